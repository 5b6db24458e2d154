"""Reading the configuration, and checking it before any job starts.

An error is one line that names file, key and value and says what would be right.
"""

import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from snakemake.utils import update_config

from stickiness.entries.yaml_files import YamlError, read_yaml

TABLES = ("materials", "surfaces", "experiments")  #: files of their own, by the key that names them
# Files that are read as one.
USER = "config/config.yaml"
PAPER = "config/campaigns/paper.yaml"
#: Files of what this project measures once, which users do not configure.
CAMPAIGNS = {
    name: f"config/campaigns/{name}.yaml" for name in ("tradeoff", "remaining", "heights", "limits")
}


class ConfigError(ValueError):
    """A key of the configuration is unknown, missing or has a value that cannot be used."""


def load(path: str | Path) -> dict[str, Any]:
    """Read a YAML file of the configuration; a ConfigError says if it is missing or not valid."""
    try:
        return read_yaml(path)
    except FileNotFoundError:
        raise ConfigError(f"{path}: no such file; set its path in {USER}") from None
    except YamlError as error:
        raise ConfigError(f"{path}: {error}") from None


def defaults(project: str | Path, locate: Callable[[str], str] = str) -> dict[str, Any]:
    """Read the configuration of the project and of the paper's figures, which users override.

    `locate` turns the paths of the tables in the project into paths from the folder of the run.
    """
    config = load(Path(project, PAPER))
    update_config(config, load(Path(project, USER)))
    return config | {table: str(locate(config[table])) for table in TABLES if table in config}


def check_all(
    config: Mapping[str, Any],
    campaigns: Mapping[str, Any],
    given: Mapping[str, Any],
    name: str = USER,
    made: bool = False,
) -> dict[str, dict[str, Any]]:
    """Check the configuration, with the defaults, and all files that it names.

    Parameters
    ----------
    config, campaigns : mapping
        The whole configuration, and that of the campaigns by name.
    given : mapping
        What the user gives: errors in it name the file `name`, others that of the paper's figures.
    name : str
        What errors call the user's configuration.
    made : bool
        Whether measured files may be missing, since another workflow makes them.

    Returns
    -------
    dict
        The checked content by file: "config", the tables and the campaigns. Every key is present,
        with numbers in SI units, defaults filled in, and None for what is absent.

    Raises
    ------
    ConfigError
        If a key is wrong.
    """
    from common.config.models import MODELS

    try:
        checked = {"config": check(MODELS["config"], config, "")}
    except ConfigError as error:
        problem = error.__cause__
        top = re.match(r"\w*", problem.key)[0]
        file = PAPER if top in config.keys() - given else name
        raise ConfigError(f"{file}: {problem}") from problem
    tables = {table: load(config[table]) for table in TABLES}
    if "surfaces" not in given:  # those of the project
        _locate_files(tables["surfaces"]["surfaces"], Path(config["surfaces"]).parents[1])
    surfaces = tables["surfaces"].get("surfaces", {})
    for table, content in tables.items():
        checked[table] = check(MODELS[table], content, config[table], surfaces=surfaces, made=made)
    for campaign, content in campaigns.items():
        checked[campaign] = check(MODELS[campaign], content, CAMPAIGNS[campaign], config=config)
    return checked


def _locate_files(surfaces: dict[str, Any], project: Path) -> None:
    """Turn the paths of measured files in the project into paths from the folder of the run."""
    for entry in surfaces.values():
        for reading in (entry, *entry.get("measurements", [])):
            if "file" in reading:
                reading["file"] = str(project / reading["file"])


def check(model: Any, content: Mapping[str, Any], file: str, **context: Any) -> dict[str, Any]:
    """Return the content of a file, checked; a ConfigError says what is wrong first."""
    from pydantic import ValidationError

    from stickiness.entries.errors import first_error

    try:
        return model.model_validate(content, context=context).model_dump()
    except ValidationError as error:
        problem = first_error(error, content)
        raise ConfigError(f"{file}: {problem}") from problem
