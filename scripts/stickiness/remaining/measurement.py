"""Adhesion that remains on a rough surface, simulated: approach, squeeze and separation.

The surfaces approach at a given mean gap from afar until they press with the squeeze, and part
again. The work that the attraction does on the way in, from afar to zero load, and the work that it
takes to part them, from zero load on, are integrals of the mean tension over the mean gap. A jump
at a given gap loses energy: approach then gains less, and separation costs more, than the energy of
the state at zero load.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from stickiness.adhesive import edge_zone
from stickiness.adhesive.path import PathPoint, path
from stickiness.adhesive.solver import SEPARATION
from stickiness.arguments import check_length, grid, number
from stickiness.plausibility import PlausibilityWarning
from stickiness.repulsive.solver import ConvergenceError
from stickiness.solids import HALF_SPACE, Solid, check_solid
from stickiness.traction_laws import TractionLaw, check_law

STEPS = 80  #: of the path between far and close, at least
# Relative errors that steps leave, times the number of steps. Of six paths at 80, 40 and 20 steps,
# against 160, at most 0.5, 2.2 and 5.6 % of a work, 3, 10 and 26 % of a pull-off. The last are of
# contact edges as sharp as a grid resolves; pull-off is a single state on the way.
STEPS_ERRORS = {"approach": 0.8, "separation": 0.8, "bound": 0.08, "pull_off": 4.0}
#: Pixels in the width of the cohesive zone; with fewer the result depends on the grid.
RESOLVED = 2.0


@dataclass(frozen=True, eq=False)
class Remaining:
    """What remains of the work of adhesion on a rough surface, by simulation.

    Works are per nominal area over the work of adhesion, ``approach <= bound <= separation``: equal
    without jumps. Limits (low, high) hold the change from a grid of every second point and the
    error of the steps; NaN if that grid was not solved.
    """

    approach: float  #: work at given mean gaps from afar to zero load
    separation: float  #: the same from zero load after the squeeze to parting
    bound: float  #: largest gain of energy on the path: attraction less elastic energy
    pull_off: float  #: largest mean tension on separation at given mean gaps [E*]
    area_at_zero_load: float  #: share of points in contact on approach; NaN without attraction
    gap_at_zero_load: float  #: mean gap [length] on approach; NaN without attraction
    #: Width of the cohesive zone, adhesion_length/strength^2; below two, points snap one by one.
    pixels_in_zone: float
    jumps: int  #: on the path under tension, of more than the error of the energy balance
    gap: NDArray  #: mean gaps of the curve [length]
    pressure: NDArray  #: mean pressures of the curve [E*]
    separating: NDArray  #: whether a point of the curve is on the way back
    fft_pairs: float  #: convolutions that it took
    points: tuple[PathPoint, ...]  #: states of the curve with their fields
    approach_limits: tuple[float, float] = (np.nan, np.nan)
    separation_limits: tuple[float, float] = (np.nan, np.nan)
    bound_limits: tuple[float, float] = (np.nan, np.nan)
    pull_off_limits: tuple[float, float] = (np.nan, np.nan)


def measure(
    heights: ArrayLike,
    length: float | tuple[float, float],
    law: TractionLaw,
    squeeze: float,
    tol: float = 1e-4,
    half_grid: bool = True,
    solid: Solid = HALF_SPACE,
    steps: int = STEPS,
) -> Remaining:
    """Measure what remains of adhesion on given heights.

    Parameters
    ----------
    heights : (n0, n1) array
        Periodic heights of the rigid surface [length]. Of flat ones everything remains.
    length : float or pair of floats
        Sides of the cell [length].
    law : TractionLaw
        Attraction, such as `adhesive.Exponential(adhesion_length, range)`. Pixels should be at
        most half the width of the cohesive zone, adhesion_length/strength^2.
    squeeze : float
        Mean pressure [E*] that the surfaces are pressed with before they part, positive. If full
        contact is reached first, they part from there.
    tol : float
        Residual of every state, see `adhesive.solve`.
    half_grid : bool
        Whether to solve on every second point as well, for the limits.
    solid : solids.HalfSpace, solids.Layer or solids.Skin
        Elastic solid; the thickness of a layer is in the unit of `length`. Works at given mean
        gaps exclude the mean compression of a layer, which stores and returns its energy.
    steps : int
        Of the path between far and close, at least; more at jumps. 80 leave 1 % in works and 3 %
        in the pull-off, 20 leave 6 and 26 % in a quarter of the time.

    Raises
    ------
    ConvergenceError
        If a state does not converge.

    Warns
    -----
    PlausibilityWarning
        If the cohesive zone is narrower than two pixels: separation then costs too much, because
        points of the grid snap one by one.
    """
    heights = grid("heights", heights)
    squeeze = number("squeeze", squeeze)
    number("steps", steps)
    check_law(law)
    pixel = check_length(length, heights.shape)[0] / heights.shape[0]
    resolution = edge_zone.resolution(pixel, law.maugis_range, law.adhesion_length)
    if np.ptp(heights) == 0:
        return _part_flat(law, 1 / resolution)
    if resolution > 2:
        raise ValueError(
            f"a pixel of {pixel:.3g} is {resolution:.2g} times the width of the cohesive zone, "
            "adhesion_length/strength^2: points would snap one by one. Take pixels of at most "
            f"{edge_zone.COARSEST * pixel / resolution:.3g} or a longer range"
        )
    if resolution * RESOLVED > 1.001:
        warnings.warn(
            f"{1 / resolution:.2g} pixels in the width of the cohesive zone are fewer than "
            f"{RESOLVED:g}: separation costs too much",
            PlausibilityWarning,
            stacklevel=2,
        )
    settings = {"tol": tol, "solid": check_solid(solid), "steps": steps}
    fine = _follow(heights, length, law, squeeze, settings, 1 / resolution)
    if not half_grid:
        return fine
    with warnings.catch_warnings():
        # The half grid is coarse on purpose: what that changes is the error.
        warnings.simplefilter("ignore", PlausibilityWarning)
        coarse = _follow(heights[::2, ::2], length, law, squeeze, settings)
    limits = {}
    for name, steps_error in STEPS_ERRORS.items():
        on_fine = getattr(fine, name)
        # The change from half the grid, more than what this one still lacks, and the steps.
        error = np.hypot(on_fine - getattr(coarse, name), steps_error / steps * on_fine)
        limits[f"{name}_limits"] = (max(on_fine - error, 0.0), on_fine + error)
    return replace(fine, **limits)


def _part_flat(law: TractionLaw, pixels_in_zone: float) -> Remaining:
    """Flat surfaces, which gain the work of adhesion at a gap of zero and part at the strength."""
    return Remaining(
        approach=1.0,
        separation=1.0,
        bound=1.0,
        pull_off=law.strength,
        area_at_zero_load=1.0,
        gap_at_zero_load=0.0,
        pixels_in_zone=pixels_in_zone,
        jumps=0,
        gap=np.empty(0),
        pressure=np.empty(0),
        separating=np.empty(0, dtype=bool),
        fft_pairs=0.0,
        points=(),
        approach_limits=(1.0, 1.0),
        separation_limits=(1.0, 1.0),
        bound_limits=(1.0, 1.0),
        pull_off_limits=(law.strength, law.strength),
    )


def _follow(heights, length, law, squeeze, options, pixels_in_zone=np.nan):
    """Approach, squeeze and part once; limits are NaN."""
    farthest = float(heights.max() - heights.mean()) + 4 * law.range
    # Error of a step's energy balance over the energies of the path, down to which jumps are
    # located.
    balance = 0.24 / options["steps"]
    settings = options | {
        "control": "mean_gap",
        "balance": balance,
        "smallest_jump": balance,
        "located": 0.4 / options["steps"],  # to about a quarter of a step
        "balanced_below": 0.0,  # no work is counted where the surfaces press
        "max_states": 2000,  # more only where points of the grid snap one by one
    }

    # Approach until the squeeze is reached.
    closest = 0.0 if law.hard_wall else -0.2 * law.range
    approach = []
    for point in path(heights, length, law, (farthest, closest), **settings):
        approach.append(point)
        if point.state.mean_pressure >= squeeze:
            break

    separation = _part(heights, length, law, approach[-1].state, farthest, settings)
    points = (*approach, *separation)
    gap = np.array([point.state.mean_gap for point in points])
    pressure = np.array([point.state.mean_pressure for point in points])
    jumped = np.array([point.event is not None for point in points])
    # Beyond both ends of the path the tension does as much work as there is energy left.
    way_in = slice(len(approach))
    way_out = slice(len(approach), None)
    work_in = _work(gap[way_in], pressure[way_in], jumped[way_in]) - approach[0].state.energy
    work_out = _work(gap[way_out], pressure[way_out], jumped[way_out]) - separation[-1].state.energy
    gained = _gain(approach)
    spent = _gain(separation)
    area_at_zero_load, gap_at_zero_load = _at_zero_load([point.state for point in approach])
    return Remaining(
        # A jump can only lose energy: where integrals say otherwise they are less exact than it.
        approach=min(work_in, gained) / law.adhesion_length,
        separation=max(work_out, gained, spent) / law.adhesion_length,
        bound=max(gained, spent) / law.adhesion_length,
        pull_off=max(-float(pressure[way_out].min()), 0.0),
        area_at_zero_load=area_at_zero_load,
        gap_at_zero_load=gap_at_zero_load,
        pixels_in_zone=pixels_in_zone,
        jumps=int(jumped.sum()),
        gap=gap,
        pressure=pressure,
        separating=np.arange(len(points)) >= len(approach),
        fft_pairs=sum(point.state.fft_pairs for point in points),
        points=points,
    )


def _part(heights, length, law, state, farthest, settings):
    """Part the surfaces from a state, at three times the farthest gap at the latest."""
    start = replace(state, branch=SEPARATION)
    mean_gaps = (start.mean_gap, farthest, 3 * farthest)
    separation = []
    for point in path(heights, length, law, mean_gaps, start=start, **settings):
        separation.append(point)
        if point.state.mean_gap >= farthest and not point.state.repulsive_area_fraction > 0:
            return separation
    raise ConvergenceError("the surfaces have not parted at the end of the path", point.state)


def _work(gap, pressure, jumped):
    """Integral of the tension over the gap one way [E* length], positive."""
    total = 0.0
    for start, end in pairwise([0, *np.flatnonzero(jumped), len(gap)]):
        if end - start > 1:
            total += _tension_over_gap(gap[start:end], pressure[start:end])
        if start > 0:  # across the jump before
            before = slice(start - 1, start + 1)
            total += abs(np.trapezoid(np.maximum(-pressure[before], 0), gap[before]))
    return float(total)


def _gain(points):
    """Largest gain of energy along one way [E* length]."""
    gains = [-point.state.energy for point in points]
    for point, after in pairwise(points):
        start = point.state
        end = after.state
        slope = (end.mean_pressure - start.mean_pressure) / (end.mean_gap - start.mean_gap)
        if after.event is None and start.mean_pressure * end.mean_pressure < 0 and slope < 0:
            # Up to zero load between them, along a straight line from either state. The lesser of
            # both holds where the first touch bends the line, too.
            ends = [state.mean_pressure**2 / (-2 * slope) - state.energy for state in (start, end)]
            gains.append(min(ends))
    return max(*gains, 0.0)


def _at_zero_load(states):
    """Area and mean gap where tension turns into pressure."""
    ends = np.array([(state.repulsive_area_fraction, state.mean_gap) for state in states])
    for i in reversed(range(len(states) - 1)):
        before = states[i].mean_pressure
        after = states[i + 1].mean_pressure
        if before < 0 <= after:
            area, gap = ends[i] - before / (after - before) * (ends[i + 1] - ends[i])
            return float(area), float(gap)
    # Full contact holds tension at a gap of zero, and is the state at zero load too.
    if states[-1].mean_pressure < 0:
        area, gap = ends[-1]
        return float(area), float(gap)
    return np.nan, np.nan


def _tension_over_gap(gap, pressure):
    """Integral along a stretch without jumps, between its states along a monotone cubic."""
    if gap[0] > gap[-1]:
        gap = gap[::-1]
        pressure = pressure[::-1]
    fine = np.linspace(gap[:-1], gap[1:], 50, endpoint=False).T.ravel()
    fine = np.append(fine, gap[-1])
    tension = np.maximum(-scipy.interpolate.PchipInterpolator(gap, pressure)(fine), 0)
    return np.trapezoid(tension, fine)
