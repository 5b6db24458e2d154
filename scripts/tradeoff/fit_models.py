"""Collect what was measured, and fit the error models of `stickiness.accuracy.error_models`."""

import numpy as np
import pandas as pd
from scipy import optimize

from stickiness.accuracy.error_models import ErrorModel
from tradeoff.measuring import COVERED

SIZES = ["magnification", "window", "pressure", "pixels", "tolerance"]
FLOOR = 1e-10  # errors below are rounding and do not tell how they depend on anything
PRIOR = 8.0  # twice the variance of exponents before anything is known of them


class Records:
    """Rows of the table, and the points that error models are fitted to."""

    def __init__(self):
        self.rows = []
        self.points = []

    def start(self, problem, name, surface):
        """Name the problem and the surface of what is added from now on."""
        self.problem = problem
        self.name = name
        self.surface = vars(surface)

    def add(self, setting, value, errors, cost):
        """Add a row for every quantity and load, with what covers 90 % of its errors."""
        for (quantity, load), every in errors.items():
            error = np.nanquantile(np.abs(every), COVERED)
            if np.isfinite(error):
                row = {"problem": self.problem, "quantity": quantity, "setting": setting}
                row |= {"value": value, "surface": self.name, "pressure": float(load)}
                self.rows.append(row | {"error": float(error), "cost": float(cost)})

    def add_points(self, part, values, noise=None, **knob):
        """Add a point for every value, by quantity and load."""
        for (quantity, load), value in values.items():
            error = noise[quantity, load] if noise else 0.0
            self.add_point(part, quantity, value, error, pressure=load, **knob)

    def add_point(self, part, quantity, value, noise=0.0, **knobs):
        """Add a value of one part of the error models and its standard error, 0 if known well."""
        point = {"part": part, "quantity": quantity, "value": float(value), "noise": float(noise)}
        self.points.append(dict.fromkeys(SIZES, 1.0) | self.surface | knobs | point)


def fit_models(points):
    """Fit a model to the points of every part and quantity."""
    models = {}
    for key, group in pd.DataFrame(points).groupby(["part", "quantity"], sort=False):
        features = np.column_stack([np.ones(len(group)), group.hurst, np.log(group[SIZES])])
        values = group.value.to_numpy()
        noise = group.noise.to_numpy()
        if noise.any():
            coefficients, ratio = fit_noisy(features, values, noise)
        else:
            coefficients, ratio = fit_least_squares(features, values)
        spread = float(np.quantile(ratio, COVERED))
        models[key] = ErrorModel(*coefficients.tolist(), spread=spread, points=len(ratio))
    return models


def fit_least_squares(features, values):
    """Fit logarithms: coefficients, 0 of what no two points differ in, and values over the fit."""
    kept = values > FLOOR
    if not kept.any():
        kept[-1] = True
    features = features[kept]
    values = np.maximum(values[kept], FLOOR)
    varied = find_varied(features)
    coefficients = np.zeros(features.shape[1])
    coefficients[varied], *_ = np.linalg.lstsq(features[:, varied], np.log(values))
    return coefficients, values / np.exp(features @ coefficients)


def fit_noisy(features, values, noise):
    """Fit the standard deviation of values of either sign that are known with some noise."""
    # The spread compares each value with a model fitted without its surface.
    surfaces = features[:, 1:4]
    ratio = np.empty(len(values))
    for surface in np.unique(surfaces, axis=0):
        here = (surfaces == surface).all(axis=1)
        others = here if here.all() else ~here
        fitted = maximise_likelihood(features[others], values[others], noise[others])
        ratio[here] = np.abs(values[here]) / np.hypot(np.exp(features[here] @ fitted), noise[here])
    return maximise_likelihood(features, values, noise), ratio


def maximise_likelihood(features, values, noise):
    """Likeliest coefficients for values that are normal about zero by the model and the noise."""
    varied = find_varied(features)
    centre = np.where(np.arange(varied.sum()) > 0, features[:, varied].mean(0), 0.0)
    apart = features[:, varied] - centre

    def log_unlikelihood(coefficients):
        variance = np.exp(2 * apart @ coefficients) + noise**2
        misfit = 0.5 * np.sum(np.log(variance) + values**2 / variance)
        return misfit + np.sum(coefficients[1:] ** 2) / PRIOR

    begin = np.zeros(varied.sum())
    begin[0] = np.log(np.sqrt(np.mean(values**2)))
    likeliest = optimize.minimize(log_unlikelihood, begin, method="BFGS").x
    coefficients = np.zeros(features.shape[1])
    coefficients[varied] = likeliest
    coefficients[0] -= centre @ likeliest
    return coefficients


def find_varied(features):
    """Which features differ between points; the constant counts."""
    varied = np.ptp(features, axis=0) > 0
    varied[0] = True
    return varied
