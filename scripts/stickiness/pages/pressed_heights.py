"""Contact and pull-off of measured heights, simulated, for a picture of both.

The heights are pressed at a few loads without adhesion. One material is then pressed on and pulled
off with adhesion. The grid cannot resolve a molecular range, so the range is as long as the
cohesive zone needs to span some pixels. More adhesion then remains than at the material's range.
The prediction of the verdicts for the same heights and the same range stands beside it.
"""

from __future__ import annotations

import logging
import warnings
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy.ndimage import maximum_filter1d
from scipy.special import erfinv

from stickiness import datasets, remaining
from stickiness.entries.material import Material
from stickiness.formatting import amount, percent
from stickiness.measured import periodic
from stickiness.measured.topography import Topography
from stickiness.plausibility import PlausibilityWarning
from stickiness.remaining.measurement import Remaining
from stickiness.remaining.measurement import measure as measure_remaining
from stickiness.remaining.prediction import Prediction
from stickiness.remaining.trial_states import SimulatedHeights
from stickiness.repulsive import solver, subpixel
from stickiness.repulsive.half_space import measure_slope
from stickiness.repulsive.solver import Contact, ConvergenceError
from stickiness.solids import HALF_SPACE, Solid
from stickiness.traction_laws import LAWS, TractionLaw, find_strength
from stickiness.verdicts.limits import LIMIT_TEXT, LIMITS
from stickiness.verdicts.rough_surface import Surface
from stickiness.verdicts.wording import LEAST_SHOWN, tell_moment

# A tapered rim is flat: it sticks better than the surface.
PERIODISATION: periodic.Periodisation = "smooth"
MOST_PIXELS = 8  # per shortest wavelength
LEAST_PIXELS = 4
ROUNDING = 1e-9
CONTACT_POINTS = 512  # along the longer side, at most; the fields kept have half of them
# Shares of the area in contact by theory: at small loads those solved are up to 1.8 times as large.
AREAS = np.geomspace(1e-3, 0.3, 8)
CONTACT_TOLERANCE = 1e-4
SQUEEZE = 0.1  # over E* q0 h_rms: before the pull-off
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
    "pressure": ("1", "mean pressure over E* q0 h_rms"),
    "contact": ("1", "share of a block of two by two points in contact"),
    "gap": ("m", "mean gap of a block"),
    "contact_pressure": ("1", "mean pressure of a block over E*"),
    "mean_pressure": ("1", "mean pressure over E*"),
    "area_fraction": ("1", "contact area over nominal area, edges of contact between pixels"),
    "area_fraction_discretisation_error": ("1", f"area times {RELATIVE_CHANGE}"),
    "mean_gap": ("m", "mean gap"),
    "mean_gap_discretisation_error": ("m", f"mean gap times {RELATIVE_CHANGE}"),
    "q0": ("1/m", "lowest wave number of the self-affine range of the surface"),
    "h_rms": ("m", "rms height of the heights simulated"),
    "rms_slope": ("1", "rms gradient of the heights simulated"),
    "shortest_wavelength": ("m", "shortest wave of the heights simulated"),
    "cutoff_wavelength": ("m", "shortest wave that the instrument resolves"),
    "change": ("1", "rms change that made the heights periodic, over the rms height"),
    "mean_traction": ("Pa", "mean tension, negative where the surfaces press"),
    "separating": ("1", "1 on the way back"),
    "contact_area": ("1", "area at a gap of zero over nominal area, by pixels"),
    "attracted_area": ("1", "area with gaps up to the range over nominal area, by pixels"),
    "zone": ("1", "state of a pixel"),
    "jumps": ("1", "jumps on the way there and back"),
    "modulus": ("Pa", "plane-strain modulus E*"),
    "work_of_adhesion": ("J/m^2", "work of adhesion"),
    "range": ("m", "range of the attraction simulated"),
    "material_range": ("m", "range of the attraction of the material"),
    "zone_width": ("1", "width of the cohesive zone, range^2/(adhesion length), times q0"),
    "energy_ratio": ("1", "work of adhesion over elastic energy of full contact"),
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


class Picture(NamedTuple):
    """Simulated contact of measured heights, and the pull-off of one material from them.

    The attribute `left_out` of each says why nothing was simulated; it is empty if something was.
    """

    contact: xr.Dataset
    pull_off: xr.Dataset


def picture_contact(surface: Surface, material: Material) -> Picture:
    """Press measured heights at a few loads without adhesion, and pull a material off them.

    Parameters
    ----------
    surface : Surface
        The surface, with its `measurements`: the first map among them is pressed.
    material : Material
        The material that is pulled off.

    Returns
    -------
    Picture
        Both datasets, whose variables have their units and descriptions.
    """
    contact = None
    try:
        measured = find_map(surface)
        contact = press(prepare(measured, CONTACT_POINTS), float(surface.data.q0), measured.cutoff)
        if len(surface.measurements) > 1:
            contact.attrs["measurement"] = measured.heights.source
        pull_off = _pull(measured, surface, material)
    except LeftOutError as reason:
        logging.info("not simulated: %s", reason)
        pull_off = xr.Dataset(attrs={"left_out": str(reason)})
        contact = pull_off.copy() if contact is None else contact
    pull_off = pull_off.assign_attrs(material=material.label, moment=tell_moment(material))
    return Picture(contact, pull_off)


@dataclass(frozen=True)
class MeasuredMap:
    """Levelled heights of one measurement of a surface."""

    heights: Topography
    cutoff: float  #: highest wave number that the instrument resolves [1/m]


def find_map(surface: Surface) -> MeasuredMap:
    """Find the first measurement of a surface that is a map; LeftOutError if there is none."""
    if surface.not_judged:
        raise LeftOutError("the surface is not judged")
    finest = float(surface.data.q_cutoff)
    for measurement in surface.measurements:
        if not isinstance(measurement.heights, Topography):
            continue
        if len(surface.measurements) > 1:
            # Of several measurements each resolves waves of its own.
            spectrum, _ = measurement.find_spectrum()
            finest = min(finest, spectrum.cutoff.q)
        return MeasuredMap(measurement.heights, finest)
    raise LeftOutError("it was measured along lines only, and contact needs a map of heights")


def _pull(measured: MeasuredMap, surface: Surface, material: Material) -> xr.Dataset:
    """Pull a material off the measured heights; see `separate`."""
    if material.surface is not None:
        raise LeftOutError("the material has a roughness of its own, which the picture would lack")
    return separate(
        prepare(measured, PULL_OFF_POINTS),
        material,
        q0=float(surface.data.q0),
        q1=float(surface.data.q1),
        simulated=surface.simulated if material.solid == HALF_SPACE else None,
    )


@dataclass(frozen=True)
class PeriodicHeights:
    """Heights [m] made periodic, without the waves that the grid cannot hold."""

    heights: NDArray
    sides: tuple[float, float]  # m
    shortest_wavelength: float  # m
    change: float  # rms change by which the heights became periodic, over their rms

    @property
    def h_rms(self) -> float:
        """Rms height [m]."""
        return float(np.std(self.heights))

    def centres(self, step: int = 1) -> dict[str, NDArray]:
        """Centres of blocks of `step` by `step` pixels along both sides [m], by axis."""
        counts = (n // step for n in self.heights.shape)
        places = zip(("x", "y"), self.sides, counts, strict=True)
        return {axis: (np.arange(n) + 0.5) * side / n for axis, side, n in places}


def prepare(measured: MeasuredMap, points: int) -> PeriodicHeights:
    """`PeriodicHeights` on at most `points` along the longer side, fewer if all waves are there."""
    heights = measured.heights
    kind = "given" if heights.periodic else PERIODISATION
    whole = periodic.periodise(heights.heights, kind)
    waves = max(heights.size) / (2 * np.pi)  # per wave number along the longer side
    nyquist = np.pi / max(heights.dx, heights.dy)
    q_max = min(measured.cutoff, nyquist, points / (LEAST_PIXELS * waves)) * (1 - ROUNDING)
    pixels = min(MOST_PIXELS, points / (waves * q_max)) * (1 - ROUNDING)
    limited = periodic.band_limited(whole, heights.size, q_max, pixels)
    change = float(np.std(whole - heights.heights) / np.std(heights.heights))
    return PeriodicHeights(limited - limited.mean(), heights.size, 2 * np.pi / q_max, change)


def press(rough: PeriodicHeights, q0: float, q_cutoff: float) -> xr.Dataset:
    """Contact and gap of `PeriodicHeights` without adhesion, at every load, as a dataset."""
    slope = measure_slope(rough.heights, rough.sides)
    # By theory a share erf(sqrt(2) p/(E* slope)) of the area touches.
    loads = slope * erfinv(AREAS) / np.sqrt(2)
    fine = list(solver.load_path(rough.heights, rough.sides, loads, tol=CONTACT_TOLERANCE))
    coarse = list(
        solver.load_path(rough.heights[::2, ::2], rough.sides, loads, tol=CONTACT_TOLERANCE)
    )
    contact = xr.Dataset()
    fields = {
        "contact": [state.gap == 0 for state in fine],
        "gap": [state.gap for state in fine],
        "contact_pressure": [state.pressure for state in fine],
    }
    for name, of_states in fields.items():
        halved = np.array([halve(field) for field in of_states], np.float32)
        contact[name] = ("pressure", "x", "y"), halved
    measures = {"area_fraction": find_area, "mean_gap": lambda state: state.mean_gap}
    for name, measure in measures.items():
        on_fine = np.array([measure(state) for state in fine])
        on_coarse = np.array([measure(state) for state in coarse])
        contact[name] = "pressure", on_fine
        contact[f"{name}_discretisation_error"] = "pressure", find_error(on_fine, on_coarse)
    for name in ("residual", "iterations"):
        contact[name] = "pressure", [getattr(state, name) for state in fine]
    contact = contact.assign(
        heights=(("x", "y"), np.float32(halve(rough.heights))),
        mean_pressure=("pressure", loads),
        q0=q0,
        h_rms=rough.h_rms,
        rms_slope=slope,
        shortest_wavelength=rough.shortest_wavelength,
        cutoff_wavelength=2 * np.pi / q_cutoff,
        change=rough.change,
    )
    contact = contact.assign_coords(
        {"pressure": loads / (q0 * rough.h_rms), **rough.centres(2)}
    ).assign_attrs(left_out="", measurement="")
    for name in (*fields, "heights"):
        contact[name].encoding = {"zlib": True}
    texts = {
        "residual": ("1", "complementarity residual over h_rms"),
        "iterations": ("1", "conjugate gradient iterations"),
    }
    return _describe(contact, CONTACT_TOLERANCE, **texts)


def _describe(states: xr.Dataset, tolerance: float, **texts: tuple[str, str]) -> xr.Dataset:
    """Describe the variables, and say of every state whether it is solved to the tolerance."""
    states["converged"] = (states.residual <= tolerance).astype("i1")
    converged = f"1 where the residual is at most {tolerance:g}, 0 where there is no state"
    texts |= TEXTS | {"converged": ("1", converged)}
    return datasets.annotate(
        states, **{name: texts[name] for name in texts if name in states.variables}
    )


def find_area(contact: Contact) -> float:
    """Contact area over nominal area, with edges of contact between pixels."""
    return float(contact.area_fraction - subpixel.boundary_strip(contact.gap == 0))


def halve(field: NDArray) -> NDArray:
    """Mean of every block of two by two points."""
    return field.reshape(field.shape[0] // 2, 2, field.shape[1] // 2, 2).mean(axis=(1, 3))


def find_error(fine: NDArray, coarse: NDArray) -> NDArray:
    """Error at every load, from a coarser grid."""
    # The change passes through zero between loads; the neighbouring ones show how large it is.
    return fine * maximum_filter1d(abs(coarse / fine - 1), 3, mode="nearest")


def separate(
    rough: PeriodicHeights,
    material: Material,
    q0: float,
    q1: float,
    simulated: SimulatedHeights | None = None,
) -> xr.Dataset:
    """States of approach, squeeze and separation of `PeriodicHeights`.

    `q0` and `q1` [1/m] are the ends of the spectrum judged; `simulated` are the states on which the
    verdict rests, if any.
    """
    modulus = material.plane_strain_modulus
    law = find_resolved_law(rough, material)
    predicted = predict_resolved(rough, material, law, q0, simulated)
    squeeze_pressure = SQUEEZE * q0 * rough.h_rms
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
            "range": law.range,
            "material_range": material.range,
            "zone_width": q0 * law.maugis_range**2 / law.adhesion_length,
            "energy_ratio": predicted.energy_ratio,
            "h_rms": rough.h_rms,
            "shortest_wavelength": rough.shortest_wavelength,
            "judged_wavelength": 2 * np.pi / q1,
            "squeeze_pressure": squeeze_pressure * modulus,
        },
        coords=rough.centres(),
        attrs={"left_out": ""},
    )
    dataset.zone.encoding = {"zlib": True}
    texts = {
        "residual": ("1", "unbalanced pressure over the strength or the flattening pressure"),
        "iterations": ("1", "iterations of conjugate gradients"),
    }
    dataset = _describe(dataset, PULL_OFF_TOLERANCE, **texts)
    return add_quoted(dataset, measured, predicted, modulus)


def find_resolved_law(rough: PeriodicHeights, material: Material) -> TractionLaw:
    """Attraction at the material's range, or the shortest that the grid resolves."""
    adhesion_length = material.work_of_adhesion / material.plane_strain_modulus
    pixel = rough.sides[0] / rough.heights.shape[0]
    strength = float(find_strength(material.law))
    # The cohesive zone, range^2/(adhesion length), spans enough pixels.
    shortest = strength * np.sqrt(PIXELS_IN_ZONE * pixel * adhesion_length)
    simulated_range = max(material.range, shortest)
    if simulated_range > rough.h_rms:
        raise LeftOutError(
            f"the shortest range that the grid resolves, {amount(simulated_range, 'm', 2)}, is "
            f"longer than the rms height, {amount(rough.h_rms, 'm', 2)}"
        )
    return LAWS[material.law](adhesion_length, simulated_range)


def predict_resolved(
    rough: PeriodicHeights,
    material: Material,
    law: TractionLaw,
    q0: float,
    simulated: SimulatedHeights | None,
) -> Prediction:
    """What the model predicts for the heights and the range that are simulated."""
    predicted = remaining.predict(
        periodic.shells(rough.heights, rough.sides),
        law.adhesion_length,
        law.range,
        q0,
        solid=material.solid,
        law=material.law,
        simulated=simulated,
    )
    if predicted.separation_limits[1] < LEAST_SHOWN:
        raise LeftOutError(
            f"the model predicts that less than {percent(LEAST_SHOWN)} of the work of adhesion "
            f"remains, even at a range of {amount(law.range, 'm', 2)}, the shortest that the "
            "grid resolves"
        )
    return predicted


def simulate(
    rough: PeriodicHeights, law: TractionLaw, solid: Solid, squeeze_pressure: float
) -> Remaining:
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


def add_quoted(
    dataset: xr.Dataset, measured: Remaining, predicted: Prediction, modulus: float
) -> xr.Dataset:
    """Add works and pull-off with their limits, simulated and by the model."""
    sources = (("", "", measured), ("predicted_", ", by the model", predicted))
    for name, description in QUOTED.items():
        is_stress = name == "pull_off"
        scale = modulus if is_stress else 1.0
        unit = "Pa" if is_stress else "1"
        for prefix, by_whom, source in sources:
            low, high = getattr(source, f"{name}_limits")
            limited = np.array([low, getattr(source, name), high])
            dataset[f"{prefix}{name}"] = "limit", scale * limited
            datasets.annotate(dataset, **{f"{prefix}{name}": (unit, description + by_whom)})
    dataset = dataset.assign_coords(limit=list(LIMITS))
    return datasets.annotate(dataset, limit=LIMIT_TEXT)
