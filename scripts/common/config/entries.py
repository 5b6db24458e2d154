"""How scripts read entries of the configuration; without the models, which jobs do not need."""

from collections.abc import Mapping
from typing import Any

MOST_POINTS = 2048  #: along a side of the grid that measured heights are pressed on, by default

#: Conditions of an experiment and of its cases, and their units.
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
#: Units of what may be observed; whether a pair sticks has none and is no number.
OBSERVED_UNITS = {
    "relative_pull_off": None,
    "limiting_roughness": "m",
    "work_of_approach": "J/m^2",
    "work_of_separation": "J/m^2",
}


def measurements(surface: Mapping[str, Any]) -> list[tuple[str, dict[str, Any]]]:
    """Return every measurement of a measured surface: a prefix for messages, and all of its keys.

    Keys beside the list `measurements` apply to every entry that does not give its own.
    """
    if "measurements" not in surface:
        return [("", dict(surface))]
    shared = {key: value for key, value in surface.items() if key != "measurements"}
    return [(f"measurements[{i}].", shared | one) for i, one in enumerate(surface["measurements"])]


def conditions_of(experiment: Mapping[str, Any], case: Mapping[str, Any]) -> dict[str, Any]:
    """Return the conditions of a case: its own, or those of the experiment."""
    conditions = {key: case.get(key, experiment.get(key)) for key in CONDITIONS}
    # A modulus of either kind in the case replaces that of the experiment.
    moduli = "plane_strain_modulus", "youngs_modulus"
    for key, other in (moduli, moduli[::-1]):
        if key in case and other not in case:
            conditions[other] = None
    return {key: given for key, given in conditions.items() if given is not None}
