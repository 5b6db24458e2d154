"""Roughness of a pair: that of the surface and of the material, as the material's solid sees it.

It is a dataset of the quantities of `Pair` along `end`, lengths in m. Measured surfaces have draws
beside. The surface of a material that is rough itself adds its spectrum. A layer of finite
thickness changes the energy that it takes to conform.
"""

import numpy as np
import xarray as xr
from scipy.special import erf

from stickiness.criteria.a_v_table import LOAD, surface_a_v
from stickiness.remaining.prediction import Roughness, find_anisotropy_error_factor
from stickiness.solids import HALF_SPACE, Film
from stickiness.spectrum import combine as add_roughness
from stickiness.spectrum.kinds import Tabulated

ENDS = ("smooth", "rough")
MOMENTS = ("h_rms", "rms_slope", "rms_curvature")
ENERGIES = ("elastic_energy", "elastic_energy_draws")
DRAWS = ("h_rms_draws", "q0_draws", "elastic_energy_draws")
OF_SURFACE = (*MOMENTS, "elastic_energy", "q0", *DRAWS)
FULL = 0.99  # contact area fraction from which on a_V has no meaning
TOO_DIFFERENT = (
    "the two rough solids differ too much in scale: at the load at which a_V is evaluated, "
    f"{LOAD:g} E* q0 h_rms, they are in full contact"
)


def combine(material, surface, a_v, second=None):
    """Roughness of a `Material` on an analysed surface, with a_V at its range.

    `a_v` is what `find_a_v` has for the surface, `second` the dataset of the surface of a material
    that is rough itself.
    """
    pair = describe(surface)
    if second is not None:
        pair = add_surfaces(surface, second, material.solid)
        area = erf(np.sqrt(np.pi) * LOAD * pair.q0 * pair.h_rms / pair.rms_slope)  # Persson's
        if area.max() < FULL:
            spectra = zip(ENDS, find_spectra(surface, second), strict=True)
            a_v = [find_end_a_v(pair, *each) for each in spectra]
        else:
            pair.attrs["not_judged"] = TOO_DIFFERENT
    if material.solid != HALF_SPACE:
        pair = put_on_layer(pair, material.solid, find_spectra(surface, second))
    at = [each.at(material.range / h) for each, h in zip(a_v, pair.h_rms.values, strict=True)]
    names = ("a_v", "a_v_low", "a_v_high")
    return pair.assign({n: ("end", x) for n, x in zip(names, np.transpose(at), strict=True)})


def describe(surface):
    """Roughness of a smooth half-space on an analysed surface."""
    pair = surface[[name for name in OF_SURFACE if name in surface]].sel(end=list(ENDS))
    return pair.drop_attrs().assign(
        half_space_energy=pair.elastic_energy,
        stiffening=xr.ones_like(pair.elastic_energy),
        relative_compliance=1.0,
        anisotropy_error_factor=find_anisotropy_error_factor(float(surface.get("axis_ratio", 1.0))),
    )


def find_spectra(surface, second=None):
    """Spectra of both ends, with the spectrum of the other solid if that is rough itself."""
    one = [real_spectrum(surface, end) for end in ENDS]
    return one if second is None else list(map(add_roughness, one, find_spectra(second)))


def real_spectrum(surface, end="rough"):
    """Spectrum of one end of an analysed real surface, up to its q1."""
    inside = surface.wave_number <= float(surface.q1) * (1 + 1e-9)
    known = surface.sel(end=end).isel(wave_number=np.flatnonzero(inside))
    return Tabulated(known.wave_number.values, known.psd.values)


def find_a_v(surface):
    """a_V by theory on both ends; it is computed once where they differ by a factor only."""
    ratio = surface.psd.sel(end=ENDS[0]) / surface.psd.sel(end=ENDS[-1])
    ends = ENDS[:1] if np.ptp(ratio.values) < 1e-6 * ratio.values.max() else ENDS
    found = [find_end_a_v(surface, end, real_spectrum(surface, end)) for end in ends]
    return found * (len(ENDS) // len(found))


def find_end_a_v(known, end, spectrum):
    moments = {name: float(known[name].sel(end=end)) for name in MOMENTS}
    return surface_a_v(spectrum, moments | {"q0": float(known.q0)})


def add_surfaces(surface, second, solid):
    """Roughness of two rough half-spaces, independent of each other.

    Draws of the first surface are kept if the second has draws, or ends that agree.
    """
    one, other = describe(surface), describe(second)
    # The longest waves that matter are those of the surface that stores the energy.
    stored, more = (
        sum(s.elastic_energy(solid) for s in find_spectra(each)) for each in (surface, second)
    )
    share = float(stored / (stored + more))
    known = [name for name in DRAWS if name in one]
    if known and known[0] in other:
        size = one.sizes["draw"]
        more = {name: ("draw", np.resize(other[name], size)) for name in known}
        other = other.drop_dims("draw").assign(more)
    elif known and np.ptp(other.h_rms.values) == 0:
        smooth = other.sel(end=ENDS[0], drop=True)
        other = other.assign({name: smooth[name.removesuffix("_draws")] for name in known})
    elif known:
        one = one.drop_dims("draw")
    factors = one.anisotropy_error_factor, other.anisotropy_error_factor
    pair = one.assign(anisotropy_error_factor=max(factors))
    for name in set(OF_SURFACE) & set(one):
        if name in ENERGIES:
            pair[name] = one[name] + other[name]
        elif name.startswith("q0"):
            pair[name] = one[name] ** share * other[name] ** (1 - share)
        else:
            pair[name] = np.hypot(one[name], other[name])
    return pair.assign(half_space_energy=pair.elastic_energy)


def put_on_layer(pair, solid, spectra):
    """Roughness of a half-space as a layer sees it; `spectra` are those of both ends."""
    energy = [spectrum.elastic_energy(solid) for spectrum in spectra]
    ratio = np.divide(energy, [spectrum.elastic_energy() for spectrum in spectra])
    # A film is softer to some waves, its layer stiffer to others: a half-space bounds nothing.
    bound = np.nan if isinstance(solid.backing, Film) else 1.0
    found = pair.assign(
        elastic_energy=pair.elastic_energy * ratio,
        half_space_energy=pair.half_space_energy * bound,
        stiffening=("end", ratio),
        relative_compliance=float(solid.factor(float(pair.q0))),
    )
    if DRAWS[0] in pair:
        # The spectra of the draws are not kept: the layer acts on them as on both ends.
        found["elastic_energy_draws"] = pair.elastic_energy_draws * np.sqrt(np.prod(ratio))
        found["half_space_energy_draws"] = pair.elastic_energy_draws * bound
    return found


def read_draws(pair):
    """`Roughness` of the draws of a measured surface; None of others."""
    if DRAWS[0] not in pair:
        return None
    bound = pair.get("half_space_energy_draws")
    return Roughness(
        *(pair[name].values for name in DRAWS),
        relative_compliance=float(pair.relative_compliance),
        half_space_energy=None if bound is None else bound.values,
        anisotropy_error_factor=float(pair.anisotropy_error_factor),
    )
