r"""Persson's multiscale theory of adhesion in the limit of short range (JKR's).

Roughness comes into sight from the longest wave on. With E* = 1, ``V = <|grad h|^2>/4`` of the
waves in sight and p the mean pressure, the pressure in contact performs a random walk in "time" V
from p on: P(sigma, V) obeys ``dP/dV = (1/2) d2P/dsigma2``, P(sigma, 0) = delta(sigma - p).
Contact is lost where the tension reaches sigma_a, ``P(-sigma_a, V) = 0``, and what remains is the
area ``A(V) = int P dsigma``. With w the adhesion length, a contact of area A whose finer waves are
not yet in sight carries the energy gamma per area,

    ``gamma A = w A_1 - int_V^V1 W(A) dV/q``,    ``W(A) = A [g + (1 - g) A^2]``,

A_1 the area at the finest scale, dV/q what the waves dV cost in full contact, g the weight that
partial contact has in the elastic energy (Yang & Persson 2008, doi:10.1088/0953-8984/20/21/215214:
0.45). A penny-shaped crack in a plane where an elastic half-space sticks to a rigid one has
K = 2 sigma (R/pi)^(1/2), and releases K^2/2 per area, half of what it does between two elastic
ones: it grows from ``sigma^2 = pi gamma/(2 R)``. Of one wavelength across, R = pi/q:

    ``sigma_a = (gamma q/2)^(1/2)``.

A single wave that a tension keeps from closing (Johnson 1995, `closed_forms.wave.AdhesiveWave`)
reaches 1.40 times this sigma_a in its trough when it snaps into full contact at zero load, and 1.17
times at the largest tension at which it snaps there. Full contact without flaws does not open.

Persson, Eur. Phys. J. E 8, 385 (2002), doi:10.1140/epje/i2002-10025-1; Persson & Scaraggi,
J. Chem. Phys. 141, 124701 (2014), doi:10.1063/1.4895789.

Simulated surfaces (H = 0.5 to 0.9, magnification 4 to 64) keep more than this says: where 5 % or
more remains, the share at weight 0.45 is a tenth of it in the median, at 0.1 six tenths, and at 0
three quarters. `share` is nearer. The pull-off tension at 0.45 is within a quarter
for H = 0.8, magnification 16 and w of 1 to 1.4 times the energy of full contact, too small below.

Numerics. The energy s = gamma A at the longest wave, what remains, and A there, one, are all that a
march to finer waves needs: it yields gamma = w at the end, so that w follows from s without
iteration over scales, and s from w by a search. The walk needs no grid of pressures: a free walk
that is beyond -sigma_a at V has met -sigma_a(V') at some V' before, whence exactly

    ``int erfc[(b - b')/(2 (V - V'))^(1/2)] (-dA') = erfc[(p + b)/(2 V)^(1/2)]``,

b = sigma_a(V), primes at V': an equation for what is lost in each step.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import erfc, inf, nan, sqrt

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq, minimize_scalar
from scipy.special import erfc as erfcs

from stickiness.arguments import number
from stickiness.spectrum.kinds import Shells, Spectrum

WEIGHT = 0.45  #: of the literature
# Least share that is told from nothing: towards the onset of adhesion the area vanishes as a small
# power of the share, so that smaller ones need ever more scales.
SMALLEST = 1e-6
MOST_SHELLS = 40  #: more shells of a window are put together
PER_DECADE = 8.0  #: of V, and as many of the wave number
FIRST = 0.02  #: V at the first node over the square of the distance to sigma_a: nothing lost yet
# Nodes before the last V, over V. In weak adhesion contact holds at the finest scales only.
LAST = np.geomspace(1e-3, 0.25, 6)
WIDEST = 1e-15  #: first node over the last, at least
FINER = 3.0  #: nodes for the area under pressure, where sigma_a sets in between two of them
TRIES = 100  #: at the area after one step
AGREEMENT = 1e-7  #: relative, of the area after one step
LOST = 1e-12  #: area that is none
SEARCH = 1e-6  #: of the work of adhesion: precision of what remains
SEARCH_TENSION = 1e-4  #: the same in the search for pull-off


@dataclass(frozen=True)
class MultiscaleAdhesion:
    """What the theory says that remains of the work of adhesion.

    Attributes
    ----------
    share : float
        Work of adhesion that remains at zero load over that of smooth surfaces, 0 to 1.
    area : float
        Area of contact over nominal area, at zero load.
    pull_off : float
        Largest mean tension [E*].
    """

    share: float
    area: float
    pull_off: float

    @property
    def approach(self) -> float:
        """Work of approach over the work of adhesion: `share`, for the theory knows no jumps."""
        return self.share

    @property
    def separation(self) -> float:
        """Work of separation over the work of adhesion: `share`, as the work of approach."""
        return self.share


def remaining_adhesion(
    spectrum: Spectrum,
    adhesion_length: float,
    weight: float = WEIGHT,
    nodes: float = 1.0,
    pull_off: bool = True,
) -> MultiscaleAdhesion:
    """Return what remains of adhesion on a rough surface at zero load, and the pull-off tension.

    Parameters
    ----------
    spectrum : Spectrum
        Of the heights.
    adhesion_length : float
        Work of adhesion over E* [length], positive.
    weight : float
        Weight g of small contacts in the elastic energy, 0 to 1.
    nodes : float
        Multiplies the number of scales. 1 errs by less than 0.2 % of the work of adhesion.
    pull_off : bool
        Whether to search for the pull-off tension, which takes most of the time; else it is NaN.

    Raises
    ------
    ValueError
        If an argument is out of range.
    """
    walk = _Walk.of(spectrum, weight, nodes)
    w = number("adhesion_length", adhesion_length)
    least = SMALLEST * w
    if walk.reach(least, 0.0)[0] > w:
        return MultiscaleAdhesion(0.0, 0.0, 0.0)
    s = _search(lambda x: walk.reach(x, 0.0)[0], w, least, w)
    tension = _pull_off(walk, w) if pull_off else nan
    return MultiscaleAdhesion(s / w, walk.reach(s, 0.0)[1], tension)


def area_fraction(
    spectrum: Spectrum,
    adhesion_length: float,
    pressure: float,
    weight: float = WEIGHT,
    nodes: float = 1.0,
) -> float:
    """Return the area of contact over the nominal one under a mean pressure.

    Parameters
    ----------
    spectrum, adhesion_length, weight, nodes
        As of `remaining_adhesion`.
    pressure : float
        Mean pressure [E*], positive.
    """
    walk = _Walk.of(spectrum, weight, FINER * nodes)
    w, pressure = number("adhesion_length", adhesion_length), number("pressure", pressure)
    # At the lower end nothing adheres at any scale, and all of full contact is to be paid for.
    lowest = -2 * spectrum.elastic_energy()
    s = _search(lambda x: walk.reach(x, pressure)[0], w, lowest, w)
    return walk.reach(s, pressure)[1]


def _pull_off(walk: _Walk, w: float) -> float:
    """Largest tension [E*] with a solution, over the ratios of tension to sigma_a at the start."""

    def tension(ratio):
        def end(s):
            return walk.reach(s, -ratio * walk.strength(s))[0]

        low, high = SMALLEST * w, w
        if end(low) > w:
            return 0.0
        return ratio * walk.strength(_search(end, w, low, high, SEARCH_TENSION))

    found = minimize_scalar(lambda x: -tension(x), bounds=(0.0, 1.0), options={"xatol": 1e-2})
    return float(-found.fun)


def _search(end, w, low, high, precision=SEARCH):
    """Energy s at which the march ends at `w`, to a fraction of w."""
    return float(
        brentq(lambda s: min(end(s), 1e9 * w) - w, low, high, xtol=precision * w, rtol=1e-9)
    )


@dataclass(frozen=True, eq=False)
class _Walk:
    """Marches of one spectrum from the longest to the shortest wave."""

    spectrum: Spectrum
    weight: float
    nodes: float
    edges: NDArray  #: V at which the wave number jumps, or where to look at it

    @classmethod
    def of(cls, spectrum, weight, nodes):
        if not isinstance(spectrum, Spectrum):
            raise ValueError(f"spectrum must be a Spectrum, got {type(spectrum).__name__}")
        weight = number("weight", weight, zero=True, most=1.0)
        nodes, spectrum = number("nodes", nodes), spectrum.averaged()
        if isinstance(spectrum, Shells):
            spectrum = group_shells(spectrum)
            q = spectrum.q
        else:
            count = int(np.ceil(nodes * (4 + PER_DECADE * np.log10(spectrum.magnification))))
            q = np.geomspace(spectrum.q0, spectrum.q1, count + 1)[1:]
            q[-1] = spectrum.q1
        return cls(spectrum, weight, nodes, spectrum.variance_below(q, 2) / 4)

    def strength(self, s):
        """Sigma_a [E*] at the longest wave."""
        return sqrt(max(s, 0.0) * self.spectrum.q0 / 2)

    def reach(self, s: float, pressure: float) -> tuple[float, float]:
        """Adhesion length and area at the finest scale that belong to the energy `s`.

        Parameters
        ----------
        s : float
            Energy at the longest wave over E* [length], negative where contact has to be forced.
        pressure : float
            Mean pressure [E*].
        """
        distance = pressure + self.strength(s)
        if distance <= 0:
            return inf, 0.0
        scales = self._scales(distance)
        lost = Absorbed(pressure, len(scales[0]))
        area, energy, gamma = 1.0, s, s
        for v, cost, q_before, q in zip(*(x.tolist() for x in scales), strict=True):
            before = sqrt(max(gamma, 0.0) * q_before / 2)
            area, energy = self._step(lost, (v, cost, q), before, (area, energy))
            if area <= 0:
                return inf, 0.0
            gamma = energy / area
        return float(gamma), float(area)

    def _step(self, lost, scale, before, state):
        """Area and energy at the next node."""
        (v, cost, q), (old, energy) = scale, state

        def carry(area):
            mean = (old + area) / 2
            return energy + cost * mean * (self.weight + (1 - self.weight) * mean**2)

        area, step, change = old, 0.0, 0.0
        for _ in range(TRIES):
            boundary = sqrt(max(carry(area) / area, 0.0) * q / 2)
            last, change = change, lost.remaining(v, (before + boundary) / 2, boundary) - area
            if abs(change) <= AGREEMENT * area:
                break
            # Secants after the first try; halfway to zero at most.
            step = change if last in (0.0, change) else step * change / (last - change)
            step = min(max(step, -area / 2), old - area)
            if area < LOST:
                return 0.0, energy
            area += step
        lost.lose(v, (before + boundary) / 2, area)
        return area, carry(area)

    def _scales(self, distance):
        """V, cost of full contact, and wave number before and at it, of the nodes of a march."""
        last = self.edges[-1]
        first = np.clip(FIRST * distance**2, WIDEST * last, last / 10)
        count = int(np.ceil(self.nodes * PER_DECADE * np.log10(last / first)))
        end = last * (1 - LAST)
        v = np.union1d(np.geomspace(first, last, count)[:-1], np.append(end, self.edges))
        v = v[np.append(np.diff(v) > 1e-9 * v[1:], True)]
        q = self.spectrum.at_gradient_variance(4 * v)[0]
        stepwise = isinstance(self.spectrum, Shells)
        q_before = q if stepwise else np.append(self.spectrum.q0, q[:-1])
        cost = np.diff(v, prepend=0.0) * (1 / q_before + 1 / q) / 2
        return v, cost * (self.spectrum.elastic_energy() / cost.sum()), q_before, q


class Absorbed:
    """What a random walk has lost at a boundary -b that recedes: the integral equation above.

    Parameters
    ----------
    start : float
        Where the walk starts.
    most : int
        Steps at most.
    """

    def __init__(self, start: float, most: int):
        self.start, self.count, self.v, self.area = start, 0, 0.0, 1.0
        self._when, self._where, self._much = np.zeros((3, most))

    def remaining(self, v: float, middle: float, boundary: float) -> float:
        """Return what is left at `v`, with b at `middle` halfway and `boundary` at the end."""
        i = self.count
        away = (boundary - self._where[:i]) / np.sqrt(2 * (v - self._when[:i]))
        beyond = erfc((self.start + boundary) / sqrt(2 * v)) - self._much[:i] @ erfcs(away)
        own = erfc((boundary - middle) / sqrt(v - self.v))
        lost = beyond / own if own > 0 else 0.0
        return self.area - min(max(lost, 0.0), self.area)

    def lose(self, v: float, middle: float, area: float) -> None:
        """Accept that `area` is left at `v`."""
        i = self.count
        self._when[i], self._where[i] = (self.v + v) / 2, middle
        self._much[i] = self.area - area
        self.count, self.v, self.area = i + 1, v, area


def group_shells(shells: Shells, most: int = MOST_SHELLS) -> Shells:
    """Return shells put together to at most `most`, with equal slope and energy of full contact."""
    if len(shells.q) <= most:
        return shells
    bins = np.geomspace(shells.q0, shells.q1, most + 1)[1:-1]
    index = np.searchsorted(bins, shells.q, side="right")
    slope, energy = (
        np.bincount(index, shells.variance * shells.q**power, minlength=most) for power in (2, 1)
    )
    there = energy > 0
    q = slope[there] / energy[there]
    return Shells(q, slope[there] / q**2)
