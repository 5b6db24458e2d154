"""Pull the same realisations off with every grid, tolerance and step of the path, and time it.

A press separates from a load, as in the loops of the configuration; beside it the pull-off of the
DMT limit: the lowest of the loads without adhesion, less the attraction over their gaps.
"""

import logging

import numpy as np
import xarray as xr

from common.adhesion_sets import LEAST, scaled_law
from common.conventions import VARIABLES
from common.job import start
from common.model_surfaces import cell_size, grid_points, model_spectrum
from stickiness import adhesive, datasets, dmt
from stickiness import surface as synthesis
from stickiness.repulsive import solver
from tradeoff import measuring

DECADES, PER_DECADE = 4, 10  # of the loads below the largest, for the DMT limit


def main(job):
    surface, pull_off = job.params.case, job.params.pull_off
    settings, finest = list_settings(pull_off), max(pull_off["pixels"])
    length, n = cell_size(surface), grid_points(surface, finest)
    points = np.array(pull_off["points"])
    laws = [
        scaled_law(pull_off, pull_off["law"], strength, range_)
        for range_, strength in pull_off["points"]
    ]
    seeds, rows = np.arange(1, pull_off["seeds"] + 1), []
    for seed in seeds:
        heights = synthesis.synthesise(model_spectrum(surface), n, length, int(seed))
        parts = [
            separate(
                measuring.sample(heights, finest // s["pixels"]),
                length,
                laws,
                pull_off["pressure"],
                s,
            )
            for s in settings
        ]
        step = finest // pull_off["at_pixels"]
        limit = solve_dmt_limit(heights[::step, ::step], length, laws, pull_off)
        rows.append(xr.concat(parts, "setting").assign(pull_off_dmt=("point", limit)))
        logging.info("seed %d", seed)
    dataset = measuring.stack(rows, "seed", seeds)
    for key in (*measuring.SETTING_TEXTS, "balance"):
        dataset[key] = "setting", [setting[key] for setting in settings]
    dataset = dataset.assign_coords(
        range_over_h_rms=("point", points[:, 0]), adhesion_length_over_range=("point", points[:, 1])
    )
    datasets.write(
        annotate(dataset.assign(pair_time=measuring.time_transforms())),
        job.output[0],
        title="pull-off of the same realisations with various settings",
        parameters={**surface, "q0_h_rms": pull_off["q0_h_rms"], "pressure": pull_off["pressure"]},
    )


def list_settings(pull_off):
    """List every setting: grids, then tolerances, then steps of the path on two grids."""
    pixels = pull_off["at_pixels"]
    usual = {
        "knob": "pixels",
        "pixels": pixels,
        "tolerance": pull_off["at_tolerance"],
        "balance": pull_off["at_balance"],
    }
    return [
        *(usual | {"pixels": points} for points in pull_off["pixels"]),
        *(usual | {"knob": "tolerance", "tolerance": value} for value in pull_off["tolerances"]),
        *(
            usual | {"knob": "step", "pixels": points, "balance": value}
            for points in (pixels // 2, pixels)
            for value in pull_off["balances"]
        ),
    ]


def separate(heights, length, laws, load, setting):
    """Lowest mean pressure on separation from a load with every law, and the time it took."""

    def lowest(law):
        path = adhesive.path(
            heights,
            length,
            law,
            (load, -2 * law.strength),
            tol=setting["tolerance"],
            balance=setting["balance"],
            smallest_jump=setting["balance"],
            steps=LEAST,
        )
        return min(point.state.mean_pressure for point in path if point.event != "pull-off")

    found = [measuring.time_task(lambda law=law: lowest(law)) for law in laws]
    values, seconds = zip(*found, strict=True)
    return xr.Dataset({"pull_off": ("point", list(values)), "seconds": ("point", list(seconds))})


def solve_dmt_limit(heights, length, laws, pull_off):
    """Lowest of the loads without adhesion, less the attraction over their gaps, with every law."""
    largest = pull_off["pressure"]
    loads = np.geomspace(largest / 10**DECADES, largest, DECADES * PER_DECADE + 1)
    path = list(solver.load_path(heights, length, loads, tol=pull_off["at_tolerance"]))
    return [min(c.mean_pressure - dmt.adhesive_pressure(c.gap, law) for c in path) for law in laws]


def annotate(dataset):
    return datasets.annotate(
        dataset,
        **measuring.SETTING_TEXTS,
        **measuring.SHARED_TEXTS,
        balance=("1", "error of the energy balance of a step over the energies of the path"),
        pull_off=("1", "lowest mean pressure over E* q0 h_rms"),
        pull_off_dmt=("1", "lowest mean pressure over E* q0 h_rms in the DMT limit"),
        range_over_h_rms=VARIABLES["range_over_h_rms"],
        adhesion_length_over_range=VARIABLES["adhesion_length_over_range"],
        seconds=("s", "processor time of the separation"),
    )


if __name__ == "__main__":
    main(start(globals(), "measure_pull_off", trade_case="H0.8_zeta16"))
