"""The a_V that criteria use, with everything that is known of its error."""

from dataclasses import dataclass

import numpy as np
from stickiness import datasets


@dataclass(frozen=True)
class MeasuredAv:
    """a_V of a simulated case and the parts of its error, all absolute.

    Attributes
    ----------
    value : float
        Mean over seeds in the first window of the fit.
    sampling : float
        Standard error over seeds, 0 for a single one, of which it is unknown.
    discretisation : float
        Change from half the resolution.
    window : float
        Half the spread between the windows of the fit: the 2/3 law holds only roughly, so that
        the window is part of the answer.
    bandwidth : float
        Growth by theory from the magnification of the case to the largest one of the sweep:
        real surfaces are broader than what can be simulated. It only adds.
    """

    value: float
    sampling: float
    discretisation: float
    window: float
    bandwidth: float

    @property
    def low(self) -> float:
        """Value less the parts that may go either way, in quadrature."""
        return max(self.value - np.linalg.norm(self._either_way), 0.01 * self.value)

    @property
    def high(self) -> float:
        """Value plus all parts in quadrature."""
        return float(self.value + np.linalg.norm([*self._either_way, self.bandwidth]))

    @property
    def _either_way(self) -> list[float]:
        return [self.sampling, self.discretisation, self.window]

    def describe(self) -> str:
        """Value, error and parts in words."""
        return (
            f"a_V = {self.value:.2f}, {self.low:.2f} to {self.high:.2f} (sampling "
            f"± {self.sampling:.2f}, discretisation ± {self.discretisation:.2f}, fit window "
            f"± {self.window:.2f}, bandwidth + {self.bandwidth:.2f})"
        )


def measured_a_v(path, theory_path, pressure):
    """Return the `MeasuredAv` of a fit to simulation, with theory's sweep over magnification."""
    fit = datasets.read(path, ["a_v_mean", "a_v_standard_error", "a_v_discretisation_error"])
    made = datasets.parameters(fit)
    at_load = fit.sel(pressure=pressure, method="nearest")
    windows = at_load.a_v_mean.values
    value = float(windows[0])
    return MeasuredAv(
        value=value,
        sampling=float(np.nan_to_num(at_load.a_v_standard_error.isel(window=0))),
        discretisation=float(at_load.a_v_discretisation_error.isel(window=0)),
        window=float(np.ptp(windows)) / 2,
        bandwidth=value * abs(growth(theory_path, made["hurst"], made["magnification"]) - 1),
    )


def growth(path, hurst, magnification):
    """Ratio of theory's a_V at the largest magnification of its sweep to that at this one."""
    theory = datasets.read(path, ["a_v"]).a_v.isel(variant=0, window=0, load=0)
    theory = theory.sel(hurst=hurst, method="nearest")
    here = np.interp(np.log(magnification), np.log(theory.magnification), theory)
    return float(theory.isel(magnification=-1)) / float(here)
