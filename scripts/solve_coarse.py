"""Coarse contact solutions of many realisations, which correct the mean of a few fine ones.

The seeds begin where those of the fine solutions can never reach. Their surfaces are solved on 2
pixels per shortest wavelength, as every fine one is too; those of the last and largest set of
seeds are not solved at all but only described by their long waves.
"""

import logging

import numpy as np
import xarray as xr

from _job import start
from _model import logarithmic_grid, spectrum_of, window_of
from solve_repulsive import COARSE, CURVE, load_curve
from stickiness import datasets, sampling, surface
from synthesise_surface import grid_points

SOLVED_FROM, DESCRIBED_FROM = 100_001, 1_000_001  # first seeds; the schema keeps the sets apart
KEPT = ("area_fraction", "mean_gap", "residual", "rms_slope")


def main(job):
    asked = job.params.surface
    dataset = coarse_solutions(
        asked,
        range(job.params.after, job.params.seeds),
        job.params.descriptor_seeds,
        np.sort(job.params.pressures),
        logarithmic_grid(job.params.gaps),
        job.params.tolerance,
    )
    datasets.write(
        annotated(dataset),
        job.output[0],
        title="coarse contact solutions and long waves of many realisations",
        parameters={
            **asked,
            "case": job.wildcards.case,
            "tolerance": job.params.tolerance,
            "largest_residual": float(dataset.residual.max()),
            "pixels_per_wavelength": COARSE,
            "grid_points": grid_points(asked, COARSE),
        },
    )


def coarse_solutions(asked, which, others_count, pressures, ranges, tolerance):
    """Solutions of surfaces, numbered from 0, and the long waves of these and of others.

    Those that are not solved go with the first of those that are.
    """
    spectrum, length = spectrum_of(asked), window_of(asked)
    amplitudes = asked.get("amplitudes", "gaussian")
    seeds = SOLVED_FROM + np.array(which)
    others = DESCRIBED_FROM + np.arange(others_count if which[0] == 0 else 0)
    curves = []
    for seed in seeds:
        logging.info("seed %d", seed)
        n = grid_points(asked, 2 * COARSE)
        heights = surface.synthesise(spectrum, n, length, int(seed), amplitudes)
        curve = load_curve(heights[::2, ::2], length, pressures, ranges, tolerance)
        # Of the finer grid: at two pixels the shortest waves are not all there.
        curve["rms_slope"] = surface.moments(heights, length).rms_slope
        curves.append(curve[[*KEPT, *(["attractive_area"] if len(ranges) else [])]])
    dataset = xr.concat(curves, xr.DataArray(seeds, dims="seed", name="seed"))
    dataset = dataset.assign_coords(descriptor=list(sampling.DESCRIPTORS), other=others)
    for name, dim in (("long_waves", "seed"), ("other_long_waves", "other")):
        rows = sampling.descriptors(spectrum, length, dataset[dim].values, amplitudes)
        dataset[name] = (dim, "descriptor"), rows
    return dataset


def annotated(dataset):
    return datasets.annotate(
        dataset,
        **{name: texts for name, texts in CURVE.items() if name in dataset.variables},
        seed=("1", "seed of the realisation"),
        other=("1", "seed of a realisation that is not solved"),
        descriptor=("1", "what is described, lengths in units of 1/q0 and heights of h_rms"),
        long_waves=("1", "descriptors of the long waves"),
        other_long_waves=("1", "descriptors of the long waves of seeds that are not solved"),
    )


if __name__ == "__main__":
    main(start(globals(), "solve_coarse", case="H0.8_zeta64"))
