"""Adhesion that remains where rough surfaces approach and separate, with predictions beside it.

Works and gains of energy are over the work of adhesion, heights, gaps and ranges over h_rms, wave
numbers over q0, energies and adhesion lengths over q0 h_rms^2, stresses over E* q0 h_rms.
"""

import logging
import warnings
from itertools import product

import numpy as np

from campaigns.columns import OF_MODEL_SURFACE
from common.conventions import Q0
from common.model_surfaces import cell_size, make_heights
from stickiness import surface
from stickiness.plausibility import PlausibilityWarning
from stickiness.remaining import measurement
from stickiness.remaining.roughness import Roughness
from stickiness.remaining.zero_load import share_at_zero_load
from stickiness.traction_laws import LAWS

QUOTED = {
    "approach": "work of approach",
    "separation": "work of separation",
    "bound": "largest gain of energy",
    "pull_off": "largest mean tension on separation",
}
OF_PATH = {
    "area_at_zero_load": "contact area over nominal area, at zero load on approach",
    "gap_at_zero_load": "mean gap at zero load on approach",
    "jumps": "jumps on the way there and back",
}
COLUMNS = OF_MODEL_SURFACE | {
    "full_contact_energy": "elastic energy of full contact",
    "rms_slope": "rms gradient",
    "energy_ratio": "work of adhesion over full_contact_energy",
    "pressed": "pressure before separation",
    "zone": "q0 range^2 over adhesion length",
    "range": "of the attraction",
    "adhesion_length": "work of adhesion over the modulus",
    **QUOTED,
    **OF_PATH,
    "pixels_in_zone": "width of the cohesive zone in pixels",
    **{f"{name}_grid_error": f"by half the grid and the steps: {QUOTED[name]}" for name in QUOTED},
    "predicted": "gain of energy by theory",
    "predicted_pull_off": "largest mean tension by theory",
    "full_contact": "gain of energy in full contact, if any",
}
FEWEST_PIXELS = 1.0  # below, points of the grid snap one by one, and the path is endless


def measure(setting, seed, shared):
    """Rows of all works of adhesion, ranges and squeezes whose cohesive zone the grid resolves."""
    length = cell_size(setting)
    heights = make_heights(setting, setting["points"], seed)
    spectrum = surface.realised_spectrum(heights, length)
    rough = Roughness(
        h_rms=1.0,
        q0=Q0 * (setting["rolloff"] or 1.0),
        elastic_energy=spectrum.elastic_energy(),
        q1=Q0 * setting["magnification"],
        rms_slope=spectrum.rms_slope,
    )
    # Ranges of attraction are given over h_rms, or by the width of the cohesive zone.
    values = setting["zones"] or setting["ranges"]
    squeezes = setting["squeezes"] or [shared["squeeze"]]
    for ratio, value, squeeze in product(setting["energies"], values, squeezes):
        adhesion_length = ratio * rough.elastic_energy
        range_ = np.sqrt(value * adhesion_length) if setting["zones"] else value
        pixels = range_**2 / adhesion_length / (length / setting["points"])
        if pixels < FEWEST_PIXELS:
            logging.info("w/U %g: %g pixels in the cohesive zone", ratio, pixels)
            continue
        law = LAWS[shared["law"]](adhesion_length, range_)
        if setting["path"]:
            found = follow(heights, length, law, squeeze, half_grid=is_halved(pixels))
        else:
            found = {"bound": share_at_zero_load(heights, length, law)}
        yield {
            "full_contact_energy": rough.elastic_energy,
            "rms_slope": rough.rms_slope,
            "energy_ratio": ratio,
            "pressed": squeeze,
            "zone": rough.q0 * range_**2 / adhesion_length,
            "range": range_,
            "adhesion_length": adhesion_length,
            "pixels_in_zone": pixels,
            **found,
            "predicted": float(rough.share(adhesion_length, range_)),
            "predicted_pull_off": float(rough.tension(adhesion_length, range_)),
            "full_contact": max(1 - 1 / ratio, 0.0),
        }


def is_halved(pixels):
    """Whether half the grid resolves a cohesive zone of so many pixels, and tells the error."""
    return pixels >= 2 * measurement.RESOLVED


def follow(heights, length, law, squeeze, half_grid):
    """What a path of approach and separation tells, with the change from half the grid."""
    with warnings.catch_warnings():
        # What a coarse grid does to the result is in the limits.
        warnings.simplefilter("ignore", PlausibilityWarning)
        measured = measurement.measure(heights, length, law, squeeze, half_grid=half_grid)
    found = {name: getattr(measured, name) for name in (*QUOTED, *OF_PATH)}
    for name in QUOTED:
        low, high = getattr(measured, f"{name}_limits")
        found[f"{name}_grid_error"] = (high - low) / 2
    return found
