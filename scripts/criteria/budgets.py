"""Error budgets of verdicts: by the spectrum, by a_V and by the model of what remains."""

import numpy as np
import xarray as xr

from stickiness.criteria.registry import REMAINING
from stickiness.error_budget import ErrorComponent, not_applicable, with_budget
from stickiness.statistics import COVERS

IN_A_V = not_applicable("in a_V's error, counted with the model")
CLOSED = {
    "discretisation": IN_A_V,
    "solver": not_applicable("closed forms"),
    "sampling": IN_A_V,
    "bandwidth": not_applicable("of the spectrum stated"),
}
OF_MODEL = "of the model, the farther of both limits"
OF_OURS = f"{OF_MODEL}; other criteria state none"
OF_SPECTRUM = "of the spectrum measured; none of one end of what is given"


def add_budgets(dataset, draws):
    """Add error budgets to what is quoted of pairs: the spectrum, and the model.

    Ends of a surface that was not measured are two surfaces, each known exactly. The threshold has
    the relative error of the margin, the pull-off that of the share.
    """
    ours = dataset.criterion == REMAINING
    of_margin = np.expm1(COVERS * dataset.error_of_spectrum.fillna(0.0))
    of_share = COVERS * dataset.share_error_of_spectrum.fillna(0.0)
    of_share = (of_share / dataset.remaining).where(dataset.remaining > 0, 0.0)
    model = between_limits(dataset, "pair_a_v")
    dataset = with_budget(dataset, "pair_a_v", model=model, **CLOSED)
    for name, limits, relative in (
        ("margin", "margin", of_margin.where(ours, 0.0)),
        ("modulus_threshold", "modulus_threshold", of_margin),
        ("remaining", "remaining", of_share),
        ("pull_off", "pull_off", of_share),
        ("threshold_by_criterion", "modulus_threshold", of_margin.where(ours, 0.0)),
    ):
        model = between_limits(dataset, limits)
        if "criterion" in dataset[name].dims:
            model = ErrorComponent(model.error.where(ours), OF_OURS)
        sampling = ErrorComponent(relative * dataset[name], OF_SPECTRUM)
        dataset = with_budget(dataset, name, **CLOSED | {"sampling": sampling, "model": model})
    return add_budget_of_probability(dataset, draws)


def add_budget_of_probability(dataset, draws):
    """The number of draws limits how well a probability is known: Wilson's interval."""
    share, number = dataset.probability, xr.DataArray(draws, dims="surface")
    number = number.where(number > 0)
    shrunk = 1 + COVERS**2 / number
    middle = (share + COVERS**2 / (2 * number)) / shrunk
    half = COVERS * np.sqrt(share * (1 - share) / number + (COVERS / (2 * number)) ** 2) / shrunk
    scatter = ErrorComponent((abs(middle - share) + half).fillna(0.0), "of the number of draws")
    parts = dict.fromkeys(("discretisation", "model"), not_applicable("drawn"))
    return with_budget(dataset, "probability", **CLOSED | parts | {"sampling": scatter})


def between_limits(dataset, name):
    """ErrorComponent of the budget of a variable that has a low and a high limit beside it."""
    return between(*(dataset[f"{name}{end}"] for end in ("", "_low", "_high")))


def between(value, low, high):
    """ErrorComponent of the budget of a value that is known between two limits."""
    return ErrorComponent(np.maximum(abs(high - value), abs(value - low)), OF_MODEL)
