"""Figure 4: area against external load with adhesion, and the adhesive part of the slope."""

import numpy as np
import xarray as xr
from matplotlib.legend_handler import HandlerTuple

from common.adhesion_sets import scaled_law
from common.conventions import VARIANT
from common.job import start
from common.paper import A_V_FIG4B
from stickiness import criteria, datasets, dmt
from stickiness.pages import plotting
from stickiness.pages.plotting import BLACK, COLOURS, GREY, MARKERS, RED, make_dot, make_key, state

SMALL = 3  # size of open markers


def main(job):
    loop = datasets.read(job.input.loop, ["mean_pressure", "repulsive_area_fraction"])
    place = {"pressure": job.params.pressure, "method": "nearest"}
    surfaces = [read_ranges(paths).sel(**place) for paths in (job.input.rough, [job.input.smooth])]
    # In the fit interval that is quoted.
    fits = (datasets.read(path, ["a_v_mean"]).isel(window=0) for path in job.input.a_v)
    a_v = [float(fit.a_v_mean.sel(**place)) for fit in fits]
    lattices = [
        datasets.read(path, ["attractive_area", "area_fraction"]) for path in job.input.theory
    ]
    with plotting.open_figure(job.output, "AB", 4.9, width_ratios=[1, 1.1]) as panels:
        finest = loop.isel(resolution=-1)
        draw_loading(panels["A"], finest, lattices)
        draw_cycle(panels["A"].inset_axes([0.56, 0.6, 0.42, 0.38]), finest)
        draw_lengths(panels["B"], surfaces, a_v)


def read_ranges(paths):
    """Averages of one surface, its ranges from one file or several."""
    parts = [datasets.read(path, ["inverse_kappa_ad", "q0_h_rms"]) for path in paths]
    data = xr.concat(parts, "range_over_h_rms", data_vars="minimal", join="exact")
    return data.sortby("range_over_h_rms")


def draw_loading(ax, loop, lattices):
    """Repulsive area on loading by simulation, and by Persson's theory with the DMT sum."""
    lengths = loop.adhesion_length_over_range.values
    press = loop.sel(control="pressure")
    for length, colour in zip(lengths, COLOURS, strict=False):
        curve = press.sel(adhesion_length_over_range=length).dropna("state")
        curve = curve.isel(state=slice(None, turning_point(curve)))
        ax.plot(
            curve.mean_pressure, curve.repulsive_area_fraction, color=colour, label=f"{length:g}"
        )
        for lattice in lattices:
            pressure, area = load_by_theory(lattice, loop, length)
            ax.plot(pressure, area, "x", color=colour, markersize=5, mew=1.4)
    parameters = datasets.parameters(loop)
    largest = parameters["pressure"]
    ax.axvline(0, color=GREY, linewidth=0.7)
    ax.set_xlim(-0.55 * largest, 1.05 * largest)
    ax.set_ylim(0, 1.75 * float(loop.repulsive_area_fraction.max()))  # room for the inset
    ax.set_xlabel(r"mean pressure $p_\mathrm{ext}/(E^*q_0h_\mathrm{rms})$")
    ax.set_ylabel(plotting.CONTACT_AREA)
    values = {"magnification": parameters["magnification"], "range": parameters["range_over_h_rms"]}
    ax.set_title(state(**values, q0_h_rms=parameters["q0_h_rms"]))
    kinds = [make_key("BEM"), make_dot("theory", marker="x", markersize=5)]
    ax.add_artist(ax.legend(handles=kinds, loc="upper left", bbox_to_anchor=(0, 0.82)))
    look = {"title": plotting.SYMBOLS["adhesion_length"], "alignment": "left"}
    ax.legend(loc="upper left", **look)


def turning_point(curve):
    """Number of the states of a curve on the way to the largest load."""
    separating = curve.separating.values
    return int(np.argmax(separating)) if separating.any() else separating.size


def load_by_theory(lattice, loop, length):
    """External pressure and area by Persson's theory, attraction by the DMT sum over its gaps."""
    parameters = datasets.parameters(loop)
    law = scaled_law(parameters, parameters["law"], length, parameters["range_over_h_rms"])
    theory = lattice.sel(variant=VARIANT)
    areas = theory.attractive_area.transpose("pressure", "range").values
    attraction = dmt.sum_over_gaps(areas, theory["range"].values, law.traction)
    return theory.pressure.values - attraction, theory.area_fraction.values


def draw_cycle(ax, loop):
    """The loading cycle of the strongest adhesion near zero load, with jumps and pull-off."""
    curves = loop.isel(adhesion_length_over_range=-1)
    colour = COLOURS[loop.sizes["adhesion_length_over_range"] - 1]
    gap = curves.sel(control="mean_gap")
    press = curves.sel(control="pressure").dropna("state")
    turn = turning_point(press)
    loading = press.isel(state=slice(None, turn))
    unloading = press.isel(state=slice(turn - 1, None))
    for leg, line, look in (
        (gap, "-", {"linewidth": 0.6, "label": "given gap"}),
        (loading, "-", {"label": "loading"}),
        (unloading, "--", {"label": "unloading"}),
        (press.isel(state=[-1]), "o", {"label": "pull-off"}),
    ):
        ax.plot(leg.mean_pressure, leg.repulsive_area_fraction, line, color=colour, **look)
    errors = {
        "xerr": curves.pull_off_pressure_total_error,
        "yerr": curves.pull_off_area_total_error,
    }
    ax.errorbar(
        float(curves.pull_off_pressure), float(curves.pull_off_area), color=colour, **errors
    )
    ax.axvline(0, color=GREY, linewidth=0.7)
    tension = -float(press.mean_pressure.min())
    largest_area = float(
        unloading.repulsive_area_fraction.where(unloading.mean_pressure < tension).max()
    )
    ax.set(xlim=(-1.2 * tension, 2.4 * tension), ylim=(0, 1.1 * largest_area))
    ax.tick_params(labelsize=7)
    ax.legend(fontsize=7, loc="lower right", handlelength=1.4)


def draw_lengths(ax, surfaces, a_v):
    """1/kappa_ad by slopes and directly, beside the formula with either a_V."""
    keys = []
    for marker, data, measured in zip(MARKERS, surfaces, a_v, strict=False):
        parameters = datasets.parameters(data)
        height = parameters["h_rms"].replace("um", "µm")
        label = (
            rf"{state(magnification=parameters['magnification'])}, $h_\mathrm{{rms}}$ = {height}"
        )
        keys.append(make_dot(label, color=BLACK, marker=marker))
        lengths = data.adhesion_length_over_range.values
        for colour, range_ in plotting.shade(data.range_over_h_rms.values):
            here = data.sel(range_over_h_rms=range_)
            for value, line in ((A_V_FIG4B, "-"), (measured, "--")):
                formula = by_formula(data, lengths, range_, value)
                ax.plot(lengths, formula, line, color=colour, linewidth=0.8)
            look = {"color": colour, "marker": marker}
            direct = here.inverse_kappa_ad_direct
            plotting.draw_hollow(ax, lengths, direct, **look, markersize=SMALL)
            draw_slopes(ax, lengths, here, "inverse_kappa_ad_fit", **look)
            chosen = here.inverse_kappa_ad.where(here.model == "dmt")
            ax.plot(lengths, chosen, "x", color=RED, markersize=3.5, zorder=6)
    threshold = 0.5  # of 1/kappa_ad, beyond which the contact is sticky
    ax.axhspan(threshold, 1e3, color=GREY, alpha=0.15, linewidth=0)
    ax.text(0.03, 0.965, "sticky", transform=ax.transAxes, va="top")
    ax.set(xscale="log", yscale="log", ylim=(1e-7, 1e3))
    ax.set_xlabel(plotting.ADHESION_LENGTH)
    ax.set_ylabel(r"adhesive part of $1/\kappa$, $1/\kappa_\mathrm{ad}$ (sticky above 1/2)")
    ax.set_title(state(pressure=float(surfaces[0].pressure)))
    ranges = plotting.shade(surfaces[0].range_over_h_rms.values)
    families = [make_key(f"{range_:g}", color=colour) for colour, range_ in ranges]
    place = {"loc": "upper left", "bbox_to_anchor": (0, 0.95), "ncols": 2, "alignment": "left"}
    ax.add_artist(ax.legend(handles=families, title=r"$\epsilon/h_\mathrm{rms}$", **place))
    # Filled and open symbols of both surfaces.
    filled, hollow = (
        tuple(make_dot("", color=BLACK, marker=marker, **look) for marker in MARKERS[:2])
        for look in ({}, {"markersize": SMALL, "mfc": "white"})
    )
    labels = [key.get_label() for key in keys] + ["by fitted slopes"]
    labels.append(r"$p_\mathrm{ad}/2p_\mathrm{rep}$")
    lines = [
        make_dot("DMT sum chosen", marker="x", color=RED),
        make_key(f"formula, {state(a_v=A_V_FIG4B)}"),
        make_key("formula, $a_V$ measured", linestyle="--"),
    ]
    handles = [*keys, filled, hollow, *lines]
    labels += [line.get_label() for line in lines]
    ax.legend(handles, labels, loc="lower right", handler_map={tuple: HandlerTuple(None)})


def by_formula(data, lengths, range_, a_v):
    """1/kappa_ad of the criterion, with h_rms as the unit of length."""
    return criteria.inverse_kappa_ad(1.0, float(data.q0_h_rms), lengths * range_, range_, a_v)


def draw_slopes(ax, x, data, name, scale=1.0, **look):
    """1/kappa_ad over `scale` where it is larger than its errors, with these."""
    _, total = plotting.read_errors(data, name)
    data = data[[name, f"{name}_error"]].where(total < data[name])
    plotting.draw_points(ax, x, data, name, scale, **look)


if __name__ == "__main__":
    main(start(globals()))
