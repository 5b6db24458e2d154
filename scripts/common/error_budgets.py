"""Error budgets of what simulation and theory give, by error models.

The models are for the columns of their table. What lies between two of the ranges of attraction is
interpolated, and what lies outside is widened like all that was not measured.
"""

from dataclasses import replace

import numpy as np
import xarray as xr

from common.conventions import GAPS_MEASURED, VARIANT
from common.grid_limits import LEFT
from stickiness.accuracy.error_models import OUTSIDE, Settings, Surface, single_error
from stickiness.accuracy.quantities import COLUMNS, has_error_model
from stickiness.accuracy.settings import Problem, covering_factor
from stickiness.error_budget import ErrorComponent, not_applicable, unknown_error
from stickiness.statistics import students_t

# Columns of the error models, by variables of an ensemble's file and, over h_rms, by ranges.
COLUMN_OF = {c.variable: c.name for c in COLUMNS.values() if "range" not in c.at}
COLUMN_AT_RANGE = {c.at["range"]: c.name for c in COLUMNS.values() if "range" in c.at}
NOT_MEASURED = "how this quantity changes with the tolerance is not measured"
ENDLESS = np.inf  # window of a continuous spectrum

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
    """Errors of a mean over realisations; `made` are the parameters of an ensemble's file."""

    def __init__(self, models, made):
        knobs = made["pixels_per_wavelength"], made["tolerance"], len(made["seeds"])
        self.settings = Settings(*knobs, made.get("coarse_seeds", 0))
        described = made.get("descriptor_seeds", 2048)
        self.problem = Problem(models, Surface.of(made), (), (), described)

    def solver(self, name, like):
        """Relative error by the tolerance of the solver, along a variable."""
        problem, knob = self.problem, {"tolerance": self.settings.tolerance}

        def single(column, load):
            return single_error(problem.models, "solver", column, problem.surface, load, **knob)

        return along(single, name, like)

    def factors(self, name, like):
        """Standard errors that cover 90 % of means, along a variable, wherever that is."""

        def single(column, load):
            return covering_factor(self.problem, self.settings, load, column)

        return along(single, name, like, widened=False)

    def parts(self, name, value, standard_error, discretisation, text=LEFT):
        """Parts of the budget of a mean; `name` is a variable without ``_mean``, or a column."""
        if name == "attractive_area" or has_error_model(COLUMN_OF.get(name, name)):
            error, factor = self.solver(name, value), self.factors(name, value)
            solver = ErrorComponent(error * abs(value), "by the tolerance, as measured")
            basis = "Student's t of the standard error"
        else:
            factor, solver = students_t(self.settings.seeds), unknown_error(NOT_MEASURED)
            basis = "Student's t by the fine seeds alone"
        return {
            "discretisation": ErrorComponent(discretisation, text),
            "solver": solver,
            "sampling": ErrorComponent(factor * standard_error, basis),
            **SIMULATED,
        }


def along(model, name, like, at=(), widened=True):
    """Values of a model by column, further coordinates `at` and pressure, along a variable."""

    def by(column):
        return xr.apply_ufunc(model, column, *at, like.pressure, vectorize=True)

    if name == "attractive_area":
        ends = {range_: by(column) for range_, column in COLUMN_AT_RANGE.items()}
        return interpolate_ranges(ends, like["range"], widened)
    found = by(COLUMN_OF.get(name, name))
    if not (widened and "gap" in like.dims):
        return found
    inside = (like.gap >= GAPS_MEASURED[0]) & (like.gap <= GAPS_MEASURED[1])
    return found * xr.where(inside, 1.0, OUTSIDE)


def interpolate_ranges(ends, ranges, widened=True):
    """A power law between the two ranges measured, held and widened outside."""
    (low, first), (high, last) = ends.items()
    share = np.log(ranges / low) / np.log(high / low)
    inside = share.clip(0, 1)
    found = first ** (1 - inside) * last**inside
    return found * xr.where(share == inside, 1, OUTSIDE) if widened else found


def theory_error(models, name, like, surface=None):
    """Relative error of theory against simulation; NaN for variants not measured.

    Without a `surface` the variable `like` has coordinates `hurst` and `magnification`.
    """
    kind = Surface.of(surface) if surface else Surface(0.8, 1.0, ENDLESS)

    def single(column, hurst, magnification, pressure):
        at = replace(kind, hurst=hurst, magnification=magnification)
        return single_error(models, "theory", column, at, pressure)

    where = kind if surface else like
    found = along(single, name, like, (where.hurst, where.magnification))
    return found.where(like["variant"] == VARIANT) if "variant" in like.coords else found


def theory_parts(models, name, value, surface=None, like=""):
    """Parts of the budget of a variable by theory; by quadrature it errs as the variable `like`."""
    quadrature = QUADRATURE[like or name] * abs(value)
    return {
        "discretisation": ErrorComponent(quadrature, "of the quadrature, as tested"),
        "model": ErrorComponent(theory_error(models, name, value, surface) * abs(value), MODEL),
        **BY_THEORY,
    }
