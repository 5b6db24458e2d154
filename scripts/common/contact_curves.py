"""Contact of one surface along its load path, on several grids, under the names of the results."""

import logging

import xarray as xr

from common import conventions
from stickiness import dmt
from stickiness.accuracy.error_models import COARSE
from stickiness.accuracy.quantities import COLUMNS, MEASURED
from stickiness.repulsive import solver, subpixel

SOLVED = ("area_fraction", "mean_gap", "residual", "iterations", "fft_pairs")
AREAS = ("attractive_area", "pixel_attractive_area")
# Of quantities that a case may ask for beyond areas and mean gaps.
MEASURED_TEXTS = {name: ("1", COLUMNS[name].text, "no contact") for name in MEASURED}


def steps_of(pixels_per_wavelength):
    """Steps between the points that each grid takes from the finest, from coarse to fine."""
    return sorted({pixels_per_wavelength // COARSE, 2, 1}, reverse=True)


def load_curves(heights, length, steps, *path):
    """Contact quantities on every grid, along `resolution`; `path` as of `load_curve`."""
    curves = [load_curve(heights[::step, ::step], length, *path) for step in steps]
    return xr.concat(curves, "resolution")


def load_curve(heights, length, pressures, ranges, tolerance, names=()):
    """Contact quantities at every pressure, each load started from the one before.

    `names` are those of the quantities that are measured because a case asks for them.
    """
    rows = []
    for contact in solver.load_path(heights, length, pressures, tol=tolerance):
        asked = {name: MEASURED[name](heights, contact.gap, length) for name in names}
        rows.append(measure(contact, ranges).assign(asked))
        logging.info(
            f"n = {len(heights)}: load {len(rows)} of {len(pressures)}, area "
            f"{contact.area_fraction:.4f}, residual {contact.residual:.1e}, "
            f"{contact.iterations} iterations"
        )
    return xr.concat(rows, xr.DataArray(list(pressures), dims="pressure", name="pressure"))


def measure(contact, ranges):
    """Quantities of one solution; attractive areas only if there are `ranges` to take them at."""
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


def annotate(dataset):
    return conventions.annotate(dataset, rms_slope=conventions.RMS_SLOPE, **MEASURED_TEXTS)
