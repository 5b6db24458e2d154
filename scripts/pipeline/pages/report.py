"""What the report says, gathered from datasets as texts; how it looks is the template's part."""

from __future__ import annotations

import dataclasses
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from pipeline.conventions import LOAD
from pipeline.numbers import NOTHING, interval, number, percent, superscripted, with_error
from pipeline.pages.surface_texts import reference_prefactor, rms_height
from pipeline.pages.verdict_texts import EDGES, STICKINESS, STICKINESS_TONES, pair_texts
from pipeline.tradeoff import summary as trade_summary
from pipeline.verdicts.materials import modulus_text
from stickiness.accuracy import plan
from stickiness.accuracy.error_models import ErrorModels, Surface
from stickiness.accuracy.prediction import Problem, predicted_cost, worst_error
from stickiness.accuracy.quantities import COLUMNS, MODELLED, columns_of
from stickiness.core import budget, datasets
from stickiness.criteria.errata import ERRATA
from stickiness.criteria.registry import CRITERIA

Datasets = Mapping[str, xr.Dataset]
Context = dict[str, Any]

RANGE = 0.03  # of the error budget: amid the window of the fits
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


def summary(claims: xr.Dataset, verdicts: xr.Dataset, ensembles: Sequence[xr.Dataset]) -> Context:
    """Numbers of the opening paragraph."""
    graded = Counter(str(verdict) for verdict in claims.verdict.values)
    order = [*CLAIM_TONES, *sorted(graded.keys() - CLAIM_TONES.keys())]
    outside = ~verdicts.simulated.astype(bool).all("end")
    sticky = verdicts.verdict == 2
    seeds = sorted({len(datasets.parameters(ensemble)["seeds"]) for ensemble in ensembles})
    return {
        "claims": claims.sizes["claim"],
        "graded": [(name, graded[name], claim_tone(name)) for name in order if graded[name]],
        "a_v": number(float(verdicts.a_v)),
        "a_v_range": interval(float(verdicts.a_v_low), float(verdicts.a_v_high)),
        "load": number(datasets.parameters(verdicts)["pressure"]),
        "pairs": verdicts.verdict.size,
        "materials": verdicts.sizes["material"],
        "surfaces": verdicts.sizes["surface"],
        "sticky": int(sticky.sum()),
        "judged": [
            (STICKINESS[code], count, STICKINESS_TONES[code])
            for code in (2, 1, 0, 3)
            if (count := int((verdicts.verdict == code).sum()))
        ],
        "outside": int(outside.sum()),
        "sticky_outside": int((sticky & outside).sum()),
        "realisations": interval(seeds[0], seeds[-1]),
    }


def claim_tone(verdict: str) -> str:
    """Class of a verdict's mark; `open` for one that is neither yes nor no."""
    return CLAIM_TONES.get(verdict, "open")


def claim_rows(claims: xr.Dataset) -> list[Context]:
    """One row for every claim."""
    return [claim_row(claims.sel(claim=claim)) for claim in claims.claim.values]


def claim_row(claim: xr.Dataset) -> Context:
    """One claim, with the files it came from and the one of its value, the first of them."""
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
        "errors": error_sources(claim),
        "dominates": dominating(claim, "value"),
        "claimed": number(float(claim.claimed), 4),
        "claimed_value": float(claim.claimed),
        "remark": str(claim.remark.item()),
        "origin": paths[0] if paths else "",
        "sources": grouped(paths),
    }


def error_sources(claim: xr.Dataset) -> str:
    """What makes up the error of a claim's value."""
    error = claim.value_error.fillna(np.inf)
    parts = error.where(error > 0, drop=True).sortby(-error)
    return ", ".join(
        f"{source} {number(value, 2) if np.isfinite(value) else 'not known'}"
        for source, value in zip(parts.source.values, map(float, parts), strict=True)
    )


def dominating(data: xr.Dataset, name: str) -> str:
    """Source of the largest error of a number in words, or which is not known."""
    source = budget.dominant(data, name)
    if source == "none":
        return NOTHING
    known = np.isfinite(float(data[f"{name}_total_error"]))
    return source if known else f"{source}, not known"


def grouped(paths: Sequence[str]) -> list[tuple[str, str]]:
    """Paths with notes; the realisations of one folder are a single entry, by their first."""
    seeds: dict[Path, list[str]] = {}
    for path in paths:
        if Path(path).stem.startswith("seed"):
            seeds.setdefault(Path(path).parent, []).append(path)
    single = [(path, "") for path in paths if not Path(path).stem.startswith("seed")]
    return single + [(found[0], f" and {len(found) - 1} more") for found in seeds.values()]


def errata_rows(claims: xr.Dataset) -> list[Context]:
    """Errata with the numbers that the ledger recomputed."""
    recomputed = datasets.parameters(claims)["errata"]
    return [
        {
            "number": erratum.number,
            "subject": erratum.subject,
            "printed": erratum.printed,
            "correct": erratum.correct,
            "proof": erratum.proof,
            "numbers": [
                (name.replace("_", " "), number(value, 4))
                for name, value in recomputed.get(str(erratum.number), {}).items()
            ],
        }
        for erratum in ERRATA
    ]


def verdict_matrix(verdicts: xr.Dataset, surfaces: Datasets) -> Context:
    """Materials against surfaces, and every pair on its own."""
    labels = surface_labels(surfaces)
    materials = datasets.parameters(verdicts)["materials"]
    names = [str(name) for name in verdicts.material.values]
    cells = {
        (material, surface): pair_texts(verdicts.sel(material=material, surface=surface))
        for material in names
        for surface in map(str, verdicts.surface.values)
    }
    return {
        "materials": [material_row(name, materials[name]) for name in names],
        "rows": [
            {
                "name": surface,
                "surface": labels[surface],
                "cells": [cells[material, surface] for material in names],
            }
            for surface in map(str, verdicts.surface.values)
        ],
        "pairs": [
            {
                "material": materials[material]["label"],
                "name": surface,
                "surface": labels[surface],
                **cell,
            }
            for (material, surface), cell in cells.items()
        ],
    }


def surface_labels(surfaces: Datasets) -> dict[str, str]:
    return {name: datasets.parameters(data)["label"] for name, data in surfaces.items()}


def material_row(name: str, entry: Mapping[str, Any]) -> Context:
    """Properties of a material as the configuration states them."""
    return {
        "name": name,
        "label": entry["label"],
        "modulus": modulus_text(entry),
        "work_of_adhesion": superscripted(entry["work_of_adhesion"]),
        "range": entry["range"],
        "source": entry.get("source", ""),
    }


def disagreements(verdicts: xr.Dataset, surfaces: Datasets) -> list[Context]:
    """Criteria against that of the edges: how many pairs differ, which, and in what direction."""
    labels = surface_labels(surfaces)
    materials = datasets.parameters(verdicts)["materials"]
    sticky = verdicts.margin > 1
    edges = sticky.sel(criterion=EDGES)

    def pairs(differs):
        found = []
        for material in verdicts.material.values:
            row = differs.sel(material=material)
            where = [labels[name] for name in verdicts.surface.values if row.sel(surface=name)]
            if where:
                found.append((materials[material]["label"], where))
        return found

    return [
        {
            "criterion": CRITERIA[name].label,
            "count": int(verdicts.disagrees.sel(criterion=name).sum()),
            "sticky": pairs((sticky.sel(criterion=name) & ~edges).any("end")),
            "not_sticky": pairs((~sticky.sel(criterion=name) & edges).any("end")),
        }
        for name in map(str, verdicts.criterion.values)
        if name != EDGES
    ]


def surface_rows(surfaces: Datasets) -> list[Context]:
    """Parameters of the real surfaces."""
    return [{"name": name, **surface_row(data)} for name, data in surfaces.items()]


def surface_row(surface: xr.Dataset) -> Context:
    """What is known of one surface; of a measured one with the errors of the fit."""
    made = datasets.parameters(surface)
    error = float(surface.hurst_total_error)
    return {
        "label": made["label"],
        "kind": made["kind"].replace("_", "-"),
        "hurst": with_error(float(surface.hurst), error),
        "c0": reference_prefactor(surface),
        "h_rms": rms_height(surface),
        "q0": number(float(surface.q0)),
        "q1": number(float(surface.q1)),
        "remarks": [text for text in (surface.attrs.get("remarks"), made.get("note")) if text],
        "source": made.get("source", ""),
    }


def error_budgets(answers: Sequence[xr.Dataset]) -> list[Context]:
    """Error budget of every case, by source, at the load next to `LOAD`."""
    budgets = []
    for answer in answers:
        at, made = answer.sel(pressure=LOAD, method="nearest"), datasets.parameters(answer)
        missed = ", not reached" if "missed" in answer.attrs else ""
        budgets.append(
            {
                "case": made["case"],
                "load": number(float(at.pressure)),
                "asked": NOTHING
                if made["accuracy"] is None
                else percent(made["accuracy"]) + missed,
                "rows": [budget_row(at.sel(column=name)) for name in at.column.values],
            }
        )
    return budgets


def trade_tables(medians: pd.DataFrame) -> list[tuple[list[str], list[list[str]]]]:
    """Tables of what accuracy costs under heads that fit a page."""
    return [
        ([HEADS.get(name, name.replace("_", " ")) for name in head], lines)
        for head, lines in trade_summary.tables(medians)
    ]


def theory_rows(comparisons: Sequence[xr.Dataset]) -> list[Context]:
    """Difference of theory from simulation for every case, at three of its loads."""
    rows = []
    for comparison in comparisons:
        at = comparison.isel(variant=0).interp({"range": RANGE})
        loads = at.pressure.values
        for load in loads[np.unique(np.linspace(0, len(loads) - 1, 5).astype(int)[1:4])]:
            here = at.sel(pressure=load)
            cells = {
                name: f"{float(here[f'{name}_difference']):+.1%} ± "
                f"{float(here[f'{name}_difference_total_error']):.1%}"
                for name in QUANTITIES
            }
            case = datasets.parameters(comparison)["case"]
            rows.append({"case": case, "load": number(float(load)), "cells": cells})
    return rows


def budget_row(at: xr.Dataset) -> Context:
    """Value of a column, its errors relative to it, and the largest of them."""
    value, total = float(at.value), float(at.value_total_error)
    errors = at.value_error / value if value else at.value_error * np.nan
    return {
        "quantity": COLUMNS[str(at.column.item())].label,
        "value": with_error(value, total) if np.isfinite(total) else number(value),
        "errors": {source: percent(float(errors.sel(source=source))) for source in budget.SOURCES},
        "dominates": dominating(at, "value"),
    }


def preset_rows(
    laws: ErrorModels,
    fidelities: Mapping[str, Any],
    asked: Mapping[str, Any],
    surface: Mapping[str, Any],
    descriptor_seeds: int,
) -> list[Context]:
    """Settings of every preset, what they were measured to cost and to err by."""
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
