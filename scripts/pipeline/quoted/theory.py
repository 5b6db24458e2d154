"""Theory against simulation: its errors by correction, gamma, and the table of a_V."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from pipeline.conventions import LOAD, VARIANT
from pipeline.numbers import percent, table
from pipeline.quoted.sources import Sources, say_range, say_shares
from stickiness.core import datasets
from stickiness.criteria.a_v_table import AvTable

VARIANTS = {
    VARIANT: "2018, Yang & Persson with γ = 0.45",
    f"{VARIANT}, wang2017": "2018, Wang & Müser",
    f"{VARIANT}, xu2024": "2018, Xu et al.",
    "almqvist2011": "2011, Yang & Persson",
}
QUANTITIES = ("area_fraction", "mean_gap", "attractive_area", "gap_density")
HEADS = ("variant and correction", "area", "mean gap", "A_ad(0.1 h_rms)", "P(u) at load 0.065")
RANGE = 0.1  # over h_rms, of the attractive area
KNOWN_TO, LARGEST_GAP = 0.2, 3.0  # of P(u): its error over simulation, and u over h_rms, at most
LEAST_HURST = 0.7  # of surfaces in cells of one wave
NARROW_LOADS = (0.03, 0.26)
GAMMA_NAMES = {"area_fraction": "area", "mean_gap": "mean gap", "attractive_area": "A_ad"}


def quote_deviations(sources: Sources) -> dict[str, str]:
    """Rms differences of theory from simulation, over all surfaces and loads that cells hold."""
    compared = sources.read_all("fits/theory")
    rows = [
        (label, *(percent(root_mean_square(compared.values(), v, name)) for name in QUANTITIES))
        for v, label in VARIANTS.items()
    ]
    return {"theory.surfaces": str(len(compared)), "theory.deviations": table(HEADS, rows)}


def root_mean_square(files: Iterable[xr.Dataset], variant: str, name: str) -> float:
    """Root mean square of the differences that can be told, all surfaces in one."""
    values = np.concatenate([list_differences(data.sel(variant=variant), name) for data in files])
    return float(np.sqrt(np.nanmean(values**2)))


def list_differences(data: xr.Dataset, name: str) -> NDArray:
    """Relative differences; NaN where the cell or the simulation is too small to tell."""
    difference = data[f"{name}_difference"]
    if name == "gap_density":
        at = data.sel(pressure=LOAD, method="nearest")
        difference, error = at.gap_density_difference, at.gap_density_difference_total_error
        known = (error < KNOWN_TO * (1 + difference)) & (at.gap < LARGEST_GAP)
        return difference.where(known).values
    if name == "attractive_area":
        difference = difference.interp({"range": RANGE})
    return difference.where(data.window_holds == 1).values


def quote_trends(sources: Sources) -> dict[str, str]:
    """Differences of area and mean gap by magnification, load and width of the cell."""
    files = [d.sel(variant=VARIANT) for d in sources.read_all("fits/theory").values()]
    by = [(datasets.parameters(data), data) for data in files]
    coarse = [data for made, data in by if made["magnification"] == 16]
    narrow = [data for made, data in by if is_narrow(made)]
    fine = [d for d in narrow if datasets.parameters(d)["magnification"] >= 64]
    smooth = [d for d in narrow if datasets.parameters(d)["hurst"] == 0.8]
    wide = [d for made, d in by if made.get("window", 1) >= 4 and made["hurst"] == 0.8]
    loads = slice(NARROW_LOADS[0] * (1 - 1e-9), NARROW_LOADS[1] * (1 + 1e-9))
    worst = max(float(d.mean_gap_difference.sel(pressure=loads).max()) for d in narrow)
    return {
        "theory.area.coarse": say_shares(pick(coarse, "area_fraction", LOAD)),
        "theory.area.fine": say_shares(pick(fine, "area_fraction", LOAD)),
        "theory.mean_gap.narrow": percent(worst),
        "theory.mean_gap.narrow_small": say_shares(pick(smooth, "mean_gap", 0.01)),
        "theory.mean_gap.wide": say_shares(pick(wide, "mean_gap", LOAD)),
        "theory.mean_gap.wide_small": say_shares(pick(wide, "mean_gap", 0.001)),
    }


def quote_wang(sources: Sources) -> dict[str, str]:
    """How far the mean gap is off in cells of one wave, by two corrections."""
    texts = {}
    for name, variant in (("yang", VARIANT), ("wang", f"{VARIANT}, wang2017")):
        found = np.concatenate(
            [
                data.mean_gap_difference.sel(variant=variant, pressure=slice(0.0649, 0.2001)).values
                for data in sources.read_all("fits/theory").values()
                if is_narrow(datasets.parameters(data))
            ]
        )
        texts[name] = percent(np.abs(found).max()) if name == "yang" else say_shares(-found)
    return {f"theory.mean_gap.{name}": text for name, text in texts.items()}


def is_narrow(made: Mapping[str, Any]) -> bool:
    """Whether a surface is smooth enough to be compared at most loads, and of one wave."""
    return made.get("window", 1) == 1 and made["hurst"] >= LEAST_HURST


def pick(files: list[xr.Dataset], name: str, load: float) -> list[float]:
    """Relative differences at one load, of the surfaces that were simulated there."""
    found = [data[f"{name}_difference"].sel(pressure=load, method="nearest") for data in files]
    return [float(one) for one in found if abs(np.log(float(one.pressure) / load)) < np.log(1.05)]


def quote_gamma(sources: Sources) -> dict[str, str]:
    """Best gamma by quantity, and where one gamma fits all of them."""
    gamma = sources.read("fits/gamma").sel(quantity=list(GAMMA_NAMES))
    ours = gamma.sel(correction="yang2008")
    texts = {
        f"gamma.{name}": f"{float(one.gamma):.2f} ({float(one.gamma_low):.2f} to "
        f"{float(one.gamma_high):.2f})"
        for name, one in ((name, ours.sel(quantity=name)) for name in GAMMA_NAMES)
    }
    other = gamma.sel(correction="wang2017")
    low, high = float(other.gamma_low.max()), float(other.gamma_high.min())
    return texts | {"gamma.wang": f"{low:.2f} to {high:.2f}" if low < high else "no γ"}


def quote_a_v_table(sources: Sources) -> dict[str, str]:
    """a_V as tabulated at H = 0.8 and load 0.1, without end of the spectrum."""
    data = sources.read("fits/a_v_table")
    at, below = (AvTable(data).a_v_at(0.8, 0.1, range_) for range_ in (RANGE, 1e-8))
    trend = float(data.simulation_trend.sel(simulated_range=RANGE, method="nearest"))
    return {
        "a_v_table.value": f"{float(at.value):.2f} ({say_range([at.low, at.high])})",
        "a_v_table.trend": percent(-trend).replace("−", "") if trend < 0 else "no",
        "a_v_table.limits": f"{below.low / below.value:.2f} to {below.high / below.value:.2f}",
    }


NUMBERS = (quote_deviations, quote_trends, quote_wang, quote_gamma, quote_a_v_table)
