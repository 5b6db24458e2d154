"""A quantity that is measured on solutions: the slope in contact."""

from types import SimpleNamespace

import numpy as np
import pytest
from helpers.entries import model_surface
from helpers.jobs import make_job

from cases import answer_case
from contact import solve_coarse, solve_repulsive
from stickiness import datasets, repulsive, spectrum, surface
from stickiness import error_budget as budget
from stickiness.accuracy.quantities import slope_within_contact
from surfaces import synthesise_surface

ASKED = model_surface(magnification=8)
LOADS, WANTED = [0.02, 0.2], ["area", "contact_slope"]
TABLE = "config/accuracy.csv"
GAPS = {"minimum": 0.01, "maximum": 10, "per_decade": 2}


def test_full_contact_has_the_slope_of_the_surface():
    band = spectrum.SelfAffine(hurst=0.8, q0=2.0, q1=16.0, h_rms=0.3)
    heights = surface.synthesise(band, 64, np.pi, seed=3)
    found = slope_within_contact(heights, np.pi)(np.zeros_like(heights))
    assert found == pytest.approx(surface.moments(heights, np.pi).rms_slope, rel=1e-10)


@pytest.mark.parametrize("pressure", [0.05, 0.15, 0.3])
def test_crests_of_a_wave_in_partial_contact(pressure):
    """Over a strip of half width b of cos(q x), the mean of sin^2 is 1/2 - sin(2 q b)/(4 q b)."""
    length, n = 2.0, 512
    q = 2 * np.pi / length
    heights = 0.4 * np.cos(q * length * np.arange(n) / n)[:, None] * np.ones((1, 8))
    heights = np.tile(heights, (1, n // 8))[::4, ::4]
    contact = repulsive.solve(heights, length, pressure)
    half = np.pi * contact.area_fraction  # q b
    assert 0.1 < contact.area_fraction < 0.9
    want = 0.4 * q * np.sqrt(0.5 - np.sin(2 * half) / (4 * half))
    # The strip ends within a pixel, 1/128 of the wave.
    measure = slope_within_contact(heights, length)
    found = measure(contact.gap)
    assert found == pytest.approx(want, rel=0.02)
    assert found < surface.moments(heights, length).rms_slope
    assert np.isnan(measure(contact.gap + 1))


def job(path, params, **inputs):
    return make_job(path, params, {"case": "mine", "model_surface": "some"}, **inputs)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Files of a case from its surfaces to its answer."""
    folder, solved = tmp_path_factory.mktemp("slope"), []
    solver = {"pressures": LOADS, "tolerance": 1e-6, "gaps": GAPS}
    for seeds in ([1, 2], [3]):
        path, made = folder / f"surfaces{seeds[0]}.nc", {"seeds": seeds, "pixels_per_wavelength": 4}
        synthesise_surface.main(job(path, made | {"surface": ASKED}))
        solved.append(folder / f"solved{seeds[0]}.nc")
        solve_repulsive.main(job(solved[-1], solver | made, surfaces=[path]))
    params = solver | {"surface": ASKED, "seeds": range(1, 41)}
    solve_coarse.main(job(folder / "coarse.nc", params))
    settings = {"pixels_per_wavelength": 4, "tolerance": 1e-6, "seeds": 3, "coarse_seeds": 40}
    plan = {"quantities": WANTED, "pressures": LOADS, "simulated": True, "settings": settings}
    plan |= {"surface": ASKED, "accuracy": None, "descriptor_seeds": 64}
    inputs = {"realisations": solved, "coarse": [folder / "coarse.nc"], "laws": TABLE}
    asked = job(folder / "answer.nc", {"plan": plan}, **inputs)
    files = {name: str(folder / f"{name}.nc") for name in ("means", "kappa", "a_v", "answer")}
    asked.output = SimpleNamespace(**files)
    answer_case.main(asked)
    return folder


@pytest.mark.slow
def test_slope_in_contact_is_averaged_with_its_errors(folder):
    ensemble = datasets.read(folder / "means.nc")
    slope, whole = ensemble.contact_slope_mean, ensemble.rms_slope.mean()
    assert ((slope > 0.2 * whole) & (slope < 1.5 * whole)).all()
    assert (ensemble.contact_slope_standard_error > 0).all()
    assert (ensemble.contact_slope_discretisation_error > 0).all()
    error = ensemble.contact_slope_mean_error
    assert np.isnan(error.sel(source="solver")).all()
    assert "solver: not known, " in error.comment
    assert "not measured" in error.comment
    assert np.isfinite(error.drop_sel(source="solver")).all()
    assert np.isnan(ensemble.contact_slope_mean_total_error).all()


@pytest.mark.slow
def test_case_is_answered_with_what_is_not_known(folder):
    answer = datasets.read(folder / "answer.nc")
    slope = answer.sel(column="contact_slope")
    np.testing.assert_array_equal(
        slope.value, datasets.read(folder / "means.nc").contact_slope_mean
    )
    assert np.isnan(slope.value_total_error).all()
    assert budget.dominant(slope.isel(pressure=0), "value") == "solver"
    assert "contact_slope: not known, how this quantity" in answer.value_error.comment
    assert np.isfinite(answer.sel(column="area").value_total_error).all()
