"""Persson's theory with more and fewer quadrature nodes on continuous spectra, timed."""

from functools import partial

import numpy as np
import xarray as xr

from pipeline.conventions import VARIABLES, logarithmic_grid, model_spectrum
from pipeline.job import start
from pipeline.theory import contact_of
from pipeline.tradeoff.measuring import pair_seconds, peak_megabytes, timed
from stickiness.core import datasets
from stickiness.persson.theory import Persson

REPETITIONS = 3  # of a state, whose least time counts


def main(job):
    asked, pressures = job.params.nodes, np.array(job.params.pressures)
    ranges, cases, memory = logarithmic_grid(job.params.gaps), [], []
    for name, surface in asked["surfaces"].items():
        rows = []
        for nodes in asked["multiples"]:
            given = model_spectrum(surface), nodes, pressures, ranges
            states = [timed(partial(state, *given)) for _ in range(REPETITIONS)]
            rows.append(states[0][0].assign(seconds=min(seconds for _, seconds in states)))
            memory.append(peak_megabytes(partial(state, *given)))
        part = xr.concat(rows, xr.DataArray(asked["multiples"], dims="nodes", name="nodes"))
        cases.append(part.expand_dims(case=[name]))
    dataset = xr.concat(cases, "case").assign(pair_time=pair_seconds())
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
            pair_time=("s", "processor time of a pair of transforms of 1024 x 1024 doubles"),
            memory=("MB", "largest memory held at once"),
        ),
        job.output[0],
        title="theory with more and fewer quadrature nodes",
        parameters=asked,
    )


def state(spectrum, nodes, pressures, ranges):
    return contact_of(Persson(spectrum, nodes=nodes), pressures, ranges)


if __name__ == "__main__":
    main(start(globals(), "measure_theory"))
