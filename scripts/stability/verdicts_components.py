"""Probes of what verdicts rest on: edges of contact, the table of a_V, choices, moduli."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

import numpy as np
import xarray as xr
from scipy.optimize import brentq

from stability.components import WIDE, Check, Component, compare_each, model, require
from stickiness.accuracy import model_choice
from stickiness.criteria import equivalent_sphere
from stickiness.criteria.a_v_table import NORMAL_90, AvTable
from stickiness.solids import moduli

# --- Edges of contact: Maugis' sphere by bisection in the ratio of radii, and its two limits. ---


def probe_edges_of_contact(
    hurst, magnification, range_over_h_rms, adhesion_length_over_range, q0_h_rms, unit
) -> Iterator[Check]:
    slope = model(hurst, magnification, q0_h_rms, unit).rms_slope
    h, q0, a_v = q0_h_rms * unit, 1 / unit, 3.0
    eps = range_over_h_rms * h
    found = equivalent_sphere.attraction(h, q0, slope, adhesion_length_over_range * eps, eps, a_v)
    strength = adhesion_length_over_range * 2 / slope
    t = 0.75 * a_v * range_over_h_rms ** (2 / 3) * slope / q0_h_rms
    yield compare_each("attractive over contact", found.attractive_over_contact, t)
    yield compare_each("strength", found.strength, 0.75 * strength / np.sqrt(t))
    sphere = find_sphere_effect(t, found.strength)
    yield compare_each("Maugis' sphere", found.effect, sphere, 1e-6)
    yield compare_each("ratio", found.ratio, strength * t * sphere, 1e-6)
    weak, tough = weak_effect(t), equivalent_sphere.tough_effect(t, found.strength)
    yield Check("below the weak limit", found.effect / weak - 1, 1e-9)
    if found.strength * np.sqrt(1 + t) < 1e-6:
        yield compare_each("weak", found.effect, weak, 1e-4)
    if found.strength > 1e3 * (1 + t) ** 2:
        yield compare_each("tough", found.effect, tough, 0.02)
    length = equivalent_sphere.adhesion_length_threshold(h, q0, slope, eps, a_v)
    at = equivalent_sphere.attraction(h, q0, slope, length, eps, a_v)
    yield compare_each("threshold", at.ratio, 1, 1e-6)


def weak_effect(t: float) -> float:
    """Work of Hertz' pressure on an unit traction, 1 + 1/t as angles, without cancellation."""
    root = np.sqrt(t)
    return float(2 / np.pi * ((1 + 1 / t) * np.arctan(root) + 1 / root))


def find_sphere_effect(t: float, tau: float) -> float:
    """Attraction of Maugis' sphere over DMT's, from the excess s = (c/a)^2 - 1 of its zone."""

    def gap(s: float) -> float:  # of Hertz, at c/a, over a^2/(pi R)
        root = np.sqrt(s)
        if s < 1e-3:  # series of root + (s - 1) arctan(root)
            return root**3 * (4 / 3 - 8 / 15 * s + 12 / 35 * s**2)
        return root + (s - 1) * np.arctan(root)

    def closing(s: float) -> float:
        root = np.sqrt(s)
        if s < 1e-6:
            return 2 * s  # 4 (root arctan(root) - sqrt(1 + s) + 1)
        return 4 * (root * np.arctan(root) - s / (np.sqrt(1 + s) + 1))

    traction = tau * 8 / (3 * np.pi) * np.sqrt(t)
    widest = gap(t)

    def excess(x: float) -> float:
        return gap(np.exp(x)) + traction * closing(np.exp(x)) - widest

    low = np.log(t) - 2
    while excess(low) > 0:
        low -= 2
    s = np.exp(brentq(excess, low, np.log(t) + 1e-9, xtol=1e-14, rtol=1e-15))
    root = np.sqrt(s)
    return float(2 / (np.pi * t) * ((1 + s) * np.arctan(root) + root))


# --- a_V: a table of power laws, between whose points logarithms are straight. ---

_RATIO, _ERROR, _TREND, _DRIFT, _QUADRATURE = 1.1, 0.05, 0.02, 0.04, 0.01


def a_v_law(hurst, pressure, ranges):
    return np.exp(0.3 * hurst) * pressure**0.1 * ranges**-0.2


def edge_range(hurst, magnification, pressure):
    return magnification**-1.5 * pressure**0.2 * np.exp(hurst)


@lru_cache(maxsize=1)
def make_table() -> AvTable:
    axes = {
        "hurst": np.linspace(0.5, 1, 6),
        "magnification": np.geomspace(1e2, 1e8, 7),
        "pressure": np.geomspace(1e-3, 1, 7),
        "range": np.geomspace(1e-12, 1, 13),
    }
    data = xr.Dataset(coords=axes)
    h, zeta, p, eps = (data[name] for name in axes)
    data["a_v"] = a_v_law(h, p, eps) * zeta**0.05
    data["a_v_limit"] = 1.5 * a_v_law(h, p, eps)
    data["edge_range"] = edge_range(h, zeta, p)
    data["edge_a_v"] = 0 * h * zeta + 2.0
    for name, value in (("below", 0.1), ("above", 0.2)):
        data[f"theory_{name}"] = 0 * data.a_v + value
        data[f"theory_{name}_limit"] = 0 * data.a_v_limit + value
    plain = xr.DataArray(np.ones((2, 3)), dims=("simulated_pressure", "simulated_range"))
    data = data.assign_coords(simulated_pressure=[0.01, 0.3], simulated_range=[1e-3, 0.03, 1])
    data["simulation_ratio"], data["simulation_error"] = _RATIO * plain, _ERROR * plain
    data["simulation_trend"] = _TREND * plain[0]
    data["quadrature_error"], data["extrapolation_error"] = _QUADRATURE, _DRIFT
    data["smallest_magnification"], data["largest_magnification"] = 32.0, 128.0
    return AvTable(data)


def probe_a_v(hurst, magnification, pressure, range_over_h_rms, variant) -> Iterator[Check]:
    infinite = variant == "infinite"
    zeta = np.inf if infinite else magnification
    found = make_table().a_v_at(hurst, pressure, range_over_h_rms, zeta)
    edge = 0.0 if infinite else edge_range(hurst, zeta, pressure)
    if infinite:
        theory = 1.5 * a_v_law(hurst, pressure, range_over_h_rms)
    else:
        held = min(max(range_over_h_rms, edge), 1.0)
        theory = a_v_law(hurst, pressure, held) * zeta**0.05
    ratio = _RATIO * np.exp(_TREND * (np.clip(np.log2(zeta), 5, 7) - 7))
    yield compare_each("value", found.value, ratio * theory, 1e-4)  # splines are solved to 1e-5
    below = range_over_h_rms < edge
    yield require("edge", bool(found.edge) == below)
    doublings = float(np.clip(np.log2(zeta) - 7, 0, 1))  # simulated from 2^5 to 2^7
    decades = max(np.log10(1e-3 / range_over_h_rms), 0.0)
    error = np.sqrt(_ERROR**2 + (_TREND * doublings) ** 2 + _DRIFT**2 * decades)
    yield compare_each("error of simulation", found.simulation, error, 1e-8)
    reach = np.log(2.0 / theory) if below else None
    for name, limit, sign, of_theory in (
        ("low", found.low, -1, 0.1 if reach is None else max(-reach, 0)),
        ("high", found.high, 1, 0.2 if reach is None else max(reach, 0)),
    ):
        width = np.sqrt(of_theory**2 + (NORMAL_90 * error) ** 2 + _QUADRATURE**2)
        yield compare_each(name, limit / found.value, np.exp(sign * width), 1e-4)


# --- Choice of the model: a table of power laws, and nothing beyond it. ---

_POINTS = (
    np.array([16.0, 32, 64]),
    np.array([1e-3, 1e-2, 0.1]),
    np.array([1e-3, 1e-2, 0.1, 1.0]),
    np.array([1e-4, 1e-2, 1.0]),
)
_POWERS = np.array([0.1, -0.05, -0.2, 0.3])


@lru_cache(maxsize=1)
def make_error_table() -> model_choice.ErrorTable:
    logs = tuple(np.log(axis) for axis in _POINTS)
    ratio = sum(k * x for k, x in zip(_POWERS, np.meshgrid(*logs, indexing="ij"), strict=True))
    return model_choice.ErrorTable({("exponential", 0.8): (logs, ratio, np.full_like(ratio, 0.1))})


def probe_model_choice(
    hurst, magnification, pressure, range_over_h_rms, adhesion_length_over_range, q0_h_rms
) -> Iterator[Check]:
    at = magnification, pressure, range_over_h_rms, adhesion_length_over_range / q0_h_rms
    inside = hurst == 0.8 and all(
        axis[0] * (1 - 1e-9) <= x <= axis[-1] * (1 + 1e-9)
        for axis, x in zip(_POINTS, at, strict=True)
    )
    ratio = float(_POWERS @ np.log(at))
    expected = max(abs(np.exp(-ratio + s) - 1) for s in (-0.1, 0.1))
    error = make_error_table().relative_error("exponential", hurst, *at)
    if inside:
        yield compare_each("error", error, expected, 1e-8)
    else:
        yield require("nothing is known outside", np.isnan(error))
    asked = {
        "law": "exponential",
        "model": "auto",
        "accuracy": 0.3,
        "q0_h_rms": q0_h_rms,
        "pressures": [pressure],
        "adhesion_length_over_range": [adhesion_length_over_range],
        "range_over_h_rms": [range_over_h_rms],
    }
    choice = model_choice.choose(
        asked, {"hurst": hurst, "magnification": magnification}, make_error_table()
    )
    # h_rms/range > (4/75) (l_a/range)/(range q0), all over q0 h_rms
    held = q0_h_rms * 75 / 4 > adhesion_length_over_range
    yield require("choice", choice.full.item() != (inside and held and expected <= 0.3))


# --- Moduli that depend on the rate, with the unit of time in place of one of length. ---


def probe_viscoelastic(frequency, unit) -> Iterator[Check]:
    rest, terms = 1e4, ((3e4, unit), (2e5, 1e-3 * unit))
    solid = moduli.Prony(rest, terms)
    f = frequency / unit
    # |i x/(1 + i x)|^2 is the same share, of complex moduli
    expected = rest + sum(e * abs(1 / (1 - 1j / (2 * np.pi * f * tau))) ** 2 for e, tau in terms)
    value = solid.storage(f)
    yield compare_each("storage modulus", value, expected, 1e-12)
    yield Check("grows with the rate", solid.storage(0.5 * f) / value - 1, 1e-15)
    yield Check("between its limits", max(rest / value, value / (rest + 2.3e5)) - 1, 1e-12)
    around = f * np.geomspace(0.1, 10, 9)
    table = moduli.Table(tuple(around), tuple(solid.storage(around)))
    yield compare_each("table", table.storage(f), value, 1e-12)
    if value > 1.0001 * rest and value < 0.9999 * (rest + 2.3e5):
        ((found, upwards),) = moduli.crossings(solid, value, f * np.geomspace(0.5, 3, 99))
        yield compare_each("crossing", found, f, 1e-2)
        yield require("upwards", upwards)


VERDICTS = {
    "edge-adhesion": Component(
        probe_edges_of_contact,
        ("magnification", "hurst", "range_over_h_rms", "adhesion_length_over_range", "q0_h_rms",
         "unit"),
        pairs=(("range_over_h_rms", "adhesion_length_over_range"), ("q0_h_rms", "unit"),
               ("magnification", "hurst"), ("q0_h_rms", "adhesion_length_over_range")),
        values=WIDE,
    ),
    "a_v-table": Component(
        probe_a_v,
        ("magnification", "hurst", "pressure", "range_over_h_rms"),
        variants=("finite", "infinite"),
        reference={"magnification": 1e4},
        values={
            "magnification": (2, 64, 1e2, 3e2, 1e4, 5e6, 1e8, 1e10),
            "hurst": (0.05, 0.5, 0.63, 0.8, 0.97, 1.0),
            "pressure": (1e-8, 1e-3, 2.1e-3, 0.03, 0.5, 3, 1e6),
            "range_over_h_rms": WIDE["range_over_h_rms"],
        },
    ),
    "model-choice": Component(
        probe_model_choice,
        ("magnification", "hurst", "pressure", "range_over_h_rms", "adhesion_length_over_range",
         "q0_h_rms"),
        values={
            "magnification": (2, 16, 24, 64, 1e3, 1e6),
            "hurst": (0.05, 0.8, 1.0),
            "range_over_h_rms": (1e-12, 1e-4, 1e-3, 1e-2, 0.3, 3, 1e3),
            "q0_h_rms": (1e-9, 1e-3, 0.1, 1, 10),
        },
    ),
    "moduli": Component(probe_viscoelastic, ("frequency", "unit")),
}  # fmt: skip
