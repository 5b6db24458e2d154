"""Stickiness criteria: which contacts sustain tension, and below which modulus."""

from stickiness.criteria.formulas import *  # noqa: F403
from stickiness.criteria.formulas import __all__ as __all__
