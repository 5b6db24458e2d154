"""Measured heights made periodic, and their contact."""

import re

import numpy as np
import pytest

from pipeline.pages import pressed as _pressed
from pipeline.verdicts.materials import material
from real_surfaces import contact_measured
from stickiness import surface
from stickiness.config import checks
from stickiness.measured import periodic
from stickiness.measured.topography import Topography
from stickiness.spectrum import SelfAffine


@pytest.fixture
def heights():
    s = SelfAffine(hurst=0.8, q0=1.0, q1=20.0, h_rms=1.0)
    return surface.synthesise(s, n=64, length=2 * np.pi, seed=3)[:40, :32]


def jump(h):
    """Largest step across the seams over the largest inside."""
    inside = max(np.abs(np.diff(h, axis=0)).max(), np.abs(np.diff(h, axis=1)).max())
    return max(np.abs(h[0] - h[-1]).max(), np.abs(h[:, 0] - h[:, -1]).max()) / inside


def test_no_jump_is_left(heights):
    assert jump(heights + np.arange(40)[:, None]) > 2
    for kind in ("taper", "mirror"):
        assert jump(periodic.periodise(heights, kind)) < 1


def test_a_mirror_keeps_every_height_and_a_taper_the_inner_ones(heights):
    mirrored = periodic.periodise(heights, "mirror")
    assert mirrored.shape == (80, 64)
    np.testing.assert_array_equal(mirrored[:40, :32], heights)
    assert np.std(mirrored) == pytest.approx(np.std(heights))
    tapered = periodic.periodise(heights, "taper")
    shift = heights[20, 16] - tapered[20, 16]
    np.testing.assert_allclose(tapered[5:35, 4:28], heights[5:35, 4:28] - shift)
    assert tapered.mean() == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("q_max", [5.0, 20.0])
def test_band_limited_heights_are_the_same_waves_on_a_finer_grid(q_max):
    s = SelfAffine(hurst=0.8, q0=1.0, q1=20.0, h_rms=1.0)
    h = surface.synthesise(s, n=64, length=2 * np.pi, seed=3)
    sides = (2 * np.pi, 2 * np.pi)
    fine = periodic.band_limited(h, sides, q_max, 8)
    assert min(fine.shape) >= 8 * q_max
    assert all(n % 4 == 0 for n in fine.shape)
    known = surface.realised_spectrum(h, 2 * np.pi)
    found = periodic.shells(fine, sides)
    # The heights hold waves up to 20: nothing is lost there, and what is beyond 5 is.
    kept = known.variance[known.q <= q_max * (1 + 1e-9)].sum()
    assert found.h_rms**2 == pytest.approx(kept, rel=1e-9)
    assert found.q1 <= q_max * (1 + 1e-9)


def test_shells_of_an_oblong_period_keep_height_and_slope():
    x, y = np.meshgrid(np.arange(48) / 48, np.arange(20) / 20, indexing="ij")
    h = 2 * np.cos(2 * np.pi * 3 * x) + np.sin(2 * np.pi * 2 * y)
    found = periodic.shells(h, (6.0, 2.5))
    qx, qy = 2 * np.pi * 3 / 6, 2 * np.pi * 2 / 2.5
    assert found.h_rms**2 == pytest.approx(2 + 0.5)
    assert found.rms_slope**2 == pytest.approx(2 * qx**2 + 0.5 * qy**2)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: periodic.periodise(np.zeros(5), "taper"), r"map \(nx, ny\)"),
        (lambda: periodic.periodise(np.zeros((5, 5)), "fold"), "'taper' or 'mirror', got 'fold'"),
        (lambda: periodic.band_limited(np.zeros((8, 8)), (1.0, 1.0), 99.0, 4), "Nyquist"),
    ],
)
def test_wrong_arguments(call, message):
    with pytest.raises(ValueError, match=message):
        call()


# Contact

RANGES = np.geomspace(0.003, 1, 11)


def pressed(h, **changed):
    n = len(h)
    arguments = {
        "q0": 1.0,
        "q_max": 16.0,
        "pressures": np.array([0.03, 0.3]),
        "ranges": RANGES,
        "pixels": 4,
        "tolerance": 1e-6,
        "gamma": 0.45,
    } | changed
    step = 2 * np.pi / n
    return contact_measured.solved(Topography(h, step, step, "here"), **arguments)


@pytest.fixture(scope="module")
def whole():
    s = SelfAffine(hurst=0.8, q0=1.0, q1=16.0, h_rms=1.0)
    h = surface.synthesise(s, n=128, length=2 * np.pi, seed=5)
    return h, contact_measured.annotated(pressed(h))


def test_both_ways_bracket_nothing_absurd(whole):
    h, found = whole
    # The mirror keeps the variance but for the waves beyond the band that its seams make.
    assert float(found.h_rms.sel(periodisation="mirror")) == pytest.approx(np.std(h), rel=0.02)
    assert float(found.h_rms.sel(periodisation="taper")) < np.std(h)
    fine = found.isel(resolution=-1)
    assert np.all(fine.area_fraction.isel(pressure=1) > fine.area_fraction.isel(pressure=0))
    assert np.all(np.diff(fine.attractive_area, axis=-1) >= 0)
    # Area grows nearly linearly, and Persson's is within a third on one small surface.
    assert np.all(
        np.abs(fine.area_fraction / fine.theory_area_fraction - 1).isel(pressure=1) < 0.35
    )


def test_a_smooth_wave_is_pressed_as_westergaard_has_it():
    # h = cos x, alone: contact over sin^2(pi a/L) = p/(pi E* amplitude/L) (Westergaard 1939), in
    # which the amplitude is sqrt(2) h_rms. A mirror image of whole periods is the wave itself.
    n = 256
    x = (np.arange(n) + 0.5) * 2 * np.pi / n  # mirrored between points: an even wave goes on
    found = pressed(np.tile(np.cos(x)[:, None], (1, n)), pressures=np.array([0.2]), pixels=16)
    area = float(found.area_fraction.sel(periodisation="mirror").isel(resolution=-1, pressure=0))
    # pi E* amplitude/L with L = 2 pi and amplitude sqrt(2) in units of h_rms is 1/sqrt(2).
    expected = 2 / np.pi * np.arcsin(np.sqrt(0.2 * np.sqrt(2)))
    assert area == pytest.approx(expected, abs=2 / 256)


def test_grid_that_would_be_too_large_is_refused_with_the_remedy():
    with pytest.raises(ValueError, match=r"more than 2048; give bem\.shortest_wavelength of"):
        pressed(np.random.default_rng(0).normal(size=(256, 256)), q_max=120.0, pixels=64)


def test_range_pressed_is_not_finer_than_the_instrument():
    assert contact_measured.highest({}, 5.0) == 5.0
    coarse = contact_measured.highest({"shortest_wavelength": "2 m"}, 5.0)
    assert coarse == pytest.approx(np.pi)
    with pytest.raises(ValueError, match="below the instrument's"):
        contact_measured.highest({"shortest_wavelength": "1 m"}, 5.0)


def test_a_profile_cannot_be_pressed(tmp_path):
    path = tmp_path / "line.txt"
    path.write_text("\n".join(str(v) for v in np.random.default_rng(0).normal(size=30)))
    asked = {"file": str(path), "length": "1 um", "height_unit": "nm", "bem": {"pressures": [0.1]}}
    with pytest.raises(ValueError, match="is a line profile; bem needs a map"):
        contact_measured.chosen(asked)


def test_measurement_pressed_must_exist():
    surfaces = {
        "asphalt": {"kind": "measured", "file": __file__},
        "polished_steel": {"kind": "measured", "file": __file__, "bem": {"measurement": 1}},
    }
    with pytest.raises(checks.ConfigError, match=r"polished_steel\.bem\.measurement = 1 .*below 1"):
        checks.check_surfaces(surfaces)


# On the page


def test_rows_of_the_page_hold_value_error_and_theory(whole):
    _, found = whole
    rows = _pressed.describe_loads(found)
    assert [row["pressure"] for row in rows] == ["0.03", "0.3"]
    assert re.fullmatch(r"[\d.]+ ± [\d.]+", rows[1]["area"]["value"])
    assert rows[1]["area"]["ways"].startswith("tapered 0.")
    value, error = _pressed.combine_ways(found.area_fraction.isel(pressure=1))
    fine = found.area_fraction.isel(pressure=1, resolution=-1).values
    assert value == pytest.approx(fine.mean())
    assert error >= abs(fine[1] - fine[0]) / 2


@pytest.mark.parametrize(("range_", "shown"), [("0.2 m", True), ("5 m", False), ("3 mm", False)])
def test_margin_is_shown_where_the_grid_resolves_the_range(whole, range_, shown):
    _, found = whole
    entry = {"plane_strain_modulus": "1 Pa", "work_of_adhesion": "0.1 J/m^2", "range": range_}
    ends = {"h_rms": ("end", [1.0, 1.0]), "rms_slope": ("end", [3.0, 3.0])}
    known = found.isel(resolution=-1, periodisation=0)[[]].assign(ends | {"q0": 1.0})
    row = _pressed.describe_pair(found, material(entry), known)
    assert row["resolved"] == shown
    assert (row["margin"] != "–") == shown
