"""What scanning leaves in a map of heights, found and mended.

Scanning probes and line scanners take a map row by row, and what happens between or within rows is
no roughness:

- rows at random heights, or tilted at random;
- a jump of the probe between two rows, or a seam between two tiles;
- creep after the start, slow drift, and the bow of a scanner: a smooth function of one coordinate;
- scars: short streaks in one to four rows, off the rows above and below, which agree;
- hum: pickup of the mains, which is one wave in the order of the samples, and so one of the map.

Each is looked for along both axes, since either may be the fast one. A fault must be the same in
separate parts of a row, as roughness is not, and must change from row to row as no lay does:

- Offsets of rows are white, so that neighbouring differences of them have the correlation -1/2.
  Those of a profile with Hurst exponent H along the lay have 2^(2H - 1) - 1, which is above -1/4
  for H > 0.3, and that of waves which the grid resolves is positive. The noise of single points is
  white, too, but differs between parts of a row.
- A jump happens between two rows, an edge of the surface wanders or is blurred. But an edge that is
  parallel to the rows looks the same, and no data alone can tell: that is a question.
- Creep relaxes from one side of the map. For drift and bow as for waves along the lay there is no
  such sign: they are found if next to nothing else is left in the profile. A surface may have such
  a form, too, which is a question again.
- Hum is one wave across all of the map, far above those beside it, and often shorter than four
  points along an axis, as no resolved wave of a surface is. Marks of machining have harmonics
  there, below a stronger longer wave. An oblique longer one is left, with a question whether it is
  hum; marks along an axis are left.

Limits were chosen on 1918 maps without faults, of 160 x 160 points: 14 families, self-affine maps
of H = 0.3 to 1 whose lay is up to 40 times as long as wide, along, across and oblique to the rows,
and profiles that are the same in all rows. Of creep and drift they were also tried on 1170 parts of
larger maps. None was touched (95 %: below 1 in 600). Profiles that are exactly the same in all rows
and have waves as short as two points are taken for offsets in 2.5 % if H = 0.3, in 0.2 % if H = 0.4
(128 rows). Of white offsets, 0.4 % of maps with 128 rows and 40 % with 64 are missed. Hum was tried
on 1080 maps of 100 to 300 points of these and other families, turned ones oblique to the rows among
them: of one crossed grating out of 60 a harmonic was taken for hum, else of none. Of 1080 maps with
hum of any period and 5 to 50 % of their rms height, it was subtracted in half, and asked about in a
quarter; up to 9 % of its height was left.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
import scipy
from numpy.typing import NDArray

from stickiness.formatting import amount

FEWEST_POINTS = 32  #: along a side
CLIPPED = 4.0  #: robust standard deviations to which differences are clipped for correlations
#: Correlation between both estimates of the offsets, or tilts, of rows, above which rows have them
LEAST_COMMON = {"offset": 0.4, "tilt": 0.75}
WHITEST = -1 / 3  #: correlation of neighbouring differences, below which offsets are white, ...
WHITEST_ERRORS = 3.5  #: ... and how many standard errors of no correlation it is below 0
LARGEST_LINE = 0.25  #: share of one wave in the differences; more is a pattern that is not resolved
OUTSTANDING_JUMP = 8.0  #: robust standard deviations of the differences between rows
LEAST_CONSTANT = 0.25  #: by which a jump may vary along the row, and what is left beside it
LEAST_SEAM = 0.7  #: share of the parts of a row that jump at a seam between tiles
MOST_JUMPS = 3  #: more are steps or lines of the surface
#: Share of the variance of the medians of rows above which creep, or a polynomial of fourth degree
#: as of drift and bow, is all of it (at most 0.91 and 0.994 without a fault) ...
LEAST_OF_PROFILE = {"creep": 0.95, "drift": 0.995}
#: ... or of that of all heights (at most 0.42 and 0.71), ...
LEAST_OF_ALL = {"creep": 0.55, "drift": 0.9}
#: Variance of the third and fourth degree over that within rows, below which drift is a parabola
LEAST_HIGHER = 0.1
LEAST_ALIKE = 1 / 3  #: ratio of the curvatures along both axes above which they are those of a form
DECAYS = 8  #: exponentials of which creep is made
LARGEST_LAY = 0.12  #: ... if the rest of the medians has so little of the variance within rows
#: Height of a scar in robust standard deviations of heights from the mean of both rows beside them
LEAST_SCAR = 8.0
FAINT_SCAR = 5.0  #: the same where other streaks are scars
TAIL = 0.5  #: least standard deviation over the 90 % quantile; 0.61 of Gaussian heights
SCAR_ENDS = 2.5  #: the same above which a streak goes on
SCARS_ALONG = 4  #: times as many along the fast axis as along the other
SAMPLE = 1e5  #: points of which standard deviations are taken
SHORTEST_SCAR = 8  #: points
WIDEST_SCAR = 4  #: rows
FAINTEST = 1 / 3  #: of its height that is left two points beyond the sharp end of a scar
LEAST_LINE = 300.0  #: power of hum over the mean of the waves beside it
BESIDE_LINE = 10  #: waves on either side that are those beside it; but for the next two
SHORTEST_WAVE = 4.0  #: points; shorter ones are no resolved waves of a surface
MOST_LINES = 4  #: hum and its harmonics
LARGEST_EFFECT = 30.0  #: rms of what was removed over that of what is left; more is not judged
MOST_NAMED = 4  #: rows in a remark

Scan = Literal["detect", "mend", "align", "keep"]


@dataclass
class Mended:
    """Heights of a map without what scanning left in it."""

    heights: NDArray  #: NaN in scars, else as given where nothing was found
    remarks: list[str] = field(default_factory=list)  #: what was found and done
    questions: list[str] = field(default_factory=list)  #: whether it may belong to the surface
    kept: str = ""  #: question about what may be a fault and was left
    doubts: list[str] = field(default_factory=list)  #: why no verdict should rest on the heights

    def subtract(self, fault: NDArray, remark: str, question: str = "") -> None:
        """Take a fault off the heights, or what may be one, with the question whether it is."""
        self.heights = self.heights - fault
        self.remarks.append(remark)
        if question:
            self.questions.append(question)


def mend(heights: NDArray, scan: Scan = "detect", scale: float = 1.0) -> Mended:
    """Find and mend what scanning left in a map.

    Parameters
    ----------
    heights : (nx, ny) array
        Heights as read, NaN where missing.
    scan : {"detect", "mend", "align", "keep"}
        "detect", "mend": mend what is found. What may also belong to the surface is a question to
        the user, unless "mend" answers it. "align": also set the median of every row to zero, which
        takes the surface's own waves along the slow axis, too. "keep": nothing.
    scale : float
        Metres per unit of `heights`, for remarks.

    Returns
    -------
    Mended

    Examples
    --------
    >>> x, y = np.meshgrid(np.arange(64.0), np.arange(64.0), indexing="ij")
    >>> smooth = np.cos(x / 5) * np.cos(y / 7 + x / 9)
    >>> jumped = smooth + 3.0 * (y >= 40)
    >>> mended = mend(jumped, scale=1e-9)
    >>> print(mended.remarks[0])
    from row 40 along y on, heights were 3 nm off, as a probe jumps: they were moved back
    >>> print(mended.questions[0])
    did the probe jump by 3 nm at row 40 along y, or does the surface have a step there?
    >>> mend(smooth).heights is smooth
    True
    """
    mended = Mended(heights)
    if scan == "keep" or heights.ndim != 2 or min(heights.shape) < FEWEST_POINTS:
        return mended
    if np.isfinite(heights).sum() < heights.size / 2 or not np.nanstd(heights) > 0:
        return mended
    for axis in (0, 1):
        for look_for in (_move_back_jumps, _align_rows, _subtract_smooth):
            look_for(mended, axis, scale)
    _subtract_hum(mended, scale, all_of_it=scan == "mend")
    scars = [_find_scars(_rows(mended.heights, axis)) for axis in (0, 1)]
    certain = [sum(scar.height > LEAST_SCAR for scar in of_axis) for of_axis in scars]
    across = int(np.argmax(certain))
    if certain[across] > SCARS_ALONG * certain[1 - across]:
        _mask_scars(mended, across, scars[across], scale)
    if scan == "align":
        slow = find_slow_axis(heights, across if any(certain) else 1)
        medians = _medians_of_rows(_rows(mended.heights, slow))
        mended.subtract(
            np.expand_dims(medians, 1 - slow),
            f"every row along {'xy'[1 - slow]} was set to the median 0 (scan: align)",
        )
    _doubt_effect(mended, heights)
    return mended


def find_slow_axis(heights: NDArray, default: int = 1) -> int:
    """Axis along which rows at random heights or tilts follow each other."""
    for axis in (0, 1):
        quarters = _block_medians(_rows(heights, axis), 4)
        if _has_white(quarters, "offset") or _has_white(quarters, "tilt"):
            return axis
    return default


def _rows(heights: NDArray, axis: int) -> NDArray:
    """Heights as an array of rows that follow each other along an axis."""
    return heights if axis == 0 else heights.T


def _medians_of_rows(rows: NDArray) -> NDArray:
    """Median of every row; between its neighbours if all of the row is missing."""
    is_known = np.isfinite(rows).any(axis=1)
    medians = np.full(len(rows), np.nan)
    of_known = rows[is_known]
    is_complete = np.isfinite(of_known).all()
    medians[is_known] = (np.median if is_complete else np.nanmedian)(of_known, axis=1)
    places = np.arange(len(rows))
    return np.interp(places, places[is_known], medians[is_known])


def _block_medians(rows: NDArray, count: int) -> NDArray:
    """Medians of differences between neighbouring rows in equal parts of the rows.

    A part without any point has the mean of the others.
    """
    medians = np.full((len(rows) - 1, count), np.nan)
    for place, part in enumerate(np.array_split(np.diff(rows, axis=0), count, axis=1)):
        if np.isfinite(part).any():
            medians[:, place] = _medians_of_rows(part)
    return np.where(np.isnan(medians), np.nanmean(medians, axis=1, keepdims=True), medians)


def _spread(steps: NDArray) -> NDArray:
    """Robust standard deviation."""
    return 1.4826 * np.nanmedian(np.abs(steps - np.nanmedian(steps, axis=0)), axis=0)


# Rows at random heights or tilts.


def _has_white(quarters: NDArray, kind: str, least_common: float | None = None) -> bool:
    """Whether rows have random offsets or tilts, by steps between quarters of them.

    Two estimates of these steps must agree and be differences of noise. The outer and the inner
    quarters are used apart, so that neither estimate of offsets contains a tilt, and points that
    are noise have no correlation.
    """
    first, second, third, fourth = quarters.T
    if kind == "offset":
        estimates = np.array([first + fourth, second + third])
    else:
        estimates = np.array([(fourth - first) / 3, third - second])
    middle = np.median(estimates, axis=1, keepdims=True)
    limit = CLIPPED * _spread(estimates.T)[:, None]
    outer, inner = np.clip(estimates - middle, -limit, limit)
    outer = outer - outer.mean()
    inner = inner - inner.mean()
    size = np.sqrt((outer @ outer) * (inner @ inner))
    covariance = outer @ inner
    if not (size > 0 and covariance > 0):
        return False
    # Correlation of neighbouring steps, and the share of the strongest wave.
    beside = (outer[1:] @ inner[:-1] + inner[1:] @ outer[:-1]) / 2
    power = np.abs(np.fft.rfft(outer + inner)[1:]) ** 2
    is_common = covariance / size > (least_common or LEAST_COMMON[kind])
    is_white = beside / covariance < min(WHITEST, -WHITEST_ERRORS / np.sqrt(len(quarters)))
    return bool(is_common and is_white and power.max() / power.sum() < LARGEST_LINE)


def _align_rows(mended: Mended, axis: int, scale: float) -> None:
    """Align rows by medians of their differences, less what is smooth over several rows."""
    rows = _rows(mended.heights, axis)
    quarters = _block_medians(rows, 4)
    shifted = _has_white(quarters, "offset")
    # Where rows have offsets, tilts need less evidence.
    tilted = _has_white(quarters, "tilt", LEAST_COMMON["offset"] if shifted else None)
    if not (shifted or tilted):
        return
    steps = _medians_of_rows(np.diff(rows, axis=0))
    offsets = _white_noise(np.append(0.0, np.cumsum(steps)))
    fault = np.broadcast_to(offsets[:, None], rows.shape)
    if tilted:
        # Medians of quarters stand for their middles; the least-squares line through the four.
        slopes = quarters @ np.array([-3.0, -1.0, 1.0, 3.0]) * 8 / 20
        tilts = _white_noise(np.append(0.0, np.cumsum(slopes)))
        fault = fault + tilts[:, None] * (np.arange(rows.shape[1]) / rows.shape[1] - 0.5)
    along = "xy"[1 - axis]
    height = amount(float(np.std(offsets)) * scale, "m", 2)
    what = "heights and tilts" if tilted else "heights"
    mended.subtract(
        _rows(fault, axis),
        f"rows along {along} are at random {what} (rms {height}), as scanning leaves them: they "
        "were aligned by medians of differences",
    )


def _white_noise(profile: NDArray) -> NDArray:
    """Part of a profile that a smoother leaves, with the smoothness by cross-validation.

    Waves of the surface are smooth over several rows and stay; all that is left of the noise in
    them is what a mean over as many rows leaves.
    """
    n = len(profile)
    places = np.linspace(-1, 1, n)
    line = np.polynomial.Polynomial.fit(places, profile, 1)
    modes = scipy.fft.dct(profile - line(places), norm="ortho")
    stiffness = (2 * np.sin(np.pi * np.arange(n) / (2 * n))) ** 4
    best = np.inf
    noise = modes
    for weight in np.geomspace(0.1, 1e9, 51):
        share_left = weight * stiffness / (1 + weight * stiffness)
        score = np.mean((share_left * modes) ** 2) / np.mean(share_left) ** 2
        if score < best:
            best = score
            noise = share_left * modes
    return scipy.fft.idct(noise, norm="ortho")


# Jumps between two rows.


def _move_back_jumps(mended: Mended, axis: int, scale: float) -> None:
    """Subtract jumps that happen between two rows and are the same along them."""
    rows = _rows(mended.heights, axis)
    # Steps between rows, in eight parts of them.
    parts = _block_medians(rows, 8)
    parts = parts - np.median(parts)
    steps = np.median(parts, axis=1)
    noise = _spread(parts.ravel())

    # Jumps and seams stand out from the steps before and behind, as creep does not.
    mean_size = np.abs(parts).mean(axis=1)
    is_sharp = np.zeros(len(steps), dtype=bool)
    is_sharp[1:-1] = np.maximum(mean_size[:-2], mean_size[2:]) < LEAST_CONSTANT * mean_size[1:-1]
    variation = np.abs(parts - steps[:, None]).max(axis=1)
    is_constant = variation < np.maximum(LEAST_CONSTANT * np.abs(steps), CLIPPED * noise)

    # A seam differs along the row.
    differs = ~is_constant & (variation > OUTSTANDING_JUMP * noise)
    share_of_parts = (np.abs(parts) > OUTSTANDING_JUMP * noise).mean(axis=1)
    seams = np.flatnonzero(is_sharp & differs & (share_of_parts > LEAST_SEAM))
    if 0 < len(seams) <= MOST_JUMPS:
        mended.doubts.append(
            f"heights jump all along row {seams[0] + 1} along {'xy'[axis]}, by different amounts, "
            "as where tiles are stitched: give the map of one tile; scan: keep judges it as it is"
        )

    # A jump is the same in all of the row, and does not go back as at a printed line.
    is_jump = is_sharp & is_constant & (np.abs(steps) > OUTSTANDING_JUMP * _spread(steps))
    places = np.flatnonzero(is_jump)
    sums = np.abs(steps[places][:-1] + steps[places][1:])
    goes_back = bool((sums < LEAST_CONSTANT * np.abs(steps[places][1:])).any())
    if not 0 < len(places) <= MOST_JUMPS or goes_back:
        return
    # What is usual between these rows is not of the jump.
    usual = [np.median(np.delete(steps[max(i - 3, 0) : i + 4], min(i, 3))) for i in places.tolist()]
    jumps = np.zeros(len(rows))
    jumps[places + 1] = steps[places] - usual
    numbers = " and ".join(str(place + 1) for place in places)
    where = f"{('column', 'row')[axis]} {numbers} along {'xy'[axis]}"
    heights = " and ".join(amount(abs(jump) * scale, "m", 2) for jump in jumps[places + 1])
    mended.subtract(
        np.expand_dims(np.cumsum(jumps), 1 - axis),
        f"from {where} on, heights were {heights} off, as a probe jumps: they were moved back",
        f"did the probe jump by {heights} at {where}, or does the surface "
        f"have {'a step' if len(places) == 1 else 'steps'} there?",
    )


# Creep, drift and bow.


def _subtract_smooth(mended: Mended, axis: int, scale: float) -> None:
    """Subtract creep or drift that is nearly all of the profile of the rows' medians."""
    rows = _rows(mended.heights, axis)
    profile = _medians_of_rows(rows)
    points = len(profile)
    line = _polynomials(points)[:, :2]

    def less_line(curve: NDArray) -> NDArray:
        return curve - line @ (line.T @ curve)

    level = less_line(profile)
    variance = np.var(level)
    within_rows = max(float(np.nanvar(rows)) - float(np.var(profile)), 0.0)

    def is_nearly_all(kind: str, fault: NDArray) -> bool:
        left = np.var(level - less_line(fault))
        share = (variance - left) / max(variance + within_rows, np.finfo(float).tiny)
        is_all_of_profile = left < (1 - LEAST_OF_PROFILE[kind]) * variance
        is_most = share > LEAST_OF_ALL[kind] and left < LARGEST_LAY * within_rows
        return bool(is_all_of_profile or is_most)

    quartic, is_form = _fit_drift(mended.heights, level, axis, within_rows)
    if is_nearly_all("creep", _fit_creep(level, less_line, longest=points / 8)):
        fault = _fit_creep(level, less_line, longest=points / 2)
        what = "creep after the start"
    elif is_nearly_all("drift", quartic) and not is_form:
        fault = quartic
        what = "drift or the bow of a scanner"
    else:
        return
    height = amount(float(np.ptp(fault)) * scale, "m", 2)
    mended.subtract(
        np.expand_dims(fault, 1 - axis),
        f"heights follow a smooth curve along {'xy'[axis]}, the same in all rows (range {height}), "
        f"as {what}: it was subtracted",
        f"is the smooth curve of {height} along {'xy'[axis]}, the same in all rows, {what}, or has "
        "the surface this form?",
    )


def _polynomials(n: int) -> NDArray:
    """Orthonormal polynomials up to the fourth degree at `n` points."""
    return np.linalg.qr(np.polynomial.legendre.legvander(np.linspace(-1, 1, n), 4))[0]


def _fit_drift(heights: NDArray, level: NDArray, axis: int, within: float) -> tuple[NDArray, bool]:
    """Polynomial of fourth degree in a profile, and whether it is the form of a specimen.

    A parabola is left to levelling, which knows lenses; so is what curves alike along both axes.
    """
    n = len(level)
    basis = _polynomials(n)[:, 2:]
    coefficients = basis.T @ level
    is_parabola = float(np.sum(coefficients[1:] ** 2)) / n < LEAST_HIGHER * within
    other = _medians_of_rows(_rows(heights, 1 - axis))
    own_bend = coefficients[0] / n**2.5
    other_bend = _polynomials(len(other))[:, 2] @ other / len(other) ** 2.5
    alike = min(own_bend / other_bend, other_bend / own_bend) if own_bend * other_bend else 0.0
    return basis @ coefficients, is_parabola or alike > LEAST_ALIKE


def _fit_creep(level: NDArray, less_line: Callable[[NDArray], NDArray], longest: float) -> NDArray:
    """Best sum of exponentials of one sign that decay from one end, and a line."""
    n = len(level)
    places = np.arange(n)
    lengths = np.geomspace(1, longest, DECAYS)
    best = np.inf
    fault = np.zeros(n)
    for distance in (places, places[::-1]):
        decays = np.exp(-distance[:, None] / lengths)
        for sign in (1, -1):
            amplitudes, misfit = scipy.optimize.nnls(sign * less_line(decays), level)
            if misfit < best:
                best = misfit
                fault = sign * decays @ amplitudes
    return fault


# Hum.


def _subtract_hum(mended: Mended, scale: float, all_of_it: bool) -> None:
    """Subtract single waves; if `all_of_it`, also those that the surface may have."""
    for _ in range(MOST_LINES):
        heights = mended.heights
        wave = _find_line(heights)
        if wave is None:
            return
        period_x, period_y = 1 / np.abs(wave)
        told = f"{period_x:.3g} points along x and {period_y:.3g} points along y"
        places = np.meshgrid(*map(np.arange, heights.shape), indexing="ij")
        phase = 2 * np.pi * np.tensordot(wave, places, axes=1)
        basis = np.stack([np.cos(phase), np.sin(phase), np.ones_like(phase)], axis=-1)
        is_known = np.isfinite(heights)
        fitted = np.linalg.lstsq(basis[is_known], heights[is_known], rcond=None)[0]
        amplitude = amount(float(np.hypot(fitted[0], fitted[1])) * scale, "m", 2)
        if min(period_x, period_y) > SHORTEST_WAVE and not all_of_it:
            mended.kept = (
                f"is one wave of {amplitude}, of {told}, a pattern of the surface, or hum?"
            )
            return
        mended.subtract(
            basis[..., :2] @ fitted[:2],
            f"one wave of the amplitude {amplitude}, of {told}, is far above those beside it, as "
            "hum is: it was subtracted",
            f"is one wave of {amplitude}, of {told}, hum, as of the mains, or a pattern?",
        )


def _find_line(heights: NDArray) -> NDArray | None:
    """Waves per point, along x and y, of the strongest line of the spectrum, if it is oblique."""
    shape = heights.shape
    level = np.nan_to_num(heights - np.nanmean(heights))
    level = level * np.outer(*map(np.hanning, shape))
    power = np.abs(np.fft.fft2(level)) ** 2
    orders = [np.abs(np.fft.fftfreq(n, 1 / n)) for n in shape]
    is_form = np.maximum.outer(*orders) <= 2

    # Waves beside each: around it, and along both axes, on which lays and offsets of rows are.
    width = 2 * BESIDE_LINE + 1
    beside = np.zeros_like(power)
    for window in ((width, width), (width, 1), (1, width)):
        inner = np.minimum(window, 5)
        total, of_inner = (
            scipy.ndimage.uniform_filter(power, size, mode="wrap") * np.prod(size)
            for size in (window, inner)
        )
        beside = np.maximum(beside, (total - of_inner) / (np.prod(window) - np.prod(inner)))
    lines = np.where((power > LEAST_LINE * beside) & ~is_form, power, 0.0)
    i, j = np.unravel_index(np.argmax(lines), shape)
    if lines[i, j] == 0 or min(orders[0][i], orders[1][j]) <= 2:
        return None  # none, or marks along an axis

    # Its place between the waves of the grid.
    def lack(wave: NDArray) -> float:
        along_x, along_y = (
            np.exp(-2j * np.pi * each * np.arange(n)) for each, n in zip(wave, shape, strict=True)
        )
        return -float(np.abs(along_x @ level @ along_y))

    on_grid = np.array([np.fft.fftfreq(shape[0])[i], np.fft.fftfreq(shape[1])[j]])
    simplex = on_grid + np.array([[0, 0], [0.5, 0], [0, 0.5]]) / shape
    options = {"initial_simplex": simplex, "xatol": 1e-3 / max(shape)}
    return np.asarray(
        scipy.optimize.minimize(lack, on_grid, method="Nelder-Mead", options=options).x
    )


# Scars.


@dataclass(frozen=True)
class _Scar:
    """Streak of points that are off the rows above and below."""

    first: int  #: row
    width: int  #: rows
    points: slice  #: along the rows
    height: float  #: in robust standard deviations


def _find_scars(rows: NDArray) -> list[_Scar]:
    """Streaks in one to four rows with sharp ends."""
    scars = []
    thin = max(1, int(np.sqrt(rows.size / SAMPLE)))
    for width in range(1, WIDEST_SCAR + 1):
        below = rows[: -width - 1]
        above = rows[width + 1 :]
        inner = [rows[1 + i : len(rows) - width + i] for i in range(width)]
        mean_of_inner = sum(row[::thin, ::thin] for row in inner) / width
        bend = np.abs(mean_of_inner - (below + above)[::thin, ::thin] / 2)
        bend = bend[np.isfinite(bend)]
        # Of a flat surface with a few features most points are far closer to their neighbours.
        deviation = max(1.4826 * np.median(bend), TAIL * np.quantile(bend, 0.9)) if bend.size else 0
        if not deviation > 0:
            continue
        step = np.abs(above - below)
        height_above = np.minimum.reduce(inner) - np.maximum(below, above)
        depth_below = np.minimum(below, above) - np.maximum.reduce(inner)
        for off in (height_above, depth_below):
            with np.errstate(invalid="ignore"):
                streaks = (off > SCAR_ENDS * deviation) & (off > step)
            # Points beside each other along a row are one streak.
            groups, _ = scipy.ndimage.label(streaks, structure=[[0] * 3, [1] * 3, [0] * 3])
            for in_row, points in scipy.ndimage.find_objects(groups):
                row = in_row.start
                if not SHORTEST_SCAR <= points.stop - points.start < rows.shape[1] / 2:
                    continue
                height = float(np.median(off[row, points]) / deviation)
                if height > FAINT_SCAR and _has_sharp_ends(np.nan_to_num(off[row]), points):
                    scars.append(_Scar(row + 1, width, points, height))
    return scars


def _has_sharp_ends(off: NDArray, points: slice) -> bool:
    """Whether a streak ends within two points, on both sides or on that within the map."""
    height = np.median(off[points])
    beyond = [off[i] for i in (points.start - 2, points.stop + 1) if 0 <= i < len(off)]
    return len(beyond) > 0 and max(beyond) < FAINTEST * height


def _mask_scars(mended: Mended, axis: int, scars: list[_Scar], scale: float) -> None:
    """Take scars for missing points."""
    rows = _rows(mended.heights, axis)
    is_scar = np.zeros(rows.shape, dtype=bool)
    for scar in scars:
        points = slice(max(scar.points.start - 1, 0), scar.points.stop + 1)
        is_scar[scar.first : scar.first + scar.width, points] = True
    level = rows - _medians_of_rows(rows)[:, None]
    height = amount(float(np.nanmedian(np.abs(level[is_scar]))) * scale, "m", 2)
    numbers = sorted({scar.first for scar in scars})
    more = " …" if len(numbers) > MOST_NAMED else ""
    named = ", ".join(map(str, numbers[:MOST_NAMED])) + more
    mended.heights = np.where(_rows(is_scar, axis), np.nan, mended.heights)
    mended.remarks.append(
        f"{len(scars)} scars of about {height}, streaks along {'xy'[1 - axis]} in row"
        f"{'s' if len(numbers) > 1 else ''} {named}, were taken for missing points"
    )


def _doubt_effect(mended: Mended, before: NDArray) -> None:
    """Doubt heights of which scanning was nearly everything."""
    removed = before - mended.heights
    left = np.nanstd(mended.heights)
    ratio = float(np.nanstd(removed) / left) if left > 0 else np.inf
    if ratio > LARGEST_EFFECT:
        mended.doubts.append(
            f"what scanning left in the map is {ratio:.3g} times as high as the roughness (rms), "
            "too much to be mended: scan again, or judge the heights as they are with scan: keep"
        )
