"""Models of config/experiments.yaml."""

from itertools import pairwise
from typing import Annotated, Any, Generic, Literal, Self

from pydantic import Field, WithJsonSchema, model_validator

from common.config.conditions import OBSERVED, conditions_of
from stickiness.criteria.registry import CRITERIA
from stickiness.entries import fields as f
from stickiness.entries.errors import EntryError
from stickiness.entries.fields import Section, needed, optional
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.traction_laws import EXPONENTIAL
from stickiness.units import Quantity

_NEEDED = ("work_of_adhesion", "range", "hurst", "longest_wavelength", "shortest_wavelength")
_WAVES = ("shortest_wavelength", "rolloff_wavelength", "longest_wavelength")
# Quantity that a relation gives.
_RELATIONS = {
    "conformal_contact": "work_of_approach",
    "cycle_loss": "work_of_separation",
    "energy_ratio": "limiting_roughness",
}


def _find_ends(known: dict[str, Any]) -> list[Any]:
    """Return both ends of what is plausible, or the value twice."""
    return known["between"] or [known["value"], known["value"]]


class KnownValue(Section, Generic[f.T]):
    """A value and how it is known, e.g. `{value: "0.3 nm", known: assumed}`."""

    one_of = (("value", "between"),)

    # The reference shows one table for the values of all keys.
    value: Annotated[f.T, WithJsonSchema({})] = optional("the value, with its unit if it has one")
    between: Annotated[f.Interval[f.T], WithJsonSchema({})] = optional("[low, high]; swept")
    known: Literal["measured", "read", "recalled", "assumed"] = needed(
        "measured: by you; read: stands in a public text that was read; recalled: known from the "
        "literature, not checked; assumed: chosen or inferred here"
    )
    note: f.Text = optional("where it stands or why it was assumed")

    @classmethod
    def model_parametrized_name(cls, params):
        """Return one name for all types, by which the reference calls them."""
        return cls.__name__

    @model_validator(mode="before")
    @classmethod
    def check_source(cls, entry: Any) -> Any:
        """Check that a value says how it is known."""
        if not isinstance(entry, dict):
            plain = f'"{entry}"' if isinstance(entry, str) else entry
            raise ValueError(
                f"must say how it is known: write {{value: {plain}, known: measured}}, or read, "
                "recalled, assumed instead of measured"
            )
        return entry


KnownLength = KnownValue[f.Length]
KnownModulus = KnownValue[f.Modulus]


class Conditions(Section):
    """Conditions of an observation; those of a case replace those of its experiment."""

    radius: KnownLength = optional("radius of the sphere; without it the contact is flat on flat")
    plane_strain_modulus: KnownModulus = optional("E* of the pair")
    youngs_modulus: KnownModulus = optional("Young's modulus of the soft solid")
    poisson_ratio: KnownValue[f.Poisson] = optional("Poisson's ratio of the soft solid")
    work_of_adhesion: KnownValue[f.Energy] = optional("work of adhesion on a smooth surface")
    range: KnownLength = optional("range of the attraction")
    law: f.PredictedLaw = optional("traction law; default exponential")
    hurst: KnownValue[Annotated[float, Field(ge=0.01, le=1)]] = optional("Hurst exponent in (0, 1]")
    longest_wavelength: KnownLength = optional("longest wavelength of the roughness")
    rolloff_wavelength: KnownLength = optional("wavelength above which the spectrum is flat")
    shortest_wavelength: KnownLength = optional("shortest wavelength of the roughness")
    h_rms: KnownLength = optional("rms height")


class Observed(KnownValue[Any]):
    """What was observed.

    The quantity is the pull-off force over that from a smooth surface, the rms height at which it
    falls to a level, the apparent work of adhesion on approach or separation, the share of the work
    of adhesion that remains, or whether the pair sticks (a value of true or false).

    Relations are evaluated with the inputs of the case. `conformal_contact`: the work of approach
    is the work of adhesion on the true area less the elastic energy of full contact. `cycle_loss`:
    the work of separation exceeds the work of approach by the work of adhesion on the true area.
    `energy_ratio`: adhesion is lost where the work of adhesion is `factor` times the energy of full
    contact.
    """

    one_of = (("value", "between", "relation"),)

    # In the unit of the quantity, by which the order is checked.
    between: f.Pair[Any] = optional("what is plausible, [low, high]")
    quantity: Literal[tuple(OBSERVED)] = needed("what was observed")
    relation: Literal[tuple(_RELATIONS)] = optional("a relation that was reported")
    level: Annotated[float, Field(gt=0, lt=1)] = optional(
        "share left at the limiting roughness; default 0.1", DEFAULT_SHARE
    )
    silent: f.Several[Literal[tuple(CRITERIA)]] = optional("criteria in whose terms it is stated")
    error: f.Energy = optional('error of the relation either way, e.g. "4 mJ/m^2"')
    factor: f.Interval[f.Positive] = optional("limits of the ratio of areas or of energies")

    @model_validator(mode="after")
    def check_observation(self) -> Self:
        """Check an observation by its quantity, and give its values their unit."""
        unit, _ = OBSERVED[self.quantity]
        if self.relation is not None:
            self._check_relation()
        elif self.quantity == "sticks":
            if not isinstance(self.value, bool):
                text = "must be true or false for 'sticks'"
                raise EntryError(*self._find_value(), text)
        elif unit is not None:
            self._read_values(unit)
        else:
            self._check_numbers()
        if self.between is not None and not self.between[0] < self.between[1]:
            raise EntryError("between", self.between, "must be [low, high] with low < high")
        return self

    def _find_value(self) -> tuple[str, Any]:
        """Return the key that holds the value, and the value."""
        return ("between", self.between) if self.value is None else ("value", self.value)

    def _check_relation(self) -> None:
        quantity = _RELATIONS[self.relation]
        if self.quantity != quantity:
            text = f"must be {quantity!r} for {self.relation!r}"
            raise EntryError("quantity", self.quantity, text)
        if self.factor is None:
            text = f"the key is missing, the limits of {self.relation!r}"
            raise EntryError("factor", None, text)

    def _read_values(self, unit: str) -> None:
        key, value = self._find_value()
        texts = value if isinstance(value, list) else [value]
        try:
            numbers = [Quantity.read(text, unit) for text in texts]
        except ValueError as error:
            raise EntryError(key, None, str(error)) from None
        if not min(numbers) > 0:
            raise EntryError(key, value, "must be positive")
        setattr(self, key, numbers if isinstance(value, list) else numbers[0])

    def _check_numbers(self) -> None:
        key, value = self._find_value()
        for end in value if isinstance(value, list) else [value]:
            if isinstance(end, bool) or not isinstance(end, int | float):
                raise EntryError(key, end, "must be a number")
            if not 0 <= end <= 10:
                raise EntryError(key, end, "must be between 0 and 10")


class ObservedCase(Conditions):
    """One observation, with the conditions that are its own."""

    label: f.Text = needed("name for readers")
    observed: Observed = needed("what was observed")
    missed: f.Text = optional("as of an experiment, for this case alone")


class Experiment(Conditions):
    """A published experiment, with the conditions that its cases share."""

    label: f.Text = needed("name for readers")
    law: f.PredictedLaw = optional("traction law; default exponential", EXPONENTIAL)
    short: f.Text = optional("author and year, where space is short")
    published: bool = optional("false for what needs no experiment; shown, but not counted", True)
    citation: f.Text = needed("full citation")
    note: f.Text = optional("what was done and what a reader should know")
    not_found: list[f.Text] = optional("what was looked for in the source and not found")
    missed: f.Text = optional("reason looked for, where the prediction misses the observation")
    cases: f.Names[ObservedCase] = needed("what was observed, by name")

    @model_validator(mode="after")
    def check_cases(self) -> Self:
        """Check that every case has all conditions, and that these agree."""
        experiment = self.model_dump()
        for name, case in experiment["cases"].items():
            conditions = conditions_of(experiment, case)
            path = f"cases.{name}"
            is_limit = case["observed"]["quantity"] == "limiting_roughness"
            for key in _NEEDED if is_limit else (*_NEEDED, "h_rms"):
                if key not in conditions:
                    text = "the key is missing, here and in the experiment"
                    raise EntryError(f"{path}.{key}", None, text)
            if conditions.keys() >= {"plane_strain_modulus", "youngs_modulus"}:
                text = "give one of plane_strain_modulus and youngs_modulus"
                raise EntryError(path, None, text)
            of_one_solid = conditions.keys() >= {"youngs_modulus", "poisson_ratio"}
            if not ("plane_strain_modulus" in conditions or of_one_solid):
                text = "give plane_strain_modulus, or youngs_modulus and poisson_ratio"
                raise EntryError(path, None, text)
            # The longest of the shorter waves must be below the shortest of the longer ones.
            for shorter, longer in pairwise(key for key in _WAVES if key in conditions):
                most = _find_ends(conditions[shorter])[1]
                least = _find_ends(conditions[longer])[0]
                if not most < least:
                    text = f"reaches {most!r} and must stay below {longer}, {least!r}"
                    raise EntryError(f"{path}.{shorter}", None, text)
        return self


class Experiments(Section):
    """The file of experiments."""

    experiments: f.Names[Experiment] = needed("published experiments by name")
