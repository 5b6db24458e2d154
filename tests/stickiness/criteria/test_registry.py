"""One table of criteria: an entry is all that a new criterion needs."""

import numpy as np
import pytest
from helpers.analysed import fix_a_v, wall

from common.materials import read_material
from criteria import verdicts
from criteria.judge import describe_page
from report import table_rows, write_report
from stickiness.criteria.registry import CRITERIA, Criterion

GEL = {
    "label": "gel",
    "plane_strain_modulus": "0.1 MPa",
    "work_of_adhesion": "50 mJ/m^2",
    "range": "0.3 nm",
}


@pytest.fixture
def judge(monkeypatch):
    """Function that judges an entry of a material on a wall."""
    fix_a_v(monkeypatch)
    given = {"wall": wall()}, {}, np.ones(1)
    return lambda entry: verdicts.find_verdicts({"gel": read_material(entry)}, *given)


@pytest.fixture
def made_up(monkeypatch):
    """A criterion of the least adhesion length over the rms height."""
    entry = Criterion(
        "made_up",
        "Made & Up",
        margin=lambda pair: (pair.adhesion_length / pair.h_rms) ** 2,
        power=2.0,
        reason="Heights of {h_rms} against nothing else.",
    )
    monkeypatch.setitem(CRITERIA, "made_up", entry)
    return entry


@pytest.mark.slow
def test_an_entry_is_all_that_a_new_criterion_needs(made_up, judge):
    judged = judge(GEL)
    pair = judged.sel(material="gel", surface="wall")
    margins = pair.margin.sel(criterion="made_up").values
    # l_a = 0.5 um: work of adhesion over modulus, over heights of 1 and 2 um.
    np.testing.assert_allclose(margins, [0.25, 0.0625], rtol=1e-6)
    moduli = pair.threshold_by_criterion.sel(criterion="made_up").values
    np.testing.assert_allclose(moduli, [50e3, 25e3], rtol=1e-6)

    assert "Made & Up" in describe_page(judged, {"gel": GEL}, {"wall": "wall"})["others"]
    rows = {row["name"]: row for row in table_rows.explain(pair, 0.05)}
    assert rows["Made & Up"]["reason"] == "Heights of 1 … 2 µm against nothing else."
    assert rows["Made & Up"]["answer"] == "does not stick"
    assert "Made & Up" in write_report.find_disagreements(judged)


@pytest.mark.slow
def test_every_threshold_is_where_the_margin_is_one(judge):
    """Also for margins that are no power of the adhesion length."""
    found = judge(GEL).sel(end="rough").squeeze()
    for name in CRITERIA:
        modulus = float(found.threshold_by_criterion.sel(criterion=name))
        at = judge(GEL | {"plane_strain_modulus": f"{modulus!r} Pa"}).sel(end="rough").squeeze()
        assert float(at.margin.sel(criterion=name)) == pytest.approx(1, rel=1e-6), name
