"""What scans tell of a larger contact: thresholds of patches, judged for the whole surface."""

import logging

import numpy as np
from scipy import stats

from common.conventions import Q0
from common.job import start
from limits.measure_patches import cut
from limits.measuring import THRESHOLDS, write_rows
from limits.trial_thresholds import SHARES, find_log_thresholds
from stickiness.entries.material import Material
from stickiness.remaining.height_simulation import find_trial_states
from stickiness.verdicts.judgement import judge
from stickiness.verdicts.limits import read_limited
from stickiness.verdicts.longer_waves import lengthen
from stickiness.verdicts.rough_surface import Surface

HEIGHT_UNIT = 1e-7  # m, of heights over h_rms
LENGTH_UNIT = 1e-5  # m, of lengths over 1/q0
WORK_OF_ADHESION = 0.05  # J/m^2
SHORTEST_FITTED = 4.0  # pixels: a fit goes up to half the Nyquist wave number
JUDGED = ("10", "30")  # thresholds that are judged, by the ends of their names
NO_VERDICT = "the patch is not judged"
FOUND = ("found_hurst", "found_rolloff", "longer", "shape", "unevenness")
PREDICTED = {
    f"{limit}_{name}": ("1", f"{limit} of ln of that adhesion length, predicted", NO_VERDICT)
    for name in JUDGED
    for limit in ("value", "low", "high")
}
LARGER_VARIABLES = {
    "row": "patch",
    "parts": "patches along a side of the surface",
    "patch": "number of the patch among those of its size",
    "skewness": "of the patch",
    "is_judged": "1 if the patch has a verdict",
    "found_hurst": ("1", "Hurst exponent fitted to the patch", NO_VERDICT),
    "found_rolloff": ("1", "wave number of the roll-off that the fit shows, over q0", "none"),
    "is_simulated": "1 if contact is simulated on the heights of the patch",
    "longer": ("1", "share of the energy in longer waves than the patch's, predicted", NO_VERDICT),
    "shape": ("1", "ln of the factor that the shape of the heights makes", NO_VERDICT),
    "unevenness": ("1", "scatter of ln of the mean square slope among quarters", NO_VERDICT),
    **PREDICTED,
    "range": "range over h_rms of the surface",
    "whole_skewness": "of the surface",
    "whole_full_contact_energy": "elastic energy of full contact of the surface",
    **{f"whole_threshold_{name}": texts for name, texts in THRESHOLDS.items()},
}


def main(job):
    write_rows(
        job,
        measure,
        LARGER_VARIABLES,
        title="what patches of a surface tell of contact with all of it",
    )


def measure(heights, setting, params):
    """Rows of all patches, beside what remains on the whole surface."""
    side = setting["waves"] * 2 * np.pi / Q0
    states = find_trial_states(heights, side, pull=False)
    thresholds = find_log_thresholds(states, params.range)
    of_whole = {
        "range": params.range,
        "whole_skewness": stats.skew(heights, axis=None),
        "whole_full_contact_energy": states.full_contact_energy,
        **{f"whole_threshold_{name}": value for name, value in thresholds.items()},
    }
    pixel = side / setting["points"]
    shortest = min(setting["shortest"], SHORTEST_FITTED) * pixel
    for parts in setting["parts"]:
        patches = cut(heights, parts, 1, params.patches)
        for number, patch in enumerate(patches):
            row = judge_patch(patch, side / parts, side, shortest, params.range, thresholds)
            logging.info("1/%d, patch %d: %s", parts, number, row)
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
    row = {"skewness": stats.skew(patch, axis=None), "is_judged": int(not surface.not_judged)}
    row |= dict.fromkeys((*FOUND, *PREDICTED), np.nan) | {"is_simulated": 0}
    if surface.not_judged:
        logging.info("not judged: %s", surface.not_judged)
        return row
    longer = float(np.median(surface.data.get("longer_energy_draws", 0.0)))
    row |= {
        "found_hurst": float(surface.data.hurst),
        "found_rolloff": float(surface.data.get("q_rolloff", np.nan)) * LENGTH_UNIT / Q0,
        "is_simulated": int(surface.simulated is not None),
        "longer": longer / (1 + longer),
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
    return {
        f"{limit}_{name}": float(np.log(WORK_OF_ADHESION / (modulus * unit)))
        for limit, modulus in moduli.items()
    }


if __name__ == "__main__":
    main(start(globals()))
