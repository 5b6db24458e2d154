"""A material on a rough surface: what the stickiness criteria need to know of the two."""

from __future__ import annotations

from dataclasses import dataclass

from numpy.typing import ArrayLike, NDArray

from stickiness.adhesion import equivalent_sphere


@dataclass(frozen=True)
class Pair:
    """A material on a surface; numbers, or arrays that broadcast against each other.

    Attributes
    ----------
    h_rms, q0 : array_like
        Root mean square height [m] and lowest wave number [1/m].
    rms_slope, rms_curvature : array_like
        Root mean square gradient [1] and Laplacian [1/m].
    elastic_energy : array_like
        Elastic energy of full contact per nominal area over E* [m].
    modulus : array_like
        Plane-strain modulus E* [Pa].
    work_of_adhesion, range : array_like
        Of the attraction [J/m^2] and [m].
    a_v, a_v_low, a_v_high : array_like
        a_V at this range on this surface, with its limits.
    constant_a_v : array_like
        a_V of a broad spectrum in the interval of the fit, the same for every pair.
    """

    h_rms: ArrayLike
    q0: ArrayLike
    rms_slope: ArrayLike
    rms_curvature: ArrayLike
    elastic_energy: ArrayLike
    modulus: ArrayLike
    work_of_adhesion: ArrayLike
    range: ArrayLike
    a_v: ArrayLike
    a_v_low: ArrayLike
    a_v_high: ArrayLike
    constant_a_v: ArrayLike

    @property
    def adhesion_length(self) -> float | NDArray:
        """Work of adhesion over E* [m]."""
        return self.work_of_adhesion / self.modulus

    def attraction(self, a_v: ArrayLike | None = None) -> equivalent_sphere.EdgeAttraction:
        """Attraction over repulsion by the edges of contact, for another a_V if one is given."""
        return self._attraction(self.adhesion_length, self.a_v if a_v is None else a_v)

    def margin_limits(self) -> tuple[ArrayLike, ArrayLike]:
        """Lowest and highest margin by the edges, for the limits of a_V and of the model."""
        low, high = self.attraction(self.a_v_low), self.attraction(self.a_v_high)
        return low.ratio / low.error_factor, high.ratio * high.error_factor

    def edge_thresholds(self) -> tuple[ArrayLike, ArrayLike, ArrayLike]:
        """Adhesion length [m] above which the pair sticks by the edges: value, low, high limit."""
        return (
            self.edge_threshold(self.a_v),
            self.edge_threshold(self.a_v_high, +1),
            self.edge_threshold(self.a_v_low, -1),
        )

    def _attraction(self, adhesion_length, a_v):
        at = self.h_rms, self.q0, self.rms_slope, adhesion_length, self.range, a_v
        return equivalent_sphere.attraction(*at)

    def edge_threshold(self, a_v: ArrayLike, sign: int = 0) -> float | NDArray:
        """Adhesion length [m] above which the pair sticks by the edges, for an a_V.

        With `sign` +1 or -1 the model's error raises or lowers it.
        """
        at = self.h_rms, self.q0, self.rms_slope, self.range, a_v
        length = equivalent_sphere.adhesion_length_threshold(*at)
        if not sign:
            return length
        # The model's error is that at the threshold without it.
        error = self._attraction(length, a_v).error_factor
        return equivalent_sphere.adhesion_length_threshold(*at, error**sign)
