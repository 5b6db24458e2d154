"""The files that the configuration names."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

# The key of each, in the tables that it stands in.
_KEYS = (
    *(("materials",), ("surfaces",), ("experiments",), ("dmt_error",)),
    *(("remaining", "table"), ("tradeoff", "table"), ("tradeoff", "summary")),
)


def locate_files(config: Mapping[str, Any], locate: Callable[[str], str]) -> dict[str, Any]:
    """Copy of a configuration with `locate(path)` in place of the path of each file it names.

    Files that `surfaces.yaml` names are not touched: they are always a user's.
    """
    changed = dict(config)
    for *tables, key in _KEYS:
        inner = changed
        for table in tables:
            inner[table] = inner = dict(inner[table])
        inner[key] = str(locate(inner[key]))
    return changed
