"""Verdict for every material on every surface, and the same as a page."""

from common.formatting import NOTHING, interval
from common.job import start
from common.templates import write_page
from criteria.classification import find_limits
from criteria.judging import judge, read_surfaces
from criteria.texts import (
    MPA,
    describe_pull_off,
    describe_share,
    describe_threshold,
    show_probability,
    show_stress,
)
from stickiness import datasets
from stickiness.criteria.pair import FULL_SHARE, NOT_JUDGED, WORDS
from stickiness.criteria.registry import CRITERIA, EDGES, REMAINING
from stickiness.criteria.verdict import THEORY_ERROR
from stickiness.remaining.prediction import DEFAULT_SHARE


def main(job):
    surfaces, materials = (
        read_surfaces(job.params.surfaces, job.input.surfaces),
        job.params.materials,
    )
    labels = {name: datasets.parameters(surface)["label"] for name, surface in surfaces.items()}
    dataset = judge(surfaces, {name: surfaces[name] for name in job.params.own}, job.params)
    datasets.write(
        dataset,
        job.output.dataset,
        title="verdicts of the stickiness criteria",
        parameters={"materials": materials, "labels": labels},
    )
    write_page(job.input.template, job.output.table, **describe_page(dataset, materials, labels))


def describe_page(dataset, materials, labels):
    """What the page shows; `labels` are those of the surfaces."""
    return {
        "wanted": DEFAULT_SHARE,
        "full": FULL_SHARE,
        "theory_error": THEORY_ERROR,
        "pairs": [
            (
                materials[material]["label"],
                labels[surface],
                *describe_pair(dataset.sel(material=material, surface=surface)),
            )
            for material in dataset.material.values
            for surface in dataset.surface.values
        ],
        "others": [criterion.label for criterion in find_others()],
        "thresholds": compare_thresholds(dataset, labels),
    }


def describe_pair(pair):
    """Cells of a pair's row after material and surface."""
    if int(pair.verdict) == NOT_JUDGED:
        return WORDS[NOT_JUDGED], *[NOTHING] * 10
    differs = [CRITERIA[str(c)].label for c in pair.criterion.values[pair.disagrees == 1]]
    dmt = pair.margin.sel(criterion="violano") ** (5 / 3)  # h_rms limit over h_rms, as a ratio
    onset = pair.margin.sel(criterion=EDGES)
    return (
        WORDS[int(pair.verdict)],
        describe_share(pair),
        describe_pull_off(pair),
        show_stress(float(pair.modulus_quoted), MPA),
        describe_threshold(pair),
        show_probability(pair),
        show_interval(pair.energy_ratio.min(), pair.energy_ratio.max()),
        show_interval(*find_limits(pair, "margin")),
        show_interval(onset.min(), onset.max()),
        show_interval(dmt.min(), dmt.max()),
        ", ".join(differs) or "none",
    )


def compare_thresholds(dataset, labels):
    """Rows of thresholds by every criterion, one a surface, over all materials and both ends."""
    by = dataset.threshold_by_criterion
    ours = by.sel(criterion=REMAINING)
    length = dataset.work_of_adhesion / ours * 1e9
    columns = [length, *(by.sel(criterion=c.name) / ours for c in find_others())]
    rows = []
    for surface in by.surface.values:
        if ours.sel(surface=surface).isnull().all():  # not judged
            continue
        cells = [column.sel(surface=surface) for column in columns]
        rows.append((labels[surface], *(show_interval(x.min(), x.max()) for x in cells)))
    return rows


def find_others():
    """Criteria with a threshold that are compared with what remains."""
    return [c for c in CRITERIA.values() if c.has_length and c.name != REMAINING]


def show_interval(low, high):
    return interval(float(low), float(high), 2)


if __name__ == "__main__":
    main(start(globals(), "judge"))
