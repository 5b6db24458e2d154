"""The rule that examines every claim."""

from pathlib import Path

import numpy as np
import pytest
from helpers.claim_files import files_by_name

from claims import check_claims
from claims.check_claims import CLAIMS, PROSE
from claims.ledger import OPEN, REPRODUCED, VERDICTS, Finding, claim
from common.templates import make_environment, write_power
from stickiness import datasets

ENVIRONMENT = make_environment(Path(__file__).parents[2] / "report")


@pytest.mark.slow
def test_every_claim_runs_on_the_files_it_names():
    """A claim gets these files alone, so it cannot read another."""
    files = files_by_name()
    assert files.keys() == {name for claim in CLAIMS for name in claim.files}
    for one in CLAIMS:
        found = one(files)
        assert found.verdict in VERDICTS
        assert np.isfinite(found.value)
        prose = check_claims.write_prose(one.number, found.facts, ENVIRONMENT)
        assert all(prose[name] for name in PROSE)
        assert "nan" not in " ".join(prose.values()).split()
        if one.number in (1, 2, 3, 4, 6, 7, 8, 9):  # the made-up files obey these exactly
            assert found.verdict == REPRODUCED, one.number


def test_sources_are_listed_once_in_the_order_of_the_claim():
    paths = {"map": "a.nc", "asphalt": "b.nc", "surfaces": ["b.nc", "c.nc"], "unused": "d.nc"}
    several = claim(1, "asphalt", "surfaces", "map")(lambda files: None)
    assert check_claims.find_sources(several, paths) == ["b.nc", "c.nc", "a.nc"]


def test_a_file_that_the_rule_does_not_give_is_named():
    misspelt = claim(7, "maps")(lambda files: None)
    with pytest.raises(ValueError, match=r"claim 7 reads 'maps'.* it gives asphalt, map:"):
        check_claims.find_paths({"map": "a.nc", "asphalt": "b.nc"}, [misspelt])


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (2.0789, 0.0284, "2.079 ± 0.028"),
        (1.1312, np.nan, "1.131"),
        (1.1312, 0.0, "1.131 (exact)"),
        (np.nan, 0.1, "not known"),
    ],
)
def test_value_is_written_with_its_error_if_that_is_known(value, error, text):
    assert check_claims.write_measured(value, error) == text


def test_a_source_that_is_not_known_dominates():
    errors = {"sampling": 0.3, "model": np.nan}
    finding = Finding(value=1.0, verdict=OPEN, errors=errors)
    assert check_claims.name_dominant(finding) == "model (not known)"
    finding = Finding(value=1.0, verdict=OPEN, errors={"sampling": 0.3, "model": 0.4})
    assert check_claims.name_dominant(finding) == "model"


@pytest.mark.parametrize(("number", "text"), [(10, "10"), (1000, "1000"), (5e4, "5e4")])
def test_magnifications_in_words(number, text):
    assert write_power(number) == text


def test_a_claim_of_which_nothing_is_known_is_open_and_written(tmp_path):
    """For example if the grids of a quick run know no point of Figure 4B well enough."""
    files = files_by_name()
    for name in ("rough", "rough_near", "smooth"):
        data = files[f"adhesive_{name}"]
        files[f"adhesive_{name}"] = data.assign(inverse_kappa_ad=-data.inverse_kappa_ad)
    (eleventh,) = (one for one in CLAIMS if one.number == 11)
    paths = dict.fromkeys(eleventh.files, "full.nc")
    row = check_claims.examine(eleventh, files, paths, ENVIRONMENT)
    assert row["verdict"] == OPEN
    assert row["measured"] == "not known"
    dataset = check_claims.to_dataset([row])
    datasets.write(dataset, tmp_path / "claims.nc", title="claims", parameters={})
    assert np.isnan(datasets.read(tmp_path / "claims.nc").value.item())
