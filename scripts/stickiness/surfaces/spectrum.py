"""Isotropic power spectral densities of rough surfaces and their moments.

One convention throughout: the two-dimensional power spectral density C(q) [length^4] of an
isotropic surface has h_rms^2 = 2 pi * integral of q C(q) dq, with no factor 1/(4 pi^2).
All integrals are closed forms, summed from the end where the terms are small, so that spectra
of ten decades lose no digits to cancellation.
"""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.core.arguments import nonnegative, number
from stickiness.solids import HALF_SPACE, Solid, check_solid

_ROUNDING = 1e-12  # q within this relative distance of the band's end still belongs to it


class Spectrum(ABC):
    """Isotropic height spectrum on a band of wave numbers ``q0 <= q <= q1``.

    What the theory needs is `variance_below` and `variance_above`; everything else follows.
    """

    q0: float
    q1: float

    @abstractmethod
    def psd(self, q: ArrayLike) -> NDArray:
        """Power spectral density C(q) [length^4] at wave numbers `q` [1/length]; 0 off the band."""

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
    def magnification(self) -> float:
        """Ratio zeta = q1/q0 of the band's ends."""
        return self.q1 / self.q0

    @property
    def h_rms(self) -> float:
        """Root mean square height [length]."""
        return float(np.sqrt(self.variance_below(self.q1)))

    @property
    def rms_slope(self) -> float:
        """Root mean square of the surface gradient |grad h|, sqrt(2 m2)."""
        return float(np.sqrt(self.variance_below(self.q1, 2)))

    @property
    def rms_curvature(self) -> float:
        """Root mean square of the Laplacian [1/length], sqrt(8 m4/3)."""
        return float(np.sqrt(self.variance_below(self.q1, 4)))

    @property
    def nayak(self) -> float:
        """Nayak's bandwidth parameter alpha = m0 m4/m2^2 (Nayak 1971, doi:10.1115/1.3451608)."""
        return self.moment(0) * self.moment(4) / self.moment(2) ** 2

    def moment(self, order: int) -> float:
        """Profile moment m0, m2 or m4 of the isotropic surface (Nayak 1971).

        m0 = h_rms^2, m2 = pi int q^3 C dq, m4 = (3 pi/4) int q^5 C dq.
        """
        try:
            share = {0: 1.0, 2: 1 / 2, 4: 3 / 8}[order]
        except KeyError:
            raise ValueError(f"moment: order must be 0, 2 or 4, got {order!r}") from None
        return share * float(self.variance_below(self.q1, order))

    def elastic_energy(self, solid: Solid = HALF_SPACE) -> float:
        """Elastic energy of full contact per nominal area over E* [length].

        (pi/2) * integral of q^2 C dq (Persson & Tosatti 2001, doi:10.1063/1.1398300); of q^2 C/S
        for a `solid` that is a layer, to 1e-12. The mean pressure's own energy is no part of it.
        """
        if check_solid(solid) == HALF_SPACE:
            return float(self.variance_below(self.q1, 1)) / 4
        from stickiness.surfaces.band_integral import integrate_band

        return integrate_band(self, lambda q: q / solid.factor(q), self.q0, self.q1) / 4


class PowerLawSegments(Spectrum):
    """Spectrum made of adjoining power laws C = C_i (q/q_i)^a_i; the base of the analytic ones.

    Parameters
    ----------
    knots : (m + 1,) array
        Increasing wave numbers that separate the m segments.
    level, exponent : (m,) array
        C at the left end of each segment, and its exponent a.
    """

    prescribed = "C"

    def __init__(self, knots: ArrayLike, level: ArrayLike, exponent: ArrayLike):
        self._knots = np.asarray(knots, dtype=float)
        self._level = np.asarray(level, dtype=float)
        self._exponent = np.asarray(exponent, dtype=float)
        self.q0, self.q1 = float(self._knots[0]), float(self._knots[-1])

    @property
    def knots(self) -> NDArray:
        """Wave numbers, both ends included, between which C is one power law each."""
        return self._knots.copy()

    def _segment(self, q: NDArray) -> NDArray:
        index = np.searchsorted(self._knots, q, side="right") - 1
        return np.clip(index, 0, len(self._level) - 1)

    def psd(self, q: ArrayLike) -> NDArray:
        """C(q) [length^4]; zero outside the band."""
        (q,) = nonnegative(q=q)
        inside = (q >= self.q0 * (1 - _ROUNDING)) & (q <= self.q1 * (1 + _ROUNDING))
        i = self._segment(q)
        ratio = np.where(inside, q, self._knots[i]) / self._knots[i]
        return np.where(inside, self._level[i] * ratio ** self._exponent[i], 0.0)

    def _integral(self, i: NDArray, a: NDArray, b: NDArray, power: float) -> NDArray:
        """2 pi * integral of q^(1 + power) C from a to b, both in segment i."""
        beta = self._exponent[i] + 2 + power
        from_knot = np.log(a / self._knots[i])
        level = self._level[i] * self._knots[i] ** (2 + power)
        return 2 * np.pi * level * np.exp(beta * from_knot) * _expm1_over(beta, np.log(b / a))

    def _whole_segments(self, power: float) -> NDArray:
        i = np.arange(len(self._level))
        return self._integral(i, self._knots[:-1], self._knots[1:], power)

    def variance_below(self, q: ArrayLike, power: float = 0) -> NDArray:
        """See `Spectrum.variance_below`."""
        q = np.clip(*nonnegative(q=q), self.q0, self.q1)
        i = self._segment(q)
        before = np.concatenate([[0.0], np.cumsum(self._whole_segments(power))])
        return before[i] + self._integral(i, self._knots[i], q, power)

    def variance_above(self, q: ArrayLike, power: float = 0) -> NDArray:
        """See `Spectrum.variance_above`."""
        q = np.clip(*nonnegative(q=q), self.q0, self.q1)
        i = self._segment(q)
        after = np.concatenate([np.cumsum(self._whole_segments(power)[::-1])[::-1], [0.0]])
        return after[i + 1] + self._integral(i, q, self._knots[i + 1], power)

    def at_gradient_variance(self, variance: ArrayLike) -> tuple[NDArray, NDArray]:
        """See `Spectrum.at_gradient_variance`."""
        (variance,) = nonnegative(variance=variance)
        before = np.concatenate([[0.0], np.cumsum(self._whole_segments(2))])
        i = np.clip(np.searchsorted(before, variance, side="right") - 1, 0, len(self._level) - 1)
        beta = self._exponent[i] + 4
        level = 2 * np.pi * self._level[i] * self._knots[i] ** 4
        q = self._knots[i] * np.exp(_log1p_over(beta, (variance - before[i]) / level))
        q = np.clip(q, self.q0, self.q1)
        return q, self.variance_above(q)

    def truncated(self, q1: float) -> PowerLawSegments:
        """Return the same spectrum cut at `q1` (q0 < q1 <= the present end)."""
        _check_cut(self, q1)
        keep = self._knots[:-1] < q1
        knots = np.append(self._knots[:-1][keep], q1)
        return PowerLawSegments(knots, self._level[keep], self._exponent[keep])


class SelfAffine(PowerLawSegments):
    """Self-affine spectrum C = C0 q^(-2(H+1)) from q0 (or q_rolloff) to q1.

    Parameters
    ----------
    hurst : float
        Hurst exponent H, 0 < H <= 1 (fractal dimension D = 3 - H).
    q0, q1 : float
        Lowest and highest wave number [1/length].
    h_rms : float, optional
        Root mean square height [length] of the continuous spectrum. Give this or `C0`.
    C0 : float, optional
        Prefactor [length^(2 - 2H)].
    q_rolloff : float, optional
        With it the spectrum is the plateau C = C0 q_rolloff^(-2(H+1)) for q0 <= q < q_rolloff.

    Raises
    ------
    ValueError
        If a parameter is out of range or both or none of `h_rms` and `C0` are given.

    Examples
    --------
    >>> s = SelfAffine(hurst=0.8, q0=1.0, q1=64.0, h_rms=1.0)
    >>> round(s.h_rms, 12), round(s.magnification)
    (1.0, 64)
    """

    def __init__(
        self,
        *,
        hurst: float,
        q0: float,
        q1: float,
        h_rms: float | None = None,
        C0: float | None = None,
        q_rolloff: float | None = None,
    ):
        _check_band(hurst, q0, q1, q_rolloff)
        if (h_rms is None) == (C0 is None):
            raise ValueError(f"give one of h_rms and C0, got h_rms={h_rms!r} and C0={C0!r}")
        name, size = ("h_rms", h_rms) if C0 is None else ("C0", C0)
        size = number(name, size)
        self.hurst, self.q_rolloff, self.prescribed = hurst, q_rolloff, name
        with np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore"):
            self._build(q0, q1, np.float64(1.0))
            self.C0 = size if h_rms is None else float(size**2 / self.variance_below(q1))
            self._build(q0, q1, np.float64(self.C0))
            variances = np.array([self.variance_below(q1, power) for power in (0, 2, 4)])
        if not np.all(np.isfinite(variances) & (variances > 0)):
            raise ValueError(
                f"q0 = {q0!r}, q1 = {q1!r} and {name} = {size!r} leave the range of floats: take a "
                "unit of length in which they are nearer to 1"
            )

    def _build(self, q0: float, q1: float, prefactor: float) -> None:
        slope = -2 * (self.hurst + 1)
        if self.q_rolloff is None:
            super().__init__([q0, q1], [prefactor * np.float64(q0) ** slope], [slope])
        else:
            level = prefactor * np.float64(self.q_rolloff) ** slope
            super().__init__([q0, self.q_rolloff, q1], [level, level], [0.0, slope])

    def truncated(self, q1: float) -> SelfAffine:
        """Return the same spectrum (same C0) cut at `q1`."""
        _check_cut(self, q1)
        if self.q_rolloff is not None and self.q_rolloff >= q1:
            return super().truncated(q1)
        return SelfAffine(hurst=self.hurst, q0=self.q0, q1=q1, C0=self.C0, q_rolloff=self.q_rolloff)

    def __repr__(self) -> str:
        rolloff = "" if self.q_rolloff is None else f", q_rolloff={self.q_rolloff:.6g}"
        size = f"h_rms={self.h_rms:.6g}" if self.prescribed == "h_rms" else f"C0={self.C0:.6g}"
        return (
            f"SelfAffine(hurst={self.hurst}, q0={self.q0:.6g}, q1={self.q1:.6g}, {size}{rolloff})"
        )


class Tabulated(PowerLawSegments):
    """Spectrum through measured points, interpolated linearly in log C against log q.

    Parameters
    ----------
    q : (m,) array
        Increasing wave numbers [1/length], m >= 2.
    C : (m,) array
        Power spectral density [length^4] in this project's convention, positive.
    """

    def __init__(self, q: ArrayLike, C: ArrayLike):
        q, C = _check_points(q, C, "C", least=2)
        if not (np.all(np.isfinite(C)) and np.all(C > 0)):
            bad = int(np.argmin(np.where(np.isfinite(C), C, -np.inf)))
            raise ValueError(f"C must be positive and finite, got C[{bad}] = {C[bad]!r}")
        super().__init__(q, C[:-1], np.diff(np.log(C)) / np.diff(np.log(q)))


class Shells(Spectrum):
    """Discrete spectrum: height variance sitting on shells |q| = q_i, as on a periodic window.

    Parameters
    ----------
    q : (m,) array
        Increasing wave numbers of the shells [1/length].
    variance : (m,) array
        Height variance on each shell [length^2], non-negative.
    """

    prescribed = "variance"

    def __init__(self, q: ArrayLike, variance: ArrayLike):
        q, variance = _check_points(q, variance, "variance", least=1)
        if not (np.all(np.isfinite(variance)) and np.all(variance >= 0) and variance.any()):
            raise ValueError("variance must be finite, non-negative and not all zero")
        keep = variance > 0
        self.q, self.variance = q[keep], variance[keep]
        self.q0, self.q1 = float(self.q[0]), float(self.q[-1])

    def psd(self, q: ArrayLike) -> NDArray:
        """C averaged over the ring between the midpoints to the neighbouring shells."""
        if len(self.q) == 1:
            raise ValueError("a single shell is a delta function: it has no density")
        middle = (self.q[1:] + self.q[:-1]) / 2
        edges = np.concatenate(
            [[self.q0 - (middle[0] - self.q0)], middle, [2 * self.q1 - middle[-1]]]
        )
        density = self.variance / (np.pi * np.diff(edges**2))
        (q,) = nonnegative(q=q)
        i = np.searchsorted(edges, q, side="right") - 1
        inside = (i >= 0) & (i < len(density))
        return np.where(inside, density[np.clip(i, 0, len(density) - 1)], 0.0)

    def variance_below(self, q: ArrayLike, power: float = 0) -> NDArray:
        """See `Spectrum.variance_below`; a shell at `q` itself counts as below."""
        before = np.concatenate([[0.0], np.cumsum(self.variance * self.q**power)])
        (q,) = nonnegative(q=q)
        return before[np.searchsorted(self.q, q, side="right")]

    def variance_above(self, q: ArrayLike, power: float = 0) -> NDArray:
        """See `Spectrum.variance_above`; a shell at `q` itself counts as below."""
        after = np.concatenate([np.cumsum((self.variance * self.q**power)[::-1])[::-1], [0.0]])
        (q,) = nonnegative(q=q)
        return after[np.searchsorted(self.q, q, side="right")]

    def at_gradient_variance(self, variance: ArrayLike) -> tuple[NDArray, NDArray]:
        """See `Spectrum.at_gradient_variance`."""
        gradient = np.cumsum(self.variance * self.q**2)
        (variance,) = nonnegative(variance=variance)
        i = np.minimum(np.searchsorted(gradient, variance, side="left"), len(self.q) - 1)
        after = np.concatenate([np.cumsum(self.variance[::-1])[::-1], [0.0]])
        rest = np.maximum(gradient[i] - variance, 0.0) / self.q[i] ** 2
        return self.q[i], after[i + 1] + rest

    def truncated(self, q1: float) -> Shells:
        """Return the shells up to and including `q1`."""
        _check_cut(self, q1)
        keep = self.q <= q1 * (1 + _ROUNDING)
        return Shells(self.q[keep], self.variance[keep])


def _check_points(q: ArrayLike, values: ArrayLike, name: str, least: int) -> tuple[NDArray, ...]:
    q, values = np.asarray(q, dtype=float), np.asarray(values, dtype=float)
    if q.ndim != 1 or q.shape != values.shape or len(q) < least:
        shapes = f"{q.shape} and {values.shape}"
        raise ValueError(f"q and {name} must be 1D, of one length >= {least}; got {shapes}")
    if not (np.all(np.isfinite(q)) and q[0] > 0 and np.all(np.diff(q) > 0)):
        raise ValueError("q must be positive, finite and strictly increasing")
    return q, values


def _check_band(hurst: float, q0: float, q1: float, q_rolloff: float | None) -> None:
    number("hurst", hurst)
    if not hurst <= 1:
        raise ValueError(f"hurst must be in (0, 1], got {hurst!r}")
    number("q0", q0)
    if not number("q1", q1) > q0:
        raise ValueError(f"q1 must be finite and above q0 = {q0!r}, got {q1!r}")
    if q_rolloff is not None and not q0 < number("q_rolloff", q_rolloff) < q1:
        raise ValueError(
            f"q_rolloff must lie between q0 = {q0!r} and q1 = {q1!r}, got {q_rolloff!r}"
        )


def _check_cut(spectrum: Spectrum, q1: float) -> None:
    if not spectrum.q0 < number("q1", q1) <= spectrum.q1:
        raise ValueError(
            f"truncated: q1 must lie in (q0, q1] = ({spectrum.q0!r}, {spectrum.q1!r}], got {q1!r}"
        )


def _expm1_over(beta: NDArray, x: NDArray) -> NDArray:
    """Integral of exp(beta t) from 0 to x, that is expm1(beta x)/beta, regular at beta = 0."""
    safe = np.where(beta == 0, 1.0, beta)
    return np.where(beta == 0, x, np.expm1(safe * x) / safe)


def _log1p_over(beta: NDArray, y: NDArray) -> NDArray:
    """Inverse of `_expm1_over`: log1p(beta y)/beta, regular at beta = 0."""
    safe = np.where(beta == 0, 1.0, beta)
    return np.where(beta == 0, y, np.log1p(np.maximum(safe * y, -1 + 1e-16)) / safe)
