"""What a material and a surface bring to their contact, joined into one rough surface.

The surface of a material that is rough itself adds its spectrum. A layer of finite thickness
changes the energy that it takes to conform.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from common.real_spectra import real_spectrum
from stickiness.criteria.a_v_table import SurfaceAv
from stickiness.criteria.verdict import surface_a_v
from stickiness.remaining.prediction import Roughness, find_anisotropy_error_factor
from stickiness.solids import HALF_SPACE, Film
from stickiness.spectrum.sums import combine

ENDS = ("smooth", "rough")
MOMENTS = ("h_rms", "rms_slope", "rms_curvature")
BY_END = (*MOMENTS, "elastic_energy")
DRAWN = ("h_rms_draws", "q0_draws", "elastic_energy_draws")


@dataclass(frozen=True)
class Joint:
    """Rough surface of a pair; arrays ``(end,)``, lengths in m."""

    h_rms: NDArray
    rms_slope: NDArray
    rms_curvature: NDArray
    elastic_energy: NDArray  # of full contact per area over E*
    stiffening: NDArray  # that energy over that of a half-space
    layer_strain: NDArray  # of a layer, see `find_strain`; 0 of a half-space
    q0: float
    a_v: tuple[SurfaceAv, ...]  # by end
    softness: float  # S of the longest waves on a layer
    deep_energy: NDArray  # elastic energy of a half-space
    widening: float  # factor on the errors of what remains
    drawn: Roughness | None  # arrays over the draws of a measured surface

    def a_v_at(self, reach: float) -> NDArray:
        """a_V with its low and high limit for a range [m], ``(end, 3)``."""
        return np.array(
            [found.at(reach / h) for found, h in zip(self.a_v, self.h_rms, strict=True)]
        )


def join(material, surface, plain, own=None):
    """`Joint` of a `Material` and the dataset of a surface, and that of the material's own surface.

    `plain` is the `Joint` of a smooth half-space and the surface.
    """
    if own is not None:
        plain = add_surfaces(surface, own, plain, material.solid)
    if material.solid == HALF_SPACE:
        return plain
    spectra = find_spectra(surface, own)
    energy = np.array([spectrum.elastic_energy(material.solid) for spectrum in spectra])
    whole = np.array([spectrum.elastic_energy() for spectrum in spectra])
    stiffening = energy / whole
    softness = float(material.solid.factor(plain.q0))
    # A film is softer to some waves, its layer stiffer to others: a half-space bounds nothing.
    bends = isinstance(material.solid.backing, Film)
    drawn = plain.drawn
    if drawn is not None:
        # Draws have no spectrum of their own here: the layer acts on them as on both ends.
        deep = drawn.elastic_energy * (np.nan if bends else 1.0)
        energy = drawn.elastic_energy * np.sqrt(np.prod(stiffening))
        drawn = replace(drawn, elastic_energy=energy)
        drawn = replace(drawn, relative_compliance=softness, half_space_energy=deep)
    return replace(
        plain,
        elastic_energy=plain.elastic_energy * stiffening,
        deep_energy=plain.deep_energy * (np.nan if bends else 1.0),
        stiffening=stiffening,
        layer_strain=find_strain(plain, material.solid),
        softness=softness,
        drawn=drawn,
    )


def find_strain(plain, layer):
    """Strain that conforming asks of a layer, ``(end,)``, as an order of magnitude.

    The rms height over the thickness; where the longest waves are longer than the layer is thick,
    material has to flow along it, and shears by 1/(q0 thickness) more.
    """
    return plain.h_rms / (layer.thickness * min(1.0, plain.q0 * layer.thickness))


def find_spectra(surface, own=None):
    """Spectra of both ends."""
    return [
        real_spectrum(surface, end)
        if own is None
        else combine(real_spectrum(surface, end), real_spectrum(own, end))
        for end in ENDS
    ]


def take_surface(surface):
    """`Joint` of a smooth half-space and a surface."""
    by_end = {name: surface[name].sel(end=list(ENDS)).values for name in BY_END}
    widening = 1.0
    if "axis_ratio" in surface:
        widening = find_anisotropy_error_factor(float(surface.axis_ratio))
    drawn = None
    if all(name in surface for name in DRAWN):
        drawn = Roughness(*(surface[name].values for name in DRAWN))
        drawn = replace(drawn, anisotropy_error_factor=widening)
    return Joint(
        **by_end,
        deep_energy=by_end["elastic_energy"],
        stiffening=np.ones(len(ENDS)),
        layer_strain=np.zeros(len(ENDS)),
        q0=float(surface.q0),
        a_v=find_a_v(surface),
        softness=1.0,
        widening=widening,
        drawn=drawn,
    )


def find_a_v(surface):
    """a_V by theory on both ends, which is one where they differ by a factor only."""
    ratio = surface.psd.sel(end=ENDS[0]) / surface.psd.sel(end=ENDS[-1])
    same = np.ptp(ratio.values) < 1e-6 * ratio.values.max()
    ends = ENDS[:1] if same else ENDS
    found = [
        surface_a_v(
            real_spectrum(surface, end),
            {name: float(surface[name].sel(end=end)) for name in MOMENTS}
            | {"q0": float(surface.q0)},
        )
        for end in ends
    ]
    return tuple(found * len(ENDS) if same else found)


def add_surfaces(surface, own, one, solid):
    """`Joint` of two rough solids, whose roughness is independent; `one` is that of `surface`."""
    other = take_surface(own)
    sums = {name: np.hypot(getattr(one, name), getattr(other, name)) for name in MOMENTS}
    energy = one.elastic_energy + other.elastic_energy
    # The longest waves that matter are those of the surface that stores the energy.
    stored = [
        np.sum([real_spectrum(each, end).elastic_energy(solid) for end in ENDS])
        for each in (surface, own)
    ]
    share = float(stored[0] / np.sum(stored))
    q0 = one.q0**share * other.q0 ** (1 - share)
    found = []
    for end, spectrum in enumerate(find_spectra(surface, own)):
        known = {name: float(sums[name][end]) for name in MOMENTS} | {"q0": q0}
        found.append(surface_a_v(spectrum, known))
    return Joint(
        **sums,
        elastic_energy=energy,
        deep_energy=energy,
        stiffening=np.ones(len(ENDS)),
        layer_strain=np.zeros(len(ENDS)),
        q0=q0,
        a_v=tuple(found),
        softness=1.0,
        widening=max(one.widening, other.widening),
        drawn=add_draws(one.drawn, other, share),
    )


def add_draws(drawn, other, share):
    """Draws of a measured surface with another added; none if that is known between ends only."""
    if drawn is None:
        return None
    if other.drawn is not None:
        number = len(drawn.h_rms)
        names = ("h_rms", "q0", "elastic_energy")
        more = Roughness(*(np.resize(getattr(other.drawn, name), number) for name in names))
    elif np.ptp(other.h_rms) == 0:
        more = Roughness(other.h_rms[0], other.q0, other.elastic_energy[0])
    else:
        return None
    return Roughness(
        h_rms=np.hypot(drawn.h_rms, more.h_rms),
        q0=drawn.q0**share * more.q0 ** (1 - share),
        elastic_energy=drawn.elastic_energy + more.elastic_energy,
        anisotropy_error_factor=max(drawn.anisotropy_error_factor, other.widening),
    )
