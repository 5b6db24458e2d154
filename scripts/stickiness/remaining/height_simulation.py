"""States of contact, simulated on heights, from which `trial_states` tells what remains.

The states are contacts without adhesion at a dozen loads, full contact, and states of zero load for
several works of adhesion. The attraction simulated has the shortest range that the grid resolves.
A solid that is stiff to long waves takes stronger adhesion than a half-space to conform. The grid
resolves its edges at a longer range, from which states are followed to that of the half-space.
"""

from __future__ import annotations

import logging
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import erfinv

from stickiness.adhesive import solver as adhesive
from stickiness.adhesive.edge_zone import COARSEST
from stickiness.arguments import check_length, grid
from stickiness.measured.periodic import periodise
from stickiness.remaining.full_contact import full_contact_energy
from stickiness.remaining.pull_offs import PullOffs
from stickiness.remaining.standard_heights import (
    MOST_POINTS,
    StandardHeights,
    StandardMap,
    standardise,
)
from stickiness.remaining.trial_states import SimulatedHeights, TrialStates
from stickiness.remaining.zero_load import LONGEST_RANGE, descend
from stickiness.repulsive import solver as repulsive
from stickiness.repulsive.half_space import half_space, measure_slope
from stickiness.repulsive.solver import ConvergenceError
from stickiness.solids import HALF_SPACE, Solid
from stickiness.traction_laws import Exponential, TractionLaw

#: Works of adhesion over the elastic energy of full contact, falling. They are simulated until
#: hardly anything of them remains: broad tops hold with very little adhesion.
ENERGY_RATIOS = np.append(np.geomspace(2.0, 0.2, 8), np.geomspace(0.1, 1e-4, 11))
HARDLY_ANYTHING = 0.005
#: Mean gaps at which contact is pulled off are wider than that of zero load by these ranges of the
#: attraction; one is so much wider than the next.
FIRST_OPENING = 0.7
LEAST_OPENING = 0.05
WIDER = 1.4
FALLEN = 0.85  #: of the largest tension, by which the surfaces part
#: Contact is lost where its area falls by more than this factor from one work of adhesion to the
#: next. Then works between them are simulated, down to a ratio of two works.
STEEP = 2.0
CLOSE = 1.1
SUMMITS_AREA = 0.01  #: in contact, below which single summits hold, in proportion to the work
#: Shares of the area in contact by theory, for the loads without adhesion.
CONTACT_AREAS = np.geomspace(1e-3, 0.9, 12)
CONTACT_TOLERANCE = 1e-4
ADHESION_TOLERANCE = 1e-3
STIFFER = 1.02  #: energy of full contact over that of a half-space, from which a solid is stiffer
MOST_ITERATIONS = 3000
FEW_ITERATIONS = 100  #: on such solids
#: Ends of the bins in which gaps are counted, over the rms height.
GAP_BINS = np.concatenate([[0.0], np.geomspace(1e-7, 30.0, 128)])


def simulate_heights(
    heights: ArrayLike,
    sides: tuple[float, float],
    most_points: int = MOST_POINTS,
    solid: Solid = HALF_SPACE,
) -> SimulatedHeights:
    """Simulate contact on levelled heights and their mirror images.

    Parameters
    ----------
    heights, sides, most_points
        As of `standard_heights.standardise`.
    solid : solids.HalfSpace or solids.Layer
        Elastic solid; the thickness of a layer is in the unit of `sides`.

    Raises
    ------
    ConvergenceError
        If no state with adhesion converges.
    ValueError
        If the map has too few points along a side.
    """
    return simulate_standard(standardise(heights, sides, most_points=most_points), solid)


def simulate_standard(standard: StandardHeights, solid: Solid = HALF_SPACE) -> SimulatedHeights:
    """Simulate contact on heights that are thinned; errors as of `simulate_heights`.

    The thickness of a layer is in the unit of the surface.
    """
    length_unit = standard.length_unit
    in_unit = solid.in_unit(length_unit)

    def make_cell(part: StandardMap) -> _Cell:
        return _Cell(part.heights, part.sides, in_unit, mirrored=True)

    def simulate(cell: _Cell, part: StandardMap, pictured: bool = False) -> TrialStates:
        states = cell.find_trial_states(pictured)
        return states.scaled(height_unit=part.height_unit, length_unit=length_unit)

    whole = make_cell(standard.whole)
    return SimulatedHeights(
        quarters=tuple(simulate(make_cell(quarter), quarter) for quarter in standard.quarters),
        whole=simulate(whole, standard.whole, pictured=True),
        pull_offs=whole.find_pull_offs().scaled(
            height_unit=standard.whole.height_unit, length_unit=length_unit
        ),
        resolved_energy=standard.resolved_energy,
        pixel=standard.pixel,
        independent_areas=standard.whole.independent_areas,
    )


def find_trial_states(
    heights: ArrayLike,
    length: float | tuple[float, float],
    solid: Solid = HALF_SPACE,
    mirrored: bool = False,
    pictured: bool = False,
) -> TrialStates:
    """Simulate states of contact on periodic heights.

    Parameters
    ----------
    heights : (n0, n1) array
        Periodic heights of the rigid surface [length]; not flat.
    length : float or pair of floats
        Sides of the cell [length].
    solid : solids.HalfSpace, solids.Layer or solids.Skin
        Elastic solid; the thickness of a layer is in the unit of `length`.
    mirrored : bool
        Whether heights are periodic together with their mirror images.
    pictured : bool
        Whether the gaps of all points are kept, in `TrialStates.gap_bin`.

    Raises
    ------
    ConvergenceError
        If no state with adhesion converges.

    Examples
    --------
    >>> x = 2 * np.pi * np.arange(32) / 32
    >>> egg_box = np.cos(x)[:, None] * np.cos(x)
    >>> states = find_trial_states(egg_box, length=2 * np.pi)
    >>> share = states.share(np.array([0.1]), range=np.array([0.1]))
    >>> print(f"{states.full_contact_energy:.4f} {share[0]:.2f}")  # sqrt(2)/16
    0.0884 0.27
    """
    heights = grid("heights", heights)
    cell = _Cell(heights, check_length(length, heights.shape), solid, mirrored)
    return cell.find_trial_states(pictured)


def find_pull_offs(
    heights: ArrayLike,
    length: float | tuple[float, float],
    solid: Solid = HALF_SPACE,
    mirrored: bool = False,
) -> PullOffs:
    """Pull off closed contact on periodic heights, for falling works of adhesion.

    Parameters and errors are those of `find_trial_states`.

    Examples
    --------
    >>> x = 2 * np.pi * np.arange(32) / 32
    >>> egg_box = np.cos(x)[:, None] * np.cos(x)
    >>> pull_offs = find_pull_offs(egg_box, length=2 * np.pi)
    >>> tension = 0.1 * pull_offs.find_held(np.array([0.1]), range=np.array([0.1]))
    >>> print(f"{tension[0]:.3f}")
    0.054
    """
    heights = grid("heights", heights)
    cell = _Cell(heights, check_length(length, heights.shape), solid, mirrored)
    return cell.find_pull_offs()


class _CountedState(NamedTuple):
    """A state of contact by its energy and its gaps."""

    elastic_energy: float  #: [length]
    gap_share: NDArray  #: of the nominal area, ``(bin,)``
    gap: NDArray  #: mean of every bin [length], ``(bin,)``
    gap_bin: NDArray  #: of every pixel, ``(n0, n1)``


def press(
    heights: NDArray,
    sides: tuple[float, float],
    solid: Solid = HALF_SPACE,
    mirrored: bool = False,
) -> Iterator[repulsive.Contact]:
    """Contacts without adhesion at loads where, by theory, `CONTACT_AREAS` touch."""

    def measure_full_contact(solid: Solid) -> float:
        """Rms pressure of full contact [E*]."""
        operator = half_space(heights.shape, sides, solid=solid, mirrored=mirrored)
        return float(np.std(operator.stiffness(heights)))

    # By theory a share erf(sqrt(2) p/(E* slope)) of the area touches a half-space. Pressures on
    # another solid rise as those of full contact.
    slope = measure_slope(heights, sides, mirrored)
    stiffening = measure_full_contact(solid) / measure_full_contact(HALF_SPACE)
    loads = stiffening * slope * erfinv(CONTACT_AREAS) / np.sqrt(2)
    return repulsive.load_path(
        heights, sides, loads, tol=CONTACT_TOLERANCE, solid=solid, mirrored=mirrored
    )


@dataclass(frozen=True, eq=False)
class _Cell:
    """Periodic heights against a solid, whose states of contact are simulated."""

    heights: NDArray  #: [length]
    sides: tuple[float, float]  #: [length]
    solid: Solid
    mirrored: bool = False  #: whether heights are periodic together with their mirror images
    #: States of closed contact by works of adhesion, each with the one that it was reached from
    _closed: dict[float, tuple[adhesive.Adhesion | None, ...]] = field(default_factory=dict)

    @cached_property
    def h_rms(self) -> float:
        """Rms height [length]."""
        return float(np.std(self.heights))

    @cached_property
    def energy(self) -> float:
        """Elastic energy of full contact per nominal area over E* [length]."""
        return self._find_energy(self.solid)

    @cached_property
    def half_space_energy(self) -> float:
        """That of a half-space [length]."""
        return self._find_energy(HALF_SPACE)

    def _find_energy(self, solid: Solid) -> float:
        period = periodise(self.heights, "mirror" if self.mirrored else "given")
        sides = np.multiply(self.sides, period.shape) / self.heights.shape
        return full_contact_energy(period, 1.0, tuple(sides), solid, edges="given")

    @property
    def is_stiffer(self) -> bool:
        """Whether the solid takes more energy to conform than a half-space."""
        return self.energy > self.half_space_energy * STIFFER

    @property
    def pixel(self) -> float:
        """Longer side of a pixel [length]."""
        return max(side / n for side, n in zip(self.sides, self.heights.shape, strict=True))

    def find_shortest_range(self, energy_ratio: float) -> float:
        """Shortest range [length] that the grid resolves on a half-space."""
        return np.sqrt(self.pixel * energy_ratio * self.half_space_energy / COARSEST)

    def choose_law(self, energy_ratio: float) -> Exponential:
        """Attraction of a work over the energy of full contact, as short as the grid resolves."""
        adhesion_length = energy_ratio * self.energy
        resolved_range = np.sqrt(self.pixel * adhesion_length / COARSEST)
        longest_range = max(LONGEST_RANGE * self.h_rms, self.find_shortest_range(energy_ratio))
        return Exponential(adhesion_length, min(resolved_range, longest_range))

    def count(self, elastic_energy: float, gap: NDArray) -> _CountedState:
        """Count the gaps of a state in `GAP_BINS`."""
        index = np.searchsorted(GAP_BINS, gap.ravel() / self.h_rms)
        counts = np.bincount(index, minlength=GAP_BINS.size + 1)
        sums = np.bincount(index, weights=gap.ravel(), minlength=GAP_BINS.size + 1)
        return _CountedState(
            elastic_energy=elastic_energy,
            gap_share=counts / gap.size,
            gap=sums / np.maximum(counts, 1),
            gap_bin=index.reshape(gap.shape).astype("u1"),
        )

    def count_contact(self, contact: repulsive.Contact) -> _CountedState:
        """Count the gaps of a contact without adhesion."""
        displacement = contact.gap + self.heights - contact.shift
        elastic_energy = float(np.mean(contact.pressure * displacement)) / 2
        return self.count(elastic_energy, contact.gap)

    def adhere(
        self, law: TractionLaw, start: str | NDArray | adhesive.Adhesion
    ) -> adhesive.Adhesion | None:
        """State of zero load from a start; None if it does not converge.

        One on a solid that is stiffer than a half-space counts when its iterations are spent, too:
        any state bounds the energy. On the grid, single points hold it back.
        """
        try:
            return self.descend(law, start)
        except ConvergenceError as error:
            logging.info("adhesion length %.3g: %s", law.adhesion_length, error)
            spent = self.is_stiffer and not isinstance(error, adhesive.PullOffError)
            return error.contact if spent else None

    def close(
        self, energy_ratio: float, stronger: adhesive.Adhesion | None
    ) -> adhesive.Adhesion | None:
        """State of zero load that contact which `stronger` adhesion has closed ends in.

        None if it does not converge. States are kept: what remains and what holds ask for the same.
        """
        kept = self._closed.get(energy_ratio)
        if kept is None or kept[0] is not stronger:
            start = adhesive.SEPARATION if stronger is None else stronger.gap
            kept = stronger, self.adhere(self.choose_law(energy_ratio), start)
            self._closed[energy_ratio] = kept
        return kept[1]

    def descend(
        self,
        law: TractionLaw,
        start: str | NDArray | adhesive.Adhesion,
        mean_gap: float | None = None,
    ) -> adhesive.Adhesion:
        """State of contact at zero load, or at a mean gap; errors as of `adhesive.solve`."""
        is_quick = self.is_stiffer and mean_gap is None
        return descend(
            self.heights,
            self.sides,
            law,
            self.solid,
            start,
            tol=ADHESION_TOLERANCE,
            max_iterations=FEW_ITERATIONS if is_quick else MOST_ITERATIONS,
            mean_gap=mean_gap,
            mirrored=self.mirrored,
        )

    def shorten_range(
        self, state: adhesive.Adhesion, shortest: float
    ) -> Iterator[adhesive.Adhesion]:
        """Follow a state of zero load to a shorter range of the attraction.

        The grid may end that before the shortest range [length].
        """
        while state.law.range > shortest:
            law = Exponential(state.law.adhesion_length, max(state.law.range / 2, shortest))
            try:
                shorter = self.adhere(law, state)
            except ValueError as error:
                logging.info("range %.3g: %s", law.range, error)  # the grid would set the edges
                return
            if shorter is None:
                return
            state = shorter
            yield state

    def follow_closed(self) -> Iterator[adhesive.Adhesion]:
        """Closed contact at zero load, for falling works of adhesion until it is lost."""
        closed = None
        last_ratio = np.inf
        last_area = 0.0
        remaining = list(ENERGY_RATIOS[::-1])
        while remaining:
            energy_ratio = remaining.pop()
            state = self.close(energy_ratio, closed)
            if state is None:
                continue
            area = state.repulsive_area_fraction
            # Where contact is lost, the work of adhesion is approached from the last one.
            if STEEP * area < last_area and CLOSE * energy_ratio < last_ratio:
                remaining += [energy_ratio, np.sqrt(energy_ratio * last_ratio)]
                continue
            closed = state
            last_ratio = energy_ratio
            last_area = area
            if self.is_stiffer:
                shortest = self.find_shortest_range(energy_ratio)
                state = [state, *self.shorten_range(state, shortest)][-1]
            yield state
            if area < SUMMITS_AREA:
                return

    def pull_off(self, state: adhesive.Adhesion) -> float:
        """Largest mean tension [E*] on the way from a state of zero load, at given mean gaps.

        There the tension has a maximum, next to which it hardly changes: mean gaps that are close
        find it within 3 %. Under a given tension it would be an end, which tolerances of the solver
        move.
        """

        def pull(opening: float, start: adhesive.Adhesion) -> adhesive.Adhesion:
            """State at a mean gap that is wider by an opening, in ranges of the attraction."""
            mean_gap = state.mean_gap + opening * state.law.range
            try:
                return self.descend(state.law, start, mean_gap)
            except ConvergenceError as error:
                return error.contact

        # Open until the tension has passed its maximum.
        opening = FIRST_OPENING
        opened = pull(opening, state)
        tensions = [-opened.mean_pressure]
        while not 0 < tensions[-1] < FALLEN * max(tensions):
            opening *= WIDER
            opened = pull(opening, opened)
            tensions.append(-opened.mean_pressure)
        # Stiffer edges hold most before the first of these openings, which may have torn contact
        # that is nearly lost: then the surfaces press there.
        opening = FIRST_OPENING
        while opening > LEAST_OPENING and (tensions[0] <= 0 or max(tensions) == tensions[0]):
            opening /= WIDER
            tensions.insert(0, -pull(opening, state).mean_pressure)
        return max(tensions)

    def find_trial_states(self, pictured: bool) -> TrialStates:
        """Simulate states of contact; see the function of this name."""
        # Surfaces that touch at the summit, and contact without adhesion up to full contact.
        counted = [
            self.count(0.0, self.heights.max() - self.heights),
            *map(self.count_contact, press(self.heights, self.sides, self.solid, self.mirrored)),
            self.count(self.energy, np.zeros(self.heights.shape)),
        ]
        without_adhesion = len(counted)

        # States at zero load, from strong to weak adhesion, and the share in the deepest of each.
        simulated = []
        closed = None
        for energy_ratio in ENERGY_RATIOS:
            law = self.choose_law(energy_ratio)
            found = self.close(energy_ratio, closed), self.adhere(law, adhesive.APPROACH)
            closed = found[0] or closed
            states = [state for state in found if state is not None]
            if not states:
                continue
            deepest = min(states, key=lambda state: state.energy)
            if self.is_stiffer:
                followed = list(self.shorten_range(deepest, self.find_shortest_range(energy_ratio)))
                states += followed
                deepest = [deepest, *followed][-1]
            counted += [self.count(state.elastic_energy, state.gap) for state in states]
            adhesion_length = law.adhesion_length
            share = max(-deepest.energy, 0.0) / adhesion_length
            simulated.append((adhesion_length, deepest.law.range, share))
            if share < HARDLY_ANYTHING:
                break
        if not simulated:
            raise ConvergenceError("no state of contact with adhesion converged", None)
        lengths, ranges, shares = np.array(simulated[::-1]).T
        trial_states = TrialStates(
            elastic_energy=np.array([state.elastic_energy for state in counted]),
            gap_share=np.array([state.gap_share for state in counted]),
            gap=np.array([state.gap for state in counted]),
            has_adhesion=np.arange(len(counted)) >= without_adhesion,
            full_contact_energy=self.energy,
            simulated_length=lengths,
            simulated_range=ranges,
            simulated_share=shares,
            gap_bin=np.array([state.gap_bin for state in counted]) if pictured else None,
        )
        if not self.is_stiffer:
            return trial_states
        # Where a state was not followed to its end, that of another work of adhesion may be deeper.
        of_deepest = trial_states.share(lengths, ranges)
        return replace(trial_states, simulated_share=np.maximum(shares, of_deepest))

    def find_pull_offs(self) -> PullOffs:
        """Pull off closed contact; see the function of this name."""
        pulled = [(state, self.pull_off(state)) for state in self.follow_closed()][::-1]
        if not pulled:
            raise ConvergenceError("no state of closed contact converged", None)
        return PullOffs(
            length=np.array([state.law.adhesion_length for state, _ in pulled]),
            range=np.array([state.law.range for state, _ in pulled]),
            # What weaker adhesion withstands, stronger adhesion does.
            tension=np.maximum.accumulate([tension for _, tension in pulled]),
            area=np.array([state.repulsive_area_fraction for state, _ in pulled]),
        )
