"""Words for verdicts and for the state of the edges, and the rules that choose them."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.adhesion import equivalent_sphere

WORDS = ("not sticky", "depends", "sticky", "undecided")
NOT_STICKY, DEPENDS, STICKY, UNDECIDED = range(4)
REGIMES = ("weak", "between", "tough", "strong")
WEAK, BETWEEN, TOUGH, STRONG = range(4)


def decide(surely: ArrayLike, possibly: ArrayLike, holds: ArrayLike) -> NDArray:
    """Code of a verdict, its place in `WORDS`.

    Parameters
    ----------
    surely, possibly : boolean array_like
        Whether contact grows by itself for all, or for some, of what is not known.
    holds : boolean array_like
        Whether full contact would cost less energy than adhesion gains. Where contact does not
        grow by itself but would hold once it is full, history decides: undecided.
    """
    decided = NOT_STICKY + np.asarray(possibly, dtype="i1") + np.asarray(surely, dtype="i1")
    return np.where((decided == NOT_STICKY) & holds, UNDECIDED, decided).astype("i1")


def classify_edges(attraction: equivalent_sphere.EdgeAttraction) -> NDArray:
    """Code of the regime of the edges, its place in `REGIMES`."""
    tau = np.asarray(attraction.strength)
    return np.select(
        [tau <= equivalent_sphere.WEAK, tau < equivalent_sphere.TOUGH, attraction.tough],
        [WEAK, BETWEEN, TOUGH],
        STRONG,
    )
