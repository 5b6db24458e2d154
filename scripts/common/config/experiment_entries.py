"""What the schema of experiments cannot say: units, orders, and what every case needs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from common.config.messages import unit_problem
from stickiness.units import si

# Conditions that a case takes from its experiment unless it has its own, and their units.
CONDITIONS = {
    "radius": "m",
    "plane_strain_modulus": "Pa",
    "youngs_modulus": "Pa",
    "poisson_ratio": None,
    "work_of_adhesion": "J/m^2",
    "range": "m",
    "hurst": None,
    "longest_wavelength": "m",
    "rolloff_wavelength": "m",
    "shortest_wavelength": "m",
    "h_rms": "m",
}
_NEEDED = ("work_of_adhesion", "range", "hurst", "longest_wavelength", "shortest_wavelength")
# Units of what may be observed; whether a pair sticks has none and is no number.
OBSERVED_UNITS = {
    "relative_pull_off": None,
    "limiting_roughness": "m",
    "work_of_approach": "J/m^2",
    "work_of_separation": "J/m^2",
}
# Quantity that a relation gives.
RELATIONS = {
    "conformal_contact": "work_of_approach",
    "cycle_loss": "work_of_separation",
    "energy_ratio": "limiting_roughness",
}
_LIMITS = {"poisson_ratio": (0.0, 0.5), "hurst": (0.01, 1.0), "relative_pull_off": (0.0, 10.0)}


def conditions_of(experiment: Mapping[str, Any], case: Mapping[str, Any]) -> dict[str, Any]:
    """Conditions of a case: its own, or those of the experiment."""
    own = {key: case.get(key, experiment.get(key)) for key in CONDITIONS}
    # A modulus of the case's own, of either kind, replaces that of the experiment.
    moduli = "plane_strain_modulus", "youngs_modulus"
    for key, other in (moduli, moduli[::-1]):
        if key in case and other not in case:
            own[other] = None
    return {key: given for key, given in own.items() if given is not None}


def experiment_problems(experiment: Mapping[str, Any]) -> Iterator[str]:
    """Yield what is wrong with an experiment, a line each."""
    for key in CONDITIONS:
        if key in experiment:
            yield from _value_problems(key, experiment[key], CONDITIONS[key])
    for name, case in experiment["cases"].items():
        for key in CONDITIONS:
            if key in case:
                yield from _value_problems(f"cases.{name}.{key}", case[key], CONDITIONS[key])
        for problem in _case_problems(conditions_of(experiment, case), case["observed"]):
            yield f"cases.{name}{problem}"


def _case_problems(conditions: Mapping[str, Any], observed: Mapping[str, Any]) -> Iterator[str]:
    quantity = observed["quantity"]
    needed = _NEEDED if quantity == "limiting_roughness" else (*_NEEDED, "h_rms")
    for key in needed:
        if key not in conditions:
            yield f": the key {key!r} is missing, here and in the experiment"
            return
    if "plane_strain_modulus" in conditions and "youngs_modulus" in conditions:
        yield ": give one of plane_strain_modulus and youngs_modulus"
    elif "plane_strain_modulus" not in conditions and not (
        {"youngs_modulus", "poisson_ratio"} <= set(conditions)
    ):
        yield ": give plane_strain_modulus, or youngs_modulus and poisson_ratio"
    if quantity == "sticks":
        if not isinstance(observed.get("value"), bool):
            given = observed.get("value", observed.get("between"))
            yield f".observed.value = {given!r} must be true or false for 'sticks'"
    elif "relation" in observed:
        yield from _relation_problems(observed)
    else:
        yield from _value_problems(".observed", observed, OBSERVED_UNITS[quantity], quantity)
    longest = "rolloff_wavelength" if "rolloff_wavelength" in conditions else "longest_wavelength"
    yield from _order_problems(conditions, "shortest_wavelength", longest)
    if longest == "rolloff_wavelength":
        yield from _order_problems(conditions, longest, "longest_wavelength")


def _relation_problems(observed: Mapping[str, Any]) -> Iterator[str]:
    relation = observed["relation"]
    quantity = RELATIONS[relation]
    if observed["quantity"] != quantity:
        yield f".observed.quantity = {observed['quantity']!r} must be {quantity!r} for {relation!r}"
    if "factor" not in observed:
        yield f".observed: the key 'factor' is missing, limits of that of {relation!r}"
    elif not observed["factor"][0] < observed["factor"][1]:
        yield f".observed.factor = {observed['factor']!r} must be [low, high] with low < high"
    yield from unit_problem(".observed.error", observed.get("error"), "J/m^2")


def _order_problems(conditions: Mapping[str, Any], shorter: str, longer: str) -> Iterator[str]:
    """The longest of the shorter waves must be below the shortest of the longer ones."""
    try:
        most = si(_listed(conditions[shorter])[-1], "m")
        least = si(_listed(conditions[longer])[0], "m")
    except ValueError:
        return  # the unit was found wrong already
    if not most < least:
        yield f".{shorter} reaches {most:g} m and must stay below {longer}, {least:g} m"


def _value_problems(
    key: str, given: Mapping[str, Any], unit: str | None, limited: str | None = None
) -> Iterator[str]:
    """A value or its limits: unit, sign, order and the limits of what it can be."""
    field = "value" if "value" in given else "between"
    found = []
    for value in _listed(given):
        if unit is not None:
            problems = list(unit_problem(f"{key}.{field}", value, unit))
            yield from problems
            if problems:
                return
            found.append(si(value, unit))
            continue
        if isinstance(value, bool) or not isinstance(value, int | float):
            yield f"{key}.{field} = {value!r} must be a number"
            return
        low, high = _LIMITS[limited or key.rsplit(".", 1)[-1]]
        if not low <= value <= high:
            yield f"{key}.{field} = {value!r} must be between {low:g} and {high:g}"
            return
        found.append(value)
    if field == "between" and not found[0] < found[1]:
        yield f"{key}.between = {given['between']!r} must be [low, high] with low < high"


def _listed(given: Mapping[str, Any]) -> list[Any]:
    return list(given["between"]) if "between" in given else [given["value"]]
