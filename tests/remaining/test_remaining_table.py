"""Simulated works of approach and separation as files, and the table with theories beside them."""

from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr
from helpers.entries import complete
from helpers.jobs import make_job

from common import remaining_table
from common.config.campaigns import RemainingSet
from remaining import measure_remaining, tabulate_remaining

ASKED = complete(
    RemainingSet,
    hurst=0.8,
    magnification=4,
    window=2,
    points=64,
    seeds=[5],
    energies=[0.6, 1.5],
    zones=[0.05, 0.8],
)


@pytest.fixture(scope="module")
def measured(tmp_path_factory):
    path = tmp_path_factory.mktemp("H0.8_zeta4_test") / "seed5.nc"
    params = {"surface": ASKED, "law": "exponential", "squeeze": 0.1}
    measure_remaining.main(make_job(path, params, {"seed": "5"}))
    return path


@pytest.mark.slow
def test_points_that_the_grid_does_not_resolve_are_left_out(measured):
    data = xr.open_dataset(measured)
    assert np.isnan(data.bound.sel(zone=0.05)).all()
    assert (data.pixels_in_zone.sel(zone=0.05) < 1).all()
    assert data.bound.sel(zone=0.8).notnull().all()


def test_shares_and_work_of_adhesion_of_a_file(measured):
    data = xr.open_dataset(measured).sel(zone=0.8).isel(squeeze=0)
    ratio = data.adhesion_length / data.full_contact_energy
    assert ratio.values == pytest.approx(ASKED["energies"])
    assert (data.range**2 / data.adhesion_length).values == pytest.approx(0.8)
    assert 0 < float(data.bound[0]) < float(data.bound[1]) < 1
    assert data.approach.values == pytest.approx(data.bound.values, rel=0.05)


@pytest.mark.slow
def test_table_has_every_point_with_its_theories(measured, tmp_path):
    path = tmp_path / "remaining.csv"
    job = SimpleNamespace(input=[str(measured)], output=[path, tmp_path / "remaining.md"])
    tabulate_remaining.main(job)
    table = remaining_table.read(path)
    assert len(table) == 2
    assert set(table["set"]) == {measured.parent.name}
    assert (table.predicted_low < table.predicted).all()
    assert (table.predicted < table.predicted_high).all()
    assert table.full_contact.tolist() == pytest.approx([0, 1 / 3], abs=1e-4)
