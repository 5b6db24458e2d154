"""Probes of surfaces with a direction and of roughness that adds up, against closed forms."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

import numpy as np
from scipy.special import ellipe

from stability.components import SCALED, Check, Component, compare_each, model, require
from stability.layers_components import check_prediction
from stability.theory_components import find_area_error, quadrature
from stickiness import remaining
from stickiness import surface as synthesis
from stickiness.persson.theory import Persson
from stickiness.spectrum.kinds import SelfAffine, Shells
from stickiness.spectrum.sums import combine

ANGLES = ("0 rad", "0.4 rad", "-2 rad")  # of the long correlation length

# --- Spectra with a direction: waves of one norm are those of a circle, stretched. ---


def probe_direction(anisotropy, hurst, magnification, q0_h_rms, unit, variant) -> Iterator[Check]:
    angle = float(variant.split()[0])
    s = point_spectrum(anisotropy, hurst, magnification, angle, q0_h_rms * unit, unit)
    a, h_rms = anisotropy, q0_h_rms * unit
    # Means of |q|^power over an ellipse, over those over the circle.
    slope, curvature = (a + 1 / a) / 2, (3 * (a**2 + 1 / a**2) + 2) / 8
    stretch = 2 / np.pi * np.sqrt(a) * ellipe(1 - 1 / a**2)
    circle = {p: quadrature(hurst, magnification, p) for p in (0, 1, 2, 4)}
    own = {p: circle[p] / circle[0] for p in circle}
    energy = own[1] * stretch / 4 * q0_h_rms * h_rms
    mean = s.averaged()
    for name, of in (("", s), (", averaged", mean)):
        yield compare_each(f"rms height{name}", of.h_rms, h_rms)
        yield compare_each(f"rms slope{name}", of.rms_slope, np.sqrt(own[2] * slope) * q0_h_rms)
    expected = np.sqrt(own[4] * curvature) * q0_h_rms / unit
    yield compare_each("rms curvature", s.rms_curvature, expected)
    yield compare_each("elastic energy", s.elastic_energy(), energy)
    followed = 2e-8 if a <= 8 else 2e-7 if a <= 100 else 2e-6
    yield compare_each("elastic energy, averaged", mean.elastic_energy(), energy, followed)
    yield compare_each("band", s.band, [1 / unit / np.sqrt(a), magnification / unit * np.sqrt(a)])
    q = np.geomspace(*s.band, 20_001)
    variance = 2 * np.pi * np.trapezoid(q**2 * s.psd(q), np.log(q))
    yield compare_each("spectrum", variance, h_rms**2, 1e-3)
    middle = np.sqrt(s.q0 * s.q1)
    halves = s.variance_below(middle) + s.variance_above(middle)
    yield compare_each("both halves", halves, h_rms**2)
    yield from check_profiles(s, np.sqrt(own[2]) * q0_h_rms, angle)
    found = remaining.predict(s, energy, 0.1 * h_rms)
    yield compare_each("energy ratio", found.energy_ratio, 1)
    yield from check_prediction(found)
    yield require("widening", 1 <= found.anisotropy_error_factor <= 2)
    yield from check_area(s, 0.1 * s.rms_slope, s.rms_slope)


@lru_cache(maxsize=16)
def point_spectrum(anisotropy, hurst, magnification, angle, h_rms, unit) -> SelfAffine:
    """Self-affine spectrum with a direction, 1/q0 = unit of its norm."""
    ends = {"q0": 1 / unit, "q1": magnification / unit}
    return SelfAffine(hurst=hurst, h_rms=h_rms, anisotropy=anisotropy, angle=angle, **ends)


def check_profiles(s, slope, angle) -> Iterator[Check]:
    """Gradients along x and y: squares over a circle of waves, stretched and turned."""
    t = 2 * np.pi * np.arange(16) / 16
    along, across = np.cos(t) / np.sqrt(s.anisotropy), np.sin(t) * np.sqrt(s.anisotropy)
    qx = np.cos(angle) * along - np.sin(angle) * across
    qy = np.sin(angle) * along + np.cos(angle) * across
    found = s.directional_moments(0.0)
    expected = slope**2 * np.array([np.mean(qx**2), np.mean(qy**2)])
    yield compare_each("profiles along x and y", [found.m20, found.m02], expected)


def check_area(s, p, slope) -> Iterator[Check]:
    """Area of Persson's theory on a spectrum of this rms slope; normalisation of its gaps."""
    t = Persson(s)
    area = float(t.area_fraction(p))
    yield Check("area", find_area_error("yang2008", p, area, slope**2 / 2), 1e-7)
    yield Check("area + gaps = 1", abs(area + float(t.gap_cumulative(np.inf, p)) - 1), 1e-8)


# --- Surfaces with a direction: each mode has the power of its norm. ---


def probe_directed_surface(
    anisotropy, hurst, magnification, q0_h_rms, unit, grid, variant
) -> Iterator[Check]:
    """Windows hold the longest wave, or only as many as without a direction."""
    kind, angle = variant.split(maxsplit=1)
    angle, h_rms = float(angle.split()[0]), q0_h_rms * unit
    s = point_spectrum(anisotropy, hurst, magnification, angle, h_rms, unit)
    length = 2 * np.pi * unit * (np.ceil(np.sqrt(anisotropy)) if kind == "held" else 1)
    heights = synthesis.synthesise(s, n=grid, length=length, seed=3, amplitudes="fixed")
    finer = synthesis.synthesise(s, n=2 * grid, length=length, seed=3, amplitudes="fixed")
    scale = float(np.max(np.abs(heights)))
    yield Check("finer grid", float(np.max(np.abs(finer[::2, ::2] - heights))) / scale, SCALED)
    yield compare_each("rms height", np.sqrt(np.mean(finer**2)), h_rms)
    power = np.abs(np.fft.fft2(finer) / finer.size) ** 2
    norm = find_norm(2 * grid, length, anisotropy, angle) * unit
    inside = (norm > 1 + 1e-8) & (norm < magnification * (1 - 1e-8))
    outside = (norm < 1 - 1e-8) | (norm > magnification * (1 + 1e-8))
    yield Check("power outside the band", power[outside].sum() / power.sum(), 1e-20)
    if inside.any():
        law = power[inside] * norm[inside] ** (2 * hurst + 2)
        yield compare_each("power", law, law.mean(), 1e-7)
    shells = synthesis.lattice_spectrum(s, length)
    yield compare_each("lattice spectrum", shells.h_rms, h_rms)
    moments = synthesis.moments(finer, length)
    yield compare_each("rms slope", moments.rms_slope, shells.rms_slope, 1e-7)


def find_norm(n, length, anisotropy, angle):
    """Elliptic norm of the wave vectors of a grid, by the quadratic form."""
    q = 2 * np.pi * np.fft.fftfreq(n, length / n)
    qx, qy = q[:, None], q[None, :]
    c, s, a = np.cos(angle), np.sin(angle), anisotropy
    square = (
        (a * c**2 + s**2 / a) * qx**2
        + 2 * (a - 1 / a) * c * s * qx * qy
        + (a * s**2 + c**2 / a) * qy**2
    )
    return np.sqrt(np.maximum(square, 0))


# --- Two rough solids: variances add, whatever the sizes and the bands. ---


def probe_sums(magnification, hurst, q0_h_rms, unit, variant) -> Iterator[Check]:
    """Roughness of these parameters added to one with q0 = h_rms = 1."""
    parts = make_parts(magnification, hurst, q0_h_rms * unit, unit, variant)
    s, swapped = combine(*parts), combine(*parts[::-1])
    for power in (0, 1, 2, 4):
        expected = sum(part.total_variance(power) for part in parts)
        yield compare_each(f"variance of power {power}", s.total_variance(power), expected)
        yield compare_each("either order", swapped.total_variance(power), expected)
    ends = [part.band for part in parts]
    low, high = min(low for low, _ in ends), max(high for _, high in ends)
    yield compare_each("band", s.band, [low, high])
    for part in parts:
        q = np.sqrt(part.q0 * part.q1)
        below = float(s.variance_below(q))
        yield compare_each("both halves", below + float(s.variance_above(q)), s.h_rms**2)
        gradient = s.variance_below(q, 2)
        at, above = s.at_gradient_variance(gradient)
        if gradient > 0:
            yield compare_each("inverse", s.variance_below(at, 2), gradient, 1e-7)
        yield Check("variance beyond", abs(above - s.variance_above(at)) / s.h_rms**2, 1e-7)
        if s.isotropic and s.q0 < q < s.q1:
            yield compare_each("truncation", s.truncated(q).h_rms ** 2, below)
    slope = np.sqrt(sum(part.total_variance(2) for part in parts))
    yield compare_each("energy", s.elastic_energy(), sum(part.elastic_energy() for part in parts))
    if variant != "shells":
        along = sum(part.directional_moments(0.0).m20 for part in parts)
        yield compare_each("profiles along x", s.directional_moments().m20, along)
    found = remaining.predict(s, s.elastic_energy(), 0.1 * s.h_rms)
    yield from check_prediction(found)
    yield from check_area(s, 0.1 * slope, slope)


def make_parts(magnification, hurst, h_rms, unit, variant):
    """Two spectra: densities, one with a direction, or the shells of a window of each."""
    if variant == "shells":
        first = Shells([1.0, 8.0], [0.9, 0.1])
        return first, Shells(
            np.array([1.0, magnification]) / unit, [0.7 * h_rms**2, 0.3 * h_rms**2]
        )
    first = model(0.8, 64)
    if variant == "direction":
        return first, point_spectrum(4.0, hurst, magnification, 0.4, h_rms, unit)
    return first, SelfAffine(hurst=hurst, q0=1 / unit, q1=magnification / unit, h_rms=h_rms)


_DECADES = (1e-10, 1e-5, 1e-2, 1, 1e2, 1e5, 1e10)

DIRECTION = {
    "direction": Component(
        probe_direction,
        ("anisotropy", "hurst", "magnification", "q0_h_rms", "unit"),
        pairs=(("anisotropy", "hurst"), ("anisotropy", "magnification"), ("q0_h_rms", "unit")),
        variants=ANGLES,
        values={
            "anisotropy": (1, 1 + 1e-6, 1.1, 2, 8, 100, 1e4, 1e5),
            "hurst": (0.1, 0.5, 0.8, 1.0),
            "magnification": (1.01, 2, 64, 1e3, 1e6),
            "q0_h_rms": (1e-9, 0.1, 10),
            "unit": (1e-9, 1, 1e3),
        },
    ),
    "directed-surfaces": Component(
        probe_directed_surface,
        ("anisotropy", "hurst", "magnification", "q0_h_rms", "unit", "grid"),
        pairs=(("anisotropy", "grid"), ("anisotropy", "magnification"), ("q0_h_rms", "unit")),
        variants=tuple(f"held {angle}" for angle in ANGLES) + ("narrow 0.4 rad",),
        reference={"magnification": 4, "grid": 64},
        values={
            "magnification": (1.01, 2, 4, 16, 1e6),
            "hurst": (0.1, 0.5, 0.8, 1.0),
            "grid": (2, 7, 16, 31, 64, 128),
        },
        further=({"anisotropy": 8, "grid": 256},
                 {"anisotropy": 30, "magnification": 2, "grid": 512}),
    ),
    "sums": Component(
        probe_sums,
        ("magnification", "hurst", "q0_h_rms", "unit"),
        pairs=(("q0_h_rms", "unit"), ("magnification", "unit")),
        variants=("densities", "direction", "shells"),
        values={
            "magnification": (1.01, 64, 1e6),
            "hurst": (0.1, 0.8, 1.0),
            "q0_h_rms": _DECADES,
            "unit": _DECADES,
        },
    ),
}  # fmt: skip
