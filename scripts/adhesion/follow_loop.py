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

CONTROLS = ("mean_gap", "pressure")
TOLERANCE = 1e-5  # of the residual: far below what the width of a line shows
# Relative, of pull-offs to this tolerance and to 1e-7 in the target tradeoff: 4e-5 to 4e-4 of six.
SOLVER = 5e-4
BALANCE = 0.01  # dissipation of a step over the energies of the curve: jumps are larger
STEPS = (2, 1)
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
VARIABLES = {
    n: ("1", text, "beyond the end of the curve") for n, text in (STATES | STEPPED).items()
}
VARIABLES |= {name: ("1", text) for name, text in QUOTED.items()}
VARIABLES |= {"control": "what is prescribed", "state": "number of the state along the curve"}


def main(job):
    surface = read_first(job.input.surfaces)
    loop = job.params.loop
    heights, length = surface.height.values, float(surface.window_length)
    lengths = np.sort(np.array(loop["adhesion_length_over_range"], dtype=float))
    finest, curves = pixels(surface), []
    for step, control, value in product(STEPS, CONTROLS, lengths):
        found = follow(heights[::step, ::step], length, loop, value, control)
        at = {"resolution": finest / step, "control": control, "adhesion_length_over_range": value}
        curves.append(found.expand_dims({name: [where] for name, where in at.items()}))
    longest = max((one.state for one in curves), key=len)
    dataset = xr.combine_by_coords([one.reindex(state=longest) for one in curves])
    title = "approach and separation of one realisation with adhesion"
    parameters = {**datasets.parameters(surface), **loop}
    datasets.write(add_quoted(dataset), job.output[0], title=title, parameters=parameters)


def follow(heights, length, loop, adhesion_length_over_range, control):
    """States from afar to the largest pressure and back, along `state`."""
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
    """Add what is quoted of the curves, on the fine grid, with its errors."""
    press, gap = (dataset.sel(control=control, drop=True) for control in CONTROLS[::-1])
    last = press.isel(state=press.mean_pressure.count("state") - 1)
    quoted = {
        "pull_off_pressure": last.mean_pressure,
        "pull_off_area": last.repulsive_area_fraction,
        "lost_share": gap.dissipated.sum("state") / gap.work.where(gap.work > 0).sum("state"),
    }
    coarse, fine = (
        xr.Dataset(quoted).drop_vars("state").isel(resolution=grid, drop=True) for grid in (0, -1)
    )
    dataset = add_convergence(annotate(dataset.assign(fine), **VARIABLES), TOLERANCE)
    for name in QUOTED:
        change, solver = fine[name] - coarse[name], SOLVER * fine[name]
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
    main(start(globals(), "follow_loop", loop="fig4a"))
