"""Contact with adhesion: loss of load over DMT's, the equivalent sphere, the paper's formula."""

from itertools import pairwise

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from pipeline.claims import adhesion as claims
from pipeline.conventions import at_load
from pipeline.edge_points import BINS, join_certain
from pipeline.numbers import number, percent
from pipeline.quoted.sources import Sources
from stickiness.adhesion import equivalent_sphere
from stickiness.core import budget

EDGES = ("dmt_error", "dmt_error_zeta128", "fig2", *(f"fig4b_{name}" for name in claims.SETS))
LEAST_AREA, SMALL_AREA = 0.2, 0.3  # attractive over contact area: of most sets, and of few
RANGE = 0.1  # over h_rms, of the threshold
TREND_FROM = 0.2  # Tabor parameter of the edges
NEAR_DMT = 0.2  # relative difference of the sphere from the DMT limit


def quote_dmt_ratio(sources: Sources) -> dict[str, str]:
    """1/kappa_ad over that of the DMT limit, weakest adhesion, at the load of the paper."""
    weak = at_load(sources.read("adhesion/full/dmt_error")).isel(adhesion_length_over_range=0)
    return {
        f"dmt_ratio.{name}": quote_ratio(weak.sel(range_over_h_rms=range_))
        for name, range_ in (("long", 1.0), ("short", 0.01))
    }


def quote_ratio(at: xr.Dataset) -> str:
    """One ratio with its error, rounded to two digits of the error or one decimal."""
    value, error = float(at.dmt_ratio), float(budget.total_error(at, "dmt_ratio"))
    return f"{value:.1f} ± {error:.1f}" if error > 1 else f"{value:.2f} ± {error:.2f}"


def quote_sphere(sources: Sources) -> dict[str, str]:
    """Simulation over the equivalent sphere, as drawn in Figure 10; ± is the scatter of sets."""
    files = [sources.read(f"adhesion/edges/{name}") for name in EDGES]
    area, strength, _, ratio, _ = join_certain(files)
    weak = strength < equivalent_sphere.WEAK
    most, few = weak & (area >= LEAST_AREA), weak & (area < SMALL_AREA)
    strong = ~weak & (strength <= equivalent_sphere.STRONGEST_SIMULATED)
    means = [mean for low, mean in average_bins(strength, ratio) if low >= TREND_FROM]
    near = np.abs(equivalent_sphere.weak_effect(area) - 1) < NEAR_DMT
    return {
        "sphere.weak": say_mean(ratio[most]),
        "sphere.weak.sets": str(most.sum()),
        "sphere.small": say_mean(ratio[few]),
        "sphere.small.sets": str(few.sum()),
        "sphere.strong": say_mean(ratio[strong]),
        "sphere.strong.sets": str(strong.sum()),
        "sphere.strong.range": f"{ratio[strong].min():.2f} to {ratio[strong].max():.2f}",
        "sphere.strongest": number(float(strength[strong].max()), 2),
        "sphere.trend.first": f"{means[0]:.1f}",
        "sphere.trend.last": f"{means[-1]:.1f}",
        "sphere.areas": f"{number(float(area.min()), 2)} … {number(float(area.max()), 2)}",
        "sphere.near_dmt": percent(float(near.mean())),
    }


def average_bins(strength: NDArray, ratio: NDArray) -> list[tuple[float, float]]:
    """Lower end and mean of the bins of Figure 10 that hold more than one point."""
    found = []
    for low, high in pairwise(BINS):
        inside = ratio[(strength >= low) & (strength < high)]
        if inside.size > 1:
            found.append((low, float(inside.mean())))
    return found


def say_mean(values: NDArray) -> str:
    """Mean with the standard deviation of the single values."""
    return f"{values.mean():.2f} ± {values.std(ddof=1):.2f}"


def quote_threshold(sources: Sources) -> dict[str, str]:
    """Threshold of l_a/range in the DMT limit, and in full at several areas, as in claim 5."""
    limit = at_load(sources.read("adhesion/dmt/fig2"))
    full = sources.read("adhesion/full/fig2").sel(range_over_h_rms=RANGE)
    return {
        "threshold.dmt": f"{claims.dmt_threshold(limit, RANGE):.2f}",
        "threshold.areas": claims.list_areas(full),
    }


def quote_formula(sources: Sources) -> dict[str, str]:
    """1/kappa_ad of simulation over the paper's formula, as in claim 11."""
    sets = claims.SETS
    files = {f"adhesive_{name}": sources.read(f"adhesion/full/fig4b_{name}") for name in sets}
    files |= {f"adhesion_{name}": sources.read(f"adhesion/dmt/fig4b_{name}") for name in sets}
    ratios = claims.join_ratios(files)
    known, resolved = claims.find_known(ratios), np.isfinite(ratios["direct"])
    slopes = ratios["inverse_kappa_ad"][known]
    return {
        "formula.mean": number(float(np.exp(np.log(slopes).mean())), 2),
        "formula.range": claims.spread(slopes),
        "formula.points": str(known.sum()),
        "formula.direct": claims.spread(ratios["inverse_kappa_ad_direct"][resolved]),
        "formula.direct.points": str(resolved.sum()),
    }


def quote_loop(sources: Sources) -> dict[str, str]:
    """Loss along the loop of Figure 4A and what half the grid changes in its pull-off."""
    coarse, fine = (sources.read("adhesion/loops/fig4a").isel(resolution=i) for i in (0, -1))
    gap = fine.isel(adhesion_length_over_range=-1).sel(control="mean_gap")
    change = abs(claims.pull_off(coarse) / claims.pull_off(fine) - 1)
    return {"loop.lost": percent(claims.lost_share(gap)), "loop.pull_off_change": percent(change)}


NUMBERS = (quote_dmt_ratio, quote_sphere, quote_threshold, quote_formula, quote_loop)
