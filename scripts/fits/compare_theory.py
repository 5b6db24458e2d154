"""Theory on the lattice spectra of cases against their simulation, with the errors of both.

Distributions of the gap are compared by the area between the cumulative ones, contact included,

    W1 = int_0^inf |A + int_0^u P du' - the same of theory| du,

which is Wasserstein's distance: the mean length by which gaps would have to be moved to turn one
distribution into the other. It allows for the atom of contact at u = 0 and for an infinite P(0),
needs no bins, has a unit, and bounds the difference of mean gaps.
"""

import numpy as np
import xarray as xr

from common import conventions
from common.ensemble_means import coarse, discretisation_error, ensemble_mean
from common.grid_limits import EXTRAPOLATION
from common.job import start
from stickiness import datasets
from stickiness.error_budget import SOURCES, ErrorComponent, not_applicable, part, with_budget

PARTS = ("area_fraction", "attractive_area")  # of the cumulative distribution
WINDOW = ("highest_summit", "margin", "window_holds")  # of theory's file
COMPARED = ("area_fraction", "mean_gap", "attractive_area", "gap_density")
DISTANCE = "area between the cumulative distributions of the gap (Wasserstein distance) over h_rms"
DIFFERENCE = "theory over simulation less 1"
SINGLE, NOTHING = "a single seed", "nothing simulated within the range"
VARIABLES = {
    "theory_mean_gap": "mean gap over h_rms by theory",
    "distance": DISTANCE,
    "distance_standard_error": ("1", f"{DISTANCE}: standard error", SINGLE),
    "distance_discretisation_error": f"{DISTANCE}: error in the limit of fine grids",
    "distance_floor": ("1", f"{DISTANCE}: mean that sampling errors alone give", SINGLE),
}
VARIABLES |= {
    f"{n}_difference": ("1", f"{DIFFERENCE}: {conventions.VARIABLES[n][1]}", NOTHING)
    for n in COMPARED
}


def main(job):
    inputs = job.input.ensembles, job.input.theories
    for ensemble, lattice, output in zip(*inputs, job.output, strict=True):
        simulated = datasets.read(ensemble, [f"{name}_mean" for name in COMPARED])
        theory = datasets.read(lattice, [*COMPARED, *WINDOW])
        means = {name: simulated[f"{name}_mean"] for name in COMPARED}
        ratios = {name: theory[name] / mean.where(mean > 0) for name, mean in means.items()}
        dataset = xr.Dataset({f"{name}_difference": ratio - 1 for name, ratio in ratios.items()})
        dataset = dataset.merge(distance(simulated, theory)).assign(theory_mean_gap=theory.mean_gap)
        dataset = conventions.annotate(dataset, **VARIABLES)
        datasets.write(
            add_budgets(dataset, simulated, theory).assign(theory[list(WINDOW)]),
            output,
            title="theory on the lattice spectrum against simulation",
            parameters=datasets.parameters(simulated),
        )


def add_budgets(dataset, simulated, theory):
    """Add the errors of the simulation to the differences, which are the error of the theory."""
    model = not_applicable("the difference is the error of the model")
    for name in COMPARED:
        mean = f"{name}_mean"
        scale = theory[name] / simulated[mean].where(simulated[mean] > 0) ** 2
        parts = {
            s: ErrorComponent(scale * part(simulated, mean, s), "of the simulation")
            for s in SOURCES
        }
        dataset = with_budget(dataset, f"{name}_difference", **parts | {"model": model})
    # Student's t, the same for all quantities of an ensemble but for the shares of its levels.
    factor = part(simulated, "mean_gap_mean", "sampling") / simulated.mean_gap_standard_error
    solver = [part(simulated, f"{name}_mean", "solver") for name in PARTS]
    return with_budget(
        dataset,
        "distance",
        discretisation=ErrorComponent(
            dataset.distance_discretisation_error, "in the limit of fine grids"
        ),
        solver=ErrorComponent(integral(np.hypot(*solver)), "of both areas, by the tolerance"),
        sampling=ErrorComponent(factor * dataset.distance_standard_error, "Student's t"),
        bandwidth=not_applicable("one spectrum for both"),
        model=model,
    )


def distance(simulated, theory):
    """W1 with its errors, and the W1 that sampling alone would give.

    Contact and gaps next to it trade places: at large gaps errors of the two areas cancel, for
    together they are all of the surface. So both errors are taken of their sum.
    """
    mean, sampling = ensemble_mean(cumulative(simulated), coarse(simulated, cumulative))
    mean = mean + sum(simulated.get(f"{name}_{EXTRAPOLATION}", 0) for name in PARTS)
    difference = mean - cumulative(theory)
    side = np.sign(difference)

    def moved(solved):
        """W1 of one realisation, were its distribution on the same side as the mean everywhere."""
        return integral(side * cumulative(solved))

    return xr.Dataset(
        {
            "distance": integral(abs(difference)),
            "distance_standard_error": ensemble_mean(moved(simulated), coarse(simulated, moved))[1],
            "distance_discretisation_error": integral(left(simulated)),
            # Mean modulus of a normal deviate.
            "distance_floor": np.sqrt(2 / np.pi) * integral(sampling),
        }
    )


def cumulative(solved):
    """Share of the surface in contact or with a gap up to the range."""
    return solved.area_fraction + solved.attractive_area


def left(simulated):
    """Discretisation error of the cumulative distribution.

    Two bounds, the lower of which holds: the errors left in its parts, as if independent, and the
    change of the sum from half the resolution.
    """
    parts = np.hypot(*(simulated[f"{name}_discretisation_error"] for name in PARTS))
    if simulated.sizes["resolution"] == 1:
        return parts
    return np.minimum(parts, discretisation_error(cumulative(simulated)))


def integral(values):
    """Integral over gaps from 0, below the smallest of which the integrand is held constant."""
    ranges = values["range"].values
    return values.integrate("range") + values.isel(range=0, drop=True) * ranges[0]


if __name__ == "__main__":
    main(start(globals(), "compare_theory"))
