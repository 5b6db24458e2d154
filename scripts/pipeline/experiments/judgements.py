"""Whether predictions hold against observations, and which criterion survives them."""

import numpy as np
from numpy.typing import NDArray

from pipeline.experiments.entries import Observation
from pipeline.experiments.predictions import (
    Predicted,
    find_margins,
    find_observed,
    find_roughness,
    heights_of,
    make_pair,
    shapes_of,
)
from stickiness.remaining.prediction import DEFAULT_SHARE

OUTCOMES = ("missed", "within for some inputs", "within")
MISSED, SOME, WITHIN = range(3)
SILENT = -1  # of a criterion, on an observation that decides nothing
FACTOR = 2.0  # between the observed roughness and that of a criterion that is right
NOTHING = 1e-3  # share of the work of adhesion that counts as none where effects are compared


def observed_limits(observation: Observation, predicted: Predicted) -> tuple[NDArray, NDArray]:
    """Limits ``(combination,)`` of what was observed."""
    heights = heights_of(observation, predicted.tenth[1])
    return find_observed(observation, make_pair(observation, shapes_of(observation), heights))


def predicted_values(observation: Observation, predicted: Predicted) -> NDArray:
    """What is predicted of the observed quantity, ``(sign, combination)``."""
    if observation.quantity == "roughness_at_a_tenth":
        return predicted.tenth
    name = "remaining" if observation.quantity == "sticks" else observation.quantity
    return predicted.values[name]


def judge_prediction(observation: Observation, predicted: Predicted) -> int:
    """Place in `OUTCOMES`: limits of the prediction against those of the observation."""
    low, high = observed_limits(observation, predicted)
    least, _, most = predicted_values(observation, predicted)
    if observation.quantity == "sticks":
        right = most >= DEFAULT_SHARE if observation.low else least < DEFAULT_SHARE
    else:
        right = (most >= low) & (least <= high)
    return summarise(right)


def judge_criteria(observation: Observation, predicted: Predicted) -> dict[str, int]:
    """Place in `OUTCOMES` of every criterion, or `SILENT`."""
    low, high = observed_limits(observation, predicted)
    if observation.quantity == "roughness_at_a_tenth":
        found = find_roughness(observation)
        return {
            name: SILENT
            if np.isnan(h).any()
            else summarise((h * FACTOR >= low) & (h <= high * FACTOR))
            for name, h in found.items()
        }
    sticks, decided = find_sticking(observation, low, high)
    margins = find_margins(observation, predicted.tenth[1])
    return {
        name: summarise(((margin[:, 0] > 1) == sticks)[decided]) if decided.any() else SILENT
        for name, margin in margins.items()
    }


def find_sticking(observation: Observation, low: NDArray, high: NDArray) -> tuple[NDArray, NDArray]:
    """Whether the pair was observed to stick, and whether that is decided; by combination."""
    if observation.quantity == "sticks":
        return low > 0, np.ones(len(low), dtype=bool)
    of_work = observation.quantity != "relative_pull_off"
    whole = observation.inputs["work_of_adhesion"] if of_work else 1.0
    sticks = low / whole >= DEFAULT_SHARE
    return sticks, sticks | (high / whole < DEFAULT_SHARE)


def summarise(right: NDArray) -> int:
    """Place in `OUTCOMES` of what holds for all, some or no combination of the inputs."""
    return WITHIN if np.all(right) else SOME if np.any(right) else MISSED


def find_effects(observation: Observation, predicted: Predicted) -> dict[str, float]:
    """Factor by which each swept input changes the prediction, the others in the middle."""
    values = predicted_values(observation, predicted)[1]
    if observation.quantity.startswith("work"):
        values = values / observation.inputs["work_of_adhesion"]
    if observation.quantity != "roughness_at_a_tenth":
        values = np.maximum(values, NOTHING)
    effects = {}
    for name in observation.axes:
        along = values[observation.along(name)]
        effects[name] = float(along.max() / along.min())
    return effects
