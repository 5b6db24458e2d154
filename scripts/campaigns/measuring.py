"""What all campaigns share: one seed of a set is measured, and its rows become a file.

The module of a campaign tells in its docstring what its table holds. `COLUMNS` has a text for every
column, or a unit and a text. `measure` finds the rows of one realisation: it takes the setting of
its set, the seed, and what is common to all sets of the campaign.
"""

import logging
from inspect import cleandoc

import numpy as np
import pandas as pd

from common.conventions import Q0, annotate
from stickiness import datasets

OF_SET = {
    "set": "as in the configuration of the campaign",
    "role": "fitted: limits are fitted to these rows; unseen: they are compared with them",
}
SEED = {"seed": "of the realisation"}
#: Columns of synthetic topographies.
OF_TOPOGRAPHY = {
    **OF_SET,
    "family": "of topographies",
    "hurst": "Hurst exponent, if not that of the family",
    "points": "of the grid, along a side",
    "waves": "longest waves, or features, along a side",
    "shortest": "shortest wave in pixels",
    **SEED,
}
#: Columns of model surfaces, which are Gaussian.
OF_MODEL_SURFACE = {
    **OF_SET,
    "hurst": "Hurst exponent",
    "magnification": "longest wave over the shortest",
    "window": "longest waves along a side",
    "points": "of the grid, along a side",
    **SEED,
}
MISSING = "none, or not known"


def main(names, job):
    """Measure one seed of a set; `names` are the ``globals()`` of the campaign's module."""
    setting = job.params.setting
    seed = int(job.wildcards.seed)
    rows = []
    for row in names["measure"](setting, seed, job.params.shared):
        logging.info("%s", row)
        rows.append(row)
    of_set = {**setting, "set": job.wildcards.set, "seed": seed}
    datasets.write(
        make_dataset(rows, of_set, names["COLUMNS"], names["__doc__"]),
        job.output[0],
        title=f"{job.wildcards.campaign}, set {job.wildcards.set}",
        parameters={**setting, "seed": seed},
    )


def make_dataset(rows, of_set, columns, explanation):
    """Rows of a set as a dataset with some columns; what they do not tell of is empty, or NaN."""
    frame = pd.DataFrame([of_set | row for row in rows], columns=list(columns))
    texts = frame.select_dtypes(exclude="number").columns
    dataset = frame.fillna(dict.fromkeys(texts, "")).rename_axis("row").to_xarray()
    described = {
        name: (*(("1", text) if isinstance(text, str) else text), MISSING)
        for name, text in columns.items()
    }
    dataset.attrs["comment"] = cleandoc(explanation)
    return annotate(dataset, row="of the table", **described)


def find_side(setting):
    """Side of a synthetic topography, in units of 1/q0."""
    return setting["waves"] * 2 * np.pi / Q0
