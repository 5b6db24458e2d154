"""Variants and corrections of Persson's theory that stages compute beside each other."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from _model import VARIANT
from stickiness.persson_kernels import CORRECTIONS

DESCRIBED = ("1", "variant of the theory, and its correction if not that of Yang & Persson")


def theories(variants: Iterable[str], gamma: float) -> dict[str, dict[str, Any]]:
    """Arguments of `Persson` by names.

    The variants asked for with the correction of Yang & Persson and `gamma`, then the quoted
    variant with the other corrections, each with its source's own gamma.
    """
    found = {name: {"variant": name, "gamma": gamma} for name in variants}
    for correction in CORRECTIONS[1:]:
        found[f"{VARIANT}, {correction}"] = {"variant": VARIANT, "correction": correction}
    return found
