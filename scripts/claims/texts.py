"""How claims put their numbers, errors and samples into words."""

from __future__ import annotations

import numpy as np
import xarray as xr

from stickiness import datasets
from stickiness import error_budget as budget


def errors_by_source(data: xr.Dataset, name: str) -> dict[str, float]:
    """Errors of a single number by their source."""
    return {source: float(budget.part(data, name, source)) for source in budget.SOURCES}


def quote(data: xr.Dataset, name: str) -> str:
    """A single number of a dataset with its error."""
    return quote_number(data[name], budget.total_error(data, name))


def quote_number(value: float, error: float) -> str:
    """Value with its error, if it has one."""
    return f"{float(value):.2f}" + (f" ± {float(error):.2f}" if np.isfinite(error) else "")


def describe_sample(data: xr.Dataset) -> str:
    """Magnification and window of a simulated case in words."""
    made = datasets.parameters(data)
    waves = made.get("window", 1)
    return (
        f"zeta = {made['magnification']:g}, "
        f"window {waves:g} longest wavelength{'s'[: waves > 1]} wide"
    )


def power_of_ten(number: float | xr.DataArray) -> str:
    """Magnification in words, 1000 or 5e4."""
    number = float(number)
    return f"{number:g}" if number < 1e4 else f"{number:.2g}".replace("e+0", "e")
