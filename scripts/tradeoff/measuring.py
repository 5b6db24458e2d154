"""What all measurements of accuracy and cost share: quantities, settings, clock, memory."""

from __future__ import annotations

import statistics
import time
import tracemalloc
from collections.abc import Callable, Sequence

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from common.conventions import FIT_MEASURED, GAPS_MEASURED
from common.quantities import derive, quote
from stickiness.accuracy.quantities import MODELLED, columns_of
from stickiness.repulsive import half_space

SETTING_TEXTS = {  # of the knobs that every solver has
    "knob": ("1", "what the settings vary"),
    "pixels": ("1", "grid points per shortest wavelength"),
    "tolerance": ("1", "tolerance of the solver over h_rms"),
}
SHARED_TEXTS = {
    "seed": ("1", "seed of the realisation"),
    "pair_time": ("s", "processor time of a pair of transforms of 1024 x 1024 doubles"),
}
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


def time_task(task: Callable[[], object]) -> tuple[object, float]:
    """Return what a task returns, and the processor time [s] it took."""
    begin = time.process_time()
    found = task()
    return found, time.process_time() - begin


def time_transforms(repetitions: int = 9) -> float:
    """Measure the unit of cost: median processor time [s] of a pair of transforms."""
    space = half_space.half_space((UNIT, UNIT), (1.0, 1.0), np.float64)
    field = np.random.default_rng(1).standard_normal((UNIT, UNIT))
    space.compliance(field)
    return statistics.median(
        time_task(lambda: space.compliance(field))[1] for _ in range(repetitions)
    )


def measure_memory(task: Callable[[], object]) -> float:
    """Measure the largest memory [MB] that a task holds at once, its operators included."""
    half_space.clear_caches()
    tracemalloc.start()
    task()
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return peak / 1e6


def sample(heights: NDArray, step: int) -> NDArray:
    """Take every `step`-th point along both axes."""
    return np.ascontiguousarray(heights[::step, ::step])


def select_knob(measured: xr.Dataset, knob: str) -> xr.Dataset:
    """Select the settings that vary one knob."""
    chosen = measured.isel(setting=np.flatnonzero(measured.knob == knob))
    return chosen.assign_coords(setting=np.arange(chosen.sizes["setting"]))


def stack(parts: Sequence[xr.Dataset], name: str, values: ArrayLike, **options) -> xr.Dataset:
    """Concatenate datasets along a new dimension with these coordinates."""
    return xr.concat(parts, xr.DataArray(values, dims=name, name=name), **options)
