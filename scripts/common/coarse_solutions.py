"""Coarse contact solutions of many surfaces and their long waves."""

import logging

import numpy as np
import xarray as xr

from common import contact_curves
from common.contact_curves import COARSE, load_curve
from common.model_surfaces import cell_size, grid_points, make_heights, model_spectrum
from stickiness import datasets
from stickiness import surface as synthesis
from stickiness.accuracy import multilevel

SOLVED_FROM, DESCRIBED_FROM = 100_001, 1_000_001  # first seeds; the schema keeps the sets apart
KEPT = ("area_fraction", "mean_gap", "residual", "rms_slope")


def coarse_solutions(asked, which, others_count, pressures, ranges, tolerance, names=()):
    """Solutions of surfaces, numbered from 0, and the long waves of these and of others.

    Those that are not solved go with the first of those that are.
    """
    spectrum, length = model_spectrum(asked), cell_size(asked)
    amplitudes = asked.get("amplitudes", "gaussian")
    seeds = SOLVED_FROM + np.array(which)
    others = DESCRIBED_FROM + np.arange(others_count if which[0] == 0 else 0)
    kept = [*KEPT, *names, *(["attractive_area"] if len(ranges) else [])]
    curves = []
    for seed in seeds:
        logging.info("seed %d", seed)
        heights = make_heights(asked, grid_points(asked, 2 * COARSE), seed)
        curve = load_curve(heights[::2, ::2], length, pressures, ranges, tolerance, names)
        # Of the finer grid: at two pixels the shortest waves are not all there.
        curve["rms_slope"] = synthesis.moments(heights, length).rms_slope
        curves.append(curve[kept])
    dataset = xr.concat(curves, xr.DataArray(seeds, dims="seed", name="seed"))
    dataset = dataset.assign_coords(descriptor=list(multilevel.DESCRIPTORS), other=others)
    for name, dim in (("long_waves", "seed"), ("other_long_waves", "other")):
        rows = multilevel.descriptors(spectrum, length, dataset[dim].values, amplitudes)
        dataset[name] = (dim, "descriptor"), rows
    return dataset


def annotate(dataset):
    return datasets.annotate(
        contact_curves.annotate(dataset),
        other=("1", "seed of a realisation that is not solved"),
        descriptor=("1", "what is described, lengths in units of 1/q0 and heights of h_rms"),
        long_waves=("1", "descriptors of the long waves"),
        other_long_waves=("1", "descriptors of the long waves of seeds that are not solved"),
    )
