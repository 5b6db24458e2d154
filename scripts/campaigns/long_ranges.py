"""What remains where attraction reaches across much of the roughness, as between polished surfaces.

Heights and ranges are over h_rms, energies and adhesion lengths over q0 h_rms^2, shares over the
work of adhesion.
"""

from itertools import product

from campaigns.columns import OF_TOPOGRAPHY, find_side
from common.conventions import Q0
from common.topographies import make_set
from stickiness import surface
from stickiness.remaining.zero_load import share_at_zero_load
from stickiness.traction_laws import LAWS

COLUMNS = OF_TOPOGRAPHY | {
    "full_contact_energy": "elastic energy of full contact",
    "rms_slope": "rms gradient",
    "q1": "largest wave number",
    "highest": "the highest of the heights",
    "energy_ratio": "work of adhesion over full_contact_energy",
    "adhesion_length": "work of adhesion over the modulus",
    "range": "of the attraction",
    "simulated": "share that remains in the deepest state of four starts",
}


def measure(setting, seed, shared):
    """Rows of all works of adhesion and ranges."""
    heights = make_set(setting, seed)
    length = find_side(setting)
    spectrum = surface.realised_spectrum(heights, length)
    energy = spectrum.elastic_energy()
    of_surface = {
        "full_contact_energy": energy,
        "rms_slope": spectrum.rms_slope,
        "q1": Q0 * setting["points"] / setting["shortest"] / setting["waves"],
        "highest": heights.max(),
    }
    for ratio, range_ in product(shared["energies"], shared["ranges"]):
        law = LAWS[shared["law"]](ratio * energy, range_)
        yield {
            **of_surface,
            "energy_ratio": ratio,
            "adhesion_length": law.adhesion_length,
            "range": law.range,
            "simulated": share_at_zero_load(heights, length, law),
        }
