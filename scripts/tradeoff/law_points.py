"""Points of the laws of contact without adhesion, from the files of the measurements."""

from __future__ import annotations

import itertools

import numpy as np
import xarray as xr

from stickiness.accuracy import multilevel
from stickiness.accuracy.error_models import COARSE, FULL, Surface
from stickiness.accuracy.extrapolation import CARRIED_TIMES
from tradeoff.fit_laws import Conditions, Points
from tradeoff.measuring import derived, rms, select_knob
from tradeoff.seed_pool import SeedPool


def add_sampling(points: Points, surface: Surface, pool: SeedPool) -> None:
    """Add the scatter of single surfaces, and the share of it that either control leaves."""

    def add(part, shares, **knob):
        for (quantity, load), share in pool.by_quantity(shares).items():
            points.add(part, quantity, Conditions(surface, load, **knob), share)

    finest = pool.fine[max(pool.fine)]
    add("scatter", finest.std(0, ddof=1) / np.abs(pool.truth))
    for pixels, fine in pool.fine.items():
        if pixels != COARSE:
            twin = pool.fine[COARSE][: len(fine)]
            left = fine - fine.sum(0) / twin.sum(0) * twin
            add("fine_share", left.std(0, ddof=1) / fine.std(0, ddof=1), pixels=pixels)
    estimate = multilevel.controlled_mean(pool.coarse, pool.controls, pool.elsewhere)
    slopes = np.std(pool.elsewhere @ estimate.coefficient, axis=0, ddof=1)
    explained = slopes / pool.coarse.std(0, ddof=1)
    add("coarse_share", np.sqrt(1 - np.minimum(explained, 1) ** 2))


def add_grid_errors(points: Points, surface: Surface, pool: SeedPool) -> None:
    """Add errors of means by the grid, with their own standard errors."""
    for pixels, parts in pool.grid_errors.items():
        if pixels > COARSE:
            errors, noise = (pool.by_quantity(part) for part in parts)
            for (quantity, load), error in errors.items():
                at = Conditions(surface, load, float(pixels))
                points.add("discretisation", quantity, at, error, noise[quantity, load])


def add_costs(points: Points, surface: Surface, measured: xr.Dataset) -> None:
    """Add costs of a solution on every grid, with its surface and areas; of describing a seed."""
    unit, loads = float(measured.pair_time), measured.sizes["pressure"]
    for pixels in measured.pixels.values:
        seconds = float(measured.seconds.sel(pixels=pixels).mean())
        at = Conditions(surface, pixels=float(pixels))
        points.add("fine_cost", "", at, seconds / loads / unit)
    at, coarse = Conditions(surface), float(measured.coarse_seconds.mean())
    points.add("coarse_cost", "", at, coarse / loads / unit)
    points.add("described_cost", "", at, float(measured.describing_seconds) / unit)


def add_tolerances(points: Points, surface: Surface, measured: xr.Dataset) -> None:
    """Add errors by the solver's tolerance, and the share of the cost that a larger one leaves."""
    chosen = select_knob(measured, "tolerance")
    seconds = (chosen.solution_time + chosen.evaluation_time).mean(["seed", "pressure"])
    full = float(seconds[int(np.argmin(abs(np.log(chosen.tolerance.values / FULL))))])
    quantities = derived(chosen)
    for k, tolerance in enumerate(chosen.tolerance.values[:-1]):
        at = Conditions(surface, tolerance=tolerance / FULL)
        points.add("tolerance_cost", "", at, float(seconds[k]) / full)
        for quantity, values in quantities.items():
            error = rms(values.isel(setting=k) / values.isel(setting=-1) - 1)
            for load in error.pressure.values:
                value = float(np.sqrt((error.sel(pressure=load) ** 2).mean()))
                at = Conditions(surface, load, tolerance=tolerance)
                points.add("solver", quantity, at, value)


def add_extrapolations(
    points: Points,
    hurst: float,
    simulated: dict[str, xr.DataArray],
    theory: dict[str, xr.DataArray],
) -> None:
    """Add errors of theory's difference between all cuts that it may extrapolate a spectrum from.

    Relative to the value simulated, not to the broader one: that is the one at hand; and to what is
    beyond the cut, measured by how much of the area it takes. The law has the Hurst exponent alone:
    laws in cut and load too predict a Hurst exponent that they were not fitted to worse.
    """
    area, at = theory["area"], Conditions(Surface(hurst, 1))
    for low, high in itertools.combinations(area.magnification.values.tolist(), 2):
        if high > CARRIED_TIMES * low:
            continue
        cut, whole = {"magnification": low}, {"magnification": high}
        size = abs(area.sel(whole) / area.sel(cut) - 1)
        for quantity, values in simulated.items():
            change = theory[quantity].sel(whole) - theory[quantity].sel(cut)
            off = values.sel(cut) + change - values.sel(whole)
            share = off / values.sel(cut).mean("seed") / size
            noise = rms(share.std("seed", ddof=1)) / np.sqrt(share.sizes["seed"])
            for error, known in zip(rms(share.mean("seed")).values, noise.values, strict=True):
                points.add("carrying", quantity, at, float(error), float(known))
