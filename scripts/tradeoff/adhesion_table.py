"""Rows of the table and points of the error models for full adhesion and the pull-off."""

from dataclasses import dataclass, replace

import numpy as np
import xarray as xr

from stickiness import datasets
from stickiness.accuracy.error_models import COARSE
from stickiness.statistics import COVERS
from tradeoff.measuring import COVERED, SETTINGS

MEANS = (4, 8, 16, 32)  # seeds that rows are given for


@dataclass(frozen=True)
class Measured:
    """A quantity of full adhesion along settings, seed and pressure, and in the DMT limit."""

    name: str
    full: xr.DataArray
    limit: xr.DataArray
    seconds: xr.DataArray  # processor time of full adhesion
    modelled: bool = True  # whether an error model is fitted to it


def list_states(measured):
    """List 1/kappa_ad at every point, and the threshold of all points together."""
    measured = measured.where(measured.external_pressure.notnull())
    for k in range(measured.sizes["point"]):
        one = measured.isel(point=k)
        same_range = measured.range_over_h_rms == one.range_over_h_rms
        weakest = measured.adhesion_length_over_range.where(same_range).min()
        # Of each range the weakest adhesion is modelled, which has the largest error.
        fall = one.external_pressure / one.repulsive_area * one.area_alone / one.pressure
        yield Measured(
            f"inverse_kappa_ad_{float(one.range_over_h_rms):g}",
            (1 - fall) / 2,
            one.attraction_dmt / one.pressure / 2,
            one.seconds,
            bool(one.adhesion_length_over_range == weakest),
        )
    left = measured.pressure - measured.attraction_dmt
    thresholds = (find_threshold(x) for x in (measured.external_pressure, left))
    yield Measured("threshold", *thresholds, measured.seconds.mean("point"))


def list_pull_offs(measured):
    """List the pull-off at every point, from the load at which separation starts."""
    measured = measured.expand_dims(pressure=[datasets.parameters(measured)["pressure"]])
    for k in range(measured.sizes["point"]):
        one = measured.isel(point=k)
        yield Measured("pull_off", one.pull_off, one.pull_off_dmt, one.seconds)


def find_threshold(external):
    """Find l_a/range at which an external pressure vanishes, NaN if it does so nowhere."""
    # Between the adhesion lengths of the range that has the most of them, along their logarithm.
    ranges, counts = np.unique(external.range_over_h_rms, return_counts=True)
    chosen = external.isel(
        point=np.flatnonzero(external.range_over_h_rms == ranges[counts.argmax()])
    ).sortby("adhesion_length_over_range")
    logs = np.log(chosen.adhesion_length_over_range.values)

    def crossing(values):
        known = np.isfinite(values)
        falling, at = -values[known], logs[known]
        if len(at) < 2 or falling[0] > 0 or falling[-1] < 0:
            return np.nan
        return np.exp(np.interp(0.0, falling, at))

    return xr.apply_ufunc(crossing, chosen, input_core_dims=[["point"]], vectorize=True)


def tabulate_adhesion(measured, list_quantities, records):
    """Add rows of every setting, the DMT limit and numbers of seeds, and points."""
    made, unit = datasets.parameters(measured), float(measured.pair_time)
    measured = measured.set_index(solution=list(SETTINGS)).unstack("solution")
    usual = {"pixels": made["at_pixels"], "tolerance": made["tolerance"]}
    axes = {knob: usual | {knob: measured[knob]} for knob in usual}
    finest = {"pixels": measured.pixels.max(), "tolerance": measured.tolerance.min()}
    for one in list_quantities(measured):
        # Without loads at which a window closes with some setting.
        opened = [
            one.full.sel(along).notnull().any("seed").all(knob) for knob, along in axes.items()
        ]
        loads = {"pressure": (opened[0] & opened[1]).values}
        full, limit, seconds = (x.sel(loads) for x in (one.full, one.limit, one.seconds))
        one = replace(one, full=full, limit=limit, seconds=seconds)
        for knob, along in axes.items() if loads["pressure"].any() else ():
            errors = full.sel(along) / full.sel(usual | {knob: finest[knob]}) - 1
            costs = seconds.sel(along).mean("seed").mean("pressure") / unit
            for value in measured[knob].drop_sel({knob: finest[knob]}).values:
                tabulate_setting(one, knob, value, errors.sel({knob: value}), costs, records)
        # The DMT limit costs nothing once the contact without adhesion is solved.
        error = limit.sel(usual) / full.sel(usual) - 1
        records.add("model", "DMT", cover_seeds(one.name, error), 0.0)
        if records.problem == "adhesion":
            tabulate_seeds(one, usual, unit, records)
    if records.problem == "adhesion":
        for pixels in measured.pixels.values[measured.pixels.values != COARSE]:
            cost = float(measured.seconds.sel(usual | {"pixels": pixels}).mean()) / unit
            records.add_point("adhesive_cost", "", cost, pixels=pixels)


def tabulate_setting(one, knob, value, error, costs, records):
    """Add rows and points of one setting, from its errors along seeds and loads."""
    label = "points per wavelength" if knob == "pixels" else knob
    records.add(label, f"{value:g}", cover_seeds(one.name, error), costs.sel({knob: value}))
    if not one.modelled or value == COARSE:
        return
    if knob == "tolerance":
        # Next to nothing changes but where a pixel turns: all loads and seeds together.
        size = abs(error).quantile(COVERED)
        records.add_point("solver", one.name, size, tolerance=value)
        return
    for load in error.pressure.values:
        off = error.sel(pressure=load).dropna("seed").values
        if not off.size:
            continue
        size, noise = off.mean(), off.std(ddof=1) / np.sqrt(off.size)
        if one.name == "pull_off":  # of one surface; all others are means
            size, noise = np.sqrt(np.mean(off**2)), 0.0
        records.add_point("discretisation", one.name, size, noise, pressure=load, pixels=value)


def cover_seeds(quantity, error):
    """Error of single surfaces at every load that covers 90 %."""
    covering = abs(error).quantile(COVERED, "seed")
    return {(quantity, load): covering.sel(pressure=load) for load in error.pressure.values}


def tabulate_seeds(one, usual, unit, records):
    """Add means, plain and with the DMT limit of the coarsest grid as control variate."""
    twin = one.limit.sel(usual | {"pixels": one.limit.pixels.min()})
    scatter, share = measure_scatter(one.full.sel(usual), twin)
    seconds = one.seconds.sel(usual).mean("seed")
    for load in one.full.pressure.values:
        spread, left, cost = (float(x.sel(pressure=load)) for x in (scatter, share, seconds))
        if not np.isfinite(spread * left):
            continue
        if one.modelled:
            records.add_point("scatter", one.name, spread, pressure=load)
            records.add_point("fine_share", one.name, left, pressure=load)
        for seeds in MEANS:
            for kind, rest in (("plain", 1.0), ("controlled", left)):
                error = {(one.name, load): COVERS * spread * rest / np.sqrt(seeds)}
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
