"""The interface of every spectrum of a rough surface: density, moments, modes of a periodic cell.

A new kind of spectrum is a subclass of `Spectrum` in `kinds`. It overrides `knots` where C(q) has
kinks, and `modes_in_band` and `mode_variance` where its modes are not those of a density.

One convention throughout: the two-dimensional power spectral density C(q) [length^4] has
h_rms^2 = double integral of C d^2q, with no factor 1/(4 pi^2); averaged over directions,
h_rms^2 = 2 pi * integral of q C(q) dq. Theories know a surface by that average: it has the same
heights, gradients, curvatures and energy of full contact.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.arguments import nonnegative, number
from stickiness.solids import HALF_SPACE, Solid, check_solid
from stickiness.spectrum.direction import CIRCLE, Ellipse

LATTICE_ROUNDING = 1e-9  #: relative slack on band limits that coincide with lattice wave numbers


def _freeze(value: Any) -> Any:
    """Numbers of an array, and of arrays in a tuple, as something that can be compared."""
    if isinstance(value, tuple):
        return tuple(_freeze(item) for item in value)
    return tuple(value.tolist()) if isinstance(value, np.ndarray) else value


class Spectrum(ABC):
    """Height spectrum on a band of wave numbers ``q0 <= q <= q1``, averaged over directions.

    What the theory needs is `variance_below` and `variance_above`; everything else follows. With a
    direction the norm of the `ellipse` takes the place of ``|q|`` in the band, and `averaged` is
    the isotropic spectrum that theories use in its place.
    """

    q0: float
    q1: float
    prescribed: str = "C"  # what fixes the size of the spectrum
    is_discrete: bool = False  # whether it sits on shells, which have these arrays:
    q: NDArray
    variance: NDArray
    ellipse: Ellipse = CIRCLE

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other):
            return NotImplemented
        return self._state() == other._state()

    def __hash__(self) -> int:
        return hash((type(self), self._state()))

    def _state(self) -> tuple:
        """Attributes that can be compared, without what is computed of the others."""
        return tuple(
            (name, _freeze(value))
            for name, value in sorted(vars(self).items())
            if not isinstance(getattr(type(self), name, None), cached_property)
        )

    @abstractmethod
    def psd(self, q: ArrayLike) -> NDArray:
        """Power spectral density C(q) [length^4] at wave numbers `q` [1/length]; 0 off the band."""

    def psd_of_norm(self, norm: ArrayLike) -> NDArray:
        """C [length^4] of wave vectors of this norm; 0 off the band."""
        return self.psd(norm)

    @property
    def isotropic(self) -> bool:
        """Whether all directions are alike."""
        return self.ellipse.is_circle

    @property
    def anisotropy(self) -> float:
        """Ratio of the correlation lengths."""
        return self.ellipse.ratio

    def averaged(self) -> Spectrum:
        """Return the isotropic spectrum that this one is on average over directions."""
        return self

    @abstractmethod
    def variance_below(self, q: ArrayLike, power: float = 0) -> NDArray:
        """Return 2 pi * integral from q0 to `q` of q'^(1 + power) C(q') dq'.

        ``power`` 0, 2 and 4 give the variances of the heights, the gradient and the Laplacian of
        the part of the surface with wave numbers up to `q`.
        """

    @abstractmethod
    def variance_above(self, q: ArrayLike, power: float = 0) -> NDArray:
        """Return 2 pi * integral from `q` to q1 of q'^(1 + power) C(q') dq'."""

    def at_gradient_variance(self, variance: ArrayLike) -> tuple[NDArray, NDArray]:
        """Invert `variance_below(q, 2)`: q, and the height variance of all wave numbers beyond.

        Within a shell of a discrete spectrum, where q stands still, both variances grow in
        proportion.
        """
        from scipy.optimize import elementwise  # not needed to read a configuration

        (variance,) = nonnegative(variance=variance)
        ends = np.log(self.band)
        target = np.clip(variance, *self.variance_below(np.exp(ends), 2))

        def excess(log_q: NDArray, target: NDArray) -> NDArray:
            return self.variance_below(np.exp(log_q), 2) - target

        tolerances = {"xatol": 4e-16, "xrtol": 4e-16, "fatol": 0.0, "frtol": 0.0}
        root = elementwise.find_root(excess, tuple(ends), args=(target,), tolerances=tolerances)
        q = np.clip(np.exp(root.x), *self.band)
        return q, self.variance_above(q)

    def truncated(self, q1: float) -> Spectrum:
        """Return the same spectrum cut at the high wave number (or norm) q0 < `q1` <= `self.q1`."""
        if not self.q0 < number("q1", q1) <= self.q1:
            band = f"({self.q0!r}, {self.q1!r}]"
            raise ValueError(f"truncated: q1 must lie in (q0, q1] = {band}, got {q1!r}")
        return self._cut(q1)

    @abstractmethod
    def _cut(self, q1: float) -> Spectrum: ...

    @property
    def knots(self) -> NDArray:
        """Wave numbers, both ends of the band included, between which C(q) is smooth."""
        return np.array([self.q0, self.q1])

    @property
    def band(self) -> tuple[float, float]:
        """Smallest and largest ``|q|`` of all waves."""
        return self.q0 / self.ellipse.reach, self.q1 * self.ellipse.reach

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
        """Profile moment m0, m2 or m4, averaged over directions (Nayak, doi:10.1115/1.3451608).

        m0 = h_rms^2, m2 = pi int q^3 C dq, m4 = (3 pi/4) int q^5 C dq.
        """
        share = {0: 1.0, 2: 1 / 2, 4: 3 / 8}
        if order not in share:
            raise ValueError(f"moment: order must be 0, 2 or 4, got {order!r}")
        return share[order] * self.total_variance(order)

    def elastic_energy(self, solid: Solid = HALF_SPACE) -> float:
        """Elastic energy of full contact per nominal area over E* [length], less the mean's.

        (pi/2) * integral of q^2 C dq (Persson & Tosatti 2001, doi:10.1063/1.1398300); of q^2 C/S
        for a `solid` that is a layer, to 1e-12.
        """
        if check_solid(solid) == HALF_SPACE:
            return self.total_variance(1) / 4
        averaged = self.averaged()
        return float(averaged.integrate(lambda q: q / solid.factor(q), *averaged.band)) / 4

    def integrate(self, function: Callable[[NDArray], NDArray], low: float, high: float) -> float:
        """Return 2 pi * integral from `low` to `high`, included, of q f(q) C(q) dq, f smooth."""
        q, area, psd = self.sample(low, high)
        return float((area * psd) @ function(q)) if q.size else 0.0

    def sample(self, low: float, high: float) -> tuple[NDArray, NDArray, NDArray]:
        """Wave numbers, areas in the plane of q, and C there, of the sum that `integrate` takes."""
        low = max(low, self.q0)
        high = min(high, self.q1)
        if not high > low:
            return np.empty(0), np.empty(0), np.empty(0)
        kinks = self.knots
        knots = np.concatenate([[low], kinks[(kinks > low) & (kinks < high)], [high]])
        # Gauss quadrature on panels in ln q. What layers make of a wave has its nearest singularity
        # about one unit of ln q off the real axis: such panels err by less than 1e-13.
        x, w = np.polynomial.legendre.leggauss(12)
        parts = np.ceil(np.diff(np.log(knots)) / 0.7).astype(int)
        start = np.concatenate([[0], np.cumsum(parts)])
        edges = np.interp(np.arange(start[-1] + 1), start, np.log(knots))
        half = 0.5 * np.diff(edges)[:, None]
        q = np.exp(edges[:-1, None] + half * (1 + x))
        area = 2 * np.pi * half * w * q**2
        return q.ravel(), area.ravel(), self.psd(q).ravel()

    def modes(self, length: float) -> tuple[NDArray, NDArray, NDArray]:
        """Modes of a periodic cell of side `length` that lie in the band.

        Returns the lattice indices i, j of the wave vectors 2 pi (i, j)/length, one of each pair
        +-k, by rising norm, and the height variance of each mode [length^2]. In this order random
        numbers stay with their modes when the band grows at its upper end. ValueError if the cell
        holds no mode of the band, or too many.
        """
        dq = 2 * np.pi / length
        reach = int(np.floor(self.band[1] / dq * (1 + LATTICE_ROUNDING)))
        if reach < 1:
            raise ValueError(f"no wave vector of a window of length {length:.6g} lies in the band")
        most = 2**15  # beyond, a list of all modes leaves no memory
        if reach > most:
            raise ValueError(
                f"length = {length:.6g} holds {reach} of the shortest waves, more than "
                f"{most}: q0 = {self.q0:.6g} and q1 = {self.q1:.6g} must be in the inverse "
                "of its unit; otherwise lower q1 or length"
            )
        i, j = np.meshgrid(np.arange(reach + 1), np.arange(-reach, reach + 1), indexing="ij")
        kept = ((i > 0) | (j > 0)) & self.modes_in_band(i, j, dq)
        i = i[kept]
        j = j[kept]
        rank = i**2 + j**2
        if not self.ellipse.is_circle:  # equal norms have equal ranks
            rank = np.round(np.log(self.ellipse.norm(i, j)), 10)
        order = np.lexsort((j, i, rank))
        i = i[order]
        j = j[order]
        variance = self.mode_variance(i, j, dq)
        if not variance.any():
            raise ValueError(f"no wave vector of a window of length {length:.6g} lies in the band")
        return i, j, variance

    def modes_in_band(self, i: NDArray, j: NDArray, dq: float) -> NDArray:
        """Whether lattice vectors dq (i, j) lie in the band."""
        norm = dq * self.ellipse.norm(i, j)
        above = norm >= self.q0 * (1 - LATTICE_ROUNDING)
        return above & (norm <= self.q1 * (1 + LATTICE_ROUNDING))

    def mode_variance(self, i: NDArray, j: NDArray, dq: float) -> NDArray:
        """Height variance C dq^2 of each mode of the band."""
        norm = dq * self.ellipse.norm(i, j)
        return self.psd_of_norm(np.clip(norm, self.q0, self.q1)) * dq**2


def check_spectrum(spectrum: Spectrum) -> Spectrum:
    """Return `spectrum`; ValueError if it is not a `Spectrum`."""
    if not isinstance(spectrum, Spectrum):
        raise ValueError(f"spectrum must be a Spectrum, got {type(spectrum).__name__}")
    return spectrum
