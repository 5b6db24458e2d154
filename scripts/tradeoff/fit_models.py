"""Fit the error models of `stickiness.accuracy.error_models` to what was measured."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import optimize

from stickiness.accuracy.error_models import ErrorModel, Surface
from tradeoff.measuring import COVERED

FEATURES = ("constant", "hurst", "magnification", "window", "pressure", "pixels", "tolerance")
FLOOR = 1e-10  # errors below are rounding and do not tell how they depend on anything
PRIOR = 8.0  # twice the variance of exponents before anything is known of them


@dataclass(frozen=True)
class Conditions:
    """What an error or a cost depends on."""

    surface: Surface
    pressure: float = 1.0
    pixels: float = 1.0
    tolerance: float = 1.0

    def features(self) -> list[float]:
        """Values of `FEATURES`."""
        surface = self.surface
        sizes = surface.magnification, surface.window, self.pressure, self.pixels, self.tolerance
        return [1.0, surface.hurst, *np.log(sizes)]


class Points:
    """Collects measured values and what they depend on, by part and quantity."""

    def __init__(self):
        self.rows = defaultdict(list)

    def add(
        self, part: str, quantity: str, at: Conditions, value: float, noise: float = 0.0
    ) -> None:
        """Add a value and its standard error; zero if it is known well."""
        self.rows[part, quantity].append((at.features(), value, noise))

    def fit(self) -> dict[tuple[str, str], ErrorModel]:
        """Fit every part: least squares of logarithms, or maximum likelihood of noisy values."""
        return {
            key: fit_noisy(rows) if any(noise for *_, noise in rows) else fit_least_squares(rows)
            for key, rows in self.rows.items()
        }


def fit_least_squares(rows: list[tuple]) -> ErrorModel:
    """Fit one model to logarithms; features that no two points differ in stay out."""
    rows = [row for row in rows if row[1] > FLOOR] or rows[-1:]
    features = np.array([row for row, *_ in rows])
    values = np.maximum([value for _, value, _ in rows], FLOOR)
    varied = find_varied(features)
    coefficients = np.zeros(features.shape[1])
    coefficients[varied], *_ = np.linalg.lstsq(features[:, varied], np.log(values))
    return make_model(coefficients, values / np.exp(features @ coefficients))


def fit_noisy(rows: list[tuple]) -> ErrorModel:
    """Fit the standard deviation of values of either sign that are known with some noise.

    Values are taken as normal about zero with the variances of the model and of the noise, so that
    few realisations do not make an error seem larger than it is. The spread compares each value
    with a model fitted without its surface.
    """
    features, values, noise = (np.array(part) for part in zip(*rows, strict=True))
    surfaces = features[:, 1:4]
    every, ratio = np.ones(len(rows), bool), np.empty(len(rows))
    for surface in np.unique(surfaces, axis=0):
        here = (surfaces == surface).all(axis=1)
        others = every if here.all() else ~here
        model = np.exp(features[here] @ maximise_likelihood(features, values, noise, others))
        ratio[here] = np.abs(values[here]) / np.hypot(model, noise[here])
    return make_model(maximise_likelihood(features, values, noise, every), ratio)


def maximise_likelihood(
    features: NDArray, values: NDArray, noise: NDArray, chosen: NDArray
) -> NDArray:
    """Coefficients of the features that are likeliest, by the chosen values."""
    features, values, noise = features[chosen], values[chosen], noise[chosen]
    varied = find_varied(features)
    centre = np.where(np.arange(varied.sum()) > 0, features[:, varied].mean(0), 0.0)
    apart = features[:, varied] - centre

    def log_unlikelihood(coefficients):
        variance = np.exp(2 * apart @ coefficients) + noise**2
        misfit = 0.5 * np.sum(np.log(variance) + values**2 / variance)
        return misfit + np.sum(coefficients[1:] ** 2) / PRIOR

    begin = np.zeros(varied.sum())
    begin[0] = np.log(np.sqrt(np.mean(values**2)))
    found = optimize.minimize(log_unlikelihood, begin, method="BFGS").x
    coefficients = np.zeros(features.shape[1])
    coefficients[varied] = found
    coefficients[0] -= centre @ found
    return coefficients


def find_varied(features: NDArray) -> NDArray:
    """Which features differ between points; the constant counts."""
    varied = np.ptp(features, axis=0) > 0
    varied[0] = True
    return varied


def make_model(coefficients: NDArray, ratio: NDArray) -> ErrorModel:
    """Model with these coefficients; `ratio` holds the measured values over it."""
    return ErrorModel(
        **dict(zip(FEATURES, coefficients.tolist(), strict=True)),
        spread=float(np.quantile(ratio, COVERED)),
        points=len(ratio),
    )
