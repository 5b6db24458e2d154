"""Random surfaces on a periodic square window: synthesis, spectrum and moments.

A surface on a window of side L has the lattice spectrum of the wave vectors 2 pi (i, j)/L, on which
simulation and theory are compared. At H = 0.8 the four longest modes carry more than half the
height variance.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
import scipy  # scipy.special is loaded when first used, a third of a second
from numpy.typing import NDArray
from scipy import fft

from stickiness.arguments import grid, integer, numbers, side
from stickiness.spectrum.direction import find_ratio_of_modes
from stickiness.spectrum.interface import LATTICE_ROUNDING, Spectrum, check_spectrum
from stickiness.spectrum.kinds import Shells

__all__ = ["Moments", "lattice_spectrum", "moments", "realised_spectrum", "resample", "synthesise"]

Amplitudes = Literal["gaussian", "fixed"]


@dataclass(frozen=True)
class Moments:
    """Spectral moments of a surface: ``m20`` is the mean of (dh/dx)^2 and so on.

    ``m22`` is the mean of (d2h/dx dy)^2. Lengths are in the unit of the heights and the cell.
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


def synthesise(
    spectrum: Spectrum,
    n: int,
    length: float,
    seed: int,
    amplitudes: Amplitudes = "gaussian",
    skewness: float = 0.0,
) -> NDArray:
    """Random periodic surface with a given spectrum, band limits exact, and a given skewness.

    Parameters
    ----------
    spectrum : Spectrum
        Wave numbers from q0 >= 2 pi/length to q1 <= pi n/length; with a direction, these are the
        smallest and the largest ``|q|`` (`spectrum.band`). At that very limit the grid
        shows only the cosine part of the two modes along its axes: a surface to be measured or
        solved on the grid wants a few more pixels per wavelength.
    n : int
        Grid points per side.
    length : float
        Side of the window [length].
    seed : int
        The surface depends on spectrum, length, seed and kind alone, not on `n`: grids of other
        sizes sample the same surface. Without a skewness, a larger q1 adds modes to those already
        there; with one, it also turns the phases of these a little.
    amplitudes : {"gaussian", "fixed"}
        "gaussian": independent Gaussian modes, the samples of a Gaussian random field.
        "fixed": every amplitude at its rms value, only the phases random (the same as in the
        Gaussian surface of this seed). Its ensemble is narrower and is not the Gaussian one.
    skewness : float
        Mean cube of the heights over h_rms^3, from -4 to 4: positive for peaks on a plain, as after
        blasting, negative for a plateau with valleys, as after honing or wear. Heights are
        log-normal within what the spectrum allows, see `skew_modes`, which says how far the
        skewness is off; spectrum, band and rms height are exact. 0 leaves the modes as they are:
        the skewness is then zero in the mean over seeds.

    Returns
    -------
    heights : (n, n) array
        Zero mean [length]. If the spectrum was prescribed by its h_rms, the rms height of every
        surface is exactly that; if by its C0 or a table, it scatters as the modes do.

    Raises
    ------
    ValueError
        If the window or the grid cannot hold the band, or an argument is out of range.

    Examples
    --------
    >>> from stickiness.spectrum import SelfAffine
    >>> q0 = 2 * np.pi
    >>> spectrum = SelfAffine(hurst=0.8, q0=q0, q1=8 * q0, h_rms=0.01)
    >>> heights = synthesise(spectrum, n=64, length=1.0, seed=7)
    >>> print(f"{heights.std():.4f}")
    0.0100
    """
    check_window(spectrum, length)
    n = integer("n", n, least=2)
    seed = integer("seed", seed, least=0)
    shortest = 2 * np.pi / spectrum.band[1]
    if shortest < 2 * length / n * (1 - LATTICE_ROUNDING):
        lower = f"q1 to {np.pi * n / length:.6g}" if spectrum.isotropic else "q1 or anisotropy"
        raise ValueError(
            f"the grid does not hold the band: shortest wavelength {shortest:.6g} is below two "
            f"pixels of length/n = {length / n:.6g}; take n >= "
            f"{int(np.ceil(2 * length / shortest))} or lower {lower}"
        )
    i, j, variance = spectrum.modes(length)
    modes = sample_modes(variance, seed, amplitudes)
    modes = skew_modes(i, j, modes, skewness)
    heights = sum_modes(i, j, modes, n)
    if spectrum.prescribed == "h_rms":
        heights *= spectrum.h_rms / np.sqrt(2 * np.sum(np.abs(modes) ** 2))
    return heights


def lattice_spectrum(spectrum: Spectrum, length: float) -> Shells:
    """Return the spectrum that a periodic window holds, as delta-like shells.

    Each wave vector carries C(q) (2 pi/length)^2. If `spectrum` was prescribed by its h_rms, the
    shells are scaled to that height, as `synthesise` scales its surfaces. Modes of one ``|q|`` make
    one shell whatever their direction.
    """
    check_window(spectrum, length)
    i, j, variance = spectrum.modes(length)
    square, total = _sum_shells(i, j, variance)
    total *= 2  # each mode and its mirror image
    if spectrum.prescribed == "h_rms":
        total *= spectrum.h_rms**2 / total.sum()
    return Shells(2 * np.pi / length * np.sqrt(square), total, spectrum.anisotropy)


def realised_spectrum(heights: NDArray, length: float) -> Shells:
    """Return the spectrum of given periodic heights `(n, n)`, one shell per distinct ``|q|``.

    Its `anisotropy` is that of the gradients, 1 if chance explains it.
    """
    i, j, power = _periodogram(heights)
    if not power.ravel()[1:].any():
        raise ValueError("heights must not be flat: they hold no wave")
    length = side("length", length)
    square, total = _sum_shells(i, j, power)
    # Modes that hold nothing but rounding are not part of the surface's band.
    keep = (square > 0) & (total > 1e-24 * total[1:].sum())
    q = 2 * np.pi / length * np.sqrt(square[keep])
    return Shells(q, total[keep], find_ratio_of_modes(i, j, power))


def moments(heights: NDArray, length: float) -> Moments:
    """Spectral moments of periodic heights `(n, n)`, derivatives taken in Fourier space."""
    i, j, power = _periodogram(heights)
    length = side("length", length)
    power = np.where((i == 0) & (j == 0), 0.0, power)
    dq = 2 * np.pi / length
    kx = i * dq
    ky = j * dq

    def moment(a, b):
        return float(np.sum(kx**a * ky**b * power))

    return Moments(
        m00=moment(0, 0),
        m20=moment(2, 0),
        m02=moment(0, 2),
        m40=moment(4, 0),
        m22=moment(2, 2),
        m04=moment(0, 4),
    )


def resample(heights: NDArray, n: int) -> NDArray:
    """Same band-limited surface on a grid of `n` x `n`, by Fourier interpolation.

    ValueError if the coarser grid cannot hold what the heights contain.
    """
    heights = grid("heights", heights, square=True)
    n = integer("n", n, least=1)
    old = heights.shape[0]
    if n == old:
        return heights.copy()
    coefficients = fft.fft2(heights) / old**2
    i = fft.fftfreq(old, 1 / old).astype(int)
    keep = np.abs(i) <= n / 2
    lost = np.sum(np.abs(coefficients[~keep, :]) ** 2) + np.sum(np.abs(coefficients[:, ~keep]) ** 2)
    if lost > 1e-20 * np.sum(np.abs(coefficients) ** 2):
        raise ValueError(
            f"n = {n} is too coarse: the surface has waves shorter than two pixels; take a larger "
            f"n, up to the {old} of the heights, or synthesise it with a lower q1"
        )
    fine = np.zeros((n, n), dtype=complex)
    where = np.ix_(i[keep] % n, i[keep] % n)
    np.add.at(fine, where, coefficients[np.ix_(keep, keep)])
    return fft.ifft2(fine).real * n**2


def check_window(spectrum: Spectrum, length: float) -> None:
    """Raise a ValueError unless a cell of side `length` holds the longest waves of `spectrum`."""
    check_spectrum(spectrum)
    length = side("length", length)
    longest = 2 * np.pi / spectrum.band[0]
    if longest > length * (1 + LATTICE_ROUNDING):
        raise ValueError(
            f"the window does not hold the band: longest wavelength {longest:.6g} "
            f"exceeds length = {length:.6g}; enlarge length, raise q0"
            f"{'' if spectrum.isotropic else ' or lower anisotropy'}"
        )


def sample_modes(variance: NDArray, seed: int, amplitudes: Amplitudes) -> NDArray:
    """Complex amplitudes of modes of given variances; more modes leave the first ones as are."""
    if amplitudes not in ("gaussian", "fixed"):
        raise ValueError(f"amplitudes must be 'gaussian' or 'fixed', got {amplitudes!r}")
    samples = np.random.Generator(np.random.PCG64(seed)).standard_normal((len(variance), 2))
    modes = samples[:, 0] + 1j * samples[:, 1]  # E|modes|^2 = 2
    if amplitudes == "fixed":
        modes *= np.sqrt(2) / np.abs(modes)
    modes *= np.sqrt(variance / 2)
    return modes


def skew_modes(
    i: NDArray, j: NDArray, modes: NDArray, skewness: float, rounds: int = 20
) -> NDArray:
    """Turn the phases of modes so that their heights have a given skewness; amplitudes stay.

    Amplitude-adjusted Fourier transforms (Schreiber & Schmitz 1996,
    doi:10.1103/PhysRevLett.77.635). Every round maps the heights, point by point and in their
    order, to a shifted log-normal distribution, and then restores the amplitude of every mode. It
    ends with the amplitudes: otherwise the map adds waves above the band, which no grid resolves.

    After 20 rounds, cells of 4 by 4 of the longest waves (H = 0.5 and 0.8, q1/q0 = 8 and 32) have
    99 to 100 % of a skewness of 1 (scatter over seeds: up to 0.003), 93 to 98 % of 2 (0.04), 82 to
    91 % of 3 (0.12) and 73 to 84 % of 4 (0.18). Cells of one longest wave have 92 to 99 % of 1
    (0.06) and 66 to 83 % of 3 (0.5): their few waves cannot be arranged to more.

    Parameters
    ----------
    i, j : (N,) arrays of int
        Lattice indices of the wave vectors, one of each pair.
    modes : (N,) array of complex
        Their amplitudes [length].
    skewness : float
        From -4 to 4; 0 returns the modes as they are.
    rounds : int
        Number of rounds.

    Returns
    -------
    modes : (N,) array of complex
        With the absolute values of those given.

    Raises
    ------
    ValueError
        If the skewness is not a number from -4 to 4.
    """
    if skewness == 0:
        return modes
    shape = log_normal_shape(skewness)
    amplitudes = np.abs(modes)
    # Products of three waves do not alias to the mean: finer grids have the same skewness.
    n = fft.next_fast_len(max(16, 4 * int(np.abs([i, j]).max())), real=True)
    # The map goes through quantiles, from the lowest to the highest point. Unlike ranks of single
    # points these move continuously with the heights, so that rounding decides nothing.
    normal = np.linspace(-1, 1, 201) * scipy.special.ndtri(1 - 0.5 / n**2)
    levels = scipy.special.ndtr(normal)
    # Phases depend neither on the mean nor on the scale.
    wanted = np.expm1(shape * normal) / shape
    for _ in range(rounds):
        heights = sum_modes(i, j, modes, n)
        quantiles = np.quantile(heights, levels, method="hazen")
        skewed = np.interp(heights, quantiles, wanted)
        phases = np.angle(fft.fft2(skewed)[i % n, j % n])
        modes = amplitudes * np.exp(1j * phases)
    return modes


def log_normal_shape(skewness: float) -> float:
    """Return s for which exp(s z)/s, with z standard normal, has a skewness from -4 to 4.

    Skewness and s have one sign. The skewness is (w + 2) sqrt(w - 1) with w = exp(s^2), which is
    2 sinh(3 t) if sqrt(w - 1) = 2 sinh(t). ValueError if the skewness is no such number.
    """
    most = 4.0  # of which the amplitudes of a spectrum leave about three quarters
    wanted = numbers("skewness", skewness)
    if wanted.ndim > 0 or not abs(wanted) <= most:
        raise ValueError(f"skewness must be a number from {-most:g} to {most:g}, got {skewness!r}")
    root = 2 * np.sinh(np.arcsinh(wanted / 2) / 3)
    return float(np.copysign(np.sqrt(np.log1p(root**2)), wanted))


def sum_modes(i: NDArray, j: NDArray, modes: NDArray, n: int) -> NDArray:
    """Sum of modes exp(i k x) + complex conjugate on the n x n grid."""
    coefficients = np.zeros((n, n), dtype=complex)
    np.add.at(coefficients, (i % n, j % n), modes)
    np.add.at(coefficients, (-i % n, -j % n), modes.conj())
    return fft.ifft2(coefficients, overwrite_x=True).real * n**2


def _sum_shells(i: NDArray, j: NDArray, power: NDArray) -> tuple[NDArray, NDArray]:
    """Distinct i^2 + j^2 and the power summed over the wave vectors of each."""
    square, shell = np.unique(i**2 + j**2, return_inverse=True)
    return square, np.bincount(shell.ravel(), weights=power.ravel())


def _periodogram(heights: NDArray) -> tuple[NDArray, NDArray, NDArray]:
    """Integer wave vectors and |h_k|^2, which sums to the mean square of the heights."""
    heights = grid("heights", heights, square=True)
    n = heights.shape[0]
    index = fft.fftfreq(n, 1 / n).round().astype(int)
    i, j = np.meshgrid(index, index, indexing="ij")
    return i, j, np.abs(fft.fft2(heights) / n**2) ** 2
