"""Theory on the lattice spectra of cases against their simulation, with the errors of both.

And the gamma of its corrections that agrees best.
"""

import xarray as xr

from common import conventions
from common.job import start
from fits.fit_gamma import write_gamma
from stickiness import datasets
from stickiness.error_budget import SOURCES, ErrorComponent, not_applicable, part, with_budget

WINDOW = ("highest_summit", "margin", "window_holds")  # of theory's file
COMPARED = ("area_fraction", "mean_gap", "attractive_area", "gap_density")
DIFFERENCE = "theory over simulation less 1"
NOTHING = "nothing simulated within the range"
DIFFERENCE_VARIABLES = {"theory_mean_gap": "mean gap over h_rms that theory predicts"} | {
    f"{name}_difference": ("1", f"{DIFFERENCE}: {conventions.SHARED_VARIABLES[name][1]}", NOTHING)
    for name in COMPARED
}


def main(job):
    files = zip(job.input.ensembles, job.input.theories, job.output.comparisons, strict=True)
    for ensemble, lattice, output in files:
        simulated = datasets.read(ensemble, [f"{name}_mean" for name in COMPARED])
        theory = datasets.read(lattice, [*COMPARED, *WINDOW])
        title = "theory on the lattice spectrum against simulation"
        parameters = datasets.parameters(simulated)
        datasets.write(compare(simulated, theory), output, title=title, parameters=parameters)
    write_gamma(job.input.ensembles, job.output.comparisons, job.output.gamma)


def compare(simulated, theory):
    """Compute relative differences of theory from simulation, with the errors of the simulation."""
    means = {name: simulated[f"{name}_mean"] for name in COMPARED}
    means = {name: mean.where(mean > 0) for name, mean in means.items()}
    dataset = xr.Dataset({f"{n}_difference": theory[n] / mean - 1 for n, mean in means.items()})
    dataset = conventions.annotate(
        dataset.assign(theory_mean_gap=theory.mean_gap), **DIFFERENCE_VARIABLES
    )
    for name, mean in means.items():
        scale = theory[name] / mean**2
        parts = {
            s: ErrorComponent(scale * part(simulated, f"{name}_mean", s), "of the simulation")
            for s in SOURCES
        }
        parts["model"] = not_applicable("the difference is the error of the model")
        dataset = with_budget(dataset, f"{name}_difference", **parts)
    return dataset.assign(theory[list(WINDOW)])


if __name__ == "__main__":
    main(start(globals()))
