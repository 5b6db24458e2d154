"""Active-set iteration of the repulsive contact problem, in dimensionless variables.

See `stickiness.repulsive` for the problem and the method. Pressures of the contact set are kept as
short vectors over its points; whole grids are touched once per update of the set.

The gap is always computed in double precision. Corrections of the pressure between two updates are
solved for in single precision: they reduce the gap by a factor of 10 or 1000, so that the seven
digits are plenty, and the next update starts from the true gap again (iterative refinement).
"""

from dataclasses import dataclass

import numpy as np
from scipy import sparse

from stickiness import fourier

__all__ = ["State", "relax"]

_PREDICTION = 0.7  # c in "contact where p > c k g": 0.5 to 1 predict about equally well
_LOOSE = 0.3  # reduction of the gap on a set that is still changing much
_CLOSER = 0.03  # and on one that changes little
_SETTLED = 1e-3  # share of changing points below which a set changes little
_ADMITTED = 0.7  # penetrations up to this multiple of the rms gap in contact may yet vanish
_RESOLVED = 1e-4  # largest reduction of the gap asked of a correction in single precision
_EXTENSION = 0.8  # weight of the residual extended beyond the edge of contact
_DIAGONAL = 0.6  # weight of a diagonal neighbour beside a direct one
_PATIENCE = 8  # updates without progress after which the set is solved ten times tighter
_SURRENDER = 40  # updates without progress after which rounding is what limits the residual


@dataclass(frozen=True, eq=False)
class State:
    """Outcome of `relax`: fields in units of the side, the rms height and E*."""

    pressure: np.ndarray
    gap: np.ndarray
    shift: float
    area_fraction: float
    residual: float
    iterations: int
    pairs: int


class _Field:
    """A field that is zero but at some points, and its image under an operator."""

    def __init__(self, operator):
        self.operator = operator
        self.shape = operator.shape
        size = self.shape[0] * self.shape[1]
        self.field = np.zeros(size, operator.dtype)
        self.image = np.empty(size, operator.dtype)

    def apply(self, operation, points, values, rows_in, rows_out=None):
        """Image of a field that is zero but for `values` at `points`; `image` holds it."""
        self.field[points] = values
        operation(self.field.reshape(self.shape), self.image.reshape(self.shape), rows_in, rows_out)
        self.field[points] = 0
        return self.image


class _Grid(_Field):
    """Heights on a grid, and scratch fields in double and in single precision."""

    def __init__(self, operator, heights):
        super().__init__(operator)
        self.heights = heights
        self.active = np.zeros(heights.size, bool)
        self.quick = _Field(fourier.half_space(self.shape, operator.lengths, np.float32))
        self._before = self._count()

    def _count(self):
        return self.operator.pairs + self.quick.operator.pairs

    @property
    def pairs(self):
        """Convolutions since this object was made."""
        return self._count() - self._before

    def rows(self, points):
        hit = np.zeros(self.shape[0], bool)
        hit[points // self.shape[1]] = True
        return np.flatnonzero(hit)


def relax(operator, heights, load, *, tol, max_iterations, gap=None, pressure=None, logger=None):
    """Find pressure and gap on one grid.

    Parameters
    ----------
    operator : stickiness.fourier.HalfSpace
        Half-space of the grid.
    heights : numpy.ndarray
        Heights in units of their rms, contiguous.
    load : float
        Mean pressure.
    tol : float
        Largest accepted residual.
    max_iterations : int
        Largest number of inner iterations; whatever is reached by then is returned.
    gap, pressure : numpy.ndarray, optional
        A guess of the gap in single precision, or one of the pressure of any positive mean;
        without either the start is a uniform pressure.
    logger : logging.Logger, optional
        Told the progress.

    Returns
    -------
    State
        The iterate of the smallest residual.
    """
    grid = _Grid(operator, heights)
    total = load * heights.size
    if gap is not None:
        points, pressure = _predicted_from_gap(grid, gap, load)
        gap = None  # frees the memory, if nobody else holds it
    elif pressure is not None:
        points, pressure = _predicted_from_pressure(grid, pressure, total)
    else:
        points, pressure = np.arange(heights.size), np.full(heights.size, load)
    if points.size == heights.size:
        full = _full_contact(grid, load)
        if full.pressure.min() >= 0:
            return full
    best, precondition = None, None
    iterations, stale, loose, changed = 0, 0, _LOOSE, points.size
    while True:
        shift, gaps, below, scatter, depth = _gap(grid, points, pressure)
        residual = max(scatter, depth)
        stale += 1
        if best is None or residual < best[0]:
            best, stale = (residual, points, pressure, shift), 0
        if logger is not None:
            _report(logger, grid, residual, points.size, iterations)
        if residual <= tol or iterations >= max_iterations or stale > _SURRENDER:
            break
        if below.size + points.size == 1:
            break
        if stale and stale % _PATIENCE == 0:
            loose /= 10
        admitted = below[grid.image[below] + shift < -_ADMITTED * np.sqrt(np.mean(gaps**2))]
        if admitted.size:
            points, pressure, gaps = _joined(grid, points, pressure, admitted, shift)
            precondition = None
        changed += admitted.size
        if precondition is None:
            precondition = _Preconditioner(grid, points)
        if changed == 0:
            goal = 0.5 * tol
        else:
            reduction = loose if changed > _SETTLED * points.size else min(loose, _CLOSER)
            goal = max(reduction * float(np.std(gaps)), 0.1 * tol)
        change, count = _inner(precondition, gaps, goal, changed == 0, max_iterations - iterations)
        iterations += count
        pressure = pressure + change
        keep = pressure > 0
        changed = points.size - int(np.count_nonzero(keep))
        if changed:
            points, pressure = points[keep], pressure[keep]
            pressure *= total / pressure.sum()
            precondition = None
        changed += admitted.size
    return _state(grid, best, pressure, iterations)


def _full_contact(grid, load):
    """Full contact of any surface: the pressure is that of the heights as a displacement."""
    pressure = grid.operator.stiffness(grid.heights)
    misfit = grid.operator.compliance(pressure)
    misfit -= grid.heights
    residual = float(np.abs(misfit).max())
    pressure += load
    misfit[...] = 0
    return State(pressure, misfit, 0.0, 1.0, residual, 0, grid.pairs)


def _report(logger, grid, residual, size, iterations):
    logger.info(
        "%d x %d: residual %.1e h_rms, area %.5f, %d iterations",
        *grid.shape,
        residual,
        size / grid.heights.size,
        iterations,
    )


def _gap(grid, points, pressure):
    """Gap of an iterate.

    Returns the shift that makes its mean in contact vanish, the gap in contact, points outside
    that penetrate, the largest gap in contact and the largest penetration. The image of `grid`
    keeps the gap without the shift.
    """
    image = grid.apply(grid.operator.compliance, points, pressure, grid.rows(points))
    image -= grid.heights.ravel()
    gaps = image[points]
    shift = -gaps.mean()
    gaps += shift
    below = np.flatnonzero(image < -shift)
    grid.active[points] = True
    below = below[~grid.active[below]]
    grid.active[points] = False
    depth = float(-(image[below].min() + shift)) if below.size else 0.0
    return float(shift), gaps, below, float(np.abs(gaps).max()), depth


def _predicted_from_gap(grid, gap, load):
    """Contact set and pressure from a guess of the gap, in single precision.

    The heights being exact, so is the pressure the guess implies well inside contact.
    """
    operator, shape = grid.quick.operator, grid.shape
    surface = grid.quick.image.reshape(shape)  # scratch: not in use here
    np.add(gap, grid.heights, out=surface, casting="same_kind")
    pressure = operator.stiffness(surface)
    pressure += np.float32(load)
    np.multiply(gap, np.float32(_PREDICTION * operator.mean_stiffness), out=surface)
    np.maximum(surface, 0, out=surface)
    points = np.flatnonzero(pressure > surface)
    if points.size == 0:
        points = np.array([np.argmax(pressure)])
    pressure = pressure.ravel()[points].astype(float)
    return points, _balanced(np.maximum(pressure, 0), load * gap.size)


def _predicted_from_pressure(grid, pressure, total):
    """Contact set and pressure from a guess of the pressure."""
    flat = pressure.ravel()
    points = np.flatnonzero(flat > 0)
    shift, *_ = _gap(grid, points, _balanced(flat[points], total))
    threshold = grid.image + shift
    threshold *= _PREDICTION * grid.operator.mean_stiffness * (flat.sum() / total)
    predicted = np.flatnonzero(flat > np.maximum(threshold, 0))
    if predicted.size:
        points = predicted
    return points, _balanced(flat[points], total)


def _balanced(pressure, total):
    force = pressure.sum()
    if force > 0:
        return pressure * (total / force)
    return np.full(pressure.size, total / pressure.size)


def _joined(grid, points, pressure, extra, shift):
    grid.active[points] = True
    grid.active[extra] = True
    joined = np.flatnonzero(grid.active)
    grid.active[joined] = False
    grid.field[points] = pressure
    pressure = grid.field[joined]
    grid.field[points] = 0
    return joined, pressure, grid.image[joined] + shift


def _inner(precondition, gaps, goal, largest, limit):
    """Change of pressure, of zero sum, that closes the gap on a set of points.

    Preconditioned conjugate gradients in the space of vectors of zero sum, until the rms
    residual (or the `largest`) is down to `goal`. In single precision, in units of the rms gap.
    """
    quick, points, rows = precondition.quick, precondition.points, precondition.inner_rows
    scale = float(np.std(gaps))
    change, count = np.zeros(points.size, np.float32), 1
    if points.size == 1 or scale == 0:
        return change, count
    goal = max(goal / scale, _RESOLVED)
    residual = ((gaps.mean() - gaps) / scale).astype(np.float32)
    direction, product = None, 1.0
    while True:
        z = precondition(residual)
        z -= z.mean()
        previous, product = product, float(residual @ z)
        if not product > 0:  # nothing but rounding is left
            break
        if direction is None:
            direction = z
        else:
            direction *= np.float32(product / previous)
            direction += z
        image = quick.apply(quick.operator.compliance, points, direction, rows, rows)[points]
        step = np.float32(product / float(direction @ image))
        change += step * direction
        image *= step
        residual -= image
        residual -= residual.mean()
        norm = np.abs(residual).max() if largest else np.sqrt(np.mean(residual**2))
        if norm <= goal or count >= limit:
            break
        count += 1
    change = change.astype(float)
    change -= change.mean()
    return scale * change, count


class _Preconditioner:
    """Stiffness between an extension of the residual beyond contact and its transpose.

    The exact inverse extends the residual by the displacement of least energy; a weighted mean
    over the neighbours in contact imitates that next to the edge, where it matters.
    """

    def __init__(self, grid, points):
        self.quick = grid.quick
        self.points = points
        self.inner_rows = grid.rows(points)
        self.extension = None
        self.every = points
        if points.size < grid.heights.size:
            self._extend(grid)
        self.rows = grid.rows(self.every)

    def _extend(self, grid):
        points = self.points
        reached = np.zeros(grid.active.size, bool)
        for neighbour, _ in _neighbours(points, grid.shape):
            reached[neighbour] = True
        reached[points] = False
        band = np.flatnonzero(reached)
        grid.active[points] = True
        position = grid.quick.image.view(np.int32)  # scratch: not in use here
        position[points] = np.arange(points.size, dtype=np.int32)
        # Eight entries a row, those of neighbours out of contact being zero: no sorting needed.
        columns = np.zeros((band.size, 8), np.int32)
        weights = np.zeros((band.size, 8), np.float32)
        for i, (neighbour, weight) in enumerate(_neighbours(band, grid.shape)):
            touching = grid.active[neighbour]
            weights[:, i] = np.float32(weight) * touching
            columns[:, i] = np.where(touching, position[neighbour], 0)
        grid.active[points] = False
        weights *= np.float32(_EXTENSION) / (1 + weights.sum(axis=1, keepdims=True))
        starts = np.arange(0, 8 * band.size + 1, 8, dtype=np.int32)
        size = (band.size, points.size)
        self.extension = sparse.csr_array((weights.ravel(), columns.ravel(), starts), shape=size)
        self.transpose = self.extension.T
        self.every = np.concatenate([points, band])

    def __call__(self, residual):
        """Approximate pressure for a displacement of the points, both in single precision."""
        quick, points, rows = self.quick, self.points, self.rows
        stiffness = quick.operator.stiffness
        if self.extension is None:
            return quick.apply(stiffness, points, residual, rows, rows)[points]
        values = np.concatenate([residual, self.extension @ residual])
        image = quick.apply(stiffness, self.every, values, rows, rows)[self.every]
        return image[: points.size] + self.transpose @ image[points.size :]


def _neighbours(points, shape):
    """Flat indices of the eight periodic neighbours of points, each with its weight."""
    n0, n1 = shape
    column = points % n1
    first, last = np.flatnonzero(column == 0), np.flatnonzero(column == n1 - 1)
    for i in (-1, 0, 1):
        row = points + i * n1
        if i < 0:
            row[row < 0] += n0 * n1
        elif i > 0:
            row[row >= n0 * n1] -= n0 * n1
        left, right = row - 1, row + 1
        left[first] += n1
        right[last] -= n1
        if i:
            yield row, 1.0
        yield left, _DIAGONAL if i else 1.0
        yield right, _DIAGONAL if i else 1.0


def _state(grid, best, last, iterations):
    residual, touching, pressure, shift = best
    gap = grid.image
    if pressure is not last:  # the image belongs to a later, worse iterate
        _gap(grid, touching, pressure)
    gap += shift
    np.maximum(gap, 0, out=gap)
    gap[touching] = 0
    grid.field[touching] = pressure
    return State(
        pressure=grid.field.reshape(grid.shape),
        gap=gap.reshape(grid.shape),
        shift=shift,
        area_fraction=touching.size / gap.size,
        residual=residual,
        iterations=iterations,
        pairs=grid.pairs,
    )
