"""Figure 4: area against external load with adhesion, and the adhesive part of the slope."""

import numpy as np

from _criteria import measured_a_v
from _job import start
from _numbers import number
from _style import (
    BLACK,
    GREY,
    MARKERS,
    canvas,
    key,
    letters,
    points,
    save,
    shades,
    total_error,
)
from stickiness import criteria, datasets

PAPER_A_V = 2.8
LENGTHS = [0.005, 0.05, 0.1, 0.2, 0.4]  # l_a/range, of panel A where the data hold them
THRESHOLD = 0.5  # of 1/kappa_ad, beyond which the contact is sticky
LENGTH_LABEL = r"adhesion length $l_a/\epsilon$"


def main(job):
    curve = datasets.read(job.input.curve, ["attraction", "area_fraction"])
    names = ["inverse_kappa_ad", "q0_h_rms", "dmt_valid"]
    sets = [
        datasets.read(path, names).sel(pressure=job.params.pressure, method="nearest")
        for path in (job.input.rough, job.input.smooth)
    ]
    a_v = measured_a_v(job.input, job.params.pressure)
    figure, panels = canvas("AB;CB", 5.2, width_ratios=[1, 1.15])
    panel_a(panels["A"], curve)
    panel_b(panels["B"], sets, a_v.value)
    panel_c(panels["C"], sets, a_v)
    letters(panels)
    save(figure, job.output)


def panel_a(ax, curve):
    """Repulsive area against the external pressure."""
    curve = curve.isel(range_over_h_rms=0)
    held = curve.adhesion_length_over_range.values
    lengths = [length for length in LENGTHS if np.isclose(held, length).any()]
    for index, (length, colour) in enumerate(zip(lengths, shades(len(lengths)), strict=True)):
        state = curve.sel(adhesion_length_over_range=length, method="nearest")
        external = state.pressure - state.attraction
        error = total_error(state.attraction_standard_error, state.attraction_discretisation_error)
        look = {"color": colour, "marker": MARKERS[index], "markersize": 3.5, "linewidth": 0.9}
        ax.errorbar(external, state.area_fraction, xerr=error, elinewidth=0.7, **look)
        ax.plot([], [], **look, label=f"{length:g}")
    ax.axvline(0, color=GREY, linewidth=0.7)
    made = datasets.parameters(curve)
    ax.set(xlabel=r"external pressure $p_\mathrm{ext}/(E^*q_0h_\mathrm{rms})$")
    ax.set(ylabel=r"area $A_\mathrm{rep}/A_\mathrm{nom}$")
    ax.set_title(
        rf"$\zeta$ = {number(made['magnification'])}, "
        rf"$\epsilon/h_\mathrm{{rms}}$ = {number(float(curve.range_over_h_rms))}"
    )
    text = "DMT: loading = unloading,\nno hysteresis"
    ax.text(0.97, 0.05, text, ha="right", transform=ax.transAxes)
    ax.legend(title=r"$l_a/\epsilon$", title_fontsize=8, loc="upper left")


def panel_b(ax, sets, a_v):
    """1/kappa_ad by simulation and by formula; open symbols where DMT gaps do not hold."""
    for marker, data in zip(MARKERS, sets, strict=False):
        ranges = data.range_over_h_rms.values
        for colour, reach in zip(shades(len(ranges)), ranges, strict=True):
            at_range = data.sel(range_over_h_rms=reach)
            lengths = at_range.adhesion_length_over_range
            for value, line in ((PAPER_A_V, "-"), (a_v, ":")):
                formula = by_formula(data, lengths.values, reach, value)
                ax.plot(lengths, formula, line, color=colour, linewidth=0.9)
            measured(ax, at_range, lengths, 1.0, colour, marker)
    shaded(ax)
    ax.set(xscale="log", yscale="log", xlabel=LENGTH_LABEL, ylabel=r"$1/\kappa_\mathrm{ad}$")
    ax.set_title(rf"DMT limit, $\hat{{p}}$ = {float(sets[0].pressure):g}")
    families = ax.legend(
        handles=range_keys(sets[0].range_over_h_rms.values),
        title=r"$\epsilon/h_\mathrm{rms}$",
        title_fontsize=8,
        loc="upper left",
        bbox_to_anchor=(0, 0.95),
        ncols=2,
        alignment="left",
    )
    ax.add_artist(families)
    ax.legend(handles=[*set_keys(sets), *line_keys(a_v)], loc="lower right")


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
    look = {"color": colour, "marker": marker}
    points(ax, x, value, *errors, **look)
    ax.plot(x, value.where(data.dmt_valid == 0), linestyle="none", **look, mfc="white", zorder=5)


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


def line_keys(a_v):
    return [
        key(color=BLACK, marker="o", mfc="white", linestyle="none", label="DMT not valid"),
        key(label=rf"formula, $a_V$ = {PAPER_A_V:g}"),
        key(linestyle=":", label=rf"formula, $a_V$ = {a_v:.2g}, carried to broad spectra"),
    ]


def panel_c(ax, sets, a_v):
    """Simulation over formula against the range: the adhesion length drops out."""
    for index, (marker, data) in enumerate(zip(MARKERS, sets, strict=False)):
        data = data.isel(adhesion_length_over_range=0)
        reach = data.range_over_h_rms
        scale = by_formula(data, float(data.adhesion_length_over_range), reach.values, PAPER_A_V)
        for colour, place in zip(shades(reach.size), range(reach.size), strict=True):
            one = data.isel(range_over_h_rms=[place])
            x = one.range_over_h_rms * 1.08 ** (index - 0.5)
            measured(ax, one, x, scale[place], colour, marker)
    ax.axhline(1, color=GREY, linewidth=0.9)
    low, high = a_v.low / PAPER_A_V, a_v.high / PAPER_A_V
    band = ax.axhspan(low, high, color=GREY, alpha=0.15, linewidth=0)
    line = ax.axhline(a_v.value / PAPER_A_V, color=GREY, linestyle=":", linewidth=0.9)
    text = rf"$a_V$ = {a_v.value:.1f} ± {a_v.error:.1f}, carried to broad spectra"
    ax.legend([(band, line)], [text], loc="lower left")
    ax.set(xscale="log", xlabel=r"range $\epsilon/h_\mathrm{rms}$", ylim=(0, 2))
    ax.set(ylabel=rf"$1/\kappa_\mathrm{{ad}}$ over formula, $a_V$ = {PAPER_A_V:g}")


if __name__ == "__main__":
    main(start(globals(), "plot_fig4"))
