"""Contact of measured heights themselves, made periodic in two ways, beside theory on the same."""

import logging
import warnings

import numpy as np
import xarray as xr

from common import conventions
from common.config.entries import MOST_POINTS, measurements
from common.contact_curves import load_curves
from common.conventions import VARIANT, logarithmic_grid
from common.job import start
from common.materials import read_material
from real_surfaces.measured_surface import find_cutoff, read_levelled
from stickiness import datasets
from stickiness.adhesive import edge_zone
from stickiness.adhesive import solver as adhesive
from stickiness.measured import periodic, topography
from stickiness.persson.theory import Persson
from stickiness.plausibility import PlausibilityWarning
from stickiness.repulsive import solver as repulsive
from stickiness.traction_laws import Exponential
from stickiness.units import si

WAYS = ("taper", "mirror")  # to make heights periodic that are not
SOLVED_VARIABLES = ["area_fraction", "mean_gap", "edge_gap", "attractive_area"]
SOLVED_VARIABLES += ["residual", "iterations"]
# With adhesion. Areas of contact change by less than 1e-3 of themselves from here to 1e-5 where
# the grid hardly resolves the attraction, which is where solutions are slow.
PRECISION = {"tol": 1e-3, "max_iterations": 10000}
START_TOLERANCE = 1e-4  # of the contact without adhesion, over h_rms
VARIABLE_TEXTS = {
    "periodisation": "way in which the heights were made periodic",
    "resolution": "grid points per shortest wavelength, at least",
    "theory_attractive_area": "attractive area that theory predicts from the heights' spectrum",
    "theory_area_fraction": "contact area that theory predicts from the heights' spectrum",
    "a_v": "a_V = A_ad/((3/2) p (range/h_rms)^(2/3))",
    "theory_a_v": "a_V that theory predicts from the heights' spectrum",
    "h_rms": ("m", "rms height of the periodic surface"),
    "q1": ("1/m", "highest wave number of the heights pressed"),
    "adhesive_contact_area": "area at a gap of zero with adhesion, by pixels",
    "adhesive_attractive_area": "area with gaps up to the range of attraction, by pixels",
    "adhesive_mean_gap": "mean gap over h_rms with adhesion",
    "adhesive_residual": "unbalanced pressure over the strength or the flattening pressure",
    "adhesive_iterations": "iterations of conjugate gradients with adhesion",
    "modulus": ("Pa", "plane-strain modulus E*"),
    "edge_resolution": f"pixel over range^2 E*/w; edges are resolved up to {edge_zone.COARSEST}",
    "applied_pressure": ("Pa", "mean pressure"),
}


def main(job):
    surface = datasets.read(job.input.surface, ["q0", "q_cutoff"])
    entry, params = job.params.surface, job.params
    bem, heights = entry["bem"], read_map(entry)
    cutoff = find_cutoff(entry, bem.get("measurement", 0), heights, float(surface.q_cutoff))
    found = solve(
        heights,
        float(surface.q0),
        highest_wave_number(bem, cutoff),
        bem,
        ranges=logarithmic_grid(params.gaps),
        pixels=params.pixels_per_wavelength,
        tolerance=params.tolerance,
        gamma=params.gamma,
    )
    title = f"contact of the measured heights of {job.wildcards.real_surface}"
    parameters = {"surface": job.wildcards.real_surface, "source": heights.source, **entry}
    found = conventions.annotate(found, **VARIABLE_TEXTS)
    datasets.write(found, job.output[0], title=title, parameters=parameters)


def read_map(entry):
    """Levelled heights of the measurement whose contact is configured."""
    bem = entry["bem"]
    measurement = measurements(entry)[bem.get("measurement", 0)][1]
    if bem.get("periodic", False):
        measurement = measurement | {"detrend": "mean"}  # a plane would break the period
    heights = read_levelled(measurement)
    if isinstance(heights, topography.Profile):
        raise ValueError(f"{heights.source} is a line profile; bem needs a map of heights")
    return heights


def highest_wave_number(bem, cutoff):
    """Highest wave number of the contact: the instrument's, or a lower one as configured."""
    if "shortest_wavelength" not in bem:
        return cutoff
    wanted = 2 * np.pi / si(bem["shortest_wavelength"], "m")
    if wanted > cutoff * (1 + 1e-9):
        raise ValueError(
            f"bem.shortest_wavelength = {bem['shortest_wavelength']!r} is below the instrument's "
            f"{2 * np.pi / cutoff:.3g} m; leave it out or give a longer one"
        )
    return wanted


def solve(heights, q0, q_max, bem, **settings):
    """Contact and theory, as configured by `bem`, for every way of making the heights periodic."""
    ways = ("given",) if bem.get("periodic", False) else WAYS
    blocks = [solve_periodic(heights, way, q0, q_max, bem, **settings) for way in ways]
    ways = xr.DataArray(list(ways), dims="periodisation", name="periodisation")
    # Loads with units are the same in every way, though not over the h_rms of each.
    dataset = xr.concat(blocks, ways, join="override")
    return dataset.assign(q1=dataset.q1.isel(periodisation=0, drop=True))


def solve_periodic(heights, way, q0, q_max, bem, ranges, pixels, tolerance, gamma):
    """Contact on two grids, in units of 1/q0 and the h_rms of the periodic heights, and theory."""
    limited, sides, q_max, pixels = make_periodic(heights, way, q_max, pixels, bem)
    h_rms = float(np.std(limited))
    scaled, lengths = (limited - limited.mean()) / h_rms, tuple(q0 * s for s in sides)
    material = read_material(bem["adhesion"]) if "adhesion" in bem else None
    pressures = np.sort(bem["pressures"])
    if any(isinstance(pressure, str) for pressure in bem["pressures"]):
        over_modulus = [si(pressure, "Pa") / material.modulus for pressure in bem["pressures"]]
        pressures = np.sort(over_modulus) / (q0 * h_rms)
    block = load_curves(scaled, lengths, (2, 1), pressures, ranges, tolerance)
    block = conventions.add_convergence(block[SOLVED_VARIABLES], tolerance)
    theory = Persson(periodic.shells(scaled, lengths), variant=VARIANT, gamma=gamma)
    areas = [theory.gap_cumulative(ranges, p) for p in pressures]
    scale = 1.5 * block.pressure * block["range"] ** (2 / 3)
    block["a_v"] = block.attractive_area / scale
    block["theory_attractive_area"] = ("pressure", "range"), areas
    block["theory_a_v"] = block.theory_attractive_area / scale
    block["theory_area_fraction"] = "pressure", [theory.area_fraction(p) for p in pressures]
    if material is not None:
        length = material.work_of_adhesion / material.modulus
        # In the units of the scaled heights, pressures over E* q0 h_rms.
        law = Exponential(length / (q0 * h_rms**2), material.range / h_rms)
        grids = scaled[::2, ::2], scaled
        curves = [press_with_adhesion(grid, lengths, pressures, law) for grid in grids]
        block = block.merge(xr.concat(curves, "resolution"))
        block["modulus"] = material.modulus
        block["applied_pressure"] = "pressure", pressures * material.modulus * q0 * h_rms
    block = block.assign_coords(resolution=[pixels / 2, float(pixels)])
    return block.assign(h_rms=h_rms, q1=q_max)


def make_periodic(heights, way, q_max, pixels, bem):
    """Heights on the grid to be solved, sides, highest wave number, points per wavelength."""
    most = bem.get("most_points", MOST_POINTS)
    if way == "given" and "shortest_wavelength" not in bem:
        shape = heights.heights.shape
        if max(shape) > most or any(n % 2 for n in shape):
            raise ValueError(
                f"{heights.source} has {shape[0]} x {shape[1]} points; bem.periodic needs even "
                f"numbers, at most bem.most_points = {most}"
            )
        return heights.heights, heights.size, np.pi / max(heights.dx, heights.dy), 2
    whole = periodic.periodise(heights.heights, way)
    sides = whole.shape[0] * heights.dx, whole.shape[1] * heights.dy
    points = max(sides) * q_max / (2 * np.pi) * pixels
    if points > most:
        raise ValueError(
            f"bem needs {points:.0f} grid points a side, more than {most}; give "
            f"bem.shortest_wavelength of {2 * np.pi / q_max * points / most:.3g} m or more, or "
            "raise bem.most_points"
        )
    limited = periodic.band_limited(whole, sides, q_max, pixels)
    logging.info("%s: %d x %d points", way, *limited.shape)
    return limited, sides, q_max, pixels


def press_with_adhesion(heights, lengths, pressures, law):
    """Quantities with adhesion at every pressure, each from the contact without adhesion."""
    # This leads to the state with the widest gaps, where loading from afar ends. Whether the grid
    # resolves the edges of contact is stored, so no warning says so.
    rows = []
    for contact in repulsive.load_path(heights, lengths, pressures, tol=START_TOLERANCE):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", PlausibilityWarning)
            load = {"pressure": contact.mean_pressure, "start": contact}
            state = adhesive.solve(heights, lengths, law, **load, **PRECISION)
        attracted = (state.gap > 0) & (state.gap <= state.law.range)
        row = xr.Dataset({"adhesive_contact_area": state.repulsive_area_fraction})
        row["adhesive_attractive_area"] = np.mean(attracted)
        row["adhesive_mean_gap"] = state.mean_gap
        row["adhesive_residual"], row["adhesive_iterations"] = state.residual, state.iterations
        rows.append(row)
        logging.info(
            f"n = {len(heights)}: with adhesion, load {len(rows)} of {len(pressures)}, area "
            f"{state.repulsive_area_fraction:.4f}, {state.iterations} iterations"
        )
    curve = xr.concat(rows, xr.DataArray(list(pressures), dims="pressure", name="pressure"))
    pixel = max(side / n for side, n in zip(lengths, heights.shape, strict=True))
    resolution = edge_zone.resolution(pixel, law.maugis_range, law.adhesion_length)
    curve = curve.assign(edge_resolution=resolution)
    return conventions.add_convergence(curve, PRECISION["tol"], "adhesive_")


if __name__ == "__main__":
    main(start(globals(), "contact_measured", real_surface="jacksboro"))
