"""Power spectral density of a map or a line profile: taper, spectrum, averages over rings.

The project's convention: h_rms^2 = double integral of C d^2q = 2 pi * integral of q C(q) dq, no
factor 1/(4 pi^2); along a line it is the integral of C1 dq over both signs of q. A measured
topography is not periodic; without a taper the jump across its edges leaks a false q^-2 tail into
the spectrum (Jacobs, Junge & Pastewka 2017, doi:10.1088/2051-672X/aa51f8). Lengths are in any one
unit; C then has that unit to the fourth.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import fft

from stickiness.arguments import grid, number, side, with_gaps

Taper = Literal["none", "hann", "hann_radial"]


@dataclass(frozen=True, kw_only=True)
class Modes:
    """Power spectral density of a line profile, q > 0."""

    q: NDArray  #: ``|q|`` of every mode [1/length]
    psd: NDArray  #: C of every mode [length^4], or C1 [length^3]
    multiplicity: NDArray | float  #: modes, of all signs of q, for which each stands
    steps: tuple[float, ...]  #: of the lattice, 2 pi over the sides [1/length]
    q_nyquist: float  #: smallest of all axes [1/length]; circles up to it are complete
    variance: float  #: mean square of the tapered heights over that of the taper [length^2]
    independence: float  #: independent modes per mode: a taper w correlates neighbours
    blur: float  #: half width of the taper's main lobe, in lattice steps; 0 without a taper


@dataclass(frozen=True, kw_only=True)
class PowerSpectrum(Modes):
    """Power spectral density of a map (nx, ny//2 + 1), on the half plane q_y >= 0."""

    qx: NDArray  #: (nx,), along the first axis [1/length], in the order of the FFT
    qy: NDArray  #: (ny//2 + 1,), along the second axis, not negative

    def anisotropy(self, q_min: float, q_max: float) -> tuple[float, float]:
        """Return A (0 to 2) and phi0 [rad] in C ~ 1 + A cos 2(phi - phi0) between two q."""
        number("q_min", q_min)
        q = self.q
        inside = (q >= q_min) & (q <= q_max)
        if not np.any(self.psd[inside] > 0):
            raise ValueError(f"no modes between q_min = {q_min:.6g} and q_max = {q_max:.6g}")
        weight = np.broadcast_to(self.multiplicity, q.shape)[inside]
        ring = np.rint(np.log10(q[inside] / q_min) * 20).astype(int)
        modes = np.bincount(ring, weights=weight)
        mean = np.bincount(ring, weights=weight * self.psd[inside]) / np.maximum(modes, 1)
        mean[mean == 0] = np.inf  # rings without power, whose modes are alike
        phi = np.arctan2(self.qy[None, :], self.qx[:, None])[inside]
        # The ring's mean is taken off: its modes are not spread evenly over the directions.
        excess = weight * (self.psd[inside] / mean[ring] - 1)
        harmonic = 2 * np.sum(excess * np.exp(2j * phi)) / weight.sum()
        return float(np.abs(harmonic)), float(np.angle(harmonic) / 2)

    def total(self) -> float:
        """Sum of C over the full plane times the cell: equals `variance` (Parseval) [length^2]."""
        return float(np.sum(self.psd @ self.multiplicity)) * self.steps[0] * self.steps[1]


@dataclass(frozen=True)
class RadialPSD:
    """Radially averaged power spectral density, one entry for each ring that holds modes."""

    q: NDArray  #: (m,), of the ring, geometric mean over its modes [1/length]
    psd: NDArray  #: (m,), mean of C over the modes of the ring [length^4]
    #: (m,), independent exponentially distributed values among the modes: half of them (conjugate
    #: pairs), times `independence`. The mean has a Gamma distribution of this shape.
    dof: NDArray

    def __len__(self) -> int:
        return len(self.q)

    @property
    def standard_error(self) -> NDArray:
        """Of `psd`, by sampling a Gaussian isotropic surface (m,) [length^4]."""
        return self.psd / np.sqrt(self.dof)

    def modes(self, plane: PowerSpectrum) -> NDArray:
        """Modes of the full plane of the spectrum averaged in each ring (m,)."""
        return np.rint(2 * self.dof / plane.independence).astype(int)

    def between(self, q_min: float, q_max: float) -> RadialPSD:
        """Return the rings with q_min <= q <= q_max."""
        keep = (self.q >= q_min) & (self.q <= q_max)
        return RadialPSD(self.q[keep], self.psd[keep], self.dof[keep])


def power_spectrum(
    heights: ArrayLike, dx: float, dy: float | None = None, taper: Taper = "none"
) -> PowerSpectrum:
    """Two-dimensional power spectral density of heights (nx, ny), levelled if they are measured."""
    heights = grid("heights", heights)
    if min(heights.shape) < 4:
        raise ValueError(f"heights must have at least 4 x 4 points, got {heights.shape}")
    dx = side("dx", dx)
    dy = dx if dy is None else side("dy", dy)
    nx, ny = heights.shape
    # In units of the sides, from the middle of the area (SurfaceTopography's tapers: from pixel
    # n//2), so that a mirrored map has the same rings.
    x = (np.arange(nx) + 0.5) / nx - 0.5
    y = (np.arange(ny) + 0.5) / ny - 0.5
    if taper == "none":
        w = np.ones((1, 1))
    elif taper == "hann":
        w = np.cos(np.pi * x[:, None]) ** 2 * np.cos(np.pi * y) ** 2
    elif taper == "hann_radial":
        # Isotropic, but it uses less of the data.
        r = np.hypot(x[:, None] * (nx * dx), y * (ny * dy)) / min(nx * dx, ny * dy)
        w = np.where(r < 0.5, np.cos(np.pi * r) ** 2, 0.0)
    else:
        raise ValueError(f"taper must be 'none', 'hann' or 'hann_radial', got {taper!r}")
    multiplicity = np.full(ny // 2 + 1, 2.0)
    multiplicity[0] = 1.0  # columns that hold both members of each conjugate pair
    if ny % 2 == 0:
        multiplicity[-1] = 1.0
    qx = 2 * np.pi * fft.fftfreq(nx, dx)
    qy = 2 * np.pi * fft.rfftfreq(ny, dy)
    transform = _transform(heights, w, cell=(2 * np.pi) ** 2 / (nx * dx * ny * dy))
    return PowerSpectrum(
        psd=transform.psd,
        variance=transform.variance,
        independence=transform.independence,
        blur=transform.blur,
        multiplicity=multiplicity,
        q=np.hypot(qx[:, None], qy),
        q_nyquist=float(min(np.abs(qx).max(), qy.max())),
        steps=(float(qx[1]), float(qy[1])),
        qx=qx,
        qy=qy,
    )


def profile_spectrum(heights: ArrayLike, dx: float, taper: Taper = "hann") -> Modes:
    """One-dimensional power spectral density of levelled heights (n,) along a line."""
    heights = with_gaps("heights", heights)
    if heights.ndim != 1 or len(heights) < 16 or not np.all(np.isfinite(heights)):
        raise ValueError(
            f"heights of a profile must be 1D, finite and at least 16, got {heights.shape}"
        )
    dx = side("dx", dx)
    n = len(heights)
    if taper not in ("none", "hann", "hann_radial"):
        raise ValueError(f"taper must be 'none', 'hann' or 'hann_radial', got {taper!r}")
    w = np.ones(1) if taper == "none" else np.sin(np.pi * (np.arange(n) + 0.5) / n) ** 2
    dq = 2 * np.pi / (n * dx)
    transform = _transform(heights, w, dq)
    psd = transform.psd[1:]
    q = dq * np.arange(1, len(psd) + 1)
    step = float(q[0])
    return Modes(
        psd=psd,
        variance=transform.variance,
        independence=transform.independence,
        blur=transform.blur,
        multiplicity=2.0,
        q=q,
        steps=(step,),
        q_nyquist=step * n / 2,
    )


class _Transform(NamedTuple):
    """What a map and a profile have in common, by the names of `Modes`."""

    psd: NDArray
    variance: float
    independence: float
    blur: float


def _transform(heights: NDArray, w: NDArray, cell: float) -> _Transform:
    """Spectrum of heights with a taper w, on cells of the lattice of q of this size."""
    power = np.mean(w**2)
    # Less the mean weighted by the taper: else a constant would leak into the lowest modes.
    tapered = w * (heights - np.mean(w * heights) / np.mean(w))
    return _Transform(
        psd=np.abs(fft.rfftn(tapered) / heights.size) ** 2 / (power * cell),
        variance=float(np.mean(tapered**2) / power),
        independence=float(power**2 / np.mean(w**4)),
        blur=2.0 if w.size > 1 else 0.0,
    )


def autocorrelation(field: ArrayLike) -> NDArray:
    """Autocorrelation about zero of a field that is periodic along every axis, 1 at no shift."""
    correlation = fft.ifftn(np.abs(fft.fftn(field)) ** 2).real
    return correlation / correlation.flat[0]


def radial_average(spectrum: Modes, bins_per_decade: float = 10) -> RadialPSD:
    """Average a spectrum over logarithmic rings of ``|q|``; of a profile, C1 over intervals."""
    bins_per_decade = number("bins_per_decade", bins_per_decade)
    q = spectrum.q
    waves = q > 0
    weight = np.broadcast_to(spectrum.multiplicity, q.shape)[waves]
    q = q[waves]
    psd = spectrum.psd[waves]
    # Half a ring of offset keeps the lowest modes, all of one |q|, clear of a ring's edge, where
    # rounding would decide.
    ring = np.floor(np.log10(q / q.min()) * bins_per_decade + 0.5).astype(int)
    # The average exceeds C at the mean q by about s^2 (ln 10/bins_per_decade)^2/24 for C ~ q^-s:
    # 3 % at 10 a decade and s = 3.6.
    q, mean, modes = _average_by_ring(ring, weight, q, psd)
    return RadialPSD(q, mean, modes / 2 * spectrum.independence)


def _average_by_ring(ring, weight, q, values) -> tuple[NDArray, NDArray, NDArray]:
    """Average over the rings that hold any weight: geometric mean of q, mean of values, weight."""
    total = np.bincount(ring, weights=weight)
    keep = total > 0
    total = total[keep]
    log_q = np.bincount(ring, weights=weight * np.log(q))[keep] / total
    mean = np.bincount(ring, weights=weight * values)[keep] / total
    return np.exp(log_q), mean, total


def wide_rings(rings: RadialPSD, bins_per_decade: float) -> NDArray:
    """Index of the wider logarithmic ring, counted from the first, that each ring falls into."""
    # The slack keeps a ring on an edge where it belongs, whatever the rounding.
    return np.floor(np.log10(rings.q / rings.q[0]) * bins_per_decade + 1e-9).astype(int)


def merge_rings(rings: RadialPSD, values, bins_per_decade) -> tuple[NDArray, NDArray, NDArray]:
    """Gather rings into wider ones: geometric mean q, mean of `values`, independent modes."""
    return _average_by_ring(wide_rings(rings, bins_per_decade), rings.dof, rings.q, values)
