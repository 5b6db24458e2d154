from pathlib import Path
from types import SimpleNamespace

import matplotlib.image
import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray as xr
from matplotlib.text import Text

import _style
import map_criterion
import plot_fig5
import plot_fig6
from _criteria import MeasuredAv
from stickiness import datasets

SMALLEST_FONT = 8  # points


@pytest.fixture
def kept(monkeypatch):
    """Figures stay open after they are saved, for a look at what is on them."""
    monkeypatch.setattr(_style.plt, "close", lambda figure: None)
    yield lambda: plt.figure(plt.get_fignums()[-1])
    monkeypatch.undo()
    plt.close("all")


def job(tmp_path, name, **inputs):
    outputs = [str(tmp_path / f"{name}.{suffix}") for suffix in ("png", "pdf")]
    return SimpleNamespace(input=SimpleNamespace(**inputs), output=outputs)


@pytest.fixture
def criterion_map(tmp_path):
    asked = {
        "range_times_q0": {"minimum": 1e-12, "maximum": 1e-2, "per_decade": 2},
        "adhesion_length_over_range": {"minimum": 1e-4, "maximum": 10, "per_decade": 2},
        "slope_parameter": [1, 0.1],
        "slope_a_v": 3.0,
    }
    a_v = MeasuredAv(
        value=3.0,
        simulated=2.0,
        over_lattice=1.0,
        magnification=1e6,
        sampling=0.2,
        discretisation=0.1,
        window=0.1,
        bandwidth=0.5,
    )
    data = map_criterion.limits(asked, a_v)
    data = data.merge(map_criterion.slopes(asked["slope_parameter"], asked["slope_a_v"]))
    path = tmp_path / "map.nc"
    datasets.write(map_criterion.annotated(data), path, title="map", parameters=asked)
    return path


def surface(tmp_path, label, measured):
    q = np.geomspace(1e3, 1e6, 12)
    data = xr.Dataset(
        {"psd": (("end", "wave_number"), [1e-5 * q**-3.6, 1e-3 * q**-3.6])},
        coords={"end": ["smooth", "rough"], "wave_number": q},
    )
    if measured:
        data["psd_fit"] = ("wave_number", 1e-5 * q**-3.6)
        data["psd_standard_error"] = ("wave_number", 2e-5 * q**-3.6)
        data["fitted"] = ("wave_number", np.ones(q.size, dtype="i1"))
    described = {name: ("1", name) for name in data.variables}
    path = tmp_path / f"{label}.nc"
    parameters = {"label": label}
    datasets.write(datasets.annotate(data, **described), path, title="t", parameters=parameters)
    return path


def assert_drawn(files):
    """Both files are there and the picture is of a journal's width and not blank."""
    picture = matplotlib.image.imread(files[0])
    assert picture.shape[1] == round(_style.WIDTH * 200)
    # Ink: a blank page has no contrast at all, text and lines alone give some per cent.
    assert picture[..., :3].std() > 0.05
    assert Path(files[1]).read_bytes().startswith(b"%PDF-")


def font_sizes(figure):
    return [text.get_fontsize() for text in figure.findobj(Text) if text.get_text().strip()]


def test_figure_5(tmp_path, criterion_map, kept):
    made = job(tmp_path, "fig5", map=criterion_map)
    plot_fig5.main(made)
    assert_drawn(made.output)
    assert min(font_sizes(kept())) >= SMALLEST_FONT


def test_threshold_is_shaded_where_it_leaves_the_dmt_range(criterion_map):
    data = datasets.read(criterion_map)
    figure, panels = _style.canvas("A", 3)
    ax = panels["A"]
    plot_fig5.unsafe(ax, data)
    # limit = (4.5 X)^0.6 and JTB = (4/75) X with X = (l_a/range)/(range q0) meet at this limit.
    crossing = (4 / 75) * (4.5**0.6 * 75 / 4) ** 2.5
    assert ax.patches[0].get_y() == pytest.approx(crossing, rel=1e-6)  # power laws: exact in logs
    plt.close(figure)


def test_figure_6_draws_bands_points_and_no_line_twice(tmp_path, kept):
    labels = [("C0 = 10⁻³ m^0.4", False), ("road", False), ("wafer", True)]
    files = [surface(tmp_path, label, measured) for label, measured in labels]
    made = job(tmp_path, "fig6", surfaces=files)
    plot_fig6.main(made)
    assert_drawn(made.output)
    figure = kept()
    assert min(font_sizes(figure)) >= SMALLEST_FONT
    legend = figure.axes[0].get_legend()
    assert [text.get_text() for text in legend.get_texts()] == ["road", "wafer"]


def test_figure_6_draws_no_more_than_was_measured(tmp_path):
    data = datasets.read(surface(tmp_path, "wafer", True)).assign(q1=1e6, q_cutoff=1e5)
    figure, panels = _style.canvas("A", 3)
    plot_fig6.measured(panels["A"], data, 0, "k")
    furthest = max(line.get_xdata().max() for line in panels["A"].lines if len(line.get_xdata()))
    assert furthest <= 1e5
    plt.close(figure)


def test_labels_move_apart_and_keep_their_order():
    assert _style.apart([1.0, 5.0, 1.05, 1.02], 1.1) == pytest.approx([1.0, 5.0, 1.21, 1.1])


def test_errors_add_in_quadrature_and_a_single_seed_has_none():
    assert _style.total_error([3.0, np.nan], [4.0, 0.5]) == pytest.approx([5.0, 0.5])


def test_a_figure_that_fails_leaves_the_old_one(tmp_path, monkeypatch):
    path = tmp_path / "fig.png"
    path.write_bytes(b"old")
    figure, _ = _style.canvas("A", 2)

    def break_off(temporary, **_):
        temporary.write_bytes(b"half")
        raise OSError("no space left on device")

    monkeypatch.setattr(figure, "savefig", break_off)
    with pytest.raises(OSError, match="no space"):
        _style.save(figure, [str(path)])
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]
    plt.close(figure)


def test_the_same_data_give_the_same_files(tmp_path, criterion_map):
    contents = []
    for name in ("a", "b"):
        made = job(tmp_path, name, map=criterion_map)
        plot_fig5.main(made)
        contents.append([Path(path).read_bytes() for path in made.output])
    assert contents[0] == contents[1]
