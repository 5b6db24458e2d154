"""What the report says, gathered from datasets as texts; how it looks is the template's part."""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from _materials import modulus_text
from _model import LOAD
from _numbers import NOTHING, interval, number, percent, quantity, superscripted, with_error
from stickiness import datasets
from stickiness.errata import ERRATA

Datasets = Mapping[str, xr.Dataset]
Context = dict[str, Any]

RANGE = 0.03  # of the error budget: amid the window of the fits
EDGES = "edge_adhesion"
STICKINESS = ("not sticky", "depends", "sticky", "undecided")
STICKINESS_TONES = ("no", "partly", "yes", "open")
CLAIM_TONES = {
    "reproduced": "yes",
    "reproduced with a qualification": "partly",
    "not reproduced": "no",
}
CRITERIA = {
    "edge_adhesion": "edges of contact",
    "violano": "derived criterion, DMT limit",
    "violano_constant": "derived, constant a_V",
    "violano_printed": "criterion as printed, 9/4",
    "pastewka_robbins": "Pastewka–Robbins",
    "fuller_tabor": "Fuller–Tabor",
    "bearing_area": "bearing area (BAM)",
    "persson_tosatti": "Persson–Tosatti",
    "dahlquist": "Dahlquist",
}
QUANTITIES = {
    "area_fraction": "contact area",
    "mean_gap": "mean gap",
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
        "depends": int((verdicts.verdict == 1).sum()),
        "not_sticky": int((verdicts.verdict == 0).sum()),
        "undecided": int((verdicts.verdict == 3).sum()),
        "outside": int(outside.sum()),
        "sticky_outside": int((sticky & outside).sum()),
        "realisations": interval(seeds[0], seeds[-1]),
    }


def claim_tone(verdict: str) -> str:
    """Class of a verdict's mark; `open` for one that is neither yes nor no."""
    return CLAIM_TONES.get(verdict, "open")


def claims_table(claims: xr.Dataset) -> Context:
    """One row for every claim, with its files relative to the folder that holds them all."""
    paths = {
        int(claim): str(claims.sources.sel(claim=claim).item()).split()
        for claim in claims.claim.values
    }
    every = [path for sources in paths.values() for path in sources]
    folder = os.path.commonpath([*map(os.path.dirname, every)]) if every else ""
    return {
        "folder": folder,
        "rows": [
            claim_row(claims.sel(claim=claim), [os.path.relpath(p, folder or ".") for p in sources])
            for claim, sources in paths.items()
        ],
    }


def claim_row(claim: xr.Dataset, sources: Sequence[str]) -> Context:
    """One claim."""
    verdict = str(claim.verdict.item())
    return {
        "number": int(claim.claim),
        "statement": str(claim.statement.item()),
        "verdict": verdict,
        "tone": claim_tone(verdict),
        "quantity": str(claim.quantity.item()),
        "measured": with_error(float(claim.value), float(claim.uncertainty)),
        "claimed": number(float(claim.claimed), 4),
        "remark": str(claim.remark.item()),
        "sources": grouped(sources) or ["closed form"],
    }


def grouped(paths: Sequence[str]) -> list[str]:
    """Paths, with the realisations of one folder as a single entry."""
    seeds = Counter(str(Path(path).parent) for path in paths if Path(path).stem.startswith("seed"))
    single = [path for path in paths if not Path(path).stem.startswith("seed")]
    return single + [f"{folder}/seed*.nc ({count} files)" for folder, count in seeds.items()]


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
    """Materials against surfaces."""
    labels = surface_labels(surfaces)
    materials = datasets.parameters(verdicts)["materials"]
    return {
        "materials": [material_row(name, materials[name]) for name in verdicts.material.values],
        "rows": [
            {
                "surface": labels[surface],
                "cells": [
                    verdict_cell(verdicts.sel(material=material, surface=surface))
                    for material in verdicts.material.values
                ],
            }
            for surface in verdicts.surface.values
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


def verdict_cell(pair: xr.Dataset) -> Context:
    """Verdict on one pair, with its margin and modulus threshold from rough to smooth end."""
    ends = ("rough", "smooth")
    margins = [float(pair.margin.sel(criterion=EDGES, end=end)) for end in ends]
    thresholds = [float(pair.modulus_threshold.sel(end=end)) for end in ends]
    return {
        "verdict": STICKINESS[int(pair.verdict)],
        "tone": STICKINESS_TONES[int(pair.verdict)],
        "outside": not bool(pair.simulated.all()),
        "margin": interval(*margins, digits=2),
        "threshold": quantity(*thresholds, "Pa", digits=2),
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
            "criterion": CRITERIA.get(name, name.replace("_", " ")),
            "count": int(verdicts.disagrees.sel(criterion=name).sum()),
            "sticky": pairs((sticky.sel(criterion=name) & ~edges).any("end")),
            "not_sticky": pairs((~sticky.sel(criterion=name) & edges).any("end")),
        }
        for name in map(str, verdicts.criterion.values)
        if name != EDGES
    ]


def surface_rows(surfaces: Datasets) -> list[Context]:
    """Parameters of the real surfaces."""
    return [surface_row(data) for data in surfaces.values()]


def surface_row(surface: xr.Dataset) -> Context:
    """What is known of one surface; of a measured one with the errors of the fit."""
    made = datasets.parameters(surface)
    ends = ("smooth", "rough")
    error = float(surface.hurst_error) if "hurst_error" in surface else np.nan
    return {
        "label": made["label"],
        "kind": made["kind"].replace("_", "-"),
        "hurst": with_error(float(surface.hurst), error),
        "c0": reference_prefactor(surface),
        "h_rms": quantity(*(float(surface.h_rms.sel(end=end)) for end in ends), "m"),
        "q0": number(float(surface.q0)),
        "q1": number(float(surface.q1)),
        "remarks": [text for text in (surface.attrs.get("remarks"), made.get("note")) if text],
        "source": made.get("source", ""),
    }


def reference_prefactor(surface: xr.Dataset) -> str:
    """C0 of the line with H = 0.8: fitted, or the highest such line that the spectrum touches."""
    if "C0_reference" in surface:
        return with_error(float(surface.C0_reference), float(surface.C0_reference_error))
    upper = surface.C0_reference_upper
    bound = "" if np.isclose(float(surface.hurst), 0.8) else "≤ "
    return bound + interval(*(float(upper.sel(end=end)) for end in ("smooth", "rough")), digits=2)


def error_budgets(ensembles: Sequence[xr.Dataset]) -> list[Context]:
    """Error budget of every ensemble at the load next to `LOAD`."""
    budgets = []
    for ensemble in ensembles:
        at = ensemble.sel(pressure=LOAD, method="nearest").interp({"range": RANGE})
        solver = solver_errors(at)
        budgets.append(
            {
                "case": datasets.parameters(ensemble)["case"],
                "load": number(float(at.pressure)),
                "rows": [budget_row(at, name, solver[name]) for name in QUANTITIES],
            }
        )
    return budgets


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
                f"{float(here[f'{name}_difference_error']):.1%}"
                for name in QUANTITIES
            }
            case = datasets.parameters(comparison)["case"]
            rows.append({"case": case, "load": number(float(load)), "cells": cells})
    return rows


def solver_errors(at: xr.Dataset) -> dict[str, float]:
    """Errors that the solver's residual causes, at one load and range.

    The residual r is the largest violation of the contact conditions, a length. It shifts the mean
    gap by at most r. Areas change by the strip of gaps below r along the edge of contact, which
    is estimated from the attractive area A at the range by the 2/3 law, A (r/range)^(2/3); what
    r changes at the outer end of the range is of higher order.
    """
    residual = float(at.residual.isel(resolution=-1).max())
    strip = float(at.attractive_area_mean) * (residual / float(at["range"])) ** (2 / 3)
    return {"area_fraction": strip, "mean_gap": residual, "attractive_area": strip}


def budget_row(at: xr.Dataset, name: str, solver: float) -> Context:
    """Contributions relative to the mean, and the largest of them."""
    mean = float(at[f"{name}_mean"])
    errors = {
        "sampling": float(at[f"{name}_standard_error"]),
        "discretisation": float(at[f"{name}_discretisation_error"]),
        "solver": solver,
    }
    known = {source: error for source, error in errors.items() if np.isfinite(error)}
    largest = max(known, key=known.get, default=NOTHING)
    return {
        "quantity": QUANTITIES[name],
        "mean": with_error(mean, float(np.sqrt(sum(error**2 for error in known.values())))),
        "errors": {
            source: percent(error / mean if mean else np.nan) for source, error in errors.items()
        },
        "dominates": largest if np.isfinite(errors["sampling"]) else "not known: a single seed",
    }


def run_times(folder: str | Path) -> Context:
    """Jobs, seconds and memory of each rule, from Snakemake's benchmark files.

    The report's own file, if there is one, is of an earlier run and left out.
    """
    jobs: dict[str, list[tuple[float, float]]] = {}
    for path in sorted(Path(folder).rglob("*.tsv")):
        rule = path.relative_to(folder).parts[0].removesuffix(".tsv")
        if rule != "write_report":
            jobs.setdefault(rule, []).extend(benchmark_lines(path))
    rows = [(rule, len(runs), *np.transpose(runs)) for rule, runs in jobs.items() if runs]
    rows.sort(key=lambda row: -np.nansum(row[2]))
    return {
        "rows": [
            {
                "rule": rule,
                "jobs": count,
                "total": number(np.nansum(seconds)),
                "longest": number(largest(seconds)),
                "memory": number(largest(memory)),
            }
            for rule, count, seconds, memory in rows
        ],
        "jobs": sum(row[1] for row in rows),
        "total": number(sum(np.nansum(row[2]) for row in rows)),
    }


def benchmark_lines(path: Path) -> list[tuple[float, float]]:
    """Seconds and largest memory [MB] of each run; NaN where a run was too short to tell."""
    head, *lines = (line.split("\t") for line in path.read_text(encoding="utf-8").splitlines())

    def value(line, column):
        text = dict(zip(head, line, strict=False)).get(column, "")
        return float(text) if re.fullmatch(r"\d+(\.\d+)?", text) else np.nan

    return [(value(line, "s"), value(line, "max_rss")) for line in lines if line]


def largest(values: np.ndarray) -> float:
    return np.nan if np.isnan(values).all() else float(np.nanmax(values))


def provenance(files: Sequence[xr.Dataset], ensembles: Sequence[xr.Dataset]) -> Context:
    """Versions that the files name, all of them where they differ, and what was run."""
    versions: dict[str, set[str]] = {}
    for file in files:
        for name, value in file.attrs.items():
            if name.startswith("version_"):
                versions.setdefault(name.removeprefix("version_"), set()).add(str(value))
    return {
        "versions": [(name, ", ".join(sorted(found))) for name, found in sorted(versions.items())],
        "mixed": sorted(name for name, found in versions.items() if len(found) > 1),
        "ensembles": [ensemble_row(datasets.parameters(ensemble)) for ensemble in ensembles],
    }


def ensemble_row(made: Mapping[str, Any]) -> Context:
    """Parameters of an ensemble."""
    return {
        "case": made["case"],
        "hurst": number(made["hurst"]),
        "magnification": number(made["magnification"]),
        "grid": f"{made['grid_points']} × {made['grid_points']}",
        "pixels": number(made["pixels_per_wavelength"]),
        "tolerance": number(made["tolerance"]),
        "residual": number(made["largest_residual"], 2),
        "seeds": runs_of(made["seeds"]),
        "means": means(made),
    }


def means(made: Mapping[str, Any]) -> str:
    """Estimator of the means, with the seeds it uses besides those of the ensemble."""
    if made["estimator"] == "plain":
        return "plain"
    return f"multilevel: {made['coarse_seeds']} coarse, {made['descriptor_seeds']} described"


def runs_of(seeds: Sequence[int]) -> str:
    """Seeds, with unbroken runs shortened: 1 … 8."""
    seeds = sorted(seeds)
    unbroken = len(seeds) > 2 and seeds == list(range(seeds[0], seeds[-1] + 1))
    return f"{seeds[0]} … {seeds[-1]}" if unbroken else ", ".join(map(str, seeds))
