"""Parts of quoted numbers that choose, average or round."""

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from pipeline.conventions import LOAD
from pipeline.quoted import adhesion, remaining, theory, times
from pipeline.quoted.sources import say_count, say_range, say_shares


def test_counts_ranges_and_shares_in_words():
    assert (say_count(0), say_count(14), say_count(40)) == ("none", "fourteen", "40")
    assert say_range([3.04, 2.6]) == "2.6 to 3"
    assert say_shares([0.149, 0.188]) == "15 to 19 %"


def compared():
    """Theory 10 % too high at a load that the cell holds, 50 % at one that it does not."""
    loads, gaps = [0.001, LOAD], [0.1, 1.0, 4.0]
    difference = [0.5, 0.1]
    return xr.Dataset(
        {
            "area_fraction_difference": ("pressure", difference),
            "window_holds": ("pressure", [0, 1]),
            "gap_density_difference": (("pressure", "gap"), np.full((2, 3), 0.3)),
            # The second gap is not known well enough, the third is too large.
            "gap_density_difference_total_error": (("pressure", "gap"), [[0.1, 0.9, 0.1]] * 2),
        },
        coords={"pressure": loads, "gap": gaps},
    )


def test_differences_that_cannot_be_told_are_left_out():
    assert theory.list_differences(compared(), "area_fraction") == pytest.approx(
        [np.nan, 0.1], nan_ok=True
    )
    assert theory.list_differences(compared(), "gap_density") == pytest.approx(
        [0.3, np.nan, np.nan], nan_ok=True
    )


def test_root_mean_square_pools_the_points_of_all_surfaces():
    one = compared().expand_dims(variant=["v"])
    other = one.assign(area_fraction_difference=one.area_fraction_difference * 0 + 0.2)
    assert theory.root_mean_square([one, other], "v", "area_fraction") == pytest.approx(
        np.sqrt((0.1**2 + 0.2**2) / 2)
    )


def test_surfaces_without_a_load_are_not_picked():
    assert theory.pick([compared()], "area_fraction", LOAD) == [0.1]
    assert theory.pick([compared()], "area_fraction", 0.01) == []


def test_works_within_a_quarter_where_enough_remains():
    frame = pd.DataFrame(
        {"predicted": [0.12, 0.10, 0.01], "approach": [0.10, 0.2, 0.04], "separation": 0.1}
    )
    assert remaining.say_near(frame, ("approach",)) == ("50 %", "2")
    assert remaining.say_near(frame, ("approach", "separation")) == ("60 %", "5")


def test_means_of_bins_with_several_points():
    strength, ratio = np.array([0.3, 0.4, 0.7, 1.2, 1.3]), np.array([1.0, 1.2, 9.0, 0.7, 0.9])
    found = adhesion.average_bins(strength, ratio)
    assert np.array(found) == pytest.approx(np.array([(0.2, 1.1), (1.0, 0.8)]))


@pytest.mark.slow
def test_a_dry_run_that_fails_says_why(tmp_path):
    with pytest.raises(RuntimeError, match="(?i)snakefile"):
        times.count_jobs(tmp_path)
