"""What scans tell of a larger contact: thresholds of patches, judged for the whole surface.

Patches are judged in the way of users. Heights and ranges are over h_rms, wave numbers over q0,
energies and adhesion lengths over q0 h_rms^2. Predictions are made without the error of what a scan
does not tell of a larger contact.
"""

import logging
from itertools import product

import numpy as np
from scipy import stats

from campaigns.columns import OF_TOPOGRAPHY, find_side
from campaigns.patches import cut, measure_whole
from campaigns.trial_thresholds import SHARES, describe_thresholds
from common.conventions import Q0
from common.topographies import make_set
from stickiness.entries.material import Material
from stickiness.verdicts.judgement import judge
from stickiness.verdicts.limits import read_limited
from stickiness.verdicts.longer_waves import lengthen
from stickiness.verdicts.rough_surface import Surface

HEIGHT_UNIT = 1e-7  # m, of heights over h_rms
LENGTH_UNIT = 1e-5  # m, of lengths over 1/q0
WORK_OF_ADHESION = 0.05  # J/m^2
SHORTEST_FITTED = 4.0  # pixels: a fit goes up to half the Nyquist wave number


JUDGED = ("10", "30")  # thresholds that are judged
LIMIT_TEXTS = {"value": "value", "low": "low limit", "high": "high limit"}
COLUMNS = OF_TOPOGRAPHY | {
    "height_skewness": "of the surface, if not that of its family",
    "parts": "patches along a side",
    "patch": "number",
    "skewness": "of the patch",
    "is_judged": "0 where a patch has no verdict",
    "found_hurst": "Hurst exponent fitted to the patch",
    "found_rolloff": "wave number of the roll-off fitted to the patch",
    "is_simulated": "1 where states simulated on the patch decide",
    "longer": "mean share of the energy in waves longer than the patch",
    "shape": "of the heights, as a verdict takes it from their skewness",
    "unevenness": "of the roughness from place to place",
    **{
        f"{limit}_{ending}": f"{text} of threshold_{ending} of the surface, predicted"
        for ending, (limit, text) in product(JUDGED, LIMIT_TEXTS.items())
    },
    "whole_skewness": "of the surface",
    "whole_full_contact_energy": "elastic energy of full contact of the surface",
    "range": "of the attraction",
    **describe_thresholds("whole_threshold", "on the surface"),
}


def measure(setting, seed, shared):
    """Rows of all patches, beside what remains on the whole surface."""
    heights = make_set(setting, seed)
    side = find_side(setting)
    range_ = shared["range"]
    thresholds, of_whole = measure_whole(heights, side, range_)
    pixel = side / setting["points"]
    shortest = min(setting["shortest"], SHORTEST_FITTED) * pixel
    for parts in setting["parts"]:
        patches = cut(heights, parts, 1, shared["count"])
        for number, patch in enumerate(patches):
            row = judge_patch(patch, side / parts, side, shortest, range_, thresholds)
            yield {"parts": parts, "patch": number, **row, **of_whole}


def judge_patch(patch, side, contact, shortest, range_, thresholds):
    """Row of one patch, whose surface is judged as a user's for a contact of all of it.

    Limits are those without what a scan does not tell of a larger contact, which are made of this.
    Every threshold is that of a pair whose modulus is the true one.
    """
    scanned = Surface.from_heights(
        patch * HEIGHT_UNIT, side * LENGTH_UNIT, extend_to=shortest * LENGTH_UNIT
    )
    surface = scanned
    if not scanned.not_judged:
        surface = Surface(lengthen(scanned.data, contact * LENGTH_UNIT, error=0.0))
    skewness = stats.skew(patch, axis=None)
    if surface.not_judged:
        logging.info("not judged: %s", surface.not_judged)
        return {"skewness": skewness, "is_judged": 0, "is_simulated": 0}
    added = surface.family.energy() / scanned.family.energy() - 1
    added = np.maximum(added, 0.0)
    row = {
        "skewness": skewness,
        "is_judged": 1,
        "found_hurst": float(surface.data.hurst),
        "found_rolloff": float(surface.data.get("q_rolloff", np.nan)) * LENGTH_UNIT / Q0,
        "is_simulated": int(surface.simulated is not None),
        "longer": float(np.mean(added / (1 + added))),
        "shape": float(surface.data["shape"]),
        "unevenness": float(surface.data.unevenness),
    }
    for name in JUDGED:
        if not np.isnan(thresholds[name]):
            row |= judge_threshold(surface, thresholds[name], name, range_)
    return row


def judge_threshold(surface, log_length, name, range_):
    """Value and limits of ln of the adhesion length at which a share remains on a surface.

    The pair that is judged has the true one.
    """
    unit = HEIGHT_UNIT**2 / LENGTH_UNIT
    material = Material(
        youngs_modulus=WORK_OF_ADHESION / (np.exp(log_length) * unit),
        poisson_ratio=0.0,
        work_of_adhesion=WORK_OF_ADHESION,
        range=range_ * HEIGHT_UNIT,
    )
    judged = judge(
        [material], [surface], wanted_share=SHARES[name], curves=False, thresholds=False
    ).isel(material=0, surface=0)
    value, low, high = read_limited(judged.modulus_threshold)
    # The stiffer the material may be, the less adhesion it needs.
    moduli = {"value": value, "low": high, "high": low}
    # A share that remains at any modulus has no end of its limits there.
    with np.errstate(divide="ignore"):
        return {
            f"{limit}_{name}": float(np.log(WORK_OF_ADHESION / (modulus * unit)))
            for limit, modulus in moduli.items()
        }
