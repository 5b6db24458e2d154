"""Contact and pull-off of measured heights, simulated, and the picture of both.

The heights are pressed at a few loads without adhesion. One material is then pressed on and pulled
off with adhesion. The grid cannot resolve a molecular range, so the range is as long as the
cohesive zone needs to span some pixels. More adhesion then remains than at the material's range.
The prediction of the verdicts for the same heights and the same range stands beside it.
"""

import logging
import warnings
from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy.ndimage import maximum_filter1d
from scipy.special import erfinv

from common import conventions
from common.adhesion_sets import STATE
from common.config.entries import measurements
from common.contact_curves import load_curve, measure
from common.contact_picture import draw_still
from common.formatting import amount, percent
from common.job import start
from common.materials import read_material
from common.verdicts import LEAST_SHOWN
from real_surfaces.measured_surface import find_cutoff, read_levelled
from stickiness import datasets, remaining
from stickiness.measured import periodic, topography
from stickiness.plausibility import PlausibilityWarning
from stickiness.repulsive import solver
from stickiness.repulsive.half_space import measure_slope
from stickiness.repulsive.solver import ConvergenceError
from stickiness.traction_laws import LAWS, find_strength

PERIODISATION = "smooth"  # a tapered rim is flat: it sticks better than the surface
MOST_PIXELS, LEAST_PIXELS = 8, 4  # per shortest wavelength
ROUNDING = 1e-9
CONTACT_POINTS = 512  # along the longer side, at most; the fields kept have half of them
# Shares of the area in contact by theory: at small loads those solved are up to 1.8 times as large.
AREAS = np.geomspace(1e-3, 0.3, 8)
CONTACT_TOLERANCE = 1e-4
PULL_OFF_POINTS = 192  # along the longer side, at most
# In the width of the cohesive zone: half the grid, which tells the error, resolves it with two.
PIXELS_IN_ZONE = 4.0
PULL_OFF_TOLERANCE, PULL_OFF_STEPS = 1e-3, 20
OPEN, ATTRACTED, TOUCHING = range(3)

RELATIVE_CHANGE = "largest relative change from half the grid at this load and its neighbours"
TEXTS = {
    "x": ("m", "position along x"),
    "y": ("m", "position along y"),
    "heights": ("m", "heights pressed: periodic, without waves that the grid does not hold"),
    "contact": "share of a block of two by two points in contact",
    "gap": ("m", "mean gap of a block"),
    "contact_pressure": "mean pressure of a block over E*",
    "mean_pressure": "mean pressure over E*",
    "area_fraction": "contact area over nominal area, edges of contact between pixels",
    "area_fraction_discretisation_error": f"area times {RELATIVE_CHANGE}",
    "mean_gap": ("m", "mean gap"),
    "mean_gap_discretisation_error": ("m", f"mean gap times {RELATIVE_CHANGE}"),
    "q0": ("1/m", "lowest wave number of the self-affine range of the surface"),
    "h_rms": ("m", "rms height of the heights simulated"),
    "rms_slope": "rms gradient of the heights simulated",
    "shortest_wavelength": ("m", "shortest wave of the heights simulated"),
    "cutoff_wavelength": ("m", "shortest wave that the instrument resolves"),
    "change": "rms change that made the heights periodic, over the rms height",
    "mean_traction": ("Pa", "mean tension, negative where the surfaces press"),
    "separating": "1 on the way back",
    "contact_area": "area at a gap of zero over nominal area, by pixels",
    "attracted_area": "area with gaps up to the range over nominal area, by pixels",
    "zone": "state of a pixel",
    "jumps": "jumps on the way there and back",
    "modulus": ("Pa", "plane-strain modulus E*"),
    "work_of_adhesion": ("J/m^2", "work of adhesion"),
    "range": ("m", "range of the attraction simulated"),
    "material_range": ("m", "range of the attraction of the material"),
    "zone_width": "width of the cohesive zone, range^2/(adhesion length), times q0",
    "energy_ratio": "work of adhesion over elastic energy of full contact",
    "judged_wavelength": ("m", "shortest wave of the spectrum judged"),
    "squeeze_pressure": ("Pa", "mean pressure before separation, at least"),
}
QUOTED = {
    "approach": "work of approach over the work of adhesion",
    "separation": "work of separation over the work of adhesion",
    "pull_off": "largest mean tension on separation",
}


class LeftOutError(Exception):
    """There is nothing to simulate; the message says why."""


def main(job):
    surface = datasets.read(job.input.surface, ["q0", "q1", "q_cutoff"])
    asked, entry, params, contact = job.params.surface, job.params.entry, job.params, None
    band = float(surface.q0), float(surface.q1)
    try:
        heights, q_cutoff = find_heights(surface, asked)
        contact = press(prepare(heights, q_cutoff, CONTACT_POINTS), band[0], q_cutoff)
        if len(measurements(asked)) > 1:
            contact.attrs["measurement"] = heights.source
        rough, material = prepare(heights, q_cutoff, PULL_OFF_POINTS), read_material(entry)
        pull_off = separate(rough, band, material, params.squeeze)
    except LeftOutError as reason:
        logging.info("not simulated: %s", reason)
        pull_off = xr.Dataset(attrs={"left_out": str(reason)})
        contact = pull_off.copy() if contact is None else contact
    made = {"surface": job.wildcards.real_surface}
    title = f"where the heights of {job.wildcards.real_surface} touch"
    datasets.write(contact, job.output.contact, title=title, parameters=made | asked)
    made |= {"material": params.material, **entry}
    title = f"pull-off of {params.material} from {job.wildcards.real_surface}"
    datasets.write(pull_off, job.output.pull_off, title=title, parameters=made)
    draw_still(contact, pull_off, job.output.figure)


def find_heights(surface, asked):
    """Levelled heights of the first measurement that is a map, and its cutoff [1/m]."""
    if surface.attrs["not_judged"]:
        raise LeftOutError("the surface is not judged")
    for index, (_, measurement) in enumerate(measurements(asked)):
        heights = read_levelled(measurement)
        if isinstance(heights, topography.Topography):
            return heights, find_cutoff(asked, index, heights, float(surface.q_cutoff))
    raise LeftOutError("it was measured along lines only, and contact needs a map of heights")


@dataclass(frozen=True)
class PeriodicHeights:
    """Heights [m] made periodic, without the waves that the grid cannot hold."""

    heights: NDArray
    sides: tuple[float, float]  # m
    shortest_wavelength: float  # m
    change: float  # rms change by which the heights became periodic, over their rms

    def centres(self, step=1):
        """Centres of blocks of `step` by `step` pixels along both sides [m], by axis."""
        counts = (n // step for n in self.heights.shape)
        places = zip(("x", "y"), self.sides, counts, strict=True)
        return {axis: (np.arange(n) + 0.5) * side / n for axis, side, n in places}


def prepare(heights, q_cutoff, points):
    """`PeriodicHeights` on at most `points` along the longer side, fewer if all waves are there."""
    whole = periodic.periodise(heights.heights, PERIODISATION)
    waves = max(heights.size) / (2 * np.pi)  # per wave number along the longer side
    nyquist = np.pi / max(heights.dx, heights.dy)
    q_max = min(q_cutoff, nyquist, points / (LEAST_PIXELS * waves)) * (1 - ROUNDING)
    pixels = min(MOST_PIXELS, points / (waves * q_max)) * (1 - ROUNDING)
    limited = periodic.band_limited(whole, heights.size, q_max, pixels)
    change = float(np.std(whole - heights.heights) / np.std(heights.heights))
    return PeriodicHeights(limited - limited.mean(), heights.size, 2 * np.pi / q_max, change)


def press(rough, q0, q_cutoff):
    """Contact and gap of `PeriodicHeights` without adhesion, at every load, as a dataset."""
    h_rms, slope = float(np.std(rough.heights)), measure_slope(rough.heights, rough.sides)
    # By theory a share erf(sqrt(2) p/(E* slope)) of the area touches.
    loads = slope * erfinv(AREAS) / np.sqrt(2)
    rows = []
    for state in solver.load_path(rough.heights, rough.sides, loads, tol=CONTACT_TOLERANCE):
        fields = {"contact": state.gap == 0, "gap": state.gap, "contact_pressure": state.pressure}
        blocks = {name: (("x", "y"), np.float32(halve(f))) for name, f in fields.items()}
        rows.append(measure(state, ()).assign(blocks))
        logging.info("load %d: area %.4f", len(rows), state.area_fraction)
    fine = xr.concat(rows, "pressure")
    coarse = load_curve(rough.heights[::2, ::2], rough.sides, loads, (), CONTACT_TOLERANCE)
    data = fine[[*fields, "area_fraction", "mean_gap", "residual", "iterations"]]
    for name in ("area_fraction", "mean_gap"):
        error = find_error(fine[name].values, coarse[name].values)
        data[f"{name}_discretisation_error"] = "pressure", error
    data = data.assign(
        heights=(("x", "y"), np.float32(halve(rough.heights))),
        mean_pressure=("pressure", loads),
        q0=q0,
        h_rms=h_rms,
        rms_slope=slope,
        shortest_wavelength=rough.shortest_wavelength,
        cutoff_wavelength=2 * np.pi / q_cutoff,
        change=rough.change,
    )
    data = data.assign_coords(pressure=loads / (q0 * h_rms), **rough.centres(2))
    for name in (*fields, "heights"):
        data[name].encoding = {"zlib": True}
    data = conventions.annotate(data.assign_attrs(left_out="", measurement=""), **TEXTS)
    return conventions.add_convergence(data, CONTACT_TOLERANCE)


def halve(field):
    """Mean of every block of two by two points."""
    return field.reshape(field.shape[0] // 2, 2, field.shape[1] // 2, 2).mean(axis=(1, 3))


def find_error(fine, coarse):
    """Error at every load, from a coarser grid."""
    # The change passes through zero between loads; the neighbouring ones show how large it is.
    return fine * maximum_filter1d(abs(coarse / fine - 1), 3, mode="nearest")


def separate(rough, band, material, squeeze):
    """States of approach, squeeze and separation of `PeriodicHeights`; `band` is q0 and q1."""
    if material.surface is not None:
        raise LeftOutError("the material has a roughness of its own, which the picture would lack")
    q0, q1 = band
    heights, sides = rough.heights, rough.sides
    h_rms, length = float(np.std(heights)), material.work_of_adhesion / material.modulus
    pixel = sides[0] / heights.shape[0]
    strength = float(find_strength(material.law))
    range_ = max(material.range, strength * np.sqrt(PIXELS_IN_ZONE * pixel * length))
    shortest = amount(range_, "m", 2)
    if range_ > h_rms:
        raise LeftOutError(
            f"the shortest range that the grid resolves, {shortest}, is longer than the rms "
            f"height, {amount(h_rms, 'm', 2)}"
        )
    spectrum = periodic.shells(heights, sides)
    predicted = remaining.predict(spectrum, length, range_, q0, material.solid, material.law)
    if predicted.separation_limits[1] < LEAST_SHOWN:
        raise LeftOutError(
            f"the model predicts that less than {percent(LEAST_SHOWN)} of the work of adhesion "
            f"remains, even at a range of {shortest}, the shortest that the grid resolves"
        )
    squeeze, law = squeeze * q0 * h_rms, LAWS[material.law](length, range_)
    settings = {"squeeze": squeeze, "tol": PULL_OFF_TOLERANCE, "solid": material.solid}
    settings["steps"] = PULL_OFF_STEPS
    try:
        with warnings.catch_warnings():
            # What a coarse grid does to the result is in the limits.
            warnings.simplefilter("ignore", PlausibilityWarning)
            found = remaining.measure(heights, sides, law, **settings)
    except ConvergenceError as error:
        raise LeftOutError(f"the simulation did not converge ({error})") from None
    gaps = np.array([point.state.gap for point in found.points])
    zones = np.select([gaps <= 0, gaps <= law.range], [TOUCHING, ATTRACTED], OPEN).astype("u1")
    dataset = xr.Dataset(
        {
            "mean_gap": ("state", found.gap),
            "mean_traction": ("state", -material.modulus * found.pressure),
            "residual": ("state", [point.state.residual for point in found.points]),
            "iterations": ("state", [point.state.iterations for point in found.points]),
            "separating": ("state", found.separating.astype("i1")),
            "zone": (("state", "x", "y"), zones),
            "contact_area": ("state", (zones == TOUCHING).mean(axis=(1, 2))),
            "attracted_area": ("state", (zones == ATTRACTED).mean(axis=(1, 2))),
            "jumps": found.jumps,
            "modulus": material.modulus,
            "work_of_adhesion": material.work_of_adhesion,
            "range": range_,
            "material_range": material.range,
            "zone_width": q0 * law.maugis_range**2 / length,
            "energy_ratio": predicted.energy_ratio,
            "h_rms": h_rms,
            "shortest_wavelength": rough.shortest_wavelength,
            "judged_wavelength": 2 * np.pi / q1,
            "squeeze_pressure": squeeze * material.modulus,
        },
        coords=rough.centres(),
        attrs={"left_out": ""},
    )
    dataset.zone.encoding = {"zlib": True}
    dataset = conventions.annotate(dataset, **TEXTS, residual=STATE["residual"])
    dataset = conventions.add_convergence(dataset, PULL_OFF_TOLERANCE)
    for name, text in QUOTED.items():
        scale, unit = (material.modulus, "Pa") if name == "pull_off" else (1.0, "1")
        for prefix, by, of in (("", "", found), ("predicted_", ", by the model", predicted)):
            values = (getattr(of, name), *getattr(of, f"{name}_limits"))
            for end, value in zip(("", "_low", "_high"), values, strict=True):
                dataset[f"{prefix}{name}{end}"] = scale * value
                texts = {f"{prefix}{name}{end}": (unit, text + by + end.replace("_", ", "))}
                datasets.annotate(dataset, **texts)
    return dataset


if __name__ == "__main__":
    main(start(globals(), "picture_contact", real_surface="jacksboro"))
