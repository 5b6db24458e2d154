"""Spectra cut where theory carries the tail within the accuracy that a case asks for.

A grid that holds all waves of a broad spectrum is dear, and many quantities hardly feel the finest
of them. A case with an accuracy may be simulated on a part of its spectrum; what the rest changes,
theory adds (`accuracy.carrying_error` says how well). Of the accuracy asked for, simulation is then
left

    left^2 = (accuracy^2 - carrying^2) / s^2,

s being the largest value simulated over the one carried: more than 1 for the area, which finer
waves take away, and at small Hurst exponents for attractive areas too, so that errors of the
simulation weigh more. Both accuracies are of all quantities at all loads together, and so is
carrying, by `accuracy.joint_error`: the sum in quadrature then bounds that of what is carried.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from typing import Any

import numpy as np

from stickiness.accuracy import error_laws as known
from stickiness.accuracy.error_laws import Laws, Settings, Surface, UnreachableError

SHARES = (1, 2, 4, 8)  # parts of the magnification to simulate, up to what was measured


def left_to_simulation(
    laws: Laws,
    accuracy: float,
    surface: Surface,
    carry_to: float,
    pressures: Sequence[float],
    quantities: Iterable[str],
) -> float:
    """Return the accuracy that a simulation needs whose values theory carries on.

    Parameters
    ----------
    accuracy : float
        Relative error of the values carried that is to cover 90 %.
    surface : Surface
        As it is simulated.
    carry_to : float
        Magnification to which theory carries.
    pressures : sequence of float
        Mean pressures over E* q0 h_rms.
    quantities : iterable of str
        What is wanted, of `accuracy.QUANTITIES`.

    Returns
    -------
    float
        Of all quantities at all loads together; 0 if theory alone errs by more.
    """
    columns = {c for quantity in quantities for c in known.QUANTITIES[quantity]}
    weights, errors = [], []
    for pressure in pressures:
        own, broad = (
            _values(surface.hurst, magnification, pressure)
            for magnification in (surface.magnification, carry_to)
        )
        size = 1 - broad["area"] / own["area"]
        for column in columns:
            error = known.carrying_error(laws, surface, carry_to, size, column, pressure)
            weights.append(max(own[column] / broad[column], 1.0))
            errors.append(weights[-1] * error)
    rest = accuracy**2 - float(known.joint_error(errors)) ** 2
    return math.sqrt(max(rest, 0.0)) / max(weights)


def cheapest(
    laws: Laws,
    accuracy: float,
    surface: Surface,
    pressures: Sequence[float],
    quantities: Iterable[str],
    **options: Any,
) -> tuple[float, Settings]:
    """Return the magnification to simulate and the settings that are cheapest in all.

    Parameters are those of `accuracy.cheapest`.

    Raises
    ------
    accuracy.UnreachableError
        For the whole spectrum, if no part of it will do.
    """
    quantities, whole, found = list(quantities), surface.magnification, []
    for magnification in _parts(whole):
        part = Surface(surface.hurst, magnification, surface.window)
        left = accuracy
        if magnification < whole:
            left = left_to_simulation(laws, accuracy, part, whole, pressures, quantities)
        try:
            settings = known.cheapest(laws, left, part, pressures, quantities, **options)
        except UnreachableError as error:
            if magnification == whole:
                refused = error
            continue
        described = options.get("descriptor_seeds", 2048)
        cost = known.predicted_cost(laws, settings, part, pressures, described)
        found.append((cost, -magnification, settings))
    if not found:
        raise refused
    _, magnification, settings = min(found)
    return -magnification, settings


def may_be_cut(case: Mapping[str, Any], surface: Mapping[str, Any]) -> bool:
    """Whether the spectrum of a case of the configuration may be cut.

    Not if all quantities are wanted, as figures need them: these show the surface as it is named.
    """
    fixed = {"carry_to", "maps"} & set(case)
    named = set(case.get("quantities", known.QUANTITIES)) != set(known.QUANTITIES)
    return "accuracy" in case and named and not fixed and "rolloff" not in surface


def name_of(surface: str, magnification: float) -> str:
    """Name of a model surface cut at a magnification."""
    return f"{surface}_to{magnification:g}"


def _parts(whole: float) -> list[float]:
    """Magnifications that may be simulated, the whole one first."""
    least = known.MEASURED["magnification"][0]
    parts = [math.ceil(whole / share) for share in SHARES[1:] if whole <= known.CARRIED_TO]
    return [whole, *(part for part in parts if least <= part < whole)]


@cache
def _values(hurst: float, magnification: float, pressure: float) -> dict[str, float]:
    """What changes of every column with the magnification, by theory on continuous spectra."""
    # Every job of a run reads the configuration; theory is loaded only if a spectrum is to be cut.
    from stickiness.persson.theory import Persson
    from stickiness.surfaces.spectrum import SelfAffine

    spectrum = SelfAffine(hurst=hurst, q0=1.0, q1=magnification, h_rms=1.0)
    theory = Persson(spectrum)
    area = float(theory.area_fraction(pressure))
    near, far = map(float, theory.gap_cumulative(np.array([0.01, 0.1]), pressure))
    return {
        "area": area,
        "mean_gap": float(theory.mean_gap(pressure)),
        "attractive_area_0.01": near,
        "attractive_area_0.1": far,
        "gap_distribution": float(theory.gap_density(0.1, pressure)),
        "a_v": math.sqrt(near * far),  # fitted between the two
        "kappa": area * spectrum.rms_slope,
    }
