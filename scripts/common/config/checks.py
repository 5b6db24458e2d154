"""Checks of the configuration: one line per error, naming the key, its value and the remedy."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import chain
from pathlib import Path
from typing import Any

import jsonschema
import yaml

from common.config.cross_checks import config_problems
from common.config.experiment_entries import experiment_problems
from common.config.material_entries import layer_problems, rate_problems, size_problems
from common.config.measurements import measurements  # noqa: F401 (public here, too)
from common.config.messages import one_line
from common.config.surface_entries import surface_problems
from stickiness.accuracy.quantities import QUANTITIES
from stickiness.units import si

# Keys whose values are strings with units, and the unit that fixes their dimension.
_LENGTHS = (
    "thickness",
    *("range", "longest_wavelength", "shortest_wavelength", "rolloff_wavelength", "h_rms"),
    *("length", "pixel_size", "fit_from", "fit_to", "resolution", "tip_radius", "extend_to"),
)
_UNITS = {
    **dict.fromkeys(_LENGTHS, "m"),
    **dict.fromkeys(("q0", "q1"), "1/m"),
    **dict.fromkeys(("plane_strain_modulus", "youngs_modulus"), "Pa"),
    "work_of_adhesion": "J/m^2",
}

TABLES = ("materials", "surfaces", "experiments")  #: files of their own, by the key that names them


class ConfigError(ValueError):
    """A key of the configuration is unknown, missing or has a value that cannot be used."""


class _UniqueKeys(getattr(yaml, "CSafeLoader", yaml.SafeLoader)):  # libyaml where it is built in
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
    """Read a YAML file of the configuration; a ConfigError says if it is missing or not valid."""
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


def check_all(
    config: Mapping[str, Any],
    schemas: str | Path,
    name: str = "config/config.yaml",
    made: bool = False,
) -> tuple[dict[str, Any], dict[str, Any], dict[str, Any]]:
    """Check the whole configuration and the files it names, without changing any of it.

    `config` is the content of config.yaml with everything that overrides it, `schemas` the folder
    of the schemas, `name` that of the configuration in errors. With `made`, measured files may be
    missing, since another workflow makes them. Returns the tables of materials,
    surfaces and experiments. A ConfigError says in one line what is wrong first.
    """
    schemas = Path(schemas)
    check_schema(config, schemas / "config.schema.yaml", name)
    check_config(config, name)
    tables = []
    for table in TABLES:
        content = load(config[table])
        check_schema(content, schemas / f"{table}.schema.yaml", config[table])
        if table != "experiments":  # whose values say how they are known
            check_units(content, config[table])
        tables.append(content[table])
    materials, surfaces, experiments = tables
    check_materials(materials, config["materials"], surfaces)
    check_surfaces(surfaces, config["surfaces"], made)
    check_experiments(experiments, config["experiments"])
    return materials, surfaces, experiments


def check_schema(content: Mapping[str, Any], schema: str | Path, name: str) -> None:
    """Check `content`, read from the file `name`, against a JSON schema in YAML."""
    validator = jsonschema.Draft202012Validator(read_schema(schema))
    errors = sorted(
        validator.iter_errors(content), key=lambda error: (-len(error.path), str(error.path))
    )
    if errors:
        raise ConfigError(f"{name}: {one_line(errors[0])}")


def read_schema(path: str | Path) -> dict[str, Any]:
    """Read a schema, with the quantities that a case may ask for filled in from their table."""
    schema = load(path)
    if "quantities" in schema.get("$defs", {}):
        schema["$defs"]["quantities"]["items"] = {"enum": list(QUANTITIES)}
    return schema


def check_config(config: Mapping[str, Any], name: str = "config/config.yaml") -> None:
    """Check what the schema of config.yaml cannot say: references, orders, units, resolution."""
    for problem in config_problems(config):
        raise ConfigError(f"{name}: {problem}")


def check_units(content: Mapping[str, Any], name: str) -> None:
    """Check that every value that needs a unit has one of the right dimension and is positive."""
    for key, value, unit in _find_units(content, ""):
        try:
            magnitude = si(value, unit)
        except ValueError as error:
            raise ConfigError(f"{name}: {key} = {error}") from None
        if not magnitude > 0:
            raise ConfigError(f"{name}: {key} = {value!r} must be positive")


def check_materials(
    materials: Mapping[str, Any],
    name: str = "config/materials.yaml",
    surfaces: Mapping[str, Any] | None = None,
) -> None:
    """Check moduli that depend on the rate, layers, and the names of surfaces."""
    for key, material in materials.items():
        for problem in chain(
            size_problems(material),
            rate_problems(material),
            layer_problems(material, surfaces or {}),
        ):
            raise ConfigError(f"{name}: materials.{key}.{problem}")


def check_surfaces(
    surfaces: Mapping[str, Any], name: str = "config/surfaces.yaml", made: bool = False
) -> None:
    """Check bands, ranges and files of the real surfaces."""
    for key, surface in surfaces.items():
        for problem in surface_problems(surface, made):
            raise ConfigError(f"{name}: surfaces.{key}.{problem}")


def check_experiments(
    experiments: Mapping[str, Any], name: str = "config/experiments.yaml"
) -> None:
    """Check units, orders and completeness of published experiments."""
    for key, experiment in experiments.items():
        for problem in experiment_problems(experiment):
            raise ConfigError(f"{name}: experiments.{key}.{problem}")


def _find_units(node: Any, key: str) -> Iterator[tuple[str, Any, str]]:
    if isinstance(node, Mapping):
        for name, value in node.items():
            below = f"{key}.{name}" if key else name
            if name in _UNITS and not isinstance(value, Mapping):
                values = enumerate(value) if isinstance(value, list) else [(None, value)]
                for index, item in values:
                    yield below if index is None else f"{below}[{index}]", item, _UNITS[name]
            else:
                yield from _find_units(value, below)
