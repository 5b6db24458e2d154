"""Adhesion that remains at zero load on a layer or below a skin, simulated on one rough surface.

Heights are Gaussian. Lengths along the surface and thicknesses are over 1/q0, wave numbers over q0,
heights and ranges over h_rms, energies and adhesion lengths over q0 h_rms^2, shares over the work
of adhesion.
"""

from itertools import product

import numpy as np

from campaigns.columns import OF_MODEL_SURFACE
from common.conventions import Q0
from common.model_surfaces import cell_size, make_heights
from stickiness import surface
from stickiness.remaining.roughness import Roughness
from stickiness.remaining.zero_load import share_at_zero_load
from stickiness.solids import Film, Layer, Skin
from stickiness.spectrum import SpectrumFamily
from stickiness.traction_laws import LAWS

TOLERANCE = 3e-3  # of thin layers; the energy of a state is off by the square of it


COLUMNS = OF_MODEL_SURFACE | {
    "kind": "layer on a rigid base, film (layer on a film), thin (incompressible and bonded), skin",
    "thickness": "of the layer or the skin",
    "poisson": "Poisson's ratio of the layer, or below the skin",
    "backing": "what the layer lies on",
    "film_modulus_ratio": "Young's modulus of the film over the layer's",
    "film_poisson": "Poisson's ratio of the film",
    "film_thickness": "thickness of the film",
    "skin_modulus_ratio": "Young's modulus of the skin over that below",
    "skin_poisson": "Poisson's ratio of the skin",
    "full_contact_energy": "elastic energy of full contact on the solid",
    "half_space_energy": "the same on a half-space",
    "rigid_base_energy": "the same on a layer whose film does not bend",
    "rms_slope": "rms gradient",
    "q1": "largest wave number",
    "relative_compliance": "over that of a half-space, of a layer on a rigid base",
    "flow": "how far a layer is squeezed out rather than compressed, 0 to 1",
    "energy_ratio": "work of adhesion over full_contact_energy",
    "pixels_in_zone": "of the cohesive zone that sets the range, for that ratio on a half-space",
    "adhesion_length": "work of adhesion over the modulus",
    "range": "of the attraction",
    "simulated": "share that remains in the deepest state of four starts",
}


def make_solid(setting):
    """Layer or skin of a set, lengths in 1/q0."""
    thickness = setting["thickness"] / Q0
    poisson = setting["poisson"]
    if setting["skin_modulus_ratio"] is not None:
        return Skin(thickness, setting["skin_modulus_ratio"], setting["skin_poisson"], poisson)
    if setting["backing"] != "film":
        return Layer(thickness, poisson, setting["backing"])
    film = Film(
        modulus_ratio=setting["film_modulus_ratio"],
        poisson=setting["film_poisson"],
        thickness=setting["film_thickness"] / Q0,
    )
    return Layer(thickness, poisson, film)


def measure(setting, seed, shared):
    """Rows of all works of adhesion and ranges, with what theory needs to know of the surface."""
    heights = make_heights(setting, setting["points"], seed)
    length = cell_size(setting)
    pixel = length / setting["points"]
    solid = make_solid(setting)
    spectrum = surface.realised_spectrum(heights, length)
    rough = Roughness.of(SpectrumFamily.of(spectrum), solid, q0=np.array([Q0])).take(0)
    of_surface = {
        "full_contact_energy": rough.elastic_energy,
        "half_space_energy": rough.half_space_energy,
        "rigid_base_energy": rough.rigid_base_energy,
        "rms_slope": rough.rms_slope,
        "q1": spectrum.q1,
        "relative_compliance": rough.relative_compliance,
        "flow": rough.flow,
    }
    widths = shared["pixels_in_zone"][setting["kind"]]
    # As numbers of numpy, whose powers differ from Python's in the last bit.
    for ratio, pixels in product(np.array(shared["energies"]), widths):
        adhesion_length = ratio * of_surface["full_contact_energy"]
        # Solids that are stiff to long waves would attract across the whole gap at such a zone.
        range_ = np.sqrt(pixels * pixel * ratio * of_surface["half_space_energy"])
        law = LAWS[shared["law"]](adhesion_length, range_)
        yield {
            **of_surface,
            "energy_ratio": ratio,
            "pixels_in_zone": pixels,
            "adhesion_length": adhesion_length,
            "range": range_,
            "simulated": share_at_zero_load(heights, length, law, solid=solid, tol=TOLERANCE),
        }
