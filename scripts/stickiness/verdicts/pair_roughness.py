"""Roughness of a pair: that of the surface and of the material, as the material's solid meets it.

The surface of a material that is rough itself adds its spectrum. A layer or a skin changes the
energy that it takes to conform. Both act on every row of what the surface may be.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.criteria.a_v_table import LOAD, RANGES, SurfaceAv, surface_a_v
from stickiness.criteria.pair import Pair
from stickiness.entries.material import Material
from stickiness.limited import Limited
from stickiness.remaining.roughness import Roughness
from stickiness.remaining.solid_response import (
    FilmResponse,
    find_half_space_energy,
    find_relative_compliance,
    find_stiffening,
    is_on_film,
)
from stickiness.remaining.thin_layers import find_flow
from stickiness.solids import HALF_SPACE, Skin, Solid
from stickiness.spectrum import combine
from stickiness.spectrum.interface import Spectrum
from stickiness.verdicts.limits import find_limits
from stickiness.verdicts.parametric import MOMENTS
from stickiness.verdicts.rough_surface import Surface
from stickiness.verdicts.scenarios import END_ROWS, Scenarios

HARDLY_CHANGED = 0.02  # relative, of the energy of full contact
TOO_DIFFERENT = (
    "the two rough solids differ too much in scale: at the load at which a_V is evaluated, "
    f"{LOAD:g} E* q0 h_rms, they are in full contact"
)


@dataclass(frozen=True)
class PairRoughness:
    """Roughness that a material meets on a surface."""

    scenarios: Scenarios  #: all that it may be
    rms_curvature: NDArray  #: at both ends [1/m], ``(2,)``
    spectra: tuple[Spectrum, ...]  #: of both ends, of both solids if both are rough
    stiffening: NDArray  #: energy of full contact over that of a half-space, ``(2,)``
    a_v: Limited[NDArray]  #: at both ends of the surface, ``(2,)`` each
    not_judged: str  #: why the pair is not judged, a line each; empty if it is

    def meet(self, material: Material, wanted_share: float) -> Pair:
        """`Pair` of the material with all that the surface may be."""
        rough = replace(
            self.scenarios.roughness, law=material.law, instant_ratio=material.instant_ratio
        )
        return Pair(
            rough=rough,
            modulus=material.plane_strain_modulus,
            work_of_adhesion=material.work_of_adhesion,
            range=material.range,
            deviation=self.scenarios.deviation,
            pressed=material.pressed,
            wanted_share=wanted_share,
            layer_strain=material.solid.strain(rough.h_rms, rough.q0),
        )

    def limit(self, values: ArrayLike, pair: Pair) -> NDArray:
        """Low limit, value and high limit of a number of `pair` in all rows, along a last axis."""
        return find_limits(values, self.scenarios.weights, pair.withstands)

    def take_ends(self, pair: Pair) -> Pair:
        """What `meet` makes, at both ends, with what serves all criteria."""
        return replace(pair.take(END_ROWS), rms_curvature=self.rms_curvature, a_v=self.a_v.value)


def combine_roughness(material: Material, surface: Surface) -> PairRoughness:
    """Find the roughness that a material meets on a surface."""
    own = material.surface
    solid = material.solid
    scenarios = combine_scenarios(material, surface)
    spectra: tuple[Spectrum, ...] = surface.spectra
    rms_curvature = surface.data.rms_curvature.values
    doubts = [surface.not_judged]

    # A material that is rough itself adds its spectrum, independent of the other.
    if own is not None:
        doubts.append(own.not_judged)
        spectra = tuple(
            combine(first, second) for first, second in zip(spectra, own.spectra, strict=True)
        )
        rms_curvature = np.hypot(rms_curvature, own.data.rms_curvature.values)

    # A layer or a skin changes the energy of full contact, and the compliance.
    stiffening = np.ones(2)
    if solid != HALF_SPACE:
        energies = [spectrum.elastic_energy(solid) for spectrum in spectra]
        stiffening = np.divide(energies, [spectrum.elastic_energy() for spectrum in spectra])
        scenarios = _put_on_layer(scenarios, spectra, stiffening, solid)
        if own is None:
            scenarios = _adapt_to_surface(scenarios, surface, stiffening, solid)

    ends = scenarios.ends
    a_v, doubt = _find_a_v(material, surface, ends, rms_curvature, spectra)
    doubts.append(doubt)
    doubts.append(_doubt_smoothness(material.range, h_rms=float(np.asarray(ends.h_rms)[0])))
    return PairRoughness(
        scenarios=scenarios,
        rms_curvature=rms_curvature,
        spectra=spectra,
        stiffening=stiffening,
        a_v=a_v,
        not_judged="\n".join(filter(None, doubts)),
    )


def combine_scenarios(material: Material, surface: Surface) -> Scenarios:
    """All that the roughness of a surface and of a material may be, on a half-space."""
    if material.surface is None:
        return surface.scenarios
    return _add_surfaces(surface, material.surface, material.solid)


def _doubt_smoothness(range: float, h_rms: float) -> str:
    """Say that heights are too small to matter, as those in a wrong unit are; empty if not."""
    if range <= RANGES[-1] * h_rms:
        return ""
    return (
        f"the range of {range:.3g} m is more than {RANGES[-1]:g} times the rms height of "
        f"{h_rms:.3g} m: for this attraction the surface is smooth"
    )


def _find_a_v(
    material: Material,
    surface: Surface,
    ends: Roughness,
    rms_curvature: NDArray,
    spectra: tuple[Spectrum, ...],
) -> tuple[Limited[NDArray], str]:
    """a_V of the pair at both ends, and why it is not known; then that of the surface alone."""
    a_v: tuple[SurfaceAv, ...] = surface.a_v
    doubt = ""
    if material.surface is not None:
        moments = np.transpose([ends.q0, ends.h_rms, ends.rms_slope, rms_curvature])
        try:
            a_v = tuple(
                surface_a_v(spectrum, dict(zip(("q0", *MOMENTS), of_end, strict=True)))
                for spectrum, of_end in zip(spectra, moments, strict=True)
            )
        except ValueError:  # attractive areas vanish within rounding
            doubt = TOO_DIFFERENT
    ranges = material.range / np.asarray(ends.h_rms)
    limited = [end_a_v.at(ratio) for end_a_v, ratio in zip(a_v, ranges, strict=True)]
    return Limited(*np.array(limited).T), doubt


def _add_surfaces(surface: Surface, own: Surface, solid: Solid) -> Scenarios:
    """All that the roughness of two solids may be."""
    if own.scenarios.is_drawn and not surface.scenarios.is_drawn:
        return _add_surfaces(own, surface, solid)
    # q0 is the geometric mean of both, weighted by the energies that they store.
    stored, added = (
        sum(spectrum.elastic_energy(solid) for spectrum in each.spectra) for each in (surface, own)
    )
    share = float(stored / (stored + added))
    scenarios, second = surface.scenarios.align(own.scenarios, is_same=own is surface)
    first = scenarios.roughness
    h_rms = np.hypot(first.h_rms, second.h_rms)
    # What the shape of the heights changes goes with their skewness. Third cumulants of independent
    # heights add, and the skewness is that over the cube of the rms height.
    of_first = (first.h_rms / h_rms) ** 3
    of_second = (second.h_rms / h_rms) ** 3
    return scenarios.with_roughness(
        h_rms=h_rms,
        rms_slope=np.hypot(first.rms_slope, second.rms_slope),
        q0=first.q0**share * second.q0 ** (1 - share),
        q1=np.maximum(first.q1, second.q1),
        elastic_energy=first.elastic_energy + second.elastic_energy,
        half_space_energy=first.half_space_energy + second.half_space_energy,
        anisotropy_error_factor=np.maximum(
            first.anisotropy_error_factor, second.anisotropy_error_factor
        ),
        shape=of_first * first.shape + of_second * second.shape,
        shape_error=np.hypot(of_first * first.shape_error, of_second * second.shape_error),
        **_keep_simulation(first, added=second.elastic_energy / first.elastic_energy),
    )


def _keep_simulation(rough: Roughness, added: ArrayLike) -> dict[str, Any]:
    """Fields of the simulated heights where another solid or a layer hardly changes the energy.

    `added` is the energy added over that of the heights. Up to `HARDLY_CHANGED` it counts as that
    of waves that are not simulated; beyond, these states of a half-space tell nothing.
    """
    lacking = (1 + np.asarray(rough.lacking)) * (1 + np.maximum(added, 0.0)) - 1
    if np.max(np.abs(added)) > HARDLY_CHANGED:
        return {"simulated": None, "lacking": np.zeros(lacking.shape)}
    return {"simulated": rough.simulated, "lacking": lacking}


def _put_on_layer(
    scenarios: Scenarios, spectra: tuple[Spectrum, ...], stiffening: NDArray, solid: Solid
) -> Scenarios:
    """The same as a layer or skin meets it; `stiffening` as of `PairRoughness`.

    The spectra of draws are not kept: the layer acts on them as on both ends.
    """
    rough = scenarios.roughness
    q0 = float(np.asarray(rough.q0)[0])
    compliance = np.array([find_relative_compliance(each, solid, q0) for each in spectra])
    changes = np.append(stiffening - 1, 1 - compliance)
    response = None
    if is_on_film(solid) or isinstance(solid, Skin):
        # Of an end it is that of its spectrum, of draws that of both.
        by_place = {0.0: spectra[:1], 1.0: spectra[1:], 0.5: spectra}
        responses = {place: FilmResponse(each, solid, q0) for place, each in by_place.items()}
        response = np.array([responses[place] for place in scenarios.place.tolist()])
    # A film makes the solid softer to long waves, the layer stiffer to others: energies on a
    # half-space bound neither way.
    is_bounded = np.isfinite(find_half_space_energy(spectra[0], solid))
    return scenarios.with_roughness(
        elastic_energy=rough.elastic_energy * scenarios.between(stiffening),
        half_space_energy=rough.half_space_energy if is_bounded else np.nan,
        relative_compliance=scenarios.between(compliance),
        flow=find_flow(solid, q0),
        is_skin=isinstance(solid, Skin),
        film_response=response,
        **_keep_simulation(rough, added=changes[np.abs(changes).argmax()]),
    )


def _adapt_to_surface(
    scenarios: Scenarios, surface: Surface, stiffening: NDArray, solid: Solid
) -> Scenarios:
    """The same with what a layer or skin does to waves of the surface that differ among rows."""
    if surface.is_larger:
        scenarios = _stiffen_longer(scenarios, surface, solid)
    scenarios = _simulate_on_layer(scenarios, surface, solid)
    if isinstance(solid, Skin) and surface.unresolved_energy > 0:
        scenarios = _stiffen_unresolved(scenarios, surface, stiffening, solid)
    return scenarios


def _stiffen_longer(scenarios: Scenarios, surface: Surface, solid: Solid) -> Scenarios:
    """Let the longer waves of every draw meet a layer, which stiffens the longest most."""
    q = surface.data.longer_wave_number.values
    on_half_space = 2 * np.pi / 4 * surface.data.longer_psd_draws.values @ q**3
    on_solid = 2 * np.pi / 4 * surface.data.longer_psd_draws.values @ (q**3 / solid.factor(q))

    # The other waves are stiffened alike in all draws.
    kept = float(surface.data.q_kept)
    others = [find_stiffening(solid, spectrum, kept) for spectrum in surface.spectra]
    energy = surface.data.elastic_energy_draws.values - on_half_space
    of_draws = np.sqrt(np.prod(others)) * energy + on_solid
    at_ends = scenarios.ends.elastic_energy
    return scenarios.with_roughness(elastic_energy=np.append(at_ends, of_draws))


def _simulate_on_layer(scenarios: Scenarios, surface: Surface, solid: Solid) -> Scenarios:
    """The same with states of the layer itself, where it differs from a half-space.

    States scale with one modulus, which a film under the layer does not share: there theory stays.
    """
    rough = scenarios.roughness
    if surface.simulated is None or rough.simulated is not None or rough.film_response is not None:
        return scenarios
    simulated = surface.simulate_on(solid)
    if simulated is None:
        return scenarios
    # Waves that the grid lacks are stiffened, too.
    on_half_space = surface.simulated.whole.full_contact_energy
    energy = np.asarray(surface.scenarios.roughness.lacking) * on_half_space
    stiffening = find_stiffening(solid, surface.spectra[1], np.pi / simulated.pixel)
    lacking = stiffening * energy / simulated.whole.full_contact_energy
    return scenarios.with_roughness(simulated=simulated, lacking=lacking)


def _stiffen_unresolved(
    scenarios: Scenarios, surface: Surface, stiffening: NDArray, skin: Skin
) -> Scenarios:
    """Let a skin meet unresolved waves, at least, as it meets the shortest that are resolved."""
    shortest = float(surface.spectra[0].band[1])
    gain = scenarios.between(np.maximum(1 / (skin.factor(shortest) * stiffening), 1.0))
    beyond = surface.rows("beyond_energy")
    longer = surface.rows("longer_energy") if surface.is_larger else 0.0
    change = 1 + beyond / (1 + beyond) / (1 + longer) * (gain - 1)
    rough = scenarios.roughness
    return scenarios.with_roughness(
        elastic_energy=rough.elastic_energy * change,
        relative_compliance=rough.relative_compliance / change,
    )
