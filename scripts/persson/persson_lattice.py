"""Persson's theory on the lattice spectra of the cells of cases, and its a_V.

The theory's Gaussian heights are unbounded, those of a cell end at its highest summit. Where theory
predicts a mean gap near or above this summit, the cell has too few summits for a comparison.
"""

import numpy as np
import xarray as xr

from common.conventions import annotate, logarithmic_grid
from common.derived_quantities import add_kappa, write_a_v
from common.error_budgets import QUADRATURE, theory_parts
from common.job import start
from common.model_surfaces import cell_size, grid_points, make_heights, model_spectrum
from common.theory_variants import evaluate, theories
from stickiness import datasets
from stickiness.accuracy.error_models import read_models
from stickiness.error_budget import with_budget
from stickiness.surface import lattice_spectrum

MARGIN = 0.75  # over h_rms, of theory's mean gap below the highest summit
LATTICE_VARIABLES = {
    "rms_slope": "rms gradient of the lattice spectrum over q0 h_rms",
    "highest_summit": "mean height of a window's highest point over h_rms",
    "margin": "least distance of theory's mean gap from the highest summit",
    "window_holds": "1 where theory's mean gap is so far below the highest summit",
}


def main(job):
    cases = job.params.lattices.items()
    outputs = zip(cases, job.output.theory, job.output.a_v, strict=True)
    for (case, settings), theory_file, a_v_file in outputs:
        write_lattice(case, settings, job.params, job.input.laws, theory_file)
        write_a_v(theory_file, a_v_file, job.params.windows, job.input.laws)


def write_lattice(case, settings, params, laws, output):
    """Write theory on the lattice spectrum of one case."""
    surface = settings["surface"]
    lattice = lattice_spectrum(model_spectrum(surface), cell_size(surface))
    pressures = np.sort(settings["pressures"])
    ranges = logarithmic_grid(params.gaps)
    variants = theories(lattice, params.variants, params.gamma)
    parts = [evaluate(theory, pressures, ranges) for theory in variants.values()]
    names = xr.DataArray(list(variants), dims="variant", name="variant")
    dataset = xr.concat(parts, names).assign(rms_slope=lattice.rms_slope)
    if settings["simulated"]:
        summit = highest_summit(surface)
        holds = dataset.mean_gap.isel(variant=0, drop=True) < summit - MARGIN
        dataset = dataset.assign(
            highest_summit=summit, margin=MARGIN, window_holds=holds.astype("i1")
        )
    dataset = annotate(dataset, **LATTICE_VARIABLES)
    models = read_models(laws)
    for name in QUADRATURE:
        dataset = with_budget(dataset, name, **theory_parts(models, name, dataset[name], surface))
    dataset = add_kappa(dataset, models, surface)
    title = "Persson's theory on the lattice spectrum of a case"
    parameters = {**surface, "case": case, "gamma": params.gamma}
    datasets.write(dataset, output, title=title, parameters=parameters)


def highest_summit(surface):
    """Mean height over h_rms of the highest point of a cell."""
    long_waves = 64.0  # wave number over q0 beyond which waves add nothing to the highest summit
    long = {**surface, "magnification": min(surface["magnification"], long_waves)}
    points = grid_points(long, 4)
    windows = 64  # random ones, whose highest summits are averaged
    return float(np.mean([make_heights(long, points, seed).max() for seed in range(windows)]))


if __name__ == "__main__":
    main(start(globals()))
