"""Probes of full adhesion: balances at every point, other units, tension, and whole paths."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from stability.components import Check, Component, compare_each, require
from stability.contact_components import LAWS, SURFACE, TOLERANCE, heights_of, solve_contact
from stickiness import adhesive

CONTROLS = tuple(f"{law} {control}" for law in LAWS for control in ("pressure", "mean_gap"))


@dataclass(frozen=True)
class Adhesion:
    """Adhesion of a model surface, and the scale of the surface."""

    range_over_h_rms: float
    adhesion_length_over_range: float
    q0_h_rms: float = 1.0
    unit: float = 1.0

    def law(self, name):
        """The law of this name in the unit of the surface."""
        eps = self.range_over_h_rms * self.q0_h_rms * self.unit
        return LAWS[name](self.adhesion_length_over_range * eps, eps)


@lru_cache(maxsize=64)
def solve_adhesive(variant, hurst, magnification, pressure, adhesion, grid):
    """Adhesive contact at a load, or at the mean gap that this load has without adhesion."""
    name, control = variant.split()
    q0_h_rms, unit = adhesion.q0_h_rms, adhesion.unit
    heights = heights_of(hurst, magnification, q0_h_rms, unit, grid)
    value = pressure * q0_h_rms
    if control == "mean_gap":
        value = solve_contact(hurst, magnification, pressure, q0_h_rms, unit, grid).mean_gap
    control = {control: value}
    return adhesive.solve(heights, 2 * np.pi * unit, adhesion.law(name), **control, tol=TOLERANCE)


def closing_pressure(displacement, unit):
    """Pressure of zero mean that a displacement needs, on a side of 2 pi units."""
    n = len(displacement)
    k = np.hypot(*np.meshgrid(*[np.fft.fftfreq(n, 1 / n)] * 2)) / unit
    return np.fft.ifft2(np.fft.fft2(displacement) * k / 2).real


def stress_unit(heights, unit, law):
    """Pressure that residuals are relative to."""
    return max(float(np.sqrt(np.mean(closing_pressure(heights, unit) ** 2))), law.strength)


def check_equilibrium(state, heights, unit) -> Iterator[Check]:
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


def probe_adhesive(hurst, magnification, pressure, grid, variant, **adhesion) -> Iterator[Check]:
    """`adhesion` holds the fields of `Adhesion`."""
    shape, adhesion = (hurst, magnification, pressure), Adhesion(**adhesion)
    q0_h_rms, unit = adhesion.q0_h_rms, adhesion.unit
    state = solve_adhesive(variant, *shape, adhesion, grid)
    heights = heights_of(hurst, magnification, q0_h_rms, unit, grid)
    control = variant.split()[1]
    stress = stress_unit(heights, unit, state.law)
    yield from check_equilibrium(state, heights, unit)
    if control == "pressure":
        balance = state.pressure.mean() - pressure * q0_h_rms
        yield Check("mean pressure", abs(balance) / stress, 2e-8)
        yield compare_each("load", state.mean_pressure, pressure * q0_h_rms, 1e-12)
    else:
        asked = solve_contact(*shape, q0_h_rms, unit, grid).mean_gap
        yield Check("mean gap", abs(state.gap.mean() - asked) / (q0_h_rms * unit), 1e-9)
    if q0_h_rms != 1 or unit != 1:
        # Same surface and loads over q0 h_rms: so must be the adhesion, l_a/eps and all.
        over_range = adhesion.adhesion_length_over_range / q0_h_rms
        plain = Adhesion(adhesion.range_over_h_rms, over_range)
        same = solve_adhesive(variant, *shape, plain, grid)
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
    law = Adhesion(range_over_h_rms, adhesion_length_over_range).law(name)
    control = {"pressure": 0.0 if kind == "unloaded" else -pressure}
    start, before = None, None
    if kind == "separation":
        start = kind
    elif kind == "closed":
        control = {"mean_gap": 0.0}
    elif kind == "flattened":
        control = {"mean_gap": 0.9 * law.range}
        start = np.full(heights.shape, control["mean_gap"])
        before = measure_energy(start, heights, law)
    # Full contact holds as long as the wall pushes everywhere.
    flattened = closing_pressure(heights, 1.0)
    holds = law.hard_wall and law.traction(0.0) - pressure > -flattened.min()
    try:
        state = adhesive.solve(heights, 2 * np.pi, law, start=start, tol=TOLERANCE, **control)
    except adhesive.PullOffError:
        yield require("pulled off without a pull", kind in ("pulled", "separation"))
        yield require("full contact holds", not (holds and kind == "separation"))
        held = find_largest_tension(heights, law) if kind == "pulled" else 0.0
        yield Check("tension held at a mean gap", held / pressure, 1 + 1e-6)
        return
    yield from check_equilibrium(state, heights, 1.0)
    yield Check("beyond the strength", -state.mean_pressure / law.strength, 1 + 1e-7)
    if kind == "separation":
        yield require("full contact", state.repulsive_area_fraction >= 1 or not holds)
    if kind == "closed" and law.hard_wall:
        yield Check("full contact", 1 - state.repulsive_area_fraction, 0.5 / heights.size)
    if kind == "unloaded":
        # The first touch without adhesion, from where the descent at no load begins.
        before = measure_energy(np.max(heights) - heights, heights, law)
    if before is not None:
        scale = law.adhesion_length + abs(before)
        yield Check("energy has not risen", (state.energy - before) / scale, 1e-7)
        yield compare_each("energy", state.energy, measure_energy(state.gap, heights, law), 1e-6)


def measure_energy(gap, heights, law):
    """Elastic plus interaction energy per area."""
    elastic = 0.5 * float(np.mean((gap + heights) * closing_pressure(gap + heights, 1.0)))
    return elastic + float(np.mean(law.potential(gap)))


def find_largest_tension(heights, law):
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
    law = Adhesion(range_over_h_rms, adhesion_length_over_range).law(name)
    if control == "pressure":
        loop = [pressure, 3 * pressure, pressure, -2 * law.strength]
    else:  # to the gap of this load, where contact may be full
        closest = solve_contact(0.8, 4, pressure, grid=grid).mean_gap
        loop = [closest + law.range, closest, closest + law.range]
    points = list(
        adhesive.path(
            heights, 2 * np.pi, law, loop, control, steps=6, balance=1e-4, located=1e-2,
            smallest_jump=1e-2, max_states=400, tol=TOLERANCE,
        )
    )  # fmt: skip
    for point in points[:: max(len(points) // 8, 1)]:
        yield from check_equilibrium(point.state, heights, 1.0)
    first = points[0].state
    energies = [point.state.energy - first.energy for point in points]
    scale = max(np.max(np.abs(energies)), 1e-3 * law.adhesion_length)
    lost = np.cumsum([p.dissipated for p in points if np.isfinite(p.dissipated)])
    yield Check("energy out of nothing", -lost[-1] / scale, 1e-2)
    if control == "pressure":
        last = points[-1]
        yield require("held beyond the strength", last.event == "pull-off")
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


_FINE = tuple(
    {"grid": 128, "magnification": 16, "range_over_h_rms": eps, "adhesion_length_over_range": la}
    for eps, la in ((0.3, 0.01), (1e-4, 1e-4), (1e-2, 10), (100, 10))
)
_BRANCHES = {
    "pressure": (1e-8, 1e-3, 0.03, 0.3, 3, 100),
    "range_over_h_rms": (1e-2, 0.1, 0.3, 3, 1e3),
    "adhesion_length_over_range": (1e-6, 1e-2, 0.1, 1, 10),
    "grid": (9, 12, 16, 17),
}


ADHESION = {
    "adhesive": Component(
        probe_adhesive,
        ("magnification", "hurst", "pressure", "range_over_h_rms", "adhesion_length_over_range",
         "q0_h_rms", "unit", "grid"),
        pairs=(("range_over_h_rms", "adhesion_length_over_range"),
               ("pressure", "adhesion_length_over_range")),
        variants=CONTROLS,
        reference=SURFACE | {"grid": 16},
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
