"""Claims on contact with adhesion, on made-up files."""

import numpy as np
import pytest
from helpers.claim_files import adhesive, loop

from claims import adhesion_claims as adhesion_claims
from claims.ledger import NOT, OPEN, QUALIFIED, REPRODUCED
from common.conventions import LOAD
from common.formatting import percent


@pytest.mark.slow
def test_threshold_lies_between_the_lengths_around_it(files):
    full = files["adhesive_fig2"]
    claim = adhesion_claims.kappa_threshold(files)
    below = full.inverse_kappa.sel(pressure=LOAD, method="nearest").isel(range_over_h_rms=0)
    # the last length with a positive slope and the first with a negative one
    lengths = full.adhesion_length_over_range.values
    first = int(np.flatnonzero(below.values < 0)[0])
    assert lengths[first - 1] < claim.value < lengths[first]
    assert claim.verdict == QUALIFIED
    at = float(below[int(np.argmin(np.abs(below.values - 0.25)))])
    # Half of l_a/range as made up, at every load, between lengths by their logarithms.
    area = np.interp(np.log(claim.value), np.log(lengths), 0.5 * lengths)
    assert f"{claim.value:.2g} at an area of {percent(area)} (mean gap of p = 0.03)" in claim.remark
    assert f"1/kappa is {at:.2f} ± {0.05 * at:.2f} by that area and {1.1 * at:.2f}" in claim.remark


def test_threshold_that_is_not_reached_is_no_number_of_its_own(files):
    files["adhesive_fig2"] = adhesive(64, scale=1e-3)
    claim = adhesion_claims.kappa_threshold(files)
    assert claim.verdict == OPEN
    assert claim.value == float(files["adhesive_fig2"].adhesion_length_over_range[-1])
    assert "largest simulated" in claim.quantity


@pytest.mark.parametrize(
    ("made", "verdict"),
    [({}, REPRODUCED), ({"wider": 1.0}, QUALIFIED), ({"pull_off": 0.01}, NOT)],
)
def test_loop_is_graded_by_its_width_and_its_pull_off(files, made, verdict):
    files["loop"] = loop(**made)
    claim = adhesion_claims.hysteresis(files)
    assert claim.verdict == verdict
    assert claim.value == pytest.approx(made.get("pull_off", -0.02))
    assert "At p = 0.02 the area is 0.040 on loading" in claim.remark
    if "pull_off" not in made:
        assert "at zero gap is 0.030, of which 0.022 is compressed" in claim.remark
    assert "25 % of the work" in claim.remark


@pytest.mark.slow
@pytest.mark.parametrize(
    ("scale", "verdict"), [(1, REPRODUCED), (2, QUALIFIED), (5, NOT), (0.2, NOT)]
)
def test_simulation_is_compared_with_the_formula(files, scale, verdict):
    for name in ("rough", "rough_near"):
        files[f"adhesive_{name}"] = adhesive(64, q0_h_rms=0.3, scale=scale)
    files["adhesive_smooth"] = adhesive(128, q0_h_rms=0.006, scale=scale)
    claim = adhesion_claims.inverse_kappa_ad(files)
    assert claim.value == pytest.approx(scale)
    assert claim.uncertainty == pytest.approx(0.05 * scale)
    assert claim.verdict == verdict
    assert f"{0.8 * scale:.2f} to {0.8 * scale:.2f}" in claim.remark  # directly
    assert "2.90 ± 0.14" in claim.remark  # a_V of the surfaces
