"""Contact of measured heights that were made periodic."""

import numpy as np
import pytest
import xarray as xr
from helpers.jobs import make_job

from common import conventions
from real_surfaces import contact_measured
from stickiness import adhesive, datasets, repulsive, surface
from stickiness.measured.topography import Topography
from stickiness.repulsive import subpixel
from stickiness.spectrum import SelfAffine

RANGES = np.geomspace(0.003, 1, 11)


def contact_of(h, q_max=16.0, pressures=(0.03, 0.3), pixels=4):
    setting = {"ranges": RANGES, "pixels": pixels, "tolerance": 1e-6, "gamma": 0.45}
    step = 2 * np.pi / len(h)
    heights, bem = Topography(h, step, step, "here"), {"pressures": list(pressures)}
    return contact_measured.solve(heights, 1.0, q_max, bem, **setting)


@pytest.fixture(scope="module")
def whole():
    s = SelfAffine(hurst=0.8, q0=1.0, q1=16.0, h_rms=1.0)
    h = surface.synthesise(s, n=128, length=2 * np.pi, seed=5)
    return h, conventions.annotate(contact_of(h), **contact_measured.VARIABLE_TEXTS)


def test_both_ways_bracket_nothing_absurd(whole):
    h, found = whole
    # The mirror keeps the variance but for the waves beyond the band that its seams make.
    assert float(found.h_rms.sel(periodisation="mirror")) == pytest.approx(np.std(h), rel=0.02)
    assert float(found.h_rms.sel(periodisation="taper")) < np.std(h)
    # Persson's area is within a third on one small surface.
    fine = found.isel(resolution=-1, pressure=1)
    assert np.all(np.abs(fine.area_fraction / fine.theory_area_fraction - 1) < 0.35)


@pytest.mark.slow
def test_contact_of_a_smooth_wave_is_westergaard_s():
    # h = cos x, alone: contact over sin^2(pi a/L) = p/(pi E* amplitude/L) (Westergaard 1939), in
    # which the amplitude is sqrt(2) h_rms. A mirror image of whole periods is the wave itself.
    n = 256
    x = (np.arange(n) + 0.5) * 2 * np.pi / n  # mirrored between points: an even wave goes on
    found = contact_of(np.tile(np.cos(x)[:, None], (1, n)), pressures=[0.2], pixels=16)
    area = float(found.area_fraction.sel(periodisation="mirror").isel(resolution=-1, pressure=0))
    # pi E* amplitude/L with L = 2 pi and amplitude sqrt(2) in units of h_rms is 1/sqrt(2).
    expected = 2 / np.pi * np.arcsin(np.sqrt(0.2 * np.sqrt(2)))
    assert area == pytest.approx(expected, abs=2 / 256)


def test_waves_are_not_shorter_than_the_instrument_or_the_grid():
    assert contact_measured.highest_wave_number({}, 5.0) == 5.0
    coarse = contact_measured.highest_wave_number({"shortest_wavelength": "2 m"}, 5.0)
    assert coarse == pytest.approx(np.pi)
    with pytest.raises(ValueError, match="below the instrument's"):
        contact_measured.highest_wave_number({"shortest_wavelength": "1 m"}, 5.0)
    with pytest.raises(ValueError, match=r"more than 2048; give bem\.shortest_wavelength of"):
        contact_of(np.random.default_rng(0).normal(size=(256, 256)), q_max=120.0, pixels=64)


def test_a_profile_is_refused(tmp_path):
    np.save(tmp_path / "line.npy", np.random.default_rng(0).normal(size=30))
    entry = {"file": str(tmp_path / "line.npy"), "length": "1 um", "height_unit": "nm", "bem": {}}
    with pytest.raises(ValueError, match="is a line profile; bem needs a map"):
        contact_measured.read_map(entry)


# Heights that are periodic as they stand, with adhesion

SOLID = {"plane_strain_modulus": "25 MPa", "work_of_adhesion": "50 mJ/m^2", "range": "40 nm"}
SIDE, POINTS, H_RMS = 10e-6, 64, 0.2e-6


@pytest.fixture(scope="module")
def periodic_file(tmp_path_factory):
    s = SelfAffine(hurst=0.8, q0=2 * np.pi / SIDE, q1=16 * np.pi / SIDE, h_rms=H_RMS)
    path = tmp_path_factory.mktemp("periodic") / "heights.npy"
    np.save(path, surface.synthesise(s, n=POINTS, length=SIDE, seed=3).T)
    return path


def asked_of(path, **bem):
    asked = {"kind": "measured", "file": str(path), "length": "10 um", "height_unit": "m"}
    bem = {"periodic": True, "pressures": ["0.5 MPa", "250 kPa"], "adhesion": SOLID} | bem
    return asked | {"label": "plate", "source": "own", "bem": bem}


@pytest.fixture(scope="module")
def pressed(periodic_file, tmp_path_factory):
    folder = tmp_path_factory.mktemp("pressed")
    q0, text = 2 * np.pi / SIDE, ("1/m", "wave number")
    known = xr.Dataset({"q0": q0, "q_cutoff": 8 * q0})
    known = datasets.annotate(known, q0=text, q_cutoff=text)
    datasets.write(known, folder / "in.nc", title="a", parameters={})
    gaps = {"minimum": 0.01, "maximum": 1.0, "per_decade": 4}
    settings = {"pixels_per_wavelength": 8, "tolerance": 1e-6, "gamma": 0.45}
    params = {"surface": asked_of(periodic_file), "gaps": gaps} | settings
    job = make_job(folder / "out.nc", params, {"real_surface": "plate"}, surface=folder / "in.nc")
    contact_measured.main(job)
    return datasets.read(folder / "out.nc")


def test_states_say_how_well_they_are_solved_and_of_which_modulus(pressed):
    for prefix in ("", "adhesive_"):
        assert (pressed[f"{prefix}converged"] == 1).all()
        assert (pressed[f"{prefix}iterations"] > 0).all()
    states = xr.Dataset({"residual": ("state", [1e-6, 1e-4, 2e-4, np.nan])})
    assert conventions.add_convergence(states, 1e-4).converged.values.tolist() == [1, 1, 0, 0]
    load = pressed.pressure * 2 * np.pi / SIDE * H_RMS * pressed.modulus
    np.testing.assert_allclose(load.squeeze(), pressed.applied_pressure.squeeze())
    assert pressed.applied_pressure.sign_convention.startswith("positive in compression")


def test_periodic_heights_are_pressed_as_they_stand(pressed, periodic_file):
    heights = np.load(periodic_file).T
    # No plane is taken from them: it would break the period.
    read = contact_measured.read_map(asked_of(periodic_file)).heights
    np.testing.assert_allclose(read, heights - heights.mean(), atol=1e-15)
    assert list(pressed.periodisation.values) == ["given"]
    assert float(pressed.h_rms.isel(periodisation=0)) == pytest.approx(H_RMS, rel=1e-9)
    for step, resolution in ((2, 1.0), (1, 2.0)):
        at = pressed.sel(resolution=resolution, periodisation="given").isel(pressure=0)
        alone = repulsive.solve(heights[::step, ::step], SIDE, 0.01, tol=1e-6)
        strip = subpixel.boundary_strip(alone.gap == 0)
        assert float(at.area_fraction) == pytest.approx(alone.area_fraction - strip, abs=1e-9)
        assert float(at.mean_gap) * H_RMS == pytest.approx(alone.mean_gap, rel=1e-5)


def test_adhesion_is_that_of_the_solver_at_the_pressures_given(pressed, periodic_file):
    heights = np.load(periodic_file).T
    law = adhesive.Exponential(adhesion_length=0.05 / 25e6, range=40e-9)
    applied = pressed.applied_pressure.isel(periodisation=0)
    np.testing.assert_allclose(applied, [0.25e6, 0.5e6], rtol=1e-9)
    for index, load in enumerate((0.01, 0.02)):
        at = pressed.isel(resolution=-1, periodisation=0, pressure=index)
        alone = repulsive.solve(heights, SIDE, load, tol=1e-6)
        state = adhesive.solve(heights, SIDE, law, load, start=alone, tol=1e-8)
        assert float(at.adhesive_mean_gap) * H_RMS == pytest.approx(state.mean_gap, rel=1e-3)
        area = state.repulsive_area_fraction
        assert float(at.adhesive_contact_area) == pytest.approx(area, rel=0.02)
        assert float(at.adhesive_residual) <= 1e-3
        assert at.adhesive_contact_area >= at.area_fraction
    edge = SIDE / 64 * 2e-9 / 40e-9**2
    assert float(pressed.edge_resolution.isel(resolution=-1).max()) == pytest.approx(edge)


@pytest.mark.parametrize(
    ("changed", "text"),
    [
        ({"most_points": 32}, r"64 x 64 points; .*at most bem\.most_points = 32"),
        ({"most_points": 64, "shortest_wavelength": "0.5 um"}, r"or raise bem\.most_points"),
    ],
)
def test_a_grid_beyond_most_points_is_refused(periodic_file, changed, text):
    asked = asked_of(periodic_file, **changed)
    bem = asked["bem"]
    setting = {"ranges": RANGES, "pixels": 8, "tolerance": 1e-4, "gamma": 0.45}
    q_max = contact_measured.highest_wave_number(bem, 1e9)
    with pytest.raises(ValueError, match=text):
        contact_measured.solve(contact_measured.read_map(asked), 1.0, q_max, bem, **setting)
