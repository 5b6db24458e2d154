"""Pairs side by side: one row a pair, the same on the page, as text and as numbers."""

import json
from pathlib import Path

import numpy as np
import openpyxl
import pandas as pd
import pytest
import xarray as xr
from helpers.pages import Page, make_job

from common.materials import read_material
from common.verdicts import SHARES, find_limits
from criteria import judge, verdicts
from stickiness.criteria.a_v_table import SurfaceAv
from stickiness.criteria.pair import NOT_JUDGED
from stickiness.spectrum import SelfAffine

A_V = SurfaceAv(np.array([1e-9, 1.0]), np.array([[4.0, 4.0]]), 0.1)
FILM = {"youngs_modulus": "4 GPa", "poisson_ratio": 0.4, "thickness": "50 um"}
SOFT = {"youngs_modulus": "60 kPa", "poisson_ratio": 0.4, "thickness": "50 um", "backing": FILM}
MATERIALS = {
    "psa": {"label": "adhesive", "plane_strain_modulus": "0.1 MPa"},
    "tape": {"label": "tape | film", **SOFT},
    "stiff": {"label": "stiff, brittle", "plane_strain_modulus": "1 GPa", "range": "0.3 um"},
}
SURFACES = {"asphalt": "a road", "pane": "a pane < 1 m", "spiky": "a pane with spikes"}


@pytest.fixture
def tables(monkeypatch, tmp_path):
    """The verdicts, and what the rule writes of them: Markdown, page, CSV and workbook."""
    monkeypatch.setattr(verdicts, "find_a_v", lambda surface: (A_V, A_V))
    surfaces, q = {}, np.geomspace(1e5, 1e9, 60)
    for (key, label), h_rms in zip(SURFACES.items(), (1e-5, 1e-7, 1e-7), strict=True):
        ends = [SelfAffine(hurst=0.8, q0=1e5, q1=1e9, h_rms=h) for h in (h_rms, 2 * h_rms)]
        names = ("h_rms", "rms_slope", "rms_curvature")
        data = {n: ("end", [getattr(s, n) for s in ends]) for n in names}
        data["elastic_energy"] = "end", [s.elastic_energy() for s in ends]
        data["psd"] = ("end", "wave_number"), [s.psd(q) for s in ends]
        data = xr.Dataset(
            data | {"q0": 1e5, "q1": 1e9}, {"end": ["smooth", "rough"], "wave_number": q}
        )
        doubts = {"not_judged": "spikes" if key == "spiky" else ""}
        surfaces[key] = data.assign_attrs(parameters=json.dumps({"label": label}), **doubts)
    monkeypatch.setattr(judge, "read_surfaces", lambda *_: surfaces)
    common = {"work_of_adhesion": "50 mJ/m^2", "range": "0.3 nm"}
    materials = {key: common | entry for key, entry in MATERIALS.items()}
    endings = {"dataset": "nc", "table": "md", "page": "html", "csv": "csv", "workbook": "xlsx"}
    outputs = {name: str(tmp_path / f"v.{ending}") for name, ending in endings.items()}
    inputs = {
        "surfaces": [],
        "template": "report/verdicts.md.j2",
        "page": "report/verdicts.html.j2",
    }
    grid = {"minimum": 1.0, "maximum": 10.0, "per_decade": 1}
    given = {"materials": materials, "material_surfaces": [], "labels": SURFACES}
    judge.main(make_job(inputs, outputs, frequencies=grid, **given))
    assert read_material(materials["tape"]).is_scalable is False
    return xr.open_dataset(outputs["dataset"]), outputs


def test_side_by_side(tables):
    dataset, files = tables
    frame = pd.read_csv(files["csv"])
    assert len(frame) == len(MATERIALS) * len(SURFACES)
    # The user's pairs come first, and in both parts w/U_full falls; what is not judged is last.
    mine = frame.entry == "yours"
    assert mine.tolist() == sorted(mine, reverse=True)
    users = frame["material key"].ne("psa") & frame["surface key"].ne("asphalt")
    assert (mine == users).all()
    ratios = frame[["w/U_full, smooth end", "w/U_full, rough end"]].mean(axis=1)
    for part in (mine, ~mine):
        assert ratios[part].dropna().is_monotonic_decreasing
        assert ratios[part].isna().is_monotonic_increasing
    for _, row in frame.iterrows():
        pair = dataset.sel(material=row["material key"], surface=row["surface key"])
        remains = row.filter(like="remains, ").to_numpy(float)
        if int(pair.verdict) == NOT_JUDGED:
            assert row.verdict == "not judged"
            assert row.drop(["judged"]).isna().sum() == 3 * 4 + 2 + 2 * len(SHARES)
            continue
        ends = [float(pair.remaining.sel(end=end)) for end in ("smooth", "rough")]
        limits = [float(limit) for limit in find_limits(pair)]
        assert remains == pytest.approx([100 * x for x in (*ends, *limits)], rel=1e-5)
        for share in SHARES:
            for kind, (low, high) in (("value", sorted(ends)), ("limits", limits)):
                expected = {(True, True): "yes", (False, False): "no", (False, True): "depends"}
                answer = row[f"keeps {100 * share:g} % by {kind}"]
                assert answer == expected[low >= share, high >= share]
        # On a film no modulus of the layer alone is a threshold.
        on_film = row["material key"] == "tape"
        assert row.filter(like="threshold").isna().all() == on_film
    assert frame["E* [MPa]"].max() == pytest.approx(1000)
    # Near full contact only a low limit of the pull-off is known.
    full = frame[ratios > 10].filter(like="pull-off")
    assert len(full)
    assert full.isna().sum().tolist() == [len(full), len(full), 0, len(full)]


def test_numbers_are_numbers_in_the_workbook_and_words_on_the_page(tables):
    _, files = tables
    frame = pd.read_csv(files["csv"])
    sheet = openpyxl.load_workbook(files["workbook"])["pairs"]
    heads, *rows = sheet.iter_rows(values_only=True)
    assert list(heads) == list(frame.columns)
    again = pd.DataFrame(rows, columns=heads)
    numeric = frame.select_dtypes("number").columns.drop("judged", errors="ignore")
    np.testing.assert_allclose(again[numeric].astype(float), frame[numeric], rtol=1e-5)
    page = Page(Path(files["page"]).read_text(encoding="utf-8"))
    page.check(
        "Stiff, brittle: range = 0.3 µm is improbable: molecules attract",
        "tape | film",
        "a pane < 1 m",
        "Keeps 30 %",
        "not known",
        "not judged",
        "peel",
    )
    table = Path(files["table"]).read_text("utf-8")
    assert table.startswith("# Do they stick?\n\n**Stiff, brittle: range = 0.3 um is improbable: ")
    assert "tape \\| film | a pane < 1 m" in table
