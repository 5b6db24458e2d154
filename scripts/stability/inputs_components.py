"""Probes of what goes into simulations and comes out: spectra, settings, the DMT limit."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from itertools import product

import numpy as np
import xarray as xr
from scipy import stats
from scipy.special import beta, erf, gamma

from adhesion.dmt_limit import DmtLimit
from stability.components import SCALED, WIDE, Check, Component, compare_each, model
from stability.theory_components import THEORIES
from stickiness import surface as synthesis
from stickiness.accuracy.choice import (
    COARSE_SEEDS,
    PIXELS,
    SAME_COST,
    SEEDS,
    TOLERANCES,
    UnreachableError,
    cheapest,
)
from stickiness.accuracy.error_models import ErrorModel, Settings, Surface, nearest_measured
from stickiness.accuracy.prediction import SAFETY, Problem, predicted_cost, worst_error
from stickiness.adhesive import LennardJones, dmt
from stickiness.measured import instrument_spectrum, psd, stitching
from stickiness.measured.topography import Topography
from stickiness.persson.theory import Persson
from stickiness.spectrum.kinds import Shells, Tabulated
from stickiness.statistics import COVERS

# --- Spectra with one shell, a gap, or a step of many decades, through theory. ---


def probe_odd_spectra(magnification, pressure, q0_h_rms, unit, variant) -> Iterator[Check]:
    kind, *theory = variant.split()
    s, plain = (
        make_odd_spectrum(kind, magnification, *size) for size in ((q0_h_rms, unit), (1.0, 1.0))
    )
    width, correction = theory
    t, same = (Persson(each, variant=width, correction=correction) for each in (s, plain))
    p, h = pressure * q0_h_rms, q0_h_rms * unit
    area, gap = float(t.area_fraction(p)), float(t.mean_gap(p))
    yield Check("area + gaps = 1", abs(area + float(t.gap_cumulative(np.inf, p)) - 1), 1e-8)
    yield Check("area, other unit", abs(area - float(same.area_fraction(pressure))), SCALED)
    other = float(same.mean_gap(pressure))
    yield Check("gap, other unit", abs(gap / h - other) / max(other, 1e-12), 1e-7)
    # Without correction the area is erf(p/sqrt(2 V)); every correction makes it larger.
    least = erf(p / np.sqrt(s.rms_slope**2))
    yield Check("area of uncorrected theory", least - area, 1e-9)
    yield Check("order", float(t.area_fraction(0.5 * p)) - area, 1e-12)
    below = float(t.gap_cumulative(h, p)), float(t.gap_cumulative(2 * h, p))
    yield Check("more gaps within twice the distance", below[0] - below[1], 1e-9)


def make_odd_spectrum(kind, magnification, q0_h_rms, unit):
    h, q = q0_h_rms * unit, np.array([1.0, magnification]) / unit
    if kind == "shell":
        return Shells(q[:1], [h**2])
    if kind == "shells":
        return Shells(q, np.array([1.0, magnification**-1.6]) * h**2)
    # Two bands with next to nothing between.
    inner = np.array([1, 1.5, 1.50001, 0.99999 * magnification, magnification, 2 * magnification])
    level = np.array([1, 0.3, 1e-30, 1e-30, magnification**-3.6, 0.1 * magnification**-3.6])
    return Tabulated(inner / unit, level * h**2 * unit**2)


# --- Measured spectra: Parseval, the law that was put in, other units, the same map twice. ---


def probe_measured(hurst, q0_h_rms, unit, grid) -> Iterator[Check]:
    found, plane, heights = analyse_map(hurst, q0_h_rms, unit, grid)
    same, *_ = analyse_map(hurst, 1.0, 1.0, grid)
    yield compare_each("Parseval", plane.total(), plane.variance)
    rings = psd.radial_average(plane)
    total = np.sum(rings.psd * rings.modes(plane)) * plane.dqx * plane.dqy
    yield compare_each("rings", total, plane.variance)
    yield compare_each("variance", plane.variance, float(np.var(heights)))
    fit = found.fit
    yield Check("Hurst exponent", abs(fit.hurst - hurst) / max(fit.hurst_se, 0.02), 5)
    yield Check("Hurst exponent, other unit", abs(fit.hurst - same.fit.hurst), 1e-6)
    yield Check("its error, other unit", abs(fit.hurst_se / same.fit.hurst_se - 1), 1e-4)
    scale = unit**2 * (q0_h_rms * unit) ** 2
    level = fit.psd(3 / unit) / same.fit.psd(3.0)
    yield compare_each("level, other unit", level, scale, 1e-6)
    both = stitching.stitch([found, found])
    yield Check("offsets of one map from itself", float(np.max(np.abs(both.offsets))), 1e-9)
    # An offset within its sampling error counts as that, which moves weight to lower q.
    twice = both.spectrum.fit
    yield Check("stitched", abs(twice.hurst - fit.hurst) / max(twice.hurst_se, 0.02), 1)
    lifted = psd.power_spectrum(heights + 3 * np.abs(heights).max(), plane.qx[1] ** -1)
    yield compare_each("lifted", lifted.variance, plane.variance, 1e-12)


@lru_cache(maxsize=64)
def analyse_map(hurst, q0_h_rms, unit, grid):
    s = model(hurst, max(0.45 * grid, 1.01), q0_h_rms, unit)
    length = 2 * np.pi * unit
    heights = synthesis.synthesise(s, n=grid, length=length, seed=3)
    step = length / grid
    plane = psd.power_spectrum(heights, step)
    limits = instrument_spectrum.Limits(detect=False)
    found = instrument_spectrum.analyse(Topography(heights, step, step, "probe"), "none", limits)
    return found, plane, heights


# --- Settings for an accuracy: error models that are plain powers. ---

_MODELS = {
    (part, column): law
    for column in ("area", "mean_gap")
    for part, law in {
        "discretisation": ErrorModel(0.0, magnification=-0.2, pressure=-0.1, pixels=-2.0),
        "solver": ErrorModel(1.0, tolerance=1.0),
        "scatter": ErrorModel(-2.0, hurst=1.0, window=-1.0),
        "fine_share": ErrorModel(-2.0),
        "coarse_share": ErrorModel(-1.0),
    }.items()
} | {
    ("fine_cost", ""): ErrorModel(0.0, magnification=2.0, window=2.0, pixels=2.0),
    ("coarse_cost", ""): ErrorModel(1.0, magnification=2.0, window=2.0),
    ("described_cost", ""): ErrorModel(-7.0),
    ("tolerance_cost", ""): ErrorModel(0.0, tolerance=-0.1),
}
_ASKED = {"30 %": 0.3, "5 %": 0.05, "1 %": 0.01}
_CANDIDATES = tuple(
    Settings(*settings)
    for settings in product(
        PIXELS,
        TOLERANCES[::2],
        SEEDS[::3],
        COARSE_SEEDS[::3],
    )
)


def probe_accuracy(hurst, magnification, pressure, variant) -> Iterator[Check]:
    asked, on = _ASKED[variant], Surface(hurst, magnification)
    problem = Problem(_MODELS, on, [pressure], ["area", "mean_gap"])

    def error(settings):
        return worst_error(problem, settings)[0]

    fits = [s for s in _CANDIDATES if s.pixels_per_wavelength * magnification <= 2048]
    good = [s for s in fits if error(s) <= asked]
    try:
        found = cheapest(problem, asked)
    except UnreachableError:
        yield Check("refused, but can be reached", float(len(good)), 0.5)
        raise
    yield Check("accuracy", error(found) / asked, 1)
    cost = predicted_cost(problem, found)
    for settings in good:
        other = predicted_cost(problem, settings)
        yield Check("cheapest", cost / other, SAME_COST * (1 + SCALED))
    near, load, factor = nearest_measured(on, pressure)
    own = predict_error(found, near, load, factor)
    yield Check("error", abs(error(found) / own - 1), 1e-5)  # of a bisection


def predict_error(settings, on, load, factor):
    grid = factor * on.magnification**-0.2 * load**-0.1 * settings.pixels_per_wavelength**-2.0
    solver = factor * np.e * settings.tolerance
    scatter = factor * np.exp(on.hurst - 2) / on.window
    fine, coarse = np.exp(-2), np.exp(-1)
    levels = 1 / settings.seeds
    if settings.coarse_seeds:
        levels = fine**2 / settings.seeds + coarse**2 / settings.coarse_seeds
        levels += (1 - coarse**2) / 2048
    sampling = COVERS * scatter * np.sqrt(levels)
    # Both quantities err alike; the squares of their chances to be beyond make that of both, 10 %.
    widened = stats.norm.isf(0.1 / np.sqrt(2) / 2) / COVERS
    return SAFETY * widened * np.sqrt(grid**2 + solver**2 + sampling**2)


# --- The DMT limit: attraction over areas that are powers of the range. ---

_DENSE = np.geomspace(1e-14, 1e6, 161)  # ranges of the areas, over h_rms


def probe_dmt_limit(
    pressure, range_over_h_rms, adhesion_length_over_range, q0_h_rms, variant
) -> Iterator[Check]:
    """Areas A = p u^(2/3), whose attraction is sigma_0 p range^(2/3) Gamma(5/3) and the like."""
    loads = xr.DataArray([pressure, 2 * pressure], dims="pressure")
    loads = loads.assign_coords(pressure=loads.values)
    ranges = xr.DataArray(_DENSE, dims="range", coords={"range": _DENSE})
    solved = xr.Dataset(
        {"attractive_area": loads * ranges ** (2 / 3), "area_fraction": loads, "rms_slope": 2.0}
    )
    asked = {
        "law": variant,
        "q0_h_rms": q0_h_rms,
        "pressures": [pressure, 2 * pressure],
        "adhesion_length_over_range": [adhesion_length_over_range],
        "range_over_h_rms": [range_over_h_rms],
    }
    limit = DmtLimit(asked, xr.DataArray([True, True], dims="pressure", coords=loads.coords))
    factor = {"maugis": 1.0, "exponential": gamma(5 / 3)}[variant]
    sigma = adhesion_length_over_range / q0_h_rms
    expected = sigma * range_over_h_rms ** (2 / 3) * factor
    got = limit.attraction(solved).squeeze()
    yield compare_each("attraction", got, expected * loads.values, 1e-3)
    total = (1 - got.values / loads.values) / 2
    kappa = limit.inverse_kappa(solved).squeeze()
    scale = float(np.max(np.abs(total)) + 1)
    yield Check("1/kappa", float(np.max(np.abs(kappa - total))) / scale, SCALED)
    fitted = float(limit.inverse_kappa_ad_fit(solved).squeeze())
    yield compare_each("1/kappa_ad, fitted", fitted, got.values[0] / pressure / 2, 1e-8)
    law = LennardJones(sigma * range_over_h_rms, range_over_h_rms)
    nodes = np.geomspace(1e-8, 1e6, 14 * 64 + 1) * range_over_h_rms
    value = float(dmt.attraction_of_areas(pressure * nodes ** (2 / 3), nodes, law))
    # Integral of x^(-1/3) ((1 + x)^-3 - (1 + x)^-9) is a difference of Beta functions.
    exact = 16 / 9 * (beta(2 / 3, 7 / 3) - beta(2 / 3, 25 / 3))
    expected = sigma * pressure * range_over_h_rms ** (2 / 3) * exact
    yield compare_each("Lennard-Jones", value, expected, 1e-3)


INPUTS = {
    "odd-spectra": Component(
        probe_odd_spectra,
        ("magnification", "pressure", "q0_h_rms", "unit"),
        pairs=(("magnification", "pressure"), ("q0_h_rms", "unit")),
        variants=tuple(f"{kind} {THEORIES[0]}" for kind in ("shell", "shells", "gap")),
        reference={"magnification": 8},
        values={"magnification": (2, 8, 64, 1e3, 1e6, 1e8)},
    ),
    "measured": Component(
        probe_measured,
        ("hurst", "q0_h_rms", "unit", "grid"),
        pairs=(("hurst", "grid"), ("q0_h_rms", "unit")),
        reference={"grid": 64},
        values={"grid": (2, 3, 4, 7, 16, 31, 32, 64, 97, 128)},
    ),
    "accuracy": Component(
        probe_accuracy,
        ("magnification", "hurst", "pressure"),
        variants=tuple(_ASKED),
        values={"magnification": (1.001, 2, 16, 64, 128, 1e3, 1e8)},
    ),
    "dmt-limit": Component(
        probe_dmt_limit,
        ("pressure", "range_over_h_rms", "adhesion_length_over_range", "q0_h_rms"),
        pairs=(("pressure", "range_over_h_rms"),
               ("adhesion_length_over_range", "range_over_h_rms"),
               ("adhesion_length_over_range", "q0_h_rms")),
        variants=("maugis", "exponential"),
        values={"range_over_h_rms": WIDE["range_over_h_rms"]},
    ),
}  # fmt: skip
