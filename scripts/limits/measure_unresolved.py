"""What states on every second or fourth point tell of a surface whose waves they lack in part."""

import numpy as np

from common.conventions import Q0
from common.job import start
from common.topographies import make_set
from limits.measuring import write_rows
from limits.trial_thresholds import find_log_thresholds, name_columns
from stickiness.remaining.height_simulation import find_trial_states


def main(job):
    write_rows(job, measure)


def measure(setting, seed, campaign):
    """Rows of all strides and ranges."""
    heights = make_set(setting, seed)
    length = setting["waves"] * 2 * np.pi / Q0
    full = find_trial_states(heights, length, pull=False)
    for stride in campaign["strides"]:
        thinned = find_trial_states(heights[::stride, ::stride], length, pull=False)
        lacking = full.full_contact_energy / thinned.full_contact_energy - 1
        for range_ in campaign["ranges"]:
            of_thinned = find_log_thresholds(thinned, range_)
            at_full_energy = {end: found + np.log1p(lacking) for end, found in of_thinned.items()}
            yield {
                "stride": stride,
                "range": range_,
                "lacking": lacking,
                "full_contact_energy": full.full_contact_energy,
                **name_columns("full", find_log_thresholds(full, range_)),
                **name_columns("thinned", at_full_energy),
            }


if __name__ == "__main__":
    main(start(globals()))
