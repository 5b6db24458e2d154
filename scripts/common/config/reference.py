"""Write docs/configuration.md, the reference of every key, and config/schema.json for editors.

PYTHONPATH=scripts python -m common.config.reference
"""

import json
from pathlib import Path
from typing import Any

from common.config.load import TABLES
from common.config.models import MODELS
from stickiness.pages.rendering import make_environment

PROJECT = Path(__file__).parents[3]
PAGE = PROJECT / "docs/configuration.md"
SCHEMA = PROJECT / "config/schema.json"


def page() -> str:
    """Return the page; a section that several files have stands with the first."""
    described = set()
    files = {}
    for name in ("config", *TABLES):
        schema = MODELS[name].model_json_schema()
        models = schema.get("$defs", {})
        sections = {section["title"]: section for section in (schema, *models.values())}
        files[name] = models, [sections[title] for title in sections if title not in described]
        described |= sections.keys()
    environment = make_environment(PROJECT / "report")
    return environment.get_template("configuration.md.j2").render(files=files)


def schema() -> dict[str, Any]:
    """Return the JSON schema of all files of users, by which editors check and complete them.

    A file of materials, surfaces or experiments is told by its key, which has entries below it. Any
    other is a configuration, in which a user gives the keys that differ from the project's.
    """
    models = {
        name: MODELS[name].model_json_schema(ref_template=f"#/$defs/{name}/$defs/{{model}}")
        for name in ("config", *TABLES)
    }
    models["config"] = _without_required(models["config"])
    holds = {
        name: {"required": [name], "properties": {name: {"type": "object"}}} for name in TABLES
    }
    branches = [{"if": holds[name], "then": {"$ref": f"#/$defs/{name}"}} for name in TABLES]
    others = {"if": {"anyOf": list(holds.values())}, "else": {"$ref": "#/$defs/config"}}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "type": "object",
        "allOf": [*branches, others],
        "$defs": models,
    }


def _without_required(part: Any) -> Any:
    """Return a schema in which no key is required, nor one of several."""
    if isinstance(part, list):
        return [_without_required(item) for item in part]
    if not isinstance(part, dict):
        return part
    is_section = part.get("type") == "object" and "properties" in part
    left_out = ("required", "allOf") if is_section else ()
    return {key: _without_required(value) for key, value in part.items() if key not in left_out}


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
    SCHEMA.write_text(json.dumps(schema(), indent=1) + "\n", encoding="utf-8")
