"""Roughness of a pair: that of the surface and of the material, as the material's solid sees it.

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
from stickiness.spectrum import combine as add_roughness

ENDS = ("smooth", "rough")
MOMENTS = ("h_rms", "rms_slope", "rms_curvature")
BY_END = (*MOMENTS, "elastic_energy")
SAMPLED = ("h_rms_draws", "q0_draws", "elastic_energy_draws")


@dataclass(frozen=True)
class PairRoughness:
    """Rough surface of a pair; arrays ``(end,)``, lengths in m."""

    h_rms: NDArray
    rms_slope: NDArray
    rms_curvature: NDArray
    elastic_energy: NDArray  # of full contact per area over E*
    energy_ratio_to_half_space: NDArray
    layer_strain: NDArray  # of a layer, as an order of magnitude; 0 of a half-space
    q0: float
    a_v: tuple[SurfaceAv, ...]  # by end
    relative_compliance: float  # S of the longest waves on a layer
    half_space_energy: NDArray  # NaN where it does not bound that of the layer
    anisotropy_error_factor: float
    samples: Roughness | None  # of a measured surface, arrays ``(draw,)``


def combine(material, surface, smooth, second=None):
    """Combine a `Material` and the dataset of a surface to their `PairRoughness`.

    `smooth` is the roughness of a smooth half-space on the surface (`half_space_pair`), `second`
    the dataset of the surface of a material that is rough itself.
    """
    pair = smooth if second is None else add_surfaces(surface, second, smooth, material.solid)
    if material.solid == HALF_SPACE:
        return pair
    spectra = find_spectra(surface, second)
    energy = np.array([spectrum.elastic_energy(material.solid) for spectrum in spectra])
    ratio = energy / np.array([spectrum.elastic_energy() for spectrum in spectra])
    # A film is softer to some waves, its layer stiffer to others: a half-space bounds nothing.
    bound = np.nan if isinstance(material.solid.backing, Film) else 1.0
    compliance = float(material.solid.factor(pair.q0))
    # The spectra of the samples are not kept: the layer acts on them as on both ends.
    samples = pair.samples and replace(
        pair.samples,
        elastic_energy=pair.samples.elastic_energy * np.sqrt(np.prod(ratio)),
        relative_compliance=compliance,
        half_space_energy=pair.samples.elastic_energy * bound,
    )
    # Where the longest waves are longer than the layer is thick, material has to flow along it, and
    # shears by 1/(q0 thickness) more than the rms height over the thickness.
    thickness = material.solid.thickness
    return replace(
        pair,
        elastic_energy=pair.elastic_energy * ratio,
        half_space_energy=pair.half_space_energy * bound,
        energy_ratio_to_half_space=ratio,
        layer_strain=pair.h_rms / (thickness * min(1.0, pair.q0 * thickness)),
        relative_compliance=compliance,
        samples=samples,
    )


def find_spectra(surface, second=None):
    """Spectra of both ends."""
    if second is None:
        return [real_spectrum(surface, end) for end in ENDS]
    return [add_roughness(real_spectrum(surface, end), real_spectrum(second, end)) for end in ENDS]


def half_space_pair(surface):
    """`PairRoughness` of a smooth half-space on a surface."""
    by_end = {name: surface[name].sel(end=list(ENDS)).values for name in BY_END}
    factor = find_anisotropy_error_factor(float(surface.get("axis_ratio", 1.0)))
    samples = None
    if set(SAMPLED) <= set(surface):
        values = (surface[name].values for name in SAMPLED)
        samples = Roughness(*values, anisotropy_error_factor=factor)
    return PairRoughness(
        **by_end,
        half_space_energy=by_end["elastic_energy"],
        energy_ratio_to_half_space=np.ones(len(ENDS)),
        layer_strain=np.zeros(len(ENDS)),
        q0=float(surface.q0),
        a_v=find_a_v(surface),
        relative_compliance=1.0,
        anisotropy_error_factor=factor,
        samples=samples,
    )


def find_a_v(surface):
    """a_V by theory on both ends; it is computed once where they differ by a factor only."""
    ratio = surface.psd.sel(end=ENDS[0]) / surface.psd.sel(end=ENDS[-1])
    ends = ENDS[:1] if np.ptp(ratio.values) < 1e-6 * ratio.values.max() else ENDS
    found = []
    for end in ends:
        moments = {name: float(surface[name].sel(end=end)) for name in MOMENTS}
        known = moments | {"q0": float(surface.q0)}
        found.append(surface_a_v(real_spectrum(surface, end), known))
    return tuple(found * (len(ENDS) // len(found)))


def add_surfaces(surface, second, one, solid):
    """`PairRoughness` of two rough solids, whose roughness is independent.

    `one` is the roughness of `surface` alone.
    """
    other = half_space_pair(second)
    moments = {name: np.hypot(getattr(one, name), getattr(other, name)) for name in MOMENTS}
    energy = one.elastic_energy + other.elastic_energy
    # The longest waves that matter are those of the surface that stores the energy.
    stored, more = (
        sum(s.elastic_energy(solid) for s in find_spectra(each)) for each in (surface, second)
    )
    share = float(stored / (stored + more))
    q0 = one.q0**share * other.q0 ** (1 - share)
    a_v = [
        surface_a_v(spectrum, {n: float(moments[n][end]) for n in MOMENTS} | {"q0": q0})
        for end, spectrum in enumerate(find_spectra(surface, second))
    ]
    return replace(
        one,
        **moments,
        elastic_energy=energy,
        half_space_energy=energy,
        q0=q0,
        a_v=tuple(a_v),
        anisotropy_error_factor=max(one.anisotropy_error_factor, other.anisotropy_error_factor),
        samples=add_samples(one.samples, other, share),
    )


def add_samples(samples, other, share):
    """Samples of a measured surface with another one added; None if that has two ends only."""
    if samples is None:
        return None
    names = ("h_rms", "q0", "elastic_energy")
    if other.samples is not None:
        size = len(samples.h_rms)
        h_rms, q0, energy = (np.resize(getattr(other.samples, name), size) for name in names)
    elif np.ptp(other.h_rms) == 0:
        h_rms, q0, energy = other.h_rms[0], other.q0, other.elastic_energy[0]
    else:
        return None
    return Roughness(
        h_rms=np.hypot(samples.h_rms, h_rms),
        q0=samples.q0**share * q0 ** (1 - share),
        elastic_energy=samples.elastic_energy + energy,
        anisotropy_error_factor=max(samples.anisotropy_error_factor, other.anisotropy_error_factor),
    )
