"""Moments of a measured spectrum and their uncertainty, by drawing spectra that agree with it.

In each draw, every ring varies by its sampling error, every measurement by the scatter between
measurements, the extrapolated part and the end of the plateau by the covariance of the fit.
All that follows from the spectrum is computed for each draw, so that correlated errors stay so.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from stickiness.measured.instrument_spectrum import MeasuredSpectrum
from stickiness.measured.stitching import Stitched
from stickiness.spectrum.kinds import PowerLawSegments

ORDERS = {"h_rms": 0, "rms_slope": 2, "rms_curvature": 4, "elastic_energy": 1}


@dataclass(frozen=True)
class Draws:
    """Moments of spectra that agree with a measured one."""

    #: (n,) each: `h_rms` [length], `rms_slope`, `rms_curvature` [1/length] and `elastic_energy`
    #: [length], the last of full contact per area over E*
    moments: dict[str, NDArray]
    #: (n,), lowest wave number of the self-affine range [1/length]: the end of the plateau if
    #: one was found, else the lowest of the scan, without error
    q0: NDArray

    def quantiles(self, name: str, levels: tuple[float, ...]) -> NDArray:
        """Quantiles of a moment."""
        return np.quantile(self.moments[name], levels)


def draw(
    spectrum: MeasuredSpectrum,
    count: int,
    seed: int,
    *,
    stitched: Stitched | None = None,
    extend_to: float | None = None,
) -> Draws:
    """Draw moments of a measured spectrum; of that of `stitched` if several measurements are.

    With `extend_to` the fit extrapolates the spectrum up to this wave number [1/length].

    Raises
    ------
    ValueError
        If the fit is to extrapolate, but is not self-affine or `extend_to` is below the cutoff.
    """
    if extend_to is not None:
        check_extension(spectrum, extend_to)
    rng = np.random.default_rng(seed)
    rings, top = spectrum.rings, spectrum.cutoff.q * (1 + 1e-9)
    levels = rings.psd * _relative(spectrum, count, rng, stitched)
    law = _draw_power_laws(spectrum, count, rng)
    moments = {}
    for name, order in ORDERS.items():
        # Beyond the cutoff slope, curvature and energy would be the instrument's.
        inside = rings.q <= (np.inf if order == 0 and extend_to is None else top)
        variance = (levels * np.where(inside, spectrum.area * rings.q**order, 0.0)).sum(1)
        if extend_to is not None:
            variance = variance + _beyond(spectrum.cutoff.q, extend_to, law, order)
        moments[name] = variance / 4 if order == 1 else np.sqrt(variance)
    q0 = np.full(count, spectrum.lowest)
    if spectrum.fit.q_rolloff is not None:
        q0 = np.exp(law[:, 2])
    return Draws(moments, q0)


def check_extension(spectrum: MeasuredSpectrum, extend_to: float) -> None:
    """Raise ValueError if the fit cannot extrapolate the spectrum to `extend_to` [1/length]."""
    if not spectrum.fit.is_self_affine:
        raise ValueError(
            f"extend_to: the fitted H = {spectrum.fit.hurst:.2f} is no self-affine surface's and "
            "cannot extrapolate the spectrum; leave extend_to out or narrow fit_from … fit_to"
        )
    if not extend_to > spectrum.cutoff.q:
        raise ValueError(
            f"extend_to must be below the shortest wavelength measured, "
            f"{2 * np.pi / spectrum.cutoff.q:.3g} m, got {2 * np.pi / extend_to:.3g} m"
        )


def _relative(
    spectrum: MeasuredSpectrum, count: int, rng: np.random.Generator, stitched: Stitched | None
) -> NDArray:
    """Drawn over measured C in every ring (count, m)."""
    # The mean of dof exponential values has the relative variance 1/dof. A log-normal distribution
    # of that mean and variance is positive and lacks the far tail of the posterior of a single
    # mode: the variance of the scan's own heights is known.
    variance = np.log1p(1 / spectrum.rings.dof)
    own, logs = variance, 0.0
    if stitched is not None:
        tau = np.nan_to_num(stitched.scatter)
        logs = rng.normal(size=(count, len(stitched.shares))) * tau @ stitched.shares
        # The errors of the rings already hold the offsets, as if these were independent.
        own = np.maximum(variance - tau**2 * np.sum(stitched.shares**2, axis=0), 0.0)
    normal = rng.normal(size=(count, len(variance)))
    return np.exp(logs + normal * np.sqrt(own) - variance / 2)


def _draw_power_laws(spectrum: MeasuredSpectrum, count: int, rng: np.random.Generator) -> NDArray:
    """Draws of (ln C at the cutoff, H) and, with a plateau, ln q_rolloff: (count, 2 or 3)."""
    fit = spectrum.fit
    centre = [np.log(fit.c0), fit.hurst] + ([np.log(fit.q_rolloff)] if fit.q_rolloff else [])
    law = rng.multivariate_normal(centre, fit.log_covariance, size=count, method="eigh")
    law[:, 0] -= 2 * (law[:, 1] + 1) * np.log(spectrum.cutoff.q)
    return law


def _beyond(q: float, q_end: float, law: NDArray, order: float) -> NDArray:
    """2 pi times the integral of q^(1 + order) C from `q` to `q_end` under every law drawn."""
    drawn = (
        PowerLawSegments([q, q_end], [np.exp(level)], [-2 * (hurst + 1)])
        for level, hurst in law[:, :2]
    )
    return np.array([segments.variance_below(q_end, order) for segments in drawn])
