"""Verdict for every material on every surface, and the same as a page."""

from itertools import product

from common import verdicts as texts
from common.formatting import NOTHING, interval
from common.job import start
from common.materials import find_doubts
from common.templates import write_page
from common.verdicts import find_limits
from criteria.verdicts import judge_materials, read_surfaces
from stickiness import datasets
from stickiness.criteria.a_v_table import THEORY_ERROR
from stickiness.criteria.pair import FULL_SHARE, NOT_JUDGED, WORDS
from stickiness.criteria.registry import CRITERIA, EDGES, REMAINING
from stickiness.remaining.prediction import DEFAULT_SHARE


def main(job):
    materials, labels = job.params.materials, job.params.labels
    surfaces = read_surfaces(labels, job.input.surfaces)
    material_surfaces = {name: surfaces[name] for name in job.params.material_surfaces}
    dataset = judge_materials(surfaces, material_surfaces, job.params)
    title = "verdicts of the stickiness criteria"
    parameters = {"materials": materials, "labels": labels}
    datasets.write(dataset, job.output.dataset, title=title, parameters=parameters)
    write_page(job.input.template, job.output.table, **describe_page(dataset, materials, labels))


def describe_page(dataset, materials, labels):
    """What the page shows; `labels` are those of the surfaces."""
    others = [c for c in CRITERIA.values() if c.has_length and c.name != REMAINING]
    return {
        "wanted": DEFAULT_SHARE,
        "full": FULL_SHARE,
        "theory_error": THEORY_ERROR,
        "doubts": [doubt for entry in materials.values() for doubt in find_doubts(entry)],
        "pairs": [
            (materials[m]["label"], labels[s], *describe_pair(dataset.sel(material=m, surface=s)))
            for m, s in product(dataset.material.values, dataset.surface.values)
        ],
        "others": [criterion.label for criterion in others],
        "thresholds": compare_thresholds(dataset, others, labels),
    }


def describe_pair(pair):
    """Cells of a pair's row after material and surface."""
    if int(pair.verdict) == NOT_JUDGED:
        return WORDS[NOT_JUDGED], *[NOTHING] * 10
    differs = [CRITERIA[str(c)].label for c in pair.criterion.values[pair.disagrees == 1]]
    dmt = pair.margin.sel(criterion="violano") ** (5 / 3)  # h_rms limit over h_rms, as a ratio
    return (
        f"{WORDS[int(pair.verdict)]} {texts.describe_moment(pair)}".strip(),
        texts.describe_share(pair),
        texts.describe_pull_off(pair),
        texts.show_stress(float(pair.modulus_quoted), texts.MPA),
        texts.describe_threshold(pair),
        texts.show_probability(pair),
        show_range(pair.energy_ratio),
        interval(*map(float, find_limits(pair, "margin")), 2),
        show_range(pair.margin.sel(criterion=EDGES)),
        show_range(dmt),
        ", ".join(differs) or "none",
    )


def compare_thresholds(dataset, others, labels):
    """Rows of thresholds by every criterion, one a surface, over all materials and both ends."""
    by = dataset.threshold_by_criterion
    ours = by.sel(criterion=REMAINING)
    length = dataset.work_of_adhesion / ours * 1e9
    columns = [length, *(by.sel(criterion=criterion.name) / ours for criterion in others)]
    return [
        (labels[surface], *(show_range(column.sel(surface=surface)) for column in columns))
        for surface in by.surface.values
        if ours.sel(surface=surface).notnull().any()  # else it is not judged
    ]


def show_range(values):
    return interval(float(values.min()), float(values.max()), 2)


if __name__ == "__main__":
    main(start(globals(), "judge"))
