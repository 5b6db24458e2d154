"""Colours and units that the moving pictures of contact share with those for paper."""

from matplotlib import colormaps
from matplotlib.colors import to_hex, to_rgba

from common.formatting import prefixed
from common.plotting import RED, SKY
from report.surface_figure import unit_of

GAPS, HEIGHTS = colormaps["bone_r"], colormaps["cividis"]
CONTACT = to_rgba(RED)
ZONES = {"open": "#f2f2f2", "attracted": SKY, "in contact": RED}  # in the order of the codes
COLOURS = 256


def palette(colormap):
    """Colours of a map as Bokeh takes them."""
    return [to_hex(colormap(i / (COLOURS - 1))) for i in range(COLOURS)]


def widest_gap(dataset):
    """Gap [m] at the end of the colours, which few points exceed at the smallest load."""
    return float(dataset.gap.isel(pressure=0).quantile(0.995))


def sides_of(dataset):
    """Sides of the map along x and y [m]; positions are middles of pixels."""
    return tuple(float(dataset[axis][0] + dataset[axis][-1]) for axis in ("x", "y"))


def unit_of_map(dataset):
    """Factor and name of the unit that suits positions on the map."""
    return unit_of(max(sides_of(dataset)))


def scale_of_tension(dataset):
    """Factor and unit that suit the largest tension; pascals at least."""
    scale, prefix = prefixed(max(float(dataset.mean_traction.max()), 1.0), 3)
    return 1 / scale, f"{prefix}Pa"


def limits_of_tension(dataset):
    """Ends of an axis [Pa] that shows the tension; the squeeze may be far beyond."""
    largest = float(dataset.mean_traction.max())
    return max(-2 * largest, 1.1 * float(dataset.mean_traction.min())), 1.3 * largest
