"""Adhesion that remains at zero load on a layer or below a skin, simulated on one rough surface."""

import logging
from itertools import product

import numpy as np
import xarray as xr

from common.conventions import Q0, annotate
from common.job import start
from common.model_surfaces import cell_size, make_heights
from stickiness import datasets, surface
from stickiness.remaining.solid_response import find_relative_compliance
from stickiness.remaining.thin_layers import find_flow
from stickiness.remaining.zero_load import share_at_zero_load
from stickiness.solids import Film, Layer, Skin
from stickiness.traction_laws import LAWS

TOLERANCE = 3e-3  # of thin layers; the energy of a state is off by the square of it
SOLID_VARIABLES = {
    "energy_ratio": "work of adhesion over elastic energy of full contact on this solid",
    "pixels_in_zone": "width of the cohesive zone in pixels, for that ratio on a half-space",
    "adhesion_length": "adhesion length over q0 h_rms^2",
    "range": "range over h_rms",
    "simulated": ("1", "largest gain of energy over the work of adhesion", "not converged"),
    "full_contact_energy": "elastic energy of full contact over E* q0 h_rms^2",
    "half_space_energy": "the same on a half-space",
    "q1": "largest wave number of the surface over q0",
    "relative_compliance": "see stickiness.remaining.solid_response.find_relative_compliance",
    "flow": "see stickiness.remaining.thin_layers.find_flow",
}


def main(job):
    setting = job.params.surface
    seed = int(job.wildcards.seed)
    heights = make_heights(setting, setting["points"], seed)
    dataset = measure(heights, cell_size(setting), make_solid(setting), job.params)
    dataset = annotate(dataset, **SOLID_VARIABLES)
    title = "adhesion that remains on a layer or below a skin"
    datasets.write(dataset, job.output[0], title=title, parameters={**setting, "seed": seed})


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


def measure(heights, length, solid, params):
    """Simulate every work of adhesion and range, with what theory needs to know of the surface."""
    spectrum = surface.realised_spectrum(heights, length)
    full_contact_energy = spectrum.elastic_energy(solid)
    half_space_energy = spectrum.elastic_energy()
    pixel = length / heights.shape[0]
    axes = {"energy_ratio": params.energies, "pixels_in_zone": params.pixels_in_zone}
    shape = [len(axis) for axis in axes.values()]
    adhesion_lengths = np.empty(shape)
    ranges = np.empty(shape)
    shares = np.empty(shape)
    for (i, ratio), (j, pixels) in product(*map(enumerate, axes.values())):
        adhesion_lengths[i, j] = ratio * full_contact_energy
        # Solids that are stiff to long waves would attract across the whole gap at such a zone.
        ranges[i, j] = np.sqrt(pixels * pixel * ratio * half_space_energy)
        law = LAWS[params.law](adhesion_lengths[i, j], ranges[i, j])
        shares[i, j] = share_at_zero_load(heights, length, law, solid=solid, tol=TOLERANCE)
        logging.info("w/U %g, %g pixels: %g of w remains", ratio, pixels, shares[i, j])
    return xr.Dataset(
        {
            "adhesion_length": (tuple(axes), adhesion_lengths),
            "range": (tuple(axes), ranges),
            "simulated": (tuple(axes), shares),
            "full_contact_energy": full_contact_energy,
            "half_space_energy": half_space_energy,
            "rms_slope": spectrum.rms_slope,
            "q1": spectrum.q1,
            "relative_compliance": find_relative_compliance(spectrum, solid, Q0),
            "flow": find_flow(solid, Q0),
        },
        coords=axes,
    )


if __name__ == "__main__":
    main(start(globals()))
