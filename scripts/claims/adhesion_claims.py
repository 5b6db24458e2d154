"""Claims on contact with adhesion: threshold of kappa, loop and 1/kappa_ad."""

import numpy as np
import xarray as xr

from claims.ledger import (
    OPEN,
    QUALIFIED,
    Finding,
    claim,
    describe_cell,
    errors_by_source,
    grade,
    value_and_error,
)
from common.conventions import LOAD, at_load
from stickiness import criteria, datasets, error_budget

PAPER_A_V = 2.8  # in the formula of Figure 4B
SETS = ("rough", "rough_near", "smooth")  # parameter sets of Figure 4B
LARGEST_ERROR = 0.3  # over the formula, of points that are compared with it


@claim(5, "adhesive_fig2", "adhesion_fig2")
def kappa_threshold(files):
    loads = files["adhesive_fig2"]
    full, limit = at_load(loads), at_load(files["adhesion_fig2"])
    solved = full.inverse_kappa.dropna("range_over_h_rms", how="all")
    solved = solved if solved.range_over_h_rms.size else full.inverse_kappa
    crossed = [
        r for r in solved.range_over_h_rms if float(solved.sel(range_over_h_rms=r).min()) < 0
    ]
    range_ = crossed[0] if crossed else solved.range_over_h_rms[-1]
    at = full.sel(range_over_h_rms=range_)
    threshold, errors = find_zero(at, "inverse_kappa")
    fitted, fit_errors = find_zero(at, "inverse_kappa_fit")  # over all loads
    crosses = bool(np.isfinite(threshold))
    weakest = limit.sel(range_over_h_rms=range_).isel(adhesion_length_over_range=0)
    smallest = full.isel(range_over_h_rms=0)
    return Finding(
        value=threshold if crosses else largest_simulated(at),
        verdict=QUALIFIED if crosses else OPEN,
        errors=errors,
        facts={
            "crosses": crosses,
            "pressure": at.pressure,
            "range": range_,
            "q0_h_rms": full.q0_h_rms,
            "cell": describe_cell(full),
            "dmt": weakest.adhesion_length_over_range / (2 * weakest.inverse_kappa_ad),
            "lowest": at.inverse_kappa.min().fillna(0.5),
            "fitted": (fitted, np.linalg.norm([*fit_errors.values()])),
            "half": describe_half(at) if crosses else None,
            "areas": list_areas(loads.sel(range_over_h_rms=float(range_))),
            "smallest": (smallest.range_over_h_rms, largest_simulated(smallest)),
        },
    )


def describe_half(data):
    """1/kappa of both definitions of the area, where about half of it is left."""
    nearest = abs(data.inverse_kappa - 0.25).argmin("adhesion_length_over_range")
    half = data.isel(adhesion_length_over_range=nearest)
    return {
        "length": half.adhesion_length_over_range,
        "whole": value_and_error(half, "inverse_kappa"),
        "net": value_and_error(half, "inverse_kappa_net"),
    }


def list_areas(loads):
    """Threshold, area of contact there and load, for every load that has a threshold."""
    found = []
    for load in loads.pressure.values:
        at = loads.sel(pressure=load).dropna("adhesion_length_over_range", subset=["inverse_kappa"])
        threshold, _ = find_zero(at, "inverse_kappa")
        if np.isfinite(threshold):
            lengths = np.log(at.adhesion_length_over_range)
            area = float(np.interp(np.log(threshold), lengths, at.repulsive_area))
            found.append((threshold, area, load))
    return found


def find_zero(data, name):
    """Adhesion length over range at which a slope is zero, and its errors by source."""
    data = data.where(np.isfinite(data[name]), drop=True)
    log_length = np.log(data.adhesion_length_over_range.values)
    value, error = data[name].values, error_budget.total_error(data, name).values
    below = np.flatnonzero(value < 0)
    if not below.size or below[0] == 0:
        return np.nan, {}
    i = below[0]
    slope = (value[i] - value[i - 1]) / (log_length[i] - log_length[i - 1])
    zero = float(np.exp(log_length[i - 1] - value[i - 1] / slope))
    # The error is that of the less certain of the two simulated points beside it.
    worse = data.isel(adhesion_length_over_range=i - 1 + int(np.argmax(error[i - 1 : i + 1])))
    sizes = errors_by_source(worse, name)
    return zero, {source: float(zero * size / abs(slope)) for source, size in sizes.items()}


def largest_simulated(data):
    """Largest adhesion length over range that was simulated at one range; 0 if none was."""
    length = data.adhesion_length_over_range.where(np.isfinite(data.inverse_kappa))
    return float(length.max().fillna(0))


@claim(10, "loop")
def hysteresis(files):
    coarse, loop = (files["loop"].isel(resolution=i) for i in (0, -1))
    strongest = loop.isel(adhesion_length_over_range=-1)
    error = abs(pull_off(coarse) - pull_off(loop))
    press, gap = strongest.sel(control="pressure"), strongest.sel(control="mean_gap")
    last = press.dropna("state").isel(state=-1)
    net = float(last.net_repulsive_area_fraction)
    tension = pull_off(loop)
    load = float(press.mean_pressure.max()) / 5
    loading, unloading = (area_at(press, load, way) for way in (0, 1))
    weak = loop.isel(adhesion_length_over_range=0).sel(control="pressure").dropna("state")
    made = datasets.parameters(loop)
    pulls = tension < -2 * error and net > 0
    return Finding(
        value=tension,
        verdict=grade(pulls and unloading > 1.05 * loading, pulls),
        errors={"discretisation": error, "sampling": np.nan},
        facts={
            "range": made["range_over_h_rms"],
            "length": strongest.adhesion_length_over_range,
            "q0_h_rms": made["q0_h_rms"],
            "cell": describe_cell(loop),
            "area": last.repulsive_area_fraction,
            "net": net,
            "load": load,
            "loading": loading,
            "unloading": unloading,
            # Energy lost over the work done on the surfaces along the loop.
            "lost": gap.dissipated.sum() / gap.work.where(gap.work > 0).sum(),
            "jumps": int(gap.jumped.sum()),
            "weak": weak.isel(state=-1),
        },
    )


def pull_off(loop):
    """Mean pressure of the last state under a press, at the largest adhesion length."""
    press = loop.isel(adhesion_length_over_range=-1).sel(control="pressure")
    return float(press.mean_pressure.dropna("state")[-1])


def area_at(curve, load, way):
    """Repulsive area at a load, on approach (`way` 0) or separation (1)."""
    leg = curve.where(curve.separating == way, drop=True)
    order = np.argsort(leg.mean_pressure.values)
    pressure, area = leg.mean_pressure.values[order], leg.repulsive_area_fraction.values[order]
    return float(np.interp(load, pressure, area))


@claim(
    11,
    *(f"adhesive_{name}" for name in SETS),
    *(f"adhesion_{name}" for name in SETS),
    "fit_bem_64",
    "fit_bem_128",
)
def inverse_kappa_ad(files):
    sets = [ratios_to_formula(files[f"adhesive_{s}"], files[f"adhesion_{s}"]) for s in SETS]
    ratios = {name: np.concatenate([ratio[name] for ratio in sets]) for name in sets[0]}
    slopes = ratios["inverse_kappa_ad"]
    known = (ratios["error"] < LARGEST_ERROR) & (slopes > 0)
    facts = {"load": LOAD, "known": int(known.sum())}
    if not known.any():
        return Finding(value=np.nan, claimed=1.0, verdict=OPEN, facts=facts)
    net = ratios["inverse_kappa_ad_net"]
    net = net[(ratios["net_error"] < LARGEST_ERROR) & (net > 0)]
    resolved = np.isfinite(ratios["direct"])
    direct = ratios["inverse_kappa_ad_direct"][resolved]
    apart = np.abs(np.log(np.concatenate([slopes[known], net]))).max()
    fits = [at_load(files[name]).isel(window=0) for name in ("fit_bem_64", "fit_bem_128")]
    return Finding(
        value=float(np.exp(np.mean(np.log(slopes[known])))),
        claimed=1.0,
        verdict=grade(apart < np.log(1.25), apart < np.log(4)),
        errors={source: float(np.mean(ratios[source][known])) for source in error_budget.SOURCES},
        facts=facts
        | {
            "slopes": (slopes[known].min(), slopes[known].max()),
            "net": (net.min(), net.max(), net.size) if net.size else None,
            "limit": (ratios["limit"][known].min(), ratios["limit"][known].max()),
            "dmt_points": int(ratios["dmt"][known].sum()),
            "decades": np.ptp(np.log10(ratios["direct"][resolved])),
            "direct": (direct.min(), direct.max(), direct.size) if direct.size else None,
            "a_v": [value_and_error(fit, "a_v_mean") for fit in fits],
            "factors": [PAPER_A_V / float(fit.a_v_mean) for fit in fits],
        },
    )


def ratios_to_formula(full, limit):
    """All points of one set, and their errors, over the formula; `direct` and `dmt` as such."""
    full, limit = at_load(full), at_load(limit)
    formula = xr.zeros_like(full.inverse_kappa_ad) + criteria.inverse_kappa_ad(
        float(full.q0_h_rms),
        1.0,
        (full.adhesion_length_over_range * full.range_over_h_rms * full.q0_h_rms).values,
        (full.range_over_h_rms * full.q0_h_rms).values,
        PAPER_A_V,
    )
    names = ("inverse_kappa_ad", "inverse_kappa_ad_net", "inverse_kappa_ad_direct")
    ratios = {name: full[name] / formula for name in names}
    ratios["error"] = error_budget.total_error(full, "inverse_kappa_ad") / formula
    ratios["net_error"] = error_budget.total_error(full, "inverse_kappa_ad_net") / formula
    for source in error_budget.SOURCES:
        ratios[source] = error_budget.part(full, "inverse_kappa_ad", source) / formula
    ratios["limit"] = limit.inverse_kappa_ad / formula
    ratios["dmt"] = full.model == "dmt"
    ratios["direct"] = full.inverse_kappa_ad_direct
    return {name: values.values.ravel() for name, values in ratios.items()}
