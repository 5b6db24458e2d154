"""Claims on contact with adhesion: threshold of kappa, loop and 1/kappa_ad."""

import numpy as np
import xarray as xr

from claims import ledger
from claims.ledger import OPEN, QUALIFIED, Finding, choose, claim, describe_cell, grade
from common.paper import A_V_FIG4B, RANGE_2, at_load
from stickiness import criteria, datasets, error_budget

LENGTH = "adhesion_length_over_range"


@claim(5)
def kappa_threshold(adhesive_fig2, adhesion_fig2):
    """1/kappa vanishes at a finite adhesion length."""
    full = at_load(adhesive_fig2)
    solved = full.inverse_kappa.dropna("range_over_h_rms", how="all")
    solved = solved if solved.range_over_h_rms.size else full.inverse_kappa
    crossed = solved.range_over_h_rms.values[(solved < 0).any(LENGTH).values]
    range_ = [*crossed, solved.range_over_h_rms.values[-1]][0]
    at_range = full.sel(range_over_h_rms=range_)
    threshold, errors = find_zero(at_range, "inverse_kappa")
    crosses = bool(np.isfinite(threshold))
    fitted, fit_errors = find_zero(at_range, "inverse_kappa_fit")  # over all loads
    limit = at_load(adhesion_fig2).sel(range_over_h_rms=range_).isel({LENGTH: 0})
    in_maps = choose(full, range_over_h_rms=RANGE_2)
    return Finding(
        threshold if crosses else largest_simulated(at_range),
        QUALIFIED if crosses else OPEN,
        errors=errors,
        crosses=crosses,
        at=at_range,
        cell=describe_cell(full),
        dmt=limit[LENGTH] / (2 * limit.inverse_kappa_ad),
        lowest=at_range.inverse_kappa.min().fillna(0.5),
        fitted=(fitted, np.linalg.norm([*fit_errors.values()])),
        areas=list_areas(adhesive_fig2.sel(range_over_h_rms=range_)),
        in_maps=(in_maps.range_over_h_rms, largest_simulated(in_maps)),
    )


def list_areas(loads):
    """Threshold, area of contact there and load, for every load that has a threshold."""
    thresholds = []
    for load in loads.pressure.values:
        loaded = loads.sel(pressure=load).dropna(LENGTH, subset=["inverse_kappa"])
        threshold, _ = find_zero(loaded, "inverse_kappa")
        if np.isfinite(threshold):
            area = np.interp(np.log(threshold), np.log(loaded[LENGTH]), loaded.repulsive_area)
            thresholds.append((threshold, float(area), load))
    return thresholds


def find_zero(data, name):
    """Adhesion length over range at which a slope is zero, and its errors by source."""
    data = data.where(np.isfinite(data[name]), drop=True)
    log_length = np.log(data[LENGTH].values)
    value = data[name].values
    below = np.flatnonzero(value < 0)
    if not below.size or below[0] == 0:
        return np.nan, {}
    i = below[0]
    slope = (value[i] - value[i - 1]) / (log_length[i] - log_length[i - 1])
    zero = float(np.exp(log_length[i - 1] - value[i - 1] / slope))
    # The error is that of the less certain of the two simulated points beside it.
    beside = data.isel({LENGTH: slice(i - 1, i + 1)})
    worse = beside.isel({LENGTH: int(np.argmax(error_budget.total_error(beside, name).values))})
    sizes = ledger.errors_by_source(worse, name)
    return zero, {source: float(zero * size / abs(slope)) for source, size in sizes.items()}


def largest_simulated(data):
    """Largest adhesion length over range that was simulated at one range; 0 if none was."""
    return float(data[LENGTH].where(np.isfinite(data.inverse_kappa)).max().fillna(0))


@claim(10)
def hysteresis(loop):
    """Loading and unloading differ, and separation needs tension."""
    strong = loop.isel({LENGTH: -1})
    fine = loop.isel(resolution=-1).sel(control="pressure")
    weak = fine.isel({LENGTH: 0}).dropna("state")
    press = fine.isel({LENGTH: -1}).dropna("state")
    tension = float(strong.pull_off_pressure)
    last = press.isel(state=-1)
    error = float(error_budget.part(strong, "pull_off_pressure", "discretisation"))
    load = float(press.mean_pressure.max()) / 5
    loading = area_at(press, load, way=0)
    unloading = area_at(press, load, way=1)
    pulls = tension < -2 * error and float(last.net_repulsive_area_fraction) > 0
    return Finding(
        tension,
        grade(pulls and unloading > 1.05 * loading, pulls),
        errors={"discretisation": error, "sampling": np.nan},
        made=datasets.parameters(loop),
        cell=describe_cell(loop),
        last=last,
        load=load,
        loading=loading,
        unloading=unloading,
        lost=strong.lost_share,
        jumps=int(strong.isel(resolution=-1).sel(control="mean_gap").jumped.sum()),
        weak=weak.isel(state=-1),
    )


def area_at(curve, load, way):
    """Repulsive area at a load, on approach (`way` 0) or separation (1)."""
    leg = curve.where(curve.separating == way, drop=True).sortby("mean_pressure")
    return float(np.interp(load, leg.mean_pressure, leg.repulsive_area_fraction))


@claim(11)
def inverse_kappa_ad(adhesive_sets, adhesion_sets, fit_bem_middle_band, fit_bem_broad_band):
    """1/kappa_ad follows the formula of the criterion."""
    sets = map(list_points, adhesive_sets, adhesion_sets)
    points = xr.concat(sets, "point", data_vars="all")
    over = {name: (points[name] / points.formula).values for name in points}
    slopes = over["inverse_kappa_ad"]
    largest_error = 0.3  # over the formula, of points that are compared with it
    load = float(at_load(adhesive_sets[0]).pressure)
    certain = (over["inverse_kappa_ad_total_error"] < largest_error) & (slopes > 0)
    if not certain.any():
        return Finding(np.nan, OPEN, claimed=1.0, load=load, known=0)
    slopes = slopes[certain]
    net = over["inverse_kappa_ad_net"]
    net = net[(over["inverse_kappa_ad_net_total_error"] < largest_error) & (net > 0)]
    apart = np.abs(np.log(np.concatenate([slopes, net]))).max()
    direct = points.inverse_kappa_ad_direct.values
    resolved = np.isfinite(direct)
    fits = [at_load(fit).isel(window=0) for fit in (fit_bem_middle_band, fit_bem_broad_band)]
    return Finding(
        np.exp(np.mean(np.log(slopes))),
        grade(apart < np.log(1.25), apart < np.log(4)),
        claimed=1.0,
        errors={source: float(np.mean(over[source][certain])) for source in error_budget.SOURCES},
        load=load,
        known=slopes.size,
        parameter_sets=sum(full.sizes["range_over_h_rms"] for full in adhesive_sets),
        slopes=find_ends(slopes),
        net=find_ends(net),
        limit=find_ends(over["limit"][certain]),
        dmt_points=int(points.dmt.values[certain].sum()),
        decades=np.ptp(np.log10(direct[resolved])),
        direct=find_ends(over["inverse_kappa_ad_direct"][resolved]),
        a_v=[ledger.value_and_error(fit, "a_v_mean") for fit in fits],
        factors=[A_V_FIG4B / float(fit.a_v_mean) for fit in fits],
    )


def find_ends(values):
    """Smallest and largest value, and their number; None if there is none."""
    return (values.min(), values.max(), values.size) if values.size else None


def list_points(full, limit):
    """Points of one set of the full simulation, with the formula, the DMT sum and the errors."""
    full = at_load(full)
    limit = at_load(limit)
    q0_h_rms = float(full.q0_h_rms)
    range_ = (full.range_over_h_rms * full.q0_h_rms).values
    length = (full[LENGTH] * full.range_over_h_rms * full.q0_h_rms).values
    formula = criteria.inverse_kappa_ad(q0_h_rms, 1.0, length, range_, A_V_FIG4B)
    names = ["inverse_kappa_ad", "inverse_kappa_ad_net"]
    names += [f"{name}_total_error" for name in names] + ["inverse_kappa_ad_direct"]
    errors = {s: error_budget.part(full, names[0], s) for s in error_budget.SOURCES}
    others = {"limit": limit.inverse_kappa_ad, "dmt": full.model == "dmt"}
    points = full[names].assign(formula=full[names[0]] * 0 + formula, **errors, **others)
    return points.stack(point=full[names[0]].dims, create_index=False).drop_vars(points.coords)
