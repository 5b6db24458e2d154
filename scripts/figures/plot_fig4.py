"""Figure 4: area against external load with adhesion, and the adhesive part of the slope."""

from pipeline.job import start
from pipeline.numbers import number
from pipeline.pages.style import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    MARKERS,
    ORANGE,
    RED,
    canvas,
    key,
    letters,
    points,
    save,
    shades,
    total_error,
    with_model,
)
from stickiness import criteria
from stickiness.core import datasets

PAPER_A_V = 2.8
THRESHOLD = 0.5  # of 1/kappa_ad, beyond which the contact is sticky
WEAK = 0.12  # 1/kappa_ad up to which it is in proportion to l_a within the errors
LENGTH_LABEL = r"adhesion length $l_a/\epsilon$"


def main(job):
    loop = datasets.read(job.input.loop, ["mean_pressure", "repulsive_area_fraction"])
    loop = loop.isel(resolution=-1)
    full = [at_load(path, job.params.pressure) for path in (job.input.rough, job.input.smooth)]
    a_v = [measured_a_v(path, job.params.pressure) for path in job.input.a_v]
    figure, panels = canvas("AB;CB", 5.4, width_ratios=[1, 1.15])
    panel_a(panels["A"], loop)
    panel_b(panels["B"], full, a_v)
    panel_c(panels["C"], full, a_v)
    letters(panels)
    save(figure, job.output)


def at_load(path, pressure):
    data = datasets.read(path, ["inverse_kappa_ad", "q0_h_rms"])
    return data.sel(pressure=pressure, method="nearest")


def measured_a_v(path, pressure):
    """a_V of the surfaces of one set, in the window that is quoted."""
    fit = datasets.read(path, ["a_v_mean"]).sel(pressure=pressure, method="nearest")
    return float(fit.a_v_mean.isel(window=0))


def panel_a(ax, loop):
    """Repulsive area on approach and separation, at given mean gap and under a press."""
    lengths = loop.adhesion_length_over_range.values
    for length, colour in zip(lengths, (BLUE, RED, GREEN, ORANGE), strict=False):
        curves = loop.sel(adhesion_length_over_range=length)
        gap, press = curves.sel(control="mean_gap"), curves.sel(control="pressure")
        ax.plot(gap.mean_pressure, gap.repulsive_area_fraction, color=colour, linewidth=0.6)
        turn = int(press.separating.sum("state") and press.separating.argmax("state"))
        for leg, line in (
            (press.isel(state=slice(None, turn)), "-"),
            (press.isel(state=slice(turn - 1, None)), "--"),
        ):
            ax.plot(leg.mean_pressure, leg.repulsive_area_fraction, line, color=colour)
        last = press.dropna("state").isel(state=-1)
        ax.plot(last.mean_pressure, last.repulsive_area_fraction, "o", color=colour, markersize=4)
        ax.plot([], [], color=colour, label=f"{length:g}")
    ax.axvline(0, color=GREY, linewidth=0.7)
    made = datasets.parameters(loop)
    ax.set(xlabel=r"mean pressure $p_\mathrm{ext}/(E^*q_0h_\mathrm{rms})$")
    ax.set(ylabel=r"area $A_\mathrm{rep}/A_\mathrm{nom}$")
    ax.set_title(
        rf"$\zeta$ = {number(made['magnification'])}, "
        rf"$\epsilon/h_\mathrm{{rms}}$ = {number(made['range_over_h_rms'])}"
    )
    handles = [
        key(label="loading"),
        key(linestyle="--", label="unloading"),
        key(linewidth=0.6, label="at given gap"),
        key(marker="o", linestyle="none", label="pull-off"),
    ]
    kinds = ax.legend(handles=handles, loc="lower right")
    ax.add_artist(kinds)
    ax.legend(title=r"$l_a/\epsilon$", title_fontsize=8, loc="upper left")


def panel_b(ax, full, a_v):
    """1/kappa_ad by slopes and directly, beside the formula with either a_V."""
    for marker, data, measured in zip(MARKERS, full, a_v, strict=False):
        ranges = data.range_over_h_rms.values
        lengths = data.adhesion_length_over_range.values
        for colour, reach in zip(shades(len(ranges)), ranges, strict=True):
            here = data.sel(range_over_h_rms=reach)
            for value, line in ((PAPER_A_V, "-"), (measured, "--")):
                formula = by_formula(data, lengths, reach, value)
                ax.plot(lengths, formula, line, color=colour, linewidth=0.8)
            hollow = {"color": colour, "marker": marker, "mfc": "white", "markersize": 3}
            direct = here.inverse_kappa_ad_direct
            ax.plot(lengths, direct, linestyle="none", **hollow, zorder=3)
            by_slopes(ax, here, "inverse_kappa_ad_fit", lengths, 1.0, colour, marker)
            chosen = here.inverse_kappa_ad.where(here.model == "dmt")
            ax.plot(lengths, chosen, "x", color=RED, markersize=3.5, zorder=6)
    shaded(ax)
    ax.set(xscale="log", yscale="log", xlabel=LENGTH_LABEL, ylabel=r"$1/\kappa_\mathrm{ad}$")
    ax.set_title(rf"$\hat{{p}}$ = {float(full[0].pressure):g}")
    families = ax.legend(
        handles=range_keys(full[0].range_over_h_rms.values),
        title=r"$\epsilon/h_\mathrm{rms}$",
        title_fontsize=8,
        loc="upper left",
        bbox_to_anchor=(0, 0.95),
        ncols=2,
        alignment="left",
    )
    ax.add_artist(families)
    ax.legend(handles=[*set_keys(full), *kind_keys()], loc="lower right")


def by_formula(data, lengths, reach, a_v):
    """1/kappa_ad of the criterion, with h_rms as the unit of length."""
    return criteria.inverse_kappa_ad(1.0, float(data.q0_h_rms), lengths * reach, reach, a_v)


def by_slopes(ax, data, name, x, scale, colour, marker):
    """1/kappa_ad over `scale` where it is larger than its errors, with these."""
    errors = with_model(data, name)
    value = data[name].where(total_error(*errors) < data[name]) / scale
    points(ax, x, value, *(one / scale for one in errors), color=colour, marker=marker)


def shaded(ax):
    low, high = 1e-7, 1e3
    ax.set_ylim(low, high)
    ax.axhspan(THRESHOLD, high, color=GREY, alpha=0.15, linewidth=0)
    ax.text(0.03, 0.965, r"sticky: $1/\kappa_\mathrm{ad}$ > 1/2", transform=ax.transAxes, va="top")


def range_keys(ranges):
    colours = shades(len(ranges))
    return [
        key(color=colour, label=f"{reach:g}") for colour, reach in zip(colours, ranges, strict=True)
    ]


def set_keys(sets):
    return [
        key(
            color=BLACK,
            marker=marker,
            linestyle="none",
            label=rf"$\zeta$ = {number(datasets.parameters(data)['magnification'])}, "
            rf"$h_\mathrm{{rms}}$ = {datasets.parameters(data)['h_rms'].replace('um', 'µm')}",
        )
        for marker, data in zip(MARKERS, sets, strict=False)
    ]


def kind_keys():
    hollow = {"marker": "o", "linestyle": "none", "markersize": 3, "color": BLACK}
    return [
        key(**hollow, label="by fitted slopes"),
        key(**hollow, mfc="white", label=r"$p_\mathrm{ad}/2p_\mathrm{rep}$"),
        key(marker="x", linestyle="none", color=RED, label="DMT limit chosen"),
        key(label=rf"formula, $a_V$ = {PAPER_A_V:g}"),
        key(linestyle="--", label=r"formula, $a_V$ measured"),
    ]


def panel_c(ax, full, a_v):
    """Slopes, tractions and DMT limit over the formula, against the range."""
    for index, (marker, data, measured) in enumerate(zip(MARKERS, full, a_v, strict=False)):
        length = weak(data)
        data = data.sel(adhesion_length_over_range=length)
        reach = data.range_over_h_rms
        scale = by_formula(data, length, reach.values, PAPER_A_V)
        for colour, place in zip(shades(reach.size), range(reach.size), strict=True):
            one = data.isel(range_over_h_rms=[place])
            x = one.range_over_h_rms * 1.08 ** (index - 0.5)
            hollow = {"color": colour, "marker": marker, "mfc": "white", "markersize": 3}
            direct = one.inverse_kappa_ad_direct / scale[place]
            ax.plot(x, direct, linestyle="none", **hollow)
            by_slopes(ax, one, "inverse_kappa_ad", x, scale[place], colour, marker)
        ax.axhline(measured / PAPER_A_V, color=GREY, linestyle="--", linewidth=0.8)
    ax.axhline(1, color=GREY, linewidth=0.9)
    ax.set(xscale="log", xlabel=r"range $\epsilon/h_\mathrm{rms}$")
    ax.set_ylim(bottom=0)
    ax.set(ylabel=rf"$1/\kappa_\mathrm{{ad}}$ over formula, $a_V$ = {PAPER_A_V:g}")


def weak(data):
    """Largest adhesion length whose adhesion is still in proportion to it, at any range."""
    largest = data.inverse_kappa_ad.max("range_over_h_rms")
    return float(data.adhesion_length_over_range.where(largest < WEAK).max())


if __name__ == "__main__":
    main(start(globals(), "plot_fig4"))
