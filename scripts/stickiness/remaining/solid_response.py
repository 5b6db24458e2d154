"""How layers, films and skins take full contact, beside a half-space."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from stickiness.solids import HALF_SPACE, Film, Layer, Skin, Solid, check_solid
from stickiness.spectrum.interface import Spectrum


@dataclass(frozen=True, eq=False)
class FilmResponse:
    """How full contact of a layer on a film, or on a skin, depends on E*; films and skins do not.

    It is evaluated at the moduli that are needed, all at once, with the waves in common.
    """

    spectra: tuple[Spectrum, ...]  #: several: of draws between them, by the geometric mean
    solid: Solid
    q0: float

    @cached_property
    def _waves(self) -> list[tuple[NDArray, NDArray]]:
        """Wave numbers of every spectrum, and what they add to the energy of a half-space."""
        waves = []
        for spectrum in self.spectra:
            averaged = spectrum.averaged()
            q, weight = averaged.quadrature(*averaged.band)
            waves.append((q, weight * q))
        return waves

    def at_modulus(self, factor: NDArray) -> tuple[NDArray, NDArray]:
        """Elastic energy over E* and relative compliance with E* times factors ``(n,)``.

        Both over what they are as it is.
        """
        modulus = np.append(1.0, factor)[:, None]
        energies = [(1 / self.solid.factor(q, modulus)) @ energy for q, energy in self._waves]
        energy = np.exp(np.mean(np.log(energies), axis=0))
        # See `find_relative_compliance`.
        compliance = 1 / energy
        if not isinstance(self.solid, Skin):
            compliance = np.asarray(self.solid.factor(self.q0, modulus[:, 0]))
        return energy[1:] / energy[0], compliance[1:] / compliance[0]


def is_on_film(solid: Solid) -> bool:
    """Whether a solid is a layer on a film."""
    return isinstance(solid, Layer) and isinstance(solid.backing, Film)


def find_relative_compliance(spectrum: Spectrum, solid: Solid, q0: float) -> float:
    """S of the longest waves on a layer, see `solids`; on a skin that of all waves together.

    A skin is stiff to short waves, which then store most of the energy. The mean of 1/S, weighted
    by the energy of a half-space, stands for them.
    """
    if isinstance(solid, Skin):
        return spectrum.elastic_energy() / spectrum.elastic_energy(solid)
    return float(check_solid(solid).factor(q0))


def find_half_space_energy(spectrum: Spectrum, solid: Solid) -> float:
    """Elastic energy that bounds that of a layer or a skin; NaN of a film.

    A film is softer to long waves.
    """
    if solid == HALF_SPACE or is_on_film(solid):
        return np.nan
    return spectrum.elastic_energy()


def find_stiffening(solid: Solid, spectrum: Spectrum, lowest: float) -> float:
    """Energy of the waves from a wave number on, over that on a half-space.

    Waves beyond those of the spectrum count as its shortest.
    """
    waves = spectrum.averaged()
    highest = spectrum.band[1]
    on_half_space = waves.integrate(lambda q: q, lowest, highest)
    if on_half_space == 0:
        return 1 / float(solid.factor(max(lowest, highest)))
    return waves.integrate(lambda q: q / solid.factor(q), lowest, highest) / on_half_space
