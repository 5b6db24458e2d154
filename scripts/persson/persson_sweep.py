"""Persson's theory on continuous self-affine spectra, over a configured sweep, and its a_V."""

from itertools import product

import numpy as np
import xarray as xr

from common.conventions import annotate, logarithmic_grid
from common.error_budgets import QUADRATURE, theory_parts
from common.job import start
from common.model_surfaces import model_spectrum
from common.quantities import write_a_v
from common.theory import evaluate, theories
from stickiness import datasets
from stickiness.accuracy.error_models import read_models
from stickiness.error_budget import with_budget


def main(job):
    for sweep, *files in zip(job.params.sweeps, job.output.theory, job.output.a_v, strict=True):
        write_sweep(sweep, job.params, job.input.laws, *files)


def write_sweep(sweep, params, laws, output, a_v):
    """Write theory over one sweep, and a_V fitted to it."""
    ranges = logarithmic_grid(params.gaps)
    axes = {name: np.array(sweep[name], dtype=float) for name in ("hurst", "magnification")}
    parts = []
    for at in product(*axes.values()):
        spectrum = model_spectrum(dict(zip(axes, map(float, at), strict=True)))
        named = theories(spectrum, params.variants, params.gamma)
        parts += [evaluate_sweep(theory, sweep, ranges) for theory in named.values()]
    axes["variant"] = list(named)
    dataset = stack(parts, axes).sortby(list(axes)).transpose("variant", ...)
    dataset, models = annotate(dataset), read_models(laws)
    for name in QUADRATURE:
        value = dataset[name].assign_coords(pressure=dataset.pressure)
        dataset = with_budget(dataset, name, **theory_parts(models, name, value))
    title = "Persson's theory on continuous self-affine spectra"
    parameters = {**sweep, "variants": params.variants, "gamma": params.gamma}
    datasets.write(dataset, output, title=title, parameters=parameters)
    write_a_v(output, a_v, params.windows, laws)


def stack(parts, axes):
    """Datasets in the order of the product of all axes as one; far sooner than by xarray."""
    shape = tuple(map(len, axes.values()))
    data = {}
    for name, first in parts[0].data_vars.items():
        values = np.array([part[name].values for part in parts])
        data[name] = (*axes, *first.dims), values.reshape(*shape, *first.shape)
    return xr.Dataset(data, coords=parts[0].coords.assign(axes))


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
    main(start(globals(), "persson_sweep"))
