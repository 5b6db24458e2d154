"""Persson's theory as its rules write it: loads, gaps and spectra agree with one another."""

from pathlib import Path

import numpy as np
import pytest
from helpers.jobs import make_job
from scipy.special import erf

from persson import persson_lattice, persson_sweep
from pipeline.conventions import VARIANT
from stickiness.core import datasets

LAWS = str(Path(__file__).parents[3] / "config/accuracy.csv")
SHARED = {
    "variants": [VARIANT],
    "gamma": 1.0,  # no correction of the elastic energy
    "gaps": {"minimum": 0.01, "maximum": 10, "per_decade": 1},
}


def sweep(path, **loads):
    asked = {"hurst": [0.8], "magnification": [4]} | loads
    persson_sweep.main(make_job(path, SHARED | {"sweep": asked}, laws=LAWS))
    return datasets.read(path).sel(variant=VARIANT).squeeze()


@pytest.fixture(scope="module")
def swept(tmp_path_factory):
    return sweep(tmp_path_factory.mktemp("sweep") / "mine.nc", mean_gap=[1.5])


def test_a_sweep_reaches_its_gap_with_the_area_of_the_closed_form(swept):
    assert float(swept.mean_gap) == pytest.approx(1.5, rel=1e-3)
    # Persson 2001, doi:10.1063/1.1388626: A/A0 = erf(sqrt(2) p / (E* h'_rms)).
    area = erf(np.sqrt(2) * float(swept.pressure / swept.rms_slope))
    assert float(swept.area_fraction) == pytest.approx(area, rel=1e-3)


@pytest.mark.slow
def test_a_large_window_holds_the_continuous_spectrum(swept, tmp_path):
    surface = {"hurst": 0.8, "magnification": 4, "window": 8}
    params = SHARED | {"surface": surface, "pressures": [float(swept.pressure)]}
    path = tmp_path / "mine.nc"
    persson_lattice.main(make_job(path, params, {"compared": "mine"}, laws=LAWS))
    lattice = datasets.read(path).sel(variant=VARIANT).squeeze()
    for name in ("area_fraction", "mean_gap", "rms_slope"):
        assert float(lattice[name]) == pytest.approx(float(swept[name]), rel=0.05), name
