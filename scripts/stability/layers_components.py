"""Probes of elastic layers that need no contact solver: response, Persson's theory, prediction."""

from __future__ import annotations

from collections.abc import Iterator
from decimal import Decimal, localcontext
from functools import cache, lru_cache

import numpy as np

from stability.components import (
    SCALED,
    WIDE,
    Check,
    Component,
    compare,
    compare_each,
    model,
    require,
)
from stability.theory_components import find_area_error
from stickiness import remaining
from stickiness.persson.theory import Persson
from stickiness.remaining import Roughness
from stickiness.solids import HALF_SPACE, Layer, Solid

THICK = 40.0  # thickness times wave number from which a layer is a half-space to 1e-30
BACKINGS = {"bonded": "bonded", "slip": "slip"}

# --- Response: the boundary value problem of plane strain, in 150 digits. ---


def probe_layers(thickness, poisson, unit, variant) -> Iterator[Check]:
    yield from check_response(thickness, poisson, unit, BACKINGS[variant])


def check_response(thickness, poisson, unit, backing) -> Iterator[Check]:
    layer, q = Layer(thickness * unit, poisson, backing), 1 / unit
    expected = find_response(thickness, poisson, backing)
    yield compare_each("response", layer.factor(q), expected, 1e-12)
    yield compare_each("compliance", layer.compliance(q), 2 * unit * expected, 1e-12)
    yield compare_each("stiffness", layer.stiffness(q), 0.5 / unit / expected, 1e-12)
    yield compare_each("other unit", layer.in_unit(unit).factor(1.0), expected, 1e-12)
    if backing == "bonded" and poisson < 0.5:
        # Long waves find the mean compliance, by as much as (k^2 + k^3/(1 - 2 nu)).
        k = 1e-5 * (1 - 2 * poisson)
        found = layer.mean_compliance / unit / thickness
        yield compare_each("mean compliance", found, 2 * find_response(k, poisson, "bonded") / k)


@cache
def find_response(k: float, poisson: float, backing: str) -> float:
    """S of a wave of k = |q| d: shear-free surface under a unit pressure wave."""
    if k > THICK:
        return 1.0
    with localcontext(prec=150):
        nu, one = Decimal(poisson), Decimal(1)
        through = carry_down(grow_with_depth(one, nu), Decimal(k))
        eye = make_identity()
        # no displacements, or no shear and none downwards
        held = eye[:2] if backing == "bonded" else eye[1:3]
        (a, b, _, e), (c, d, _, f) = held @ through
        depth = (a * f - c * e) / (a * d - b * c)  # with zz = -1 and no shear at the surface
        return float(depth / (1 - nu))  # E* = 2/(1 - nu)


def make_identity():
    return np.array([[Decimal(int(i == j)) for j in range(4)] for i in range(4)])


def grow_with_depth(shear, nu):
    """Matrix of d/dz of (u sin x, w cos x, xz sin x, zz cos x), by equilibrium and Hooke's law."""
    zero, one = Decimal(0), Decimal(1)
    return np.array(
        [
            [zero, one, 1 / shear, zero],
            [-nu / (1 - nu), zero, zero, (1 - 2 * nu) / (2 * shear * (1 - nu))],
            [2 * shear / (1 - nu), zero, zero, nu / (1 - nu)],
            [zero, zero, -one, zero],
        ]
    )


def carry_down(growth, k):
    """Exponential of the matrix times k, by its double eigenvalues 1 and -1."""
    up = k.exp()
    sinh, cosh = (up - 1 / up) / 2, (up + 1 / up) / 2
    square = growth @ growth
    return (
        (cosh - k * sinh / 2) * make_identity()
        + (3 * sinh - k * cosh) / 2 * growth
        + k * sinh / 2 * square
        + (k * cosh - sinh) / 2 * (square @ growth)
    )


# --- What layers make of a spectrum, by quadrature in ln q. ---


def make_solid(variant: str, thickness: float, poisson: float, unit: float = 1.0) -> Solid:
    """Layer of thickness over 1/q0, in a unit of length."""
    return Layer(thickness * unit, poisson, BACKINGS[variant])


def soften(solid: Solid, unit: float = 1.0) -> float:
    """S of the longest waves, 1/q0 = unit."""
    return float(solid.factor(1 / unit))


@cache
def weigh_waves(hurst, magnification, solid, power) -> float:
    """Mean of (q/S)^power over the waves of a model spectrum, in units of q0."""
    x, w = np.polynomial.legendre.leggauss(20)
    edges = np.linspace(0, np.log(magnification), 2 + int(4 * np.log(magnification)))
    half = 0.5 * np.diff(edges)[:, None]
    log_q = edges[:-1, None] + half * (1 + x)
    q, variance = np.exp(log_q), half * w * np.exp(-2 * hurst * log_q)
    return float(np.sum(variance * (q / solid.factor(q)) ** power) / np.sum(variance))


# --- Persson's theory: area by the variance of pressure, energy by the mean gap, limits. ---


@lru_cache(maxsize=64)
def make_theory(hurst, magnification, q0_h_rms, unit, solid) -> Persson:
    return Persson(model(hurst, magnification, q0_h_rms, unit), solid=solid)


def probe_layer_theory(
    thickness, poisson, hurst, magnification, pressure, q0_h_rms, unit, variant
) -> Iterator[Check]:
    plain = make_solid(variant, thickness, poisson)
    solid = make_solid(variant, thickness, poisson, unit)
    surface = hurst, magnification, q0_h_rms, unit
    t, h_rms = make_theory(*surface, solid), q0_h_rms * unit
    unit_pressure = q0_h_rms / soften(plain)
    p = pressure * unit_pressure
    area, gap = float(t.area_fraction(p)), float(t.mean_gap(p))
    m2 = 0.5 * weigh_waves(hurst, magnification, plain, 2) * q0_h_rms**2
    yield require("sign", 0 <= area <= 1 and gap >= 0)
    yield Check("area", find_area_error("yang2008", p, area, m2), 1e-7)
    more = float(t.area_fraction(1.1 * p)), float(t.mean_gap(1.1 * p))
    yield Check("order of areas", area - more[0], 1e-12)
    yield Check("order of gaps", (more[1] - gap) / h_rms, 1e-12)
    if 1 - area > 1e-6 and gap > 1e-6 * h_rms and pressure > 1e-6:
        yield compare_each("load at the gap", t.pressure_at(gap), p, 1e-6)
    energy = weigh_waves(hurst, magnification, plain, 1) / 4 * q0_h_rms**2 * unit
    yield compare_each("energy of full contact", t.spectrum.elastic_energy(solid), energy)
    whole = integrate_gap(surface, solid, np.sqrt(m2))
    yield compare_each("mean gap over pressure", whole, energy, 1e-7)
    same = make_theory(hurst, magnification, 1.0, 1.0, plain)
    plain_pressure = pressure / soften(plain)
    yield Check("area, other unit", abs(area - float(same.area_fraction(plain_pressure))), SCALED)
    other = float(same.mean_gap(plain_pressure))
    yield Check("gap, other unit", abs(gap / h_rms - other) / max(other, 1e-12), 1e-7)
    if thickness > THICK:
        half = make_theory(*surface, HALF_SPACE)
        yield Check("area on a half-space", abs(area - float(half.area_fraction(p))), SCALED)
        other = abs(gap - float(half.mean_gap(p)))
        yield Check("gap on a half-space", other / max(gap, 1e-12 * h_rms), 1e-8)


@lru_cache(maxsize=64)
def integrate_gap(surface, solid, rms_pressure) -> float:
    """Integral of the mean gap over all pressures."""
    t = make_theory(*surface, solid)
    p = rms_pressure * np.exp(np.linspace(-36, 3, 200))
    return float(np.trapezoid(t.mean_gap(p) * p, np.log(p)))


# --- Prediction of what remains: order, bounds, energy, limits, and its own inverse. ---


def probe_layer_prediction(
    thickness, poisson, hurst, magnification, range_over_h_rms, adhesion_length_over_range, unit,
    variant,
) -> Iterator[Check]:  # fmt: skip
    plain = make_solid(variant, thickness, poisson)
    solid = make_solid(variant, thickness, poisson, unit)
    s, eps = model(hurst, magnification, 1.0, unit), range_over_h_rms * unit
    length = adhesion_length_over_range * eps / soften(plain)
    found = remaining.predict(s, length, eps, solid=solid)
    energy = weigh_waves(hurst, magnification, plain, 1) / 4 * unit
    yield compare_each("energy ratio", found.energy_ratio, length / energy)
    yield from check_prediction(found)
    stronger = remaining.predict(s, 1.1 * length, eps, solid=solid)
    yield Check("order", found.separation - stronger.separation, 1e-9)
    for name in ("separation_limits", "approach_limits"):
        falls = np.subtract(getattr(found, name), getattr(stronger, name))
        yield Check(f"order of {name}", float(falls.max()), 1e-9)
    same = remaining.predict(
        model(hurst, magnification), length / unit, range_over_h_rms, solid=plain
    )
    yield Check("other unit", abs(found.separation - same.separation), SCALED)
    yield compare("pull-off, other unit", found.pull_off, same.pull_off)
    rough = Roughness(s.h_rms, s.q0, energy, soften(plain))
    threshold = rough.threshold(eps)
    share = rough.share(threshold, eps)
    yield Check("share at the threshold", (0.1 - share) / 0.1, 1e-5)
    if threshold > 1e-11 * energy:
        yield compare_each("threshold", share, 0.1, 1e-5)
    if thickness > THICK:
        half = remaining.predict(s, length, eps)
        yield Check("share on a half-space", abs(found.separation - half.separation), SCALED)
        yield compare("pull-off on a half-space", found.pull_off, half.pull_off)


def check_prediction(found) -> Iterator[Check]:
    """Bounds and order of a prediction and its limits."""
    for name in ("approach", "separation", "pull_off"):
        value, (low, high) = getattr(found, name), getattr(found, f"{name}_limits")
        yield require(f"{name} within its limits", 0 <= low <= value <= high)
        if name != "pull_off":
            yield require(f"{name} at most all", high <= 1)
    yield require("area at zero load", 0 <= found.area_at_zero_load <= 1)
    left = 1 - 1 / found.energy_ratio
    yield Check("less than full contact leaves", left - found.separation, 1e-12)


_DEPTHS = (1e-8, 1e-6, 1e-4, 1e-2, 0.1, 0.5, 0.7, 0.8, 1, 3, 10, 24.9, 25.1, 100, 1e4, 1e6, 1e8)
_POISSON = (0, 0.1, 0.3, 0.45, 0.4999, 0.5 - 1e-12, 0.5)
_SURFACE = {
    "thickness": (1e-4, 1e-2, 0.1, 0.3, 1, 3, 30, 1e3, 1e4),
    "poisson": (0, 0.3, 0.49, 0.5 - 1e-12, 0.5),
    "magnification": (1.01, 8, 64, 1e4, 1e10),
    "hurst": (0.05, 0.5, 0.8, 1.0),
    "unit": (1e-9, 1, 1e3),
}

LAYERS = {
    "layers": Component(
        probe_layers,
        ("thickness", "poisson", "unit"),
        variants=("bonded", "slip"),
        values={"thickness": _DEPTHS, "poisson": _POISSON},
    ),
    "layer-theory": Component(
        probe_layer_theory,
        ("thickness", "poisson", "hurst", "magnification", "pressure", "q0_h_rms", "unit"),
        pairs=(("thickness", "pressure"), ("thickness", "poisson"), ("thickness", "magnification"),
               ("q0_h_rms", "unit")),
        variants=("bonded", "slip"),
        values=_SURFACE | {"q0_h_rms": (1e-9, 0.1, 10)},
    ),
    "layer-remaining": Component(
        probe_layer_prediction,
        ("thickness", "poisson", "hurst", "magnification", "range_over_h_rms",
         "adhesion_length_over_range", "unit"),
        pairs=(("thickness", "adhesion_length_over_range"), ("thickness", "range_over_h_rms"),
               ("range_over_h_rms", "adhesion_length_over_range"), ("thickness", "poisson")),
        variants=tuple(BACKINGS),
        reference={"adhesion_length_over_range": 1},
        values=_SURFACE | {name: WIDE[name] for name in WIDE if name != "magnification"},
    ),
}  # fmt: skip
