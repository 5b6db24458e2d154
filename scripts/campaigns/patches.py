"""What patches of a surface tell of it: works of adhesion at which shares remain, by simulation.

States are simulated on the heights of a patch as on those of a measured map. Heights and ranges are
over h_rms, energies and adhesion lengths over q0 h_rms^2, shares over the work of adhesion.
"""

from itertools import product

import numpy as np
from scipy import stats

from campaigns.columns import OF_TOPOGRAPHY, find_side
from campaigns.trial_thresholds import (
    SHARES,
    describe_thresholds,
    find_log_thresholds,
    name_columns,
    share_on,
)
from common.conventions import Q0
from common.topographies import make_set
from stickiness.measured.levelling import detrend
from stickiness.measured.psd import autocorrelation
from stickiness.remaining.height_simulation import find_trial_states
from stickiness.remaining.standard_heights import standardise

OF_QUARTERS = ("10", "30")  # thresholds that are kept of the quarters of a patch
COLUMNS = OF_TOPOGRAPHY | {
    "patch_waves": "longest waves along a side of the patch",
    "patch": "number",
    "h_rms": "rms height of the patch",
    "skewness": "of the patch",
    "kurtosis": "of the patch",
    "independent_areas": "1 over the mean square of the autocorrelation",
    "mean_cube": "of the autocorrelation",
    "full_contact_energy": "elastic energy of full contact of the patch",
    "whole_skewness": "of the surface",
    "whole_kurtosis": "of the surface",
    "whole_full_contact_energy": "elastic energy of full contact of the surface",
    "range": "of the attraction",
    **describe_thresholds("threshold", "on the patch"),
    **describe_thresholds("whole_threshold", "on the surface"),
    **{
        f"share_{ending}": f"share on the patch where {share:.0%} remains on the surface"
        for ending, share in SHARES.items()
    },
    **{
        f"q{number}_{ending}": f"threshold_{ending} of a quarter of the patch"
        for ending, number in product(OF_QUARTERS, range(1, 5))
    },
}


def measure(setting, seed, shared):
    """Rows of all patches, beside what remains on the whole surface."""
    heights = make_set(setting, seed)
    waves = setting["waves"]
    wavelength = 2 * np.pi / Q0
    thresholds, of_whole = measure_whole(heights, find_side(setting), shared["range"])
    for size in shared["patches"]:
        patches = cut(heights, waves, size["waves"], size["count"])
        for number, patch in enumerate(patches):
            side = size["waves"] * wavelength
            row = measure_patch(patch, side, thresholds, shared["range"])
            yield {"patch_waves": size["waves"], "patch": number, **row, **of_whole}


def measure_whole(heights, side, range_):
    """Thresholds on a whole surface, and what the rows of its patches tell of it."""
    states = find_trial_states(heights, side)
    thresholds = find_log_thresholds(states, range_)
    return thresholds, {
        "range": range_,
        "whole_skewness": stats.skew(heights, axis=None),
        "whole_kurtosis": stats.kurtosis(heights, axis=None, fisher=False),
        "whole_full_contact_energy": states.full_contact_energy,
        **name_columns("whole_threshold", thresholds),
    }


def cut(heights, waves, patch_waves, count):
    """Patches side by side, first those that touch at their corners alone."""
    across = waves // patch_waves
    stride = heights.shape[0] // across
    points = heights.shape[0] * patch_waves // waves
    # From tile to tile the parity changes, as on a chessboard.
    tiles = sorted(product(range(across), repeat=2), key=lambda tile: sum(tile) % 2)
    for i, j in tiles[:count]:
        patch = heights[i * stride : i * stride + points, j * stride : j * stride + points]
        yield detrend(patch, "plane")


def measure_patch(patch, side, whole_thresholds, range_):
    """Row of one patch, whose states are simulated as those of a map and of its quarters."""
    standard = standardise(patch, (side, side), most_points=patch.shape[0])
    states = [
        find_trial_states(part.heights, part.sides, mirrored=True).scaled(part.height_unit, side)
        for part in (standard.whole, *standard.quarters)
    ]
    correlation = autocorrelation(standard.whole.heights)
    thresholds = [find_log_thresholds(part, range_) for part in states]
    shares = {
        ending: share_on(states[0], log_length, range_)
        for ending, log_length in whole_thresholds.items()
    }
    return {
        "h_rms": patch.std(),
        "skewness": stats.skew(patch, axis=None),
        "kurtosis": stats.kurtosis(patch, axis=None, fisher=False),
        "independent_areas": 1 / np.mean(correlation**2),
        "mean_cube": np.mean(correlation**3),
        "full_contact_energy": states[0].full_contact_energy,
        **name_columns("threshold", thresholds[0]),
        **name_columns("share", shares),
        **{
            f"q{number}_{ending}": thresholds[number][ending]
            for number, ending in product(range(1, 5), OF_QUARTERS)
        },
    }
