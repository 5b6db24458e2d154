"""Roughness of a pair: that of the surface and of the material, as the material's solid meets it.

The surface of a material that is rough itself adds its spectrum. A layer or a skin changes the
energy that it takes to conform. Everything is known at both ends of the surface, and on the draws
of a surface that was measured.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.criteria.a_v_table import LOAD, RANGES, SurfaceAv, surface_a_v
from stickiness.criteria.pair import Pair, make_pair
from stickiness.limited import Limited
from stickiness.remaining.prediction import (
    FilmResponse,
    Roughness,
    find_half_space_energy,
    find_relative_compliance,
    is_on_film,
)
from stickiness.remaining.thin_layers import find_flow
from stickiness.solids import HALF_SPACE, Skin, Solid
from stickiness.spectrum import combine
from stickiness.spectrum.interface import Spectrum
from stickiness.verdicts.material import Material
from stickiness.verdicts.parametric import MOMENTS
from stickiness.verdicts.rough_surface import Surface

SHUFFLE_SEED = 3  #: of the order in which draws of a second surface meet those of the first
HARDLY_CHANGED = 0.02  # relative, of the energy of full contact
TOO_DIFFERENT = (
    "the two rough solids differ too much in scale: at the load at which a_V is evaluated, "
    f"{LOAD:g} E* q0 h_rms, they are in full contact"
)


@dataclass(frozen=True)
class PairRoughness:
    """Roughness that a material meets on a surface."""

    ends: Roughness  #: at the smooth and the rough end, ``(2,)``; q0 is the same at both
    draws: Roughness | None  #: of every draw of a measured surface, ``(n,)``
    rms_curvature: NDArray  #: at both ends [1/m], ``(2,)``
    spectra: tuple[Spectrum, ...]  #: of both ends, of both solids if both are rough
    stiffening: NDArray  #: energy of full contact over that of a half-space, ``(2,)``
    a_v: Limited  #: at both ends of the surface, ``(2,)`` each
    not_judged: str  #: why the pair is not judged, a line each; empty if it is

    def meet_draws(self, material: Material, wanted_share: float) -> Pair | None:
        """`Pair` of the material with every draw; None of a surface that was not measured."""
        return None if self.draws is None else _meet(material, self.draws, wanted_share)

    def meet_ends(self, material: Material, wanted_share: float) -> Pair:
        """`Pair` of the material with both ends of the surface, for what needs no a_V."""
        return _meet(material, self.ends, wanted_share)


def _meet(material: Material, rough: Roughness, wanted_share: float) -> Pair:
    """`Pair` of a material and a roughness."""
    return make_pair(
        rough,
        modulus=material.plane_strain_modulus,
        work_of_adhesion=material.work_of_adhesion,
        range=material.range,
        law=material.law,
        instant_ratio=material.instant_ratio,
        pressed=material.pressed,
        wanted_share=wanted_share,
        layer_strain=material.solid.strain(rough.h_rms, rough.q0),
    )


def combine_roughness(material: Material, surface: Surface) -> PairRoughness:
    """Find the roughness that a material meets on a surface."""
    own = material.surface
    ends = surface.ends
    draws = surface.draws
    spectra = surface.spectra
    rms_curvature = _curvature(surface)
    doubts = [surface.not_judged]

    # A material that is rough itself adds its spectrum, independent of the other.
    if own is not None:
        doubts.append(own.not_judged)
        spectra = tuple(
            combine(first, second) for first, second in zip(spectra, own.spectra, strict=True)
        )
        ends, draws = _add_surfaces(surface, own, material.solid)
        rms_curvature = np.hypot(rms_curvature, _curvature(own))

    # A layer or a skin changes the energy of full contact, and the compliance.
    stiffening = np.ones(2)
    if material.solid != HALF_SPACE:
        ends, draws, stiffening = _put_on_layer(ends, draws, spectra, material.solid)
        if surface.is_larger and own is None:
            draws = _stiffen_longer(draws, surface, material.solid)
        if own is None:
            ends, draws = _simulate_on_layer(ends, draws, surface, material.solid)
    if isinstance(material.solid, Skin) and own is None and surface.unresolved_energy > 0:
        ends, draws = _stiffen_unresolved(ends, draws, surface, stiffening, material.solid)

    a_v, doubt = _find_a_v(material, surface, ends, rms_curvature, spectra)
    doubts.append(doubt)
    doubts.append(_doubt_smoothness(material.range, h_rms=float(ends.h_rms[0])))
    return PairRoughness(
        ends=ends,
        draws=draws,
        rms_curvature=rms_curvature,
        spectra=tuple(spectra),
        stiffening=stiffening,
        a_v=a_v,
        not_judged="\n".join(filter(None, doubts)),
    )


def _doubt_smoothness(range: float, h_rms: float) -> str:
    """Say that heights are too small to matter, as those in a wrong unit are; empty if not."""
    if range <= RANGES[-1] * h_rms:
        return ""
    return (
        f"the range of {range:.3g} m is more than {RANGES[-1]:g} times the rms height of "
        f"{h_rms:.3g} m: for this attraction the surface is smooth"
    )


def _curvature(surface: Surface) -> NDArray:
    """Rms Laplacian of a surface at both ends [1/m]."""
    return surface.data.rms_curvature.values


def _find_a_v(
    material: Material,
    surface: Surface,
    ends: Roughness,
    rms_curvature: NDArray,
    spectra: tuple[Spectrum, ...],
) -> tuple[Limited, str]:
    """a_V of the pair at both ends, and why it is not known; then that of the surface alone."""
    a_v: tuple[SurfaceAv, ...] = surface.a_v
    doubt = ""
    if material.surface is not None:
        moments = zip(ends.q0, ends.h_rms, ends.rms_slope, rms_curvature, strict=True)
        try:
            a_v = tuple(
                surface_a_v(spectrum, dict(zip(("q0", *MOMENTS), values, strict=True)))
                for spectrum, values in zip(spectra, moments, strict=True)
            )
        except ValueError:  # attractive areas vanish within rounding
            doubt = TOO_DIFFERENT
    limited = [
        end_a_v.at(material.range / h_rms) for end_a_v, h_rms in zip(a_v, ends.h_rms, strict=True)
    ]
    return Limited(*np.transpose(limited)), doubt


def _add_surfaces(
    surface: Surface, own: Surface, solid: Solid
) -> tuple[Roughness, Roughness | None]:
    """Roughness of two rough half-spaces at both ends and on draws.

    The draws of one surface are kept if the other has draws, too, or ends that agree.
    """
    if surface.draws is None and own.draws is not None:
        return _add_surfaces(own, surface, solid)
    # q0 is the geometric mean of both, weighted by the energies that they store.
    stored, added = (
        sum(spectrum.elastic_energy(solid) for spectrum in each.spectra) for each in (surface, own)
    )
    share = float(stored / (stored + added))
    ends = _add(surface.ends, own.ends, share)
    if surface.draws is None:
        return ends, None
    if own.draws is not None:
        # Measurements of two surfaces err independently, although their draws have one seed.
        second = _repeat_draws(own.draws, count=surface.draw_count, shuffled=own is not surface)
    elif np.ptp(own.ends.h_rms) == np.ptp(own.ends.elastic_energy) == 0:
        second = _take_smooth_end(own.ends)
    else:
        return ends, None
    draws = _add(surface.draws, second, share)
    # As in `Surface.draws`: slopes of draws are not kept.
    return ends, replace(draws, rms_slope=ends.rms_slope.mean())


def _add(first: Roughness, second: Roughness, share: float) -> Roughness:
    """Roughness of two solids; the first stores the `share` of the elastic energy."""
    return replace(
        first,
        h_rms=np.hypot(first.h_rms, second.h_rms),
        rms_slope=np.hypot(first.rms_slope, second.rms_slope),
        q0=first.q0**share * second.q0 ** (1 - share),
        q1=np.maximum(first.q1, second.q1),
        elastic_energy=first.elastic_energy + second.elastic_energy,
        half_space_energy=first.half_space_energy + second.half_space_energy,
        anisotropy_error_factor=np.maximum(
            first.anisotropy_error_factor, second.anisotropy_error_factor
        ),
        **_add_shapes(first, second),
        **_keep_simulation(first, added=second.elastic_energy / first.elastic_energy),
    )


def _add_shapes(first: Roughness, second: Roughness) -> dict[str, NDArray]:
    """What the shape of the heights of two solids changes, and its error.

    It goes with their skewness. Third cumulants of independent heights add, and the skewness is
    that over the cube of the rms height.
    """
    h_rms = np.hypot(first.h_rms, second.h_rms)
    of_first = (first.h_rms / h_rms) ** 3
    of_second = (second.h_rms / h_rms) ** 3
    return {
        "shape": of_first * first.shape + of_second * second.shape,
        "shape_error": np.hypot(of_first * first.shape_error, of_second * second.shape_error),
    }


def _keep_simulation(rough: Roughness, added: ArrayLike) -> dict[str, NDArray]:
    """Fields of the simulated heights where another solid or a layer hardly changes the energy.

    `added` is the energy added over that of the heights. Up to `HARDLY_CHANGED` it counts as that
    of waves that are not simulated; beyond, these states of a half-space tell nothing.
    """
    lacking = (1 + np.asarray(rough.lacking)) * (1 + np.maximum(added, 0.0)) - 1
    if np.max(np.abs(added)) > HARDLY_CHANGED:
        return {"simulated": np.full(lacking.shape, None), "lacking": np.zeros(lacking.shape)}
    return {"simulated": rough.simulated, "lacking": lacking}


def _find_largest_change(stiffening: NDArray, compliance: NDArray) -> float:
    """Largest relative change of energy and compliance by a layer, with its sign."""
    changes = np.append(stiffening - 1, 1 - compliance)
    return float(changes[np.abs(changes).argmax()])


def _repeat_draws(draws: Roughness, count: int, shuffled: bool) -> Roughness:
    """As many draws as `count`, repeated or cut off, in their order or in a random one."""
    order = np.resize(np.arange(draws.h_rms.size), count)
    if shuffled:
        order = np.random.default_rng(SHUFFLE_SEED).permutation(order)
    return replace(
        draws,
        h_rms=draws.h_rms[order],
        q0=draws.q0[order],
        elastic_energy=draws.elastic_energy[order],
        half_space_energy=draws.half_space_energy[order],
    )


def _take_smooth_end(ends: Roughness) -> Roughness:
    """Roughness of the smooth end alone."""
    return replace(
        ends,
        h_rms=ends.h_rms[0],
        q0=ends.q0[0],
        q1=ends.q1[0],
        elastic_energy=ends.elastic_energy[0],
        half_space_energy=ends.half_space_energy[0],
        rms_slope=ends.rms_slope[0],
        anisotropy_error_factor=ends.anisotropy_error_factor[0],
        waves=ends.waves[0],
        shape=ends.shape[0],
        shape_error=ends.shape_error[0],
    )


def _stiffen_unresolved(
    ends: Roughness, draws: Roughness, surface: Surface, stiffening: NDArray, skin: Skin
) -> tuple[Roughness, Roughness]:
    """Let a skin meet unresolved waves, at least, as it meets the shortest that are resolved."""
    shortest = float(surface.spectra[0].band[1])
    gain = np.maximum(1 / (skin.factor(shortest) * stiffening), 1.0)
    stiffened = []
    for rough, ending, its_gain in (
        (ends, "", gain),
        (draws, "_draws", np.sqrt(np.prod(gain))),
    ):
        beyond = surface.data[f"beyond_energy{ending}"].values
        longer = np.asarray(surface.data.get(f"longer_energy{ending}", 0.0))
        unresolved = beyond / (1 + beyond) / (1 + longer)
        change = 1 + unresolved * (its_gain - 1)
        stiffened.append(
            replace(
                rough,
                elastic_energy=rough.elastic_energy * change,
                relative_compliance=rough.relative_compliance / change,
            )
        )
    return stiffened[0], stiffened[1]


def _put_on_layer(
    ends: Roughness, draws: Roughness | None, spectra: tuple[Spectrum, ...], solid: Solid
) -> tuple[Roughness, Roughness | None, NDArray]:
    """Roughness as a layer or skin meets it, and its energy over that of a half-space."""
    energy = [spectrum.elastic_energy(solid) for spectrum in spectra]
    stiffening = np.divide(energy, [spectrum.elastic_energy() for spectrum in spectra])
    q0 = float(ends.q0[0])
    compliance = np.array([find_relative_compliance(each, solid, q0) for each in spectra])
    flow = float(find_flow(solid, q0))
    is_skin = np.full(2, isinstance(solid, Skin))
    ends = replace(
        ends,
        elastic_energy=ends.elastic_energy * stiffening,
        relative_compliance=compliance,
        flow=np.full(2, flow),
        is_skin=is_skin,
        **_keep_simulation(ends, added=_find_largest_change(stiffening, compliance)),
    )
    if draws is not None:
        # The spectra of the draws are not kept: the layer acts on them as on both ends.
        draws = replace(
            draws,
            elastic_energy=draws.elastic_energy * np.sqrt(np.prod(stiffening)),
            relative_compliance=np.sqrt(np.prod(compliance)),
            flow=np.float64(flow),
            is_skin=is_skin[0],
            **_keep_simulation(draws, added=_find_largest_change(stiffening, compliance)),
        )
    if is_on_film(solid) or isinstance(solid, Skin):
        responses = [FilmResponse((spectrum,), solid, q0) for spectrum in spectra]
        ends = replace(ends, film_response=np.array(responses))
        if draws is not None:
            draws = replace(draws, film_response=FilmResponse(spectra, solid, q0))
    if find_half_space_energy(spectra[0], solid) is None:
        # A film makes the solid softer to long waves, the layer stiffer to others: energies on a
        # half-space bound neither way.
        ends = replace(ends, half_space_energy=np.full(2, np.nan))
        if draws is not None:
            draws = replace(draws, half_space_energy=np.full(draws.h_rms.shape, np.nan))
    return ends, draws, stiffening


def _stiffen_longer(draws: Roughness, surface: Surface, solid: Solid) -> Roughness:
    """Let the longer waves of every draw meet a layer, which stiffens the longest most."""
    q = surface.data.longer_wave_number.values
    on_half_space = 2 * np.pi / 4 * surface.data.longer_psd_draws.values @ q**3
    on_solid = 2 * np.pi / 4 * surface.data.longer_psd_draws.values @ (q**3 / solid.factor(q))

    # The other waves are stiffened alike in all draws.
    kept = float(surface.data.q_kept)
    others = []
    for spectrum in surface.spectra:
        waves = spectrum.averaged()
        highest = spectrum.band[1]
        energy = waves.integrate(lambda q: q, kept, highest)
        others.append(waves.integrate(lambda q: q / solid.factor(q), kept, highest) / energy)
    energy = surface.data.elastic_energy_draws.values - on_half_space
    stiffening = np.sqrt(np.prod(others))
    return replace(draws, elastic_energy=stiffening * energy + on_solid)


def _simulate_on_layer(
    ends: Roughness, draws: Roughness | None, surface: Surface, solid: Solid
) -> tuple[Roughness, Roughness | None]:
    """Roughness with states of the layer itself, where it differs from a half-space.

    States scale with one modulus, which a film under the layer does not share: there theory stays.
    """
    is_kept = ends.simulated[0] is not None
    is_scaled = ends.film_response[0] is None
    if surface.simulated is None or draws is None or is_kept or not is_scaled:
        return ends, draws
    simulated = surface.simulate_on(solid)
    if simulated is None:
        return ends, draws
    ends = replace(
        ends,
        simulated=np.full(2, simulated),
        lacking=surface.find_lacking_on(solid, simulated, surface.ends.lacking),
    )
    draws = replace(
        draws,
        simulated=simulated,
        lacking=surface.find_lacking_on(solid, simulated, surface.draws.lacking),
    )
    return ends, draws
