"""What the schema of real surfaces cannot say: orders, units, files."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from common.config.measured_contact import bem_problems
from common.config.measurements import measurements
from common.config.messages import unit_problem
from stickiness import plausibility
from stickiness.measured import readers
from stickiness.units import si

_BUILTIN = ("builtin:jacksboro",)


def surface_problems(surface: Mapping[str, Any], made: bool = False) -> Iterator[str]:
    """Yield what is wrong with a real surface and its files, a line each.

    With `made`, files may be missing, since another workflow makes them.
    """
    if surface["kind"] == "measured":
        for name, measurement in measurements(surface):
            for problem in _file_problems(measurement, made):
                yield f"{name}{problem}"
        yield from bem_problems(surface)
        return
    longest = _wavelength(surface, "longest_wavelength", "q0")
    shortest = _wavelength(surface, "shortest_wavelength", "q1")
    if not shortest < longest:
        yield f"shortest_wavelength = {shortest:g} m must be below the longest, {longest:g} m"
    if "rolloff_wavelength" in surface:
        rolloff = si(surface["rolloff_wavelength"], "m")
        if not shortest < rolloff < longest:
            yield f"rolloff_wavelength = {rolloff:g} m must be in {shortest:g} … {longest:g} m"
    unit = f"m^{2 - 2 * surface['hurst']:g}"
    for value in _as_list(surface.get("C0", [])):
        yield from unit_problem("C0", value, unit)
    for key, key_unit in (("C0", unit), ("h_rms", "m")):
        values = [si(value, key_unit) for value in _as_list(surface.get(key, []))]
        if values != sorted(values):
            yield f"{key} = {surface[key]!r} must be [low, high]"


def _file_problems(measurement: Mapping[str, Any], made: bool) -> Iterator[str]:
    """Yield what is wrong with a measurement, as far as is known before its file is read."""
    file = measurement["file"]
    for key in ("height_unit", "position_unit"):
        if key in measurement:
            yield from unit_problem(key, f"1 {measurement[key]}", "m")
    if file.startswith("builtin:"):
        if file not in _BUILTIN:
            yield f"file = {file!r} is unknown; built in: {', '.join(_BUILTIN)}"
        return
    if not Path(file).is_file():
        if not made:
            yield f"file = {file!r}: no such file; give a path from the working directory"
        return
    yield from _side_problems(measurement)
    if "length" in measurement and "pixel_size" in measurement:
        yield f"pixel_size = {measurement['pixel_size']!r}: give length or pixel_size, not both"
    if measurement.get("missing", "fill") != "fill" and "max_missing" in measurement:
        yield (
            f"max_missing = {measurement['max_missing']!r} is the share that missing: fill fills; "
            f"leave it out with missing: {measurement['missing']}"
        )
    kind = readers.format_of(file, measurement.get("format"))
    if kind != readers.INSTRUMENT and "channel" in measurement:
        yield f"channel = {measurement['channel']!r}: a {kind} file has no channels; leave it out"
    if kind not in ("netcdf", "numpy") and "variable" in measurement:
        yield f"variable = {measurement['variable']!r} is for NetCDF and npz, this file is neither"
    fit_from, fit_to = (measurement.get(key) for key in ("fit_from", "fit_to"))
    if fit_from and fit_to and not si(fit_to, "m") < si(fit_from, "m"):
        yield f"fit_to = {fit_to!r} must be below fit_from = {fit_from!r}"


def _side_problems(measurement: Mapping[str, Any]) -> Iterator[str]:
    """Yield sides that no measurement has."""
    if measurement.get("plausibility") == "ignore":
        return
    for side in _as_list(measurement.get("length", [])):
        if si(side, "m") > plausibility.LONGEST_SIDE:
            yield f"length = {side!r} {plausibility.REFUSED_SIDE}"
        if si(side, "m") < plausibility.SHORTEST_SIDE:
            yield (
                f"length = {side!r} is shorter than {plausibility.SHORTEST_SIDE:g} m, a few atoms; "
                "correct it, or give plausibility: ignore if it is so"
            )


def _wavelength(surface: Mapping[str, Any], wavelength: str, wave_number: str) -> float:
    if wavelength in surface:
        return si(surface[wavelength], "m")
    return 2 * math.pi / si(surface[wave_number], "1/m")


def _as_list(value: Any) -> list[Any]:
    return value if isinstance(value, list) else [value]
