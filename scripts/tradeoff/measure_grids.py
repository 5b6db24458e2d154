"""Solve the same realisations with every grid, tolerance and precision, and time each solution."""

import logging
from types import SimpleNamespace

import numpy as np
import xarray as xr

from pipeline.contact_curves import measure
from pipeline.conventions import VARIABLES, cell_size, grid_points, logarithmic_grid, model_spectrum
from pipeline.job import start
from pipeline.tradeoff.measuring import KEYS, pair_seconds, peak_megabytes, timed
from stickiness.contact import active_set, solver
from stickiness.core import datasets
from stickiness.surfaces import synthesis

FINEST_TOLERANCE = 1e-12  # of what other tolerances are held against
SINGLE = 1e-4  # tolerance that single precision can meet


def main(job):
    asked, pressures = job.params.case, np.array(job.params.pressures)
    chosen = settings(**job.params.settings)
    ranges, length = logarithmic_grid(job.params.gaps), cell_size(asked)
    finest = max(setting["pixels"] for setting in chosen)
    seeds, rows = np.arange(1, job.params.seeds + 1), []
    for seed in seeds:
        logging.info("seed %d", seed)
        n = grid_points(asked, finest)
        heights = synthesis.synthesise(model_spectrum(asked), n, length, int(seed))
        slope = synthesis.moments(heights, length).rms_slope
        parts = [solved(heights, length, pressures, ranges, finest, **s) for s in chosen]
        rows.append(xr.concat(parts, "setting").assign(rms_slope=slope, pair_time=pair_seconds()))
    dataset = xr.concat(rows, xr.DataArray(seeds, dims="seed", name="seed"))
    dataset["memory"] = (
        "setting",
        [
            peak_megabytes(lambda s=s: solved(heights, length, pressures[-1:], ranges, finest, **s))
            for s in chosen
        ],
    )
    for key in KEYS:
        dataset[key] = "setting", [setting[key] for setting in chosen]
    datasets.write(
        annotated(dataset),
        job.output[0],
        title="the same realisations solved with various settings",
        parameters={**asked, "grid_points": n},
    )


def settings(pixels, tolerances, at_pixels, at_tolerance):
    """Every setting to solve with: one knob varied, the others at a fixed value."""
    return [
        *({"knob": "pixels", "pixels": p, "tolerance": at_tolerance} for p in pixels),
        *(
            {"knob": "tolerance", "pixels": at_pixels, "tolerance": t}
            for t in (*tolerances, FINEST_TOLERANCE)
        ),
        {"knob": "precision", "pixels": at_pixels, "tolerance": SINGLE},
    ]


def solved(heights, length, pressures, ranges, finest, knob, pixels, tolerance):
    """One realisation with one setting: quantities, and the times of solution and evaluation."""
    step = finest // pixels
    sampled = np.ascontiguousarray(heights[::step, ::step])
    solve = in_single_precision if knob == "precision" else solver.solve
    rows = []
    for load in pressures:
        contact, solution_time = timed(lambda p=load: solve(sampled, length, p, tolerance))
        row, evaluation_time = timed(lambda c=contact: measure(c, ranges))
        rows.append(row.assign(solution_time=solution_time, evaluation_time=evaluation_time))
    return xr.concat(rows, xr.DataArray(pressures, dims="pressure", name="pressure"))


def in_single_precision(heights, length, pressure, tolerance):
    """The solver as it treats coarser grids; `solver.solve` ends in double precision.

    It offers no such choice, for it gains next to nothing: the inner iterations are in single
    precision anyway.
    """
    h_rms, sides = heights.std(), (1.0, 1.0)
    scaled, load = (heights - heights.mean()) / h_rms, pressure * length / h_rms
    problem, work = active_set.Problem(scaled, sides, load), []
    gap = solver.coarse_gap(problem, work)
    state = active_set.relax(problem, tol=tolerance, max_iterations=1000, gap=gap, rough=True)
    return SimpleNamespace(
        gap=state.gap.astype(float) * h_rms,
        area_fraction=state.area_fraction,
        mean_gap=float(state.gap.mean(dtype=float)) * h_rms,
        residual=state.residual,
        iterations=state.iterations,
        fft_pairs=state.pairs + sum(work) / scaled.size,
    )


def annotated(dataset):
    names = ("pressure", "range", "area_fraction", "mean_gap", "attractive_area")
    return datasets.annotate(
        dataset,
        **{name: VARIABLES[name] for name in names},
        **{key: ("1", text) for key, text in KEYS.items()},
        seed=("1", "seed of the realisation"),
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
        pair_time=("s", "processor time of a pair of transforms of 1024 x 1024 doubles"),
        memory=("MB", "largest memory held at once at the largest load"),
    )


if __name__ == "__main__":
    main(start(globals(), "measure_grids", trade_case="H0.8_zeta32"))
