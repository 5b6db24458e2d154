"""The report: one self-contained page of figures, claims, verdicts and errors."""

from collections import Counter
from pathlib import Path

import numpy as np
import pandas as pd

from common import experiment_outcomes as experiments
from common import heights_table, remaining_models
from common.job import start
from common.pairs import arrange_pairs, count_pairs
from common.paper import at_load
from report import pages
from report.pages import find_pixels
from stickiness import datasets, error_budget
from stickiness.accuracy import plan
from stickiness.accuracy.error_models import Surface, read_models
from stickiness.accuracy.quantities import COLUMNS, MODELLED, columns_of
from stickiness.accuracy.settings import Problem, predicted_cost, worst_error
from stickiness.criteria.pair import FULL_SHARE, NOT_JUDGED, TOUCHES, WORDS
from stickiness.criteria.registry import CRITERIA, REMAINING
from stickiness.pages import interactive
from stickiness.pages.rendering import write_page
from stickiness.pages.rows import TONES, describe_surface
from stickiness.remaining.trial_states import DEFAULT_SHARE

CLAIM_TONES = {
    "reproduced": "yes",
    "reproduced with a qualification": "partly",
    "not reproduced": "no",
    "not decided": "open",
    "not checked: the configuration differs": "differs",
}
COMPARED_RANGE = 0.03  # over h_rms, where attractive areas are compared: amid the fit interval
WORD_TONES = dict(zip(WORDS[NOT_JUDGED - 1 :: -1], TONES[NOT_JUDGED - 1 :: -1], strict=True))


def main(job):
    inputs = job.input
    params = job.params
    claims = datasets.read(inputs.claims, ["value", "claimed", "verdict", "difference", "sources"])
    verdicts = datasets.read(inputs.verdicts, ["remaining", "verdict", "margin", "disagrees"])
    tested = datasets.read(inputs.experiments, ["outcome", "criterion_outcome"])
    files = {
        kind: path if isinstance(path, str) else {Path(each).stem: each for each in path}
        for kind, path in inputs.items()
    }
    surfaces, ensembles, comparisons, answers = (
        {name: datasets.read(path) for name, path in files[kind].items()}
        for kind in ("surfaces", "ensembles", "comparisons", "answers")
    )
    surfaces = {name: data for name, data in surfaces.items() if "unread" not in data.attrs}
    materials = params.materials
    labels = {name: entry["label"] for name, entry in params.surfaces.items()}
    pairs = arrange_pairs(verdicts, labels)
    embed = pages.embed_figure
    write_page(
        inputs.template,
        job.output[0],
        fidelity=params.fidelity,
        files=files,
        figures=list(map(embed, inputs.figures, inputs.captions)),
        figure_sources=params.figure_sources,
        panels=params.panels,
        pixels_in_zone=find_pixels(inputs.adhesive_maps),
        criterion=datasets.read(inputs.criterion, ["a_v"]),
        claims=describe_claims(claims),
        grades=count(map(str, claims.verdict.values), CLAIM_TONES),
        recomputed=datasets.parameters(claims)["errata"],
        wanted=DEFAULT_SHARE,
        full=FULL_SHARE,
        kept=count_pairs(verdicts),
        words=count((pair["word"] for pair in pairs), WORD_TONES),
        local_word=WORDS[TOUCHES],
        pairs=pairs,
        materials=list({pair["key"]: pair | materials[pair["key"]] for pair in pairs}.values()),
        library=interactive.library(),
        every_pair=interactive.embed(interactive.draw_pairs(pairs)),
        disagreements=find_disagreements(verdicts),
        experiments=experiments.describe(tested),
        experiments_figure=embed(inputs.experiments_figure, inputs.experiments_caption),
        surfaces=surfaces,
        described={name: params.surfaces[name] for name in surfaces},
        sizes={name: describe_surface(surface) for name, surface in surfaces.items()},
        answers={name: at_load(answer) for name, answer in answers.items()},
        comparisons={name: compare_theory(data) for name, data in comparisons.items()},
        compared_range=COMPARED_RANGE,
        presets=describe_presets(read_models(inputs.laws), **params.presets),
        columns=COLUMNS,
        dominant_source=error_budget.dominant,
        remaining_models=remaining_models.condense(heights_table.read(inputs.heights)),
        least_share=remaining_models.LEAST_SHARE,
        trade_figure=embed(inputs.trade_figure, inputs.trade_caption),
        versions=list_versions([claims, verdicts, tested, *surfaces.values(), *ensembles.values()]),
        ensembles=list(map(datasets.parameters, ensembles.values())),
    )


def describe_claims(claims):
    """Every claim with its errors, the largest first, and the files behind it."""
    # An error that is not known counts as the largest.
    errors = claims.value_error.fillna(np.inf).transpose("claim", "source").to_pandas()
    rows = claims.drop_dims("source").to_dataframe().reset_index().to_dict("records")
    for row in rows:
        by_source = errors.loc[row["claim"]].sort_values(ascending=False, kind="stable")
        row["errors"] = by_source[by_source > 0].to_dict()
        row["tone"] = CLAIM_TONES.get(row["verdict"], "open")
        row["files"] = group_seeds(row["sources"].split())
    return rows


def group_seeds(paths):
    """Paths and how many more they stand for: of the seeds of a folder the first stands for all."""
    groups = {}
    for path in paths:
        seed = Path(path).stem.startswith("seed")
        groups.setdefault(Path(path).parent if seed else path, []).append(path)
    counted = [(group[0], len(group) - 1) for group in groups.values()]
    return sorted(counted, key=lambda group: group[1] > 0)


def count(words, tones):
    """Words with their number and tone, in the order of `tones`; other words come last."""
    counts = Counter(words)
    order = [*tones, *sorted(counts.keys() - tones.keys())]
    return [(word, counts[word], tones.get(word, "open")) for word in order if counts[word]]


def describe_presets(models, fidelities, presets, surface, descriptor_seeds):
    """Settings of every preset, with their predicted cost and errors."""

    def pose(names):
        return Problem(
            models,
            Surface.of(surface),
            presets["pressures"],
            columns_of(names),
            descriptor_seeds,
        )

    whole = pose(MODELLED)
    single = {name: pose([name]) for name in MODELLED}
    rows = []
    for name, error in presets["accuracy"].items():
        chosen = plan.preset(fidelities[name])
        errors = {name: worst_error(problem, chosen)[0] for name, problem in single.items()}
        row = {"name": name, "asked": error, "settings": vars(chosen), "errors": errors}
        rows.append(row | {"cost": predicted_cost(whole, chosen)})
    return rows


def compare_theory(comparison):
    """Relative difference of theory from simulation [%] at three of the loads."""
    some = np.unique(np.linspace(0, comparison.sizes["pressure"] - 1, 5).astype(int)[1:4])
    return 100 * comparison.isel(variant=0, pressure=some).interp({"range": COMPARED_RANGE})


def find_disagreements(verdicts):
    """Number of pairs, by word, on which each criterion contradicts the verdict."""
    words = np.array(WORDS)[verdicts.verdict.values.astype(int)]
    others = [name for name in map(str, verdicts.criterion.values) if name != REMAINING]
    return {
        CRITERIA[name].label: Counter(words[verdicts.disagrees.sel(criterion=name) == 1].tolist())
        for name in others
    }


def list_versions(files):
    """Versions of codes that the files record; several where they differ."""
    recorded = pd.DataFrame([file.attrs for file in files]).filter(regex="^version_")
    versions = recorded.rename(columns=lambda name: name.removeprefix("version_"))
    return {name: sorted(set(versions[name].dropna())) for name in sorted(versions)}


if __name__ == "__main__":
    main(start(globals()))
