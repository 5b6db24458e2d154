"""Pictures of where measured heights touch: fields, loads, errors."""

import numpy as np
import pytest

from criteria.materials import Material, read_material
from real_surfaces import (
    analyse_surface,
    contact_measured,
    measured_surface,
    pictured_heights,
    press_measured,
)
from report import stills, touch
from stickiness import datasets, repulsive, surface
from stickiness.measured import periodic
from stickiness.measured.topography import Topography
from stickiness.repulsive import subpixel
from stickiness.spectrum import SelfAffine

SIDE, Q0 = 1e-4, 2 * np.pi * 4 / 1e-4
TAPE = {
    "label": "tape",
    "youngs_modulus": "0.3 MPa",
    "poisson_ratio": 0.5,
    "work_of_adhesion": "50 mJ/m^2",
    "range": "0.3 nm",
}


def plate(n=128, seed=1, width=None):
    """Patch of a rough surface that is not periodic, with waves of 2 pixels and more."""
    s = SelfAffine(hurst=0.8, q0=1.0, q1=n / 2.0, h_rms=1e-6, q_rolloff=4.0)
    h = surface.synthesise(s, n=2 * n, length=4 * np.pi, seed=seed)[:n, : width or n]
    return Topography(h, SIDE / n, SIDE / n, "here")


@pytest.fixture(scope="module")
def pressed():
    return press_measured.press(plate(), Q0, 2 * np.pi / SIDE * 16, 128)


def test_a_share_of_every_block_touches_and_more_at_every_load(pressed):
    assert pressed.contact.dims == ("pressure", "x", "y")
    assert pressed.contact.shape == (8, 64, 64)
    assert set(np.unique(pressed.contact)) <= {0, 0.25, 0.5, 0.75, 1}
    assert np.all(np.diff(pressed.area_fraction) > 0)
    assert np.all(np.diff(pressed.mean_gap) < 0)
    # Where it touches once it touches at every higher load.
    lost = pressed.contact.values[1:] < pressed.contact.values[:-1]
    assert lost.mean() < 1e-3
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
    assert float(pressed.residual.max()) <= press_measured.TOLERANCE


def test_area_is_within_its_error_of_a_direct_solution_on_a_finer_grid(pressed):
    whole = periodic.periodise(plate().heights, "smooth")
    fine = periodic.band_limited(whole, (SIDE, SIDE), 2 * np.pi / SIDE * 15.99, 32)
    assert fine.shape[0] >= 4 * len(pressed.x)
    for index in (3, 5, 7):
        at = pressed.isel(pressure=index)
        contact = repulsive.solve(fine, SIDE, float(at.mean_pressure), tol=1e-5)
        area = contact.area_fraction - subpixel.boundary_strip(contact.gap == 0)
        assert abs(float(at.area_fraction) - area) <= float(at.area_fraction_discretisation_error)


def test_a_grid_that_is_too_coarse_leaves_waves_out_and_says_so():
    heights, cutoff = plate(), 2 * np.pi / SIDE * 32
    coarse = pictured_heights.prepare(heights, cutoff, 64)
    assert coarse.heights.shape == (64, 64)
    assert coarse.shortest_wavelength == pytest.approx(SIDE / 16)
    fine = pictured_heights.prepare(heights, cutoff, 512)
    assert fine.heights.shape == (256, 256)
    assert fine.shortest_wavelength == pytest.approx(SIDE / 32)
    long = pictured_heights.prepare(plate(width=64), cutoff, 128)
    assert long.heights.shape == (128, 64)
    assert long.sides == pytest.approx((SIDE, SIDE / 2))


def test_a_cutoff_beyond_the_map_leaves_waves_of_two_pixels():
    """That of another measurement, or pixels longer along one side."""
    heights = plate(100)
    found = pictured_heights.prepare(heights, 1e8, 512)
    assert found.shortest_wavelength == pytest.approx(2 * heights.dx)
    assert found.heights.shape == (400, 400)
    oblong = Topography(heights.heights, heights.dx, 2 * heights.dy, "here")
    assert pictured_heights.prepare(oblong, 1e8, 512).shortest_wavelength == pytest.approx(
        4 * heights.dx
    )


def test_the_first_measurement_that_is_a_map_is_pressed(tmp_path):
    line, area = tmp_path / "line.txt", tmp_path / "map.txt"
    heights = plate(64).heights
    np.savetxt(line, heights[:, 0] * 1e6)
    np.savetxt(area, heights.T * 1e6)
    units = {"kind": "measured", "height_unit": "um", "length": "100 um"}
    profile, matrix = {"file": str(line)}, {"file": str(area)}
    assert pictured_heights.read_map(units | profile, 1e9) is None
    several = units | {"measurements": [profile, matrix]}
    found, _ = pictured_heights.read_map(several, 1e9)
    assert found.source == str(area)
    assert found.heights.shape == (64, 64)
    assert pictured_heights.name_measurement(several, found) == str(area)
    assert pictured_heights.name_measurement(units | matrix, found) == ""


def test_a_map_has_its_own_cutoff_and_not_that_of_a_finer_one(tmp_path):
    paths = [tmp_path / name for name in ("coarse.txt", "fine.txt")]
    for seed, path in enumerate(paths):
        np.savetxt(path, plate(seed=seed).heights.T * 1e6)
    units = {"kind": "measured", "label": "both", "source": "own", "height_unit": "um"}
    coarse, fine = (
        {"file": str(path), "length": length}
        for path, length in zip(paths, ("100 um", "20 um"), strict=True)
    )
    both = units | {"measurements": [coarse, fine]}
    finest = float(analyse_surface.analyse(units | fine).q_cutoff)
    found, cutoff = pictured_heights.read_map(both, finest)
    alone = float(analyse_surface.analyse(units | coarse).q_cutoff)
    assert cutoff == pytest.approx(alone)
    assert pictured_heights.read_map(units | fine, finest)[1] == finest > 2 * cutoff
    prepared = pictured_heights.prepare(found, cutoff, 512)
    assert prepared.shortest_wavelength == pytest.approx(2 * np.pi / alone)
    # Contact that is asked for (bem) is of one measurement, too.
    for measurement, expected in ((0, cutoff), (1, finest)):
        asked = both | {"bem": {"measurement": measurement}}
        heights = contact_measured.read_map(asked)
        pressed = measured_surface.find_cutoff(asked, measurement, heights, finest)
        assert pressed == pytest.approx(expected)


def test_error_does_not_vanish_where_the_change_does():
    fine = np.array([1.0, 2.0, 4.0, 8.0, 16.0])
    error = press_measured.find_error(fine, fine * [1.01, 1.0, 0.97, 1.02, 1.0])
    np.testing.assert_allclose(error / fine, [0.01, 0.03, 0.03, 0.03, 0.02])


def test_numbers_have_three_digits_and_an_error_that_is_never_none(pressed):
    for row in touch.describe_loads(pressed, {}):
        for text in (row["area"], row["gap"]):
            value, error = text.split(")")[0].strip("(").split(" ± ")
            assert len(value.replace(".", "").lstrip("0")) <= 3, text
            assert float(error) > 0, text


def test_caption_names_the_measurement_among_several(pressed):
    assert "The heights are those" not in touch.write_caption(pressed)
    named = pressed.assign_attrs(measurement="data/b.txt")
    assert "those of the first map measured, ``data/b.txt``." in touch.write_caption(named)


def test_file_keeps_fields_and_is_small(pressed, tmp_path):
    path = tmp_path / "pictures/plate.nc"
    datasets.write(pressed, path, title="a", parameters={"surface": "plate"})
    back = datasets.read(path)
    np.testing.assert_array_equal(back.contact, pressed.contact)
    np.testing.assert_array_equal(back.gap, pressed.gap)
    assert path.stat().st_size < 500_000


def test_page_says_pressures_of_half_spaces_alone(pressed):
    tape = read_material(TAPE)
    rated = Material(tape.plane_strain, 0.05, 3e-10, depends_on_rate=True)
    rough = Material(tape.plane_strain, 0.05, 3e-10, depends_on_rate=False, surface="plate")
    rows = touch.describe_loads(pressed, {"tape": tape, "rated": rated, "rough": rough})
    assert [list(row["pressures"]) for row in rows] == [["tape", "rated at 1 Hz"]] * 8
    first = float(pressed.mean_pressure[0]) * 0.4e6
    assert rows[0]["pressures"]["tape"].startswith(f"{first:.2g} ")
    assert "for tape" in touch.say(rows[0])
    assert "p/(E* q<sub>0</sub> h<sub>rms</sub>) = " in touch.say(
        touch.describe_loads(pressed, {"rough": rough})[0]
    )
    for row in rows:
        assert "±" in row["area"]
        assert "±" in row["gap"]


@pytest.mark.slow
def test_picture_for_paper_shows_every_load(pressed, tmp_path):
    stills.draw_touch(pressed, tmp_path / "a.png")
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    drawn = touch.draw(pressed, ["load"] * 8)
    slider = drawn.select_one({"name": "load"})
    assert (slider.start, slider.end) == (0, 7)
