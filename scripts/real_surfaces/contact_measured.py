"""Contact of measured heights themselves, made periodic in two ways, beside theory on the same."""

import logging
import warnings

import numpy as np
import xarray as xr

from common import conventions
from common.contact_curves import load_curves
from common.conventions import VARIANT, logarithmic_grid
from common.job import start
from real_surfaces.measured_maps import read_map
from stickiness import datasets
from stickiness.adhesive import edge_zone
from stickiness.adhesive import solver as adhesive
from stickiness.measured import periodic
from stickiness.persson.theory import Persson
from stickiness.plausibility import PlausibilityWarning
from stickiness.repulsive import solver as repulsive
from stickiness.traction_laws import Exponential
from stickiness.units import Quantity
from stickiness.verdicts.material import Material

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
    entry = job.params.surface
    bem = entry["bem"]
    measured = read_map(
        entry,
        bem["measurement"],
        finest=float(surface.q_cutoff),
        detrend="mean" if bem["periodic"] else None,  # a plane would break the period
    )
    if measured is None:
        raise ValueError(f"{entry['label']}: bem needs a map of heights, not a line profile")
    dataset = solve(
        measured.heights,
        q0=float(surface.q0),
        q_max=choose_highest_wave_number(bem, measured.cutoff),
        bem=bem,
        ranges=logarithmic_grid(job.params.gaps),
        pixels=job.params.pixels_per_wavelength,
        tolerance=job.params.tolerance,
        gamma=job.params.gamma,
    )
    name = job.wildcards.real_surface
    datasets.write(
        conventions.annotate(dataset, **VARIABLE_TEXTS),
        job.output[0],
        title=f"contact of the measured heights of {name}",
        parameters={"surface": name, "source": measured.heights.source, **entry},
    )


def choose_highest_wave_number(bem, cutoff):
    """Highest wave number of the contact [1/m]: the instrument's, or a lower one as configured."""
    if bem["shortest_wavelength"] is None:
        return cutoff
    wanted = 2 * np.pi / bem["shortest_wavelength"]
    if wanted > cutoff * (1 + 1e-9):
        raise ValueError(
            f"bem.shortest_wavelength = {bem['shortest_wavelength']} is below the instrument's "
            f"{2 * np.pi / cutoff:.3g} m; leave it out or give a longer one"
        )
    return wanted


def solve(heights, q0, q_max, bem, **settings):
    """Contact and theory, as configured by `bem`, for every way of making the heights periodic."""
    ways = ("given",) if bem["periodic"] else WAYS
    blocks = [solve_periodic(heights, way, q0, q_max, bem, **settings) for way in ways]
    ways = xr.DataArray(list(ways), dims="periodisation", name="periodisation")
    # Loads with units are the same in every way, though not over the h_rms of each.
    dataset = xr.concat(blocks, ways, join="override")
    return dataset.assign(q1=dataset.q1.isel(periodisation=0, drop=True))


def solve_periodic(heights, way, q0, q_max, bem, ranges, pixels, tolerance, gamma):
    """Contact on two grids, in units of 1/q0 and the h_rms of the periodic heights, and theory."""
    limited, sides, q_max, pixels = make_periodic(heights, way, q_max, pixels, bem)
    # In units of 1/q0 along the surface, and of the rms height across it.
    h_rms = float(np.std(limited))
    scaled = (limited - limited.mean()) / h_rms
    lengths = tuple(q0 * side for side in sides)
    material = None if bem["adhesion"] is None else Material.from_entry(bem["adhesion"])
    pressures = np.sort(bem["pressures"])
    if any(isinstance(pressure, Quantity) for pressure in bem["pressures"]):
        modulus = material.plane_strain_modulus
        pressures = np.sort([p / modulus for p in bem["pressures"]]) / (q0 * h_rms)
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
        modulus = material.plane_strain_modulus
        length = material.work_of_adhesion / modulus
        # In the units of the scaled heights, pressures over E* q0 h_rms.
        law = Exponential(length / (q0 * h_rms**2), material.range / h_rms)
        grids = scaled[::2, ::2], scaled
        curves = [press_with_adhesion(grid, lengths, pressures, law) for grid in grids]
        block = block.merge(xr.concat(curves, "resolution"))
        block["modulus"] = modulus
        block["applied_pressure"] = "pressure", pressures * modulus * q0 * h_rms
    block = block.assign_coords(resolution=[pixels / 2, float(pixels)])
    return block.assign(h_rms=h_rms, q1=q_max)


def make_periodic(heights, way, q_max, pixels, bem):
    """Heights on the grid to be solved, sides, highest wave number, points per wavelength."""
    most = bem["most_points"]
    if way == "given" and bem["shortest_wavelength"] is None:
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
        row["adhesive_residual"] = state.residual
        row["adhesive_iterations"] = state.iterations
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
    main(start(globals()))
