"""What the schema of materials cannot say: orders, units, sizes, what goes together."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise
from typing import Any

from common.config.messages import unit_problem, unknown
from stickiness.units import si

# Far wider than those of real solids, for mistaken prefixes; tough tapes dissipate 1 kJ/m^2.
_SIZES = {
    "plane_strain_modulus": ("1 Pa", "100000 GPa"),
    "youngs_modulus": ("1 Pa", "100000 GPa"),
    "work_of_adhesion": ("1e-9 J/m^2", "10000 J/m^2"),
    "range": ("1e-12 m", "1e-4 m"),
    "thickness": ("1e-10 m", "1 m"),
}


def rate_problems(material: Mapping[str, Any]) -> Iterator[str]:
    """Yield what is wrong with a modulus that depends on the rate, a line each."""
    series = material.get("youngs_modulus_prony", {"terms": []})
    yield from unit_problem("youngs_modulus_prony.equilibrium", series.get("equilibrium"), "Pa")
    for index, (modulus, time) in enumerate(series["terms"]):
        yield from unit_problem(f"youngs_modulus_prony.terms[{index}][0]", modulus, "Pa")
        yield from unit_problem(f"youngs_modulus_prony.terms[{index}][1]", time, "s")
    pairs = material.get("youngs_modulus_table", [])
    for index, (frequency, modulus) in enumerate(pairs):
        yield from unit_problem(f"youngs_modulus_table[{index}][0]", frequency, "Hz")
        yield from unit_problem(f"youngs_modulus_table[{index}][1]", modulus, "Pa")
    frequencies = [si(frequency, "Hz") for frequency, _ in pairs]
    if any(b <= a for a, b in pairwise(frequencies)):
        listed = ", ".join(frequency for frequency, _ in pairs)
        yield f"youngs_modulus_table = {listed}: frequencies must ascend"
    if pairs and not frequencies[0] <= 1 <= frequencies[-1]:
        yield (
            f"youngs_modulus_table runs from {pairs[0][0]} to {pairs[-1][0]} and must cover 1 Hz, "
            "at which the verdict is quoted"
        )


def size_problems(material: Mapping[str, Any]) -> Iterator[str]:
    """Yield which sizes of a material are those of no solid, a line each."""
    for key, (low, high) in _SIZES.items():
        unit = low.partition(" ")[2]
        if key in material and not si(low, unit) <= si(material[key], unit) <= si(high, unit):
            yield f"{key} = {material[key]!r} must be in {low} … {high}; no solid is beyond"


def layer_problems(material: Mapping[str, Any], surfaces: Mapping[str, Any]) -> Iterator[str]:
    """Yield what is wrong with a layer or with the surface of a material, a line each."""
    own = material.get("surface")
    if own is not None and own not in surfaces:
        yield unknown("surface", own, surfaces)
    if "thickness" not in material:
        if "backing" in material:
            yield f"backing = {material['backing']!r} is of a layer: give its thickness, too"
        return
    poisson = material.get("poisson_ratio")
    if "plane_strain_modulus" in material or poisson is None:
        yield (
            f"thickness = {material['thickness']!r}: a layer needs youngs_modulus and "
            "poisson_ratio in place of plane_strain_modulus"
        )
    elif poisson < 0:
        yield f"poisson_ratio = {poisson!r} of a layer must be between 0 and 0.5"
    if isinstance(material.get("backing"), Mapping):
        for key in ("youngs_modulus_table", "youngs_modulus_prony"):
            if key in material:
                yield (
                    f"{key} with an elastic backing: give youngs_modulus, since only the layer "
                    "would depend on the rate"
                )
