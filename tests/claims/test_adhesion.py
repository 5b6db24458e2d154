"""Claims on contact with adhesion, on made-up files."""

import numpy as np
import pytest
from helpers.claim_files import adhesive, loop

from claims import adhesion_claims
from claims.ledger import NOT, OPEN, QUALIFIED, REPRODUCED
from common.paper import at_load


@pytest.mark.slow
def test_threshold_lies_between_the_lengths_around_it(files):
    full = files["adhesive_fig2"]
    claim = adhesion_claims.kappa_threshold(files)
    below = at_load(full.inverse_kappa).isel(range_over_h_rms=0)
    # the last length with a positive slope and the first with a negative one
    lengths = full.adhesion_length_over_range.values
    first = int(np.flatnonzero(below.values < 0)[0])
    assert lengths[first - 1] < claim.value < lengths[first]
    assert claim.verdict == QUALIFIED
    # Half of l_a/range as made up, at every load, between lengths by their logarithms.
    area = np.interp(np.log(claim.value), np.log(lengths), 0.5 * lengths)
    found = {load: (threshold, area) for threshold, area, load in claim.facts["areas"]}
    assert found[0.03] == pytest.approx((claim.value, area))


def test_threshold_that_is_not_reached_is_no_number_of_its_own(files):
    files["adhesive_fig2"] = adhesive(64, scale=1e-3)
    claim = adhesion_claims.kappa_threshold(files)
    assert claim.verdict == OPEN
    assert claim.value == float(files["adhesive_fig2"].adhesion_length_over_range[-1])
    assert not claim.facts["crosses"]


@pytest.mark.parametrize(
    ("made", "verdict"), [({}, REPRODUCED), ({"wider": 1.0}, QUALIFIED), ({"pull_off": 0.01}, NOT)]
)
def test_loop_is_graded_by_its_width_and_its_pull_off(files, made, verdict):
    files["loop"] = loop(**made)
    claim = adhesion_claims.hysteresis(files)
    assert claim.verdict == verdict
    assert claim.value == pytest.approx(made.get("pull_off", -0.02))
    assert claim.facts["load"] == pytest.approx(0.02)
    assert claim.facts["loading"] == pytest.approx(0.04)
    if "pull_off" not in made:
        last = claim.facts["last"]
        assert float(last.repulsive_area_fraction) == pytest.approx(0.03)
        assert float(last.net_repulsive_area_fraction) == pytest.approx(0.0225)
    assert float(claim.facts["lost"]) == pytest.approx(0.25)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("scale", "verdict"), [(1, REPRODUCED), (2, QUALIFIED), (5, NOT), (0.2, NOT)]
)
def test_simulation_is_compared_with_the_formula(files, scale, verdict):
    files["adhesive_sets"] = [adhesive(64, 0.3, scale), adhesive(128, 0.006, scale)]
    files["adhesion_sets"] = files["adhesion_sets"][1:]
    claim = adhesion_claims.inverse_kappa_ad(files)
    assert claim.value == pytest.approx(scale)
    assert claim.uncertainty == pytest.approx(0.05 * scale)
    assert claim.verdict == verdict
    assert claim.facts["direct"][:2] == pytest.approx((0.8 * scale, 0.8 * scale))
    assert claim.facts["a_v"][0] == pytest.approx((2.9, 0.145))
