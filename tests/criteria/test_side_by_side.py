"""Pairs side by side: the same as text and as numbers, one row a pair."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from helpers.analysed import wall
from helpers.pages import Page, make_job

from common.pairs import SHARES
from criteria import judge
from stickiness import Material, datasets
from stickiness import judge as judge_pairs
from stickiness.entries import check_material
from stickiness.verdicts.limits import read_limited

pytestmark = pytest.mark.usefixtures("coarse_simulation")

COMMON = {"work_of_adhesion": "50 mJ/m^2", "range": "0.3 nm"}
FILM = {"youngs_modulus": "4 GPa", "poisson_ratio": 0.4, "thickness": "50 um"}
MATERIALS = {
    "psa": COMMON | {"label": "adhesive", "plane_strain_modulus": "0.1 MPa"},
    "tape": COMMON | FILM | {"label": "a | b", "youngs_modulus": "60 kPa", "backing": FILM},
    "stiff": COMMON | {"label": "stiff", "plane_strain_modulus": "1 GPa", "range": "0.3 um"},
}
SURFACES = {"asphalt": 1e-5, "pane < 1 m": 1e-7, "spiky": 1e-7}  # rms heights in m


@pytest.fixture
def written(tmp_path):
    """Files that the rule writes, by name."""
    entries = {name: check_material(entry) for name, entry in MATERIALS.items()}
    materials = {name: Material.from_entry(entry) for name, entry in entries.items()}
    paths = []
    for name, h_rms in SURFACES.items():
        surface = wall(h_rms, not_judged="spikes" if name == "spiky" else "")
        verdicts = judge_pairs(materials, {name: surface})
        paths.append(tmp_path / f"{len(paths)}.nc")
        datasets.write(verdicts, paths[-1], title="verdicts", parameters={})
    endings = {"dataset": "nc", "table": "md", "page": "html", "csv": "csv", "workbook": "xlsx"}
    outputs = {name: str(tmp_path / f"v.{ending}") for name, ending in endings.items()}
    templates = {"template": "report/verdicts.md.j2", "page": "report/verdicts.html.j2"}
    inputs = templates | {"verdicts": paths}
    labels = {name: name for name in SURFACES}
    judge.main(make_job(inputs, outputs, materials=entries, labels=labels))
    return outputs


def test_no_label_is_a_formula():
    labels = ["=1+1", "+1", "-1", "@sum", "|x", "a=b", "gel"]
    kept = [judge.keep_text(label) for label in labels]
    assert kept == ["'=1+1", "'+1", "'-1", "'@sum", "|x", "a=b", "gel"]


def test_rows_are_sorted_and_say_what_the_verdicts_say(written):
    frame, dataset = pd.read_csv(written["csv"]), datasets.read(written["dataset"])
    assert len(frame) == len(MATERIALS) * len(SURFACES)
    # The user's pairs come first. In both parts w/U_full falls; what is not judged is last.
    mine = frame["material key"].ne("psa") & frame["surface key"].ne("asphalt")
    assert (mine == frame.entry.eq("yours")).all()
    assert mine.is_monotonic_decreasing
    ratios = frame["w/U_full"]
    for part in (mine, ~mine):
        assert ratios[part].fillna(-1).is_monotonic_decreasing
    for _, row in frame.iterrows():
        pair = dataset.sel(material=row["material key"], surface=row["surface key"])
        if row["surface key"] == "spiky":
            assert row.verdict == "not judged"
            assert row.filter(regex="remains|pull-off|threshold|keeps").isna().all()
            continue
        value, *limits = read_limited(pair.remaining)
        wanted = [100 * x for x in (value, *limits)]
        assert row.filter(like="remains").tolist() == pytest.approx(wanted, rel=1e-5)
        for share in SHARES:
            assert row[f"keeps {100 * share:g} % by value"] == ("yes" if value >= share else "no")
            kept = sum(limit >= share for limit in limits)
            assert row[f"keeps {100 * share:g} % by limits"] == ("no", "depends", "yes")[kept]
        margin = read_limited(pair.margin).value
        for symbol in ("E", "E*"):
            if symbol == "E" and np.isnan(pair.poisson_ratio):
                assert np.isnan(row["E [MPa]"])
                continue
            threshold = row[f"threshold of {symbol} [MPa]"] / row[f"{symbol} [MPa]"]
            assert threshold == pytest.approx(margin, rel=1e-4)
    # Near full contact only a low limit of the pull-off is known.
    unknown = frame[ratios > 10].filter(like="pull-off").isna()
    assert unknown.all().tolist() == [True, False, True]


def test_workbook_holds_numbers_and_the_page_words(written):
    frame, sheet = pd.read_csv(written["csv"]), pd.read_excel(written["workbook"])
    pd.testing.assert_frame_equal(sheet, frame, check_dtype=False, rtol=1e-5)
    page = Page(Path(written["page"]).read_text(encoding="utf-8"))
    page.check(
        "Stiff: range = 3e-07 is outside 1e-11 to 1e-07: molecules",
        "a | b",
        "pane < 1 m",
        "Keeps 30 %",
        "not judged",
        "peel force",
    )
    table = Path(written["table"]).read_text(encoding="utf-8")
    assert table.startswith("# Do they stick?\n\n**Stiff: range = 3e-07 is outside")
    assert "| a \\| b | pane < 1 m |" in table
