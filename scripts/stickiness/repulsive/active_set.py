"""Active-set iteration of the repulsive contact problem, in dimensionless variables.

For a guess of the contact set, preconditioned conjugate gradients solve ``g = 0`` there for the
pressure. Points under tension are released and points that penetrate are added, until neither is
left. Between updates of the set the pressure is corrected in single precision; the next update
starts from the true gap (iterative refinement), in double precision as soon as rounding matters.
Below a per cent of contact only points that may touch take part (`dilute_contact`), and with free
edges their displacement is added up without a convolution on the whole grid (`free_edges`).
"""

from dataclasses import dataclass

import numpy as np

from stickiness.repulsive import convolution, dilute_contact, half_space, sharing
from stickiness.repulsive.preconditioner import Preconditioner, close_gap
from stickiness.solids import HALF_SPACE, Solid

_FIRST_SET_FACTOR = 2.0  # first set over the contact that is expected
_LARGEST_FIRST_SET = 0.5  # of all points: beyond this the first set is all of them
# c in "contact where p > c k g", k being the stiffness of a single pixel, which predicts the set to
# a per cent from a guess of the gap; 0.5 to 1 do about equally well.
PREDICTION = 0.7
_REDUCTION_WHILE_CHANGING = 0.4  # of the gap, on a set that is still changing much
_REDUCTION_NEARLY_SETTLED = 0.01  # and on one that changes little
_FEW_CHANGES = 1e-3  # share of changing points below which a set changes little
_SINGLE_PRECISION_LIMIT = 1e-4  # of the largest height: a smaller residual needs double precision
_SPLIT_LIMIT = 1e-9  # of the largest height: a smaller tolerance needs convolutions
_LARGEST_KEPT = 2**22  # points: beyond this memory is dearer than the time to make operators again
# Updates without progress …
_STALLED_UPDATES_TO_TIGHTEN = 8  # … after which the set is solved ten times tighter
_MAX_STALLED_DILUTE = 2  # … after which corrections among few points are given up
_MAX_STALLED_UPDATES = 40  # … after which rounding is what limits the residual
_MAX_STALLED_UNSURE = 8  # … and where `projected_gradients` takes over


@dataclass(frozen=True, eq=False)
class Problem:
    """Contact problem on one grid."""

    heights: np.ndarray  #: contiguous; for `relax` in units of their rms
    sides: tuple  #: of the cell; for `relax` in units of the first, as the thickness of a layer
    load: float  #: mean pressure [E*]; for `relax` in units of E* times rms height over side
    solid: Solid = HALF_SPACE
    periodic: bool = True  #: or a rectangle on a half-space without end

    def operator(self, dtype):
        """Compliance on this grid, and its inverse, be it approximate."""
        kind = self.heights.shape, self.sides, dtype, self.solid, self.periodic
        return half_space.half_space(*kind, kept=self.heights.size <= _LARGEST_KEPT)


@dataclass(frozen=True, eq=False)
class State:
    """Outcome of `relax`: fields in units of the side, the rms height and E*."""

    pressure: np.ndarray
    gap: np.ndarray
    shift: float
    area_fraction: float
    residual: float
    iterations: int
    fft_pairs: float


class _Field:
    """A field that is zero but at some points, replaced by its image under an operator."""

    def __init__(self, operator, memory):
        self.operator, self.shape = operator, operator.shape
        self.image = memory.view(operator.dtype)[: self.shape[0] * self.shape[1]]

    def apply(self, operation, points, values, rows_in, rows_out=None):
        """Image of a field that is zero but for `values` at `points`; `image` holds it."""
        image = self.image.reshape(self.shape)
        sharing.evaluate(lambda: 0, self.image)
        sharing.put(self.image, points, values)
        operation(image, image, rows_in, rows_out)
        return self.image


class _Grid:
    """Heights on a grid, and scratch fields in single and, unless `rough`, double precision."""

    def __init__(self, problem, rough, tol=0.0):
        self.heights, self.shape = problem.heights, problem.heights.shape
        self.solid, self.sides, self.periodic = problem.solid, problem.sides, problem.periodic
        self.active = np.zeros(self.heights.size, bool)
        # One array in double precision, or two in single: an image is read before the next is made.
        memory = convolution.aligned_zeros(self.heights.size, np.float64)
        self.scratch = memory.view(np.float32)[self.heights.size :]
        self.exact = _Field(problem.operator(np.float32 if rough else np.float64), memory)
        self.quick = self.exact if rough else _Field(problem.operator(np.float32), memory)
        # Below this residual rounding in single precision (some 1e-6 of the heights) is felt.
        largest = max(float(self.heights.max()), -float(self.heights.min()))
        if not problem.periodic:  # an absolute displacement is about as large as this
            largest = max(largest, problem.load)
        self.single_limit = 0.0 if rough else _SINGLE_PRECISION_LIMIT * largest
        self.splits = not problem.periodic and tol > _SPLIT_LIMIT * largest
        self._operators = {self.quick.operator, self.exact.operator}
        self.spent = 0.0  # convolutions on coarser grids, by their share of the points
        self.spent = -self.pairs

    @property
    def pairs(self):
        """Convolutions since this object was made."""
        return self.spent + sum(operator.pairs for operator in self._operators)

    def displace(self, field, points, pressure):
        """Displacement by pressure on some points; `image` of the field holds it."""
        operator = field.operator
        if not self.splits or not dilute_contact.is_worthwhile(self, points.size):
            return field.apply(operator.compliance, points, pressure, self.rows(points))
        operator.displace(points, pressure, field.image.reshape(self.shape))
        return field.image

    def rows(self, points):
        """Rows that hold some of the points, given in increasing order."""
        begins = np.searchsorted(points, np.arange(self.shape[0] + 1) * self.shape[1])
        return np.flatnonzero(np.diff(begins))


def relax(problem, guess, *, tol, max_iterations, rough=False):
    """Find pressure and gap on one grid; returns the iterate of the smallest residual.

    Starts from a `guess` of the "gap" (single precision), which is taken out of the mapping so that
    its memory is free, from one of the "pressure" (any positive mean), or from a uniform pressure
    on the highest points. `rough`: single precision suffices, `tol` is well above 1e-5.
    """
    gap, pressure = guess.pop("gap", None), guess.get("pressure")
    heights, load = problem.heights, problem.load
    sure = problem.solid == HALF_SPACE and problem.periodic
    max_stalled = _MAX_STALLED_UPDATES if sure else _MAX_STALLED_UNSURE
    grid = _Grid(problem, rough, tol)
    field = grid.exact if problem.periodic and pressure is not None else grid.quick
    total = load * heights.size
    if gap is not None:
        points, pressure = _predicted_from_gap(grid, gap, load)
        gap = None  # frees the memory
    elif pressure is not None:
        points, pressure = _predicted_from_pressure(grid, pressure, total)
    else:
        points = _highest(problem)
        pressure = np.full(points.size, total / points.size)
    if points.size == heights.size and problem.periodic:
        full = _full_contact(grid, load)
        if full.pressure.min() >= 0:
            return full
    dilute = dilute_contact.is_worthwhile(grid, points.size)
    best = precondition = candidates = None
    iterations, stalled, loose, changed = 0, 0, _REDUCTION_WHILE_CHANGING, points.size
    while True:
        shift, gaps, below, residual = _gap(grid, field, points, pressure)
        if residual <= tol and field is not grid.exact:
            field = grid.exact
            continue
        stalled += 1
        if best is None or residual < best[-1]:
            best, stalled = (points, pressure, shift, residual), 0
        settled = residual <= tol or below.size + points.size == 1
        if settled or iterations >= max_iterations or stalled > max_stalled:
            break
        if dilute and stalled < _MAX_STALLED_DILUTE:
            at = points, below, field.image, shift
            candidates = dilute_contact.select_candidates(grid, candidates, *at)
        else:
            candidates = None
        if dilute := candidates is not None:
            local = field.image[candidates.points].astype(float) + shift
            points, pressure, count = candidates.correct_pressure(
                points, pressure, local, 0.3 * tol, max_iterations - iterations
            )
            iterations += count
            # such a correction gains a factor of 100
            field = grid.quick if residual > 10 * grid.single_limit else grid.exact
            continue
        if stalled and stalled % _STALLED_UPDATES_TO_TIGHTEN == 0:
            loose /= 10
        admitted = below[
            field.image[below] + shift
            < -dilute_contact.ADMITTED_PENETRATION * np.sqrt(gaps @ gaps / gaps.size)
        ]
        if admitted.size:
            gaps = None  # frees memory
            points, pressure, gaps = _joined(grid, field, points, pressure, admitted, shift)
            precondition = None
        changed += admitted.size
        if precondition is None:
            precondition = Preconditioner(grid, points)
        spread, few = float(np.std(gaps)), changed <= _FEW_CHANGES * points.size
        reduction = min(loose, _REDUCTION_NEARLY_SETTLED) if few else loose
        goal = max(reduction * spread, 0.1 * tol) if changed else 0.5 * tol
        scale = spread or 1.0
        residuals = np.empty(gaps.size, np.float32)
        np.subtract(float(gaps.mean()), gaps, out=residuals, casting="same_kind")
        residuals /= np.float32(scale)
        gaps = None  # frees memory
        operators, left = (precondition, precondition.compliance), max_iterations - iterations
        change, count = close_gap(*operators, residuals, goal / scale, changed == 0, left)
        iterations += count
        change = np.multiply(change, scale, dtype=float)
        change -= change.mean()
        change += pressure
        pressure, change, residuals = change, None, None
        keep = pressure > 0
        changed = points.size - int(np.count_nonzero(keep))
        if changed:
            points, pressure = points[keep], pressure[keep]
            pressure *= total / pressure.sum()
            precondition = None
        changed += admitted.size
        field = grid.quick if residual > grid.single_limit else grid.exact
    candidates = precondition = None  # frees memory
    return _state(grid, best, field, pressure, iterations)


def _full_contact(grid, load):
    """Full contact of any surface: the pressure that displaces the solid by the heights."""
    operator = grid.exact.operator
    pressure = operator.stiffness(grid.heights.astype(operator.dtype, copy=False))
    misfit = operator.compliance(pressure)
    misfit -= grid.heights
    residual = float(np.abs(misfit).max())
    pressure += load
    misfit[...] = 0
    return State(pressure, misfit, 0.0, 1.0, residual, 0, grid.pairs)


def _gap(grid, field, points, pressure):
    """Shift, gaps in contact, points that penetrate outside it, and residual of an iterate.

    The shift makes the mean gap in contact vanish; the image of `field` keeps the gap without it.
    """
    image = grid.displace(field, points, pressure)
    sharing.evaluate(np.subtract, image, image, grid.heights.ravel())
    gaps = sharing.take(image, points).astype(float, copy=False)
    shift = float(-gaps.mean())
    gaps += shift
    sharing.put(grid.active, points, True)
    below = sharing.find(lambda c: (image[c] < -shift) & ~grid.active[c], image.size)
    sharing.put(grid.active, points, False)
    depth = float(-(image[below].min() + shift)) if below.size else 0.0
    return shift, gaps, below, max(float(np.abs(gaps).max()), depth)


def _highest(problem):
    """Points that may touch, for want of a guess: the highest, many of them; all at a high load."""
    heights, sure = problem.heights, problem.periodic and problem.solid == HALF_SPACE
    # at small loads
    area = 2 * problem.load / (half_space.measure_slope(heights, problem.sides) or 1.0)
    count = int(_FIRST_SET_FACTOR * area * heights.size) + 1
    if not sure or count > _LARGEST_FIRST_SET * heights.size:
        return np.arange(heights.size)
    return np.sort(np.argpartition(heights.ravel(), -count)[-count:])


def _predicted_from_gap(grid, gap, load):
    """Contact set and pressure that a guess of the gap implies: inside contact both are good."""
    operator, surface, pressure = grid.quick.operator, grid.quick.image, grid.scratch  # free yet
    gap = gap.ravel()
    sharing.evaluate(np.add, surface, gap, grid.heights.ravel())
    operator.stiffness(surface.reshape(grid.shape), pressure.reshape(grid.shape))
    weight, mean = np.float32(PREDICTION * operator.mean_stiffness), np.float32(load)
    points = sharing.find(lambda c: pressure[c] + mean > np.maximum(gap[c] * weight, 0), gap.size)
    if points.size == 0:
        points = np.array([np.argmax(pressure)])
    touching = (sharing.take(pressure, points) + mean).astype(float)
    return points, _balanced(np.maximum(touching, 0), load * gap.size)


def _predicted_from_pressure(grid, pressure, total):
    flat = pressure.ravel()
    points = np.flatnonzero(flat > 0)
    field = grid.exact if grid.periodic else grid.quick
    shift, *_ = _gap(grid, field, points, _balanced(flat[points], total))
    threshold = field.image
    threshold += threshold.dtype.type(shift)
    threshold *= PREDICTION * field.operator.mean_stiffness * (flat.sum() / total)
    predicted = np.flatnonzero(flat > np.maximum(threshold, 0, out=threshold))
    points = predicted if predicted.size else points
    return points, _balanced(flat[points], total)


def _balanced(pressure, total):
    pressure = pressure.astype(float, copy=False)  # single precision would upset the balance
    force = pressure.sum()
    if force > 0:
        return pressure * (total / force)
    return np.full(pressure.size, total / pressure.size)


def _joined(grid, field, points, pressure, extra, shift):
    at = np.searchsorted(points, extra)
    points = np.insert(points, at, extra)
    # In the precision of the grid, be it single.
    pressure = np.insert(pressure.astype(grid.exact.image.dtype, copy=False), at, 0).astype(float)
    return points, pressure, sharing.take(field.image, points).astype(float, copy=False) + shift


def _state(grid, best, field, last, iterations):
    touching, pressure, shift, residual = best
    # The image may belong to a later, worse iterate, or be in single precision.
    if pressure is not last or field is not grid.exact:
        shift, *_, residual = _gap(grid, grid.exact, touching, pressure)
    gap = grid.exact.image
    filled = np.zeros_like(gap)
    sharing.evaluate(lambda g: np.maximum(g + g.dtype.type(shift), 0), gap, gap)
    sharing.put(gap, touching, 0)
    sharing.put(filled, touching, pressure)
    fields, area = (filled.reshape(grid.shape), gap.reshape(grid.shape)), touching.size / gap.size
    return State(*fields, shift, area, residual, iterations, grid.pairs)
