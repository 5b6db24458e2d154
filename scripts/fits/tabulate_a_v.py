"""Table of a_V with its error: theory, what other theories say, and what simulation says of it."""

import numpy as np
import xarray as xr

from common.conventions import annotate
from common.job import start
from stickiness import datasets
from stickiness import error_budget as budget
from stickiness.statistics import COVERS

SMALLEST_RANGE = 0.01  # over h_rms; below, simulated areas are extrapolated on most grids
QUOTED = ("a_v", "a_v_limit", "edge_a_v")
THEORY = [f"{name}{ending}" for name in QUOTED for ending in ("", *budget.ENDINGS)]
THEORY += ["edge_range", "quadrature_error"]
APART = "ln of how far other variants and corrections of the theory are"
A_V_TABLE_VARIABLES = {
    "a_v": "a_V that theory predicts; to be held constant below edge_range",
    "a_v_limit": "a_V that theory predicts in the limit of infinite magnification",
    "theory_below": f"{APART} below the quoted",
    "theory_below_limit": f"{APART} below the quoted, infinite magnification",
    "theory_above": f"{APART} above the quoted",
    "theory_above_limit": f"{APART} above the quoted, infinite magnification",
    "simulated_pressure": "mean pressure over E* q0 h_rms of simulations",
    "simulated_range": "range of attraction over h_rms of simulations",
    "simulation_ratio": "simulation over theory at the largest magnification simulated",
    "simulation_error": "standard relative error of this ratio for a further surface",
    "simulation_trend": "change of ln of this ratio per doubling of the magnification",
    "smallest_magnification": "smallest magnification simulated",
    "largest_magnification": "largest magnification simulated",
    "extrapolation_error": "standard relative error that a decade below the simulated ranges adds",
}


def main(job):
    theory = datasets.read(job.input.theory, THEORY)
    needed = ["attractive_area_difference", "window_holds"]
    comparisons = [datasets.read(path, needed) for path in job.input.comparisons]
    dataset = theory[THEORY].isel(variant=0, drop=True).merge(reach(theory))
    dataset = annotate(dataset.merge(simulated(comparisons)), **A_V_TABLE_VARIABLES)
    error = COVERS * dataset.simulation_error * dataset.simulation_ratio
    counted = budget.not_applicable("counted with the sampling")
    parts = dict.fromkeys(("discretisation", "solver"), counted)
    text = "of a further surface, the errors of the cases included"
    parts["sampling"] = budget.ErrorComponent(error, text)
    text = "the trend beyond the largest magnification is not simulated"
    parts["bandwidth"] = budget.unknown_error(text)
    parts["model"] = budget.not_applicable("simulation over theory is what is quoted")
    dataset = budget.with_budget(dataset, "simulation_ratio", **parts)
    title = "a_V as a function of Hurst exponent, magnification, load and range, with its error"
    parameters = {
        **datasets.parameters(theory),
        "variants": theory.variant.values.tolist(),
        "cases": [datasets.parameters(comparison)["case"] for comparison in comparisons],
    }
    datasets.write(dataset, job.output[0], title=title, parameters=parameters)


def reach(theory):
    """Find how far other variants and corrections lie below and above the quoted theory."""
    parts = {}
    for name, ending in (("a_v", ""), ("a_v_limit", "_limit")):
        logs = np.log(theory[name]) - np.log(theory[name].isel(variant=0))
        parts[f"theory_below{ending}"] = -logs.min("variant")
        parts[f"theory_above{ending}"] = logs.max("variant")
    return xr.Dataset(parts)


def simulated(comparisons):
    """Fit the ratio of simulation to theory at every range, smooth in load and magnification.

    ln ratio = parabola in ln p + trend log2(zeta/largest zeta), fitted at each range, every case
    with the same say. Cases differ by more than their errors: a variance between them (a random
    effect, by moments) enters weights and error, which is that of a further case. It adds a
    jackknife, and the cases' errors: grids err to one side in all cases, so no average helps.
    """
    points = collect(comparisons)
    between = scatter(points)
    error = np.hypot(points.error, between)
    mean, trend = fit(points, error)
    weight = 1 / (error**2 * points.sharing)
    common = (weight * points.error**2).sum("point") / weight.sum("point")
    spread = np.hypot(between, jackknife(points, error))
    # Towards smaller ranges: what a decade of simulated ones changes.
    change = mean.sel(range=10 * SMALLEST_RANGE, method="nearest") - mean.isel(range=0)
    dataset = xr.Dataset(
        {
            "simulation_ratio": np.exp(mean),
            "simulation_error": np.sqrt(spread**2 + common),
            "simulation_trend": trend,
            "smallest_magnification": points.magnification.min(),
            "largest_magnification": points.magnification.max(),
            "extrapolation_error": np.sqrt((change**2).mean()),
        }
    )
    return dataset.rename({"pressure": "simulated_pressure", "range": "simulated_range"})


def collect(comparisons):
    """Collect ln(simulation/theory), with errors, at loads whose windows are large enough."""
    parts = []
    per_decade = 4  # simulated ranges
    count = round(-np.log10(SMALLEST_RANGE) * per_decade) + 1
    ranges = np.geomspace(SMALLEST_RANGE, 1, count)
    for case, comparison in enumerate(comparisons):
        quoted = comparison.isel(variant=0, drop=True).interp({"range": ranges})
        quoted = quoted.where(quoted.window_holds == 1)
        over = 1 + quoted.attractive_area_difference
        error = quoted.attractive_area_difference_total_error / COVERS / over
        part = xr.Dataset({"log": -np.log(over), "error": error})
        part = part.rename(pressure="point").dropna("point")
        zeta = datasets.parameters(comparison)["magnification"]
        part = part.assign(
            pressure=part.point,
            case=xr.full_like(part.point, case, float),
            sharing=xr.full_like(part.point, part.sizes["point"], float),
            magnification=xr.full_like(part.point, zeta, float),
        )
        parts.append(part.drop_vars("point"))
    points = xr.concat(parts, "point").transpose("point", "range")
    if not points.sizes["point"]:
        raise ValueError(
            "no load of any case has a window that holds summits enough to compare theory with; "
            "add larger windows or higher pressures to cases or comparisons"
        )
    return points


def fit(points, error, kept=slice(None)):
    """Fit ln ratio at the largest magnification, and its change per doubling of this."""
    loads = np.unique(points.pressure)
    largest = float(points.magnification.max())
    points = points.isel(point=kept)
    error = error.isel(point=kept)
    degree = min(2, len(np.unique(points.pressure)) - 1)
    several = len(np.unique(points.magnification)) > 1

    def terms(load, zeta):
        powers = np.log(load / loads[-1])[:, None] ** np.arange(degree + 1)
        return np.column_stack([powers, np.log2(zeta / largest)]) if several else powers

    matrix = terms(points.pressure.values, points.magnification.values)
    weights = 1 / np.maximum(error * np.sqrt(points.sharing), 1e-9).values
    coefficients = []
    for weight, log in zip(weights.T, points.log.values.T, strict=True):
        solution, *_ = np.linalg.lstsq(matrix * weight[:, None], log * weight, rcond=None)
        coefficients.append(solution)
    coefficients = np.transpose(coefficients)
    coords = {"pressure": loads, "range": points["range"].values}
    mean = terms(loads, np.full(len(loads), largest)) @ coefficients
    trend = xr.DataArray(
        coefficients[-1] if several else np.zeros(coefficients.shape[1]), dims="range"
    )
    return xr.DataArray(mean, coords), trend.assign_coords(range=coords["range"])


def scatter(points):
    """Standard deviation between cases at each range, beyond what their errors explain."""
    mean, trend = fit(points, xr.ones_like(points.error))
    doublings = np.log2(points.magnification / points.magnification.max())
    left = points.log - mean.sel(pressure=points.pressure).drop_vars("pressure") - trend * doublings
    squares = (left**2).groupby(points.case).mean().mean("case")
    explained = (points.error**2).groupby(points.case).mean().mean("case")
    count = len(np.unique(points.case))
    spent = 1 + (len(np.unique(points.magnification)) > 1)
    return np.sqrt(np.maximum(squares * count / max(count - spent, 1) - explained, 0))


def jackknife(points, error):
    """Standard error of the fit, by leaving out one case after the other."""
    cases = np.unique(points.case)
    if len(cases) == 1:
        return 0.0
    means = [fit(points, error, (points.case != case).values)[0] for case in cases]
    return np.sqrt((len(cases) - 1) * xr.concat(means, "case").var("case"))


if __name__ == "__main__":
    main(start(globals()))
