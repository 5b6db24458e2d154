"""Approach and separation on measured heights: states, what is left out, the model beside it."""

from dataclasses import replace

import numpy as np
import pytest

from common.formatting import number, percent
from criteria.materials import read_material
from criteria.texts import describe_share
from real_surfaces import pictured_heights, pull_measured
from real_surfaces.pull_measured import ATTRACTED, OPEN, TOUCHING, LeftOutError
from remaining import measure_remaining
from report import pull_off, stills
from report.pull_off_states import moments
from stickiness import surface
from stickiness.measured.topography import Topography
from stickiness.solids.moduli import Constant
from stickiness.spectrum import SelfAffine

SIDE = 1e-4
BAND = 2 * np.pi * 4 / SIDE, 2 * np.pi * 16 / SIDE
GEL = read_material(
    {
        "plane_strain_modulus": "0.1 MPa",
        "work_of_adhesion": "20 mJ/m^2",
        "range": "0.3 nm",
    }
)


def simulate(material=GEL, h_rms=2e-6, points=64, band=BAND):
    s = SelfAffine(hurst=0.8, q0=4.0, q1=16.0, h_rms=h_rms)
    h = surface.synthesise(s, n=64, length=2 * np.pi, seed=2)
    pictured = pictured_heights.prepare(
        Topography(h, SIDE / 64, SIDE / 64, "here"), 2 * np.pi / SIDE * 16, points
    )
    return pull_measured.simulate(pictured, band, material, "exponential", 0.1)


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
    # Errors are told from half the grid, as those of the simulations behind the model.
    assert pull_measured.PIXELS_IN_ZONE >= 2 * measure_remaining.RESOLVED


def test_simulation_agrees_with_the_model_of_the_verdicts(pulled):
    """On Gaussian heights, periodic, of several long waves."""
    assert pull_off.overlap(pulled, "separation")
    assert pull_off.overlap(pulled, "pull_off")
    assert "agree" in pull_off.judge(pulled)
    assert 0.05 < float(pulled.predicted_separation) < 0.9


def test_disagreement_names_what_the_model_is_known_to_get_wrong(pulled):
    off = pulled.assign(predicted_pull_off_high=pulled.pull_off_low / 2)
    assert pull_off.judge(off) == "The pull-off lies beyond the limits of the model."
    names = [f"{name}{end}" for name in ("separation", "pull_off") for end in pull_off.ENDS]
    less = pulled.assign({name: pulled[name] * 0.02 for name in names})
    assert float(less.separation) < pull_off.TOO_HIGH
    assert pull_off.judge(less) == (
        "The share that remains on separation and the pull-off lie beyond the limits of the model, "
        "which is known to be too high where less than 5 % remains."
    )
    # Where the simulation has more, that is no reason.
    model = {f"predicted_{name}": less[name] / 2 for name in names}
    assert "known" not in pull_off.judge(less.assign(model))
    # Nor where much remains.
    much = pulled.assign({f"predicted_{name}": pulled[name] * 3 for name in names})
    assert "beyond" in pull_off.judge(much)
    assert "known" not in pull_off.judge(much)


def test_table_shows_the_limits_that_are_compared(pulled):
    """Those of separation, and of the verdict in its own words."""
    pair = pull_off.as_pair(pulled, "predicted_").assign(remaining=("end", [0.2, 0.3]))
    rows = pull_off.compare(pulled, pair)
    assert [row["name"].split(",")[0] for row in rows] == [
        "Work of separation",
        "Work of separation by the model",
        "The verdict: energy gained by the model",
    ]
    for row, prefix in zip(rows, ("", "predicted_"), strict=False):
        shares = [percent(float(pulled[f"{prefix}separation{end}"])) for end in pull_off.ENDS]
        value, low, high = (share.removesuffix(" %") for share in shares)
        assert row["remains"] == f"{value} % ({low} to {high} %)"
        tensions = [float(pulled[f"{prefix}pull_off{end}"]) / 1e3 for end in pull_off.ENDS]
        value, low, high = (number(tension, 2) for tension in tensions)
        assert row["pull_off"] == f"{value} ({low} to {high})"
    assert rows[2]["remains"] == describe_share(pair)
    assert rows[2]["remains"].startswith("20 … 30 %")
    # Near full contact the model knows no pull-off, and the simulation does.
    strong = pulled.assign(energy_ratio=10.0)
    near = pull_off.compare(strong, pull_off.as_pair(strong, "predicted_"))
    assert [row["pull_off"].startswith("at least") for row in near] == [False, True, True]


def test_what_is_not_simulated_says_why():
    with pytest.raises(LeftOutError, match="by the model less than 0.1 % of its work"):
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
