"""Write docs/configuration.md, the reference of every key, from the JSON schemas of the models.

PYTHONPATH=scripts python -m common.config.reference
PYTHONPATH=scripts python -m common.config.reference --json-schema materials

The second prints a JSON schema of config, materials, surfaces or experiments, by which editors
check and complete a file.
"""

from __future__ import annotations

import json
import re
import sys
from pathlib import Path
from typing import Any

from common.config.load import TABLES
from common.config.models import MODELS
from common.templates import make_environment

PROJECT = Path(__file__).parents[3]
PAGE = PROJECT / "docs/configuration.md"
_SIGNS = {"minimum": "≥", "exclusiveMinimum": ">", "maximum": "≤", "exclusiveMaximum": "<"}
_WORDS = {"integer": "whole number", "boolean": "true or false", "string": "text"}


def heading(title: str) -> str:
    """Return the heading of a model by its name: ``AdhesionSet`` becomes ``Adhesion set``."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])", " ", title).capitalize()


def words(schema: dict[str, Any], models: dict[str, Any]) -> str:
    """Say in words what a value may be, by its JSON schema."""
    if "$ref" in schema:
        name = heading(models[schema["$ref"].rsplit("/", 1)[-1]]["title"]).lower()
        return f"[{name}](#{name.replace(' ', '-')})"
    if "quantity" in schema:
        return f"*{schema['quantity']}*"
    if choices := schema.get("enum", [schema["const"]] if "const" in schema else []):
        return ", ".join(f"`{choice}`" for choice in choices)
    if kinds := schema.get("anyOf") or schema.get("oneOf"):
        return " or ".join(words(kind, models) for kind in reversed(kinds))
    if "patternProperties" in schema:
        (entry,) = schema["patternProperties"].values()
        return f"names, each {words(entry, models)}"
    if schema.get("type") == "array":
        if "prefixItems" in schema:
            return " and ".join(words(item, models) for item in schema["prefixItems"])
        pair = schema.get("minItems") == schema.get("maxItems") == 2
        return f"{'pair' if pair else 'list'} of {words(schema['items'], models)}"
    limits = [f"{sign} {schema[word]:g}" for word, sign in _SIGNS.items() if word in schema]
    limits += [f"in steps of {schema['multipleOf']}"] if "multipleOf" in schema else []
    kind = schema.get("type", "any")
    return f"{_WORDS.get(kind, kind)} {', '.join(limits)}".strip()


def page() -> str:
    """Return the page; a section that several files have stands with the first."""
    found, files = {}, {}
    for name in ("config", *TABLES):
        schema = MODELS[name].model_json_schema()
        models = schema.get("$defs", {})
        sections = {section["title"]: section for section in (schema, *models.values())}
        files[name] = [
            sections[title] | {"models": models} for title in sections if title not in found
        ]
        found |= sections
    environment = make_environment(PROJECT / "report")
    environment.filters |= {"heading": heading, "words": words}
    return environment.get_template("configuration.md.j2").render(files=files)


if __name__ == "__main__":
    match sys.argv[1:]:
        case []:
            PAGE.write_text(page(), encoding="utf-8")
        case ["--json-schema", name] if name in MODELS:
            print(json.dumps(MODELS[name].model_json_schema(), indent=1))
        case _:
            sys.exit(__doc__)
