"""The gamma of each correction of the theory that agrees best with simulation, and how well.

Cases of one window are made with the same seeds, so they share their long waves and most of their
deviations (correlations of 0.9 to 1). Their errors rise and fall together, and confidence intervals
are taken by resampling windows together with their cases.
"""

import numpy as np
import xarray as xr
from scipy.interpolate import CubicSpline

from common.conventions import annotate
from common.model_surfaces import cell_size, model_spectrum
from stickiness import datasets
from stickiness.error_budget import ErrorComponent, not_applicable, with_budget
from stickiness.persson.kernels import CORRECTIONS, correction_of
from stickiness.persson.theory import Persson
from stickiness.statistics import COVERS
from stickiness.surface import lattice_spectrum

GRID = np.geomspace(0.15, 1.0, 16)  # of gamma
FEW = np.geomspace(0.15, 1.0, 4)  # of gamma, for attractive areas: their logarithms are smooth
LOADS = (0.065, 0.2)  # over E* q0 h_rms, for attractive areas, which take longest
RANGES = (0.03, 0.1, 0.3)  # over h_rms, of attractive areas
QUANTITIES = ("area_fraction", "mean_gap", "attractive_area")
EVERY = "all"  # the three quantities with equal weights
CONFIDENCE = 0.95
RANDOM = {"draws": 1000, "seed": 1}
INTERVAL = f"{CONFIDENCE:.0%} confidence interval of gamma, over windows, their cases and errors"
MISFIT = "root mean square of ln(theory/simulation) at the"
VARIABLES = {
    "correction": "correction of the theory",
    "quantity": f"what is compared; {EVERY}: the three with equal weights",
    "gamma": "gamma at which theory agrees best with simulation",
    "gamma_low": f"low end of the {INTERVAL}",
    "gamma_high": f"high end of the {INTERVAL}",
    "misfit": f"{MISFIT} best gamma",
    "misfit_own": f"{MISFIT} gamma of the correction's source",
    "quantities_agree": "1 where one gamma lies within the intervals of the three quantities; "
    f"where 0, the one for {EVERY} is a compromise that may suit none of them",
    "own_gamma": "gamma of the correction's source",
}


def write_gamma(ensembles, comparisons, output):
    """Write the gamma that agrees best with the means in files, and the comparisons behind it."""
    files = zip(ensembles, comparisons, strict=True)
    read = ((datasets.read(one), datasets.read(other, ["window_holds"])) for one, other in files)
    cases = [found for both in read if (found := case(*both))]
    windows = [deviations.pop("window") for deviations in cases]
    draws = sample(np.random.default_rng(RANDOM["seed"]), RANDOM["draws"], windows)
    rows = [
        [fit(cases, draws, index, quantity) for quantity in (*QUANTITIES, EVERY)]
        for index in range(len(CORRECTIONS))
    ]
    names = ("gamma", "gamma_low", "gamma_high", "spread", "misfit", "misfit_own")
    dims, values = ("correction", "quantity"), np.moveaxis(rows, -1, 0)
    dataset = xr.Dataset(
        {name: (dims, value) for name, value in zip(names, values, strict=True)},
        coords={"correction": list(CORRECTIONS), "quantity": [*QUANTITIES, EVERY]},
    )
    each = dataset.sel(quantity=list(QUANTITIES))
    agree = each.gamma_low.max("quantity") <= each.gamma_high.min("quantity")
    dataset["quantities_agree"] = agree.astype("i1")
    dataset["own_gamma"] = "correction", [correction_of(name).gamma for name in CORRECTIONS]
    title = "gamma of the corrections of Persson's theory by simulation"
    parameters = {"cases": len(cases), "ranges": RANGES, "loads": LOADS} | RANDOM
    gamma = add_budgets(annotate(dataset.drop_vars("spread"), **VARIABLES), dataset.spread)
    datasets.write(gamma, output, title=title, parameters=parameters)


def case(ensemble, comparison):
    """Mean squares of ln(theory/simulation), mean products with its errors, mean squares of these.

    By quantity, along correction and gamma, over loads at which the window holds summits enough.
    """
    made = datasets.parameters(ensemble)
    lattice = lattice_spectrum(model_spectrum(made), cell_size(made))
    ensemble = ensemble.isel(pressure=comparison.window_holds.values == 1)
    if not ensemble.sizes["pressure"]:
        return None
    few = np.unique(ensemble.pressure.sel(pressure=list(LOADS), method="nearest"))
    theory = {name: [] for name in QUANTITIES}
    for correction in CORRECTIONS:
        at = [Persson(lattice, gamma=g, correction=correction) for g in GRID]
        for name in ("area_fraction", "mean_gap"):
            values = [getattr(t, name)(ensemble.pressure.values) for t in at]
            theory[name].append(np.log(values))
        coarser = [Persson(lattice, gamma=g, correction=correction, nodes=0.5) for g in FEW]
        areas = [t.gap_cumulative(np.array(RANGES), few).ravel() for t in coarser]
        theory["attractive_area"].append(CubicSpline(np.log(FEW), np.log(areas))(np.log(GRID)))
    found = {"window": made.get("window", 1)}
    for name, logs in theory.items():
        simulated = ensemble[[f"{name}_mean", f"{name}_mean_total_error"]]
        simulated = simulated.transpose("pressure", ...)
        if "range" in simulated.dims:
            simulated = simulated.sel(pressure=few).interp({"range": list(RANGES)})
        mean, error = (part.values.ravel() for part in simulated.values())
        logs, error = np.array(logs) - np.log(mean), np.nan_to_num(error / COVERS / mean)
        found[name] = np.mean(logs**2, axis=-1), np.mean(logs * error, axis=-1), np.mean(error**2)
    return found


def sample(rng, count, windows):
    """Cases drawn, and how many errors each quantity of each is off by.

    Windows are drawn with replacement, then as many cases as there are from theirs. Cases of one
    window are off together.
    """
    names, member = np.unique(windows, return_inverse=True)
    size = len(windows)
    chosen = np.empty((count, size), dtype=int)
    for row in chosen:
        drawn = rng.integers(len(names), size=len(names))
        row[:] = rng.choice(np.concatenate([np.flatnonzero(member == w) for w in drawn]), size)
    off = rng.standard_normal((len(QUANTITIES), count, len(names)))
    return chosen, np.take_along_axis(off, member[chosen][None], axis=2)


def fit(cases, draws, correction, quantity):
    """Gamma, the ends of its interval, the 90 % spread, the misfits at it and at the source's."""
    names = QUANTITIES if quantity == EVERY else (quantity,)
    every = np.arange(len(cases))[None]
    still = every, np.zeros((len(QUANTITIES), *every.shape))
    as_found, drawn = (
        np.mean([mean_squares(cases, name, correction, *which) for name in names], axis=0)
        for which in (still, draws)
    )
    curve = CubicSpline(np.log(GRID), as_found[0])
    best = lowest(curve)
    gammas = lowest(CubicSpline(np.log(GRID), drawn, axis=1))
    ends = np.quantile(gammas, [0.5 - CONFIDENCE / 2, 0.5 + CONFIDENCE / 2])
    spread = np.quantile(np.abs(gammas - best), 0.9)
    at = np.log([best, correction_of(CORRECTIONS[correction]).gamma])
    return best, *ends, spread, *np.sqrt(np.maximum(curve(at), 0.0))


def add_budgets(dataset, spread):
    """Add the errors of gamma: by resampling, and for all quantities how far single ones differ."""
    each = dataset.gamma.sel(quantity=list(QUANTITIES))
    apart = abs(each - dataset.gamma.sel(quantity=EVERY)).max("quantity")
    text = f"how far the gammas of single quantities are from the one for {EVERY}"
    return with_budget(
        dataset,
        "gamma",
        **dict.fromkeys(("discretisation", "solver"), not_applicable("drawn with the sampling")),
        sampling=ErrorComponent(spread, "windows, cases and their errors drawn"),
        bandwidth=not_applicable("of the spectra simulated"),
        model=ErrorComponent(apart.where(dataset.quantity == EVERY, 0.0), text),
    )


def mean_squares(cases, name, correction, chosen, off):
    """Mean square deviation in one quantity, (draw, gamma), with the errors drawn.

    The points of a case are off together.
    """
    squares, mixed, errors = map(np.array, zip(*(case[name] for case in cases), strict=True))
    at, shift = (chosen, correction), off[QUANTITIES.index(name)][..., None]
    moved = squares[at] - 2 * shift * mixed[at] + shift**2 * errors[chosen][..., None]
    return moved.mean(axis=1)


def lowest(curves):
    """Gamma at the lowest point of one or several cubic splines over ln gamma, within the grid."""
    cubic, square, slope, level = curves.c
    length = np.diff(curves.x).reshape(-1, *[1] * (slope.ndim - 1))
    # Both zeros of 3 cubic x^2 + 2 square x + slope, in the form without cancellation.
    with np.errstate(invalid="ignore", divide="ignore"):
        half = -(square + np.copysign(np.sqrt(square**2 - 3 * cubic * slope), square))
        zeros = np.stack([half / (3 * cubic), slope / half])
    inside = np.where((zeros > 0) & (zeros < length), zeros, 0.0)
    at = np.concatenate([inside, length * np.ones_like(inside[:1])])
    values = ((cubic * at + square) * at + slope) * at + level
    at += curves.x[:-1].reshape(length.shape)
    at, values = (part.reshape(-1, *slope.shape[1:]) for part in (at, values))
    return np.exp(np.take_along_axis(at, values.argmin(axis=0)[None], axis=0)[0])
