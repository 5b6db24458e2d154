"""kappa_rep = A_rep E* h'_rms/(A_nom p) of a case, load by load and fitted, beside theory's."""

import numpy as np
import xarray as xr
from _job import start
from _model import DESCRIBED
from stickiness import datasets

LINEAR_UP_TO = 0.3  # area fraction up to which the paper calls the area linear in load


def main(job):
    ensemble = datasets.read(job.input.ensemble, ["area_fraction", "rms_slope"])
    theory = datasets.read(job.input.theory, ["area_fraction", "rms_slope"])
    kappa = ensemble.area_fraction * ensemble.rms_slope / ensemble.pressure
    slope = fitted_slope(ensemble)
    count = ensemble.sizes["seed"]
    fine, fine_slope = kappa.isel(resolution=-1, drop=True), slope.isel(resolution=-1, drop=True)
    dataset = xr.Dataset(
        {
            "area_fraction": ensemble.area_fraction_mean,
            "kappa": fine.mean("seed"),
            "kappa_standard_error": standard_error(fine, count),
            "kappa_discretisation_error": change_with_resolution(kappa),
            "kappa_fit": fine_slope.mean("seed"),
            "kappa_fit_standard_error": standard_error(fine_slope, count),
            "kappa_fit_discretisation_error": change_with_resolution(slope),
            "kappa_theory": theory.area_fraction * theory.rms_slope / theory.pressure,
        }
    )
    datasets.write(
        annotated(dataset),
        job.output[0],
        title="slope of the area-load relation",
        parameters={**datasets.parameters(ensemble), "linear_up_to": LINEAR_UP_TO},
    )


def fitted_slope(ensemble):
    """Least-squares slope of area h'_rms against pressure through the origin, A <= 30 %."""
    area = ensemble.area_fraction.where(ensemble.area_fraction <= LINEAR_UP_TO)
    pressure = ensemble.pressure.where(area.notnull())
    slope = (area * pressure).sum("pressure") / (pressure**2).sum("pressure")
    return slope * ensemble.rms_slope


def standard_error(values, count):
    if count == 1:
        return values.mean("seed") * np.nan
    return values.std("seed", ddof=1) / np.sqrt(count)


def change_with_resolution(values):
    return abs(values.diff("resolution").isel(resolution=-1, drop=True).mean("seed"))


def annotated(dataset):
    text = "kappa = A_rep E* h'_rms/(A_nom p)"
    fit = f"{text}, fitted through the origin up to {LINEAR_UP_TO:.0%} area"
    return datasets.annotate(
        dataset,
        pressure=DESCRIBED["pressure"],
        area_fraction=DESCRIBED["area_fraction"],
        kappa=("1", text),
        kappa_standard_error=("1", f"{text}: standard error over seeds", "a single seed"),
        kappa_discretisation_error=("1", f"{text}: change from half the resolution"),
        kappa_fit=("1", fit),
        kappa_fit_standard_error=("1", f"{fit}: standard error over seeds", "a single seed"),
        kappa_fit_discretisation_error=("1", f"{fit}: change from half the resolution"),
        kappa_theory=("1", f"{text} by Persson's theory on the lattice spectrum"),
    )


if __name__ == "__main__":
    main(start(globals(), "fit_kappa", case="H0.8_zeta64"))
