"""Sentences on what is wrong with a value of the configuration, and what would be right."""

from __future__ import annotations

import difflib
import json
from collections.abc import Iterator, Mapping
from typing import Any

import jsonschema

from stickiness.units import si

_REASONS = {
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


def unit_problem(key: str, value: str | None, unit: str) -> Iterator[str]:
    """Yield what is wrong with a value that needs a unit and must be positive, if anything is."""
    if value is None:
        return
    try:
        if not si(value, unit) > 0:
            yield f"{key} = {value!r} must be positive"
    except ValueError as error:
        yield f"{key} = {error}"


def grid_problems(key: str, grid: Mapping[str, float]) -> Iterator[str]:
    """Yield what is wrong with the ends of a grid, if anything is."""
    if not grid["minimum"] < grid["maximum"]:
        yield f"{key}.minimum = {grid['minimum']!r} must be below maximum = {grid['maximum']!r}"


def unknown(key: str, value: str, known: Mapping[str, Any]) -> str:
    """Say that a name is unknown, and which is meant."""
    return f"{key} = {value!r} is unknown; {suggest(value, known)}"


def suggest(value: str, known: Mapping[str, Any]) -> str:
    """Ask whether the closest of the known names is meant; without one, list them all."""
    close = difflib.get_close_matches(str(value), [str(name) for name in known], n=1)
    return f"did you mean {close[0]!r}?" if close else f"choose one of {', '.join(map(str, known))}"


def one_line(error: jsonschema.ValidationError) -> str:
    """Say in one line what a schema finds wrong: key, value and what would be right."""
    key = "".join(f"[{p}]" if isinstance(p, int) else f".{p}" for p in error.absolute_path).lstrip(
        "."
    )
    where = f"{key}: " if key else ""
    match error.validator:
        case "additionalProperties":
            known = error.schema.get("properties", {})
            extra = next(name for name in error.instance if name not in known)
            # Keywords of our own beside `properties`, for keys of earlier versions.
            if extra in (removed := error.schema.get("removed", {})):
                return f"{where}remove the key {extra!r}: {removed[extra]}"
            if extra in (renamed := error.schema.get("renamed", {})):
                return f"{where}the key {extra!r} is now called {renamed[extra]!r}"
            return f"{where}unknown key {extra!r}; {suggest(extra, known)}"
        case "required":
            missing = next(name for name in error.validator_value if name not in error.instance)
            hint = error.schema.get("properties", {}).get(missing, {}).get("description")
            return f"{where}the key {missing!r} is missing" + (f" ({hint})" if hint else "")
        case "oneOf" | "anyOf":
            choices = [" and ".join(choice.get("required", [])) for choice in error.validator_value]
            if any(choices):
                return f"{where}give exactly one of: {'; '.join(filter(None, choices))}"
            # Choices of a value, not of keys: what is wrong with the one of its type, if any is.
            inside = (e for e in error.context if e.relative_path or e.validator != "type")
            if (nearest := next(inside, None)) is not None:
                return one_line(nearest)
            kinds = " or ".join(choice["type"] for choice in error.validator_value)
            return f"{key} = {error.instance!r} must be of type {kinds}, with its unit"
        case "enum":
            choices = dict.fromkeys(error.validator_value)
            return f"{key} = {error.instance!r} is unknown; {suggest(error.instance, choices)}"
    wanted = error.validator_value
    if wanted == "object" and {"value", "known"} <= error.schema.get("properties", {}).keys():
        plain = json.dumps(error.instance, ensure_ascii=False)
        return (
            f"{key} = {error.instance!r} must say how it is known: write "
            f"{{value: {plain}, known: measured}}, or read, recalled, assumed in place of measured"
        )
    if error.validator == "type" and not isinstance(wanted, str):
        wanted = " or ".join(wanted)
    reason = _REASONS.get(error.validator, error.message).format(wanted)
    hint = error.schema.get("description") if isinstance(error.schema, Mapping) else None
    return f"{key} = {error.instance!r} {reason}" + (f" ({hint})" if hint else "")
