"""Write docs/configuration.md, the reference of every key, from the models.

PYTHONPATH=scripts python -m common.config.reference
PYTHONPATH=scripts python -m common.config.reference --json-schema materials

The second prints a JSON schema of config, materials, surfaces, experiments, tradeoff or remaining,
by which editors check and complete a file.
"""

from __future__ import annotations

import inspect
import json
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, get_args

from common.config.campaigns import Remaining, Tradeoff
from common.config.experiments import Experiments
from common.config.fields import Section
from common.config.materials import Materials
from common.config.models import Configuration
from common.config.surfaces import Surfaces

PAGE = Path(__file__).parents[3] / "docs/configuration.md"
MARK = "<!-- Below, the tables are written by common.config.reference from its models. -->"
FILES = {
    "config": (Configuration, "config/config.yaml and config/campaigns/paper.yaml"),
    "materials": (Materials, "config/materials.yaml"),
    "surfaces": (Surfaces, "config/surfaces.yaml"),
    "experiments": (Experiments, "config/experiments.yaml"),
    "tradeoff": (Tradeoff, "config/campaigns/tradeoff.yaml"),
    "remaining": (Remaining, "config/campaigns/remaining.yaml"),
}
_SIGNS = {"minimum": "≥", "exclusiveMinimum": ">", "maximum": "≤", "exclusiveMaximum": "<"}
_WORDS = {"integer": "whole number", "boolean": "true or false", "string": "text"}


def models_of(annotation: Any) -> Iterator[type[Section]]:
    """Yield the models in the type of a key."""
    if isinstance(annotation, type) and issubclass(annotation, Section):
        yield annotation
    for part in get_args(annotation):
        yield from models_of(part)


def collect(model: type[Section], found: dict[str, type[Section]]) -> None:
    """Add a model, those that it extends and those of its keys to the models `found` by title."""
    if title(model.__name__) not in found:
        if own_keys(model):
            found[title(model.__name__)] = model
        for base in shared(model):
            collect(base, found)
        for field in model.model_fields.values():
            for inner in models_of(field.annotation):
                collect(inner, found)


def shared(model: type[Section]) -> list[type[Section]]:
    """Return the models whose keys a model has beside its own."""
    return [base for base in model.__bases__ if base is not Section]


def own_keys(model: type[Section]) -> list[str]:
    """Return the keys of a model that it does not take from one that it extends."""
    taken = {key for base in shared(model) for key in base.model_fields}
    return [key for key in model.model_fields if key not in taken]


def title(name: str) -> str:
    """Return the heading of a model by its name: ``AdhesionSet`` becomes ``Adhesion set``."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name).capitalize()


def link(name: str) -> str:
    heading = title(name).lower()
    return f"[{heading}](#{heading.replace(' ', '-')})"


def value(schema: dict[str, Any], models: dict[str, Any]) -> str:
    """Say in words what a value may be, by its JSON schema."""
    if "$ref" in schema:
        return link(models[schema["$ref"].rsplit("/", 1)[-1]]["title"])
    if "quantity" in schema:
        return f"*{schema['quantity']}*"
    if choices := schema.get("enum", [schema["const"]] if "const" in schema else []):
        return ", ".join(f"`{choice}`" for choice in choices)
    if kinds := schema.get("anyOf") or schema.get("oneOf"):
        return " or ".join(value(kind, models) for kind in reversed(kinds))
    if "patternProperties" in schema:
        (entry,) = schema["patternProperties"].values()
        return f"names, each {value(entry, models)}"
    if schema.get("type") == "array":
        if "prefixItems" in schema:
            return " and ".join(value(item, models) for item in schema["prefixItems"])
        pair = schema.get("minItems") == schema.get("maxItems") == 2
        return f"{'pair' if pair else 'list'} of {value(schema['items'], models)}"
    limits = [f"{sign} {schema[word]:g}" for word, sign in _SIGNS.items() if word in schema]
    limits += [f"in steps of {schema['multipleOf']}"] if "multipleOf" in schema else []
    kind = schema.get("type", "any")
    return f"{_WORDS.get(kind, kind)} {', '.join(limits)}".strip()


def table(model: type[Section]) -> str:
    schema = model.model_json_schema()
    models = schema.get("$defs", {})
    lines = [f"### {title(model.__name__)}", "", inspect.cleandoc(model.__doc__), ""]
    if bases := shared(model):
        lines += [f"Further keys: {', '.join(link(base.__name__) for base in bases)}.", ""]
    lines += ["| key | value | meaning |", "| --- | --- | --- |"]
    for key in own_keys(model):
        label = f"**`{key}`**" if key in schema.get("required", []) else f"`{key}`"
        entry = schema["properties"][key]
        lines.append(f"| {label} | {value(entry, models)} | {entry['description']} |")
    groups = vars(model).get("one_of", ())
    choices = [
        "; ".join(f"`{one.replace(' and ', '` and `')}`" for one in group) for group in groups
    ]
    lines += ["", f"Exactly one of: {', and one of: '.join(choices)}."] if choices else []
    return "\n".join(lines)


def page() -> str:
    """Write the whole page: its head as it is, and the tables of all files.

    Models that several files share stand with the first.
    """
    head, _, _ = PAGE.read_text(encoding="utf-8").partition(MARK)
    parts, found = [head + MARK], {}
    for model, file in FILES.values():
        shown = len(found)
        collect(model, found)
        parts += [f"## {file}", *map(table, list(found.values())[shown:])]
    return "\n\n".join(parts) + "\n"


if __name__ == "__main__":
    match sys.argv[1:]:
        case []:
            PAGE.write_text(page(), encoding="utf-8")
        case ["--json-schema", name] if name in FILES:
            print(json.dumps(FILES[name][0].model_json_schema(), indent=1))
        case _:
            sys.exit(__doc__)
