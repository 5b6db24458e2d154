"""What would make pairs stick, as `stickiness.thresholds` says it, with the limits of verdicts."""

from dataclasses import fields

import numpy as np

from common.materials import read_material
from common.verdicts import find_limits, find_value
from criteria.pair_roughness import conform, find_spectra, read_draws
from criteria.verdicts import DIMS, draw_errors, find_quantiles
from stickiness import datasets
from stickiness.criteria import thresholds as questions
from stickiness.criteria.pair import MOST_STRAIN, SIGNS, Pair
from stickiness.remaining.prediction import Roughness
from stickiness.solids.moduli import choose_factor

OF_CONTACT = f"mean pressure that makes {questions.CONTACT_AREA:.0%} contact without adhesion"
ASKED = {  # unit, description, and why a value may be missing
    "rms_height_threshold": ("m", "rms height below which the wanted share remains", "not known"),
    "thickness_threshold": ("m", "thickness above which the wanted share remains", "no layer"),
    "rate_threshold": ("Hz", "frequency below which the wanted share remains", "elastic, or dwell"),
    "contact_pressure": ("Pa", OF_CONTACT, "not judged"),
}
UNKNOWN = (np.nan,) * len(SIGNS)


def find_thresholds(verdicts, surface, material_surfaces, entries):
    """Add the thresholds of every material on an analysed surface to their `verdicts`.

    Values and limits are as of `find_value` and `find_limits`. 0 and infinity: no value sticks, or
    every one.
    """
    for name, texts in ASKED.items():
        for end in SIGNS:
            verdicts[f"{name}{end}"] = DIMS[:2], np.full((len(entries), 1), np.nan)
            datasets.annotate(verdicts, **{f"{name}{end}": texts})
    for name, entry in entries.items():
        at, solid = {"material": name}, read_material(entry)
        pair = verdicts.sel(at).squeeze("surface")
        if pair.not_judged == "":
            second = material_surfaces.get(solid.surface)
            found = ask(solid, pair, conform(solid, surface, second), find_spectra(surface, second))
            for asked, limited in zip(ASKED, found, strict=True):
                for end, value in zip(SIGNS, limited or UNKNOWN, strict=True):
                    verdicts[f"{asked}{end}"].loc[at] = value
    return verdicts


def ask(solid, judged, rough, spectra):
    """`Threshold` of all that is `ASKED`, or None, of a `Material` on roughness."""
    layer, h_rms, draws = solid.solid, rough.h_rms.values, read_draws(rough, solid.law)
    known = draws or rough.assign(law=solid.law)
    names = [
        field.name for field in fields(Roughness) if getattr(known, field.name, None) is not None
    ]
    known = {name: np.asarray(getattr(known, name)) for name in names}
    pair = Pair(
        **known,
        **{name: getattr(solid, name) for name in ("modulus", "work_of_adhesion", "range")},
        separation_factor=solid.separation_factor,
        layer_strain=layer.strain(known["h_rms"], known["q0"]),
        rms_curvature=np.nan,
        a_v=np.nan,
    )

    def remain(at):
        if draws is None:
            return questions.remain_at_ends(at)
        errors = draw_errors(draws)
        factor = choose_factor(solid.separation_factor, errors)
        shares = at.share(at.adhesion_length, at.range, errors, factor)
        return find_quantiles(shares, at.layer_strain <= MOST_STRAIN)[:, None]

    rate = None
    if solid.depends_on_rate and np.isnan(solid.dwell):
        moduli = find_value(judged, "modulus_threshold"), *find_limits(judged, "modulus_threshold")
        rate = [
            questions.find_rate(solid.plane_strain, float(x), judged.frequency.values, place == 2)
            for place, x in enumerate(moduli)
        ]
    return (
        questions.find_rms_height(pair, float(np.sqrt(h_rms.prod())), remain),
        questions.find_thickness(pair, layer, spectra, remain),
        rate,
        questions.find_pressure(spectra, layer, pair),
    )
