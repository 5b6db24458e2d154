"""Adhesion that remains at zero load on a layer or below a skin, simulated on one rough surface."""

from itertools import product

import numpy as np

from common.conventions import Q0
from common.job import start
from common.model_surfaces import cell_size, make_heights
from limits.measuring import write_rows
from stickiness import surface
from stickiness.remaining.roughness import Roughness
from stickiness.remaining.zero_load import share_at_zero_load
from stickiness.solids import Film, Layer, Skin
from stickiness.spectrum import SpectrumFamily
from stickiness.traction_laws import LAWS

TOLERANCE = 3e-3  # of thin layers; the energy of a state is off by the square of it


def main(job):
    write_rows(job, measure)


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


def measure(setting, seed, campaign):
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
        "rms_slope": rough.rms_slope,
        "q1": spectrum.q1,
        "relative_compliance": rough.relative_compliance,
        "flow": rough.flow,
    }
    widths = campaign["pixels_in_zone"][setting["kind"]]
    # As numbers of numpy, whose powers differ from Python's in the last bit.
    for ratio, pixels in product(np.array(campaign["energies"]), widths):
        adhesion_length = ratio * of_surface["full_contact_energy"]
        # Solids that are stiff to long waves would attract across the whole gap at such a zone.
        range_ = np.sqrt(pixels * pixel * ratio * of_surface["half_space_energy"])
        law = LAWS[campaign["law"]](adhesion_length, range_)
        yield {
            **of_surface,
            "energy_ratio": ratio,
            "pixels_in_zone": pixels,
            "adhesion_length": adhesion_length,
            "range": range_,
            "simulated": share_at_zero_load(heights, length, law, solid=solid, tol=TOLERANCE),
        }


if __name__ == "__main__":
    main(start(globals()))
