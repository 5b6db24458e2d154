"""Error models whose answers are known."""

import math

from stickiness.accuracy.error_models import ErrorModel, Surface
from stickiness.accuracy.quantities import MODELLED, columns_of
from stickiness.accuracy.settings import Problem

SMOOTH = Surface(hurst=0.8, magnification=32.0)


def made_up():
    """Error 2/pixels^2 of the grid, scatter 0.2; controls leave a tenth and a half of it."""
    laws = {}
    for column in columns_of(MODELLED):
        laws |= {
            ("discretisation", column): ErrorModel(math.log(2.0), pixels=-2.0),
            ("solver", column): ErrorModel(0.0, tolerance=1.0),
            ("scatter", column): ErrorModel(math.log(0.2)),
            ("fine_share", column): ErrorModel(math.log(0.1)),
            ("coarse_share", column): ErrorModel(math.log(0.5)),
            ("theory", column): ErrorModel(math.log(0.1)),
        }
    costs = {"fine_cost": ErrorModel(0.0, pixels=2.0), "coarse_cost": ErrorModel(math.log(4.0))}
    costs |= {
        "described_cost": ErrorModel(math.log(0.001)),
        "tolerance_cost": ErrorModel(0.0, tolerance=-0.02),
    }
    return laws | {(name, ""): law for name, law in costs.items()}


def problem(*columns, pressures=(0.1,), surface=SMOOTH, descriptor_seeds=2048):
    """Some columns at some loads, with the made-up error models."""
    return Problem(made_up(), surface, list(pressures), list(columns), descriptor_seeds)
