"""Adhesion that remains on given heights, by states of contact that were simulated on them.

At zero load the surfaces take the state of least energy. Every other state bounds that energy from
above. So of any states k, with elastic energies U_k and gaps g_k, the share S of the work of
adhesion w that remains is at least

    S >= max_k [ <potential of the gaps g_k> - U_k ]/w,

for any work of adhesion, any range and any law. (Of states without adhesion this is the bound of
Ciavarella, doi:10.1016/j.jmps.2018.02.013.) The closer one of the states is to the state in
question, the sharper is the bound; with those of `height_simulation` it serves as the value.

S rises with the range, because the attraction does at every gap, and w S is convex in w. So a
share that was simulated at one range is a high limit for shorter ranges, and between two works of
adhesion the chord of w S is one.

What simulation on heights leaves open widens the limits further:

- Waves below the grid, or below the resolution of the instrument, store additional energy. For the
  value they raise the energy of every state in proportion. In the low limit the whole area that
  attracts conforms to them, so that they take their energy of full contact off the work of
  adhesion (Persson, doi:10.1140/epje/i2002-10019-7); in the high limit they do not count.
- Heights are one realisation. The scatter of quarters tells how far one part of the surface
  differs from another. What the whole lacks against its quarters, a larger surface may lack twice
  as much against the whole.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray
from scipy import special

from stickiness.traction_laws import EXPONENTIAL, LAWS, find_strength

# At longer ranges than those simulated the states bound closely: what they miss is less than this,
# over the product of what remains and what is lost, and absolute.
MISSED = 0.15
LEAST_MISSED = 0.005
LEAST_LEFT = 1e-6  # of the work of adhesion
TREND = 2.0  # of a larger surface against the whole map, over that of the whole against quarters


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
    #: Work that remains over the largest tension on separation [length]; NaN where not simulated
    simulated_distance: NDArray

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
            simulated_distance=self.simulated_distance * height_unit,
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
        )

    def share(self, adhesion_length: NDArray, range: NDArray, law: str = EXPONENTIAL) -> NDArray:
        """Share that remains in the deepest of the states, a low bound, ``(n,)``.

        Parameters
        ----------
        adhesion_length, range : (n,) array
            Of the pairs [length].
        law : str
            Name in `traction_laws.LAWS`, of a potential that is convex in the gap.
        """
        return np.maximum(self._gains(adhesion_length, range, law).max(axis=1), 0.0)

    def area(self, adhesion_length: NDArray, range: NDArray, law: str = EXPONENTIAL) -> NDArray:
        """Share of the nominal area in contact at zero load, ``(n,)``; as `share`.

        It is that of the deepest state at every length simulated, and interpolated between these.
        """
        nodes = self.simulated_length
        area = np.empty(adhesion_length.shape)
        for value in np.unique(range):
            gains = self._gains(nodes, np.full(nodes.shape, value), law)
            deepest = gains.argmax(axis=1)
            touching = np.where(gains.max(axis=1) > 0, self.gap_share[deepest, 0], 0.0)
            rows = range == value
            area[rows] = np.interp(np.log(adhesion_length[rows]), np.log(nodes), touching)
        return area

    def distance(self, adhesion_length: NDArray, range: NDArray) -> NDArray:
        """Distance over which what remains acts, ``(n,)``: its work over the largest tension.

        A range beyond the one simulated lengthens it by as much.
        """
        log_length = np.log(adhesion_length)
        nodes = np.log(self.simulated_length)
        distance = np.exp(np.interp(log_length, nodes, np.log(self.simulated_distance)))
        simulated_range = np.exp(np.interp(log_length, nodes, np.log(self.simulated_range)))
        return distance + np.maximum(range - simulated_range, 0.0)

    def _gains(self, adhesion_length: NDArray, range: NDArray, law: str) -> NDArray:
        """Energy gained in every state over the work of adhesion, ``(n, state)``."""
        # Pairs have few ranges, and many adhesion lengths. The mean potential of a bin is at least
        # that of its mean gap.
        ranges, place = np.unique(range, return_inverse=True)
        attraction = np.empty((ranges.size, self.elastic_energy.size))
        for row, value in enumerate(ranges):
            potential = -LAWS[law](1.0, value).potential(self.gap)
            attraction[row] = (self.gap_share * potential).sum(axis=1)
        return attraction[place] - self.elastic_energy / adhesion_length[:, None]

    def high_limit(
        self, adhesion_length: NDArray, range: NDArray, law: str = EXPONENTIAL
    ) -> NDArray:
        """High limit of the share, ``(n,)``; as `share`."""
        # The length simulated that is next below, whose range is the shorter one.
        lengths = self.simulated_length
        below = np.maximum(np.searchsorted(lengths, adhesion_length, side="right") - 1, 0)
        # The chord of length * share. That begins at zero, and beyond the last length its slope,
        # the mean attraction, is at most 1.
        gains = np.append(0.0, lengths * self.simulated_share)
        beyond = np.maximum(adhesion_length - lengths[-1], 0.0)
        chord = np.interp(adhesion_length, np.append(0.0, lengths), gains) + beyond
        # What the law attracts beyond the one simulated.
        excess = _find_excess(range, law, self.simulated_range[below])
        share = self.share(adhesion_length, range, law)
        close = share + MISSED * share * (1 - share) + LEAST_MISSED
        is_longer = range > self.simulated_range[below]
        return np.minimum(np.where(is_longer, close, chord / adhesion_length + excess), 1.0)


def _find_excess(range: NDArray, law: str, simulated_range: NDArray) -> NDArray:
    """Largest excess of a law's potential over that of the exponential law at another range."""
    pairs, place = np.unique([range, simulated_range], axis=1, return_inverse=True)
    gaps = np.geomspace(1e-3, 30.0, 200)  # over the simulated range
    simulated = np.exp(-gaps)
    potentials = -LAWS[law](1.0, 1.0).potential(gaps * (pairs[1] / pairs[0])[:, None])
    return np.maximum(potentials - simulated, 0.0).max(axis=1)[place]


@dataclass(frozen=True, eq=False)
class SimulatedHeights:
    """States of contact on a map of heights and on its quarters."""

    whole: TrialStates
    quarters: tuple[TrialStates, ...]
    #: Energy of full contact of the map's waves up to the cutoff, per nominal area [length]
    resolved_energy: float
    pixel: float  #: of the grid simulated [length]

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
        sign: NDArray,
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
        sign : (n,) array
            0 for the value, -1 or +1 for its low or high limit, between them in proportion.
        """
        in_proportion = adhesion_length / (1 + lacking)
        value = self.whole.share(in_proportion, range, law)
        of_quarters = [quarter.share(in_proportion, range, law) for quarter in self.quarters]
        more_error, less_error = _find_patch_errors(value, np.array(of_quarters))
        # The work of adhesion that is left where all that attracts conforms to the waves.
        least_left = LEAST_LEFT * adhesion_length
        left = adhesion_length - lacking * self.whole.full_contact_energy
        low = self.whole.share(np.maximum(left, least_left), range, law) * left / adhesion_length
        low = np.where(left > least_left, np.minimum(low, value), 0.0) - less_error
        high = self.whole.high_limit(adhesion_length, range, law) + more_error
        distance = np.where(sign > 0, np.maximum(high - value, 0.0), value - low)
        return np.clip(value + sign * distance, 0.0, 1.0)

    def area(self, adhesion_length: NDArray, range: NDArray, law: str, lacking: NDArray) -> NDArray:
        """Share of the nominal area in contact at zero load, ``(n,)``; arguments as of `share`."""
        return self.whole.area(adhesion_length / (1 + lacking), range, law)

    def distance(
        self, adhesion_length: NDArray, range: NDArray, law: str, lacking: NDArray
    ) -> NDArray:
        """Distance over which what remains acts, ``(n,)``; arguments as of `share`."""
        maugis_range = range / find_strength(law)
        return self.whole.distance(adhesion_length / (1 + lacking), maugis_range)


def _find_patch_errors(whole: NDArray, quarters: NDArray) -> tuple[NDArray, NDArray]:
    """How much more and less may remain on a larger surface than on the whole map, ``(n,)`` each.

    `quarters` has the shares on the quarters, ``(quarter, n)``. Errors cover 90 %.
    """
    count = len(quarters)
    # Four independent quarters scatter twice as much as the whole.
    scatter = special.stdtrit(count - 1, 0.95) * quarters.std(axis=0, ddof=1) / np.sqrt(count)
    trend = TREND * (whole - quarters.mean(axis=0))
    return np.hypot(scatter, np.maximum(trend, 0.0)), np.hypot(scatter, np.maximum(-trend, 0.0))
