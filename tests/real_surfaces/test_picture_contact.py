"""Contact and pull-off of measured heights for their picture: fields, loads, errors, states."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from bokeh.models import Div

from common import contact_picture
from real_surfaces import measured_maps, picture_contact
from real_surfaces.measured_maps import MeasuredMap
from real_surfaces.picture_contact import ATTRACTED, OPEN, TOUCHING, LeftOutError
from report import interactive, write_surface
from stickiness import Material, Surface, repulsive, surface
from stickiness.entries import check_material, check_surface
from stickiness.measured import periodic
from stickiness.measured.topography import Topography
from stickiness.remaining.measurement import RESOLVED
from stickiness.repulsive import subpixel
from stickiness.spectrum import SelfAffine

SIDE, Q0 = 1e-4, 2 * np.pi * 4 / 1e-4
Q1 = 4 * Q0
CUTOFF = 2 * np.pi / SIDE * 16
GEL = Material(modulus=1e5, poisson=None, work_of_adhesion=0.02, range=3e-10)  # E*


def plate(n=128, seed=1, width=None):
    """Patch of a rough surface that is not periodic, with waves of 2 pixels and more."""
    s = SelfAffine(hurst=0.8, q0=1.0, q1=n / 2.0, h_rms=1e-6, q_rolloff=4.0)
    h = surface.synthesise(s, n=2 * n, length=4 * np.pi, seed=seed)[:n, : width or n]
    return Topography(h, SIDE / n, SIDE / n, "here")


@pytest.fixture(scope="module")
def pressed():
    rough = picture_contact.prepare(MeasuredMap(plate(), CUTOFF), 128)
    return picture_contact.press(rough, Q0, CUTOFF)


def separate(material=GEL, h_rms=2e-6):
    s = SelfAffine(hurst=0.8, q0=4.0, q1=16.0, h_rms=h_rms)
    h = surface.synthesise(s, n=64, length=2 * np.pi, seed=2)
    heights = Topography(h, SIDE / 64, SIDE / 64, "here")
    rough = picture_contact.prepare(MeasuredMap(heights, Q1), 64)
    return picture_contact.separate(rough, material, q0=Q0, q1=Q1, squeeze=0.1)


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
    assert float(pressed.residual.max()) <= picture_contact.CONTACT_TOLERANCE


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
    error = picture_contact.find_error(fine, fine * [1.01, 1.0, 0.97, 1.02, 1.0])
    np.testing.assert_allclose(error / fine, [0.01, 0.03, 0.03, 0.03, 0.02])


@pytest.mark.parametrize(
    ("width", "points", "shape", "waves"),  # too coarse a grid leaves waves out
    [(128, 64, (64, 64), 16), (128, 512, (256, 256), 32), (64, 128, (128, 64), 32)],
)
def test_the_grid_resolves_the_waves_it_keeps(width, points, shape, waves):
    rough = picture_contact.prepare(MeasuredMap(plate(width=width), 2 * CUTOFF), points)
    assert rough.heights.shape == shape
    assert rough.shortest_wavelength == pytest.approx(SIDE / waves)
    assert rough.sides == pytest.approx((SIDE, SIDE * width / 128))


def test_a_cutoff_beyond_the_map_leaves_waves_of_two_pixels():
    """The cutoff of another measurement, or pixels longer along one side."""
    heights = plate(100)
    for longer in (1, 2):
        stretched = replace(heights, dy=longer * heights.dy)
        rough = picture_contact.prepare(MeasuredMap(stretched, 1e8), 512)
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


def describe_known(q_cutoff, not_judged=""):
    return xr.Dataset({"q_cutoff": q_cutoff}, attrs={"not_judged": not_judged})


def test_the_first_measurement_that_is_a_map_is_pressed(tmp_path):
    line, area = tmp_path / "line.txt", tmp_path / "map.txt"
    heights = plate(64).heights
    np.savetxt(line, heights[:, 0] * 1e6)
    np.savetxt(area, heights.T * 1e6)
    units = {"kind": "measured", "height_unit": "um", "length": "100 um"}
    profile = {"file": str(line)}
    both = check_surface(units | {"measurements": [profile, {"file": str(area)}]})
    found = picture_contact.find_map(describe_known(1e9), both)
    assert found.heights.source == str(area)
    assert found.heights.heights.shape == (64, 64)
    with pytest.raises(LeftOutError, match="along lines only"):
        picture_contact.find_map(describe_known(1e9), check_surface(units | profile))
    with pytest.raises(LeftOutError, match="not judged"):
        picture_contact.find_map(describe_known(1e9, "a spike"), both)


def test_a_map_has_its_own_cutoff_and_not_that_of_a_finer_one(tmp_path):
    alone, both = check_maps(tmp_path, coarse="100 um", fine="20 um")
    cutoffs = {
        name: float(Surface.from_entry(entry).data.q_cutoff) for name, entry in alone.items()
    }
    known = describe_known(cutoffs["fine"])
    coarse = picture_contact.find_map(known, both)
    assert coarse.cutoff == pytest.approx(cutoffs["coarse"])
    fine = picture_contact.find_map(known, alone["fine"])
    assert fine.cutoff == cutoffs["fine"] > 2 * coarse.cutoff
    prepared = picture_contact.prepare(coarse, 512)
    assert prepared.shortest_wavelength == pytest.approx(2 * np.pi / cutoffs["coarse"])
    # Contact that is asked for (bem) is of one measurement, too.
    for index, cutoff in enumerate(cutoffs.values()):
        pressed = measured_maps.read_map(both, index, finest=cutoffs["fine"])
        assert pressed.cutoff == pytest.approx(cutoff)


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
    assert pulled.residual.max() <= picture_contact.PULL_OFF_TOLERANCE
    assert float(pulled.modulus) == GEL.modulus


def test_quoted_numbers_are_those_of_the_curve(pulled):
    back = pulled.isel(state=pulled.separating.values == 1)
    pull_off = float(pulled.pull_off.sel(limit="value"))
    assert pull_off == pytest.approx(float(back.mean_traction.max()))
    work = np.trapezoid(np.maximum(back.mean_traction, 0), back.mean_gap)
    separation = float(pulled.separation.sel(limit="value"))
    assert separation == pytest.approx(work / GEL.work_of_adhesion, rel=0.1)


def test_range_is_that_of_the_grid_and_a_longer_one_that_of_the_material(pulled):
    length = GEL.work_of_adhesion / GEL.modulus
    zone = float(pulled["range"]) ** 2 / length
    assert zone / (SIDE / pulled.sizes["x"]) == pytest.approx(picture_contact.PIXELS_IN_ZONE)
    assert float(pulled.material_range) == GEL.range
    wide = replace(GEL, range=1.9e-6)
    assert float(separate(wide)["range"]) == wide.range
    # Errors are told from half the grid, as those of the simulations behind the model.
    assert picture_contact.PIXELS_IN_ZONE >= 2 * RESOLVED


def test_simulation_agrees_with_the_model_of_the_verdicts(pulled):
    """On Gaussian heights, periodic, of several long waves."""
    assert write_surface.overlap(pulled, "separation")
    assert write_surface.overlap(pulled, "pull_off")
    too_low = pulled.assign(
        predicted_pull_off=pulled.pull_off.sel(limit="low") / 2 * xr.ones_like(pulled.pull_off)
    )
    assert not write_surface.overlap(too_low, "pull_off")
    assert 0.05 < float(pulled.predicted_separation.sel(limit="value")) < 0.9


def test_what_is_not_simulated_says_why():
    with pytest.raises(LeftOutError, match=r"less than 0\.1 % of the work"):
        separate(replace(GEL, modulus=2e11))
    with pytest.raises(LeftOutError, match=r"longer than the rms height, 9\.9 nm"):
        separate(h_rms=1e-8)
    with pytest.raises(LeftOutError, match="roughness of its own"):
        picture_contact.pull(None, None, check_gel(surface="plate"), squeeze=0.1)


def check_gel(**changes):
    """Checked entry of `GEL`, with other keys."""
    gel = {"work_of_adhesion": "20 mJ/m^2", "range": "0.3 nm", "label": "gel"}
    modulus = {} if "youngs_modulus_prony" in changes else {"plane_strain_modulus": "0.1 MPa"}
    return check_material(gel | modulus | changes)


def test_pressures_are_given_for_deep_and_smooth_solids(pressed):
    series = {"equilibrium": "75 kPa", "terms": [["1 kPa", "1 us"]]}
    rated = check_gel(label="rated", youngs_modulus_prony=series, poisson_ratio=0.5)
    rough = check_gel(label="rough", surface="plate")
    rows = write_surface.list_loads(pressed, [check_gel(), rated, rough])
    assert [list(row["pressures"]) for row in rows] == [["gel", "rated at 1 Hz"]] * 8
    first = float(pressed.mean_pressure[0]) * 0.1e6
    assert rows[0]["pressures"]["gel"].startswith(f"{first:.2g} ")
    assert all("±" in row[name] for row in rows for name in ("area", "gap"))


@pytest.mark.slow
def test_both_figures_show_the_contact_and_the_curve(pressed, pulled, tmp_path):
    nothing = xr.Dataset(attrs={"left_out": "it is dark"})
    for shown in ((pressed, pulled), (pressed, nothing), (nothing, nothing)):
        contact_picture.draw_still(*shown, tmp_path / "still.png")
        assert (tmp_path / "still.png").read_bytes().startswith(b"\x89PNG")
    codes, widest = contact_picture.code_maps(pressed)
    assert codes.shape == (8, 64, 64)
    touching = (codes == contact_picture.CONTACT).transpose(0, 2, 1)
    assert np.all(pressed.contact.values[touching] >= 0.5)
    gaps = np.minimum(pressed.gap.values, widest)[~touching]
    shown = codes.transpose(0, 2, 1)[~touching] * widest / (contact_picture.CONTACT - 1)
    np.testing.assert_allclose(shown, gaps, atol=0.002 * widest)
    drawn = interactive.draw_contact(pressed, pulled, list("abcdefgh"))
    assert drawn.select_one({"type": Div}).render_as_text  # "gel <soft>" is a label, not a tag
    slider = drawn.select_one({"name": "load"})
    assert (slider.start, slider.end) == (0, 7)
    curves, _, _, (lowest, highest) = contact_picture.follow_tension(pulled)
    assert sum(len(curve["gap"]) for _, _, curve in curves) == pulled.sizes["state"]
    assert lowest < 0 < max(curves[1][2]["tension"]) < highest
