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
from stickiness.plausibility import LONGEST_SIDE, REFUSED_SIDE, SHORTEST_SIDE
from stickiness.statistics import COVERS

# Share of the points with one value above which it stands out, if it is so many times as frequent
# as the values next to it. Up to 6 times were seen, at 1 % of the points (elevations in metres).
PLATEAUS = ((0.002, 20.0), (0.03, 5.0))
FEWEST_LEVELS = 16  #: different heights; a converter of four bits
FLATTEST = 1e-7  # rms slope between neighbours
STEEPEST = 20.0
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
        beside = np.delete(counts[max(top - 3, 0) : top + 4], min(top, 3))
        share = counts[top] / counts.sum()
        times = counts[top] / beside.max()
        if any(share >= least and times >= most for least, most in PLATEAUS):
            yield (
                f"{share:.2g} of the points have the one value {levels[top]:g}, as where nothing "
                f"was measured: give missing_value: {_written(levels[top])} (in an array: put NaN "
                "there)"
            )
    if len(levels) < FEWEST_LEVELS:
        yield (
            f"there are only {len(levels)} different heights: their range is below what the "
            "numbers resolve; export the heights with more digits"
        )


def _written(value: float) -> str:
    """All digits of a number, as YAML reads them: missing points are told by equality."""
    text = repr(float(value)).removesuffix(".0")
    # YAML takes 1e-09 for a text.
    return np.format_float_scientific(value) if "e" in text and "." not in text else text


def doubt_sizes(heights: NDArray, steps: Sequence[float]) -> Iterator[str]:
    """Doubts about heights [m] on a grid of steps [m]: sides, range of the heights, slope."""
    sides = [n * step for n, step in zip(heights.shape, steps, strict=True)]
    if max(sides) > LONGEST_SIDE:
        yield f"the side of {max(sides):.3g} m {REFUSED_SIDE}"
    if max(sides) < SHORTEST_SIDE:
        yield (
            f"the side of {max(sides):.3g} m is shorter than {SHORTEST_SIDE:g} m, a few atoms: "
            "correct length or pixel_size"
        )
    # A tilt, or the drift of a scan, may exceed the side.
    between = float(np.ptp(levelling.detrend(heights, "plane")))
    if between > max(sides):
        yield (
            f"the heights range over {between:.3g} m, more than the side of {max(sides):.3g} m: "
            "correct height_unit or length"
        )
        return
    axes = [axis for axis, n in enumerate(heights.shape) if n > 1]
    squares = [np.mean((np.diff(heights, axis=axis) / steps[axis]) ** 2) for axis in axes]
    slope = float(np.sqrt(np.sum(squares)))
    if not FLATTEST <= slope <= STEEPEST:
        yield (
            f"the rms slope between points is {slope:.2g}, outside {FLATTEST:g} to {STEEPEST:g} of "
            "surfaces: correct height_unit or length"
        )


def doubt_fit(fit: SelfAffineFit) -> Iterator[str]:
    """Doubts about a spectrum by its self-affine fit; H counts within its error of 90 %."""
    error = COVERS * fit.hurst_se
    exponent = f"the spectrum has H = {fit.hurst:.2f} ± {error:.2f}, outside 0 < H <= 1"
    if fit.hurst + error <= 0:
        yield (
            f"{exponent}: noise, spikes or lost points whiten it, or the scan is coarser than the "
            "roll-off; look at the heights, scan with smaller steps, or limit the fit by "
            "resolution or fit_to to waves that the instrument resolves"
        )
    if fit.hurst - error > 1 + HURST_BIAS:
        yield (
            f"{exponent}: it falls as blur does; limit the fit by resolution or fit_to to waves "
            "that the instrument resolves, or level by detrend: quadratic"
        )
    if fit.misfit > LARGEST_MISFIT:
        yield (
            f"the spectrum departs from a power law by {100 * fit.misfit:.0f} % (rms): limit the "
            "fit by fit_from and fit_to to where it holds"
        )
