"""Experiments of the configuration in SI units, with everything that is not known swept."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stickiness.config.experiment_entries import CONDITIONS, conditions_of
from stickiness.core.units import si

GRADES = ("read", "recalled", "assumed")
LENGTHS = ("longest_wavelength", "rolloff_wavelength", "shortest_wavelength")
SHAPE = ("hurst", *LENGTHS)
OBSERVED_UNITS = {
    "relative_pull_off": None,
    "roughness_at_a_tenth": "m",
    "work_of_approach": "J/m^2",
    "work_of_separation": "J/m^2",
    "sticks": None,
}
BOUNDS = 3  # values of a swept input: low, geometric middle (from zero the mean), high


@dataclass(frozen=True)
class Observation:
    """One observation, and the conditions it was made under.

    `inputs` has, by name, arrays of one value for every combination of what is plausible; `axes`
    the values of every input that is swept. Combination `middle` has all of them in the middle.
    """

    experiment: str
    name: str
    label: str
    quantity: str
    low: float  # limits of what was observed, or of the factor of the relation; 0 or 1 of "sticks"
    high: float
    relation: str | None  # that was observed, in place of a number
    error: float  # of the relation
    inputs: dict[str, NDArray]
    axes: dict[str, NDArray]
    grades: dict[str, str]  # by input and, under its quantity, of what was observed

    @property
    def middle(self) -> int:
        """Index of the combination with every input in the middle."""
        sizes = [len(values) for values in self.axes.values()]
        return int(np.ravel_multi_index([size // 2 for size in sizes], sizes)) if sizes else 0

    def along(self, name: str) -> NDArray:
        """Indices of the combinations along one swept input, the others in the middle."""
        sizes = [len(values) for values in self.axes.values()]
        indices = np.arange(np.prod(sizes, dtype=int)).reshape(sizes)
        every = slice(None)
        place = [every if key == name else len(v) // 2 for key, v in self.axes.items()]
        return indices[tuple(place)]


def read_observations(experiments: Mapping[str, Any]) -> Iterator[Observation]:
    """Every case of every experiment, in the order of the configuration."""
    for experiment, entry in experiments.items():
        for name, case in entry["cases"].items():
            yield read_observation(experiment, name, entry, case)


def read_observation(experiment: str, name: str, entry: Any, case: Any) -> Observation:
    """One case of an experiment."""
    conditions = conditions_of(entry, case)
    values = {key: read_values(given, CONDITIONS[key]) for key, given in conditions.items()}
    axes = {key: found for key, found in values.items() if len(found) > 1}
    combined = np.array(list(product(*axes.values())))
    inputs = {key: np.full(len(combined), found[0]) for key, found in values.items()}
    inputs |= dict(zip(axes, combined.T, strict=True))
    observed = case["observed"]
    low, high = read_observed(observed)
    grades = {key: given["known"] for key, given in conditions.items()}
    return Observation(
        experiment=experiment,
        name=name,
        label=case["label"],
        quantity=observed["quantity"],
        low=low,
        high=high,
        relation=observed.get("relation"),
        error=si(observed["error"], "J/m^2") if "error" in observed else 0.0,
        inputs=with_modulus(inputs),
        axes=axes,
        grades=grades | {observed["quantity"]: observed["known"]},
    )


def read_values(given: Any, unit: str | None) -> NDArray:
    """The value, or `BOUNDS` of them between the limits."""
    if "value" in given:
        return np.array([read_number(given["value"], unit)])
    low, high = (read_number(value, unit) for value in given["between"])
    return np.geomspace(low, high, BOUNDS) if low > 0 else np.linspace(low, high, BOUNDS)


def read_observed(observed: Any) -> tuple[float, float]:
    """Limits of what was observed, equal if one value is given, or of a relation's factor."""
    if "relation" in observed:
        low, high = observed.get("factor", (1.0, 1.0))
        return low, high
    unit = OBSERVED_UNITS[observed["quantity"]]
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
