"""Kinds of spectra: power laws, tables, shells of a periodic window, and sums of these."""

from __future__ import annotations

from copy import copy
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.arguments import nonnegative, number
from stickiness.spectrum.direction import CIRCLE, Ellipse, expm1_over
from stickiness.spectrum.interface import LATTICE_ROUNDING, Spectrum

_ROUNDING = 1e-12  # q within this relative distance of the band's end still belongs to it
_ALIKE = 1e-9  # shells or knots that much apart, relatively, are one


class PowerLawSegments(Spectrum):
    """Spectrum made of adjoining power laws C = C_i (q/q_i)^a_i; the base of the analytic ones.

    Parameters
    ----------
    knots : (m + 1,) array
        Increasing wave numbers that separate the m segments.
    level, exponent : (m,) array
        C at the left end of each segment, and its exponent a.
    ellipse : direction.Ellipse
        Norm that takes the place of ``|q|`` in them: ``|q|`` by default.
    """

    def __init__(
        self, knots: ArrayLike, level: ArrayLike, exponent: ArrayLike, ellipse: Ellipse = CIRCLE
    ):
        self._knots = np.asarray(knots, dtype=float)
        self._level = np.asarray(level, dtype=float)
        self._exponent = np.asarray(exponent, dtype=float)
        self._laws = (self._knots, self._level, self._exponent)
        self.ellipse = ellipse
        self.q0 = float(self._knots[0])
        self.q1 = float(self._knots[-1])

    @property
    def knots(self) -> NDArray:
        """Wave numbers, both ends included, between which C is one power law each."""
        return self._knots.copy()

    def psd(self, q: ArrayLike) -> NDArray:
        """C(q) [length^4], averaged over directions; zero outside the band."""
        if self.ellipse.is_nearly_circle:
            return self.psd_of_norm(q)
        return self.ellipse.mean_psd(self._laws, q)

    def psd_of_norm(self, norm: ArrayLike) -> NDArray:
        (q,) = nonnegative(q=norm)
        inside = (q >= self.q0 * (1 - _ROUNDING)) & (q <= self.q1 * (1 + _ROUNDING))
        i = self._segment(q)
        ratio = np.where(inside, q, self._knots[i]) / self._knots[i]
        return np.where(inside, self._level[i] * ratio ** self._exponent[i], 0.0)

    def averaged(self) -> PowerLawSegments:
        return self if self.isotropic else self._mean

    def total_variance(self, power: float = 0) -> float:
        return float(self._below_knots(power)[-1]) * self.ellipse.mean_stretch(power)

    def variance_below(self, q: ArrayLike, power: float = 0) -> NDArray:
        mean = self.averaged()
        q = nonnegative(q=q)[0].clip(mean.q0, mean.q1)
        i = mean._segment(q)
        return mean._below_knots(power)[i] + mean._integral(i, mean._knots[i], q, power)

    def variance_above(self, q: ArrayLike, power: float = 0) -> NDArray:
        mean = self.averaged()
        q = nonnegative(q=q)[0].clip(mean.q0, mean.q1)
        i = mean._segment(q)
        after = np.append(np.cumsum(mean._whole_segments(power)[::-1])[::-1], 0.0)
        return after[i + 1] + mean._integral(i, q, mean._knots[i + 1], power)

    def at_gradient_variance(self, variance: ArrayLike) -> tuple[NDArray, NDArray]:
        (variance,) = nonnegative(variance=variance)
        mean = self.averaged()
        before = mean._below_knots(2)
        i = np.clip(np.searchsorted(before, variance, side="right") - 1, 0, len(mean._level) - 1)
        beta = mean._exponent[i] + 4
        level = 2 * np.pi * mean._level[i] * mean._knots[i] ** 4
        log_ratio = _log1p_over(beta, (variance - before[i]) / level)
        q = np.clip(mean._knots[i] * np.exp(log_ratio), mean.q0, mean.q1)
        return q, self.variance_above(q)

    @cached_property
    def _mean(self) -> PowerLawSegments:
        """The spectrum averaged over directions."""
        knots, level, exponent = self.ellipse.average(self._laws)
        return PowerLawSegments(knots, level, exponent)

    def _cut(self, q1: float) -> PowerLawSegments:
        cut = copy(self)
        keep = self._knots[:-1] < q1
        knots = np.append(self._knots[:-1][keep], q1)
        PowerLawSegments.__init__(cut, knots, self._level[keep], self._exponent[keep], self.ellipse)
        vars(cut).pop("_mean", None)
        cut.prescribed = "C"
        return cut

    def __repr__(self) -> str:
        laws = (np.array2string(x, separator=", ", threshold=3, edgeitems=1) for x in self._laws)
        return f"PowerLawSegments({', '.join(laws)}, {self.ellipse!r})"

    # Integrals are summed from the end where the terms are small, so that spectra of ten decades
    # lose no digits to cancellation.

    def _segment(self, q: NDArray) -> NDArray:
        index = np.searchsorted(self._knots, q, side="right") - 1
        return np.clip(index, 0, len(self._level) - 1)

    def _integral(self, i: NDArray, a: NDArray, b: NDArray, power: float) -> NDArray:
        """2 pi * integral of q^(1 + power) C from a to b, both in segment i."""
        beta = self._exponent[i] + 2 + power
        from_knot = np.log(a / self._knots[i])
        level = self._level[i] * self._knots[i] ** (2 + power)
        return 2 * np.pi * level * np.exp(beta * from_knot) * expm1_over(beta, np.log(b / a))

    def _whole_segments(self, power: float) -> NDArray:
        i = np.arange(len(self._level))
        return self._integral(i, self._knots[:-1], self._knots[1:], power)

    def _below_knots(self, power: float) -> NDArray:
        return np.append(0.0, np.cumsum(self._whole_segments(power)))


class SelfAffine(PowerLawSegments):
    """Self-affine spectrum C = C0 q^(-2(H+1)) from q0 (or q_rolloff) to q1.

    Parameters
    ----------
    hurst : float
        Hurst exponent H, 0 < H <= 1 (fractal dimension D = 3 - H).
    q0, q1 : float
        Lowest and highest wave number [1/length].
    h_rms : float, optional
        Root mean square height [length] of the continuous spectrum. Give either this or `C0`.
    C0 : float, optional
        Prefactor [length^(2 - 2H)].
    q_rolloff : float, optional
        With it the spectrum is the plateau C = C0 q_rolloff^(-2(H+1)) for q0 <= q < q_rolloff.
    anisotropy : float
        Ratio of the correlation lengths, long over short, from 1 to 1e4.
    angle : float
        Direction of the long correlation length from x [rad].

    Notes
    -----
    With a direction q is an elliptic norm of the wave vector, (a k^2 + s^2/a)^(1/2), k and s being
    its components along the long correlation length and across, a the anisotropy. `q0`, `q_rolloff`
    and `q1` bound this norm: the longest waves have wave number q0/sqrt(a) along and q0 sqrt(a)
    across, the shortest q1/sqrt(a) and q1 sqrt(a). `h_rms` does not depend on a, the rms slope
    grows with it. `psd`, `variance_below` and the like are averages over directions at ``|q|``.

    Examples
    --------
    >>> s = SelfAffine(hurst=0.8, q0=1.0, q1=64.0, h_rms=1.0)
    >>> round(s.h_rms, 12), round(s.magnification)
    (1.0, 64)
    >>> ground = SelfAffine(hurst=0.8, q0=1.0, q1=64.0, h_rms=1.0, anisotropy=4.0)
    >>> round(ground.h_rms, 12), round(ground.rms_slope / s.rms_slope, 3)
    (1.0, 1.458)
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
        anisotropy: float = 1.0,
        angle: float = 0.0,
    ):
        number("hurst", hurst, most=1)
        number("q0", q0)
        if not number("q1", q1) > q0:
            raise ValueError(f"q1 must be finite and above q0 = {q0!r}, got {q1!r}")
        if q_rolloff is not None and not q0 < number("q_rolloff", q_rolloff) < q1:
            band = f"q0 = {q0!r} and q1 = {q1!r}"
            raise ValueError(f"q_rolloff must lie between {band}, got {q_rolloff!r}")
        self.ellipse = Ellipse(anisotropy, angle)
        given = [size for size in (h_rms, C0) if size is not None]
        if len(given) != 1:
            raise ValueError(f"give one of h_rms and C0, got h_rms={h_rms!r} and C0={C0!r}")
        name = "h_rms" if C0 is None else "C0"
        size = number(name, given[0])
        self.hurst = hurst
        self.q_rolloff = q_rolloff
        self.prescribed = name
        slope = -2 * (hurst + 1)
        knots = [q0, q1] if q_rolloff is None else [q0, q_rolloff, q1]
        exponents = [slope] if q_rolloff is None else [0.0, slope]
        with np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore"):
            levels = np.full(len(exponents), np.float64(knots[-2]) ** slope)
            super().__init__(knots, levels, exponents, self.ellipse)
            variance = np.float64(self.total_variance())  # vanishes without an error
            self.C0 = size if h_rms is None else float(size**2 / variance)
            super().__init__(knots, self.C0 * levels, exponents, self.ellipse)
            variances = np.array([self.total_variance(power) for power in (0, 2, 4)])
        if not np.all(np.isfinite(variances) & (variances > 0)):
            raise ValueError(
                f"q0 = {q0!r}, q1 = {q1!r} and {name} = {size!r} leave the range of floats: take a "
                "unit of length in which they are nearer to 1"
            )

    @property
    def q_longest(self) -> float:
        """See `Spectrum.q_longest`; with a direction the geometric mean of along and across."""
        return self.q0 if self.q_rolloff is None else self.q_rolloff

    def _cut(self, q1: float) -> PowerLawSegments:
        cut = super()._cut(q1)
        bends = self.q_rolloff is None or self.q_rolloff < q1
        if bends:
            return cut
        # A plateau alone.
        return PowerLawSegments(cut._knots, cut._level, cut._exponent, cut.ellipse)

    def __repr__(self) -> str:
        rest = "" if self.q_rolloff is None else f", q_rolloff={self.q_rolloff:.6g}"
        if not self.isotropic:
            rest += f", anisotropy={self.anisotropy:.6g}, angle={self.ellipse.angle:.6g}"
        size = f"h_rms={self.h_rms:.6g}" if self.prescribed == "h_rms" else f"C0={self.C0:.6g}"
        return f"SelfAffine(hurst={self.hurst}, q0={self.q0:.6g}, q1={self.q1:.6g}, {size}{rest})"


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
    """Discrete spectrum: height variance sitting on shells ``|q|`` = q_i, as on a periodic window.

    Parameters
    ----------
    q : (m,) array
        Increasing wave numbers of the shells [1/length].
    variance : (m,) array
        Height variance on each shell [length^2], non-negative.
    anisotropy : float
        Ratio of the correlation lengths of the heights whose shells these are. It widens limits of
        predictions; shells themselves have no direction.
    """

    prescribed = "variance"
    is_discrete = True

    def __init__(self, q: ArrayLike, variance: ArrayLike, anisotropy: float = 1.0):
        q, variance = _check_points(q, variance, "variance", least=1)
        if not (np.all(np.isfinite(variance)) and np.all(variance >= 0) and variance.any()):
            raise ValueError("variance must be finite, non-negative and not all zero")
        keep = variance > 0
        self.q = q[keep]
        self.variance = variance[keep]
        self.q0 = float(self.q[0])
        self.q1 = float(self.q[-1])
        self._anisotropy = Ellipse(anisotropy).ratio

    @property
    def anisotropy(self) -> float:
        """Ratio of the correlation lengths of the heights."""
        return self._anisotropy

    def psd(self, q: ArrayLike) -> NDArray:
        """C averaged over the ring between the midpoints to the neighbouring shells."""
        if len(self.q) == 1:
            raise ValueError("a single shell is a delta function: it has no density")
        middle = (self.q[1:] + self.q[:-1]) / 2
        first = self.q0 - (middle[0] - self.q0)
        last = 2 * self.q1 - middle[-1]
        edges = np.concatenate([[first], middle, [last]])
        density = self.variance / (np.pi * np.diff(edges**2))
        (q,) = nonnegative(q=q)
        return np.pad(density, 1)[np.searchsorted(edges, q, side="right")]

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
        gradient = np.cumsum(self.variance * self.q**2)
        (variance,) = nonnegative(variance=variance)
        i = np.minimum(np.searchsorted(gradient, variance, side="left"), len(self.q) - 1)
        rest = np.maximum(gradient[i] - variance, 0.0) / self.q[i] ** 2
        return self.q[i], self.variance_above(self.q[i]) + rest

    def _cut(self, q1: float) -> Shells:
        keep = self.q <= q1 * (1 + _ROUNDING)
        return Shells(self.q[keep], self.variance[keep], self.anisotropy)

    def sample(self, low: float, high: float) -> tuple[NDArray, NDArray, NDArray]:
        inside = (self.q >= low) & (self.q <= high)
        return self.q[inside], np.ones(np.count_nonzero(inside)), self.variance[inside]

    def mode_variance(self, i: NDArray, j: NDArray, dq: float) -> NDArray:
        """Height variance of each mode of the band: its shell's variance in equal parts."""
        norm = dq * np.hypot(i, j)
        middle = (self.q[1:] + self.q[:-1]) / 2
        shell = np.searchsorted(middle, norm)
        on_shell = np.abs(norm - self.q[shell]) <= LATTICE_ROUNDING * norm
        count = 2 * np.bincount(shell[on_shell], minlength=len(self.q))  # with mirror images
        if not count.all():
            missing = self.q[np.argmin(count)]
            raise ValueError(f"no wave vector of the window lies on the shell at q = {missing:.6g}")
        return np.where(on_shell, (self.variance / count)[shell], 0.0)


class Sum(Spectrum):
    """Sum of the densities of independent surfaces; see `combine`.

    Its surfaces have the sum of the mode variances of the parts, each part with a prescribed h_rms
    being scaled to it.
    """

    def __init__(self, *parts: Spectrum):
        self.parts = parts
        self.q0 = min(part.q0 for part in parts)
        self.q1 = max(part.q1 for part in parts)

    def __repr__(self) -> str:
        return f"Sum({', '.join(map(repr, self.parts))})"

    @property
    def isotropic(self) -> bool:
        return all(part.isotropic for part in self.parts)

    @property
    def anisotropy(self) -> float:
        """Of the parts that store the energy of full contact, like `q_longest`."""
        return self._weigh([part.anisotropy for part in self.parts])

    @property
    def knots(self) -> NDArray:
        """Wave numbers, both ends included, between which C is smooth if it is isotropic."""
        q = np.sort(np.concatenate([part.knots for part in self.parts]))
        kept = q[_find_first(q)]
        kept[-1] = q[-1]
        return kept

    @property
    def band(self) -> tuple[float, float]:
        bands = [part.band for part in self.parts]
        return min(low for low, _ in bands), max(high for _, high in bands)

    @property
    def q_longest(self) -> float:
        """See `Spectrum.q_longest`: of the parts that store the energy of full contact."""
        return self._weigh([part.q_longest for part in self.parts])

    def _weigh(self, values: list[float]) -> float:
        """Geometric mean, by the energies of full contact of the parts."""
        energies = np.array([part.elastic_energy() for part in self.parts])
        return float(np.exp(np.average(np.log(values), weights=energies)))

    def psd(self, q: ArrayLike) -> NDArray:
        """C(q) [length^4], averaged over directions; zero off all bands."""
        return np.sum([part.psd(q) for part in self.parts], axis=0)

    def averaged(self) -> Spectrum:
        return self if self.isotropic else Sum(*(part.averaged() for part in self.parts))

    def total_variance(self, power: float = 0) -> float:
        return sum(part.total_variance(power) for part in self.parts)

    def variance_below(self, q: ArrayLike, power: float = 0) -> NDArray:
        return np.sum([part.variance_below(q, power) for part in self.parts], axis=0)

    def variance_above(self, q: ArrayLike, power: float = 0) -> NDArray:
        return np.sum([part.variance_above(q, power) for part in self.parts], axis=0)

    def _cut(self, q1: float) -> Spectrum:
        kept = [part for part in self.parts if part.q0 < q1]
        cut = [part.truncated(q1) if part.q1 > q1 else part for part in kept]
        return Sum(*cut) if len(cut) > 1 else cut[0]

    def modes_in_band(self, i: NDArray, j: NDArray, dq: float) -> NDArray:
        """Whether lattice vectors lie in the band of any part."""
        return np.any([part.modes_in_band(i, j, dq) for part in self.parts], axis=0)

    def mode_variance(self, i: NDArray, j: NDArray, dq: float) -> NDArray:
        """Sum of what the parts contribute, each scaled to its prescribed h_rms."""
        total = np.zeros(len(i))
        for part in self.parts:
            inside = part.modes_in_band(i, j, dq)
            variance = np.zeros(len(i))
            variance[inside] = part.mode_variance(i[inside], j[inside], dq)
            if part.prescribed == "h_rms" and variance.any():
                variance *= part.h_rms**2 / (2 * variance.sum())
            total += variance
        return total


def combine(first: Spectrum, *others: Spectrum) -> Spectrum:
    """Spectrum of rough solids that press on each other: their roughness is independent and adds.

    Either all are discrete spectra of periodic windows (`Shells`), or none; ValueError otherwise.
    The result, C = C_1 + C_2 + ..., is shells of shells, else a `Sum`.

    Examples
    --------
    >>> from stickiness.spectrum import SelfAffine
    >>> rough = SelfAffine(hurst=0.8, q0=1.0, q1=64.0, h_rms=3.0)
    >>> round(combine(rough, SelfAffine(hurst=0.6, q0=2.0, q1=500.0, h_rms=4.0)).h_rms, 12)
    5.0
    """
    spectra = (first, *others)
    for spectrum in spectra:
        if not isinstance(spectrum, Spectrum):
            raise ValueError(
                "combine takes spectra one by one, combine(*spectra), got "
                f"{type(spectrum).__name__}"
            )
    is_shells = [spectrum.is_discrete for spectrum in spectra]
    if all(is_shells):
        q = np.concatenate([spectrum.q for spectrum in spectra])
        variance = np.concatenate([spectrum.variance for spectrum in spectra])
        order = np.argsort(q, kind="stable")
        q = q[order]
        start = _find_first(q)  # shells at one wave number hold the sum
        anisotropy = Sum(*spectra).anisotropy
        return Shells(q[start], np.add.reduceat(variance[order], start), anisotropy)
    if any(is_shells):
        raise ValueError(
            "combine: shells and a density have no common form; take surface.lattice_spectrum of "
            "the density on the window of the shells"
        )
    parts: list[Spectrum] = []
    for spectrum in spectra:
        parts += spectrum.parts if isinstance(spectrum, Sum) else [spectrum]
    return Sum(*parts) if len(parts) > 1 else first


def _check_points(q: ArrayLike, values: ArrayLike, name: str, least: int) -> tuple[NDArray, ...]:
    q = np.asarray(q, dtype=float)
    values = np.asarray(values, dtype=float)
    if q.ndim != 1 or q.shape != values.shape or len(q) < least:
        shapes = f"{q.shape} and {values.shape}"
        raise ValueError(f"q and {name} must be 1D, of one length >= {least}; got {shapes}")
    if not (np.all(np.isfinite(q)) and q[0] > 0 and np.all(np.diff(q) > 0)):
        raise ValueError("q must be positive, finite and strictly increasing")
    return q, values


def _log1p_over(beta: NDArray, y: NDArray) -> NDArray:
    """Inverse of `expm1_over`: log1p(beta y)/beta, regular at beta = 0."""
    safe = np.where(beta == 0, 1.0, beta)
    return np.where(beta == 0, y, np.log1p(np.maximum(safe * y, -1 + 1e-16)) / safe)


def _find_first(q: NDArray) -> NDArray:
    """Indices of the first of those, in ascending order, that are one to rounding."""
    return np.flatnonzero(np.append(True, np.diff(q) > _ALIKE * q[1:]))
