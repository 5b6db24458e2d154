"""How many jobs a run has, and the processor time that they took."""

import re
import subprocess
import sys
from pathlib import Path

from pipeline.numbers import number
from pipeline.pages.benchmarks import processor_time
from pipeline.quoted.sources import Sources

PAGE = "jacksboro"  # measured surface whose page stands for all


def quote_jobs(sources: Sources) -> dict[str, str]:
    page = f"results/draft/report/surfaces/{PAGE}.html"
    return {
        "jobs.standard": str(count_jobs(sources.root)),
        "jobs.draft": str(count_jobs(sources.root, "--config", "fidelity=draft")),
        "jobs.page": str(count_jobs(sources.root, page, "--config", "fidelity=draft")),
    }


def count_jobs(root: Path, *arguments: str) -> int:
    """Number of jobs of a run from nothing, from a dry-run in the folder of the workflow."""
    command = [sys.executable, "-m", "snakemake", *arguments, "-n", "-F", "--quiet", "host"]
    done = subprocess.run(command, cwd=root, capture_output=True, text=True, check=False)
    found = re.search(r"^total +(\d+)$", done.stdout + done.stderr, re.M)
    if done.returncode or found is None:
        raise RuntimeError(f"{' '.join(command[1:])} failed:\n{done.stderr or done.stdout}")
    return int(found[1])


def quote_times(sources: Sources) -> dict[str, str]:
    """Processor time of the jobs, to one digit: more would not be found again."""
    standard, draft = (folder / "benchmarks" for folder in (sources.results, sources.draft))
    return {
        "time.standard": f"{number(processor_time(standard) / 60, 1)} min",
        "time.draft": f"{number(processor_time(draft) / 60, 1)} min",
        "time.page": f"{number(processor_time(draft, PAGE), 1)} s",
    }


NUMBERS = (quote_jobs, quote_times)
