"""How solids take full contact: half-spaces, layers, layers on a film, and skins."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stickiness.remaining.thin_layers import find_flow
from stickiness.solids import Film, Layer, Skin, Solid, check_solid
from stickiness.spectrum.family import SpectrumFamily

BOUNDED = ("layer", "skin")  #: solids that are stiffer than a half-space to every wave, or softer


def name_solid(solid: Solid) -> str:
    """What theory tells apart: "half-space", "layer", "film" for a layer on one, or "skin"."""
    check_solid(solid)
    if isinstance(solid, Layer):
        return "film" if isinstance(solid.backing, Film) else "layer"
    return "skin" if isinstance(solid, Skin) else "half-space"


def find_columns(family: SpectrumFamily, solid: Solid, q0: Any) -> dict[str, Any]:
    """Columns of `roughness.Roughness` that a solid decides, ``(n,)`` for a family of n spectra.

    `q0` is the wave number of the longest waves of each.
    """
    response = SolidResponse(family, solid, q0)
    is_split = name_solid(solid) in ("film", "skin")  # of two solids, which differ in modulus
    on_rigid_base = _without_film(solid)
    return {
        **response.find(),
        "half_space_energy": family.energy(),
        "rigid_base_energy": family.energy(on_rigid_base),
        "flow": find_flow(on_rigid_base, q0),
        "solid": name_solid(solid),
        "response": response if is_split else None,
        "row": np.arange(family.count),
    }


def _without_film(solid: Solid) -> Solid:
    """A layer on a rigid base in the place of its film; other solids as they are."""
    if isinstance(solid, Layer) and isinstance(solid.backing, Film):
        return replace(solid, backing="bonded")
    return solid


@dataclass(frozen=True, eq=False)
class SolidResponse:
    """Full contact of one solid with a family of spectra, at any modulus.

    Films and skins keep their stiffness where the modulus of the layer on them, or of the
    half-space below, is another.
    """

    family: SpectrumFamily
    solid: Solid
    q0: NDArray  #: of the longest waves, ``(n,)``

    def find(self, modulus: Any = 1.0, rows: Any = slice(None)) -> dict[str, NDArray]:
        """Energy over E*, and compliance over that of a half-space, with E* times a `modulus`.

        The compliance is S of the longest waves, see `solids`. A film below a layer bends under
        them, but couples no points that are as close as the layer is thick: the compliance is that
        of the layer on a rigid base. A skin is stiff to short waves, which then store most of the
        energy. The mean of 1/S of all waves, weighted by the energy of a half-space, stands for
        them.
        """
        family = self.family.take(rows)
        energy = family.energy(self.solid, modulus)
        if isinstance(self.solid, Skin):
            compliance = family.energy() / energy
        else:
            longest = self.q0[rows]
            compliance = _without_film(self.solid).factor(longest) * np.ones(longest.shape)
        return {"elastic_energy": energy, "relative_compliance": compliance}

    def change(self, rows: Any, modulus: Any) -> dict[str, NDArray]:
        """Factors on energy over E* and on compliance, if E* is multiplied by a `modulus`."""
        changed = self.find(modulus, rows)
        unchanged = self.find(1.0, rows)
        return {name: changed[name] / unchanged[name] for name in changed}
