"""What all measurements of accuracy and cost share: solutions with their settings, and a clock."""

import logging
import statistics

import numpy as np
import xarray as xr

from common import conventions
from common.clock import time_task
from common.model_surfaces import grid_points
from common.model_surfaces import make_heights as make_surface
from stickiness import datasets
from stickiness.accuracy.error_models import COARSE
from stickiness.repulsive import half_space

COVERED = 0.9  # share of cases that a stated error covers
SETTINGS = ("pixels", "tolerance", "seed")
SETTING_VARIABLES = {
    "pixels": "grid points per shortest wavelength",
    "tolerance": "tolerance of the solver over h_rms",
    "pair_time": ("s", "processor time of a pair of transforms of 1024 x 1024 doubles"),
}


def record(wanted, solve):
    """Solve with every (pixels, tolerance, seed) that is wanted; settings along `solution`.

    The processor time of a solution is added as `seconds`, if it does not have times of its own.
    """
    wanted = list(dict.fromkeys(wanted))
    parts = []
    for pixels, tolerance, seed in wanted:
        logging.info("seed %d on %d points, tolerance %g", seed, pixels, tolerance)
        solved, seconds = time_task(solve, pixels, tolerance, seed)
        parts.append(solved if "seconds" in solved else solved.assign(seconds=seconds))
    dataset = xr.concat(parts, "solution")
    columns = zip(*wanted, strict=True)
    settings = {
        name: ("solution", list(column)) for name, column in zip(SETTINGS, columns, strict=True)
    }
    return dataset.assign_coords(settings)


def write(dataset, path, title, parameters, **texts):
    """Write solutions with the time of a pair of transforms."""
    side = 1024  # side of the grid whose pair of transforms is the unit of cost
    space = half_space.half_space((side, side), (1.0, 1.0), np.float64)
    field = np.random.default_rng(1).standard_normal((side, side))
    # The first transform also makes the plans.
    _, *seconds = (time_task(space.compliance, field)[1] for _ in range(10))
    dataset = dataset.assign(pair_time=statistics.median(seconds))
    dataset = conventions.annotate(dataset, **SETTING_VARIABLES, **texts)
    datasets.write(dataset, path, title=title, parameters=parameters)


def make_heights(surface, pixels, seed):
    """Heights on a grid and, with twice as many points if it is coarse, on a finer one."""
    # Two points do not resolve the slope of the shortest waves: it is taken from four.
    finer = make_surface(surface, grid_points(surface, max(pixels, 2 * COARSE)), seed)
    step = max(2 * COARSE // pixels, 1)
    return np.ascontiguousarray(finer[::step, ::step]), finer


def split_loads(quantity, errors):
    """Errors of single surfaces by quantity and load."""
    return {(quantity, load): errors.sel(pressure=load).values for load in errors.pressure.values}
