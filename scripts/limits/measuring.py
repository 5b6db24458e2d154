"""What measurements on synthetic topographies share: their file, and variables of thresholds."""

import pandas as pd

from common.conventions import annotate
from common.topographies import make_set
from limits.trial_thresholds import SHARES
from stickiness import datasets

NEVER = "the share remains at any adhesion length"
#: Unit, description and what NaN means of thresholds, by the ends of their names.
THRESHOLDS = {
    name: ("1", f"ln of the adhesion length at which {share:g} of w remains", NEVER)
    for name, share in SHARES.items()
}


def write_rows(job, measure, variables, title):
    """Make the heights of a set, and write the rows that `measure` finds on them."""
    setting = job.params.surface
    heights = make_set(setting, int(job.wildcards.seed))
    write_table(job, measure(heights, setting, job.params), variables, title)


def write_table(job, rows, variables, title):
    """Write rows of one seed of a set."""
    dataset = annotate(pd.DataFrame(rows).rename_axis("row").to_xarray(), **variables)
    parameters = {**job.params.surface, "seed": int(job.wildcards.seed)}
    datasets.write(dataset, job.output[0], title=title, parameters=parameters)
