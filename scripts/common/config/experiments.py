"""Models of config/experiments.yaml."""

from itertools import pairwise
from typing import Annotated, Any, Generic, Literal

from pydantic import WithJsonSchema, model_validator

from common.config import fields as f
from common.config.entries import OBSERVED, conditions_of
from common.config.fields import Section, needed, optional
from stickiness.criteria.registry import CRITERIA

_NEEDED = ("work_of_adhesion", "range", "hurst", "longest_wavelength", "shortest_wavelength")
_WAVES = ("shortest_wavelength", "rolloff_wavelength", "longest_wavelength")
# Quantity that a relation gives.
_RELATIONS = {
    "conformal_contact": "work_of_approach",
    "cycle_loss": "work_of_separation",
    "energy_ratio": "limiting_roughness",
}


def _ends(known):
    """Return both ends of what is plausible, or the value twice."""
    return known.get("between") or (known["value"], known["value"])


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
    def _require_its_source(cls, given):
        if not isinstance(given, dict):
            plain = f'"{given}"' if isinstance(given, str) else given
            raise ValueError(
                f"{given!r} must say how it is known: write {{value: {plain}, known: "
                "measured}, or read, recalled, assumed instead of measured"
            )
        return given


KnownLength, KnownModulus = KnownValue[f.Length], KnownValue[f.Modulus]


class Conditions(Section):
    """Conditions of an observation; those of a case replace those of its experiment."""

    radius: KnownLength = optional("radius of the sphere; without it the contact is flat on flat")
    plane_strain_modulus: KnownModulus = optional("E* of the pair")
    youngs_modulus: KnownModulus = optional("Young's modulus of the soft solid")
    poisson_ratio: KnownValue[f.Poisson] = optional("Poisson's ratio of the soft solid")
    work_of_adhesion: KnownValue[f.Energy] = optional("work of adhesion on a smooth surface")
    range: KnownLength = optional("range of the attraction")
    law: f.PredictedLaw = optional("traction law; default exponential")
    hurst: KnownValue[f.number(ge=0.01, le=1)] = optional("Hurst exponent in (0, 1]")
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
    level: f.number(gt=0, lt=1) = optional("share left at the limiting roughness; default 0.1")
    silent: f.Several[Literal[tuple(CRITERIA)]] = optional("criteria in whose terms it is stated")
    error: f.Energy = optional('error of the relation either way, e.g. "4 mJ/m^2"')
    factor: f.Interval[f.Positive] = optional("limits of the ratio of areas or of energies")

    def _problems(self, context):
        field = "value" if self.between is None else "between"
        low, high = _ends(dict(self))
        if self.relation is not None:
            quantity = _RELATIONS[self.relation]
            if self.quantity != quantity:
                yield f"quantity = {self.quantity!r} must be {quantity!r} for {self.relation!r}"
            if self.factor is None:
                yield f": the key 'factor' is missing, the limits of {self.relation!r}"
        elif self.quantity == "sticks":
            if not isinstance(low, bool) or field == "between":
                yield f"{field} = {getattr(self, field)!r} must be true or false for 'sticks'"
        elif (unit := OBSERVED[self.quantity][0]) is not None:
            try:
                low, high = f.Quantity(low, unit), f.Quantity(high, unit)
            except ValueError as error:
                yield f"{field} = {error}"
            if not low > 0:
                yield f"{field} = {getattr(self, field)!r} must be positive"
        else:
            for end in (low, high):
                if isinstance(end, bool) or not isinstance(end, int | float):
                    yield f"{field} = {end!r} must be a number"
                elif not 0 <= end <= 10:
                    yield f"{field} = {end!r} must be between 0 and 10"
        if field == "between" and not low < high:
            yield f"between = {self.between!r} must be [low, high] with low < high"


class ObservedCase(Conditions):
    """One observation, with the conditions that are its own."""

    label: f.Text = needed("name for readers")
    observed: Observed = needed("what was observed")
    missed: f.Text = optional("as of an experiment, for this case alone")


class Experiment(Conditions):
    """A published experiment, with the conditions that its cases share."""

    label: f.Text = needed("name for readers")
    short: f.Text = optional("author and year, where space is short")
    published: bool = optional("false for what needs no experiment; shown, but not counted")
    citation: f.Text = needed("full citation")
    note: f.Text = optional("what was done and what a reader should know")
    not_found: list[f.Text] = optional("what was looked for in the source and not found")
    missed: f.Text = optional("reason looked for, where the prediction misses the observation")
    cases: f.Names[ObservedCase] = needed("what was observed, by name")

    def _problems(self, context):
        experiment = self.model_dump(exclude_unset=True, warnings=False)
        for name, case in experiment["cases"].items():
            given, path = conditions_of(experiment, case), f"cases.{name}"
            is_limit = case["observed"]["quantity"] == "limiting_roughness"
            for key in _NEEDED if is_limit else (*_NEEDED, "h_rms"):
                if key not in given:
                    yield f"{path}: the key {key!r} is missing, here and in the experiment"
            if given.keys() >= {"plane_strain_modulus", "youngs_modulus"}:
                yield f"{path}: give one of plane_strain_modulus and youngs_modulus"
            of_one_solid = given.keys() >= {"youngs_modulus", "poisson_ratio"}
            if not ("plane_strain_modulus" in given or of_one_solid):
                yield f"{path}: give plane_strain_modulus, or youngs_modulus and poisson_ratio"
            # The longest of the shorter waves must be below the shortest of the longer ones.
            for shorter, longer in pairwise(key for key in _WAVES if key in given):
                most, least = _ends(given[shorter])[1], _ends(given[longer])[0]
                if not most < least:
                    text = f"{shorter} reaches {most:g} m and must stay below {longer}, {least:g} m"
                    yield f"{path}.{text}"


class Experiments(Section):
    """The file of experiments."""

    experiments: f.Names[Experiment] = needed("published experiments by name")
