"""Pull the same realisations off with every grid and tolerance, and time each separation.

A press separates from a load, as in the loops of the configuration. Beside it stands the pull-off
in the DMT limit: the lowest of the loads without adhesion, less the attraction over their gaps.
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
    finest, at_pixels = max(pull_off["pixels"]), pull_off["at_pixels"]
    settings = measuring.list_settings(
        pull_off["pixels"], pull_off["tolerances"], at_pixels, pull_off["at_tolerance"]
    )
    length, n = cell_size(surface), grid_points(surface, finest)
    points = np.array(pull_off["points"])
    laws = [scaled_law(pull_off, pull_off["law"], strength, range_) for range_, strength in points]
    seeds, rows = np.arange(1, pull_off["seeds"] + 1), []
    for seed in seeds:
        heights = synthesis.synthesise(model_spectrum(surface), n, length, int(seed))
        parts = [
            separate(measuring.coarsen(heights, finest // s["pixels"]), length, laws, pull_off, s)
            for s in settings
        ]
        usual = measuring.coarsen(heights, finest // at_pixels)
        limit = solve_dmt_limit(usual, length, laws, pull_off)
        rows.append(xr.concat(parts, "setting").assign(pull_off_dmt=("point", limit)))
        logging.info("seed %d", seed)
    dataset = measuring.stack(rows, "seed", seeds)
    for key in ("knob", "pixels", "tolerance"):
        dataset[key] = "setting", [setting[key] for setting in settings]
    dataset = dataset.assign_coords(
        range_over_h_rms=("point", points[:, 0]), adhesion_length_over_range=("point", points[:, 1])
    )
    datasets.write(
        datasets.annotate(
            dataset.assign(pair_time=measuring.time_transforms()),
            **measuring.TEXTS,
            pull_off=("1", "lowest mean pressure over E* q0 h_rms"),
            pull_off_dmt=("1", "lowest mean pressure over E* q0 h_rms in the DMT limit"),
            range_over_h_rms=VARIABLES["range_over_h_rms"],
            adhesion_length_over_range=VARIABLES["adhesion_length_over_range"],
            seconds=("s", "processor time of the separation"),
        ),
        job.output[0],
        title="pull-off of the same realisations with various settings",
        parameters={**surface, "q0_h_rms": pull_off["q0_h_rms"], "pressure": pull_off["pressure"]},
    )


def separate(heights, length, laws, pull_off, setting):
    """Find the lowest mean pressure on separation with every law, and the time it took."""
    balance = pull_off["at_balance"]

    def lowest(law):
        path = adhesive.path(
            heights,
            length,
            law,
            (pull_off["pressure"], -2 * law.strength),
            tol=setting["tolerance"],
            balance=balance,
            smallest_jump=balance,
            steps=LEAST,
        )
        return min(point.state.mean_pressure for point in path if point.event != "pull-off")

    found = [measuring.time_task(lambda law=law: lowest(law)) for law in laws]
    values, seconds = zip(*found, strict=True)
    return xr.Dataset({"pull_off": ("point", list(values)), "seconds": ("point", list(seconds))})


def solve_dmt_limit(heights, length, laws, pull_off):
    """Find the lowest of the loads without adhesion, less the attraction over their gaps."""
    largest = pull_off["pressure"]
    loads = np.geomspace(largest / 10**DECADES, largest, DECADES * PER_DECADE + 1)
    path = list(solver.load_path(heights, length, loads, tol=pull_off["at_tolerance"]))
    return [min(c.mean_pressure - dmt.adhesive_pressure(c.gap, law) for c in path) for law in laws]


if __name__ == "__main__":
    main(start(globals(), "measure_pull_off", trade_case="H0.8_zeta16"))
