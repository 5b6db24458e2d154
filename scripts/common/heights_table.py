"""The committed table of the adhesion that remains at zero load on heights of many shapes."""

import numpy as np

from common import committed

#: Columns that predict the share that remains; each but the bound has `_low` and `_high` beside it.
PREDICTED = ("theory", "shaped", "states")
COLUMNS = (
    *("set", "role", "family", "hurst", "height_skewness", "points", "waves", "shortest", "seed"),
    *("skewness", "kurtosis", "full_contact_energy", "rms_slope", "lacking"),
    *("energy_ratio", "zone", "range", "adhesion_length", "simulated", "bound"),
    *(f"{name}{ending}" for name in PREDICTED for ending in ("", "_low", "_high")),
    *("seconds_simulated", "seconds_bound", "seconds_states", "seconds_theory"),
)
GAUSSIAN = "Gaussian"


def read(path):
    """Read the table with its band and kinds of rows; errors as of `committed.read`.

    Heights are Gaussian, transformed point by point, or skewed at an exact spectrum.
    """
    table = committed.read(path, COLUMNS, "heights_measured")
    kind = np.where(table.family == "gaussian", GAUSSIAN, "transformed")
    return table.assign(
        magnification=table.points / table.waves / table.shortest,
        window=table.waves,
        kind=np.where(table.height_skewness.notna(), "skewed", kind),
    )


def compare(table, name, wanted_share, least_share=0.05):
    """Compare predictions with simulation; the limits of `bound` are itself and 1.

    Ratios are over simulated shares of at least `least_share`; the error of smaller ones is
    absolute. A decision is false if the limits exclude the side of the `wanted_share` on which the
    simulation lies.
    """
    low, high = (
        (table.bound, 1.0) if name == "bound" else (table[f"{name}_low"], table[f"{name}_high"])
    )
    is_small = table.simulated < least_share
    ratio = (table[name] / table.simulated)[~is_small]
    error = (table[name] - table.simulated)[is_small]
    sticks = table.simulated >= wanted_share
    # Within the rounding of the table, the tolerance of simulations, and the bins of the gaps.
    rounding = 2e-3 * table.simulated + 1e-4
    inside = (low - rounding <= table.simulated) & (table.simulated <= high + rounding)
    return {
        "points": len(table),
        "ratio": ratio.mean(),
        "ratio_rms": np.sqrt(np.mean((ratio - 1) ** 2)),
        "within_quarter": np.mean(abs(ratio - 1) <= 0.25),
        "small_error": error.mean(),
        "small_error_rms": np.sqrt(np.mean(error**2)),
        "inside": np.mean(inside),
        "decided": np.mean((low >= wanted_share) | (high < wanted_share)),
        "false_sticks": int(np.sum((low >= wanted_share) & ~sticks)),
        "false_does_not_stick": int(np.sum((high < wanted_share) & sticks)),
    }
