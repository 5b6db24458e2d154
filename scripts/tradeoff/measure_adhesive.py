"""Solve full adhesion on the same realisations with every grid and tolerance, and time each state.

A few realisations are solved with every setting, more on the usual grid and coarser ones alone:
those tell how the quantities scatter, and how much of the scatter is left by their control variate,
the DMT limit on the coarsest grid.
"""

import logging

import numpy as np
import xarray as xr

from common.adhesion_sets import STRONGEST, scaled_law, solve_at_gap
from common.conventions import VARIABLES
from common.job import start
from common.model_surfaces import cell_size, grid_points, model_spectrum
from stickiness import datasets, dmt
from stickiness import surface as synthesis
from stickiness.repulsive import solver
from tradeoff import measuring

FINEST_TOLERANCE = 1e-10  # the reference of the other tolerances
STATE_TEXTS = {
    "external_pressure": "mean pressure over E* q0 h_rms",
    "repulsive_area": "area at a gap of zero over nominal area, by pixels",
}
ALONE_TEXTS = {
    "attraction_dmt": "attraction over the gaps without adhesion over E* q0 h_rms",
    "area_alone": "contact area without adhesion over nominal area, by pixels",
}


def main(job):
    surface, adhesion = job.params.case, job.params.adhesion
    most = adhesion["most_points"]
    grids = [p for p in sorted(adhesion["pixels"]) if grid_points(surface, p) <= most]
    tolerances = [*adhesion["tolerances"], FINEST_TOLERANCE]
    at_pixels = adhesion["at_pixels"]
    settings = measuring.list_settings(grids, tolerances, at_pixels, adhesion["at_tolerance"])
    length, n = cell_size(surface), grid_points(surface, grids[-1])
    seeds, rows = np.arange(1, adhesion["more_seeds"] + 1), []
    for seed in seeds:
        heights = synthesis.synthesise(model_spectrum(surface), n, length, int(seed))
        chosen = settings if seed <= adhesion["seeds"] else settings[: 1 + grids.index(at_pixels)]
        parts = [
            solve(measuring.coarsen(heights, grids[-1] // s["pixels"]), length, adhesion, s)
            for s in chosen
        ]
        rows.append(measuring.stack(parts, "setting", np.arange(len(parts))))
        logging.info("seed %d", seed)
    dataset = measuring.stack(rows, "seed", seeds, join="outer").drop_vars("setting")
    for key in ("knob", "pixels", "tolerance"):
        dataset[key] = "setting", [setting[key] for setting in settings]
    missing = "a window closes, or not solved with this setting"
    texts = {name: ("1", text, missing) for name, text in {**STATE_TEXTS, **ALONE_TEXTS}.items()}
    datasets.write(
        datasets.annotate(
            dataset.assign(pair_time=measuring.time_transforms()),
            **texts,
            **measuring.TEXTS,
            pressure=("1", "mean pressure without adhesion at the same mean gap over E* q0 h_rms"),
            range_over_h_rms=VARIABLES["range_over_h_rms"],
            adhesion_length_over_range=VARIABLES["adhesion_length_over_range"],
            seconds=("s", "processor time of an adhesive state", missing),
        ),
        job.output[0],
        title="full adhesion of the same realisations with various settings",
        parameters={**surface, "q0_h_rms": adhesion["q0_h_rms"]},
    )


def solve(heights, length, adhesion, setting):
    """Solve one realisation with one setting at every load and point; NaN if a window closes."""
    tolerance = setting["tolerance"]
    loads, points = np.array(adhesion["pressures"]), np.array(adhesion["points"])
    shape = len(loads), len(points)
    values = {name: np.full(shape, np.nan) for name in (*STATE_TEXTS, *ALONE_TEXTS, "seconds")}
    laws = [scaled_law(adhesion, adhesion["law"], strength, range_) for range_, strength in points]
    for i, contact in enumerate(solver.load_path(heights, length, loads, tol=tolerance)):
        values["area_alone"][i] = contact.area_fraction
        for k, law in enumerate(laws):
            attraction = dmt.adhesive_pressure(contact.gap, law)
            values["attraction_dmt"][i, k] = attraction
            if attraction > STRONGEST * contact.mean_pressure:
                continue
            (state, _), values["seconds"][i, k] = measuring.time_task(
                lambda law=law, contact=contact: solve_at_gap(
                    heights, length, law, contact, tolerance
                )
            )
            for name in STATE_TEXTS:
                values[name][i, k] = state[name]
    return xr.Dataset(
        {name: (("pressure", "point"), value) for name, value in values.items()},
        coords={
            "pressure": loads,
            "range_over_h_rms": ("point", points[:, 0]),
            "adhesion_length_over_range": ("point", points[:, 1]),
        },
    )


if __name__ == "__main__":
    main(start(globals(), "measure_adhesive", trade_case="H0.8_zeta16"))
