"""What all measurements of accuracy and cost share: solutions with their settings, and a clock."""

import logging
import statistics
import time

import numpy as np
import xarray as xr

from common.conventions import FIT_MEASURED, GAPS_MEASURED
from common.model_surfaces import grid_points
from common.model_surfaces import make_heights as make_surface
from common.quantities import derive, quote
from stickiness import datasets
from stickiness.accuracy.error_models import COARSE
from stickiness.accuracy.quantities import MODELLED, columns_of
from stickiness.repulsive import half_space

UNIT = 1024  # side of the grid whose pair of transforms is the unit of cost
COVERED = 0.9  # share of cases that a stated error covers
SETTINGS = ("pixels", "tolerance", "seed")
TEXTS = {
    "pixels": ("1", "grid points per shortest wavelength"),
    "tolerance": ("1", "tolerance of the solver over h_rms"),
    "seed": ("1", "seed of the realisation"),
    "pair_time": ("s", "processor time of a pair of transforms of 1024 x 1024 doubles"),
}


def record(wanted, solve):
    """Solve with every (pixels, tolerance, seed) that is wanted; settings along `solution`."""
    wanted, parts = list(dict.fromkeys(wanted)), []
    for pixels, tolerance, seed in wanted:
        logging.info("seed %d on %d points, tolerance %g", seed, pixels, tolerance)
        parts.append(solve(pixels, tolerance, seed))
    settings = zip(SETTINGS, zip(*wanted, strict=True), strict=True)
    found = xr.concat(parts, "solution")
    return found.assign_coords({name: ("solution", list(values)) for name, values in settings})


def write(dataset, path, title, parameters, **texts):
    """Write solutions with the time of a pair of transforms."""
    dataset = datasets.annotate(dataset.assign(pair_time=time_transforms()), **TEXTS, **texts)
    datasets.write(dataset, path, title=title, parameters=parameters)


def select(measured, pixels, tolerance):
    """Solutions with one grid and tolerance, along the seed."""
    chosen = (measured.pixels == pixels) & (measured.tolerance == tolerance)
    found = measured.isel(solution=np.flatnonzero(chosen)).swap_dims(solution="seed")
    return found.drop_vars(SETTINGS[:2])


def derive_columns(solved):
    """Columns of all quantities with error models; P(u) at all gaps that its error covers."""
    contact = derive(solved, FIT_MEASURED)
    found = {name: quote(name, contact) for name in columns_of(MODELLED)}
    return found | {"gap_distribution": contact.gap_density.sel(gap=slice(*GAPS_MEASURED))}


def make_heights(surface, pixels, seed):
    """Heights on a grid and, with twice as many points if it is coarse, on a finer one."""
    # Two points do not resolve the slope of the shortest waves: it is taken from four.
    finer = make_surface(surface, grid_points(surface, max(pixels, 2 * COARSE)), seed)
    step = max(2 * COARSE // pixels, 1)
    return np.ascontiguousarray(finer[::step, ::step]), finer


def time_task(task):
    """Return what a task returns, and the processor time [s] it took."""
    begin = time.process_time()
    found = task()
    return found, time.process_time() - begin


def time_transforms(repetitions=9):
    """Measure the unit of cost: median processor time [s] of a pair of transforms."""
    space = half_space.half_space((UNIT, UNIT), (1.0, 1.0), np.float64)
    field = np.random.default_rng(1).standard_normal((UNIT, UNIT))
    space.compliance(field)
    return statistics.median(
        time_task(lambda: space.compliance(field))[1] for _ in range(repetitions)
    )
