"""The report: one self-contained page of figures, claims, verdicts, errors and run times."""

import dataclasses
from collections import Counter
from pathlib import Path

import numpy as np
import pandas as pd

from common import provided
from common.conventions import at_load
from common.job import start
from criteria.materials import describe_modulus
from experiments import outcomes as experiments
from report import interactive, pages
from report.table_rows import TONES, describe_pair, describe_surface
from stickiness import datasets, error_budget
from stickiness.accuracy import plan
from stickiness.accuracy.error_models import Surface, read_models
from stickiness.accuracy.quantities import COLUMNS, MODELLED, columns_of
from stickiness.accuracy.settings import Problem, predicted_cost, worst_error
from stickiness.criteria.pair import FULL_SHARE, NOT_JUDGED, WORDS
from stickiness.criteria.registry import CRITERIA, REMAINING
from stickiness.remaining.prediction import DEFAULT_SHARE
from tradeoff import summary

CLAIM_TONES = {
    "reproduced": "yes",
    "reproduced with a qualification": "partly",
    "not reproduced": "no",
}
COMPARED_RANGE = 0.03  # over h_rms, where attractive areas are compared: amid the fit interval
COMPARED = {
    "area_fraction": COLUMNS["area"].label,
    "mean_gap": COLUMNS["mean_gap"].label,
    "attractive_area": f"attractive area at range {COMPARED_RANGE:g}",
}
HEADS = {
    **{name: column.heading for name, column in COLUMNS.items() if column.heading},
    "inverse_kappa_ad_0.0075": "1/κ_ad(0.0075)",
    "inverse_kappa_ad_0.1": "1/κ_ad(0.1)",
    "inverse_kappa_ad_1": "1/κ_ad(1)",
    "inverse_kappa_ad_weak": "1/κ_ad, weakest",
    "area_with_adhesion": "area",
    "memory [MB]": "MB",
}


def main(job):
    inputs, params = job.input, job.params
    claims = datasets.read(inputs.claims, ["value", "claimed", "verdict", "sources"])
    verdicts = datasets.read(inputs.verdicts, ["remaining", "verdict", "margin", "disagrees"])
    tested = datasets.read(inputs.experiments, ["outcome", "criterion_outcome"])
    surfaces, ensembles, comparisons, answers = (
        {Path(path).stem: datasets.read(path) for path in inputs[kind]}
        for kind in ("surfaces", "ensembles", "comparisons", "answers")
    )
    pairs = arrange_pairs(verdicts, surfaces)
    pages.write_page(
        inputs.template,
        job.output[0],
        fidelity=params.fidelity,
        files={
            kind: path if isinstance(path, str) else {Path(one).stem: one for one in path}
            for kind, path in inputs.items()
        },
        figures=[
            pages.embed_figure(*of) for of in zip(inputs.figures, inputs.captions, strict=True)
        ],
        figure_sources=params.figure_sources,
        criterion=datasets.read(inputs.criterion, ["a_v"]),
        claims=describe_claims(claims),
        grades=count_grades(claims),
        recomputed=datasets.parameters(claims)["errata"],
        infinity=np.inf,
        wanted=DEFAULT_SHARE,
        full=FULL_SHARE,
        words=count_words(verdicts),
        local_word=WORDS[1],
        pairs=pairs,
        materials=describe_materials(verdicts),
        mine=choose_mine(pairs),
        library=interactive.library(),
        every_pair=interactive.embed(interactive.draw_pairs(verdicts, pairs)),
        disagreements=find_disagreements(verdicts, pairs),
        experiments=experiments.describe(tested),
        experiments_figure=pages.embed_figure(
            inputs.experiments_figure, inputs.experiments_caption
        ),
        surfaces={
            name: {
                "data": surface,
                "made": datasets.parameters(surface),
                "sizes": describe_surface(surface),
            }
            for name, surface in surfaces.items()
        },
        budgets=list(map(describe_budgets, answers.values())),
        sources=error_budget.SOURCES,
        trade_figure=pages.embed_figure(inputs.trade_figure, inputs.trade_caption),
        trade_tables=head_tables(summary.read(inputs.trade)),
        presets=describe_presets(read_models(inputs.laws), **params.presets),
        modelled=[COLUMNS[n].label if n in COLUMNS else n.replace("_", " ") for n in MODELLED],
        comparisons=compare_theory(comparisons.values()),
        compared=COMPARED,
        run_times=read_run_times(params.benchmarks),
        versions=list_versions([claims, verdicts, tested, *surfaces.values(), *ensembles.values()]),
        ensembles=list(map(datasets.parameters, ensembles.values())),
    )


def describe_claims(claims):
    """Every claim with its errors, the largest first, and the files behind it."""
    rows = []
    for number in claims.claim.values:
        claim = claims.sel(claim=number)
        grade, paths = str(claim.verdict.item()), str(claim.sources.item()).split()
        errors = claim.value_error.fillna(np.inf)
        errors = errors.where(errors > 0, drop=True).sortby(-errors)
        rows.append(
            {
                "number": int(number),
                "statement": str(claim.statement.item()),
                "grade": grade,
                "order": list(CLAIM_TONES).index(grade) if grade in CLAIM_TONES else "",
                "tone": CLAIM_TONES.get(grade, "open"),
                "quantity": str(claim.quantity.item()),
                "value": float(claim.value),
                "error": float(claim.value_total_error),
                "errors": dict(zip(errors.source.values, map(float, errors), strict=True)),
                "dominant": name_dominant(claim),
                "claimed": float(claim.claimed),
                "remark": str(claim.remark.item()),
                "files": group_seeds(paths),
            }
        )
    return rows


def name_dominant(data):
    """Source of the largest error of the value; one that is not known counts as the largest."""
    source = error_budget.dominant(data, "value")
    known = source == "none" or np.isfinite(float(data.value_total_error))
    return "–" if source == "none" else source if known else f"{source}, not known"


def group_seeds(paths):
    """Paths and how many more they stand for: of the seeds of a folder the first stands for all."""
    folders = Counter(Path(path).parent for path in paths if Path(path).stem.startswith("seed"))
    first = {}
    for path in paths:
        seed = Path(path).stem.startswith("seed")
        first.setdefault(Path(path).parent if seed else path, path)
    return sorted(
        ((path, folders.get(key, 1) - 1) for key, path in first.items()), key=lambda of: of[1] > 0
    )


def count_grades(claims):
    """Claims by grade, as grade, count and tone."""
    counts = Counter(map(str, claims.verdict.values))
    order = [*CLAIM_TONES, *sorted(counts.keys() - CLAIM_TONES.keys())]
    return [(name, counts[name], CLAIM_TONES.get(name, "open")) for name in order if counts[name]]


def count_words(verdicts):
    """Pairs by verdict, from sticky to not sticky, as word, count and tone."""
    codes = Counter(verdicts.verdict.values.ravel().tolist())
    order = [*reversed(range(NOT_JUDGED)), NOT_JUDGED]
    return [(WORDS[code], codes[code], TONES[code]) for code in order if codes[code]]


def arrange_pairs(verdicts, surfaces):
    """Rows of all pairs, material by material, those of the user first."""
    materials = datasets.parameters(verdicts)["materials"]
    return [
        describe_pair(verdicts.sel(material=material, surface=surface))
        | {"key": material, "material": materials[material]["label"]}
        | {"name": surface, "surface": datasets.parameters(surfaces[surface])["label"]}
        for material in provided.user_defined_first(verdicts.material.values, provided.MATERIALS)
        for surface in provided.user_defined_first(verdicts.surface.values, provided.SURFACES)
    ]


def choose_mine(pairs):
    """Pairs of the user's materials on the user's surfaces, or on all where one kind is missing."""
    mine = {
        kind: [pair for pair in pairs if pair[key] not in known]
        for kind, key, known in (
            ("material", "key", provided.MATERIALS),
            ("surface", "name", provided.SURFACES),
        )
    }
    both = [pair for pair in mine["material"] if pair in mine["surface"]]
    return both or mine["material"] or mine["surface"]


def describe_materials(verdicts):
    """Entries of the materials with the modulus as text, those of the user first."""
    entries = datasets.parameters(verdicts)["materials"]
    order = provided.user_defined_first(map(str, verdicts.material.values), provided.MATERIALS)
    return [entries[name] | {"modulus": describe_modulus(entries[name])} for name in order]


def find_disagreements(verdicts, pairs):
    """Pairs on which each criterion contradicts the verdict: their number by word, and which."""
    words = [word for word, _, _ in count_words(verdicts)]
    labels = {
        (pair["key"], pair["name"]): f"{pair['material']} on {pair['surface']}" for pair in pairs
    }
    sticky = verdicts.margin > 1
    ours = sticky.sel(criterion=REMAINING)

    def list_pairs(chosen):
        return [
            label
            for (material, surface), label in labels.items()
            if chosen.sel(material=material, surface=surface)
        ]

    rows = []
    for name in map(str, verdicts.criterion.values):
        if name == REMAINING:
            continue
        says, against = sticky.sel(criterion=name), verdicts.disagrees.sel(criterion=name) == 1
        rows.append(
            {
                "criterion": CRITERIA[name].label,
                "counts": {
                    word: int((against & (verdicts.verdict == WORDS.index(word))).sum())
                    for word in words
                },
                "sticky": list_pairs((says & ~ours).any("end")),
                "not_sticky": list_pairs((~says & ours).any("end")),
            }
        )
    return rows


def describe_budgets(answer):
    """Error budget of every column of a case at the load of the paper's figures."""
    at, made = at_load(answer), datasets.parameters(answer)
    rows = []
    for name in at.column.values:
        one = at.sel(column=name)
        relative = one.value_error / one.value if float(one.value) else one.value_error * np.nan
        rows.append(
            {
                "quantity": COLUMNS[str(name)].label,
                "value": float(one.value),
                "error": float(one.value_total_error),
                "errors": {
                    source: float(relative.sel(source=source)) for source in error_budget.SOURCES
                },
                "dominant": name_dominant(one),
            }
        )
    return {
        "case": made["case"],
        "load": float(at.pressure),
        "accuracy": made["accuracy"],
        "missed": "missed" in answer.attrs,
        "rows": rows,
    }


def head_tables(medians):
    """Tables of the accuracy-cost study with short heads."""
    return [
        ([HEADS.get(name, name.replace("_", " ")) for name in head], lines)
        for head, lines in summary.tables(medians)
    ]


def describe_presets(models, fidelities, presets, surface, descriptor_seeds):
    """Settings of every preset, with their predicted cost and errors."""
    given = models, Surface.of(surface), presets["pressures"]
    rows = []
    for name, error in presets["accuracy"].items():
        chosen = plan.preset(fidelities[name])
        problems = [Problem(*given, columns_of([one]), descriptor_seeds) for one in MODELLED]
        whole = Problem(*given, columns_of(MODELLED), descriptor_seeds)
        rows.append(
            {
                "name": name,
                "asked": error,
                "settings": dataclasses.asdict(chosen),
                "cost": predicted_cost(whole, chosen),
                "errors": [worst_error(problem, chosen)[0] for problem in problems],
            }
        )
    return rows


def compare_theory(comparisons):
    """Relative difference of theory from simulation for every case, at three of its loads."""
    rows = []
    for comparison in comparisons:
        at = comparison.isel(variant=0).interp({"range": COMPARED_RANGE})
        loads = at.pressure.values
        for load in loads[np.unique(np.linspace(0, len(loads) - 1, 5).astype(int)[1:4])]:
            here = at.sel(pressure=load)
            found = {
                name: (
                    float(here[f"{name}_difference"]),
                    float(here[f"{name}_difference_total_error"]),
                )
                for name in COMPARED
            }
            case = datasets.parameters(comparison)["case"]
            rows.append({"case": case, "load": float(load), "differences": found})
    return rows


def read_run_times(folder):
    """Jobs, seconds, processor seconds and memory [MB] of each rule, from Snakemake's benchmarks.

    The report's benchmark, if there is one, is of an earlier run and left out. So are numbers of
    runs that were too short to tell.
    """
    runs = [
        pd.read_csv(path, sep="\t", na_values=["-"]).assign(
            rule=path.relative_to(folder).parts[0].removesuffix(".tsv")
        )
        for path in sorted(Path(folder).rglob("*.tsv"))
    ]
    if not runs:
        return pd.DataFrame(columns=["jobs", "total", "processor", "longest", "memory"])
    table = pd.concat(runs).query("rule != 'write_report'")
    numbers = ["s", "cpu_time", "max_rss"]
    table[numbers] = table[numbers].apply(pd.to_numeric, errors="coerce")
    return (
        table.groupby("rule")
        .agg(
            jobs=("s", "size"),
            total=("s", "sum"),
            processor=("cpu_time", "sum"),
            longest=("s", "max"),
            memory=("max_rss", "max"),
        )
        .sort_values("total", ascending=False)
    )


def list_versions(files):
    """Versions of codes that the files record; several where they differ."""
    versions = {}
    for file in files:
        for name, value in file.attrs.items():
            if name.startswith("version_"):
                versions.setdefault(name.removeprefix("version_"), set()).add(str(value))
    return {name: sorted(found) for name, found in sorted(versions.items())}


if __name__ == "__main__":
    main(start(globals(), "write_report"))
