"""Verdict for every material on a surface, by the adhesion that remains and other criteria."""

import xarray as xr

from common.conventions import logarithmic_grid
from criteria.budgets import add_budgets
from criteria.curves import OF_RATE, follow_remaining
from criteria.joint import BY_END, ENDS
from criteria.materials import read_material
from criteria.pairs import (
    describe_edges,
    describe_joints,
    describe_remaining,
    find_margins,
    follow_rates,
    gather_pairs,
    join_all,
)
from criteria.probabilities import find_probabilities
from criteria.words import decide_pairs, find_disagreement, find_doubts, withhold
from stickiness import datasets
from stickiness.criteria.pair import REGIMES, WORDS
from stickiness.criteria.registry import CRITERIA

OF_SURFACES = (*BY_END, "q0", "q1", "hurst", "psd")


def read_surfaces(names, paths):
    """Datasets of real surfaces by name, with what a verdict needs."""
    return {name: datasets.read(path, OF_SURFACES) for name, path in zip(names, paths, strict=True)}


def judge(surfaces, own, asked):
    """Verdicts on surfaces, as a dataset; `asked` are the parameters of the rules that judge.

    `own` has the surfaces of materials that are rough themselves, by name.
    """
    materials = {name: read_material(entry) for name, entry in asked.materials.items()}
    return find_verdicts(materials, surfaces, own, logarithmic_grid(asked.frequencies))


def find_verdicts(materials, surfaces, own, frequencies):
    """Every criterion for every material on both ends of every surface.

    `own` has the surfaces of materials that are rough themselves, by name.
    """
    joints = join_all(materials, surfaces, own)
    pair = gather_pairs(materials, joints)
    dataset = xr.Dataset(
        {
            "work_of_adhesion": ("material", [m.work_of_adhesion for m in materials.values()]),
            **find_margins(pair),
            **describe_remaining(pair, materials),
            **describe_joints(pair, joints),
            **describe_edges(pair),
        },
        coords={
            "material": list(materials),
            "surface": list(surfaces),
            "end": list(ENDS),
            "criterion": list(CRITERIA),
        },
    )
    dataset = dataset.assign(find_probabilities(materials, joints))
    dataset = dataset.assign(follow_rates(materials, frequencies))
    dataset = dataset.assign(follow_remaining(pair, materials, joints, frequencies))
    dataset["verdict"] = decide_pairs(dataset)
    dataset["disagrees"] = find_disagreement(dataset)
    dataset["not_judged"] = find_doubts(materials, surfaces, own)
    draws = {name: surface.sizes.get("draw", 0) for name, surface in surfaces.items()}
    return withhold(add_budgets(describe(dataset), draws))


def describe(dataset):
    margin = "adhesion length over the one at which the wanted share remains"
    remains = "share of the work of adhesion that remains"
    pull_off = "largest mean tension on separation"
    threshold = "plane-strain modulus below which the wanted share remains"
    words = ", ".join(f"{code} {word}" for code, word in enumerate(WORDS))
    dataset = datasets.annotate(
        dataset,
        material=("1", "material"),
        surface=("1", "real surface"),
        end=("1", "smooth or rough end of what is known of the surface"),
        criterion=("1", "stickiness criterion"),
        margin=("1", "threshold over actual value in the criterion's own form; sticky above 1"),
        margin_low=("1", f"{margin}, low limit of the model"),
        margin_high=("1", f"{margin}, high limit of the model"),
        remaining=("1", remains),
        remaining_low=("1", f"{remains}, low limit of the model"),
        remaining_high=("1", f"{remains}, high limit of the model"),
        remaining_quantile=("1", f"quantiles of the {remains}", "not measured"),
        pull_off=("Pa", pull_off),
        pull_off_low=("Pa", f"{pull_off}, low limit of the model"),
        pull_off_high=("Pa", f"{pull_off}, high limit of the model"),
        energy_ratio=("1", "work of adhesion over the elastic energy of full contact"),
        range_over_h_rms=("1", "range of attraction over rms height"),
        stiffening=("1", "energy of full contact over that of a half-space"),
        layer_strain=("1", "strain that conforming asks of a layer, order of magnitude"),
        pair_h_rms=("m", "rms height of the pair, of both solids if both are rough"),
        pair_q0=("1/m", "wave number of the longest waves of the pair that matter"),
        pair_rms_slope=("1", "rms gradient of the pair"),
        pair_rms_curvature=("1/m", "rms Laplacian of the pair"),
        pair_a_v=("1", "a_V of the pair: its surface's spectrum, its range over h_rms"),
        pair_a_v_low=("1", "low limit of the pair's a_V"),
        pair_a_v_high=("1", "high limit of the pair's a_V"),
        edge_strength=("1", "Tabor's parameter of the edges of contact, l_a d/range^2"),
        attractive_over_contact=("1", "area within the range over area of contact"),
        over_dmt=("1", "attraction over that of the DMT limit, at equal area of contact"),
        regime=("1", "edges: 0 weak, 1 between, 2 tough (JKR), 3 strong, not JKR"),
        simulated=("1", "1 where full simulation bears the model out"),
        jtb_margin=("1", "rms height over the smallest at which the DMT limit holds (JTB)"),
        modulus_threshold=("Pa", threshold, "elastic backing"),
        modulus_threshold_low=("Pa", f"{threshold}, low limit of the model", "elastic backing"),
        modulus_threshold_high=("Pa", f"{threshold}, high limit of the model", "elastic backing"),
        modulus_threshold_quantile=(
            "Pa",
            f"quantiles of the {threshold}",
            "not measured, or elastic backing",
        ),
        pull_off_quantile=("Pa", f"quantiles of the {pull_off}", "not measured"),
        work_of_adhesion=("J/m^2", "work of adhesion"),
        threshold_by_criterion=("Pa", "plane-strain modulus below which a criterion says sticky"),
        verdict=("1", f"verdict: {words}"),
        probability=("1", "share of draws that stick", "surface not measured"),
        not_judged=("1", "why a pair is not judged, a line each; empty if it is"),
        quantile=("1", "quantile of the draws"),
        margin_quantile=("1", "quantiles of the margin", "not measured"),
        error_of_spectrum=("1", "standard deviation of ln margin by the spectrum", "not measured"),
        error_of_model=("1", "standard deviation of ln margin by the model", "not measured"),
        share_error_of_spectrum=(
            "1",
            f"standard deviation of the {remains}, by the spectrum",
            "not measured",
        ),
        frequency=("Hz", "frequency of loading"),
        modulus=("Pa", "plane-strain storage modulus", "beyond the material's table"),
        modulus_quoted=("Pa", "plane-strain storage modulus at 1 Hz, of the quoted margins"),
        **describe_curves(remains),
        depends_on_rate=("1", "1 where the modulus is given as a function of the frequency"),
        disagrees=("1", "1 where a criterion says the opposite of the verdict"),
    )
    dataset.verdict.attrs |= datasets.flags(WORDS)
    dataset.regime.attrs |= datasets.flags(REGIMES)
    return dataset


def describe_curves(remains):
    """Descriptions of the share along the modulus, the heights and the rate."""
    axes = {
        "modulus": ("for E* times a factor", "elastic backing"),
        "roughness": ("for the pair's heights times a factor", "not judged"),
        "rate": ("at a frequency", OF_RATE),
    }
    described = {
        "modulus_factor": ("1", "factor on the plane-strain modulus"),
        "roughness_factor": ("1", "factor on the heights, at unchanged shape of the spectrum"),
    }
    for axis, (text, unknown) in axes.items():
        name = f"remaining_by_{axis}"
        described[name] = ("1", f"{remains}, {text}", unknown)
        for end in ("low", "high"):
            described[f"{name}_{end}"] = ("1", f"{remains}, {text}, {end} limit", unknown)
    return described
