"""`judge`: every material on every surface. It is the only place where a pair becomes numbers.

The steps are those of the reasoning: what roughness a material meets on a surface; what remains on
it, with limits over all that the surface may be; what the draws of a measured surface add; what
every criterion says at both ends of what is known of the surface; and the verdict, which follows
from the limits. Results are codes and numbers in SI units.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import product
from typing import Any, NamedTuple

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
from stickiness.formatting import amount, percent
from stickiness.measured.guess import guess_end
from stickiness.remaining.roughness import LEAST_LENGTH
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.solids import HALF_SPACE, Skin
from stickiness.statistics import COVERS
from stickiness.verdicts.curves import (
    FREQUENCIES,
    find_axes,
    find_rate_moduli,
    follow_remaining,
)
from stickiness.verdicts.limits import LIMITS, LOW
from stickiness.verdicts.meeting import Meeting, meet
from stickiness.verdicts.pair_variables import (
    BY_BOUND,
    BY_GAUSSIAN_THEORY,
    BY_SHAPED_THEORY,
    BY_SIMULATION,
    DECIDED_BY,
    DIMENSIONS,
    GIVEN,
    PAIR_VARIABLES,
    PER_PAIR,
)
from stickiness.verdicts.questions import ask, ask_about_end
from stickiness.verdicts.rough_surface import Surface
from stickiness.verdicts.surface_data import ENDS
from stickiness.verdicts.thresholds import (
    CONTACT_AREA,
    LEAST_AREA,
    MOST_AREA,
    find_thresholds,
)
from stickiness.verdicts.wording import describe_material

FURTHEST = 15.0  #: ln of a margin; a threshold further away is an end of the search
MUCH = 0.1  #: of the energy of full contact, in waves that were not measured
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
    axes = find_axes(np.atleast_1d(frequencies))

    wanted = _Wanted(wanted_share, contact_area, axes if curves else None, thresholds)
    cells = [
        _judge_pair(material, surface, wanted)
        for material, surface in product(materials.values(), surfaces.values())
    ]
    dataset = _arrange(cells, materials, surfaces).assign(wanted_share=wanted_share)
    rate_moduli = [find_rate_moduli(each.plane_strain, axes) for each in materials.values()]
    dataset["modulus"] = ("material", "frequency"), rate_moduli
    along = {name: points for name, points in axes.items() if name in dataset.dims}
    return withhold(_describe(dataset.assign_coords(along)))


class _Wanted(NamedTuple):
    """What is asked of every pair."""

    share: float  #: that must remain for it to stick
    contact_area: float
    axes: Mapping[str, NDArray] | None  #: along which the share is followed; None of no curves
    thresholds: bool


def _judge_pair(material: Material, surface: Surface, wanted: _Wanted) -> dict[str, Any]:
    """All numbers of a pair, whatever is true of what its measurement leaves open."""
    others = [(guess, _judge_pair(material, other, wanted)) for guess, other in surface.readings]
    return ask(_judge_reading(material, surface, wanted), others, wanted.share)


def _judge_reading(material: Material, surface: Surface, wanted: _Wanted) -> dict[str, Any]:
    """The same by one answer, with the question where the waves end if that decides."""
    meeting = meet(material, surface, wanted.share)
    cell = judge_meeting(meeting)
    if wanted.axes is not None:
        cell |= follow_remaining(meeting, wanted.axes)
    if wanted.thresholds:
        # Of two rough solids only the rms height of the pair is defined.
        known = surface.rms_height if material.surface is None else None
        for name, found in find_thresholds(meeting, cell, wanted.contact_area, known).items():
            cell[name] = [found.low, found.value, found.high]
    cell["doubts"] = "\n".join(_list_doubts(material, surface, meeting, cell))
    cell["questions"] = ""
    if cell["verdict"] != DEPENDS or surface.as_measured is None:
        return cell
    as_measured = judge_meeting(meet(material, surface.as_measured, wanted.share))
    return ask_about_end(cell, as_measured, guess_end(amount(surface.shortest_resolved, "m")))


def _check_shares(wanted_share: float, contact_area: float) -> None:
    """Raise an error unless both shares are in their range."""
    if not 0 < number("wanted_share", wanted_share) < 1:
        raise ValueError(f"wanted_share must be between 0 and 1, got {wanted_share!r}")
    if not LEAST_AREA <= contact_area <= MOST_AREA:
        limits = f"{LEAST_AREA:g} to {MOST_AREA:g}"
        raise ValueError(f"contact_area must be in {limits}, got {contact_area!r}")


def _name(argument: str, given: Mapping | Sequence, kind: type) -> dict:
    """Materials or surfaces by name, or by number if they come in a sequence."""
    given_type = type(given).__name__
    named = {}
    if isinstance(given, Mapping | Sequence):
        named = dict(given if isinstance(given, Mapping) else enumerate(given))
        kinds = sorted({type(each).__name__ for each in named.values()})
        given_type = f"{given_type} of {', '.join(kinds)}" if kinds else f"empty {given_type}"
    if not named or not all(isinstance(each, kind) for each in named.values()):
        raise ValueError(
            f"{argument} must be a list or a mapping of {kind.__name__}, got: {given_type}"
        )
    return named


def judge_meeting(meeting: Meeting) -> dict[str, Any]:
    """Numbers and codes of one pair; their dimensions are in `DIMENSIONS`."""
    # What has limits: a row for each surface that it may be.
    pair = meeting.pair
    length_threshold = pair.remaining_threshold
    # Where the search for the adhesion length ends, any modulus would do. E* has no threshold
    # where nothing is soft enough.
    holds_always = length_threshold < 1.01 * LEAST_LENGTH * pair.elastic_energy
    thresholds_of_rows = np.where(holds_always, np.inf, pair.work_of_adhesion / length_threshold)
    moduli = meeting.limit(thresholds_of_rows, pair)
    moduli = np.where(moduli < LEAST_MODULUS, 0.0, moduli)
    cell: dict[str, Any] = {
        "remaining": meeting.limit(pair.remaining, pair),
        "pull_off": meeting.limit(pair.pull_off, pair),
        "margin": meeting.limit(pair.adhesion_length / length_threshold, pair),
        "plane_strain_modulus_threshold": moduli,
        "modulus_threshold": moduli * meeting.quoted_ratio,
    }
    cell |= describe_draws(meeting)

    # What is known at both ends, the smooth one and the rough one.
    ends = meeting.ends
    cell |= find_quantities(ends)
    cell |= {
        "plane_strain_modulus": pair.modulus,
        "quoted_modulus": pair.modulus * meeting.quoted_ratio,
        "work_of_adhesion": pair.work_of_adhesion,
        "range": pair.range,
        "instant_ratio": pair.rough.instant_ratio,
        "law": pair.rough.law,
    }

    # What every criterion says there.
    margins = _join_criteria([criterion.margin(ends) for criterion in CRITERIA.values()])
    thresholds = [criterion.modulus_threshold(ends) for criterion in CRITERIA.values()]
    sticky = dict(zip(CRITERIA, margins.T > 1, strict=True))
    cell["margin_by_criterion"] = margins
    cell["threshold_by_criterion"] = _join_criteria(thresholds)
    cell["stiffening"] = meeting.stiffening
    a_v = meeting.a_v
    cell["pair_a_v"] = [a_v.low.min(), a_v.value[-1], a_v.high.max()]

    # The verdict. Beyond the onset at the finest wave contact grows by itself.
    low, _, high = cell["remaining"]
    cell["verdict"] = decide(low, high, sticky[EDGES].any(), pair.wanted_share)
    cell["disagrees"] = [(says != sticky[REMAINING]).any() for says in sticky.values()]
    cell["decided_by"] = _find_decider(meeting)
    cell["not_judged"] = meeting.not_judged
    return cell


def _join_criteria(by_criterion: Sequence[float | NDArray]) -> NDArray:
    """What all criteria say at both ends, ``(end, criterion)``; some say the same at both."""
    return np.transpose([np.broadcast_to(at_ends, len(ENDS)) for at_ends in by_criterion])


def describe_draws(meeting: Meeting) -> dict[str, float]:
    """`DRAW_STATISTICS` of the margins of a pair; NaN of a surface that was not measured."""
    if not meeting.is_drawn:
        return dict.fromkeys(DRAW_STATISTICS, np.nan)
    pair = meeting.pair
    margins = pair.adhesion_length / pair.remaining_threshold
    # Without the error of the model, margins scatter with the spectrum alone.
    exact = pair.deviating(0.0)
    by_spectrum = np.log(exact.adhesion_length / exact.remaining_threshold)
    by_model = np.log(margins) - by_spectrum
    # Of rows without a threshold the ends of the search would count.
    is_found = (np.abs(by_spectrum) < FURTHEST) & (np.abs(by_model) < FURTHEST)
    of_spectrum, of_model = (
        np.std(by_source[is_found]) if is_found.any() else 0.0
        for by_source in (by_spectrum, by_model)
    )
    # On a map, errors of the model contain how its parts differ, and what is not resolved.
    of_map, of_waves = _find_errors_of_map(pair) / COVERS
    sticks = margins > 1
    return {
        "probability": np.mean(sticks),
        "probability_low": np.mean(sticks & pair.withstands),
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
    law = str(pair.rough.law)
    of_map = simulated.find_patch_error(float(pair.range), law, pair.wanted_share)
    length = np.array([np.median(pair.remaining_threshold)])
    lacking = np.array([np.median(pair.rough.lacking)])
    low, high = (
        simulated.find_shift(length, np.array([pair.range]), law, lacking, eta, pair.wanted_share)
        for eta in (-np.ones(1), np.ones(1))
    )
    half_width = (high - low).item() / 2
    return np.array([of_map, np.sqrt(max(half_width**2 - of_map**2, 0.0))])


def _find_decider(meeting: Meeting) -> int:
    """Code of what decides the verdict on a pair, its place in `DECIDED_BY`."""
    if not meeting.is_drawn:
        return BY_GAUSSIAN_THEORY
    pair = meeting.pair
    if pair.rough.simulated is None:
        return BY_SHAPED_THEORY
    # Is enough left in contact without adhesion already, by its low limit?
    states = pair.rough.simulated.without_adhesion()
    pressed = replace(pair, rough=replace(pair.rough, simulated=states))
    is_enough = meeting.limit(pressed.remaining, pair)[LOW] >= pair.wanted_share
    return BY_BOUND if is_enough else BY_SIMULATION


def _list_doubts(
    material: Material, surface: Surface, meeting: Meeting, cell: Mapping[str, Any]
) -> Iterator[str]:
    """Sentences about a pair: why it is not judged, improbable values, remarks on the data."""
    reasons = cell["not_judged"].splitlines()
    yield from reasons
    yield from find_pair_doubts(material, surface)
    yield from (remark for remark in surface.remarks if remark not in reasons)
    unresolved = float(np.median(meeting.pair.rough.unresolved))
    if isinstance(meeting.solid, Skin) and cell["verdict"] == DEPENDS and unresolved > MUCH:
        is_told = surface.draw_count and surface.data.q1 > surface.data.q_cutoff * (1 + 1e-9)
        cure = "" if is_told else ", or the end of the waves (extend_to),"
        yield (
            "the skin is stiff to waves finer than those measured, which are thought to hold "
            f"{percent(unresolved)} of the energy of full contact with it: these decide, and a "
            f"finer measurement{cure} would narrow the limits"
        )
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
        "material_label": material.label,
        "material_doubts": "\n".join(material.doubts),
        "properties": describe_material(material),
        "work_on_smooth": material.work_on_smooth,
        "half_space": material.solid == HALF_SPACE and material.surface is None,
        "poisson_ratio": np.nan if material.is_plane_strain else material.poisson_ratio,
        "dwell": material.dwell or np.nan,
        "depends_on_rate": material.depends_on_rate,
    }


def _list_lengths(surface: Surface) -> dict[str, float]:
    """Lengths of a surface [m]."""
    return {
        "rms_height": surface.rms_height,
        "scan": surface.scan,
        "contact": surface.contact,
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
    dataset.regime.attrs |= datasets.flags(REGIMES)
    dataset.decided_by.attrs |= datasets.flags(DECIDED_BY)
    return dataset


def withhold(dataset: xr.Dataset) -> xr.Dataset:
    """The dataset without numbers of pairs that are not judged, and with that as their verdict."""
    judged = dataset.not_judged == ""
    if judged.all():
        return dataset
    withheld = {}
    with xr.set_options(keep_attrs=True):
        for name, numbers in dataset.items():
            is_found = numbers.dtype.kind == "f" and name not in GIVEN
            if is_found and set(PER_PAIR) <= set(numbers.dims):
                reasons = filter(None, (numbers.attrs.get("nan_means"), "not judged"))
                withheld[name] = numbers.where(judged).transpose(*numbers.dims)
                withheld[name].attrs["nan_means"] = ", or ".join(dict.fromkeys(reasons))
        withheld["verdict"] = dataset.verdict.where(judged, NOT_JUDGED).astype("i1")
        withheld["disagrees"] = dataset.disagrees.where(judged, 0).astype("i1")
    return dataset.assign(withheld)
