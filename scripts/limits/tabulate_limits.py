"""Table of what the simulations of one kind found, a row each, behind the limits of verdicts."""

from pathlib import Path

from common import limits_table
from common.job import start
from stickiness import __version__, datasets


def main(job):
    parts = [Path(path).read_text(encoding="utf-8").partition("\n") for path in job.input]
    head = limits_table.describe(job.wildcards.limits_kind, __version__)
    names, newline, _ = parts[0]
    with datasets.whole_file(job.output[0]) as path:
        rows = "".join(rows for _, _, rows in parts)
        path.write_text(f"{head}{names}{newline}{rows}", encoding="utf-8")


if __name__ == "__main__":
    main(start(globals()))
