"""Probes of contact: equilibrium recomputed with plain transforms, balances, other units."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

import numpy as np

from pipeline.stability.components import Check, Component
from pipeline.stability.theory import each_against, model
from stickiness import adhesive
from stickiness.adhesion import dmt
from stickiness.contact import gaps, grid_limit, solver, subpixel
from stickiness.criteria import a_v_fit
from stickiness.surfaces import synthesis

TOLERANCE = 1e-8  # asked of the solvers
_SLACK = 2.0  # for what rounding adds to a residual that was met to the tolerance
LAWS = {
    "maugis": adhesive.Maugis,
    "exponential": adhesive.Exponential,
    "lennard_jones": adhesive.LennardJones,
}
CONTROLS = tuple(f"{law} {control}" for law in LAWS for control in ("pressure", "mean_gap"))


@lru_cache(maxsize=4)
def heights_of(hurst, magnification, q0_h_rms, unit, grid):
    """Heights of a model surface as far as the grid holds it, one wave at the least."""
    held = min(magnification, grid / 2) if grid > 2 else magnification
    s = model(hurst, max(held, 1.01), q0_h_rms, unit)
    return synthesis.synthesise(s, n=grid, length=2 * np.pi * unit, seed=3)


@lru_cache(maxsize=256)
def pressed(hurst, magnification, pressure, q0_h_rms=1.0, unit=1.0, grid=32):
    """Repulsive contact; by default in the unit in which everything is of order one."""
    heights = heights_of(hurst, magnification, q0_h_rms, unit, grid)
    return solver.solve(heights, 2 * np.pi * unit, pressure * q0_h_rms, tol=TOLERANCE)


def response(pressure, length):
    """Displacement of zero mean under a pressure over E*, by a transform of its own."""
    n0, n1 = pressure.shape
    k = np.hypot(np.fft.fftfreq(n0, 1 / n0)[:, None], np.fft.fftfreq(n1, 1 / n1)[None, :])
    k[0, 0] = np.inf
    return np.fft.ifft2(np.fft.fft2(pressure) / (np.pi * k / length)).real


def probe_repulsive(hurst, magnification, pressure, q0_h_rms, unit, grid) -> Iterator[Check]:
    parameters = (hurst, magnification, pressure, q0_h_rms, unit, grid)
    heights, c = heights_of(hurst, magnification, *parameters[3:]), pressed(*parameters)
    h_rms, p = q0_h_rms * unit, pressure * q0_h_rms
    yield each_against("mean pressure", c.pressure.mean(), p, 1e-11)
    gap = response(c.pressure, 2 * np.pi * unit) - heights
    gap += c.shift
    # Rounding of the transform grows with the largest pressure, far beyond full contact.
    rounding = 1e-14 * float(c.pressure.max()) * 2 * np.pi * unit
    allowed = _SLACK * (TOLERANCE * c.rms_height + rounding)
    touching = c.pressure > 0
    inside = float(np.max(np.abs(gap[touching]), initial=0))
    yield Check("gap in contact", inside / allowed, 1)
    outside = float(np.max(-gap[~touching], initial=0))
    yield Check("penetration", outside / allowed, 1)
    yield Check("gap reported", float(np.max(np.abs(np.maximum(gap, 0) - c.gap))) / allowed, 1)
    yield Check("tension", 0.0 if c.pressure.min() >= 0 else 1.0, 0.5)
    yield each_against("area", c.area_fraction, np.mean(touching), 1e-12)
    same = pressed(hurst, magnification, pressure, grid=grid)
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
    c = pressed(hurst, magnification, pressure, q0_h_rms, unit, grid)
    same = pressed(hurst, magnification, pressure, grid=grid)
    ranges = np.array([range_over_h_rms, 1e6])
    area = gaps.attractive_area(c.gap, ranges * h_rms, subpixel=True)
    strip = subpixel.boundary_strip(c.gap == 0)
    contact = float(np.mean(c.gap == 0)) - strip
    # Areas of contact and gap add up to one, up to what clefts and narrow spots leave.
    yield Check("areas add up", abs(contact + area[1] - 1), 1e-9)
    yield Check("sign and order", 0.0 if -1e-12 <= area[0] <= area[1] + 1e-12 else 1.0, 0.5)
    other = gaps.attractive_area(same.gap, ranges, subpixel=True)
    # Contacts that differ by a point have edges that differ by a few.
    yield Check("other unit", float(np.max(np.abs(area - other))) * grid**2 / 4, 1)
    values = [gaps.attractive_area(g, ranges * h_rms) for g in (c.gap[::2, ::2], c.gap)]
    limit = grid_limit.estimate(
        "attractive_area", values, area - values[1], subpixel.edge_count(c.gap == 0), ranges
    )
    yield Check("limit", 0.0 if np.all(np.isfinite([limit.value, limit.error])) else 1.0, 0.5)
    edges = np.array([0.0, *(np.geomspace(1e-7, 1e4, 23) * h_rms)])
    share = np.sum(gaps.gap_density(c.gap, edges) * np.diff(edges))
    yield Check("P(u) normalised", abs(share + np.mean(c.gap == 0) - 1), 1e-9)


def probe_dmt(
    hurst, magnification, pressure, range_over_h_rms, adhesion_length_over_range, q0_h_rms, unit,
    variant,
) -> Iterator[Check]:  # fmt: skip
    h_rms = q0_h_rms * unit
    c = pressed(hurst, magnification, pressure, q0_h_rms, unit)
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
        area = adhesion_length_over_range * gaps.attractive_area(c.gap, eps, subpixel=True)
        yield Check("Maugis by areas", abs(fine - area) / max(area, 1e-300), 1e-9)
    same = LAWS[variant](adhesion_length_over_range * range_over_h_rms, range_over_h_rms)
    plain = pressed(hurst, magnification, pressure)
    other = dmt.adhesive_pressure(plain.gap, same, subpixel=True)
    allowed = 4 * law.strength / c.gap.size  # contacts may differ by a point
    yield Check("other unit", abs(fine - other) / allowed, 1)
    ranges = np.geomspace(0.01, 0.1, 5) * h_rms
    made = 1.5 * 3 * pressure * (ranges / h_rms) ** (2 / 3)
    fit = a_v_fit.fit_a_v(ranges, made, pressure * q0_h_rms, h_rms, 1 / unit)
    yield each_against("a_V", fit.value, 3)


@lru_cache(maxsize=64)
def adhered(variant, hurst, magnification, pressure, *adhesion, grid):
    """Adhesive contact at a load, or at the mean gap that this load has without adhesion."""
    eps_over_h, length_over_eps, q0_h_rms, unit = adhesion
    law, control = variant.split()
    heights = heights_of(hurst, magnification, q0_h_rms, unit, grid)
    eps = eps_over_h * q0_h_rms * unit
    value = pressure * q0_h_rms
    if control == "mean_gap":
        value = pressed(hurst, magnification, pressure, q0_h_rms, unit, grid).mean_gap
    return adhesive.solve(
        heights,
        2 * np.pi * unit,
        LAWS[law](length_over_eps * eps, eps),
        **{control: value},
        tol=TOLERANCE,
    )


def closing_pressure(displacement, unit):
    """Pressure of zero mean that a displacement needs, on a side of 2 pi units."""
    n = len(displacement)
    k = np.hypot(*np.meshgrid(*[np.fft.fftfreq(n, 1 / n)] * 2)) / unit
    return np.fft.ifft2(np.fft.fft2(displacement) * k / 2).real


def stress_unit(heights, unit, law):
    """Pressure that residuals are relative to."""
    return max(float(np.sqrt(np.mean(closing_pressure(heights, unit) ** 2))), law.strength)


def equilibrium(state, heights, unit) -> Iterator[Check]:
    """Balance of pressures at every point of an adhesive state."""
    stress = stress_unit(heights, unit, state.law)
    # Pressure that the half-space asks for.
    elastic = closing_pressure(state.gap + heights, unit) + state.mean_pressure
    excess = elastic + state.law.traction(state.gap)  # what is left for the wall
    at_wall = (state.gap <= 0) & state.law.hard_wall
    free = ~at_wall
    if not state.law.smooth:
        # At the jump of the law any traction between its two sides is in equilibrium.
        jump = np.abs(state.gap - state.law.range) <= 1e-9 * state.law.range
        within = (elastic <= TOLERANCE * stress) & (-elastic <= state.law.strength * (1 + 1e-9))
        free &= ~(jump & within)
    yield Check("equilibrium", float(np.max(np.abs(excess[free]), initial=0)) / stress, 2e-8)
    yield Check("wall", float(np.max(-excess[at_wall], initial=0)) / stress, 2e-8)


def probe_adhesive(
    hurst, magnification, pressure, range_over_h_rms, adhesion_length_over_range, q0_h_rms, unit,
    grid, variant,
) -> Iterator[Check]:  # fmt: skip
    shape = (hurst, magnification, pressure)
    adhesion = (range_over_h_rms, adhesion_length_over_range, q0_h_rms, unit)
    state = adhered(variant, *shape, *adhesion, grid=grid)
    heights = heights_of(hurst, magnification, q0_h_rms, unit, grid)
    control = variant.split()[1]
    stress = stress_unit(heights, unit, state.law)
    yield from equilibrium(state, heights, unit)
    if control == "pressure":
        balance = state.pressure.mean() - pressure * q0_h_rms
        yield Check("mean pressure", abs(balance) / stress, 2e-8)
        yield each_against("load", state.mean_pressure, pressure * q0_h_rms, 1e-12)
    else:
        asked = pressed(*shape, q0_h_rms, unit, grid).mean_gap
        error = abs(state.gap.mean() - asked) / (q0_h_rms * unit)
        yield Check("mean gap", error, 1e-9)
    if q0_h_rms != 1 or unit != 1:
        # Same surface and loads over q0 h_rms: so must be the adhesion, l_a/eps and all.
        plain = (range_over_h_rms, adhesion_length_over_range / q0_h_rms, 1.0, 1.0)
        same = adhered(variant, *shape, *plain, grid=grid)
        gap = state.mean_gap / (q0_h_rms * unit)
        allowed = 1e-5 * max(abs(same.mean_gap), 1e-3)
        if not state.law.hard_wall and control == "pressure":
            # The residual leaves the gap as uncertain as the law is weak beside the elasticity.
            stiffness = abs(float(np.mean(state.law.derivative(state.gap))))
            allowed += 4 * TOLERANCE * stress / stiffness / (q0_h_rms * unit)
        yield Check("gap, other unit", abs(gap - same.mean_gap) / allowed, 1)


# --- Zero load, tension, states from full contact; what is pulled off must have been. ---

STARTS = tuple(
    f"{law} {kind}"
    for law in LAWS
    for kind in ("unloaded", "pulled", "separation", "closed", "flattened")
)


def probe_tension(
    pressure, range_over_h_rms, adhesion_length_over_range, grid, variant
) -> Iterator[Check]:
    """The pressure pulls; `closed` and `flattened` prescribe the mean gap.

    `closed` makes it zero, `flattened` begins with the same gap everywhere, where the law softens.
    """
    name, kind = variant.split()
    heights = heights_of(0.8, 4, 1.0, 1.0, grid)
    law = LAWS[name](adhesion_length_over_range * range_over_h_rms, range_over_h_rms)
    control = {"pressure": 0.0 if kind == "unloaded" else -pressure}
    start, before = None, None
    if kind == "separation":
        start = kind
    elif kind == "closed":
        control = {"mean_gap": 0.0}
    elif kind == "flattened":
        control = {"mean_gap": 0.9 * law.range}
        start = np.full(heights.shape, control["mean_gap"])
        before = _energy(start, heights, law)
    # Full contact holds as long as the wall pushes everywhere.
    flattened = closing_pressure(heights, 1.0)
    holds = law.hard_wall and law.traction(0.0) - pressure > -flattened.min()
    try:
        state = adhesive.solve(heights, 2 * np.pi, law, start=start, tol=TOLERANCE, **control)
    except adhesive.PullOffError:
        yield Check("pulled off without a pull", float(kind not in ("pulled", "separation")), 0.5)
        yield Check("full contact holds", float(holds and kind == "separation"), 0.5)
        held = _largest_tension(heights, law) if kind == "pulled" else 0.0
        yield Check("tension held at a mean gap", held / pressure, 1 + 1e-6)
        return
    yield from equilibrium(state, heights, 1.0)
    yield Check("beyond the strength", -state.mean_pressure / law.strength, 1 + 1e-7)
    if kind == "separation":
        yield Check("full contact", float((state.repulsive_area_fraction < 1) and holds), 0.5)
    if kind == "closed" and law.hard_wall:
        yield Check("full contact", 1 - state.repulsive_area_fraction, 0.5 / heights.size)
    if kind == "unloaded":
        # The first touch without adhesion, from where the descent at no load begins.
        before = _energy(np.max(heights) - heights, heights, law)
    if before is not None:
        scale = law.adhesion_length + abs(before)
        yield Check("energy has not risen", (state.energy - before) / scale, 1e-7)
        yield each_against("energy", state.energy, _energy(state.gap, heights, law), 1e-6)


def _energy(gap, heights, law):
    """Elastic plus interaction energy per area."""
    elastic = 0.5 * float(np.mean((gap + heights) * closing_pressure(gap + heights, 1.0)))
    return elastic + float(np.mean(law.potential(gap)))


def _largest_tension(heights, law):
    """Largest tension at mean gaps beyond that of no load, a lower bound of the branch's."""
    state = adhesive.solve(heights, 2 * np.pi, law, pressure=0.0, tol=TOLERANCE)
    most, first = 0.0, state.mean_gap
    for share in (0.02, 0.05, 0.1, 0.2, 0.4, 0.7, 1.0):
        mean_gap = first + share * law.range
        state = adhesive.solve(
            heights, 2 * np.pi, law, mean_gap=mean_gap, start=state, tol=TOLERANCE
        )
        most = max(most, -state.mean_pressure)
    return most


# --- Paths: equilibrium, no energy out of nothing, and back to where a reversible one began. ---


def probe_path(
    pressure, range_over_h_rms, adhesion_length_over_range, grid, variant
) -> Iterator[Check]:
    name, control = variant.split()
    heights = heights_of(0.8, 4, 1.0, 1.0, grid)
    law = LAWS[name](adhesion_length_over_range * range_over_h_rms, range_over_h_rms)
    if control == "pressure":
        loop = [pressure, 3 * pressure, pressure, -2 * law.strength]
    else:  # to the gap of this load, where contact may be full
        closest = pressed(0.8, 4, pressure, grid=grid).mean_gap
        loop = [closest + law.range, closest, closest + law.range]
    points = list(
        adhesive.path(
            heights, 2 * np.pi, law, loop, control, steps=6, balance=1e-4, located=1e-2,
            smallest_jump=1e-2, max_states=400, tol=TOLERANCE,
        )
    )  # fmt: skip
    for point in points[:: max(len(points) // 8, 1)]:
        yield from equilibrium(point.state, heights, 1.0)
    first = points[0].state
    energies = [point.state.energy - first.energy for point in points]
    scale = max(np.max(np.abs(energies)), 1e-3 * law.adhesion_length)
    lost = np.cumsum([p.dissipated for p in points if np.isfinite(p.dissipated)])
    yield Check("energy out of nothing", -lost[-1] / scale, 1e-2)
    if control == "pressure":
        last = points[-1]
        yield Check("held beyond the strength", float(last.event != "pull-off"), 0.5)
        yield Check("pull-off", -last.state.mean_pressure / law.strength, 1 + 1e-7)
        back = max(k for k, p in enumerate(points) if p.state.mean_pressure == pressure)
        # Unloading keeps what loading closed.
        wider = points[back].state.mean_gap - first.mean_gap
        yield Check("hysteresis", wider / max(first.mean_gap, law.range), 1e-5)
    else:
        back = len(points) - 1
        yield Check("mean gap at the end", abs(points[back].state.mean_gap / loop[-1] - 1), 1e-9)
    if not any(p.event for p in points[: back + 1]) and lost[back] < 1e-6 * scale:
        yield Check("reversible", abs(energies[back]) / scale, 1e-3)


_SURFACE = {"magnification": 8}
_FINE = tuple(
    {"grid": 128, "magnification": 16, "range_over_h_rms": eps, "adhesion_length_over_range": la}
    for eps, la in ((0.3, 0.01), (1e-4, 1e-4), (1e-2, 10), (100, 10))
)
_MAGNIFICATIONS = {"magnification": (1.01, 2, 4, 8, 16, 64, 1e6)}
_BRANCHES = {
    "pressure": (1e-8, 1e-3, 0.03, 0.3, 3, 100),
    "range_over_h_rms": (1e-2, 0.1, 0.3, 3, 1e3),
    "adhesion_length_over_range": (1e-6, 1e-2, 0.1, 1, 10),
    "grid": (9, 12, 16, 17),
}

CONTACT = {
    "repulsive": Component(
        probe_repulsive,
        ("magnification", "hurst", "pressure", "q0_h_rms", "unit", "grid"),
        reference=_SURFACE,
        values=_MAGNIFICATIONS,
        further=({"grid": 509}, {"grid": 1024}),
    ),
    "sub-pixel": Component(
        probe_edges,
        ("magnification", "hurst", "pressure", "range_over_h_rms", "q0_h_rms", "unit", "grid"),
        pairs=(("pressure", "range_over_h_rms"), ("pressure", "grid"), ("pressure", "hurst"),
               ("q0_h_rms", "unit"), ("pressure", "unit"), ("pressure", "magnification")),
        reference=_SURFACE,
        values=_MAGNIFICATIONS,
    ),
    "dmt": Component(
        probe_dmt,
        ("magnification", "hurst", "pressure", "range_over_h_rms", "adhesion_length_over_range",
         "q0_h_rms", "unit"),
        pairs=(("pressure", "range_over_h_rms"), ("q0_h_rms", "unit"),
               ("adhesion_length_over_range", "range_over_h_rms"),
               ("range_over_h_rms", "unit")),
        variants=tuple(LAWS),
        reference=_SURFACE,
        values=_MAGNIFICATIONS,
    ),
    "adhesive": Component(
        probe_adhesive,
        ("magnification", "hurst", "pressure", "range_over_h_rms", "adhesion_length_over_range",
         "q0_h_rms", "unit", "grid"),
        pairs=(("range_over_h_rms", "adhesion_length_over_range"),
               ("pressure", "adhesion_length_over_range")),
        variants=CONTROLS,
        reference=_SURFACE | {"grid": 16},
        values={"magnification": (1.01, 2, 4, 8, 64), "grid": (2, 3, 4, 7, 16, 31, 64)},
        further=_FINE,
    ),
    "tension": Component(
        probe_tension,
        ("pressure", "range_over_h_rms", "adhesion_length_over_range", "grid"),
        pairs=(("pressure", "adhesion_length_over_range"),
               ("range_over_h_rms", "adhesion_length_over_range")),
        variants=STARTS,
        reference={"grid": 16, "adhesion_length_over_range": 0.1},
        values=_BRANCHES,
    ),
    "paths": Component(
        probe_path,
        ("pressure", "range_over_h_rms", "adhesion_length_over_range", "grid"),
        pairs=(),
        variants=CONTROLS,
        reference={"grid": 16, "adhesion_length_over_range": 0.1},
        values=_BRANCHES | {"pressure": (1e-5, 1e-3, 0.03, 0.3, 3)},
    ),
}  # fmt: skip
