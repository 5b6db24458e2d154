"""Rows of the table and points of the error models for full adhesion and the pull-off.

A quantity is a dataset along settings, seed and pressure: `full` adhesion, the DMT `limit`, and the
processor time in `seconds` of full adhesion. Error models are fitted if it is `modelled`.
"""

import numpy as np
import xarray as xr

from stickiness import datasets
from stickiness.accuracy.error_models import COARSE
from stickiness.statistics import COVERS
from tradeoff.measuring import COVERED, SETTINGS, split_loads

MEANS = (4, 8, 16, 32)  # seeds that rows are given for


def list_states(measured):
    """List 1/kappa_ad at every point, and the threshold of all points together."""
    measured = measured.where(measured.external_pressure.notnull())
    for k in range(measured.sizes["point"]):
        one = measured.isel(point=k, drop=True)
        at = measured[["range_over_h_rms", "adhesion_length_over_range"]].isel(point=k)
        same_range = measured.range_over_h_rms == at.range_over_h_rms
        weakest = measured.adhesion_length_over_range.where(same_range).min()
        fall = one.external_pressure / one.repulsive_area * one.area_alone / one.pressure
        limit = one.attraction_dmt / one.pressure / 2
        found = xr.Dataset({"full": (1 - fall) / 2, "limit": limit, "seconds": one.seconds})
        # Of each range the weakest adhesion is modelled, which has the largest error.
        modelled = bool(at.adhesion_length_over_range == weakest)
        yield f"inverse_kappa_ad_{float(at.range_over_h_rms):g}", found, modelled
    left = measured.pressure - measured.attraction_dmt
    found = {"full": find_threshold(measured.external_pressure), "limit": find_threshold(left)}
    yield "threshold", xr.Dataset(found | {"seconds": measured.seconds.mean("point")}), True


def list_pull_offs(measured):
    """List the pull-off at every point, from the load at which separation starts."""
    measured = measured.expand_dims(pressure=[datasets.parameters(measured)["pressure"]])
    names = {"pull_off": "full", "pull_off_dmt": "limit", "seconds": "seconds"}
    for k in range(measured.sizes["point"]):
        yield "pull_off", measured[list(names)].rename(names).isel(point=k, drop=True), True


def find_threshold(external):
    """Find l_a/range at which an external pressure vanishes, NaN if it does so nowhere."""
    # Between the adhesion lengths of the range that has the most of them, along their logarithm.
    ranges, counts = np.unique(external.range_over_h_rms, return_counts=True)
    chosen = external.isel(point=(external.range_over_h_rms == ranges[counts.argmax()]).values)
    chosen = chosen.sortby("adhesion_length_over_range")
    logs = np.log(chosen.adhesion_length_over_range.values)

    def crossing(values):
        known = np.isfinite(values)
        falling, at = -values[known], logs[known]
        if len(at) < 2 or falling[0] > 0 or falling[-1] < 0:
            return np.nan
        return np.exp(np.interp(0.0, falling, at))

    return xr.apply_ufunc(crossing, chosen, input_core_dims=[["point"]], vectorize=True)


def tabulate_adhesion(measured, records):
    """Add rows of every setting, the DMT sum and numbers of seeds, and points."""
    made, unit = datasets.parameters(measured), float(measured.pair_time)
    measured = measured.set_index(solution=list(SETTINGS)).unstack("solution")
    usual = {"pixels": made["at_pixels"], "tolerance": made["tolerance"]}
    axes = {knob: usual | {knob: measured[knob]} for knob in usual}
    finest = {"pixels": measured.pixels.max(), "tolerance": measured.tolerance.min()}
    of_states = records.problem == "adhesion"
    for name, one, modelled in (list_states if of_states else list_pull_offs)(measured):
        # Without loads at which a window closes with some setting.
        for knob, along in axes.items():
            one = one.sel(pressure=one.full.sel(along).notnull().any("seed").all(knob).values)
        for knob, along in axes.items() if one.sizes["pressure"] else ():
            errors = one.full.sel(along) / one.full.sel(usual | {knob: finest[knob]}) - 1
            costs = one.seconds.sel(along).mean("seed").mean("pressure") / unit
            label = "points per wavelength" if knob == "pixels" else knob
            for value in measured[knob].drop_sel({knob: finest[knob]}).values:
                error, cost = errors.sel({knob: value}), costs.sel({knob: value})
                records.add(label, f"{value:g}", split_loads(name, error), cost)
                if modelled and value != COARSE:
                    add_points(name, knob, value, error, records)
        # The DMT sum costs nothing once the contact without adhesion is solved.
        error = one.limit.sel(usual) / one.full.sel(usual) - 1
        records.add("model", "DMT", split_loads(name, error), 0.0)
        if of_states:
            tabulate_seeds(name, one, modelled, usual, unit, records)
    for pixels in measured.pixels.values[measured.pixels.values != COARSE] if of_states else ():
        cost = float(measured.seconds.sel(usual | {"pixels": pixels}).mean()) / unit
        records.add_point("adhesive_cost", "", cost, pixels=pixels)


def add_points(name, knob, value, error, records):
    """Add points of one setting, from its errors along seeds and loads."""
    if knob == "tolerance":
        # Next to nothing changes but where a pixel turns: all loads and seeds together.
        records.add_point("solver", name, abs(error).quantile(COVERED), tolerance=value)
        return
    for load in error.pressure.values:
        off = error.sel(pressure=load).dropna("seed").values
        if not off.size:
            continue
        size, noise = off.mean(), off.std(ddof=1) / np.sqrt(off.size)
        if name == "pull_off":  # of one surface; all others are means
            size, noise = np.sqrt(np.mean(off**2)), 0.0
        records.add_point("discretisation", name, size, noise, pressure=load, pixels=value)


def tabulate_seeds(name, one, modelled, usual, unit, records):
    """Add means, plain and with the DMT sum of the coarsest grid as control variate."""
    twin = one.limit.sel(usual | {"pixels": one.pixels.min()})
    scatter, share = measure_scatter(one.full.sel(usual), twin)
    seconds = one.seconds.sel(usual).mean("seed")
    for load in one.pressure.values:
        spread, left, cost = (float(x.sel(pressure=load)) for x in (scatter, share, seconds))
        if not np.isfinite(spread * left):
            continue
        if modelled:
            records.add_point("scatter", name, spread, pressure=load)
            records.add_point("fine_share", name, left, pressure=load)
        for seeds in MEANS:
            for kind, rest in (("plain", 1.0), ("controlled", left)):
                error = {(name, load): COVERS * spread * rest / np.sqrt(seeds)}
                records.add("seeds", f"{seeds} {kind}", error, seeds * cost / unit)


def measure_scatter(full, twin):
    """Standard deviation of single surfaces over the mean, and the share a control leaves of it."""
    # The control's coefficient is a slope over the seeds, which costs two degrees of freedom. NaN
    # where a window closes with any seed.
    off, of_twin = (x - x.mean("seed", skipna=False) for x in (full, twin))
    slope = (off * of_twin).sum("seed", skipna=False) / (of_twin**2).sum("seed", skipna=False)
    count = full.sizes["seed"]
    left = np.sqrt(((off - slope * of_twin) ** 2).sum("seed", skipna=False) / (count - 2))
    whole = full.std("seed", ddof=1, skipna=False)
    return whole / abs(full.mean("seed", skipna=False)), np.minimum(left / whole, 1.0)
