"""Checks of the configuration: one line per error, naming the key, its value and the remedy."""

from __future__ import annotations

import difflib
from collections.abc import Iterator, Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any

import jsonschema
import yaml

from . import readers
from .units import si

# Keys whose values are strings with units, and the unit that fixes their dimension.
_UNITS = {
    "plane_strain_modulus": "Pa",
    "youngs_modulus": "Pa",
    "work_of_adhesion": "J/m^2",
    "range": "m",
    "longest_wavelength": "m",
    "shortest_wavelength": "m",
    "rolloff_wavelength": "m",
    "q0": "1/m",
    "q1": "1/m",
    "h_rms": "m",
    "length": "m",
    "pixel_size": "m",
    "fit_from": "m",
    "fit_to": "m",
    "resolution": "m",
    "tip_radius": "m",
    "extend_to": "m",
}


# What the figures and the claims ledger read; may be edited but not removed.
_PAPER = {
    "cases": ("H0.8_zeta32", "H0.8_zeta64", "H0.8_zeta128", "H0.8_zeta32_wide"),
    "theory.sweeps": ("fig1a", "fig1b", "fig3a", "fig3b", "fig3c", "fig3d"),
    "adhesion": ("fig2", "fig4b_rough", "fig4b_smooth", "dmt_error"),
    "loops": ("fig4a",),
}
_CRITERIA_GRIDS = {
    "map": ("range_times_q0", "adhesion_length_over_range"),
    "compared": ("h_rms_over_range", "magnification"),
}
_PAPER_SURFACES = ("asphalt", "polished_steel")
_BUILTIN = ("builtin:jacksboro",)


class ConfigError(ValueError):
    """A key of the configuration is unknown, missing or has a value that cannot be used."""


class _UniqueKeys(yaml.SafeLoader):
    """Loader that refuses a key given twice, of which YAML would keep the second."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Any, Any]:
        seen = set()
        for key, _ in node.value:
            if key.value in seen and key.value != "<<":
                problem = f"the key {key.value!r} is given twice"
                raise yaml.constructor.ConstructorError(
                    problem=problem, problem_mark=key.start_mark
                )
            seen.add(key.value)
        return super().construct_mapping(node, deep)


def load(path: str | Path) -> dict[str, Any]:
    """Read a YAML file of the configuration.

    Raises
    ------
    ConfigError
        If the file is missing or is not valid YAML.
    """
    try:
        content = yaml.load(Path(path).read_text(encoding="utf-8"), _UniqueKeys)
    except FileNotFoundError:
        raise ConfigError(f"{path}: no such file; set its path in config/config.yaml") from None
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        line = f" line {mark.line + 1}" if mark else ""
        raise ConfigError(
            f"{path}:{line}: not valid YAML: {getattr(error, 'problem', error)}"
        ) from None
    if not isinstance(content, dict):
        raise ConfigError(f"{path}: must hold keys and values, found {type(content).__name__}")
    return content


def checked(
    config: Mapping[str, Any], schemas: str | Path, name: str = "config/config.yaml"
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Check the whole configuration and the files it names.

    Parameters
    ----------
    config : mapping
        Content of config.yaml with everything that overrides it.
    schemas : path
        Folder of the schemas.
    name : str
        What to call the configuration in errors.

    Returns
    -------
    materials, surfaces : dict
        The tables of materials.yaml and surfaces.yaml.

    Raises
    ------
    ConfigError
        On the first thing wrong, in one line.
    """
    schemas = Path(schemas)
    check_schema(config, schemas / "config.schema.yaml", name)
    check_config(config, name)
    tables = []
    for table in ("materials", "surfaces"):
        content = load(config[table])
        check_schema(content, schemas / f"{table}.schema.yaml", config[table])
        check_units(content, config[table])
        tables.append(content[table])
    check_materials(tables[0], config["materials"])
    check_surfaces(tables[1], config["surfaces"])
    return tables[0], tables[1]


def check_schema(content: Mapping[str, Any], schema: str | Path, name: str) -> None:
    """Check `content`, read from the file `name`, against a JSON schema in YAML."""
    validator = jsonschema.Draft202012Validator(load(schema))
    errors = sorted(
        validator.iter_errors(content), key=lambda error: (-len(error.path), str(error.path))
    )
    if errors:
        raise ConfigError(f"{name}: {_one_line(errors[0])}")


def check_config(config: Mapping[str, Any], name: str = "config/config.yaml") -> None:
    """Check what the schema of config.yaml cannot say: references, orders, units, resolution."""
    for problem in _config_problems(config):
        raise ConfigError(f"{name}: {problem}")


def check_units(content: Mapping[str, Any], name: str) -> None:
    """Check that every value that needs a unit has one of the right dimension and is positive."""
    for key, value, unit in _with_units(content, ""):
        try:
            magnitude = si(value, unit)
        except ValueError as error:
            raise ConfigError(f"{name}: {key} = {error}") from None
        if not magnitude > 0:
            raise ConfigError(f"{name}: {key} = {value!r} must be positive")


def check_materials(materials: Mapping[str, Any], name: str = "config/materials.yaml") -> None:
    """Check moduli that depend on the rate: units, order, and that they cover 1 Hz."""
    for key, material in materials.items():
        for problem in _rate_problems(material):
            raise ConfigError(f"{name}: materials.{key}.{problem}")


def check_surfaces(surfaces: Mapping[str, Any], name: str = "config/surfaces.yaml") -> None:
    """Check bands, ranges and files of the real surfaces."""
    for key in _PAPER_SURFACES:
        if key not in surfaces:
            raise ConfigError(f"{name}: surfaces: {key!r} is missing; the paper's claims need it")
    for key, surface in surfaces.items():
        for problem in _surface_problems(surface):
            raise ConfigError(f"{name}: surfaces.{key}.{problem}")


def _config_problems(config: Mapping[str, Any]) -> Iterator[str]:
    fidelity = config["fidelity"]
    if fidelity not in config["fidelities"]:
        yield f"fidelity = {fidelity!r} is unknown; choose one of {', '.join(config['fidelities'])}"
    yield from _grid_problems("gaps", config["gaps"])
    tables = {"theory.sweeps": config["theory"]["sweeps"]}
    for table, names in _PAPER.items():
        for name in names:
            if name not in tables.get(table, config.get(table)):
                yield f"{table}: {name!r} is missing; the paper's figures and claims need it"
    yield from _comparison_problems(config)
    yield from _criteria_problems(config)
    table = config["theory"]["table"]
    for key in ("hurst", "magnification", "pressure"):
        if sorted(table[key]) != table[key]:
            yield f"theory.table.{key} = {table[key]!r} must be in increasing order"
    yield from _grid_problems("theory.table.range", table["range"])
    for key, case in config["cases"].items():
        if case["surface"] not in config["model_surfaces"]:
            yield _unknown(f"cases.{key}.surface", case["surface"], config["model_surfaces"])
        yield from _model_problems(f"cases.{key}", case, config["model_surfaces"])
        for load_ in case.get("maps", []):
            if load_ not in case["pressures"]:
                yield f"cases.{key}.maps: {load_!r} is not among the case's pressures"
    for key, surface in config["model_surfaces"].items():
        rolloff, magnification = surface.get("rolloff"), surface["magnification"]
        if rolloff is not None and rolloff >= magnification:
            yield (
                f"model_surfaces.{key}.rolloff = {rolloff!r} must be below "
                f"magnification = {magnification!r}"
            )
    for key, window in enumerate(config["a_v"]["windows"]):
        if not window[0] < window[1]:
            yield f"a_v.windows[{key}] = {window!r} must be [low, high] with low < high"
        gaps = config["gaps"]
        if window[0] < gaps["minimum"] or window[1] > gaps["maximum"]:
            yield f"a_v.windows[{key}] = {window!r} must lie within gaps.minimum … gaps.maximum"
    for key, adhesion in config["adhesion"].items():
        for problem in _adhesion_problems(adhesion, config):
            yield f"adhesion.{key}.{problem}"
    if "maps" not in config["adhesion"]["fig2"]:
        yield "adhesion.fig2.maps is missing; Figure 2 needs it: {pressures, ...}"
    if config["adhesion"]["dmt_error"]["model"] != "full":
        yield "adhesion.dmt_error.model must be full; the error of the DMT limit is measured there"
    for key, loop in config["loops"].items():
        if loop["surface"] not in config["model_surfaces"]:
            yield _unknown(f"loops.{key}.surface", loop["surface"], config["model_surfaces"])
        for unit_key in ("window", "h_rms"):
            yield from _unit_problem(f"loops.{key}.{unit_key}", loop.get(unit_key), "m")
    chosen = config["criteria"]["a_v"]
    if chosen["case"] not in config["cases"]:
        yield _unknown("criteria.a_v.case", chosen["case"], config["cases"])
    elif chosen["pressure"] not in config["cases"][chosen["case"]]["pressures"]:
        yield (
            f"criteria.a_v.pressure = {chosen['pressure']!r} is not among the pressures of "
            f"cases.{chosen['case']}"
        )
    yield from _preset_problems(config)
    yield from _whole_problems(config)


def _criteria_problems(config: Mapping[str, Any]) -> Iterator[str]:
    """What the maps of criteria ask of a_V and the table of it does not hold."""
    criteria, table = config["criteria"], config["theory"]["table"]
    for key in ("ranges", "frequencies"):
        yield from _grid_problems(f"criteria.{key}", criteria[key])
    for part, grids in _CRITERIA_GRIDS.items():
        for key in grids:
            yield from _grid_problems(f"criteria.{part}.{key}", criteria[part][key])
    compared = criteria["compared"]
    roughness = compared["h_rms_over_range"]
    asked = [
        ("a_v.pressure", "pressure", criteria["a_v"]["pressure"]),
        ("map.hurst", "hurst", criteria["map"]["hurst"]),
        ("compared.hurst", "hurst", compared["hurst"]),
        ("compared.quoted_magnification", "magnification", compared["quoted_magnification"]),
    ]
    for end in ("minimum", "maximum"):
        key = f"magnification.{end}"
        asked.append((f"compared.{key}", "magnification", compared["magnification"][end]))
    for key, axis, value in asked:
        if not min(table[axis]) <= value <= max(table[axis]):
            yield (
                f"criteria.{key} = {value!r} must lie within theory.table.{axis}, "
                f"{min(table[axis])!r} … {max(table[axis])!r}"
            )
    largest = 1 / table["range"]["minimum"]
    smallest = 1 / table["range"]["maximum"]
    for key, value in (
        ("h_rms_over_range.minimum", roughness["minimum"]),
        ("h_rms_over_range.maximum", roughness["maximum"]),
        ("quoted_h_rms_over_range", compared["quoted_h_rms_over_range"]),
    ):
        if not smallest <= value <= largest:
            yield (
                f"criteria.compared.{key} = {value!r} must lie within the inverse of "
                f"theory.table.range, {smallest:g} … {largest:g}"
            )


def _comparison_problems(config: Mapping[str, Any]) -> Iterator[str]:
    surfaces = config["comparisons"]["surfaces"]
    for name in surfaces.keys() & config["cases"].keys():
        yield f"comparisons.surfaces.{name} has the name of a case; give it another"
    for key, fidelity in config["fidelities"].items():
        for name in fidelity.get("comparisons", []):
            if name not in surfaces:
                yield _unknown(f"fidelities.{key}.comparisons", name, surfaces)


def _adhesion_problems(adhesion: Mapping[str, Any], config: Mapping[str, Any]) -> Iterator[str]:
    """What of an adhesive set does not fit its case, its model or the gaps."""
    if adhesion["case"] not in config["cases"]:
        yield _unknown("case", adhesion["case"], config["cases"])
        return
    for key in ("window", "h_rms"):
        yield from _unit_problem(key, adhesion.get(key), "m")
    for pressure in adhesion["pressures"]:
        if pressure not in config["cases"][adhesion["case"]]["pressures"]:
            yield f"pressures: {pressure!r} is not among those of cases.{adhesion['case']}"
    gaps, model = config["gaps"], adhesion["model"]
    for value in adhesion["range_over_h_rms"]:
        if not gaps["minimum"] <= value <= gaps["maximum"]:
            yield (
                f"range_over_h_rms: {value!r} must lie within gaps.minimum … gaps.maximum, "
                f"{gaps['minimum']:g} … {gaps['maximum']:g}"
            )
    if model == "auto" and "accuracy" not in adhesion:
        yield "accuracy is missing; model: auto chooses by it, relative in 1/kappa_ad"
    if model != "auto" and "accuracy" in adhesion:
        yield f"accuracy = {adhesion['accuracy']!r} needs model: auto, which chooses by it"
    for key in ("seeds", "refine", "maps"):
        if model == "dmt" and key in adhesion:
            yield f"{key} = {adhesion[key]!r} is of the full model; leave it out with model: dmt"


def _whole_problems(config: Mapping[str, Any]) -> Iterator[str]:
    """Cases that others rest on must be simulated for every quantity."""
    cases = dict.fromkeys(_PAPER["cases"], "the paper's figures and claims")
    cases |= {adhesion["case"]: f"adhesion.{key}" for key, adhesion in config["adhesion"].items()}
    cases[config["criteria"]["a_v"]["case"]] = "criteria.a_v"
    for name, user in cases.items():
        for key in ("quantities", "model"):
            case = config["cases"].get(name, {})
            if case.get(key, "simulation") != "simulation":
                yield (
                    f"cases.{name}.{key} = {case[key]!r}: leave it out, {user} needs every "
                    "quantity by simulation; or add a case"
                )


def _preset_problems(config: Mapping[str, Any]) -> Iterator[str]:
    """The rule of the presets must name what there is."""
    rule = config["tradeoff"]["presets"]
    if rule["surface"] not in config["model_surfaces"]:
        yield _unknown("tradeoff.presets.surface", rule["surface"], config["model_surfaces"])
    for name in rule["accuracy"]:
        for table in (config["fidelities"], rule["least"]):
            if name not in table:
                yield _unknown("tradeoff.presets.accuracy", name, table)


def _model_problems(
    key: str, case: Mapping[str, Any], surfaces: Mapping[str, Any]
) -> Iterator[str]:
    """What a case may ask for depends on whether it is simulated."""
    if case.get("model") == "theory":
        for unused in ("accuracy", "seeds", "sampling", "maps"):
            if unused in case:
                yield (
                    f"{key}.{unused} = {case[unused]!r} is for simulations; leave it out with "
                    "model: theory"
                )
    magnification = surfaces.get(case["surface"], {}).get("magnification", 0)
    if case.get("carry_to", magnification + 1) <= magnification:
        yield (
            f"{key}.carry_to = {case['carry_to']!r} must be above the magnification simulated, "
            f"{magnification!r}"
        )
    if "accuracy" in case and "seeds" in case:
        yield f"{key}.seeds = {case['seeds']!r}: give accuracy or seeds, not both"


def _rate_problems(material: Mapping[str, Any]) -> Iterator[str]:
    series = material.get("youngs_modulus_prony", {"terms": []})
    yield from _unit_problem("youngs_modulus_prony.equilibrium", series.get("equilibrium"), "Pa")
    for index, (modulus, time) in enumerate(series["terms"]):
        yield from _unit_problem(f"youngs_modulus_prony.terms[{index}][0]", modulus, "Pa")
        yield from _unit_problem(f"youngs_modulus_prony.terms[{index}][1]", time, "s")
    pairs = material.get("youngs_modulus_table", [])
    for index, (frequency, modulus) in enumerate(pairs):
        yield from _unit_problem(f"youngs_modulus_table[{index}][0]", frequency, "Hz")
        yield from _unit_problem(f"youngs_modulus_table[{index}][1]", modulus, "Pa")
    frequencies = [si(frequency, "Hz") for frequency, _ in pairs]
    if any(b <= a for a, b in pairwise(frequencies)):
        yield "youngs_modulus_table: frequencies must ascend"
    if pairs and not frequencies[0] <= 1 <= frequencies[-1]:
        yield (
            f"youngs_modulus_table runs from {pairs[0][0]} to {pairs[-1][0]} and must cover 1 Hz, "
            "at which the verdict is quoted"
        )


def _surface_problems(surface: Mapping[str, Any]) -> Iterator[str]:
    if surface["kind"] == "measured":
        for name, measurement in measurements(surface):
            for problem in _file_problems(measurement):
                yield f"{name}{problem}"
        index, count = surface.get("bem", {}).get("measurement", 0), len(measurements(surface))
        if index >= count:
            yield f"bem.measurement = {index} is counted from 0 and must be below {count}"
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
        yield from _unit_problem("C0", value, unit)
    for key, key_unit in (("C0", unit), ("h_rms", "m")):
        values = [si(value, key_unit) for value in _as_list(surface.get(key, []))]
        if values != sorted(values):
            yield f"{key} = {surface[key]!r} must be [low, high]"


def measurements(surface: Mapping[str, Any]) -> list[tuple[str, dict[str, Any]]]:
    """Return every measurement of a measured surface: a prefix for messages, and all of its keys.

    What stands beside the list `measurements` holds for each that does not say otherwise.
    """
    if "measurements" not in surface:
        return [("", dict(surface))]
    shared = {key: value for key, value in surface.items() if key != "measurements"}
    several = enumerate(surface["measurements"])
    return [(f"measurements[{index}].", shared | dict(one)) for index, one in several]


def _file_problems(measurement: Mapping[str, Any]) -> Iterator[str]:
    """What can be said of a measurement before its file is read."""
    file = measurement["file"]
    for key in ("height_unit", "position_unit"):
        if key in measurement:
            yield from _unit_problem(key, f"1 {measurement[key]}", "m")
    if file.startswith("builtin:"):
        if file not in _BUILTIN:
            yield f"file = {file!r} is unknown; built in: {', '.join(_BUILTIN)}"
        return
    if not Path(file).is_file():
        yield f"file = {file!r}: no such file; give a path from the working directory"
        return
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


def _wavelength(surface: Mapping[str, Any], wavelength: str, wave_number: str) -> float:
    if wavelength in surface:
        return si(surface[wavelength], "m")
    return 2 * 3.141592653589793 / si(surface[wave_number], "1/m")


def _as_list(value: Any) -> list[Any]:
    return value if isinstance(value, list) else [value]


def _unit_problem(key: str, value: str | None, unit: str) -> Iterator[str]:
    if value is None:
        return
    try:
        if not si(value, unit) > 0:
            yield f"{key} = {value!r} must be positive"
    except ValueError as error:
        yield f"{key} = {error}"


def _grid_problems(key: str, grid: Mapping[str, float]) -> Iterator[str]:
    if not grid["minimum"] < grid["maximum"]:
        yield f"{key}.minimum = {grid['minimum']!r} must be below maximum = {grid['maximum']!r}"


def _with_units(node: Any, key: str) -> Iterator[tuple[str, Any, str]]:
    if isinstance(node, Mapping):
        for name, value in node.items():
            below = f"{key}.{name}" if key else name
            if name in _UNITS and not isinstance(value, Mapping):
                values = enumerate(value) if isinstance(value, list) else [(None, value)]
                for index, item in values:
                    yield below if index is None else f"{below}[{index}]", item, _UNITS[name]
            else:
                yield from _with_units(value, below)


def _unknown(key: str, value: str, known: Mapping[str, Any]) -> str:
    return f"{key} = {value!r} is unknown; {_suggest(value, known)}"


def _suggest(value: str, known: Mapping[str, Any]) -> str:
    close = difflib.get_close_matches(str(value), [str(name) for name in known], n=1)
    return f"did you mean {close[0]!r}?" if close else f"choose one of {', '.join(map(str, known))}"


def _one_line(error: jsonschema.ValidationError) -> str:
    key = "".join(f"[{p}]" if isinstance(p, int) else f".{p}" for p in error.absolute_path).lstrip(
        "."
    )
    where = f"{key}: " if key else ""
    match error.validator:
        case "additionalProperties":
            known = error.schema.get("properties", {})
            extra = next(name for name in error.instance if name not in known)
            return f"{where}unknown key {extra!r}; {_suggest(extra, known)}"
        case "required":
            missing = next(name for name in error.validator_value if name not in error.instance)
            hint = error.schema.get("properties", {}).get(missing, {}).get("description")
            return f"{where}the key {missing!r} is missing" + (f" ({hint})" if hint else "")
        case "oneOf" | "anyOf":
            choices = [" and ".join(choice.get("required", [])) for choice in error.validator_value]
            return f"{where}give exactly one of: {'; '.join(filter(None, choices))}"
        case "enum":
            choices = dict.fromkeys(error.validator_value)
            return f"{key} = {error.instance!r} is unknown; {_suggest(error.instance, choices)}"
    reasons = {
        "minimum": "must be at least {}",
        "maximum": "must be at most {}",
        "exclusiveMinimum": "must be greater than {}",
        "exclusiveMaximum": "must be below {}",
        "multipleOf": "must be a multiple of {}",
        "type": "must be of type {}",
        "minItems": "needs at least {} item(s)",
        "maxItems": "takes at most {} item(s)",
        "minProperties": "needs at least {} entry",
        "minLength": "must not be empty",
        "pattern": "does not match {}",
        "uniqueItems": "must not repeat a value",
        "contains": "lacks a value",
    }
    reason = reasons.get(error.validator, error.message).format(error.validator_value)
    hint = error.schema.get("description") if isinstance(error.schema, Mapping) else None
    return f"{key} = {error.instance!r} {reason}" + (f" ({hint})" if hint else "")
