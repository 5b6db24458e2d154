"""What all campaigns share: one seed of a set is measured, and its rows are written."""

import logging

import pandas as pd

from common import limits_table
from stickiness import datasets


def write_rows(job, measure):
    """Write the rows that `measure` finds on one seed of a set, with the columns of their table.

    `measure` takes the setting of the set, the seed, and what is common to all sets of a campaign.
    """
    setting = job.params.setting
    seed = int(job.wildcards.seed)
    kind = job.wildcards.limits_kind
    of_set = {**setting, "set": job.wildcards.limits_set, "seed": seed}
    rows = []
    for row in measure(setting, seed, job.params.campaign):
        logging.info("%s", row)
        rows.append(of_set | row)
    dataset = limits_table.make_dataset(pd.DataFrame(rows), kind)
    title = f"simulations behind the limits of verdicts: {kind}"
    datasets.write(dataset, job.output[0], title=title, parameters={**setting, "seed": seed})
