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

from stickiness.arguments import integer
from stickiness.spectrum.kinds import Spectrum
from stickiness.surface import Amplitudes, check_window, sample_modes, sum_modes

_SUMMITS = (0.01, 0.03, 0.1, 0.3)  # share of the area whose mean height is taken
DESCRIPTORS = (
    *("full_contact_energy", "rms_slope", "mean_square_slope"),
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


def plain_mean(values: ArrayLike) -> Estimate:
    """Mean over axis 0 of at least two finite samples and its standard error, without controls."""
    values = _check_samples("values", values, 2)
    return Estimate(values.mean(0), _error(values), np.zeros(values.shape[1:]))


def controlled_mean(values: ArrayLike, controls: ArrayLike, elsewhere: ArrayLike) -> Estimate:
    """Mean of expensive samples, corrected by controls that are known for many more.

    Parameters
    ----------
    values : (N, ...) array
        One sample per seed, for instance A_rep or A_ad at several loads and ranges.
    controls : (N, k) array
        Controls of the same seeds, in the same order; they serve every trailing entry of `values`.
        One without scatter is left out.
    elsewhere : (M, k) array
        The same controls of other seeds, none of them among the first N.

    Returns
    -------
    Estimate
        Linear in `values`. ``coefficient`` has the shape ``(k, ...)``. The standard error is that
        of the residuals, each against coefficients fitted without it, and that of the controls'
        mean.

    Raises
    ------
    ValueError
        If shapes do not match, values are not finite, or N is below 4 (k + 1): with fewer
        the coefficients scatter so much that the standard error comes out too small.
    """
    values = _check_samples("values", values, 2)
    controls = _check_samples("controls", controls, 2)
    elsewhere = _check_samples("elsewhere", elsewhere, 2)
    if controls.ndim != 2 or len(controls) != len(values):
        raise ValueError(f"controls must be of shape ({len(values)}, k), got {controls.shape}")
    if elsewhere.shape[1:] != controls.shape[1:]:
        wanted = f"(M, {controls.shape[1]})"
        raise ValueError(f"elsewhere must be of shape {wanted}, got {elsewhere.shape}")
    _check_samples("values", values, 4 * (controls.shape[1] + 1))
    flat = values.reshape(len(values), -1)
    corrected, coefficient = _regress(flat, controls, elsewhere.mean(0))
    variance = _error(corrected) ** 2 + _error(elsewhere @ coefficient) ** 2
    return Estimate(
        corrected.mean(0).reshape(values.shape[1:]),
        np.sqrt(variance).reshape(values.shape[1:]),
        coefficient.reshape(-1, *values.shape[1:]),
    )


def multilevel_mean(
    fine: ArrayLike,
    coarse: ArrayLike,
    many: ArrayLike,
    controls: ArrayLike | None = None,
    elsewhere: ArrayLike | None = None,
    fewest: int = _FEWEST,
) -> Estimate:
    """Mean of a few fine solutions, corrected by many coarse ones.

    Parameters
    ----------
    fine : (n, ...) array
        Fine solutions, one per seed.
    coarse : (n, ...) array
        The same quantities of the same seeds on the coarse grid.
    many : (N, ...) array
        The same quantities on the coarse grid for other seeds, none of them among the first n.
    controls, elsewhere : (N, k) and (M, k) array, optional
        Controls (`descriptors`) of the seeds of `many`, and of seeds of which there is no solution
        at all; without them the plain mean is taken.
    fewest : int
        Fine seeds from which on the coefficient of the coarse solution is the slope of fine against
        coarse, entry by entry; with fewer it is the ratio of their means.

    Raises
    ------
    ValueError
        If shapes do not match or values are not finite, or there are fewer than two samples.

    Notes
    -----
    A slope fitted to a few seeds scatters too much to help: with four it can double the variance of
    a plain mean. The ratio of means does not, and it suits areas at ranges that the coarse grid
    does not resolve: those are too large, but all in proportion. Where coarse solutions are not all
    of one sign a ratio means little, and 1 is taken.

    Neither helps where the coarse solutions hold noise of their own, such as P(u) at gaps that
    their grid does not resolve: leave these entries to `plain_mean`.
    """
    fine, coarse = _check_samples("fine", fine, 2), _check_samples("coarse", coarse, 2)
    many = _check_samples("many", many, 2)
    if coarse.shape != fine.shape:
        raise ValueError(f"coarse must have the shape {fine.shape} of fine, got {coarse.shape}")
    if many.shape[1:] != fine.shape[1:]:
        raise ValueError(f"many must have the shape (N, *{fine.shape[1:]}), got {many.shape}")
    if (controls is None) != (elsewhere is None):
        raise ValueError("controls and elsewhere must be given together, got one of them")
    level = plain_mean(many) if controls is None else controlled_mean(many, controls, elsewhere)
    one_sign = np.all(many >= 0, axis=0) | np.all(many <= 0, axis=0)
    return corrected_mean(fine, coarse, level, one_sign, fewest)


def corrected_mean(fine, coarse, level, one_sign=True, fewest=_FEWEST) -> Estimate:
    """Mean of a few fine solutions, corrected by a mean of coarse ones: see `multilevel_mean`.

    `level` is the mean of the coarse solutions of other seeds; `one_sign` says whether these are
    all of one sign, so that a ratio to them means something.
    """
    if len(fine) >= fewest:
        factor = _left_out_slopes(fine, coarse)
    else:
        factor = np.where(one_sign, _left_out_ratios(fine, coarse), 1.0)
    corrected = fine - factor * (coarse - level.mean)
    factor = factor.mean(0)
    return Estimate(
        corrected.mean(0), np.hypot(_error(corrected), factor * level.standard_error), factor
    )


def descriptors(
    spectrum: Spectrum,
    length: float,
    seeds: Iterable[int],
    amplitudes: Amplitudes = "gaussian",
    cutoff: float = 8.0,
) -> NDArray:
    """Describe the long waves of surfaces, as controls of their contact at any load.

    Parameters
    ----------
    spectrum, length, seeds, amplitudes
        As for `surface.synthesise`, whose surfaces are described.
    cutoff : float
        Waves up to `cutoff` times q0 are looked at; those beyond count with the power expected of
        them, so that the time does not depend on the magnification.

    Returns
    -------
    (number of seeds, 7) array
        In the order of `DESCRIPTORS`: mean of ``|q|`` times the height variance [length], which is
        4/E* times the elastic energy of full contact per area; rms slope and its square; mean
        height [length] of the highest 1, 3, 10 and 30 % of the area.
    """
    check_window(spectrum, length)
    if amplitudes not in ("gaussian", "fixed"):
        raise ValueError(f"amplitudes must be 'gaussian' or 'fixed', got {amplitudes!r}")
    if not cutoff >= 1:
        raise ValueError(f"cutoff must be at least 1, got {cutoff!r}")
    dq = 2 * np.pi / length
    i, j, variance = spectrum.modes(length)
    q = dq * np.hypot(i, j)
    low = q <= cutoff * spectrum.q0 * (1 + _SINGULAR)
    beyond = [float(np.sum(2 * (variance * q**k)[~low])) for k in range(3)]
    i, j, q, variance = i[low], j[low], q[low], variance[low]
    n = fft.next_fast_len(max(16, 4 * int(np.abs([i, j]).max())), real=True)
    counts = [max(1, round(share * n * n)) for share in _SUMMITS]
    rows = []
    if not isinstance(seeds, Iterable):
        raise ValueError(f"seeds must be a sequence of integers, got {seeds!r}")
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


def _regress(values: NDArray, controls: NDArray, target: NDArray) -> tuple[NDArray, NDArray]:
    """Values moved to where the controls are at `target`, each by a fit without it; mean slopes."""
    centre, spread = controls.mean(0), controls.std(0)
    spread = np.where(spread > _SINGULAR * np.abs(centre), spread, np.inf)
    scaled = (controls - centre) / spread
    left, size, right = np.linalg.svd(scaled, full_matrices=False)
    keep = size > _SINGULAR * size[0]
    left, size, right = left[:, keep], size[keep], right[keep]
    inverse = right.T / size
    slopes = inverse @ (left.T @ values)
    residual = values - values.mean(0) - left @ (left.T @ values)
    leverage = 1 / len(values) + np.sum(left**2, axis=1)
    # A seed that alone fixes a direction says nothing about it once it is left out.
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
    x, y = coarse - coarse.mean(0), fine - fine.mean(0)
    xx = np.sum(x**2, axis=0) - n / (n - 1) * x**2
    xy = np.sum(x * y, axis=0) - n / (n - 1) * x * y
    scatters = xx > _SINGULAR * np.sum(coarse**2, axis=0)
    return np.where(scatters, xy / np.where(scatters, xx, 1.0), 1.0)


def _left_out_ratios(fine: NDArray, coarse: NDArray) -> NDArray:
    """Ratio of the means of fine and coarse for every sample, without it; 1 if there is none."""
    x, y = coarse.sum(0) - coarse, fine.sum(0) - fine
    known = np.abs(x) > _SINGULAR * np.abs(coarse).sum(0)
    return np.where(known, y / np.where(known, x, 1.0), 1.0)


def _error(samples: NDArray) -> NDArray:
    return samples.std(0, ddof=1) / np.sqrt(len(samples))


def _check_samples(name: str, values: ArrayLike, fewest: int) -> NDArray:
    values = np.asarray(values, dtype=float)
    if values.ndim == 0 or len(values) < fewest:
        raise ValueError(
            f"{name} must hold at least {fewest} samples along axis 0, got shape {values.shape}"
        )
    if not np.all(np.isfinite(values)):
        raise ValueError(f"{name} must be finite, got {np.sum(~np.isfinite(values))} that are not")
    return values
