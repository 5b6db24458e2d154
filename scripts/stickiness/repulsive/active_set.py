"""Active-set iteration of the repulsive contact problem, in dimensionless variables.

For a guess of the contact set, preconditioned conjugate gradients solve ``g = 0`` there for the
pressure. Points under tension are released and points that penetrate are added, until neither is
left. Where sets cycle, as on long strips, all points are the next set, and none is added until none
is under tension. Between updates of the set the pressure is corrected in single precision; the next
update starts from the gap computed anew (iterative refinement), in double precision as soon as
rounding matters. Below a per cent of contact only points that may touch take part
(`dilute_contact`), and with free edges their displacement is added up without a convolution on the
whole grid (`free_edges`).
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
_SPLIT_LIMIT = (
    1e-9  # of the largest height: a smaller tolerance needs a convolution of the whole grid
)
_LARGEST_KEPT = 2**22  # points: beyond this memory is dearer than the time to make operators again
# Updates without progress …
_STALLED_UPDATES_TO_RESTART = 5  # … after which it begins again; square grids have at most 3
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
    mirrored: bool = False  #: periodic together with its mirror images

    def operator(self, dtype):
        """Compliance on this grid, and its inverse, be it approximate."""
        return half_space.half_space(
            shape=self.heights.shape,
            lengths=self.sides,
            dtype=dtype,
            solid=self.solid,
            periodic=self.periodic,
            mirrored=self.mirrored,
            kept=self.heights.size <= _LARGEST_KEPT,
        )


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
        self.operator = operator
        self.shape = operator.shape
        self.image = memory.view(operator.dtype)[: self.shape[0] * self.shape[1]]

    def apply(self, operation, points, values, rows_in, rows_out=None):
        """Image of a field that is zero but for `values` at `points`; `image` holds it."""
        image = self.image.reshape(self.shape)
        sharing.evaluate(lambda: 0, self.image)
        sharing.put(self.image, points, values)
        operation(image, image, rows_in, rows_out)
        return self.image


class _Grid:
    """Heights on a grid, with scratch fields in single and, if needed, in double precision."""

    def __init__(self, problem, approximate, tol=0.0):
        self.heights = problem.heights
        self.shape = problem.heights.shape
        self.sides = problem.sides
        self.solid = problem.solid
        self.periodic = problem.periodic
        self.mirrored = problem.mirrored
        self.active = np.zeros(self.heights.size, bool)
        # One array in double precision, or two in single: an image is read before the next is made.
        memory = convolution.aligned_zeros(self.heights.size, np.float64)
        self.scratch = memory.view(np.float32)[self.heights.size :]
        self.exact = _Field(problem.operator(np.float32 if approximate else np.float64), memory)
        self.quick = self.exact if approximate else _Field(problem.operator(np.float32), memory)
        # Below this residual rounding in single precision (some 1e-6 of the heights) is felt.
        largest = max(float(self.heights.max()), -float(self.heights.min()))
        if not problem.periodic:  # an absolute displacement is about as large as this
            largest = max(largest, problem.load)
        self.single_limit = 0.0 if approximate else _SINGLE_PRECISION_LIMIT * largest
        self.splits = not problem.periodic and tol > _SPLIT_LIMIT * largest
        self._operators = {self.quick.operator, self.exact.operator}
        self.spent = 0.0  # convolutions on coarser grids, by their share of the points
        self.spent = -self.pairs  # operators are shared: count from now on

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


def relax(problem, guess, *, tol, max_iterations, approximate=False):
    """Find pressure and gap on one grid; returns the iterate of the smallest residual.

    It starts from what the mapping `guess` has: a "gap" in single precision, which is taken out of
    the mapping to free its memory, or a "pressure" of any positive mean. Without a guess it starts
    from a uniform pressure on the highest points. With `approximate`, single precision suffices:
    `tol` is well above 1e-5.
    """
    # Where active sets are known to converge; elsewhere `projected_gradients` takes over.
    sure = problem.solid == HALF_SPACE and problem.periodic
    max_stalled = _MAX_STALLED_UPDATES if sure else _MAX_STALLED_UNSURE
    grid = _Grid(problem, approximate, tol)
    field = grid.exact if problem.periodic and "pressure" in guess else grid.quick
    contact = _first_contact(problem, grid, guess)
    if contact.points.size == problem.heights.size and problem.periodic:
        full = _full_contact(grid, problem.load)
        if full.pressure.min() >= 0:
            return full
    dilute = dilute_contact.is_worthwhile(grid, contact.points.size)
    candidates = None
    best = None
    iterations = 0
    stalled = 0
    while True:
        # Measure the gap in single precision, and once more in double before it is believed.
        contact.measure(field)
        if contact.residual <= tol and field is not grid.exact:
            field = grid.exact
            continue

        # Keep the best iterate, and end where it is good enough or no better one is in sight.
        stalled += not contact.shrinks
        if best is None or contact.residual < best.residual:
            best = contact.iterate()
            stalled = 0
        # A single point carries the whole load.
        settled = contact.residual <= tol or contact.below.size + contact.points.size == 1
        if settled or iterations >= max_iterations or stalled > max_stalled:
            break

        # Where few points touch, correct the pressure among those that may touch.
        if dilute and stalled < _MAX_STALLED_DILUTE:
            candidates = dilute_contact.select_candidates(
                grid, candidates, contact.points, contact.below, field.image, contact.shift
            )
        else:
            candidates = None
        dilute = candidates is not None
        if dilute:
            iterations += contact.correct_among(
                candidates, field, goal=0.3 * tol, limit=max_iterations - iterations
            )
            # The residual is that before the correction, which lowers it a hundredfold.
            field = grid.quick if contact.residual > 10 * grid.single_limit else grid.exact
            continue

        # Where sets cycle, begin again with all points.
        if stalled == _STALLED_UPDATES_TO_RESTART and not contact.shrinks:
            points = np.arange(problem.heights.size)
            pressure = np.full(points.size, problem.load)
            contact = _Contact(grid, points, pressure, contact.total, shrinks=True)
            contact.measure(field)

        # Otherwise correct it on the contact set: admit what penetrates, close the gap in contact,
        # release what is under tension.
        admitted = contact.admit_penetrating(field)
        iterations += contact.correct(tol, limit=max_iterations - iterations)
        contact.release_tension()
        contact.changed += admitted
        field = grid.quick if contact.residual > grid.single_limit else grid.exact
    candidates = None  # frees memory
    contact.precondition = None
    return _state(grid, best, field, contact.pressure, iterations)


@dataclass(frozen=True, eq=False)
class _Iterate:
    """Contact set with its pressure, and how well it meets the contact conditions."""

    points: np.ndarray
    pressure: np.ndarray
    shift: float
    residual: float


class _Contact:
    """Contact set, flat and increasing `points`, and the `pressure` on it, which updates change.

    A set that `shrinks` admits no point until none is under tension, so that it cannot cycle. If it
    begins with all points, it ends near the solution, because the stiffness of a half-space is
    nearly an M-matrix (Hintermüller, Ito and Kunisch, SIAM J. Optim. 13:865, 2002, doi
    10.1137/S1052623401383558).
    """

    def __init__(self, grid, points, pressure, total, shrinks=False):
        self.grid = grid
        self.points = points
        self.pressure = pressure
        self.total = total  # of the pressure over all points
        self.precondition = None  # of this set, made when it is needed
        self.changed = points.size  # points that the last update admitted or released
        self.shrinks = shrinks

    def measure(self, field):
        """Measure the gap, whose image stays in `field`, and how it violates contact conditions."""
        self.shift, self.gaps, self.below, self.residual = _gap(
            self.grid, field, self.points, self.pressure
        )

    def iterate(self):
        """Return what was measured last, without the gap."""
        return _Iterate(self.points, self.pressure, self.shift, self.residual)

    def correct_among(self, candidates, field, goal, limit):
        """Correct set and pressure among few candidates; returns the number of iterations."""
        gap = field.image[candidates.points].astype(float) + self.shift
        self.points, self.pressure, count = candidates.correct_pressure(
            self.points, self.pressure, gap, goal, limit
        )
        return count

    def admit_penetrating(self, field):
        """Admit, without pressure, points that penetrate deep; returns their number."""
        if self.shrinks:
            return 0
        rms_gap = np.sqrt(self.gaps @ self.gaps / self.gaps.size)
        deepest_allowed = -dilute_contact.ADMITTED_PENETRATION * rms_gap
        admitted = self.below[field.image[self.below] + self.shift < deepest_allowed]
        if admitted.size:
            self.gaps = None  # frees memory
            places = np.searchsorted(self.points, admitted)
            self.points = np.insert(self.points, places, admitted)
            # Rounded to the precision of the grid.
            pressure = self.pressure.astype(self.grid.exact.image.dtype, copy=False)
            self.pressure = np.insert(pressure, places, 0).astype(float)
            gaps = sharing.take(field.image, self.points)
            self.gaps = gaps.astype(float, copy=False) + self.shift
            self.precondition = None
        self.changed += admitted.size
        return admitted.size

    def correct(self, tol, limit):
        """Change the pressure so as to close the gap in contact; returns the number of iterations.

        Points may come under tension. The gap is given up, which frees its memory.
        """
        if self.precondition is None:
            self.precondition = Preconditioner(self.grid, self.points)
        # A set that still changes much is not worth a small gap.
        spread = float(np.std(self.gaps))
        settles = self.shrinks or self.changed <= _FEW_CHANGES * self.points.size
        reduction = _REDUCTION_NEARLY_SETTLED if settles else _REDUCTION_WHILE_CHANGING
        goal = max(reduction * spread, 0.1 * tol) if self.changed else 0.5 * tol
        # In single precision, of numbers about one.
        scale = spread or 1.0
        residuals = np.empty(self.gaps.size, np.float32)
        np.subtract(float(self.gaps.mean()), self.gaps, out=residuals, casting="same_kind")
        residuals /= np.float32(scale)
        self.gaps = None
        change, count = close_gap(
            precondition=self.precondition,
            compliance=self.precondition.compliance,
            residual=residuals,
            goal=goal / scale,
            largest=self.changed == 0,
            limit=limit,
        )
        # The load stays: the change has no mean.
        change = np.multiply(change, scale, dtype=float)
        change -= change.mean()
        change += self.pressure
        self.pressure = change
        return count

    def release_tension(self):
        """Release the points under tension, and balance the load."""
        keep = self.pressure > 0
        self.changed = self.points.size - int(np.count_nonzero(keep))
        if self.changed:
            self.points = self.points[keep]
            self.pressure = self.pressure[keep]
            self.pressure *= self.total / self.pressure.sum()
            self.precondition = None
        else:
            self.shrinks = False


def _first_contact(problem, grid, guess):
    """First contact set and pressure, from a guess of gap or pressure, or from heights alone."""
    total = problem.load * problem.heights.size
    gap = guess.pop("gap", None)
    if gap is not None:
        points, pressure = _predicted_from_gap(grid, gap, problem.load)
    elif "pressure" in guess:
        points, pressure = _predicted_from_pressure(grid, guess["pressure"], total)
    else:
        points = _highest(problem)
        pressure = np.full(points.size, total / points.size)
    return _Contact(grid, points, pressure, total)


def _full_contact(grid, load):
    """Full contact of any surface: the pressure that displaces the solid by the heights."""
    operator = grid.exact.operator
    pressure = operator.stiffness(grid.heights.astype(operator.dtype, copy=False))
    misfit = operator.compliance(pressure)
    misfit -= grid.heights
    residual = float(np.abs(misfit).max())
    pressure += load
    misfit[...] = 0
    return State(
        pressure=pressure,
        gap=misfit,
        shift=0.0,
        area_fraction=1.0,
        residual=residual,
        iterations=0,
        fft_pairs=grid.pairs,
    )


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
    heights = problem.heights
    sure = problem.periodic and problem.solid == HALF_SPACE
    # Share of the area in contact at small loads, A/A0 = 2 p/(E* h'_rms).
    area = 2 * problem.load / (half_space.measure_slope(heights, problem.sides) or 1.0)
    count = int(_FIRST_SET_FACTOR * area * heights.size) + 1
    if not sure or count > _LARGEST_FIRST_SET * heights.size:
        return np.arange(heights.size)
    return np.sort(np.argpartition(heights.ravel(), -count)[-count:])


def _predicted_from_gap(grid, gap, load):
    """Contact set and pressure that a guess of the gap implies: inside contact both are good."""
    operator = grid.quick.operator
    # Two scratch fields that nothing uses yet.
    surface = grid.quick.image
    pressure = grid.scratch
    # The pressure that displaces the solid by gap plus heights, without its mean.
    gap = gap.ravel()
    sharing.evaluate(np.add, surface, gap, grid.heights.ravel())
    operator.stiffness(surface.reshape(grid.shape), pressure.reshape(grid.shape))
    # Contact is where p > c k g.
    weight = np.float32(PREDICTION * operator.mean_stiffness)
    mean = np.float32(load)
    points = sharing.find(lambda c: pressure[c] + mean > np.maximum(gap[c] * weight, 0), gap.size)
    if points.size == 0:
        points = np.array([np.argmax(pressure)])
    touching = (sharing.take(pressure, points) + mean).astype(float)
    return points, _balanced(np.maximum(touching, 0), load * gap.size)


def _predicted_from_pressure(grid, pressure, total):
    """Contact set and pressure by a guess of the pressure, which implies the gap."""
    flat = pressure.ravel()
    points = np.flatnonzero(flat > 0)
    field = grid.exact if grid.periodic else grid.quick
    shift, *_ = _gap(grid, field, points, _balanced(flat[points], total))
    # Contact is where p > c k g. The guess has another mean, and pressures scale with it.
    threshold = field.image
    threshold += threshold.dtype.type(shift)
    threshold *= PREDICTION * field.operator.mean_stiffness * (flat.sum() / total)
    predicted = np.flatnonzero(flat > np.maximum(threshold, 0, out=threshold))
    points = predicted if predicted.size else points
    return points, _balanced(flat[points], total)


def _balanced(pressure, total):
    """Pressure scaled to a total; a uniform one if there is none."""
    pressure = pressure.astype(float, copy=False)  # single precision would upset the balance
    force = pressure.sum()
    if force > 0:
        return pressure * (total / force)
    return np.full(pressure.size, total / pressure.size)


def _state(grid, best, field, last_pressure, iterations):
    """Fields on the grid of the best iterate, whose gap and residual are in double precision."""
    shift = best.shift
    residual = best.residual
    # The image may belong to a later, worse iterate, or be in single precision.
    if best.pressure is not last_pressure or field is not grid.exact:
        shift, _, _, residual = _gap(grid, grid.exact, best.points, best.pressure)
    gap = grid.exact.image
    pressure = np.zeros_like(gap)
    sharing.evaluate(lambda g: np.maximum(g + g.dtype.type(shift), 0), gap, gap)
    sharing.put(gap, best.points, 0)
    sharing.put(pressure, best.points, best.pressure)
    return State(
        pressure=pressure.reshape(grid.shape),
        gap=gap.reshape(grid.shape),
        shift=shift,
        area_fraction=best.points.size / gap.size,
        residual=residual,
        iterations=iterations,
        fft_pairs=grid.pairs,
    )
