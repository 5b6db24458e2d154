"""Error budgets of verdicts: by the spectrum, by a_V and by the model of what remains."""

import numpy as np
import xarray as xr

from stickiness.criteria.registry import REMAINING
from stickiness.error_budget import Part, absent, with_budget
from stickiness.statistics import COVERS

IN_A_V = absent("in a_V's error, counted with the model")
CLOSED = {
    "discretisation": IN_A_V,
    "solver": absent("closed forms"),
    "sampling": IN_A_V,
    "bandwidth": absent("of the spectrum stated"),
}
OF_MODEL = "of the model, the farther of both limits"
OF_SPECTRUM = "of the spectrum measured; none of one end of what is given"
OF_OURS = f"{OF_MODEL}; other criteria state none"


def add_budgets(dataset, draws):
    """Add error budgets to what is quoted of pairs: the spectrum, and the model."""
    model = between_limits(dataset, "pair_a_v")
    dataset = with_budget(dataset, "pair_a_v", model=model, **CLOSED)
    for name, from_spectrum in find_spectrum_errors(dataset).items():
        parts = CLOSED | {"sampling": Part(from_spectrum, OF_SPECTRUM)}
        dataset = with_budget(dataset, name, model=find_model_error(dataset, name), **parts)
    return add_budget_of_probability(dataset, draws)


def find_spectrum_errors(dataset):
    """Errors by the spectrum, by variable; only the verdict's criterion has them.

    Ends of a surface that was not measured are two surfaces, each known exactly. The threshold is
    the modulus times the margin and has the same relative error; the pull-off goes with the share.
    """
    ours = dataset.criterion == REMAINING
    of_margin = np.expm1(COVERS * dataset.error_of_spectrum.fillna(0.0))
    of_share = COVERS * dataset.share_error_of_spectrum.fillna(0.0)
    relative = (of_share / dataset.remaining).where(dataset.remaining > 0, 0.0)
    return {
        "margin": dataset.margin * of_margin.where(ours, 0.0),
        "modulus_threshold": dataset.modulus_threshold * of_margin,
        "remaining": relative * dataset.remaining,
        "pull_off": relative * dataset.pull_off,
        "threshold_by_criterion": dataset.threshold_by_criterion * of_margin.where(ours, 0.0),
    }


def find_model_error(dataset, name):
    """Part of the model's error; other criteria than the verdict's state none."""
    limits = {"threshold_by_criterion": "modulus_threshold"}.get(name, name)
    part = between_limits(dataset, limits)
    if "criterion" not in dataset[name].dims:
        return part
    error = part.error.where(dataset.criterion == REMAINING)
    return Part(error, OF_OURS)


def add_budget_of_probability(dataset, draws):
    """The number of draws limits how well a probability is known: Wilson's interval."""
    share, number = dataset.probability, xr.DataArray(draws, dims="surface")
    number = number.where(number > 0)
    shrunk = 1 + COVERS**2 / number
    middle = (share + COVERS**2 / (2 * number)) / shrunk
    half = COVERS * np.sqrt(share * (1 - share) / number + (COVERS / (2 * number)) ** 2) / shrunk
    scatter = abs(middle - share) + half
    inside = absent("drawn")
    return with_budget(
        dataset,
        "probability",
        discretisation=inside,
        solver=CLOSED["solver"],
        sampling=Part(scatter.fillna(0.0), "of the number of draws"),
        bandwidth=CLOSED["bandwidth"],
        model=inside,
    )


def between_limits(dataset: xr.Dataset, name: str) -> Part:
    """Part of the budget of a variable that has a low and a high limit beside it."""
    return between(*(dataset[f"{name}{end}"] for end in ("", "_low", "_high")))


def between(value: xr.DataArray, low: xr.DataArray, high: xr.DataArray) -> Part:
    """Part of the budget of a value that is known between two limits."""
    return Part(np.maximum(abs(high - value), abs(value - low)), OF_MODEL)
