"""Contact of measured heights themselves, made periodic in two ways, beside theory on the same."""

import logging

import numpy as np
import xarray as xr

from common import conventions
from common.config.entries import MOST_POINTS, measurements
from common.contact_curves import load_curves
from common.conventions import VARIANT, logarithmic_grid
from common.job import start
from real_surfaces import measured_adhesion, measured_surface
from real_surfaces.measured_loads import Setting, read_loads
from stickiness import datasets
from stickiness.measured import periodic, topography
from stickiness.persson.theory import Persson
from stickiness.units import si

WAYS = ("taper", "mirror")  # to make heights periodic that are not
AS_THEY_STAND = ("given",)
SOLVED_VARIABLES = ["area_fraction", "mean_gap", "edge_gap", "residual", "attractive_area"]


def main(job):
    surface = datasets.read(job.input.surface, ["q0", "q_cutoff"])
    asked = job.params.surface
    bem = asked["bem"]
    heights = read_map(asked)
    setting = Setting(
        **read_loads(bem),
        ranges=logarithmic_grid(job.params.gaps),
        pixels=job.params.pixels_per_wavelength,
        tolerance=job.params.tolerance,
        gamma=job.params.gamma,
        ways=AS_THEY_STAND if bem.get("periodic", False) else WAYS,
        own_grid="shortest_wavelength" not in bem,
        most_points=bem.get("most_points", MOST_POINTS),
    )
    index, finest = bem.get("measurement", 0), float(surface.q_cutoff)
    cutoff = measured_surface.find_cutoff(asked, index, heights, finest)
    q_max = highest_wave_number(bem, cutoff)
    datasets.write(
        annotate(solve(heights, float(surface.q0), q_max, setting)),
        job.output[0],
        title=f"contact of measured heights: {asked['label']}",
        parameters={"surface": job.wildcards.real_surface, "source": heights.source, **asked},
    )


def read_map(asked):
    """Levelled heights of the measurement whose contact is asked for."""
    bem = asked["bem"]
    measurement = measurements(asked)[bem.get("measurement", 0)][1]
    if bem.get("periodic", False):
        measurement = measurement | {"detrend": "mean"}  # a plane would break the period
    heights = measured_surface.read_levelled(measurement)
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
    """Contact and theory for every way of making the heights periodic."""
    blocks = [solve_periodic(heights, way, q0, q_max, setting) for way in setting.ways]
    ways = xr.DataArray(list(setting.ways), dims="periodisation", name="periodisation")
    # Loads with units are the same in every way, though not over the h_rms of each.
    dataset = xr.concat(blocks, ways, join="override")
    return dataset.assign(q1=dataset.q1.isel(periodisation=0, drop=True))


def solve_periodic(heights, way, q0, q_max, setting):
    """Contact on two grids, in units of 1/q0 and the h_rms of the periodic heights, and theory."""
    limited, sides, q_max, pixels = make_periodic(heights, way, q_max, setting)
    h_rms = float(np.std(limited))
    scaled, lengths = (limited - limited.mean()) / h_rms, tuple(q0 * s for s in sides)
    pressures, ranges = setting.scaled_pressures(q0 * h_rms), setting.ranges
    block = load_curves(scaled, lengths, (2, 1), pressures, ranges, setting.tolerance)
    block = block[SOLVED_VARIABLES]
    theory = Persson(periodic.shells(scaled, lengths), variant=VARIANT, gamma=setting.gamma)
    areas = [theory.gap_cumulative(ranges, p) for p in pressures]
    block["theory_attractive_area"] = (("pressure", "range"), areas)
    block["theory_area_fraction"] = "pressure", [theory.area_fraction(p) for p in pressures]
    for name in ("attractive_area", "theory_attractive_area"):
        scale = 1.5 * block.pressure * block["range"] ** (2 / 3)
        block[name.replace("attractive_area", "a_v")] = block[name] / scale
    if setting.solid is not None:
        law = setting.solid.scaled_law(q0, h_rms)
        block = block.merge(measured_adhesion.load_curves(scaled, lengths, pressures, law))
        block["applied_pressure"] = "pressure", pressures * setting.solid.modulus * q0 * h_rms
    block = block.assign_coords(resolution=[pixels / 2, float(pixels)])
    return block.assign(h_rms=h_rms, q1=q_max)


def make_periodic(heights, way, q_max, setting):
    """Heights on the grid to be solved, sides, highest wave number, points per wavelength."""
    if way in AS_THEY_STAND and setting.own_grid:
        shape = heights.heights.shape
        if max(shape) > setting.most_points or any(n % 2 for n in shape):
            raise ValueError(
                f"{heights.source} has {shape[0]} x {shape[1]} points; bem.periodic needs even "
                f"numbers, at most bem.most_points = {setting.most_points}"
            )
        nyquist = np.pi / max(heights.dx, heights.dy)
        return heights.heights, heights.size, nyquist, 2
    whole = periodic.periodise(heights.heights, way)
    sides = whole.shape[0] * heights.dx, whole.shape[1] * heights.dy
    check_size(sides, q_max, setting.pixels, setting.most_points)
    limited = periodic.band_limited(whole, sides, q_max, setting.pixels)
    logging.info("%s: %d x %d points", way, *limited.shape)
    return limited, sides, q_max, setting.pixels


def check_size(sides, q_max, pixels, most_points):
    """Refuse a grid that would be too large."""
    points = max(sides) * q_max / (2 * np.pi) * pixels
    if points > most_points:
        shortest = 2 * np.pi / q_max * points / most_points
        raise ValueError(
            f"bem needs {points:.0f} grid points a side, more than {most_points}; give "
            f"bem.shortest_wavelength of {shortest:.3g} m or more, or raise bem.most_points"
        )


def annotate(dataset):
    return conventions.annotate(
        dataset,
        periodisation=("1", "way in which the heights were made periodic"),
        resolution=("1", "grid points per shortest wavelength, at least"),
        theory_attractive_area=("1", "attractive area by theory on the spectrum of these heights"),
        theory_area_fraction=("1", "contact area by theory on the spectrum of these heights"),
        a_v=("1", "a_V = A_ad/((3/2) p (range/h_rms)^(2/3))"),
        theory_a_v=("1", "a_V by theory on the spectrum of these heights"),
        h_rms=("m", "rms height of the periodic surface"),
        q1=("1/m", "highest wave number of the heights pressed"),
        **measured_adhesion.TEXTS,
    )


if __name__ == "__main__":
    main(start(globals(), "contact_measured", real_surface="jacksboro"))
