"""Error budgets of what simulation and theory give, by the measured laws of their errors.

`stickiness.accuracy` has the laws by the columns of its table; what lies between two of its ranges
of attraction is interpolated, and what lies outside widened like all that was not measured.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from pipeline.conventions import GAPS_MEASURED, VARIANT
from stickiness.accuracy import error_laws
from stickiness.core.budget import Part, absent

COLUMNS = {"area_fraction": "area", "mean_gap": "mean_gap", "gap_density": "gap_distribution"}
RANGES = {0.01: "attractive_area_0.01", 0.1: "attractive_area_0.1"}  # over h_rms, measured
ENDLESS = np.inf  # window of a continuous spectrum

SIMULATED = {
    "bandwidth": absent("the case's own spectrum is simulated"),
    "model": absent("linear elastic half-space and hard wall define the quantity"),
}
BY_THEORY = {
    "solver": absent("nothing is iterated"),
    "sampling": absent("theory is of the ensemble"),
    "bandwidth": absent("of the spectrum stated"),
}
MODEL = f"of {VARIANT} against simulation, as measured; of other variants not measured"
# Relative, of the quadrature with the default number of nodes, see `stickiness.persson.Persson`.
QUADRATURE = {"area_fraction": 1e-9, "mean_gap": 1e-9, "attractive_area": 5e-7, "gap_density": 5e-6}


@dataclass(frozen=True)
class Simulation:
    """What a mean over realisations errs by, beside its own standard error.

    Attributes
    ----------
    laws : mapping
        Of `error_laws.read_laws`.
    surface : accuracy.Surface
    settings : accuracy.Settings
    described : int
        Seeds of which only the long waves are looked at.
    """

    laws: error_laws.Laws
    surface: error_laws.Surface
    settings: error_laws.Settings
    described: int

    @classmethod
    def of(cls, laws: error_laws.Laws, made: Mapping[str, Any]) -> Simulation:
        """From the parameters of an ensemble's file, or of one that derives from it."""
        settings = error_laws.Settings(
            made["pixels_per_wavelength"],
            made["tolerance"],
            len(made["seeds"]),
            made.get("coarse_seeds", 0),
        )
        return cls(laws, error_laws.Surface.of(made), settings, made.get("descriptor_seeds", 2048))

    def solver(self, column: str, pressure: float) -> float:
        """Relative error of a column by the tolerance of the solver."""
        tolerance = self.settings.tolerance
        return error_laws.single_error(
            self.laws, "solver", column, self.surface, pressure, tolerance=tolerance
        )

    def factor(self, column: str, pressure: float) -> float:
        """Standard errors that cover 90 % of means of a column."""
        return error_laws.covering_factor(
            self.laws, self.settings, self.surface, pressure, column, self.described
        )

    def factors(self, name: str, like: xr.DataArray) -> xr.DataArray:
        """`factor` along a variable: it goes with what was measured, wherever that is."""
        return along(self.factor, name, like, widened=False)

    def parts(
        self,
        name: str,
        value: xr.DataArray,
        standard_error: xr.DataArray,
        discretisation: xr.DataArray,
        text: str = "left in the limit of fine grids",
    ) -> dict[str, Part]:
        """Parts of the budget of a mean.

        Parameters
        ----------
        name : str
            Of a variable of an ensemble's file without the ``_mean``, or of a column of the laws.
        value, standard_error, discretisation : xarray.DataArray
            Along `pressure`, and `range` or `gap`.
        text : str
            What the discretisation error is.
        """
        solver, factor = along(self.solver, name, value), self.factors(name, value)
        return {
            "discretisation": Part(discretisation, text),
            "solver": Part(solver * abs(value), "by the tolerance, as measured"),
            "sampling": Part(factor * standard_error, "Student's t of the standard error"),
            **SIMULATED,
        }


def along(
    law: Callable[[str, float], float], name: str, like: xr.DataArray, widened: bool = True
) -> xr.DataArray:
    """Values of a law by column and pressure, along the pressures and ranges of a variable."""

    def by(column):
        return xr.apply_ufunc(law, column, like.pressure, vectorize=True)

    if name != "attractive_area":
        return by(COLUMNS.get(name, name)) * (widened_gaps(like) if widened else 1.0)
    ends = {reach: by(column) for reach, column in RANGES.items()}
    return between_ranges(ends, like["range"], widened)


def between_ranges(
    ends: Mapping[float, xr.DataArray], ranges: xr.DataArray, widened: bool = True
) -> xr.DataArray:
    """A power law between the two ranges measured, held and widened outside."""
    (low, first), (high, last) = ends.items()
    share = np.log(ranges / low) / np.log(high / low)
    inside = share.clip(0, 1)
    found = first ** (1 - inside) * last**inside
    return found * xr.where(share == inside, 1, error_laws.OUTSIDE) if widened else found


def widened_gaps(like: xr.DataArray) -> xr.DataArray | float:
    """Factor for gaps outside those that the law of P(u) was measured over."""
    if "gap" not in like.dims:
        return 1.0
    inside = (like.gap >= GAPS_MEASURED[0]) & (like.gap <= GAPS_MEASURED[1])
    return xr.where(inside, 1.0, error_laws.OUTSIDE)


def theory_error(
    laws: error_laws.Laws, name: str, like: xr.DataArray, surface: Mapping[str, Any] | None = None
) -> xr.DataArray:
    """Relative error of theory in place of simulation; NaN for variants not measured.

    Parameters
    ----------
    laws : mapping
        Of `error_laws.read_laws`.
    name : str
        Of the variable, or of a column of the laws.
    like : xarray.DataArray
        The variable with a coordinate `pressure`; without `surface` also along `hurst` and
        `magnification`, of spectra without a window.
    """

    def single(column, hurst, magnification, window, pressure):
        at = error_laws.Surface(hurst, magnification, window)
        return error_laws.single_error(laws, "theory", column, at, pressure)

    known = error_laws.Surface.of(surface) if surface else None
    where = (
        (known.hurst, known.magnification, known.window)
        if known
        else (like.hurst, like.magnification, ENDLESS)
    )

    def by(column):
        return xr.apply_ufunc(single, column, *where, like.pressure, vectorize=True)

    if name == "attractive_area":
        ends = {reach: by(column) for reach, column in RANGES.items()}
        found = between_ranges(ends, like["range"])
    else:
        found = by(COLUMNS.get(name, name)) * widened_gaps(like)
    return found.where(like["variant"] == VARIANT) if "variant" in like.coords else found


def theory_parts(
    laws: error_laws.Laws, name: str, value: xr.DataArray, surface: Mapping[str, Any] | None = None
) -> dict[str, Part]:
    """Parts of the budget of a variable of theory's; arguments as of `theory_error`."""
    return {
        "discretisation": Part(QUADRATURE[name] * abs(value), "of the quadrature, as tested"),
        "model": Part(theory_error(laws, name, value, surface) * abs(value), MODEL),
        **BY_THEORY,
    }
