"""Contact of a rough solid with a hard wall without adhesion."""

from stickiness.repulsive.solver import Contact, ConvergenceError, load_path, solve

__all__ = ["Contact", "ConvergenceError", "load_path", "solve"]
