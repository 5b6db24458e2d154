"""The rule that examines every claim."""

import numpy as np
import pytest
from helpers.claim_files import files_by_name

from claims import check_claims, errata
from claims.check_claims import CLAIMS, PROSE
from claims.ledger import OPEN, REPRODUCED, VERDICTS
from stickiness import datasets
from stickiness.error_budget import SOURCES
from stickiness.pages.rendering import write_page

TEXTS = "report/claims.j2"


def write_table(rows, path):
    write_page("report/claims.md.j2", path, claims=rows, recomputed=errata.recompute())
    return path.read_text(encoding="utf-8")


def test_claims_are_numbered_without_gaps():
    assert [claim.number for claim in CLAIMS] == list(range(1, 1 + len(CLAIMS)))


@pytest.mark.slow
def test_every_claim_runs_on_the_files_it_names(tmp_path):
    """A claim gets these files alone, so it cannot read another."""
    files = files_by_name()
    assert files.keys() == {name for claim in CLAIMS for name in claim.files}
    paths = dict.fromkeys(files, "a.nc")
    rows = [check_claims.examine(one, files, paths, TEXTS, differences=[]) for one in CLAIMS]
    for row in rows:
        assert row["verdict"] in VERDICTS
        assert row["errors"].keys() <= {*SOURCES}
        assert np.isfinite(row["value"])
        assert all(row[name] for name in PROSE if name != "difference")
        assert not row["difference"]
        assert "nan" not in " ".join(row[name] for name in PROSE).split()
        if row["number"] in (1, 2, 3, 4, 6, 7, 8, 9):  # the made-up files obey these exactly
            assert row["verdict"] == REPRODUCED, row["number"]
    text = write_table(rows, tmp_path / "claims.md")
    assert "2.00 ± 0.10 | discretisation |" in text
    assert "(exact)" in text


def test_a_claim_of_which_nothing_is_known_is_open_and_written(tmp_path):
    """For example if the grids of a quick run know no point of Figure 4B well enough."""
    files = files_by_name()
    files["adhesive_sets"] = [
        data.assign(inverse_kappa_ad=-data.inverse_kappa_ad) for data in files["adhesive_sets"]
    ]
    (eleventh,) = (one for one in CLAIMS if one.number == 11)
    paths = dict.fromkeys(eleventh.files, "full.nc")
    row = check_claims.examine(eleventh, files, paths, TEXTS, differences=[])
    assert row["verdict"] == OPEN
    assert ": not known |" in write_table([row], tmp_path / "claims.md")
    row |= {"errors": {"sampling": 0.3, "model": np.nan}}
    assert "| model (not known) |" in write_table([row], tmp_path / "claims.md")
    dataset = check_claims.to_dataset([row])
    datasets.write(dataset, tmp_path / "claims.nc", title="claims", parameters={})
    assert np.isnan(datasets.read(tmp_path / "claims.nc").value.item())
