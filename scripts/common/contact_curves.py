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

SOLVED = ("area_fraction", "mean_gap", "residual", "iterations", "fft_pairs")
AREAS = ("attractive_area", "pixel_attractive_area")
COARSELY_SOLVED = ("area_fraction", "mean_gap", "residual", "iterations", "rms_slope")
# First seeds of coarse solutions and of described waves; the configuration keeps these sets apart.
SOLVED_FROM, DESCRIBED_FROM = 100_001, 1_000_001
# Quantities that a case may want beyond areas and mean gaps.
MEASURED_TEXTS = {name: ("1", COLUMNS[name].text, "no contact") for name in MEASURED}
VARIABLES = MEASURED_TEXTS | {
    "rms_slope": RMS_SLOPE,
    "other": "seed of a realisation that is not solved",
    "descriptor": "what is described, lengths in units of 1/q0 and heights of h_rms",
    "long_waves": "descriptors of the long waves",
    "other_long_waves": "descriptors of the long waves of seeds that are not solved",
}


def steps_of(pixels_per_wavelength):
    """Steps between the points that each grid takes from the finest, from coarse to fine."""
    return sorted({pixels_per_wavelength // COARSE, 2, 1}, reverse=True)


def load_curves(heights, length, steps, *path):
    """Contact quantities on every grid, along `resolution`; `path` as of `load_curve`."""
    curves = [load_curve(heights[::step, ::step], length, *path) for step in steps]
    return xr.concat(curves, "resolution")


def load_curve(heights, length, pressures, ranges, tolerance, names=()):
    """Contact quantities at every pressure, and further ones by `names`, which a case wants."""
    rows = []
    for contact in solver.load_path(heights, length, pressures, tol=tolerance):
        surface = {name: MEASURED[name](heights, contact.gap, length) for name in names}
        rows.append(measure(contact, ranges).assign(surface))
        logging.info(
            f"n = {len(heights)}: load {len(rows)} of {len(pressures)}, area "
            f"{contact.area_fraction:.4f}, residual {contact.residual:.1e}, "
            f"{contact.iterations} iterations"
        )
    return xr.concat(rows, xr.DataArray(list(pressures), dims="pressure", name="pressure"))


def measure(contact, ranges):
    """Quantities of one solution; attractive areas only if there are `ranges` for them."""
    touching = contact.gap == 0
    found = {name: float(getattr(contact, name)) for name in SOLVED}
    found["pixel_area_fraction"] = found["area_fraction"]
    found["area_fraction"] -= subpixel.boundary_strip(touching)
    found["edge_gap"] = subpixel.edge_gap(contact.gap) if 0 < found["area_fraction"] < 1 else 0.0
    found["edges"] = subpixel.edge_count(touching)
    if len(ranges):
        areas = (dmt.attractive_area(contact.gap, ranges, subpixel=fine) for fine in (True, False))
        found |= {name: ("range", area) for name, area in zip(AREAS, areas, strict=True)}
        return xr.Dataset(found, {"range": ranges})
    return xr.Dataset(found)


def solve_seeds(surface, seeds, pixels_per_wavelength, steps, *path):
    """Contact of random surfaces on every grid, and the slope of the finest; as `load_curves`."""
    length, n = cell_size(surface), grid_points(surface, pixels_per_wavelength)
    curves = []
    for seed in seeds:
        logging.info("seed %d", seed)
        heights = make_heights(surface, n, seed)
        slope = synthesis.moments(heights, length).rms_slope
        curves.append(load_curves(heights, length, steps, *path).assign(rms_slope=slope))
    dataset = xr.concat(curves, xr.DataArray(seeds, dims="seed", name="seed"))
    return dataset.assign_coords(resolution=n / waves_across(surface) / np.array(steps))


def coarse_solutions(surface, which, others_count, pressures, ranges, tolerance, names=()):
    """Solve surfaces, numbered from 0, on a coarse grid and describe the long waves of more.

    The file of the first solved surface also has the surfaces that are only described.
    """
    spectrum, length = model_spectrum(surface), cell_size(surface)
    amplitudes = surface.get("amplitudes", "gaussian")
    seeds = SOLVED_FROM + np.array(which)
    others = DESCRIBED_FROM + np.arange(others_count if which[0] == 0 else 0)
    kept = [*COARSELY_SOLVED, *names, *(["attractive_area"] if len(ranges) else [])]
    # On every second point: on two pixels a wave the slope of the shortest is not all there.
    path = pressures, ranges, tolerance, names
    dataset = solve_seeds(surface, seeds, 2 * COARSE, [2], *path).isel(resolution=0, drop=True)
    dataset = dataset[kept].assign_coords(descriptor=list(multilevel.DESCRIPTORS), other=others)
    for name, dim in (("long_waves", "seed"), ("other_long_waves", "other")):
        rows = multilevel.descriptors(spectrum, length, dataset[dim].values, amplitudes)
        dataset[name] = (dim, "descriptor"), rows
    return dataset
