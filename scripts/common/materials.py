"""Materials of the configuration as readers see them: moduli as given, and improbable values."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from stickiness.formatting import number, unit_for
from stickiness.plausibility import LIMITS
from stickiness.units import si

LEAST_READABLE = 0.01  #: number in the unit that a modulus was given in
MOST_READABLE = 1e3


def find_doubts(entry: Mapping[str, Any]) -> Iterator[str]:
    """Sentences about values that hardly any real pair has, as the configuration states them."""
    for key, limits in LIMITS.items():
        value = entry.get(key)
        is_measured = key == "work_of_adhesion" and entry.get("work_on_smooth")
        if value is not None and value > limits.usual and not is_measured:
            name = f"{entry['label']}: {key.replace('_', ' ')}"
            yield f"{name} = {value} is improbable: {limits.reason}"


def show_modulus(
    modulus: float, entry: Mapping[str, Any], digits: int = 2, beside: Sequence[float] = ()
) -> str:
    """E* [Pa] as the modulus that the configuration gives, e.g. "E = 0.2 MPa".

    It is in the unit given there, or in one that suits it and all E* that are shown `beside` it.
    """
    name = "E*"
    factor = 1.0
    quantity = entry.get("plane_strain_modulus")
    if quantity is None:
        name = "E"
        factor = 1 - entry["poisson_ratio"] ** 2
        quantity = _find_youngs_modulus(entry)
    moduli = factor * np.array([modulus, *beside])
    unit = str(quantity).lstrip("0123456789.+-eE ")
    per_pascal = 1 / si(f"1 {unit}", "Pa")
    numbers = moduli * per_pascal
    if min(numbers) < LEAST_READABLE or max(numbers) > MOST_READABLE:
        per_pascal, unit = unit_for(max(moduli), "Pa", 2)
    return f"{name} = {number(moduli[0] * per_pascal, digits)} {unit}"


def _find_youngs_modulus(entry: Mapping[str, Any]) -> Any:
    """Young's modulus of an entry, or one of those of which its table or series consists."""
    if entry.get("youngs_modulus_table"):
        return entry["youngs_modulus_table"][0][1]
    if entry.get("youngs_modulus_prony"):
        return entry["youngs_modulus_prony"]["equilibrium"]
    return entry["youngs_modulus"]
