"""Figure 14: Persson's theory beside simulation: area, mean gap and distribution of gaps."""

from common.job import start
from figures.plot_fig10 import draw_simulation
from figures.theory_curves import draw_theory, name_case
from stickiness import datasets
from stickiness.pages import plotting
from stickiness.pages.plotting import make_dot, make_key, pick_look


def main(job):
    variables = ["area_fraction_mean", "mean_gap_mean", "gap_density_mean", "edge_gap_mean"]
    ensembles = [datasets.read(path, variables) for path in job.input.ensembles]
    lattices = [
        datasets.read(path, ["area_fraction", "mean_gap", "gap_density"])
        for path in job.input.lattices
    ]
    with plotting.open_figure(job.output, "AB;CC", 6.4, height_ratios=[1, 1.2]) as panels:
        draw_means(panels["A"], "area_fraction", ensembles, lattices)
        draw_means(panels["B"], "mean_gap", ensembles, lattices)
        panels["A"].set(ylabel=plotting.CONTACT_AREA, yscale="log")
        panels["B"].set(ylabel=rf"mean gap {plotting.SYMBOLS['mean_gap']}")
        draw_simulation(panels["C"], ensembles[0], lattices[0])


def draw_means(ax, name, ensembles, lattices):
    """Area or mean gap against the load, simulated and by theory on the spectra of the cells."""
    for index, (ensemble, lattice) in enumerate(zip(ensembles, lattices, strict=True)):
        look = pick_look(index, label=name_case(ensemble), markersize=3.5)
        draw_theory(ax, lattice.pressure, lattice[name], look["color"])
        plotting.draw_points(ax, ensemble.pressure, ensemble, f"{name}_mean", **look)
    ax.set(xscale="log", xlabel=plotting.PRESSURE)
    plotting.add_legend(ax, make_dot("BEM", marker="."), make_key("theory, 2018"))


if __name__ == "__main__":
    main(start(globals()))
