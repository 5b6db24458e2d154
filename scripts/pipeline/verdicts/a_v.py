"""The a_V that criteria use: measured by simulation, carried by theory to broad spectra."""

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from pipeline.conventions import VARIANT
from stickiness.core import datasets
from stickiness.core.budget import Part, absent
from stickiness.core.statistics import COVERS
from stickiness.criteria.surface_a_v import SurfaceAv


@dataclass(frozen=True)
class MeasuredAv:
    """a_V of a broad spectrum and the parts of its error, all absolute.

    Attributes
    ----------
    value : float
        a_V of a simulated case in the first window of the fit, times the ratio of theory on the
        broadest continuous spectrum to theory on the lattice spectrum of the case. Simulation
        holds neither the bandwidth of real surfaces nor, on a small window, their long waves;
        theory, which is close to simulation on one and the same spectrum, carries both.
    simulated : float
        a_V of the case itself.
    over_lattice : float
        Ratio of simulation to theory on the lattice spectrum of the case.
    magnification : float
        Magnification that the value is carried to.
    sampling : float
        Of the mean over seeds, covers 90 %; 0 for a single one, of which it is unknown.
    discretisation : float
        What the attractive areas keep in the limit of fine grids.
    window : float
        Half the spread between the windows of the fit: the 2/3 law holds only roughly, so that
        the window is part of the answer.
    bandwidth : float
        Change of theory over the last two decades of magnification, in which a_V still grows.
    """

    value: float
    simulated: float
    over_lattice: float
    magnification: float
    sampling: float
    discretisation: float
    window: float
    bandwidth: float

    @property
    def error(self) -> float:
        """All parts in quadrature."""
        parts = (self.sampling, self.discretisation, self.window, self.bandwidth)
        return float(np.linalg.norm(parts))

    def parts(self, times: ArrayLike) -> dict[str, Part]:
        """Parts of a budget: `times` its own relative errors."""
        scale = times / self.value
        return {
            "discretisation": Part(self.discretisation * scale, "of the case simulated"),
            "solver": absent("far below what is recorded of the case"),
            "sampling": Part(self.sampling * scale, "of the case simulated"),
            "bandwidth": Part(self.bandwidth * scale, "growth over the last two decades"),
            "model": Part(self.window * scale, "half the spread between windows of the fit"),
        }

    @property
    def low(self) -> float:
        """Value less its error, kept positive."""
        return max(self.value - self.error, 0.01 * self.value)

    @property
    def high(self) -> float:
        """Value plus its error."""
        return self.value + self.error

    def describe(self) -> str:
        """Value, error and parts in words."""
        return (
            f"a_V = {self.value:.2f} ± {self.error:.2f} (simulated {self.simulated:.2f}, carried "
            f"by theory to zeta = {self.magnification:.0e}; sampling {self.sampling:.2f}, "
            f"discretisation {self.discretisation:.2f}, fit window {self.window:.2f}, bandwidth "
            f"{self.bandwidth:.2f})"
        )


IN_A_V = absent("in a_V's error, counted with the model")
CLOSED = {
    "discretisation": IN_A_V,
    "solver": absent("closed forms"),
    "sampling": IN_A_V,
    "bandwidth": absent("of the spectrum stated"),
}
LIMITS = "of a_V, its sources together, and of the model of the edges; the farther of both limits"


def between(value: xr.DataArray, low: xr.DataArray, high: xr.DataArray) -> Part:
    """Part of the budget of a value that is known between two limits."""
    return Part(np.maximum(abs(high - value), abs(value - low)), LIMITS)


RECORDED = (
    "pressure",
    "window_low",
    "window_high",
    "a_v",
    "standard_error",
    "discretisation_error",
)


def recorded(path):
    """Columns of a table of measured a_V, one row for every window of the fit."""
    lines = Path(path).read_text(encoding="utf-8").splitlines()
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    try:
        return {name: np.array([float(row[name]) for row in rows]) for name in RECORDED}
    except (KeyError, TypeError, ValueError) as error:
        raise ValueError(f"{path}: not a table of measured a_V ({error!r})") from None


def measure_a_v(inputs, pressure):
    """`MeasuredAv` from the measured a_V of the configuration and two fits to theory.

    Parameters
    ----------
    inputs : object
        With the files `a_v`, a table as `record_a_v` writes it; `lattice`, the fit to theory on the
        lattice spectrum of the same case; and `theory`, a sweep over magnification.
    pressure : float
        Load over E* q0 h_rms.
    """
    fit = recorded(inputs.a_v)
    if not np.isclose(fit["pressure"][0], pressure):
        raise ValueError(
            f"{inputs.a_v}: was measured at pressure {fit['pressure'][0]:g}, and "
            f"criteria.a_v.pressure = {pressure:g}; record it anew (target a_v)"
        )
    known = datasets.read(inputs.lattice, ["a_v"])
    lattice = known.a_v.sel(variant=VARIANT).sel(pressure=pressure, method="nearest").values
    theory = datasets.read(inputs.theory, ["a_v"]).a_v.sel(variant=VARIANT).isel(load=0)
    theory = theory.sel(hurst=datasets.parameters(known)["hurst"], method="nearest")
    broadest = float(theory.magnification.max())
    ratio = theory.sel(magnification=broadest).values / lattice
    carried = fit["a_v"] * ratio
    before = theory.isel(window=0).sel(magnification=broadest / 100, method="nearest")
    growth = float(theory.isel(window=0).sel(magnification=broadest) / before) - 1
    return MeasuredAv(
        value=float(carried[0]),
        simulated=float(fit["a_v"][0]),
        magnification=broadest,
        over_lattice=float(fit["a_v"][0] / lattice[0]),
        sampling=COVERS * float(fit["standard_error"][0]) * float(ratio[0]),
        discretisation=float(fit["discretisation_error"][0]) * float(ratio[0]),
        window=float(np.ptp(carried)) / 2,
        bandwidth=float(carried[0]) * abs(growth),
    )


def scale_theory(path, measured):
    """`SurfaceAv` from a file of `persson_surface` and the `MeasuredAv` of the simulation."""
    theory = datasets.read(path, ["a_v"]).a_v
    return SurfaceAv(
        ranges=theory["range"].values,
        theory=theory.values,
        quoted=list(theory["variant"].values).index(VARIANT),
        ratio=measured.over_lattice,
        relative_error=float(np.hypot(measured.sampling, measured.discretisation)) / measured.value,
    )
