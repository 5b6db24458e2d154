"""Error models: how errors and costs of a simulation depend on surface, load and settings.

Errors of means over random surfaces, and their costs, were measured on a few surfaces with many
settings (target `tradeoff`). Each part of an error is an `ErrorModel`: a power law in
magnification, window, pressure, pixels and tolerance, times an exponential of the Hurst exponent.
Outside the measured range (`MEASURED`) the models are evaluated at its edge and errors are doubled.
The table also has the error of Persson's theory relative to a simulation.
"""

from __future__ import annotations

import csv
import itertools
import math
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from stickiness.accuracy.quantities import MODELLED, columns_of

PARTS = ("discretisation", "solver", "scatter", "fine_share", "coarse_share", "theory")
COSTS = ("fine_cost", "coarse_cost", "described_cost", "tolerance_cost")
COARSE = 2  #: pixels per shortest wavelength of the coarse seeds, the fewest that resolve it
FULL = 1e-8  #: tolerance at which costs were measured
# Where the models were fitted or, at the largest Hurst exponent and the smallest pressure, compared
# with other simulations.
MEASURED = {
    "hurst": (0.5, 0.9),
    "magnification": (16.0, 64.0),
    "window": (1.0, 4.0),
    "pressure": (0.0065, 0.3),
}
# Finer settings have at most the error of the finest; coarser ones are outside what was measured.
FINEST = {"pixels": 16.0, "tolerance": 1e-8}
COARSEST = {"pixels": 4.0, "tolerance": 1e-3}
OUTSIDE = 2.0  #: factor by which errors outside are widened; P(u) at magnification 128 needs 1.1


@dataclass(frozen=True)
class Surface:
    """Surface as the error models see it.

    `window` is the side of the cell over the longest wavelength. Only isotropic surfaces of
    Gaussian amplitudes and heights without a roll-off were measured: ``kind_measured`` is false for
    others.
    """

    hurst: float
    magnification: float
    window: float = 1.0
    kind_measured: bool = True

    @classmethod
    def of(cls, entry: Mapping[str, Any]) -> Surface:
        """From a model surface of the configuration, or the parameters of a file."""
        isotropic = entry["anisotropy"] == 1
        gaussian = entry["amplitudes"] == "gaussian" and "heights" not in entry
        return cls(
            hurst=entry["hurst"],
            magnification=entry["magnification"],
            window=entry["window"],
            kind_measured=entry["rolloff"] is None and isotropic and gaussian,
        )


@dataclass(frozen=True, order=True)
class Settings:
    """Settings of a case; without coarse seeds means are plain."""

    pixels_per_wavelength: int
    tolerance: float
    seeds: int
    coarse_seeds: int


@dataclass(frozen=True)
class ErrorModel:
    """One measured part of an error or cost over everything that it depends on.

    `spread` is the factor above the fit below which 90 % of the measured `points` lie.
    """

    constant: float
    hurst: float = 0.0
    magnification: float = 0.0
    window: float = 0.0
    pressure: float = 0.0
    pixels: float = 0.0
    tolerance: float = 0.0
    spread: float = 1.0
    points: float = 0

    def __call__(
        self, surface: Surface, pressure: float = 1.0, pixels: float = 1.0, tolerance: float = 1.0
    ) -> float:
        """Return the value by the fit, without the spread."""
        return math.exp(
            self.constant
            + self.hurst * surface.hurst
            + self.magnification * math.log(surface.magnification)
            + self.window * math.log(surface.window)
            + self.pressure * math.log(pressure)
            + self.pixels * math.log(pixels)
            + self.tolerance * math.log(tolerance)
        )


ErrorModels = Mapping[tuple[str, str], ErrorModel]


@lru_cache
def nearest_measured(surface: Surface, pressure: float) -> tuple[Surface, float, float]:
    """Return the nearest surface and pressure measured, and the factor that widens errors there."""

    def to_measured(name, value):
        low, high = MEASURED[name]
        return min(max(value, low), high)

    nearest = replace(
        surface,
        hurst=to_measured("hurst", surface.hurst),
        magnification=to_measured("magnification", surface.magnification),
        window=to_measured("window", surface.window),
    )
    load = to_measured("pressure", pressure)
    inside = nearest == surface and load == pressure
    factor = 1.0 if inside and surface.kind_measured else OUTSIDE
    return nearest, load, factor


def single_error(
    models, part, column, surface, pressure, pixels=FINEST["pixels"], tolerance=FINEST["tolerance"]
) -> float:
    """Return one part of an error, covering 90 %; widened outside what was measured."""
    model = models[part, column]
    surface, pressure, factor = nearest_measured(surface, pressure)
    if _is_coarse(pixels, tolerance):
        factor *= OUTSIDE
    error = model(
        surface,
        pressure,
        pixels=min(pixels, FINEST["pixels"]),
        tolerance=max(tolerance, FINEST["tolerance"]),
    )
    return factor * model.spread * error


def grid_error(models, column, surface, pressure, pixels, by_grids) -> float:
    """Return the relative error by the grid, covering 90 %, of a case; `by_grids` is its own.

    The smaller of that and the error model's. What one case's grids say has to cover any surface,
    and is two to five times the error; outside what was measured it stands alone.
    """
    if extrapolated(surface, pressure, pixels):
        return by_grids
    by_model = single_error(models, "discretisation", column, surface, pressure, pixels=pixels)
    return float(np.fmin(by_grids, by_model))


def extrapolated(surface, pressure, pixels=FINEST["pixels"], tolerance=FINEST["tolerance"]) -> bool:
    """Whether anything that errors are taken from is outside what was measured."""
    return nearest_measured(surface, pressure)[-1] > 1 or _is_coarse(pixels, tolerance)


def _is_coarse(pixels: float, tolerance: float) -> bool:
    return pixels < COARSEST["pixels"] or tolerance > COARSEST["tolerance"]


def read_models(path: str | Path) -> dict[tuple[str, str], ErrorModel]:
    """Read the table of error models, by part and column of a quantity (costs have no column)."""
    try:
        with Path(path).open(encoding="utf-8", newline="") as file:
            models = {}
            for row in csv.DictReader(line for line in file if not line.startswith("#")):
                key = (row.pop("part"), row.pop("quantity"))
                models[key] = ErrorModel(**{name: float(value) for name, value in row.items()})
    except FileNotFoundError:
        raise ValueError(f"{path}: no such file; the target tradeoff makes it") from None
    except (KeyError, TypeError, ValueError) as error:
        raise ValueError(f"{path}: not a table of error models ({error})") from None
    wanted = list(itertools.product(PARTS, columns_of(MODELLED)))
    wanted += [(cost, "") for cost in COSTS]
    for part, column in wanted:
        if (part, column) not in models:
            raise ValueError(f"{path}: lacks {part} of {column or 'a solution'}")
    return models


def write_models(path: str | Path, models: ErrorModels, comment: str) -> None:
    """Write a table of error models, with lines of comment before it."""
    with Path(path).open("w", encoding="utf-8", newline="") as file:
        file.writelines(f"# {line}\n" for line in comment.splitlines())
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["part", "quantity", *(field.name for field in fields(ErrorModel))])
        for key, model in models.items():
            table.writerow([*key, *(f"{value:.5g}" for value in vars(model).values())])
