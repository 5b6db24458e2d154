"""Panels of figures hold the numbers of the files of a complete run."""

import matplotlib.pyplot as plt
import numpy as np
import pytest

from common.conventions import VARIANT
from figures import (
    plot_fig1,
    plot_fig2,
    plot_fig3,
    plot_fig4,
    plot_fig6,
    plot_fig7,
    plot_fig8,
    plot_fig9,
    plot_fig10,
    plot_fig12,
    plot_fig14,
)
from stickiness import datasets
from stickiness.pages import plotting

pytestmark = pytest.mark.workflow


def draw_2b(ax, maps):
    plot_fig2.draw_areas(ax, maps, rms_slope=1.0)


def draw_3a(ax, sweep):
    plot_fig3.draw_magnifications(ax, sweep, [])


def draw_4a(ax, loop):
    plot_fig4.draw_loading(ax, loop.isel(resolution=-1), [])


def draw_6(ax, surface):
    plot_fig6.draw_surface(ax, surface, plotting.BLUE, "surface")


def draw_7a(ax, ratios):
    plot_fig7.draw_plane(ax, ratios.isel(pressure=0))


def draw_8g(ax, kappa, lattice):
    plot_fig8.draw_slopes(ax, [kappa], [lattice])


def draw_9a(ax, compared):
    limits = compared.remaining_against_roughness
    made = datasets.parameters(compared)
    plot_fig9.draw_thresholds(ax, compared.against_roughness, limits, made, "")


def draw_12(ax, compared):
    plot_fig12.draw_shares(ax, compared.sel(skewness=1.5))


def draw_14b(ax, ensemble, lattice):
    plot_fig14.draw_means(ax, "mean_gap", [ensemble], [lattice])


def find_loading(loop):
    pressed = loop.sel(control="pressure")
    return pressed.where(pressed.separating == 0)


def find_positive(density):
    """What an axis of logarithms shows: rounding leaves less than nothing beyond all gaps."""
    return density.where(density > 0)


def list_weak(ratios):
    """Attraction over the DMT sum at equal area, and at equal mean gap over its limit."""
    weak = ratios.isel(adhesion_length_over_range=0)
    return [weak.dmt_ratio, weak.dmt_ratio_at_gap, weak.dmt_ratio_at_gap / weak.weak_ratio]


CASE = "H0.8_zeta64.nc"
AT_LOADS = {"pressure": plot_fig10.LOADS, "method": "nearest"}
#: What draws a panel, its files, and the numbers that it shows.
PANELS = {
    "1A": (
        plot_fig1.draw_magnifications,
        ["persson/sweeps/fig1a.nc"],
        lambda theory: [theory.gap_density.sel(variant=VARIANT)],
    ),
    "2B": (
        draw_2b,
        ["adhesion/full/fig2/maps.nc"],
        lambda maps: [maps.pressure, maps.area_alone, maps.repulsive_area],
    ),
    "3A": (
        draw_3a,
        ["persson/sweeps/fig3a.nc"],
        lambda sweep: [sweep.attractive_area.sel(variant=VARIANT)],
    ),
    "4A": (
        draw_4a,
        ["adhesion/loops/fig4a.nc"],
        lambda loop: [find_loading(loop.isel(resolution=-1)).repulsive_area_fraction],
    ),
    "6": (draw_6, ["../real_surfaces/asphalt.nc"], lambda surface: [surface.psd]),
    "7A": (draw_7a, ["adhesion/full/dmt_error.nc"], lambda d: [d.dmt_ratio.isel(pressure=0)]),
    "7B": (plot_fig7.draw_weak, ["adhesion/full/dmt_error.nc"], list_weak),
    "8E": (plot_fig8.draw_gamma, ["fits/gamma.nc"], lambda fit: [fit.gamma, fit.gamma_low]),
    "8G": (
        draw_8g,
        [f"fits/kappa/{CASE}", f"persson/lattice/{CASE}"],
        lambda kappa, lattice: [kappa.kappa, lattice.kappa.sel(variant=VARIANT)],
    ),
    "9A": (
        draw_9a,
        ["criteria/compared.nc"],
        lambda d: [d.remaining_against_roughness, d.against_roughness],
    ),
    "10C": (
        plot_fig10.draw_simulation,
        [f"contact/ensembles/{CASE}", f"persson/lattice/{CASE}"],
        lambda ensemble, _: [find_positive(ensemble.gap_density_mean.sel(**AT_LOADS))],
    ),
    "12": (
        draw_12,
        ["remaining/heights.nc"],
        lambda d: [d[name].sel(skewness=1.5) for name in ("theory", "states", "simulated")],
    ),
    "14B": (
        draw_14b,
        [f"contact/ensembles/{CASE}", f"persson/lattice/{CASE}"],
        lambda ensemble, lattice: [
            ensemble.mean_gap_mean,
            lattice.mean_gap.sel(variant=VARIANT),
        ],
    ),
}


def list_numbers(ax):
    """All that is drawn: points of lines, corners of bands and bars, and values of meshes."""
    found = [line.get_xydata() for line in ax.lines]
    for collection in ax.collections:
        found += [path.vertices for path in collection.get_paths()]
        found += [] if collection.get_array() is None else [np.ma.filled(collection.get_array())]
    return np.sort(np.concatenate([np.ravel(each) for each in found]))


@pytest.mark.parametrize("panel", PANELS)
def test_a_panel_shows_the_numbers_of_its_files(finished, panel):
    draw, files, select = PANELS[panel]
    read = [datasets.read(finished / "results/tiny" / file) for file in files]
    figure, ax = plt.subplots()
    draw(ax, *read)
    drawn = list_numbers(ax)
    plt.close(figure)
    for values in select(*read):
        wanted = np.ravel(values)
        wanted = wanted[np.isfinite(wanted)]
        after = np.searchsorted(drawn, wanted).clip(1, drawn.size - 1)
        away = np.minimum(abs(drawn[after] - wanted), abs(drawn[after - 1] - wanted))
        missing = wanted[away > 1e-9 * abs(wanted)]
        assert wanted.size > 0
        assert missing.size == 0, (missing.size, wanted.size, missing[:5])
