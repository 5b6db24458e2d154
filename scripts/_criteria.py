"""The a_V that criteria use: measured by simulation, carried by theory to broad spectra."""

from dataclasses import dataclass

import numpy as np

from _model import VARIANT
from stickiness import datasets


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
        Standard error over seeds; 0 for a single one, of which it is unknown.
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


def measured_a_v(inputs, pressure):
    """`MeasuredAv` from the fits to simulation, lattice theory and theory over magnification.

    Parameters
    ----------
    inputs : object
        With the files `a_v` and `lattice` of one case and `theory`, a sweep over magnification.
    pressure : float
        Load over E* q0 h_rms.
    """
    fit = datasets.read(inputs.a_v, ["a_v_mean", "a_v_standard_error", "a_v_discretisation_error"])
    fit = fit.sel(pressure=pressure, method="nearest")
    lattice = datasets.read(inputs.lattice, ["a_v"]).a_v.sel(variant=VARIANT)
    lattice = lattice.sel(pressure=pressure, method="nearest").values
    theory = datasets.read(inputs.theory, ["a_v"]).a_v.sel(variant=VARIANT).isel(load=0)
    theory = theory.sel(hurst=datasets.parameters(fit)["hurst"], method="nearest")
    broadest = float(theory.magnification.max())
    ratio = theory.sel(magnification=broadest).values / lattice
    carried = fit.a_v_mean.values * ratio
    before = theory.isel(window=0).sel(magnification=broadest / 100, method="nearest")
    growth = float(theory.isel(window=0).sel(magnification=broadest) / before) - 1
    return MeasuredAv(
        value=float(carried[0]),
        simulated=float(fit.a_v_mean[0]),
        magnification=broadest,
        over_lattice=float(fit.a_v_mean[0] / lattice[0]),
        sampling=float(np.nan_to_num(fit.a_v_standard_error[0])) * float(ratio[0]),
        discretisation=float(fit.a_v_discretisation_error[0]) * float(ratio[0]),
        window=float(np.ptp(carried)) / 2,
        bandwidth=float(carried[0]) * abs(growth),
    )


@dataclass(frozen=True)
class SurfaceAv:
    """a_V of a real surface against the range, with the limits of what is known of it.

    Theory on the surface's own spectrum, times the ratio of simulation to theory of the simulated
    case. The limits are those of both variants of the theory and, below the edge range, of
    Pastewka and Robbins' estimate, widened by the sampling and discretisation error of the
    simulation.
    """

    ranges: np.ndarray
    theory: np.ndarray
    quoted: int
    ratio: float
    relative_error: float

    def at(self, range_over_h_rms):
        """Value, low and high limit at a range over h_rms, interpolated in logarithms."""
        logs = [
            np.interp(np.log(range_over_h_rms), np.log(self.ranges), np.log(a)) for a in self.theory
        ]
        every = self.ratio * np.exp(logs)
        return (
            float(every[self.quoted]),
            float(every.min() * max(1 - self.relative_error, 0.01)),
            float(every.max() * (1 + self.relative_error)),
        )


def surface_a_v(path, measured):
    """`SurfaceAv` from a file of `persson_surface` and the `MeasuredAv` of the simulation."""
    theory = datasets.read(path, ["a_v"]).a_v
    return SurfaceAv(
        ranges=theory["range"].values,
        theory=theory.values,
        quoted=list(theory["variant"].values).index(VARIANT),
        ratio=measured.over_lattice,
        relative_error=float(np.hypot(measured.sampling, measured.discretisation)) / measured.value,
    )
