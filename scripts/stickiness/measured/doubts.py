"""Doubts about a measurement: values that no surface and no instrument have.

A doubt is a sentence that names what is found and what helps. A measurement with doubts has a
spectrum, but no verdict should rest on it. Limits were chosen on fifteen files of instruments,
which are not in the repository; the limits of H on surfaces of known H.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from stickiness.measured import levelling
from stickiness.measured.self_affine_fit import SelfAffineFit
from stickiness.plausibility import LONGEST_SIDE, PLAUSIBLE, REFUSED_SIDE, SHORTEST_SIDE
from stickiness.statistics import COVERS

# Share of the points with one value above which it stands out, if it is so many times as frequent
# as the values next to it. Up to 6 times were seen, at 1 % of the points (elevations in metres).
PLATEAUS = ((0.002, 20.0), (0.03, 5.0))
FEWEST_LEVELS = 16  #: different heights; a converter of four bits
FLATTEST = 1e-7  # rms slope between neighbours
STEEPEST = 5.0  # 79 degrees; the steepest of instruments' files, an AFM's map of diamond, has 2.2
STEEPEST_COUNTS = 1.0  # of whole numbers, which raw counts and grey levels are
FEWEST_PERIODS = 4  #: of a pattern
LEAST_PATTERN = 0.5  #: share of the variance that a pattern has
SQUARE = 1.1  #: ratio of the sides of pixels up to which they are square
MOST_COVERED = 0.2  #: share of all waves that may be beside those of a pattern
LARGEST_MISFIT = 1.0  #: relative; a spectrum off its law by more than a factor e
# By which H may exceed 1 beyond its error. Of 20 surfaces each, 256 x 256, made with H = 0.9 or 1
# and blurred by up to 1.5 or 0.7 points, 0 to 17 exceed it by more than 0, 0 to 2 by more than
# 0.1; of those made with H = 0.8 and blurred by 2 points 2 do, by 3 points all.
HURST_BIAS = 0.1


def doubt_values(values: NDArray) -> Iterator[str]:
    """Doubts about numbers as they stand in a file, a map or a profile, NaN where missing."""
    # Instruments and conversions write zero, the limit of the range, or a marker where nothing was
    # measured. Such a value is many times as frequent as the three next above and below it; the
    # coarse steps of a converter are not.
    levels, counts = np.unique(values[np.isfinite(values)], return_counts=True)
    if len(levels) > 1:
        top = int(np.argmax(counts))
        counts_beside = np.delete(counts[max(top - 3, 0) : top + 4], min(top, 3))
        share = counts[top] / counts.sum()
        times = counts[top] / counts_beside.max()
        if any(share >= least and times >= most for least, most in PLATEAUS):
            yield (
                f"{share:.2g} of the points have the one value {levels[top]:g}, as where nothing "
                f"was measured: give missing_value: {_written(levels[top])} (in an array: put NaN "
                "there)"
            )
    scaled = [(0, 1), (0, 255), (0, 65535)]
    if len(levels) >= FEWEST_LEVELS and (levels[0], levels[-1]) in scaled:
        yield (
            f"the heights run from exactly 0 to {levels[-1]:g}, as in a picture that was scaled to "
            "this range: export heights with their unit"
        )
    if len(levels) < FEWEST_LEVELS:
        yield (
            f"there are only {len(levels)} different heights: their range is below what the "
            "numbers resolve; export the heights with more digits"
        )


def _written(value: float) -> str:
    """All digits of a number, as YAML reads them: missing points are told by equality."""
    digits = repr(float(value)).removesuffix(".0")
    # YAML takes 1e-09 for a text.
    return np.format_float_scientific(value) if "e" in digits and "." not in digits else digits


def doubt_sizes(
    heights: NDArray, steps: Sequence[float] | NDArray, are_whole: bool = False
) -> Iterator[str]:
    """Doubts about heights [m] on a grid of steps [m]: sides, rms and range of heights, slope.

    `are_whole` says that the numbers of which the heights were made are whole.
    """
    sides = [n * step for n, step in zip(heights.shape, steps, strict=True)]
    if max(sides) > LONGEST_SIDE:
        yield f"the side of {max(sides):.3g} m {REFUSED_SIDE}"
    if max(sides) < SHORTEST_SIDE:
        yield (
            f"the side of {max(sides):.3g} m is shorter than {SHORTEST_SIDE:g} m, a few atoms: "
            "correct length or pixel_size"
        )
    # A tilt, or the drift of a scan, may exceed the side.
    level = levelling.detrend(heights, "plane")
    between = float(np.ptp(level))
    if between > max(sides):
        yield (
            f"the heights range over {between:.3g} m, more than the side of {max(sides):.3g} m: "
            "correct height_unit or length"
        )
        return
    h_rms = float(np.std(level))
    if h_rms < PLAUSIBLE["h_rms"].least:
        yield (
            f"the rms height is {h_rms:.2g} m, below {PLAUSIBLE['h_rms'].least:g} m: atoms are "
            "larger; correct height_unit"
        )
    axes = [axis for axis, n in enumerate(heights.shape) if n > 1]
    squares = [np.mean((np.diff(heights, axis=axis) / steps[axis]) ** 2) for axis in axes]
    slope = float(np.sqrt(np.sum(squares)))
    if are_whole and slope > STEEPEST_COUNTS:
        yield (
            f"the heights are whole numbers with an rms slope of {slope:.2g} between points: raw "
            "counts or grey levels are no heights; export heights with their unit, or correct "
            "height_unit or length"
        )
    elif not FLATTEST <= slope <= STEEPEST:
        yield (
            f"the rms slope between points is {slope:.2g}, outside {FLATTEST:g} to {STEEPEST:g} of "
            "surfaces: correct height_unit or length"
        )


def doubt_pixels(
    source: str,
    shape: Sequence[int],
    steps: Sequence[float] | NDArray,
    in_file: float | None = None,
) -> Iterator[str]:
    """Doubt about pixels [m] that are not square, unless the file has the same ratio of steps."""
    ratio = steps[0] / steps[1]
    if in_file is not None and np.isclose(ratio, in_file, rtol=0.01):
        return
    if not 1 / SQUARE < ratio < SQUARE:
        side_x, side_y = np.multiply(shape, steps)
        yield (
            f"{source}: sides of {side_x:.3g} x {side_y:.3g} m mean pixels of {steps[0]:.3g} x "
            f"{steps[1]:.3g} m, for there are {shape[0]} x {shape[1]} points: correct length or "
            "pixel_size unless the instrument has such pixels"
        )


def doubt_pattern(source: str, heights: NDArray, sides: Sequence[float]) -> Iterator[str]:
    """Doubt about a periodic pattern of heights on sides [m], such as a grating, by its period."""
    wave = find_pattern(heights)
    if wave is not None:
        period = 1 / np.linalg.norm(np.divide(wave, sides))
        yield (
            f"{source}: the heights repeat with a period of {period:.3g} m, as those "
            "of a grating: verdicts are for random roughness"
        )


def find_pattern(heights: NDArray) -> tuple[float, ...] | None:
    """Periods along every axis of the strongest wave of a periodic pattern; None of other heights.

    The pattern consists of that wave and its multiples, or of the sums of two waves and theirs.
    """
    # Power of every wave, which a Hann window spreads to the waves beside it.
    level = levelling.detrend(heights, "quadratic")
    for axis, n in enumerate(level.shape):
        level = level * np.expand_dims(np.hanning(n), [i for i in range(level.ndim) if i != axis])
    power = np.abs(np.fft.fftn(level)) ** 2
    along_axes = [np.fft.fftfreq(n, 1 / n) for n in power.shape]
    numbers = np.stack(np.meshgrid(*along_axes, indexing="ij"), axis=-1)

    # The strongest wave, and then the strongest of the others.
    power_left = power.copy()
    waves: list[NDArray] = []
    while len(waves) < power.ndim:
        top = np.unravel_index(np.argmax(power_left), power.shape)
        is_near = np.abs(numbers - numbers[top]).max(axis=-1) <= 1
        wave = np.average(numbers[is_near], axis=0, weights=power_left[is_near])
        if np.linalg.norm(wave) < FEWEST_PERIODS:
            return None
        waves.append(wave)
        # Its multiples, and sums of both waves and theirs, are of the pattern.
        counts = np.rint(numbers @ np.linalg.pinv(waves))
        is_multiple = np.abs(numbers - counts @ np.array(waves)).max(axis=-1) <= 1.5
        if is_multiple.mean() > MOST_COVERED:
            return None
        power_left[is_multiple & counts.any(axis=-1)] = 0.0
        if power_left.sum() < (1 - LEAST_PATTERN) * power.sum():
            return tuple(map(float, waves[0]))
    return None


def doubt_fit(fit: SelfAffineFit, is_end_told: bool = False) -> Iterator[str]:
    """Doubts about a spectrum by its self-affine fit; H counts within its error of 90 %.

    A user who tells where the waves end says that a steep spectrum is the surface's.
    """
    error = COVERS * fit.hurst_se
    exponent = f"the spectrum has H = {fit.hurst:.2f} ± {error:.2f}, outside 0 < H <= 1"
    if fit.hurst + error <= 0:
        yield (
            f"{exponent}: noise, spikes or lost points whiten it, or the scan is coarser than the "
            "roll-off; look at the heights, scan with smaller steps, or limit the fit by "
            "resolution or fit_to to waves that the instrument resolves"
        )
    if fit.hurst - error > 1 + HURST_BIAS and not is_end_told:
        yield (
            f"{exponent}: it falls as blur does; limit the fit by resolution or fit_to to waves "
            "that the instrument resolves, give extend_to if the surface has no shorter ones, or "
            "level by detrend: quadratic"
        )
    if fit.misfit > LARGEST_MISFIT:
        yield (
            f"the spectrum departs from a power law by {100 * fit.misfit:.0f} % (rms): limit the "
            "fit by fit_from and fit_to to where it holds"
        )
