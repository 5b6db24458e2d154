"""A material on a rough surface: what criteria need to know of the two, and words for verdicts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.criteria import equivalent_sphere
from stickiness.remaining.prediction import DEFAULT_SHARE, Roughness

WORDS = (
    *("does not stick", "touches without hold", "depends", "sticks", "sticks fully"),
    "not judged",
)
NOT_STICKY, TOUCHES, DEPENDS, STICKY, STICKS_FULLY, NOT_JUDGED = range(6)
FULL_SHARE = 0.8  #: of the work of adhesion, from which a pair sticks fully
REGIMES = ("weak", "between", "tough", "strong")
WEAK, BETWEEN, TOUGH, STRONG = range(4)


@dataclass(frozen=True)
class Pair:
    """A material on a surface; numbers, or arrays that broadcast against each other."""

    h_rms: ArrayLike  #: [m]
    q0: ArrayLike  #: lowest wave number [1/m]
    rms_slope: ArrayLike  #: rms gradient [1]
    rms_curvature: ArrayLike  #: rms Laplacian [1/m]
    elastic_energy: ArrayLike  #: of full contact per nominal area over E* [m]
    modulus: ArrayLike  #: plane-strain modulus E* [Pa]
    work_of_adhesion: ArrayLike  #: [J/m^2]
    range: ArrayLike  #: of the attraction [m]
    a_v: ArrayLike  #: at this range on this surface
    a_v_low: ArrayLike  #: its limits
    a_v_high: ArrayLike
    constant_a_v: ArrayLike  #: a_V of a broad spectrum, the same for every pair
    wanted_share: float = DEFAULT_SHARE  #: of the work of adhesion, that must remain to stick
    softness: ArrayLike = 1.0  #: S of the longest waves on a layer, see `solids`
    deep_energy: ArrayLike | None = None  #: of full contact of a half-space, under a layer
    widening: ArrayLike = 1.0  #: factor on the errors of what remains, as in `Roughness`

    @property
    def adhesion_length(self) -> float | NDArray:
        """Work of adhesion over E* [m]."""
        return self.work_of_adhesion / self.modulus

    def attraction(self, a_v: ArrayLike | None = None) -> equivalent_sphere.EdgeAttraction:
        """Attraction over repulsion by the edges of contact, for another a_V if one is given."""
        return self._attraction(self.adhesion_length, self.a_v if a_v is None else a_v)

    @property
    def roughness(self) -> Roughness:
        """The surface as `stickiness.remaining` needs it."""
        surface = self.h_rms, self.q0, self.elastic_energy, self.softness
        return Roughness(*surface, self.deep_energy, self.widening)

    def remaining(self, sign: int = 0) -> float | NDArray:
        """Share of the work of adhesion that remains; `sign` -1 or +1 for its low or high limit."""
        return self.roughness.share(self.adhesion_length, self.range, sign)

    def pull_off(self) -> tuple[ArrayLike, ArrayLike, ArrayLike]:
        """Pull-off stress over E* with its low and high limit."""
        return self.roughness.pull_off(self.adhesion_length, self.range)

    def remaining_threshold(self, sign: int = 0) -> float | NDArray:
        """Adhesion length [m] above which the wanted share remains.

        With `sign` +1 or -1 by the high or low limit of the share.
        """
        return self.roughness.threshold(self.range, self.wanted_share, sign)

    def margin_limits(self) -> tuple[ArrayLike, ArrayLike]:
        """Lowest and highest margin by the adhesion that remains, for the limits of its model."""
        low, high = (self.adhesion_length / self.remaining_threshold(sign) for sign in (-1, 1))
        return low, high

    def _attraction(self, adhesion_length, a_v):
        at = self.h_rms, self.q0, self.rms_slope, adhesion_length, self.range, a_v
        return equivalent_sphere.attraction(*at)

    def edge_threshold(self, a_v: ArrayLike) -> float | NDArray:
        """Adhesion length [m] above which contact grows by itself by the edges, for an a_V."""
        at = self.h_rms, self.q0, self.rms_slope, self.range, a_v
        return equivalent_sphere.adhesion_length_threshold(*at)


def decide(
    low: ArrayLike, high: ArrayLike, grows: ArrayLike, wanted: float = DEFAULT_SHARE
) -> NDArray:
    """Code of a verdict, its place in `WORDS`.

    `low` and `high` are the limits of the share that remains, `grows` tells whether contact grows
    by itself at the finest wave.
    """
    low, high = np.asarray(low), np.asarray(high)
    return np.select(
        [high < wanted, low < wanted, low < FULL_SHARE],
        [np.where(grows, TOUCHES, NOT_STICKY), DEPENDS, STICKY],
        STICKS_FULLY,
    ).astype("i1")


def classify_edges(attraction: equivalent_sphere.EdgeAttraction) -> NDArray:
    """Code of the regime of the edges, its place in `REGIMES`."""
    tau = np.asarray(attraction.strength)
    return np.select(
        [tau <= equivalent_sphere.WEAK, tau < equivalent_sphere.TOUGH, attraction.tough],
        [WEAK, BETWEEN, TOUGH],
        STRONG,
    )
