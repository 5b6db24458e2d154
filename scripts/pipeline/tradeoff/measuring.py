"""What all measurements of accuracy and cost share: quantities, settings, clock, memory."""

from __future__ import annotations

import statistics
import time
import tracemalloc
from collections.abc import Callable, Sequence

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from pipeline.conventions import GAPS_MEASURED, middles
from pipeline.fits import fit_one
from stickiness.contact import half_space

# What a user may ask for, and how the columns of the tables are called. The attraction of the DMT
# limit 1/kappa_ad is in proportion to the attractive area at its range and the threshold of E* to
# a_V: their relative errors are the same.
QUANTITIES = {
    "area": "contact area",
    "mean_gap": "mean gap",
    "attractive_area_0.01": "attractive area and 1/kappa_ad at range 0.01 h_rms",
    "attractive_area_0.1": "attractive area and 1/kappa_ad at range 0.1 h_rms",
    "gap_distribution": "P(u), rms over gaps from 0.01 to 1 h_rms",
    "a_v": "a_V and threshold of E*",
    "kappa": "kappa_rep",
}
WINDOW = (0.01, 0.1)  # of the fit of a_V, the one that is quoted
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


def derived(solved: xr.Dataset, area: str = "attractive_area") -> dict[str, xr.DataArray]:
    """Return the quantities of `QUANTITIES` from those of solutions.

    Parameters
    ----------
    solved
        With ``area_fraction``, ``mean_gap``, ``rms_slope`` and the attractive areas named `area`
        along ``pressure`` and ``range``, and any other dimensions.
    """
    areas, ranges = solved[area], solved["range"].values
    density = areas.diff("range") / xr.DataArray(np.diff(ranges), dims="range")
    density = density.rename(range="gap").assign_coords(gap=middles(ranges))
    fitted = xr.apply_ufunc(
        lambda values, load: fit_one(ranges, values, load, WINDOW)[0],
        areas,
        solved.pressure,
        input_core_dims=[["range"], []],
        vectorize=True,
    )
    return {
        "area": solved.area_fraction,
        "mean_gap": solved.mean_gap,
        "attractive_area_0.01": areas.sel(range=0.01, method="nearest", drop=True),
        "attractive_area_0.1": areas.sel(range=0.1, method="nearest", drop=True),
        "gap_distribution": density.sel(gap=slice(*GAPS_MEASURED)),
        "a_v": fitted,
        "kappa": solved.area_fraction * solved.rms_slope / solved.pressure,
    }


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
