"""What would make pairs stick, as `stickiness.thresholds` says it, with the limits of verdicts."""

import numpy as np

from common.materials import read_material
from common.verdicts import find_limits, find_value
from criteria.pair_roughness import conform, find_spectra, meet, read_draws, read_ends
from criteria.verdicts import DIMS, remain_of_draws
from stickiness import datasets
from stickiness.criteria import thresholds as questions
from stickiness.criteria.pair import SIGNS

OF_CONTACT = f"mean pressure that makes {questions.CONTACT_AREA:.0%} contact without adhesion"
ASKED = {  # unit, description, and why a value may be missing
    "rms_height_threshold": ("m", "rms height below which the wanted share remains", "not known"),
    "thickness_threshold": ("m", "thickness above which the wanted share remains", "no layer"),
    "rate_threshold": ("Hz", "frequency below which the wanted share remains", "elastic, or dwell"),
    "contact_pressure": ("Pa", OF_CONTACT, "not judged"),
}
UNKNOWN = (None,) * len(ASKED)


def find_thresholds(verdicts, surface, material_surfaces, entries):
    """Add the thresholds of every material on an analysed surface to their `verdicts`.

    Values and limits are as of `find_value` and `find_limits`. 0 and infinity: no value sticks, or
    every one.
    """
    found = []
    for name, entry in entries.items():
        pair, material = verdicts.sel(material=name).squeeze("surface"), read_material(entry)
        second = material_surfaces.get(material.surface)
        answers = ask(material, pair, surface, second) if pair.not_judged == "" else UNKNOWN
        found.append([np.full(len(SIGNS), np.nan) if x is None else x for x in answers])
    for (name, texts), values in zip(ASKED.items(), np.transpose(found, (1, 2, 0)), strict=True):
        for end, value in zip(SIGNS, values, strict=True):
            verdicts[f"{name}{end}"] = DIMS[:2], value[:, None]
            datasets.annotate(verdicts, **{f"{name}{end}": texts})
    return verdicts


def ask(material, judged, surface, second):
    """`Threshold` of all that is `ASKED`, or None, of a `Material` on a surface."""
    rough, spectra = conform(material, surface, second), find_spectra(surface, second)
    draws = read_draws(rough, material)
    pair, remain = meet(material, read_ends(rough)), questions.remain_at_ends
    h_rms = float(rough.h_rms[-1])
    if draws is not None:
        pair, remain = draws, lambda at: remain_of_draws(at)[:, None]
        h_rms = float(np.sqrt(rough.h_rms.prod()))
    return (
        questions.find_rms_height(pair, h_rms, remain),
        questions.find_thickness(pair, material.solid, spectra, remain),
        find_rate(material, judged),
        questions.find_pressure(spectra, material.solid, pair),
    )


def find_rate(material, judged):
    """`Threshold` of the frequency; None if the modulus does not depend on it, or on the dwell."""
    if not material.depends_on_rate or np.isfinite(material.dwell):
        return None
    name = "modulus_threshold"
    moduli = np.sort([find_value(judged, name), *find_limits(judged, name)])
    return questions.find_rate(material.plane_strain, moduli, judged.frequency.values)
