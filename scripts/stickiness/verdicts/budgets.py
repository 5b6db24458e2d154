"""Error budgets of verdicts: by the spectrum, by a_V and by the model of what remains."""

from __future__ import annotations

import numpy as np
import xarray as xr

from stickiness.criteria.registry import REMAINING
from stickiness.error_budget import ErrorComponent, not_applicable, with_budget
from stickiness.statistics import COVERS

IN_A_V = not_applicable("in a_V's error, counted with the model")
CLOSED_FORM = {
    "discretisation": IN_A_V,
    "solver": not_applicable("closed forms"),
    "sampling": IN_A_V,
    "bandwidth": not_applicable("of the spectrum stated"),
}
OF_MODEL = "of the model, the farther of both limits"


def add_budgets(dataset: xr.Dataset, draw_counts: xr.DataArray) -> xr.Dataset:
    """Add error budgets to what is quoted of pairs: by the spectrum, and by the model.

    The ends of a surface that was not measured are two surfaces, each known exactly. The threshold
    has the relative error of the margin, the pull-off that of the share. `draw_counts` has the
    number of draws of every pair.
    """
    states_errors = dataset.criterion == REMAINING
    # Relative errors by the spectrum.
    of_margin = np.expm1(COVERS * dataset.error_of_spectrum.fillna(0.0))
    of_share = COVERS * dataset.share_error_of_spectrum.fillna(0.0)
    of_share = (of_share / dataset.remaining).where(dataset.remaining > 0, 0.0)
    dataset = with_budget(
        dataset, "pair_a_v", **CLOSED_FORM, model=find_model_error(dataset, "pair_a_v")
    )
    # Every quoted quantity, the one whose limits it has, and its relative error by the spectrum.
    for name, limited, relative_error in (
        ("margin", "margin", of_margin.where(states_errors, 0.0)),
        ("modulus_threshold", "modulus_threshold", of_margin),
        ("remaining", "remaining", of_share),
        ("pull_off", "pull_off", of_share),
        ("threshold_by_criterion", "modulus_threshold", of_margin.where(states_errors, 0.0)),
    ):
        model = find_model_error(dataset, limited)
        if "criterion" in dataset[name].dims:
            text = f"{OF_MODEL}; other criteria state none"
            model = ErrorComponent(model.error.where(states_errors), text)
        sampling = ErrorComponent(
            relative_error * dataset[name],
            "of the spectrum measured; none of one end of what is given",
        )
        components = CLOSED_FORM | {"sampling": sampling, "model": model}
        dataset = with_budget(dataset, name, **components)
    return add_budget_of_probability(dataset, draw_counts)


def add_budget_of_probability(dataset: xr.Dataset, draw_counts: xr.DataArray) -> xr.Dataset:
    """The number of draws limits how well a probability is known: Wilson's interval."""
    share = dataset.probability
    number = draw_counts.where(draw_counts > 0)
    shrunk = 1 + COVERS**2 / number
    middle = (share + COVERS**2 / (2 * number)) / shrunk
    half = COVERS * np.sqrt(share * (1 - share) / number + (COVERS / (2 * number)) ** 2) / shrunk
    scatter = ErrorComponent((abs(middle - share) + half).fillna(0.0), "of the number of draws")
    drawn = dict.fromkeys(("discretisation", "model"), not_applicable("drawn"))
    components = CLOSED_FORM | drawn | {"sampling": scatter}
    return with_budget(dataset, "probability", **components)


def find_model_error(dataset: xr.Dataset, name: str) -> ErrorComponent:
    """Error by the model of a quantity that has a low and a high limit beside it."""
    return find_error_between(
        dataset[name], low=dataset[f"{name}_low"], high=dataset[f"{name}_high"]
    )


def find_error_between(
    value: xr.DataArray, low: xr.DataArray, high: xr.DataArray
) -> ErrorComponent:
    """Error by the model of a value that is known between two limits."""
    return ErrorComponent(np.maximum(abs(high - value), abs(value - low)), OF_MODEL)
