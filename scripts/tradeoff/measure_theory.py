"""Persson's theory with more and fewer quadrature nodes on continuous spectra, timed."""

import numpy as np
import xarray as xr

from common.conventions import VARIABLES, logarithmic_grid
from common.job import start
from common.model_surfaces import model_spectrum
from common.theory import contact_of
from stickiness import datasets
from stickiness.persson.theory import Persson
from tradeoff import measuring

REPETITIONS = 3  # of a state, whose least time counts


def main(job):
    nodes, pressures = job.params.nodes, np.array(job.params.pressures)
    ranges, cases, memory = logarithmic_grid(job.params.gaps), [], []
    for name, surface in nodes["surfaces"].items():
        spectrum, rows = model_spectrum(surface), []
        for multiple in nodes["multiples"]:

            def solve(spectrum=spectrum, multiple=multiple):
                return contact_of(Persson(spectrum, nodes=multiple), pressures, ranges)

            states = [measuring.time_task(solve) for _ in range(REPETITIONS)]
            rows.append(states[0][0].assign(seconds=min(seconds for _, seconds in states)))
            memory.append(measuring.measure_memory(solve))
        cases.append(measuring.stack(rows, "nodes", nodes["multiples"]).expand_dims(case=[name]))
    dataset = xr.concat(cases, "case").assign(pair_time=measuring.time_transforms())
    shape = dataset.sizes["case"], dataset.sizes["nodes"]
    dataset["memory"] = ("case", "nodes"), np.reshape(memory, shape)
    names = ("pressure", "range", "area_fraction", "mean_gap", "attractive_area")
    datasets.write(
        datasets.annotate(
            dataset,
            **{name: VARIABLES[name] for name in names},
            case=("1", "surface"),
            nodes=("1", "multiple of the number of quadrature nodes"),
            rms_slope=("1", "rms gradient over q0 h_rms"),
            seconds=("s", "processor time of all loads"),
            pair_time=measuring.SHARED_TEXTS["pair_time"],
            memory=("MB", "largest memory held at once"),
        ),
        job.output[0],
        title="theory with more and fewer quadrature nodes",
        parameters=nodes,
    )


if __name__ == "__main__":
    main(start(globals(), "measure_theory"))
