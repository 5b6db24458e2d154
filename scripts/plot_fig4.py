"""Figure 4: area against external load with adhesion, and the adhesive part of the slope."""

from _job import start
from _numbers import number
from _style import (
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
)
from stickiness import criteria, datasets

PAPER_A_V = 2.8
THRESHOLD = 0.5  # of 1/kappa_ad, beyond which the contact is sticky
WEAK = 0.12  # 1/kappa_ad up to which it is in proportion to l_a within the errors
LENGTH_LABEL = r"adhesion length $l_a/\epsilon$"


def main(job):
    loop = datasets.read(job.input.loop, ["mean_pressure", "repulsive_area_fraction"])
    loop = loop.isel(resolution=-1)
    limits, full = (
        [at_load(path, job.params.pressure) for path in paths]
        for paths in (
            (job.input.rough, job.input.smooth),
            (job.input.rough_full, job.input.smooth_full),
        )
    )
    figure, panels = canvas("AB;CB", 5.2, width_ratios=[1, 1.15])
    panel_a(panels["A"], loop)
    panel_b(panels["B"], limits, full)
    panel_c(panels["C"], limits, full)
    letters(panels)
    save(figure, job.output)


def at_load(path, pressure):
    data = datasets.read(path, ["inverse_kappa_ad", "q0_h_rms"])
    return data.sel(pressure=pressure, method="nearest")


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


def panel_b(ax, limits, full):
    """1/kappa_ad by full simulation, in the DMT limit (thin) and by formula."""
    for marker, limit, data in zip(MARKERS, limits, full, strict=False):
        ranges = data.range_over_h_rms.values
        for colour, reach in zip(shades(len(ranges)), ranges, strict=True):
            here, dmt = (one.sel(range_over_h_rms=reach) for one in (data, limit))
            lengths = dmt.adhesion_length_over_range
            formula = by_formula(limit, lengths.values, reach, PAPER_A_V)
            ax.plot(lengths, formula, "-", color=colour, linewidth=0.9)
            ax.plot(lengths, dmt.inverse_kappa_ad, ":", color=colour, linewidth=0.9)
            measured(ax, here, here.adhesion_length_over_range, 1.0, colour, marker)
    shaded(ax)
    ax.set(xscale="log", yscale="log", xlabel=LENGTH_LABEL, ylabel=r"$1/\kappa_\mathrm{ad}$")
    ax.set_title(rf"full simulation, $\hat{{p}}$ = {float(full[0].pressure):g}")
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
    ax.legend(handles=[*set_keys(limits), *line_keys()], loc="lower right")


def by_formula(data, lengths, reach, a_v):
    """1/kappa_ad of the criterion, with h_rms as the unit of length."""
    return criteria.inverse_kappa_ad(1.0, float(data.q0_h_rms), lengths * reach, reach, a_v)


def measured(ax, data, x, scale, colour, marker):
    """1/kappa_ad over `scale` with its errors."""
    value = data.inverse_kappa_ad / scale
    errors = (
        data.inverse_kappa_ad_standard_error / scale,
        data.inverse_kappa_ad_discretisation_error / scale,
    )
    points(ax, x, value, *errors, color=colour, marker=marker)


def shaded(ax):
    low, high = 1e-5, 1e4
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


def line_keys():
    return [
        key(linestyle=":", label="DMT limit"),
        key(label=rf"formula, $a_V$ = {PAPER_A_V:g}"),
    ]


def panel_c(ax, limits, full):
    """Full simulation and DMT limit over the formula, against the range."""
    for index, (marker, limit, data) in enumerate(zip(MARKERS, limits, full, strict=False)):
        length = weak(data)
        data = data.sel(adhesion_length_over_range=length)
        reach = data.range_over_h_rms
        scale = by_formula(limit, length, reach.values, PAPER_A_V)
        ax.plot(reach, data.inverse_kappa_ad_dmt / scale, ":", color=GREY, linewidth=0.9)
        for colour, place in zip(shades(reach.size), range(reach.size), strict=True):
            one = data.isel(range_over_h_rms=[place])
            x = one.range_over_h_rms * 1.08 ** (index - 0.5)
            measured(ax, one, x, scale[place], colour, marker)
    ax.axhline(1, color=GREY, linewidth=0.9)
    ax.text(0.97, 0.95, "dotted: DMT limit", ha="right", va="top", transform=ax.transAxes)
    ax.set(xscale="log", xlabel=r"range $\epsilon/h_\mathrm{rms}$")
    ax.set_ylim(bottom=0)
    ax.set(ylabel=rf"$1/\kappa_\mathrm{{ad}}$ over formula, $a_V$ = {PAPER_A_V:g}")


def weak(data):
    """Largest adhesion length whose adhesion is still in proportion to it, at any range."""
    largest = data.inverse_kappa_ad.max("range_over_h_rms")
    return float(data.adhesion_length_over_range.where(largest < WEAK).max())


if __name__ == "__main__":
    main(start(globals(), "plot_fig4"))
