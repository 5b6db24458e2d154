"""Active-set iteration of the repulsive contact problem, in dimensionless variables.

See `stickiness.repulsive` for the problem and the method. Pressures of the contact set are kept as
short vectors over its points; whole grids are touched once per update of the set.
"""

from dataclasses import dataclass

import numpy as np
from scipy import sparse

__all__ = ["State", "relax"]

_PREDICTION = 0.7  # c in "contact where p > c k g": 0.5 to 1 predict about equally well
_LOOSE = 0.3  # reduction of the gap on a set that is still changing
_SETTLED = 1e-3  # share of points that may still change for a solution to full accuracy
_EXTENSION = 0.6  # weight of the residual extended beyond the edge of contact
_DIAGONAL = 0.7  # weight of a diagonal neighbour beside a direct one
_PATIENCE = 8  # updates without progress after which the set is solved ten times tighter


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


class _Grid:
    """Heights on a grid with its operator and two scratch fields."""

    def __init__(self, operator, heights):
        self.operator = operator
        self.heights = heights
        self.shape = heights.shape
        self.field = np.zeros(heights.size)
        self.image = np.empty(heights.size)
        self.active = np.zeros(heights.size, bool)

    def rows(self, points):
        hit = np.zeros(self.shape[0], bool)
        hit[points // self.shape[1]] = True
        return np.flatnonzero(hit)

    def apply(self, operation, points, values, rows_in, rows_out=None):
        """Image of a field that is zero but for `values` at `points`; `image` holds it."""
        self.field[points] = values
        operation(self.field.reshape(self.shape), self.image.reshape(self.shape), rows_in, rows_out)
        self.field[points] = 0
        return self.image


def relax(
    operator, heights, load, guess, *, predict, tol, max_iterations, logger=None
):
    """Find pressure and gap on one grid.

    Parameters
    ----------
    operator : stickiness.fourier.HalfSpace
        Half-space of the grid.
    heights : numpy.ndarray
        Heights in units of their rms.
    load : float
        Mean pressure.
    guess : numpy.ndarray
        Non-negative pressure of that mean, or proportional to one.
    predict : bool
        Whether the guess deserves a prediction of the contact set from it.
    tol : float
        Largest accepted residual.
    max_iterations : int
        Largest number of inner iterations; whatever is reached by then is returned.
    logger : logging.Logger, optional
        Told the progress.

    Returns
    -------
    State
        The iterate of the smallest residual.
    """
    before = operator.pairs
    grid = _Grid(operator, heights.ravel().reshape(heights.shape))
    total = load * heights.size
    points, pressure = _compressed(guess, total)
    if predict and points.size < heights.size:
        points, pressure = _predicted(grid, points, pressure, total)
    best = None
    iterations, loose, stale, changed = 0, _LOOSE, 0, points.size
    while True:
        shift, gaps, touching, scatter, depth = _gap(grid, points, pressure)
        residual = max(scatter, depth)
        if logger is not None:
            logger.info(
                "%d x %d: residual %.1e, area %.5f, %d iterations",
                *grid.shape, residual, points.size / heights.size, iterations,
            )
        if best is None or residual < best[0]:
            best = (residual, points, pressure, shift)
            stale = 0
        else:
            stale += 1
            if stale % _PATIENCE == 0:
                loose = max(loose / 10, 1e-8)
        if residual <= tol or iterations >= max_iterations or points.size + touching.size <= 1:
            break
        added = touching.size
        if added:
            points, pressure, gaps = _joined(grid, points, pressure, gaps, touching, shift)
        settled = changed + added <= _SETTLED * points.size
        change, count = _inner(
            grid, points, -gaps, 0.5 * tol if settled else 0.0, loose, max_iterations - iterations
        )
        iterations += count
        pressure = pressure + change
        keep = pressure > 0
        changed = added + points.size - int(np.count_nonzero(keep))
        if changed > added:
            points, pressure = points[keep], pressure[keep]
            pressure *= total / pressure.sum()
    return _state(grid, best, iterations, operator.pairs - before)


def _compressed(guess, total):
    flat = guess.ravel()
    points = np.flatnonzero(flat > 0)
    if points.size == 0:
        points = np.arange(flat.size)
        return points, np.full(flat.size, total / flat.size)
    pressure = flat[points]
    return points, pressure * (total / pressure.sum())


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


def _predicted(grid, points, pressure, total):
    shift, *_ = _gap(grid, points, pressure)
    threshold = grid.image + shift
    threshold *= _PREDICTION * grid.operator.mean_stiffness
    full = np.zeros(threshold.size)
    full[points] = pressure
    predicted = np.flatnonzero(full > threshold)
    if not full[predicted].sum() > 0:
        return points, pressure
    pressure = full[predicted]
    return predicted, pressure * (total / pressure.sum())


def _joined(grid, points, pressure, gaps, extra, shift):
    grid.active[points] = True
    grid.active[extra] = True
    joined = np.flatnonzero(grid.active)
    grid.active[joined] = False
    grid.field[points] = pressure
    pressure = grid.field[joined]
    grid.field[points] = 0
    return joined, pressure, grid.image[joined] + shift


def _inner(grid, points, residual, target, loose, limit):
    """Change of pressure, of zero sum, that closes the gap on a set of points.

    Preconditioned conjugate gradients in the space of vectors of zero sum, until the largest
    residual is below `target` or, if that is zero, its norm is reduced by the factor `loose`.
    """
    if points.size <= 1:
        return np.zeros(points.size), 1
    precondition = _Preconditioner(grid, points)
    rows = grid.rows(points)
    residual = residual - residual.mean()
    goal = loose * np.linalg.norm(residual)
    change = np.zeros(points.size)
    direction, product = None, 1.0
    count = 0
    for count in range(1, max(limit, 1) + 1):
        z = precondition(residual)
        z -= z.mean()
        previous, product = product, float(residual @ z)
        if not product > 0:
            break
        if direction is None:
            direction = z
        else:
            direction *= product / previous
            direction += z
        image = grid.apply(grid.operator.compliance, points, direction, rows, rows)[points]
        step = product / float(direction @ image)
        change += step * direction
        residual -= step * image
        residual -= residual.mean()
        if target > 0:
            if np.abs(residual).max() <= target:
                break
        elif np.linalg.norm(residual) <= goal:
            break
    return change, count


class _Preconditioner:
    """Stiffness between an extension of the residual beyond contact and its transpose.

    The exact inverse extends the residual by the displacement of least energy; a weighted mean
    over the neighbours in contact imitates that next to the edge, where it matters.
    """

    def __init__(self, grid, points):
        self.grid = grid
        self.points = points
        self.extension = None
        self.every = points
        if points.size < grid.heights.size:
            self._extend()
        self.rows = grid.rows(self.every)

    def _extend(self):
        grid, points = self.grid, self.points
        n0, n1 = grid.shape
        grid.active[points] = True
        row, column = np.divmod(points, n1)
        targets, sources, weights = [], [], []
        for i in (-1, 0, 1):
            for j in (-1, 0, 1):
                if i == 0 and j == 0:
                    continue
                neighbour = (row + i) % n0 * n1 + (column + j) % n1
                outside = np.flatnonzero(~grid.active[neighbour])
                targets.append(neighbour[outside])
                sources.append(outside)
                weights.append(np.full(outside.size, _DIAGONAL if i and j else 1.0))
        grid.active[points] = False
        targets, sources = np.concatenate(targets), np.concatenate(sources)
        weights = np.concatenate(weights)
        grid.active[targets] = True
        band = np.flatnonzero(grid.active)
        grid.active[band] = False
        index = np.searchsorted(band, targets)
        counts = np.bincount(index, weights, band.size)
        weights *= _EXTENSION / (1 + counts[index])
        size = (band.size, points.size)
        self.extension = sparse.csr_array((weights, (index, sources)), shape=size)
        self.transpose = self.extension.T.tocsr()
        self.every = np.concatenate([points, band])

    def __call__(self, residual):
        grid, points = self.grid, self.points
        operation = grid.operator.stiffness
        if self.extension is None:
            return grid.apply(operation, points, residual, self.rows, self.rows)[points]
        values = np.concatenate([residual, self.extension @ residual])
        image = grid.apply(operation, self.every, values, self.rows, self.rows)[self.every]
        return image[: points.size] + self.transpose @ image[points.size :]


def _state(grid, best, iterations, pairs):
    residual, points, pressure, shift = best
    grid.apply(grid.operator.compliance, points, pressure, grid.rows(points))
    gap = grid.image
    gap -= grid.heights.ravel()
    gap += shift
    np.maximum(gap, 0, out=gap)
    gap[points] = 0
    grid.field[points] = pressure
    return State(
        pressure=grid.field.reshape(grid.shape),
        gap=gap.reshape(grid.shape),
        shift=shift,
        area_fraction=points.size / gap.size,
        residual=residual,
        iterations=iterations,
        pairs=pairs,
    )
