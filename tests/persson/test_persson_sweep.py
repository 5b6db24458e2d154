"""Persson's theory as its rules write it: loads, gaps and spectra agree with one another."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from helpers.entries import complete, model_surface
from helpers.jobs import make_job
from scipy.special import erf

from common.config import models
from common.conventions import VARIANT
from persson import persson_lattice, persson_sweep
from stickiness import datasets

LAWS = str(Path(__file__).parents[2] / "config/accuracy.csv")
SHARED = {
    "variants": [VARIANT],
    "gamma": 1.0,  # no correction of the elastic energy
    "gaps": {"minimum": 0.01, "maximum": 10, "per_decade": 1},
    "windows": [[0.01, 1.0]],
}


def write(rule, path, params):
    """Run a rule's script, and read what it writes of the variant that is quoted."""
    job = make_job(path, SHARED | params, laws=LAWS)
    job.output = SimpleNamespace(theory=[path], a_v=[path.with_name("a_v.nc")])
    rule.main(job)
    return datasets.read(path).sel(variant=VARIANT).squeeze()


def sweep(path, **loads):
    asked = complete(models.Sweep, hurst=[0.8], magnification=[4], **loads)
    return write(persson_sweep, path, {"sweeps": [asked]})


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
    surface = model_surface(magnification=4, window=8)
    asked = {"surface": surface, "pressures": [float(swept.pressure)], "simulated": False}
    lattice = write(persson_lattice, tmp_path / "mine.nc", {"lattices": {"mine": asked}})
    for name in ("area_fraction", "mean_gap", "rms_slope"):
        assert float(lattice[name]) == pytest.approx(float(swept[name]), rel=0.05), name
