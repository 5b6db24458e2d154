"""What the schemas of materials and real surfaces cannot say: orders, units, files."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any

from stickiness.config.measured_contact import bem_problems
from stickiness.config.measurements import measurements
from stickiness.config.messages import unit_problem, unknown
from stickiness.core import plausibility
from stickiness.core.units import si
from stickiness.measured import readers

_BUILTIN = ("builtin:jacksboro",)
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
            yield f"{key} = {material[key]!r} is beyond all solids; {low} to {high} is taken"


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
    if kind == readers.INSTRUMENT and not readers.can_read_instruments():
        yield (
            f"file = {file!r} is an instrument's and needs SurfaceTopography, which is not "
            f"installed; run {readers.INSTALL}"
        )
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
