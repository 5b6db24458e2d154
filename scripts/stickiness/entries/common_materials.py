"""Common materials by name, as entries of the configuration with values as texts."""

from functools import cache
from pathlib import Path
from typing import Any

from stickiness.entries.errors import EntryError, suggest

FILE = Path(__file__).with_suffix(".yaml")


@cache
def read_common_materials() -> dict[str, dict[str, Any]]:
    """Return the entries of all common materials, by name."""
    import yaml

    return yaml.safe_load(FILE.read_text(encoding="utf-8"))["materials"]


def find_common_material(name: Any) -> dict[str, Any]:
    """Return the entry of a common material; raise an `EntryError` if the name is unknown."""
    entries = read_common_materials()
    if name not in entries:
        raise EntryError("common", name, f"unknown material; {suggest(name, entries)}")
    return entries[name]
