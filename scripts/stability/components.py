"""Probes of the main chain: each compares a part of the library with closed forms and limits.

A probe takes two parameters, and a `variant` if there are several laws or models. It yields what
was compared and the error over what passes for right. Lengths are in units of 1/q0, pressures over
E*.
"""

from decimal import Decimal, localcontext
from functools import cache, lru_cache

import numpy as np
from scipy.integrate import quad
from scipy.special import erf, erfinv

from stickiness import adhesive, criteria, remaining, surface, traction_laws
from stickiness.criteria import equivalent_sphere
from stickiness.measured import instrument_spectrum, psd
from stickiness.measured.topography import Topography
from stickiness.persson.theory import Persson
from stickiness.repulsive import solver
from stickiness.solids import Layer
from stickiness.spectrum.kinds import SelfAffine

TOLERANCE = 1e-8  # of the solvers
SIDE = 2 * np.pi
LAWS = traction_laws.LAWS | {"lennard_jones": adhesive.LennardJones}
PRESSURES = (1e-8, 1e-5, 1e-3, 0.03, 0.3, 3, 100, 1e6)
RANGES = (1e-6, 1e-4, 1e-2, 0.3, 3, 30, 1e3)
ADHESION = (1e-6, 1e-4, 1e-2, 0.1, 1, 10)
GAMMA = 0.45  # of Yang and Persson's suppression of the diffusion of pressure
THICK = 40.0  # thickness times wave number from which a layer is a half-space to 1e-30

#: Probe of every component, and the values of the parameters that it is tried at.
COMPONENTS = {}


def component(name, **values):
    """Decorator that registers a probe by the name of its component."""

    def register(probe):
        COMPONENTS[name] = probe, values
        return probe

    return register


def check(name, error, tolerance):
    """Return what was compared, and its error over the tolerance."""
    return name, float(error / tolerance)


def require(name, met):
    """Check that a condition is met."""
    return check(name, float(not met), 0.5)


def bound(name, errors, tolerance=1e-9):
    """Check the largest of some errors, 0 if there are none."""
    return check(name, np.max(errors, initial=0), tolerance)


def compare(name, value, expected, tolerance=1e-9):
    """Check the relative deviation."""
    return check(name, abs(value / expected - 1), tolerance)


def integrate_band(hurst, magnification, power):
    """Integral of x^(1 + power - 2 (1 + H)) over the band, x = q/q0 up to the magnification."""
    exponent = power - 2 * hurst
    return float(np.expm1(exponent * np.log(magnification)) / exponent)


def hertz_attraction(t):
    """Attraction on a sphere without its own effect on the gap, over that of DMT.

    Work of Hertz' pressure on an unit traction, with t the ratio of attractive to contact area.
    """
    root = np.sqrt(t)
    return float(2 / np.pi * ((1 + 1 / t) * np.arctan(root) + 1 / root))


def law_of_traction(kind, x):
    """Traction at a gap x over the range, over the work of adhesion per range."""
    if kind == "maugis":
        return np.where(x <= 1, 1.0, 0.0)
    if kind == "exponential":
        return np.exp(-x)
    if kind == "van_der_waals":
        return 2 * np.exp(-3 * np.log1p(x))
    return 8 / 3 * (np.exp(-3 * np.log1p(x)) - np.exp(-9 * np.log1p(x)))


def persson_area_error(pressure, area, m2):
    """Relative error of the variance m2 at which Persson's theory gives an area.

    The diffusion of pressure is integrated anew, with the suppression S = g + (1 - g) A^2 of Yang
    and Persson, J. Phys.: Condens. Matter 20, 215214 (2008), doi:10.1088/0953-8984/20/21/215214.
    """
    if area > 1 - 1e-9 or area < 1e-12:  # erf leaves no digits to invert
        return 0.0
    y = float(erfinv(area))
    # dV/p^2 = dy/(y^3 S); in t = ln(y'/y), from y to where the contact is full.
    scale = 2 / y**2 * quad(
        lambda t: np.exp(-2 * t) / (GAMMA + (1 - GAMMA) * erf(y * np.exp(t)) ** 2),
        0, 20, points=[max(np.log(1 / y), 0.1)] if y < 1 else None, limit=400, epsrel=1e-10,
    )[0]  # fmt: skip
    # Near full contact the area hardly depends on the variance: errors weigh as in the area.
    return abs(scale * pressure**2 / m2 - 1) * y * np.exp(-(y**2)) / area


@cache
def layer_response(k, poisson, backing):
    """Compliance of a layer on a rigid base over that of a half-space, at k = |q| d, in 150 digits.

    Johnson, Contact Mechanics (1985), section 5.8: the base is bonded, or slips without friction.
    """
    if k > THICK:
        return 1.0
    with localcontext(prec=150):
        x = Decimal(k)
        nu = Decimal(poisson)
        up = (2 * x).exp()
        down = (-2 * x).exp()
        sinh = (up - down) / 2
        cosh = (up + down) / 2
        if backing == "slip":
            return float((cosh - 1) / (sinh + 2 * x))
        kappa = 3 - 4 * nu
        return float((kappa * sinh - 2 * x) / (kappa * cosh + 2 * x * x + (1 + kappa * kappa) / 2))


def filter_waves(field, factor):
    """Field on a side of 2 pi with each wave multiplied by a factor of its wave number, no mean."""
    index = np.fft.fftfreq(len(field), 1 / len(field))
    q = np.hypot(index[:, None], index[None, :])
    q[0, 0] = 1.0
    waves = np.fft.fft2(field) * factor(q)
    waves[0, 0] = 0
    return np.fft.ifft2(waves).real


def model(hurst, magnification):
    """Self-affine spectrum of unit rms height."""
    return SelfAffine(hurst=hurst, q0=1.0, q1=magnification, h_rms=1.0)


@lru_cache(maxsize=4)
def make_heights(magnification, grid):
    """Heights of a model surface as far as the grid resolves it."""
    return surface.synthesise(model(0.8, min(magnification, grid / 2)), n=grid, length=SIDE, seed=3)


@component("surface", magnification=(1.001, 2, 8, 64, 1e3), grid=(2, 3, 4, 16, 31, 32, 97, 128))
def probe_surface(magnification, grid):
    """Moments of the spectrum, and its heights on two grids."""
    s = model(0.8, magnification)
    variance = integrate_band(0.8, magnification, power=0)
    energy = integrate_band(0.8, magnification, power=1)
    for name, value, power in (("slope", s.rms_slope, 2), ("curvature", s.rms_curvature, 4)):
        expected = np.sqrt(integrate_band(0.8, magnification, power) / variance)
        yield compare(f"rms {name}", value, expected)
    yield compare("elastic energy", s.elastic_energy(), energy / variance / 4)
    heights = surface.synthesise(s, n=grid, length=SIDE, seed=3)
    if grid > 2 * magnification:  # beyond Nyquist, where the grid shows half of some modes
        yield compare("rms height", np.sqrt(np.mean(heights**2)), 1)
    yield bound("mean", abs(heights.mean()))
    finer = surface.synthesise(s, n=2 * grid, length=SIDE, seed=3)
    yield bound("finer grid", np.abs(finer[::2, ::2] - heights) / np.max(np.abs(heights)))
    power = np.abs(np.fft.fft2(heights)) ** 2
    index = np.fft.fftfreq(grid, 1 / grid)
    radius = np.hypot(index[:, None], index[None, :])
    outside = (radius > magnification * (1 + 1e-9)) | (radius < 1 - 1e-9)
    yield check("power outside the band", power[outside].sum() / power.sum(), 1e-20)


@component("contact", pressure=PRESSURES, magnification=(1.01, 2, 8, 16, 64, 1e6))
def probe_contact(pressure, magnification):
    """Gaps that follow from pressures by a transform; nothing pulls or overlaps."""
    heights = make_heights(magnification, 32)
    c = solver.solve(heights, SIDE, pressure, tol=TOLERANCE)
    yield compare("mean pressure", c.pressure.mean(), pressure, 1e-11)
    gap = filter_waves(c.pressure, lambda q: 2 / q) - heights + c.shift
    # Rounding of the transform grows with the largest pressure, far beyond full contact.
    allowed = 2 * (TOLERANCE * c.rms_height + 6e-14 * float(c.pressure.max()))
    touching = c.pressure > 0
    yield bound("gap in contact", np.abs(gap[touching]), allowed)
    yield bound("penetration", -gap[~touching], allowed)
    yield bound("gap reported", np.abs(np.maximum(gap, 0) - c.gap), allowed)
    yield require("no tension", c.pressure.min() >= 0)
    yield compare("area", c.area_fraction, np.mean(touching), 1e-12)


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


@component(
    "adhesion", range_over_h_rms=RANGES, adhesion_length_over_range=ADHESION, variant=(*LAWS,)
)
def probe_adhesion(range_over_h_rms, adhesion_length_over_range, variant):
    """At a load, and at a mean gap of zero, where contact is full if there is a wall."""
    heights = make_heights(8, 16)
    pressure = 0.03
    law = LAWS[variant](adhesion_length_over_range * range_over_h_rms, range_over_h_rms)
    state = adhesive.solve(heights, SIDE, law, pressure=pressure, tol=TOLERANCE)
    yield from check_equilibrium(state, heights)
    x = np.array([0.1, 0.5, 2.0, 10.0])
    traction = law.traction(x * range_over_h_rms) / adhesion_length_over_range
    yield bound("law of traction", np.abs(traction - law_of_traction(variant, x)))
    stress = max(float(np.std(elastic_pressure(heights))), law.strength)
    yield check("mean pressure", abs(state.pressure.mean() - pressure) / stress, 2e-8)
    displaced = state.gap + heights
    stored = 0.5 * np.mean(displaced * elastic_pressure(displaced))
    off = abs(state.energy - stored - np.mean(law.potential(state.gap)))
    yield bound("energy", off / (stored + law.adhesion_length), 1e-6)
    if law.hard_wall:
        closed = adhesive.solve(heights, SIDE, law, mean_gap=0.0, tol=TOLERANCE)
        yield check("full contact", 1 - closed.repulsive_area_fraction, 0.5 / heights.size)


@component(
    "paths",
    pressure=(1e-5, 0.03, 3),
    adhesion_length_over_range=(1e-6, 1e-2, 0.1, 1, 10),
    variant=(*LAWS,),
)
def probe_path(pressure, adhesion_length_over_range, variant):
    """Load, unload and pull off, without energy out of nothing."""
    heights = make_heights(4, 16)
    law = LAWS[variant](adhesion_length_over_range * 0.3, 0.3)
    loop = [pressure, 3 * pressure, pressure, -2 * law.strength]
    points = list(
        adhesive.path(
            heights, SIDE, law, loop, steps=6, balance=1e-4, located=1e-2,
            smallest_jump=1e-2, max_states=400, tol=TOLERANCE,
        )
    )  # fmt: skip
    for point in points[:: max(len(points) // 8, 1)]:
        yield from check_equilibrium(point.state, heights)
    first = points[0].state
    last = points[-1]
    energies = [point.state.energy - first.energy for point in points]
    scale = max(np.max(np.abs(energies)), 1e-3 * law.adhesion_length)
    lost = np.cumsum([p.dissipated for p in points if np.isfinite(p.dissipated)])
    yield check("energy out of nothing", -lost[-1] / scale, 1e-2)
    yield require("pulls off before twice its strength", last.event == "pull-off")
    yield check("pull-off", -last.state.mean_pressure / law.strength, 1 + 1e-7)
    back = max(k for k, p in enumerate(points) if p.state.mean_pressure == pressure)
    # Unloading keeps what loading closed.
    wider = points[back].state.mean_gap - first.mean_gap
    yield check("hysteresis", wider / max(first.mean_gap, law.range), 1e-5)
    if not any(p.event for p in points[: back + 1]) and lost[back] < 1e-6 * scale:
        yield check("reversible", abs(energies[back]) / scale, 1e-3)


@lru_cache(maxsize=2)
def make_theory(variant, magnification):
    """Persson's theory of a model spectrum."""
    return Persson(model(0.8, magnification), variant=variant)


@component(
    "theory",
    magnification=(1.001, 2, 8, 64, 1e3, 1e6, 1e10),
    pressure=PRESSURES,
    variant=("afferrante2018", "almqvist2011"),
)
def probe_theory(magnification, pressure, variant):
    t = make_theory(variant, magnification)
    area = float(t.area_fraction(pressure))
    gap = float(t.mean_gap(pressure))
    below = float(t.gap_cumulative(0.3, pressure))
    everything = float(t.gap_cumulative(np.inf, pressure))
    yield check("area + gaps = 1", abs(area + everything - 1), 1e-8)
    yield require("sign", min(area, gap, below, float(t.gap_density(0.3, pressure))) >= 0)
    yield check("order", max(below - everything, 0.0), 1e-12)
    m2 = 0.5 * t.spectrum.rms_slope**2
    yield check("area", persson_area_error(pressure, area, m2), 1e-7)
    if 1 - area > 1e-6 and gap > 1e-6 and pressure > 1e-6:
        yield compare("load at the gap", t.pressure_at(gap), pressure, 1e-6)


@component("PSD", hurst=(0.05, 0.2, 0.5, 0.8, 1.0), grid=(2, 3, 4, 16, 31, 64, 97, 128))
def probe_psd(hurst, grid):
    """Parseval, and the power law that was put in."""
    s = model(hurst, max(0.45 * grid, 1.01))
    step = SIDE / grid
    heights = surface.synthesise(s, n=grid, length=SIDE, seed=3)
    plane = psd.power_spectrum(heights, step)
    yield compare("Parseval", plane.total(), np.var(heights))
    limits = instrument_spectrum.TrustedWaves(detect=False)
    topography = Topography(heights, step, step, "probe")
    fit = instrument_spectrum.analyse(topography, "none", limits).fit
    yield check("Hurst exponent", abs(fit.hurst - hurst) / max(fit.hurst_se, 0.02), 5)


@component(
    "criteria", range_over_h_rms=(1e-12, *RANGES), adhesion_length_over_range=(*ADHESION, 1e4, 1e7)
)
def probe_criteria(range_over_h_rms, adhesion_length_over_range):
    """Formulas of the criteria, and what remains of adhesion: its order, bounds and energy."""
    s = model(0.8, 64)
    a_v = 3.0
    eps = range_over_h_rms
    la = adhesion_length_over_range * eps
    limit = criteria.h_rms_threshold(1.0, la, eps, a_v)
    yield compare("threshold", criteria.violano(limit, 1.0, la, eps, a_v).margin, 1)
    margin = 75 / 4 / adhesion_length_over_range
    yield compare("DMT range", 1 / criteria.jtb_limit(1.0, la, eps), margin)
    energy = integrate_band(0.8, 64, 1) / integrate_band(0.8, 64, 0) / 4
    yield compare("Persson-Tosatti", criteria.persson_tosatti(s, la).margin, la / energy)
    margin = 10 * np.sqrt(2 / s.rms_curvature) * la
    yield compare("Fuller-Tabor", criteria.fuller_tabor(1.0, s.rms_curvature, la).margin, margin)
    if range_over_h_rms < 1e-3:
        margin = np.exp(2) / np.sqrt(2 * np.pi) * la
        bearing = criteria.bearing_area(1.0, 1.0, la, eps).margin
        yield compare("bearing area, small ranges", bearing, margin, 1e-2)
    # The sphere that stands for an edge of contact: Hertz' limit of weak attraction.
    sphere = equivalent_sphere.attraction(1.0, 1.0, s.rms_slope, la, eps, a_v)
    t = 0.75 * a_v * range_over_h_rms ** (2 / 3) * s.rms_slope
    yield compare("attractive over contact", sphere.attractive_over_contact, t)
    weak = hertz_attraction(t)
    yield check("below Hertz' limit", sphere.effect / weak - 1, 1e-9)
    if sphere.strength * np.sqrt(1 + t) < 1e-6:
        yield compare("Hertz' limit", sphere.effect, weak, 1e-4)
    predicted = remaining.predict(s, la, eps)
    stronger = remaining.predict(s, 1.1 * la, eps)
    yield compare("energy ratio", predicted.energy_ratio, la / energy)
    for name in ("approach", "separation", "pull_off"):
        value = getattr(predicted, name)
        low, high = getattr(predicted, f"{name}_limits")
        yield require(f"{name} within its limits", 0 <= low <= value <= high)
        yield require(f"{name} at most all", name == "pull_off" or high <= 1)
    left = 1 - 1 / predicted.energy_ratio
    yield check("less than full contact leaves", left - predicted.separation, 1e-12)
    yield check("order", predicted.separation - stronger.separation, 1e-9)


@component(
    "layer",
    thickness=(1e-8, 1e-4, 1e-2, 0.3, 1, 3, 30, 1e4, 1e8),
    poisson=(0, 0.3, 0.4999, 0.499999, 0.5),
    variant=("bonded", "slip"),
)
def probe_layer(thickness, poisson, variant):
    """Response to the longest wave."""
    layer = Layer(thickness, poisson, variant)
    expected = layer_response(thickness, poisson, variant)
    yield compare("response", layer.factor(1.0), expected, 1e-12)
    yield compare("compliance", layer.compliance(1.0), 2 * expected, 1e-12)
    yield compare("stiffness", layer.stiffness(1.0), 0.5 / expected, 1e-12)
