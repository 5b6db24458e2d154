"""A claim has a grade only if the configuration has the parameters that the claim is about."""

import numpy as np
import pytest
import xarray as xr
from helpers.claim_files import ensemble, files_by_name, fit, sweep
from helpers.committed import ROOT, read_committed

from claims import check_claims, errata
from claims.check_claims import CLAIMS
from claims.ledger import DIFFERS, VERDICTS
from common.paper import find_differences
from report.write_report import CLAIM_TONES
from stickiness.pages.rendering import make_environment, write_page


@pytest.fixture
def committed(monkeypatch):
    return read_committed(monkeypatch)


def examine(number, files, differences):
    (claim,) = [claim for claim in CLAIMS if claim.number == number]
    paths = dict.fromkeys(claim.files, "a.nc")
    return check_claims.examine(claim, files, paths, "report/claims.j2", differences[number])


def list_ungraded(committed):
    return {number for number, differences in find_differences(*committed).items() if differences}


def test_the_committed_configuration_leaves_every_claim_its_grade(committed):
    assert list_ungraded(committed) == set()


def test_other_hurst_exponents_are_stated_and_have_no_grade(committed):
    hursts = [0.4, 0.5, 0.6]
    committed[0]["theory"]["sweeps"]["fig3c"]["hurst"] = hursts
    files = files_by_name()
    theory = sweep((10.0, 100.0, 1e4, 1e5, 1e6), hursts=hursts)
    files["fit_fig3c"] = fit(theory, 1.7, 1.5, 2.0)
    row = examine(8, files, find_differences(*committed))
    assert row["verdict"] == DIFFERS
    assert "H = 0.6," in row["quantity"]
    assert "reproduced" not in row["remark"]
    expected = "theory.sweeps.fig3c.hurst: H = 0.4, 0.5, 0.6 (paper: 0.7, 0.8, 0.9)"
    assert row["difference"] == expected
    assert list_ungraded(committed) == {8}


@pytest.mark.parametrize(
    ("path", "value", "ungraded"),
    [
        ("model_surfaces/H0.8_zeta128/hurst", 0.7, {1, 11}),
        ("model_surfaces/H0.8_zeta128/magnification", 16.0, {1, 11}),
        ("model_surfaces/H0.8_zeta32/hurst", 0.7, {10}),
        ("model_surfaces/H0.8_zeta32_wide/hurst", 0.7, {4, 7}),
        ("cases/H0.8_zeta128/pressures", [0.03, 0.06, 0.2], {1}),
        ("cases/H0.8_zeta32_wide/pressures", [0.01, 0.065, 0.52], {4, 7}),
        ("theory/sweeps/fig1b/mean_gap", [2.0], {2}),
        ("theory/sweeps/fig3a/pressure", [0.2], {3, 6}),
        ("theory/sweeps/fig3a/magnification", [10.0, 1000.0], {3, 6}),
        ("theory/sweeps/fig3c/magnification", [10.0, 100.0, 1000.0], {8}),
        ("theory/sweeps/fig3d/pressure", [0.01, 0.1], {9}),
        ("adhesion/fig2/range_over_h_rms", [0.1], {5}),
        ("adhesion/fig4b_rough/h_rms", 4e-6, {11}),
        ("criteria/map/slope_a_v", 2.8, {12}),
        # Values that the claims do not select, and differences within the tolerance.
        ("theory/sweeps/fig3a/hurst", [0.3, 0.8], set()),
        ("theory/sweeps/fig3c/hurst", [0.3, 0.7, 0.8, 0.9], set()),
        ("model_surfaces/H0.8_zeta128/hurst", 0.8001, set()),
        ("fidelity", "draft", set()),
    ],
)
def test_claims_lose_their_grade_with_their_parameters(committed, path, value, ungraded):
    entry = committed[0]
    *parents, key = path.split("/")
    for parent in parents:
        entry = entry[parent]
    entry[key] = value
    assert list_ungraded(committed) == ungraded


@pytest.mark.parametrize(
    ("surface", "key", "value", "ungraded"),
    [
        ("asphalt", "hurst", 0.7, {14, 20}),
        ("asphalt", "C0", [1e-5, 1e-4], {14, 20}),
        ("polished_steel", "h_rms", 1e-7, {15}),
    ],
)
def test_real_surfaces_of_the_paper_are_compared_too(committed, surface, key, value, ungraded):
    committed[1][surface][key] = value
    assert list_ungraded(committed) == ungraded


def test_further_hurst_exponents_do_not_change_the_value():
    """The claims choose those of the paper, wherever these are in the list."""
    files = files_by_name()
    broad = (1000.0, 1e4, 5e4)
    (law,) = [claim for claim in CLAIMS if claim.number == 3]
    alone = law(files).value
    other = sweep(broad, hursts=(0.3,), exponent=-0.9)
    files["fig3a"] = xr.concat([other, files["fig3a"]], "hurst", data_vars="minimal")
    assert law(files).value == pytest.approx(alone)


def test_theory_of_another_hurst_exponent_is_not_compared_with_a_simulation():
    files = files_by_name()
    files["fit_bem_broad_band"] = fit(ensemble(128, hurst=0.6), 2.9, 3.0, 3.1)
    (convergence,) = [claim for claim in CLAIMS if claim.number == 8]
    assert np.isnan(convergence(files).facts["continuous"])


def test_every_verdict_has_a_mark_a_meaning_and_a_tone(tmp_path):
    legend = make_environment(ROOT / "report").get_template("claim_verdicts.j2").module
    assert (*legend.claim_verdicts,) == (*CLAIM_TONES,) == VERDICTS
    marks = [legend.mark(verdict) for verdict in VERDICTS]
    assert len({*marks}) == len(VERDICTS)
    difference = {"key": "loops.fig4a.surface", "here": "H = 0.6", "paper": "0.8"}
    row = examine(10, files_by_name(), {10: [difference]})
    path = tmp_path / "claims.md"
    write_page(ROOT / "report/claims.md.j2", path, claims=[row], recomputed=errata.recompute())
    assert f"**≠ {DIFFERS}** (loops.fig4a.surface: H = 0.6 (paper: 0.8))" in path.read_text("utf-8")
