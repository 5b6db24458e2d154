"""Power spectral density of a measured or computed topography: taper, 2D spectrum, rings.

The project's convention: h_rms^2 = double integral of C d^2q = 2 pi * integral of q C(q) dq, no
factor 1/(4 pi^2). A measured topography is not periodic; without a taper the jump across its
edges leaks a false q^-2 tail along the axes into the spectrum (Jacobs, Junge & Pastewka 2017,
doi:10.1088/2051-672X/aa51f8). Lengths are in any one unit; C then has that unit to the fourth.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import fft

from stickiness.arguments import grid, number

Taper = Literal["none", "hann", "hann_radial"]


@dataclass(frozen=True)
class PowerSpectrum:
    """Two-dimensional power spectral density on the half plane q_y >= 0."""

    qx: NDArray  #: (nx,), along the first axis [1/length], in the order of the FFT
    qy: NDArray  #: (ny//2 + 1,), along the second axis, not negative
    psd: NDArray  #: (nx, ny//2 + 1), C(qx, qy) [length^4]
    #: (ny//2 + 1,): modes of the full plane for which each column stands (2; 1 for columns that
    #: hold both members of each conjugate pair)
    multiplicity: NDArray
    variance: float  #: mean square of the tapered heights over that of the taper [length^2]
    #: Independent modes per mode: 1 without a taper, (mean w^2)^2/mean w^4 with one, because a
    #: taper correlates neighbouring modes.
    independence: float
    #: Half width of the taper's main lobe, in lattice steps: 0 without a taper. Modes nearer to
    #: q = 0 than this are mixed with the mean and the trend.
    blur: float

    @property
    def dqx(self) -> float:
        """Lattice step along the first axis, 2 pi over the side [1/length]."""
        return float(self.qx[1])

    @property
    def dqy(self) -> float:
        """Lattice step along the second axis [1/length]."""
        return float(self.qy[1])

    @property
    def q(self) -> NDArray:
        """``|q|`` of every mode, shape of `psd` [1/length]."""
        return np.hypot(self.qx[:, None], self.qy[None, :])

    @property
    def q_nyquist(self) -> float:
        """Smaller of the two Nyquist wave numbers [1/length]; circles up to it are complete."""
        return float(min(np.abs(self.qx).max(), self.qy.max()))

    def anisotropy(self, q_min: float, q_max: float) -> tuple[float, float]:
        """Return A and phi0 [rad] in C ~ 1 + A cos 2(phi - phi0) between two wave numbers.

        The amplitude A is 0 if C is isotropic, towards 2 for a pure lay; phi0 in (-pi/2, pi/2] is
        the direction of the wave vectors with the largest C.
        """
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
        phi = np.arctan2(*np.broadcast_arrays(self.qy[None, :], self.qx[:, None]))[inside]
        # The ring's mean is taken off: its modes are not spread evenly over the directions.
        excess = weight * (self.psd[inside] / mean[ring] - 1)
        harmonic = 2 * np.sum(excess * np.exp(2j * phi)) / weight.sum()
        return float(np.abs(harmonic)), float(np.angle(harmonic) / 2)

    def total(self) -> float:
        """Sum of C over the full plane times dqx dqy: equals `variance` (Parseval) [length^2]."""
        return float(np.sum(self.psd @ self.multiplicity)) * self.dqx * self.dqy


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
    """Two-dimensional power spectral density of heights on a rectangular grid.

    Parameters
    ----------
    heights : (nx, ny) array
        Heights [length], the first axis along x; levelled beforehand if they are measured.
    dx, dy : float
        Grid steps along the first and second axis [length]; `dy` defaults to `dx`.
    taper : {"none", "hann", "hann_radial"}
        "none" for periodic heights. "hann": product of a Hann taper along each axis.
        "hann_radial": Hann taper of the distance from the centre, zero beyond the largest
        inscribed circle; isotropic, but it uses less of the data. Both are centred on the middle
        of the area (SurfaceTopography's on pixel n//2), so that a mirrored map has the same rings.

    Returns
    -------
    PowerSpectrum
        C, whatever the taper: over the taper's mean square.

    Raises
    ------
    ValueError
        If the heights are not a finite 2D array of at least 4 by 4 points, a step is not
        positive, or the taper is unknown.
    """
    heights = grid("heights", heights)
    if min(heights.shape) < 4:
        raise ValueError(f"heights must have at least 4 x 4 points, got {heights.shape}")
    dx, dy = number("dx", dx), number("dy", dx if dy is None else dy)
    nx, ny = heights.shape
    w, blur = _taper(taper, (nx, ny), (dx, dy))
    power = np.mean(w**2)
    # Less the mean weighted by the taper: else a constant would leak into the lowest modes.
    tapered = w * (heights - np.mean(w * heights) / np.mean(w))
    modes = fft.rfft2(tapered) / (nx * ny)
    cell = (2 * np.pi) ** 2 / (nx * dx * ny * dy)
    with np.errstate(over="ignore"):
        variance = float(np.mean(tapered**2) / power)
    if not np.isfinite(variance / cell):
        raise ValueError("heights leave the range of floats: take a larger unit of length")
    multiplicity = np.full(modes.shape[1], 2.0)
    multiplicity[0] = 1.0
    if ny % 2 == 0:
        multiplicity[-1] = 1.0
    return PowerSpectrum(
        qx=2 * np.pi * fft.fftfreq(nx, dx),
        qy=2 * np.pi * fft.rfftfreq(ny, dy),
        psd=np.abs(modes) ** 2 / (power * cell),
        multiplicity=multiplicity,
        variance=variance,
        independence=float(power**2 / np.mean(w**4)),
        blur=blur,
    )


def radial_average(spectrum: PowerSpectrum, bins_per_decade: float = 10) -> RadialPSD:
    """Average a 2D spectrum over logarithmic rings of ``|q|``.

    Every mode but q = 0 falls into exactly one ring, those in the corners beyond `q_nyquist`
    included, so that the sum of psd * modes * dqx * dqy is still the variance. The average over a
    ring exceeds C at its mean q by about s^2 (ln 10/bins_per_decade)^2/24 for C ~ q^-s: 3 % at 10
    a decade and s = 3.6.
    """
    bins_per_decade = number("bins_per_decade", bins_per_decade)
    q = spectrum.q.ravel()
    weight = np.broadcast_to(spectrum.multiplicity, spectrum.psd.shape).ravel()
    q, weight, psd = q[1:], weight[1:], spectrum.psd.ravel()[1:]  # the first mode is q = 0
    ring = logarithmic_rings(q, q.min(), bins_per_decade)
    q, mean, modes = average_by_ring(ring, weight, q, psd)
    return RadialPSD(q, mean, modes / 2 * spectrum.independence)


def logarithmic_rings(q: NDArray, lowest: float, bins_per_decade: float) -> NDArray:
    """Index of the logarithmic ring that each mode falls into, 0 about `lowest`."""
    # Half a ring of offset keeps the lowest modes, all of one |q|, clear of a ring's edge, where
    # rounding would decide.
    return np.floor(np.log10(q / lowest) * bins_per_decade + 0.5).astype(int)


def average_by_ring(ring, weight, q, values) -> tuple[NDArray, NDArray, NDArray]:
    """Average over the rings that hold any weight: geometric mean of q, mean of values, weight."""
    total = np.bincount(ring, weights=weight)
    keep = total > 0
    total = total[keep]
    log_q = np.bincount(ring, weights=weight * np.log(q))[keep] / total
    return np.exp(log_q), np.bincount(ring, weights=weight * values)[keep] / total, total


def wide_rings(rings: RadialPSD, bins_per_decade: float) -> NDArray:
    """Index of the wider logarithmic ring, counted from the first, that each ring falls into."""
    # The slack keeps a ring on an edge where it belongs, whatever the rounding.
    return np.floor(np.log10(rings.q / rings.q[0]) * bins_per_decade + 1e-9).astype(int)


def merge_rings(rings: RadialPSD, values, bins_per_decade) -> tuple[NDArray, NDArray, NDArray]:
    """Gather narrow rings into wider ones: geometric mean q, mean of `values`, independent modes.

    The means are weighted by independent modes.
    """
    return average_by_ring(wide_rings(rings, bins_per_decade), rings.dof, rings.q, values)


def _taper(name: str, shape: tuple[int, int], step: tuple[float, float]) -> tuple[NDArray, float]:
    """Return the taper's values at the pixels' centres and its half width in lattice steps."""
    if name == "none":
        return np.ones((1, 1)), 0.0
    x, y = ((np.arange(n) + 0.5) / n - 0.5 for n in shape)  # in units of the sides
    if name == "hann":
        return np.cos(np.pi * x[:, None]) ** 2 * np.cos(np.pi * y) ** 2, 2.0
    if name == "hann_radial":
        sides = shape[0] * step[0], shape[1] * step[1]
        r = np.hypot(x[:, None] * sides[0], y * sides[1]) / min(sides)
        return np.where(r < 0.5, np.cos(np.pi * r) ** 2, 0.0), 2.0
    raise ValueError(f"taper must be 'none', 'hann' or 'hann_radial', got {name!r}")
