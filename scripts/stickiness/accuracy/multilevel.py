"""Means over random surfaces with a small sampling error: control variates on two levels.

The mean of a quantity f of the fine solution is E[f - b c] + b E[c - g(x)] + b E[g(x)], with c the
same quantity of the same surface on a coarse grid and g a linear function of descriptors x of its
long waves, which need no solution. The three means are over disjoint sets of few, many and
thousands of seeds. Each sample takes coefficients that are fitted without it, so that no mean has a
bias (cf. Gorodetsky et al. 2020, doi:10.1016/j.jcp.2020.109257; Giles 2015,
doi:10.1017/S096249291500001X).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import fft

from stickiness.arguments import finite, integer
from stickiness.surface import check_window, sample_modes, sum_modes

_SUMMITS = (0.01, 0.03, 0.1, 0.3)  # share of the area whose mean height is taken
DESCRIPTORS = (
    "full_contact_energy",
    "rms_slope",
    "mean_square_slope",
    *(f"summit_{share:g}" for share in _SUMMITS),
)
_FEWEST = 16  # seeds that a slope can be fitted to with profit
_SINGULAR = 1e-10  # of the largest singular value or sum of squares: no scatter but rounding


@dataclass(frozen=True, eq=False)
class Estimate:
    """A mean over an ensemble and its sampling error, all levels included."""

    mean: NDArray  #: of the shape of one sample, as `standard_error`
    standard_error: NDArray
    #: of the control, averaged over the samples; several controls are along a leading axis
    coefficient: NDArray


def controlled_mean(values: NDArray, controls: NDArray, elsewhere: NDArray) -> Estimate:
    """Mean of expensive samples (N, ...), corrected by controls that are known for many more.

    The standard error is that of the residuals, each against coefficients fitted without it, and
    that of the controls' mean.

    Parameters
    ----------
    values : (N, ...) array
        Expensive samples, a seed each.
    controls : (N, k) array
        Controls of the same seeds, which serve every trailing entry of `values`; one without
        scatter is left out.
    elsewhere : (M, k) array
        Controls of other seeds.

    Returns
    -------
    Estimate

    Raises
    ------
    ValueError
        If a number is not finite, or an array has too few samples or the wrong shape.
    """
    values = _samples("values", values)
    controls = _samples("controls", controls, (len(values), "any"))
    elsewhere = _samples("elsewhere", elsewhere, ("any", controls.shape[1]))
    # With fewer the coefficients scatter so much that the standard error comes out too small.
    _samples("values", values, fewest=4 * (controls.shape[1] + 1))
    flat = values.reshape(len(values), -1)
    corrected, coefficient = _regress(flat, controls, elsewhere.mean(0))
    variance = _error(corrected) ** 2 + _error(elsewhere @ coefficient) ** 2
    return Estimate(
        mean=corrected.mean(0).reshape(values.shape[1:]),
        standard_error=np.sqrt(variance).reshape(values.shape[1:]),
        coefficient=coefficient.reshape(-1, *values.shape[1:]),
    )


def multilevel_mean(fine, coarse, many, controls, elsewhere, fewest=_FEWEST) -> Estimate:
    """Mean of a few fine solutions (n, ...), corrected by many coarse ones.

    Parameters
    ----------
    fine : (n, ...) array
        Quantities of the fine solutions, a seed each.
    coarse : (n, ...) array
        The same quantities of the same seeds on the coarse grid.
    many : (N, ...) array
        Those of other seeds on the coarse grid.
    controls, elsewhere : (N, k) and (M, k) arrays
        Descriptors of the seeds of `many`, and of seeds that are not solved.
    fewest : int
        Fine seeds from which on a slope is fitted, see `corrected_mean`.

    Returns
    -------
    Estimate

    Raises
    ------
    ValueError
        If a number is not finite, or an array has too few samples or the wrong shape.
    """
    fine = _samples("fine", fine)
    coarse = _samples("coarse", coarse, fine.shape)
    many = _samples("many", many, ("any", *fine.shape[1:]))
    level = controlled_mean(many, controls, elsewhere)
    one_sign = np.all(many >= 0, axis=0) | np.all(many <= 0, axis=0)
    return corrected_mean(fine, coarse, level, one_sign, fewest)


def corrected_mean(fine, coarse, level, one_sign=True, fewest=_FEWEST) -> Estimate:
    """Mean of a few fine solutions, corrected by the mean `level` of coarse ones of other seeds.

    If these seeds are among those of `level`, the error leaves out that both are correlated.

    From `fewest` fine seeds on, the coefficient of the coarse solution is the slope of fine against
    coarse, entry by entry. With fewer it is the ratio of their means, or 1 where coarse solutions
    are not all of `one_sign`: fitted to four seeds, a slope can double the variance of a plain
    mean. Areas within a range that the coarse grid does not resolve are too large by one factor:
    there the ratio is right.
    """
    if len(fine) >= fewest:
        factor = _left_out_slopes(fine, coarse)
    else:
        factor = np.where(one_sign, _left_out_ratios(fine, coarse), 1.0)
    corrected = fine - factor * (coarse - level.mean)
    factor = factor.mean(0)
    error = np.hypot(_error(corrected), factor * level.standard_error)
    return Estimate(corrected.mean(0), error, factor)


def descriptors(spectrum, length, seeds, amplitudes="gaussian", cutoff=8.0) -> NDArray:
    """Describe the long waves of surfaces, as controls of their contact at any load.

    The first arguments are as for `surface.synthesise`. Waves beyond `cutoff` times q0 count with
    the power expected of them. The result (number of seeds, 7) is in the order of `DESCRIPTORS`:
    mean of ``|q|`` times the height variance [length], which is 4/E* times the elastic energy of
    full contact per area; rms slope and its square; mean height [length] of the highest 1, 3, 10
    and 30 % of the area.
    """
    check_window(spectrum, length)
    if not cutoff >= 1:
        raise ValueError(f"cutoff must be at least 1, got {cutoff!r}")
    if not isinstance(seeds, Iterable):
        raise ValueError(f"seeds must be a sequence of integers, got {seeds!r}")
    dq = 2 * np.pi / length
    i, j, variance = spectrum.modes(length)
    q = dq * np.hypot(i, j)
    low = q <= cutoff * spectrum.q0 * (1 + _SINGULAR)
    # Expected sums of variance, of |q| times it and of |q|^2 times it over the shorter waves.
    beyond = [float(np.sum(2 * (variance * q**k)[~low])) for k in range(3)]
    i = i[low]
    j = j[low]
    q = q[low]
    variance = variance[low]
    n = fft.next_fast_len(max(16, 4 * int(np.abs([i, j]).max())), real=True)
    counts = [max(1, round(share * n * n)) for share in _SUMMITS]
    rows = []
    for seed in seeds:
        modes = sample_modes(variance, integer("seeds", seed, least=0), amplitudes)
        power = 2 * np.abs(modes) ** 2
        square, energy, slope = (beyond[k] + float(np.sum(power * q**k)) for k in range(3))
        heights = np.sort(sum_modes(i, j, modes, n), axis=None)
        scale = spectrum.h_rms / np.sqrt(square) if spectrum.prescribed == "h_rms" else 1.0
        slope *= scale**2
        summits = [scale * heights[-count:].mean() for count in counts]
        rows.append([scale**2 * energy, np.sqrt(slope), slope, *summits])
    return np.array(rows).reshape(-1, len(DESCRIPTORS))


def _samples(name: str, given: ArrayLike, shape: tuple = (), fewest: int = 2) -> NDArray:
    """Finite samples along axis 0; a length "any" in `shape` may be any."""
    (values,) = finite(**{name: given})
    if values.ndim == 0 or len(values) < fewest:
        raise ValueError(f"{name} must hold at least {fewest} samples, got shape {values.shape}")
    wanted = tuple(m if n == "any" else n for n, m in zip(shape, values.shape, strict=False))
    if shape and (len(shape) != values.ndim or wanted != values.shape):
        raise ValueError(f"{name} must be of shape {shape}, got {values.shape}")
    return values


def _regress(values: NDArray, controls: NDArray, target: NDArray) -> tuple[NDArray, NDArray]:
    """Values moved to where the controls are at `target`, each by a fit without it; mean slopes."""
    centre = controls.mean(0)
    spread = controls.std(0)
    spread = np.where(spread > _SINGULAR * np.abs(centre), spread, np.inf)
    scaled = (controls - centre) / spread
    left, size, right = np.linalg.svd(scaled, full_matrices=False)
    keep = size > _SINGULAR * size[0]
    left = left[:, keep]
    right = right[keep]
    # Slopes of the least-squares fit by the pseudo-inverse.
    inverse = right.T / size[keep]
    slopes = inverse @ (left.T @ values)
    residual = values - values.mean(0) - left @ (left.T @ values)
    leverage = 1 / len(values) + np.sum(left**2, axis=1)
    # With a leverage of 1 the residual is rounding, and must not be divided by nothing.
    ratio = residual / np.maximum(1 - leverage, _SINGULAR)[:, None]
    offset = scaled - (target - centre) / spread
    lever = np.sum((offset @ inverse) * left, axis=1)
    # Leaving sample a out changes the slopes by -inverse @ left[a] residual/(1 - leverage).
    corrected = values - offset @ slopes + lever[:, None] * ratio
    change = inverse @ (left.T @ ratio) / len(values)
    return corrected, (slopes - change) / spread[:, None]


def _left_out_slopes(fine: NDArray, coarse: NDArray) -> NDArray:
    """Slope of fine against coarse for every sample, fitted without it; 1 if nothing scatters."""
    n = len(fine)
    x = coarse - coarse.mean(0)
    y = fine - fine.mean(0)
    xx = np.sum(x**2, axis=0) - n / (n - 1) * x**2
    xy = np.sum(x * y, axis=0) - n / (n - 1) * x * y
    scatters = xx > _SINGULAR * np.sum(coarse**2, axis=0)
    return np.where(scatters, xy / np.where(scatters, xx, 1.0), 1.0)


def _left_out_ratios(fine: NDArray, coarse: NDArray) -> NDArray:
    """Ratio of the means of fine and coarse for every sample, without it; 1 if there is none."""
    x = coarse.sum(0) - coarse
    y = fine.sum(0) - fine
    divides = np.abs(x) > _SINGULAR * np.abs(coarse).sum(0)
    return np.where(divides, y / np.where(divides, x, 1.0), 1.0)


def _error(samples: NDArray) -> NDArray:
    return samples.std(0, ddof=1) / np.sqrt(len(samples))
