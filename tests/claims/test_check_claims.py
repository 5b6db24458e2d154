"""The rule that examines every claim."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from helpers.claim_files import files_by_name

from claims import check_claims
from claims.all_claims import CLAIMS
from claims.ledger import OPEN, REPRODUCED, VERDICTS, claim
from stickiness import datasets
from stickiness.accuracy import plan

RULES = Path(__file__).parents[2] / "rules"


def ledger_inputs():
    """The inputs of the rule, with one assumed and one measured surface, and two seeds."""
    (text,) = (
        text
        for path in RULES.glob("*.smk")
        if "def ledger_inputs" in (text := path.read_text(encoding="utf-8"))
    )
    start = text.index("def ledger_inputs")
    names = {
        "RESULTS": "out",
        "REMAINING_TABLE": "config/remaining.csv",
        "PAPER_SURFACES": ("asphalt", "polished_steel"),
        "FIG4B": ("rough", "rough_near", "smooth"),
        "paper_surface": lambda name: f"out/real_surfaces/{name}.nc",
        "REAL_SURFACES": {"steel": {"kind": "self_affine"}, "terrain": {"kind": "measured"}},
        "seeds_of": lambda case: [1, 2],
        "plan": plan,
        "surfaces_of": lambda case, part: f"out/surfaces/{case}/seeds{part}.nc",
        "a_v_of_simulation": lambda case: f"out/fits/a_v/ensembles/{case}.nc",
    }
    exec(text[start : text.index("\n\n\n", start)], names)
    return names["ledger_inputs"]()


@pytest.mark.slow
def test_every_claim_runs_on_the_files_it_names():
    """A claim is given these files alone, so that it cannot read another."""
    files = files_by_name()
    findings = {claim.number: claim(files) for claim in CLAIMS}
    assert list(findings) == list(range(1, 23))
    for found in findings.values():
        assert found.verdict in VERDICTS
        assert np.isfinite(found.value)
        assert "nan" not in found.remark + found.quantity
    for number in (1, 2, 3, 4, 6, 7, 8, 9):  # what the made-up world obeys to the letter
        assert findings[number].verdict == REPRODUCED, findings[number]


def test_the_rule_gives_the_files_that_claims_read_and_no_others():
    assert ledger_inputs().keys() == {name for claim in CLAIMS for name in claim.files}
    assert ledger_inputs().keys() == files_by_name().keys()


def test_only_measured_surfaces_are_given_to_test_the_line():
    assert ledger_inputs()["measured_surfaces"] == ["out/real_surfaces/terrain.nc"]


def test_sources_are_listed_once_in_the_order_of_the_claim():
    paths = {"map": "a.nc", "asphalt": "b.nc", "surfaces": ["b.nc", "c.nc"], "unused": "d.nc"}
    several = claim(1, "several", files=("asphalt", "surfaces", "map"))(lambda files: None)
    assert check_claims.source_paths(several, paths) == ["b.nc", "c.nc", "a.nc"]


def test_a_file_that_the_rule_does_not_give_is_named():
    misspelt = claim(7, "misspelt", files=("maps",))(lambda files: None)
    with pytest.raises(ValueError, match=r"claim 7 reads 'maps'.* it gives asphalt, map:"):
        check_claims.input_paths({"map": "a.nc", "asphalt": "b.nc"}, [misspelt])


def test_value_is_written_with_its_error_if_that_is_known():
    assert check_claims.with_error(2.0789, 0.0284) == "2.079 ± 0.028"
    assert check_claims.with_error(1.1312, np.nan) == "1.131"
    assert check_claims.with_error(1.1312, 0.0) == "1.131 (exact)"


def test_a_source_that_is_not_known_dominates():
    finding = SimpleNamespace(errors={"sampling": 0.3, "model": np.nan}, uncertainty=np.nan)
    assert check_claims.name_dominant(finding) == "model (not known)"
    finding = SimpleNamespace(errors={"sampling": 0.3, "model": 0.4}, uncertainty=0.5)
    assert check_claims.name_dominant(finding) == "model"


def test_a_claim_of_which_nothing_is_known_is_open_and_written(tmp_path):
    """As where adhesion on the grids of a quick run is known to no point of Figure 4B."""
    files = files_by_name()
    for name in ("rough", "rough_near", "smooth"):
        data = files[f"adhesive_{name}"]
        files[f"adhesive_{name}"] = data.assign(inverse_kappa_ad=-data.inverse_kappa_ad)
    (eleventh,) = (one for one in CLAIMS if one.number == 11)
    found, sources = eleventh(files), [["full.nc"]]
    assert found.verdict == OPEN
    dataset = check_claims.to_dataset([eleventh], [found], sources)
    datasets.write(dataset, tmp_path / "claims.nc", title="claims", parameters={})
    assert np.isnan(datasets.read(tmp_path / "claims.nc").value.item())
    assert "over the formula: not known |" in check_claims.to_markdown([eleventh], [found], sources)
