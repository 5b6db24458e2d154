"""Frictionless, non-adhesive contact of an elastic solid with a rough rigid surface.

Given heights ``h`` and a mean pressure, find the pressure ``p >= 0`` and the gap ``g >= 0`` with
``p g = 0`` where ``g = u + shift - h`` and ``u_q = 2 p_q / |q|``, or S times that for a layer
(`solids`; Polonsky and Keer, Wear 231:206, 1999, doi 10.1016/S0043-1648(99)00113-1; Stanley and
Kato, doi 10.1115/1.2833523).

* For a guess of the contact set, preconditioned conjugate gradients solve ``g = 0`` there for the
  pressure (`preconditioner`). The number of iterations hardly depends on the grid.
* Points under tension are released and points that penetrate are added, until neither is left.
  While the set still changes, the inner solution is a rough one.
* Coarser grids supply a first guess of the gap, which is smooth enough to be interpolated. With the
  exact heights it gives a pressure. A point is put into contact where ``p > c k g``, k being the
  stiffness of a single pixel: this predicts the set to a per cent.
* Below a per cent of contact corrections involve only points that may touch (`dilute_contact`).
* Where this fails on a layer, `projected_gradients` takes over.

If the surface is not periodic, u is the displacement of a half-space loaded on a rectangle
(`free_edges`). The method is the same except that the stiffness is only approximate: coarser grids
supply a guess of the pressure, full contact is no special case, and `projected_gradients` takes
over if necessary.
"""

from dataclasses import dataclass, replace

import numpy as np

from stickiness.arguments import grid, integer, number
from stickiness.plausibility import warn_of_heights, warn_of_pressure
from stickiness.repulsive import active_set, free_edges, projected_gradients
from stickiness.repulsive.half_space import (
    check_length,
    coarsen,
    interpolate,
    measure_scale,
    measure_slope,
    sample,
)
from stickiness.solids import HALF_SPACE, check_solid

_MIN_COARSE_POINTS = 64  # points along the shorter side of the coarsest grid
# Relative change of load up to which the last solution is the better start.
_MAX_LOAD_CHANGE = 0.005
_MAX_TOLERANCE = 0.1  # of h_rms: beyond this no solution is worth the name
# Iterations with active sets on a layer or with free edges: either tens do, or more gain little.
_MAX_UNSURE_ITERATIONS = 150
_COARSE_TOLERANCE = 3e-3  # of h_rms: a guess for the next grid needs no more


@dataclass(frozen=True, eq=False)
class Contact:
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
        come closer since they touched, ``max(h) - shift``. Not a number on a periodic surface,
        where it is infinite.
    """

    pressure: np.ndarray
    gap: np.ndarray
    mean_pressure: float
    area_fraction: float
    mean_gap: float
    shift: float
    residual: float
    iterations: int
    fft_pairs: float
    length: tuple
    rms_height: float
    approach: float = np.nan


class ConvergenceError(RuntimeError):
    """The contact conditions were not met to the tolerance.

    `contact` is the best iterate, `residual` its residual in units of h_rms.
    """

    def __init__(self, message, contact):
        super().__init__(message)
        self.contact = contact
        self.residual = contact.residual


def solve(
    heights,
    length,
    pressure,
    tol=1e-8,
    start=None,
    max_iterations=1000,
    logger=None,
    solid=HALF_SPACE,
    periodic=True,
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
    logger : logging.Logger, optional
        Receives the progress at level INFO.
    solid : solids.HalfSpace or solids.Layer, optional
        Elastic solid, a half-space by default; the thickness of a layer is in the unit of `length`.
    periodic : bool
        Whether surface and pressure repeat. If not, the surface is a rigid body with free edges,
        pressed into an unbounded half-space; each height is that of a pixel. The total force is
        `pressure` times the area within `length`. This takes two to five times as long, and needs a
        half-space as `solid`.

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
    if not (start is None or isinstance(start, Contact)):
        raise ValueError(f"start must be a Contact of the same grid, got {type(start).__name__}")
    if start is not None and start.pressure.shape != heights.shape:
        raise ValueError(
            f"start has the shape {start.pressure.shape}, the heights {heights.shape}: "
            "pass a solution on the same grid"
        )
    solid = check_solid(solid)
    if not isinstance(periodic, bool | np.bool_):
        raise ValueError(f"periodic must be True or False, got {periodic!r}")
    if not periodic and solid != HALF_SPACE:
        raise ValueError(
            f"periodic=False is for a half-space only, got solid={solid!r}; leave out one of them"
        )
    scale = measure_scale(heights)
    warn_of_heights(scale[1], lengths[0])
    if pressure > 1:
        # a thin layer takes that much more pressure
        stiffening = 1 / solid.factor(2 * np.pi / max(lengths))
        warn_of_pressure(pressure, measure_slope(heights, lengths) * stiffening)
    effort = Effort(tol, max_iterations, logger)
    return press(heights, lengths, pressure, effort, start, solid, periodic, scale)


@dataclass(frozen=True)
class Effort:
    """When to stop, and the logger that is told the progress: see `solve`."""

    tol: float
    max_iterations: int = 1000
    logger: object = None


def press(
    heights, lengths, pressure, effort, start=None, solid=HALF_SPACE, periodic=True, scale=None
):
    """Solve as `solve` does, of arguments that were checked, in any unit: nothing is warned of.

    `scale` is `measure_scale(heights)`, if it is known.
    """
    mean, rms = scale or measure_scale(heights)
    if pressure == 0 or (rms == 0 and periodic):
        return _without_iterations(heights, lengths, pressure, rms, periodic)
    unit = rms if rms > 0 else pressure * lengths[0]  # a flat punch only sinks in
    scaled = heights - mean
    scaled /= unit
    problem = active_set.Problem(
        scaled,
        (1.0, lengths[1] / lengths[0]),
        pressure * (lengths[0] / unit),
        solid.in_unit(lengths[0]),
        bool(periodic),
    )
    guess = {"pressure": start.pressure} if start is not None and start.area_fraction > 0 else None
    state = _relax(problem, guess, effort)
    # Nothing else refers to these fields: they may be large, and are scaled in place.
    field, gap = (np.asarray(values, dtype=float) for values in (state.pressure, state.gap))
    field *= unit / lengths[0]
    gap *= unit
    shift = state.shift * unit + mean
    contact = Contact(
        pressure=field,
        gap=gap,
        mean_pressure=pressure,
        area_fraction=state.area_fraction,
        mean_gap=float(gap.mean()),
        shift=shift,
        residual=state.residual,
        iterations=state.iterations,
        fft_pairs=state.pairs,
        length=lengths,
        rms_height=rms,
        approach=np.nan if periodic else float(heights.max()) - shift,
    )
    if not state.residual <= effort.tol:
        raise ConvergenceError(
            f"residual {state.residual:.2e} h_rms after {state.iterations} iterations exceeds tol "
            f"= {effort.tol:.2e}: raise max_iterations, or tol if it is near rounding",
            contact,
        )
    return contact


def _relax(problem, guess, effort):
    """Solve a scaled problem from a guess or, without one, from coarser grids.

    Its iterations and convolutions are those of all methods, the latter on all grids.
    """
    work, logger, limit = [], effort.logger, effort.max_iterations
    unsure = problem.solid != HALF_SPACE or not problem.periodic
    if guess is None:
        guess = _guess_from_coarser_grids(problem, work, logger)
    first_limit = min(limit, _MAX_UNSURE_ITERATIONS) if unsure else limit
    state = active_set.relax(
        problem, tol=effort.tol, max_iterations=first_limit, logger=logger, **guess
    )
    iterations, pairs = state.iterations, state.pairs
    if unsure and not state.residual <= effort.tol and iterations < limit:
        pressure = np.asarray(state.pressure, dtype=float)
        left = limit - iterations
        state = projected_gradients.relax(
            problem, pressure, tol=effort.tol, max_iterations=left, logger=logger
        )
        iterations, pairs = iterations + state.iterations, pairs + state.pairs
    pairs += sum(work) / problem.heights.size
    return replace(state, iterations=iterations, pairs=pairs)


def load_path(heights, length, pressures, tol=1e-8, **options):
    """Solve one surface at several mean pressures; yields one `Contact` for each, in order.

    A solution at nearly the same pressure is the start of the next; beyond a relative change of 0.5
    % the coarser grids predict the contact set better, and every solution starts from those.

    Parameters
    ----------
    pressures : iterable of float
        Mean pressures in units of E*.
    heights, length, tol, **options
        As for `solve`, which also takes `start`.
    """
    last = None
    for pressure in pressures:
        near = last is not None and (
            abs(pressure - last.mean_pressure) < _MAX_LOAD_CHANGE * last.mean_pressure
        )
        start = last if near else None
        last = solve(heights, length, pressure, tol=tol, start=start, **options)
        yield last


def _guess_from_coarser_grids(problem, work, logger):
    """First guess of the gap or, with free edges, of the pressure; empty for a small grid.

    It is found in single precision. `work` gets the convolutions on every coarser grid, times its
    points.
    """
    shape = problem.heights.shape
    if min(shape) < 2 * _MIN_COARSE_POINTS:
        return {}
    if problem.periodic:
        heights, sides = sample(problem.heights, tuple(coarsen(n) for n in shape)), problem.sides
    else:
        heights = free_edges.coarsen_heights(problem.heights)
        sides = tuple(
            a * 2 * m / n for a, m, n in zip(problem.sides, heights.shape, shape, strict=True)
        )
    coarse = replace(problem, heights=heights, sides=sides)
    guess = _guess_from_coarser_grids(coarse, work, logger)
    state = active_set.relax(
        coarse, tol=_COARSE_TOLERANCE, max_iterations=200, rough=True, logger=logger, **guess
    )
    work.append(state.pairs * heights.size)
    if problem.periodic:
        return {"gap": interpolate(state.gap, shape)}
    return {"pressure": free_edges.refine_pressure(state.pressure, shape)}


def _without_iterations(heights, lengths, pressure, rms, periodic):
    """Contact of a flat, which is in full contact, or of any surface that carries no load."""
    top = float(heights.max() if rms > 0 else heights.flat[0])
    gap = top - heights if rms > 0 else np.zeros(heights.shape)
    return Contact(
        pressure=np.full(heights.shape, pressure),
        gap=gap,
        mean_pressure=pressure,
        area_fraction=1.0 if pressure > 0 else 0.0,
        mean_gap=float(gap.mean()),
        shift=top,
        residual=0.0,
        iterations=0,
        fft_pairs=0.0,
        length=lengths,
        rms_height=rms,
        approach=np.nan if periodic else 0.0,
    )
