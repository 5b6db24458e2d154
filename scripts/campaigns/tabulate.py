"""Table of what all sets of one campaign measured. The committed tables are copies of these."""

import textwrap

import pandas as pd

from common.job import start
from stickiness import __version__, datasets

WIDTH = 100


def main(job):
    measured = [datasets.read(path) for path in job.input]
    head = describe(measured[0], job.params.target)
    rows = pd.concat([dataset.to_dataframe() for dataset in measured])
    text = rows.to_csv(index=False, float_format="%.6g", lineterminator="\n")
    with datasets.whole_file(job.output[0]) as path:
        path.write_text(head + text, encoding="utf-8")


def describe(dataset, target):
    """Comment at the head of a table: what it holds, and every column."""
    origin = (
        f"Measured with version {__version__} by the target {target}. To take a new measurement "
        "over, copy its table here."
    )
    columns = [describe_column(name, column.attrs) for name, column in dataset.items()]
    paragraphs = [*dataset.comment.split("\n\n"), origin, *columns]
    lines = [line for text in paragraphs for line in textwrap.wrap(text, WIDTH - 2)]
    return "".join(f"# {line}\n" for line in lines)


def describe_column(name, attributes):
    """Name, text and unit of a column."""
    units = attributes.get("units", "1")  # texts have none
    unit = "" if units == "1" else f" [{units}]"
    return f"{name}: {attributes['long_name']}{unit}"


if __name__ == "__main__":
    main(start(globals()))
