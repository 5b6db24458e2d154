"""One table of criteria: an entry is all that a new criterion needs."""

import numpy as np
import pytest
import xarray as xr

from common.materials import read_material
from criteria import judging, pair_roughness
from criteria.judge import describe_page
from report import table_rows, write_report
from stickiness.criteria.a_v_table import SurfaceAv
from stickiness.criteria.registry import CRITERIA, Criterion
from stickiness.spectrum import SelfAffine

GEL = {
    "label": "gel",
    "plane_strain_modulus": "0.1 MPa",
    "work_of_adhesion": "50 mJ/m^2",
    "range": "0.3 nm",
}
A_V = SurfaceAv(np.array([1e-9, 1.0]), np.array([[4.0, 4.0]]), 0, 0.1)


@pytest.fixture
def road():
    """Surface with two ends."""
    ends = [SelfAffine(hurst=0.8, q0=1e5, q1=1e9, h_rms=h_rms) for h_rms in (1e-6, 2e-6)]
    data = {
        name: ("end", [getattr(s, name) for s in ends])
        for name in ("h_rms", "rms_slope", "rms_curvature")
    }
    data["elastic_energy"] = "end", [s.elastic_energy() for s in ends]
    data = xr.Dataset(data | {"q0": 1e5, "hurst": 0.8}, coords={"end": ["smooth", "rough"]})
    return data.assign_attrs(parameters='{"label": "road"}')


@pytest.fixture(autouse=True)
def fixed_a_v(monkeypatch):
    monkeypatch.setattr(pair_roughness, "find_a_v", lambda surface: (A_V, A_V))


@pytest.fixture
def judged(road):
    solids = {"gel": read_material(GEL)}
    return judging.find_verdicts(solids, {"road": road}, {}, np.array([1.0]))


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
def test_an_entry_is_all_that_a_new_criterion_needs(made_up, road, judged):
    pair = judged.sel(material="gel", surface="road")
    margins = pair.margin.sel(criterion="made_up").values
    # l_a = 0.5 um: work of adhesion over modulus, over heights of 1 and 2 um.
    np.testing.assert_allclose(margins, [0.25, 0.0625], rtol=1e-6)
    moduli = pair.threshold_by_criterion.sel(criterion="made_up").values
    np.testing.assert_allclose(moduli, [50e3, 25e3], rtol=1e-6)

    assert "Made & Up" in describe_page(judged, {"gel": GEL}, {"road": "road"})["others"]
    rows = {row["name"]: row for row in table_rows.explain(pair, 0.05)}
    assert rows["Made & Up"]["reason"] == "Heights of 1 … 2 µm against nothing else."
    assert rows["Made & Up"]["answer"] == "does not stick"
    assert "Made & Up" in write_report.find_disagreements(judged)


@pytest.mark.slow
def test_every_threshold_is_where_the_margin_is_one(judged, road):
    """Also for margins that are no power of the adhesion length."""
    pair = judged.sel(material="gel", surface="road", end="rough")
    for name in CRITERIA:
        modulus = float(pair.threshold_by_criterion.sel(criterion=name))
        solids = {"gel": read_material(GEL | {"plane_strain_modulus": f"{modulus!r} Pa"})}
        at = (
            judging.find_verdicts(solids, {"road": road}, {}, np.array([1.0]))
            .sel(criterion=name, end="rough")
            .squeeze()
        )
        assert float(at.margin) == pytest.approx(1, rel=1e-6), name
