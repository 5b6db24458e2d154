"""Compliance of an elastic half-space, of layers and of skins on a half-space, wave by wave.

A pressure wave ``p_q`` displaces the surface of a solid by ``u_q = (2/|q|) S p_q/E*``. E* is the
plane-strain modulus of the material at the surface, i.e. of the layer, but of the half-space below
a skin. S, the `factor`, is one for a half-space and for short waves, and a function of
``k = |q| d`` for a layer of thickness d:

- free to slip on a rigid base: ``S = (cosh 2k - 1)/(sinh 2k + 2k)``;
- bonded to a rigid base: ``S = [a sinh 2k - 2k]/[a cosh 2k + 2 k^2 + 5 - 12 nu + 8 nu^2]``, with
  ``a = 3 - 4 nu`` (Carbone and Mangialardi 2008, doi 10.1016/j.jmps.2007.05.009).

Below a skin S is one for long waves, and E*/E1* for short ones, with E1* of the skin: see `Skin`.

The code regroups numerator and denominator into sums of terms that do not cancel. Displacements
have no mean: mean gaps, energies and works of adhesion do not depend on how a layer as a whole
yields, by `mean_compliance` times the mean pressure.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.arguments import number, plain, positive

LEAST_SCALE = 1e-30  #: thickness times wave number of layers that floats can carry


class _Compliant(ABC):
    """What follows from the compliance over that of a half-space."""

    @abstractmethod
    def factor(self, q: ArrayLike, modulus: ArrayLike = 1.0) -> float | NDArray:
        """Compliance over that of a half-space, with E* times `modulus`.

        Films and skins keep their stiffness.
        """

    def compliance(self, q: ArrayLike) -> float | NDArray:
        """Displacement per pressure u_q E*/p_q = 2 S/q [length] of waves `q` > 0 [1/length]."""
        (q,) = positive(q=q)
        return plain(2 / q * self.factor(q))

    def stiffness(self, q: ArrayLike) -> float | NDArray:
        """Pressure per displacement p_q/(u_q E*) [1/length] of waves `q` > 0 [1/length]."""
        (q,) = positive(q=q)
        return plain(q / 2 / self.factor(q))


class _Deep(_Compliant):
    """What half-spaces have in common, with a skin or without."""

    mean_compliance = 0.0  # undefined; displacements are counted from their mean

    def strain(self, h_rms: ArrayLike, q0: ArrayLike) -> float | NDArray:
        """Strain that conforming demands of the whole depth: none."""
        return plain(np.zeros(np.broadcast_shapes(np.shape(h_rms), np.shape(q0))))


@dataclass(frozen=True)
class HalfSpace(_Deep):
    """Elastic half-space: the default everywhere."""

    def factor(self, q: ArrayLike, modulus: ArrayLike = 1.0) -> float:
        """Compliance over that of a half-space: one."""
        return 1.0

    def in_unit(self, length: float) -> HalfSpace:
        """Return the solid with `length` as the unit of length."""
        return self


@dataclass(frozen=True)
class Film:
    """Elastic film, free on its back, that a layer is bonded to, such as the film of a tape.

    It yields by bending as a plate: a pressure wave moves it by ``p/(D q^4)``, with ``D = E t^3/(12
    (1 - nu^2))``, besides the layer as on a rigid base (Timoshenko and Woinowsky-Krieger, Theory of
    Plates and Shells, 1959). Waves must be long against its thickness to bend it noticeably.

    Parameters
    ----------
    modulus_ratio : float
        Young's modulus of the film over that of the layer, positive.
    poisson : float
        Poisson's ratio of the film, 0 to 0.5.
    thickness : float
        Thickness t [length], positive.
    """

    modulus_ratio: float
    poisson: float
    thickness: float

    def __post_init__(self):
        _set(self, "modulus_ratio", number("modulus_ratio", self.modulus_ratio))
        _set(self, "poisson", number("poisson", self.poisson, zero=True, most=0.5))
        _set(self, "thickness", number("thickness", self.thickness))


@dataclass(frozen=True)
class Layer(_Compliant):
    """Elastic layer on a rigid base or on a film.

    Parameters
    ----------
    thickness : float
        Thickness d [length], positive.
    poisson : float
        Poisson's ratio nu, 0 to 0.5; exactly 0.5 for an incompressible layer.
    backing : {"bonded", "slip"} or Film
        Bonded to a rigid base, free to slip on it without friction, or bonded to a film that bends.

    Examples
    --------
    >>> rubber = Layer(thickness=1.0, poisson=0.5)
    >>> print(f"{rubber.compliance(0.01):.3e}")  # (4/3) q^2 d^3: long waves hardly move it
    1.333e-04
    >>> rubber.mean_compliance
    0.0
    """

    thickness: float
    poisson: float
    backing: Literal["bonded", "slip"] | Film = "bonded"

    def __post_init__(self):
        _set(self, "thickness", number("thickness", self.thickness))
        _set(self, "poisson", number("poisson", self.poisson, zero=True, most=0.5))
        if not (self.backing in ("bonded", "slip") or isinstance(self.backing, Film)):
            raise ValueError(
                "backing must be 'bonded', 'slip' or a Film(modulus_ratio, poisson, thickness), "
                f"got {self.backing!r}"
            )

    @property
    def mean_compliance(self) -> float:
        """Compression per uniform pressure, times E* [length].

        ``d (1 - 2 nu)/(1 - nu)^2``. The layer is wide and cannot spread, on a base that it sticks
        to or slips on alike.
        """
        return self.thickness * (1 - 2 * self.poisson) / (1 - self.poisson) ** 2

    def factor(self, q: ArrayLike, modulus: ArrayLike = 1.0) -> float | NDArray:
        """Compliance over that of a half-space, S, of waves `q` >= 0 [1/length].

        A factor on E*, `modulus`, leaves the film as it is.
        """
        k = self._scale(q)
        factor = np.ones(k.shape)
        is_long = k < 25.0  # beyond, S is 1 to rounding
        on_base = self._slipping if self.backing == "slip" else self._bonded
        factor[is_long] = on_base(k[is_long])
        if isinstance(self.backing, Film):
            return plain(factor + np.asarray(modulus) * self._bending(self.backing, q))
        return plain(factor)

    def strain(self, h_rms: ArrayLike, q0: ArrayLike) -> float | NDArray:
        """Strain that conforming demands of the layer, order of magnitude.

        The rms height over the thickness d. Where the longest waves, of wave number `q0`, are
        longer than d and the layer sticks to its base, material that cannot be compressed has to
        flow along it: the flow between parallel plates shears it by 3/(q0 d) more. A film is taken
        for rigid, although its bending relieves the layer of long waves.
        """
        k = self._scale(q0)
        least = np.divide(h_rms, self.thickness)
        if self.backing == "slip":
            return plain(least + 0 * k)
        flow = k**2 * 4 / 3 * (1 - self.poisson) ** 2  # over compression, in incompressible layers
        return plain(least * np.maximum(1.0, 3 * flow / (flow + (1 - 2 * self.poisson)) / k))

    def in_unit(self, length: float) -> Layer:
        """Return the solid with `length` as the unit of length."""
        backing = self.backing
        if isinstance(backing, Film):
            backing = replace(backing, thickness=backing.thickness / length)
        return replace(self, thickness=self.thickness / length, backing=backing)

    def _scale(self, q: ArrayLike) -> NDArray:
        """Wave numbers `q` times the thickness; ValueError if floats cannot carry their cubes."""
        q = np.asarray(q, dtype=float)
        with np.errstate(over="ignore"):
            k = np.minimum(q * self.thickness, 1 / LEAST_SCALE)  # beyond, a half-space
        if np.any((k < LEAST_SCALE) & (q > 0)):
            raise ValueError(
                f"thickness = {self.thickness!r} is out of proportion to the waves, of wave number "
                f"{np.min(q):.3g} to {np.max(q):.3g}: give both in one unit of length"
            )
        return k

    def _bending(self, film: Film, q: ArrayLike) -> NDArray:
        """What bending of the film adds to S: E*/(2 D q^3)."""
        stiffness = film.modulus_ratio * (1 - self.poisson**2) / (1 - film.poisson**2)
        thin = np.asarray(q, dtype=float) * film.thickness
        return 6 / (stiffness * np.maximum(thin, np.finfo(float).tiny ** 0.25) ** 3)

    def _slipping(self, k: NDArray) -> NDArray:
        """S on a rigid base without friction.

        Numerator and denominator are multiplied by 2 exp(-2k) = 2 (1 + d), d = exp(-2k) - 1.
        """
        d = np.expm1(-2 * k)
        denominator = -d * (2 + d) + 4 * k * (1 + d)
        return d**2 / np.where(k > 0, denominator, 1.0)

    def _bonded(self, k: NDArray) -> NDArray:
        """S on a rigid base that it sticks to.

        Numerator and denominator are multiplied by 2 exp(-2k), and regrouped so that all terms are
        positive.
        """
        a = 3 - 4 * self.poisson
        compressible = 1 - 2 * self.poisson
        decay = np.exp(-2 * k)
        odd, even = _less_leading_terms(2 * k)
        numerator = (2 * a * odd) / 2 + 4 * (2 * compressible) * k * decay
        denominator = (2 * a * even) / 2
        denominator += ((1 + a) ** 2 + 4 * (4 * (1 - self.poisson)) * k**2) * decay
        return numerator / denominator


@dataclass(frozen=True)
class Skin(_Deep):
    """Elastic half-space below a skin that is bonded to it: an oxide, a paint, an aged surface.

    E* is that of the half-space. With ``g`` the shear modulus of the skin over that of the
    half-space, ``a = 3 - 4 nu``, index 1 for the skin, 2 for the half-space, ``k = |q| t``, and

    ``b = 8 g (1 - nu1) (1 - nu2)``, ``c = a2 g^2 + 2 g (1 - 2 nu1) (1 - 2 nu2) + a1``,

    S is E*/E1* times::

          b cosh 2k + c (sinh 2k - 2k) + 4 [a2 g^2 + 1 - 2 nu1 - 2 g nu1 (1 - 2 nu2)] k
        ----------------------------------------------------------------------------------------
        b sinh 2k + c (cosh 2k - 1 - 2k^2) + 8 (1 - nu1)^2 + 8 (1 - nu1) [1 + g (1 - 2 nu2)] k^2

    This is Burmister's solution for two layers (1945, doi 10.1063/1.1707558), regrouped so that no
    terms cancel. Stiff skins carry short waves alone, and bend as plates under long ones.

    Parameters
    ----------
    thickness : float
        Thickness t of the skin [length], positive.
    modulus_ratio : float
        Young's modulus of the skin over that of the half-space, positive.
    skin_poisson : float
        Poisson's ratio of the skin, 0 to 0.5.
    poisson : float
        Poisson's ratio of the half-space, 0 to 0.5.

    Examples
    --------
    >>> oxidised = Skin(thickness=0.1, modulus_ratio=1000.0, skin_poisson=0.35, poisson=0.5)
    >>> print(f"{oxidised.factor(0.01):.3f} {oxidised.factor(10.0):.5f}")
    1.000 0.00856
    """

    thickness: float
    modulus_ratio: float
    skin_poisson: float
    poisson: float

    def __post_init__(self):
        _set(self, "thickness", number("thickness", self.thickness))
        _set(self, "modulus_ratio", number("modulus_ratio", self.modulus_ratio))
        for name in ("skin_poisson", "poisson"):
            _set(self, name, number(name, getattr(self, name), zero=True, most=0.5))

    def factor(self, q: ArrayLike, modulus: ArrayLike = 1.0) -> float | NDArray:
        """Compliance over that of the half-space alone, S, of waves `q` >= 0 [1/length].

        A factor on E*, `modulus`, leaves the skin as it is.
        """
        skin = 1 - self.skin_poisson
        deep = 1 - self.poisson
        skin_volume = 1 - 2 * self.skin_poisson  # zero if incompressible
        deep_volume = 1 - 2 * self.poisson
        g = self.modulus_ratio / modulus * (1 + self.poisson) / (1 + self.skin_poisson)
        # The coefficients over g, so that squares of large and small ratios do not overflow.
        both = 8 * skin * deep
        common = (3 - 4 * self.poisson) * g
        common += 2 * skin_volume * deep_volume + (3 - 4 * self.skin_poisson) / g
        linear = 4 * (
            (3 - 4 * self.poisson) * g + skin_volume / g - 2 * self.skin_poisson * deep_volume
        )
        square = 8 * skin * (1 / g + deep_volume)

        # Numerator and denominator times 2 exp(-2k).
        with np.errstate(over="ignore"):
            k = np.minimum(np.multiply(q, self.thickness), 1 / LEAST_SCALE)
        decay = np.exp(-2 * k)
        odd, even = _less_leading_terms(2 * k)
        numerator = both * (1 + decay**2) + common * odd + 2 * linear * k * decay
        denominator = both * -np.expm1(-4 * k) + common * even
        denominator += 2 * (8 * skin**2 / g + square * k**2) * decay
        return plain(skin / (g * deep) * (numerator / denominator))

    def in_unit(self, length: float) -> Skin:
        """Return the solid with `length` as the unit of length."""
        return replace(self, thickness=self.thickness / length)


Solid = HalfSpace | Layer | Skin  #: what the solvers and theories take
HALF_SPACE = HalfSpace()  #: their default


def check_solid(solid: Solid) -> Solid:
    """Return a solid; ValueError for anything else."""
    if not isinstance(solid, Solid):
        got = f"the class {solid.__name__}" if isinstance(solid, type) else repr(solid)
        raise ValueError(
            "solid must be solids.HalfSpace() or a solids.Layer(...) or solids.Skin(...), "
            f"got {got}"
        )
    return solid


def _set(frozen: Film | Layer | Skin, name: str, value: float) -> None:
    object.__setattr__(frozen, name, value)


def _less_leading_terms(x: NDArray) -> tuple[NDArray, NDArray]:
    """Return sinh x - x and cosh x - 1 - x^2/2, both times 2 exp(-x), without cancellation."""
    decay = np.exp(-x)
    odd = np.array(-np.expm1(-2 * x) - 2 * x * decay)
    even = np.array(1 + decay**2 - (2 + x**2) * decay)

    # Where the terms cancel, the series sinh x - x = x^3 (1/6 + ...) and
    # cosh x - 1 - x^2/2 = x^4/2 (1/12 + ...), summed from their last terms.
    is_small = x < 1.5
    x2 = x[is_small] ** 2
    decay = decay[is_small]
    sinh_series = np.zeros_like(x2)
    cosh_series = np.zeros_like(x2)
    for n in range(12, 0, -1):
        sinh_series = (1 + sinh_series * x2) / ((2 * n) * (2 * n + 1))
        cosh_series = (1 + cosh_series * x2) / ((2 * n + 1) * (2 * n + 2))
    odd[is_small] = 2 * decay * x[is_small] * x2 * sinh_series
    even[is_small] = decay * x2**2 * cosh_series
    return odd, even
