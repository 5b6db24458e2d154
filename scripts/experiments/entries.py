"""Experiments of the configuration in SI units, with everything that is not known swept."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from common.config.entries import CONDITIONS, OBSERVED_UNITS, conditions_of
from stickiness.remaining.prediction import DEFAULT_SHARE
from stickiness.units import si

GRADES = ("measured", "read", "recalled", "assumed")
SHAPE = ("hurst", "longest_wavelength", "rolloff_wavelength", "shortest_wavelength")
MIDDLE = 0  # index of the combination with every input in the middle


@dataclass(frozen=True)
class Observation:
    """One observation, and the conditions it was made under.

    `inputs` has, by name, arrays of one value for every combination of what is plausible: first all
    inputs in the middle, then each at its low and high end, the others in the middle, then all
    corners. `swept` are the names of the inputs that are not known.
    """

    experiment: str
    name: str
    label: str
    published: bool
    quantity: str
    low: float  # limits of what was observed, or of the factor of the relation; 0 or 1 of "sticks"
    high: float
    level: float  # share of the adhesion that is left at a limiting roughness
    relation: str | None  # that was observed, in place of a number
    error: float  # of the relation
    silent: tuple[str, ...]  # criteria that it does not test
    inputs: dict[str, NDArray]
    swept: tuple[str, ...]
    grades: dict[str, str]  # by input and, under its quantity, of what was observed

    def along(self, name: str) -> NDArray:
        """Indices of the combinations along one swept input, the others in the middle."""
        low = 1 + 2 * self.swept.index(name)
        return np.array([low, MIDDLE, low + 1])


def read_observations(experiments: Mapping[str, Any]) -> Iterator[Observation]:
    """Every case of every experiment, in the order of the configuration."""
    for experiment, entry in experiments.items():
        for name, case in entry["cases"].items():
            yield read_observation(experiment, name, entry, case)


def read_observation(experiment: str, name: str, entry: Any, case: Any) -> Observation:
    """One case of an experiment."""
    conditions = conditions_of(entry, case)
    ends = {key: read_ends(given, CONDITIONS[key]) for key, given in conditions.items()}
    swept = tuple(key for key, found in ends.items() if len(found) > 1)
    observed = case["observed"]
    low, high = read_observed(observed)
    grades = {key: given["known"] for key, given in conditions.items()}
    return Observation(
        experiment=experiment,
        name=name,
        label=case["label"],
        published=entry.get("published", True),
        quantity=observed["quantity"],
        low=low,
        high=high,
        level=observed.get("level", DEFAULT_SHARE),
        relation=observed.get("relation"),
        error=si(observed["error"], "J/m^2") if "error" in observed else 0.0,
        silent=tuple(observed.get("silent", ())),
        inputs=with_modulus(combine_inputs(ends, swept)),
        swept=swept,
        grades=grades | {observed["quantity"]: observed["known"]},
    )


def combine_inputs(ends: Mapping[str, NDArray], swept: tuple[str, ...]) -> dict[str, NDArray]:
    """Values of every input for all combinations; see `Observation`."""
    # Places of the swept inputs between their ends: 0 low, 1 middle, 2 high.
    places = [[1] * len(swept)]
    for axis in range(len(swept)):
        places += [[end if i == axis else 1 for i in range(len(swept))] for end in (0, 2)]
    places = np.array([*places, *(list(corner) for corner in product((0, 2), repeat=len(swept)))])
    inputs = {key: np.full(len(places), found[0]) for key, found in ends.items()}
    for axis, key in enumerate(swept):
        low, high = ends[key]
        middle = np.sqrt(low * high) if low > 0 else high / 2
        inputs[key] = np.array([low, middle, high])[places[:, axis]]
    return inputs


def read_ends(given: Any, unit: str | None) -> NDArray:
    """The value, or both limits."""
    values = given["between"] if "between" in given else [given["value"]]
    return np.array([read_number(value, unit) for value in values])


def read_observed(observed: Any) -> tuple[float, float]:
    """Limits of what was observed, equal if one value is given, or of a relation's factor."""
    if "relation" in observed:
        low, high = observed["factor"]
        return low, high
    unit = OBSERVED_UNITS.get(observed["quantity"])
    given = observed["between"] if "between" in observed else [observed["value"]] * 2
    low, high = (read_number(value, unit) for value in given)
    return low, high


def read_number(value: Any, unit: str | None) -> float:
    return float(value) if unit is None else si(value, unit)


def with_modulus(inputs: dict[str, NDArray]) -> dict[str, NDArray]:
    """The inputs with E* as `modulus`, from Young's modulus if that is given."""
    if "plane_strain_modulus" in inputs:
        return inputs | {"modulus": inputs["plane_strain_modulus"]}
    return inputs | {"modulus": inputs["youngs_modulus"] / (1 - inputs["poisson_ratio"] ** 2)}
