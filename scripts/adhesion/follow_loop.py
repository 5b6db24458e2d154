"""Approach and separation of one realisation with adhesion, at a given mean gap and under a press.

At a given mean gap the curve is followed through its turns; under a press, at a given mean
pressure, it jumps where they are, and ends with the pull-off. Both on the grid of the realisation
and on every second point of it, which shows what of it is the grid's.
"""

import logging
import warnings
from itertools import product

import numpy as np
import pandas as pd
import xarray as xr

from common.adhesion_sets import ATTRIBUTES, LEAST, STATE, scaled_law
from common.conventions import add_convergence, annotate
from common.error_budgets import SIMULATED
from common.job import start
from common.model_surfaces import pixels, read_first
from stickiness import adhesive, datasets
from stickiness.error_budget import ErrorComponent, unknown_error, with_budget
from stickiness.plausibility import PlausibilityWarning
from stickiness.repulsive import solver

TOLERANCE = 1e-5  # of the residual: far below what the width of a line shows
# Relative, of pull-offs to this tolerance and to 1e-7 in the target tradeoff: 4e-5 to 4e-4 of six.
SOLVER = 5e-4
BALANCE = 0.01  # dissipation of a step over the energies of the curve: jumps are larger
MARGIN = 1.2  # ranges of attraction between the summit and the surface where the curve begins
NOT_KEPT = ("repulsive_pressure", "attraction")
STATES = {ATTRIBUTES.get(n, n): text for n, text in STATE.items() if n not in NOT_KEPT}
STATES["mean_gap"] = "mean gap over h_rms"
QUOTED = {
    "pull_off_pressure": "mean pressure over E* q0 h_rms at which a press lets go",
    "pull_off_area": "area at a gap of zero over nominal area at pull-off",
    "lost_share": "energy lost over the work done on the surfaces, at given mean gaps",
}
STEPPED = {
    "separating": "1 on the way back",
    "jumped": "1 where a jump led here",
    "work": "work of the control on the way from the state before, per nominal area",
    "dissipated": "energy lost on the way from the state before, per nominal area",
}
LOOP_VARIABLES = {
    n: ("1", text, "beyond the end of the curve") for n, text in (STATES | STEPPED).items()
}
LOOP_VARIABLES |= {name: ("1", text) for name, text in QUOTED.items()}
LOOP_VARIABLES |= {"control": "what is prescribed", "state": "number of the state along the curve"}


def main(job):
    surface = read_first(job.input.surfaces)
    loop = job.params.loop
    heights = surface.height.values
    length = float(surface.window_length)
    lengths = np.sort(np.array(loop["adhesion_length_over_range"], dtype=float))
    finest = pixels(surface)
    curves = []
    # Every second point first: the finest grid is the last along `resolution`.
    for step, control, value in product((2, 1), ("mean_gap", "pressure"), lengths):
        curve = follow(heights[::step, ::step], length, loop, value, control)
        place = {
            "resolution": finest / step,
            "control": control,
            "adhesion_length_over_range": value,
        }
        curves.append(curve.expand_dims({name: [here] for name, here in place.items()}))
    longest = max((curve.state for curve in curves), key=len)
    dataset = xr.combine_by_coords([curve.reindex(state=longest) for curve in curves])
    title = "approach and separation of one realisation with adhesion"
    # Of both, `window` of the surface is meant.
    parameters = {**loop, **datasets.parameters(surface)}
    datasets.write(add_quoted(dataset), job.output[0], title=title, parameters=parameters)


def follow(heights, length, loop, adhesion_length_over_range, control):
    """Follow the states from afar to the largest pressure and back, along `state`."""
    law = scaled_law(loop, loop["law"], adhesion_length_over_range, loop["range_over_h_rms"])
    far = float(heights.max() - heights.mean()) + MARGIN * law.range
    nearest = solver.solve(heights, length, loop["pressure"], tol=TOLERANCE).mean_gap
    turns = {
        "mean_gap": (far, nearest, far),
        "pressure": (0.0, loop["pressure"], -2 * law.strength),
    }
    settings = {"tol": TOLERANCE, "balance": BALANCE, "smallest_jump": BALANCE, "steps": LEAST}
    rows = []
    with warnings.catch_warnings():
        # The half grid is coarse on purpose: what that changes is the error of the loop.
        warnings.simplefilter("ignore", PlausibilityWarning)
        for point in adhesive.path(heights, length, law, turns[control], control, **settings):
            state = point.state
            logging.info("%s: p %.4g, gap %.4g", state.branch, state.mean_pressure, state.mean_gap)
            if point.event != "pull-off":  # the last state that held is in the list already
                row = {name: getattr(state, name) for name in STATES}
                row["separating"] = float(state.branch == "separation")
                row["jumped"] = float(point.event in ("jump-in", "jump-out"))
                rows.append(row | {"work": point.work, "dissipated": point.dissipated})
    return pd.DataFrame(rows).rename_axis("state").to_xarray()


def add_quoted(dataset):
    """Add the pull-off and the lost share of energy, on the fine grid, with their errors."""
    press = dataset.sel(control="pressure", drop=True)
    gap = dataset.sel(control="mean_gap", drop=True)
    last = press.isel(state=press.mean_pressure.count("state") - 1)
    quoted = {
        "pull_off_pressure": last.mean_pressure,
        "pull_off_area": last.repulsive_area_fraction,
        "lost_share": gap.dissipated.sum("state") / gap.work.where(gap.work > 0).sum("state"),
    }
    quoted = xr.Dataset(quoted).drop_vars("state")
    coarse = quoted.isel(resolution=0, drop=True)
    fine = quoted.isel(resolution=-1, drop=True)
    dataset = add_convergence(annotate(dataset.assign(fine), **LOOP_VARIABLES), TOLERANCE)
    for name in QUOTED:
        change = fine[name] - coarse[name]
        solver = SOLVER * fine[name]
        dataset = with_budget(
            dataset,
            name,
            discretisation=ErrorComponent(change, "change from half the resolution"),
            solver=ErrorComponent(solver, "by the tolerance, as measured of pull-offs"),
            sampling=unknown_error("a single realisation"),
            **SIMULATED,
        )
    return dataset


if __name__ == "__main__":
    main(start(globals()))
