"""Traction laws of adhesion. To add one, write its class here and name it in `LAWS`.

Pressures are in units of the plane-strain modulus E*, tension positive for tractions; gaps, ranges
and the adhesion length l_a = (work of adhesion)/E* share one unit of length. A gap of zero is where
the hard wall of the repulsive solution begins. A law is a small class: its `evaluate`, its
strength, and how it is to be solved (`hard_wall`, `smooth`).
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.arguments import number

# Separation over range at which the traction of the 9-3 law peaks: (range/g)^6 = 1/3.
_LJ_PEAK = 3.0 ** (1 / 6)


@dataclass(frozen=True)
class TractionLaw(ABC):
    """Attraction between two smooth half-spaces at a uniform gap.

    Parameters
    ----------
    adhesion_length : float
        Work of adhesion over E* [length]; the integral of the traction over the gap.
    range : float
        Range of attraction epsilon [length].

    Examples
    --------
    >>> law = Maugis(adhesion_length=1e-4, range=1e-3)
    >>> print(law.traction([0.0, 0.5e-3, 2e-3]))
    [0.1 0.1 0. ]
    """

    adhesion_length: float
    range: float
    #: Whether a wall at gap 0 repels: the traction must then not rise with the gap. If not, the law
    #: itself repels, and gaps must exceed -range.
    hard_wall: ClassVar[bool] = True
    #: Whether the traction is continuous beyond the wall; where it is not it must jump at `range`
    #: between constants, as in the law of Maugis.
    smooth: ClassVar[bool] = True
    strength_ratio: ClassVar[float] = 1.0  #: strength over `maugis_stress`

    def __post_init__(self):
        number("adhesion_length", self.adhesion_length)
        number("range", self.range)

    @property
    def maugis_stress(self) -> float:
        """Return sigma_0/E* = adhesion_length/range, the traction of the Maugis law."""
        return self.adhesion_length / self.range

    @property
    def strength(self) -> float:
        """Largest traction [E*], the theoretical strength of the interface."""
        return self.strength_ratio * self.maugis_stress

    @property
    def maugis_range(self) -> float:
        """Range [length] of the Maugis law of equal work of adhesion and strength."""
        return self.range / self.strength_ratio

    @property
    def strength_gap(self) -> float:
        """Gap of the largest traction [length], beyond which it never rises again."""
        return 0.0

    @abstractmethod
    def evaluate(self, gap: ArrayLike) -> tuple[NDArray, NDArray, NDArray]:
        """Traction, derivative and potential at `gap`, in the units of the methods below."""

    def traction(self, gap: ArrayLike) -> NDArray:
        """Traction [E*] at `gap` [length], positive where the surfaces attract."""
        return self.evaluate(gap)[0]

    def derivative(self, gap: ArrayLike) -> NDArray:
        """Derivative of the traction with respect to the gap [E*/length]."""
        return self.evaluate(gap)[1]

    def potential(self, gap: ArrayLike) -> NDArray:
        """Energy per area over E* [length], zero at infinite gap; its slope is the traction."""
        return self.evaluate(gap)[2]


@dataclass(frozen=True)
class Maugis(TractionLaw):
    """Constant traction up to the range, none beyond.

    sigma = adhesion_length/range for gap <= range, else 0. The point gap = range is inside, so that
    the traction and `dmt.attractive_area` count the same points. Maugis, J. Colloid Interface Sci.
    150, 243 (1992), doi:10.1016/0021-9797(92)90285-T.
    """

    smooth: ClassVar[bool] = False

    def evaluate(self, gap: ArrayLike) -> tuple[NDArray, NDArray, NDArray]:
        gap = np.asarray(gap, dtype=float)
        traction = np.where(gap <= self.range, self.maugis_stress, 0.0)
        potential = -self.maugis_stress * np.maximum(self.range - gap, 0.0)
        return traction, np.zeros_like(gap), potential


@dataclass(frozen=True)
class Exponential(TractionLaw):
    """Traction that decays exponentially, sigma = (adhesion_length/range) exp(-gap/range)."""

    def evaluate(self, gap: ArrayLike) -> tuple[NDArray, NDArray, NDArray]:
        # In single precision if the gaps are.
        traction = self.maugis_stress * np.exp(np.asarray(gap) / -self.range)
        return traction, traction / -self.range, traction * -self.range


@dataclass(frozen=True)
class VanDerWaals(TractionLaw):
    """Van der Waals attraction of half-spaces, cut off by a hard wall.

    sigma = (2 adhesion_length/range) (range/g)^3 with g = gap + range: the range is the cut-off
    distance D0, and A_H/(6 pi g^3) follows from w = A_H/(12 pi D0^2). Israelachvili, Intermolecular
    and Surface Forces, 3rd ed. (2011), chapter 13, isbn:978-0-12-375182-9.
    """

    strength_ratio: ClassVar[float] = 2.0

    def evaluate(self, gap: ArrayLike) -> tuple[NDArray, NDArray, NDArray]:
        # In single precision if the gaps are.
        s = 1 / (1 + np.asarray(gap) / self.range)
        traction = self.strength * s**3
        return traction, traction * s * (-3 / self.range), s**2 * -self.adhesion_length


@dataclass(frozen=True)
class LennardJones(TractionLaw):
    """Lennard-Jones 9-3 law between half-spaces, which also repels below gap 0.

    sigma = (8 adhesion_length/(3 range)) [(range/g)^3 - (range/g)^9] with g = gap + range, so that
    gap 0 is the equilibrium separation. All methods need gap > -range.
    """

    hard_wall: ClassVar[bool] = False
    strength_ratio: ClassVar[float] = 16 / 9 / 3.0**0.5  # reached at `strength_gap`

    @property
    def strength_gap(self) -> float:
        return (_LJ_PEAK - 1) * self.range

    def evaluate(self, gap: ArrayLike) -> tuple[NDArray, NDArray, NDArray]:
        separation = np.asarray(gap, dtype=float) + self.range
        if not np.all(separation > 0):
            raise ValueError(
                f"gap must exceed -range = {-self.range!r}, got {separation.min() - self.range!r}"
            )
        s = self.range / separation
        stress = self.maugis_stress
        traction = 8 / 3 * stress * (s**3 - s**9)
        derivative = 8 * stress / self.range * (3 * s**10 - s**4)
        return traction, derivative, -self.adhesion_length * (4 * s**2 - s**8) / 3


EXPONENTIAL = "exponential"  #: the law that simulations are made with
#: Laws by the names that a configuration gives them.
LAWS: dict[str, type[TractionLaw]] = {
    "maugis": Maugis,
    EXPONENTIAL: Exponential,
    "van_der_waals": VanDerWaals,
}
#: Laws with which what remains of adhesion is predicted; with that of Maugis it was up to seven
#: times too small where attraction is weak.
PREDICTED = (EXPONENTIAL, "van_der_waals")


def find_strength(names: ArrayLike) -> NDArray:
    """Strength of laws, by their names in `PREDICTED`, over adhesion_length/range."""
    distinct, place = np.unique(names, return_inverse=True)
    unknown = set(distinct.tolist()) - set(PREDICTED)
    if unknown:
        raise ValueError(f"law must be one of {', '.join(PREDICTED)}, got {unknown.pop()!r}")
    strengths = np.array([LAWS[name].strength_ratio for name in distinct])
    return strengths[place].reshape(np.shape(names))


def check_law(law: TractionLaw) -> None:
    """Raise ValueError unless this is a traction law."""
    if not isinstance(law, TractionLaw):
        raise ValueError(f"law must be a TractionLaw such as Exponential(...), got {law!r}")
