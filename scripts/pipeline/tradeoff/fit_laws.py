"""Laws of `stickiness.accuracy`, fitted to what was measured."""

from __future__ import annotations

from collections import defaultdict

import numpy as np
import xarray as xr
from scipy import optimize

from pipeline.tradeoff.measuring import COVERED, derived, rms
from pipeline.tradeoff.seed_pool import extrapolated
from stickiness.accuracy import multilevel
from stickiness.accuracy.error_models import COARSE, FULL, ErrorModel

FEATURES = ("constant", "hurst", "magnification", "window", "pressure", "pixels", "tolerance")
FLOOR = 1e-10  # errors below are nothing, and say nothing of how they depend on what
CAUTIOUS = "carrying"  # the part of which noise exceeds the error itself, in areas
STIFF = 8.0  # twice the variance of exponents before anything is known of them


class Points:
    """Collects measured values and what they depend on, by part and quantity."""

    def __init__(self):
        self.rows = defaultdict(list)

    def add(self, part, quantity, surface, value, pressure=1.0, pixels=1.0, tolerance=1.0, noise=0):
        """Add a value, and if it is not known well the standard error of it."""
        row = [
            1.0,
            surface.hurst,
            *np.log([surface.magnification, surface.window, pressure, pixels, tolerance]),
        ]
        self.rows[part, quantity].append((row, value, noise))

    def laws(self):
        """Fit every part: least squares of logarithms, or what is likeliest of noisy values."""
        return {
            key: likeliest(rows, key[0] == CAUTIOUS) if any(n for *_, n in rows) else fitted(rows)
            for key, rows in self.rows.items()
        }


def fitted(rows):
    """Fit one law; features that no two points differ in stay out."""
    rows = [row for row in rows if row[1] > FLOOR] or rows[-1:]
    features = np.array([row for row, *_ in rows])
    values = np.maximum([value for _, value, _ in rows], FLOOR)
    varied = varying(features)
    coefficients = np.zeros(features.shape[1])
    coefficients[varied], *_ = np.linalg.lstsq(features[:, varied], np.log(values))
    return law_of(coefficients, values / np.exp(features @ coefficients))


def likeliest(rows, cautious=False):
    """Law of the standard deviation of what may have either sign and is known with some noise.

    Values are taken as normal about zero, their variance being that of the law and of the noise.
    Few realisations thus do not make out an error to be larger than it is. The spread is that over
    laws fitted without the surface that a value is of. To be cautious, noise counts as error in it,
    of surfaces that the law is fitted to: without those it would not know the error from the noise.
    """
    features, values, noise = (np.array(part) for part in zip(*rows, strict=True))
    surfaces = [tuple(row) for row in features[:, 1:4]]
    every, ratio = np.ones(len(rows), bool), np.empty(len(rows))
    for one in set(surfaces):
        own = np.array([surface == one for surface in surfaces])
        others = every if cautious or own.all() else ~own
        law = np.exp(features[own] @ likeliest_exponents(features, values, noise, others))
        ratio[own] = np.abs(values[own]) / np.hypot(law, 0.0 if cautious else noise[own])
    return law_of(likeliest_exponents(features, values, noise, every), ratio)


def likeliest_exponents(features, values, noise, chosen):
    """Coefficients of the features by some of the values."""
    features, values, noise = features[chosen], values[chosen], noise[chosen]
    varied = varying(features)
    centre = np.where(np.arange(varied.sum()) > 0, features[:, varied].mean(0), 0.0)
    apart = features[:, varied] - centre

    def unlikely(coefficients):
        own = np.exp(2 * apart @ coefficients) + noise**2
        return 0.5 * np.sum(np.log(own) + values**2 / own) + np.sum(coefficients[1:] ** 2) / STIFF

    begin = np.zeros(varied.sum())
    begin[0] = np.log(np.sqrt(np.mean(values**2)))
    found = optimize.minimize(unlikely, begin, method="BFGS").x
    coefficients = np.zeros(features.shape[1])
    coefficients[varied] = found
    coefficients[0] -= centre @ found
    return coefficients


def varying(features):
    """Which features differ between points; the constant counts."""
    varied = np.ptp(features, axis=0) > 0
    varied[0] = True
    return varied


def law_of(coefficients, ratio):
    """Law of coefficients, with the ratios of what was measured to it."""
    return ErrorModel(
        **dict(zip(FEATURES, coefficients.tolist(), strict=True)),
        spread=float(np.quantile(ratio, COVERED)),
        points=len(ratio),
    )


def add_sampling(points, surface, bank):
    """Scatter of single surfaces, and what either control leaves of it."""
    finest = max(bank.fine)
    add = {"surface": surface}
    for (quantity, load), scatter in bank.by_quantity(relative(bank.fine[finest], bank)).items():
        points.add("scatter", quantity, **add, value=scatter, pressure=load)
    for pixels, fine in bank.fine.items():
        if pixels == COARSE:
            continue
        twin = bank.fine[COARSE][: len(fine)]
        left = fine - fine.sum(0) / twin.sum(0) * twin
        share = bank.by_quantity(left.std(0, ddof=1) / fine.std(0, ddof=1))
        for (quantity, load), value in share.items():
            points.add("fine_share", quantity, **add, value=value, pressure=load, pixels=pixels)
    estimate = multilevel.controlled_mean(bank.coarse, bank.controls, bank.elsewhere)
    slopes = np.std(bank.elsewhere @ estimate.coefficient, axis=0, ddof=1)
    explained = slopes / bank.coarse.std(0, ddof=1)
    left = bank.by_quantity(np.sqrt(1 - np.minimum(explained, 1) ** 2))
    for (quantity, load), value in left.items():
        points.add("coarse_share", quantity, **add, value=value, pressure=load)


def add_offsets(points, surface, bank):
    """Errors of means by the grid, with their own standard errors."""
    for pixels, parts in bank.offsets.items():
        off, noise = (bank.by_quantity(part) for part in parts)
        if pixels > COARSE:
            for (quantity, load), value in off.items():
                points.add(
                    "discretisation",
                    quantity,
                    surface,
                    value,
                    load,
                    float(pixels),
                    noise=noise[quantity, load],
                )


def relative(values, bank):
    """Standard deviation between seeds over the mean, per entry."""
    return values.std(0, ddof=1) / np.abs(bank.truth)


def add_costs(points, surface, measured):
    """Cost of one solution on every grid, with its surface and areas; of describing a seed."""
    unit, loads = float(measured.pair_time), measured.sizes["pressure"]
    for pixels in measured.pixels.values:
        seconds = float(measured.seconds.sel(pixels=pixels).mean())
        points.add("fine_cost", "", surface, seconds / loads / unit, pixels=float(pixels))
    points.add("coarse_cost", "", surface, float(measured.coarse_seconds.mean()) / loads / unit)
    points.add("described_cost", "", surface, float(measured.describing_seconds) / unit)


def estimates(measured):
    """Ways from solutions to quantities: a name, values on all grids, and the grids they need."""
    counted = measured.assign(
        area_fraction=measured.pixel_area_fraction,
        attractive_area=measured.pixel_attractive_area,
    )
    yield "counted", derived(counted), 1
    yield "sub-pixel", derived(measured), 1
    order = np.argsort(measured.pixels.values)
    halves = np.clip(order - 1, 0, None)
    half = measured.isel(setting=halves).assign_coords(setting=measured.setting)
    area = xr.concat(
        [
            measured.attractive_area.isel(setting=k)
            if measured.pixels.values[k] == COARSE
            else extrapolated(half.isel(setting=k), measured.isel(setting=k))
            for k in range(measured.sizes["setting"])
        ],
        "setting",
    )
    yield "extrapolated", derived(measured.assign(attractive_area=area)), 2


def by_knob(measured, knob):
    chosen = measured.isel(setting=np.flatnonzero(measured.knob == knob))
    return chosen.assign_coords(setting=np.arange(chosen.sizes["setting"]))


def add_grids(points, surface, measured):
    """Points of the laws of the solver and of what a tolerance saves."""
    chosen = by_knob(measured, "tolerance")
    seconds = (chosen.solution_time + chosen.evaluation_time).mean(["seed", "pressure"])
    full = float(seconds[int(np.argmin(abs(np.log(chosen.tolerance.values / FULL))))])
    for k, tolerance in enumerate(chosen.tolerance.values[:-1]):
        points.add(
            "tolerance_cost", "", surface, float(seconds[k]) / full, tolerance=tolerance / FULL
        )
        for quantity, values in derived(chosen).items():
            error = rms(values.isel(setting=k) / values.isel(setting=-1) - 1)
            for load in error.pressure.values:
                value = float(np.sqrt((error.sel(pressure=load) ** 2).mean()))
                points.add("solver", quantity, surface, value, load, tolerance=tolerance)
