"""What the report says: texts and numbers from datasets, for the template to lay out."""

from __future__ import annotations

import dataclasses
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from common.conventions import at_load
from common.formatting import (
    NOTHING,
    difference,
    interval,
    number,
    percent,
    superscripted,
    with_error,
)
from criteria.materials import describe_modulus
from criteria.texts import say_verdict
from report import provided
from report.provided import own_first
from report.surface_texts import describe_height, describe_line
from report.verdict_texts import WORD_TONES, describe_pair
from stickiness import datasets
from stickiness import error_budget as budget
from stickiness.accuracy import plan
from stickiness.accuracy.error_models import ErrorModels, Surface
from stickiness.accuracy.prediction import Problem, predicted_cost, worst_error
from stickiness.accuracy.quantities import COLUMNS, MODELLED, columns_of
from stickiness.criteria.errata import ERRATA
from stickiness.criteria.pair import FULL_SHARE, NOT_JUDGED, STICKS_FULLY, STICKY, TOUCHES, WORDS
from stickiness.criteria.registry import CRITERIA, REMAINING
from stickiness.remaining.prediction import DEFAULT_SHARE
from tradeoff import summary

Datasets = Mapping[str, xr.Dataset]
Context = dict[str, Any]

RANGE = 0.03  # over h_rms, where attractive areas are compared: amid the fit interval
HEADS = {
    **{name: column.heading for name, column in COLUMNS.items() if column.heading},
    "inverse_kappa_ad_0.0075": "1/κ_ad(0.0075)",
    "inverse_kappa_ad_0.1": "1/κ_ad(0.1)",
    "inverse_kappa_ad_1": "1/κ_ad(1)",
    "inverse_kappa_ad_weak": "1/κ_ad, weakest",
    "area_with_adhesion": "area",
    "memory [MB]": "MB",
}
CLAIM_TONES = {
    "reproduced": "yes",
    "reproduced with a qualification": "partly",
    "not reproduced": "no",
}
QUANTITIES = {
    "area_fraction": COLUMNS["area"].label,
    "mean_gap": COLUMNS["mean_gap"].label,
    "attractive_area": f"attractive area at range {RANGE:g}",
}


@dataclass(frozen=True)
class Results:
    """The datasets that the page is made of, and where they were read from.

    `paths` has those of `claims`, `verdicts` and `experiments`, those of the others by name, and, a
    list for each, those of the data behind the `figures`.
    """

    claims: xr.Dataset
    verdicts: xr.Dataset
    experiments: xr.Dataset
    surfaces: Datasets  # real surfaces by name
    ensembles: Sequence[xr.Dataset]  # one for every case: means over seeds
    answers: Sequence[xr.Dataset]  # values asked for
    comparisons: Sequence[xr.Dataset]  # theory against simulation
    criterion: xr.Dataset  # map of the paper's criterion
    paths: Mapping[str, Any]


def summarise(
    claims: xr.Dataset,
    verdicts: xr.Dataset,
    criterion: xr.Dataset,
    ensembles: Sequence[xr.Dataset],
) -> Context:
    """Numbers of the opening paragraph."""
    grades, counts = count_grades(claims), count_verdicts(verdicts)
    order = [*CLAIM_TONES, *sorted(grades.keys() - CLAIM_TONES.keys())]
    seeds = sorted({len(datasets.parameters(ensemble)["seeds"]) for ensemble in ensembles})
    return {
        "claims": claims.sizes["claim"],
        "graded": [(name, grades[name], claim_tone(name)) for name in order if grades[name]],
        "a_v": number(float(criterion.a_v), 2),
        "a_v_range": interval(float(criterion.a_v_low), float(criterion.a_v_high), 2),
        "load": number(datasets.parameters(criterion)["pressure"]),
        "pairs": verdicts.verdict.size,
        "judged": verdicts.verdict.size - counts[NOT_JUDGED],
        "materials": verdicts.sizes["material"],
        "surfaces": verdicts.sizes["surface"],
        "sticky": counts[STICKY] + counts[STICKS_FULLY],
        "touching": counts[TOUCHES],
        "wanted": percent(DEFAULT_SHARE),
        "full": percent(FULL_SHARE),
        "by_verdict": [
            (WORDS[code], counts[code], WORD_TONES[code])
            for code in reversed(range(len(WORDS)))
            if counts[code]
        ],
        "realisations": interval(seeds[0], seeds[-1]),
    }


def count_grades(claims: xr.Dataset) -> Counter[str]:
    """Number of claims by grade."""
    return Counter(str(verdict) for verdict in claims.verdict.values)


def count_verdicts(verdicts: xr.Dataset) -> Counter[int]:
    """Number of pairs by the code of their verdict."""
    return Counter(verdicts.verdict.values.ravel().tolist())


def claim_tone(verdict: str) -> str:
    """Class of a verdict's mark; `open` for one that is neither yes nor no."""
    return CLAIM_TONES.get(verdict, "open")


def describe_claim(claim: xr.Dataset) -> Context:
    """One claim, with the files behind it; the first is that of its value."""
    verdict = str(claim.verdict.item())
    paths = str(claim.sources.item()).split()
    return {
        "number": int(claim.claim),
        "statement": str(claim.statement.item()),
        "verdict": verdict,
        "grade": list(CLAIM_TONES).index(verdict) if verdict in CLAIM_TONES else "",
        "tone": claim_tone(verdict),
        "quantity": str(claim.quantity.item()),
        "value": float(claim.value),
        "measured": with_error(float(claim.value), float(claim.value_total_error)),
        "errors": list_errors(claim),
        "dominates": name_dominant(claim, "value"),
        "claimed": number(float(claim.claimed), 4),
        "claimed_value": float(claim.claimed),
        "remark": str(claim.remark.item()),
        "origin": paths[0] if paths else "",
        "sources": group_seeds(paths),
    }


def list_errors(claim: xr.Dataset) -> list[str]:
    """Errors of a claim's value by source, the largest first."""
    error = claim.value_error.fillna(np.inf)
    parts = error.where(error > 0, drop=True).sortby(-error)
    return [
        f"{source} {number(value, 2) if np.isfinite(value) else 'not known'}"
        for source, value in zip(parts.source.values, map(float, parts), strict=True)
    ]


def name_dominant(data: xr.Dataset, name: str) -> str:
    """Source of the largest error of a number; one that is not known counts as the largest."""
    source = budget.dominant(data, name)
    if source == "none":
        return NOTHING
    known = np.isfinite(float(data[f"{name}_total_error"]))
    return source if known else f"{source}, not known"


def group_seeds(paths: Sequence[str]) -> list[tuple[str, str]]:
    """Paths with notes; of the seeds of one folder only the first, and how many more."""
    seeds: dict[Path, list[str]] = {}
    for path in paths:
        if Path(path).stem.startswith("seed"):
            seeds.setdefault(Path(path).parent, []).append(path)
    single = [(path, "") for path in paths if not Path(path).stem.startswith("seed")]
    return single + [(found[0], f" and {len(found) - 1} more") for found in seeds.values()]


def describe_errata(claims: xr.Dataset) -> list[Context]:
    """Errata with their recomputed numbers."""
    recomputed = datasets.parameters(claims)["errata"]

    def list_numbers(erratum):
        values = recomputed.get(str(erratum.number), {})
        return [(name.replace("_", " "), number(value, 4)) for name, value in values.items()]

    return [vars(erratum) | {"numbers": list_numbers(erratum)} for erratum in ERRATA]


def arrange_verdicts(verdicts: xr.Dataset, surfaces: Datasets) -> Context:
    """Materials against surfaces, and every pair on its own."""
    labels = labels_of(surfaces)
    materials = datasets.parameters(verdicts)["materials"]
    names = own_first(map(str, verdicts.material.values), provided.MATERIALS)
    on = own_first(map(str, verdicts.surface.values), provided.SURFACES)
    cells = {
        (material, surface): describe_pair(verdicts.sel(material=material, surface=surface))
        | {"key": material, "material": materials[material]["label"]}
        | {"name": surface, "surface": labels[surface]}
        for material in names
        for surface in on
    }
    return {
        "materials": [describe_material(name, materials[name]) for name in names],
        "rows": [
            {
                "name": surface,
                "surface": labels[surface],
                "cells": [cells[material, surface] for material in names],
            }
            for surface in on
        ],
        "pairs": list(cells.values()),
    }


def answer_own(verdicts: xr.Dataset, surfaces: Datasets) -> list[str]:
    """A sentence for every pair of the user's: own materials on own surfaces, or on all.

    Surfaces of the user's without own materials have those that come with the project.
    """
    materials, labels = datasets.parameters(verdicts)["materials"], labels_of(surfaces)
    mine = provided.own(materials, provided.MATERIALS)
    places = provided.own(labels, provided.SURFACES)
    if not mine and not places:
        return []
    return [
        say_verdict(
            f"{materials[material]['label']} on {labels[surface]}",
            verdicts.sel(material=material, surface=surface),
        )
        for surface in places or labels
        for material in mine or materials
    ]


def labels_of(surfaces: Datasets) -> dict[str, str]:
    return {name: datasets.parameters(data)["label"] for name, data in surfaces.items()}


def describe_material(name: str, entry: Mapping[str, Any]) -> Context:
    """Properties of a material as the configuration states them."""
    return {
        "name": name,
        "label": entry["label"],
        "modulus": describe_modulus(entry),
        "work_of_adhesion": superscripted(entry["work_of_adhesion"]),
        "range": entry["range"],
        "source": entry.get("source", ""),
    }


def find_disagreements(verdicts: xr.Dataset, surfaces: Datasets) -> Context:
    """How many pairs of each verdict every criterion contradicts, and which, by direction."""
    labels = labels_of(surfaces)
    materials = datasets.parameters(verdicts)["materials"]
    codes = [code for code in reversed(range(NOT_JUDGED)) if (verdicts.verdict == code).any()]
    sticky = verdicts.margin.where(verdicts.verdict != NOT_JUDGED, 0) > 1  # all say the same there
    ours = sticky.sel(criterion=REMAINING)

    def list_pairs(differs):
        return [
            f"{materials[material]['label']} on {labels[surface]}"
            for material in verdicts.material.values
            for surface in verdicts.surface.values
            if differs.sel(material=material, surface=surface)
        ]

    def count(name):
        against = verdicts.disagrees.sel(criterion=name) == 1
        return [int((against & (verdicts.verdict == code)).sum()) for code in codes]

    totals = [int((verdicts.verdict == code).sum()) for code in codes]
    rows = [
        {
            "criterion": CRITERIA[name].label,
            "counts": count(name),
            "sticky": list_pairs((sticky.sel(criterion=name) & ~ours).any("end")),
            "not_sticky": list_pairs((~sticky.sel(criterion=name) & ours).any("end")),
        }
        for name in map(str, verdicts.criterion.values)
        if name != REMAINING
    ]
    heads = [(WORDS[c], WORD_TONES[c], total) for c, total in zip(codes, totals, strict=True)]
    return {"heads": heads, "rows": rows}


def describe_surface(name: str, surface: xr.Dataset) -> Context:
    """Parameters of a real surface; of a measured one with the errors of the fit."""
    made = datasets.parameters(surface)
    return {
        "name": name,
        "label": made["label"],
        "kind": made["kind"].replace("_", "-"),
        "hurst": with_error(float(surface.hurst), float(surface.hurst_total_error)),
        "c0": describe_line(surface),
        "h_rms": describe_height(surface),
        "q0": number(float(surface.q0)),
        "q1": number(float(surface.q1)),
        "remarks": [text for text in (surface.attrs.get("remarks"), made.get("note")) if text],
        "source": made.get("source", ""),
    }


def describe_budgets(answer: xr.Dataset) -> Context:
    """Error budgets of a case, by source, at the load of the paper's figures."""
    at, made = at_load(answer), datasets.parameters(answer)
    missed = ", not reached" if "missed" in answer.attrs else ""
    return {
        "case": made["case"],
        "load": number(float(at.pressure)),
        "asked": NOTHING if made["accuracy"] is None else percent(made["accuracy"]) + missed,
        "rows": [describe_budget(at.sel(column=name)) for name in at.column.values],
    }


def head_tables(medians: pd.DataFrame) -> list[tuple[list[str], list[list[str]]]]:
    """Tables of the accuracy-cost study with short heads."""
    return [
        ([HEADS.get(name, name.replace("_", " ")) for name in head], lines)
        for head, lines in summary.tables(medians)
    ]


def compare_theory(comparisons: Sequence[xr.Dataset]) -> list[Context]:
    """Relative difference of theory from simulation for every case, at three of its loads."""
    rows = []
    for comparison in comparisons:
        at = comparison.isel(variant=0).interp({"range": RANGE})
        loads = at.pressure.values
        for load in loads[np.unique(np.linspace(0, len(loads) - 1, 5).astype(int)[1:4])]:
            here = at.sel(pressure=load)
            cells = {
                name: difference(
                    float(here[f"{name}_difference"]),
                    float(here[f"{name}_difference_total_error"]),
                )
                for name in QUANTITIES
            }
            case = datasets.parameters(comparison)["case"]
            rows.append({"case": case, "load": number(float(load)), "cells": cells})
    return rows


def describe_budget(at: xr.Dataset) -> Context:
    """Value of a column, its errors relative to it, and the largest of them."""
    value, total = float(at.value), float(at.value_total_error)
    errors = at.value_error / value if value else at.value_error * np.nan
    return {
        "quantity": COLUMNS[str(at.column.item())].label,
        "value": with_error(value, total) if np.isfinite(total) else number(value),
        "errors": {source: percent(float(errors.sel(source=source))) for source in budget.SOURCES},
        "dominates": name_dominant(at, "value"),
    }


def describe_presets(
    laws: ErrorModels,
    fidelities: Mapping[str, Any],
    asked: Mapping[str, Any],
    surface: Mapping[str, Any],
    descriptor_seeds: int,
) -> list[Context]:
    """Settings of every preset, with their predicted cost and errors."""
    given = laws, Surface.of(surface), asked["pressures"]
    rows = []
    for name, error in asked["accuracy"].items():
        chosen = plan.preset(fidelities[name])
        errors = (
            worst_error(Problem(*given, columns_of([quantity]), descriptor_seeds), chosen)[0]
            for quantity in MODELLED
        )
        cost = predicted_cost(Problem(*given, columns_of(MODELLED), descriptor_seeds), chosen)
        rows.append(
            {
                "name": name,
                "asked": percent(error),
                "settings": dataclasses.asdict(chosen),
                "cost": number(cost),
                "errors": [percent(value) for value in errors],
            }
        )
    return rows
