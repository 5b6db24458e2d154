"""What patches of a surface tell of it: works of adhesion at which shares remain, by simulation."""

import logging
from itertools import product

import numpy as np
from scipy import fft, stats

from common.conventions import Q0
from common.job import start
from limits.measuring import NEVER, THRESHOLDS, write_rows
from limits.trial_thresholds import SHARES, find_log_thresholds, share_on
from stickiness.measured.levelling import detrend
from stickiness.remaining.height_simulation import find_trial_states
from stickiness.remaining.standard_heights import standardise

OF_QUARTERS = ("10", "30")  # thresholds that are kept of the quarters
PATCH_VARIABLES = {
    "row": "patch",
    "patch_waves": "longest waves along a side of the patch",
    "patch": "number of the patch among those of its size",
    "h_rms": "rms height of the levelled patch over that of the surface",
    "skewness": "of the levelled patch",
    "kurtosis": "of the levelled patch",
    "independent_areas": "1 over the mean of the squared autocorrelation of the patch",
    "mean_cube": "mean of the cubed autocorrelation of the patch",
    "full_contact_energy": "elastic energy of full contact of the patch over E* q0 h_rms^2",
    "range": "range over h_rms of the surface",
    **{f"threshold_{name}": texts for name, texts in THRESHOLDS.items()},
    **{
        f"share_{name}": ("1", f"share on the patch where {share:g} remains on the surface", NEVER)
        for name, share in SHARES.items()
    },
    **{
        f"q{number}_{name}": ("1", f"threshold_{name} of quarter {number}", NEVER)
        for number, name in product(range(1, 5), OF_QUARTERS)
    },
    "whole_skewness": "of the surface",
    "whole_kurtosis": "of the surface",
    "whole_full_contact_energy": "that of the surface",
    **{f"whole_threshold_{name}": texts for name, texts in THRESHOLDS.items()},
}


def main(job):
    write_rows(job, measure, PATCH_VARIABLES, title="what patches of a surface tell of it")


def measure(heights, setting, params):
    """Rows of all patches, beside what remains on the whole surface."""
    waves = setting["waves"]
    wavelength = 2 * np.pi / Q0
    whole = find_trial_states(heights, waves * wavelength, pull=False)
    whole_thresholds = find_log_thresholds(whole, params.range)
    of_whole = {
        "range": params.range,
        "whole_skewness": stats.skew(heights, axis=None),
        "whole_kurtosis": stats.kurtosis(heights, axis=None, fisher=False),
        "whole_full_contact_energy": whole.full_contact_energy,
        **{f"whole_threshold_{name}": value for name, value in whole_thresholds.items()},
    }
    for size in params.patches:
        patches = cut(heights, waves, size["waves"], size["count"])
        for number, patch in enumerate(patches):
            row = measure_patch(patch, size["waves"] * wavelength, whole_thresholds, params.range)
            logging.info("%d waves, patch %d: %s", size["waves"], number, row)
            yield {"patch_waves": size["waves"], "patch": number, **row, **of_whole}


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
        find_trial_states(part.mirrored, part.mirrored_sides, pull=False).scaled(
            part.height_unit, side
        )
        for part in (standard.whole, *standard.quarters)
    ]
    autocorrelation = find_autocorrelation(standard.whole.heights)
    thresholds = [find_log_thresholds(part, range_) for part in states]
    return {
        "h_rms": patch.std(),
        "skewness": stats.skew(patch, axis=None),
        "kurtosis": stats.kurtosis(patch, axis=None, fisher=False),
        "independent_areas": 1 / np.mean(autocorrelation**2),
        "mean_cube": np.mean(autocorrelation**3),
        "full_contact_energy": states[0].full_contact_energy,
        **{f"threshold_{name}": thresholds[0][name] for name in SHARES},
        **{
            f"share_{name}": share_on(states[0], log_length, range_)
            for name, log_length in whole_thresholds.items()
        },
        **{
            f"q{number}_{name}": thresholds[number][name]
            for number, name in product(range(1, 5), OF_QUARTERS)
        },
    }


def find_autocorrelation(heights):
    """Autocorrelation of periodic heights, 1 at no shift."""
    power = np.abs(fft.fft2(heights - heights.mean())) ** 2
    return fft.ifft2(power).real * power.size / power.sum()


if __name__ == "__main__":
    main(start(globals()))
