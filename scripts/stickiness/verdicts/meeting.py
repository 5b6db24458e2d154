"""A material meets a surface: the one place where both become the numbers of a pair.

A measured surface may have each of its drawn spectra, and each has an error of the model of its
own, so that quantiles over these rows hold both. A described surface may lie anywhere between its
smooth and its rough end. Its value is that of the rough end; its limits are the least and the
greatest at either end with the model at either limit. A layer, a skin or a second rough solid acts
on every spectrum.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.criteria.a_v_theory import LOAD, RANGES, SurfaceAv, surface_a_v
from stickiness.criteria.pair import Pair
from stickiness.entries.material import Material
from stickiness.limited import Limited
from stickiness.remaining.roughness import Roughness
from stickiness.remaining.solid_response import SolidResponse
from stickiness.solids import HALF_SPACE, Solid
from stickiness.solids.moduli import Modulus
from stickiness.spectrum import SpectrumFamily, combine
from stickiness.spectrum.interface import Spectrum
from stickiness.statistics import COVERS
from stickiness.verdicts.limits import limit_between_ends, limit_drawn
from stickiness.verdicts.rough_surface import Surface
from stickiness.verdicts.surface_data import END_QUANTILES, MOMENTS

HARDLY_CHANGED = 0.02  # relative, of the energy of full contact
_SEED = 2  # of the errors of the model
_SHUFFLE_SEED = 3  # of the order in which spectra of a second surface meet those of the first
TOO_DIFFERENT = (
    "the two rough solids differ too much in scale: at the load at which a_V is evaluated, "
    f"{LOAD:g} E* q0 h_rms, they are in full contact"
)


@dataclass(frozen=True)
class Meeting:
    """A material on a surface, in all that the surface may be. All results are made of it."""

    pair: Pair  #: `n` rows
    ends: Pair  #: the smooth and the rough end, with what serves all criteria, ``(2,)``
    is_drawn: bool  #: whether the rows are draws of a measured surface
    family: SpectrumFamily  #: of the rows
    spectra: tuple[Spectrum, ...]  #: of both ends, of both solids if both are rough
    stiffening: NDArray  #: energy of full contact over that of a half-space, at both ends, ``(2,)``
    a_v: Limited[NDArray]  #: at both ends, ``(2,)`` each
    solid: Solid
    moduli: Modulus  #: E* by the frequency or the dwell
    dwell: float | None  #: [s]
    quoted_ratio: float  #: modulus as it was given over E*
    not_judged: str  #: why the pair is not judged, a line each; empty if it is

    def limit(self, values: ArrayLike, pair: Pair) -> NDArray:
        """Low limit, value and high limit of a number of `pair` in all rows, along a last axis."""
        find = limit_drawn if self.is_drawn else limit_between_ends
        return find(values, pair.withstands)


def meet(material: Material, surface: Surface, wanted_share: float) -> Meeting:
    """Let a material meet a surface."""
    own = material.surface
    solid = material.solid
    spectra: tuple[Spectrum, ...] = surface.spectra
    rms_curvature = surface.data.rms_curvature.values
    if own is not None:
        both = zip(spectra, own.spectra, strict=True)
        spectra = tuple(combine(first, second) for first, second in both)
        rms_curvature = np.hypot(rms_curvature, own.data.rms_curvature.values)

    # What the surface may be, and by how much the model may err there.
    family = find_family(material, surface)
    is_drawn = family.is_drawn
    rough = find_roughness(material, surface, family)
    at_ends = rough
    if is_drawn:
        q0 = float(surface.data.q0) if own is None else float(np.median(rough.q0))
        at_ends = _find_ends(rough, spectra, solid, q0)
    stiffening = family.energy(solid) / family.energy()
    if is_drawn:
        stiffening = np.quantile(stiffening, END_QUANTILES)

    pair = make_pair(material, deviate(rough, is_drawn), wanted_share)
    ends = make_pair(material, at_ends, wanted_share)
    ends = replace(ends, rms_curvature=rms_curvature)
    a_v, doubt = _find_a_v(ends, spectra, surface, is_double=own is not None)
    doubts = ("" if each is None else each.not_judged for each in (surface, own))
    return Meeting(
        pair=pair,
        ends=replace(ends, a_v=a_v.value),
        is_drawn=is_drawn,
        family=family,
        spectra=spectra,
        stiffening=stiffening,
        a_v=a_v,
        solid=solid,
        moduli=material.plane_strain.scaled(pair.modulus / material.plane_strain_modulus),
        dwell=material.dwell,
        quoted_ratio=material.quoted_modulus / material.plane_strain_modulus,
        not_judged="\n".join(filter(None, (*doubts, doubt, _doubt_smoothness(ends)))),
    )


def make_pair(material: Material, rough: Roughness, wanted_share: float) -> Pair:
    """`Pair` of a material on roughness that it meets: all that results know of the material."""
    return Pair(
        rough=replace(
            rough,
            law=material.law,
            instant_ratio=material.instant_ratio,
            wanted_share=wanted_share,
        ),
        modulus=material.plane_strain_modulus,
        work_of_adhesion=material.work_of_adhesion,
        range=material.range,
        pressed=material.pressed,
        wanted_share=wanted_share,
        layer_strain=material.solid.strain(rough.h_rms, rough.q0),
    )


def deviate(rough: Roughness, is_drawn: bool) -> Roughness:
    """Rows with errors of the model: a random one for each draw; both ends at eta = 0, -1 and 1.

    `limits` knows what a row stands for by its place.
    """
    if is_drawn:
        (count,) = rough.shape_of_arrays
        return rough.deviating(np.random.default_rng(_SEED).normal(size=count) / COVERS)
    return rough.take(np.tile([0, 1], 3)).deviating(np.repeat([0.0, -1.0, 1.0], 2))


def find_family(material: Material, surface: Surface, above: float = 0.0) -> SpectrumFamily:
    """Spectra that the roughness of a surface, and of the material, may have together.

    Waves below a wave number are left out [1/m].
    """
    if material.surface is None:
        return surface.find_family(above)
    return _add_families(*_align(material, surface), above)


def _align(material: Material, surface: Surface) -> tuple[Surface, Surface, NDArray]:
    """Both rough solids, a measured one first, and for each of its spectra the row of the second.

    Ends meet ends. Draws meet draws in another order, for measurements of two surfaces err
    independently, although their draws have one seed; not so those of the same surface.
    """
    first = surface
    second = material.surface
    if second.draw_count and not first.draw_count:
        first, second = second, first
    rows = np.resize(np.arange(second.family.count), first.family.count)
    if first.draw_count and second is not first:
        rows = np.random.default_rng(_SHUFFLE_SEED).permutation(rows)
    return first, second, rows


def find_roughness(
    material: Material, surface: Surface, family: SpectrumFamily, above: float = 0.0
) -> Roughness:
    """Roughness that a material meets, a row for each spectrum of a family, without errors."""
    solid = material.solid
    if material.surface is None:
        columns = surface.find_columns(above)
    else:
        columns = _add_columns(*_align(material, surface), solid, above)
    rough = Roughness.of(family, solid, **columns)
    if family.is_drawn:
        measured = family.up_to(_find_cutoff(material, surface))
        rough = replace(rough, unresolved=1 - measured.energy(solid) / rough.elastic_energy)
    if rough.simulated is None or solid == HALF_SPACE:
        return rough
    added = rough.elastic_energy / rough.half_space_energy - 1
    kept = _keep_simulation(rough, np.array([added, 1 - rough.relative_compliance]))
    if kept.simulated is not None or material.surface is not None:
        return kept
    return _simulate_on_layer(kept, surface, solid)


def _find_cutoff(material: Material, surface: Surface) -> float:
    """Highest wave number that the measurements resolve [1/m]."""
    rough = [each for each in (surface, material.surface) if each is not None and each.draw_count]
    return min(float(each.data.q_cutoff) for each in rough)


def _add_families(first: Surface, second: Surface, rows: NDArray, above: float) -> SpectrumFamily:
    """Sums of the spectra of two solids."""
    return first.find_family(above) + _meet_first(first, second, rows, above)


def _meet_first(first: Surface, second: Surface, rows: NDArray, above: float) -> SpectrumFamily:
    """Spectra of the second solid that meet those of the first."""
    family = second.find_family(above)
    if first.draw_count and not second.draw_count:
        # A surface that is known between two ends lies anywhere between.
        places = np.linspace(0.0, 1.0, rows.size)
        return family.between(np.random.default_rng(_SHUFFLE_SEED).permutation(places))
    return family.take(rows)


def _add_columns(
    first: Surface, second: Surface, rows: NDArray, solid: Solid, above: float
) -> dict[str, Any]:
    """Columns of the roughness of two solids, by those of each."""
    one = Roughness.of(first.find_family(above), solid, **first.find_columns(above))
    other = Roughness.of(
        _meet_first(first, second, rows, above), solid, **_take(second.find_columns(above), rows)
    )
    # What the shape of the heights changes goes with their skewness. Third cumulants of independent
    # heights add, and the skewness is that over the cube of the rms height.
    h_rms = np.hypot(one.h_rms, other.h_rms)
    of_one = (one.h_rms / h_rms) ** 3
    of_other = (other.h_rms / h_rms) ** 3
    # q0 is the geometric mean of both, weighted by the energies that they store.
    share = one.elastic_energy / (one.elastic_energy + other.elastic_energy)
    added = np.divide(other.half_space_energy, one.half_space_energy)
    kept = _keep_simulation(one, added[None])
    return {
        "q0": one.q0**share * other.q0 ** (1 - share),
        "q1": max(one.q1, other.q1),
        "rms_slope": np.hypot(one.rms_slope, other.rms_slope),
        "waves": one.waves,
        "anisotropy_error_factor": max(one.anisotropy_error_factor, other.anisotropy_error_factor),
        "shape": of_one * one.shape + of_other * other.shape,
        "shape_error": np.hypot(of_one * one.shape_error, of_other * other.shape_error),
        "simulated": kept.simulated,
        "lacking": kept.lacking,
    }


def _take(columns: dict[str, Any], rows: NDArray) -> dict[str, Any]:
    """Some rows of the columns that have any."""
    return {name: column[rows] if np.ndim(column) else column for name, column in columns.items()}


def _keep_simulation(rough: Roughness, changes: NDArray) -> Roughness:
    """The same with simulated states where a solid hardly changes the energy, else without.

    The first of the `changes`, ``(kind, n)``, is the energy added over that of the heights. Up to
    `HARDLY_CHANGED` it counts as that of waves that are not simulated; beyond, these states of a
    half-space tell nothing.
    """
    if np.max(np.abs(changes)) > HARDLY_CHANGED:
        return replace(rough, simulated=None, lacking=0.0)
    lacking = (1 + np.asarray(rough.lacking)) * (1 + np.maximum(changes[0], 0.0)) - 1
    return replace(rough, lacking=lacking)


def _simulate_on_layer(rough: Roughness, surface: Surface, solid: Solid) -> Roughness:
    """The same with states of the layer itself.

    States scale with one modulus, which the film under a layer, and a half-space below a skin, do
    not share: there theory decides.
    """
    if rough.response is not None:
        return rough
    simulated = surface.simulate_on(solid)
    if simulated is None:
        return rough
    # Waves that the grid lacks are stiffened, too, of every spectrum its own.
    fine = surface.family.above(np.pi / simulated.pixel)
    stiffening = fine.energy(solid) / fine.energy()
    energy = surface.lacking_energy
    lacking = stiffening * energy / simulated.whole.full_contact_energy
    return replace(rough, simulated=simulated, lacking=lacking)


def _find_ends(
    rough: Roughness, spectra: tuple[Spectrum, ...], solid: Solid, q0: float
) -> Roughness:
    """Smooth and rough end of what draws say, ``(2,)``: quantiles of every column but `q0`."""
    columns = {
        name: np.quantile(column, END_QUANTILES)
        for name, column in rough.columns.items()
        if np.ndim(column)
    }
    ends = replace(rough, **columns | {"q0": np.full(2, q0), "row": np.arange(2)})
    if rough.response is None:
        return ends
    response = SolidResponse(SpectrumFamily.of(*spectra), solid, np.full(2, q0))
    return replace(ends, response=response)


def _doubt_smoothness(ends: Pair) -> str:
    """Say that heights are too small to matter, as those in a wrong unit are; empty if not."""
    h_rms = float(np.asarray(ends.h_rms)[0])
    if ends.range <= RANGES[-1] * h_rms:
        return ""
    return (
        f"the range of {ends.range:.3g} m is more than {RANGES[-1]:g} times the rms height of "
        f"{h_rms:.3g} m: for this attraction the surface is smooth"
    )


def _find_a_v(
    ends: Pair, spectra: tuple[Spectrum, ...], surface: Surface, is_double: bool
) -> tuple[Limited[NDArray], str]:
    """a_V of the pair at both ends, and why it is not known; then that of the surface alone."""
    a_v: tuple[SurfaceAv, ...] = surface.a_v
    doubt = ""
    if is_double:
        moments = np.transpose([ends.q0, ends.h_rms, ends.rms_slope, ends.rms_curvature])
        try:
            a_v = tuple(
                surface_a_v(spectrum, dict(zip(("q0", *MOMENTS), of_end, strict=True)))
                for spectrum, of_end in zip(spectra, moments, strict=True)
            )
        except ValueError:  # attractive areas vanish within rounding
            doubt = TOO_DIFFERENT
    ranges = ends.range / np.asarray(ends.h_rms)
    limited = [end_a_v.at(ratio) for end_a_v, ratio in zip(a_v, ranges, strict=True)]
    return Limited(*np.array(limited).T), doubt
