"""Adhesion that remains on one rough surface at zero load, and states simulated on its heights."""

import logging
import time
from itertools import product

import numpy as np
import xarray as xr
from scipy import stats
from scipy.special import erfinv

from common.conventions import Q0, annotate
from common.job import start
from common.model_surfaces import cell_size, make_heights, waves_across
from stickiness import datasets, repulsive, surface
from stickiness.measured import periodic
from stickiness.remaining.height_simulation import CONTACT_AREAS, simulate_heights
from stickiness.remaining.zero_load import share_at_zero_load
from stickiness.traction_laws import LAWS
from stickiness.verdicts.simulated_surface import find_lacking, tabulate_simulated
from stickiness.verdicts.surface_data import SURFACE_VARIABLES

TRANSFORMS = {
    "squared": np.square,
    "-squared": lambda heights: -np.square(heights),
    "valleys cut": lambda heights: np.maximum(heights, -0.5),
    "tops cut": lambda heights: np.minimum(heights, 0.5),
    "exp": np.exp,
    "-exp": lambda heights: -np.exp(heights),
}
TOLERANCE = 1e-4
HEIGHT_VARIABLES = {
    "simulated": ("1", "largest gain of energy over the work of adhesion", "none converged"),
    "bound": "the same of contacts without adhesion",
    "energy": "work of adhesion over elastic energy of full contact of this surface",
    "pixels_in_zone": "width of the cohesive zone in pixels",
    "adhesion_length": "adhesion length over q0 h_rms^2",
    "range": "range over h_rms",
    "full_contact_energy": "elastic energy of full contact over E* q0 h_rms^2",
    "skewness": SURFACE_VARIABLES["skewness"],
    "kurtosis": SURFACE_VARIABLES["kurtosis"],
    "lacking": "energy of waves that the states lack over that of the others",
    "seconds_simulated": ("s", "processor time of a simulation"),
    "seconds_bound": ("s", "processor time of the contacts without adhesion"),
    "seconds_states": ("s", "processor time of the states simulated on the heights"),
}


def main(job):
    setting = job.params.surface
    seed = int(job.wildcards.seed)
    length = cell_size(setting)
    heights = transform_heights(setting, seed)
    spectrum = surface.realised_spectrum(heights, length)
    dataset = measure(heights, length, spectrum, job.params)
    dataset = dataset.merge(simulate(heights, length, setting))
    dataset["full_contact_energy"] = spectrum.elastic_energy()
    dataset["rms_slope"] = spectrum.rms_slope
    dataset["skewness"] = stats.skew(heights, axis=None)
    dataset["kurtosis"] = stats.kurtosis(heights, axis=None, fisher=False)
    dataset = annotate(dataset, **SURFACE_VARIABLES | HEIGHT_VARIABLES)
    title = "adhesion that remains on one rough surface at zero load"
    parameters = {**setting, "seed": seed, "law": job.params.law}
    datasets.write(dataset, job.output[0], title=title, parameters=parameters)


def transform_heights(setting, seed):
    """Heights over h_rms of one realisation, transformed and limited to its band."""
    points = setting["points"]
    if setting["transform"] is None:
        return make_heights(setting, points, seed)
    # Transforms make shorter waves: a finer grid keeps these from those of the band.
    fine = make_heights(setting, 2 * points, seed)
    transformed = TRANSFORMS[setting["transform"]](fine)
    rounding = 1e-6
    q_max = setting["magnification"] * Q0 * (1 + rounding)
    pixels = points / waves_across(setting) * (1 - 2 * rounding)
    sides = (cell_size(setting), cell_size(setting))
    heights = periodic.band_limited(transformed - transformed.mean(), sides, q_max, pixels)
    return heights / heights.std()


def measure(heights, length, spectrum, params):
    """Simulate every work of adhesion and range; beside it, the bound without adhesion."""
    began = time.process_time()
    contacts = press(heights, length, spectrum.rms_slope)
    seconds_bound = time.process_time() - began
    axes = {"energy": params.energies, "pixels_in_zone": params.pixels_in_zone}
    pixel = length / heights.shape[0]
    rows = []
    for ratio, pixels in product(*axes.values()):
        adhesion_length = ratio * spectrum.elastic_energy()
        law = LAWS[params.law](adhesion_length, np.sqrt(pixels * pixel * adhesion_length))
        began = time.process_time()
        share = share_at_zero_load(heights, length, law)
        row = {
            "adhesion_length": adhesion_length,
            "range": law.range,
            "simulated": share,
            "seconds_simulated": time.process_time() - began,
            "bound": bound_share(contacts, law),
        }
        logging.info("w/U %g, %g pixels in the zone: %s", ratio, pixels, row)
        rows.append(row)
    shape = [len(axis) for axis in axes.values()]
    values = {key: (tuple(axes), np.reshape([row[key] for row in rows], shape)) for key in rows[0]}
    return xr.Dataset({**values, "seconds_bound": seconds_bound}, coords=axes)


def press(heights, length, slope):
    """Elastic energies and gaps of contacts without adhesion, at the loads of the library."""
    loads = slope * erfinv(CONTACT_AREAS) / np.sqrt(2)
    contacts = []
    for contact in repulsive.load_path(heights, length, loads, tol=TOLERANCE):
        displacement = contact.gap + heights - contact.shift
        contacts.append((np.mean(contact.pressure * displacement) / 2, contact.gap))
    return contacts


def bound_share(contacts, law):
    """Share that remains in the deepest of these contacts: no less does in simulation."""
    gains = [-np.mean(law.potential(gap)) - energy for energy, gap in contacts]
    return max(*gains, 0.0) / law.adhesion_length


def simulate(heights, length, setting):
    """States simulated on the heights, on half of the grid, and what their waves lack."""
    began = time.process_time()
    simulated = simulate_heights(heights, (length, length), most_points=setting["points"] // 2)
    dataset = tabulate_simulated(simulated)
    dataset["seconds_states"] = time.process_time() - began
    dataset["lacking"] = float(find_lacking(simulated))
    return dataset


if __name__ == "__main__":
    main(start(globals()))
