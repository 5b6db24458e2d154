"""Spectral moments of a surface by direction."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Moments:
    """Spectral moments of a surface: ``m20`` is the mean of (dh/dx)^2 and so on.

    ``m22`` is that of (d2h/dx dy)^2; lengths as the heights' and the window's.
    """

    m00: float
    m20: float
    m02: float
    m40: float
    m22: float
    m04: float

    @property
    def h_rms(self) -> float:
        """Root mean square height."""
        return float(np.sqrt(self.m00))

    @property
    def rms_slope(self) -> float:
        """Root mean square gradient."""
        return float(np.sqrt(self.m20 + self.m02))

    @property
    def rms_curvature(self) -> float:
        """Root mean square Laplacian."""
        return float(np.sqrt(self.m40 + 2 * self.m22 + self.m04))

    @property
    def nayak(self) -> float:
        """Bandwidth m0 m4/m2^2 with m2, m4 averaged over direction for an isotropic surface."""
        m2 = (self.m20 + self.m02) / 2
        m4 = 3 / 8 * (self.m40 + 2 * self.m22 + self.m04)
        return self.m00 * m4 / m2**2

    def plus(self, other: Moments) -> Moments:
        """Moments of the sum of this surface and an independent one, by the same axes."""
        return Moments(**{name: getattr(self, name) + getattr(other, name) for name in vars(self)})
