"""Time and memory of jobs, from Snakemake's benchmark files."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np

from common.formatting import number


def run_times(folder: str | Path) -> dict[str, Any]:
    """Jobs, seconds, processor seconds and memory of each rule, from Snakemake's benchmark files.

    The report's own file, if there is one, is of an earlier run and left out.
    """
    jobs: dict[str, list[tuple[float, float, float]]] = {}
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
                "processor": number(np.nansum(processor)),
                "longest": number(np.fmax.reduce(seconds)),
                "memory": number(np.fmax.reduce(memory)),
            }
            for rule, count, seconds, memory, processor in rows
        ],
        "jobs": sum(row[1] for row in rows),
        "total": number(sum(np.nansum(row[2]) for row in rows)),
        "processor": number(sum(np.nansum(row[4]) for row in rows)),
    }


def read_benchmark(path: Path) -> list[tuple[float, float, float]]:
    """Seconds, largest memory [MB] and processor seconds of each run.

    NaN where a run was too short to tell.
    """
    head, *lines = (line.split("\t") for line in path.read_text(encoding="utf-8").splitlines())

    def value(line, column):
        text = dict(zip(head, line, strict=False)).get(column, "")
        return float(text) if re.fullmatch(r"\d+(\.\d+)?", text) else np.nan

    columns = ("s", "max_rss", "cpu_time")
    return [tuple(value(line, column) for column in columns) for line in lines if line]


def processor_time(folder: str | Path, name: str = "*") -> float:
    """Processor seconds of the jobs in a folder of benchmarks, or of those files called `name`."""
    paths = sorted(Path(folder).rglob(f"{name}.tsv"))
    if not paths:
        raise FileNotFoundError(f"{folder}: no benchmark {name}.tsv; run the workflow first")
    return float(sum(np.nansum([run[2] for run in read_benchmark(path)]) for path in paths))
