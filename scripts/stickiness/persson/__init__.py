"""Persson's theory of contact: area, mean gap and distribution of gaps of a spectrum."""

from stickiness.persson.theory import Persson

__all__ = ["Persson"]
