"""Rows of the table and points of the error models for contact without adhesion."""

from __future__ import annotations

import numpy as np
import xarray as xr

from common.model_surfaces import cell_size, model_spectrum
from common.theory import contact_of
from stickiness import datasets
from stickiness.accuracy import multilevel
from stickiness.accuracy.error_models import COARSE, FULL, Settings, Surface
from stickiness.persson.theory import Persson
from stickiness.surface import lattice_spectrum
from tradeoff.fit_models import Conditions, Points
from tradeoff.measuring import COVERED, derive_columns, rms, time_task
from tradeoff.seed_pool import FEWEST_FINE, Resampling, SeedPool, flatten, rename_seeds
from tradeoff.summary import list_rows

REPETITIONS = 60  # of means that are resampled
DESCRIBED_SEEDS = 2048
MEANS = ((4, 0), (8, 0), (16, 0), (32, 0), (2, 64), (4, 64), (8, 64), (4, 256), (8, 256))


def tabulate_contact(
    name: str, measured: xr.Dataset, pool: SeedPool, points: Points
) -> list[tuple]:
    """List the rows of one file of `measure_contact`, and add its points."""
    surface = Surface.of(datasets.parameters(measured))
    return [
        *tabulate_grids(name, surface, measured, pool, points),
        *tabulate_tolerances(name, surface, measured, points),
        *tabulate_seeds(name, surface, measured, pool, points),
        *tabulate_theory(name, surface, measured, pool, points),
    ]


def tabulate_grids(name, surface, measured, pool, points):
    """Errors of single surfaces against the finest grid, errors of means, and costs."""
    rows, unit, loads = [], float(measured.pair_time), measured.sizes["pressure"]
    seconds = {
        int(p): float(t) / loads for p, t in measured.seconds.mean("seed").to_series().items()
    }
    *grids, finest = sorted(pool.fine)
    exact = pool.fine[finest]
    for pixels in grids:
        single = pool.by_quantity(pool.fine[pixels][: len(exact)] / exact - 1)
        covering = {key: np.quantile(error, COVERED) for key, error in single.items()}
        # Areas are extrapolated from two grids.
        cost = seconds[pixels] + (seconds[pixels // 2] if pixels > COARSE else 0.0)
        where = "contact", "points per wavelength", str(pixels), name
        rows += list_rows(where, covering, cost, unit)
    for pixels, parts in pool.grid_errors.items():
        if pixels > COARSE:
            errors, noise = (pool.by_quantity(part) for part in parts)
            for (quantity, load), error in errors.items():
                at = Conditions(surface, load, float(pixels))
                points.add("discretisation", quantity, at, error, noise[quantity, load])
    for pixels, cost in seconds.items():
        points.add("fine_cost", "", Conditions(surface, pixels=float(pixels)), cost / unit)
    coarse = float(measured.coarse_seconds.mean())
    points.add("coarse_cost", "", Conditions(surface), coarse / loads / unit)
    points.add("described_cost", "", Conditions(surface), float(measured.describing_seconds) / unit)
    return rows


def tabulate_tolerances(name, surface, measured, points):
    """Errors by the solver's tolerance, and the share of the cost that a larger one leaves."""
    rows, unit = [], float(measured.pair_time)
    solved = rename_seeds(measured, "tolerance")
    quantities, tolerances = derive_columns(solved), measured.tolerance.values
    seconds = measured.tolerance_seconds.mean("tolerance_seed") / measured.sizes["pressure"]
    full = float(seconds.sel({"tolerance": FULL}, method="nearest"))
    for tolerance in tolerances[:-1]:
        cost = float(seconds.sel({"tolerance": tolerance}))
        points.add(
            "tolerance_cost", "", Conditions(surface, tolerance=tolerance / FULL), cost / full
        )
        covering = {}
        for quantity, values in quantities.items():
            exact = values.sel({"tolerance": tolerances[-1]})
            error = rms(values.sel({"tolerance": tolerance}) / exact - 1)
            for load in error.pressure.values:
                single = error.sel(pressure=load)
                covering[quantity, float(load)] = float(single.quantile(COVERED))
                at = Conditions(surface, load, tolerance=tolerance)
                points.add("solver", quantity, at, float(np.sqrt((single**2).mean())))
        rows += list_rows(("contact", "tolerance", f"{tolerance:g}", name), covering, cost, unit)
    return rows


def tabulate_seeds(name, surface, measured, pool, points):
    """Errors of means by the number and kind of seeds, on the finest grid that has many."""
    best = max(p for p, fine in pool.fine.items() if len(fine) >= FEWEST_FINE)

    def add(part, shares, **knob):
        for (quantity, load), share in pool.by_quantity(shares).items():
            points.add(part, quantity, Conditions(surface, load, **knob), share)

    add("scatter", pool.fine[best].std(0, ddof=1) / np.abs(pool.truth))
    for pixels, fine in pool.fine.items():
        if pixels != COARSE:
            twin = pool.fine[COARSE][: len(fine)]
            left = fine - fine.sum(0) / twin.sum(0) * twin
            add("fine_share", left.std(0, ddof=1) / fine.std(0, ddof=1), pixels=pixels)
    estimate = multilevel.controlled_mean(pool.coarse, pool.controls, pool.elsewhere)
    slopes = np.std(pool.elsewhere @ estimate.coefficient, axis=0, ddof=1)
    explained = slopes / pool.coarse.std(0, ddof=1)
    add("coarse_share", np.sqrt(1 - np.minimum(explained, 1) ** 2))

    rows, resampling = [], Resampling(pool, REPETITIONS, DESCRIBED_SEEDS)
    loads, unit = measured.sizes["pressure"], float(measured.pair_time)
    grids = sorted({best, best // 2, COARSE})
    one = float(measured.seconds.mean("seed").sel(pixels=grids).sum()) / loads
    coarse = float(measured.coarse_seconds.mean()) / loads
    describe = float(measured.describing_seconds) * DESCRIBED_SEEDS / loads
    for seeds, more in MEANS:
        errors = pool.by_quantity(resampling.draw(Settings(best, FULL, seeds, more))[0])
        covering = {key: np.quantile(error, COVERED) for key, error in errors.items()}
        seconds = seeds * one + more * coarse + (describe if more else 0.0)
        text = f"{seeds} + {more}" if more else f"{seeds} plain"
        rows += list_rows(("contact", "seeds", text, name), covering, seconds, unit)
    return rows


def tabulate_theory(name, surface, measured, pool, points):
    """Errors of Persson's theory on the lattice spectrum, relative to the simulation."""
    parameters, loads = datasets.parameters(measured), measured.pressure.values
    lattice = lattice_spectrum(model_spectrum(parameters), cell_size(parameters))
    state, seconds = time_task(
        lambda: contact_of(Persson(lattice), loads, measured["range"].values)
    )
    values, *_ = flatten(derive_columns(state.expand_dims("seed")))
    errors = pool.by_quantity(values[0] / pool.truth - 1)
    noise = pool.by_quantity(pool.truth_error / pool.truth)
    for (quantity, load), error in errors.items():
        at = Conditions(surface, load)
        points.add("theory", quantity, at, float(error), float(noise[quantity, load]))
    where = "contact", "model", "theory", name
    return list_rows(where, errors, seconds / len(loads), float(measured.pair_time))
