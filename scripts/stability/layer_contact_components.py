"""Probes of contact on elastic layers: equilibrium by plain transforms, half-space, springs."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

import numpy as np
from scipy.optimize import brentq

from stability.components import Check, Component, compare_each, require
from stability.contact_components import LAWS, SLACK, SURFACE, TOLERANCE, heights_of
from stability.layers_components import BACKINGS, THICK
from stickiness import adhesive
from stickiness.repulsive import solver
from stickiness.solids import HALF_SPACE, HalfSpace, Layer

_GRID, _HURST = 64, 0.8
_SPRINGS = 2e-4  # thickness times q0 up to which waves of the grid see springs, to (64 times it)^2
# Poisson's ratio and backing of a layer, by name.
SOLIDS = {
    "bonded incompressible": (0.5, "bonded"),
    "bonded compressible": (0.3, "bonded"),
    "bonded cork": (0.0, "bonded"),
    "slip": (0.5, "slip"),
}
_ADHESIVE = (
    *(f"{name} exponential pressure" for name in SOLIDS),
    "bonded incompressible exponential mean_gap",
    "bonded incompressible maugis pressure",
    "slip lennard_jones pressure",
)


@lru_cache(maxsize=64)
def lay(name, thickness, unit=1.0) -> Layer:
    poisson, backing = SOLIDS[name]
    return Layer(thickness * unit, poisson, BACKINGS[backing])


def convolve(field, unit, response):
    """Field of zero mean whose waves are multiplied by a function of |q|, on a side of 2 pi unit.

    By a transform of its own.
    """
    n = len(field)
    q = np.hypot(*np.meshgrid(*[np.fft.fftfreq(n, 1 / n)] * 2)) / unit
    q[0, 0] = q[0, 1]
    waves = np.fft.fft2(field) * response(q)
    waves[0, 0] = 0
    return np.fft.ifft2(waves).real


@lru_cache(maxsize=64)
def press_layer(solid, magnification, pressure, unit):
    """Contact without adhesion; the pressure over q0 h_rms."""
    heights = heights_of(_HURST, magnification, 1.0, unit, _GRID)
    return solver.solve(heights, 2 * np.pi * unit, pressure, tol=TOLERANCE, solid=solid)


# --- Without adhesion. ---


def probe_layer_contact(thickness, magnification, pressure, unit, variant) -> Iterator[Check]:
    """The pressure is over E* q0 h_rms/S of the longest waves."""
    solid, plain = lay(variant, thickness, unit), lay(variant, thickness)
    p = pressure / float(plain.factor(1.0))
    heights = heights_of(_HURST, magnification, 1.0, unit, _GRID)
    c = press_layer(solid, magnification, p, unit)
    yield compare_each("mean pressure", c.pressure.mean(), p, 1e-11)
    gap = convolve(c.pressure, unit, solid.compliance) - heights + c.shift
    softest = float(np.max(solid.compliance(np.geomspace(1, 46, 99) / unit)))
    rounding = 1e-14 * float(c.pressure.max()) * softest
    allowed = SLACK * (TOLERANCE * c.rms_height + rounding)
    touching = c.pressure > 0
    inside = float(np.max(np.abs(gap[touching]), initial=0))
    yield Check("gap in contact", inside / allowed, 1)
    yield Check("penetration", float(np.max(-gap[~touching], initial=0)) / allowed, 1)
    yield Check("gap reported", float(np.max(np.abs(np.maximum(gap, 0) - c.gap))) / allowed, 1)
    yield require("tension", c.pressure.min() >= 0)
    yield compare_each("area", c.area_fraction, np.mean(touching), 1e-12)
    same = press_layer(plain, magnification, p, 1.0)
    pixel = 1.5 / heights.size  # a point on the verge may be counted either way
    yield Check("area, other unit", abs(c.area_fraction - same.area_fraction) / pixel, 1)
    if thickness > THICK:
        half = press_layer(HALF_SPACE, magnification, p, unit)
        off = abs(c.area_fraction - half.area_fraction)
        yield Check("area on a half-space", off / pixel, 1)
        off = abs(c.mean_gap - half.mean_gap) / max(half.mean_gap, TOLERANCE * unit)
        yield Check("gap on a half-space", off, 1e-6)
    if thickness <= _SPRINGS and variant in ("bonded compressible", "bonded cork", "slip"):
        spring = float(solid.compliance(1e-9 / unit))
        gap, area = press_springs(heights, p * spring)
        yield Check("area on springs", abs(c.area_fraction - area), 0.01)
        yield Check("gap on springs", abs(c.mean_gap - gap) / unit, 0.01)


def press_springs(heights, overlap):
    """Mean gap and area of heights on springs that are pressed in by a mean overlap."""
    top = float(heights.max())
    level = brentq(
        lambda z: np.mean(np.maximum(heights - z, 0)) - overlap,
        float(heights.mean()) - overlap - float(np.ptp(heights)), top, xtol=1e-14, rtol=1e-14,
    )  # fmt: skip
    return float(np.mean(np.maximum(level - heights, 0))), float(np.mean(heights > level))


# --- With adhesion. ---


def probe_layer_adhesion(
    thickness, pressure, range_over_h_rms, adhesion_length_over_range, variant
) -> Iterator[Check]:
    """Pressure and adhesion length are those of E*/S of the longest waves."""
    name, kind, control = variant.rsplit(maxsplit=2)
    solid, heights = lay(name, thickness), heights_of(_HURST, 8, 1.0, 1.0, _GRID)
    stiffer = 1 / float(solid.factor(1.0))
    law = LAWS[kind](adhesion_length_over_range * range_over_h_rms * stiffer, range_over_h_rms)
    p = pressure * stiffer
    value = p if control == "pressure" else press_layer(solid, 8, p, 1.0).mean_gap
    state = attach(solid, law, control, value)
    stress = max(float(np.std(convolve(heights, 1.0, solid.stiffness))), law.strength)
    yield from check_layer_equilibrium(state, heights, solid, stress)
    if control == "pressure":
        balance = abs(state.pressure.mean() - p)
        yield Check("mean pressure", balance / stress, 2e-8)
    else:
        yield Check("mean gap", abs(state.gap.mean() - value), 1e-9)
    if thickness > THICK:
        half = attach(HALF_SPACE, law, control, value)
        off = abs(state.mean_gap - half.mean_gap) / max(abs(half.mean_gap), 1e-3)
        yield Check("gap on a half-space", off, 1e-5)
        yield compare_each("energy on a half-space", state.energy, half.energy, 1e-5)


@lru_cache(maxsize=16)
def attach(solid: HalfSpace | Layer, law, control, value):
    """Adhesive state at a pressure or a mean gap."""
    heights = heights_of(_HURST, 8, 1.0, 1.0, _GRID)
    return adhesive.solve(heights, 2 * np.pi, law, solid=solid, tol=TOLERANCE, **{control: value})


def check_layer_equilibrium(state, heights, solid, stress) -> Iterator[Check]:
    """Balance of pressures at every point, energies."""
    elastic = convolve(state.gap + heights, 1.0, solid.stiffness)
    excess = elastic + state.mean_pressure + state.law.traction(state.gap)
    at_wall = (state.gap <= 0) & state.law.hard_wall
    free = np.abs(excess[~at_wall])
    yield Check("equilibrium", float(np.max(free, initial=0)) / stress, 2e-8)
    yield Check("wall", float(np.max(-excess[at_wall], initial=0)) / stress, 2e-8)
    stored = 0.5 * float(np.mean((state.gap + heights) * elastic))
    gained = float(np.mean(state.law.potential(state.gap)))
    scale = stored + state.law.adhesion_length
    yield Check("energy", abs(state.energy - stored - gained) / scale, 1e-8)


LAYER_CONTACT = {
    "layer-contact": Component(
        probe_layer_contact,
        ("thickness", "magnification", "pressure", "unit"),
        pairs=(("thickness", "pressure"), ("thickness", "magnification")),
        variants=tuple(SOLIDS),
        reference=SURFACE,
        values={"magnification": (1.01, 8, 32), "unit": (1e-9, 1, 1e3)},
    ),
    "layer-adhesion": Component(
        probe_layer_adhesion,
        ("thickness", "pressure", "range_over_h_rms", "adhesion_length_over_range"),
        pairs=(("thickness", "pressure"), ("thickness", "adhesion_length_over_range"),
               ("thickness", "range_over_h_rms")),
        variants=_ADHESIVE,
        values={
            "thickness": (1e-4, 1e-2, 0.3, 3, 1e4),
            "pressure": (1e-8, 1e-3, 0.03, 0.3, 3, 100),
            "range_over_h_rms": (1e-2, 0.3, 3, 30, 1e3),
            "adhesion_length_over_range": (1e-6, 1e-2, 0.1, 1, 10),
        },
    ),
}  # fmt: skip
