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
from stickiness.persson.theory import Persson


def main(job):
    sweep, ranges = job.params.sweep, logarithmic_grid(job.params.gaps)
    named = theories(job.params.variants, job.params.gamma)
    axes = list(named), sweep["hurst"], [float(m) for m in sweep["magnification"]]
    parts = []
    for variant, *at in product(*axes):
        at = dict(zip(("hurst", "magnification"), at, strict=True))
        contact = evaluate_sweep(Persson(model_spectrum(at), **named[variant]), sweep, ranges)
        axis = {name: [value] for name, value in at.items()}
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
