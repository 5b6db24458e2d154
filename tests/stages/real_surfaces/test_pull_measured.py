"""Approach and separation on measured heights: states, what is left out, the model beside it."""

from dataclasses import replace

import numpy as np
import pytest

from pipeline import pictured_heights
from pipeline.pages import pull_off, stills
from pipeline.pages.pull_off_states import moments
from pipeline.verdicts.materials import read_material
from real_surfaces import pull_measured
from real_surfaces.pull_measured import ATTRACTED, OPEN, TOUCHING, LeftOutError
from stickiness import surface
from stickiness.criteria.moduli import Constant
from stickiness.measured.topography import Topography
from stickiness.spectrum import SelfAffine

SIDE, Q0 = 1e-4, 2 * np.pi * 4 / 1e-4
GEL = read_material(
    {
        "plane_strain_modulus": "0.1 MPa",
        "work_of_adhesion": "20 mJ/m^2",
        "range": "0.3 nm",
    }
)


def simulate(material=GEL, h_rms=2e-6, points=64):
    s = SelfAffine(hurst=0.8, q0=4.0, q1=16.0, h_rms=h_rms)
    h = surface.synthesise(s, n=64, length=2 * np.pi, seed=2)
    pictured = pictured_heights.prepare(
        Topography(h, SIDE / 64, SIDE / 64, "here"), 2 * np.pi / SIDE * 16, points
    )
    return pull_measured.simulate(pictured, Q0, material, "exponential", 0.1)


@pytest.fixture(scope="module")
def pulled():
    return simulate()


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


def test_quoted_numbers_are_those_of_the_curve(pulled):
    back = pulled.isel(state=pulled.separating.values == 1)
    assert float(pulled.pull_off) == pytest.approx(float(back.mean_traction.max()))
    work = np.trapezoid(np.maximum(back.mean_traction, 0), back.mean_gap)
    assert float(pulled.separation) == pytest.approx(work / GEL.work_of_adhesion, rel=0.1)
    found = moments(pulled)
    assert list(found) == ["unloaded", "squeezed", "pull-off", "last contact"]
    assert list(found.values()) == sorted(found.values())
    assert float(pulled.mean_traction[found["pull-off"]]) == pytest.approx(float(pulled.pull_off))


def test_range_is_that_of_the_grid_and_a_longer_one_that_of_the_material(pulled):
    length = GEL.work_of_adhesion / GEL.modulus
    zone = float(pulled["range"]) ** 2 / length
    assert zone / (SIDE / pulled.sizes["x"]) == pytest.approx(pull_measured.PIXELS_IN_ZONE)
    assert float(pulled.material_range) == GEL.range
    wide = replace(GEL, range=1.9e-6)
    assert float(simulate(wide)["range"]) == wide.range


def test_simulation_agrees_with_the_model_of_the_verdicts(pulled):
    """On Gaussian heights, periodic, of several long waves."""
    assert pull_off.overlap(pulled, "separation")
    assert pull_off.overlap(pulled, "pull_off")
    assert "agree" in pull_off.judge(pulled)
    assert 0.05 < float(pulled.predicted_separation) < 0.9
    off = pulled.assign(predicted_pull_off_high=pulled.pull_off_low / 2)
    assert "The pull-off lies beyond the limits" in pull_off.judge(off)


def test_what_is_not_simulated_says_why():
    with pytest.raises(LeftOutError, match="nothing of its work of adhesion remains"):
        simulate(replace(GEL, plane_strain=Constant(2e11)))
    with pytest.raises(LeftOutError, match="longer than the rms height, 9.9 nm"):
        simulate(h_rms=1e-8)
    with pytest.raises(LeftOutError, match="roughness of its own"):
        simulate(replace(GEL, surface="plate"))


def test_pictures_show_the_moments(pulled, tmp_path):
    stills.draw_pull_off(pulled, tmp_path / "a.png")
    stills.draw_reason("it is dark", tmp_path / "b.png")
    for name in "ab":
        assert (tmp_path / f"{name}.png").read_bytes().startswith(b"\x89PNG")
    few = pull_off.thin(pulled)
    assert few.sizes["state"] <= pull_off.MOST_STATES + 4
    slider = pull_off.draw(few).select_one({"name": "moment"})
    assert slider.value == moments(few)["pull-off"]
