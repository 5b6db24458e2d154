"""Whether predictions hold against observations, and which criterion survives them."""

import numpy as np
from numpy.typing import NDArray

from experiments.entries import MIDDLE, Observation
from experiments.predictions import (
    Predicted,
    find_lengths,
    find_margins,
    find_observed,
    heights_of,
    make_pair,
    shapes_of,
)
from stickiness.criteria.registry import CRITERIA
from stickiness.remaining.prediction import DEFAULT_SHARE

OUTCOMES = ("missed", "compatible for some inputs", "compatible")
MISSED, SOME, COMPATIBLE = range(3)
SILENT = -1  # of a criterion, on an observation that does not test it
FACTOR = 4.0  # between the adhesion that a criterion asks for and the actual one, where it is right
FEWEST_WAVES = 5.0  # across what holds a sphere, from which the model of a sphere applies


def observed_limits(observation: Observation, predicted: Predicted) -> tuple[NDArray, NDArray]:
    """Limits ``(combination,)`` of what was observed."""
    heights = heights_of(observation, predicted.limit[1])
    return find_observed(observation, make_pair(observation, shapes_of(observation), heights))


def predicted_values(observation: Observation, predicted: Predicted) -> NDArray:
    """What is predicted of the observed quantity, ``(sign, combination)``."""
    if observation.quantity == "limiting_roughness":
        return predicted.limit
    name = "remaining" if observation.quantity == "sticks" else observation.quantity
    return predicted.values[name]


def judge_prediction(observation: Observation, predicted: Predicted) -> int:
    """Place in `OUTCOMES`, by whether limits of prediction and observation overlap."""
    low, high = observed_limits(observation, predicted)
    least, _, most = predicted_values(observation, predicted)
    if observation.quantity == "sticks":
        right = most >= DEFAULT_SHARE if observation.low else least < DEFAULT_SHARE
    else:
        right = (most >= low) & (least <= high)
    return summarise(right)


def is_value_inside(observation: Observation, predicted: Predicted) -> bool:
    """Whether the predicted value itself is right, every input in the middle."""
    low, high = (limits[MIDDLE] for limits in observed_limits(observation, predicted))
    value = predicted_values(observation, predicted)[1, MIDDLE]
    if observation.quantity == "sticks":
        return bool((value >= DEFAULT_SHARE) == bool(observation.low))
    return bool(low <= value <= high)


def judge_criteria(observation: Observation, predicted: Predicted) -> dict[str, int]:
    """Place in `OUTCOMES` of every criterion, or `SILENT`."""
    judge = judge_limits if observation.quantity == "limiting_roughness" else judge_margins
    outcomes = dict.fromkeys(CRITERIA, SILENT) | judge(observation, predicted)
    return outcomes | dict.fromkeys(observation.silent, SILENT)


def judge_limits(observation: Observation, predicted: Predicted) -> dict[str, int]:
    """Criteria against an observed limiting roughness.

    Right where they ask there for an adhesion within `FACTOR` of the actual one.
    """
    low, high = observed_limits(observation, predicted)
    lengths = find_lengths(observation, np.stack([low, high], axis=-1))
    return {
        name: summarise((ratio[:, 0] <= FACTOR) & (ratio[:, 1] >= 1 / FACTOR))
        for name, ratio in lengths.items()
    }


def judge_margins(observation: Observation, predicted: Predicted) -> dict[str, int]:
    """Criteria against whether the pair was observed to stick."""
    sticks, decided = find_sticking(observation, *observed_limits(observation, predicted))
    if not decided.any():
        return {}
    margins = find_margins(observation, predicted.limit[1])
    return {name: summarise(((margin > 1) == sticks)[decided]) for name, margin in margins.items()}


def find_sticking(observation: Observation, low: NDArray, high: NDArray) -> tuple[NDArray, NDArray]:
    """Whether the pair was observed to stick, and whether that is decided; by combination."""
    if observation.quantity == "sticks":
        return low > 0, np.ones(len(low), dtype=bool)
    of_work = observation.quantity != "relative_pull_off"
    whole = observation.inputs["work_of_adhesion"] if of_work else 1.0
    sticks = low / whole >= DEFAULT_SHARE
    return sticks, sticks | (high / whole <= DEFAULT_SHARE)


def summarise(right: NDArray) -> int:
    """Place in `OUTCOMES` of what holds for all, some or no combination of the inputs."""
    return COMPATIBLE if np.all(right) else SOME if np.any(right) else MISSED


def find_effects(observation: Observation, predicted: Predicted) -> dict[str, float]:
    """Factor by which each swept input changes the prediction, the others in the middle.

    Infinite where the prediction vanishes at one end, NaN where it does at all.
    """
    values = predicted_values(observation, predicted)[1]
    effects = {}
    for name in observation.swept:
        along = values[observation.along(name)]
        with np.errstate(divide="ignore", invalid="ignore"):
            effects[name] = float(along.max() / along.min())
    return effects
