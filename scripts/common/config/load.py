"""Reading the configuration, and checking it before any job starts.

An error is one line that names file, key and value and says what would be right. The models are
imported where they are used, since jobs read a configuration that was checked before.
"""

import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import yaml
from snakemake.utils import update_config

TABLES = ("materials", "surfaces", "experiments")  #: files of their own, by the key that names them
USER, PAPER = "config/config.yaml", "config/campaigns/paper.yaml"  #: files that are read as one
#: Files of what this project measures once, which users do not configure.
CAMPAIGNS = {name: f"config/campaigns/{name}.yaml" for name in ("tradeoff", "remaining")}

# What errors of pydantic say here, by its names of them.
_REASONS = {
    "greater_than": "must be greater than {gt:g}",
    "greater_than_equal": "must be at least {ge:g}",
    "less_than": "must be below {lt:g}",
    "less_than_equal": "must be at most {le:g}",
    "multiple_of": "must be a multiple of {multiple_of:g}",
    "too_short": "needs at least {min_length} entries",
    "too_long": "takes at most {max_length} entries",
    "missing": "needs two entries",
    "string_too_short": "must not be empty",
    "string_pattern_mismatch": "is no name: use letters, digits, dot, dash and underscore",
    "int_type": "must be a whole number",
    "float_type": "must be a number",
    "string_type": "must be a text",
    "bool_type": "must be true or false",
    "list_type": "must be a list",
    "tuple_type": "must be a list of two",
    "dict_type": "must hold names and their entries",
    "model_type": "must hold keys and values",
}


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
        text = Path(path).read_text(encoding="utf-8")
        content = yaml.load(text, _UniqueKeys)
    except FileNotFoundError:
        raise ConfigError(f"{path}: no such file; set its path in {USER}") from None
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", "it is no text in UTF-8")
        raise ConfigError(f"{path}: cannot be read as YAML: {reason}") from None
    except yaml.YAMLError as error:
        mark, problem = getattr(error, "problem_mark", None), getattr(error, "problem", error)
        line = f" line {mark.line + 1}" if mark else ""
        if mark and "\t" in "".join(text.splitlines()[mark.line : mark.line + 1]):
            problem = "it holds a tab: indent with blanks"
        raise ConfigError(f"{path}:{line}: not valid YAML: {problem}") from None
    if not isinstance(content, dict):
        found = "nothing" if content is None else type(content).__name__
        raise ConfigError(f"{path}: must hold keys and values, found {found}")
    return content


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
) -> None:
    """Check the configuration, with the defaults, and all files it names, without changing any.

    `given` is what the user gives: errors in it name the file `name`, others that of the paper's
    figures. With `made`, measured files may be missing, since another workflow makes them.
    """
    from common.config.models import MODELS

    try:
        check(MODELS["config"], config, "")
    except ConfigError as error:
        text = str(error).removeprefix(": ")
        top = re.match(r"\w*", text)[0]
        raise ConfigError(f"{PAPER if top in config.keys() - given else name}: {text}") from None
    tables = {table: load(config[table]) for table in TABLES}
    surfaces = tables["surfaces"].get("surfaces", {})
    for table, content in tables.items():
        check(MODELS[table], content, config[table], surfaces=surfaces, made=made)
    for campaign, content in campaigns.items():
        check(MODELS[campaign], content, CAMPAIGNS[campaign], config=config)


def check(model: type, content: Mapping[str, Any], file: str, **context: Any) -> None:
    """Check the content of a file against its model; a ConfigError says what is wrong first."""
    from pydantic import ValidationError

    try:
        model.model_validate(content, context=context)
    except ValidationError as error:
        raise ConfigError(f"{file}: {one_line(error.errors()[0])}") from None


def one_line(error: Mapping[str, Any]) -> str:
    """Say in one line what pydantic finds wrong: key, value and what would be right."""
    from common.config.fields import unknown

    # Names of choices between types, and the mark of a name that is wrong, are no keys.
    steps = [step for step in error["loc"] if not re.match(r"<|\[key\]", str(step))]
    path = "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in steps)[1:]
    value, details = error["input"], error.get("ctx", {})
    if error["type"] == "value_error":
        text = str(details["error"])
        return f"{path}{text}".lstrip(":. ") if text[0] in ":." else f"{path} = {text}"
    if error["type"] == "literal_error":
        choices = (word for word in re.findall(r"[\w.]+", details["expected"]) if word != "or")
        return unknown(path, value, choices)
    reason = _REASONS.get(error["type"], error["msg"]).format(**details)
    if error["type"] == "float_type" and re.fullmatch(r"[-+.\deE]*\d", str(value)):
        reason += ", not a text: leave off quotes, and write 1.0e-2 for 1e-2"
    return f"{path} = {value!r} {reason.replace('1 entries', '1 entry')}"
