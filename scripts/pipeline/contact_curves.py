"""Contact of one surface along its load path, on several grids, under the names of the results."""

import logging

import xarray as xr

from pipeline.conventions import DESCRIBED
from pipeline.quantities import describe_measured
from stickiness.accuracy.error_models import COARSE
from stickiness.accuracy.quantities import MEASURED
from stickiness.contact import gaps, solver, subpixel
from stickiness.core import datasets

SOLVED = ("area_fraction", "mean_gap", "residual", "iterations", "fft_pairs")
AREAS = ("attractive_area", "pixel_attractive_area")
CURVE = {
    **{name: DESCRIBED[name] for name in ("pressure", "range", "area_fraction", "mean_gap")},
    "attractive_area": DESCRIBED["attractive_area"],
    "residual": ("1", "complementarity residual over h_rms"),
    "rms_slope": ("1", "rms gradient of this realisation over q0 h_rms"),
}


def steps_of(pixels_per_wavelength):
    """Steps between the points that each grid takes from the finest, from coarse to fine."""
    return sorted({pixels_per_wavelength // COARSE, 2, 1}, reverse=True)


def load_curves(heights, length, steps, pressures, ranges, tolerance, names=()):
    """Contact quantities on every grid, along the dimension `resolution`."""
    curves = [
        load_curve(heights[::step, ::step], length, pressures, ranges, tolerance, names)
        for step in steps
    ]
    return xr.concat(curves, "resolution")


def load_curve(heights, length, pressures, ranges, tolerance, names=()):
    """Contact quantities at every pressure, each load started from the one before.

    `names` are those of the quantities that are measured because a case asks for them.
    """
    rows = []
    for contact in solver.load_path(heights, length, pressures, tol=tolerance):
        row = measured(contact, ranges)
        rows.append(
            row.assign({name: MEASURED[name](heights, contact.gap, length) for name in names})
        )
        logging.info(
            "n = %d: load %d of %d, area %.4f, residual %.1e, %d iterations",
            len(heights),
            len(rows),
            len(pressures),
            contact.area_fraction,
            contact.residual,
            contact.iterations,
        )
    return xr.concat(rows, xr.DataArray(pressures, dims="pressure", name="pressure"))


def measured(contact, ranges):
    """Quantities of one solution; attractive areas only if there are `ranges` to take them at."""
    touching = contact.gap == 0
    found = {name: float(getattr(contact, name)) for name in SOLVED}
    found["pixel_area_fraction"] = found["area_fraction"]
    found["area_fraction"] -= subpixel.boundary_strip(touching)
    found["edge_gap"] = subpixel.edge_gap(contact.gap) if 0 < found["area_fraction"] < 1 else 0.0
    found["edges"] = subpixel.edge_count(touching)
    if len(ranges):
        areas = (gaps.attractive_area(contact.gap, ranges, subpixel=fine) for fine in (True, False))
        found |= {name: ("range", area) for name, area in zip(AREAS, areas, strict=True)}
        return xr.Dataset(found, {"range": ranges})
    return xr.Dataset(found)


def annotate(dataset):
    texts = {name: text for name, text in CURVE.items() if name in dataset.variables}
    if "range" in dataset.dims:
        texts["pixel_attractive_area"] = (
            "1",
            "attractive area as counted in pixels, over nominal area",
        )
    return datasets.annotate(
        dataset,
        **texts,
        **describe_measured(dataset.data_vars),
        resolution=("1", "grid points per shortest wavelength"),
        pixel_area_fraction=("1", "repulsive contact area as counted in pixels, over nominal area"),
        edges=("1", "pixel sides between contact and gap"),
        edge_gap=("1", "gap of the pixels next to the contact over h_rms: smallest range resolved"),
        iterations=("1", "conjugate gradient iterations"),
        fft_pairs=("1", "pairs of Fourier transforms in units of this grid"),
    )
