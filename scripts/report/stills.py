"""Pictures of contact for paper and for browsers without scripts."""

from matplotlib.cm import ScalarMappable
from matplotlib.colors import ListedColormap, Normalize
from matplotlib.patches import Patch

from common import plotting
from common.formatting import percent
from common.plotting import BLACK, BLUE, GREY, RED
from real_surfaces.pictured_heights import halve
from report.contact_looks import (
    CONTACT,
    GAPS,
    ZONES,
    limits_of_tension,
    scale_of_tension,
    sides_of,
    unit_of_map,
    widest_gap,
)
from report.pull_off_states import moments
from report.surface_figure import unit_of

BESIDE = 4  # panels beside one another
POINTS = 128  # of a panel, along the longer side: more make a large file and no better picture


def draw_touch(dataset, output):
    """Write gaps with the contact on top of them at every load."""
    letters = "ABCDEFGH"[: dataset.sizes["pressure"]]
    rows = [letters[i : i + BESIDE] for i in range(0, len(letters), BESIDE)]
    widest, (per_x, unit_x) = widest_gap(dataset), unit_of_map(dataset)
    per_gap, unit_gap = unit_of(widest)
    sides = sides_of(dataset)
    height = len(rows) * min(max(1.5 * sides[1] / sides[0], 0.8), 3.0) + 0.9
    with plotting.open_figure([output], ";".join(rows), height) as panels:
        for index, letter in enumerate(letters):
            at, ax = dataset.isel(pressure=index), panels[letter]
            gap, share = (thin(at[name].values.T) for name in ("gap", "contact"))
            colours, share = GAPS(gap / widest), share[..., None]
            look = {"origin": "lower", "interpolation": "nearest"}
            extent = [0, sides[0] * per_x, 0, sides[1] * per_x]
            ax.imshow((1 - share) * colours + share * CONTACT, extent=extent, **look)
            ax.set_title(f"{percent(float(at.area_fraction))} contact", loc="right")
            ax.tick_params(labelleft=letter == rows[index // BESIDE][0])
        for letter in rows[-1]:
            panels[letter].set_xlabel(f"x [{unit_x}]")
        scale = ScalarMappable(Normalize(0, widest * per_gap), GAPS)
        figure = next(iter(panels.values())).figure
        bar = figure.colorbar(scale, ax=list(panels.values()), shrink=0.8)
        bar.set_label(f"gap [{unit_gap}]; contact orange")


def thin(field):
    """Field of at most `POINTS` a side, by means of blocks."""
    return field if max(field.shape) <= POINTS else halve(field)


def draw_pull_off(dataset, output):
    """Write the curve of tension against gap, and the contact at four moments."""
    found = moments(dataset)
    names = "BCDE"[: len(found)]
    sides, (per_x, unit_x) = sides_of(dataset), unit_of_map(dataset)
    per_gap, unit_gap = unit_of(float(dataset.mean_gap.max()))
    per_tension, unit = scale_of_tension(dataset)
    height = 2.4 + min(max(1.5 * sides[1] / sides[0], 0.8), 3.0) + 0.6
    rows = [list("A" * len(names)), list(names)]
    with plotting.open_figure([output], rows, height) as panels:
        ax = panels["A"]
        for way, name, colour in ((0, "approach", BLUE), (1, "separation", RED)):
            curve = dataset.isel(state=dataset.separating.values == way)
            gap, tension = curve.mean_gap * per_gap, curve.mean_traction * per_tension
            ax.plot(gap, tension, color=colour, label=name)
        ax.axhline(0, color=GREY, linewidth=0.7)
        ax.set_ylim(*(limit * per_tension for limit in limits_of_tension(dataset)))
        for name, (_, index) in zip(names, found.items(), strict=True):
            at = dataset.isel(state=index)
            place = float(at.mean_gap) * per_gap, float(at.mean_traction) * per_tension
            ax.plot(*place, "o", color=BLACK)
            ax.annotate(name, place, xytext=(4, 4), textcoords="offset points", clip_on=True)
        ax.set(xlabel=f"mean gap [{unit_gap}]", ylabel=f"mean tension [{unit}]")
        ax.legend(loc="lower right")
        for name, (title, index) in zip(names, found.items(), strict=True):
            zone = dataset.zone.isel(state=index).values.T
            look = {"origin": "lower", "cmap": ListedColormap(list(ZONES.values()))}
            extent = [0, sides[0] * per_x, 0, sides[1] * per_x]
            panels[name].imshow(zone, vmin=0, vmax=2, extent=extent, **look)
            panels[name].set_title(title, loc="right")
            panels[name].set_xlabel(f"x [{unit_x}]")
            panels[name].tick_params(labelleft=name == "B")
        keys = [
            Patch(facecolor=c, edgecolor=GREY, linewidth=0.5, label=n) for n, c in ZONES.items()
        ]
        ax.figure.legend(handles=keys, loc="outside lower center", ncols=3)


def draw_reason(reason, output):
    """Write a figure that says why there is nothing to draw."""
    with plotting.open_figure([output], [["text"]], 0.6) as panels:
        panels["text"].axis("off")
        panels["text"].text(0, 0.5, f"Not drawn: {reason}.", va="center", wrap=True)
