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
from common.contact_curves import load_curve, measure
from common.contact_picture import draw_still
from common.job import start
from real_surfaces.measured_maps import read_map
from stickiness import datasets, remaining
from stickiness.entries import list_measurements
from stickiness.formatting import amount, percent
from stickiness.measured import periodic
from stickiness.plausibility import PlausibilityWarning
from stickiness.remaining.measurement import measure as measure_remaining
from stickiness.repulsive import solver
from stickiness.repulsive.half_space import measure_slope
from stickiness.repulsive.solver import ConvergenceError
from stickiness.solids import HALF_SPACE
from stickiness.traction_laws import LAWS, find_strength
from stickiness.verdicts.limits import LIMIT_TEXT, LIMITS
from stickiness.verdicts.material import Material
from stickiness.verdicts.simulated_surface import read_simulated
from stickiness.verdicts.verdict import LEAST_SHOWN

PERIODISATION = "smooth"  # a tapered rim is flat: it sticks better than the surface
MOST_PIXELS = 8  # per shortest wavelength
LEAST_PIXELS = 4
ROUNDING = 1e-9
CONTACT_POINTS = 512  # along the longer side, at most; the fields kept have half of them
# Shares of the area in contact by theory: at small loads those solved are up to 1.8 times as large.
AREAS = np.geomspace(1e-3, 0.3, 8)
CONTACT_TOLERANCE = 1e-4
PULL_OFF_POINTS = 192  # along the longer side, at most
# In the width of the cohesive zone: half the grid, which tells the error, resolves it with two.
PIXELS_IN_ZONE = 4.0
PULL_OFF_TOLERANCE = 1e-3
PULL_OFF_STEPS = 20
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
    params = job.params
    name = job.wildcards.real_surface
    surface = datasets.read(job.input.surface, ["q0", "q1", "q_cutoff"])
    contact = None
    try:
        measured = find_map(surface, params.surface)
        contact = press(prepare(measured, CONTACT_POINTS), float(surface.q0), measured.cutoff)
        if len(list_measurements(params.surface)) > 1:
            contact.attrs["measurement"] = measured.heights.source
        pull_off = pull(measured, surface, params.entry, params.squeeze)
    except LeftOutError as reason:
        logging.info("not simulated: %s", reason)
        pull_off = xr.Dataset(attrs={"left_out": str(reason)})
        contact = pull_off.copy() if contact is None else contact
    datasets.write(
        contact,
        job.output.contact,
        title=f"where the heights of {name} touch",
        parameters={"surface": name, **params.surface},
    )
    datasets.write(
        pull_off,
        job.output.pull_off,
        title=f"pull-off of {params.material} from {name}",
        parameters={"surface": name, "material": params.material, **params.entry},
    )
    draw_still(contact, pull_off, job.output.figure)


def find_map(surface, entry):
    """`MeasuredMap` of the first measurement that is a map."""
    if surface.attrs["not_judged"]:
        raise LeftOutError("the surface is not judged")
    for index in range(len(list_measurements(entry))):
        measured = read_map(entry, index, finest=float(surface.q_cutoff))
        if measured is not None:
            return measured
    raise LeftOutError("it was measured along lines only, and contact needs a map of heights")


def pull(measured, surface, entry, squeeze):
    """Pull the material of an entry off the measured heights; see `separate`."""
    if entry["surface"] is not None:
        raise LeftOutError("the material has a roughness of its own, which the picture would lack")
    rough = prepare(measured, PULL_OFF_POINTS)
    material = Material.from_entry(entry)
    simulated = read_simulated(surface) if material.solid == HALF_SPACE else None
    return separate(
        rough,
        material,
        q0=float(surface.q0),
        q1=float(surface.q1),
        squeeze=squeeze,
        simulated=simulated,
    )


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


def prepare(measured, points):
    """`PeriodicHeights` on at most `points` along the longer side, fewer if all waves are there."""
    heights = measured.heights
    whole = periodic.periodise(heights.heights, PERIODISATION)
    waves = max(heights.size) / (2 * np.pi)  # per wave number along the longer side
    nyquist = np.pi / max(heights.dx, heights.dy)
    q_max = min(measured.cutoff, nyquist, points / (LEAST_PIXELS * waves)) * (1 - ROUNDING)
    pixels = min(MOST_PIXELS, points / (waves * q_max)) * (1 - ROUNDING)
    limited = periodic.band_limited(whole, heights.size, q_max, pixels)
    change = float(np.std(whole - heights.heights) / np.std(heights.heights))
    return PeriodicHeights(limited - limited.mean(), heights.size, 2 * np.pi / q_max, change)


def press(rough, q0, q_cutoff):
    """Contact and gap of `PeriodicHeights` without adhesion, at every load, as a dataset."""
    h_rms = float(np.std(rough.heights))
    slope = measure_slope(rough.heights, rough.sides)
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


def separate(rough, material, q0, q1, squeeze, simulated=None):
    """States of approach, squeeze and separation of `PeriodicHeights`.

    `q0` and `q1` [1/m] are the ends of the spectrum judged; `squeeze` is over E* q0 h_rms;
    `simulated` are the states on which the verdict rests, if any.
    """
    h_rms = float(np.std(rough.heights))
    modulus = material.plane_strain_modulus
    adhesion_length = material.work_of_adhesion / modulus
    simulated_range = find_resolved_range(rough, material, adhesion_length)
    predicted = predict_resolved(
        rough, material, adhesion_length, simulated_range, q0, simulated=simulated
    )
    law = LAWS[material.law](adhesion_length, simulated_range)
    squeeze_pressure = squeeze * q0 * h_rms
    measured = simulate(rough, law, material.solid, squeeze_pressure)
    gaps = np.array([point.state.gap for point in measured.points])
    zones = np.select([gaps <= 0, gaps <= law.range], [TOUCHING, ATTRACTED], OPEN).astype("u1")
    dataset = xr.Dataset(
        {
            "mean_gap": ("state", measured.gap),
            "mean_traction": ("state", -modulus * measured.pressure),
            "residual": ("state", [point.state.residual for point in measured.points]),
            "iterations": ("state", [point.state.iterations for point in measured.points]),
            "separating": ("state", measured.separating.astype("i1")),
            "zone": (("state", "x", "y"), zones),
            "contact_area": ("state", (zones == TOUCHING).mean(axis=(1, 2))),
            "attracted_area": ("state", (zones == ATTRACTED).mean(axis=(1, 2))),
            "jumps": measured.jumps,
            "modulus": modulus,
            "work_of_adhesion": material.work_of_adhesion,
            "range": simulated_range,
            "material_range": material.range,
            "zone_width": q0 * law.maugis_range**2 / adhesion_length,
            "energy_ratio": predicted.energy_ratio,
            "h_rms": h_rms,
            "shortest_wavelength": rough.shortest_wavelength,
            "judged_wavelength": 2 * np.pi / q1,
            "squeeze_pressure": squeeze_pressure * modulus,
        },
        coords=rough.centres(),
        attrs={"left_out": ""},
    )
    dataset.zone.encoding = {"zlib": True}
    dataset = conventions.annotate(dataset, **TEXTS, residual=STATE["residual"])
    dataset = conventions.add_convergence(dataset, PULL_OFF_TOLERANCE)
    return add_quoted(dataset, measured, predicted, modulus)


def find_resolved_range(rough, material, adhesion_length):
    """Range of the attraction [m]: the material's, or the shortest that the grid resolves."""
    pixel = rough.sides[0] / rough.heights.shape[0]
    strength = float(find_strength(material.law))
    # The cohesive zone, range^2/(adhesion length), spans enough pixels.
    shortest = strength * np.sqrt(PIXELS_IN_ZONE * pixel * adhesion_length)
    simulated_range = max(material.range, shortest)
    h_rms = float(np.std(rough.heights))
    if simulated_range > h_rms:
        raise LeftOutError(
            f"the shortest range that the grid resolves, {amount(simulated_range, 'm', 2)}, is "
            f"longer than the rms height, {amount(h_rms, 'm', 2)}"
        )
    return simulated_range


def predict_resolved(rough, material, adhesion_length, simulated_range, q0, simulated=None):
    """What the model predicts for the heights and the range that are simulated."""
    spectrum = periodic.shells(rough.heights, rough.sides)
    predicted = remaining.predict(
        spectrum,
        adhesion_length,
        simulated_range,
        q0,
        material.solid,
        material.law,
        simulated=simulated,
    )
    if predicted.separation_limits[1] < LEAST_SHOWN:
        raise LeftOutError(
            f"the model predicts that less than {percent(LEAST_SHOWN)} of the work of adhesion "
            f"remains, even at a range of {amount(simulated_range, 'm', 2)}, the shortest that the "
            "grid resolves"
        )
    return predicted


def simulate(rough, law, solid, squeeze_pressure):
    """Approach, squeeze [E*] and separation by full simulation."""
    try:
        with warnings.catch_warnings():
            # What a coarse grid does to the result is in the limits.
            warnings.simplefilter("ignore", PlausibilityWarning)
            return measure_remaining(
                rough.heights,
                rough.sides,
                law,
                squeeze=squeeze_pressure,
                tol=PULL_OFF_TOLERANCE,
                solid=solid,
                steps=PULL_OFF_STEPS,
            )
    except ConvergenceError as error:
        raise LeftOutError(f"the simulation did not converge ({error})") from None


def add_quoted(dataset, measured, predicted, modulus):
    """Add works and pull-off with their limits, simulated and by the model."""
    sources = (("", "", measured), ("predicted_", ", by the model", predicted))
    for name, text in QUOTED.items():
        scale, unit = (modulus, "Pa") if name == "pull_off" else (1.0, "1")
        for prefix, by_whom, source in sources:
            low, high = getattr(source, f"{name}_limits")
            limited = np.array([low, getattr(source, name), high])
            dataset[f"{prefix}{name}"] = "limit", scale * limited
            datasets.annotate(dataset, **{f"{prefix}{name}": (unit, text + by_whom)})
    dataset = dataset.assign_coords(limit=list(LIMITS))
    return datasets.annotate(dataset, limit=LIMIT_TEXT)


if __name__ == "__main__":
    main(start(globals()))
