"""Measurements of a measured surface, one or several."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any


def measurements(surface: Mapping[str, Any]) -> list[tuple[str, dict[str, Any]]]:
    """Return every measurement of a measured surface: a prefix for messages, and all of its keys.

    Keys beside the list `measurements` hold for every entry that does not give its own.
    """
    if "measurements" not in surface:
        return [("", dict(surface))]
    shared = {key: value for key, value in surface.items() if key != "measurements"}
    several = enumerate(surface["measurements"])
    return [(f"measurements[{index}].", shared | dict(one)) for index, one in several]
