"""Write docs/config.md, the reference of every configuration key, from the schemas.

python docs/write_config.py
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "scripts"))

from common.config.checks import read_schema  # noqa: E402

TARGET = ROOT / "docs/config.md"
HEAD = """# Every key of the configuration

<!-- Written by docs/write_config.py from config/schemas; edit the schemas. -->

A value with a unit is a text, e.g. `"0.1 um"`. `*` stands for a name of your choice (letters,
digits, dot, dash, underscore), `[]` for an entry of a list. Bold keys are required. The schemas in
`config/schemas` say the same; a configuration that breaks them stops before any job runs.
"""
TITLES = {
    "config": "config/config.yaml",
    "materials": "Materials: config/materials.yaml",
    "surfaces": "Real surfaces: config/surfaces.yaml",
    "experiments": "Published experiments: config/experiments.yaml",
}

Schema = Mapping[str, Any]


def schema_of(name: str) -> dict[str, Any]:
    """The schema of one of the files."""
    return read_schema(ROOT / f"config/schemas/{name}.schema.yaml")


def resolve(schema: Schema, root: Schema) -> dict[str, Any]:
    """The schema with its reference filled in; its own keywords, such as the text, come first."""
    found = dict(schema)
    while "$ref" in found:
        *_, name = found.pop("$ref").split("/")
        found = {**root["$defs"][name], **found}
    return found


def keys(
    schema: Schema, root: Schema, path: str = ""
) -> Iterator[tuple[str, bool, dict[str, Any]]]:
    """Dotted name, whether it is required, and schema of every key, depth first."""
    schema = resolve(schema, root)
    for name, value in schema.get("properties", {}).items():
        inner = resolve(value, root)
        key = f"{path}.{name}" if path else name
        yield key, name in schema.get("required", []), inner
        yield from below(inner, root, key)
    for branch in ("then", "else"):
        if branch in schema:
            yield from keys(schema[branch], root, path)


def below(schema: Schema, root: Schema, path: str) -> Iterator[tuple[str, bool, dict[str, Any]]]:
    """Keys below a key that is an object, a mapping of names, or a list of objects."""
    if is_grid(schema, root):
        return
    yield from keys(schema, root, path)
    if isinstance(schema.get("additionalProperties"), Mapping):
        yield from keys(schema["additionalProperties"], root, f"{path}.*")
    if "items" in schema:
        yield from keys(schema["items"], root, f"{path}[]")


def is_grid(schema: Schema, root: Schema) -> bool:
    """Whether a key holds logarithmically spaced values, which take one line of the table."""
    return schema.get("properties") == root.get("$defs", {}).get("grid", {}).get("properties", 0)


def kind(schema: Schema, root: Schema) -> str:
    """What a value may be, in words."""
    schema = resolve(schema, root)
    if is_grid(schema, root):
        return "`{minimum, maximum, per_decade}`"
    if "const" in schema:
        return f"`{schema['const']}`"
    if "enum" in schema:
        return ", ".join(f"`{value}`" for value in schema["enum"])
    if "oneOf" in schema and all("type" in choice for choice in schema["oneOf"]):
        return " or ".join(kind(choice, root) for choice in schema["oneOf"])
    name = schema.get("type", "")
    if isinstance(name, list):
        return " or ".join(kind({"type": one}, root) for one in name)
    if name == "array":
        pair = schema.get("minItems") == schema.get("maxItems") == 2
        return f"{'pair' if pair else 'list'} of {kind(schema['items'], root)}"
    if name == "object":
        return "names" if isinstance(schema.get("additionalProperties"), Mapping) else "keys below"
    words = {"string": "text", "number": "number", "integer": "whole number", "boolean": "yes/no"}
    return " ".join([words.get(name, name), *limits(schema)]).strip()


def limits(schema: Schema) -> list[str]:
    """Range of a number as one text; empty if there is none."""
    signs = {"minimum": "≥", "exclusiveMinimum": ">", "maximum": "≤", "exclusiveMaximum": "<"}
    found = [f"{sign} {schema[word]:g}" for word, sign in signs.items() if word in schema]
    if "multipleOf" in schema:
        found.append(f"in steps of {schema['multipleOf']}")
    return [", ".join(found)] if found else []


def alternatives(schema: Schema, root: Schema, path: str = "") -> Iterator[tuple[str, list[str]]]:
    """Places where exactly one of several groups of keys is required."""
    schema = resolve(schema, root)
    for part in (schema, *schema.get("allOf", [])):
        groups = [choice.get("required") for choice in part.get("oneOf", [])]
        if groups and all(groups):
            yield path, [" and ".join(f"`{name}`" for name in group) for group in groups]
    for name, value in schema.get("properties", {}).items():
        yield from alternatives(value, root, f"{path}.{name}" if path else name)
    if isinstance(schema.get("additionalProperties"), Mapping):
        yield from alternatives(schema["additionalProperties"], root, f"{path}.*")
    for branch in ("then", "else"):
        if branch in schema:
            yield from alternatives(schema[branch], root, path)


def section(name: str) -> str:
    """The part on one of the files."""
    root = schema_of(name)
    lines = [f"## {TITLES[name]}", "", "| key | value | meaning |", "| --- | --- | --- |"]
    shown = set()
    for key, required, schema in keys(root, root):
        row = key, kind(schema, root), schema.get("description", "")
        if row in shown:
            continue
        shown.add(row)
        label = f"**`{key}`**" if required else f"`{key}`"
        lines.append(
            "| " + " | ".join(text.replace("|", "\\|") for text in (label, *row[1:])) + " |"
        )
    choices = [f"- `{path}`: {'; '.join(groups)}" for path, groups in alternatives(root, root)]
    if choices:
        lines += ["", "Exactly one of:", "", *dict.fromkeys(choices)]
    return "\n".join(lines)


def undescribed() -> list[str]:
    """Keys without a description, by their schema."""
    roots = {name: schema_of(name) for name in TITLES}
    return [
        f"{name}: {key}"
        for name, root in roots.items()
        for key, _, schema in keys(root, root)
        if not schema.get("description", "").strip()
    ]


def reference() -> str:
    """The whole page."""
    return "\n\n".join([HEAD.rstrip(), *map(section, TITLES)]) + "\n"


if __name__ == "__main__":
    if missing := undescribed():
        sys.exit("keys without a description in config/schemas: " + "; ".join(missing))
    TARGET.write_text(reference(), encoding="utf-8")
