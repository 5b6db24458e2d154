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


def list_states(measured):
    """List 1/kappa_ad at every point, and the threshold of all points together."""
    measured = measured.where(measured.external_pressure.notnull())
    for k in range(measured.sizes["point"]):
        states = measured.isel(point=k, drop=True)
        point = measured[["range_over_h_rms", "adhesion_length_over_range"]].isel(point=k)

        # 1/kappa_ad is half the share by which adhesion lowers the load over the area.
        load_over_area = states.external_pressure / states.repulsive_area
        left_share = load_over_area * states.area_alone / states.pressure
        quantity = xr.Dataset(
            {
                "full": (1 - left_share) / 2,
                "limit": states.attraction_dmt / states.pressure / 2,
                "seconds": states.seconds,
            }
        )

        # Of each range the weakest adhesion is modelled, which has the largest error.
        same_range = measured.range_over_h_rms == point.range_over_h_rms
        weakest = measured.adhesion_length_over_range.where(same_range).min()
        modelled = bool(point.adhesion_length_over_range == weakest)
        yield f"inverse_kappa_ad_{float(point.range_over_h_rms):g}", quantity, modelled

    threshold = xr.Dataset(
        {
            "full": find_threshold(measured.external_pressure),
            "limit": find_threshold(measured.pressure - measured.attraction_dmt),
            "seconds": measured.seconds.mean("point"),
        }
    )
    yield "threshold", threshold, True


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
        finite = np.isfinite(values)
        falling = -values[finite]
        log_lengths = logs[finite]
        if len(log_lengths) < 2 or falling[0] > 0 or falling[-1] < 0:
            return np.nan
        return np.exp(np.interp(0.0, falling, log_lengths))

    return xr.apply_ufunc(crossing, chosen, input_core_dims=[["point"]], vectorize=True)


def tabulate_adhesion(measured, records):
    """Add rows of every setting, the DMT sum and numbers of seeds, and points."""
    parameters = datasets.parameters(measured)
    unit = float(measured.pair_time)
    measured = measured.set_index(solution=list(SETTINGS)).unstack("solution")
    usual = {"pixels": parameters["at_pixels"], "tolerance": parameters["tolerance"]}
    of_states = records.problem == "adhesion"
    quantities = list_states(measured) if of_states else list_pull_offs(measured)
    for name, quantity, modelled in quantities:
        quantity = drop_open_loads(quantity, usual)
        if quantity.sizes["pressure"]:
            for knob in usual:
                tabulate_setting(name, quantity, modelled, knob, usual, unit, records)
        # The DMT sum costs nothing once the contact without adhesion is solved.
        error = quantity.limit.sel(usual) / quantity.full.sel(usual) - 1
        records.add("model", "DMT", split_loads(name, error), 0.0)
        if of_states:
            tabulate_seeds(name, quantity, modelled, usual, unit, records)
    if of_states:
        for pixels in measured.pixels.values[measured.pixels.values != COARSE]:
            cost = float(measured.seconds.sel(usual | {"pixels": pixels}).mean()) / unit
            records.add_point("adhesive_cost", "", cost, pixels=pixels)


def drop_open_loads(quantity, usual):
    """Leave out the loads at which a window closes with some grid or tolerance."""
    for knob in usual:
        along = usual | {knob: quantity[knob]}
        solved = quantity.full.sel(along).notnull().any("seed").all(knob)
        quantity = quantity.sel(pressure=solved.values)
    return quantity


def tabulate_setting(name, quantity, modelled, knob, usual, unit, records):
    """Add rows and points of every grid or tolerance (`knob`), the other one as usual."""
    finest = quantity.pixels.max() if knob == "pixels" else quantity.tolerance.min()
    along = usual | {knob: quantity[knob]}
    errors = quantity.full.sel(along) / quantity.full.sel(usual | {knob: finest}) - 1
    costs = quantity.seconds.sel(along).mean("seed").mean("pressure") / unit
    label = "points per wavelength" if knob == "pixels" else knob
    for value in quantity[knob].drop_sel({knob: finest}).values:
        error = errors.sel({knob: value})
        records.add(label, f"{value:g}", split_loads(name, error), costs.sel({knob: value}))
        if modelled and value != COARSE:
            add_points(name, knob, value, error, records)


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
        size = off.mean()
        noise = off.std(ddof=1) / np.sqrt(off.size)
        if name == "pull_off":  # of one surface; all others are means
            size = np.sqrt(np.mean(off**2))
            noise = 0.0
        records.add_point("discretisation", name, size, noise, pressure=load, pixels=value)


def tabulate_seeds(name, quantity, modelled, usual, unit, records):
    """Add means, plain and with the DMT sum of the coarsest grid as control variate."""
    twin = quantity.limit.sel(usual | {"pixels": quantity.pixels.min()})
    scatter, share = measure_scatter(quantity.full.sel(usual), twin)
    seconds = quantity.seconds.sel(usual).mean("seed")
    means = (4, 8, 16, 32)  # seeds that rows are given for
    for load in quantity.pressure.values:
        spread = float(scatter.sel(pressure=load))
        left = float(share.sel(pressure=load))
        cost = float(seconds.sel(pressure=load))
        if not np.isfinite(spread * left):
            continue
        if modelled:
            records.add_point("scatter", name, spread, pressure=load)
            records.add_point("fine_share", name, left, pressure=load)
        for seeds in means:
            for kind, rest in (("plain", 1.0), ("controlled", left)):
                error = {(name, load): COVERS * spread * rest / np.sqrt(seeds)}
                records.add("seeds", f"{seeds} {kind}", error, seeds * cost / unit)


def measure_scatter(full, twin):
    """Standard deviation of single surfaces over the mean, and the share a control leaves of it."""
    # The control's coefficient is a slope over the seeds, which costs two degrees of freedom. NaN
    # where a window closes with any seed.
    off = full - full.mean("seed", skipna=False)
    of_twin = twin - twin.mean("seed", skipna=False)
    slope = (off * of_twin).sum("seed", skipna=False) / (of_twin**2).sum("seed", skipna=False)
    count = full.sizes["seed"]
    left = np.sqrt(((off - slope * of_twin) ** 2).sum("seed", skipna=False) / (count - 2))
    whole = full.std("seed", ddof=1, skipna=False)
    return whole / abs(full.mean("seed", skipna=False)), np.minimum(left / whole, 1.0)
