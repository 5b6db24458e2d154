"""What every spectrum of a rough surface can tell: moments, and the average over directions."""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.solids import HALF_SPACE, Solid, check_solid
from stickiness.spectrum.direction import CIRCLE
from stickiness.spectrum.moments import Moments


class Spectrum(ABC):
    """Height spectrum on a band of wave numbers ``q0 <= q <= q1``, averaged over directions.

    What the theory needs is `variance_below` and `variance_above`; everything else follows. Only
    `PowerLawSegments` may have a direction: then `norm` takes the place of ``|q|`` in the band, and
    `averaged` is the isotropic spectrum that theories use in its place.
    """

    q0: float
    q1: float
    isotropic: bool = True
    anisotropy: float = 1.0  # ratio of the correlation lengths

    @abstractmethod
    def psd(self, q: ArrayLike) -> NDArray:
        """Power spectral density C(q) [length^4] at wave numbers `q` [1/length]; 0 off the band."""

    def norm(self, qx: ArrayLike, qy: ArrayLike) -> NDArray:
        """Norm of wave vectors that `q0` and `q1` bound: ``|q|`` without a direction."""
        return np.hypot(qx, qy)

    def psd_of_norm(self, norm: ArrayLike) -> NDArray:
        """C [length^4] of wave vectors of this `norm`; 0 off the band."""
        return self.psd(norm)

    def psd_of_vector(self, qx: ArrayLike, qy: ArrayLike) -> NDArray:
        """C(qx, qy) [length^4] of wave vectors; 0 off the band."""
        return self.psd_of_norm(self.norm(qx, qy))

    def averaged(self) -> Spectrum:
        """Return the isotropic spectrum that this one is on average over directions."""
        return self

    def directional_moments(self, axis: float | None = None) -> Moments:
        """Profile moments by direction (Longuet-Higgins 1957, doi:10.1098/rsta.1957.0002).

        ``m20`` and ``m40`` are of profiles along `axis` [rad from x], ``m02`` and ``m04`` across;
        without a direction they equal `moment`. By default the axis is the long correlation
        length, so that these are the smallest and the largest.
        """
        return CIRCLE.moments(tuple(self.total_variance(power) for power in (0, 2, 4)))

    @abstractmethod
    def variance_below(self, q: ArrayLike, power: float = 0) -> NDArray:
        """Return 2 pi * integral from q0 to `q` of q'^(1 + power) C(q') dq'.

        ``power`` 0 gives the variance of the heights, 2 that of the gradient, 4 that of the
        Laplacian, each of the part of the surface with wave numbers up to `q`.
        """

    @abstractmethod
    def variance_above(self, q: ArrayLike, power: float = 0) -> NDArray:
        """Return 2 pi * integral from `q` to q1 of q'^(1 + power) C(q') dq'."""

    @abstractmethod
    def at_gradient_variance(self, variance: ArrayLike) -> tuple[NDArray, NDArray]:
        """Invert `variance_below(q, 2)`: q, and the height variance of all wave numbers beyond.

        Within a shell of a discrete spectrum, where q stands still, both variances grow in
        proportion.
        """

    @abstractmethod
    def truncated(self, q1: float) -> Spectrum:
        """Return the same spectrum cut at the high wave number `q1`."""

    @property
    def band(self) -> tuple[float, float]:
        """Smallest and largest ``|q|`` of all waves."""
        return self.q0, self.q1

    @property
    def q_longest(self) -> float:
        """Wave number of the longest waves that matter: q0, or the end of a plateau."""
        return self.q0

    @property
    def magnification(self) -> float:
        """Ratio zeta = q1/q0 of the band's ends."""
        return self.q1 / self.q0

    def total_variance(self, power: float = 0) -> float:
        """Return the integral of ``|q|^power`` C over all wave vectors: see `variance_below`."""
        return float(self.variance_below(self.q1, power))

    @property
    def h_rms(self) -> float:
        """Root mean square height [length]."""
        return float(np.sqrt(self.total_variance()))

    @property
    def rms_slope(self) -> float:
        """Root mean square of the surface gradient ``|grad h|``, sqrt(2 m2)."""
        return float(np.sqrt(self.total_variance(2)))

    @property
    def rms_curvature(self) -> float:
        """Root mean square of the Laplacian [1/length], sqrt(8 m4/3)."""
        return float(np.sqrt(self.total_variance(4)))

    @property
    def nayak(self) -> float:
        """Nayak's bandwidth parameter alpha = m0 m4/m2^2 (Nayak 1971, doi:10.1115/1.3451608)."""
        return self.moment(0) * self.moment(4) / self.moment(2) ** 2

    def moment(self, order: int) -> float:
        """Profile moment m0, m2 or m4 of the surface averaged over directions (Nayak 1971).

        m0 = h_rms^2, m2 = pi int q^3 C dq, m4 = (3 pi/4) int q^5 C dq.
        """
        try:
            share = {0: 1.0, 2: 1 / 2, 4: 3 / 8}[order]
        except KeyError:
            raise ValueError(f"moment: order must be 0, 2 or 4, got {order!r}") from None
        return share * self.total_variance(order)

    def elastic_energy(self, solid: Solid = HALF_SPACE) -> float:
        """Elastic energy of full contact per nominal area over E* [length].

        (pi/2) * integral of q^2 C dq (Persson & Tosatti 2001, doi:10.1063/1.1398300); of q^2 C/S
        for a `solid` that is a layer, to 1e-12. The mean pressure's own energy is no part of it.
        """
        if check_solid(solid) == HALF_SPACE:
            return self.total_variance(1) / 4
        from stickiness.spectrum.band_integral import integrate_band

        averaged = self.averaged()
        return integrate_band(averaged, lambda q: q / solid.factor(q), *averaged.band) / 4
