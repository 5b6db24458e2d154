"""Persson's theory on the lattice spectrum that the window of a simulated case holds."""

import numpy as np
import xarray as xr

from pipeline.conventions import annotate, cell_size, logarithmic_grid, model_spectrum
from pipeline.error_budgets import QUADRATURE, theory_parts
from pipeline.job import start
from pipeline.theory import evaluate, theories
from stickiness.accuracy.error_models import read_models
from stickiness.core import datasets
from stickiness.core.budget import with_budget
from stickiness.surfaces.synthesis import lattice_spectrum


def main(job):
    asked = job.params.surface
    lattice = lattice_spectrum(model_spectrum(asked), cell_size(asked))
    pressures, ranges = np.sort(job.params.pressures), logarithmic_grid(job.params.gaps)
    named = theories(lattice, job.params.variants, job.params.gamma)
    parts = [evaluate(theory, pressures, ranges) for theory in named.values()]
    names = xr.DataArray(list(named), dims="variant", name="variant")
    dataset = xr.concat(parts, names).assign(rms_slope=lattice.rms_slope)
    text = "rms gradient of the lattice spectrum over q0 h_rms"
    dataset = annotate(dataset, rms_slope=("1", text))
    models = read_models(job.input.laws)
    for name in QUADRATURE:
        dataset = with_budget(dataset, name, **theory_parts(models, name, dataset[name], asked))
    datasets.write(
        dataset,
        job.output[0],
        title="Persson's theory on the lattice spectrum of a case",
        parameters={**asked, "case": job.wildcards.compared, "gamma": job.params.gamma},
    )


if __name__ == "__main__":
    main(start(globals(), "persson_lattice", compared="H0.8_zeta64"))
