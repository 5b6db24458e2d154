"""Adhesive contact: traction laws, states of equilibrium, loading and unloading curves."""

from stickiness.adhesive.path import PathPoint, path
from stickiness.adhesive.solver import Adhesion, ConvergenceError, PullOffError, solve
from stickiness.traction_laws import Exponential, LennardJones, Maugis, TractionLaw

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
