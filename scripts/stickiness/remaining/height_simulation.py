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
from scipy import fft
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
FEWEST_POINTS = 32  #: along the shorter side
PIXELS_RESOLVED = 4  #: in the shortest wave that an instrument resolves, unless it says otherwise
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
    cutoff: float = np.inf,
    most_points: int = MOST_POINTS,
) -> SimulatedHeights:
    """Simulate contact on levelled heights, which are made periodic.

    Large maps are thinned to every second, third … point. That keeps the distribution of the
    heights and the flat tops, which a filter would cover with ripples.

    Parameters
    ----------
    heights : (nx, ny) array
        Levelled heights [length].
    sides : pair of floats
        Sides of the map [length].
    cutoff : float
        Highest wave number that the heights resolve [1/length]. Waves beyond it are filtered out
        only where it is below that of four pixels: there they are noise or blur.
    most_points : int
        Points of the grid along the longer side, at most.

    Raises
    ------
    ConvergenceError
        If no state with adhesion converges.
    ValueError
        If the map has fewer than `FEWEST_POINTS` along a side.
    """
    heights = np.asarray(heights, dtype=float)
    if min(heights.shape) < FEWEST_POINTS:
        raise ValueError(
            f"heights must have {FEWEST_POINTS} points along each side, got {heights.shape}"
        )
    steps = tuple(side / n for side, n in zip(sides, heights.shape, strict=True))
    # Thin the longer side to as many points, but leave enough of them across a narrow strip.
    stride = -(-max(heights.shape) // most_points)
    stride = min(stride, min(heights.shape) // FEWEST_POINTS)
    is_noisy = cutoff < 2 * np.pi / (PIXELS_RESOLVED * max(steps)) * (1 - _ROUNDING)

    def prepare(part: NDArray) -> NDArray:
        """A part, periodic, on a grid whose halves the solvers can thin again."""
        counts = tuple(n // (4 * stride) * (4 * stride) for n in part.shape)
        level = periodic.periodise(part[: counts[0], : counts[1]], "smooth")
        return _filter_waves(level, steps, cutoff) if is_noisy else level

    def simulate(part: NDArray, pull: bool = False) -> TrialStates:
        level = prepare(part)
        # Lengths over the first side of the whole; heights of one size for every surface, rounded:
        # last bits do not matter.
        unit = sides[0]
        part_sides = tuple(n * step / unit for n, step in zip(level.shape, steps, strict=True))
        thinned = level[::stride, ::stride]
        height_unit = float(np.std(thinned)) / STANDARD_HEIGHT
        standard = np.round((thinned - thinned.mean()) / height_unit, DECIMALS)
        states = find_trial_states(standard, part_sides, pull=pull)
        return states.scaled(height_unit=height_unit, length_unit=unit)

    half_x, half_y = (n // 2 for n in heights.shape)
    quarters = [
        simulate(heights[along_x, along_y])
        for along_x in (slice(None, half_x), slice(half_x, None))
        for along_y in (slice(None, half_y), slice(half_y, None))
    ]
    whole = prepare(heights)
    resolved = _filter_waves(whole, steps, cutoff)
    whole_sides = tuple(n * step for n, step in zip(whole.shape, steps, strict=True))
    return SimulatedHeights(
        whole=simulate(heights, pull=True),
        quarters=tuple(quarters),
        resolved_energy=full_contact_energy(resolved, 1.0, whole_sides, edges="given"),
        pixel=stride * max(steps),
    )


def _filter_waves(heights: NDArray, steps: tuple[float, float], cutoff: float) -> NDArray:
    """Periodic heights without waves beyond a wave number."""
    qx, qy = (
        2 * np.pi * fft.fftfreq(n, step) for n, step in zip(heights.shape, steps, strict=True)
    )
    modes = fft.fft2(heights)
    modes[np.hypot(qx[:, None], qy) > cutoff * (1 + _ROUNDING)] = 0.0
    return fft.ifft2(modes).real


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
    # Surfaces that touch at the summit, and contact without adhesion up to full contact.
    counted = [_count_gaps(0.0, heights.max() - heights, h_rms)]
    counted += _press(heights, sides, solid, h_rms)
    energy = full_contact_energy(heights, 1.0, sides, solid, edges="given")
    counted.append(_count_gaps(energy, np.zeros(heights.shape), h_rms))
    without_adhesion = len(counted)

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
        has_adhesion=np.arange(len(counted)) >= without_adhesion,
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
    withstood = pull(tension, state)
    while withstood is None and tension > 0:
        tension /= 2
        withstood = pull(tension, state)
    step = 2.0
    while step > LAST_STEP:
        further = pull(tension * step, withstood)
        if further is None:
            step = np.sqrt(step)
        else:
            tension *= step
            withstood = further
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
