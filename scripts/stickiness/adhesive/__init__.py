"""Adhesive contact: traction laws, states of equilibrium, loading and unloading curves.

- `solver`: `solve`, in the caller's units
- `path`: loading and unloading curves with their jumps
- `equilibrium`: stable state from a start, for smooth laws and the law of Maugis
- `descent`, `softening_descent`: general and quick descent in energy
- `preconditioner`: approximate inverse of the stiffness
- `problem`: the scaled problem and its states
- `edge_zone`: whether a grid resolves the edges of contact
"""

from stickiness.adhesive.path import PathPoint, path
from stickiness.adhesive.solver import Adhesion, ConvergenceError, PullOffError, solve
from stickiness.traction_laws import Exponential, LennardJones, Maugis, TractionLaw, VanDerWaals

__all__ = [
    "Adhesion",
    "ConvergenceError",
    "Exponential",
    "LennardJones",
    "Maugis",
    "PathPoint",
    "PullOffError",
    "TractionLaw",
    "VanDerWaals",
    "path",
    "solve",
]
