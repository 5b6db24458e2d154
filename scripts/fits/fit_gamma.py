"""The gamma of each correction of the theory that agrees best with simulation, and how well.

Cases of one window are made with the same seeds, so they share their long waves and most of their
deviations (correlations of 0.9 to 1). Their errors rise and fall together, and confidence intervals
are taken by resampling windows together with their cases.
"""

from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray
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
INTERVAL = f"{CONFIDENCE:.0%} confidence interval of gamma, over windows, their cases and errors"
MISFIT = "root mean square of ln(theory/simulation) at the"
GAMMA_VARIABLES = {
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


@dataclass(frozen=True)
class Deviations:
    """ln(theory/simulation) of a quantity in one case, averaged over its points.

    `squares` and `products` are along correction and gamma.
    """

    squares: NDArray  # mean square of the deviation
    products: NDArray  # mean product with the relative error of the simulation
    errors: NDArray  # mean square of this error


@dataclass(frozen=True)
class Case:
    """Deviations of a case by quantity, and its window in longest waves."""

    window: float
    deviations: dict[str, Deviations]


@dataclass(frozen=True)
class Draws:
    """Cases that are drawn, and how many errors each quantity of each is off by."""

    cases: NDArray  # (draw, case)
    off: NDArray  # (quantity, draw, case)


def write_gamma(ensembles, comparisons, output):
    """Write the gamma that agrees best with the means in files, and the comparisons behind it."""
    cases = []
    for ensemble_file, comparison_file in zip(ensembles, comparisons, strict=True):
        comparison = datasets.read(comparison_file, ["window_holds"])
        case = compare_gammas(datasets.read(ensemble_file), comparison)
        if case:
            cases.append(case)
    windows = [case.window for case in cases]
    randomness = {"draws": 1000, "seed": 1}
    draws = sample(np.random.default_rng(randomness["seed"]), randomness["draws"], windows)
    rows = [
        [fit(cases, draws, index, quantity) for quantity in (*QUANTITIES, EVERY)]
        for index in range(len(CORRECTIONS))
    ]
    names = ("gamma", "gamma_low", "gamma_high", "spread", "misfit", "misfit_own")
    dims = ("correction", "quantity")
    values = np.moveaxis(rows, -1, 0)
    dataset = xr.Dataset(
        {name: (dims, value) for name, value in zip(names, values, strict=True)},
        coords={"correction": list(CORRECTIONS), "quantity": [*QUANTITIES, EVERY]},
    )
    each = dataset.sel(quantity=list(QUANTITIES))
    agree = each.gamma_low.max("quantity") <= each.gamma_high.min("quantity")
    dataset["quantities_agree"] = agree.astype("i1")
    dataset["own_gamma"] = "correction", [correction_of(name).gamma for name in CORRECTIONS]
    title = "gamma of the corrections of Persson's theory by simulation"
    parameters = {"cases": len(cases), "ranges": RANGES, "loads": LOADS} | randomness
    gamma = add_budgets(annotate(dataset.drop_vars("spread"), **GAMMA_VARIABLES), dataset.spread)
    datasets.write(gamma, output, title=title, parameters=parameters)


def compare_gammas(ensemble, comparison):
    """Compare theory at every gamma with one case, at loads whose window holds summits enough.

    None if there is no such load.
    """
    parameters = datasets.parameters(ensemble)
    lattice = lattice_spectrum(model_spectrum(parameters), cell_size(parameters))
    ensemble = ensemble.isel(pressure=comparison.window_holds.values == 1)
    if not ensemble.sizes["pressure"]:
        return None
    few = np.unique(ensemble.pressure.sel(pressure=list(LOADS), method="nearest"))

    # Logarithms by theory, along correction and gamma.
    theory = {name: [] for name in QUANTITIES}
    for correction in CORRECTIONS:
        theories = [Persson(lattice, gamma=g, correction=correction) for g in GRID]
        for name in ("area_fraction", "mean_gap"):
            values = [getattr(t, name)(ensemble.pressure.values) for t in theories]
            theory[name].append(np.log(values))
        coarser = [Persson(lattice, gamma=g, correction=correction, nodes=0.5) for g in FEW]
        areas = [t.gap_cumulative(np.array(RANGES), few).ravel() for t in coarser]
        theory["attractive_area"].append(CubicSpline(np.log(FEW), np.log(areas))(np.log(GRID)))

    deviations = {}
    for name, logs in theory.items():
        simulated = ensemble[[f"{name}_mean", f"{name}_mean_total_error"]]
        simulated = simulated.transpose("pressure", ...)
        if "range" in simulated.dims:
            simulated = simulated.sel(pressure=few).interp({"range": list(RANGES)})
        mean, error = (part.values.ravel() for part in simulated.values())
        off = np.array(logs) - np.log(mean)
        error = np.nan_to_num(error / COVERS / mean)
        deviations[name] = Deviations(
            squares=np.mean(off**2, axis=-1),
            products=np.mean(off * error, axis=-1),
            errors=np.mean(error**2),
        )
    return Case(parameters["window"], deviations)


def sample(rng, count, windows):
    """Draw cases, and how many errors each quantity of each is off by.

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
    return Draws(chosen, np.take_along_axis(off, member[chosen][None], axis=2))


def fit(cases, draws, correction, quantity):
    """Gamma, the ends of its interval, the 90 % spread, the misfits at it and at the source's."""
    names = QUANTITIES if quantity == EVERY else (quantity,)

    def average(chosen):
        squares = [mean_squares(cases, name, correction, chosen) for name in names]
        return np.mean(squares, axis=0)

    # Every case once, with its values as they are.
    every = np.arange(len(cases))[None]
    still = Draws(every, np.zeros((len(QUANTITIES), *every.shape)))
    curve = CubicSpline(np.log(GRID), average(still)[0])
    best = lowest(curve)

    gammas = lowest(CubicSpline(np.log(GRID), average(draws), axis=1))
    low, high = np.quantile(gammas, [0.5 - CONFIDENCE / 2, 0.5 + CONFIDENCE / 2])
    spread = np.quantile(np.abs(gammas - best), 0.9)
    log_gammas = np.log([best, correction_of(CORRECTIONS[correction]).gamma])
    misfit, own_misfit = np.sqrt(np.maximum(curve(log_gammas), 0.0))
    return best, low, high, spread, misfit, own_misfit


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


def mean_squares(cases, name, correction, draws):
    """Mean square deviation in one quantity, (draw, gamma), with the errors drawn.

    The points of a case are off together.
    """
    squares = np.array([case.deviations[name].squares[correction] for case in cases])
    products = np.array([case.deviations[name].products[correction] for case in cases])
    errors = np.array([case.deviations[name].errors for case in cases])
    chosen = draws.cases
    shift = draws.off[QUANTITIES.index(name)][..., None]
    moved = squares[chosen] - 2 * shift * products[chosen] + shift**2 * errors[chosen][..., None]
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
    places = np.concatenate([inside, length * np.ones_like(inside[:1])])
    values = ((cubic * places + square) * places + slope) * places + level
    places += curves.x[:-1].reshape(length.shape)
    places = places.reshape(-1, *slope.shape[1:])
    values = values.reshape(-1, *slope.shape[1:])
    return np.exp(np.take_along_axis(places, values.argmin(axis=0)[None], axis=0)[0])
