"""Contact of measured heights themselves, made periodic in two ways, beside theory on the same."""

import logging
import warnings
from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from common import conventions
from common.config.entries import MOST_POINTS, measurements
from common.contact_curves import load_curves
from common.conventions import VARIANT, logarithmic_grid
from common.job import start
from common.materials import Material, read_material
from real_surfaces import measured_surface
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
AS_THEY_STAND = ("given",)
SOLVED_VARIABLES = ["area_fraction", "mean_gap", "edge_gap", "residual", "attractive_area"]
# With adhesion. Areas of contact change by less than 1e-3 of themselves from here to 1e-5 where
# the grid hardly resolves the attraction, which is where solutions are slow.
PRECISION = {"tol": 1e-3, "max_iterations": 10000}
START_TOLERANCE = 1e-4  # of the contact without adhesion, over h_rms
VARIABLE_TEXTS = {
    "periodisation": ("1", "way in which the heights were made periodic"),
    "resolution": ("1", "grid points per shortest wavelength, at least"),
    "theory_attractive_area": ("1", "attractive area by theory on the spectrum of these heights"),
    "theory_area_fraction": ("1", "contact area by theory on the spectrum of these heights"),
    "a_v": ("1", "a_V = A_ad/((3/2) p (range/h_rms)^(2/3))"),
    "theory_a_v": ("1", "a_V by theory on the spectrum of these heights"),
    "h_rms": ("m", "rms height of the periodic surface"),
    "q1": ("1/m", "highest wave number of the heights pressed"),
    "adhesive_contact_area": ("1", "area at a gap of zero with adhesion, by pixels"),
    "adhesive_attractive_area": ("1", "area with gaps up to the range of attraction, by pixels"),
    "adhesive_mean_gap": ("1", "mean gap over h_rms with adhesion"),
    "adhesive_residual": ("1", "unbalanced pressure over the strength or the flattening pressure"),
    "edge_resolution": (
        "1",
        f"pixel over range^2 E*/w; edges of contact are resolved up to {edge_zone.COARSEST}",
    ),
    "applied_pressure": ("Pa", "mean pressure"),
}


@dataclass(frozen=True)
class Setting:
    """Loads and settings: pressures over E* q0 h_rms, ranges over h_rms."""

    pressures: NDArray  # over E* alone if `absolute`
    ranges: NDArray
    pixels: int  # per shortest wavelength, at least
    tolerance: float
    gamma: float  # of the theory
    absolute: bool = False
    material: Material | None = None  # for contact with adhesion
    ways: tuple[str, ...] = WAYS
    resampled: bool = True  # if False, periodic heights stay on their grid
    most_points: int = MOST_POINTS


def main(job):
    surface = datasets.read(job.input.surface, ["q0", "q_cutoff"])
    entry = job.params.surface
    bem = entry["bem"]
    heights = read_map(entry)
    index, finest = bem.get("measurement", 0), float(surface.q_cutoff)
    cutoff = measured_surface.find_cutoff(entry, index, heights, finest)
    q_max = highest_wave_number(bem, cutoff)
    params, ranges = job.params, logarithmic_grid(job.params.gaps)
    grid = {"pixels": params.pixels_per_wavelength, "tolerance": params.tolerance}
    setting = read_setting(bem, ranges=ranges, gamma=params.gamma, **grid)
    datasets.write(
        conventions.annotate(solve(heights, float(surface.q0), q_max, setting), **VARIABLE_TEXTS),
        job.output[0],
        title=f"contact of measured heights: {entry['label']}",
        parameters={"surface": job.wildcards.real_surface, "source": heights.source, **entry},
    )


def read_map(entry):
    """Levelled heights of the measurement whose contact is configured."""
    bem = entry["bem"]
    measurement = measurements(entry)[bem.get("measurement", 0)][1]
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
    wanted = 2 * np.pi / si(bem["shortest_wavelength"], "m")
    if wanted > cutoff * (1 + 1e-9):
        raise ValueError(
            f"bem.shortest_wavelength = {bem['shortest_wavelength']!r} is below the instrument's "
            f"{2 * np.pi / cutoff:.3g} m; leave it out or give a longer one"
        )
    return wanted


def read_setting(bem, **settings):
    """Loads, material and grid as configured, beside the other settings."""
    material = read_material(bem["adhesion"]) if "adhesion" in bem else None
    pressures = bem["pressures"]
    absolute = any(isinstance(pressure, str) for pressure in pressures)
    if absolute:
        pressures = [si(pressure, "Pa") / material.modulus for pressure in pressures]
    return Setting(
        np.sort(pressures),
        absolute=absolute,
        material=material,
        ways=AS_THEY_STAND if bem.get("periodic", False) else WAYS,
        resampled="shortest_wavelength" in bem,
        most_points=bem.get("most_points", MOST_POINTS),
        **settings,
    )


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
    pressures = setting.pressures / (q0 * h_rms) if setting.absolute else setting.pressures
    ranges = setting.ranges
    block = load_curves(scaled, lengths, (2, 1), pressures, ranges, setting.tolerance)
    block = block[SOLVED_VARIABLES]
    theory = Persson(periodic.shells(scaled, lengths), variant=VARIANT, gamma=setting.gamma)
    areas = [theory.gap_cumulative(ranges, p) for p in pressures]
    block["theory_attractive_area"] = (("pressure", "range"), areas)
    block["theory_area_fraction"] = "pressure", [theory.area_fraction(p) for p in pressures]
    for name in ("attractive_area", "theory_attractive_area"):
        scale = 1.5 * block.pressure * block["range"] ** (2 / 3)
        block[name.replace("attractive_area", "a_v")] = block[name] / scale
    if setting.material is not None:
        modulus = setting.material.modulus
        length = setting.material.work_of_adhesion / modulus
        # In the units of the scaled heights, pressures over E* q0 h_rms.
        law = Exponential(length / (q0 * h_rms**2), setting.material.range / h_rms)
        fine = scaled, lengths, pressures, law
        coarse = scaled[::2, ::2], *fine[1:]
        curves = [press_with_adhesion(*grid) for grid in (coarse, fine)]
        block = block.merge(xr.concat(curves, "resolution"))
        block["applied_pressure"] = "pressure", pressures * modulus * q0 * h_rms
    block = block.assign_coords(resolution=[pixels / 2, float(pixels)])
    return block.assign(h_rms=h_rms, q1=q_max)


def make_periodic(heights, way, q_max, setting):
    """Heights on the grid to be solved, sides, highest wave number, points per wavelength."""
    if way in AS_THEY_STAND and not setting.resampled:
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
    points = max(sides) * q_max / (2 * np.pi) * setting.pixels
    if points > setting.most_points:
        shortest = 2 * np.pi / q_max * points / setting.most_points
        raise ValueError(
            f"bem needs {points:.0f} grid points a side, more than {setting.most_points}; give "
            f"bem.shortest_wavelength of {shortest:.3g} m or more, or raise bem.most_points"
        )
    limited = periodic.band_limited(whole, sides, q_max, setting.pixels)
    logging.info("%s: %d x %d points", way, *limited.shape)
    return limited, sides, q_max, setting.pixels


def press_with_adhesion(heights, lengths, pressures, law):
    """Quantities with adhesion at every pressure, each from the contact without adhesion.

    This leads to the state with the widest gaps, where loading from afar ends. Whether the grid
    resolves the edges of contact is stored, so no warning says so.
    """
    rows = []
    for contact in repulsive.load_path(heights, lengths, pressures, tol=START_TOLERANCE):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", PlausibilityWarning)
            load = {"pressure": contact.mean_pressure, "start": contact}
            state = adhesive.solve(heights, lengths, law, **load, **PRECISION)
        attracted = (state.gap > 0) & (state.gap <= state.law.range)
        area = state.repulsive_area_fraction
        row = {
            "adhesive_contact_area": area,
            "adhesive_attractive_area": np.mean(attracted),
            "adhesive_mean_gap": state.mean_gap,
            "adhesive_residual": state.residual,
        }
        rows.append(xr.Dataset(row))
        at = f"n = {len(heights)}: with adhesion, load {len(rows)} of {len(pressures)}"
        logging.info("%s, area %.4f, %d iterations", at, area, state.iterations)
    curve = xr.concat(rows, xr.DataArray(list(pressures), dims="pressure", name="pressure"))
    pixel = max(side / n for side, n in zip(lengths, heights.shape, strict=True))
    resolution = edge_zone.resolution(pixel, law.range, law.adhesion_length)
    return curve.assign(edge_resolution=resolution)


if __name__ == "__main__":
    main(start(globals(), "contact_measured", real_surface="jacksboro"))
