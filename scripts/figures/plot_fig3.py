"""Figure 3: attractive area against range, and the prefactor a_V of its power law."""

from typing import NamedTuple

import numpy as np

from common.conventions import VARIANT
from common.job import start
from common.paper import A_V, LOAD
from figures.theory_curves import draw_theory, name_case, name_cell
from stickiness import criteria, datasets
from stickiness.formatting import number
from stickiness.pages import plotting
from stickiness.pages.plotting import BLACK, GREY, MARKERS, make_dot, make_key, pick_look, state

EXPONENT = 2 / 3
SIMULATED_RANGES = slice(3e-3, 0.3)  # over h_rms, of the points of panel A
LARGEST_RANGE = SIMULATED_RANGES.stop  # in panels A and B
WIDE_MARKER = MARKERS[3]  # of cells of several wavelengths, in panel C
THEORY_ON_CELL = make_dot("theory, cell's spectrum", mfc="white")


class Surface(NamedTuple):
    """Surface of a simulated case; figures list cases in the order of these parameters."""

    hurst: float
    window: float
    magnification: float


def main(job):
    sweeps = [datasets.read(path, ["attractive_area", "pressure"]) for path in job.input.sweeps]
    fits = [datasets.read(path, ["a_v", "window_low"]) for path in job.input.fits]
    cases = []
    files = zip(job.input.bem, job.input.bem_fits, job.input.lattice_fits, strict=True)
    for areas, fit, lattice in files:
        case = join(
            datasets.read(areas, ["attractive_area_mean"]),
            datasets.read(fit, ["a_v_mean"]),
            datasets.read(lattice, ["a_v"]),
        )
        cases.append(case)
    cases.sort(key=lambda case: case.surface)
    # The sweeps take their Hurst exponents from the surfaces of cases, so that these are equal.
    alike = [case for case in cases if case.surface.hurst == float(sweeps[0].hurst[0])]
    with plotting.open_figure(job.output, "AB;CD", 6.1) as panels:
        draw_magnifications(panels["A"], sweeps[0], alike)
        draw_pressures(panels["B"], sweeps[1])
        draw_a_v(panels["C"], sweeps[2], fits[2], cases)
        draw_a_v_of_pressure(panels["D"], sweeps[3], fits[3], alike)


def join(areas, fit, lattice):
    """A simulated case: its areas, its fits of a_V, and the a_V of theory on its spectrum."""
    theory = lattice.a_v.sel(variant=VARIANT, drop=True)
    fit = fit.assign(theory_a_v=theory).isel(window=0)
    case = areas.merge(fit, join="exact", combine_attrs="override")
    parameters = datasets.parameters(case)
    surface = Surface(*(parameters[name] for name in Surface._fields))
    return case.assign_attrs(surface=surface, label=name_case(case))


def draw_magnifications(ax, theory, cases):
    """Areas at one pressure for a few magnifications, by theory and simulation."""
    hurst = float(theory.hurst[0])
    theory = theory.isel(hurst=0, load=0)
    pressure = float(theory.pressure.sel(variant=VARIANT)[0])
    for colour, magnification in plotting.shade(theory.magnification.values):
        area = theory.attractive_area.sel(magnification=magnification)
        draw_theory(ax, area["range"] ** EXPONENT, area, colour, label=number(magnification))
    dress_areas(ax, 0.22)
    ax.set_title(state(hurst=hurst, pressure=pressure))
    place = {"loc": "upper left", "ncols": 2, "alignment": "left"}
    ax.add_artist(ax.legend(title=r"theory, $\zeta$ =", **place))
    for index, case in enumerate(cases):
        area = case.sel(pressure=pressure, method="nearest").sel(range=SIMULATED_RANGES)
        area = area.isel(range=slice(None, None, 4))
        x = area["range"] ** EXPONENT + 0.004 * (index - 1)  # sideways
        look = pick_look(index, label=case.label)
        plotting.draw_points(ax, x, area, "attractive_area_mean", **look)
    x = np.array([0, LARGEST_RANGE**EXPONENT])
    look = {"color": BLACK, "zorder": 5, "label": state(a_v=A_V)}
    ax.plot(x, 1.5 * A_V * pressure * x, ":", **look)
    handles, _ = ax.get_legend_handles_labels()
    handles = handles[theory.sizes["magnification"] :]
    ax.legend(handles=handles, loc="upper right", title="BEM")


def dress_areas(ax, top):
    """Axes of the attractive area against the range to the power 2/3."""
    ax.set(xlim=(0, LARGEST_RANGE**EXPONENT), ylim=(0, top))
    ax.set_xlabel(r"$(\epsilon/h_\mathrm{rms})^{2/3}$")
    ax.set_ylabel(r"attractive area $A_\mathrm{ad}/A_\mathrm{nom}$")


def draw_pressures(ax, theory):
    """Areas at several pressures, by theory."""
    hurst = float(theory.hurst[0])
    theory = theory.isel(hurst=0, magnification=0)
    for colour, load in plotting.shade(range(theory.sizes["load"])):
        loaded = theory.isel(load=load)
        label = f"{float(loaded.pressure.sel(variant=VARIANT)):g}"
        draw_theory(ax, loaded["range"] ** EXPONENT, loaded.attractive_area, colour, label=label)
    dress_areas(ax, 0.75)
    ax.set_title(f"{state(hurst=hurst, magnification=float(theory.magnification))}, theory")
    ax.legend(title=r"$\hat{p}$ =", loc="upper left", ncols=2, alignment="left")


def draw_a_v(ax, sweep, fit, cases):
    """a_V against magnification with Pastewka and Robbins' and simulation."""
    a_v = fit.a_v.isel(load=0)
    sweep = sweep.sel(variant=VARIANT).isel(load=0)
    # Those of the theory first; a user's case may have another one.
    hursts = dict.fromkeys([*fit.hurst.values, *(case.surface.hurst for case in cases)])
    for index, hurst in enumerate(hursts):
        look = pick_look(index)
        if hurst in fit.hurst:
            draw_intervals(ax, fit.magnification, a_v.sel(hurst=hurst), look["color"])
            moments = sweep.sel(hurst=hurst)
            slope = moments.rms_slope.values
            curvature = moments.rms_curvature.values
            robbins = criteria.pastewka_robbins_a_v(1.0, 1.0, slope, curvature)
            ax.plot(fit.magnification, robbins, "--", color=look["color"], linewidth=0.9)
        ax.plot([], [], label=state(hurst=hurst), **look)
        for case in cases:
            if case.surface.hurst == hurst:
                x = plotting.move_aside(case.surface.magnification, 2 * (index - 1))
                wide = {"marker": WIDE_MARKER} if case.surface.window > 1 else {}
                draw_case(ax, case, x, [LOAD], **look | wide)
    ax.set(xscale="log", yscale="log", ylim=(0.6, 400))
    ax.set(xlabel=plotting.MAGNIFICATION, ylabel=r"$a_V$")
    ax.set_title(state(pressure=float(sweep.pressure[0, 0])))
    wide = make_dot("BEM, larger cell", marker=WIDE_MARKER)
    kinds = [make_key("theory"), make_dot(f"BEM, {name_cell(1)}"), wide, THEORY_ON_CELL]
    kinds.append(make_key("Pastewka & Robbins", linestyle="--"))
    plotting.add_legend(ax, *kinds, loc="upper left")


def draw_intervals(ax, x, a_v, colour):
    """a_V in the interval quoted, with light bands over all fit intervals and corrections."""
    quoted = a_v.sel(variant=VARIANT)
    plotting.draw_band(ax, x, quoted.min("window"), quoted.max("window"), colour, alpha=0.2)
    draw_theory(ax, x, a_v.isel(window=0), colour)


def draw_case(ax, case, x, pressures, label=None, **look):
    """a_V of a case at some pressures, with theory on its spectrum."""
    loaded = case.sel(pressure=pressures, method="nearest")
    x = np.broadcast_to(x, loaded.pressure.shape)
    plotting.draw_hollow(ax, x, loaded.theory_a_v, **look)
    plotting.draw_points(ax, x, loaded, "a_v_mean", **look, label=label)


def draw_a_v_of_pressure(ax, sweep, fit, cases):
    hurst = float(sweep.hurst[0])
    sweep = sweep.sel(variant=VARIANT).isel(hurst=0, magnification=0)
    draw_intervals(ax, sweep.pressure, fit.a_v.isel(hurst=0, magnification=0), GREY)
    for index, case in enumerate(cases):
        pressures = case.pressure.values
        x = plotting.move_aside(pressures, index - 1)
        draw_case(ax, case, x, pressures, case.label, **pick_look(index))
    ax.set(xscale="log", yscale="log", ylim=(0.8, 25), xlabel=plotting.PRESSURE, ylabel=r"$a_V$")
    plotting.write_ticks(ax.yaxis, [1, 2, 3, 5, 10, 20])
    ax.set_title(state(hurst=hurst))
    theory = make_key(f"theory, {state(magnification=float(sweep.magnification))}")
    plotting.add_legend(ax, theory, THEORY_ON_CELL, loc="upper right")


if __name__ == "__main__":
    main(start(globals()))
