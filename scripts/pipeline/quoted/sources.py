"""Where quoted numbers come from: folders of results and the committed tables."""

from dataclasses import dataclass
from functools import cached_property, lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
import yaml

from pipeline.numbers import number
from pipeline.verdicts.texts import show_shares
from stickiness.core import datasets

WORDS = (
    *("none", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"),
    *("eleven", "twelve", "thirteen", "fourteen", "fifteen", "sixteen", "seventeen", "eighteen"),
)


@dataclass(frozen=True)
class Sources:
    """Folders that quoted numbers are read from."""

    results: Path  # of the full reproduction
    draft: Path  # of the draft, for its times
    root: Path  # of the project, with its configuration

    def read(self, name: str) -> xr.Dataset:
        """The dataset of this name, a path without its ending."""
        return read_once(self.results / f"{name}.nc")

    def read_all(self, folder: str) -> dict[str, xr.Dataset]:
        """All datasets of a folder by their names."""
        paths = sorted((self.results / folder).glob("*.nc"))
        return {path.stem: read_once(path) for path in paths}

    @cached_property
    def config(self) -> dict[str, Any]:
        """The configuration as it comes."""
        return yaml.safe_load((self.root / "config/config.yaml").read_text(encoding="utf-8"))


@lru_cache
def read_once(path: Path) -> xr.Dataset:
    """A dataset, read from disk the first time only."""
    return datasets.read(path)


def say_count(count: int) -> str:
    """A small whole number as a word."""
    return WORDS[count] if count < len(WORDS) else str(count)


def say_range(values: Any, digits: int = 2) -> str:
    """Smallest and largest value, ``2.3 to 2.6``."""
    low, high = (number(float(end), digits) for end in (np.min(values), np.max(values)))
    return low if low == high else f"{low} to {high}"


def say_shares(values: Any) -> str:
    """Smallest and largest share as percentages, ``3 to 10 %``."""
    return show_shares(float(np.min(values)), float(np.max(values)), " to ")
