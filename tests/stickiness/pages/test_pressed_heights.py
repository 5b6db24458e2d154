"""Contact and pull-off of measured heights for their picture: fields, loads, errors, states."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from stickiness import Material, Surface, repulsive, surface
from stickiness.entries import check_surface
from stickiness.measured import periodic
from stickiness.measured.measurement import Measurement
from stickiness.measured.topography import Profile, Topography
from stickiness.pages import pressed_heights
from stickiness.pages.pressed_heights import (
    ATTRACTED,
    OPEN,
    TOUCHING,
    LeftOutError,
    MeasuredMap,
    picture_contact,
)
from stickiness.pages.surface_page import overlap
from stickiness.remaining.measurement import RESOLVED
from stickiness.repulsive import subpixel
from stickiness.spectrum import SelfAffine
from stickiness.verdicts.rough_surface import read_measurements

SIDE, Q0 = 1e-4, 2 * np.pi * 4 / 1e-4
Q1 = 4 * Q0
CUTOFF = 2 * np.pi / SIDE * 16
GEL = Material(  # E*
    plane_strain_modulus=1e5, work_of_adhesion=0.02, range=3e-10, label="gel"
)


def plate(n=128, seed=1, width=None):
    """Patch of a rough surface that is not periodic, with waves of 2 pixels and more."""
    s = SelfAffine(hurst=0.8, q0=1.0, q1=n / 2.0, h_rms=1e-6, q_rolloff=4.0)
    h = surface.synthesise(s, n=2 * n, length=4 * np.pi, seed=seed)[:n, : width or n]
    return Topography(h, SIDE / n, SIDE / n, "here")


@pytest.fixture(scope="module")
def pressed():
    rough = pressed_heights.prepare(MeasuredMap(plate(), CUTOFF), 128)
    return pressed_heights.press(rough, Q0, CUTOFF)


def separate(material=GEL, h_rms=2e-6):
    s = SelfAffine(hurst=0.8, q0=4.0, q1=16.0, h_rms=h_rms)
    h = surface.synthesise(s, n=64, length=2 * np.pi, seed=2)
    heights = Topography(h, SIDE / 64, SIDE / 64, "here")
    rough = pressed_heights.prepare(MeasuredMap(heights, Q1), 64)
    return pressed_heights.separate(rough, material, q0=Q0, q1=Q1)


@pytest.fixture(scope="module")
def pulled():
    return separate()


def test_contact_grows_with_the_load(pressed):
    assert set(np.unique(pressed.contact)) <= {0, 0.25, 0.5, 0.75, 1}
    assert np.all(np.diff(pressed.area_fraction) > 0)
    assert np.all(np.diff(pressed.mean_gap) < 0)
    # Where it touches once it touches at every higher load.
    assert (pressed.contact.values[1:] < pressed.contact.values[:-1]).mean() < 1e-3
    assert 5e-4 < float(pressed.area_fraction[0]) < 3e-3
    assert 0.3 < float(pressed.area_fraction[-1]) < 0.5


def test_traction_balances_the_load_and_gaps_are_where_nothing_touches(pressed):
    traction = pressed.contact_pressure.mean(["x", "y"])
    np.testing.assert_allclose(traction, pressed.mean_pressure, rtol=1e-5)
    np.testing.assert_allclose(pressed.gap.mean(["x", "y"]), pressed.mean_gap, rtol=1e-5)
    closed = pressed.contact.values == 1
    assert closed.any()
    assert np.all(pressed.gap.values[closed] == 0)
    assert np.all(pressed.gap.values[~closed] > 0)
    assert np.all(pressed.contact_pressure.values[pressed.contact.values == 0] == 0)
    assert float(pressed.residual.max()) <= pressed_heights.CONTACT_TOLERANCE


def test_area_is_within_its_error_of_a_direct_solution_on_a_finer_grid(pressed):
    whole = periodic.periodise(plate().heights, "smooth")
    fine = periodic.band_limited(whole, (SIDE, SIDE), 2 * np.pi / SIDE * 15.99, 32)
    assert fine.shape[0] >= 4 * len(pressed.x)
    for index in (3, 5, 7):
        at = pressed.isel(pressure=index)
        contact = repulsive.solve(fine, SIDE, float(at.mean_pressure), tol=1e-5)
        area = contact.area_fraction - subpixel.boundary_strip(contact.gap == 0)
        assert abs(float(at.area_fraction) - area) <= float(at.area_fraction_discretisation_error)


def test_error_does_not_vanish_where_the_change_does():
    fine = np.array([1.0, 2.0, 4.0, 8.0, 16.0])
    error = pressed_heights.find_error(fine, fine * [1.01, 1.0, 0.97, 1.02, 1.0])
    np.testing.assert_allclose(error / fine, [0.01, 0.03, 0.03, 0.03, 0.02])


@pytest.mark.parametrize(
    ("width", "points", "shape", "waves"),  # too coarse a grid leaves waves out
    [(128, 64, (64, 64), 16), (128, 512, (256, 256), 32), (64, 128, (128, 64), 32)],
)
def test_the_grid_resolves_the_waves_it_keeps(width, points, shape, waves):
    rough = pressed_heights.prepare(MeasuredMap(plate(width=width), 2 * CUTOFF), points)
    assert rough.heights.shape == shape
    assert rough.shortest_wavelength == pytest.approx(SIDE / waves)
    assert rough.sides == pytest.approx((SIDE, SIDE * width / 128))


def test_a_cutoff_beyond_the_map_leaves_waves_of_two_pixels():
    """The cutoff of another measurement, or pixels longer along one side."""
    heights = plate(100)
    for longer in (1, 2):
        stretched = replace(heights, dy=longer * heights.dy)
        rough = pressed_heights.prepare(MeasuredMap(stretched, 1e8), 512)
        assert rough.shortest_wavelength == pytest.approx(2 * longer * heights.dx)


def check_maps(folder, **sides):
    """Checked entries of maps with these sides, by name, and of a surface measured by all."""
    measurements = {}
    for seed, (name, side) in enumerate(sides.items()):
        path = folder / f"{name}.txt"
        np.savetxt(path, plate(seed=seed).heights.T * 1e6)
        measurements[name] = {"file": str(path), "length": side}
    units = {"kind": "measured", "height_unit": "um"}
    alone = {name: check_surface(units | each) for name, each in measurements.items()}
    return alone, check_surface(units | {"measurements": list(measurements.values())})


def make_surface(measurements, q_cutoff=1e9, not_judged=""):
    """What the picture needs of a surface with these measurements."""
    data = xr.Dataset({"q0": Q0, "q1": Q1, "q_cutoff": q_cutoff}, attrs={"not_judged": not_judged})
    return Surface(data, measurements=measurements)


LINE = Measurement(Profile(plate(64).heights[:, 0], SIDE / 64, "a line"))
MAP = Measurement(plate(32))


def test_the_first_measurement_that_is_a_map_is_pressed():
    found = pressed_heights.find_map(make_surface((LINE, MAP, LINE)))
    assert found.heights is MAP.heights
    with pytest.raises(LeftOutError, match="along lines only"):
        pressed_heights.find_map(make_surface((LINE,)))
    with pytest.raises(LeftOutError, match="not judged"):
        pressed_heights.find_map(make_surface((MAP,), not_judged="a spike"))


@pytest.mark.usefixtures("coarse_simulation")
def test_a_map_has_its_own_cutoff_and_not_that_of_a_finer_one(tmp_path):
    alone, both = check_maps(tmp_path, coarse="100 um", fine="20 um")
    surfaces = {name: Surface.from_entry(entry) for name, entry in alone.items()}
    cutoffs = {name: float(surface.data.q_cutoff) for name, surface in surfaces.items()}
    coarse = pressed_heights.find_map(make_surface(read_measurements(both), cutoffs["fine"]))
    assert coarse.cutoff == pytest.approx(cutoffs["coarse"])
    fine = pressed_heights.find_map(surfaces["fine"])
    assert fine.cutoff == cutoffs["fine"] > 2 * coarse.cutoff
    prepared = pressed_heights.prepare(coarse, 512)
    assert prepared.shortest_wavelength == pytest.approx(2 * np.pi / cutoffs["coarse"])


def test_surfaces_meet_are_squeezed_and_part(pulled):
    there, back = (pulled.isel(state=pulled.separating.values == way) for way in (0, 1))
    for way, order in ((there, -1), (back, 1)):
        assert np.all(order * np.diff(way.mean_gap) > 0)
    for state in (there.isel(state=0), back.isel(state=-1)):
        assert np.all(state.zone == OPEN)
    assert -float(there.mean_traction[-1]) >= float(pulled.squeeze_pressure)
    for name, code in (("contact_area", TOUCHING), ("attracted_area", ATTRACTED)):
        np.testing.assert_allclose((pulled.zone == code).mean(["x", "y"]), pulled[name])
    assert float(pulled.contact_area.max()) > 0.1
    assert (pulled.converged == 1).all()
    assert pulled.residual.max() <= pressed_heights.PULL_OFF_TOLERANCE
    assert float(pulled.modulus) == GEL.plane_strain_modulus


def test_quoted_numbers_are_those_of_the_curve(pulled):
    back = pulled.isel(state=pulled.separating.values == 1)
    pull_off = float(pulled.pull_off.sel(limit="value"))
    assert pull_off == pytest.approx(float(back.mean_traction.max()))
    work = np.trapezoid(np.maximum(back.mean_traction, 0), back.mean_gap)
    separation = float(pulled.separation.sel(limit="value"))
    assert separation == pytest.approx(work / GEL.work_of_adhesion, rel=0.1)


def test_range_is_that_of_the_grid_and_a_longer_one_that_of_the_material(pulled):
    length = GEL.work_of_adhesion / GEL.plane_strain_modulus
    zone = float(pulled["range"]) ** 2 / length
    assert zone / (SIDE / pulled.sizes["x"]) == pytest.approx(pressed_heights.PIXELS_IN_ZONE)
    assert float(pulled.material_range) == GEL.range
    wide = GEL.replace(range=1.9e-6)
    assert float(separate(wide)["range"]) == wide.range
    # Errors are told from half the grid, as those of the simulations behind the model.
    assert pressed_heights.PIXELS_IN_ZONE >= 2 * RESOLVED


def test_simulation_agrees_with_the_model_of_the_verdicts(pulled):
    """On Gaussian heights, periodic, of several long waves."""
    assert overlap(pulled, "separation")
    assert overlap(pulled, "pull_off")
    too_low = pulled.assign(
        predicted_pull_off=pulled.pull_off.sel(limit="low") / 2 * xr.ones_like(pulled.pull_off)
    )
    assert not overlap(too_low, "pull_off")
    assert 0.05 < float(pulled.predicted_separation.sel(limit="value")) < 0.9


def test_what_is_not_simulated_says_why():
    with pytest.raises(LeftOutError, match=r"less than 0\.1 % of the work"):
        separate(GEL.replace(plane_strain_modulus=2e11))
    with pytest.raises(LeftOutError, match=r"longer than the rms height, 9\.9 nm"):
        separate(h_rms=1e-8)


def test_what_is_not_simulated_is_left_out_of_the_picture(pressed):
    spectrum = SelfAffine(hurst=0.8, q0=Q0, q1=Q1, h_rms=1e-6)
    rough = GEL.replace(surface=Surface.from_spectrum(spectrum))
    contact, pull_off = picture_contact(make_surface((LINE, MAP)), rough)
    assert contact.attrs == {"left_out": "", "measurement": MAP.heights.source}
    assert contact.keys() == pressed.keys()
    assert pull_off.attrs["left_out"].startswith("the material has a roughness of its own")
    assert pull_off.attrs["material"] == "gel"
    for nothing in picture_contact(make_surface((LINE,)), GEL):
        assert nothing.attrs["left_out"].startswith("it was measured along lines only")
