"""Frictionless, non-adhesive contact of a periodic half-space with a rough rigid surface.

Given heights ``h`` and a mean pressure, find the pressure ``p >= 0`` and the gap ``g >= 0`` with
``p g = 0`` where ``g = u + shift - h`` and ``u_q = 2 p_q / |q|`` (Polonsky and Keer, Wear 231:206,
1999, doi 10.1016/S0043-1648(99)00113-1; Stanley and Kato, doi 10.1115/1.2833523).

The method is an active-set one:

* For a guess of the contact set, conjugate gradients solve ``g = 0`` there for the pressure. They
  are preconditioned with the stiffness ``|q| / 2``, the exact inverse of the compliance in full
  contact, between an extension of the residual beyond the edge of contact and the transpose of
  that extension. The number of iterations hardly depends on the grid. Up to a contact of 30 %
  a grid half as fine carries the stiffness of long waves and a constant that of short ones.
* Points under tension are released, points that penetrate are added, and so on. Early on the
  inner solution is a rough one, for a wrong set deserves no better.
* Coarser grids supply a first guess of the gap, which is smooth enough to be interpolated. On
  top of the exact heights it gives a pressure, and a point is put into contact where
  ``p > c k g`` with the stiffness ``k`` of a single pixel: this predicts the set to a per cent.

Everything is solved in units of one side of the cell, ``h_rms`` and E*.
"""

from dataclasses import dataclass

import numpy as np

from stickiness.contact import active_set
from stickiness.core.arguments import grid, integer, number, positive

__all__ = ["Contact", "ConvergenceError", "load_path", "solve"]

_COARSEST = 64  # points along the shorter side of the coarsest grid
_NEAR = 0.005  # relative change of load up to which the last solution is the better start
_LOOSEST = 0.1  # of h_rms: beyond this no solution is worth the name
_COARSE_TOLERANCE = 3e-3  # of h_rms: a guess for the next grid needs no more


@dataclass(frozen=True, eq=False)
class Contact:
    """Solution of a repulsive contact problem.

    Attributes
    ----------
    pressure : numpy.ndarray
        Contact pressure in units of E*, zero outside contact, ``(n0, n1)``.
    gap : numpy.ndarray
        Gap in the unit of the heights; zero in contact, positive outside.
    mean_pressure : float
        Prescribed mean pressure in units of E*.
    area_fraction : float
        Share of points with positive pressure.
    mean_gap : float
        Mean of `gap`, unit of the heights.
    shift : float
        Rigid displacement in ``gap = u + shift - h``, with u of zero mean; unit of the heights.
    residual : float
        Largest violation of the contact conditions, in units of h_rms: the maximum over the grid
        of ``|u + shift - h|`` in contact and of the penetration ``-(u + shift - h)`` outside it.
        Pressure is non-negative and balances the load to rounding, and is not part of it.
    iterations : int
        Iterations of conjugate gradients on the given grid.
    fft_pairs : float
        Convolutions (a forward and a backward transform each) on all grids, those on
        coarser ones (also inside the preconditioner) counted by their share of the points of
        the given grid.
    length : tuple of float
        Sides of the periodic cell.
    rms_height : float
        Root mean square of the heights about their mean.
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


class ConvergenceError(RuntimeError):
    """The contact conditions were not met to the tolerance.

    Attributes
    ----------
    contact : Contact
        Best iterate.
    residual : float
        Its residual, in units of h_rms.
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
    precision="double",
    logger=None,
):
    """Solve the contact of a half-space with a rigid periodic surface at a mean pressure.

    Parameters
    ----------
    heights : array_like
        Heights ``(n0, n1)`` of the rigid surface (positive towards the half-space), any unit.
    length : float or tuple of float
        Side of the cell along axis 0 (pixels are then square), or both sides; same unit as the
        heights.
    pressure : float
        Mean pressure in units of E*. Zero stands for touching at the summit, without contact.
    tol : float
        Largest accepted `Contact.residual`, relative to h_rms; at most 0.1.
    start : Contact, optional
        Solution on the same grid at nearly the same load; it saves a quarter of the work at a
        change of 0.1 % and costs more than it saves beyond 1 %.
    max_iterations : int
        Largest number of iterations on the given grid.
    precision : {"double", "single"}
        Of the last iterations. Single precision reaches a `tol` of about 1e-4 and saves next to
        nothing: all iterations but the last ones are in single precision anyway.
    logger : logging.Logger, optional
        Told the progress at level INFO.

    Returns
    -------
    Contact
        Pressure, gap and how well they meet the contact conditions.

    Raises
    ------
    ValueError
        If an argument is not what it should be.
    ConvergenceError
        If `max_iterations` do not suffice; it carries the best iterate.

    Examples
    --------
    >>> import numpy as np
    >>> x = np.arange(32) / 32
    >>> wave = 0.01 * np.cos(2 * np.pi * x)[:, None] * np.ones(32)
    >>> solve(wave, length=1.0, pressure=0.1).area_fraction  # beyond pi * 0.01: full contact
    1.0
    """
    heights = grid("heights", heights)
    lengths = _check_length(length, heights.shape)
    pressure = number("pressure", pressure, zero=True)
    tol = number("tol", tol, most=_LOOSEST)
    max_iterations = integer("max_iterations", max_iterations, least=1)
    if not (start is None or isinstance(start, Contact)):
        raise ValueError(f"start must be a Contact of the same grid, got {type(start).__name__}")
    if start is not None and start.pressure.shape != heights.shape:
        raise ValueError(
            f"start has the shape {start.pressure.shape}, the heights {heights.shape}: "
            "pass a solution on the same grid"
        )
    if precision not in ("double", "single"):
        raise ValueError(f"precision must be 'double' or 'single', got {precision!r}")
    mean, rms = _scale(heights)
    if rms == 0:
        return _flat(heights, lengths, pressure)
    if pressure == 0:
        return _touching(heights, lengths, rms)
    scaled = heights - mean
    scaled /= rms
    load = pressure * (lengths[0] / rms)
    sides = (1.0, lengths[1] / lengths[0])
    work = []
    guess = None
    if start is not None and start.area_fraction > 0:
        guess = start.pressure
    state = active_set.relax(
        scaled,
        sides,
        load,
        tol=tol,
        rough=precision == "single",
        max_iterations=max_iterations,
        pressure=guess,
        gap=_coarse_gap(scaled, sides, load, work, logger) if guess is None else None,
        logger=logger,
    )
    # The fields are this call's own: scaled in place, for they may be large.
    field, gap = (np.asarray(values, dtype=float) for values in (state.pressure, state.gap))
    field *= rms / lengths[0]
    gap *= rms
    contact = Contact(
        pressure=field,
        gap=gap,
        mean_pressure=pressure,
        area_fraction=state.area_fraction,
        mean_gap=float(gap.mean()),
        shift=state.shift * rms + mean,
        residual=state.residual,
        iterations=state.iterations,
        fft_pairs=state.pairs + sum(work) / scaled.size,
        length=lengths,
        rms_height=rms,
    )
    if not state.residual <= tol:
        raise ConvergenceError(
            f"residual {state.residual:.2e} h_rms after {state.iterations} iterations, "
            f"asked for {tol:.2e}: raise max_iterations, or tol if it is near rounding",
            contact,
        )
    return contact


def load_path(heights, length, pressures, tol=1e-8, **options):
    """Solve one surface at several mean pressures.

    A solution at nearly the same pressure is the start of the next; beyond `_NEAR` of relative
    change the coarser grids predict the contact set better, and every solution starts from those.

    Parameters
    ----------
    heights, length, tol
        As for `solve`.
    pressures : iterable of float
        Mean pressures in units of E*.
    **options
        Further arguments of `solve` but `start`.

    Yields
    ------
    Contact
        One solution per pressure, in the order given.
    """
    last = None
    for pressure in pressures:
        near = last is not None and abs(pressure - last.mean_pressure) < _NEAR * last.mean_pressure
        start = last if near else None
        last = solve(heights, length, pressure, tol=tol, start=start, **options)
        yield last


def _coarse_gap(heights, sides, load, work, logger):
    """First guess of the gap from coarser grids, in single precision.

    Appends to the list `work` the pairs of transforms times points of every grid.
    """
    if min(heights.shape) < 2 * _COARSEST:
        return None
    coarse = _sampled(heights, tuple(_coarser(n) for n in heights.shape))
    state = active_set.relax(
        coarse,
        sides,
        load,
        tol=_COARSE_TOLERANCE,
        max_iterations=200,
        gap=_coarse_gap(coarse, sides, load, work, logger),
        rough=True,
        logger=logger,
    )
    work.append(state.pairs * coarse.size)
    return _interpolated(state.gap, heights.shape)


def _coarser(n):
    return n // 2 if n % 2 == 0 else (n + 1) // 2


def _sampled(field, shape):
    """Sample a periodic field on a grid about half as fine."""
    if all(n == 2 * m for n, m in zip(field.shape, shape, strict=True)):
        return np.ascontiguousarray(field[::2, ::2])
    return _interpolated(field, shape)


def _interpolated(field, shape):
    """Interpolate a periodic field by cubics along both axes, onto a grid of any shape."""
    for axis, n in enumerate(shape):
        if n == 2 * field.shape[axis]:
            field = _doubled(field, axis)
        elif n != field.shape[axis]:
            field = _resampled(field, n, axis)
    return field


def _doubled(field, axis):
    """Put a point between any two, on the cubic through its four neighbours."""
    between = field + np.roll(field, -1, axis)
    between *= 9
    between -= np.roll(field, 1, axis)
    between -= np.roll(field, -2, axis)
    between /= 16
    shape = list(field.shape)
    shape[axis] *= 2
    fine = np.empty(shape, field.dtype)
    even, odd = [slice(None)] * 2, [slice(None)] * 2
    even[axis], odd[axis] = slice(0, None, 2), slice(1, None, 2)
    fine[tuple(even)] = field
    fine[tuple(odd)] = between
    return fine


def _resampled(field, n, axis):
    """Sample at n points the cubics through any four neighbours."""
    m = field.shape[axis]
    position = np.arange(n) * (m / n)
    left = np.floor(position).astype(int)
    t = position - left
    weights = {
        -1: -t * (t - 1) * (t - 2) / 6,
        0: (t + 1) * (t - 1) * (t - 2) / 2,
        1: -(t + 1) * t * (t - 2) / 2,
        2: (t + 1) * t * (t - 1) / 6,
    }
    total = 0.0
    for offset, weight in weights.items():
        weight = weight[:, None] if axis == 0 else weight
        total = total + weight * np.take(field, (left + offset) % m, axis=axis)
    return total.astype(field.dtype)


def _flat(heights, lengths, pressure):
    return Contact(
        pressure=np.full(heights.shape, pressure),
        gap=np.zeros(heights.shape),
        mean_pressure=pressure,
        area_fraction=1.0 if pressure > 0 else 0.0,
        mean_gap=0.0,
        shift=float(heights.flat[0]),
        residual=0.0,
        iterations=0,
        fft_pairs=0.0,
        length=lengths,
        rms_height=0.0,
    )


def _touching(heights, lengths, rms):
    top = float(heights.max())
    gap = top - heights
    return Contact(
        pressure=np.zeros(heights.shape),
        gap=gap,
        mean_pressure=0.0,
        area_fraction=0.0,
        mean_gap=float(gap.mean()),
        shift=top,
        residual=0.0,
        iterations=0,
        fft_pairs=0.0,
        length=lengths,
        rms_height=rms,
    )


def _scale(heights):
    """Mean and root mean square about it, safe from overflow and underflow of the squares."""
    mean = float(heights.mean())
    largest = float(np.abs(heights - mean).max())
    # Heights that differ by rounding only are flat.
    if largest <= 8 * np.finfo(float).eps * abs(mean):
        return mean, 0.0
    return mean, largest * float(np.sqrt(np.mean(((heights - mean) / largest) ** 2)))


def _check_length(length, shape):
    (sides,) = positive(length=length)
    if sides.size == 1:
        side = float(sides.ravel()[0])
        return side, side * shape[1] / shape[0]
    if sides.shape != (2,):
        raise ValueError(f"length must be one or two positive numbers, got {length!r}")
    return float(sides[0]), float(sides[1])
