"""One material pressed on a measured surface and pulled off: adhesion simulated, for pictures.

The grid does not resolve a molecular range. The range is as long as the cohesive zone needs to be
some pixels wide, so that more adhesion remains than at the material's own range. Beside the
simulation stands what the model of the verdicts predicts for the same heights and the same range.
"""

import logging
import warnings

import numpy as np
import xarray as xr

from common.formatting import amount, percent
from common.job import start
from criteria.materials import read_material
from criteria.texts import LEAST_SHOWN
from real_surfaces import pictured_heights
from real_surfaces.pictured_heights import NO_MAP, NOT_JUDGED
from report.stills import draw_pull_off, draw_reason
from stickiness import datasets
from stickiness.measured import periodic
from stickiness.plausibility import PlausibilityWarning
from stickiness.remaining import measure, predict
from stickiness.repulsive.solver import ConvergenceError
from stickiness.traction_laws import LAWS

POINTS = 192  # along the longer side, at most
# In the width of the cohesive zone: half the grid, which tells the error, resolves it with two.
PIXELS_IN_ZONE = 4.0
TOLERANCE = 1e-3
OPEN, ATTRACTED, TOUCHING = range(3)
QUOTED = {
    "approach": "work of approach over the work of adhesion",
    "separation": "work of separation over the work of adhesion",
    "pull_off": "largest mean tension on separation",
}
TEXTS = {
    "x": ("m", "position along x"),
    "y": ("m", "position along y"),
    "mean_gap": ("m", "mean gap"),
    "mean_traction": ("Pa", "mean tension, negative where the surfaces press"),
    "separating": ("1", "1 on the way back"),
    "contact_area": ("1", "area at a gap of zero over nominal area, by pixels"),
    "attracted_area": ("1", "area with gaps up to the range over nominal area, by pixels"),
    "zone": ("1", "state of a pixel"),
    "jumps": ("1", "jumps on the way there and back"),
    "range": ("m", "range of the attraction simulated"),
    "material_range": ("m", "range of the attraction of the material"),
    "zone_width": ("1", "width of the cohesive zone, range^2/(adhesion length), times q0"),
    "energy_ratio": ("1", "work of adhesion over elastic energy of full contact"),
    "h_rms": ("m", "rms height of the heights simulated"),
    "shortest_wavelength": ("m", "shortest wave of the heights simulated"),
    "judged_wavelength": ("m", "shortest wave of the spectrum judged"),
    "squeeze_pressure": ("Pa", "mean pressure before separation, at least"),
}


class LeftOutError(Exception):
    """There is no pull-off to show; the message says why."""


def main(job):
    surface = datasets.read(job.input.surface, ["q0", "q1", "q_cutoff"])
    asked, entry = job.params.surface, job.params.entry
    try:
        heights, q_cutoff = find_heights(surface, asked)
        found = simulate(
            pictured_heights.prepare(heights, q_cutoff, POINTS),
            (float(surface.q0), float(surface.q1)),
            read_material(entry),
            job.params.law,
            job.params.squeeze,
        )
        found.attrs["measurement"] = pictured_heights.name_measurement(asked, heights)
        draw_pull_off(found, job.output.figure)
    except LeftOutError as reason:
        logging.info("no pictures: %s", reason)
        found = xr.Dataset(attrs={"left_out": str(reason)})
        draw_reason(str(reason), job.output.figure)
    parameters = {"surface": job.wildcards.real_surface, "material": job.params.material}
    datasets.write(
        found,
        job.output.dataset,
        title=f"pull-off of {entry['label']} from {asked['label']}",
        parameters={**parameters, **entry, "source": asked["source"]},
    )


def find_heights(surface, asked):
    """Heights to pull off from, and their cutoff [1/m]."""
    if surface.attrs["not_judged"]:
        raise LeftOutError(NOT_JUDGED)
    found = pictured_heights.read_map(asked, float(surface.q_cutoff))
    if found is None:
        raise LeftOutError(NO_MAP)
    return found


def simulate(pictured, band, material, law, squeeze):
    """Dataset of the states of approach, squeeze and separation, and of the model for the same.

    `band` is q0 and q1 [1/m] of the spectrum judged. `squeeze` is the mean pressure before
    separation over E* q0 h_rms.
    """
    if material.surface is not None:
        raise LeftOutError("the material has a roughness of its own, which the picture would lack")
    q0, q1 = band
    h_rms, sides, solid = pictured.h_rms, pictured.sides, material.solid
    length = material.work_of_adhesion / material.modulus
    pixel = sides[0] / pictured.heights.shape[0]
    range_ = max(material.range, np.sqrt(PIXELS_IN_ZONE * pixel * length))
    if range_ > h_rms:
        raise LeftOutError(
            f"the shortest range that the grid resolves, {metres(range_)}, is longer than the rms "
            f"height, {metres(h_rms)}"
        )
    spectrum = periodic.shells(pictured.heights, sides)
    predicted = predict(spectrum, length, range_, q0, solid)
    if predicted.separation_limits[1] < LEAST_SHOWN:
        raise LeftOutError(
            f"by the model less than {percent(LEAST_SHOWN)} of its work of adhesion remains, even "
            f"at a range of {metres(range_)}, the shortest that the grid resolves"
        )
    try:
        with warnings.catch_warnings():
            # What a coarse grid does to the result is in the limits.
            warnings.simplefilter("ignore", PlausibilityWarning)
            settings = {"squeeze": squeeze * q0 * h_rms, "tol": TOLERANCE, "solid": solid}
            law = LAWS[law](length, range_)
            found = measure(pictured.heights, sides, law, **settings)
    except ConvergenceError as error:
        raise LeftOutError(f"the simulation did not converge ({error})") from None
    dataset = describe_states(found, pictured, material.modulus)
    for name, text in QUOTED.items():
        for prefix, of in (("", found), ("predicted_", predicted)):
            scale, unit = (material.modulus, "Pa") if name == "pull_off" else (1.0, "1")
            values = (getattr(of, name), *getattr(of, f"{name}_limits"))
            for end, value in zip(("", "_low", "_high"), values, strict=True):
                text_of = f"{text}{', by the model' * bool(prefix)}{end.replace('_', ', ')}"
                dataset[f"{prefix}{name}{end}"] = scale * value
                dataset[f"{prefix}{name}{end}"].attrs = {"units": unit, "long_name": text_of}
    dataset = dataset.assign(
        jumps=found.jumps,
        range=range_,
        material_range=material.range,
        zone_width=q0 * range_**2 / length,
        energy_ratio=predicted.energy_ratio,
        h_rms=h_rms,
        shortest_wavelength=pictured.shortest_wavelength,
        judged_wavelength=2 * np.pi / q1,
        squeeze_pressure=settings["squeeze"] * material.modulus,
    )
    return datasets.annotate(dataset, **TEXTS).assign_attrs(left_out="", measurement="")


def metres(length):
    return amount(length, "m", 2)


def describe_states(found, pictured, modulus):
    """Curve and zones of all states."""
    states = [point.state for point in found.points]
    zones = np.array([find_zones(state) for state in states])
    dataset = xr.Dataset(
        {
            "zone": (("state", "x", "y"), zones),
            "mean_gap": ("state", found.gap),
            "mean_traction": ("state", -modulus * found.pressure),
            "separating": ("state", found.separating.astype("i1")),
            "contact_area": ("state", (zones == TOUCHING).mean(axis=(1, 2))),
            "attracted_area": ("state", (zones == ATTRACTED).mean(axis=(1, 2))),
        },
        coords=dict(zip(("x", "y"), pictured.places(), strict=True)),
    )
    dataset.zone.encoding = {"zlib": True}
    return dataset


def find_zones(state):
    """Pixels that touch, that are within the range of the attraction, and that are not."""
    zone = np.where(state.gap <= state.law.range, ATTRACTED, OPEN)
    return np.where(state.gap <= 0, TOUCHING, zone).astype("u1")


if __name__ == "__main__":
    main(start(globals(), "pull_measured", real_surface="jacksboro"))
