"""Solve the same realisations with every grid, tolerance and precision, and time each solution."""

import logging

import numpy as np
import xarray as xr

from common.contact_curves import measure
from common.conventions import VARIABLES, logarithmic_grid
from common.job import start
from common.model_surfaces import cell_size, grid_points, model_spectrum
from stickiness import datasets
from stickiness import surface as synthesis
from stickiness.repulsive import solver
from tradeoff import measuring

FINEST_TOLERANCE = 1e-12  # the reference of the other tolerances
SINGLE = 1e-4  # tolerance that single precision can meet


def main(job):
    surface, pressures = job.params.case, np.array(job.params.pressures)
    settings = list_settings(**job.params.settings)
    ranges, length = logarithmic_grid(job.params.gaps), cell_size(surface)
    finest = max(setting["pixels"] for setting in settings)
    n = grid_points(surface, finest)
    seeds, rows = np.arange(1, job.params.seeds + 1), []
    for seed in seeds:
        logging.info("seed %d", seed)
        heights = synthesis.synthesise(model_spectrum(surface), n, length, int(seed))
        slope = synthesis.moments(heights, length).rms_slope
        parts = [solve(heights, length, pressures, ranges, finest, **s) for s in settings]
        row = xr.concat(parts, "setting")
        rows.append(row.assign(rms_slope=slope, pair_time=measuring.time_transforms()))
    dataset = measuring.stack(rows, "seed", seeds)
    largest = heights, length, pressures[-1:], ranges, finest
    memory = [measuring.measure_memory(lambda s=s: solve(*largest, **s)) for s in settings]
    dataset["memory"] = "setting", memory
    for key in measuring.SETTING_TEXTS:
        dataset[key] = "setting", [setting[key] for setting in settings]
    datasets.write(
        annotate(dataset),
        job.output[0],
        title="the same realisations solved with various settings",
        parameters={**surface, "grid_points": n},
    )


def list_settings(pixels, tolerances, at_pixels, at_tolerance):
    """List every setting to solve with: one knob varied, the others at a fixed value."""
    return [
        *({"knob": "pixels", "pixels": p, "tolerance": at_tolerance} for p in pixels),
        *(
            {"knob": "tolerance", "pixels": at_pixels, "tolerance": t}
            for t in (*tolerances, FINEST_TOLERANCE)
        ),
        {"knob": "precision", "pixels": at_pixels, "tolerance": SINGLE},
    ]


def solve(heights, length, pressures, ranges, finest, knob, pixels, tolerance):
    """Solve one realisation with one setting, and time solution and evaluation."""
    sampled = measuring.sample(heights, finest // pixels)
    options = {"tol": tolerance, "precision": "single" if knob == "precision" else "double"}
    rows = []
    for load in pressures:
        contact, solution_time = measuring.time_task(
            lambda p=load: solver.solve(sampled, length, p, **options)
        )
        row, evaluation_time = measuring.time_task(lambda c=contact: measure(c, ranges))
        rows.append(row.assign(solution_time=solution_time, evaluation_time=evaluation_time))
    return measuring.stack(rows, "pressure", pressures)


def annotate(dataset):
    names = ("pressure", "range", "area_fraction", "mean_gap", "attractive_area")
    return datasets.annotate(
        dataset,
        **{name: VARIABLES[name] for name in names},
        **measuring.SETTING_TEXTS,
        **measuring.SHARED_TEXTS,
        pixel_area_fraction=("1", "repulsive contact area as counted in pixels, over nominal area"),
        pixel_attractive_area=("1", "attractive area as counted in pixels, over nominal area"),
        edges=("1", "pixel sides between contact and gap"),
        edge_gap=("1", "gap of the pixels next to the contact over h_rms"),
        residual=("1", "complementarity residual over h_rms"),
        iterations=("1", "conjugate gradient iterations"),
        fft_pairs=("1", "pairs of Fourier transforms in units of this grid"),
        rms_slope=("1", "rms gradient of this realisation over q0 h_rms"),
        solution_time=("s", "processor time of the solution"),
        evaluation_time=("s", "processor time of areas and gaps"),
        memory=("MB", "largest memory held at once at the largest load"),
    )


if __name__ == "__main__":
    main(start(globals(), "measure_grids", trade_case="H0.8_zeta32"))
