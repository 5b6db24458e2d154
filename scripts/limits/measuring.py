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
    seed = int(job.wildcards.seed)
    rows = list(measure(make_set(setting, seed), setting, job.params))
    dataset = annotate(pd.DataFrame(rows).rename_axis("row").to_xarray(), **variables)
    datasets.write(dataset, job.output[0], title=title, parameters={**setting, "seed": seed})
