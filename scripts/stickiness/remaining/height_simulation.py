"""States of contact, simulated on heights, from which `trial_states` tells what remains.

The states are contacts without adhesion at a dozen loads, full contact, and states of zero load for
several works of adhesion. The attraction simulated has the shortest range that the grid resolves.
A solid that is stiff to long waves takes stronger adhesion than a half-space to conform. The grid
resolves its edges at a longer range, from which states are followed to that of the half-space.
"""

from __future__ import annotations

import logging
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import erfinv

from stickiness.adhesive import solver as adhesive
from stickiness.adhesive.edge_zone import COARSEST
from stickiness.arguments import check_length, grid
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

    def simulate(part: StandardMap, is_whole: bool = False) -> TrialStates:
        states = find_trial_states(
            part.mirrored,
            part.mirrored_sides,
            solid=in_unit,
            # Pictures show the whole map, without its mirror images.
            pictured=part.heights.shape if is_whole else None,
        )
        return states.scaled(height_unit=part.height_unit, length_unit=length_unit)

    whole = standard.whole
    pull_offs = find_pull_offs(whole.mirrored, whole.mirrored_sides, solid=in_unit)
    return SimulatedHeights(
        quarters=tuple(simulate(quarter) for quarter in standard.quarters),
        whole=simulate(whole, is_whole=True),
        pull_offs=pull_offs.scaled(height_unit=whole.height_unit, length_unit=length_unit),
        resolved_energy=standard.resolved_energy,
        pixel=standard.pixel,
        independent_areas=standard.whole.independent_areas,
    )


def find_trial_states(
    heights: ArrayLike,
    length: float | tuple[float, float],
    solid: Solid = HALF_SPACE,
    pictured: tuple[int, ...] | None = None,
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
    pictured : pair of ints, optional
        Points along both sides of whose gaps pictures are kept, in `TrialStates.gap_bin`.

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
    cell = _Cell(heights, check_length(length, heights.shape), solid, pictured or (0, 0))
    # Surfaces that touch at the summit, and contact without adhesion up to full contact.
    counted = [
        cell.count(0.0, heights.max() - heights),
        *(cell.count_contact(each) for each in press(heights, cell.sides, solid)),
        cell.count(cell.energy, np.zeros(heights.shape)),
    ]
    without_adhesion = len(counted)

    # States at zero load, from strong to weak adhesion, and the share in the deepest of each.
    simulated = []
    closed: str | NDArray = adhesive.SEPARATION
    for energy_ratio in ENERGY_RATIOS:
        law = cell.choose_law(energy_ratio)
        states = list(cell.adhere(law, (closed, adhesive.APPROACH)))
        if not states:
            continue
        closed = states[0].gap
        deepest = min(states, key=lambda state: state.energy)
        if cell.is_stiffer:
            followed = list(cell.shorten_range(deepest, cell.find_shortest_range(energy_ratio)))
            states += followed
            deepest = [deepest, *followed][-1]
        counted += [cell.count(state.elastic_energy, state.gap) for state in states]
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
        full_contact_energy=cell.energy,
        simulated_length=lengths,
        simulated_range=ranges,
        simulated_share=shares,
        gap_bin=None if pictured is None else np.array([state.gap_bin for state in counted]),
    )
    if not cell.is_stiffer:
        return trial_states
    # Where a state was not followed to its end, that for another work of adhesion may be deeper.
    of_deepest = trial_states.share(lengths, ranges)
    return replace(trial_states, simulated_share=np.maximum(shares, of_deepest))


def find_pull_offs(
    heights: ArrayLike, length: float | tuple[float, float], solid: Solid = HALF_SPACE
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
    cell = _Cell(heights, check_length(length, heights.shape), solid)
    pulled = [(state, cell.pull_off(state)) for state in cell.follow_closed()][::-1]
    if not pulled:
        raise ConvergenceError("no state of closed contact converged", None)
    return PullOffs(
        length=np.array([state.law.adhesion_length for state, _ in pulled]),
        range=np.array([state.law.range for state, _ in pulled]),
        # What weaker adhesion withstands, stronger adhesion does.
        tension=np.maximum.accumulate([tension for _, tension in pulled]),
        area=np.array([state.repulsive_area_fraction for state, _ in pulled]),
    )


class _CountedState(NamedTuple):
    """A state of contact by its energy and its gaps."""

    elastic_energy: float  #: [length]
    gap_share: NDArray  #: of the nominal area, ``(bin,)``
    gap: NDArray  #: mean of every bin [length], ``(bin,)``
    gap_bin: NDArray  #: of every pixel that is pictured, ``(n0, n1)``


def press(
    heights: NDArray, sides: tuple[float, float], solid: Solid = HALF_SPACE
) -> Iterator[repulsive.Contact]:
    """Contacts without adhesion at loads where, by theory, `CONTACT_AREAS` touch."""
    slope = measure_slope(heights, sides)
    # By theory a share erf(sqrt(2) p/(E* slope)) of the area touches a half-space. Pressures on
    # another solid rise as those of full contact.
    rms_pressure, on_half_space = (
        float(np.std(half_space(heights.shape, sides, solid=each, kept=False).stiffness(heights)))
        for each in (solid, HALF_SPACE)
    )
    loads = rms_pressure / on_half_space * slope * erfinv(CONTACT_AREAS) / np.sqrt(2)
    return repulsive.load_path(heights, sides, loads, tol=CONTACT_TOLERANCE, solid=solid)


@dataclass(frozen=True, eq=False)
class _Cell:
    """Periodic heights against a solid, whose states of contact are simulated."""

    heights: NDArray  #: [length]
    sides: tuple[float, float]  #: [length]
    solid: Solid
    pictured: tuple[int, ...] = (0, 0)  #: points along both sides of which gaps are kept

    @cached_property
    def h_rms(self) -> float:
        """Rms height [length]."""
        return float(np.std(self.heights))

    @cached_property
    def energy(self) -> float:
        """Elastic energy of full contact per nominal area over E* [length]."""
        return full_contact_energy(self.heights, 1.0, self.sides, self.solid, edges="given")

    @cached_property
    def half_space_energy(self) -> float:
        """That of a half-space [length]."""
        return full_contact_energy(self.heights, 1.0, self.sides, edges="given")

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
            gap_bin=index.reshape(gap.shape)[: self.pictured[0], : self.pictured[1]].astype("u1"),
        )

    def count_contact(self, contact: repulsive.Contact) -> _CountedState:
        """Count the gaps of a contact without adhesion."""
        displacement = contact.gap + self.heights - contact.shift
        elastic_energy = float(np.mean(contact.pressure * displacement)) / 2
        return self.count(elastic_energy, contact.gap)

    def adhere(
        self, law: TractionLaw, starts: tuple[str | NDArray | adhesive.Adhesion, ...]
    ) -> Iterator[adhesive.Adhesion]:
        """States of zero load, from several starts, but for those that do not converge.

        Those on a solid that is stiffer than a half-space count when their iterations are spent,
        too: any state bounds the energy. On the grid, single points hold them back.
        """
        for start in starts:
            try:
                yield self.descend(law, start)
            except ConvergenceError as error:
                if self.is_stiffer and not isinstance(error, adhesive.PullOffError):
                    yield error.contact
                logging.info("adhesion length %.3g: %s", law.adhesion_length, error)

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
                (state,) = self.adhere(law, (state,))
            except ValueError as error:
                logging.info("range %.3g: %s", law.range, error)  # the grid would set the edges
                return
            yield state

    def follow_closed(self) -> Iterator[adhesive.Adhesion]:
        """Closed contact at zero load, for falling works of adhesion until it is lost."""
        closed: str | NDArray = adhesive.SEPARATION
        last_ratio = np.inf
        last_area = 0.0
        remaining = list(ENERGY_RATIOS[::-1])
        while remaining:
            energy_ratio = remaining.pop()
            state = next(self.adhere(self.choose_law(energy_ratio), (closed,)), None)
            if state is None:
                continue
            area = state.repulsive_area_fraction
            # Where contact is lost, the work of adhesion is approached from the last one.
            if STEEP * area < last_area and CLOSE * energy_ratio < last_ratio:
                remaining += [energy_ratio, np.sqrt(energy_ratio * last_ratio)]
                continue
            closed = state.gap
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
