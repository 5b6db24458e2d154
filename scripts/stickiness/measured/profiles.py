"""Line profiles: one-dimensional spectra, and the isotropic two-dimensional ones behind them.

Convention of the project, one dimension less: h_rms^2 is the integral of C1 dq over all q, both
signs. A profile across an isotropic surface has C1(q) = integral of C(sqrt(q^2 + k^2)) dk over all
k, Abel's transform of C (Nayak 1971, doi:10.1115/1.3451608). Its inverse takes a derivative of a
noisy spectrum. Here the ratio C/C1 is taken from the self-affine fit to the profile. It is
exact for such a spectrum; elsewhere its error follows from the local exponent: for C ~ q^-s the
ratio is Gamma(s/2)/(sqrt(pi) Gamma(s/2 - 1/2))/q.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import fft, special

from stickiness.arguments import number
from stickiness.measured.psd import RadialPSD, Taper, average_by_ring, logarithmic_rings
from stickiness.measured.self_affine_fit import FINE, SelfAffineFit, fit_rings

LOWEST_HURST = -0.4  #: at -1/2 the transform of q^(-2(H+1)) no longer exists
_ROUNDS = 20


@dataclass(frozen=True)
class ProfileSpectrum:
    """One-dimensional power spectral density of a line profile, q > 0."""

    q: NDArray  #: (m,), multiples of 2 pi over the length [1/length]
    psd: NDArray  #: (m,), C1(q) [length^3]
    variance: float  #: mean square of the tapered heights over that of the taper [length^2]
    independence: float  #: this and `blur` as in `psd.PowerSpectrum`
    blur: float
    n: int  #: points of the profile

    @property
    def q_nyquist(self) -> float:
        """Highest wave number, pi over the step [1/length]."""
        return float(self.q[0]) * self.n / 2

    def rings(self, bins_per_decade: float) -> RadialPSD:
        """Means of C1 (not C) over logarithmic intervals of q."""
        ring = logarithmic_rings(self.q, self.q[0], bins_per_decade)
        q, mean, modes = average_by_ring(ring, np.ones(len(self.q)), self.q, self.psd)
        return RadialPSD(q, mean, modes * self.independence)


def profile_spectrum(heights: ArrayLike, dx: float, taper: Taper = "hann") -> ProfileSpectrum:
    """One-dimensional power spectral density of heights (n,) along a line, levelled beforehand.

    Along a line both Hann tapers are the same.
    """
    heights = np.asarray(heights, dtype=float)
    if heights.ndim != 1 or len(heights) < 16 or not np.all(np.isfinite(heights)):
        raise ValueError(
            f"heights of a profile must be 1D, finite and at least 16, got {heights.shape}"
        )
    dx = number("dx", dx)
    if taper not in ("none", "hann", "hann_radial"):
        raise ValueError(f"taper must be 'none', 'hann' or 'hann_radial', got {taper!r}")
    n = len(heights)
    w, blur = np.ones(n), 0.0
    if taper != "none":
        w, blur = np.sin(np.pi * (np.arange(n) + 0.5) / n) ** 2, 2.0
    power = np.mean(w**2)
    tapered = w * (heights - np.mean(w * heights) / np.mean(w))
    dq = 2 * np.pi / (n * dx)
    modes = fft.rfft(tapered)[1:] / n
    return ProfileSpectrum(
        q=dq * np.arange(1, len(modes) + 1),
        psd=np.abs(modes) ** 2 / (power * dq),
        variance=float(np.mean(tapered**2) / power),
        independence=float(power**2 / np.mean(w**4)),
        blur=blur,
        n=n,
    )


def abel_ratio(q: ArrayLike, hurst: float, q_rolloff: float | None = None) -> NDArray:
    """C/C1 [1/length] of a self-affine spectrum with no upper end, and a plateau below `q_rolloff`.

    C1 exists for H > -1/2 in C ~ q^(-2(H+1)); else a ValueError is raised.
    """
    if not hurst > -0.5:
        raise ValueError(f"hurst must be above -1/2 for a profile's spectrum, got {hurst!r}")
    q = np.asarray(q, dtype=float)
    if q_rolloff is None:
        return special.gamma(hurst + 1) / (np.sqrt(np.pi) * special.gamma(hurst + 0.5)) / q
    # With C = 1 on the plateau. Beyond q_rolloff the integral over k is an incomplete beta
    # function in t = (q/|q|)^2, below it the integrand is constant.
    t = np.minimum((q / q_rolloff) ** 2, 1.0)
    level = np.minimum((q / q_rolloff) ** (-2 * (hurst + 1)), 1.0)
    tail = special.betainc(hurst + 0.5, 0.5, t) * special.beta(hurst + 0.5, 0.5)
    sloped = q_rolloff * (q / q_rolloff) ** (-2 * hurst - 1) * tail
    flat = 2 * np.sqrt(np.maximum(q_rolloff**2 - q**2, 0.0))
    return level / (sloped + flat)


def isotropic(
    spectrum: ProfileSpectrum, q_min: float, q_max: float, rolloff: bool | None = None
) -> tuple[RadialPSD, SelfAffineFit]:
    """Two-dimensional isotropic spectrum behind a profile, and its self-affine fit between two q.

    Returns narrow rings of C [length^4] with the degrees of freedom of the profile, and the fit in
    the convention of two dimensions. Besides what `self_affine_fit.fit_rings` raises, a ValueError
    says that the spectrum falls more slowly than any isotropic surface's: noise.
    """
    profile = spectrum.rings(FINE)
    rings = replace(profile, psd=profile.psd * (1 / profile.q))
    fit = fit_rings(rings, q_min, q_max, rolloff)
    for _ in range(_ROUNDS):
        before = fit
        if not fit.hurst > LOWEST_HURST:
            raise ValueError(
                f"the profile's spectrum falls as q^{-2 * fit.hurst - 1:.2f}: too slowly for a "
                "surface, rather noise; lower the highest wave number of the fit"
            )
        ratio = abel_ratio(profile.q, fit.hurst, fit.q_rolloff)
        rings = replace(profile, psd=profile.psd * ratio)
        # The model stays once it is chosen: else a plateau might come and go for ever.
        fit = fit_rings(rings, q_min, q_max, fit.q_rolloff is not None)
        if abs(fit.hurst - before.hurst) < 1e-3 * fit.hurst_se:
            break
    return rings, fit
