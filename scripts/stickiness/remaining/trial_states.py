"""Adhesion that remains on given heights, by states of contact that were simulated on them.

At zero load the surfaces take the state of least energy. Every other state bounds that energy from
above. So of any states k, with elastic energies U_k and gaps g_k, the share S of the work of
adhesion w that remains is at least

    S >= max_k [ <potential of the gaps g_k> - U_k ]/w,

for any work of adhesion, any range and any law. (Of states without adhesion this is the bound of
Ciavarella, doi:10.1016/j.jmps.2018.02.013.) The closer one of the states is to the state in
question, the sharper is the bound; with those of `height_simulation` it serves as the value.

S rises with the range, because the attraction does at every gap, and w S is convex in w. So a
share that was simulated at one range is a high limit for shorter ranges, and linear interpolation
of w S between two works of adhesion is an upper bound. At a range shorter than the one simulated,
the share lies between both bounds, at a place that was measured.

What simulation on heights leaves open is an error of the work of adhesion, see `calibration`:

- Waves below the grid, or below the resolution of the instrument, store additional energy. They
  raise the energy of every state in proportion, which divides the work of adhesion. Where little
  remains they take more than that, see `SimulatedHeights.find_shift`.
- Heights are one realisation. How far its quarters differ from the whole map tells how far that may
  differ from the surface which it was cut from.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.remaining.errors import (
    PATCH,
    PLACE,
    UNRESOLVED,
    between,
    find_states_error,
)
from stickiness.remaining.pull_offs import PullOffs
from stickiness.traction_laws import EXPONENTIAL, LAWS, find_strength

DEFAULT_SHARE = 0.1  #: of the work of adhesion, from which a pair is said to stick
#: Adhesion lengths over the energy of full contact at which thresholds of parts are looked for
_LENGTHS = np.geomspace(1e-7, 1e4, 331)


@dataclass(frozen=True, eq=False)
class TrialStates:
    """States of contact on one periodic map of heights; lengths in one unit, energies over E*."""

    elastic_energy: NDArray  #: of every state per nominal area [length], ``(state,)``
    #: Share of the nominal area by bins of the gap, and the mean gap of every bin [length],
    #: ``(state, bin)``; the first bin is contact.
    gap_share: NDArray
    gap: NDArray
    has_adhesion: NDArray  #: whether a state was simulated with adhesion, ``(state,)``
    full_contact_energy: float  #: per nominal area [length]
    #: Adhesion lengths simulated, rising, their ranges [length], and the shares that remained,
    #: ``(length,)``.
    simulated_length: NDArray
    simulated_range: NDArray
    simulated_share: NDArray
    #: Bin of the gap of every pixel, for pictures; None where it is not kept, ``(state, n0, n1)``
    gap_bin: NDArray | None = None

    def scaled(self, height_unit: float, length_unit: float) -> Self:
        """Return the states in other units: of heights and gaps, and of lengths along the surface.

        The solid is linear: its energies over E* are products of two heights over a length.
        """
        energy_unit = height_unit**2 / length_unit
        return replace(
            self,
            elastic_energy=self.elastic_energy * energy_unit,
            gap=self.gap * height_unit,
            full_contact_energy=self.full_contact_energy * energy_unit,
            simulated_length=self.simulated_length * energy_unit,
            simulated_range=self.simulated_range * height_unit,
        )

    def without_adhesion(self) -> Self:
        """Return the states that were simulated without adhesion, and full contact."""
        kept = ~self.has_adhesion
        return replace(
            self,
            elastic_energy=self.elastic_energy[kept],
            gap_share=self.gap_share[kept],
            gap=self.gap[kept],
            has_adhesion=self.has_adhesion[kept],
            gap_bin=None if self.gap_bin is None else self.gap_bin[kept],
        )

    def share(self, adhesion_length: NDArray, range: NDArray, law: str = EXPONENTIAL) -> NDArray:
        """Share that remains in the deepest of the states, a lower bound, ``(n,)``.

        Parameters
        ----------
        adhesion_length, range : (n,) array
            Of the pairs [length].
        law : str
            Name in `traction_laws.LAWS`, of a potential that is convex in the gap.
        """
        return np.maximum(self._gains(adhesion_length, range, law).max(axis=1), 0.0)

    def find_deepest(
        self, adhesion_length: NDArray, range: NDArray, law: str = EXPONENTIAL
    ) -> NDArray:
        """Index of the deepest of the states, which gives `share`, ``(n,)``."""
        return self._gains(adhesion_length, range, law).argmax(axis=1)

    def find_gap(self, state: int) -> NDArray:
        """Gap of every pixel in a state [length], the mean of its bin, ``(n0, n1)``."""
        if self.gap_bin is None:
            raise ValueError("the gaps of these states are not kept")
        return self.gap[state][self.gap_bin[state]]

    def area(self, adhesion_length: NDArray, range: NDArray, law: str = EXPONENTIAL) -> NDArray:
        """Share of the nominal area in contact at zero load, ``(n,)``; as `share`.

        It is that of the deepest state at every length simulated, and interpolated between these.
        """
        nodes = self.simulated_length
        area = np.empty(adhesion_length.shape)
        for one_range in np.unique(range):
            gains = self._gains(nodes, np.full(nodes.shape, one_range), law)
            deepest = gains.argmax(axis=1)
            touching = np.where(gains.max(axis=1) > 0, self.gap_share[deepest, 0], 0.0)
            rows = range == one_range
            area[rows] = np.interp(np.log(adhesion_length[rows]), np.log(nodes), touching)
        return area

    def _gains(self, adhesion_length: NDArray, range: NDArray, law: str) -> NDArray:
        """Energy gained in every state over the work of adhesion, ``(n, state)``."""
        # Pairs have few ranges, and many adhesion lengths. The mean potential of a bin is at least
        # that of its mean gap.
        ranges, place = np.unique(range, return_inverse=True)
        attraction = np.empty((ranges.size, self.elastic_energy.size))
        for place_of_range, one_range in enumerate(ranges):
            potential = -LAWS[law](1.0, one_range).potential(self.gap)
            attraction[place_of_range] = (self.gap_share * potential).sum(axis=1)
        return attraction[place] - self.elastic_energy / adhesion_length[:, None]

    def find_high_bound(
        self, adhesion_length: NDArray, range: NDArray, law: str = EXPONENTIAL
    ) -> NDArray:
        """High bound of the share at ranges up to those simulated, ``(n,)``; as `share`."""
        lengths = self.simulated_length
        # The chord of length * share. That begins at zero, and beyond the last length its slope,
        # the mean attraction, is at most 1.
        gains = np.append(0.0, lengths * self.simulated_share)
        beyond = np.maximum(adhesion_length - lengths[-1], 0.0)
        chord = np.interp(adhesion_length, np.append(0.0, lengths), gains) + beyond
        # What the law attracts beyond the one simulated.
        excess = _find_excess(range, law, self._find_simulated_range(adhesion_length))
        return np.minimum(chord / adhesion_length + excess, 1.0)

    def _find_simulated_range(self, adhesion_length: NDArray) -> NDArray:
        """Range simulated at the length next below, which is the shorter one."""
        below = np.searchsorted(self.simulated_length, adhesion_length, side="right") - 1
        return self.simulated_range[np.maximum(below, 0)]

    def share_between(
        self, adhesion_length: NDArray, range: NDArray, law: str, eta: NDArray
    ) -> NDArray:
        """Share that remains, between both bounds, ``(n,)``; as `share`.

        `eta` is -1 or +1 for the low or high limit of the place between them.
        States simulated at this range or a shorter one bound the share closely.
        """
        low_bound = self.share(adhesion_length, range, law)
        high_bound = self.find_high_bound(adhesion_length, range, law)
        ratio = range / self._find_simulated_range(adhesion_length)
        # It is the further up, the stronger the adhesion is, and the shorter its range. Beyond
        # the strongest that was simulated, full contact is near, whose energy is known.
        strongest = self.simulated_length[-1]
        strength = np.minimum(adhesion_length, strongest**2 / adhesion_length)
        strength = strength / self.full_contact_energy
        place = between(PLACE.spread, eta) * PLACE.unit(strength, ratio)
        place = np.clip(place, 0.0, 1.0)
        return low_bound + place * np.maximum(high_bound - low_bound, 0.0)

    def find_threshold(self, range: float, law: str, wanted: float) -> float:
        """Logarithm of the adhesion length at which a share remains; NaN if it does at any."""
        lengths = _LENGTHS * self.full_contact_energy
        shares = self.share(lengths, np.full(lengths.shape, range), law)
        if shares[0] >= wanted:
            return np.nan
        # Shares fall a little where full contact takes over from states that are not its own.
        return float(np.interp(wanted, np.maximum.accumulate(shares), np.log(lengths)))


def _find_excess(range: NDArray, law: str, simulated_range: NDArray) -> NDArray:
    """Largest excess of a law's potential over that of the exponential law at another range."""
    pairs, place = np.unique([range, simulated_range], axis=1, return_inverse=True)
    gaps = np.geomspace(1e-3, 30.0, 200)  # over the simulated range
    simulated = np.exp(-gaps)
    potentials = -LAWS[law](1.0, 1.0).potential(gaps * (pairs[1] / pairs[0])[:, None])
    return np.maximum(potentials - simulated, 0.0).max(axis=1)[place]


@dataclass(frozen=True, eq=False)
class SimulatedHeights:
    """States of contact on a map of heights and on its quarters, and pull-offs from the map."""

    whole: TrialStates
    quarters: tuple[TrialStates, ...]
    pull_offs: PullOffs
    #: Energy of full contact of the map's waves up to the cutoff, per nominal area [length]
    resolved_energy: float
    pixel: float  #: of the grid simulated [length]
    independent_areas: float  #: of the map, see `standard_heights.StandardMap`
    #: Distances of the quarters from the map, of ranges and laws asked for before
    _distances: dict[tuple[float, str], float] = field(init=False, repr=False, default_factory=dict)

    @property
    def lost_ratio(self) -> float:
        """Work of adhesion over the energy of full contact at which contact is nearly lost."""
        return self.pull_offs.lost_length / self.whole.full_contact_energy

    def without_adhesion(self) -> Self:
        """Return the states that were simulated without adhesion, and full contact."""
        quarters = tuple(quarter.without_adhesion() for quarter in self.quarters)
        return replace(self, whole=self.whole.without_adhesion(), quarters=quarters)

    def share(
        self,
        adhesion_length: NDArray,
        range: NDArray,
        law: str,
        lacking: NDArray,
        eta: NDArray,
        wanted_share: float = DEFAULT_SHARE,
    ) -> NDArray:
        """Share of the work of adhesion that remains, ``(n,)``.

        Parameters
        ----------
        adhesion_length, range : (n,) array
            Of the pairs, in the unit of the heights.
        law : str
            Name in `traction_laws.LAWS`.
        lacking : (n,) array
            Energy of full contact of the waves that are not simulated, over that of the others.
        eta : (n,) array
            0 for the value, -1 or +1 for its low or high limit, between them in proportion.
        wanted_share : float
            Share at which limits cover 90 %: they are wider where less is asked for.
        """
        shift = self.find_shift(adhesion_length, range, law, lacking, eta, wanted_share)
        share = self.whole.share_between(adhesion_length * np.exp(shift), range, law, eta)
        return np.clip(share + eta * find_states_error(share), 0.0, 1.0)

    def find_shift(
        self,
        adhesion_length: NDArray,
        range: NDArray,
        law: str,
        lacking: NDArray,
        eta: ArrayLike = 0.0,
        wanted_share: float = DEFAULT_SHARE,
    ) -> NDArray:
        """Logarithm of the factor on the work of adhesion, ``(n,)``; arguments as of `share`."""
        ranges, place = np.unique(range, return_inverse=True)
        errors = [self.find_patch_error(float(each), law, wanted_share) for each in ranges]
        of_patch = np.array(errors)
        # Waves that lack cost their energy, and more where contact is sparse: they part summits.
        stored = np.log1p(lacking)
        lost = 1 - self.whole.share(adhesion_length / (1 + lacking), range, law)
        beyond = UNRESOLVED.unit(lacking, lost)
        value, low, high = UNRESOLVED.spread
        of_waves = np.where(np.less(eta, 0), value - low, high - value)
        error = np.hypot(of_patch[place], of_waves * beyond)
        return value * beyond - stored + np.multiply(eta, error)

    def find_patch_error(self, range: float, law: str, wanted_share: float) -> float:
        """Error of ln of the work of adhesion by what another place of the surface may differ.

        It covers 90 % at the share that is wanted. `range` is in the unit of the heights, `law` a
        name in `traction_laws.LAWS`.
        """
        distance = self._find_distance(range, law)
        return float(PATCH.half_width(distance, self.independent_areas, wanted_share))

    def _find_distance(self, range: float, law: str) -> float:
        """Rms distance of the quarters from the map, in ln of thresholds of the default share."""
        if (range, law) not in self._distances:
            parts = (self.whole, *self.quarters)
            whole, *quarters = (part.find_threshold(range, law, DEFAULT_SHARE) for part in parts)
            # Parts that hold at any work of adhesion have no threshold.
            known = np.array(quarters)[np.isfinite(quarters)] - whole
            distance = np.sqrt(np.mean(known**2)) if np.isfinite(known).any() else 0.0
            self._distances[range, law] = float(distance)
        return self._distances[range, law]

    def area(self, adhesion_length: NDArray, range: NDArray, law: str, lacking: NDArray) -> NDArray:
        """Share of the nominal area in contact at zero load, ``(n,)``; arguments as of `share`."""
        shift = self.find_shift(adhesion_length, range, law, lacking)
        return self.whole.area(adhesion_length * np.exp(shift), range, law)

    def find_deepest(
        self, adhesion_length: NDArray, range: NDArray, law: str, lacking: NDArray
    ) -> NDArray:
        """Index of the deepest state of the whole map, ``(n,)``; arguments as of `share`."""
        shift = self.find_shift(adhesion_length, range, law, lacking)
        return self.whole.find_deepest(adhesion_length * np.exp(shift), range, law)

    def tension(
        self,
        adhesion_length: NDArray,
        range: NDArray,
        law: str,
        lacking: NDArray,
        eta: NDArray,
    ) -> NDArray:
        """Largest mean tension on separation over E*, ``(n,)``; arguments as of `share`."""
        shift = self.find_shift(adhesion_length, range, law, lacking, eta)
        maugis_range = range / find_strength(law)
        held = self.pull_offs.find_held(adhesion_length * np.exp(shift), maugis_range)
        return adhesion_length * held
