"""Full adhesion on the same realisations with every grid, tolerance and law, and time each state.

A few realisations are solved with every setting, more on the usual grid and coarser ones alone:
those tell how the quantities scatter, and how much of it the DMT limit on the coarsest grid, their
control variate, leaves.
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
    "iterations": "iterations of conjugate gradients",
}
ALONE_TEXTS = {
    "attraction_dmt": "attraction over the gaps without adhesion over E* q0 h_rms",
    "area_alone": "contact area without adhesion over nominal area, by pixels",
}


def main(job):
    surface, adhesion = job.params.case, job.params.adhesion
    most = adhesion["most_points"]
    grids = [p for p in sorted(adhesion["pixels"]) if grid_points(surface, p) <= most]
    settings = list_settings(adhesion, grids)
    finest = max(setting["pixels"] for setting in settings)
    length, n = cell_size(surface), grid_points(surface, finest)
    usual = 1 + grids.index(adhesion["at_pixels"])
    seeds, rows = np.arange(1, adhesion["more_seeds"] + 1), []
    for seed in seeds:
        heights = synthesis.synthesise(model_spectrum(surface), n, length, int(seed))
        chosen = settings if seed <= adhesion["seeds"] else settings[:usual]
        parts = [solve(heights, length, adhesion, finest, **s) for s in chosen]
        rows.append(measuring.stack(parts, "setting", np.arange(len(parts))))
        logging.info("seed %d", seed)
    dataset = measuring.stack(rows, "seed", seeds, join="outer").drop_vars("setting")
    one = adhesion | {"pressures": adhesion["pressures"][-1:], "points": adhesion["points"][-1:]}
    memory = [
        measuring.measure_memory(lambda s=s: solve(heights, length, one, finest, **s))
        for s in settings
    ]
    dataset["memory"] = "setting", memory
    for key in (*measuring.SETTING_TEXTS, "law"):
        dataset[key] = "setting", [setting[key] for setting in settings]
    datasets.write(
        annotate(dataset.assign(pair_time=measuring.time_transforms())),
        job.output[0],
        title="full adhesion of the same realisations with various settings",
        parameters={**surface, "q0_h_rms": adhesion["q0_h_rms"]},
    )


def list_settings(adhesion, grids):
    """List every setting to solve with, grids first: one knob varied, the others fixed."""
    pixels, tolerance, law = (adhesion[key] for key in ("at_pixels", "at_tolerance", "law"))
    usual = {"knob": "pixels", "pixels": pixels, "tolerance": tolerance, "law": law}
    return [
        *(usual | {"pixels": points} for points in grids),
        *(
            usual | {"knob": "tolerance", "tolerance": value}
            for value in (*adhesion["tolerances"], FINEST_TOLERANCE)
        ),
        *(usual | {"knob": "law", "law": other} for other in adhesion["other_laws"]),
    ]


def solve(heights, length, adhesion, finest, knob, pixels, tolerance, law):
    """Solve one realisation with one setting at every load and point; NaN if a window closes."""
    sampled = measuring.sample(heights, finest // pixels)
    loads, points = np.array(adhesion["pressures"]), np.array(adhesion["points"])
    shape = len(loads), len(points)
    values = {name: np.full(shape, np.nan) for name in (*STATE_TEXTS, *ALONE_TEXTS, "seconds")}
    laws = [scaled_law(adhesion, law, strength, range_) for range_, strength in points]
    for i, contact in enumerate(solver.load_path(sampled, length, loads, tol=tolerance)):
        values["area_alone"][i] = contact.area_fraction
        for k, traction in enumerate(laws):
            attraction = dmt.adhesive_pressure(contact.gap, traction)
            values["attraction_dmt"][i, k] = attraction
            if attraction > STRONGEST * contact.mean_pressure:
                continue
            (state, _), values["seconds"][i, k] = measuring.time_task(
                lambda law=traction, alone=contact: solve_at_gap(
                    sampled, length, law, alone, tolerance
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


def annotate(dataset):
    missing = "a window closes, or not solved with this setting"
    texts = {name: ("1", text, missing) for name, text in {**STATE_TEXTS, **ALONE_TEXTS}.items()}
    return datasets.annotate(
        dataset,
        **texts,
        **measuring.SETTING_TEXTS,
        **measuring.SHARED_TEXTS,
        pressure=("1", "mean pressure without adhesion at the same mean gap over E* q0 h_rms"),
        range_over_h_rms=VARIABLES["range_over_h_rms"],
        adhesion_length_over_range=VARIABLES["adhesion_length_over_range"],
        law=("1", "law of traction"),
        seconds=("s", "processor time of an adhesive state", missing),
        memory=("MB", "largest memory held at once at the largest load and last point"),
    )


if __name__ == "__main__":
    main(start(globals(), "measure_adhesive", trade_case="H0.8_zeta16"))
