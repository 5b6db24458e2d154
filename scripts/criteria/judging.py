"""Judge every material on surfaces: arrays for the library's judgement, and one dataset."""

import numpy as np
import xarray as xr

from common.conventions import logarithmic_grid
from common.materials import read_material
from criteria.budgets import add_budgets
from criteria.classification import decide_pairs, find_doubts, withhold
from criteria.curves import CURVES, DIMS, QUANTILES, follow_remaining, sample_errors
from criteria.pair_roughness import BY_END, ENDS, combine, half_space_pair
from stickiness import datasets
from stickiness.criteria.pair import REGIMES, WORDS, Pair
from stickiness.criteria.registry import CRITERIA, REMAINING
from stickiness.criteria.verdict import BROAD_A_V, LIMITED, QUANTITIES, judge

OF_SURFACES = (*BY_END, "q0", "q1", "hurst", "psd")
FILM, UNMEASURED = "elastic backing", "not measured"
REMAINS = LIMITED["remaining"][1]
THRESHOLDS = [name for name in QUANTITIES if name.startswith("modulus_threshold")]
ERRORS = {  # of measured surfaces
    "probability": ("1", "share of draws that stick", "surface not measured"),
    "error_of_spectrum": ("1", "standard deviation of ln margin by the spectrum", UNMEASURED),
    "error_of_model": ("1", "standard deviation of ln margin by the model", UNMEASURED),
    "share_error_of_spectrum": ("1", f"standard deviation by the spectrum: {REMAINS}", UNMEASURED),
}
# Units, descriptions and, where a value may be missing, what that means.
VARIABLES = {
    **QUANTITIES,
    **{name: (*QUANTITIES[name], FILM) for name in THRESHOLDS},
    **{
        f"{name}_quantile": (units, f"quantiles of the {text}", UNMEASURED)
        for name, (units, text) in LIMITED.items()
    },
    **ERRORS,
    **CURVES,
    "material": ("1", "material"),
    "surface": ("1", "real surface"),
    "end": ("1", "smooth or rough end of what is known of the surface"),
    "criterion": ("1", "stickiness criterion"),
    "quantile": ("1", "quantile of the draws"),
    "frequency": ("Hz", "frequency of loading"),
    "margin": ("1", "threshold over actual value in the criterion's usual form; sticky above 1"),
    "margin_quantile": ("1", "quantiles of the margin", UNMEASURED),
    "modulus_threshold_quantile": ("Pa", "quantiles of the threshold", f"{UNMEASURED}, or {FILM}"),
    "threshold_by_criterion": ("Pa", "plane-strain modulus below which a criterion says sticky"),
    "work_of_adhesion": ("J/m^2", "work of adhesion"),
    "stiffening": ("1", "energy of full contact over that of a half-space"),
    "layer_strain": ("1", "strain that conforming demands of a layer, order of magnitude"),
    "modulus": ("Pa", "plane-strain storage modulus", "beyond the material's table"),
    "modulus_quoted": ("Pa", "plane-strain storage modulus at 1 Hz, of the quoted margins"),
    "depends_on_rate": ("1", "1 where the modulus is given as a function of the frequency"),
    "verdict": ("1", "verdict: " + ", ".join(f"{code} {word}" for code, word in enumerate(WORDS))),
    "disagrees": ("1", "1 where a criterion says the opposite of the verdict"),
    "not_judged": ("1", "why a pair is not judged, a line each; empty if it is"),
}


def read_surfaces(names, paths):
    """Datasets of real surfaces by name, with what a verdict needs."""
    return {name: datasets.read(path, OF_SURFACES) for name, path in zip(names, paths, strict=True)}


def judge_materials(surfaces, material_surfaces, asked):
    """Judge the `materials` of a rule's parameters at its `frequencies`; see `find_verdicts`."""
    materials = {name: read_material(entry) for name, entry in asked.materials.items()}
    frequencies = logarithmic_grid(asked.frequencies)
    return find_verdicts(materials, surfaces, material_surfaces, frequencies)


def find_verdicts(materials, surfaces, material_surfaces, frequencies):
    """Every variable of `VARIABLES`, with error budgets, for `Material`s on surfaces by name.

    `material_surfaces` has the datasets of the surfaces of materials that are rough themselves.
    The frequencies are in Hz.
    """
    solids = list(materials.values())
    smooth = [half_space_pair(surface) for surface in surfaces.values()]
    on = list(zip(surfaces.values(), smooth, strict=True))
    roughness = [
        [combine(solid, *one, material_surfaces.get(solid.surface)) for one in on]
        for solid in solids
    ]
    pair = stack_pairs(solids, roughness)
    moduli = np.array([np.atleast_1d(solid.plane_strain.storage(frequencies)) for solid in solids])
    dataset = xr.Dataset(
        {
            **judge_pairs(pair, solids, roughness),
            **judge_measured(solids, roughness),
            **follow_remaining(pair, solids, roughness, moduli),
            "work_of_adhesion": ("material", [solid.work_of_adhesion for solid in solids]),
            "modulus": (("material", "frequency"), moduli),
            "modulus_quoted": ("material", [solid.modulus for solid in solids]),
            "depends_on_rate": ("material", [int(solid.depends_on_rate) for solid in solids]),
            "not_judged": find_doubts(materials, surfaces, material_surfaces),
        },
        coords={
            "material": list(materials),
            "surface": list(surfaces),
            "end": list(ENDS),
            "criterion": list(CRITERIA),
            "quantile": list(QUANTILES),
            "frequency": frequencies,
        },
    )
    sticky = dataset.margin > 1
    differs = (sticky != sticky.sel(criterion=REMAINING)).any("end")
    dataset = dataset.assign(verdict=decide_pairs(dataset), disagrees=differs.astype("i1"))
    dataset = datasets.annotate(dataset, **VARIABLES)
    dataset.verdict.attrs |= datasets.flags(WORDS)
    dataset.regime.attrs |= datasets.flags(REGIMES)
    draws = [surface.sizes.get("draw", 0) for surface in surfaces.values()]
    return withhold(add_budgets(dataset, draws))


def stack(roughness, name):
    """One number or array of every `PairRoughness`, along material and surface."""
    return np.array([[getattr(pair, name) for pair in row] for row in roughness])


def stack_pairs(solids, roughness) -> Pair:
    """`Pair` of arrays on the dimensions `DIMS`; `roughness` has a row for every material."""
    known = {
        name: np.reshape([getattr(solid, name) for solid in solids], (-1, 1, 1))
        for name in ("modulus", "work_of_adhesion", "range")
    }
    known |= {name: stack(roughness, name) for name in (*BY_END, "half_space_energy")}
    for name in ("q0", "relative_compliance", "anisotropy_error_factor"):
        known[name] = stack(roughness, name)[..., None]
    shape = known["h_rms"].shape
    a_v = np.empty((3, *shape))  # value and both limits
    for i, j, end in np.ndindex(shape):
        pair = roughness[i][j]
        a_v[:, i, j, end] = pair.a_v[end].at(solids[i].range / pair.h_rms[end])
    known |= dict(zip(("a_v", "a_v_low", "a_v_high"), a_v, strict=True))
    return Pair(
        **{name: np.broadcast_to(value, shape) for name, value in known.items()},
        constant_a_v=BROAD_A_V,
    )


def judge_pairs(pair, solids, roughness):
    """The library's judgement on every pair, and what the thickness of a layer does to it.

    There is no threshold of E* with a film: the modulus of the layer alone cannot change without
    changing what the layer does.
    """
    found = judge(pair)
    scalable = np.reshape([solid.is_scalable for solid in solids], (-1, 1, 1))
    for name in THRESHOLDS:
        found[name] = np.where(scalable, found[name], np.nan)
    found["stiffening"] = stack(roughness, "energy_ratio_to_half_space")
    found["layer_strain"] = stack(roughness, "layer_strain")
    margins = [criterion.margin(pair) for criterion in CRITERIA.values()]
    thresholds = [criterion.modulus_threshold(pair) for criterion in CRITERIA.values()]
    return {name: (DIMS, values) for name, values in found.items()} | {
        "margin": ((*DIMS, "criterion"), np.stack(margins, axis=-1)),
        "threshold_by_criterion": ((*DIMS, "criterion"), np.stack(thresholds, axis=-1)),
    }


def judge_measured(solids, roughness):
    """Distributions over the samples of measured surfaces; NaN on others."""
    shape = len(solids), len(roughness[0])
    numbers = {name: np.full(shape, np.nan) for name in ERRORS}
    quantiles = {name: np.full((*shape, len(QUANTILES)), np.nan) for name in LIMITED}
    for place in np.ndindex(shape):
        solid, samples = solids[place[0]], roughness[place[0]][place[1]].samples
        if samples is None:
            continue
        found = judge_samples(solid, samples)
        for name in ERRORS:
            numbers[name][place] = found[name]
        for name in ("margin", "remaining", "pull_off"):
            quantiles[name][place] = np.quantile(found[name], QUANTILES)
        if solid.is_scalable:
            quantiles["modulus_threshold"][place] = solid.modulus * quantiles["margin"][place]
    return {name: (DIMS[:2], values) for name, values in numbers.items()} | {
        f"{name}_quantile": ((*DIMS[:2], "quantile"), x) for name, x in quantiles.items()
    }


def judge_samples(solid, samples):
    """Judge one `Material` on the samples of a surface, with errors of the model."""
    length, errors = solid.work_of_adhesion / solid.modulus, sample_errors(samples)
    at_value = length / samples.threshold(solid.range)
    margins = length / samples.threshold(solid.range, sign=errors)
    return {
        "margin": margins,
        "remaining": samples.share(length, solid.range, errors),
        "pull_off": solid.modulus * samples.tension(length, solid.range, errors),
        "probability": np.mean(margins > 1),
        "error_of_spectrum": np.std(np.log(at_value)),
        "error_of_model": np.std(np.log(margins / at_value)),
        "share_error_of_spectrum": np.std(samples.share(length, solid.range)),
    }
