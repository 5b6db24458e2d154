"""Table of what the simulations of one kind found, a row each, behind the limits of verdicts."""

import pandas as pd

from common import limits_table
from common.job import start
from stickiness import __version__, datasets


def main(job):
    kind = job.wildcards.limits_kind
    columns = list(limits_table.COLUMNS[kind])
    frame = pd.concat([datasets.read(path, columns).to_dataframe() for path in job.input])
    head = limits_table.describe(kind, __version__)
    table = frame.to_csv(columns=columns, index=False, float_format="%.6g", lineterminator="\n")
    with datasets.whole_file(job.output[0]) as path:
        path.write_text(head + table, encoding="utf-8")


if __name__ == "__main__":
    main(start(globals()))
