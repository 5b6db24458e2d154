"""Verdicts on every material and every surface: one dataset of all that is said of the pairs.

Beside each verdict are curves of what remains against the modulus, the heights and the rate.
"""

from dataclasses import fields, replace

import numpy as np
import xarray as xr

from common.conventions import logarithmic_grid
from common.materials import read_material
from common.verdicts import find_limits
from criteria.budgets import add_budgets
from criteria.pair_roughness import ENDS, MOMENTS, combine, find_a_v, read_draws
from stickiness import datasets
from stickiness.criteria import pair as pairs
from stickiness.criteria.pair import LIMITED, NOT_JUDGED, QUANTITIES, REGIMES, SIGNS, WORDS
from stickiness.criteria.registry import CRITERIA, EDGES, REMAINING
from stickiness.solids.moduli import choose_factor
from stickiness.statistics import COVERS

DIMS = ("material", "surface", "end")
# Of the draws of a measured surface: values of draws, so that the limits of a share, its margin and
# its threshold and the number of draws that stick say the same.
QUANTILES, METHOD = (0.05, 0.5, 0.95), "inverted_cdf"
SEED = 2
# Factors on E*, on heights at an unchanged shape of the spectrum, and on the dwell, 1 among them.
MODULUS_FACTORS = 10.0 ** (np.arange(-60, 41) / 10)
ROUGHNESS_FACTORS = 10.0 ** (np.arange(-16, 17) / 16)
DWELL_FACTORS = 10.0 ** (np.arange(-16, 17) / 4)
AXES = {  # dimension, description, and why a value may be missing, of every curve
    "modulus": ("modulus_factor", "for E* times a factor", "not judged"),
    "roughness": ("roughness_factor", "for the pair's heights times a factor", "not judged"),
    "rate": ("frequency", "at a frequency", "beyond the material's table, or dwell"),
    "dwell": ("dwell_factor", "for the dwell times a factor", "no dwell, or beyond the table"),
}
OF_SURFACES = (*MOMENTS, "elastic_energy", "q0", "q1", "psd")
UNMEASURED, REMAINS = "not measured", LIMITED["remaining"][1]
ERRORS = {  # of measured surfaces
    "probability": ("1", "share of draws that stick", UNMEASURED),
    "probability_low": ("1", "share of draws that stick within linear elasticity", UNMEASURED),
    "error_of_spectrum": ("1", "standard deviation of ln margin by the spectrum", UNMEASURED),
    "error_of_model": ("1", "standard deviation of ln margin by the model", UNMEASURED),
    "share_error_of_spectrum": ("1", f"standard deviation by the spectrum: {REMAINS}", UNMEASURED),
}
# Whose quantiles over draws are computed.
DRAWN = ("margin", "modulus_threshold", "remaining", "pull_off")
# Units, descriptions and, where a value may be missing, what that means.
VARIABLES = {
    **QUANTITIES,
    **{
        f"{name}_quantile": (LIMITED[name][0], f"quantiles of the {LIMITED[name][1]}", UNMEASURED)
        for name in DRAWN
    },
    **ERRORS,
    "modulus_factor": ("1", "factor on the plane-strain modulus"),
    "roughness_factor": ("1", "factor on the heights, at unchanged shape of the spectrum"),
    "dwell_factor": ("1", "factor on the dwell"),
    **{
        f"remaining_by_{axis}{end}": (
            "1",
            f"{REMAINS}, {text}{f', {end[1:]} limit' if end else ''}",
            missing,
        )
        for axis, (_, text, missing) in AXES.items()
        for end in SIGNS
    },
    "material": ("1", "material"),
    "surface": ("1", "real surface"),
    "end": ("1", "smooth or rough end of what is known of the surface"),
    "criterion": ("1", "stickiness criterion"),
    "quantile": ("1", "quantile of the draws"),
    "frequency": ("Hz", "frequency of loading"),
    "margin": ("1", "threshold over actual value in the criterion's usual form; sticky above 1"),
    "margin_quantile": ("1", "quantiles of the margin", UNMEASURED),
    "threshold_by_criterion": ("Pa", "plane-strain modulus below which a criterion says sticky"),
    "pair_a_v_low": ("1", "low limit of the pair's a_V"),
    "pair_a_v_high": ("1", "high limit of the pair's a_V"),
    "work_of_adhesion": ("J/m^2", "work of adhesion"),
    "stiffening": ("1", "energy of full contact over that of a half-space"),
    "modulus": ("Pa", "plane-strain storage modulus", "beyond the material's table"),
    "modulus_quoted": ("Pa", "plane-strain modulus at 1 Hz or after the dwell, of all margins"),
    "dwell": ("s", "time for which contact is made", "judged at one frequency"),
    "broken_at": ("Hz", "frequency of the modulus, or after a dwell the rate of breaking"),
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
    on = [(surface, find_a_v(surface)) for surface in surfaces.values()]
    roughness = [
        [combine(solid, *one, material_surfaces.get(solid.surface)) for one in on]
        for solid in solids
    ]
    dataset = judge_pairs(solids, roughness, frequencies)
    dataset = dataset.assign_coords(material=list(materials), surface=list(surfaces))
    doubts = [[pair.attrs["not_judged"] for pair in row] for row in roughness]
    dataset["not_judged"] = DIMS[:2], np.array(doubts, "O")
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
    return low.copy(data=pairs.decide(low, high, grows))


def judge_pairs(solids, roughness, frequencies):
    """Quantities of every pair by the library; `roughness` has a row of `combine` by material."""
    known = {
        name: ("material", [getattr(solid, name) for solid in solids])
        for name in ("modulus", "work_of_adhesion", "range", "law", "pressed")
    }
    ends = [[one.drop_dims("draw", errors="ignore") for one in row] for row in roughness]
    rough = xr.combine_nested(ends, DIMS[:2], combine_attrs="drop").assign(known)
    films = rough.film_response.transpose(*DIMS, ...).values
    rough = rough.drop_dims("response").broadcast_like(rough.h_rms).transpose(*DIMS)
    at = zip(solids, rough.h_rms.values, rough.q0.values, strict=True)
    strain = np.array([solid.solid.strain(h_rms, q0) for solid, h_rms, q0 in at])
    names = [field.name for field in fields(pairs.Pair) if field.name in rough]
    factors = np.array([solid.separation_factor for solid in solids])
    pair = pairs.Pair(
        **{name: rough[name].values for name in names},
        separation_factor=tuple(factors.T[..., None, None]),
        layer_strain=strain,
        film_response=films,
    )
    dataset = xr.Dataset({name: (DIMS, values) for name, values in pairs.judge(pair).items()})
    margins = [criterion.margin(pair) for criterion in CRITERIA.values()]
    thresholds = [criterion.modulus_threshold(pair) for criterion in CRITERIA.values()]
    moduli = np.array([np.atleast_1d(solid.plane_strain.storage(frequencies)) for solid in solids])
    rows = zip(solids, roughness, strict=True)
    draws = [[read_draws(one, solid) for one in row] for solid, row in rows]
    return dataset.assign(
        **judge_measured(draws),
        **follow_remaining(pair, solids, draws, moduli),
        margin=((*DIMS, "criterion"), np.stack(margins, axis=-1)),
        threshold_by_criterion=((*DIMS, "criterion"), np.stack(thresholds, axis=-1)),
        pair_a_v_low=rough.a_v_low,
        pair_a_v_high=rough.a_v_high,
        stiffening=rough.stiffening,
        work_of_adhesion=known["work_of_adhesion"],
        modulus=(("material", "frequency"), moduli),
        modulus_quoted=known["modulus"],
        dwell=("material", [solid.dwell for solid in solids]),
        broken_at=("material", [solid.broken_at for solid in solids]),
        depends_on_rate=("material", [int(solid.depends_on_rate) for solid in solids]),
    ).assign_coords(
        end=list(ENDS), criterion=list(CRITERIA), quantile=list(QUANTILES), frequency=frequencies
    )


def judge_measured(draws):
    """Distributions over the draws of measured surfaces; NaN on others."""
    nothing = np.full(1, np.nan)
    unknown = dict.fromkeys((*DRAWN, "withstands"), nothing) | dict.fromkeys(ERRORS, np.nan)
    found = [[unknown if one is None else judge_draws(one) for one in row] for row in draws]
    dataset = xr.Dataset({n: (DIMS[:2], [[x[n] for x in row] for row in found]) for n in ERRORS})
    for name in DRAWN:
        values = [[find_quantiles(one[name], one["withstands"]) for one in row] for row in found]
        dataset[f"{name}_quantile"] = (*DIMS[:2], "quantile"), values
    return dataset


def find_quantiles(values, withstands):
    """`QUANTILES` over draws; for the low limit nothing remains where a layer cannot withstand."""
    low, *others = QUANTILES
    least = np.quantile(values * withstands, [low], axis=-1, method=METHOD)
    found = np.concatenate([least, np.quantile(values, others, axis=-1, method=METHOD)])
    return np.moveaxis(found, 0, -1)


def judge_draws(draws):
    """Judge a `Pair` on draws of its surface, with errors of the model."""
    length, errors = draws.adhesion_length, draw_errors(draws)
    value, factor = (choose_factor(draws.separation_factor, sign) for sign in (0, errors))
    pressed = draws.pressed / draws.modulus
    known = {"range": draws.range, "adhesion_length": length}
    at_value = length / draws.threshold(**known, separation_factor=value)
    margins = length / draws.threshold(**known, sign=errors, separation_factor=factor)
    withstands = draws.layer_strain <= pairs.MOST_STRAIN
    return {
        "withstands": withstands,
        "margin": margins,
        "modulus_threshold": margins * draws.modulus,
        "remaining": draws.share(length, draws.range, errors, factor),
        "pull_off": draws.modulus * draws.tension(length, draws.range, errors, pressed, factor),
        "probability": np.mean(margins > 1),
        "probability_low": np.mean((margins > 1) & withstands),
        "error_of_spectrum": np.std(np.log(at_value)),
        "error_of_model": np.std(np.log(margins / at_value)),
        "share_error_of_spectrum": np.std(draws.share(length, draws.range)) * value,
    }


def follow_remaining(pair, solids, draws, rates):
    """Share that remains along factors on E*, on the heights and on the dwell, and along the rate.

    `draws` has a row of `read_draws` for every material, `rates` are moduli (material, frequency).
    """
    dwelt = np.isfinite([solid.dwell for solid in solids])
    quoted = np.array([solid.modulus for solid in solids])
    times = DWELL_FACTORS if dwelt.any() else np.ones(1)
    dwells = [[replace(one, dwell=x * one.dwell) for one in solids] for x in times]
    along = {
        "modulus": MODULUS_FACTORS[:, None] * quoted,
        "roughness": np.broadcast_to(quoted, (len(ROUGHNESS_FACTORS), len(solids))),
        "rate": np.where(dwelt, np.nan, rates.T),
        "dwell": np.where(dwelt, [[one.modulus for one in row] for row in dwells], np.nan),
    }
    found = {"modulus_factor": MODULUS_FACTORS, "roughness_factor": ROUGHNESS_FACTORS}
    found["dwell_factor"] = times
    for axis, moduli in along.items():
        heights = ROUGHNESS_FACTORS if axis == "roughness" else np.ones(len(moduli))
        at = dwells if axis == "dwell" else [solids] * len(moduli)
        factors = np.array([[one.separation_factor for one in row] for row in at])
        curves = follow(pair, draws, AXES[axis][0], moduli, factors, heights)
        found |= {f"remaining_by_{axis}{end}": x for end, x in zip(SIGNS, curves, strict=True)}
    return found


def follow(pair, draws, dim, moduli, factors, heights):
    """Share with the limits that decide, for moduli (dim, material) and factors on heights (dim,).

    `factors` on the work of separation, with limits, are (dim, material, 3). A modulus that is not
    known is NaN, and so are its shares.
    """
    known = xr.DataArray(~np.isnan(moduli), dims=(dim, "material"))
    moduli = np.where(known, moduli, pair.modulus[:, 0, 0])
    at = pair.scaled(heights[:, None, None, None])
    factors = np.where(known.values[..., None], factors, 1.0)
    by_limit = tuple(np.moveaxis(factors, -1, 0)[..., None, None])
    moduli = moduli[..., None, None]
    at = replace(at.at_modulus(moduli / pair.modulus), modulus=moduli, separation_factor=by_limit)
    found = xr.Dataset(
        {f"remaining{end}": ((dim, *DIMS), at.remaining(sign)) for end, sign in SIGNS.items()}
    )
    quantiles = [
        [follow_draws(one, moduli[:, i, 0, 0], factors[:, i], heights) for one in row]
        for i, row in enumerate(draws)
    ]
    found["remaining_quantile"] = (*DIMS[:2], dim, "quantile"), np.array(quantiles)
    curves = (found.remaining, *find_limits(found))
    return tuple(x.where(known).transpose(*DIMS, dim, missing_dims="ignore") for x in curves)


def follow_draws(draws, moduli, factors, heights):
    """Quantiles of the share over the draws of a surface, ``(dim, quantile)``; NaN without."""
    if draws is None:
        return np.full((len(moduli), len(QUANTILES)), np.nan)
    along, place = np.unique([moduli, heights, *factors.T], axis=1, return_inverse=True)
    moduli, heights, *factors = along[..., None]
    at = draws.scaled(heights).at_modulus(moduli / draws.modulus)
    return remain_of_draws(replace(at, modulus=moduli, separation_factor=factors))[place]


def remain_of_draws(draws):
    """Quantiles of the share, along a last axis, of a `Pair` on draws."""
    errors = draw_errors(draws)
    factor = choose_factor(draws.separation_factor, errors)
    shares = draws.share(draws.adhesion_length, draws.range, errors, factor)
    return find_quantiles(shares, draws.layer_strain <= pairs.MOST_STRAIN)


def draw_errors(draws):
    """Errors of the model for every draw, in units of its limits, which cover 90 %."""
    return np.random.default_rng(SEED).normal(size=np.shape(draws.h_rms)[-1]) / COVERS


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
