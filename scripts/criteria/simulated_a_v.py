"""a_V of the paper's criterion: simulated for one case, carried to a broad spectrum by theory."""

from dataclasses import astuple, dataclass

import numpy as np

from common.conventions import VARIANT
from stickiness import datasets
from stickiness.error_budget import ErrorComponent, not_applicable, part

SIMULATED = ("a_v_mean", "a_v_mean_error")


@dataclass(frozen=True)
class MeasuredAv:
    """a_V of a broad spectrum and the parts of its error, all absolute.

    The value is that of a simulated case in the first interval of the fit, times the ratio of
    theory on the broadest continuous spectrum to theory on the lattice spectrum of the case.
    Simulation has neither the bandwidth of real surfaces nor, in a small cell, their long waves.
    Theory is close to simulation on the same spectrum and extrapolates to both.
    """

    value: float
    sampling: float  # of the mean over seeds, covers 90 %, by Student's t
    discretisation: float  # of the limit of fine grids
    fit_interval: float  # half the spread between intervals, as the 2/3 law holds only roughly
    bandwidth: float  # change over the last two decades of magnification, in which a_V still grows

    @property
    def error(self):
        """All parts in quadrature."""
        return float(np.linalg.norm(astuple(self)[1:]))

    def parts(self, times):
        """Parts of a budget: the relative errors of a_V times a number."""
        scale = times / self.value
        interval = ErrorComponent(
            self.fit_interval * scale, "half the spread between intervals of the fit"
        )
        return {
            "discretisation": ErrorComponent(self.discretisation * scale, "of the case simulated"),
            "solver": not_applicable("far below the errors of the case simulated"),
            "sampling": ErrorComponent(self.sampling * scale, "of the case simulated"),
            "bandwidth": ErrorComponent(self.bandwidth * scale, "growth over the last two decades"),
            "model": interval,
        }


def measure_a_v(inputs, pressure):
    """`MeasuredAv` at a load over E* q0 h_rms, from three fits of a_V.

    `inputs.a_v` is of the simulated case, `inputs.lattice` of theory on the lattice spectrum of the
    same case, and `inputs.theory` of a sweep over magnification. Their first interval is quoted.
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
    sampling, grid = (part(fit, "a_v_mean", name).values for name in ("sampling", "discretisation"))
    if not np.isfinite([sampling[0], grid[0]]).all():
        raise ValueError(
            f"{inputs.a_v}: the error of a_V is not known; give its case two seeds or more"
        )
    known = datasets.read(inputs.lattice, ["a_v"])
    lattice = known.a_v.sel(variant=VARIANT).sel(pressure=pressure, method="nearest").values
    theory = datasets.read(inputs.theory, ["a_v"]).a_v.sel(variant=VARIANT).isel(load=0)
    theory = theory.sel(hurst=datasets.parameters(known)["hurst"], method="nearest")
    broadest = float(theory.magnification.max())
    ratio = theory.sel(magnification=broadest).values / lattice
    extrapolated = simulated * ratio
    before = theory.isel(window=0).sel(magnification=broadest / 100, method="nearest")
    growth = float(theory.isel(window=0).sel(magnification=broadest) / before) - 1
    return MeasuredAv(
        value=float(extrapolated[0]),
        sampling=float(sampling[0]) * float(ratio[0]),
        discretisation=float(grid[0]) * float(ratio[0]),
        fit_interval=float(np.ptp(extrapolated)) / 2,
        bandwidth=float(extrapolated[0]) * abs(growth),
    )
