"""What all measurements of accuracy and cost share: quantities, settings and clock."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Sequence

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from common.conventions import FIT_MEASURED, GAPS_MEASURED
from common.quantities import derive, quote
from stickiness.accuracy.quantities import MODELLED, columns_of
from stickiness.repulsive import half_space

UNIT = 1024  # side of the grid whose pair of transforms is the unit of cost
COVERED = 0.9  # share of cases that a stated error covers
TEXTS = {
    "knob": ("1", "what the settings vary"),
    "pixels": ("1", "grid points per shortest wavelength"),
    "tolerance": ("1", "tolerance of the solver over h_rms"),
    "seed": ("1", "seed of the realisation"),
    "pair_time": ("s", "processor time of a pair of transforms of 1024 x 1024 doubles"),
}


def derive_columns(solved: xr.Dataset) -> dict[str, xr.DataArray]:
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


def coarsen(heights: NDArray, step: int) -> NDArray:
    """Take every `step`-th point along both axes."""
    return np.ascontiguousarray(heights[::step, ::step])


def list_settings(
    pixels: Sequence[int], tolerances: Sequence[float], at_pixels: int, at_tolerance: float
) -> list[dict]:
    """List every setting to solve with: one is varied while the other stays at its usual value."""
    return [
        *({"knob": "pixels", "pixels": p, "tolerance": at_tolerance} for p in pixels),
        *({"knob": "tolerance", "pixels": at_pixels, "tolerance": t} for t in tolerances),
    ]


def stack(parts: Sequence[xr.Dataset], name: str, values: ArrayLike, **options) -> xr.Dataset:
    """Concatenate datasets along a new dimension with these coordinates."""
    return xr.concat(parts, xr.DataArray(values, dims=name, name=name), **options)
