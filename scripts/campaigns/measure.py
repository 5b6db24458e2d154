"""Measure one seed of a set of a campaign, and keep its rows.

The module of a campaign beside this one describes its table in its docstring. Its `COLUMNS`
have a text for every column, or a unit and a text. Its `measure` finds the rows of one realisation:
it takes the setting of the set, the seed, and what all sets of the campaign share.
"""

import logging
from importlib import import_module
from inspect import cleandoc

import pandas as pd

from common.conventions import annotate
from common.job import start
from stickiness import datasets

MISSING = "none, or not known"


def main(job):
    write_rows(job, import_module(f"campaigns.{job.wildcards.campaign}"))


def write_rows(job, campaign):
    """Write the rows that the module of a campaign finds."""
    setting = job.params.setting
    seed = int(job.wildcards.seed)
    rows = []
    for row in campaign.measure(setting, seed, job.params.shared):
        logging.info("%s", row)
        rows.append(row)
    of_set = {**setting, "set": job.wildcards.set, "seed": seed}
    datasets.write(
        make_dataset(rows, of_set, campaign),
        job.output[0],
        title=f"{job.wildcards.campaign}, set {job.wildcards.set}",
        parameters={**setting, "seed": seed},
    )


def make_dataset(rows, of_set, campaign):
    """Rows of a set as a dataset.

    Missing entries are empty, or NaN. What rows hold beyond the columns is left out.
    """
    columns = campaign.COLUMNS
    # What a row has takes the place of what its set says, such as one of several wave numbers.
    frame = pd.DataFrame([of_set | row for row in rows], columns=list(columns))
    texts = frame.select_dtypes(exclude="number").columns
    dataset = frame.fillna(dict.fromkeys(texts, "")).rename_axis("row").to_xarray()
    # Unit, text, and what a missing entry means.
    described = {
        name: ("1", text, MISSING) if isinstance(text, str) else (*text, MISSING)
        for name, text in columns.items()
    }
    dataset.attrs["comment"] = cleandoc(campaign.__doc__)
    return annotate(dataset, row="of the table", **described)


if __name__ == "__main__":
    main(start(globals()))
