"""Table of what the simulations of one kind found, a row each, behind the limits of verdicts."""

from pathlib import Path

import pandas as pd

from common import limits_table
from common.job import start
from stickiness import __version__, datasets


def main(job):
    kind = job.wildcards.limits_kind
    frame = pd.concat([list_rows(path, kind) for path in job.input])
    text = limits_table.describe(kind, __version__) + frame.to_csv(index=False, float_format="%.6g")
    with datasets.whole_file(job.output[0]) as path:
        path.write_text(text, encoding="utf-8")


def list_rows(path, kind):
    """Rows of one file, with the set that it belongs to."""
    data = datasets.read(path)
    of_set = {"set": Path(path).parent.name, **datasets.parameters(data)}
    frame = data.to_dataframe().reset_index()
    columns = limits_table.COLUMNS[kind]
    missing = {name: of_set[name] for name in columns if name not in frame}
    return frame.assign(**missing)[list(columns)]


if __name__ == "__main__":
    main(start(globals()))
