"""What states on every second or fourth point tell of a surface whose waves they lack in part.

Heights and ranges are over h_rms, energies and adhesion lengths over q0 h_rms^2.
"""

import numpy as np

from campaigns.columns import OF_TOPOGRAPHY, find_side
from campaigns.trial_thresholds import describe_thresholds, find_log_thresholds, name_columns
from common.topographies import make_set
from stickiness.remaining.height_simulation import find_trial_states

COLUMNS = OF_TOPOGRAPHY | {
    "full_contact_energy": "elastic energy of full contact on the full grid",
    "stride": "the thinned grid has every n-th point along each side",
    "lacking": "energy of full contact that the thinned grid lacks, over that of the others",
    "range": "of the attraction",
    **describe_thresholds("full", "on the full grid"),
    **describe_thresholds("thinned", "times 1 + lacking on the thinned grid"),
}


def measure(setting, seed, shared):
    """Rows of all strides and ranges."""
    heights = make_set(setting, seed)
    length = find_side(setting)
    full = find_trial_states(heights, length)
    for stride in shared["strides"]:
        thinned = find_trial_states(heights[::stride, ::stride], length)
        lacking = full.full_contact_energy / thinned.full_contact_energy - 1
        for range_ in shared["ranges"]:
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
