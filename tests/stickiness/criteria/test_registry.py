"""One table of criteria: an entry is all that a new criterion needs."""

import numpy as np
import pytest
from helpers.analysed import wall

import stickiness
from criteria.judge import describe_page
from report.write_report import find_disagreements
from stickiness import Material
from stickiness.criteria.registry import CRITERIA, Criterion
from stickiness.entries import check_material

ENTRY = check_material(
    {
        "label": "gel",
        "plane_strain_modulus": "0.1 MPa",
        "work_of_adhesion": "50 mJ/m^2",
        "range": "0.3 nm",
    }
)
GEL = Material.from_entry(ENTRY)


@pytest.fixture
def made_up(monkeypatch):
    """A criterion of the least adhesion length over the rms height."""
    entry = Criterion(
        "made_up",
        "Made & Up",
        margin=lambda pair: (pair.adhesion_length / pair.h_rms) ** 2,
        power=2.0,
    )
    monkeypatch.setitem(CRITERIA, "made_up", entry)
    return entry


@pytest.mark.slow
def test_an_entry_is_all_that_a_new_criterion_needs(made_up):
    verdicts = stickiness.judge({"gel": GEL}, {"wall": wall()})
    pair = verdicts.sel(material="gel", surface="wall", criterion="made_up")
    # l_a = 0.5 um: work of adhesion over modulus, over heights of 1 and 2 um.
    np.testing.assert_allclose(pair.margin_by_criterion, [0.25, 0.0625], rtol=1e-6)
    np.testing.assert_allclose(pair.threshold_by_criterion, [50e3, 25e3], rtol=1e-6)
    assert "Made & Up" in describe_page(verdicts, {"wall": "wall"})["others"]
    assert "Made & Up" in find_disagreements(verdicts)


@pytest.mark.slow
def test_every_threshold_is_where_the_margin_is_one():
    """Also for margins that are no power of the adhesion length."""
    surfaces = {"wall": wall()}
    cell = stickiness.judge([GEL], surfaces, thresholds=False).sel(end="rough").squeeze()
    moduli = [float(cell.threshold_by_criterion.sel(criterion=name)) for name in CRITERIA]
    materials = {
        name: GEL.replace(plane_strain_modulus=modulus)
        for name, modulus in zip(CRITERIA, moduli, strict=True)
    }
    verdicts = stickiness.judge(materials, surfaces, thresholds=False).sel(end="rough")
    for name in CRITERIA:
        margin = float(
            verdicts.margin_by_criterion.sel(surface="wall", material=name, criterion=name)
        )
        assert margin == pytest.approx(1, rel=1e-6), name
