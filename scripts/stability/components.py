"""Where each part of the library is right, refuses, or fails, at the extremes of two parameters.

A `Component` is probed at every point of a grid of two parameters. Each probe compares results with
something that was obtained in another way, and yields `Check`s.
"""

from __future__ import annotations

import signal
import traceback
import warnings
from collections.abc import Callable
from contextlib import contextmanager
from dataclasses import dataclass
from functools import lru_cache
from itertools import product
from pathlib import Path
from typing import NamedTuple

import numpy as np

import stickiness
from stability import closed_forms
from stability.closed_forms import THICK, filter_waves, integrate_band, layer_response
from stickiness import adhesive, criteria, remaining, traction_laws
from stickiness import surface as synthesis
from stickiness.criteria import equivalent_sphere
from stickiness.measured import instrument_spectrum, psd
from stickiness.measured.topography import Topography
from stickiness.persson.theory import Persson
from stickiness.plausibility import PlausibilityWarning
from stickiness.repulsive import solver
from stickiness.solids import Layer
from stickiness.spectrum.kinds import SelfAffine

OUTCOMES = ("right", "refused", "not converged", "failed")
RIGHT, REFUSED, UNCONVERGED, FAILED = range(4)
SCALED = 1e-9  # relative error allowed where only the unit or an overall factor differs
TOLERANCE = 1e-8  # of the solvers
TIME_LIMIT = 30  # seconds of computing for a point; most take less than 0.1
UNIT, Q0_H_RMS = 1e-6, 1e-3  # 1/q0 and q0 h_rms of the same problem in other units

LABELS = {
    "magnification": "magnification q1/q0",
    "hurst": "Hurst exponent",
    "pressure": "mean pressure over E* q0 h_rms",
    "range_over_h_rms": "range over h_rms",
    "adhesion_length_over_range": "adhesion length over range",
    "thickness": "thickness of a layer times q0",
    "poisson": "Poisson's ratio of a layer",
    "grid": "grid points a side",
}
LAWS = traction_laws.LAWS | {"lennard_jones": adhesive.LennardJones}


class Check(NamedTuple):
    """What was compared, its relative error, and the largest error that passes for right."""

    name: str
    error: float
    tolerance: float


def require(name, met):
    """Check a condition."""
    return Check(name, float(not met), 0.5)


def bound(name, errors, tolerance=SCALED):
    """Check the largest of some errors, 0 if there are none."""
    return Check(name, float(np.max(errors, initial=0)), tolerance)


def compare(name, value, expected, tolerance=SCALED):
    """Check the largest relative deviation of any element."""
    return Check(name, float(np.max(np.abs(np.divide(value, expected) - 1))), tolerance)


@dataclass(frozen=True)
class Component:
    """A part of the library: its probe, and the values of the parameters that it is tried at.

    `probe` takes the parameters by name, and `variant` if there are any.
    """

    probe: Callable
    values: dict
    variants: tuple[str, ...] = ()

    def points(self):
        """List every combination of the values and variants."""
        values = self.values | ({"variant": self.variants} if self.variants else {})
        return [dict(zip(values, point, strict=True)) for point in product(*values.values())]

    def middle(self):
        """Return the point in the middle of all values."""
        point = {name: values[len(values) // 2] for name, values in self.values.items()}
        return point | ({"variant": self.variants[0]} if self.variants else {})


class Result(NamedTuple):
    """Outcome of a point, its largest error over the tolerance, and a message or a check."""

    outcome: int
    excess: float
    text: str


def probe_point(component, point):
    """Return the outcome of one point."""
    try:
        with warnings.catch_warnings(), limit_time():
            warnings.simplefilter("error")
            warnings.simplefilter("ignore", PlausibilityWarning)  # coarse grids are the point
            checks = list(component.probe(**point))
    except solver.ConvergenceError as error:  # of adhesive contact, too
        return Result(UNCONVERGED, np.nan, str(error))
    except Exception as error:  # whatever it is belongs on the map
        *_, last = traceback.extract_tb(error.__traceback__)
        in_library = Path(last.filename).is_relative_to(Path(stickiness.__file__).parent)
        outcome = REFUSED if isinstance(error, ValueError) and in_library else FAILED
        return Result(outcome, np.nan, f"{type(error).__name__}: {error}")
    # A NaN must not hide behind a comparison that is false.
    excess = [c.error / c.tolerance if np.isfinite(c.error) else np.inf for c in checks]
    worst = int(np.argmax(excess))
    outcome = RIGHT if excess[worst] <= 1 else FAILED
    return Result(outcome, float(excess[worst]), checks[worst].name)


@contextmanager
def limit_time():
    """Raise TimeoutError after `TIME_LIMIT` of computing."""

    def expired(*_):
        raise TimeoutError(f"took more than {TIME_LIMIT:g} s")

    before = signal.signal(signal.SIGPROF, expired)
    signal.setitimer(signal.ITIMER_PROF, TIME_LIMIT)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


def model(hurst, magnification, q0_h_rms=1.0, unit=1.0):
    """Self-affine spectrum with 1/q0 = unit."""
    return SelfAffine(hurst=hurst, q0=1 / unit, q1=magnification / unit, h_rms=q0_h_rms * unit)


@lru_cache(maxsize=4)
def make_heights(magnification, grid, q0_h_rms=1.0, unit=1.0):
    """Heights of a model surface as far as the grid resolves it, one wave at the least."""
    held = min(magnification, grid / 2) if grid > 2 else magnification
    spectrum = model(0.8, max(held, 1.01), q0_h_rms, unit)
    return synthesis.synthesise(spectrum, n=grid, length=2 * np.pi * unit, seed=3)


# --- Surface: moments against quadrature, the same surface on other grids and in other units. ---


def probe_spectrum(hurst, magnification):
    s = model(hurst, magnification)
    variance = integrate_band(hurst, magnification, 0)
    for name, value, power in (("slope", s.rms_slope, 2), ("curvature", s.rms_curvature, 4)):
        expected = np.sqrt(integrate_band(hurst, magnification, power) / variance)
        yield compare(f"rms {name}", value, expected)
    energy = integrate_band(hurst, magnification, 1) / variance / 4
    yield compare("elastic energy", s.elastic_energy(), energy)
    middle = np.sqrt(s.q0 * s.q1)
    halves = s.variance_below(middle) + s.variance_above(middle)
    yield compare("both halves", halves, s.h_rms**2)
    yield compare("truncation", s.truncated(middle).h_rms ** 2, s.variance_below(middle))
    other = model(hurst, magnification, Q0_H_RMS, UNIT)
    yield compare("slope, other unit", other.rms_slope / Q0_H_RMS, s.rms_slope)


def probe_surface(magnification, grid):
    s, length = model(0.8, magnification), 2 * np.pi
    heights = synthesis.synthesise(s, n=grid, length=length, seed=3)
    if grid > 2 * magnification:  # beyond Nyquist, where the grid shows half of some modes
        yield compare("rms height", np.sqrt(np.mean(heights**2)), 1)
    yield Check("mean", abs(float(heights.mean())), SCALED)
    finer = synthesis.synthesise(s, n=2 * grid, length=length, seed=3)
    largest = max(np.max(np.abs(heights)), 1e-300)
    yield bound("finer grid", np.abs(finer[::2, ::2] - heights) / largest)
    power = np.abs(np.fft.fft2(heights)) ** 2
    index = np.fft.fftfreq(grid, 1 / grid)
    radius = np.hypot(index[:, None], index[None, :])
    outside = (radius > magnification * (1 + 1e-9)) | (radius < 1 - 1e-9)
    yield Check("power outside the band", power[outside].sum() / power.sum(), 1e-20)
    other = model(0.8, magnification, Q0_H_RMS, UNIT)
    same = synthesis.synthesise(other, n=grid, length=2 * np.pi * UNIT, seed=3)
    yield bound("other unit", np.abs(same / (Q0_H_RMS * UNIT) - heights) / largest)


# --- Contact: a wave by Westergaard, and equilibrium of rough contact by plain transforms. ---


def probe_wave(pressure, grid):
    heights = np.repeat(np.cos(2 * np.pi * np.arange(grid) / grid)[:, None], grid, axis=1)
    c = solver.solve(heights, 2 * np.pi, pressure, tol=TOLERANCE)
    area, gap = closed_forms.westergaard(pressure)
    yield Check("Westergaard's area", abs(c.area_fraction - area), 2 / grid)
    yield Check("Westergaard's mean gap", abs(c.mean_gap - gap), 4 / grid**2 + 1e-6)
    yield require("full contact", c.area_fraction == 1 or pressure < 0.5)


def probe_contact(pressure, magnification):
    heights = make_heights(magnification, 32)
    c = solver.solve(heights, 2 * np.pi, pressure, tol=TOLERANCE)
    yield compare("mean pressure", c.pressure.mean(), pressure, 1e-11)
    yield from check_contact(c, heights, lambda q: 2 / q)
    scaled = make_heights(magnification, 32, Q0_H_RMS, UNIT)
    same = solver.solve(scaled, 2 * np.pi * UNIT, pressure * Q0_H_RMS, tol=TOLERANCE)
    # A point on the verge may be counted either way.
    pixel = 1.5 / heights.size
    yield Check("area, other unit", abs(c.area_fraction - same.area_fraction) / pixel, 1)
    off = abs(same.mean_gap / (Q0_H_RMS * UNIT) - c.mean_gap)
    yield Check("gap, other unit", off / max(c.mean_gap, TOLERANCE), 1e-6)


def check_contact(c, heights, compliance):
    """Check that gaps follow from pressures by a transform, and that nothing pulls or overlaps."""
    gap = filter_waves(c.pressure, compliance) - heights + c.shift
    # Rounding of the transform grows with the largest pressure, far beyond full contact.
    softest = float(np.max(compliance(np.geomspace(1, 46, 99))))
    allowed = 2 * (TOLERANCE * c.rms_height + 1e-14 * float(c.pressure.max()) * max(softest, 6))
    touching = c.pressure > 0
    yield bound("gap in contact", np.abs(gap[touching]), allowed)
    yield bound("penetration", -gap[~touching], allowed)
    yield bound("gap reported", np.abs(np.maximum(gap, 0) - c.gap), allowed)
    yield require("no tension", c.pressure.min() >= 0)
    yield compare("area", c.area_fraction, np.mean(touching), 1e-12)


# --- Adhesion: equilibrium at every point, whole paths without energy out of nothing. ---


def elastic_pressure(displacement):
    """Pressure of zero mean that a displacement needs on a half-space."""
    return filter_waves(displacement, lambda q: q / 2)


def check_equilibrium(state, heights):
    """Check the balance of pressures at every point of an adhesive state."""
    law = state.law
    stress = max(float(np.std(elastic_pressure(heights))), law.strength)
    elastic = elastic_pressure(state.gap + heights) + state.mean_pressure
    excess = elastic + law.traction(state.gap)  # what is left for the wall
    at_wall = (state.gap <= 0) & law.hard_wall
    free = ~at_wall
    if not law.smooth:
        # At the jump of the law any traction between its two sides is in equilibrium.
        jump = np.abs(state.gap - law.range) <= 1e-9 * law.range
        within = (elastic <= TOLERANCE * stress) & (-elastic <= law.strength * (1 + 1e-9))
        free &= ~(jump & within)
    yield bound("equilibrium", np.abs(excess[free]) / stress, 2e-8)
    yield bound("wall", -excess[at_wall] / stress, 2e-8)


def probe_adhesion(range_over_h_rms, adhesion_length_over_range, variant):
    """At a load, and at a mean gap of zero, where contact is full if there is a wall."""
    heights, pressure = make_heights(8, 16), 0.03
    law = LAWS[variant](adhesion_length_over_range * range_over_h_rms, range_over_h_rms)
    state = adhesive.solve(heights, 2 * np.pi, law, pressure=pressure, tol=TOLERANCE)
    yield from check_equilibrium(state, heights)
    x = np.array([0.1, 0.5, 2.0, 10.0])
    traction = adhesion_length_over_range * closed_forms.law_of_traction(variant, x)
    off = np.abs(law.traction(x * range_over_h_rms) - traction)
    yield bound("law of traction", off / adhesion_length_over_range)
    stress = max(float(np.std(elastic_pressure(heights))), law.strength)
    yield Check("mean pressure", abs(state.pressure.mean() - pressure) / stress, 2e-8)
    displaced = state.gap + heights
    stored = 0.5 * np.mean(displaced * elastic_pressure(displaced))
    off = abs(state.energy - stored - np.mean(law.potential(state.gap)))
    yield bound("energy", off / (stored + law.adhesion_length), 1e-6)
    if law.hard_wall:
        closed = adhesive.solve(heights, 2 * np.pi, law, mean_gap=0.0, tol=TOLERANCE)
        yield Check("full contact", 1 - closed.repulsive_area_fraction, 0.5 / heights.size)


def probe_path(pressure, adhesion_length_over_range, variant):
    """Load, unload and pull off."""
    heights = make_heights(4, 16)
    law = LAWS[variant](adhesion_length_over_range * 0.3, 0.3)
    loop = [pressure, 3 * pressure, pressure, -2 * law.strength]
    points = list(
        adhesive.path(
            heights, 2 * np.pi, law, loop, steps=6, balance=1e-4, located=1e-2,
            smallest_jump=1e-2, max_states=400, tol=TOLERANCE,
        )
    )  # fmt: skip
    for point in points[:: max(len(points) // 8, 1)]:
        yield from check_equilibrium(point.state, heights)
    first, last = points[0].state, points[-1]
    energies = [point.state.energy - first.energy for point in points]
    scale = max(np.max(np.abs(energies)), 1e-3 * law.adhesion_length)
    lost = np.cumsum([p.dissipated for p in points if np.isfinite(p.dissipated)])
    yield Check("energy out of nothing", -lost[-1] / scale, 1e-2)
    yield require("pulls off before twice its strength", last.event == "pull-off")
    yield Check("pull-off", -last.state.mean_pressure / law.strength, 1 + 1e-7)
    back = max(k for k, p in enumerate(points) if p.state.mean_pressure == pressure)
    # Unloading keeps what loading closed.
    wider = points[back].state.mean_gap - first.mean_gap
    yield Check("hysteresis", wider / max(first.mean_gap, law.range), 1e-5)
    if not any(p.event for p in points[: back + 1]) and lost[back] < 1e-6 * scale:
        yield Check("reversible", abs(energies[back]) / scale, 1e-3)


# --- Theory and PSD. ---


@lru_cache(maxsize=8)
def make_theory(variant, magnification, *size):
    return Persson(model(0.8, magnification, *size), variant=variant)


def probe_theory(magnification, pressure, variant):
    t = make_theory(variant, magnification)
    same = make_theory(variant, magnification, Q0_H_RMS, UNIT)
    area, gap = float(t.area_fraction(pressure)), float(t.mean_gap(pressure))
    below, everything = (float(t.gap_cumulative(x, pressure)) for x in (0.3, np.inf))
    yield Check("area + gaps = 1", abs(area + everything - 1), 1e-8)
    yield require("sign", min(area, gap, below, float(t.gap_density(0.3, pressure))) >= 0)
    yield Check("order", max(below - everything, 0.0), 1e-12)
    m2 = 0.5 * t.spectrum.rms_slope**2
    yield Check("area", closed_forms.persson_area_error(pressure, area, m2), 1e-7)
    p = pressure * Q0_H_RMS
    yield Check("area, other unit", abs(area - float(same.area_fraction(p))), SCALED)
    other = float(same.mean_gap(p)) / (Q0_H_RMS * UNIT)
    yield Check("gap, other unit", abs(gap - other) / max(gap, 1e-12), 1e-7)
    if 1 - area > 1e-6 and gap > 1e-6 and pressure > 1e-6:
        yield compare("load at the gap", t.pressure_at(gap), pressure, 1e-6)


def probe_psd(hurst, grid):
    """Parseval, the power law that was put in, and the same map in other units."""
    found, plane, heights = analyse_map(hurst, grid)
    same, *_ = analyse_map(hurst, grid, Q0_H_RMS, UNIT)
    yield compare("Parseval", plane.total(), plane.variance)
    rings = psd.radial_average(plane)
    total = np.sum(rings.psd * rings.modes(plane)) * plane.dqx * plane.dqy
    yield compare("rings", total, plane.variance)
    yield compare("variance", plane.variance, float(np.var(heights)))
    fit = found.fit
    yield Check("Hurst exponent", abs(fit.hurst - hurst) / max(fit.hurst_se, 0.02), 5)
    yield Check("Hurst exponent, other unit", abs(fit.hurst - same.fit.hurst), 1e-6)
    lifted = psd.power_spectrum(heights + 3 * np.abs(heights).max(), 2 * np.pi / grid)
    yield compare("lifted", lifted.variance, plane.variance, 1e-12)


def analyse_map(hurst, grid, q0_h_rms=1.0, unit=1.0):
    s = model(hurst, max(0.45 * grid, 1.01), q0_h_rms, unit)
    heights = synthesis.synthesise(s, n=grid, length=2 * np.pi * unit, seed=3)
    step = 2 * np.pi * unit / grid
    limits = instrument_spectrum.Limits(detect=False)
    found = instrument_spectrum.analyse(Topography(heights, step, step, "probe"), "none", limits)
    return found, psd.power_spectrum(heights, step), heights


# --- Criteria and verdict. ---


def probe_criteria(range_over_h_rms, adhesion_length_over_range):
    s, a_v, q0_h_rms = model(0.8, 64), 3.0, 1.0
    eps, la = range_over_h_rms, adhesion_length_over_range * range_over_h_rms
    limit = criteria.h_rms_limit(1.0, la, eps, a_v)
    yield compare("threshold", criteria.violano(limit, 1.0, la, eps, a_v).margin, 1)
    ratio = criteria.traction_ratio(1.0, 1.0, la, eps, a_v)
    yield compare("modulus", criteria.modulus_threshold(1.0, 1.0, la, eps, a_v), ratio)
    margin = 75 / 4 * q0_h_rms / adhesion_length_over_range
    yield compare("DMT range", 1 / criteria.jtb_limit(1.0, la, eps), margin)
    yield compare(
        "Persson-Tosatti", criteria.persson_tosatti(s, la).margin, la / s.elastic_energy()
    )
    curvature = 10 * np.sqrt(2 / s.rms_curvature) * la
    yield compare("Fuller-Tabor", criteria.fuller_tabor(1.0, s.rms_curvature, la).margin, curvature)
    bearing = criteria.bearing_area(1.0, 1.0, la, eps).margin
    if range_over_h_rms < 1e-3:
        expected = np.exp(2) / np.sqrt(2 * np.pi) * la
        yield compare("bearing area, small ranges", bearing, expected, 1e-2)
    # The sphere that stands for an edge of contact: Hertz' limit of weak attraction.
    sphere = equivalent_sphere.attraction(1.0, 1.0, s.rms_slope, la, eps, a_v)
    t = 0.75 * a_v * range_over_h_rms ** (2 / 3) * s.rms_slope
    yield compare("attractive over contact", sphere.attractive_over_contact, t)
    weak = closed_forms.hertz_attraction(t)
    yield Check("below Hertz' limit", sphere.effect / weak - 1, 1e-9)
    if sphere.strength * np.sqrt(1 + t) < 1e-6:
        yield compare("Hertz' limit", sphere.effect, weak, 1e-4)


def probe_verdict(adhesion_length_over_range, magnification):
    """What remains of adhesion: its order, bounds and energy, and the same in other units."""
    s, eps = model(0.8, magnification), 0.1
    length = adhesion_length_over_range * eps
    found = remaining.predict(s, length, eps)
    variance = integrate_band(0.8, magnification, 0)
    energy = integrate_band(0.8, magnification, 1) / variance / 4
    yield compare("energy ratio", found.energy_ratio, length / energy)
    for name in ("approach", "separation", "pull_off"):
        value, (low, high) = getattr(found, name), getattr(found, f"{name}_limits")
        yield require(f"{name} within its limits", 0 <= low <= value <= high)
        yield require(f"{name} at most all", name == "pull_off" or high <= 1)
    left = 1 - 1 / found.energy_ratio
    yield Check("less than full contact leaves", left - found.separation, 1e-12)
    stronger = remaining.predict(s, 1.1 * length, eps)
    yield Check("order", found.separation - stronger.separation, 1e-9)
    same = remaining.predict(model(0.8, magnification, 1.0, UNIT), length * UNIT, eps * UNIT)
    yield Check("other unit", abs(found.separation - same.separation), SCALED)


# --- Layers: response of each wave, and contact in the limits of a half-space and of springs. ---


def probe_layer(thickness, poisson, variant):
    layer = Layer(thickness, poisson, variant)
    expected = layer_response(thickness, poisson, variant)
    yield compare("response", layer.factor(1.0), expected, 1e-12)
    yield compare("compliance", layer.compliance(1.0), 2 * expected, 1e-12)
    yield compare("stiffness", layer.stiffness(1.0), 0.5 / expected, 1e-12)
    same = Layer(thickness * UNIT, poisson, variant).in_unit(UNIT)
    yield compare("other unit", same.factor(1.0), expected, 1e-12)


def probe_layer_contact(thickness, pressure, variant):
    """The pressure is in units of the longest waves' stiffness."""
    solid, heights = Layer(thickness, 0.3, variant), make_heights(8, 32)
    p = pressure / float(solid.factor(1.0))
    c = solver.solve(heights, 2 * np.pi, p, tol=TOLERANCE, solid=solid)
    yield compare("mean pressure", c.pressure.mean(), p, 1e-11)
    yield from check_contact(c, heights, solid.compliance)
    if thickness > THICK:
        half = solver.solve(heights, 2 * np.pi, p, tol=TOLERANCE)
        off = abs(c.area_fraction - half.area_fraction) * heights.size
        yield Check("area on a half-space", off / 1.5, 1)
    if thickness <= 2e-4:
        gap, area = closed_forms.press_springs(heights, p * float(solid.compliance(1e-9)))
        yield Check("area on springs", abs(c.area_fraction - area), 0.01)
        yield Check("gap on springs", abs(c.mean_gap - gap), 0.01)


_HURST = (0.05, 0.2, 0.5, 0.8, 1.0)
_MAGNIFICATION = (1.001, 2, 8, 64, 1e3, 1e6, 1e10)
_PRESSURE = (1e-8, 1e-5, 1e-3, 0.03, 0.3, 3, 100, 1e6)
_RANGE = (1e-6, 1e-4, 1e-2, 0.3, 3, 30, 1e3)
_ADHESION = (1e-6, 1e-4, 1e-2, 0.1, 1, 10)
_THICKNESS = (1e-8, 1e-4, 1e-2, 0.3, 1, 3, 30, 1e4, 1e8)

COMPONENTS = {
    "spectrum": Component(probe_spectrum, {"hurst": _HURST, "magnification": _MAGNIFICATION}),
    "surface": Component(
        probe_surface,
        {"magnification": (1.001, 2, 8, 64, 1e3), "grid": (2, 3, 4, 16, 31, 32, 97, 128)},
    ),
    "wave": Component(probe_wave, {"pressure": _PRESSURE, "grid": (4, 7, 16, 31, 64, 128)}),
    "contact": Component(
        probe_contact, {"pressure": _PRESSURE, "magnification": (1.01, 2, 8, 16, 64, 1e6)}
    ),
    "adhesion": Component(
        probe_adhesion,
        {"range_over_h_rms": _RANGE, "adhesion_length_over_range": _ADHESION},
        tuple(LAWS),
    ),
    "paths": Component(
        probe_path,
        {"pressure": (1e-5, 0.03, 3), "adhesion_length_over_range": (1e-6, 1e-2, 0.1, 1, 10)},
        tuple(LAWS),
    ),
    "theory": Component(
        probe_theory,
        {"magnification": _MAGNIFICATION, "pressure": _PRESSURE},
        ("afferrante2018", "almqvist2011"),
    ),
    "PSD": Component(probe_psd, {"hurst": _HURST, "grid": (2, 3, 4, 16, 31, 64, 97, 128)}),
    "criteria": Component(
        probe_criteria,
        {
            "range_over_h_rms": (1e-12, *_RANGE),
            "adhesion_length_over_range": (*_ADHESION, 1e4, 1e7),
        },
    ),
    "verdict": Component(
        probe_verdict,
        {"adhesion_length_over_range": (*_ADHESION, 1e4, 1e7), "magnification": _MAGNIFICATION},
    ),
    "layer": Component(
        probe_layer,
        {"thickness": _THICKNESS, "poisson": (0, 0.3, 0.4999, 0.499999, 0.5)},
        ("bonded", "slip"),
    ),
    "layer-contact": Component(
        probe_layer_contact,
        {"thickness": (1e-4, 1e-2, 0.3, 3, 1e4), "pressure": _PRESSURE},
        ("bonded", "slip"),
    ),
}
