"""Table of a_V with its error: theory, what other theories say, and what simulation says of it."""

import numpy as np
import xarray as xr

from _job import start
from stickiness import datasets

SMALLEST_RANGE = 0.01  # over h_rms; below, simulated areas are extrapolated on most grids
PER_DECADE = 4  # simulated ranges
THEORY = ("a_v", "a_v_limit", "edge_range", "edge_a_v", "quadrature_error")


def main(job):
    theory = datasets.read(job.input.theory, THEORY)
    comparisons = [
        datasets.read(path, ["attractive_area_difference", "window_holds"])
        for path in job.input.comparisons
    ]
    dataset = theory[list(THEORY)].isel(variant=0, drop=True).merge(reach(theory))
    dataset = dataset.merge(simulated(comparisons))
    datasets.write(
        annotated(dataset),
        job.output[0],
        title="a_V as a function of Hurst exponent, magnification, load and range, with its error",
        parameters={
            **datasets.parameters(theory),
            "variants": [str(name) for name in theory.variant.values],
            "cases": [datasets.parameters(comparison)["case"] for comparison in comparisons],
        },
    )


def reach(theory):
    """How far other variants and corrections reach below and above the quoted theory."""
    parts = {}
    for name, ending in (("a_v", ""), ("a_v_limit", "_limit")):
        logs = np.log(theory[name]) - np.log(theory[name].isel(variant=0))
        parts[f"theory_below{ending}"] = -logs.min("variant")
        parts[f"theory_above{ending}"] = logs.max("variant")
    return xr.Dataset(parts)


def simulated(comparisons):
    """Ratio of simulation to theory at every load and range, pooled over cases.

    Cases differ by more than their errors: the ratio is a mean with a variance between cases (a
    random effect, by moments over all loads), and its error is that of a further case. The cases'
    own errors are not taken to average out, for grids err to one side in all of them.
    """
    logs, errors = zip(*map(log_ratio, comparisons), strict=True)
    logs, errors = (xr.concat(part, "case", join="outer") for part in (logs, errors))
    scatter = between_cases(logs, errors)
    weight = (1 / (errors**2 + scatter**2)).fillna(0)
    total = weight.sum("case")
    known = total.min("range") > 0
    if not known.any():
        raise ValueError(
            "no load of any case has a window that holds summits enough to compare theory with; "
            "add larger windows or higher pressures to cases or comparisons"
        )
    mean = (weight * logs.fillna(0)).sum("case") / total
    common = (weight * errors.fillna(0) ** 2).sum("case") / total
    mean, common = mean.isel(pressure=known.values), common.isel(pressure=known.values)
    # Towards smaller ranges: what a decade of simulated ones changes.
    change = mean.sel(range=10 * SMALLEST_RANGE, method="nearest") - mean.isel(range=0)
    found = xr.Dataset(
        {
            "simulation_ratio": np.exp(mean),
            "simulation_error": np.sqrt(scatter**2 + common),
            "extrapolation_error": np.sqrt((change**2).mean()),
        }
    )
    return found.rename({"pressure": "simulated_pressure", "range": "simulated_range"})


def log_ratio(comparison):
    """Logarithm of simulation over theory and its error, where the window is large enough."""
    quoted = comparison.isel(variant=0, drop=True)
    decades = -np.log10(SMALLEST_RANGE)
    ranges = np.geomspace(SMALLEST_RANGE, 1, round(decades * PER_DECADE) + 1)
    quoted = quoted.interp({"range": ranges}).where(quoted.window_holds == 1)
    over = 1 + quoted.attractive_area_difference
    return -np.log(over), quoted.attractive_area_difference_error / over


def between_cases(logs, errors):
    """Standard deviation between cases at each range, what their errors explain taken away."""
    count = logs.notnull().sum("case")
    several = count > 1
    spread = logs.var("case", ddof=1).where(several).mean("pressure")
    explained = (errors**2).mean("case").where(several).mean("pressure")
    return np.sqrt(np.maximum(spread - explained, 0).fillna(0))


def annotated(dataset):
    theory = "a_V by theory"
    texts = {
        "a_v": ("1", f"{theory}; to be held constant below edge_range"),
        "a_v_limit": ("1", f"{theory} in the limit of infinite magnification"),
        "simulated_pressure": ("1", "mean pressure over E* q0 h_rms of simulations"),
        "simulated_range": ("1", "range of attraction over h_rms of simulations"),
        "simulation_ratio": ("1", "simulation over theory on the same spectrum, pooled over cases"),
        "simulation_error": ("1", "relative error of this ratio for a further surface"),
        "extrapolation_error": ("1", "relative error added below the simulated ranges"),
    }
    for name in ("theory_below", "theory_above"):
        side = name.removeprefix("theory_")
        text = f"ln of how far other variants and corrections of the theory are {side} the quoted"
        texts |= {name: ("1", text), f"{name}_limit": ("1", f"{text}, infinite magnification")}
    return datasets.annotate(dataset, **texts)


if __name__ == "__main__":
    main(start(globals(), "tabulate_a_v"))
