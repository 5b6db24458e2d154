"""Correction of the pressure where few points touch: an approximate compliance of these alone.

Below 1 % of contact a convolution spends most of its work on points without pressure. The points
that may touch, the *candidates*, are few, and mostly near ones displace each other. Their
compliance is split by wave number, as Ewald split the Coulomb potential (Ann. Phys. 369:253, 1921):
short waves give a sparse matrix of near pairs, long waves a convolution on a grid with a sixteenth
of the points, between cubic B-splines (Essmann et al., J. Chem. Phys. 103:8577, 1995, doi
10.1063/1.470117). It is accurate to 1 %; `active_set` measures the true gap after a correction.
"""

from dataclasses import dataclass

import numpy as np
from scipy import fft, sparse

from stickiness.repulsive import convolution, free_edges, half_space, sharing
from stickiness.repulsive.preconditioner import close_gap

# Beyond these two limits the whole grid is as cheap.
_MAX_CANDIDATES = 0.012  # of all points
_MAX_PAIRS = 0.8  # near pairs, per point of the grid
_FREE_FACTOR = 2  # of both with free edges, where convolutions are on four times the points
_CANDIDATE_GAP = 1.0  # of the rms gap in contact: candidates are what lies below
_SPACING = 4  # of the grid of long waves, in pixels
_SPLIT_WIDTH = 0.8  # of the split, in spacings: the shortest wave of that grid keeps 0.013
_REACH = 10  # of near pairs, in pixels
_BESIDE = 3  # in pixels, of the stiffness that preconditions
_TABLE = 64  # pixels along the sides of the table of near pairs
_PATCH = (_TABLE, _TABLE)
#: Penetrations up to this multiple of the rms gap in contact may yet vanish.
ADMITTED_PENETRATION = 0.7
_MAX_SET_CHANGES = 30  # changes of the set in a correction
_USUAL_REDUCTION = 0.01  # reduction of the gap by a correction
_BEST_REDUCTION = 0.002  # by a last correction: a goal within it is reached at once
_REDUCTION_WHILE_CHANGING = 0.1  # reduction of the gap between changes of the set


def is_worthwhile(grid, count):
    """Whether corrections among `count` points pay on a grid, of about square pixels."""
    if grid.mirrored:  # kernels of near pairs know no mirror images
        return False
    pixel = [a / n for a, n in zip(grid.sides, grid.shape, strict=True)]
    square = max(pixel) < 1.5 * min(pixel)
    return square and min(grid.shape) >= 2 * _TABLE and count <= _MAX_CANDIDATES * _points(grid)


def _points(grid):
    """Points of a grid, as many as convolutions on it cost."""
    return grid.heights.size * (1 if grid.periodic else _FREE_FACTOR)


def select_candidates(grid, last, points, below, image, shift):
    """The `last` candidates if they hold all that penetrate, else new ones; None if too many.

    `points` are in contact and those `below` penetrate; `image` plus `shift` is the gap.
    """
    if last is not None and np.isin(below, last.points, assume_unique=True).all():
        return last
    # Points with a small gap may touch next, those in contact or among the last ones anyway.
    likely = image < _CANDIDATE_GAP * np.std(image[points]) - shift
    likely[points] = True
    if last is not None:
        likely[last.points] = True
        last.clear()
    likely = np.flatnonzero(likely)
    if not is_worthwhile(grid, likely.size):
        return None
    row, column = np.divmod(likely.astype(np.int32), np.int32(grid.shape[1]))
    if grid.periodic:
        split = half_space.keep(_Split, grid.shape, tuple(grid.sides), grid.solid)
    else:  # on the rectangle that holds the points
        row = row - row.min()
        column = column - column.min()
        pixel = tuple(side / n for side, n in zip(grid.sides, grid.shape, strict=True))
        split = _FreeSplit((int(row.max()) + 1, int(column.max()) + 1), pixel)
    # Short waves between near pairs, the stiffness that preconditions, and long waves.
    pairs = _find_pairs(row, column, split.cell, most=_MAX_PAIRS * _points(grid))
    if pairs is None:
        return None
    near = _symmetric(split.near, pairs)
    beside = _symmetric(split.beside, pairs)
    splines = _splines(row, column, split)
    return Candidates(grid, likely, split, splines, near, beside)


class Candidates:
    """Points that may touch (flat, increasing), and the approximate compliance among them."""

    def __init__(self, grid, points, split, splines, near, beside):
        self.points = points
        self._grid = grid
        self._split = split
        self._portion = np.prod(split.shape) / grid.heights.size
        self._splines = splines
        self._transpose = splines.T
        self._near = near
        self._beside = beside

    def clear(self):
        """Free the memory of candidates that are not used any more."""
        vars(self).clear()

    def compliance(self, pressure):
        """Displacement of all candidates, in single precision."""
        self._grid.spent += self._split.share * self._portion
        image = self._splines @ self._split.convolve(self._transpose @ pressure)
        return self._near.multiply(pressure, image)

    def stiffness(self, gap):
        """Pressure for a gap in contact, short waves only: a preconditioner."""
        return self._beside.multiply(gap, 0)

    def correct_pressure(self, points, pressure, gap, goal, limit):
        """Correct a pressure on some candidates so as to close the `gap`, given at all of them.

        Returns points, pressure and the number of iterations, about `limit` at most.
        """
        active = np.isin(self.points, points, assume_unique=True)
        before = np.zeros(self.points.size)
        before[active] = pressure
        after = before.copy()
        count = 0
        # The compliance is good to 1 %: a correction cannot do much better than that.
        gap = gap - gap[active].mean()
        gap_before = gap.copy()
        largest = float(np.abs(gap[active]).max())
        if goal < _BEST_REDUCTION * largest:
            goal = _USUAL_REDUCTION * largest
        for _ in range(_MAX_SET_CHANGES):
            # Admit points that penetrate deep.
            joined = gap < -max(ADMITTED_PENETRATION * float(np.std(gap[active])), goal)
            settled = not (joined & ~active).any() and np.abs(gap[active]).max() <= goal
            if settled or count >= limit:
                break
            touched = active
            active = touched | joined
            # Close the gap in contact, in single precision and scaled to one.
            misfit = gap[active].mean() - gap[active]
            scale = float(np.abs(misfit).max()) or 1.0
            misfit = (misfit / scale).astype(np.float32)
            reduction = max(_REDUCTION_WHILE_CHANGING, 0.5 * goal / scale)
            change, more = close_gap(
                precondition=self._among(self.stiffness, active),
                compliance=self._among(self.compliance, active),
                residual=misfit,
                goal=reduction,
                largest=True,
                limit=limit - count,
            )
            count += more
            after[active] += (change - change.mean(dtype=float)) * scale
            steady = not (joined & ~touched).any() and after[active].min() > 0
            if steady and np.abs(misfit).max() * scale <= goal:
                break
            # Release points under tension, balance the load, and find the new gap.
            active = after > 0
            after[~active] = 0
            after *= pressure.sum() / after.sum()
            gap = gap_before + self.compliance((after - before).astype(np.float32))
            gap -= gap[active].mean()
        return self.points[active], after[active], count

    def _among(self, operator, active):
        """An operator on all candidates as one on those that touch."""
        touching = np.flatnonzero(active)
        field = np.zeros(active.size, np.float32)

        def apply(values):
            field[touching] = values
            return operator(field)[touching]

        return apply


class _Split:
    """Short and long waves of the compliance of a periodic solid on a grid."""

    share = 1 / _SPACING**2  # of the points of the grid, in a convolution

    def __init__(self, shape, sides, solid):
        self.shape = shape
        self.cell = shape
        self.coarse = tuple(fft.next_fast_len(-(-n // _SPACING), real=True) for n in shape)
        self.places = [(m / n, 0) for m, n in zip(self.coarse, shape, strict=True)]
        width = _SPLIT_WIDTH * max(a / m for a, m in zip(sides, self.coarse, strict=True))
        # Short waves: near pairs do not feel how large the cell is.
        patch = [_TABLE * a / n for a, n in zip(sides, shape, strict=True)]
        q = half_space.effective_wavenumbers(_PATCH, patch, solid)
        self.near = _tabulate(_invert(q) * (1 - _long(_PATCH, patch, width)), _REACH)
        self.beside = _tabulate(q / 2, _BESIDE)
        # Long waves, on the coarse grid.
        symbol = _invert(half_space.effective_wavenumbers(self.coarse, sides, solid))
        symbol *= _long(self.coarse, sides, width)
        blur = [np.sinc(np.fft.rfftfreq(m)) ** 8 for m in self.coarse]  # of two cubic B-splines
        symbol /= np.outer(blur[0], blur[1]) * (shape[0] * shape[1])
        self._convolution = convolution.convolution(self.coarse, np.float32)
        self._symbol = self._convolution.symbol(symbol.T)
        self._image = np.zeros(self.coarse, np.float32)

    def convolve(self, field):
        """Long waves of all points of the coarse grid; the next call overwrites the result."""
        self._convolution.apply(self._symbol, field.reshape(self.coarse), self._image)
        return self._image.ravel()


class _FreeSplit(free_edges.Split):
    """The same of an unbounded half-space."""

    places = [(1 / free_edges.SPACING, 1)] * 2

    def __init__(self, shape, pixel):
        super().__init__(shape, pixel, np.float32, free_edges.COARSE)
        # A period so wide that no point neighbours another across it.
        self.cell = (shape[0] + _REACH, shape[1] + _REACH)
        rest = self.rest([_REACH] * 2)
        self.near = _truncate_kernel(np.hstack([rest, rest[:, :0:-1]]), _REACH)
        q = half_space.wavenumbers(_PATCH, [_TABLE * a for a in pixel])
        self.beside = _tabulate(q / 2, _BESIDE)


def _long(shape, lengths, width):
    """Share of a wave that counts as long: the rest falls off with distance to the power -5."""
    x = (width * half_space.wavenumbers(shape, lengths)) ** 2
    return np.exp(-x) * (1 + x)


def _invert(q):
    """Compliance 2/q of a wave, zero for the mean."""
    return np.divide(2, q, out=np.zeros_like(q), where=q > 0)


def _tabulate(symbol, reach):
    """Kernel of a symbol, of which one quadrant is given, as `_truncate_kernel` returns it."""
    whole = np.concatenate([symbol, symbol[-2:0:-1]])
    return _truncate_kernel(np.fft.irfft2(whole, _PATCH), reach)


def _truncate_kernel(kernel, reach):
    """Kernel within a reach, on the half of a square that holds every pair once."""
    kernel = kernel.astype(np.float32)
    down = np.arange(_REACH + 1)[:, None]
    across = np.arange(-_REACH, _REACH + 1)
    beside = np.where(np.hypot(down, across) <= reach, kernel[down, across], 0)
    return _NearKernel(beside=beside, diagonal=kernel[0, 0])


@dataclass(frozen=True, eq=False)
class _NearKernel:
    """Displacement by pressure on a pixel, of its neighbours and of itself."""

    beside: np.ndarray  #: by rows down, and by columns from `_REACH` to the left on
    diagonal: np.float32


@dataclass(frozen=True, eq=False)
class _SymmetricMatrix:
    """Sparse symmetric matrix: the half above the diagonal, its transpose, a constant diagonal."""

    upper: sparse.csr_array
    lower: sparse.csc_array
    diagonal: np.float32

    def multiply(self, values, image):
        """Add the product with some values to an image."""
        halves = (self.upper, self.lower)
        upper, lower = sharing.share(lambda _, half: half @ values, halves, self.upper.nnz)
        return image + upper + lower + self.diagonal * values


@dataclass(frozen=True, eq=False)
class _Pairs:
    """Pairs of points within reach, each once, by its first point."""

    starts: np.ndarray  #: where the pairs of each first point begin, and the end
    second: np.ndarray  #: the other point
    place: np.ndarray  #: of the pair in a table of a kernel


def _find_pairs(row, column, cell, most):
    """Pairs of points by row and column of a periodic cell; None if more than `most`."""
    height, period = (np.int32(n) for n in cell)
    # Points in the order of rows that go on beyond both ends of the cell: neighbours across the
    # boundary then follow one another, too.
    left = np.flatnonzero(column >= period - _REACH)
    right = np.flatnonzero(column < _REACH)
    index = np.concatenate([np.arange(row.size, dtype=np.int32), left, right], dtype=np.int32)
    width = period + np.int32(2 * _REACH)
    places = row[index] * width + column[index] + np.int32(_REACH)
    places[row.size : row.size + left.size] -= period
    places[row.size + left.size :] += period
    order = np.argsort(places, kind="stable")
    places = places[order]
    # Half a disk around a point holds every pair once, in each row a run of points.
    down = np.arange(_REACH + 1, dtype=np.int32)
    half = np.sqrt(_REACH**2 - down**2).astype(np.int32)
    middle = (row[:, None] + down) % height * width + column[:, None] + np.int32(_REACH)
    begin = middle - half
    begin[:, 0] = middle[:, 0] + 1
    first = np.searchsorted(places, begin.ravel())
    count = np.searchsorted(places, (middle + half).ravel(), side="right") - first
    total = np.cumsum(count)
    if total[-1] > most:
        return None
    # All runs one after the other, and where their points are in a table by rows down.
    found = np.repeat(first - total + count, count) + np.arange(total[-1])
    origin = down * (2 * _REACH + 1) + np.int32(_REACH) - middle
    return _Pairs(
        starts=np.append(0, total[_REACH :: _REACH + 1]).astype(np.int32),
        second=index[order].take(found),
        place=places.take(found) + np.repeat(origin.ravel(), count),
    )


def _symmetric(kernel, pairs):
    """Matrix of a kernel, without the pairs beyond its reach."""
    size = pairs.starts.size - 1
    entries = (kernel.beside.take(pairs.place), pairs.second, pairs.starts)
    upper = sparse.csr_array(entries, shape=(size, size), copy=True)
    upper.eliminate_zeros()
    return _SymmetricMatrix(upper=upper, lower=upper.T, diagonal=kernel.diagonal)


def _splines(row, column, split):
    """Cubic B-splines around the points of the coarse grid, at some of the fine one: a row each."""
    columns = np.zeros((1, 1), np.int32)
    weights = np.ones((1, 1), np.float32)
    axes = zip((row, column), split.places, split.coarse, strict=True)
    for position, (ratio, first), m in axes:
        left, t = np.divmod(position[:, None] * ratio + first, 1)
        u = 1 - t
        # The four splines that overlap a point, and the coarse points that they are around.
        spline = np.hstack([u**3, 4 + 3 * t**3 - 6 * t**2, 4 + 3 * u**3 - 6 * u**2, t**3]) / 6
        around = (left.astype(np.int32) + np.arange(-1, 3, dtype=np.int32)) % np.int32(m)
        # Outer product with those of the other axis.
        columns = (columns[:, :, None] * np.int32(m) + around[:, None]).reshape(row.size, -1)
        product = weights[:, :, None] * spline.astype(np.float32)[:, None]
        weights = product.reshape(row.size, -1)
    starts = np.arange(0, columns.size + 1, columns.shape[1], dtype=np.int32)
    shape = (row.size, split.coarse[0] * split.coarse[1])
    return sparse.csr_array((weights.ravel(), columns.ravel(), starts), shape=shape)
