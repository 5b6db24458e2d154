"""A material on a rough surface: what the criteria need to know, and all that is said of it.

`QUANTITIES` lists what is said of a pair, and the stages write all of it to their files. To add a
quantity, give it a line there and one in `find_quantities`.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.criteria import equivalent_sphere
from stickiness.criteria.formulas import dmt_validity
from stickiness.remaining.roughness import Roughness
from stickiness.remaining.trial_states import DEFAULT_SHARE

WORDS = (
    *("does not stick", "adheres locally, does not hold", "depends", "sticks", "sticks fully"),
    "not judged",
)
NOT_STICKY, TOUCHES, DEPENDS, STICKY, STICKS_FULLY, NOT_JUDGED = range(6)
FULL_SHARE = 0.8  #: of the work of adhesion, from which a pair sticks fully
REGIMES = ("DMT-like", "between DMT and JKR", "JKR-like", "strong but not JKR-like")  #: by code
MOST_STRAIN = 0.3  #: up to which a layer is taken for linear
BROAD_A_V = 3.0  #: of broad spectra, as Violano et al. (2019) find it
#: Units and descriptions of the quantities that have limits
LIMITED = {
    "remaining": ("1", "share of the work of adhesion that remains"),
    "pull_off": ("Pa", "largest mean tension on separation"),
    "margin": ("1", "adhesion length over the one at which the wanted share remains"),
    "modulus_threshold": (
        "Pa",
        "Young's modulus below which the wanted share remains; E* without a Poisson's ratio",
    ),
    "plane_strain_modulus_threshold": (
        "Pa",
        "plane-strain modulus E* below which the wanted share remains",
    ),
}
#: Units and descriptions of the others, which are known at both ends of what a surface may be
QUANTITIES = {
    "energy_ratio": ("1", "work of adhesion over the elastic energy of full contact"),
    "extrapolation": ("1", "decades of wave numbers by which the theory goes beyond simulations"),
    "range_over_h_rms": ("1", "range of attraction over rms height"),
    "pair_h_rms": ("m", "rms height of the pair, of both solids if both are rough"),
    "pair_q0": ("1/m", "wave number of the longest waves of the pair that matter"),
    "pair_rms_slope": ("1", "rms gradient of the pair"),
    "pair_rms_curvature": ("1/m", "rms Laplacian of the pair"),
    "edge_strength": ("1", "Tabor's parameter of the edges of contact, l_a d/range^2"),
    "attractive_over_contact": ("1", "area within the range over area of contact"),
    "over_dmt": ("1", "attraction over its DMT sum, at equal area of contact"),
    "regime": ("1", "edges of contact: " + ", ".join(f"{i} {x}" for i, x in enumerate(REGIMES))),
    "layer_strain": ("1", "strain that conforming demands of a layer, order of magnitude"),
    "simulated": ("1", "1 where full simulation agrees with the model"),
    "jtb_margin": ("1", "rms height over the smallest at which the DMT limit holds (JTB)"),
}


@dataclass(frozen=True, kw_only=True)
class Pair:
    """A material on a surface; numbers, or arrays that broadcast against each other, in SI units.

    Curvature and a_V serve the other criteria than that of what remains.
    """

    rough: Roughness  #: that the material meets on the surface
    modulus: float | NDArray  #: plane-strain modulus E* [Pa]
    work_of_adhesion: float | NDArray  #: [J/m^2]
    range: float | NDArray  #: of the attraction [m]
    rms_curvature: float | NDArray = np.nan  #: rms Laplacian [1/m]
    a_v: float | NDArray = np.nan  #: at this range on this surface
    pressed: float | NDArray = 0.0  #: mean pressure before separation [Pa]
    constant_a_v: float | NDArray = BROAD_A_V  #: the same for every pair
    wanted_share: float = DEFAULT_SHARE  #: of the work of adhesion, that must remain to stick
    #: Strain that conforming demands of a layer: beyond `MOST_STRAIN` low limits are 0
    layer_strain: float | NDArray = 0.0

    @property
    def h_rms(self) -> float | NDArray:
        """Rms height [m]."""
        return self.rough.h_rms

    @property
    def q0(self) -> float | NDArray:
        """Wave number of the longest waves that matter [1/m]."""
        return self.rough.q0

    @property
    def rms_slope(self) -> float | NDArray:
        """Rms gradient [1]."""
        return self.rough.rms_slope

    @property
    def elastic_energy(self) -> float | NDArray:
        """Elastic energy of full contact per nominal area over E* [m]."""
        return self.rough.elastic_energy

    @property
    def adhesion_length(self) -> float | NDArray:
        """Work of adhesion over E* [m]."""
        return self.work_of_adhesion / self.modulus

    @property
    def withstands(self) -> NDArray:
        """Whether a layer can take the heights within linear elasticity."""
        return np.asarray(self.layer_strain) <= MOST_STRAIN

    def take(self, rows: ArrayLike) -> Self:
        """Return some rows of the arrays; a number is that of all rows."""
        taken = {
            field.name: values[rows]
            for field in fields(self)
            if field.name != "rough" and np.ndim(values := getattr(self, field.name))
        }
        return replace(self, rough=self.rough.take(rows), **taken)

    def scaled(self, factor: float | NDArray) -> Self:
        """Return the same with heights times a factor, at an unchanged shape of the spectrum."""
        rough = self.rough.scaled(factor)
        return replace(self, rough=rough, layer_strain=self.layer_strain * factor)

    def at_modulus(self, modulus: float | NDArray) -> Self:
        """Return the same with another E* [Pa]: films and skins keep their stiffness."""
        rough = self.rough.at_modulus(modulus / self.modulus)
        return replace(self, rough=rough, modulus=modulus)

    def deviating(self, eta: float | NDArray) -> Self:
        """Return the same with another error of the model, see `Roughness.deviating`."""
        return replace(self, rough=self.rough.deviating(eta))

    @cached_property
    def remaining(self) -> float | NDArray:
        """Share of the work of adhesion that remains."""
        return self.rough.share(adhesion_length=self.adhesion_length, range=self.range)

    @cached_property
    def pull_off(self) -> float | NDArray:
        """Largest mean tension on separation [Pa]."""
        tension = self.rough.tension(
            adhesion_length=self.adhesion_length,
            range=self.range,
            pressed=self.pressed / self.modulus,
        )
        return tension * self.modulus

    @cached_property
    def remaining_threshold(self) -> float | NDArray:
        """Adhesion length [m] above which the wanted share remains.

        The adhesion length is varied through E*. The threshold is infinite if no modulus keeps the
        wanted share.
        """
        return self.rough.threshold(
            range=self.range,
            share=self.wanted_share,
            adhesion_length=self.adhesion_length,
        )

    @cached_property
    def edges(self) -> equivalent_sphere.EdgeAttraction:
        """Attraction over repulsion by the edges of contact."""
        return equivalent_sphere.attraction(
            self.h_rms, self.q0, self.rms_slope, self.adhesion_length, self.range, self.a_v
        )

    def edge_threshold(self) -> float | NDArray:
        """Adhesion length [m] above which contact grows by itself by the edges."""
        return equivalent_sphere.adhesion_length_threshold(
            self.h_rms, self.q0, self.rms_slope, self.range, self.a_v
        )


def decide(
    low: ArrayLike, high: ArrayLike, grows: ArrayLike, wanted: float = DEFAULT_SHARE
) -> NDArray:
    """Codes of the verdicts (int8), their places in `WORDS`.

    `low` and `high` are limits of the share that remains, `wanted` is the share from which a pair
    sticks; `grows` says whether contact grows by itself at the finest wave.
    """
    low, high = np.asarray(low), np.asarray(high)
    return np.select(
        [high < wanted, low < wanted, low < FULL_SHARE],
        [np.where(grows, TOUCHES, NOT_STICKY), DEPENDS, STICKY],
        STICKS_FULLY,
    ).astype("i1")


def find_quantities(pair: Pair) -> dict[str, NDArray]:
    """Compute every one of `QUANTITIES` for a pair, by name."""
    length = pair.adhesion_length
    edges = pair.edges
    tabor = np.asarray(edges.strength)
    regime = np.select(
        [
            tabor <= equivalent_sphere.WEAK,
            tabor < equivalent_sphere.TOUGH,
            equivalent_sphere.tough(edges.attractive_over_contact, tabor),
        ],
        range(3),
        3,
    )
    quantities = {
        "range_over_h_rms": pair.range / pair.h_rms,
        "extrapolation": pair.rough.extrapolation(length, pair.range),
        "energy_ratio": length / pair.elastic_energy,
        "edge_strength": edges.strength,
        "attractive_over_contact": edges.attractive_over_contact,
        "over_dmt": edges.effect,
        "regime": regime.astype("i1"),
        "simulated": np.asarray(edges.simulated).astype("i1"),
        "jtb_margin": dmt_validity(pair.h_rms, pair.q0, length, pair.range).margin,
        "layer_strain": pair.layer_strain,
    }
    for name in ("h_rms", "q0", "rms_slope", "rms_curvature"):
        quantities[f"pair_{name}"] = getattr(pair, name)
    return dict(zip(quantities, np.broadcast_arrays(*quantities.values()), strict=True))
