"""What all campaigns share: one seed of a set is measured, and its rows are written."""

import logging

import pandas as pd

from common import limits_table
from common.conventions import annotate
from stickiness import datasets


def write_rows(job, measure):
    """Write the rows that `measure` finds on one seed of a set, as far as their table holds them.

    `measure` takes the setting of the set, the seed, and what is common to all sets of a campaign.
    """
    setting = job.params.setting
    seed = int(job.wildcards.seed)
    table = limits_table.TABLES[job.wildcards.limits_kind]
    rows = []
    for row in measure(setting, seed, job.params.campaign):
        logging.info("%s", row)
        rows.append(row)
    # What a row does not tell is NaN.
    frame = pd.DataFrame(rows).reindex(columns=list(table.measured)).rename_axis("row")
    dataset = annotate(frame.to_xarray(), row="place in the table", **table.measured)
    parameters = {**setting, "seed": seed}
    datasets.write(dataset, job.output[0], title=table.title, parameters=parameters)
