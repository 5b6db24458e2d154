"""Picture of contact and pull-off of measured heights, and what its interactive form shares."""

import numpy as np
from matplotlib import colormaps
from matplotlib.cm import ScalarMappable
from matplotlib.colors import ListedColormap, Normalize, to_hex

from stickiness.formatting import percent, unit_for
from stickiness.pages import plotting
from stickiness.pages.plotting import BLUE, GREY, RED

CONTACT = 255  # code of a pixel in contact; lower ones are gaps
GAPS = [to_hex(colormaps["bone_r"](code / (CONTACT - 1))) for code in range(CONTACT)]


def draw_still(contact, pull_off, output):
    """Write contact at some loads above the curve of tension, or why nothing was simulated."""
    if contact.attrs["left_out"]:
        with plotting.open_figure([output], [["text"]], 0.6) as panels:
            panels["text"].axis("off")
            reason = f"Not simulated: {contact.attrs['left_out']}."
            panels["text"].text(0, 0.5, reason, va="center", wrap=True)
        return
    codes, widest = code_maps(contact)
    (width, height), unit = sides_of(contact)
    ratios = [min(max(1.5 * height / width, 0.8), 3.0)]
    rows = "ABCD"
    if not pull_off.attrs["left_out"]:
        rows = f"{rows};.EE."
        ratios = [*ratios, 2.2]
    with plotting.open_figure([output], rows, sum(ratios) + 0.9, height_ratios=ratios) as panels:
        maps = [panels[letter] for letter in "ABCD"]
        loads = np.linspace(1, len(codes) - 1, len(maps)).round().astype(int)
        look = {"cmap": ListedColormap([*GAPS, RED]), "vmin": 0, "vmax": CONTACT}
        look |= {"extent": [0, width, height, 0], "interpolation": "nearest"}
        for ax, index in zip(maps, loads, strict=True):
            ax.imshow(codes[index], **look)
            ax.set_title(f"{percent(contact.area_fraction[index])} contact", loc="right")
            ax.set_xlabel(f"x [{unit}]")
            ax.tick_params(labelleft=ax is maps[0])
        per_gap, unit = unit_for(widest, "m")
        scale = ScalarMappable(Normalize(0, widest * per_gap), ListedColormap(GAPS))
        ax.figure.colorbar(scale, ax=maps, shrink=0.8, label=f"gap [{unit}]")
        if "E" in panels:
            curves, gap, tension, limits = follow_tension(pull_off)
            for name, colour, curve in curves:
                panels["E"].plot(curve["gap"], curve["tension"], color=colour, label=name)
            panels["E"].axhline(0, color=GREY, linewidth=0.7)
            panels["E"].set(ylim=limits, xlabel=gap, ylabel=tension)
            panels["E"].legend(loc="lower right")


def code_maps(contact):
    """Code of every pixel by load, y and x, and the gap [m] of the highest code of gaps."""
    # A pixel is a block of two by two points, and in contact if half of them are.
    widest = float(contact.gap.isel(pressure=0).quantile(0.995))
    codes = np.rint((CONTACT - 1) * np.clip(contact.gap / widest, 0, 1))
    codes = codes.where(contact.contact < 0.5, CONTACT).transpose("pressure", "y", "x")
    return codes.values.astype("u1"), widest


def sides_of(dataset):
    """Sides of the map along x and y in a unit that suits them; positions are pixel centres."""
    sides = [float(dataset[axis][0] + dataset[axis][-1]) for axis in ("x", "y")]
    factor, unit = unit_for(max(sides), "m")
    return [factor * side for side in sides], unit


def follow_tension(pull_off):
    """Curves of tension against gap with their names and colours, labels, and limits of tension."""
    per_gap, gap = unit_for(float(pull_off.mean_gap.max()), "m")
    largest = float(pull_off.mean_traction.max())
    per_tension, tension = unit_for(max(largest, 1.0), "Pa")
    curves = []
    ways = ((0, "approach", BLUE), (1, "separation", RED))
    for way, name, colour in ways:
        states = pull_off.isel(state=pull_off.separating.values == way)
        gaps = states.mean_gap.values
        tensions = states.mean_traction.values
        curves.append((name, colour, {"gap": gaps * per_gap, "tension": tensions * per_tension}))
    # The squeeze may press far harder than the surfaces attract each other.
    lowest = max(-2 * largest, 1.1 * float(pull_off.mean_traction.min()))
    limits = lowest * per_tension, 1.3 * largest * per_tension
    return curves, f"mean gap [{gap}]", f"mean tension [{tension}]", limits
