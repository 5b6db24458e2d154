"""Frictionless, non-adhesive contact of an elastic solid with a rough rigid surface.

Given heights ``h`` and a mean pressure, find the pressure ``p >= 0`` and the gap ``g >= 0`` with
``p g = 0`` where ``g = u + shift - h`` and ``u_q = 2 p_q / |q|``, or S times that for a layer
(`solids`; Polonsky and Keer, Wear 231:206, 1999, doi 10.1016/S0043-1648(99)00113-1; Stanley and
Kato, doi 10.1115/1.2833523).

`active_set` finds the contact set; coarser grids supply a first guess of the gap, which is smooth
enough to be interpolated. If the surface is not periodic, u is the displacement of a half-space
loaded on a rectangle, and coarser grids supply a guess of the pressure. There, and on layers,
`projected_gradients` takes over where active sets fail.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from stickiness.arguments import check_length, flag, grid, integer, number
from stickiness.plausibility import warn_of_heights, warn_of_pressure
from stickiness.repulsive import active_set, half_space, projected_gradients, sharing
from stickiness.solids import HALF_SPACE, Skin, Solid, check_solid

_MIN_COARSE_POINTS = 128  # points along the shorter side of the coarsest grid
# Relative change of load up to which the last solution is the better start.
_MAX_LOAD_CHANGE = 0.005
_MAX_TOLERANCE = 0.1  # of h_rms: beyond this no solution is worth the name
# Iterations with active sets on a layer or with free edges: either tens do, or more gain little.
_MAX_UNSURE_ITERATIONS = 150
# Tolerance on a coarser grid, over the rms step from point to point: a guess for the next grid
# needs no more. The limits are over h_rms; single precision gives the lower one.
_COARSE_TOLERANCE_OF_STEP = 0.05
_LEAST_COARSE_TOLERANCE = 1e-4
_LARGEST_COARSE_TOLERANCE = 3e-3


@dataclass(frozen=True, eq=False)
class Contact(active_set.State):
    """Solution of a repulsive contact problem.

    Attributes
    ----------
    pressure, gap : numpy.ndarray
        Contact pressure in units of E*, zero outside contact; gap in the unit of the heights, zero
        in contact and positive outside; ``(n0, n1)``.
    mean_pressure, mean_gap : float
        Prescribed mean pressure in units of E*, mean of `gap` over the surface.
    area_fraction : float
        Share of points with positive pressure.
    shift : float
        Rigid displacement in ``gap = u + shift - h``; unit of the heights. On a periodic surface u
        has no mean, and the approach of a layer's backing is ``solid.mean_compliance *
        mean_pressure - shift``. With free edges u vanishes far away: the plane h = 0 is ``-shift``
        below the surface of the undeformed half-space.
    residual : float
        Largest violation of the contact conditions, in units of h_rms: the maximum over the grid
        of ``|u + shift - h|`` in contact and of the penetration ``-(u + shift - h)`` outside it.
        Pressure is non-negative and balances the load to rounding, and is not part of it. For a
        flat punch with free edges the unit is the mean pressure [E*] times the first side.
    iterations : int
        Iterations of conjugate gradients on the given grid.
    fft_pairs : float
        Convolutions (a forward and a backward transform each) on all grids, those on
        coarser ones (also inside the preconditioner) counted by their share of the points of
        the given grid.
    length : tuple of float
        Sides of the periodic cell, or of the surface if its edges are free.
    rms_height : float
        Root mean square of the heights about their mean.
    approach : float
        With free edges, distance [unit of the heights] by which surface and far half-space have
        come closer since they touched. Not a number on a periodic surface, where it is infinite.
    """

    mean_pressure: float
    mean_gap: float
    length: tuple
    rms_height: float
    approach: float


class ConvergenceError(RuntimeError):
    """The contact conditions were not met to the tolerance.

    `contact` is the best iterate, `residual` its residual in units of h_rms; None and NaN where
    there is none.
    """

    def __init__(self, message: str, contact: Any):
        super().__init__(message)
        self.contact = contact
        self.residual = np.nan if contact is None else contact.residual


def solve(
    heights: ArrayLike,
    length: float | tuple[float, float],
    pressure: float,
    tol: float = 1e-8,
    start: Contact | None = None,
    max_iterations: int = 1000,
    solid: Solid = HALF_SPACE,
    periodic: bool = True,
    mirrored: bool = False,
    threads: int = 1,
) -> Contact:
    """Solve the contact of an elastic solid with a rigid surface at a mean pressure.

    Parameters
    ----------
    heights : array_like
        Heights ``(n0, n1)`` of the rigid surface (positive towards the half-space), any unit.
    length : float or tuple of float
        Side of the cell along axis 0 (pixels are then square), or both sides; same unit.
    pressure : float
        Mean pressure in units of E*. At zero the surfaces touch at the summit, without contact.
    tol : float
        Largest accepted `Contact.residual`, relative to h_rms; at most 0.1.
    start : Contact, optional
        Solution on the same grid at nearly the same load. It saves a quarter of the work if the
        load changes by 0.1 %, and costs more than it saves beyond 1 %.
    max_iterations : int
        Largest number of iterations on the given grid.
    solid : solids.HalfSpace, solids.Layer or solids.Skin, optional
        Elastic solid, a half-space by default; the thickness of a layer is in the unit of `length`.
    periodic : bool
        Whether surface and pressure repeat. If not, the surface is a rigid body with free edges,
        pressed into an unbounded half-space; each height is that of a pixel. The total force is
        `pressure` times the area within `length`. It needs a half-space as `solid`, and
        takes up to five times as long as a periodic surface.
    mirrored : bool
        Whether a periodic surface goes on as its mirror image at every side, instead of repeating
        as it is. It takes a quarter of the work of heights with their images.
    threads : int
        Threads that share the work on grids from 400 by 400 points on, at least 1. The solution
        is the same, bit by bit, for any number. Many solutions at once, each on one thread, are the
        better use of many cores.

    Returns
    -------
    Contact
        Pressure, gap and the numbers that follow from them.

    Raises
    ------
    ValueError
        If an argument is malformed or out of range; the message names it.
    ConvergenceError
        If `max_iterations` do not suffice; it carries the best iterate.

    Warns
    -----
    PlausibilityWarning
        If heights and length can hardly be in the same unit, or the pressure is far above the one
        that flattens the surface.

    Examples
    --------
    >>> import numpy as np
    >>> x = np.arange(32) / 32
    >>> wave = 0.01 * np.cos(2 * np.pi * x)[:, None] * np.ones(32)
    >>> solve(wave, length=1.0, pressure=0.1).area_fraction  # beyond pi * 0.01: full contact
    1.0
    >>> punch = solve(np.zeros((128, 128)), length=1.0, pressure=0.01, periodic=False)
    >>> print(f"{punch.mean_pressure / punch.approach:.2f}")  # fine pixels: 1.152
    1.15
    """
    heights = grid("heights", heights)
    lengths = check_length(length, heights.shape)
    pressure = number("pressure", pressure, zero=True)
    tol = number("tol", tol, most=_MAX_TOLERANCE)
    max_iterations = integer("max_iterations", max_iterations, least=1)
    threads = integer("threads", threads, least=1)
    if not (start is None or isinstance(start, Contact)):
        raise ValueError(f"start must be a Contact of the same grid, got {type(start).__name__}")
    if start is not None and start.pressure.shape != heights.shape:
        raise ValueError(
            f"start has the shape {start.pressure.shape}, the heights {heights.shape}: "
            "pass a solution on the same grid"
        )
    solid = check_solid(solid)
    periodic = flag("periodic", periodic)
    mirrored = flag("mirrored", mirrored)
    if not periodic and solid != HALF_SPACE:
        raise ValueError(
            f"periodic=False is for a half-space only, got solid={solid!r}; leave out one of them"
        )
    if mirrored and not periodic:
        raise ValueError("mirrored=True is for a periodic surface, got periodic=False")
    if pressure > 1:
        # a thin layer takes that much more pressure
        stiffening = 1 / solid.factor(2 * np.pi / max(lengths))
        slope = half_space.measure_slope(heights, lengths, mirrored)
        warn_of_pressure(pressure, slope * stiffening)
    with sharing.threads(threads):
        mean, rms = half_space.measure_scale(heights)
        warn_of_heights(rms, lengths[0])
        problem = active_set.Problem(
            heights=heights,
            sides=lengths,
            load=pressure,
            solid=solid,
            periodic=periodic,
            mirrored=mirrored,
        )
        return press(problem, tol, start, max_iterations, scale=(mean, rms))


def press(problem, tol, start=None, limit=1000, scale=None):
    """Solve as `solve` does, a problem that was checked, in any unit: nothing is warned of.

    `scale`: what `half_space.measure_scale` returns, if it is known.
    """
    heights = problem.heights
    mean, rms = scale or half_space.measure_scale(heights)
    if problem.load == 0 or (rms == 0 and problem.periodic):
        state = _state_at_once(problem, rms)
    else:
        unit = rms if rms > 0 else problem.load * problem.sides[0]  # a flat punch only sinks in
        guess = {"pressure": start.pressure} if start is not None and start.area_fraction else None
        state = _relax_in_unit(problem, guess, tol, limit, mean, unit)
    contact = Contact(
        pressure=state.pressure,
        gap=state.gap,
        shift=state.shift,
        area_fraction=state.area_fraction,
        residual=state.residual,
        iterations=state.iterations,
        fft_pairs=state.fft_pairs,
        mean_pressure=problem.load,
        mean_gap=float(state.gap.mean()),
        length=problem.sides,
        rms_height=rms,
        approach=np.nan if problem.periodic else float(heights.max()) - state.shift,
    )
    if not state.residual <= tol:
        raise ConvergenceError(
            f"residual {state.residual:.2e} h_rms after {state.iterations} iterations exceeds tol "
            f"= {tol:.2e}: raise max_iterations, or tol if it is near rounding",
            contact,
        )
    return contact


def _state_at_once(problem, rms):
    """State that needs no iteration: no contact without load, and full contact of a flat."""
    heights = problem.heights
    top = float(heights.max() if rms > 0 else heights.flat[0])
    return active_set.State(
        pressure=np.full(heights.shape, problem.load),
        gap=top - heights if rms > 0 else np.zeros(heights.shape),
        shift=top,
        area_fraction=float(problem.load > 0),
        residual=0.0,
        iterations=0,
        fft_pairs=0.0,
    )


def _relax_in_unit(problem, guess, tol, limit, mean, unit):
    """Solve with heights about their mean in a unit and lengths in the first side; state as is."""
    side = problem.sides[0]
    scaled = np.empty(problem.heights.shape)
    sharing.evaluate(lambda h: (h - mean) / unit, scaled.ravel(), problem.heights.ravel())
    scaled_problem = replace(
        problem,
        heights=scaled,
        sides=(1.0, problem.sides[1] / side),
        load=problem.load * (side / unit),
        solid=problem.solid.in_unit(side),
    )
    state = _relax(scaled_problem, guess, tol, limit)
    # Nothing else refers to these fields: they may be large, and are scaled in place.
    pressure = np.asarray(state.pressure, dtype=float)
    pressure *= unit / side
    gap = np.asarray(state.gap, dtype=float)
    gap *= unit
    return replace(state, pressure=pressure, gap=gap, shift=state.shift * unit + mean)


def load_path(
    heights: ArrayLike,
    length: float | tuple[float, float],
    pressures: Iterable[float],
    tol: float = 1e-8,
    **options: Any,
) -> Iterator[Contact]:
    """Solve one surface at several mean pressures, in the order given.

    A solution at nearly the same pressure is the start of the next; beyond a relative change of
    0.5 % coarser grids predict the contact better.

    Parameters
    ----------
    heights, length, tol
        As for `solve`.
    pressures : iterable of float
        Mean pressures in units of E*.
    **options
        Further arguments of `solve`, except `start`.

    Yields
    ------
    Contact
        One for each pressure.

    Examples
    --------
    >>> import numpy as np
    >>> wave = 0.01 * np.cos(2 * np.pi * np.arange(64) / 64)[:, None] * np.ones(64)
    >>> for contact in load_path(wave, length=1.0, pressures=[0.01, 0.02]):
    ...     print(f"{contact.area_fraction:.2f}")
    0.39
    0.61
    """
    last = None
    for pressure in pressures:
        pressure = number("pressures", pressure, zero=True)
        loaded = last.mean_pressure if last else 0.0
        near = loaded and abs(pressure - loaded) < _MAX_LOAD_CHANGE * loaded
        last = solve(heights, length, pressure, tol=tol, start=last if near else None, **options)
        yield last


def _relax(problem, guess, tol, limit):
    """Solve a scaled problem by all methods, from a guess or, without one, from coarser grids."""
    work = []
    unsure = problem.solid != HALF_SPACE or not problem.periodic
    guess = guess or _guess_from_coarser_grids(problem, work)
    first_limit = min(limit, _MAX_UNSURE_ITERATIONS) if unsure else limit
    state = active_set.relax(problem, guess, tol=tol, max_iterations=first_limit)
    iterations = state.iterations
    pairs = state.fft_pairs
    if unsure and not state.residual <= tol and iterations < limit:
        if isinstance(problem.solid, Skin):
            gap = np.asarray(state.gap, dtype=float)
            state = projected_gradients.relax_gap(problem, gap, tol, limit - iterations)
        else:
            pressure = np.asarray(state.pressure, dtype=float)
            state = projected_gradients.relax(problem, pressure, tol, limit - iterations)
        iterations += state.iterations
        pairs += state.fft_pairs
    pairs += sum(work) / problem.heights.size
    return replace(state, iterations=iterations, fft_pairs=pairs)


def _guess_from_coarser_grids(problem, work):
    """First guess of the gap or, with free edges, of the pressure; empty for a small grid.

    `work` gets the convolutions on every coarser grid, times its points.
    """
    shape = problem.heights.shape
    if min(shape) < 2 * _MIN_COARSE_POINTS:
        return {}
    repeats = problem.periodic and not problem.mirrored
    if repeats:
        coarse_shape = tuple(half_space.coarsen(n) for n in shape)
        heights = half_space.sample(problem.heights, coarse_shape)
        sides = problem.sides
    else:
        heights = half_space.average_pixels(problem.heights)
        # Of an odd number of pixels the last one extends beyond the rectangle.
        sides = tuple(
            side * 2 * m / n for side, m, n in zip(problem.sides, heights.shape, shape, strict=True)
        )
    coarse = replace(problem, heights=heights, sides=sides)
    guess = _guess_from_coarser_grids(coarse, work)
    step = half_space.measure_slope(heights, heights.shape)
    tol = np.clip(
        _COARSE_TOLERANCE_OF_STEP * step, _LEAST_COARSE_TOLERANCE, _LARGEST_COARSE_TOLERANCE
    )
    state = active_set.relax(coarse, guess, tol=tol, max_iterations=200, approximate=True)
    work.append(state.fft_pairs * heights.size)
    if repeats:
        return {"gap": half_space.interpolate(state.gap, shape)}
    fine = state.pressure.repeat(2, axis=0).repeat(2, axis=1)
    return {"pressure": np.ascontiguousarray(fine[: shape[0], : shape[1]])}
