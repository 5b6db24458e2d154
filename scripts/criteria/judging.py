"""Judge every material on surfaces: arrays for the library's judgement, and one dataset."""

import numpy as np
import xarray as xr

from common.conventions import logarithmic_grid
from criteria.budgets import add_budgets
from criteria.classification import decide_pairs, find_disagreement, find_doubts, withhold
from criteria.curves import CURVES, DIMS, QUANTILES, follow_remaining, sample_errors
from criteria.materials import read_material
from criteria.pair_roughness import BY_END, ENDS, combine, half_space_pair
from stickiness import datasets
from stickiness.criteria import judgement
from stickiness.criteria.pair import REGIMES, WORDS, Pair
from stickiness.criteria.registry import CRITERIA
from stickiness.criteria.verdict import BROAD_A_V

OF_SURFACES = (*BY_END, "q0", "q1", "hurst", "psd")
FILM, UNMEASURED = "elastic backing", "not measured"
REMAINS, PULL_OFF, THRESHOLD = (
    judgement.QUANTITIES[name].long_name for name in ("remaining", "pull_off", "modulus_threshold")
)
# Units, descriptions and, where a value may be missing, what that means.
VARIABLES = {
    **{name: (q.units, q.long_name) for name, q in judgement.QUANTITIES.items()},
    **{
        name: (q.units, q.long_name, FILM)
        for name, q in judgement.QUANTITIES.items()
        if name.startswith("modulus_threshold")
    },
    "material": ("1", "material"),
    "surface": ("1", "real surface"),
    "end": ("1", "smooth or rough end of what is known of the surface"),
    "criterion": ("1", "stickiness criterion"),
    "quantile": ("1", "quantile of the draws"),
    "frequency": ("Hz", "frequency of loading"),
    "margin": ("1", "threshold over actual value in the criterion's own form; sticky above 1"),
    "threshold_by_criterion": ("Pa", "plane-strain modulus below which a criterion says sticky"),
    "work_of_adhesion": ("J/m^2", "work of adhesion"),
    "stiffening": ("1", "energy of full contact over that of a half-space"),
    "layer_strain": ("1", "strain that conforming demands of a layer, order of magnitude"),
    "modulus": ("Pa", "plane-strain storage modulus", "beyond the material's table"),
    "modulus_quoted": ("Pa", "plane-strain storage modulus at 1 Hz, of the quoted margins"),
    "depends_on_rate": ("1", "1 where the modulus is given as a function of the frequency"),
    "probability": ("1", "share of draws that stick", "surface not measured"),
    "margin_quantile": ("1", "quantiles of the margin", UNMEASURED),
    "remaining_quantile": ("1", f"quantiles of the {REMAINS}", UNMEASURED),
    "pull_off_quantile": ("Pa", f"quantiles of the {PULL_OFF}", UNMEASURED),
    "modulus_threshold_quantile": (
        "Pa",
        f"quantiles of the {THRESHOLD}",
        f"{UNMEASURED}, or {FILM}",
    ),
    "error_of_spectrum": ("1", "standard deviation of ln margin by the spectrum", UNMEASURED),
    "error_of_model": ("1", "standard deviation of ln margin by the model", UNMEASURED),
    "share_error_of_spectrum": (
        "1",
        f"standard deviation of the {REMAINS}, by the spectrum",
        UNMEASURED,
    ),
    **CURVES,
    "verdict": ("1", "verdict: " + ", ".join(f"{code} {word}" for code, word in enumerate(WORDS))),
    "disagrees": ("1", "1 where a criterion says the opposite of the verdict"),
    "not_judged": ("1", "why a pair is not judged, a line each; empty if it is"),
}


def read_surfaces(names, paths):
    """Datasets of real surfaces by name, with what a verdict needs."""
    return {name: datasets.read(path, OF_SURFACES) for name, path in zip(names, paths, strict=True)}


def judge(surfaces, own, asked):
    """Judge the materials on surfaces.

    Parameters
    ----------
    surfaces : dict of str to Dataset
        Surfaces by name, see `read_surfaces`.
    own : dict of str to Dataset
        Surfaces of the materials that are rough themselves, by name.
    asked : object
        Parameters of a rule that judges: `materials` and `frequencies` of the configuration.

    Returns
    -------
    Dataset
        Every variable of `VARIABLES`, with error budgets.
    """
    materials = {name: read_material(entry) for name, entry in asked.materials.items()}
    return find_verdicts(materials, surfaces, own, logarithmic_grid(asked.frequencies))


def find_verdicts(materials, surfaces, own, frequencies):
    """Judge `Material`s on surfaces, at frequencies [Hz]; see `judge`."""
    smooth = [half_space_pair(surface) for surface in surfaces.values()]
    roughness = [
        [
            combine(material, surface, one, own.get(material.surface))
            for surface, one in zip(surfaces.values(), smooth, strict=True)
        ]
        for material in materials.values()
    ]
    pair = stack_pairs(materials, roughness)
    coords = {
        "material": list(materials),
        "surface": list(surfaces),
        "end": list(ENDS),
        "criterion": list(CRITERIA),
        "quantile": list(QUANTILES),
        "frequency": frequencies,
    }
    dataset = xr.Dataset(
        {
            **judge_pairs(pair, materials, roughness),
            **judge_measured(materials, roughness),
            **describe_materials(materials, frequencies),
        },
        coords=coords,
    )
    dataset = dataset.assign(follow_remaining(pair, materials, roughness, frequencies))
    dataset["verdict"] = decide_pairs(dataset)
    dataset["disagrees"] = find_disagreement(dataset)
    dataset["not_judged"] = find_doubts(materials, surfaces, own)
    dataset = datasets.annotate(dataset, **VARIABLES)
    dataset.verdict.attrs |= datasets.flags(WORDS)
    dataset.regime.attrs |= datasets.flags(REGIMES)
    draws = [surface.sizes.get("draw", 0) for surface in surfaces.values()]
    return withhold(add_budgets(dataset, draws))


def stack(roughness, name):
    """One number or array of every `PairRoughness`, along material and surface."""
    return np.array([[getattr(pair, name) for pair in row] for row in roughness])


def stack_pairs(materials, roughness) -> Pair:
    """`Pair` of arrays on the dimensions `DIMS`; `roughness` has a row for every material."""
    known = {
        name: np.reshape([getattr(solid, name) for solid in materials.values()], (-1, 1, 1))
        for name in ("modulus", "work_of_adhesion", "range")
    }
    known |= {name: stack(roughness, name) for name in (*BY_END, "half_space_energy")}
    for name in ("q0", "relative_compliance", "anisotropy_error_factor"):
        known[name] = stack(roughness, name)[..., None]
    a_v = [
        [pair.a_v_at(solid.range) for pair in row]
        for solid, row in zip(materials.values(), roughness, strict=True)
    ]
    known |= dict(zip(("a_v", "a_v_low", "a_v_high"), np.moveaxis(a_v, -1, 0), strict=True))
    shape = len(materials), len(roughness[0]), len(ENDS)
    return Pair(
        **{name: np.broadcast_to(value, shape) for name, value in known.items()},
        constant_a_v=BROAD_A_V,
    )


def judge_pairs(pair, materials, roughness):
    """The library's judgement on every pair, and what the thickness of a layer does to it.

    There is no threshold of E* with a film: the modulus of the layer alone cannot change without
    changing what the layer does.
    """
    found = {name: (DIMS, values) for name, values in judgement.judge(pair).items()}
    scalable = np.reshape([solid.is_scalable for solid in materials.values()], (-1, 1, 1))
    for name in found:
        if name.startswith("modulus_threshold"):
            found[name] = DIMS, np.where(scalable, found[name][1], np.nan)
    by_criterion = {
        "margin": judgement.find_margins(pair),
        "threshold_by_criterion": judgement.find_modulus_thresholds(pair),
    }
    return (
        found
        | {
            name: ((*DIMS, "criterion"), np.stack(list(values.values()), axis=-1))
            for name, values in by_criterion.items()
        }
        | {
            "stiffening": (DIMS, stack(roughness, "energy_ratio_to_half_space")),
            "layer_strain": (DIMS, stack(roughness, "layer_strain")),
        }
    )


def judge_measured(materials, roughness):
    """Distributions over the samples of measured surfaces; NaN on others."""
    names = ("probability", "error_of_spectrum", "error_of_model", "share_error_of_spectrum")
    shape = len(materials), len(roughness[0])
    numbers = np.full((len(names), *shape), np.nan)
    quantiles = {
        name: np.full((*shape, len(QUANTILES)), np.nan)
        for name in ("margin", "remaining", "pull_off", "modulus_threshold")
    }
    for i, solid in enumerate(materials.values()):
        for j, pair in enumerate(roughness[i]):
            if pair.samples is None:
                continue
            found = judge_samples(solid, pair.samples)
            numbers[:, i, j] = (
                *(found.probability, found.from_spectrum, found.from_model),
                found.share_from_spectrum,
            )
            for name, values in (
                ("margin", found.margins),
                ("remaining", found.remaining),
                ("pull_off", found.pull_off),
            ):
                quantiles[name][i, j] = np.quantile(values, QUANTILES)
            if solid.is_scalable:
                quantiles["modulus_threshold"][i, j] = solid.modulus * quantiles["margin"][i, j]
    dims = DIMS[:2]
    return {name: (dims, values) for name, values in zip(names, numbers, strict=True)} | {
        f"{name}_quantile": ((*dims, "quantile"), values) for name, values in quantiles.items()
    }


def judge_samples(solid, samples):
    """Judge one `Material` on the samples of a surface, with errors of the model."""
    return judgement.judge_samples(
        samples, solid.modulus, solid.work_of_adhesion, solid.range, sample_errors(samples)
    )


def describe_materials(materials, frequencies):
    """Work of adhesion and moduli; beyond a material's table there is no modulus."""
    solids = materials.values()
    return {
        "work_of_adhesion": ("material", [m.work_of_adhesion for m in solids]),
        "modulus": (
            ("material", "frequency"),
            np.array([np.atleast_1d(m.plane_strain.storage(frequencies)) for m in solids]),
        ),
        "modulus_quoted": ("material", [m.modulus for m in solids]),
        "depends_on_rate": ("material", [int(m.depends_on_rate) for m in solids]),
    }
