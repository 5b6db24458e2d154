"""What would make pairs stick, as `stickiness.thresholds` says it, with the limits of verdicts."""

from dataclasses import fields, replace
from functools import cache

import numpy as np

from common.materials import read_material
from common.verdicts import find_limits, find_value
from criteria.pair_roughness import ENDS, conform, find_spectra, read_draws
from criteria.verdicts import DIMS, draw_errors, find_quantiles
from stickiness import datasets
from stickiness.criteria import thresholds as questions
from stickiness.criteria.a_v_table import RANGES
from stickiness.criteria.pair import MOST_STRAIN, SIGNS
from stickiness.remaining.prediction import DEFAULT_SHARE, Roughness
from stickiness.solids import HALF_SPACE
from stickiness.solids.moduli import choose_factor
from stickiness.statistics import COVERS

THRESHOLD = "modulus_threshold"
ASKED = {  # unit, description, and why a value may be missing
    "rms_height_threshold": ("m", "rms height below which the wanted share remains", "unknown"),
    "thickness_threshold": ("m", "thickness above which the wanted share remains", "no layer"),
    "rate_threshold": ("Hz", "frequency below which the wanted share remains", "elastic, or dwell"),
    "contact_pressure": (
        *("Pa", f"mean pressure that makes {questions.CONTACT_AREA:.0%} contact without adhesion"),
        "not judged",
    ),
}


def find_thresholds(verdicts, surface, material_surfaces, entries):
    """Add the thresholds of every material on an analysed surface to their `verdicts`.

    Values and limits are as of `find_value` and `find_limits`. 0 and infinity: no value sticks, or
    every one.
    """
    found = []
    for name, entry in entries.items():
        solid, pair = read_material(entry), verdicts.sel(material=name).squeeze("surface")
        second = material_surfaces.get(solid.surface)
        rough, spectra = conform(solid, surface, second), find_spectra(surface, second)
        known = pair.not_judged == ""
        found.append(find_pair(solid, pair, rough, spectra) if known else np.full((4, 3), np.nan))
    table = np.moveaxis(found, 0, -1)[..., None]  # (asked, limit, material, surface)
    for (name, texts), values in zip(ASKED.items(), table, strict=True):
        for end, value in zip(SIGNS, values, strict=True):
            verdicts[f"{name}{end}"] = DIMS[:2], value
            datasets.annotate(verdicts, **{f"{name}{end}": texts})
    return verdicts


def find_pair(solid, pair, rough, spectra):
    """Value, low and high limit of all that is `ASKED`, for a `Material` on roughness."""
    layer, draws = solid.solid, read_draws(rough, solid.law)
    known = [field.name for field in fields(Roughness) if field.name in rough]
    ends = Roughness(**{name: rough[name].values for name in known}, law=solid.law)
    h_rms, q0 = float(np.sqrt(rough.h_rms.prod())), float(rough.q0)
    at = solid.work_of_adhesion / solid.modulus, solid.range

    def scale(rough, factor):
        scaled = rough.scaled(factor[:, None])
        return scaled, layer.strain(scaled.h_rms, scaled.q0)

    def put_on(rough, thickness):
        layers = [replace(layer, thickness=d) for d in thickness]
        energy = np.array([[s.elastic_energy(one) for s in spectra] for one in (layer, *layers)])
        stiffer = energy[1:] / energy[0]
        if rough is draws:  # whose spectra are not kept
            stiffer = np.sqrt(stiffer.prod(axis=1, keepdims=True))
        changed = replace(
            rough,
            elastic_energy=rough.elastic_energy * stiffer,
            relative_compliance=np.array([[one.factor(q0)] for one in layers]),
        )
        return changed, np.array([one.strain(rough.h_rms, rough.q0) for one in layers])

    def search(change, start, stop):
        @cache  # the first places are the same for all limits
        def remain(places):
            """Low limit, value and high limit along the last axis, of the draws or of each end."""
            rough, strain = change(ends if draws is None else draws, np.array(places))
            errors = [-1, 0, 1] if draws is None else [draw_errors(draws)]
            shares = [
                rough.share(*at, error, choose_factor(solid.separation_factor, error))
                for error in errors
            ]
            if draws is not None:
                return find_quantiles(*shares, strain <= MOST_STRAIN)[:, None]
            shares[0] = np.where(strain > MOST_STRAIN, 0.0, shares[0])
            return np.stack(shares, axis=-1)

        def find(end, limit):
            def share(x):
                return remain(tuple(x))[:, end, limit]

            return questions.find_crossing(share, start, stop, DEFAULT_SHARE, last=limit == 2)

        found = np.array([[find(end, limit) for limit in range(3)] for end in which])
        with np.errstate(invalid="ignore"):  # none at one end, any at the other
            return [np.prod(found[:, 1]) ** (1 / len(found)), found.min(), found.max()]

    which = range(len(ENDS) if draws is None else 1)
    thickness = rate = [np.nan] * 3
    if layer != HALF_SPACE:
        thickness = search(put_on, questions.DEEPEST / spectra[0].band[0], h_rms)
    if solid.depends_on_rate and np.isnan(solid.dwell):
        moduli = find_value(pair, THRESHOLD), *find_limits(pair, THRESHOLD)
        hertz = pair.frequency.values
        rate = [questions.find_rate(solid.plane_strain, float(x), hertz) for x in moduli]
    factors = search(scale, solid.range / (RANGES[-1] * h_rms), questions.ROUGHEST)
    unlike = float(rough.anisotropy_error_factor)
    low, high = np.sort(
        [questions.find_pressures(one, layer, q0, unlike) for one in spectra], axis=0
    )
    # Ends of a measured surface are one standard error from its middle.
    wider = (high[0] / low[0]) ** (0.0 if draws is None else (COVERS - 1) / 2)
    pressure = np.array([np.sqrt(low[0] * high[0]), low[1] / wider, high[2] * wider])
    return np.array([np.multiply(factors, h_rms), thickness, rate, solid.modulus * pressure])
