"""Full adhesion on the same realisations with every grid, tolerance and law, and time each state.

A few realisations are solved with every setting, more on the usual grid and coarser ones alone:
those say how the quantities scatter, and what the DMT limit on the coarsest grid leaves of it as
their control.
"""

import logging

import numpy as np
import xarray as xr

from pipeline.adhesion_sets import STRONGEST, scaled_law, solve_at_gap
from pipeline.conventions import VARIABLES, cell_size, grid_points, model_spectrum
from pipeline.job import start
from pipeline.tradeoff.measuring import KEYS, pair_seconds, peak_megabytes, timed
from stickiness.adhesion import dmt
from stickiness.contact import solver
from stickiness.core import datasets
from stickiness.surfaces import synthesis

FINEST_TOLERANCE = 1e-10  # of what other tolerances are held against
KEPT = {
    "external_pressure": "mean pressure over E* q0 h_rms",
    "repulsive_area": "area at a gap of zero over nominal area, by pixels",
    "iterations": "iterations of conjugate gradients",
}
ALONE = {
    "attraction_dmt": "attraction over the gaps without adhesion over E* q0 h_rms",
    "area_alone": "contact area without adhesion over nominal area, by pixels",
}


def main(job):
    asked, wanted = job.params.case, job.params.adhesion
    grids = [p for p in sorted(wanted["pixels"]) if grid_points(asked, p) <= wanted["most_points"]]
    chosen = settings(wanted, grids)
    finest = max(setting["pixels"] for setting in chosen)
    length, n = cell_size(asked), grid_points(asked, finest)
    seeds, rows, few = np.arange(1, wanted["more_seeds"] + 1), [], wanted["seeds"]
    usual = 1 + grids.index(wanted["at_pixels"])
    for seed in seeds:
        heights = synthesis.synthesise(model_spectrum(asked), n, length, int(seed))
        most = len(chosen) if seed <= few else usual
        parts = [solved(heights, length, wanted, finest, **s) for s in chosen[:most]]
        rows.append(xr.concat(parts, xr.DataArray(np.arange(most), dims="setting", name="setting")))
        logging.info("seed %d", seed)
    dataset = xr.concat(
        rows, xr.DataArray(seeds, dims="seed", name="seed"), join="outer"
    ).drop_vars("setting")
    one = wanted | {"pressures": wanted["pressures"][-1:], "points": wanted["points"][-1:]}
    dataset["memory"] = (
        "setting",
        [peak_megabytes(lambda s=s: solved(heights, length, one, finest, **s)) for s in chosen],
    )
    for key in (*KEYS, "law"):
        dataset[key] = "setting", [setting[key] for setting in chosen]
    datasets.write(
        annotated(dataset.assign(pair_time=pair_seconds())),
        job.output[0],
        title="full adhesion of the same realisations with various settings",
        parameters={**asked, "q0_h_rms": wanted["q0_h_rms"]},
    )


def settings(wanted, grids):
    """Every setting to solve with, grids first: one knob varied, the others at a fixed value."""
    pixels, tolerance, law = wanted["at_pixels"], wanted["at_tolerance"], wanted["law"]
    usual = {"knob": "pixels", "pixels": pixels, "tolerance": tolerance, "law": law}
    return [
        *(usual | {"pixels": points} for points in grids),
        *(
            usual | {"knob": "tolerance", "tolerance": value}
            for value in (*wanted["tolerances"], FINEST_TOLERANCE)
        ),
        *(usual | {"knob": "law", "law": other} for other in wanted["other_laws"]),
    ]


def solved(heights, length, wanted, finest, knob, pixels, tolerance, law):
    """States of one realisation with one setting at every load and point; NaN if one closes."""
    step = finest // pixels
    sampled = np.ascontiguousarray(heights[::step, ::step])
    loads, points = np.array(wanted["pressures"]), np.array(wanted["points"])
    shape = len(loads), len(points)
    values = {name: np.full(shape, np.nan) for name in (*KEPT, *ALONE, "seconds")}
    path = solver.load_path(sampled, length, loads, tol=tolerance)
    for i, contact in enumerate(path):
        values["area_alone"][i] = contact.area_fraction
        for k, (reach, strength) in enumerate(points):
            attracts = scaled_law(wanted, law, strength, reach)
            attraction = dmt.adhesive_pressure(contact.gap, attracts)
            values["attraction_dmt"][i, k] = attraction
            if attraction <= STRONGEST * contact.mean_pressure:
                state, values["seconds"][i, k] = timed(
                    lambda law=attracts, alone=contact: solve_at_gap(
                        sampled, length, law, alone, tolerance
                    )
                )
                for name in KEPT:
                    values[name][i, k] = state[name]
    reach, strength = points.T
    return xr.Dataset(
        {name: (("pressure", "point"), value) for name, value in values.items()},
        coords={
            "pressure": loads,
            "range_over_h_rms": ("point", reach),
            "adhesion_length_over_range": ("point", strength),
        },
    )


def annotated(dataset):
    missing = "a window closes, or not solved with this setting"
    texts = {name: ("1", text, missing) for name, text in {**KEPT, **ALONE}.items()}
    return datasets.annotate(
        dataset,
        **texts,
        **{key: ("1", text) for key, text in KEYS.items()},
        pressure=("1", "mean pressure without adhesion at the same mean gap over E* q0 h_rms"),
        range_over_h_rms=VARIABLES["range_over_h_rms"],
        adhesion_length_over_range=VARIABLES["adhesion_length_over_range"],
        law=("1", "law of traction"),
        seed=("1", "seed of the realisation"),
        seconds=("s", "processor time of an adhesive state", missing),
        pair_time=("s", "processor time of a pair of transforms of 1024 x 1024 doubles"),
        memory=("MB", "largest memory held at once at the largest load and last point"),
    )


if __name__ == "__main__":
    main(start(globals(), "measure_adhesive", trade_case="H0.8_zeta16"))
