"""Collect what jobs cost from the results of a run, for `scripts/_cost.py` and its test.

    python benchmarks/job_cost.py results/draft results/standard > tests/data/job_costs.csv

A further configuration that the run was given follows `--configfile`.
"""

import argparse
import csv
import sys
from pathlib import Path

import yaml

sys.path.insert(0, str(Path(__file__).parents[1] / "scripts"))

from pipeline import job_cost
from stickiness.config import checks as configuration

WILDCARDS = {
    "synthesise_surface": ("model_surface", "seed"),
    "solve_repulsive": ("case", "seed"),
    "solve_coarse": ("case",),
    "solve_ensemble": ("comparison",),
    "contact_maps": ("case",),
    "solve_adhesive": ("adhesion", "seed"),
    "adhesive_maps": ("adhesion",),
    "follow_loop": ("loop",),
}
SIZE = ("stored", "solved", "solutions")
MEASURED = {"seconds": "s", "cpu_seconds": "cpu_time", "max_rss_mb": "max_rss"}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", type=Path, nargs="+", help="folders results/FIDELITY")
    parser.add_argument("--configfile", type=Path, help="what the run was given besides")
    chosen = parser.parse_args()
    config = configuration.load("config/config.yaml")
    if chosen.configfile:
        for key, value in yaml.safe_load(chosen.configfile.read_text()).items():
            config[key] = config[key] | value if isinstance(value, dict) else value
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(["fidelity", "rule", "job", *SIZE, *MEASURED])
    for folder in chosen.results:
        for rule in WILDCARDS:
            table.writerows(rows(config | {"fidelity": folder.name}, folder, rule))


def rows(config, folder, rule):
    """One row per benchmark of a rule."""
    for file in sorted((folder / "benchmarks" / rule).rglob("*.tsv")):
        job = file.relative_to(folder / "benchmarks" / rule).with_suffix("")
        values = [part.removeprefix("seed") for part in job.parts]
        size = job_cost.work(config, rule, **dict(zip(WILDCARDS[rule], values, strict=True)))
        with file.open() as lines:
            measured = next(csv.DictReader(lines, delimiter="\t"))
        yield [
            *(folder.name, rule, job.as_posix()),
            *(getattr(size, name) for name in SIZE),
            *(measured[column] for column in MEASURED.values()),
        ]


if __name__ == "__main__":
    main()
