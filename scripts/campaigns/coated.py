"""Adhesion on skins and thin layers, simulated on surfaces whose finest waves a map lacks.

What remains at zero load is simulated on the whole surface. Beside it stands what a user learns of
its map, on which waves that an instrument does not resolve are filtered out and points are thinned.
Lengths along the surface and thicknesses are over 1/q0, heights and ranges over h_rms, energies and
adhesion lengths over q0 h_rms^2, shares over the work of adhesion.
"""

import logging
from dataclasses import replace

import numpy as np

from campaigns.columns import OF_TOPOGRAPHY, find_side
from campaigns.larger import HEIGHT_UNIT, LENGTH_UNIT, LIMIT_TEXTS, WORK_OF_ADHESION
from campaigns.solids import TOLERANCE, make_solid
from common.conventions import Q0
from common.topographies import limit_band, make_set
from stickiness import surface
from stickiness.entries.material import Material
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.remaining.zero_load import share_at_zero_load
from stickiness.traction_laws import LAWS
from stickiness.verdicts.limits import limit_drawn
from stickiness.verdicts.meeting import meet
from stickiness.verdicts.rough_surface import Surface

LEAST_SHARE = 0.002  # that tells of a work of adhesion
SHORTEST_SEEN = 4.0  # shortest wave that a map shows, in its own pixels


COLUMNS = OF_TOPOGRAPHY | {
    "stride": "the map has every n-th point, and no waves shorter than four of its pixels",
    "solid": "as in the configuration of the campaign",
    "thickness": "of the layer or the skin",
    "poisson": "Poisson's ratio of the layer, or below the skin",
    "backing": "what the layer lies on",
    "skin_modulus_ratio": "Young's modulus of the skin over that below",
    "skin_poisson": "Poisson's ratio of the skin",
    "energy_ratio": "work of adhesion over full_contact_energy",
    "pixels_in_zone": "of the cohesive zone that sets the range, for that ratio on a half-space",
    "adhesion_length": "work of adhesion over the modulus",
    "range": "of the attraction",
    "full_contact_energy": "elastic energy of full contact of the surface on the solid",
    "half_space_energy": "the same on a half-space",
    "map_full_contact_energy": "elastic energy of full contact of the map on the solid",
    "map_half_space_energy": "the same on a half-space",
    "simulated": "share that remains on the surface in the deepest state of all starts",
    "is_judged": "0 where a map has no verdict",
    "is_simulated": "1 where states simulated on the map decide",
    "unresolved": "share of the energy in waves that the map lacks, as drawn",
    **{
        limit: f"{text} of ln of the adhesion length that keeps the simulated share, by a verdict "
        "on the map with the end of the waves told, without the error of skins on maps"
        for limit, text in LIMIT_TEXTS.items()
    },
}


def measure(setting, seed, shared):
    """Rows of all solids and works of adhesion, simulated and predicted from the map."""
    heights = make_set(setting, seed)
    length = find_side(setting)
    pixel = length / setting["points"]
    spectrum = surface.realised_spectrum(heights, length)
    shown = scan(heights, setting)
    of_map = surface.realised_spectrum(shown, length)
    judged = Surface.from_heights(
        shown * HEIGHT_UNIT,
        length * LENGTH_UNIT,
        extend_to=setting["shortest"] * pixel * LENGTH_UNIT,
    )
    for name, entry in shared["solids"].items():
        solid = make_solid(entry)
        energies = {
            "full_contact_energy": spectrum.elastic_energy(solid),
            "half_space_energy": spectrum.elastic_energy(),
            "map_full_contact_energy": of_map.elastic_energy(solid),
            "map_half_space_energy": of_map.elastic_energy(),
        }
        for ratio in entry["energies"]:
            zone = entry["pixels_in_zone"] * pixel
            adhesion_length = ratio * energies["full_contact_energy"]
            # As on a half-space: the solids would have a range of many heights.
            range_ = float(np.sqrt(zone * ratio * energies["half_space_energy"]))
            law = LAWS[shared["law"]](adhesion_length, range_)
            share = simulate(heights, length, law, solid)
            yield {
                "solid": name,
                **entry,
                **energies,
                "energy_ratio": ratio,
                "adhesion_length": adhesion_length,
                "range": range_,
                "simulated": share,
                **predict(judged, entry, law, share),
            }


def predict(judged, entry, law, share):
    """What a verdict on the map says of ln of the adhesion length that keeps a share.

    Limits hold all errors but that of skins on maps, which is made of this. A share of which next
    to nothing remains tells nothing.
    """
    if judged.not_judged or not LEAST_SHARE <= share < 1:
        return {"is_judged": int(not judged.not_judged)}
    material = make_material(entry, law)
    meeting = meet(material, judged, DEFAULT_SHARE)
    pair = meeting.pair
    unit = HEIGHT_UNIT**2 / LENGTH_UNIT
    logs = {}
    for name, eta in (("value", 0.0), ("limits", pair.rough.eta)):
        rough = replace(pair.rough, eta=eta, unresolved=0.0)
        logs[name] = np.log(rough.threshold(pair.range, share) / unit)
    low, _, high = limit_drawn(logs["limits"])
    return {
        "is_judged": 1,
        "is_simulated": int(pair.rough.simulated is not None),
        "unresolved": float(np.median(pair.rough.unresolved)),
        "value": float(np.median(logs["value"])),
        "low": low,
        "high": high,
    }


def make_material(entry, law):
    """Material of a user, in SI units."""
    modulus = WORK_OF_ADHESION / (law.adhesion_length * HEIGHT_UNIT**2 / LENGTH_UNIT)
    youngs_modulus = modulus * (1 - entry["poisson"] ** 2)
    thickness = entry["thickness"] / Q0 * LENGTH_UNIT
    if entry["skin_modulus_ratio"] is None:
        solid = {"thickness": thickness, "backing": entry["backing"]}
    else:
        skin_modulus = entry["skin_modulus_ratio"] * youngs_modulus
        skin = {"thickness": thickness, "modulus": skin_modulus, "poisson": entry["skin_poisson"]}
        solid = {"skin": skin}
    return Material(
        youngs_modulus=youngs_modulus,
        poisson_ratio=entry["poisson"],
        work_of_adhesion=WORK_OF_ADHESION,
        range=law.range * HEIGHT_UNIT,
        **solid,
    )


def scan(heights, setting):
    """Heights of the map that an instrument shows of a surface.

    The map has every n-th point, the `stride` of the set. Waves shorter than four of its
    pixels are filtered out before, sharply.
    """
    points = len(heights) // setting["stride"]
    return limit_band(heights, points, points / SHORTEST_SEEN)


def simulate(heights, length, law, solid):
    """Share that remains, not a number where no state was found or the grid would set the edges."""
    try:
        return share_at_zero_load(heights, length, law, solid=solid, tol=TOLERANCE)
    except ValueError as error:
        logging.info("%s: %s", law, error)
        return np.nan
