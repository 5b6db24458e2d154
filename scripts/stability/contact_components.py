"""Probes of contact without adhesion: equilibrium by plain transforms, balances, other units."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

import numpy as np

from stability.components import Check, Component, compare_each, model, require
from stickiness import adhesive, dmt
from stickiness import surface as synthesis
from stickiness.criteria import a_v_fit
from stickiness.repulsive import richardson, solver, subpixel

TOLERANCE = 1e-8  # asked of the solvers
SLACK = 2.0  # for what rounding adds to a residual that was met to the tolerance
LAWS = {
    "maugis": adhesive.Maugis,
    "exponential": adhesive.Exponential,
    "lennard_jones": adhesive.LennardJones,
}


@lru_cache(maxsize=4)
def heights_of(hurst, magnification, q0_h_rms, unit, grid):
    """Heights of a model surface as far as the grid holds it, one wave at the least."""
    held = min(magnification, grid / 2) if grid > 2 else magnification
    s = model(hurst, max(held, 1.01), q0_h_rms, unit)
    return synthesis.synthesise(s, n=grid, length=2 * np.pi * unit, seed=3)


@lru_cache(maxsize=256)
def solve_contact(hurst, magnification, pressure, q0_h_rms=1.0, unit=1.0, grid=32):
    """Repulsive contact; by default in the unit in which everything is of order one."""
    heights = heights_of(hurst, magnification, q0_h_rms, unit, grid)
    return solver.solve(heights, 2 * np.pi * unit, pressure * q0_h_rms, tol=TOLERANCE)


def displace(pressure, length):
    """Displacement of zero mean under a pressure over E*, by a transform of its own."""
    n0, n1 = pressure.shape
    k = np.hypot(np.fft.fftfreq(n0, 1 / n0)[:, None], np.fft.fftfreq(n1, 1 / n1)[None, :])
    k[0, 0] = np.inf
    return np.fft.ifft2(np.fft.fft2(pressure) / (np.pi * k / length)).real


def probe_repulsive(hurst, magnification, pressure, q0_h_rms, unit, grid) -> Iterator[Check]:
    parameters = (hurst, magnification, pressure, q0_h_rms, unit, grid)
    heights, c = heights_of(hurst, magnification, *parameters[3:]), solve_contact(*parameters)
    h_rms, p = q0_h_rms * unit, pressure * q0_h_rms
    yield compare_each("mean pressure", c.pressure.mean(), p, 1e-11)
    gap = displace(c.pressure, 2 * np.pi * unit) - heights
    gap += c.shift
    # Rounding of the transform grows with the largest pressure, far beyond full contact.
    rounding = 1e-14 * float(c.pressure.max()) * 2 * np.pi * unit
    allowed = SLACK * (TOLERANCE * c.rms_height + rounding)
    touching = c.pressure > 0
    inside = float(np.max(np.abs(gap[touching]), initial=0))
    yield Check("gap in contact", inside / allowed, 1)
    outside = float(np.max(-gap[~touching], initial=0))
    yield Check("penetration", outside / allowed, 1)
    yield Check("gap reported", float(np.max(np.abs(np.maximum(gap, 0) - c.gap))) / allowed, 1)
    yield require("tension", c.pressure.min() >= 0)
    yield compare_each("area", c.area_fraction, np.mean(touching), 1e-12)
    same = solve_contact(hurst, magnification, pressure, grid=grid)
    # A point on the verge may be counted either way.
    pixel = 1.5 / heights.size
    yield Check("area, other unit", abs(c.area_fraction - same.area_fraction) / pixel, 1)
    scale = max(same.mean_gap, TOLERANCE)
    yield Check("gap, other unit", abs(c.mean_gap / h_rms - same.mean_gap) / scale, 1e-6)


def probe_edges(
    hurst, magnification, pressure, range_over_h_rms, q0_h_rms, unit, grid
) -> Iterator[Check]:
    """Sub-pixel areas, and the limit of fine grids from them and every second point."""
    h_rms = q0_h_rms * unit
    c = solve_contact(hurst, magnification, pressure, q0_h_rms, unit, grid)
    same = solve_contact(hurst, magnification, pressure, grid=grid)
    ranges = np.array([range_over_h_rms, 1e6])
    area = dmt.attractive_area(c.gap, ranges * h_rms, subpixel=True)
    strip = subpixel.boundary_strip(c.gap == 0)
    contact = float(np.mean(c.gap == 0)) - strip
    # Areas of contact and gap add up to one, up to what clefts and narrow spots leave.
    yield Check("areas add up", abs(contact + area[1] - 1), 1e-9)
    yield require("sign and order", -1e-12 <= area[0] <= area[1] + 1e-12)
    other = dmt.attractive_area(same.gap, ranges, subpixel=True)
    # Contacts that differ by a point have edges that differ by a few.
    yield Check("other unit", float(np.max(np.abs(area - other))) * grid**2 / 4, 1)
    values = [dmt.attractive_area(g, ranges * h_rms) for g in (c.gap[::2, ::2], c.gap)]
    limit = richardson.estimate(
        "attractive_area", values, area - values[1], subpixel.edge_count(c.gap == 0), ranges
    )
    yield require("limit", np.all(np.isfinite([limit.value, limit.error])))
    edges = np.array([0.0, *(np.geomspace(1e-7, 1e4, 23) * h_rms)])
    share = np.sum(dmt.gap_density(c.gap, edges) * np.diff(edges))
    yield Check("P(u) normalised", abs(share + np.mean(c.gap == 0) - 1), 1e-9)


def probe_dmt(
    hurst, magnification, pressure, range_over_h_rms, adhesion_length_over_range, q0_h_rms, unit,
    variant,
) -> Iterator[Check]:  # fmt: skip
    h_rms = q0_h_rms * unit
    c = solve_contact(hurst, magnification, pressure, q0_h_rms, unit)
    eps = range_over_h_rms * h_rms
    law = LAWS[variant](adhesion_length_over_range * eps, eps)
    counted, fine = (dmt.adhesive_pressure(c.gap, law, subpixel=kind) for kind in (False, True))
    # Anew from the gaps over the range, largest first.
    x = np.sort(c.gap[c.gap > 0])[::-1] / eps
    sigma = {
        "maugis": lambda: np.where(x <= 1, 1.0, 0.0),
        "exponential": lambda: np.exp(-x),
        "lennard_jones": lambda: 8 / 3 * (np.exp(-3 * np.log1p(x)) - np.exp(-9 * np.log1p(x))),
    }[variant]()
    expected = adhesion_length_over_range * sigma.sum() / c.gap.size
    yield Check("attraction", abs(counted - expected) / max(expected, 1e-300), 1e-7)
    open_share = 1 - (c.area_fraction - subpixel.boundary_strip(c.gap == 0))
    yield Check("sub-pixel, below the strength", max(fine / law.strength - open_share, 0.0), 1e-9)
    if variant == "maugis":
        area = adhesion_length_over_range * dmt.attractive_area(c.gap, eps, subpixel=True)
        yield Check("Maugis by areas", abs(fine - area) / max(area, 1e-300), 1e-9)
    same = LAWS[variant](adhesion_length_over_range * range_over_h_rms, range_over_h_rms)
    plain = solve_contact(hurst, magnification, pressure)
    other = dmt.adhesive_pressure(plain.gap, same, subpixel=True)
    allowed = 4 * law.strength / c.gap.size  # contacts may differ by a point
    yield Check("other unit", abs(fine - other) / allowed, 1)
    ranges = np.geomspace(0.01, 0.1, 5) * h_rms
    made = 1.5 * 3 * pressure * (ranges / h_rms) ** (2 / 3)
    fit = a_v_fit.fit_a_v(ranges, made, pressure * q0_h_rms, h_rms, 1 / unit)
    yield compare_each("a_V", fit.value, 3)


SURFACE = {"magnification": 8}
MAGNIFICATIONS = {"magnification": (1.01, 2, 4, 8, 16, 64, 1e6)}

CONTACT = {
    "repulsive": Component(
        probe_repulsive,
        ("magnification", "hurst", "pressure", "q0_h_rms", "unit", "grid"),
        reference=SURFACE,
        values=MAGNIFICATIONS,
        further=({"grid": 509}, {"grid": 1024}),
    ),
    "sub-pixel": Component(
        probe_edges,
        ("magnification", "hurst", "pressure", "range_over_h_rms", "q0_h_rms", "unit", "grid"),
        pairs=(("pressure", "range_over_h_rms"), ("pressure", "grid"), ("pressure", "hurst"),
               ("q0_h_rms", "unit"), ("pressure", "unit"), ("pressure", "magnification")),
        reference=SURFACE,
        values=MAGNIFICATIONS,
    ),
    "dmt": Component(
        probe_dmt,
        ("magnification", "hurst", "pressure", "range_over_h_rms", "adhesion_length_over_range",
         "q0_h_rms", "unit"),
        pairs=(("pressure", "range_over_h_rms"), ("q0_h_rms", "unit"),
               ("adhesion_length_over_range", "range_over_h_rms"),
               ("range_over_h_rms", "unit")),
        variants=tuple(LAWS),
        reference=SURFACE,
        values=MAGNIFICATIONS,
    ),
}  # fmt: skip
