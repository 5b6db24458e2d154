"""Time and memory of jobs, from Snakemake's benchmark files."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np

from pipeline.numbers import number


def run_times(folder: str | Path) -> dict[str, Any]:
    """Jobs, seconds and memory of each rule, from Snakemake's benchmark files.

    The report's own file, if there is one, is of an earlier run and left out.
    """
    jobs: dict[str, list[tuple[float, float]]] = {}
    for path in sorted(Path(folder).rglob("*.tsv")):
        rule = path.relative_to(folder).parts[0].removesuffix(".tsv")
        if rule != "write_report":
            jobs.setdefault(rule, []).extend(read_benchmark(path))
    rows = [(rule, len(runs), *np.transpose(runs)) for rule, runs in jobs.items() if runs]
    rows.sort(key=lambda row: -np.nansum(row[2]))
    return {
        "rows": [
            {
                "rule": rule,
                "jobs": count,
                "total": number(np.nansum(seconds)),
                "longest": number(np.fmax.reduce(seconds)),
                "memory": number(np.fmax.reduce(memory)),
            }
            for rule, count, seconds, memory in rows
        ],
        "jobs": sum(row[1] for row in rows),
        "total": number(sum(np.nansum(row[2]) for row in rows)),
    }


def read_benchmark(path: Path) -> list[tuple[float, float]]:
    """Seconds and largest memory [MB] of each run; NaN where a run was too short to tell."""
    head, *lines = (line.split("\t") for line in path.read_text(encoding="utf-8").splitlines())

    def value(line, column):
        text = dict(zip(head, line, strict=False)).get(column, "")
        return float(text) if re.fullmatch(r"\d+(\.\d+)?", text) else np.nan

    return [(value(line, "s"), value(line, "max_rss")) for line in lines if line]
