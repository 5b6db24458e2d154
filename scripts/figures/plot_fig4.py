"""Figure 4: area against external load with adhesion, and the adhesive part of the slope."""

import xarray as xr

from common import plotting
from common.job import start
from common.plotting import BLACK, COLOURS, GREY, MARKERS, RED, make_dot, make_key, state
from stickiness import criteria, datasets

PAPER_A_V = 2.8
SMALL = 3  # size of open markers


def main(job):
    loop = datasets.read(job.input.loop, ["mean_pressure", "repulsive_area_fraction"])
    place = {"pressure": job.params.pressure, "method": "nearest"}
    surfaces = [read_ranges(paths).sel(**place) for paths in (job.input.rough, [job.input.smooth])]
    # In the fit interval that is quoted.
    fits = (datasets.read(path, ["a_v_mean"]).isel(window=0) for path in job.input.a_v)
    a_v = [float(fit.a_v_mean.sel(**place)) for fit in fits]
    with plotting.open_figure(job.output, "AB;CB", 5.4, width_ratios=[1, 1.15]) as panels:
        draw_loops(panels["A"], loop.isel(resolution=-1))
        draw_lengths(panels["B"], surfaces, a_v)
        draw_ranges(panels["C"], surfaces, a_v)


def read_ranges(paths):
    """Averages of one surface, its ranges from one file or several."""
    parts = [datasets.read(path, ["inverse_kappa_ad", "q0_h_rms"]) for path in paths]
    data = xr.concat(parts, "range_over_h_rms", data_vars="minimal", join="exact")
    return data.sortby("range_over_h_rms")


def draw_loops(ax, loop):
    """Repulsive area on approach and separation, at given mean gap and under a press."""
    lengths = loop.adhesion_length_over_range.values
    for length, colour in zip(lengths, COLOURS, strict=False):
        curves = loop.sel(adhesion_length_over_range=length)
        gap = curves.sel(control="mean_gap")
        press = curves.sel(control="pressure")
        turn = int(press.separating.sum("state") and press.separating.argmax("state"))
        loading = slice(None, turn)
        unloading = slice(turn - 1, None)
        for leg, line, look in (
            (gap, "-", {"linewidth": 0.6}),
            (press.isel(state=loading), "-", {"label": f"{length:g}"}),
            (press.isel(state=unloading), "--", {}),
            (press.dropna("state").isel(state=-1), "o", {}),
        ):
            ax.plot(leg.mean_pressure, leg.repulsive_area_fraction, line, color=colour, **look)
    ax.axvline(0, color=GREY, linewidth=0.7)
    parameters = datasets.parameters(loop)
    ax.set_xlabel(r"mean pressure $p_\mathrm{ext}/(E^*q_0h_\mathrm{rms})$")
    ax.set_ylabel(plotting.CONTACT_AREA)
    ax.locator_params(axis="x", nbins=5)
    ax.set_title(
        state(magnification=parameters["magnification"], range=parameters["range_over_h_rms"])
    )
    kinds = [make_key("loading"), make_key("unloading", linestyle="--")]
    kinds += [make_key("at given gap", linewidth=0.6), make_dot("pull-off")]
    ax.add_artist(ax.legend(handles=kinds, loc="lower right"))
    ax.legend(title=r"$l_a/\epsilon$", loc="upper left")


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
            for value, line in ((PAPER_A_V, "-"), (measured, "--")):
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
    ax.text(0.03, 0.965, r"sticky: $1/\kappa_\mathrm{ad}$ > 1/2", transform=ax.transAxes, va="top")
    ax.set(xscale="log", yscale="log", ylim=(1e-7, 1e3))
    ax.set(xlabel=plotting.ADHESION_LENGTH, ylabel=r"$1/\kappa_\mathrm{ad}$")
    ax.set_title(state(pressure=float(surfaces[0].pressure)))
    ranges = plotting.shade(surfaces[0].range_over_h_rms.values)
    families = [make_key(f"{range_:g}", color=colour) for colour, range_ in ranges]
    place = {"loc": "upper left", "bbox_to_anchor": (0, 0.95), "ncols": 2, "alignment": "left"}
    ax.add_artist(ax.legend(handles=families, title=r"$\epsilon/h_\mathrm{rms}$", **place))
    small = {"markersize": SMALL, "color": BLACK}
    keys += [
        make_dot("by fitted slopes", **small),
        make_dot(r"$p_\mathrm{ad}/2p_\mathrm{rep}$", **small, mfc="white"),
        make_dot("DMT sum chosen", marker="x", color=RED),
        make_key(f"formula, {state(a_v=PAPER_A_V)}"),
        make_key("formula, $a_V$ measured", linestyle="--"),
    ]
    ax.legend(handles=keys, loc="lower right")


def by_formula(data, lengths, range_, a_v):
    """1/kappa_ad of the criterion, with h_rms as the unit of length."""
    return criteria.inverse_kappa_ad(1.0, float(data.q0_h_rms), lengths * range_, range_, a_v)


def draw_slopes(ax, x, data, name, scale=1.0, **look):
    """1/kappa_ad over `scale` where it is larger than its errors, with these."""
    _, total = plotting.read_errors(data, name)
    data = data[[name, f"{name}_error"]].where(total < data[name])
    plotting.draw_points(ax, x, data, name, scale, **look)


def draw_ranges(ax, surfaces, a_v):
    """Slopes, tractions and DMT sum over the formula, against the range."""
    for index, (data, measured) in enumerate(zip(surfaces, a_v, strict=True)):
        length = largest_weak_length(data)
        data = data.sel(adhesion_length_over_range=length)
        for colour, range_ in plotting.shade(data.range_over_h_rms.values):
            here = data.sel(range_over_h_rms=[range_])
            scale = by_formula(data, length, range_, PAPER_A_V)
            x = plotting.move_aside(range_, index - 0.5, 1.08)
            look = {"color": colour, "marker": MARKERS[index]}
            direct = here.inverse_kappa_ad_direct / scale
            plotting.draw_hollow(ax, x, direct, **look, markersize=SMALL)
            draw_slopes(ax, x, here, "inverse_kappa_ad", scale, **look)
        ax.axhline(measured / PAPER_A_V, color=GREY, linestyle="--", linewidth=0.8)
    ax.axhline(1, color=GREY, linewidth=0.9)
    ax.set(xscale="log", xlabel=plotting.RANGE)
    ax.set_ylim(bottom=0)
    ax.set_ylabel(rf"$1/\kappa_\mathrm{{ad}}$ over formula, {state(a_v=PAPER_A_V)}")


def largest_weak_length(data):
    """Largest adhesion length whose adhesion is still in proportion to it, at any range."""
    largest = data.inverse_kappa_ad.max("range_over_h_rms")
    proportional_up_to = 0.12  # 1/kappa_ad that is in proportion to l_a within the errors
    return float(data.adhesion_length_over_range.where(largest < proportional_up_to).max())


if __name__ == "__main__":
    main(start(globals()))
