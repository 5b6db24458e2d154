"""How scripts read entries of the configuration; without the models, which jobs do not need."""

from collections.abc import Mapping
from typing import Any

MOST_POINTS = 2048  #: along a side of the grid that measured heights are pressed on, by default

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
