"""Adhesion that remains at zero load on heights of many shapes, with what predicts it.

Shares are over the work of adhesion, heights and ranges over h_rms, energies and adhesion lengths
over q0 h_rms^2. Processor times of contacts without adhesion and of states are those for all rows
of a surface, of theory for a share with both limits.
"""

from dataclasses import replace
from itertools import product

import numpy as np
from scipy import stats
from scipy.special import erfinv

from campaigns.columns import OF_TOPOGRAPHY, find_side
from common.clock import time_task
from common.conventions import Q0
from common.topographies import make_set
from stickiness import repulsive, surface
from stickiness.remaining.height_shape import find_height_shape
from stickiness.remaining.height_simulation import CONTACT_AREAS, simulate_heights
from stickiness.remaining.roughness import Roughness
from stickiness.remaining.zero_load import share_at_zero_load
from stickiness.traction_laws import LAWS
from stickiness.verdicts.simulated_surface import find_lacking

PREDICTED = {
    "theory": "share by the spectrum of these heights",
    "shaped": "the same with the law of the skewness",
    "states": "share by states simulated on the heights, on half of the grid",
}
TIMED = {
    "simulated": "processor time of a simulation",
    "bound": "processor time of the contacts without adhesion",
    "states": "processor time of the states",
    "theory": "processor time of theory",
}
COLUMNS = OF_TOPOGRAPHY | {
    "height_skewness": "of log-normal heights",
    "skewness": "of the heights",
    "kurtosis": "of the heights, 3 of Gaussian ones",
    "full_contact_energy": "elastic energy of full contact",
    "rms_slope": "rms gradient",
    "lacking": "energy of waves that the states lack over that of the others",
    "energy_ratio": "work of adhesion over full_contact_energy",
    "zone": "q0 range^2 over adhesion length",
    "range": "of the attraction",
    "adhesion_length": "work of adhesion over the modulus",
    "simulated": "share in the deepest state of four starts",
    "bound": "share in the deepest of the contacts without adhesion",
    **{
        f"{name}{ending}": text + limit
        for name, text in PREDICTED.items()
        for ending, limit in (("", ""), ("_low", ", low limit"), ("_high", ", high limit"))
    },
    **{f"seconds_{name}": ("s", text) for name, text in TIMED.items()},
}
TOLERANCE = 1e-4


def measure(setting, seed, shared):
    """Rows of all works of adhesion and ranges."""
    heights = make_set(setting, seed)
    length = find_side(setting)
    spectrum = surface.realised_spectrum(heights, length)
    contacts, seconds_bound = time_task(press, heights, length, spectrum.rms_slope)
    states, seconds_states = time_task(
        simulate_heights, heights, (length, length), most_points=setting["points"] // 2
    )
    of_surface = {
        "skewness": stats.skew(heights, axis=None),
        "kurtosis": stats.kurtosis(heights, axis=None, fisher=False),
        "full_contact_energy": spectrum.elastic_energy(),
        "rms_slope": spectrum.rms_slope,
        "lacking": float(find_lacking(states)),
        "seconds_bound": seconds_bound,
        "seconds_states": seconds_states,
    }
    q1 = Q0 * setting["points"] / setting["shortest"] / setting["waves"]
    models = list_models(of_surface, states, q1, shared["law"])
    pixel = length / setting["points"]
    for ratio, pixels in product(shared["energies"], shared["pixels_in_zone"]):
        adhesion_length = ratio * of_surface["full_contact_energy"]
        law = LAWS[shared["law"]](adhesion_length, np.sqrt(pixels * pixel * adhesion_length))
        simulated, seconds = time_task(share_at_zero_load, heights, length, law)
        yield {
            **of_surface,
            "energy_ratio": ratio,
            "zone": Q0 * law.range**2 / adhesion_length,
            "range": law.range,
            "adhesion_length": adhesion_length,
            "simulated": simulated,
            "bound": bound_share(contacts, law),
            "seconds_simulated": seconds,
            **predict(models, law),
        }


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


def list_models(of_surface, states, q1, law):
    """`Roughness` by the name of what predicts."""
    theory = Roughness(
        h_rms=1.0,
        q0=Q0,
        elastic_energy=of_surface["full_contact_energy"],
        q1=q1,
        rms_slope=of_surface["rms_slope"],
        law=law,
    )
    shape = find_height_shape(of_surface["skewness"])
    return {
        "theory": theory,
        "shaped": replace(theory, shape=shape.shape, shape_error=shape.error),
        "states": replace(theory, simulated=states, lacking=of_surface["lacking"]),
    }


def predict(models, law):
    """Share with its limits by every model, and the processor time of theory."""
    row = {}
    for name, model in models.items():
        limited, seconds = time_task(model.limit_share, law.adhesion_length, law.range)
        row[name], row[f"{name}_low"], row[f"{name}_high"] = map(float, limited)
        if name == "theory":
            row["seconds_theory"] = seconds
    return row
