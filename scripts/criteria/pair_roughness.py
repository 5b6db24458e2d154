"""Roughness of a pair: that of the surface and of the material, as the material's solid sees it.

It is a dataset of the quantities of `Pair` along `end`, lengths in m. Measured surfaces have draws
beside. The surface of a material that is rough itself adds its spectrum. A layer of finite
thickness changes the energy that it takes to conform.
"""

from dataclasses import fields

import numpy as np
import xarray as xr

from stickiness.criteria.a_v_table import LOAD, surface_a_v
from stickiness.criteria.pair import Pair
from stickiness.remaining.prediction import FILM_FACTORS, Roughness, find_film_response
from stickiness.remaining.prediction import find_anisotropy_error_factor as find_error_factor
from stickiness.solids import HALF_SPACE, Film
from stickiness.spectrum import combine as add_roughness
from stickiness.spectrum.kinds import Tabulated

ENDS = ("smooth", "rough")
MOMENTS = ("h_rms", "rms_slope", "rms_curvature")
# Energies, and those of a half-space that bound them on a layer.
BOUNDS = {f"elastic_energy{end}": f"half_space_energy{end}" for end in ("", "_draws")}
OF_MATERIAL = ("modulus", "work_of_adhesion", "range", "law", "pressed", "separation_factor")
OF_SURFACE = (*MOMENTS, "q0", "h_rms_draws", "q0_draws", *BOUNDS)
TOO_DIFFERENT = (
    "the two rough solids differ too much in scale: at the load at which a_V is evaluated, "
    f"{LOAD:g} E* q0 h_rms, they are in full contact"
)


def combine(material, surface, a_v, second=None):
    """Roughness of a `Material`, with its `second` surface if it is rough, on an analysed surface.

    `a_v` is what `find_a_v` has for the surface.
    """
    pair, doubts = conform(material, surface, second), [find_doubts([surface, second])]
    if second is not None:
        spectra = zip(ENDS, find_spectra(surface, second), strict=True)
        try:
            a_v = [find_end_a_v(pair, *each) for each in spectra]
        except ValueError:  # attractive areas vanish within rounding
            doubts.append(TOO_DIFFERENT)
    at = [each.at(material.range / h) for each, h in zip(a_v, pair.h_rms.values, strict=True)]
    names = ("a_v", "a_v_low", "a_v_high")
    pair = pair.assign({n: ("end", x) for n, x in zip(names, np.transpose(at), strict=True)})
    return pair.assign_attrs(not_judged="\n".join(filter(None, doubts)))


def conform(material, surface, second=None):
    """Roughness that the solid of a `Material` has to conform to."""
    pair = describe(surface)
    if second is not None:
        pair = add_surfaces(surface, second, material.solid)
    if material.solid == HALF_SPACE:
        return pair
    return put_on_layer(pair, material.solid, find_spectra(surface, second))


def find_doubts(surfaces):
    """Why a pair is not judged, by the attributes of its surfaces; empty if it is."""
    reasons = (one.attrs.get("not_judged") for one in surfaces if one is not None)
    return "\n".join(filter(None, reasons))


def describe(surface):
    """Roughness of a smooth half-space on an analysed surface."""
    pair = surface[[name for name in OF_SURFACE if name in surface]].sel(end=list(ENDS))
    return pair.drop_attrs().assign(
        **{bound: pair[name] for name, bound in BOUNDS.items() if name in pair},
        stiffening=xr.ones_like(pair.elastic_energy),
        relative_compliance=1.0,
        film_response=(("end", "response", "factor"), np.zeros((2, 2, len(FILM_FACTORS)))),
        anisotropy_error_factor=find_error_factor(float(surface.get("axis_ratio", 1.0))),
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
    known = [name for name in one if name.endswith("_draws")]
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
    for name in set(one) - {"stiffening", "relative_compliance", "anisotropy_error_factor"}:
        if "energy" in name:
            pair[name] = one[name] + other[name]
        elif name.startswith("q0"):
            pair[name] = one[name] ** share * other[name] ** (1 - share)
        else:
            pair[name] = np.hypot(one[name], other[name])
    return pair


def put_on_layer(pair, solid, spectra):
    """Roughness of a half-space as a layer sees it; `spectra` are those of both ends."""
    energy = [spectrum.elastic_energy(solid) for spectrum in spectra]
    ratio = np.divide(energy, [spectrum.elastic_energy() for spectrum in spectra])
    # A film is softer to some waves, its layer stiffer to others: a half-space bounds nothing.
    bound = np.nan if isinstance(solid.backing, Film) else 1.0
    compliance = float(solid.factor(float(pair.q0)))
    found = pair.assign(stiffening=("end", ratio), relative_compliance=compliance)
    if isinstance(solid.backing, Film):
        films = [find_film_response(spectrum, solid, float(pair.q0)) for spectrum in spectra]
        found["film_response"] = ("end", "response", "factor"), films
    # The spectra of the draws are not kept: the layer acts on them as on both ends.
    for name, factor in zip(BOUNDS, (ratio, np.sqrt(np.prod(ratio))), strict=True):
        if name in pair:
            found[name] = pair[name] * factor
            found[BOUNDS[name]] = pair[BOUNDS[name]] * bound
    return found


def meet(material, rough):
    """`Pair` of a `Material` on a `Roughness`, for all that needs no a_V."""
    known = vars(rough) | {name: getattr(material, name) for name in OF_MATERIAL}
    strain = material.solid.strain(rough.h_rms, rough.q0)
    return Pair(**known, layer_strain=strain, rms_curvature=np.nan, a_v=np.nan)


def read_ends(pair, ending=""):
    """`Roughness` of both ends, or of all with another `ending` of names."""
    names = [field.name for field in fields(Roughness) if field.name != "law"]
    return Roughness(**{name: pair.get(f"{name}{ending}", pair[name]).values for name in names})


def read_draws(pair, material):
    """`Pair` of a `Material` on the draws of a measured surface; None of others."""
    if "h_rms_draws" not in pair:
        return None
    # Slopes and layers of the draws are not kept; those of both ends hardly differ.
    means = {name: pair[name].mean("end") for name in ("rms_slope", "film_response")}
    return meet(material, read_ends(pair.assign(means), "_draws"))
