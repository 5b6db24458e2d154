"""Old names of keys in Python, which work for one more version, with a warning."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Mapping
from typing import Any

from stickiness.solids.moduli import Prony, Table

#: Old names of a material, and the new ones for most of their values.
OLD_NAMES = {"modulus": "youngs_modulus", "poisson": "poisson_ratio"}
_BY_KIND = {Prony: "youngs_modulus_prony", Table: "youngs_modulus_table"}


def take_old_names(keys: Mapping[str, Any]) -> dict[str, Any]:
    """Return keys of a material by their new names; warn of old ones.

    An old name stands for one of several by its value: a `modulus` is a number, a series or a
    table, and E* itself if `poisson` is None.
    """
    renamed = {key: value for key, value in keys.items() if key not in OLD_NAMES}
    for old, new in OLD_NAMES.items():
        if old in keys and new in keys:
            raise ValueError(f"{old} is an old name of {new}: give one of them")
    is_plane_strain = "poisson" in keys and keys["poisson"] is None
    if "modulus" in keys:
        name = _BY_KIND.get(type(keys["modulus"]), OLD_NAMES["modulus"])
        if is_plane_strain and name == OLD_NAMES["modulus"]:
            name = "plane_strain_modulus"
        renamed[name] = keys["modulus"]
        warn_of_old_name("modulus", name)
    if "poisson" in keys:
        if not is_plane_strain:
            renamed[OLD_NAMES["poisson"]] = keys["poisson"]
        elif "plane_strain_modulus" not in renamed:  # a series or a table of E*
            renamed[OLD_NAMES["poisson"]] = 0.0
        warn_of_old_name("poisson", OLD_NAMES["poisson"])
    return renamed


def warn_of_old_name(old: str, new: str) -> None:
    """Warn whoever uses an old name, at the line outside this package that does."""
    level = 1
    frame = sys._getframe()
    while frame.f_back and frame.f_globals["__name__"].startswith("stickiness."):
        frame = frame.f_back
        level += 1
    warnings.warn(f"{old} is an old name: write {new}", DeprecationWarning, stacklevel=level)
