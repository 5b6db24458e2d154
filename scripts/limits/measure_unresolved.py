"""What states on every second or fourth point tell of a surface whose waves they lack in part."""

import logging

import numpy as np

from common.conventions import Q0
from common.job import start
from limits.measuring import NEVER, THRESHOLDS, write_rows
from limits.trial_thresholds import SHARES, find_log_thresholds
from stickiness.remaining.height_simulation import find_trial_states

UNRESOLVED_VARIABLES = {
    "row": "stride and range",
    "stride": "of which every so many-th point is simulated",
    "range": "range over h_rms",
    "lacking": "energy of full contact that the thinned grid lacks, over that of the others",
    "full_contact_energy": "elastic energy of full contact over E* q0 h_rms^2, on the full grid",
    **{f"full_{name}": texts for name, texts in THRESHOLDS.items()},
    **{
        f"thinned_{name}": ("1", "the same of thinned heights, for w over 1 + lacking", NEVER)
        for name in SHARES
    },
}


def main(job):
    write_rows(
        job, measure, UNRESOLVED_VARIABLES, title="what states on thinned heights tell of a surface"
    )


def measure(heights, setting, params):
    """Rows of all strides and ranges."""
    length = setting["waves"] * 2 * np.pi / Q0
    full = find_trial_states(heights, length, pull=False)
    for stride in params.strides:
        thinned = find_trial_states(heights[::stride, ::stride], length, pull=False)
        lacking = full.full_contact_energy / thinned.full_contact_energy - 1
        for range_ in params.ranges:
            of_full = find_log_thresholds(full, range_)
            of_thinned = find_log_thresholds(thinned, range_)
            row = {
                "stride": stride,
                "range": range_,
                "lacking": lacking,
                "full_contact_energy": full.full_contact_energy,
                **{f"full_{name}": value for name, value in of_full.items()},
                **{f"thinned_{n}": value + np.log1p(lacking) for n, value in of_thinned.items()},
            }
            logging.info("%s", row)
            yield row


if __name__ == "__main__":
    main(start(globals()))
