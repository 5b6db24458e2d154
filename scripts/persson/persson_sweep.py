"""Persson's theory on continuous self-affine spectra, over a configured sweep, and its a_V."""

from itertools import product

import numpy as np
import xarray as xr

from common.conventions import annotate, logarithmic_grid
from common.derived_quantities import write_a_v
from common.error_budgets import QUADRATURE, theory_parts
from common.job import start
from common.model_surfaces import make_spectrum
from common.theory_variants import evaluate, theories
from stickiness import datasets
from stickiness.accuracy.error_models import read_models
from stickiness.error_budget import with_budget


def main(job):
    outputs = zip(job.params.sweeps, job.output.theory, job.output.a_v, strict=True)
    for sweep, theory_file, a_v_file in outputs:
        write_sweep(sweep, job.params, job.input.laws, theory_file)
        write_a_v(theory_file, a_v_file, job.params.windows, job.input.laws)


def write_sweep(sweep, params, laws, output):
    """Write theory over one sweep."""
    ranges = logarithmic_grid(params.gaps)
    hursts = np.array(sweep["hurst"], dtype=float)
    magnifications = np.array(sweep["magnification"], dtype=float)
    parts = []
    for hurst, magnification in product(hursts, magnifications):
        spectrum = make_spectrum(float(hurst), float(magnification))
        variants = theories(spectrum, params.variants, params.gamma)
        parts += [evaluate_sweep(theory, sweep, ranges) for theory in variants.values()]
    axes = {"hurst": hursts, "magnification": magnifications, "variant": list(variants)}
    dataset = stack(parts, axes).sortby(list(axes)).transpose("variant", ...)
    dataset = annotate(dataset)
    models = read_models(laws)
    for name in QUADRATURE:
        value = dataset[name].assign_coords(pressure=dataset.pressure)
        dataset = with_budget(dataset, name, **theory_parts(models, name, value))
    title = "Persson's theory on continuous self-affine spectra"
    parameters = {**sweep, "variants": params.variants, "gamma": params.gamma}
    datasets.write(dataset, output, title=title, parameters=parameters)


def stack(parts, axes):
    """Join datasets that are in the order of the product of all axes; far faster than by xarray."""
    shape = [len(points) for points in axes.values()]
    data = {}
    for name, first in parts[0].data_vars.items():
        values = np.array([part[name].values for part in parts])
        data[name] = (*axes, *first.dims), values.reshape(*shape, *first.shape)
    return xr.Dataset(data, coords=parts[0].coords.assign(axes))


def evaluate_sweep(theory, sweep, ranges):
    """Evaluate theory at the loads of a sweep, which are pressures or mean gaps."""
    if sweep["pressure"]:
        pressures = np.array(sweep["pressure"], dtype=float)
    else:
        pressures = np.array([theory.pressure_at(gap) for gap in sweep["mean_gap"]])
    contact = evaluate(theory, pressures, ranges).rename_dims(pressure="load")
    contact = contact.reset_index("pressure").reset_coords("pressure")
    return contact.assign(rms_curvature=theory.spectrum.rms_curvature)


if __name__ == "__main__":
    main(start(globals()))
