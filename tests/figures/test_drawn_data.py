"""What the figures show: lines, points and bars are the numbers of the data they are drawn from."""

import json

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest
import xarray as xr
from helpers.entries import model_surface
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import same_color

from common.edge_points import select_certain
from figures import (
    plot_fig1,
    plot_fig2,
    plot_fig3,
    plot_fig4,
    plot_fig5,
    plot_fig6,
    plot_fig8,
    plot_fig9,
    plot_fig10,
    plot_fig13,
    plot_fig14,
)
from stability import plot_stability
from stickiness import error_budget as budget
from stickiness.criteria import equivalent_sphere
from stickiness.pages import plotting
from stickiness.remaining import predict
from stickiness.spectrum import SelfAffine
from tradeoff import plot_tradeoff

# Relative errors by source of everything "measured" here: in quadrature 3, 4, 12 give 13 %.
SHARES = {"discretisation": 0.03, "sampling": 0.04, "model": 0.12}
SAMPLING, TOTAL = 0.04, 0.13
VARIANTS = ["afferrante2018", "afferrante2018, wang2017", "almqvist2011"]
FACTORS = [1.0, 1.2, 0.5]  # of the variants, so that the band is from 1 to 1.2


@pytest.fixture
def ax():
    figure, ax = plt.subplots(figsize=(plotting.WIDTH, 3))
    yield ax
    plt.close(figure)


def dataset(coords, variables, **parameters):
    """Dataset with parameters; a name that ends in * gets errors by source.

    Without a tuple that names its dimensions, a variable has the last ones of the coordinates.
    """
    dims, described = tuple(coords), {}
    for name, values in variables.items():
        known = isinstance(values, tuple)
        described[name.rstrip("*")] = (
            values if known else (dims[len(dims) - np.ndim(values) :], values)
        )
    data = xr.Dataset(described, coords=coords)
    for name in (name.rstrip("*") for name in variables if name.endswith("*")):
        parts = [abs(data[name]) * SHARES.get(source, 0.0) for source in budget.SOURCES]
        data[f"{name}_error"] = xr.concat(parts, "source")
        data[f"{name}_total_error"] = TOTAL * abs(data[name])
    data = data.assign_coords(source=list(budget.SOURCES))
    return data.assign_attrs(parameters=json.dumps(parameters))


def drawn(ax, x, y, **look):
    """The only line of this look that is drawn through these points, point by point."""
    x, y = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
    found = []
    for line in ax.lines:
        data = np.array(line.get_data(), dtype=float)
        same = data.shape[1:] == x.shape and np.allclose(
            data, [x, y], rtol=1e-9, atol=0, equal_nan=True
        )
        values = {name: getattr(line, f"get_{name}")() for name in look}
        alike = all(
            same_color(values[name], value) if "color" in name else values[name] == value
            for name, value in look.items()
        )
        found += [line] if same and alike else []
    assert len(found) == 1, f"{len(found)} lines of {look} through {x}, {y}"
    return found[0]


def bar_lengths(ax, axis=1):
    """Half the length of every error bar, one array for every set of points."""
    halves = []
    for container in ax.containers:
        (bars,) = container.lines[2]
        ends = np.array([ends for ends in bars.get_segments() if len(ends)])[:, :, axis]
        halves.append((bars.get_linewidth()[0], (ends[:, 1] - ends[:, 0]) / 2))
    return halves


def assert_bars(ax, values):
    """A thin bar for all errors and a thick one for the sampling error of these values."""
    (thin, total), (thick, sampling) = bar_lengths(ax)
    assert thin < thick
    np.testing.assert_allclose(total, TOTAL * np.ravel(values), rtol=1e-9)
    np.testing.assert_allclose(sampling, SAMPLING * np.ravel(values), rtol=1e-9)


def band_ends(ax, index=0):
    """Lowest and highest ordinate of a band at each of its abscissae."""
    bands = [c for c in ax.collections if isinstance(c, PolyCollection)]
    corners = bands[index].get_paths()[0].vertices
    x = np.unique(corners[:, 0])
    rows = [corners[corners[:, 0] == value][:, 1] for value in x]
    return x, [row.min() for row in rows], [row.max() for row in rows]


def test_bars_are_the_errors_and_unknown_ones_are_left_out(ax):
    data = dataset({"x": [1.0, 2.0]}, {"mean*": [1.0, 2.0]})
    data.mean_error.loc[{"source": "sampling"}] = [np.nan, 0.08]
    plotting.draw_points(ax, [1, 2], data, "mean", 2.0, color=plotting.RED)
    drawn(ax, [1, 2], [0.5, 1.0], marker="o", color=plotting.RED)
    (_, total), (_, sampling) = bar_lengths(ax)
    np.testing.assert_allclose(sampling, [0, 0.04])
    np.testing.assert_allclose(total, [np.hypot(0.03, 0.12) / 2, 0.13])


def densities(gap, magnification):
    """P(u) by all variants, (zeta/u)^0.1, at one Hurst exponent and load."""
    coords = {"hurst": [0.8], "load": [0], "variant": VARIANTS}
    coords |= {"magnification": magnification, "gap": gap}
    values = np.multiply.outer(FACTORS, np.divide.outer(magnification, gap) ** 0.1)
    return dataset(coords, {"gap_density": values[None, None], "mean_gap": 2.0})


def test_figure_1b_interpolates_gaps_along_a_power_law(ax):
    plot_fig1.draw_convergence(ax, densities(np.geomspace(1e-4, 10, 6), [3.0, 30.0]))
    for gap in plot_fig1.GAPS:
        drawn(ax, [3, 30], (np.array([3, 30]) / gap) ** 0.1, marker=".")


def loaded_maps(**more):
    """Areas of one realisation on loading, at two adhesion lengths."""
    pressure = np.array([0.015, 0.065])
    coords = {"adhesion_length_over_range": [0.05, 0.2], "pressure": pressure}
    variables = {"repulsive_area": np.outer([1.0, 2.0], pressure), "area_alone": pressure / 2}
    variables |= {"range_over_h_rms": ((), 0.0075), "pixels_in_zone": ([*coords][0], [4.8, 1.2])}
    return dataset(coords, variables | more, q0_h_rms=0.1)


def test_figure_2c_has_full_solution_fit_compressed_area_and_dmt_limit(ax):
    lengths, value = np.array([0.01, 0.1]), np.array([[[0.4, -0.1]]])
    coords = {"pressure": [0.065], "range_over_h_rms": [0.1], "adhesion_length_over_range": lengths}
    variables = {"inverse_kappa*": value, "inverse_kappa_fit": value + 0.01}
    variables |= {"inverse_kappa_net": value + 0.02, "q0_h_rms": 0.1}
    limit = dataset(coords, {"inverse_kappa": value + 0.03})
    plot_fig2.draw_threshold(ax, limit, dataset(coords, variables), loaded_maps(), rms_slope=4.0)
    drawn(ax, lengths, [0.4, -0.1], marker="o", linestyle="None")
    drawn(ax, lengths, [0.41, -0.09], linestyle="-")
    drawn(ax, lengths, [0.42, -0.08], markerfacecolor="white")
    drawn(ax, lengths, [0.43, -0.07], linestyle=":")
    drawn(ax, [0.05, 0.2], [1 / 4, 1 / 8], marker="x")
    assert_bars(ax, [0.4, 0.1])


def test_figure_2_maps_show_compression_tension_and_attraction(ax):
    plot_fig2.draw_zones(ax, np.array([[3, 2], [1, 0]]))
    (image,) = ax.images
    picture = image.get_array()
    assert same_color(picture[0, 0], plotting.BLACK)
    assert same_color(picture[0, 1], plotting.ORANGE)
    assert same_color(picture[1, 0], plot_fig2.ZONES[1])
    assert same_color(picture[1, 1], "white")


@pytest.fixture
def case():
    ranges = np.array([0.01, 0.03, 0.1, 0.2, 0.3])
    coords = {"pressure": [0.0065, 0.065], "range": ranges}
    windows = {"variant": VARIANTS, "window": [0, 1], "pressure": coords["pressure"]}
    area = np.outer([1, 10], 0.02 * ranges ** (2 / 3))
    a_v = np.multiply.outer(FACTORS, [[2.5, 1.5], [9.0, 9.0]])
    surface = model_surface(magnification=64, window=4)
    return plot_fig3.join(
        dataset(coords, {"attractive_area_mean*": area}, **surface),
        dataset(windows, {"a_v_mean*": [[3.0, 2.0], [9.0, 9.0]]}, **surface),
        dataset(windows, {"a_v": a_v}, **surface),
    )


def test_figure_3_takes_a_v_of_the_first_window_at_its_load(ax, case):
    plot_fig3.draw_case(ax, case, 64, [0.065], color=plotting.RED, marker="D")
    drawn(ax, [64], [2.0], markerfacecolor=plotting.RED, marker="D")
    drawn(ax, [64], [1.5], markerfacecolor="white", marker="D")
    assert_bars(ax, [2.0])


def test_figure_4b_leaves_out_slopes_below_their_error(ax):
    data = dataset({"length": [1, 2]}, {"inverse_kappa_ad*": np.array([0.5, 0.1])})
    data.inverse_kappa_ad_error[{"length": 1}] = 0.1  # in quadrature over all sources: more
    plot_fig4.draw_slopes(ax, [1, 2], data, "inverse_kappa_ad", 0.5, color="k", marker="o")
    drawn(ax, [1, 2], [1.0, np.nan], marker="o")
    (_, total), (_, sampling) = bar_lengths(ax)
    assert (total[0], sampling[0]) == pytest.approx((TOTAL, SAMPLING))


def test_figure_4a_theory_is_the_dmt_sum_over_its_gaps():
    """All gaps lie between 0.3 and 0.5 h_rms, so that the exponential law is nearly constant."""
    ranges = np.geomspace(0.3, 0.5, 30)
    coords = {"variant": VARIANTS, "pressure": [0.02, 0.1], "range": ranges}
    share = np.linspace(0, 1, 30)
    area = np.broadcast_to(np.outer([0.4, 0.8], share), (3, 2, 30))
    contact = ("variant", "pressure"), np.outer(FACTORS, [0.1, 0.2])
    lattice = dataset(coords, {"attractive_area": area, "area_fraction": contact})
    loop = dataset({}, {}, q0_h_rms=0.1, law="exponential", range_over_h_rms=0.2)
    pressure, contact_area = plot_fig4.load_by_theory(lattice, loop, 0.01)
    # Mean of exp(-u/range) over gaps spread evenly in the logarithm's steps of area.
    middle = np.sqrt(ranges[1:] * ranges[:-1])
    attraction = 0.01 / 0.1 * np.mean(np.exp(-middle / 0.2))
    np.testing.assert_allclose(pressure, [0.02 - 0.4 * attraction, 0.1 - 0.8 * attraction])
    np.testing.assert_allclose(contact_area, [0.1, 0.2])


LENGTHS = "adhesion_length_over_range"


def test_figure_5_has_the_criterion_its_error_and_what_is_printed(ax):
    x, lengths = np.array([1e-12, 1e-3]), np.array([1e-3, 1e-1])
    law = np.outer(x**-0.6, lengths**0.5)
    edges = xr.DataArray(
        np.multiply.outer([1.0, 2.0, 3.0], law),
        {"limit": ["low", "value", "high"], "range_times_q0": x, LENGTHS: lengths},
    )
    made = xr.Dataset({plot_fig5.EDGES: edges, "a_v": 3.6, "a_v_total_error": 0.6})
    plot_fig5.draw_plane(ax, made)
    h = ax.lines[0].get_xdata()
    # (range/l_a)(h/range)^(5/3) q0 range^... < 3 a_V/2: the lines of the criterion.
    drawn(ax, h, 1.5 * 3.6 * h ** (-5 / 3), color=plotting.BLACK, linestyle="-")
    drawn(ax, h, 4.5 * h ** (-5 / 3), color=plotting.BLUE, linestyle="--")
    drawn(ax, h, 2.25 * h ** (-5 / 3), color=plotting.RED, linestyle="--")
    drawn(ax, h, 4 / 75 / h, linestyle="-.")
    _, low, high = band_ends(ax, 1)
    np.testing.assert_allclose([low, high], np.outer([4.5, 6.3], h ** (-5 / 3)))
    drawn(ax, 2 * x**-0.6 * 0.05**0.5, x / 0.05, color=plotting.GREEN)
    drawn(ax, [1e3, 6.7e4, 1e6], np.array([1e-6, 1e-9, 1e-12]) / 0.05, marker="o")
    recomputed = (2.25 * 0.05 / np.array([1e-6, 1e-9, 1e-12])) ** 0.6
    drawn(ax, recomputed, np.array([1e-6, 1e-9, 1e-12]) / 0.05, marker="+")


WAVE_NUMBERS = np.geomspace(1e3, 1e6, 4)


def spectrum(**more):
    levels = {"psd": np.outer([1e-5, 1e-3], WAVE_NUMBERS**-3.6)}
    coords = {"end": ["smooth", "rough"], "wave_number": WAVE_NUMBERS}
    return dataset(coords, levels | more)


def test_figure_6_draws_no_more_than_was_measured(ax):
    q = WAVE_NUMBERS
    more = {"psd_fit": 2e-5 * q**-3.6, "psd_standard_error": 2e-6 * q**-3.6}
    more |= {"fitted": np.array([0, 1, 1, 0], dtype="i1"), "q1": 1e6, "q_cutoff": 1e5}
    plot_fig6.draw_surface(ax, spectrum(**more), plotting.BLUE, "wafer")
    drawn(ax, q[:3], 1e-5 * q[:3] ** -3.6, marker="o")
    drawn(ax, q, [np.nan, *(2e-5 * q[1:3] ** -3.6), np.nan], color=plotting.BLACK)
    ((_, halves),) = bar_lengths(ax)
    expected = 1.645 * 2e-6 * q[:3] ** -3.6  # 90 %, not one standard error
    np.testing.assert_allclose(halves, expected, rtol=1e-3)


@pytest.fixture
def compared():
    """Theory of two surfaces: the first has a window too small for its smallest load."""
    coords = {"variant": ["afferrante2018"], "pressure": [0.01, 0.065, 0.5]}
    variables = {"area_fraction_difference*": [[0.2, -0.1, 3.0]], "window_holds": [0, 1, 1]}
    return [
        dataset(coords, variables, **model_surface(magnification=64, window=window))
        for window in (1, 4)
    ]


def test_figure_8_has_a_row_for_every_case_and_a_point_for_every_load(ax, compared):
    plot_fig8.draw_ratios(ax, "area_fraction", compared)
    for row in (0, 1):
        # Open where the window is too small; an arrow at the edge where a ratio is outside.
        drawn(ax, [1.2], [row - 0.25], markerfacecolor="white", marker="o")
        drawn(ax, [0.9], [row], markerfacecolor=plotting.BLACK, marker="s")
        drawn(ax, [plot_fig8.SHOWN[1]], [row + 0.25], marker=">")
    halves = [half for _, found in bar_lengths(ax, axis=0) for half in found]
    np.testing.assert_allclose(halves, [0.2 * TOTAL, 0.1 * TOTAL, 3 * TOTAL] * 2)


def test_figure_8d_averages_where_windows_hold(compared):
    root = plot_fig8.root_mean_square("area_fraction", "afferrante2018", compared)
    assert root == pytest.approx(100 * np.sqrt((0.1**2 + 3**2) / 2))


CRITERIA_DRAWN = ["remaining_adhesion", "violano", "pastewka_robbins", "fuller_tabor", "dahlquist"]


def test_figure_9c_has_geometric_means_and_the_range_over_materials_and_ends(ax):
    factors = np.array([1.0, 10.0, 0.01, 100.0, 7.0])  # over the verdict's, by criterion
    spread = np.array([[0.5, 2.0], [0.25, 4.0]])[:, None, :, None] ** (np.arange(5) > 0)
    base = np.array([1e3, 1e6])[None, :, None, None]
    moduli = factors * spread * base * np.ones((2, 2, 2, 5))
    dims = ("material", "surface", "end", "criterion")
    coords = {"surface": ["a_line", "wafer"], "criterion": CRITERIA_DRAWN}
    data = xr.Dataset({"threshold_by_criterion": (dims, moduli)}, coords)
    plot_fig9.draw_surfaces(ax, data, {"a_line": "a line of it", "wafer": "ultranano wafer"})
    for index, factor in enumerate(factors[1:4]):
        drawn(ax, np.arange(2) + 0.09 * (index - 1), [factor] * 2)
    bars = [c for c in ax.collections if isinstance(c, LineCollection)]
    assert len(bars) == 3  # Dahlquist's modulus does not depend on the surface
    ends = np.array(bars[0].get_segments())[:, :, 1]
    np.testing.assert_allclose(ends, [[2.5, 40.0]] * 2)
    assert [text.get_text() for text in ax.get_xticklabels()] == [
        "a line of it",
        "ultranano\nwafer",
    ]


@pytest.fixture
def edges():
    coords = {"pressure": [0.065], "adhesion_length_over_range": [0.01, 0.1]}
    coords |= {"range_over_h_rms": [0.1, 1.0]}
    variables = {"attractive_over_contact": [[[0.2, 1.0], [2.0, 3.0]]]}
    variables |= {"edge_strength": [[[0.01, 0.02], [1.0, 0.03]]]}
    variables |= {"effect": [[[3.0, 2.0], [1.5, 1.2]]]}
    variables |= {"over_model*": [[[1.1, 0.9], [0.8, 4.0]]]}  # the last with too large an error
    return dataset(coords, variables, magnification=32, q0_h_rms=0.314159)


def test_figure_10b_shades_the_error_of_verdicts(ax, edges):
    plot_fig10.draw_ratios(ax, select_certain([edges]))
    drawn(ax, [0.01, 0.02, 1.0], [1.1, 0.9, 0.8], marker="o")
    (_, halves), (_, of_mean) = bar_lengths(ax)
    np.testing.assert_allclose(halves, TOTAL * np.array([1.1, 0.9, 0.8]))
    # Two points lie between 0.01 and 0.05, and a single one has no error of its mean.
    np.testing.assert_allclose(of_mean, [0.1])
    drawn(ax, [0.01, 0.05], [1.0, 1.0], color=plotting.BLACK)
    for index, factor in enumerate((equivalent_sphere.ERROR_WEAK, equivalent_sphere.ERROR_STRONG)):
        _, low, high = band_ends(ax, index)
        np.testing.assert_allclose([low, high], [[1 / factor] * 2, [factor] * 2])


def test_figure_14_draws_theory_beside_simulation(ax):
    loads = [0.01, 0.1]
    case = {"hurst": 0.8, "magnification": 32.0, "window": 4}
    ensemble = dataset({"pressure": loads}, {"mean_gap_mean*": [2.0, 1.0]}, **case)
    values = np.multiply.outer(FACTORS, [2.5, 1.25])
    lattice = dataset({"variant": VARIANTS, "pressure": loads}, {"mean_gap": values})
    plot_fig14.draw_means(ax, "mean_gap", [ensemble], [lattice])
    drawn(ax, loads, [2.0, 1.0], marker="o", color=plotting.BLUE)
    drawn(ax, loads, [2.5, 1.25], marker="None", color=plotting.BLUE)
    assert_bars(ax, [2.0, 1.0])
    _, low, high = band_ends(ax)
    np.testing.assert_allclose([low, high], [[2.5, 1.25], [3.0, 1.5]])


def test_lines_of_the_trade_are_errors_against_costs(ax):
    errors = {"value": ["4", "8", "2"], "error": [0.1, 0.01, 0.3], "cost": [2.0, 4.0, 1.0]}
    found = pd.DataFrame(errors).assign(quantity="area", x=errors["cost"])
    styles = {"area": {"color": "black", "marker": "o"}}
    plot_tradeoff.draw_setting(ax, found, styles, "points per wavelength")
    np.testing.assert_allclose(ax.lines[1].get_xydata(), [[1, 0.3], [2, 0.1], [4, 0.01]])
    assert {text.get_text() for text in ax.texts} == {"2", "4", "8"}


def test_lines_of_verdicts_are_widths_and_pairs_against_time(ax):
    row = {"way": "states", "share": 0.01, "outside": 0.1, "undecided": 0.2, "wrong": 0.1}
    rows = [row | {"points": n, "seconds": n / 10, "width": 1 / n} for n in (10, 40, 80)]
    verdicts = pd.DataFrame(rows).assign(pairs=[30, 30, 6])
    plot_tradeoff.draw_widths(ax, verdicts)
    np.testing.assert_allclose(ax.lines[0].get_xydata(), [[1, 0.1], [4, 0.025]])
    np.testing.assert_allclose(ax.lines[1].get_xydata(), [[8, 0.0125]])
    np.testing.assert_allclose(ax.lines[2].get_xydata(), [[1, 0.01], [4, 0.01]])
    assert {text.get_text() for text in ax.texts} == {"10", "40", "80*"}
    ax.clear()
    plot_tradeoff.draw_pairs(ax, verdicts)
    np.testing.assert_allclose(ax.lines[0].get_ydata(), [70, 70])
    np.testing.assert_allclose(ax.lines[2].get_ydata(), [90, 90])


def test_map_of_validity_shows_the_worst_of_the_variants(ax):
    axes = {"hurst": [0.2, 0.8], "grid": [4.0], "variant": ["one", "other"]}
    outcome = xr.DataArray([[[0, 3]], [[0, 1]]], coords=axes)
    for name in ("hurst", "grid"):
        outcome[name].attrs["long_name"] = name
    plot_stability.draw_map(ax, outcome)
    np.testing.assert_array_equal(ax.images[0].get_array(), [[3], [1]])
    assert [label.get_text() for label in ax.get_yticklabels()] == ["0.2", "0.8"]


def test_figure_13_follows_the_surfaces_that_go_furthest(ax):
    """Means of seeds 1 and 2, which have both magnifications, over that of seed 3."""
    rows = [(1, 4, 0.05), (2, 4, 0.07), (3, 4, 0.5), (1, 8, 0.03), (2, 8, 0.05)]
    table = pd.DataFrame(rows, columns=["seed", "magnification", "bound"])
    table = table.assign(set="a_rest", hurst=0.8, window=2, energy_ratio=0.5)
    plot_fig13.draw_ladder(ax, table, 0.5)
    drawn(ax, [4, 8], [0.06, 0.04], marker="o", color=plotting.BLUE)
    # The theory at H = 0.8 is the same spectrum's, at a zone of a quarter of the finest waves.
    value, low, high = plot_fig13.predict(0.8, np.array([8.0]), 0.5)
    spectrum = SelfAffine(hurst=0.8, q0=1.0, q1=8.0, h_rms=1.0)
    length = 0.5 * spectrum.elastic_energy()
    expected = predict(spectrum, length, range=np.sqrt(0.25 / 8 * length))
    assert value[0] == pytest.approx(expected.separation)
    assert low[0] < value[0] < high[0]
