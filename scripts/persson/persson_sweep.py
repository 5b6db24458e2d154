"""Persson's theory on continuous self-affine spectra, over a sweep of the configuration."""

from itertools import product

import numpy as np
import xarray as xr

from pipeline.conventions import annotate, logarithmic_grid, model_spectrum
from pipeline.error_budgets import QUADRATURE, theory_parts
from pipeline.job import start
from pipeline.theory import evaluate, theories
from stickiness.accuracy.error_models import read_models
from stickiness.core import datasets
from stickiness.core.budget import with_budget


def main(job):
    sweep, ranges = job.params.sweep, logarithmic_grid(job.params.gaps)
    parts = []
    for hurst, magnification in product(sweep["hurst"], map(float, sweep["magnification"])):
        at = {"hurst": hurst, "magnification": magnification}
        axis = {name: [value] for name, value in at.items()}
        named = theories(model_spectrum(at), job.params.variants, job.params.gamma)
        for variant, theory in named.items():
            contact = evaluate_sweep(theory, sweep, ranges)
            parts.append(contact.expand_dims(variant=[variant], **axis))
    dataset, models = annotate(xr.combine_by_coords(parts)), read_models(job.input.laws)
    for name in QUADRATURE:
        value = dataset[name].assign_coords(pressure=dataset.pressure)
        dataset = with_budget(dataset, name, **theory_parts(models, name, value))
    datasets.write(
        dataset,
        job.output[0],
        title="Persson's theory on continuous self-affine spectra",
        parameters={**sweep, "variants": job.params.variants, "gamma": job.params.gamma},
    )


def evaluate_sweep(theory, sweep, ranges):
    """Everything at the sweep's loads, which are pressures or mean gaps."""
    if "pressure" in sweep:
        pressures = np.array(sweep["pressure"], dtype=float)
    else:
        pressures = np.array([theory.pressure_at(gap) for gap in sweep["mean_gap"]])
    contact = evaluate(theory, pressures, ranges).rename_dims(pressure="load")
    contact = contact.reset_index("pressure").reset_coords("pressure")
    return contact.assign(rms_curvature=theory.spectrum.rms_curvature)


if __name__ == "__main__":
    main(start(globals(), "persson_sweep", sweep="fig1a"))
