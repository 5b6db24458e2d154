"""Adhesive contact: traction laws, states of equilibrium, loading and unloading curves."""

from stickiness.adhesion.laws import Exponential, LennardJones, Maugis, TractionLaw
from stickiness.adhesion.path import PathPoint, path
from stickiness.adhesion.scaling import Adhesion
from stickiness.adhesion.solver import ConvergenceError, PullOffError, solve

__all__ = [
    "Adhesion",
    "ConvergenceError",
    "Exponential",
    "LennardJones",
    "Maugis",
    "PathPoint",
    "PullOffError",
    "TractionLaw",
    "path",
    "solve",
]
