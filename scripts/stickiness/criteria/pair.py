"""A material on a rough surface: what the criteria need to know, and the words of verdicts."""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.criteria import equivalent_sphere
from stickiness.remaining.prediction import DEFAULT_SHARE, Roughness

WORDS = (
    *("does not stick", "adheres locally, does not hold", "depends", "sticks", "sticks fully"),
    "not judged",
)
NOT_STICKY, TOUCHES, DEPENDS, STICKY, STICKS_FULLY, NOT_JUDGED = range(6)
FULL_SHARE = 0.8  #: of the work of adhesion, from which a pair sticks fully
REGIMES = ("weak", "between", "tough", "strong")
WEAK, BETWEEN, TOUGH, STRONG = range(4)
BROAD_A_V = 3.0  #: of broad spectra, as Violano et al. (2019) find it


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
    constant_a_v: ArrayLike = BROAD_A_V  #: the same for every pair
    wanted_share: float = DEFAULT_SHARE  #: of the work of adhesion, that must remain to stick
    relative_compliance: ArrayLike = 1.0  #: S of the longest waves on a layer, see `solids`
    half_space_energy: ArrayLike | None = None  #: of full contact of a half-space, under a layer
    anisotropy_error_factor: ArrayLike = 1.0  #: on the errors of what remains, as in `Roughness`

    @property
    def adhesion_length(self) -> float | NDArray:
        """Work of adhesion over E* [m]."""
        return self.work_of_adhesion / self.modulus

    @property
    def roughness(self) -> Roughness:
        """The surface as `stickiness.remaining` needs it."""
        return Roughness(**{field.name: getattr(self, field.name) for field in fields(Roughness)})

    def remaining(self, sign: int = 0) -> float | NDArray:
        """Share of the work of adhesion that remains; `sign` -1 or +1 for its low or high limit."""
        return self.roughness.share(self.adhesion_length, self.range, sign)

    def pull_off(self, sign: int = 0) -> float | NDArray:
        """Largest mean tension on separation [Pa]; `sign` as of `remaining`."""
        return self.roughness.tension(self.adhesion_length, self.range, sign) * self.modulus

    def remaining_threshold(self, sign: int = 0) -> float | NDArray:
        """Adhesion length [m] above which the wanted share remains.

        With `sign` +1 or -1 by the high or low limit of the share.
        """
        return self.roughness.threshold(self.range, self.wanted_share, sign)

    @cached_property
    def edges(self) -> equivalent_sphere.EdgeAttraction:
        """Attraction over repulsion by the edges of contact."""
        at = self.h_rms, self.q0, self.rms_slope, self.adhesion_length, self.range, self.a_v
        return equivalent_sphere.attraction(*at)

    def edge_threshold(self) -> float | NDArray:
        """Adhesion length [m] above which contact grows by itself by the edges."""
        at = self.h_rms, self.q0, self.rms_slope, self.range, self.a_v
        return equivalent_sphere.adhesion_length_threshold(*at)


def decide(
    low: ArrayLike, high: ArrayLike, grows: ArrayLike, wanted: float = DEFAULT_SHARE
) -> NDArray:
    """Codes of the verdicts (int8), their places in `WORDS`.

    `low` and `high` are limits of the share of the work of adhesion that remains, `wanted` is the
    share from which a pair sticks; `grows` says whether contact grows by itself at the finest wave.
    """
    low, high = np.asarray(low), np.asarray(high)
    return np.select(
        [high < wanted, low < wanted, low < FULL_SHARE],
        [np.where(grows, TOUCHES, NOT_STICKY), DEPENDS, STICKY],
        STICKS_FULLY,
    ).astype("i1")


def classify_edges(edges: equivalent_sphere.EdgeAttraction) -> NDArray:
    """Return the code of the regime of the edges, its place in `REGIMES`."""
    tau = np.asarray(edges.strength)
    return np.select(
        [tau <= equivalent_sphere.WEAK, tau < equivalent_sphere.TOUGH, edges.tough],
        [WEAK, BETWEEN, TOUGH],
        STRONG,
    )
