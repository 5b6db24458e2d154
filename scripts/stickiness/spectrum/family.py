"""Spectra that one surface may have, on common wave numbers.

A measured surface has as many as are drawn: each agrees with the measurement. A surface that is
described has one or two. Whatever acts on a spectrum acts on all of them alike: a layer or a skin,
a contact that is smaller or larger than a scan, a second rough solid.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.solids import HALF_SPACE, Solid
from stickiness.spectrum.interface import Spectrum
from stickiness.spectrum.kinds import combine

LEAST = 1e-12  #: share of the variance that stands for none: a surface without waves is smooth


@dataclass(frozen=True, eq=False)
class SpectrumFamily:
    """Spectra of `n` surfaces in `m` rings of the plane of wave vectors.

    Examples
    --------
    >>> from stickiness.spectrum import SelfAffine
    >>> rough = SelfAffine(hurst=0.8, q0=1.0, q1=1e4, h_rms=1.0)
    >>> both = SpectrumFamily.of(rough, rough)
    >>> print(f"{np.sqrt(both.variance()[0]):.6f} {both.energy()[1] / rough.elastic_energy():.6f}")
    1.000000 1.000000
    """

    q: NDArray  #: wave numbers [1/length], ``(m,)``
    #: Of every ring [1/length^2], ``(m,)``; 1 of the waves of a periodic cell, whose psd is their
    #: variance
    area: NDArray
    psd: NDArray  #: C of every surface [length^4], ``(n, m)``
    #: The same as functions of the wave number, if they are known, and between which of these
    spectra: tuple[Spectrum, ...] = ()
    band: tuple[float, float] = (0.0, np.inf)

    @classmethod
    def of(cls, *spectra: Spectrum, lowest: float = 0.0, highest: float = np.inf) -> SpectrumFamily:
        """Family of spectra that have one band and kinks at the same wave numbers.

        Sums over the rings are integrals between `lowest` and `highest` to rounding.
        """
        averaged = tuple(spectrum.averaged() for spectrum in spectra)
        q, area, _ = averaged[0].sample(lowest, highest)
        if not q.size:  # no waves are left
            q, area, _ = averaged[0].sample(0.0, np.inf)
            rest = [[LEAST * spectrum.total_variance() / area[-1]] for spectrum in averaged]
            return cls(q[-1:], area[-1:], np.array(rest), averaged, (lowest, highest))
        psd = np.array([spectrum.sample(lowest, highest)[2] for spectrum in averaged])
        return cls(q, area, psd, averaged, (lowest, highest))

    @property
    def is_drawn(self) -> bool:
        """Whether the spectra are draws, known in the rings alone."""
        return not self.spectra

    @property
    def count(self) -> int:
        """Number of surfaces, n."""
        return len(self.psd)

    def variance(self, order: float = 0) -> NDArray:
        """Sum of C q^order over all wave vectors, ``(n,)``.

        Orders 0, 2 and 4 give the variances of the heights, the gradient and the Laplacian.
        """
        return self.psd @ (self.area * self.q**order)

    def energy(self, solid: Solid = HALF_SPACE, modulus: ArrayLike = 1.0) -> NDArray:
        """Elastic energy of full contact per nominal area over E* [length], ``(..., n)``.

        A factor on E*, `modulus`, of every surface or ``(..., 1)`` of all, leaves films and skins
        as they are (Persson and Tosatti, doi:10.1063/1.1398300).
        """
        weight = self.area * self.q / 4
        if np.ndim(modulus) == 0:
            return self.psd @ (weight / solid.factor(self.q, modulus))
        factors = np.asarray(modulus)[..., None]
        shape = np.broadcast_shapes(factors.shape, self.q.shape)
        factor = np.broadcast_to(solid.factor(self.q, factors), shape)
        return np.sum(self.psd * (weight / factor), axis=-1)

    def up_to(self, q: float) -> SpectrumFamily:
        """The rings whose wave number is at most this: what was measured, or is held by heights."""
        counted = self.q <= q * (1 + 1e-9)
        return SpectrumFamily(self.q[counted], self.area[counted], self.psd[:, counted])

    def ending_rings(self, q: float) -> SpectrumFamily:
        """The same with rings about lower wave numbers that end here, where others begin."""
        inner, outer = self._edges
        reaches = (self.q <= q * (1 + 1e-9)) & (outer > q)
        area = np.where(reaches, np.pi * np.maximum(q**2 - inner**2, 0.0), self.area)
        return SpectrumFamily(self.q, area, self.psd)

    def above(self, q: float) -> SpectrumFamily:
        """The same without waves below a wave number, as a contact meets it that is smaller."""
        return self._cut(q, np.inf)

    def below(self, q: float) -> SpectrumFamily:
        """The waves that `above` leaves out."""
        return self._cut(0.0, q)

    def _cut(self, low: float, high: float) -> SpectrumFamily:
        """Waves between two wave numbers; of a ring that holds an end, a part."""
        if not self.is_drawn:
            band = max(low, self.band[0]), min(high, self.band[1])
            return SpectrumFamily.of(*self.spectra, lowest=band[0], highest=band[1])
        psd = self.psd * self._find_inside(low, high)
        is_smooth = ~psd.any(axis=1)
        psd[is_smooth, -1] = LEAST * self.variance()[is_smooth] / self.area[-1]
        kept = psd.any(axis=0)
        return SpectrumFamily(self.q[kept], self.area[kept], psd[:, kept])

    def _find_inside(self, low: float, high: float) -> NDArray:
        """Share of every ring between two wave numbers, evenly in its logarithm, ``(m,)``.

        Nearly as much energy is at one logarithm of the wave number as at another.
        """
        inner, outer = self._edges
        lowest, highest = np.log([max(low, np.finfo(float).tiny), high])
        inside = np.clip(np.log([inner, outer]), lowest, highest)
        return np.diff(inside, axis=0)[0] / np.log(outer / inner)

    @property
    def _edges(self) -> NDArray:
        """Ends of every ring, of which its wave number is the geometric mean, ``(2, m)``."""
        half = self.area / (2 * np.pi)
        outer = np.sqrt(half + np.hypot(half, self.q**2))
        return np.array([self.q**2 / outer, outer])

    @property
    def highest(self) -> float:
        """Wave number beyond which there are no waves."""
        if not self.is_drawn:
            return max(spectrum.band[1] for spectrum in self.spectra)
        return float(self._edges[1].max())

    def take(self, rows: NDArray | slice) -> SpectrumFamily:
        """Some of the surfaces, or all in another order."""
        spectra = () if self.is_drawn else np.array(self.spectra, dtype=object)[rows]
        return SpectrumFamily(self.q, self.area, self.psd[rows], tuple(spectra), self.band)

    def between(self, places: NDArray) -> SpectrumFamily:
        """Spectra between the first, at 0, and the second, at 1, evenly in the logarithm of C."""
        first, second = self.psd
        psd = first ** (1 - places[:, None]) * second ** places[:, None]
        return SpectrumFamily(self.q, self.area, psd)

    def __add__(self, other: SpectrumFamily) -> SpectrumFamily:
        """Family of pairs of rough solids, whose roughness is independent and adds."""
        if not (self.is_drawn or other.is_drawn):
            both = zip(self.spectra, other.spectra, strict=True)
            whole = SpectrumFamily.of(*(combine(first, second) for first, second in both))
            return whole._cut(*self.band)
        return SpectrumFamily(
            q=np.concatenate([self.q, other.q]),
            area=np.concatenate([self.area, other.area]),
            psd=np.concatenate([self.psd, other.psd], axis=1),
        )
