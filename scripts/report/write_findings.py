"""The findings: what a run says, with its numbers, as one page of Markdown."""

import pandas as pd

from common import heights_table, remaining_table
from common import tradeoff_table as summary
from common.conventions import VARIANT
from common.edge_points import select_certain
from common.experiment_outcomes import OUTCOMES, describe
from common.job import start
from common.pairs import count_pairs
from common.paper import at_load
from report.pages import find_pixels
from stickiness import datasets, error_budget
from stickiness.criteria import equivalent_sphere
from stickiness.criteria.pair import WORDS
from stickiness.pages.rendering import write_page
from stickiness.remaining.trial_states import DEFAULT_SHARE

WELL_KNOWN = 0.25  # relative error of a predicted work that counts as met
LEAST_SHARE = 0.05  # remaining share from which predicted works are compared
LEAST_AREA = 0.2  # attractive over contact area from which the sphere is compared
ENERGY_RATIOS = (0.3, 0.4, 0.6, 0.8, 1.1, 1.5, 2.5)  # bins of w/U_full
HEIGHT_MODELS = ("theory", "shaped", "states")
SHOWN_SETTINGS = ("points per wavelength", "seeds", "model")  # without adhesion


def main(job):
    read = datasets.read
    inputs = job.input
    weakest = at_load(read(inputs.dmt_error)).isel(adhesion_length_over_range=0)
    judged = read(inputs.verdicts)
    materials = judged.material_label.to_series()
    labels = datasets.parameters(judged)["labels"]
    verdicts = judged.verdict.transpose("material", "surface").to_pandas()
    verdicts = verdicts.rename(index=materials, columns=labels)
    experiments = read(inputs.experiments)
    trade = summary.read(inputs.tradeoff)
    of_contact = trade.problem == "contact"
    edges = select_certain(map(read, inputs.edges))
    weak = edges.edge_strength < equivalent_sphere.WEAK
    write_page(
        inputs.template,
        job.output[0],
        fidelity=job.params.fidelity,
        panels=job.params.panels,
        pixels_in_zone=find_pixels(inputs.adhesive_maps),
        claims=read(inputs.claims).drop_dims("source").to_dataframe().reset_index(),
        cells=compare_cells(map(read, inputs.a_v), map(read, inputs.lattices)),
        gamma=read(inputs.gamma),
        dmt=weakest.dropna("range_over_h_rms", subset=["dmt_ratio"]),
        sphere=edges.over_model[weak & (edges.attractive_over_contact >= LEAST_AREA)],
        least_area=LEAST_AREA,
        remaining=compare_remaining(remaining_table.read(inputs.remaining)),
        heights=compare_heights(heights_table.read(inputs.heights)),
        within=WELL_KNOWN,
        least_share=LEAST_SHARE,
        verdicts=verdicts.map(WORDS.__getitem__),
        counts=count_pairs(judged),
        rule=read(inputs.criterion),
        known=[case for case in describe(experiments)["cases"] if case["of"] == "everyday"],
        outcomes=pd.Series(experiments.outcome.values[experiments.tests.values == 1]),
        outcome_words=OUTCOMES,
        settings=summary.tables(trade[of_contact & trade.setting.isin(SHOWN_SETTINGS)]),
    )


def compare_cells(simulated, lattices):
    """a_V of every complete case, its error, and theory on the spectrum of its cell."""
    rows = []
    for ensemble, lattice in zip(simulated, lattices, strict=True):
        surface = datasets.parameters(ensemble)
        cell = (surface["window"], surface["hurst"], surface["magnification"])
        fit = at_load(ensemble).isel(window=0)
        theory = at_load(lattice).isel(window=0).sel(variant=VARIANT).a_v
        error = error_budget.total_error(fit, "a_v_mean")
        rows.append((*cell, fit.a_v_mean, error, theory))
    return sorted(rows, key=lambda row: row[:3])


def compare_remaining(table):
    """Share of predicted works near the simulated ones, and means by energy ratio."""
    table = table[table.separation.notna()]  # others rested at zero load
    works = table.melt(["wide", "predicted"], ["approach", "separation"])
    works = works[works.value > LEAST_SHARE]
    near = abs(works.predicted / works.value - 1) < WELL_KNOWN
    tough = table[table.wide & (table.zone < 0.11)]
    groups = tough.groupby(pd.cut(tough.energy_ratio, ENERGY_RATIOS), observed=True)
    columns = ["energy_ratio", "approach", "separation", "predicted", "pull_off"]
    return {
        "points": table.wide.sum(),
        "near": near.groupby(works.wide).agg(["mean", "size"]),
        "means": groups[columns].mean(),
    }


def compare_heights(table):
    """How models of what remains agree with simulation, for every kind of heights."""
    return [
        {"kind": kind, "model": model}
        | heights_table.compare(heights, model, DEFAULT_SHARE, LEAST_SHARE)
        for kind, heights in table.groupby("kind")
        for model in HEIGHT_MODELS
    ]


if __name__ == "__main__":
    main(start(globals()))
