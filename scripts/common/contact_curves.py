"""Contact of surfaces along their load path, under the names of the results.

Fine solutions are taken on several grids; coarse ones of many more surfaces, with descriptors of
their long waves, correct the ensemble mean.
"""

import logging

import numpy as np
import xarray as xr

from common.conventions import RMS_SLOPE
from common.model_surfaces import cell_size, grid_points, make_heights, model_spectrum, waves_across
from stickiness import dmt
from stickiness import surface as synthesis
from stickiness.accuracy import multilevel
from stickiness.accuracy.error_models import COARSE
from stickiness.accuracy.quantities import COLUMNS, MEASURED
from stickiness.repulsive import solver, subpixel

# First seeds of coarse solutions and of described waves; the configuration keeps these sets apart.
SOLVED_FROM = 100_001
DESCRIBED_FROM = 1_000_001
# Quantities that are measured beyond areas and mean gaps.
MEASURED_TEXTS = {name: ("1", COLUMNS[name].text, "no contact") for name in MEASURED}
CONTACT_VARIABLES = MEASURED_TEXTS | {
    "rms_slope": RMS_SLOPE,
    "other": "seed of a realisation that is not solved",
    "descriptor": "what is described, lengths in units of 1/q0 and heights of h_rms",
    "long_waves": "descriptors of the long waves",
    "other_long_waves": "descriptors of the long waves of seeds that are not solved",
}


def steps_of(pixels_per_wavelength):
    """List by how many points of the finest grid each grid steps, from coarse to fine."""
    return sorted({pixels_per_wavelength // COARSE, 2, 1}, reverse=True)


def load_curves(heights, length, steps, pressures, ranges, tolerance, names=()):
    """Measure the contact on every grid, along `resolution`; see `load_curve`."""
    curves = [
        load_curve(heights[::step, ::step], length, pressures, ranges, tolerance, names)
        for step in steps
    ]
    return xr.concat(curves, "resolution")


def load_curve(heights, length, pressures, ranges, tolerance, names=()):
    """Measure the contact at every pressure; `names` are those of `MEASURED` to measure, too."""
    measured = {name: MEASURED[name](heights, length) for name in names}
    rows = []
    for contact in solver.load_path(heights, length, pressures, tol=tolerance):
        more = {name: of_gap(contact.gap) for name, of_gap in measured.items()}
        rows.append(measure(contact, ranges).assign(more))
        logging.info(
            f"n = {len(heights)}: load {len(rows)} of {len(pressures)}, area "
            f"{contact.area_fraction:.4f}, residual {contact.residual:.1e}, "
            f"{contact.iterations} iterations"
        )
    return xr.concat(rows, xr.DataArray(list(pressures), dims="pressure", name="pressure"))


def measure(contact, ranges):
    """Measure one solution, and its attractive areas if there are `ranges` for them."""
    touching = contact.gap == 0
    solved = ("area_fraction", "mean_gap", "residual", "iterations", "fft_pairs")
    quantities = {name: float(getattr(contact, name)) for name in solved}
    quantities["pixel_area_fraction"] = quantities["area_fraction"]
    quantities["area_fraction"] -= subpixel.boundary_strip(touching)
    quantities["edge_gap"] = (
        subpixel.edge_gap(contact.gap) if 0 < quantities["area_fraction"] < 1 else 0.0
    )
    quantities["edges"] = subpixel.edge_count(touching)
    if not len(ranges):
        return xr.Dataset(quantities)
    within = dmt.attractive_area(contact.gap, ranges, subpixel=True)
    within_pixels = dmt.attractive_area(contact.gap, ranges, subpixel=False)
    quantities["attractive_area"] = ("range", within)
    quantities["pixel_attractive_area"] = ("range", within_pixels)
    return xr.Dataset(quantities, {"range": ranges})


def solve_seeds(
    surface, seeds, pixels_per_wavelength, steps, pressures, ranges, tolerance, names=()
):
    """Solve random surfaces on every grid, with the slope of the finest; see `load_curve`."""
    length = cell_size(surface)
    n = grid_points(surface, pixels_per_wavelength)
    curves = []
    for seed in seeds:
        logging.info("seed %d", seed)
        heights = make_heights(surface, n, seed)
        slope = synthesis.moments(heights, length).rms_slope
        curve = load_curves(heights, length, steps, pressures, ranges, tolerance, names)
        curves.append(curve.assign(rms_slope=slope))
    dataset = xr.concat(curves, xr.DataArray(seeds, dims="seed", name="seed"))
    return dataset.assign_coords(resolution=n / waves_across(surface) / np.array(steps))


def coarse_seeds(numbers):
    """Seeds of coarse solutions, which are numbered from 1."""
    return SOLVED_FROM - 1 + np.array(numbers)


def coarse_solutions(surface, numbers, pressures, ranges, tolerance, names=()):
    """Solve surfaces, numbered from 1, on a coarse grid and describe their long waves."""
    seeds = coarse_seeds(numbers)
    coarsely_solved = ("area_fraction", "mean_gap", "residual", "iterations", "rms_slope")
    kept = [*coarsely_solved, *names, *(["attractive_area"] if len(ranges) else [])]
    # On every second point: on two pixels a wave the slope of the shortest is not all there.
    dataset = solve_seeds(
        surface, seeds, 2 * COARSE, [2], pressures, ranges, tolerance, names
    ).isel(resolution=0, drop=True)
    return dataset[kept].assign(long_waves=describe_waves(surface, dataset.seed))


def describe_others(surface, count):
    """Describe the long waves of so many further surfaces, which are not solved."""
    return describe_waves(surface, xr.DataArray(DESCRIBED_FROM + np.arange(count), dims="other"))


def describe_waves(surface, seeds):
    """Describe the long waves of surfaces, by the seeds along a dimension of any name."""
    # Of skewed surfaces, too, the Gaussian long waves of a seed are described. They explain more of
    # the scatter of areas and gaps than long waves whose phases are turned.
    spectrum = model_spectrum(surface)
    length = cell_size(surface)
    (dim,) = seeds.dims
    rows = multilevel.descriptors(spectrum, length, seeds.values, surface["amplitudes"])
    coords = {dim: seeds.values, "descriptor": list(multilevel.DESCRIPTORS)}
    return xr.DataArray(rows, coords, (dim, "descriptor"))
