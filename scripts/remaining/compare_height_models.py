"""What remains of adhesion by every model, on surfaces of one spectrum with different heights."""

from dataclasses import replace

import numpy as np
import xarray as xr
from scipy import stats

from campaigns.heights import bound_share, press
from common.clock import time_task
from common.conventions import Q0, annotate
from common.job import start
from common.model_surfaces import cell_size, grid_points, make_heights, skewness_of, waves_across
from stickiness import datasets, surface
from stickiness.adhesive.edge_zone import COARSEST
from stickiness.remaining import height_simulation
from stickiness.remaining.roughness import Roughness
from stickiness.remaining.zero_load import share_at_zero_load
from stickiness.traction_laws import Exponential
from stickiness.verdicts.simulated_surface import find_lacking

PIXELS_PER_WAVELENGTH = 4
REMAINS = "share of the work of adhesion that remains: "
SECONDS = "processor time: "
MODELS = {
    "theory": "theory of the spectrum, for Gaussian heights",
    "bound": "lower bound by contact without adhesion",
    "states": "states simulated with adhesion",
    "simulated": "full simulation, the deepest state of four starts",
}
COMPARED_VARIABLES = {
    "skewness": "skewness that was prescribed",
    "height_skewness": "skewness of the heights",
    "height": "height over h_rms",
    "energy_ratio": "work of adhesion over elastic energy of full contact",
    "simulated_energy_ratio": "the same, of full simulations",
    "full_contact_energy": "elastic energy of full contact over E* q0 h_rms^2",
    "range": "range over h_rms, the shortest that the grid resolves",
    "limit": "which limit, or the value itself",
    **{model: f"{REMAINS}{text}" for model, text in MODELS.items()},
    "simulated": ("1", f"{REMAINS}{MODELS['simulated']}", "no state converged"),
    **{f"seconds_{model}": ("s", f"{SECONDS}{text}") for model, text in MODELS.items()},
}


def main(job):
    params = job.params
    # Compile the loops before any time is taken.
    coarse = make_heights(params.surfaces[0], 2 * waves_across(params.surfaces[0]), params.seed)
    height_simulation.find_trial_states(coarse, cell_size(params.surfaces[0]))
    compared = [compare(each, params) for each in params.surfaces]
    skewness = [skewness_of(each) for each in params.surfaces]
    dataset = xr.concat(compared, xr.DataArray(skewness, dims="skewness", name="skewness"))
    datasets.write(
        annotate(dataset, **COMPARED_VARIABLES),
        job.output[0],
        title="adhesion that remains on skewed heights of one spectrum, by every model",
        parameters={**params.surfaces[0], "heights": {"skewness": skewness}, "seed": params.seed},
    )


def compare(setting, params):
    """What remains on one surface by every model, and the processor time that each takes."""
    length = cell_size(setting)
    points = grid_points(setting, PIXELS_PER_WAVELENGTH)
    heights = make_heights(setting, points, params.seed)
    spectrum = surface.realised_spectrum(heights, length)
    energy = spectrum.elastic_energy()
    lengths = energy * np.asarray(params.energies)
    ranges = find_shortest_range(lengths, length / points)

    rough = Roughness(
        h_rms=1.0,
        q0=Q0,
        elastic_energy=energy,
        q1=Q0 * setting["magnification"],
        rms_slope=spectrum.rms_slope,
    )
    theory, seconds_theory = time_task(list_limits, rough, lengths, ranges)
    contacts, seconds_bound = time_task(press, heights, length, spectrum.rms_slope)
    states, seconds_states = time_task(simulate, heights, length, rough)
    simulated, seconds_simulated = time_task(
        find_shares, heights, length, energy * np.asarray(params.simulated_energies)
    )
    bounds = [bound_share(contacts, law) for law in map(Exponential, lengths, ranges)]
    return xr.Dataset(
        {
            "height": (("x", "y"), heights, {}, {"zlib": True}),
            "height_skewness": stats.skew(heights, axis=None),
            "full_contact_energy": energy,
            "range": ("energy_ratio", ranges),
            "theory": (("limit", "energy_ratio"), theory),
            "bound": ("energy_ratio", bounds),
            "states": (("limit", "energy_ratio"), list_limits(states, lengths, ranges)),
            "simulated": ("simulated_energy_ratio", simulated),
            "seconds_theory": seconds_theory,
            "seconds_bound": seconds_bound,
            "seconds_states": seconds_states,
            "seconds_simulated": seconds_simulated,
        },
        coords={
            "energy_ratio": params.energies,
            "simulated_energy_ratio": params.simulated_energies,
            "limit": ["low", "value", "high"],
        },
    )


def find_shortest_range(adhesion_length, pixel):
    """Shortest range of attraction whose cohesive zone the grid resolves."""
    return np.sqrt(pixel * adhesion_length / COARSEST)


def list_limits(model, lengths, ranges):
    """Share by a `Roughness`: its low limit, its value and its high limit."""
    value, low, high = model.limit_share(lengths, ranges)
    return [low, value, high]


def simulate(heights, length, rough):
    """`Roughness` by states simulated on the heights."""
    simulated = height_simulation.simulate_heights(heights, (length, length))
    lacking = float(find_lacking(simulated))
    return replace(rough, simulated=simulated, lacking=lacking)


def find_shares(heights, length, lengths):
    """Share that remains by full simulation, for every adhesion length."""
    ranges = find_shortest_range(lengths, length / len(heights))
    laws = map(Exponential, lengths, ranges)
    return [share_at_zero_load(heights, length, law) for law in laws]


if __name__ == "__main__":
    main(start(globals()))
