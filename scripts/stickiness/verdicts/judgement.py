"""`judge`: every material on every surface. It is the only place where a pair becomes numbers.

The steps are those of the reasoning: what roughness a material meets on a surface; what every
criterion says at both ends of what is known of the surface; what the draws of a measured surface
add; and the limits, from which the verdict follows. Results are codes and numbers in SI units.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from stickiness import datasets
from stickiness.arguments import number
from stickiness.criteria.pair import (
    LIMITED,
    NOT_JUDGED,
    QUANTITIES,
    REGIMES,
    SIGNS,
    WORDS,
    Pair,
    decide,
    find_quantities,
    make_pair,
)
from stickiness.criteria.registry import CRITERIA, EDGES, REMAINING
from stickiness.remaining.prediction import DEFAULT_SHARE, Roughness
from stickiness.solids.moduli import REFERENCE_FREQUENCY
from stickiness.verdicts.curves import AXES, PAIR_DIMENSIONS, follow_remaining
from stickiness.verdicts.draws import (
    DRAW_STATISTICS,
    DRAWN,
    QUANTILES,
    find_share_quantiles,
    judge_draws,
)
from stickiness.verdicts.limits import find_limits, find_value
from stickiness.verdicts.material import Material
from stickiness.verdicts.pair_roughness import PairRoughness, combine_roughness
from stickiness.verdicts.parametric import ENDS
from stickiness.verdicts.rough_surface import Surface
from stickiness.verdicts.thresholds import (
    CONTACT_AREA,
    LEAST_AREA,
    MOST_AREA,
    THRESHOLDS,
    find_thresholds,
)

#: What decides a verdict, by code: theory of the spectrum, alone or with the skewness of the
#: heights, or contact simulated on the heights.
DECIDED_BY = (
    "theory for Gaussian heights",
    "theory for the spectrum and the skewness of the heights",
    "simulated contact without adhesion, a low bound",
    "simulated contact with adhesion",
)
BY_GAUSSIAN_THEORY, BY_SHAPED_THEORY, BY_BOUND, BY_SIMULATION = range(4)
LARGER = ("remaining", "modulus_threshold")  #: judged for a larger contact, too, with limits
PER_PAIR = PAIR_DIMENSIONS[:2]  #: dimensions of what has one value for every pair


def judge(
    materials: Mapping[str, Material] | Sequence[Material],
    surfaces: Mapping[str, Surface] | Sequence[Surface],
    *,
    frequencies: ArrayLike = (REFERENCE_FREQUENCY,),
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
        Over `material`, `surface` and, for what differs between them, the smooth and rough `end` of
        what is known of the surface. `verdict` has codes, the places in `criteria.pair.WORDS`.
        Every variable has its unit and description. `verdicts.limits` has the value and the limits
        that decide. Numbers of pairs that are not
        judged are NaN; `not_judged` says why.

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
    >>> properties = {"poisson": 0.5, "work_of_adhesion": 0.06, "range": 3e-10}
    >>> soft = Material(modulus=2e5, **properties)
    >>> stiff = Material(modulus=2e9, **properties)
    >>> verdicts = judge({"soft": soft, "stiff": stiff}, {"wall": wall})
    >>> [WORDS[code] for code in verdicts.verdict.sel(surface="wall").values]
    ['sticks fully', 'does not stick']
    """
    _check_shares(wanted_share, contact_area)
    materials = _name("materials", materials, Material)
    surfaces = _name("surfaces", surfaces, Surface)
    roughness = [
        [combine_roughness(material, surface) for surface in surfaces.values()]
        for material in materials.values()
    ]
    dataset = _judge_pairs(
        list(materials.values()), roughness, np.atleast_1d(frequencies), wanted_share, curves
    )
    dataset = dataset.assign_coords(material=list(materials), surface=list(surfaces))
    reasons = [[rough.not_judged for rough in row] for row in roughness]
    dataset["not_judged"] = PER_PAIR, np.array(reasons, "O")
    dataset["verdict"] = decide_pairs(dataset, wanted_share)
    dataset["disagrees"] = _find_disagreement(dataset)
    dataset["decided_by"] = PER_PAIR, _find_deciders(materials, roughness, wanted_share)
    if thresholds:
        dataset = dataset.assign(
            _find_thresholds(materials, roughness, dataset, contact_area, wanted_share)
        )
    dataset = dataset.assign(_judge_larger(materials, surfaces, wanted_share))
    return _withhold(_describe(dataset))


def _check_shares(wanted_share: float, contact_area: float) -> None:
    """Raise an error unless both shares are in their range."""
    if not 0 < number("wanted_share", wanted_share) < 1:
        raise ValueError(f"wanted_share must be between 0 and 1, got {wanted_share!r}")
    if not LEAST_AREA <= contact_area <= MOST_AREA:
        limits = f"{LEAST_AREA:g} to {MOST_AREA:g}"
        raise ValueError(f"contact_area must be in {limits}, got {contact_area!r}")


def _name(argument: str, items: Mapping | Sequence, kind: type) -> dict:
    """Materials or surfaces by name, or by number if they come in a sequence."""
    named = {}
    if isinstance(items, Mapping | Sequence):
        named = dict(items if isinstance(items, Mapping) else enumerate(items))
    if not named or not all(isinstance(item, kind) for item in named.values()):
        raise ValueError(
            f"{argument} must be a list or a mapping of {kind.__name__}, got {items!r}"
        )
    return named


def _judge_pairs(
    materials: list[Material],
    roughness: list[list[PairRoughness]],
    frequencies: NDArray,
    wanted_share: float,
    curves: bool,
) -> xr.Dataset:
    """Numbers of every pair, before any is decided; `roughness` has a row for every material."""
    pair = _stack_ends(materials, roughness, wanted_share)
    draws = [
        [rough.meet_draws(material, wanted_share) for rough in row]
        for material, row in zip(materials, roughness, strict=True)
    ]
    rate_moduli = np.array(
        [np.atleast_1d(material.plane_strain.storage(frequencies)) for material in materials]
    )
    quantities = find_quantities(pair)
    dataset = xr.Dataset({name: (PAIR_DIMENSIONS, quantities[name]) for name in quantities})
    dataset = dataset.assign(_judge_all_draws(draws))
    if curves:
        dataset = dataset.assign(follow_remaining(pair, materials, draws, rate_moduli))

    # What the criteria say.
    by_criterion = (*PAIR_DIMENSIONS, "criterion")
    margins = [criterion.margin(pair) for criterion in CRITERIA.values()]
    moduli = [criterion.modulus_threshold(pair) for criterion in CRITERIA.values()]
    dataset["margin"] = by_criterion, np.stack(margins, axis=-1)
    dataset["threshold_by_criterion"] = by_criterion, np.stack(moduli, axis=-1)

    # What depends on the surface beside the criteria.
    dataset["pair_a_v_low"] = (
        PAIR_DIMENSIONS,
        np.array([[rough.a_v.low for rough in row] for row in roughness]),
    )
    dataset["pair_a_v_high"] = (
        PAIR_DIMENSIONS,
        np.array([[rough.a_v.high for rough in row] for row in roughness]),
    )
    dataset["stiffening"] = (
        PAIR_DIMENSIONS,
        np.array([[rough.stiffening for rough in row] for row in roughness]),
    )

    # Properties of the materials, as they are judged.
    by_material = {
        "work_of_adhesion": [material.work_of_adhesion for material in materials],
        "modulus_quoted": [material.plane_strain_modulus for material in materials],
        "dwell": [np.nan if material.dwell is None else material.dwell for material in materials],
        "broken_at": [material.broken_at for material in materials],
        "instant_ratio": [material.instant_ratio for material in materials],
        "depends_on_rate": [int(material.depends_on_rate) for material in materials],
    }
    dataset = dataset.assign({name: ("material", by_material[name]) for name in by_material})
    dataset["modulus"] = ("material", "frequency"), rate_moduli
    return dataset.assign_coords(
        end=list(ENDS),
        criterion=list(CRITERIA),
        quantile=list(QUANTILES),
        frequency=frequencies,
    )


def _stack_ends(
    materials: list[Material], roughness: list[list[PairRoughness]], wanted_share: float
) -> Pair:
    """`Pair` of every material with both ends of every surface, ``(material, surface, end)``."""

    def of_ends(name: str) -> NDArray:
        return np.array([[getattr(rough.ends, name) for rough in row] for row in roughness])

    def of_materials(values: list) -> NDArray:
        columns = np.array(values)[:, None, None]
        return np.broadcast_to(columns, (len(materials), len(roughness[0]), len(ENDS)))

    h_rms = of_ends("h_rms")
    q0 = of_ends("q0")
    rough = Roughness(
        h_rms=h_rms,
        q0=q0,
        q1=of_ends("q1"),
        elastic_energy=of_ends("elastic_energy"),
        relative_compliance=of_ends("relative_compliance"),
        flow=of_ends("flow"),
        half_space_energy=of_ends("half_space_energy"),
        is_skin=of_ends("is_skin"),
        anisotropy_error_factor=of_ends("anisotropy_error_factor"),
        waves=of_ends("waves"),
        rms_slope=of_ends("rms_slope"),
        law=of_materials([material.law for material in materials]),
        film_response=of_ends("film_response"),
        shape=of_ends("shape"),
        shape_error=of_ends("shape_error"),
        simulated=of_ends("simulated"),
        lacking=of_ends("lacking"),
        instant_ratio=of_materials([material.instant_ratio for material in materials]),
    )
    strain = [material.solid.strain(h_rms[i], q0[i]) for i, material in enumerate(materials)]
    return make_pair(
        rough,
        modulus=of_materials([material.plane_strain_modulus for material in materials]),
        work_of_adhesion=of_materials([material.work_of_adhesion for material in materials]),
        range=of_materials([material.range for material in materials]),
        pressed=of_materials([material.pressed for material in materials]),
        rms_curvature=np.array([[rough.rms_curvature for rough in row] for row in roughness]),
        a_v=np.array([[rough.a_v.value for rough in row] for row in roughness]),
        wanted_share=wanted_share,
        layer_strain=np.array(strain),
    )


def _judge_all_draws(draws: list[list[Pair | None]]) -> dict[str, tuple]:
    """Distributions over the draws of measured surfaces; NaN on others."""
    judged = [[judge_draws(pair) for pair in row] for row in draws]

    def collect(name: str) -> list[list]:
        return [[distributions[name] for distributions in row] for row in judged]

    statistics = {name: (PER_PAIR, collect(name)) for name in DRAW_STATISTICS}
    quantiles = {
        f"{name}_quantile": ((*PER_PAIR, "quantile"), collect(f"{name}_quantile")) for name in DRAWN
    }
    return statistics | quantiles


def decide_pairs(dataset: xr.Dataset, wanted_share: float) -> xr.DataArray:
    """Codes of the verdicts over the whole range of the surface and the limits of the model."""
    low, high = find_limits(dataset)
    # Beyond the onset at the finest wave contact grows by itself.
    grows = (dataset.margin.sel(criterion=EDGES, drop=True) > 1).any("end")
    return low.copy(data=decide(low, high, grows, wanted_share))


def _find_deciders(
    materials: Mapping[str, Material], roughness: list[list[PairRoughness]], wanted_share: float
) -> NDArray:
    """Codes of what decides the verdicts, their places in `DECIDED_BY`; `roughness` as before."""
    codes = [
        [_find_decider(rough, rough.meet_draws(material, wanted_share)) for rough in row]
        for material, row in zip(materials.values(), roughness, strict=True)
    ]
    return np.array(codes, "i1")


def _find_decider(rough: PairRoughness, draws: Pair | None) -> int:
    """Code of what decides the verdict on one pair."""
    if draws is None:
        return BY_GAUSSIAN_THEORY
    simulated = rough.ends.simulated[0]
    if simulated is None:
        return BY_SHAPED_THEORY
    # Enough may remain without what attraction does to the contact.
    pressed = replace(draws, simulated=np.full(draws.lacking.shape, simulated.without_adhesion()))
    is_enough = find_share_quantiles(pressed)[0] >= draws.wanted_share
    return BY_BOUND if is_enough else BY_SIMULATION


def _find_disagreement(dataset: xr.Dataset) -> xr.DataArray:
    """Whether a criterion says the opposite of the verdict."""
    sticky = dataset.margin > 1
    differs = (sticky != sticky.sel(criterion=REMAINING)).any("end")
    return differs.astype("i1")


def _find_thresholds(
    materials: Mapping[str, Material],
    roughness: list[list[PairRoughness]],
    dataset: xr.Dataset,
    contact_area: float,
    wanted_share: float,
) -> dict[str, tuple]:
    """Every one of `THRESHOLDS` with its limits."""
    thresholds = [
        [
            find_thresholds(
                material,
                rough,
                cell=dataset.isel(material=row, surface=column),
                contact_area=contact_area,
                wanted_share=wanted_share,
            )
            for column, rough in enumerate(roughness[row])
        ]
        for row, material in enumerate(materials.values())
    ]
    parts = {"": "value", "_low": "low", "_high": "high"}
    return {
        f"{name}{ending}": (
            PER_PAIR,
            [[getattr(threshold[name], part) for threshold in row] for row in thresholds],
        )
        for name in THRESHOLDS
        for ending, part in parts.items()
    }


def _judge_larger(
    materials: Mapping[str, Material], surfaces: Mapping[str, Surface], wanted_share: float
) -> xr.Dataset:
    """Verdict, and `LARGER` with limits, where the contact is larger than a scan.

    "not judged" and NaN where no longer waves may follow, or nothing is known of them.
    """
    larger = {name: surface.larger for name, surface in surfaces.items() if surface.larger}
    of_surfaces = {"surface": list(surfaces)}
    contact = [surface.contact for surface in surfaces.values()]
    larger_contact = [larger[x].contact if x in larger else np.nan for x in surfaces]
    dataset = xr.Dataset(
        {"contact": ("surface", contact), "larger_contact": ("surface", larger_contact)},
        coords=of_surfaces,
    )
    names = [f"larger_{name}{ending}" for name in LARGER for ending in SIGNS]
    if not larger:
        coords = {"material": list(materials), **of_surfaces}
        unknown = xr.DataArray(np.nan, dims=PER_PAIR, coords=coords)
        verdict = xr.full_like(unknown, NOT_JUDGED, dtype="i1")
        return dataset.assign(dict.fromkeys(names, unknown) | {"larger_verdict": verdict})
    # A material that is rough itself meets the same contact.
    judged = xr.concat(
        [
            judge(
                {key: material.on_contact(surface.contact) for key, material in materials.items()},
                {name: surface},
                wanted_share=wanted_share,
                curves=False,
                thresholds=False,
            )
            for name, surface in larger.items()
        ],
        dim="surface",
        data_vars="minimal",
    )
    limited = {"larger_verdict": judged.verdict}
    for name in LARGER:
        low, high = find_limits(judged, name)
        numbers = (find_value(judged, name), low, high)
        for ending, values in zip(SIGNS, numbers, strict=True):
            limited[f"larger_{name}{ending}"] = values
    verdicts = xr.Dataset(limited).reset_coords(drop=True)
    return dataset.merge(verdicts.reindex(of_surfaces, fill_value={"larger_verdict": NOT_JUDGED}))


def _describe(dataset: xr.Dataset) -> xr.Dataset:
    """Give every variable its unit, its description, and what a missing value means."""
    texts = {name: text for name, text in _list_texts().items() if name in dataset.variables}
    dataset = datasets.annotate(dataset, **texts)
    dataset.verdict.attrs |= datasets.flags(WORDS)
    dataset.larger_verdict.attrs |= datasets.flags(WORDS)
    dataset.regime.attrs |= datasets.flags(REGIMES)
    dataset.decided_by.attrs |= datasets.flags(DECIDED_BY)
    return dataset


def _list_texts() -> dict[str, tuple[str, ...]]:
    """Unit, description and, where a value may be missing, what that means, of every variable."""
    remains = LIMITED["remaining"][1]
    unmeasured = "not measured"
    no_longer = "no waves longer than the scan are expected or known"
    texts: dict[str, tuple[str, ...]] = {
        **QUANTITIES,
        "material": ("1", "material"),
        "surface": ("1", "real surface"),
        "end": ("1", "smooth or rough end of what is known of the surface"),
        "criterion": ("1", "stickiness criterion"),
        "quantile": ("1", "quantile of the draws"),
        "frequency": ("Hz", "frequency of loading"),
        "modulus_factor": ("1", "factor on the plane-strain modulus"),
        "roughness_factor": ("1", "factor on the heights, at unchanged shape of the spectrum"),
        "dwell_factor": ("1", "factor on the dwell"),
        "probability": ("1", "share of draws that stick", unmeasured),
        "probability_low": ("1", "share of draws that stick within linear elasticity", unmeasured),
        "error_of_spectrum": ("1", "standard deviation of ln margin by the spectrum", unmeasured),
        "error_of_model": ("1", "standard deviation of ln margin by the model", unmeasured),
        "margin": (
            "1",
            "threshold over actual value in the criterion's usual form; sticky above 1",
        ),
        "threshold_by_criterion": (
            "Pa",
            "plane-strain modulus below which a criterion says sticky",
        ),
        "pair_a_v_low": ("1", "low limit of the pair's a_V"),
        "pair_a_v_high": ("1", "high limit of the pair's a_V"),
        "work_of_adhesion": ("J/m^2", "work of adhesion"),
        "stiffening": ("1", "energy of full contact over that of a half-space"),
        "modulus": ("Pa", "plane-strain storage modulus", "beyond the material's table"),
        "modulus_quoted": ("Pa", "plane-strain modulus at 1 Hz or after the dwell, of all margins"),
        "dwell": ("s", "time for which contact is made", "judged at one frequency"),
        "broken_at": ("Hz", "frequency of the modulus, or after a dwell the rate of breaking"),
        "instant_ratio": ("1", "instantaneous modulus over that after the dwell, 1 without one"),
        "depends_on_rate": ("1", "1 where the modulus is given as a function of the frequency"),
        "verdict": ("1", "verdict: " + ", ".join(f"{i} {word}" for i, word in enumerate(WORDS))),
        "decided_by": (
            "1",
            "decided by: " + ", ".join(f"{i} {x}" for i, x in enumerate(DECIDED_BY)),
        ),
        "disagrees": ("1", "1 where a criterion says the opposite of the verdict"),
        "not_judged": ("1", "why a pair is not judged, a line each; empty if it is"),
        "contact": ("m", "side of the contact that is judged", unmeasured),
        "larger_contact": ("m", "side of a larger contact that is judged, too", no_longer),
        "larger_verdict": ("1", "verdict for the larger contact"),
    }
    for name in LARGER:
        unit, text = LIMITED[name]
        for ending in SIGNS:
            limit = f", {ending[1:]} limit" if ending else ""
            longer = f"{text}, of the larger contact{limit}"
            texts[f"larger_{name}{ending}"] = (unit, longer, no_longer)
    for name in DRAWN:
        unit, text = LIMITED[name]
        texts[f"{name}_quantile"] = (unit, f"quantiles of the {text}", unmeasured)
    texts["margin_quantile"] = ("1", "quantiles of the margin", unmeasured)
    for ending in SIGNS:
        limit = f", {ending[1:]} limit" if ending else ""
        for axis, (_, text, missing) in AXES.items():
            texts[f"remaining_by_{axis}{ending}"] = ("1", f"{remains}, {text}{limit}", missing)
        for name, threshold in THRESHOLDS.items():
            texts[f"{name}{ending}"] = threshold
    return texts


def _withhold(dataset: xr.Dataset) -> xr.Dataset:
    """The dataset without numbers of pairs that are not judged, and with that as their verdict."""
    judged = dataset.not_judged == ""
    if judged.all():
        return dataset
    withheld = {}
    with xr.set_options(keep_attrs=True):
        for name, values in dataset.items():
            if values.dtype.kind == "f" and set(PER_PAIR) <= set(values.dims):
                reasons = filter(None, (values.attrs.get("nan_means"), "not judged"))
                withheld[name] = values.where(judged).transpose(*values.dims)
                withheld[name].attrs["nan_means"] = ", or ".join(dict.fromkeys(reasons))
        withheld["verdict"] = dataset.verdict.where(judged, NOT_JUDGED).astype("i1")
        withheld["disagrees"] = dataset.disagrees.where(judged, 0).astype("i1")
    return dataset.assign(withheld)
