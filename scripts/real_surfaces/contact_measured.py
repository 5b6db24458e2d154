"""Contact of measured heights themselves, made periodic in two ways, beside theory on the same."""

from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from pipeline import conventions, measured_surface
from pipeline.contact_curves import load_curves
from pipeline.conventions import VARIANT, logarithmic_grid
from pipeline.job import start
from stickiness.config import checks
from stickiness.core import datasets
from stickiness.core.units import si
from stickiness.measured import periodic, topography
from stickiness.persson.theory import Persson

WAYS = ("taper", "mirror")
MOST_POINTS = 2048  # of the grid along a side
SOLVED_VARIABLES = ["area_fraction", "mean_gap", "edge_gap", "residual", "attractive_area"]


@dataclass(frozen=True)
class Setting:
    """Loads and settings: pressures over E* q0 h_rms, ranges over h_rms."""

    pressures: NDArray
    ranges: NDArray
    pixels: int  # per shortest wavelength, at least
    tolerance: float
    gamma: float  # of the theory


def main(job):
    surface = datasets.read(job.input.surface, ["q0", "q_cutoff"])
    asked = job.params.surface
    heights = read_map(asked)
    q_max = highest_wave_number(asked["bem"], float(surface.q_cutoff))
    setting = Setting(
        pressures=np.sort(asked["bem"]["pressures"]),
        ranges=logarithmic_grid(job.params.gaps),
        pixels=job.params.pixels_per_wavelength,
        tolerance=job.params.tolerance,
        gamma=job.params.gamma,
    )
    datasets.write(
        annotate(solve(heights, float(surface.q0), q_max, setting)),
        job.output[0],
        title=f"contact of measured heights: {asked['label']}",
        parameters={"surface": job.wildcards.real_surface, "source": heights.source, **asked},
    )


def read_map(asked):
    """Levelled heights of the measurement whose contact is asked for."""
    index = asked["bem"].get("measurement", 0)
    heights = measured_surface.read_levelled(checks.measurements(asked)[index][1])
    if isinstance(heights, topography.Profile):
        raise ValueError(f"{heights.source} is a line profile; bem needs a map of heights")
    return heights


def highest_wave_number(bem, cutoff):
    """Highest wave number of the contact: the instrument's, or a lower one as configured."""
    if "shortest_wavelength" not in bem:
        return cutoff
    asked = 2 * np.pi / si(bem["shortest_wavelength"], "m")
    if asked > cutoff * (1 + 1e-9):
        raise ValueError(
            f"bem.shortest_wavelength = {bem['shortest_wavelength']!r} is below the instrument's "
            f"{2 * np.pi / cutoff:.3g} m; leave it out or give a longer one"
        )
    return asked


def solve(heights, q0, q_max, setting):
    """Contact and theory for both ways of making the heights periodic."""
    blocks = [solve_periodic(heights, way, q0, q_max, setting) for way in WAYS]
    ways = xr.DataArray(list(WAYS), dims="periodisation", name="periodisation")
    dataset = xr.concat(blocks, ways)
    for name in ("attractive_area", "theory_attractive_area"):
        scale = 1.5 * dataset.pressure * dataset["range"] ** (2 / 3)
        dataset[name.replace("attractive_area", "a_v")] = dataset[name] / scale
    return dataset.assign(q1=q_max)


def solve_periodic(heights, way, q0, q_max, setting):
    """Contact on two grids, in units of 1/q0 and the h_rms of the periodic heights, and theory."""
    whole = periodic.periodise(heights.heights, way)
    sides = whole.shape[0] * heights.dx, whole.shape[1] * heights.dy
    check_size(sides, q_max, setting.pixels)
    limited = periodic.band_limited(whole, sides, q_max, setting.pixels)
    h_rms = float(np.std(limited))
    scaled, lengths = (limited - limited.mean()) / h_rms, tuple(q0 * s for s in sides)
    pressures, ranges = setting.pressures, setting.ranges
    block = load_curves(scaled, lengths, (2, 1), pressures, ranges, setting.tolerance)
    grids = [setting.pixels / 2, float(setting.pixels)]
    block = block[SOLVED_VARIABLES].assign_coords(resolution=grids)
    theory = Persson(periodic.shells(scaled, lengths), variant=VARIANT, gamma=setting.gamma)
    areas = [theory.gap_cumulative(ranges, p) for p in pressures]
    block["theory_attractive_area"] = (("pressure", "range"), areas)
    block["theory_area_fraction"] = "pressure", [theory.area_fraction(p) for p in pressures]
    return block.assign(h_rms=h_rms)


def check_size(sides, q_max, pixels):
    """Refuse a grid that would be too large."""
    points = max(sides) * q_max / (2 * np.pi) * pixels
    if points > MOST_POINTS:
        shortest = 2 * np.pi / q_max * points / MOST_POINTS
        raise ValueError(
            f"bem needs {points:.0f} grid points a side, more than {MOST_POINTS}; give "
            f"bem.shortest_wavelength of {shortest:.3g} m or more"
        )


def annotate(dataset):
    return conventions.annotate(
        dataset,
        periodisation=("1", "way in which the heights were made periodic"),
        resolution=("1", "grid points per shortest wavelength, at least"),
        theory_attractive_area=("1", "the same by theory on the spectrum of the same heights"),
        theory_area_fraction=("1", "contact area by theory on the spectrum of the same heights"),
        a_v=("1", "a_V = A_ad/((3/2) p (range/h_rms)^(2/3))"),
        theory_a_v=("1", "a_V by theory on the spectrum of the same heights"),
        h_rms=("m", "rms height of the periodic surface"),
        q1=("1/m", "highest wave number of the heights pressed"),
    )


if __name__ == "__main__":
    main(start(globals(), "contact_measured", real_surface="jacksboro"))
