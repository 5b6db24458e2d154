"""What the measurements of the trade between cost and error share: quantities, clock, memory."""

from __future__ import annotations

import statistics
import time
import tracemalloc
from collections.abc import Callable

import numpy as np
import xarray as xr

from pipeline.conventions import FIT_MEASURED, GAPS_MEASURED
from pipeline.quantities import derive, quote
from stickiness.accuracy.quantities import MODELLED, columns_of
from stickiness.contact import half_space

UNIT = 1024  # side of the grid whose pair of transforms is the unit of cost
COVERED = 0.9  # share of cases that a stated error covers


def derived(solved: xr.Dataset) -> dict[str, xr.DataArray]:
    """Return the columns of all quantities that have error models, from solutions.

    P(u) is taken at all gaps that its error is measured over, not only where it is quoted.

    Parameters
    ----------
    solved
        With ``area_fraction``, ``mean_gap``, ``rms_slope`` and ``attractive_area`` along
        ``pressure`` and ``range``, and any other dimensions.
    """
    contact = derive(solved, FIT_MEASURED)
    found = {name: quote(name, contact) for name in columns_of(MODELLED)}
    return found | {"gap_distribution": contact.gap_density.sel(gap=slice(*GAPS_MEASURED))}


def rms(values: xr.DataArray, dims: str | list[str] = "gap") -> xr.DataArray:
    """Root mean square over those of `dims` that the values have."""
    dims = [dim for dim in np.atleast_1d(dims) if dim in values.dims]
    return np.sqrt((values**2).mean(dims)) if dims else abs(values)


def timed(task: Callable[[], object]) -> tuple[object, float]:
    """What a task returns, and the processor time [s] it took."""
    begin = time.process_time()
    found = task()
    return found, time.process_time() - begin


def pair_seconds(repetitions: int = 9) -> float:
    """Processor time [s] of a forward and a backward transform of 1024 x 1024 doubles, median."""
    space = half_space.half_space((UNIT, UNIT), (1.0, 1.0), np.float64)
    field = np.random.default_rng(1).standard_normal((UNIT, UNIT))
    space.compliance(field)
    return statistics.median(timed(lambda: space.compliance(field))[1] for _ in range(repetitions))


def peak_megabytes(task: Callable[[], object]) -> float:
    """Largest memory [MB] that a task holds at once, its operators included."""
    half_space.clear_caches()
    tracemalloc.start()
    task()
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return peak / 1e6


KEYS = {
    "knob": "what the settings vary",
    "pixels": "grid points per shortest wavelength",
    "tolerance": "tolerance of the solver over h_rms",
}
