"""What all campaigns share: one seed of a set is measured, and its rows are written."""

import logging

import pandas as pd

from common import limits_table
from stickiness import datasets


def write_rows(job, measure):
    """Write the rows that `measure` finds on one seed of a set, as their table has them.

    `measure` takes the setting of the set, the seed, and what is common to all sets of a campaign.
    """
    setting = job.params.setting
    seed = int(job.wildcards.seed)
    of_set = {**setting, "set": job.wildcards.limits_set, "seed": seed}
    rows = []
    for row in measure(setting, seed, job.params.campaign):
        logging.info("%s", row)
        rows.append(of_set | row)
    # What a row does not tell is left empty.
    columns = limits_table.COLUMNS[job.wildcards.limits_kind]
    frame = pd.DataFrame(rows).reindex(columns=columns)
    with datasets.whole_file(job.output[0]) as path:
        frame.to_csv(path, index=False, float_format="%.6g", lineterminator="\n")
