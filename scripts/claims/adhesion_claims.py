"""Claims on contact with adhesion: threshold of kappa, loop and 1/kappa_ad."""

from __future__ import annotations

import numpy as np
import xarray as xr

from claims.ledger import OPEN, QUALIFIED, Files, Finding, claim, grade
from claims.texts import describe_sample, errors_by_source, quote, quote_number
from common.conventions import LOAD, at_load
from common.formatting import percent
from stickiness import criteria, datasets
from stickiness import error_budget as budget

PAPER_A_V = 2.8  # in the formula of Figure 4B
SETS = ("rough", "rough_near", "smooth")  # of Figure 4B, ends of the names of files
KNOWN = 0.3  # error over formula up to which a point is compared with it


@claim(
    5,
    "kappa grows with l_a/range and turns negative above a threshold (Figs. 2B, 2D-I)",
    files=("adhesive_fig2", "adhesion_fig2"),
)
def kappa_threshold(files: Files) -> Finding:
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
    crosses = np.isfinite(threshold)
    lowest = float(at.inverse_kappa.min().fillna(0.5))
    below = f"1/kappa falls to {lowest:.2f}; the grid does not resolve larger l_a/range."
    return Finding(
        quantity=(
            f"{'threshold' if crosses else 'largest simulated'} l_a/range on approach, at the mean "
            f"gap that p = {float(at.pressure):g} has without adhesion, "
            f"range/h_rms = {float(range_):g}, q0 h_rms = {float(full.q0_h_rms):g}, "
            f"{describe_sample(full)}"
        ),
        value=threshold if crosses else largest_simulated(at),
        verdict=QUALIFIED if crosses else OPEN,
        remark=(
            "Full simulation at prescribed mean gaps; in the DMT limit the threshold is "
            f"{dmt_threshold(limit, range_):.2f}. {describe_threshold(at) if crosses else below} "
            f"{describe_areas(loads.sel(range_over_h_rms=float(range_)))}"
            "On separation a pull-off force exists at smaller l_a/range already (claim 10). "
            f"{describe_resolved(full.isel(range_over_h_rms=0))}"
        ),
        errors=errors,
        comment="errors of 1/kappa at the less certain of the two points beside the threshold",
    )


def dmt_threshold(limit: xr.Dataset, range_: float | xr.DataArray) -> float:
    """Threshold of l_a/range in the DMT limit, at one range over h_rms."""
    weakest = limit.sel(range_over_h_rms=range_).isel(adhesion_length_over_range=0)
    return float(weakest.adhesion_length_over_range / (2 * weakest.inverse_kappa_ad))


def describe_threshold(data: xr.Dataset) -> str:
    """The threshold by the fitted slope, and 1/kappa by both areas where half of it is left."""
    fitted, errors = find_zero(data, "inverse_kappa_fit")
    total = np.linalg.norm([*errors.values()])
    fit = f"The slope fitted over all loads puts it at {quote_number(fitted, total)}. "
    nearest = abs(data.inverse_kappa - 0.25).argmin("adhesion_length_over_range")
    half = data.isel(adhesion_length_over_range=nearest)
    whole, net = (quote(half, name) for name in ("inverse_kappa", "inverse_kappa_net"))
    return (
        f"{fit if np.isfinite(fitted) else ''}The area is that at zero gap; the threshold, where "
        "the pressure vanishes, does not depend on this choice. At "
        f"l_a/range = {float(half.adhesion_length_over_range):g} 1/kappa is {whole} by that area "
        f"and {net} by its compressed part."
    )


def describe_areas(loads: xr.Dataset) -> str:
    """The threshold at the mean gap of every load, and the area of contact there."""
    found = list_areas(loads)
    return f"It depends on the area of contact: {found}. " if found else ""


def list_areas(loads: xr.Dataset) -> str:
    """Thresholds at one range with their areas, in a row; empty where there are none."""
    found = []
    for load in loads.pressure.values:
        at = loads.sel(pressure=load).dropna("adhesion_length_over_range", subset=["inverse_kappa"])
        threshold, _ = find_zero(at, "inverse_kappa")
        if np.isfinite(threshold):
            lengths = np.log(at.adhesion_length_over_range)
            area = float(np.interp(np.log(threshold), lengths, at.repulsive_area))
            found.append(
                f"{threshold:.2g} at an area of {percent(area)} (mean gap of p = {load:g})"
            )
    return ", ".join(found)


def describe_resolved(smallest: xr.Dataset) -> str:
    """Up to which adhesion length the paper's range, the smallest, is resolved."""
    largest = largest_simulated(smallest)
    return (
        f"At the range of the paper, {float(smallest.range_over_h_rms):g} h_rms, the grid resolves "
        + (f"l_a/range up to {largest:g} only." if largest else "the edge of the contact nowhere.")
    )


def find_zero(data: xr.Dataset, name: str) -> tuple[float, dict[str, float]]:
    """Adhesion length at which a slope is zero, between those simulated, and its errors.

    They are those of the less certain of the two points beside it.
    """
    data = data.where(np.isfinite(data[name]), drop=True)
    log_length = np.log(data.adhesion_length_over_range.values)
    value, error = data[name].values, budget.total_error(data, name).values
    below = np.flatnonzero(value < 0)
    if not below.size or below[0] == 0:
        return np.nan, {}
    i = below[0]
    slope = (value[i] - value[i - 1]) / (log_length[i] - log_length[i - 1])
    zero = float(np.exp(log_length[i - 1] - value[i - 1] / slope))
    worse = data.isel(adhesion_length_over_range=i - 1 + int(np.argmax(error[i - 1 : i + 1])))
    sizes = errors_by_source(worse, name)
    return zero, {source: float(zero * size / abs(slope)) for source, size in sizes.items()}


def largest_simulated(data: xr.Dataset) -> float:
    """Largest adhesion length over range that was simulated at one range; 0 if none was."""
    length = data.adhesion_length_over_range.where(np.isfinite(data.inverse_kappa))
    return float(length.max().fillna(0))


@claim(
    10, "loading-unloading loop, jump-in and pull-off at non-zero area (Fig. 4A)", files=("loop",)
)
def hysteresis(files: Files) -> Finding:
    coarse, loop = (files["loop"].isel(resolution=i) for i in (0, -1))
    strongest = loop.isel(adhesion_length_over_range=-1)
    error = abs(pull_off(coarse) - pull_off(loop))
    press, gap = strongest.sel(control="pressure"), strongest.sel(control="mean_gap")
    last = press.dropna("state").isel(state=-1)
    area, net = (
        float(last[name]) for name in ("repulsive_area_fraction", "net_repulsive_area_fraction")
    )
    tension = pull_off(loop)
    load = float(press.mean_pressure.max()) / 5
    loading, unloading = (area_at(press, load, way) for way in (0, 1))
    lost = lost_share(gap)
    weak = loop.isel(adhesion_length_over_range=0).sel(control="pressure").dropna("state")
    weak = weak.isel(state=-1)
    made = datasets.parameters(loop)
    pulls = tension < -2 * error and net > 0
    return Finding(
        quantity=(
            "pull-off pressure over E* q0 h_rms, range/h_rms = "
            f"{made['range_over_h_rms']:g}, l_a/range = "
            f"{float(strongest.adhesion_length_over_range):g}, q0 h_rms = {made['q0_h_rms']:g}, "
            f"{describe_sample(loop)}, one realisation"
        ),
        value=tension,
        verdict=grade(pulls and unloading > 1.05 * loading, pulls),
        remark=(
            f"At pull-off the area at zero gap is {area:.3f}, of which {net:.3f} is compressed. At "
            f"p = {load:g} the area is {loading:.3f} on loading and {unloading:.3f} on unloading. "
            f"At prescribed mean gap the loop loses {percent(lost)} of the work done on the "
            f"surfaces; number of jumps: {int(gap.jumped.sum())}. With l_a/range = "
            f"{float(weak.adhesion_length_over_range):g} the surfaces separate at p = "
            f"{float(weak.mean_pressure):.2g}, area {float(weak.repulsive_area_fraction):.3f}."
        ),
        errors={"discretisation": error, "sampling": np.nan},
        comment=(
            "discretisation: change from half the resolution; sampling: not known, a single "
            "realisation"
        ),
    )


def lost_share(gap: xr.Dataset) -> float:
    """Energy lost over the work done on the surfaces, along a loop at prescribed mean gaps."""
    return float(gap.dissipated.sum() / gap.work.where(gap.work > 0).sum())


def pull_off(loop: xr.Dataset) -> float:
    """Mean pressure of the last state under a press, at the largest adhesion length."""
    press = loop.isel(adhesion_length_over_range=-1).sel(control="pressure")
    return float(press.mean_pressure.dropna("state")[-1])


def area_at(curve: xr.Dataset, load: float, way: int) -> float:
    """Repulsive area at a load on one leg of a loop."""
    leg = curve.where(curve.separating == way, drop=True)
    order = np.argsort(leg.mean_pressure.values)
    pressure, area = leg.mean_pressure.values[order], leg.repulsive_area_fraction.values[order]
    return float(np.interp(load, pressure, area))


@claim(
    11,
    "1/kappa_ad follows the formula with a_V = 2.8 over six decades (Fig. 4B)",
    files=(
        *(f"adhesive_{name}" for name in SETS),
        *(f"adhesion_{name}" for name in SETS),
        "fit_bem_64",
        "fit_bem_128",
    ),
)
def inverse_kappa_ad(files: Files) -> Finding:
    ratios = join_ratios(files)
    slopes, known = ratios["inverse_kappa_ad"], find_known(ratios)
    if not known.any():
        remark = "No point is known to 30 % of the formula."
        quantity = "1/kappa_ad by slopes over the formula"
        return Finding(quantity=quantity, value=np.nan, claimed=1.0, verdict=OPEN, remark=remark)
    net = ratios["inverse_kappa_ad_net"]
    net = net[(ratios["net_error"] < KNOWN) & (net > 0)]
    resolved = np.isfinite(ratios["direct"])
    direct = ratios["inverse_kappa_ad_direct"][resolved]
    decades = np.ptp(np.log10(ratios["direct"][resolved]))
    apart = np.abs(np.log(np.concatenate([slopes[known], net]))).max()
    fits = [at_load(files[name]).isel(window=0) for name in ("fit_bem_64", "fit_bem_128")]
    return Finding(
        quantity=(
            "1/kappa_ad by slopes over the formula, geometric mean of the "
            f"{known.sum()} points of 8 parameter sets that are known to 30 % of the formula, "
            f"p = {LOAD:g}; ± the mean error of a single point"
        ),
        value=float(np.exp(np.mean(np.log(slopes[known])))),
        claimed=1.0,
        verdict=grade(apart < np.log(1.25), apart < np.log(4)),
        remark=(
            f"The ratios are {spread(slopes[known])}; with the compressed area {spread(net)} "
            f"({net.size} points); in the DMT limit {spread(ratios['limit'][known])}, a limit that "
            f"is good enough at {int(ratios['dmt'][known].sum())} of the points. Taken directly "
            f"from the tractions, which resolves all {decades:.1f} decades of 1/kappa_ad "
            f"({direct.size} points), they are {spread(direct)}. With the a_V of these surfaces "
            f"({', '.join(quote(fit, 'a_v_mean') for fit in fits)}) in the formula all ratios are "
            f"{', '.join(f'{PAPER_A_V / float(fit.a_v_mean):.2f}' for fit in fits)} times as "
            "large. The order of magnitude agrees. But attraction next to the edge of a contact, "
            "even the weakest, draws in more area than the same attraction spread evenly would, so "
            "that 1/kappa_ad falls with the range more slowly than (range/h_rms)^(2/3). Strong "
            "attraction saturates (Fig. 7)."
        ),
        errors={source: float(np.mean(ratios[source][known])) for source in budget.SOURCES},
        comment="means of the errors of single points",
    )


def join_ratios(files: Files) -> dict[str, np.ndarray]:
    """Ratios to the formula of all points of both surfaces."""
    sets = [ratios_to_formula(files[f"adhesive_{s}"], files[f"adhesion_{s}"]) for s in SETS]
    return {name: np.concatenate([ratio[name] for ratio in sets]) for name in sets[0]}


def find_known(ratios: dict[str, np.ndarray]) -> np.ndarray:
    """Points that are known well enough to be compared with the formula."""
    return (ratios["error"] < KNOWN) & (ratios["inverse_kappa_ad"] > 0)


def ratios_to_formula(full: xr.Dataset, limit: xr.Dataset) -> dict[str, np.ndarray]:
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
    ratios["error"] = budget.total_error(full, "inverse_kappa_ad") / formula
    ratios["net_error"] = budget.total_error(full, "inverse_kappa_ad_net") / formula
    for source in budget.SOURCES:
        ratios[source] = budget.part(full, "inverse_kappa_ad", source) / formula
    ratios["limit"] = limit.inverse_kappa_ad / formula
    ratios["dmt"] = full.model == "dmt"
    ratios["direct"] = full.inverse_kappa_ad_direct
    return {name: values.values.ravel() for name, values in ratios.items()}


def spread(ratios: np.ndarray) -> str:
    if not ratios.size:
        return "not known"
    return f"{ratios.min():.2f} to {ratios.max():.2f}"
