"""Spectra of independent roughness that adds up, such as two rough solids in contact."""

from __future__ import annotations

from functools import reduce

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import elementwise

from stickiness.arguments import nonnegative
from stickiness.spectrum.interface import Spectrum, check_cut
from stickiness.spectrum.kinds import Shells

_ALIKE = 1e-9  # shells or knots that much apart, relatively, are one
_STEPS = 64  # of the table in ln q that inversion starts from, besides the knots
_PRECISION = 4e-16  # of ln q


def combine(first: Spectrum, *others: Spectrum) -> Spectrum:
    """Spectrum of rough solids that press on each other: their roughness is independent and adds.

    Parameters
    ----------
    first, *others : Spectrum
        Of each solid: either all are discrete spectra of periodic windows (`Shells`), or none.

    Returns
    -------
    Spectrum
        C = C_1 + C_2 + ...: shells of shells, else a `Sum`.

    Raises
    ------
    ValueError
        If an argument is no spectrum, or if shells are to be added to a density.

    Examples
    --------
    >>> from stickiness.spectrum import SelfAffine
    >>> rough = SelfAffine(hurst=0.8, q0=1.0, q1=64.0, h_rms=3.0)
    >>> round(combine(rough, SelfAffine(hurst=0.6, q0=2.0, q1=500.0, h_rms=4.0)).h_rms, 12)
    5.0
    """
    spectra = (first, *others)
    for one in spectra:
        if not isinstance(one, Spectrum):
            raise ValueError(
                f"combine takes spectra one by one, combine(*spectra), got {type(one).__name__}"
            )
    shells = [one.is_discrete for one in spectra]
    if all(shells):
        return reduce(_merge_shells, spectra)
    if any(shells):
        raise ValueError(
            "combine: shells and a density have no common form; take surface.lattice_spectrum of "
            "the density on the window of the shells"
        )
    parts = [part for one in spectra for part in getattr(one, "parts", (one,))]
    return Sum(*parts) if len(parts) > 1 else first


class Sum(Spectrum):
    """Sum of the densities of independent surfaces; see `combine`.

    Its surfaces have the sum of the mode variances of the parts, each part with a prescribed h_rms
    being scaled to it.
    """

    def __init__(self, *parts: Spectrum):
        self.parts = parts
        self.q0, self.q1 = min(part.q0 for part in parts), max(part.q1 for part in parts)
        self.isotropic = all(part.isotropic for part in parts)
        self.anisotropy = self._weigh([part.anisotropy for part in parts])

    @property
    def knots(self) -> NDArray:
        """Wave numbers, both ends included, between which C is smooth if it is isotropic."""
        q = np.sort(np.concatenate([part.knots for part in self.parts]))
        kept = q[_find_first(q)]
        kept[-1] = q[-1]
        return kept

    @property
    def band(self) -> tuple[float, float]:
        low, high = zip(*(part.band for part in self.parts), strict=True)
        return min(low), max(high)

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
        return sum(part.psd(q) for part in self.parts)

    def averaged(self) -> Spectrum:
        return self if self.isotropic else Sum(*(part.averaged() for part in self.parts))

    def total_variance(self, power: float = 0) -> float:
        return sum(part.total_variance(power) for part in self.parts)

    def variance_below(self, q: ArrayLike, power: float = 0) -> NDArray:
        return sum(part.variance_below(q, power) for part in self.parts)

    def variance_above(self, q: ArrayLike, power: float = 0) -> NDArray:
        return sum(part.variance_above(q, power) for part in self.parts)

    def at_gradient_variance(self, variance: ArrayLike) -> tuple[NDArray, NDArray]:
        (variance,) = nonnegative(variance=variance)
        low, high = np.log(self.band)
        table = np.union1d(np.log(self.averaged().knots), np.linspace(low, high, _STEPS))
        known = self.variance_below(np.exp(table), 2)
        i = np.clip(np.searchsorted(known, variance, side="right") - 1, 0, len(table) - 2)
        # Rounding aside, each lies between its two of the table.
        target = np.clip(variance, known[i], known[i + 1])

        def excess(log_q, target):
            return self.variance_below(np.exp(log_q), 2) - target

        tolerances = {"xatol": _PRECISION, "xrtol": _PRECISION, "fatol": 0.0, "frtol": 0.0}
        found = elementwise.find_root(
            excess, (table[i], table[i + 1]), args=(target,), tolerances=tolerances
        )
        # Bands that do not meet leave a range of q without waves.
        log_q = np.where(known[i] == known[i + 1], table[i], found.x)
        q = np.clip(np.exp(log_q), *self.band)
        return q, self.variance_above(q)

    def truncated(self, q1: float) -> Spectrum:
        """Return the sum of the same spectra cut at `q1`, each of its norm."""
        check_cut(self, q1)
        kept = [part for part in self.parts if part.q0 < q1]
        cut = [part.truncated(q1) if part.q1 > q1 else part for part in kept]
        return Sum(*cut) if len(cut) > 1 else cut[0]

    def modes_in_band(self, i: NDArray, j: NDArray, dq: float) -> NDArray:
        """Whether lattice vectors lie in the band of any part."""
        return np.any([part.modes_in_band(i, j, dq) for part in self.parts], axis=0)

    def rank_modes(self, i: NDArray, j: NDArray) -> NDArray:
        """See `Spectrum.rank_modes`: the parts have no common norm, ``|q|`` ranks them."""
        return i**2 + j**2

    def mode_variance(self, i: NDArray, j: NDArray, dq: float) -> NDArray:
        """Sum of what the parts contribute, each scaled to its prescribed h_rms."""
        total = 0
        for part in self.parts:
            inside = part.modes_in_band(i, j, dq)
            variance = np.zeros(len(i))
            variance[inside] = part.mode_variance(i[inside], j[inside], dq)
            if part.prescribed == "h_rms" and variance.any():
                variance *= part.h_rms**2 / (2 * variance.sum())
            total = total + variance
        return total

    def __repr__(self) -> str:
        return f"Sum({', '.join(map(repr, self.parts))})"


def _merge_shells(one: Shells, other: Shells) -> Shells:
    """Shells of both; those at one wave number, to rounding, hold the sum."""
    q = np.concatenate([one.q, other.q])
    order = np.argsort(q, kind="stable")
    q, variance = q[order], np.concatenate([one.variance, other.variance])[order]
    first = _find_first(q)
    return Shells(q[first], np.add.reduceat(variance, first))


def _find_first(q: NDArray) -> NDArray:
    """Indices of the first of those, in ascending order, that are one to rounding."""
    return np.flatnonzero(np.append(True, np.diff(q) > _ALIKE * q[1:]))
