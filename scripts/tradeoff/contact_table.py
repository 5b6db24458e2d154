"""Rows of the table and points of the error models for contact without adhesion."""

import numpy as np

from common.model_surfaces import cell_size, model_spectrum
from common.theory import contact_of
from stickiness import datasets
from stickiness.accuracy import multilevel
from stickiness.accuracy.error_models import COARSE, FULL, Settings
from stickiness.persson.theory import Persson
from stickiness.surface import lattice_spectrum
from tradeoff.measuring import COVERED, derive_columns, select, time_task
from tradeoff.seed_pool import FEWEST_FINE, Resampling, flatten, make_pool

MEANS = ((4, 0), (8, 0), (16, 0), (32, 0), (2, 64), (4, 64), (8, 64), (4, 256), (8, 256))


def tabulate_contact(measured, records):
    """Add rows and points of one file of `measure_contact`."""
    pool, grid_errors = make_pool(measured)
    tabulate_grids(pool, grid_errors, records)
    tabulate_tolerances(measured, records)
    tabulate_seeds(pool, records)
    tabulate_theory(measured, pool, records)


def cover(errors):
    """Errors of single surfaces that cover 90 %, by quantity and load."""
    return {key: np.quantile(np.abs(error), COVERED) for key, error in errors.items()}


def tabulate_grids(pool, grid_errors, records):
    """Errors of single surfaces against the finest grid, errors of means, and costs."""
    loads = len(np.unique(pool.pressure))
    *grids, finest = sorted(pool.fine)
    exact = pool.fine[finest]
    for pixels in grids:
        errors = cover(pool.by_quantity(pool.fine[pixels][: len(exact)] / exact - 1))
        # Areas are extrapolated from two grids.
        cost = pool.costs[pixels] + (pool.costs[pixels // 2] if pixels > COARSE else 0.0)
        records.add("points per wavelength", str(pixels), errors, cost / loads)
    for pixels, parts in grid_errors.items():
        if pixels > COARSE:
            errors, noise = (pool.by_quantity(part) for part in parts)
            for (quantity, load), error in errors.items():
                at = {"pressure": load, "pixels": pixels}
                records.add_point("discretisation", quantity, error, noise[quantity, load], **at)
    for pixels in pool.fine:
        records.add_point("fine_cost", "", pool.costs[pixels] / loads, pixels=pixels)
    records.add_point("coarse_cost", "", pool.costs["coarse"] / loads)
    records.add_point("described_cost", "", pool.costs["described"])


def tabulate_tolerances(measured, records):
    """Errors by the solver's tolerance, and the share of the cost that a larger one leaves."""
    made, unit = datasets.parameters(measured), float(measured.pair_time)
    at_pixels = made["at_pixels"]
    tolerances = np.unique(measured.tolerance.sel(solution=measured.pixels == at_pixels))
    best = select(measured, at_pixels, tolerances[0])
    exact, loads = derive_columns(best), best.sizes["pressure"]
    solved = {t: select(measured, at_pixels, t).sel(seed=best.seed) for t in tolerances[1:]}
    full = float(solved[made["tolerance"]].seconds.mean())
    for tolerance, solutions in solved.items():
        seconds = float(solutions.seconds.mean())
        records.add_point("tolerance_cost", "", seconds / full, tolerance=tolerance / FULL)
        single = {}
        for quantity, values in derive_columns(solutions).items():
            square = (values / exact[quantity] - 1) ** 2
            error = np.sqrt(square.mean([d for d in square.dims if d not in ("seed", "pressure")]))
            for load in error.pressure.values:
                one = single[quantity, load] = error.sel(pressure=load).values
                at = {"pressure": load, "tolerance": tolerance}
                records.add_point("solver", quantity, np.sqrt((one**2).mean()), **at)
        records.add("tolerance", f"{tolerance:g}", cover(single), seconds / loads / unit)


def tabulate_seeds(pool, records):
    """Errors of means by the number and kind of seeds, on the finest grid that has many."""
    best = max(p for p, fine in pool.fine.items() if len(fine) >= FEWEST_FINE)

    def add(part, shares, **knob):
        for (quantity, load), share in pool.by_quantity(shares).items():
            records.add_point(part, quantity, share, pressure=load, **knob)

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

    resampling, loads = Resampling(pool), len(np.unique(pool.pressure))
    for seeds, more in MEANS:
        settings = Settings(best, FULL, seeds, more)
        text = f"{seeds} + {more}" if more else f"{seeds} plain"
        records.add("seeds", text, cover(resampling.draw(settings)), pool.cost(settings) / loads)


def tabulate_theory(measured, pool, records):
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
        records.add_point("theory", quantity, error, noise[quantity, load], pressure=load)
    records.add("model", "theory", errors, seconds / len(loads) / float(measured.pair_time))
