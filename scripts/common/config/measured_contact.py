"""What the schema cannot say of `bem`, the contact of measured heights."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from common.config.measurements import measurements
from common.config.messages import unit_problem
from stickiness.units import si

MOST_POINTS = 2048  #: of the grid along a side, unless `most_points` says otherwise


def bem_problems(surface: Mapping[str, Any]) -> Iterator[str]:
    """Yield what is wrong with the contact that is asked for, a line each."""
    bem = surface.get("bem", {})
    entries = measurements(surface)
    index = bem.get("measurement", 0)
    if index >= len(entries):
        yield f"bem.measurement = {index} is counted from 0 and must be below {len(entries)}"
        return
    yield from _pressure_problems(bem)
    if bem.get("periodic", False):
        yield from _period_problems(entries[index][1])


def has_units(pressures: list[float | str]) -> bool:
    """Whether pressures of an entry are given with units."""
    return any(isinstance(pressure, str) for pressure in pressures)


def _pressure_problems(bem: Mapping[str, Any]) -> Iterator[str]:
    pressures = bem.get("pressures", [])
    if not has_units(pressures):
        return
    for index, pressure in enumerate(pressures):
        key = f"bem.pressures[{index}]"
        if not isinstance(pressure, str):
            yield f"{key} = {pressure!r} has no unit, while others have; give all of them one kind"
            return
        if "adhesion" not in bem:
            yield (
                f"{key} = {pressure!r} needs bem.adhesion, which gives the modulus; "
                "or give it over E* q0 h_rms, without a unit"
            )
            return
        yield from unit_problem(key, pressure, "Pa")
    values = [si(pressure, "Pa") for pressure in pressures]
    if len({f"{value:.9e}" for value in values}) < len(values):
        yield f"bem.pressures = {pressures!r} must not repeat a value"


def _period_problems(measurement: Mapping[str, Any]) -> Iterator[str]:
    """Yield what would make periodic heights lose their period."""
    if measurement.get("detrend", "mean") != "mean":
        yield (
            f"detrend = {measurement['detrend']!r} would break the period that bem.periodic "
            "states; give detrend: mean"
        )
    if measurement.get("missing") == "crop":
        yield (
            "missing = 'crop' would break the period that bem.periodic states; "
            "give missing: fill or refuse"
        )
