"""Compare the times of two commits of this project, on one machine and in turn.

Each commit is checked out and installed in a folder of its own, outside this one. Every round runs
a task once with either commit, so that whatever else the machine does meets both. Examples::

    python benchmarks/two_commits.py main~10
    python benchmarks/two_commits.py v0.3.0 --tasks verdict page --rounds 9

The table has the median time of the base, and the ratio of this commit to it: the median over
rounds, with the least and the largest. It is printed after each task, from the shortest to the
longest. Rules of the workflow have the wall time of their jobs: Snakemake looks at the processor
time of a job every 30 s, and misses what comes after. Processor time is that of all processes of a
task. It needs POSIX, git and make.
"""

import argparse
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from collections import defaultdict
from pathlib import Path
from statistics import median
from typing import NamedTuple

import pandas as pd

ROOT = Path(__file__).parents[1]
RUN = ("-m", "snakemake", "-j2", "--quiet", "all", "--config", "results=run")
TESTS = ("-m", "pytest", "-q", "-n", "2", "--dist", "worksteal")


class Task(NamedTuple):
    """What is run."""

    rounds: int
    arguments: tuple[str, ...]  #: of Python


#: Numba compiles anew for tasks that are called first.
TASKS = {
    "verdict": Task(5, ("-m", "stickiness", "--example", "--no-page")),
    "first verdict": Task(3, ("-m", "stickiness", "--example", "--no-page")),
    "page": Task(5, ("-m", "stickiness", "--example", "--output", "run")),
    "quick tests": Task(3, (*TESTS, "-m", "not slow and not workflow and not peers")),
    "draft": Task(2, (*RUN, "fidelity=draft")),
    "tests": Task(1, TESTS),
    "standard": Task(1, RUN),
}
DEFAULT = ("verdict", "first verdict", "page", "draft")
LEAST_TIME = 1.0  #: [s] of rules that are shown


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("base", help="commit to compare with")
    parser.add_argument("--here", default="HEAD", help="commit that is compared (default: HEAD)")
    parser.add_argument("--tasks", nargs="+", choices=TASKS, default=DEFAULT)
    parser.add_argument("--rounds", type=int, help="of every task (default: fewer of longer ones)")
    options = parser.parse_args()
    with_tests = any(task.endswith("tests") for task in options.tasks)
    with tempfile.TemporaryDirectory(prefix="commits-") as place:
        folders = {
            name: check_out(commit, Path(place, name), with_tests=with_tests)
            for name, commit in (("base", options.base), ("here", options.here))
        }
        for task in sorted(options.tasks, key=list(TASKS).index):
            rounds = options.rounds or TASKS[task].rounds
            print(compare(task, rounds, folders).to_string(index=False), flush=True)


def compare(task, rounds, folders):
    """Table of the times of a task in both folders, which take turns."""
    times = defaultdict(list)
    for number in range(rounds):
        # The order changes from round to round.
        for name in sorted(folders, reverse=bool(number % 2)):
            for measured, seconds in run(task, folders[name]).items():
                times[measured, name].append(seconds)
            print(f"round {number + 1} of {rounds}: {task} of {name}", file=sys.stderr)
    return tabulate(times, rounds)


def check_out(commit, folder, with_tests):
    """Check a commit out into a new folder, install it there, and call it once."""
    stamps = (".venv/.peers", ".venv/.docs") if with_tests else (".venv/.run",)
    subprocess.run(["git", "clone", "--quiet", ROOT, folder], check=True)
    subprocess.run(["git", "checkout", "--quiet", find_hash(commit)], cwd=folder, check=True)
    subprocess.run(["make", "--silent", *stamps], cwd=folder, check=True)
    run("verdict", folder)  # after which numba has compiled
    return folder


def find_hash(commit):
    """Whole hash of a commit as this folder names it."""
    asked = ["git", "rev-parse", "--verify", f"{commit}^{{commit}}"]
    return subprocess.run(
        asked, cwd=ROOT, check=True, capture_output=True, text=True
    ).stdout.strip()


def run(task, folder):
    """Wall and processor time of a task [s], and of the rules that it runs."""
    shutil.rmtree(folder / "run", ignore_errors=True)
    environment = os.environ | {"OMP_NUM_THREADS": "1"}
    if task.startswith("first"):
        environment["NUMBA_CACHE_DIR"] = str(folder / "run" / "compiled")
    command = [folder / ".venv/bin/python", *TASKS[task].arguments]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.monotonic()
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)
    wall = time.monotonic() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        sys.exit(f"{task} failed in {folder.name}:\n{done.stdout}\n{done.stderr}")
    processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    found = {(task, "wall"): wall, (task, "processor"): processor}
    for rule in folder.glob("run/**/benchmarks/*"):
        jobs = [pd.read_csv(file, sep="\t").s.sum() for file in rule.rglob("*.tsv")]
        found[f"{task}: {rule.name}", "wall"] = sum(jobs)
    return found


def tabulate(times, rounds):
    """Median times of the base, and ratios with their spread."""
    rows = []
    for task, kind in dict.fromkeys(measured for measured, _ in times):
        base, here = (times[(task, kind), name] for name in ("base", "here"))
        if min(len(base), len(here)) < rounds or (":" in task and median(base) < LEAST_TIME):
            continue  # a rule that one of them does not have, or that hardly counts
        ratios = [new / old for old, new in zip(base, here, strict=True)]
        spread = f"{median(ratios):.2f} ({min(ratios):.2f} to {max(ratios):.2f})"
        rows.append(
            {"task": task, "time": kind, "base [s]": f"{median(base):.1f}", "ratio": spread}
        )
    return pd.DataFrame(rows)


if __name__ == "__main__":
    main()
