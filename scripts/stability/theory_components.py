"""Probes of what needs no contact solver: spectra, surfaces, Persson's theory, criteria, means."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache, lru_cache

import numpy as np
from scipy.integrate import quad
from scipy.special import erf, erfinv

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
from stickiness import criteria
from stickiness import surface as synthesis
from stickiness.accuracy import multilevel
from stickiness.persson.theory import Persson
from stickiness.spectrum.kinds import SelfAffine, Tabulated

_SEEDS = 24

# --- Spectrum: closed forms against adaptive quadrature in ln q, in units of q0 and h_rms. ---


@cache
def quadrature(hurst: float, magnification: float, power: float) -> float:
    """Integral of x^(1 + power - 2 (1 + H)) over the band, x = q/q0."""
    exponent, span = power - 2 * hurst, np.log(magnification)
    # Scaled by the largest value of the integrand, which is at one of the ends.
    largest = max(exponent * span, 0.0)
    pieces = np.linspace(0, span, 2 + int(span))
    parts = [
        quad(lambda s: np.exp(exponent * s - largest), *ends, epsrel=1e-12)[0]
        for ends in zip(pieces[:-1], pieces[1:], strict=True)
    ]
    return float(np.exp(largest) * np.sum(parts))


def probe_spectrum(hurst, magnification, q0_h_rms, unit) -> Iterator[Check]:
    s = model(hurst, magnification, q0_h_rms, unit)
    variance = quadrature(hurst, magnification, 0)
    for name, value, power in (
        ("rms slope", s.rms_slope / q0_h_rms, 2),
        ("rms curvature", s.rms_curvature * unit / q0_h_rms, 4),
    ):
        expected = np.sqrt(quadrature(hurst, magnification, power) / variance)
        yield compare_each(name, value, expected)
    energy = quadrature(hurst, magnification, 1) / variance / 4
    yield compare_each("elastic energy", s.elastic_energy() / (unit * q0_h_rms**2), energy)
    yield compare_each("rms height", s.h_rms, q0_h_rms * unit)
    expected = s.moment(0) * s.moment(4) / s.moment(2) ** 2
    yield compare_each("Nayak", s.nayak, expected)
    middle = np.sqrt(s.q0 * s.q1)
    halves = s.variance_below(middle) + s.variance_above(middle)
    yield compare_each("both halves", halves, s.h_rms**2)
    inner = s.truncated(middle)
    yield compare_each("truncation", inner.h_rms**2, s.variance_below(middle))
    q, above = s.at_gradient_variance(s.variance_below(middle, 2))
    yield compare_each("inverse", q, middle, 1e-7)
    yield Check("variance beyond", abs(above - s.variance_above(middle)) / s.h_rms**2, 1e-7)
    q = np.geomspace(s.q0, s.q1, 9)
    table = Tabulated(q, s.psd(q))
    yield compare_each("table", table.rms_slope, s.rms_slope)


# --- Synthesis: prescribed height, other grids, band, and the same surface in another unit. ---


def probe_synthesis(hurst, magnification, q0_h_rms, unit, grid) -> Iterator[Check]:
    s, length = model(hurst, magnification, q0_h_rms, unit), 2 * np.pi * unit
    heights = synthesis.synthesise(s, n=grid, length=length, seed=3)
    h_rms = q0_h_rms * unit
    if grid > 2 * magnification:  # beyond Nyquist, where the grid shows half of some modes
        yield compare_each("rms height", np.sqrt(np.mean(heights**2)), h_rms)
    yield Check("mean", abs(float(heights.mean())) / h_rms, SCALED)
    finer = synthesis.synthesise(s, n=2 * grid, length=length, seed=3)
    yield compare("finer grid", finer[::2, ::2], heights)
    power = np.abs(np.fft.fft2(heights)) ** 2
    index = np.fft.fftfreq(grid, 1 / grid)
    radius = np.hypot(index[:, None], index[None, :])
    outside = (radius > magnification * (1 + 1e-9)) | (radius < 1 - 1e-9)
    yield Check("power outside the band", power[outside].sum() / power.sum(), 1e-20)
    plain = synthesis.synthesise(model(hurst, magnification), n=grid, length=2 * np.pi, seed=3)
    yield compare("other unit", heights / h_rms, plain)
    moments = synthesis.moments(finer, length)
    gy, gx = (np.fft.ifft2(1j * k * np.fft.fft2(finer)).real for k in _wave_vectors(2 * grid, unit))
    slope = np.sqrt(np.mean(gx**2 + gy**2))
    yield compare_each("rms slope", moments.rms_slope, slope, 1e-7)
    shells = synthesis.lattice_spectrum(s, length)
    yield compare_each("lattice spectrum", shells.h_rms, h_rms)


def _wave_vectors(n, unit):
    k = np.fft.fftfreq(n, 1 / n) / unit
    return k[:, None], k[None, :]


# --- Persson's theory: normalisation, the diffusion of pressure integrated anew, other units. ---

_SUPPRESSION = {
    "yang2008": lambda a, g: g + (1 - g) * a**2,
    "wang2017": lambda a, g: g - 2 / 9 * a**2 + (11 / 9 - g) * a**4,
}
_GAMMA = {"yang2008": 0.45, "wang2017": 5 / 9, "xu2024": 0.45}
THEORIES = tuple(
    f"{variant} {correction}"
    for variant in ("afferrante2018", "almqvist2011")
    for correction in _GAMMA
)


@lru_cache(maxsize=64)
def theory(variant: str, *parameters: float) -> Persson:
    """Theory of a model spectrum."""
    width, correction = variant.split()
    return Persson(model(*parameters), variant=width, correction=correction)


def probe_persson(
    hurst, magnification, pressure, range_over_h_rms, q0_h_rms, unit, variant
) -> Iterator[Check]:
    h_rms = q0_h_rms * unit
    t = theory(variant, hurst, magnification, q0_h_rms, unit)
    p, u = pressure * q0_h_rms, range_over_h_rms * h_rms
    area, gap = float(t.area_fraction(p)), float(t.mean_gap(p))
    below, everything = (float(t.gap_cumulative(x, p)) for x in (u, np.inf))
    density = float(t.gap_density(u, p))
    yield Check("area + gaps = 1", abs(area + everything - 1), 1e-8)
    yield require("sign", min(area, gap, below, density) >= 0)
    yield Check("order", max(below - everything, 0.0), 1e-12)
    m2 = 0.5 * t.spectrum.rms_slope**2
    yield Check("area", find_area_error(variant.split()[1], p, area, m2), 1e-7)
    same = theory(variant, hurst, magnification)
    yield Check("area, other unit", abs(area - float(same.area_fraction(pressure))), SCALED)
    other = float(same.mean_gap(pressure))
    yield Check("gap, other unit", abs(gap / h_rms - other) / max(other, 1e-12), 1e-7)
    other = float(same.gap_cumulative(range_over_h_rms, pressure))
    yield Check("gaps, other unit", abs(below - other), 1e-8)
    if 1 - area > 1e-6 and gap > 1e-6 * h_rms and pressure > 1e-6:
        yield compare_each("load at the gap", t.pressure_at(gap), p, 1e-6)


def find_area_error(correction: str, p: float, area: float, m2: float) -> float:
    """Relative error of the variance m2 at which the area is what the theory says."""
    if area > 1 - 1e-9 or area < 1e-12:  # erf leaves no digits to invert
        return 0.0
    y, gamma = float(erfinv(area)), _GAMMA[correction]
    if correction == "xu2024":
        scale = 1 / (y**2 * (gamma + (1 - gamma) * area))
    else:
        suppression = _SUPPRESSION[correction]
        # dV/p^2 = dy/(y^3 S); in t = ln(y'/y), from y to where the contact is full.
        scale = 2 / y**2 * quad(
            lambda t: np.exp(-2 * t) / suppression(erf(y * np.exp(t)), gamma),
            0, 20, points=[max(np.log(1 / y), 0.1)] if y < 1 else None, limit=400, epsrel=1e-10,
        )[0]  # fmt: skip
    # Near full contact the area hardly depends on the variance: errors weigh as in the area.
    weight = y * np.exp(-(y**2)) / area
    return abs(scale * p**2 / m2 - 1) * weight


# --- Criteria: at its own limit a margin is 1; other units change nothing; limits of formulas. ---


def probe_criteria(
    hurst, magnification, range_over_h_rms, adhesion_length_over_range, q0_h_rms, unit
) -> Iterator[Check]:
    s, q0 = model(hurst, magnification, q0_h_rms, unit), 1 / unit
    h_rms = s.h_rms
    eps = range_over_h_rms * h_rms
    la = adhesion_length_over_range * eps
    limit = criteria.h_rms_limit(q0, la, eps, 3.0)
    yield compare_each("threshold", criteria.violano(limit, q0, la, eps, 3.0).margin, 1)
    ratio = criteria.traction_ratio(h_rms, q0, la, eps, 3.0)
    margin = criteria.violano(h_rms, q0, la, eps, 3.0).margin
    yield compare_each("margin and ratio", margin ** (5 / 3), ratio)
    yield compare_each("modulus", criteria.modulus_threshold(h_rms, q0, la, eps, 3.0), ratio)
    expected = 1 / (75 / 4 * q0_h_rms / adhesion_length_over_range)
    yield compare_each("DMT range", 1 / criteria.dmt_validity(h_rms, q0, la, eps).margin, expected)
    scaled = model(hurst, magnification)
    expected_margins = list_scaled_margins(scaled, la, eps, q0, h_rms)
    for (name, value), expected in zip(list_margins(s, la, eps, q0), expected_margins, strict=True):
        if np.isinf(expected):
            yield require(name, value == expected)
        else:
            yield compare_each(name, value, expected, 1e-7)
    if range_over_h_rms < 1e-3:
        expected = np.exp(2) / np.sqrt(2 * np.pi) * la / (q0 * h_rms**2)
        value = criteria.bearing_area(h_rms, q0, la, eps).margin
        yield compare_each("bearing area, small ranges", value, expected, 1e-2)
    pressure, gap = criteria.bearing_area_pull_off(h_rms, q0, la, eps)
    sticky = criteria.bearing_area(h_rms, q0, la, eps).sticky
    agree = np.isfinite(gap) and np.isfinite(pressure) and (pressure < 0) == sticky
    yield require("bearing area, pull-off", agree)
    c0 = criteria.violano_c0_limit(hurst, q0, la, eps, 3.0, magnification)
    made = SelfAffine(hurst=hurst, q0=q0, q1=magnification * q0, C0=c0)
    yield compare_each("C0 and h_rms", made.h_rms, limit)


def list_margins(s, la, eps, q0):
    pull = criteria.pastewka_robbins(s.rms_slope, s.rms_curvature, la, eps)
    yield "Pastewka-Robbins", pull.margin
    yield "Fuller-Tabor", criteria.fuller_tabor(s.h_rms, s.rms_curvature, la).margin
    yield "bearing area", criteria.bearing_area(s.h_rms, q0, la, eps).margin
    yield "Persson-Tosatti", criteria.persson_tosatti(s, la).margin


def list_scaled_margins(s, la, eps, q0, h):
    """The same from a surface with q0 = h_rms = 1, moved by the powers that the formulas have."""
    slope, curvature = s.rms_slope * q0 * h, s.rms_curvature * q0**2 * h
    delta = np.sqrt(24 * la * eps)
    left = slope * delta / (2 * la) * (slope**2 / (curvature * delta)) ** (2 / 3)
    yield np.pi * (3 / 16) ** (2 / 3) / left
    yield 10 * np.sqrt(2 / s.rms_curvature) * (la / h) / (q0 * h)
    yield criteria.bearing_area(1, 1, la / (q0 * h**2), eps / h).margin
    yield la / (q0 * h**2) / s.elastic_energy()


# --- Means: shift and scale, known answers, the descriptors in other units. ---


def probe_sampling(hurst, magnification, q0_h_rms, unit) -> Iterator[Check]:
    s, length = model(hurst, magnification, q0_h_rms, unit), 2 * np.pi * unit
    found = multilevel.descriptors(s, length, range(_SEEDS))
    plain = multilevel.descriptors(model(hurst, magnification), 2 * np.pi, range(_SEEDS))
    heights = q0_h_rms * unit
    factors = [heights * q0_h_rms, q0_h_rms, q0_h_rms**2, *[heights] * 4]
    yield compare_each("descriptors", found / factors, plain)
    fine, many = found[:4], found[4:]
    mean = multilevel.multilevel_mean(fine, fine, many)
    yield compare_each("fine = coarse", mean.mean, many.mean(0))
    constant = multilevel.controlled_mean(np.full(_SEEDS, heights), found[:, :1], many[:, :1])
    yield compare_each("constant", constant.mean, heights)
    linear = multilevel.controlled_mean(3 * found[:, 0], found[:, :1], many[:, :1])
    yield compare_each("linear", linear.mean, 3 * many[:, 0].mean())


THEORY = {
    "spectrum": Component(
        probe_spectrum,
        ("magnification", "hurst", "q0_h_rms", "unit"),
        values=WIDE,
    ),
    "synthesise": Component(
        probe_synthesis,
        ("magnification", "hurst", "q0_h_rms", "unit", "grid"),
        reference={"magnification": 8},
        values={"magnification": (1.001, 2, 8, 64, 1e3, 1e6)},
        further=({"grid": 509}, {"grid": 1024}),
    ),
    "persson": Component(
        probe_persson,
        ("magnification", "hurst", "pressure", "range_over_h_rms", "q0_h_rms", "unit"),
        pairs=(("magnification", "pressure"), ("hurst", "pressure"), ("hurst", "magnification")),
        variants=THEORIES,
        values={
            "magnification": (1.001, 8, 64, 1e3, 1e6, 1e10),
            "hurst": (0.05, 0.5, 0.8, 1.0),
            "pressure": (1e-8, 1e-3, 0.03, 0.3, 3.0, 100.0, 1e6),
        },
    ),
    "criteria": Component(
        probe_criteria,
        (
            "magnification", "hurst", "range_over_h_rms", "adhesion_length_over_range",
            "q0_h_rms", "unit",
        ),
        values=WIDE,
    ),
    "sampling": Component(
        probe_sampling,
        ("magnification", "hurst", "q0_h_rms", "unit"),
        reference={"magnification": 8},
        values={"magnification": (1.001, 2, 8, 32)},
    ),
}  # fmt: skip
