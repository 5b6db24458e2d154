"""Where a measured surface touches: its heights pressed at a few loads, for pictures."""

import logging

import numpy as np
import xarray as xr
from scipy.ndimage import maximum_filter1d
from scipy.special import erfinv

from common.contact_curves import load_curve, measure
from common.job import start
from real_surfaces import pictured_heights
from real_surfaces.pictured_heights import NO_MAP, NOT_JUDGED, halve
from report.stills import draw_reason, draw_touch
from stickiness import datasets
from stickiness.repulsive import solver
from stickiness.repulsive.half_space import measure_slope

POINTS = 512  # along the longer side, at most; pictures have half of them
# Shares of the area in contact by theory: at small loads those solved are up to 1.8 times as large.
AREAS = np.geomspace(1e-3, 0.3, 8)
TOLERANCE = 1e-4
RELATIVE_CHANGE = "largest relative change from half the grid at this load and its neighbours"
TEXTS = {
    "x": ("m", "position along x"),
    "y": ("m", "position along y"),
    "pressure": ("1", "mean pressure over E* q0 h_rms"),
    "heights": ("m", "heights pressed: periodic, without waves that the grid does not hold"),
    "contact": ("1", "share of a block of two by two points in contact"),
    "gap": ("m", "mean gap of a block"),
    "contact_pressure": ("1", "mean pressure of a block over E*"),
    "mean_pressure": ("1", "mean pressure over E*"),
    "area_fraction": ("1", "contact area over nominal area, edges of contact between pixels"),
    "area_fraction_discretisation_error": ("1", f"area times {RELATIVE_CHANGE}"),
    "mean_gap": ("m", "mean gap"),
    "mean_gap_discretisation_error": ("m", f"mean gap times {RELATIVE_CHANGE}"),
    "residual": ("1", "complementarity residual over the rms height"),
    "q0": ("1/m", "lowest wave number of the self-affine range of the surface"),
    "h_rms": ("m", "rms height of the heights pressed"),
    "rms_slope": ("1", "rms gradient of the heights pressed"),
    "shortest_wavelength": ("m", "shortest wave of the heights pressed"),
    "cutoff_wavelength": ("m", "shortest wave that the instrument resolves"),
    "change": ("1", "rms change that made the heights periodic, over the rms height"),
}


def main(job):
    surface = datasets.read(job.input.surface, ["q0", "q_cutoff"])
    asked, finest = job.params.surface, float(surface.q_cutoff)
    found = None if surface.attrs["not_judged"] else pictured_heights.read_map(asked, finest)
    if found is None:
        reason = NOT_JUDGED if surface.attrs["not_judged"] else NO_MAP
        logging.info("no pictures: %s", reason)
        dataset = xr.Dataset(attrs={"left_out": reason})
        draw_reason(reason, job.output.figure)
    else:
        heights, q_cutoff = found
        dataset = press(heights, float(surface.q0), q_cutoff, POINTS)
        dataset.attrs["measurement"] = pictured_heights.name_measurement(asked, heights)
        draw_touch(dataset, job.output.figure)
    datasets.write(
        dataset,
        job.output.dataset,
        title=f"where the heights touch: {asked['label']}",
        parameters={"surface": job.wildcards.real_surface, **asked},
    )


def press(heights, q0, q_cutoff, points):
    """Dataset of contact and gap at every load, on a grid of at most `points` a side."""
    pictured = pictured_heights.prepare(heights, q_cutoff, points)
    h_rms, slope = pictured.h_rms, measure_slope(pictured.heights, pictured.sides)
    # By theory a share erf(sqrt(2) p/(E* slope)) of the area touches.
    loads = slope * erfinv(AREAS) / np.sqrt(2)
    fields = {"contact": [], "gap": [], "contact_pressure": []}
    rows = []
    for state in solver.load_path(pictured.heights, pictured.sides, loads, tol=TOLERANCE):
        fields["contact"].append(halve(state.gap == 0))
        fields["gap"].append(halve(state.gap))
        fields["contact_pressure"].append(halve(state.pressure))
        rows.append(measure(state, ()))
        logging.info("load %d: area %.4f", len(rows), state.area_fraction)
    fine = xr.concat(rows, "pressure")
    coarse = load_curve(pictured.heights[::2, ::2], pictured.sides, loads, (), TOLERANCE)
    x, y = pictured.places(2)
    data = {name: (("pressure", "x", "y"), np.float32(field)) for name, field in fields.items()}
    for name in ("area_fraction", "mean_gap"):
        error = find_error(fine[name].values, coarse[name].values)
        data[name] = fine[name]
        data[f"{name}_discretisation_error"] = "pressure", error
    dataset = xr.Dataset(
        {
            **data,
            "heights": (("x", "y"), np.float32(halve(pictured.heights))),
            "mean_pressure": ("pressure", loads),
            "residual": fine.residual,
            "q0": q0,
            "h_rms": h_rms,
            "rms_slope": slope,
            "shortest_wavelength": pictured.shortest_wavelength,
            "cutoff_wavelength": 2 * np.pi / q_cutoff,
            "change": pictured.change,
        },
        coords={"pressure": loads / (q0 * h_rms), "x": x, "y": y},
        attrs={"left_out": "", "measurement": ""},
    )
    for name in (*fields, "heights"):
        dataset[name].encoding = {"zlib": True}
    return datasets.annotate(dataset, **TEXTS)


def find_error(fine, coarse):
    """Error at every load by a coarser grid.

    Changes pass through zero between loads. Neighbours show how large they are where they do.
    """
    return fine * maximum_filter1d(abs(coarse / fine - 1), 3, mode="nearest")


if __name__ == "__main__":
    main(start(globals(), "press_measured", real_surface="jacksboro"))
