"""`judge`: every material on every surface. It is the only place where a pair becomes numbers.

The steps are those of the reasoning: what roughness a material meets on a surface; what remains on
it, with limits over all that the surface may be; what the draws of a measured surface add; what
every criterion says at both ends of what is known of the surface; and the verdict, which follows
from the limits. Results are codes and numbers in SI units.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from stickiness import datasets
from stickiness.arguments import number
from stickiness.criteria.pair import (
    DEPENDS,
    MOST_STRAIN,
    NOT_JUDGED,
    REGIMES,
    WORDS,
    Pair,
    decide,
    find_quantities,
)
from stickiness.criteria.registry import CRITERIA, EDGES, REMAINING
from stickiness.entries.material import Material
from stickiness.limited import Limited
from stickiness.remaining.roughness import LEAST_LENGTH
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.solids import HALF_SPACE
from stickiness.statistics import COVERS
from stickiness.verdicts.curves import (
    FREQUENCIES,
    find_axes,
    find_rate_moduli,
    follow_remaining,
)
from stickiness.verdicts.limits import HIGH, LIMITS, LOW, VALUE
from stickiness.verdicts.pair_roughness import PairRoughness, combine_roughness
from stickiness.verdicts.pair_variables import (
    BY_BOUND,
    BY_GAUSSIAN_THEORY,
    BY_SHAPED_THEORY,
    BY_SIMULATION,
    DECIDED_BY,
    DIMENSIONS,
    LARGER,
    PAIR_VARIABLES,
    PER_PAIR,
)
from stickiness.verdicts.parametric import ENDS
from stickiness.verdicts.rough_surface import Surface
from stickiness.verdicts.scenarios import Scenarios
from stickiness.verdicts.thresholds import (
    CONTACT_AREA,
    LEAST_AREA,
    MOST_AREA,
    find_thresholds,
)
from stickiness.verdicts.wording import describe_material

LEAST_MODULUS = 1e-3  #: [Pa]; a threshold below is none: nothing is softer
#: What is known of the draws of a measured surface alone.
DRAW_STATISTICS = (
    "probability",
    "probability_low",
    "error_of_spectrum",
    "error_of_map",
    "error_of_model",
)


def judge(
    materials: Mapping[str, Material] | Sequence[Material],
    surfaces: Mapping[str, Surface] | Sequence[Surface],
    *,
    frequencies: ArrayLike = FREQUENCIES,
    wanted_share: float = DEFAULT_SHARE,
    contact_area: float = CONTACT_AREA,
    curves: bool = True,
    thresholds: bool = True,
) -> xr.Dataset:
    """Judge every material on every surface.

    Parameters
    ----------
    materials, surfaces : mapping or sequence
        `Material` and `Surface` by name; those of a sequence are numbered from 0.
    frequencies : (n,) array
        Frequencies of loading [Hz], for the curve of what remains against the rate.
    wanted_share : float
        Share of the work of adhesion that must remain for a pair to stick, between 0 and 1.
    contact_area : float
        Share of the nominal area, 0.005 to 0.35, for the pressure that brings it into contact.
    curves : bool
        Whether to follow what remains along the modulus, the heights, the rate and the dwell.
    thresholds : bool
        Whether to find the rms height, thickness and rate at which a pair begins to stick, and the
        pressure. The threshold of the modulus is always found.

    Returns
    -------
    Dataset
        Over `material` and `surface`. Numbers with limits have the dimension `limit`: low, value,
        high. What the criteria say is known at the smooth and the rough `end` of what is known of
        the surface. `verdict` has codes, the places in `criteria.pair.WORDS`. Every variable has
        its unit and description. Numbers of pairs that are not judged are NaN; `not_judged` says
        why.

    Raises
    ------
    ValueError
        If there is no material or surface, or a share is out of range.

    See Also
    --------
    stickiness.verdict : one pair

    Examples
    --------
    >>> from stickiness.spectrum import SelfAffine
    >>> wall = Surface.from_spectrum(SelfAffine(hurst=0.8, q0=6e4, q1=6e8, h_rms=1e-6))
    >>> adhesion = {"work_of_adhesion": 0.06, "range": 3e-10}
    >>> soft = Material(youngs_modulus=2e5, **adhesion)
    >>> stiff = Material(youngs_modulus=2e9, **adhesion)
    >>> verdicts = judge({"soft": soft, "stiff": stiff}, {"wall": wall})
    >>> [WORDS[code] for code in verdicts.verdict.sel(surface="wall").values]
    ['sticks fully', 'does not stick']
    """
    _check_shares(wanted_share, contact_area)
    materials = _name("materials", materials, Material)
    surfaces = _name("surfaces", surfaces, Surface)
    axes = find_axes(materials.values(), np.atleast_1d(frequencies))
    cells = []
    for material in materials.values():
        for surface in surfaces.values():
            rough = combine_roughness(material, surface)
            pair = rough.meet(material, wanted_share)
            cell = _judge_pair(rough, pair, material)
            if curves:
                cell |= follow_remaining(pair, rough, material, axes)
            if thresholds:
                moduli = Limited(*cell["plane_strain_modulus_threshold"][[VALUE, LOW, HIGH]])
                # Of two rough solids only the rms height of the pair is defined.
                known = surface.rms_height if material.surface is None else None
                of_pair = find_thresholds(material, rough, pair, moduli, contact_area, known)
                for name, threshold in of_pair.items():
                    cell[name] = [threshold.low, threshold.value, threshold.high]
            cell |= _judge_larger(material, surface, wanted_share)
            cell["doubts"] = "\n".join(_list_doubts(material, surface, cell))
            cells.append(cell)
    dataset = _arrange(cells, materials, surfaces).assign(wanted_share=wanted_share)
    rate_moduli = [find_rate_moduli(material, axes) for material in materials.values()]
    dataset["modulus"] = ("material", "frequency"), rate_moduli
    along = {name: points for name, points in axes.items() if name in dataset.dims}
    return _withhold(_describe(dataset.assign_coords(along)))


def _check_shares(wanted_share: float, contact_area: float) -> None:
    """Raise an error unless both shares are in their range."""
    if not 0 < number("wanted_share", wanted_share) < 1:
        raise ValueError(f"wanted_share must be between 0 and 1, got {wanted_share!r}")
    if not LEAST_AREA <= contact_area <= MOST_AREA:
        limits = f"{LEAST_AREA:g} to {MOST_AREA:g}"
        raise ValueError(f"contact_area must be in {limits}, got {contact_area!r}")


def _name(argument: str, given: Mapping | Sequence, kind: type) -> dict:
    """Materials or surfaces by name, or by number if they come in a sequence."""
    named = {}
    if isinstance(given, Mapping | Sequence):
        named = dict(given if isinstance(given, Mapping) else enumerate(given))
    if not named or not all(isinstance(each, kind) for each in named.values()):
        raise ValueError(
            f"{argument} must be a list or a mapping of {kind.__name__}, got {given!r}"
        )
    return named


def _judge_pair(rough: PairRoughness, pair: Pair, material: Material) -> dict[str, Any]:
    """Numbers and codes of one pair; their dimensions are in `DIMENSIONS`."""
    # What has limits: a row for each surface that it may be, both ends first and then the draws.
    length_threshold = pair.remaining_threshold
    # Where the search for the adhesion length ends, any modulus would do. E* has no threshold
    # where nothing is soft enough.
    holds_always = length_threshold < 1.01 * LEAST_LENGTH * pair.elastic_energy
    thresholds_of_rows = np.where(holds_always, np.inf, pair.work_of_adhesion / length_threshold)
    moduli = rough.limit(thresholds_of_rows, pair)
    moduli = np.where(moduli < LEAST_MODULUS, 0.0, moduli)
    cell: dict[str, Any] = {
        "remaining": rough.limit(pair.remaining, pair),
        "pull_off": rough.limit(pair.pull_off, pair),
        "margin": rough.limit(pair.adhesion_length / length_threshold, pair),
        "plane_strain_modulus_threshold": moduli,
    }
    cell |= describe_draws(rough.scenarios, pair)

    # What is known at both ends, the smooth one and the rough one.
    ends = rough.take_ends(pair)
    cell |= find_quantities(ends)
    cell["modulus_threshold"] = moduli * material.quoted_modulus / material.plane_strain_modulus

    # What every criterion says there.
    margins = _join_criteria([criterion.margin(ends) for criterion in CRITERIA.values()])
    thresholds = [criterion.modulus_threshold(ends) for criterion in CRITERIA.values()]
    sticky = dict(zip(CRITERIA, margins.T > 1, strict=True))
    cell["margin_by_criterion"] = margins
    cell["threshold_by_criterion"] = _join_criteria(thresholds)
    cell["stiffening"] = rough.stiffening
    cell["pair_a_v"] = [rough.a_v.low.min(), rough.a_v.value[-1], rough.a_v.high.max()]

    # The verdict. Beyond the onset at the finest wave contact grows by itself.
    low, _, high = cell["remaining"]
    cell["verdict"] = decide(low, high, sticky[EDGES].any(), pair.wanted_share)
    cell["disagrees"] = [(says != sticky[REMAINING]).any() for says in sticky.values()]
    cell["decided_by"] = _find_decider(rough, pair)
    cell["not_judged"] = rough.not_judged
    return cell


def _join_criteria(by_criterion: Sequence[float | NDArray]) -> NDArray:
    """What all criteria say at both ends, ``(end, criterion)``; some say the same at both."""
    return np.transpose([np.broadcast_to(at_ends, len(ENDS)) for at_ends in by_criterion])


def describe_draws(scenarios: Scenarios, pair: Pair) -> dict[str, float]:
    """`DRAW_STATISTICS` of the margins of a pair; NaN of a surface that was not measured."""
    if not scenarios.is_drawn:
        return dict.fromkeys(DRAW_STATISTICS, np.nan)
    margins = pair.adhesion_length / pair.remaining_threshold
    # Without the error of the model, margins scatter with the spectrum alone.
    exact = replace(pair, deviation=0.0)
    by_spectrum = np.log(exact.adhesion_length / exact.remaining_threshold)
    by_model = np.log(margins) - by_spectrum
    weights = scenarios.weights
    of_spectrum, of_model = (
        np.sqrt(np.cov(by_source, aweights=weights, ddof=0))
        for by_source in (by_spectrum, by_model)
    )
    # On a map, errors of the model contain how its parts differ, and what is not resolved.
    of_map, of_waves = _find_errors_of_map(pair) / COVERS
    sticks = margins > 1
    return {
        "probability": np.average(sticks, weights=weights),
        "probability_low": np.average(sticks & pair.withstands, weights=weights),
        "error_of_spectrum": np.hypot(of_spectrum, of_waves),
        "error_of_map": of_map,
        "error_of_model": np.sqrt(np.maximum(of_model**2 - of_map**2 - of_waves**2, 0.0)),
    }


def _find_errors_of_map(pair: Pair) -> NDArray:
    """Errors of ln of the work of adhesion by the parts of a map and by unresolved waves, ``(2,)``.

    They cover 90 %, at the threshold of the pair; 0 where no contact was simulated.
    """
    simulated = pair.rough.simulated
    if simulated is None:
        return np.zeros(2)
    of_map = simulated.find_patch_error(float(pair.range), pair.rough.law)
    length = np.array([np.median(pair.remaining_threshold)])
    lacking = np.array([np.median(pair.rough.lacking)])
    low, high = (
        simulated.find_shift(length, np.array([pair.range]), pair.rough.law, lacking, deviation)
        for deviation in (-np.ones(1), np.ones(1))
    )
    half_width = (high - low).item() / 2
    return np.array([of_map, np.sqrt(max(half_width**2 - of_map**2, 0.0))])


def _find_decider(rough: PairRoughness, pair: Pair) -> int:
    """Code of what decides the verdict on a pair, its place in `DECIDED_BY`."""
    if not rough.scenarios.is_drawn:
        return BY_GAUSSIAN_THEORY
    simulated = pair.rough.simulated
    if simulated is None:
        return BY_SHAPED_THEORY
    # Is enough left in contact without adhesion already, by its low limit?
    pressed = replace(pair, rough=replace(pair.rough, simulated=simulated.without_adhesion()))
    is_enough = rough.limit(pressed.remaining, pair)[LOW] >= pair.wanted_share
    return BY_BOUND if is_enough else BY_SIMULATION


def _judge_larger(material: Material, surface: Surface, wanted_share: float) -> dict[str, Any]:
    """Verdict, and `LARGER` with limits, of a contact that is larger than a scan.

    "not judged" and NaN where longer waves are not expected, or not known.
    """
    larger = surface.larger
    if larger is None:
        unknown = dict.fromkeys((f"larger_{name}" for name in LARGER), np.full(3, np.nan))
        return unknown | {"larger_verdict": NOT_JUDGED}
    # A material that is rough itself meets the same contact.
    material = material.on_contact(larger.contact)
    rough = combine_roughness(material, larger)
    cell = _judge_pair(rough, rough.meet(material, wanted_share), material)
    if rough.not_judged:
        cell |= dict.fromkeys(LARGER, np.full(3, np.nan)) | {"verdict": NOT_JUDGED}
    return {f"larger_{name}": cell[name] for name in ("verdict", *LARGER)}


def _list_doubts(material: Material, surface: Surface, cell: Mapping[str, Any]) -> Iterator[str]:
    """Sentences about a pair: why it is not judged, improbable values, remarks on the data."""
    reasons = cell["not_judged"].splitlines()
    yield from reasons
    yield from find_pair_doubts(material, surface)
    remarks = list(surface.remarks)
    if surface.larger is not None and cell["larger_verdict"] == DEPENDS:
        remarks += [remark for remark in surface.larger.remarks if remark not in remarks]
    yield from (remark for remark in remarks if remark not in reasons)
    strain = float(np.max(cell["layer_strain"]))
    if strain > MOST_STRAIN:
        yield (
            f"to conform, the layer would have to strain by about {strain:.2g}, beyond linear "
            "elasticity: all adhesion may be lost"
        )


def find_pair_doubts(material: Material, surface: Surface) -> tuple[str, ...]:
    """Sentences about values of a material and of both rough solids that hardly any pair has."""
    rough = [each.doubts for each in (surface, material.surface) if each is not None]
    return (*material.doubts, *(doubt for doubts in rough for doubt in doubts))


def _arrange(
    cells: list[dict[str, Any]], materials: Mapping[str, Material], surfaces: Mapping[str, Surface]
) -> xr.Dataset:
    """Dataset of all cells, those of a material one after the other."""
    shape = (len(materials), len(surfaces))
    dataset = xr.Dataset(
        coords={
            "material": list(materials),
            "surface": list(surfaces),
            "limit": list(LIMITS),
            "end": list(ENDS),
            "criterion": list(CRITERIA),
        }
    )
    for name in cells[0]:
        of_pairs = _as_array([cell[name] for cell in cells])
        dimensions = (*PER_PAIR, *DIMENSIONS.get(name, ()))
        dataset[name] = dimensions, of_pairs.reshape(*shape, *of_pairs.shape[1:])
    properties = {
        "material": [_list_properties(material) for material in materials.values()],
        "surface": [_list_lengths(surface) for surface in surfaces.values()],
    }
    for dimension, columns in properties.items():
        for name in columns[0]:
            dataset[name] = dimension, _as_array([column[name] for column in columns])
    return dataset


def _list_properties(material: Material) -> dict[str, Any]:
    """Properties of a material, as it is judged."""
    return {
        "work_of_adhesion": material.work_of_adhesion,
        "material_label": material.label,
        "material_doubts": "\n".join(material.doubts),
        "properties": describe_material(material),
        "law": material.law,
        "range": material.range,
        "work_on_smooth": material.work_on_smooth,
        "half_space": material.solid == HALF_SPACE and material.surface is None,
        "quoted_modulus": material.quoted_modulus,
        "plane_strain_modulus": material.plane_strain_modulus,
        "poisson_ratio": np.nan if material.is_plane_strain else material.poisson_ratio,
        "dwell": material.dwell or np.nan,
        "instant_ratio": material.instant_ratio,
        "depends_on_rate": material.depends_on_rate,
    }


def _list_lengths(surface: Surface) -> dict[str, float]:
    """Lengths of a surface [m]."""
    return {
        "rms_height": surface.rms_height,
        "scan": surface.scan,
        "contact": surface.contact,
        "larger_contact": surface.larger.contact if surface.larger else np.nan,
    }


def _as_array(column: list[Any]) -> NDArray:
    """Array of numbers, codes or texts, of the types that files have."""
    array = np.array(column)
    return array.astype({"i": "i1", "b": "i1", "U": "O"}.get(array.dtype.kind, array.dtype))


def _describe(dataset: xr.Dataset) -> xr.Dataset:
    """Give every variable its unit, its description, and what a missing value means."""
    present = {name: PAIR_VARIABLES[name] for name in PAIR_VARIABLES if name in dataset.variables}
    dataset = datasets.annotate(dataset, **present)
    dataset.verdict.attrs |= datasets.flags(WORDS)
    dataset.larger_verdict.attrs |= datasets.flags(WORDS)
    dataset.regime.attrs |= datasets.flags(REGIMES)
    dataset.decided_by.attrs |= datasets.flags(DECIDED_BY)
    return dataset


def _withhold(dataset: xr.Dataset) -> xr.Dataset:
    """The dataset without numbers of pairs that are not judged, and with that as their verdict."""
    judged = dataset.not_judged == ""
    if judged.all():
        return dataset
    withheld = {}
    with xr.set_options(keep_attrs=True):
        for name, numbers in dataset.items():
            if numbers.dtype.kind == "f" and set(PER_PAIR) <= set(numbers.dims):
                reasons = filter(None, (numbers.attrs.get("nan_means"), "not judged"))
                withheld[name] = numbers.where(judged).transpose(*numbers.dims)
                withheld[name].attrs["nan_means"] = ", or ".join(dict.fromkeys(reasons))
        withheld["verdict"] = dataset.verdict.where(judged, NOT_JUDGED).astype("i1")
        withheld["disagrees"] = dataset.disagrees.where(judged, 0).astype("i1")
    return dataset.assign(withheld)
