"""Moduli that depend on the rate: a Prony series, a table, or a constant.

The storage modulus E'(f) sets the elastic energy that competes with adhesion at a frequency f.
Dahlquist's limit is one on E' at 1 Hz. Dissipation adds to the work of adhesion; no criterion here
takes it into account. Moduli in Pa, frequencies in Hz, times in s.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.arguments import plain, positive

REFERENCE_FREQUENCY = 1.0  #: Hz, Dahlquist's
_GLASSY = 1e100  # x from which on a term is E_i to rounding; its square does not overflow


@dataclass(frozen=True)
class Constant:
    """Modulus of an elastic solid [Pa], the same at every frequency."""

    modulus: float

    def __post_init__(self):
        positive(modulus=self.modulus)

    def storage(self, frequency: ArrayLike) -> float | NDArray:
        """Storage modulus [Pa] at frequencies [Hz]."""
        (frequency,) = positive(frequency=frequency)
        return plain(np.full(frequency.shape, self.modulus))


@dataclass(frozen=True)
class Prony:
    """Relaxation modulus E(t) = equilibrium + sum of E_i exp(-t/tau_i)."""

    equilibrium: float  #: modulus at rest [Pa]
    terms: tuple[tuple[float, float], ...]  #: E_i [Pa] and tau_i [s]

    def __post_init__(self):
        positive(equilibrium=self.equilibrium)
        if not len(self.terms):
            raise ValueError("terms of a Prony series must not be empty; give a constant instead")
        (terms,) = positive(terms=self.terms)
        if terms.ndim != 2 or terms.shape[1] != 2:
            raise ValueError(f"terms must be pairs of modulus and time, got {self.terms!r}")

    def storage(self, frequency: ArrayLike) -> float | NDArray:
        """Storage modulus [Pa] at frequencies [Hz].

        equilibrium + sum of E_i x_i^2/(1 + x_i^2), x_i = 2 pi f tau_i (Ferry, Viscoelastic
        Properties of Polymers, 1980).
        """
        (frequency,) = positive(frequency=frequency)
        moduli, times = np.array(self.terms).T
        x = np.minimum(2 * np.pi * frequency[..., None] * times, _GLASSY)
        return plain(self.equilibrium + np.sum(moduli * x**2 / (1 + x**2), axis=-1))


@dataclass(frozen=True)
class Table:
    """Storage modulus as measured, interpolated in logarithms."""

    frequencies: tuple[float, ...]  #: increasing [Hz]
    moduli: tuple[float, ...]  #: [Pa]

    def __post_init__(self):
        frequencies, _ = positive(frequencies=self.frequencies, moduli=self.moduli)
        if len(self.frequencies) != len(self.moduli) or len(self.frequencies) < 2:
            raise ValueError("a table needs two pairs of frequency and modulus at least")
        if not np.all(np.diff(frequencies) > 0):
            raise ValueError(f"frequencies must increase, got {self.frequencies!r}")

    def storage(self, frequency: ArrayLike) -> float | NDArray:
        """Storage modulus [Pa] at frequencies [Hz]; NaN beyond the table."""
        (frequency,) = positive(frequency=frequency)
        x, y = np.log(self.frequencies), np.log(self.moduli)
        return plain(np.exp(np.interp(np.log(frequency), x, y, left=np.nan, right=np.nan)))


Modulus = Constant | Prony | Table


def crossings(modulus: Modulus, threshold: float, frequencies: NDArray) -> list[tuple[float, bool]]:
    """Frequencies at which the storage modulus passes a threshold [Pa], in ascending order.

    Crossings are looked for between neighbours of the increasing `frequencies`, those of a table
    too, and interpolated in logarithms. With each comes whether the modulus exceeds the threshold
    beyond.
    """
    frequencies, _ = positive(frequencies=frequencies, threshold=threshold)
    if frequencies.ndim != 1 or not np.all(np.diff(frequencies) > 0):
        raise ValueError(f"frequencies must be one increasing sequence, got {frequencies!r}")
    if isinstance(modulus, Table) and frequencies.size:
        inside = np.clip(modulus.frequencies, frequencies[0], frequencies[-1])
        frequencies = np.union1d(frequencies, inside)
    excess = np.log(np.asarray(modulus.storage(frequencies)) / threshold)
    a, b = excess[:-1], excess[1:]
    known = np.isfinite(a) & np.isfinite(b) & (a != 0)
    here = np.flatnonzero((np.sign(a) != np.sign(b)) & known)
    a, b, low, high = a[here], b[here], frequencies[here], frequencies[here + 1]
    passed = low * (high / low) ** (a / (a - b))
    return list(zip(passed.tolist(), (b > a).tolist(), strict=True))
