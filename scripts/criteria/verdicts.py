"""Verdicts on every material and every surface: one dataset of all that is said of the pairs."""

from dataclasses import fields

import numpy as np
import xarray as xr

from common.conventions import logarithmic_grid
from common.materials import read_material
from common.verdicts import find_limits
from criteria.budgets import add_budgets
from criteria.curves import CURVES, DIMS, QUANTILES, draw_errors, follow_remaining
from criteria.pair_roughness import ENDS, MOMENTS, combine, find_a_v, read_draws
from stickiness import datasets
from stickiness.criteria.pair import (
    LIMITED,
    NOT_JUDGED,
    QUANTITIES,
    REGIMES,
    WORDS,
    Pair,
    decide,
    judge,
)
from stickiness.criteria.registry import CRITERIA, EDGES, REMAINING

OF_SURFACES = (*MOMENTS, "elastic_energy", "q0", "q1", "hurst", "psd")
FILM, UNMEASURED = "elastic backing", "not measured"
REMAINS = LIMITED["remaining"][1]
THRESHOLDS = [name for name in QUANTITIES if name.startswith("modulus_threshold")]
ERRORS = {  # of measured surfaces
    "probability": ("1", "share of draws that stick", "surface not measured"),
    "error_of_spectrum": ("1", "standard deviation of ln margin by the spectrum", UNMEASURED),
    "error_of_model": ("1", "standard deviation of ln margin by the model", UNMEASURED),
    "share_error_of_spectrum": ("1", f"standard deviation by the spectrum: {REMAINS}", UNMEASURED),
}
DRAWN = ("margin", "remaining", "pull_off")  # whose quantiles over draws are computed
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
    "pair_a_v_low": ("1", "low limit of the pair's a_V"),
    "pair_a_v_high": ("1", "high limit of the pair's a_V"),
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

    `material_surfaces` are those of materials that are rough themselves; frequencies are in Hz.
    """
    solids = list(materials.values())
    seconds = [material_surfaces.get(solid.surface) for solid in solids]
    on = [(surface, find_a_v(surface)) for surface in surfaces.values()]
    roughness = [
        [combine(solid, *one, second) for one in on]
        for solid, second in zip(solids, seconds, strict=True)
    ]
    dataset = judge_pairs(solids, roughness, frequencies)
    dataset = dataset.assign_coords(material=list(materials), surface=list(surfaces))
    given = [
        [(one, second, pair) for one, pair in zip(surfaces.values(), row, strict=True)]
        for second, row in zip(seconds, roughness, strict=True)
    ]
    dataset["not_judged"] = DIMS[:2], np.array([list(map(find_doubts, row)) for row in given], "O")
    sticky = dataset.margin > 1
    differs = (sticky != sticky.sel(criterion=REMAINING)).any("end")
    dataset = dataset.assign(verdict=decide_pairs(dataset), disagrees=differs.astype("i1"))
    dataset = datasets.annotate(dataset, **VARIABLES)
    dataset.verdict.attrs |= datasets.flags(WORDS)
    dataset.regime.attrs |= datasets.flags(REGIMES)
    draws = [surface.sizes.get("draw", 0) for surface in surfaces.values()]
    return withhold(add_budgets(dataset, draws))


def decide_pairs(dataset):
    """Code of the verdict over the whole range of the surface and the limits of the model."""
    low, high = find_limits(dataset)
    grows = (dataset.margin.sel(criterion=EDGES, drop=True) > 1).any("end")
    return low.copy(data=decide(low, high, grows))


def find_doubts(given):
    """Why a pair is not judged, by the attributes of its datasets; empty if it is."""
    reasons = (one.attrs.get("not_judged") for one in given if one is not None)
    return "\n".join(filter(None, reasons))


def judge_pairs(solids, roughness, frequencies):
    """Quantities of every pair by the library; `roughness` has a row of `combine` by material."""
    known = {
        name: ("material", [getattr(solid, name) for solid in solids])
        for name in ("modulus", "work_of_adhesion", "range")
    }
    ends = [[one.drop_dims("draw", errors="ignore") for one in row] for row in roughness]
    rough = xr.combine_nested(ends, DIMS[:2], combine_attrs="drop").assign(known)
    rough = rough.broadcast_like(rough.h_rms).transpose(*DIMS)
    names = [field.name for field in fields(Pair) if field.name in rough]
    pair = Pair(**{name: rough[name].values for name in names})
    dataset = xr.Dataset({name: (DIMS, values) for name, values in judge(pair).items()})
    # There is no threshold of E* with a film: the modulus of the layer alone cannot change without
    # changing what the layer does.
    scalable = xr.DataArray([solid.is_scalable for solid in solids], dims="material")
    dataset = dataset.assign({name: dataset[name].where(scalable) for name in THRESHOLDS})
    # Where the longest waves are longer than the layer is thick, material has to flow along it, and
    # shears by 1/(q0 thickness) more than the rms height over the thickness.
    thickness = [getattr(solid.solid, "thickness", np.inf) for solid in solids]
    thickness = xr.DataArray(thickness, dims="material")
    strain = rough.h_rms / (thickness * np.minimum(1.0, rough.q0 * thickness))
    margins = [criterion.margin(pair) for criterion in CRITERIA.values()]
    thresholds = [criterion.modulus_threshold(pair) for criterion in CRITERIA.values()]
    moduli = np.array([np.atleast_1d(solid.plane_strain.storage(frequencies)) for solid in solids])
    draws = [[read_draws(one) for one in row] for row in roughness]
    return dataset.assign(
        **judge_measured(solids, draws),
        **follow_remaining(pair, solids, draws, strain, moduli),
        margin=((*DIMS, "criterion"), np.stack(margins, axis=-1)),
        threshold_by_criterion=((*DIMS, "criterion"), np.stack(thresholds, axis=-1)),
        pair_a_v_low=rough.a_v_low,
        pair_a_v_high=rough.a_v_high,
        stiffening=rough.stiffening,
        layer_strain=strain,
        work_of_adhesion=known["work_of_adhesion"],
        modulus=(("material", "frequency"), moduli),
        modulus_quoted=known["modulus"],
        depends_on_rate=("material", [int(solid.depends_on_rate) for solid in solids]),
    ).assign_coords(
        end=list(ENDS), criterion=list(CRITERIA), quantile=list(QUANTILES), frequency=frequencies
    )


def judge_measured(solids, draws):
    """Distributions over the draws of measured surfaces; NaN on others."""
    unknown = dict.fromkeys((*ERRORS, *DRAWN), np.nan)
    found = [
        [unknown if one is None else judge_draws(solid, one) for one in row]
        for solid, row in zip(solids, draws, strict=True)
    ]
    dataset = xr.Dataset({n: (DIMS[:2], [[x[n] for x in row] for row in found]) for n in ERRORS})
    for name in DRAWN:
        values = [[np.quantile(one[name], QUANTILES) for one in row] for row in found]
        dataset[f"{name}_quantile"] = (*DIMS[:2], "quantile"), values
    moduli = [solid.modulus if solid.is_scalable else np.nan for solid in solids]
    thresholds = dataset.margin_quantile * xr.DataArray(moduli, dims="material")
    return dataset.assign(modulus_threshold_quantile=thresholds)


def judge_draws(solid, draws):
    """Judge one `Material` on the draws of a surface, with errors of the model."""
    length, errors = solid.work_of_adhesion / solid.modulus, draw_errors(draws)
    at_value = length / draws.threshold(solid.range)
    margins = length / draws.threshold(solid.range, sign=errors)
    return {
        "margin": margins,
        "remaining": draws.share(length, solid.range, errors),
        "pull_off": solid.modulus * draws.tension(length, solid.range, errors),
        "probability": np.mean(margins > 1),
        "error_of_spectrum": np.std(np.log(at_value)),
        "error_of_model": np.std(np.log(margins / at_value)),
        "share_error_of_spectrum": np.std(draws.share(length, solid.range)),
    }


def withhold(dataset):
    """The dataset without any number of pairs where there are doubts about a surface."""
    judged = dataset.not_judged == ""
    if judged.all():
        return dataset
    found = {}
    with xr.set_options(keep_attrs=True):
        for name, values in dataset.items():
            if values.dtype.kind == "f" and {"material", "surface"} <= set(values.dims):
                reasons = filter(None, (values.attrs.get("nan_means"), "not judged"))
                found[name] = values.where(judged).transpose(*values.dims)
                found[name].attrs["nan_means"] = ", or ".join(reasons)
        for name, code in (("verdict", NOT_JUDGED), ("disagrees", 0)):
            found[name] = dataset[name].where(judged, code).astype("i1")
    return dataset.assign(found)
