"""Tear the same realisations off with every grid, tolerance and step of the path, and time it.

A press separates from a load, as in the loops of the configuration; beside it the pull-off that the
DMT limit has, the lowest of the loads that are left of those without adhesion.
"""

import logging

import numpy as np
import xarray as xr

from pipeline.adhesion_sets import LEAST, scaled_law
from pipeline.conventions import VARIABLES, cell_size, grid_points, model_spectrum
from pipeline.job import start
from pipeline.tradeoff.measuring import KEYS, pair_seconds, timed
from stickiness import adhesive
from stickiness.adhesion import dmt
from stickiness.contact import solver
from stickiness.core import datasets
from stickiness.surfaces import synthesis

DECADES, PER_DECADE = 4, 10  # of the loads below the largest, for the DMT limit


def main(job):
    asked, wanted = job.params.case, job.params.pull_off
    chosen, finest = settings(wanted), max(wanted["pixels"])
    length, points = cell_size(asked), np.array(wanted["points"])
    seeds, rows = np.arange(1, wanted["seeds"] + 1), []
    for seed in seeds:
        heights = synthesis.synthesise(
            model_spectrum(asked), grid_points(asked, finest), length, int(seed)
        )
        parts = [torn(heights, length, wanted, finest, **s) for s in chosen]
        step = finest // wanted["at_pixels"]
        limit = dmt_limit(heights[::step, ::step], length, wanted)
        rows.append(xr.concat(parts, "setting").assign(pull_off_dmt=("point", limit)))
        logging.info("seed %d", seed)
    dataset = xr.concat(rows, xr.DataArray(seeds, dims="seed", name="seed"))
    for key in (*KEYS, "balance"):
        dataset[key] = "setting", [setting[key] for setting in chosen]
    dataset = dataset.assign_coords(
        range_over_h_rms=("point", points[:, 0]), adhesion_length_over_range=("point", points[:, 1])
    )
    datasets.write(
        annotated(dataset.assign(pair_time=pair_seconds())),
        job.output[0],
        title="pull-off of the same realisations with various settings",
        parameters={**asked, "q0_h_rms": wanted["q0_h_rms"], "pressure": wanted["pressure"]},
    )


def settings(wanted):
    """Every setting: grids, then tolerances, then steps of the path on two grids."""
    usual = {
        "knob": "pixels",
        "pixels": wanted["at_pixels"],
        "tolerance": wanted["at_tolerance"],
        "balance": wanted["at_balance"],
    }
    return [
        *(usual | {"pixels": points} for points in wanted["pixels"]),
        *(usual | {"knob": "tolerance", "tolerance": value} for value in wanted["tolerances"]),
        *(
            usual | {"knob": "step", "pixels": points, "balance": value}
            for points in (wanted["at_pixels"] // 2, wanted["at_pixels"])
            for value in wanted["balances"]
        ),
    ]


def torn(heights, length, wanted, finest, knob, pixels, tolerance, balance):
    """Lowest mean pressure on separation at every point, and the time it took."""
    step = finest // pixels
    sampled = np.ascontiguousarray(heights[::step, ::step])
    found = [
        timed(lambda p=point: lowest(sampled, length, wanted, *p, tolerance, balance))
        for point in wanted["points"]
    ]
    values, seconds = zip(*found, strict=True)
    return xr.Dataset({"pull_off": ("point", list(values)), "seconds": ("point", list(seconds))})


def lowest(heights, length, wanted, reach, strength, tolerance, balance):
    """Lowest mean pressure on the way from the load to the pull-off."""
    law = scaled_law(wanted, wanted["law"], strength, reach)
    points = adhesive.path(
        heights,
        length,
        law,
        (wanted["pressure"], -2 * law.strength),
        tol=tolerance,
        balance=balance,
        smallest_jump=balance,
        steps=LEAST,
    )
    return min(point.state.mean_pressure for point in points if point.event != "pull-off")


def dmt_limit(heights, length, wanted):
    """Lowest load that is left of those without adhesion by the attraction over their gaps."""
    loads = np.geomspace(
        wanted["pressure"] / 10**DECADES, wanted["pressure"], DECADES * PER_DECADE + 1
    )
    path = list(solver.load_path(heights, length, loads, tol=wanted["at_tolerance"]))
    return [
        min(c.mean_pressure - dmt.adhesive_pressure(c.gap, law) for c in path)
        for law in (
            scaled_law(wanted, wanted["law"], strength, reach)
            for reach, strength in wanted["points"]
        )
    ]


def annotated(dataset):
    return datasets.annotate(
        dataset,
        **{key: ("1", text) for key, text in KEYS.items()},
        balance=("1", "error of the energy balance of a step over the energies of the path"),
        pull_off=("1", "lowest mean pressure over E* q0 h_rms"),
        pull_off_dmt=("1", "the same in the DMT limit"),
        range_over_h_rms=VARIABLES["range_over_h_rms"],
        adhesion_length_over_range=VARIABLES["adhesion_length_over_range"],
        seed=("1", "seed of the realisation"),
        seconds=("s", "processor time of the separation"),
        pair_time=("s", "processor time of a pair of transforms of 1024 x 1024 doubles"),
    )


if __name__ == "__main__":
    main(start(globals(), "measure_pull_off", trade_case="H0.8_zeta16"))
