from pathlib import Path
from types import SimpleNamespace

import matplotlib.image
import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray as xr
from matplotlib.text import Text

from adhesion import compare_edges
from criteria import compare_criteria, map_criterion
from figures import plot_fig9
from pipeline.pages import style
from pipeline.verdicts.a_v import MeasuredAv
from stickiness import criteria
from stickiness.adhesion import equivalent_sphere
from stickiness.core import datasets
from stickiness.spectrum import SelfAffine

SMALLEST_FONT = 8  # points


@pytest.fixture
def kept(monkeypatch):
    """Figures stay open after they are saved, for a look at what is on them."""
    monkeypatch.setattr(style.plt, "close", lambda figure: None)
    yield lambda: plt.figure(plt.get_fignums()[-1])
    monkeypatch.undo()
    plt.close("all")


def job(tmp_path, name, **inputs):
    outputs = [str(tmp_path / f"{name}.{suffix}") for suffix in ("png", "pdf")]
    return SimpleNamespace(input=SimpleNamespace(**inputs), output=outputs)


class ConstantAv:
    """A table of a_V that has one value, 20 % low and 30 % high ends."""

    bounds = {"magnification": (10.0, 1e8), "range": (1e-12, 1.0)}  # noqa: RUF012

    def a_v_at(self, hurst, pressure, range_over_h_rms, magnification):
        value = np.full(np.broadcast(range_over_h_rms, magnification).shape, 3.0)
        return SimpleNamespace(value=value, low=0.8 * value, high=1.3 * value)


ASKED_MAP = {
    "hurst": 0.8,
    "shortest_over_range": 4,
    "range_times_q0": {"minimum": 1e-7, "maximum": 1e-2, "per_decade": 2},
    "adhesion_length_over_range": {"minimum": 1e-3, "maximum": 10, "per_decade": 2},
    "slope_parameter": [1, 0.1],
    "slope_a_v": 3.0,
}
CONSTANT = MeasuredAv(
    value=3.0,
    simulated=2.0,
    over_lattice=1.0,
    magnification=1e6,
    sampling=0.2,
    discretisation=0.1,
    window=0.1,
    bandwidth=0.5,
)


def made_map():
    roughness = map_criterion.Roughness(ConstantAv(), ASKED_MAP, 0.065)
    return map_criterion.find_limits(ASKED_MAP, CONSTANT, roughness)


def test_map_with_constant_a_v_has_the_closed_form():
    made = made_map()
    inside = made.h_rms_limit.notnull()
    ratio = (made.h_rms_limit / made.h_rms_limit_constant).where(inside)
    np.testing.assert_allclose(ratio.values[inside.values], 1, rtol=1e-5)
    for end, share in (("low", 0.8), ("high", 1.3)):
        ratio = made[f"h_rms_limit_{end}"] / made.h_rms_limit
        there = ratio.notnull().values
        np.testing.assert_allclose(ratio.values[there], share**0.6, rtol=1e-5)


def test_edges_of_the_map_are_weak_above_its_line_and_balance_on_the_threshold():
    made = made_map()
    roughness = map_criterion.Roughness(ConstantAv(), ASKED_MAP, 0.065)
    q0, length = 1e-4, 0.1
    at = {"range_times_q0": q0, "adhesion_length_over_range": length}
    one = made.sel(at, method="nearest")

    def edges(h):
        slope = roughness.slope(h, np.array(q0))
        return equivalent_sphere.attraction(h, q0, slope, length, 1.0, 3.0)

    assert edges(float(one.weak_limit)).strength == pytest.approx(equivalent_sphere.WEAK, rel=1e-4)
    assert edges(float(one.h_rms_limit_edges)).ratio == pytest.approx(1, rel=1e-4)
    assert one.h_rms_limit_edges_low < one.h_rms_limit_edges < one.h_rms_limit_edges_high


def assert_drawn(files):
    """Both files are there and the picture is of a journal's width and not blank."""
    picture = matplotlib.image.imread(files[0])
    assert picture.shape[1] == round(style.WIDTH * 200)
    # Ink: a blank page has no contrast at all, text and lines alone give some per cent.
    assert picture[..., :3].std() > 0.05
    assert Path(files[1]).read_bytes().startswith(b"%PDF-")


def font_sizes(figure):
    return [text.get_fontsize() for text in figure.findobj(Text) if text.get_text().strip()]


def compared(tmp_path):
    asked = {
        "hurst": 0.8,
        "range_times_q0": 1e-6,
        "h_rms_over_range": {"minimum": 10, "maximum": 1e4, "per_decade": 2},
        "quoted_h_rms_over_range": 1000,
        "magnification": {"minimum": 10, "maximum": 1e5, "per_decade": 2},
        "quoted_magnification": 1e4,
    }
    data = compare_criteria.compare(asked, 0.065, ConstantAv(), 3.0)
    path = tmp_path / "compared.nc"
    datasets.write(compare_criteria.describe(data), path, title="c", parameters=asked)
    return path


def test_which_criteria_know_the_finest_waves(tmp_path):
    data = datasets.read(compared(tmp_path)).against_magnification
    change = data.isel(magnification=-1) / data.isel(magnification=0)
    unmoved = ["violano_constant", "violano_printed", "bearing_area"]
    np.testing.assert_allclose(change.sel(criterion=unmoved), 1, rtol=1e-12)
    assert change.sel(criterion="fuller_tabor") > 10
    assert change.sel(criterion="pastewka_robbins") < 0.1
    # every threshold is where its criterion's margin is 1
    at = float(data.sel(criterion="pastewka_robbins", magnification=10))
    s = SelfAffine(hurst=0.8, q0=1e-6, q1=1e-5, h_rms=1000.0)
    found = criteria.pastewka_robbins(s.rms_slope, s.rms_curvature, at, 1.0)
    assert found.margin == pytest.approx(1, rel=1e-12)


def test_figure_9(tmp_path, kept):
    names = ["edge_adhesion", "violano", "pastewka_robbins", "fuller_tabor", "dahlquist"]
    moduli = np.geomspace(1e3, 1e7, 2 * 3 * 2 * len(names)).reshape(2, 3, 2, len(names))
    data = xr.Dataset(
        {"threshold_by_criterion": (("material", "surface", "end", "criterion"), moduli)},
        coords={
            "material": ["gel", "steel"],
            "surface": ["a_line", "road", "wafer"],
            "end": ["smooth", "rough"],
            "criterion": names,
        },
    )
    path = tmp_path / "verdicts.nc"
    described = {name: ("1", name) for name in data.variables}
    datasets.write(datasets.annotate(data, **described), path, title="v", parameters={})
    made = job(tmp_path, "fig9", compared=compared(tmp_path), verdicts=path)
    plot_fig9.main(made)
    assert_drawn(made.output)
    assert min(font_sizes(kept())) >= SMALLEST_FONT


def test_simulation_of_spheres_is_the_model_of_the_edges():
    """Realisations that behave as the equivalent sphere give a ratio of 1, at any load and area."""
    loads, q0_h_rms = np.geomspace(0.01, 0.3, 9), 0.1
    ranges, lengths = np.array([0.03, 0.1]), np.array([1e-3, 0.1])
    gaps = np.geomspace(1e-3, 10, 400)
    area = 0.9 * loads  # without adhesion
    attractive = 1.3 * loads[:, None] * gaps ** (2 / 3)
    alone = xr.Dataset(
        {
            "pixel_area_fraction": (("resolution", "pressure"), [area]),
            "attractive_area": (("resolution", "pressure", "range"), [attractive]),
        },
        coords={"pressure": loads, "range": gaps, "resolution": [8.0]},
    )
    at = loads[[3, 4]]
    dims = ("pressure", "adhesion_length_over_range", "range_over_h_rms")
    held = 1.1 * at[:, None, None]  # load without adhesion at the area with it
    strength = lengths[:, None] / q0_h_rms
    t = 1.3 / 0.9 * ranges ** (2 / 3)
    tau = equivalent_sphere.edge_strength(t, strength * 0.9)
    ratio = strength * 1.3 * ranges ** (2 / 3) * equivalent_sphere.effect(t, tau)
    adhesive = xr.Dataset(
        {
            "external_pressure": (dims, held * (1 - ratio)),
            "repulsive_area": (dims, 0.9 * held * np.ones((1, 2, 2))),
            "attraction_dmt": (dims, strength * 1.3 * at[:, None, None] * ranges ** (2 / 3)),
            "area_alone": ("pressure", 0.9 * at),
        },
        coords=dict(zip(dims, (at, lengths, ranges), strict=True)),
        attrs={"parameters": '{"law": "maugis", "grid_points": 512, "refine": 1}'},
    ).expand_dims(resolution=[8.0])
    found = compare_edges.compare(adhesive, alone, q0_h_rms, -1)
    np.testing.assert_allclose(found.effect, found.effect_model, rtol=1e-3)
    few = adhesive.assign_attrs(parameters='{"law": "maugis", "grid_points": 64, "refine": 1}')
    assert compare_edges.compare(few, alone, q0_h_rms, -1).effect.isnull().all()
    np.testing.assert_allclose(found.edge_strength.transpose(*dims)[0], tau, rtol=1e-3)
