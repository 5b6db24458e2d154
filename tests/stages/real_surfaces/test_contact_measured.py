"""Contact of measured heights that were made periodic."""

import re

import numpy as np
import pytest

from pipeline.pages import measured_contact
from pipeline.verdicts.materials import read_material
from real_surfaces import contact_measured
from stickiness import surface
from stickiness.measured.topography import Topography
from stickiness.spectrum import SelfAffine

RANGES = np.geomspace(0.003, 1, 11)


def contact_of(h, q_max=16.0, **changed):
    setting = {
        "pressures": np.array([0.03, 0.3]),
        "ranges": RANGES,
        "pixels": 4,
        "tolerance": 1e-6,
        "gamma": 0.45,
    } | changed
    step = 2 * np.pi / len(h)
    heights = Topography(h, step, step, "here")
    return contact_measured.solve(heights, 1.0, q_max, contact_measured.Setting(**setting))


@pytest.fixture(scope="module")
def whole():
    s = SelfAffine(hurst=0.8, q0=1.0, q1=16.0, h_rms=1.0)
    h = surface.synthesise(s, n=128, length=2 * np.pi, seed=5)
    return h, contact_measured.annotate(contact_of(h))


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


def test_contact_of_a_smooth_wave_is_westergaard_s():
    # h = cos x, alone: contact over sin^2(pi a/L) = p/(pi E* amplitude/L) (Westergaard 1939), in
    # which the amplitude is sqrt(2) h_rms. A mirror image of whole periods is the wave itself.
    n = 256
    x = (np.arange(n) + 0.5) * 2 * np.pi / n  # mirrored between points: an even wave goes on
    found = contact_of(np.tile(np.cos(x)[:, None], (1, n)), pressures=np.array([0.2]), pixels=16)
    area = float(found.area_fraction.sel(periodisation="mirror").isel(resolution=-1, pressure=0))
    # pi E* amplitude/L with L = 2 pi and amplitude sqrt(2) in units of h_rms is 1/sqrt(2).
    expected = 2 / np.pi * np.arcsin(np.sqrt(0.2 * np.sqrt(2)))
    assert area == pytest.approx(expected, abs=2 / 256)


def test_grid_that_would_be_too_large_is_refused_with_the_remedy():
    with pytest.raises(ValueError, match=r"more than 2048; give bem\.shortest_wavelength of"):
        contact_of(np.random.default_rng(0).normal(size=(256, 256)), q_max=120.0, pixels=64)


def test_waves_are_not_shorter_than_the_instrument():
    assert contact_measured.highest_wave_number({}, 5.0) == 5.0
    coarse = contact_measured.highest_wave_number({"shortest_wavelength": "2 m"}, 5.0)
    assert coarse == pytest.approx(np.pi)
    with pytest.raises(ValueError, match="below the instrument's"):
        contact_measured.highest_wave_number({"shortest_wavelength": "1 m"}, 5.0)


def test_a_profile_is_refused(tmp_path):
    path = tmp_path / "line.txt"
    path.write_text("\n".join(str(v) for v in np.random.default_rng(0).normal(size=30)))
    asked = {"file": str(path), "length": "1 um", "height_unit": "nm", "bem": {"pressures": [0.1]}}
    with pytest.raises(ValueError, match="is a line profile; bem needs a map"):
        contact_measured.read_map(asked)


# On the page


def test_rows_of_the_page_hold_value_error_and_theory(whole):
    _, found = whole
    rows = measured_contact.describe_loads(found)
    assert [row["pressure"] for row in rows] == ["0.03", "0.3"]
    assert re.fullmatch(r"[\d.]+ ± [\d.]+", rows[1]["area"]["value"])
    assert rows[1]["area"]["ways"].startswith("tapered 0.")
    value, error = measured_contact.combine_ways(found.area_fraction.isel(pressure=1))
    fine = found.area_fraction.isel(pressure=1, resolution=-1).values
    assert value == pytest.approx(fine.mean())
    assert error >= abs(fine[1] - fine[0]) / 2


@pytest.mark.parametrize(("range_", "shown"), [("0.2 m", True), ("5 m", False), ("3 mm", False)])
def test_margin_is_shown_where_the_grid_resolves_the_range(whole, range_, shown):
    _, found = whole
    entry = {"plane_strain_modulus": "1 Pa", "work_of_adhesion": "0.1 J/m^2", "range": range_}
    ends = {"h_rms": ("end", [1.0, 1.0]), "rms_slope": ("end", [3.0, 3.0])}
    known = found.isel(resolution=-1, periodisation=0)[[]].assign(ends | {"q0": 1.0})
    row = measured_contact.describe_pair(found, read_material(entry), known)
    assert row["resolved"] == shown
    assert (row["margin"] != "–") == shown
