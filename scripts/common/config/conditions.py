"""Conditions of published experiments, and what may be observed."""

from collections.abc import Mapping
from typing import Any

#: Conditions of an experiment and of its cases: unit, and name for readers.
CONDITIONS = {
    "radius": ("m", "radius of the sphere"),
    "plane_strain_modulus": ("Pa", "modulus"),
    "youngs_modulus": ("Pa", "modulus"),
    "poisson_ratio": (None, "Poisson's ratio"),
    "work_of_adhesion": ("J/m^2", "work of adhesion"),
    "range": ("m", "range of the attraction"),
    "hurst": (None, "Hurst exponent"),
    "longest_wavelength": ("m", "longest wave"),
    "rolloff_wavelength": ("m", "roll-off"),
    "shortest_wavelength": ("m", "shortest wave"),
    "h_rms": ("m", "rms height"),
}
#: What may be observed: unit, and name for readers. Whether a pair sticks is no number.
OBSERVED = {
    "relative_pull_off": (None, "relative pull-off"),
    "limiting_roughness": ("m", "limiting rms height"),
    "work_of_approach": ("J/m^2", "work of approach"),
    "work_of_separation": ("J/m^2", "work of separation"),
    "share": (None, "remaining share"),
    "sticks": (None, "sticks"),
}


def conditions_of(experiment: Mapping[str, Any], case: Mapping[str, Any]) -> dict[str, Any]:
    """Return the conditions of a case: its own, or those of the experiment."""
    conditions = {key: case[key] or experiment[key] for key in CONDITIONS}
    # A modulus of either kind in the case replaces that of the experiment.
    if case["plane_strain_modulus"] and not case["youngs_modulus"]:
        conditions["youngs_modulus"] = None
    if case["youngs_modulus"] and not case["plane_strain_modulus"]:
        conditions["plane_strain_modulus"] = None
    return {key: condition for key, condition in conditions.items() if condition is not None}
