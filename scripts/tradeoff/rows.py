"""Rows of the table of errors and costs: one for each setting, case and quantity."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import xarray as xr

from tradeoff.measuring import COVERED, rms


@dataclass(frozen=True)
class Trial:
    """A setting of a knob, tried on a case.

    Attributes
    ----------
    knob, setting, case : str
        What is varied, its value, and the surface (with its adhesion).
    unit : float
        Processor time [s] of a pair of transforms.
    memory : float
        Largest memory [MB].
    """

    knob: str
    setting: str
    case: str
    unit: float
    memory: float = np.nan

    def list_rows(
        self,
        errors: Mapping[tuple[str, float], float],
        biases: Mapping[tuple[str, float], float],
        seconds: float | xr.DataArray,
    ) -> list[tuple]:
        """List a row for every quantity and load.

        Parameters
        ----------
        errors, biases : mapping
            Relative errors of single surfaces (or of means) and of the mean by quantity and load;
            a bias may be missing.
        seconds : float or DataArray
            Processor time, of one load or by load.
        """
        rows = []
        for (quantity, load), error in errors.items():
            time = seconds
            if isinstance(seconds, xr.DataArray):
                time = float(seconds.sel(pressure=load))
            bias = float(biases.get((quantity, load), np.nan))
            place = self.knob, self.setting, f"{self.case}, p = {load:g}", quantity
            rows.append((*place, float(error), bias, time / self.unit, time, self.memory))
        return rows

    def compare(
        self,
        quantities: Mapping[str, xr.DataArray],
        reference: Mapping[str, xr.DataArray],
        seconds: xr.DataArray,
    ) -> list[tuple]:
        """List rows of values against those of a reference, seed by seed."""
        rows = []
        for quantity, values in quantities.items():
            error = values / reference[quantity] - 1
            single = by_load(quantity, rms(error).quantile(COVERED, "seed"))
            rows += self.list_rows(single, by_load(quantity, rms(error.mean("seed"))), seconds)
        return rows


def by_load(quantity: str, values: xr.DataArray) -> dict[tuple[str, float], float]:
    """Values along the loads as a mapping from quantity and load."""
    return {(quantity, load): float(values.sel(pressure=load)) for load in values.pressure.values}


def select(quantities: Mapping[str, xr.DataArray], **where: int) -> dict[str, xr.DataArray]:
    """Every quantity at these positions."""
    return {quantity: values.isel(where) for quantity, values in quantities.items()}
