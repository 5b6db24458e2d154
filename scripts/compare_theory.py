"""Theory on the lattice spectrum of a case against its simulation, with the errors of both."""

import numpy as np
import xarray as xr

from _job import start
from _model import DESCRIBED
from stickiness import datasets

COMPARED = ("area_fraction", "mean_gap", "attractive_area")


def main(job):
    simulated = datasets.read(job.input.ensemble, [f"{name}_mean" for name in COMPARED])
    theory = datasets.read(job.input.theory, COMPARED)
    dataset = xr.Dataset()
    for name in COMPARED:
        mean = simulated[f"{name}_mean"].where(simulated[f"{name}_mean"] > 0)
        errors = [
            simulated[f"{name}_{kind}"] for kind in ("standard_error", "discretisation_error")
        ]
        ratio = theory[name] / mean
        dataset[f"{name}_difference"] = ratio - 1
        dataset[f"{name}_difference_error"] = ratio * np.hypot(*errors) / mean
    datasets.write(
        annotated(dataset),
        job.output[0],
        title="theory on the lattice spectrum against simulation",
        parameters=datasets.parameters(simulated),
    )


def annotated(dataset):
    texts = {name: DESCRIBED[name] for name in ("pressure", "range")}
    texts["variant"] = ("1", "variant of the theory")
    for name in COMPARED:
        text = f"theory over simulation less 1: {DESCRIBED[name][1]}"
        texts[f"{name}_difference"] = ("1", text, "nothing simulated within the range")
        texts[f"{name}_difference_error"] = (
            "1",
            f"{text}: sampling and discretisation error in quadrature",
            "nothing simulated within the range, or a single seed",
        )
    return datasets.annotate(dataset, **texts)


if __name__ == "__main__":
    main(start(globals(), "compare_theory", case="H0.8_zeta64"))
