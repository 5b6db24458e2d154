"""Contact of measured heights that were made periodic."""

import numpy as np
import pytest
import xarray as xr
from helpers.jobs import make_job

from common import conventions
from real_surfaces import contact_measured, measured_maps
from stickiness import adhesive, datasets, repulsive, surface
from stickiness.entries import check_surface
from stickiness.measured.topography import Topography
from stickiness.repulsive import subpixel
from stickiness.spectrum import SelfAffine

RANGES = np.geomspace(0.003, 1, 11)


def check_bem(file="heights.npy", **bem):
    """The checked entry of a surface of which contact is wanted."""
    units = {"length": "10 um", "height_unit": "m"}
    given = {"pressures": [0.1]} | bem
    return check_surface({"kind": "measured", "file": str(file), "bem": given} | units)


def solve(heights, q_max, bem, pixels=4, tolerance=1e-6):
    return contact_measured.solve(
        heights, 1.0, q_max, bem, ranges=RANGES, pixels=pixels, tolerance=tolerance, gamma=0.45
    )


def solve_heights(h, q_max=16.0, pressures=(0.03, 0.3), pixels=4):
    step = 2 * np.pi / len(h)
    bem = check_bem(pressures=list(pressures))["bem"]
    return solve(Topography(h, step, step, "here"), q_max, bem, pixels)


@pytest.fixture(scope="module")
def whole():
    s = SelfAffine(hurst=0.8, q0=1.0, q1=16.0, h_rms=1.0)
    h = surface.synthesise(s, n=128, length=2 * np.pi, seed=5)
    return h, conventions.annotate(solve_heights(h), **contact_measured.VARIABLE_TEXTS)


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
    found = solve_heights(np.tile(np.cos(x)[:, None], (1, n)), pressures=[0.2], pixels=16)
    area = float(found.area_fraction.sel(periodisation="mirror").isel(resolution=-1, pressure=0))
    # pi E* amplitude/L with L = 2 pi and amplitude sqrt(2) in units of h_rms is 1/sqrt(2).
    expected = 2 / np.pi * np.arcsin(np.sqrt(0.2 * np.sqrt(2)))
    assert area == pytest.approx(expected, abs=2 / 256)


def test_waves_are_not_shorter_than_the_instrument_or_the_grid():
    choose = contact_measured.choose_highest_wave_number
    assert choose(check_bem()["bem"], 5e6) == 5e6
    assert choose(check_bem(shortest_wavelength="2 um")["bem"], 5e6) == pytest.approx(np.pi * 1e6)
    with pytest.raises(ValueError, match="below the instrument's"):
        choose(check_bem(shortest_wavelength="1 um")["bem"], 5e6)
    with pytest.raises(ValueError, match="more than 2048"):
        solve_heights(np.random.default_rng(0).normal(size=(256, 256)), q_max=120.0, pixels=64)


def test_a_profile_is_refused(tmp_path):
    np.save(tmp_path / "line.npy", np.random.default_rng(0).normal(size=30))
    known = xr.Dataset({"q0": 1.0, "q_cutoff": 1e9})
    with pytest.raises(ValueError, match="needs a map of heights, not a line profile"):
        press(tmp_path, known, check_bem(tmp_path / "line.npy"))


# Heights that are periodic as they stand, with adhesion

SOLID = {"plane_strain_modulus": "25 MPa", "work_of_adhesion": "50 mJ/m^2", "range": "40 nm"}
SIDE, POINTS, H_RMS = 10e-6, 64, 0.2e-6


@pytest.fixture(scope="module")
def periodic_file(tmp_path_factory):
    s = SelfAffine(hurst=0.8, q0=2 * np.pi / SIDE, q1=16 * np.pi / SIDE, h_rms=H_RMS)
    path = tmp_path_factory.mktemp("periodic") / "heights.npy"
    np.save(path, surface.synthesise(s, n=POINTS, length=SIDE, seed=3).T)
    return path


def check_periodic(path, **bem):
    given = {"periodic": True, "pressures": ["0.5 MPa", "250 kPa"], "adhesion": SOLID}
    return check_bem(path, **given | bem)


def press(folder, known, entry):
    """What the rule writes for an entry, from the wave numbers that are known of its surface."""
    texts = dict.fromkeys(("q0", "q_cutoff"), ("1/m", "wave number"))
    datasets.write(datasets.annotate(known, **texts), folder / "in.nc", title="a", parameters={})
    params = {
        "surface": entry,
        "gaps": {"minimum": 0.01, "maximum": 1.0, "per_decade": 4},
        "pixels_per_wavelength": 8,
        "tolerance": 1e-6,
        "gamma": 0.45,
    }
    job = make_job(folder / "out.nc", params, {"real_surface": "plate"}, surface=folder / "in.nc")
    contact_measured.main(job)
    return datasets.read(folder / "out.nc")


@pytest.fixture(scope="module")
def pressed(periodic_file, tmp_path_factory):
    q0 = 2 * np.pi / SIDE
    known = xr.Dataset({"q0": q0, "q_cutoff": 8 * q0})
    return press(tmp_path_factory.mktemp("pressed"), known, check_periodic(periodic_file))


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
    read = measured_maps.read_map(check_periodic(periodic_file), 0, 1e9, detrend="mean")
    np.testing.assert_allclose(read.heights.heights, heights - heights.mean(), atol=1e-15)
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
    "limit", [{"most_points": 32}, {"most_points": 64, "shortest_wavelength": 0.5e-6}]
)
def test_a_grid_beyond_most_points_is_refused(periodic_file, limit):
    entry = check_periodic(periodic_file)
    bem = entry["bem"] | limit
    measured = measured_maps.read_map(entry, 0, 1e9, detrend="mean")
    q_max = contact_measured.choose_highest_wave_number(bem, measured.cutoff)
    with pytest.raises(ValueError, match=r"bem\.most_points"):
        solve(measured.heights, q_max, bem, pixels=8, tolerance=1e-4)
