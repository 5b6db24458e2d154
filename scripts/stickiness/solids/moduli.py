"""Moduli that depend on the rate: a Prony series, a table, or a constant.

The storage modulus E'(f) sets the elastic energy that competes with adhesion. After a dwell the
relaxation modulus E(t) replaces it, and dissipation at the edge of contact multiplies the work of
separation. Moduli in Pa, frequencies in Hz, times in s.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.arguments import number, plain, positive

REFERENCE_FREQUENCY = 1.0  #: Hz, Dahlquist's
NOISE = 0.05  #: relative, by which a measured storage modulus may fall with frequency
STEEPEST = 0.9  # power of a table with the frequency, up to which its losses follow from it


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

    def scaled(self, factor: float) -> Constant:
        """Return the modulus times a factor."""
        return Constant(factor * self.modulus)


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

    def scaled(self, factor: float) -> Prony:
        """Return the series with all moduli times a factor."""
        terms = tuple((factor * modulus, time) for modulus, time in self.terms)
        return Prony(factor * self.equilibrium, terms)

    def storage(self, frequency: ArrayLike) -> float | NDArray:
        """Storage modulus [Pa] at frequencies [Hz].

        equilibrium + sum of E_i x_i^2/(1 + x_i^2), x_i = 2 pi f tau_i (Ferry, Viscoelastic
        Properties of Polymers, 1980).
        """
        (frequency,) = positive(frequency=frequency)
        moduli, times = np.array(self.terms).T
        # From 1e100 on a term is E_i to rounding, and its square does not overflow.
        x = np.minimum(2 * np.pi * frequency[..., None] * times, 1e100)
        return plain(self.equilibrium + np.sum(moduli * x**2 / (1 + x**2), axis=-1))

    def relaxation(self, time: ArrayLike) -> float | NDArray:
        """Relaxation modulus E(t) [Pa] at times [s] after a step of the strain."""
        (time,) = positive(time=time)
        moduli, times = np.array(self.terms).T
        return plain(self.equilibrium + np.exp(-time[..., None] / times) @ moduli)

    def separation_factor(self, dwell: float, frequency: float) -> tuple[float, float, float]:
        """Factor by which dissipation at the edge of contact multiplies the work of separation.

        1/(1 - (2/pi) E(dwell) int_0^f (1 - (g/f)^2)^(1/2) Im(-1/E(g)) dg/g) by Persson and Brener
        (doi:10.1103/PhysRevE.71.036123), f the speed of the edge over the radius of its tip [Hz]. A
        term counts by the part of it that has relaxed in the dwell [s]; the rest carries stress as
        if it were at equilibrium. Limits: 1, of a slow edge, and of a fast one the instantaneous
        modulus over E(dwell). The value is that of an edge in steady motion in an infinite solid:
        see `criteria.pair.find_dissipation` for contacts in which it holds.
        """
        dwell = number("dwell", dwell)
        frequency = number("frequency", frequency)
        relaxed = float(self.relaxation(dwell))
        moduli, times = np.array(self.terms).T
        fast_edge = float(self.equilibrium + moduli.sum()) / relaxed
        factor = _find_edge_factor(relaxed, -moduli * np.expm1(-dwell / times), times, frequency)
        return float(np.clip(factor, 1.0, fast_edge)), 1.0, fast_edge


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
        fall = find_fall(self.moduli)
        rise = find_rise(self.frequencies, self.moduli)
        if rise is not None:
            raise ValueError(
                f"moduli[{rise}] = {self.moduli[rise]:g} Pa at {self.frequencies[rise]:g} Hz is "
                "too high: a storage modulus rises with the square of the frequency at most"
            )
        if fall is not None:
            raise ValueError(
                f"moduli[{fall}] = {self.moduli[fall]:g} Pa at {self.frequencies[fall]:g} Hz is "
                "below a modulus at a lower frequency: a storage modulus does not fall"
            )

    def scaled(self, factor: float) -> Table:
        """Return the table with all moduli times a factor."""
        return Table(self.frequencies, tuple(factor * modulus for modulus in self.moduli))

    def storage(self, frequency: ArrayLike) -> float | NDArray:
        """Storage modulus [Pa] at frequencies [Hz]; NaN beyond the table."""
        (frequency,) = positive(frequency=frequency)
        log_modulus = np.interp(
            np.log(frequency),
            np.log(self.frequencies),
            np.log(self.moduli),
            left=np.nan,
            right=np.nan,
        )
        return plain(np.exp(log_modulus))

    def relaxation(self, time: ArrayLike) -> float | NDArray:
        """Relaxation modulus E(t) [Pa] at times [s]: E' at omega = 2/(pi t); NaN beyond the table.

        Where E' goes with any power of the frequency it is off by less than 1.3 %, of a single
        relaxation by less than a tenth of its step.
        """
        (time,) = positive(time=time)
        return self.storage(relaxation_frequency(time))

    def separation_factor(self, dwell: float, frequency: float) -> tuple[float, float, float]:
        """Factor on the work of separation with its limits, as that of `Prony`; NaN beyond.

        A table has no loss modulus; that follows from `_find_spectrum`. The value is within 1.5 %
        where E' goes with a power of the frequency up to 0.9, and up to 21 % too low at a single
        relaxation. The high limit is as high as the table goes: its largest modulus, or the factor
        at its highest frequency where it still rises there.
        """
        relaxed = float(self.relaxation(number("dwell", dwell)))
        if np.isnan(self.storage(number("frequency", frequency)) * relaxed):
            return np.nan, 1.0, float(np.maximum(max(self.moduli) / relaxed, 1.0))
        moduli, times = self._find_spectrum()
        moduli = -moduli * np.expm1(-dwell / times)
        factor, highest = (
            _find_edge_factor(relaxed, moduli, times, f) for f in (frequency, self.frequencies[-1])
        )
        fast_edge = float(max(max(self.moduli) / relaxed, highest, 1.0))
        return float(np.clip(factor, 1.0, fast_edge)), 1.0, fast_edge

    def _find_spectrum(self) -> tuple[NDArray, NDArray]:
        """Moduli [Pa] and relaxation times [s] of a series, by the local power n of the table.

        H = (2/pi) sin(pi n/2) E' at the time 1/omega: exact where E' goes with a power of omega,
        whose loss modulus is then tan(pi n/2) E'. Beyond its ends the table goes on with the powers
        it has there.
        """
        step = 0.25  # of ln omega
        log_table = np.log(self.frequencies)
        log_moduli = np.log(self.moduli)
        slopes = np.clip(np.diff(log_moduli) / np.diff(log_table), 0.0, STEEPEST)
        # Two decades of slower terms, and as many of faster ones as it takes to sum their losses.
        log_frequency = np.arange(log_table[0] - 5.0, log_table[-1] + 46.0, step)
        log_storage = np.interp(log_frequency, log_table, log_moduli)
        log_storage += slopes[0] * np.minimum(log_frequency - log_table[0], 0)
        log_storage += slopes[-1] * np.maximum(log_frequency - log_table[-1], 0)
        power = np.clip(np.gradient(log_storage, step), 0.0, STEEPEST)
        moduli = 2 / np.pi * np.sin(np.pi / 2 * power) * np.exp(log_storage) * step
        return moduli, np.exp(-log_frequency) / (2 * np.pi)


def _find_edge_factor(relaxed: float, moduli: NDArray, times: NDArray, frequency: float) -> float:
    """Factor of Persson and Brener of a series that is `relaxed` at rest, see `Prony`."""
    omega = 2 * np.pi * frequency
    # With g = f/cosh(t) the integrand is smooth, even in t, and vanishes exponentially: the sum
    # converges as exp(-pi^2/step).
    step = 0.25
    most = 1 + moduli.sum() / relaxed
    t = np.arange(step, 40 + np.log1p(omega * times.max() * most), step)
    x = 1j * (omega / np.cosh(t))[:, None] * times
    modulus = relaxed + x / (1 + x) @ moduli
    lost = np.tanh(t) ** 2 @ (-1 / modulus).imag * step
    return float(1 / (1 - 2 / np.pi * relaxed * lost))


Modulus = Constant | Prony | Table


def find_fall(moduli: Sequence[float]) -> int | None:
    """Index of the first storage modulus that is below one before it by more than `NOISE`.

    The storage modulus of a solid that only relaxes does not fall with frequency.
    """
    if not len(moduli):
        return None
    highest = np.maximum.accumulate(np.asarray(moduli, dtype=float))
    falls = np.flatnonzero(np.asarray(moduli) < (1 - NOISE) * highest)
    return int(falls[0]) if falls.size else None


def find_rise(frequencies: Sequence[float], moduli: Sequence[float]) -> int | None:
    """Index of the first storage modulus that rises faster than the square of the frequency.

    That is how a single relaxation begins; a sum of several rises more slowly.
    """
    steepest = np.divide(frequencies[1:], frequencies[:-1]) ** 2
    rises = np.flatnonzero(np.divide(moduli[1:], moduli[:-1]) > (1 + NOISE) * steepest)
    return int(rises[0]) + 1 if rises.size else None


def relaxation_frequency(time: ArrayLike) -> ArrayLike:
    """Frequency [Hz] at which the storage modulus is about the relaxation modulus at a time [s]."""
    return 1 / (np.pi**2 * time)


def choose_factor(factor: tuple[ArrayLike, ArrayLike, ArrayLike], sign: ArrayLike) -> NDArray:
    """Value of a factor, or its low or high limit at `sign` -1 or +1; signs between interpolate.

    A value that is not known (NaN) is replaced by the low limit.
    """
    value, low, high = map(np.asarray, factor)
    value = np.where(np.isnan(value), low, value)
    towards_low = np.clip(np.negative(sign), 0, 1)
    towards_high = np.clip(sign, 0, 1)
    return value * (low / value) ** towards_low * (high / value) ** towards_high
