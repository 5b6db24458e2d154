"""a_V of the paper's criterion: simulated for one case, carried to a broad spectrum by theory."""

import numpy as np

from common.conventions import VARIANT
from stickiness import datasets
from stickiness.error_budget import ErrorComponent, not_applicable, part

SIMULATED = ("a_v_mean", "a_v_mean_error")


def measure_a_v(inputs, pressure):
    """a_V of a broad spectrum at a load over E* q0 h_rms, and the parts of its error budget.

    The value is a_V of a simulated case (`inputs.a_v`) in the first interval of the fit, times the
    ratio of theory on the broadest spectrum of a sweep (`inputs.theory`) to theory on the lattice
    spectrum of the case (`inputs.lattice`): simulation has not the bandwidth of real surfaces.
    """
    fit = datasets.read(inputs.a_v, SIMULATED)
    if not np.isclose(fit.pressure, pressure).any():
        raise ValueError(
            f"{inputs.a_v}: has no a_V at criteria.a_v.pressure = {pressure:g}; its pressures are "
            f"{', '.join(f'{p:g}' for p in fit.pressure.values)}"
        )
    fit = fit[list(SIMULATED)].sel(pressure=pressure, method="nearest")
    simulated = fit.a_v_mean.values
    if not np.all(simulated > 0):
        raise ValueError(f"{inputs.a_v}: a_V at pressure {pressure:g} is {simulated}, not positive")
    errors = [float(part(fit, "a_v_mean", name)[0]) for name in ("sampling", "discretisation")]
    if not np.isfinite(errors).all():
        raise ValueError(
            f"{inputs.a_v}: the error of a_V is not known; give its case two seeds or more"
        )
    lattice_file = datasets.read(inputs.lattice, ["a_v"])
    lattice = lattice_file.a_v.sel(variant=VARIANT).sel(pressure=pressure, method="nearest").values
    theory = datasets.read(inputs.theory, ["a_v"]).a_v.sel(variant=VARIANT).isel(load=0)
    theory = theory.sel(hurst=datasets.parameters(lattice_file)["hurst"], method="nearest")
    broadest = float(theory.magnification.max())
    ratio = theory.sel(magnification=broadest).values / lattice
    a_v = simulated * ratio
    sampling, discretisation = (error * float(ratio[0]) for error in errors)
    # The 2/3 law holds only roughly, and a_V still grows with the magnification.
    spread = float(np.ptp(a_v)) / 2
    theory = theory.isel(window=0)
    before = theory.sel(magnification=broadest / 100, method="nearest")
    growth = float(a_v[0]) * abs(float(theory.sel(magnification=broadest) / before) - 1)
    return float(a_v[0]), {
        "sampling": ErrorComponent(sampling, "of the case simulated"),
        "discretisation": ErrorComponent(discretisation, "of the case simulated"),
        "model": ErrorComponent(spread, "half the spread between intervals of the fit"),
        "bandwidth": ErrorComponent(growth, "growth over the last two decades"),
        "solver": not_applicable("far below the errors of the case simulated"),
    }
