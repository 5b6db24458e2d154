"""States of contact, simulated on heights, from which `trial_states` tells what remains.

The states are contacts without adhesion at a dozen loads, full contact, and states of zero load for
several works of adhesion. The attraction simulated has the shortest range that the grid resolves.
"""

from __future__ import annotations

import logging
import warnings
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import erfinv

from stickiness.adhesive import solver as adhesive
from stickiness.adhesive.edge_zone import COARSEST
from stickiness.arguments import grid
from stickiness.measured import periodic
from stickiness.plausibility import PlausibilityWarning
from stickiness.remaining.full_contact import full_contact_energy
from stickiness.remaining.trial_states import SimulatedHeights, TrialStates
from stickiness.repulsive import solver as repulsive
from stickiness.repulsive.half_space import check_length, measure_slope
from stickiness.repulsive.solver import ConvergenceError
from stickiness.solids import HALF_SPACE, Solid
from stickiness.traction_laws import Exponential

MOST_POINTS = 256  #: of the grid, along the longer side
PIXELS_PER_WAVE = 4  #: of the shortest wave, at least
MOST_PIXELS_PER_WAVE = 8  #: beyond which a finer grid changes little
#: Works of adhesion over the elastic energy of full contact, falling. They are simulated until
#: hardly anything of them remains: broad tops hold with very little adhesion.
ENERGY_RATIOS = np.append(np.geomspace(2.0, 0.2, 8), np.geomspace(0.1, 1e-4, 11))
HARDLY_ANYTHING = 0.005
LAST_STEP = 1.1  #: of the tension on separation, over the one before
#: Shares of the area in contact by theory, for the loads without adhesion.
CONTACT_AREAS = np.geomspace(1e-3, 0.9, 12)
CONTACT_TOLERANCE = 1e-4
ADHESION_TOLERANCE = 1e-3
#: Ends of the bins in which gaps are counted, over the rms height.
GAP_BINS = np.concatenate([[0.0], np.geomspace(1e-7, 30.0, 128)])
STANDARD_HEIGHT = 0.01  #: rms height of what is simulated, over the first side of the map
DECIMALS = 10  #: of these heights; an instrument resolves far less
_ROUNDING = 1e-9


def simulate_heights(
    heights: ArrayLike,
    sides: tuple[float, float],
    cutoff: float,
    most_points: int = MOST_POINTS,
) -> tuple[SimulatedHeights, float]:
    """Simulate contact on levelled heights, which are made periodic.

    Parameters
    ----------
    heights : (nx, ny) array
        Levelled heights [length].
    sides : pair of floats
        Sides of the map [length].
    cutoff : float
        Highest wave number that the heights resolve [1/length].
    most_points : int
        Points of the grid along the longer side, at most.

    Returns
    -------
    SimulatedHeights
    float
        Highest wave number that is simulated [1/length].

    Raises
    ------
    ConvergenceError
        If no state with adhesion converges.
    """
    heights = np.asarray(heights, dtype=float)
    q_max, pixels = choose_grid(heights.shape, sides, cutoff, most_points)

    def simulate(part: NDArray, pull: bool = False) -> TrialStates:
        # The part, with its sides over the first side of the whole.
        shares = zip(sides, part.shape, heights.shape, strict=True)
        part_sides = tuple(side / sides[0] * n / of_whole for side, n, of_whole in shares)
        level = periodic.periodise(part, "smooth")
        limited = periodic.band_limited(level, part_sides, q_max * sides[0], pixels)
        # Heights of one size for every surface, rounded: last bits do not matter.
        height_unit = float(np.std(limited)) / STANDARD_HEIGHT
        standard = np.round(limited / height_unit, DECIMALS)
        states = find_trial_states(standard, part_sides, pull=pull)
        return states.scaled(height_unit=height_unit, length_unit=sides[0])

    half_x, half_y = (n // 2 for n in heights.shape)
    quarters = [
        simulate(heights[along_x, along_y])
        for along_x in (slice(None, half_x), slice(half_x, None))
        for along_y in (slice(None, half_y), slice(half_y, None))
    ]
    return SimulatedHeights(simulate(heights, pull=True), tuple(quarters)), q_max


def choose_grid(
    shape: tuple[int, ...],
    sides: tuple[float, float],
    cutoff: float,
    most_points: int = MOST_POINTS,
) -> tuple[float, float]:
    """Highest wave number to simulate [1/length], and grid points per wavelength of that."""
    nyquist = np.pi * min(n / side for n, side in zip(shape, sides, strict=True))
    most_waves = most_points / PIXELS_PER_WAVE
    q_max = min(cutoff, nyquist, 2 * np.pi * most_waves / max(sides)) * (1 - _ROUNDING)
    pixels = 2 * np.pi * most_points / (max(sides) * q_max)
    return q_max, min(MOST_PIXELS_PER_WAVE, pixels) * (1 - _ROUNDING)


def find_trial_states(
    heights: ArrayLike,
    length: float | tuple[float, float],
    solid: Solid = HALF_SPACE,
    pull: bool = True,
) -> TrialStates:
    """Simulate states of contact on periodic heights.

    Parameters
    ----------
    heights : (n0, n1) array
        Periodic heights of the rigid surface [length]; not flat.
    length : float or pair of floats
        Sides of the cell [length].
    solid : solids.HalfSpace or solids.Layer
        Elastic solid; the thickness of a layer is in the unit of `length`.
    pull : bool
        Whether to pull the surfaces off, for `TrialStates.distance`.

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
    sides = check_length(length, heights.shape)
    h_rms = float(np.std(heights))
    counted = list(_press(heights, sides, solid, h_rms))

    # Full contact has no gaps; it is the last state without adhesion.
    energy = full_contact_energy(heights, 1.0, sides, solid, edges="given")
    counted.append(_count_gaps(energy, np.zeros(heights.shape), h_rms))

    # States at zero load, from strong to weak adhesion: the share in the deepest of each, and the
    # distance over which that acts on separation.
    simulated = []
    closed: str | NDArray = adhesive.SEPARATION
    pixel = max(side / n for side, n in zip(sides, heights.shape, strict=True))
    for ratio in ENERGY_RATIOS:
        adhesion_length = ratio * energy
        law = Exponential(adhesion_length, np.sqrt(pixel * adhesion_length / COARSEST))
        states = list(_adhere(heights, sides, law, solid, starts=(closed, adhesive.APPROACH)))
        if not states:
            continue
        counted += [_count_gaps(state.elastic_energy, state.gap, h_rms) for state in states]
        deepest = min(states, key=lambda state: state.energy)
        share = max(-deepest.energy, 0.0) / adhesion_length
        if share < HARDLY_ANYTHING:
            simulated.append((adhesion_length, law.range, share, h_rms))
            break
        tension = _pull_off(heights, sides, deepest, share, solid) if pull else np.nan
        simulated.append((adhesion_length, law.range, share, adhesion_length * share / tension))
        closed = states[0].gap
    if not simulated:
        raise ConvergenceError("no state of contact with adhesion converged", None)
    lengths, ranges, shares, distances = np.array(simulated[::-1]).T
    return TrialStates(
        elastic_energy=np.array([state.elastic_energy for state in counted]),
        gap_share=np.array([state.gap_share for state in counted]),
        gap=np.array([state.gap for state in counted]),
        has_adhesion=np.arange(len(counted)) > CONTACT_AREAS.size,
        full_contact_energy=energy,
        simulated_length=lengths,
        simulated_range=ranges,
        simulated_share=shares,
        simulated_distance=distances,
    )


def _pull_off(
    heights: NDArray,
    sides: tuple[float, float],
    state: adhesive.Adhesion,
    share: float,
    solid: Solid,
) -> float:
    """Largest mean tension [E*] that a state of zero load withstands, within some 5 %."""

    def pull(tension: float, start: adhesive.Adhesion) -> adhesive.Adhesion | None:
        """State under a tension; None if that tears the surfaces apart."""
        states = _adhere(heights, sides, state.law, solid, (start,), pressure=-tension)
        return next(states, None)

    # Halve a tension until the surfaces withstand it, and then raise it in steps, each half as
    # large as the one before that they did not withstand.
    tension = state.law.adhesion_length * share / state.rms_height
    held = pull(tension, state)
    while held is None and tension > 0:
        tension /= 2
        held = pull(tension, state)
    step = 2.0
    while step > LAST_STEP:
        further = pull(tension * step, held)
        if further is None:
            step = np.sqrt(step)
        else:
            tension *= step
            held = further
    return tension * np.sqrt(step)


class _CountedState(NamedTuple):
    """A state of contact by its energy and its gaps."""

    elastic_energy: float  #: [length]
    gap_share: NDArray  #: of the nominal area, ``(bin,)``
    gap: NDArray  #: mean of every bin [length], ``(bin,)``


def _count_gaps(elastic_energy: float, gap: NDArray, h_rms: float) -> _CountedState:
    """Count the gaps of a state in `GAP_BINS`."""
    index = np.searchsorted(GAP_BINS, gap.ravel() / h_rms)
    counts = np.bincount(index, minlength=GAP_BINS.size + 1)
    sums = np.bincount(index, weights=gap.ravel(), minlength=GAP_BINS.size + 1)
    return _CountedState(elastic_energy, counts / gap.size, sums / np.maximum(counts, 1))


def _press(
    heights: NDArray, sides: tuple[float, float], solid: Solid, h_rms: float
) -> Iterator[_CountedState]:
    """States of contact without adhesion."""
    slope = measure_slope(heights, sides)
    # By theory a share erf(sqrt(2) p/(E* slope)) of the area touches.
    loads = slope * erfinv(CONTACT_AREAS) / np.sqrt(2)
    contacts = repulsive.load_path(heights, sides, loads, tol=CONTACT_TOLERANCE, solid=solid)
    for contact in contacts:
        displacement = contact.gap + heights - contact.shift
        elastic_energy = float(np.mean(contact.pressure * displacement)) / 2
        yield _count_gaps(elastic_energy, contact.gap, h_rms)


def _adhere(
    heights: NDArray,
    sides: tuple[float, float],
    law: Exponential,
    solid: Solid,
    starts: tuple[str | NDArray | adhesive.Adhesion, ...],
    pressure: float = 0.0,
) -> Iterator[adhesive.Adhesion]:
    """States of contact at a load, from several starts, but for those that do not converge."""
    for start in starts:
        try:
            with warnings.catch_warnings():
                # The grid hardly resolves the edges: the range is as short as it can be.
                warnings.simplefilter("ignore", PlausibilityWarning)
                yield adhesive.solve(
                    heights,
                    sides,
                    law,
                    pressure=pressure,
                    start=start,
                    tol=ADHESION_TOLERANCE,
                    solid=solid,
                )
        except ConvergenceError as error:
            logging.info("adhesion length %.3g: %s", law.adhesion_length, error)
