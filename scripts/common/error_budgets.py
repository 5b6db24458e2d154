"""Error budgets of what simulation and theory give, by error models.

The models are for the columns of their table. What lies between two of the ranges of attraction is
interpolated, and what lies outside is widened like all that was not measured.
"""

from dataclasses import replace

import numpy as np
import xarray as xr

from common.continuum_values import LEFT
from common.conventions import GAPS_MEASURED, VARIANT
from stickiness.accuracy.error_models import OUTSIDE, Settings, Surface, single_error
from stickiness.accuracy.quantities import COLUMNS, has_error_model
from stickiness.accuracy.settings import Problem, covering_factor
from stickiness.error_budget import ErrorComponent, not_applicable, unknown_error
from stickiness.statistics import students_t

# Columns of the error models, by variables of an ensemble's file and, over h_rms, by ranges.
COLUMN_OF = {c.variable: c.name for c in COLUMNS.values() if "range" not in c.at}
COLUMN_AT_RANGE = {c.at["range"]: c.name for c in COLUMNS.values() if "range" in c.at}
NOT_MEASURED = "how this quantity changes with the tolerance is not measured"

SIMULATED = {
    "bandwidth": not_applicable("the case's own spectrum is simulated"),
    "model": not_applicable("linear elastic half-space and hard wall define the quantity"),
}
BY_THEORY = {
    "solver": not_applicable("nothing is iterated"),
    "sampling": not_applicable("theory is of the ensemble"),
    "bandwidth": not_applicable("of the spectrum stated"),
}
MODEL = f"of {VARIANT} against simulation, as measured; of other variants not measured"
# Relative, of the quadrature with the default number of nodes, see `stickiness.persson.Persson`.
QUADRATURE = {"area_fraction": 1e-9, "mean_gap": 1e-9, "attractive_area": 5e-7, "gap_density": 5e-6}


class Simulation:
    """Errors of a mean over realisations; `parameters` are those of its file."""

    def __init__(self, models, parameters):
        self.settings = Settings(
            pixels_per_wavelength=parameters["pixels_per_wavelength"],
            tolerance=parameters["tolerance"],
            seeds=len(parameters["seeds"]),
            coarse_seeds=parameters.get("coarse_seeds", 0),
        )
        described = parameters.get("descriptor_seeds", 2048)
        self.problem = Problem(models, Surface.of(parameters), (), (), described)

    def solver(self, name, like):
        """Relative error by the tolerance of the solver, along a variable."""
        problem = self.problem
        tolerance = self.settings.tolerance

        def single(column, load):
            surface = problem.surface
            return single_error(
                problem.models, "solver", column, surface, load, tolerance=tolerance
            )

        return along(single, name, like)

    def factors(self, name, like):
        """Number of standard errors that cover 90 % of means, along a variable."""

        def single(column, load):
            return covering_factor(self.problem, self.settings, load, column)

        return along(single, name, like, widened=False)

    def parts(self, name, value, standard_error, discretisation, text=LEFT):
        """Make the budget of a mean; `name` is a variable without ``_mean``, or a column."""
        if name == "attractive_area" or has_error_model(COLUMN_OF.get(name, name)):
            error = self.solver(name, value)
            factor = self.factors(name, value)
            solver = ErrorComponent(error * abs(value), "by the tolerance, as measured")
            basis = "Student's t of the standard error"
        else:
            factor = students_t(self.settings.seeds)
            solver = unknown_error(NOT_MEASURED)
            basis = "Student's t by the fine seeds alone"
        return {
            "discretisation": ErrorComponent(discretisation, text),
            "solver": solver,
            "sampling": ErrorComponent(factor * standard_error, basis),
            **SIMULATED,
        }


def along(model, name, like, coordinates=(), widened=True):
    """Evaluate a model of a column, further `coordinates` and the pressure along a variable."""

    def evaluate(column):
        return xr.apply_ufunc(model, column, *coordinates, like.pressure, vectorize=True)

    if name == "attractive_area":
        ends = {range_: evaluate(column) for range_, column in COLUMN_AT_RANGE.items()}
        return interpolate_ranges(ends, like["range"], widened)
    values = evaluate(COLUMN_OF.get(name, name))
    if not (widened and "gap" in like.dims):
        return values
    inside = (like.gap >= GAPS_MEASURED[0]) & (like.gap <= GAPS_MEASURED[1])
    return values * xr.where(inside, 1.0, OUTSIDE)


def interpolate_ranges(ends, ranges, widened=True):
    """Geometric interpolation between the two ranges measured; constant and widened outside."""
    (low, at_low), (high, at_high) = ends.items()
    share = np.log(ranges / low) / np.log(high / low)
    inside = share.clip(0, 1)
    values = at_low ** (1 - inside) * at_high**inside
    return values * xr.where(share == inside, 1, OUTSIDE) if widened else values


def theory_error(models, name, like, surface=None):
    """Relative error of theory against simulation; NaN for variants not measured.

    Without a `surface` the variable `like` has coordinates `hurst` and `magnification`.
    """
    # The window of a continuous spectrum is endless.
    kind = Surface.of(surface) if surface else Surface(0.8, 1.0, np.inf)

    def single(column, hurst, magnification, pressure):
        surface_here = replace(kind, hurst=hurst, magnification=magnification)
        return single_error(models, "theory", column, surface_here, pressure)

    shape = kind if surface else like
    error = along(single, name, like, coordinates=(shape.hurst, shape.magnification))
    return error.where(like["variant"] == VARIANT) if "variant" in like.coords else error


def theory_parts(models, name, value, surface=None, like=""):
    """Make the budget of a variable by theory, with the quadrature error of the variable `like`."""
    quadrature = QUADRATURE[like or name] * abs(value)
    return {
        "discretisation": ErrorComponent(quadrature, "of the quadrature, as tested"),
        "model": ErrorComponent(theory_error(models, name, value, surface) * abs(value), MODEL),
        **BY_THEORY,
    }
