"""Moments of a measured spectrum and their uncertainty, by drawing spectra that agree with it.

A draw is one spectrum that might be the surface's: each ring by its sampling law, the whole of each
measurement by what separates measurements, the law beyond the instrument's band by the covariance
of its fit, the end of the plateau likewise. Whatever follows from the spectrum follows from each
draw, so that errors that belong together stay together.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from stickiness.measured.instrument_spectrum import MeasuredSpectrum
from stickiness.measured.stitching import Stitched
from stickiness.surfaces.spectrum import PowerLawSegments

ORDERS = {"h_rms": 0, "rms_slope": 2, "rms_curvature": 4, "elastic_energy": 1}


@dataclass(frozen=True)
class Draws:
    """Moments of spectra that agree with a measured one.

    Attributes
    ----------
    moments : dict of (n,) arrays
        `h_rms` [length], `rms_slope`, `rms_curvature` [1/length] and `elastic_energy` [length],
        the last of full contact per area over E*.
    q0 : (n,) array
        Lowest wave number of the self-affine range [1/length]: the end of the plateau if one was
        found, else the lowest that was measured, which is the scan's and carries no error.
    """

    moments: dict[str, NDArray]
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
    """Draw moments of a measured spectrum.

    Parameters
    ----------
    spectrum : MeasuredSpectrum
        Of one measurement, or `stitched.spectrum`.
    count : int
        Number of draws.
    seed : int
        Of the random numbers.
    stitched : Stitched, optional
        Where the spectrum comes from several measurements.
    extend_to : float, optional
        Highest wave number to which the fitted law carries on beyond the cutoff [1/length].

    Raises
    ------
    ValueError
        If the law is to be carried on, but is not self-affine or does not begin below.
    """
    if extend_to is not None:
        check_extension(spectrum, extend_to)
    rng = np.random.default_rng(seed)
    rings, top = spectrum.rings, spectrum.cutoff.q * (1 + 1e-9)
    levels = rings.psd * _relative(spectrum, count, rng, stitched)
    law = _laws(spectrum, count, rng)
    moments = {}
    for name, order in ORDERS.items():
        # Slope, curvature and energy are of waves up to the cutoff: beyond, the instrument decides.
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
    """Raise ValueError if the fitted law cannot be carried on to the wave number `extend_to`."""
    if not spectrum.fit.is_self_affine:
        raise ValueError(
            f"extend_to: the fitted H = {spectrum.fit.hurst:.2f} is no self-affine surface's, the "
            "law cannot be carried on; leave extend_to out or narrow fit_from … fit_to"
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
    # The mean of dof exponential values has the relative variance 1/dof. A log-normal law of that
    # mean and variance stays positive without the far tail that the posterior of a single mode
    # has: the scan does know the variance of its own heights.
    variance = np.log1p(1 / spectrum.rings.dof)
    own, logs = variance, 0.0
    if stitched is not None:
        tau = np.nan_to_num(stitched.scatter)
        logs = rng.normal(size=(count, len(stitched.shares))) * tau @ stitched.shares
        # The rings' errors hold the offsets already, as if they were independent.
        own = np.maximum(variance - tau**2 * np.sum(stitched.shares**2, axis=0), 0.0)
    normal = rng.normal(size=(count, len(variance)))
    return np.exp(logs + normal * np.sqrt(own) - variance / 2)


def _laws(spectrum: MeasuredSpectrum, count: int, rng: np.random.Generator) -> NDArray:
    """Draws of (ln C at the cutoff, H) and, with a plateau, ln q_rolloff: (count, 2 or 3)."""
    fit = spectrum.fit
    centre = [np.log(fit.c0), fit.hurst] + ([np.log(fit.q_rolloff)] if fit.q_rolloff else [])
    law = rng.multivariate_normal(centre, fit.log_covariance, size=count, method="eigh")
    law[:, 0] -= 2 * (law[:, 1] + 1) * np.log(spectrum.cutoff.q)
    return law


def _beyond(q: float, q_end: float, law: NDArray, order: float) -> NDArray:
    """2 pi times the integral of q^(1 + order) C from `q` to `q_end` under every law drawn."""
    return np.array(
        [
            PowerLawSegments([q, q_end], [np.exp(level)], [-2 * (hurst + 1)]).variance_below(
                q_end, order
            )
            for level, hurst in law[:, :2]
        ]
    )
