"""Persson's theory on continuous self-affine spectra, over a sweep of the configuration."""

from itertools import product

import numpy as np
import xarray as xr

from pipeline.conventions import DESCRIBED, logarithmic_grid, middles, spectrum_of
from pipeline.error_budgets import QUADRATURE, theory_parts
from pipeline.job import start
from pipeline.theory import DESCRIBED as DESCRIBED_THEORY
from pipeline.theory import theories
from stickiness.accuracy.error_models import read_models
from stickiness.core import datasets
from stickiness.core.budget import with_budget
from stickiness.persson.theory import Persson


def main(job):
    sweep, ranges = job.params.sweep, logarithmic_grid(job.params.gaps)
    named = theories(job.params.variants, job.params.gamma)
    axes = {
        "variant": list(named),
        "hurst": sweep["hurst"],
        "magnification": [float(m) for m in sweep["magnification"]],
    }
    parts = [
        state(theory(named[point[0]], *point[1:]), sweep, ranges).expand_dims(
            {name: [value] for name, value in zip(axes, point, strict=True)}
        )
        for point in product(*axes.values())
    ]
    dataset, laws = annotated(xr.combine_by_coords(parts)), read_models(job.input.laws)
    for name in QUADRATURE:
        value = dataset[name].assign_coords(pressure=dataset.pressure)
        dataset = with_budget(dataset, name, **theory_parts(laws, name, value))
    datasets.write(
        dataset,
        job.output[0],
        title="Persson's theory on continuous self-affine spectra",
        parameters={**sweep, "variants": job.params.variants, "gamma": job.params.gamma},
    )


def theory(options, hurst, magnification):
    return Persson(spectrum_of({"hurst": hurst, "magnification": magnification}), **options)


def state(theory, sweep, ranges):
    """Everything at the sweep's loads, which are pressures or mean gaps."""
    if "pressure" in sweep:
        pressures = np.array(sweep["pressure"], dtype=float)
    else:
        pressures = np.array([theory.pressure_at(gap) for gap in sweep["mean_gap"]])
    gaps = middles(ranges)
    return xr.Dataset(
        {
            "pressure": ("load", pressures),
            "mean_gap": ("load", [float(theory.mean_gap(p)) for p in pressures]),
            "area_fraction": ("load", [float(theory.area_fraction(p)) for p in pressures]),
            "attractive_area": (
                ("load", "range"),
                [theory.gap_cumulative(ranges, p) for p in pressures],
            ),
            "gap_density": (("load", "gap"), [theory.gap_density(gaps, p) for p in pressures]),
            "rms_slope": ((), theory.spectrum.rms_slope),
            "rms_curvature": ((), theory.spectrum.rms_curvature),
        },
        coords={"range": ranges, "gap": gaps},
    )


def annotated(dataset):
    return datasets.annotate(
        dataset,
        **DESCRIBED,
        variant=DESCRIBED_THEORY,
        hurst=("1", "Hurst exponent"),
        magnification=("1", "magnification q1/q0"),
        rms_slope=("1", "rms gradient over q0 h_rms"),
        rms_curvature=("1", "rms Laplacian over q0^2 h_rms"),
    )


if __name__ == "__main__":
    main(start(globals(), "persson_sweep", sweep="fig1a"))
