"""What the models of the configuration are made of: sections, numbers and values with units."""

import inspect
import re
from collections.abc import Hashable
from typing import Annotated, Any, ClassVar, Literal, TypeVar

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Discriminator,
    Field,
    PlainValidator,
    Strict,
    Tag,
    ValidationInfo,
    WithJsonSchema,
    model_validator,
)

from stickiness.entries.errors import EntryError, suggest
from stickiness.plausibility import LIMITS
from stickiness.traction_laws import LAWS, PREDICTED
from stickiness.units import Quantity

T = TypeVar("T")


def complete_schema(schema: dict[str, Any], section: type["Section"]) -> None:
    """Give a JSON schema a title, a docstring, and groups of keys that exclude each other."""
    schema["title"] = re.sub("(?<=[a-z])(?=[A-Z])", " ", section.__name__).capitalize()
    schema["description"] = inspect.getdoc(section)
    for group in section.one_of:
        choices = [{"required": choice.split(" and ")} for choice in group]
        schema.setdefault("allOf", []).append({"oneOf": choices})


class Section(BaseModel):
    """Keys that stand together.

    Models check a configuration and document it. `model_dump` gives what rules and scripts get: a
    dictionary of all keys, with numbers in SI units, defaults filled in, and None for what is
    absent. The docstring of a model introduces its table in docs/configuration.md.
    """

    model_config = ConfigDict(extra="forbid", strict=True, json_schema_extra=complete_schema)
    #: Groups of choices such as "a" and "b and c", of which exactly one must be given.
    one_of: ClassVar[tuple[tuple[str, ...], ...]] = ()

    @model_validator(mode="before")
    @classmethod
    def check_keys(cls, entry: Any) -> Any:
        """Check that no key is unknown, and that of keys that exclude each other one is there."""
        if not isinstance(entry, dict):
            return entry
        for key in entry:
            if key not in cls.model_fields:
                text = f"the key is unknown; {suggest(key, cls.model_fields)}"
                raise EntryError(str(key), None, text)
        for group in cls.one_of:
            complete = [choice for choice in group if entry.keys() >= {*choice.split(" and ")}]
            if len(complete) != 1:
                raise EntryError("", None, f"give exactly one of: {'; '.join(group)}")
        return entry


def needed(text: str) -> Any:
    return Field(description=text)


def optional(text: str, default: Any = None) -> Any:
    return Field(default, description=text)


def quantity(word: str, unit: str, limits: str = "") -> Any:
    """Return the type of a text with a unit, positive and possible by the named limits.

    Entries that are made in Python (`check_material`, `check_surface`) may have numbers in SI.
    """

    def read(value: Any, info: ValidationInfo) -> Quantity:
        if isinstance(value, Quantity):
            return value
        if isinstance(value, int | float) and (info.context or {}).get("numbers"):
            value = f"{value!r} {unit}"
        number = Quantity.read(value, unit)
        if not number > 0:
            raise ValueError("must be positive")
        if limits:
            possible = LIMITS[limits]
            if not possible.least <= number <= possible.most:
                between = f"{possible.least:g} … {possible.most:g} {unit}"
                raise ValueError(f"must be in {between}: {possible.reason}")
        return number

    schema = WithJsonSchema({"type": "string", "quantity": word})
    return Annotated[Quantity, PlainValidator(read), schema]


def _check_distinct(values: list[Any]) -> list[Any]:
    # Pressures in various units are equal within rounding.
    texts = {f"{value:.9e}" if isinstance(value, float) else str(value) for value in values}
    if len(texts) < len(values):
        raise ValueError("must not repeat a value")
    return values


def _check_interval(interval: list[Any]) -> list[Any]:
    low, high = interval
    if not low < high:
        raise ValueError("must be [low, high] with low < high")
    return interval


def _count_values(value: Any) -> Hashable:
    return "pair" if isinstance(value, list | tuple) else "value"


Text = Annotated[str, Field(min_length=1)]
Name = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9._-]*$")]
Names = Annotated[dict[Name, T], Field(min_length=1)]
Several = Annotated[list[T], Field(min_length=1), AfterValidator(_check_distinct)]
AtLeastTwo = Annotated[list[T], Field(min_length=2)]
# Not strict, since Python has tuples where YAML has lists.
Pair = Annotated[list[T], Field(min_length=2, max_length=2), Strict(False)]
Interval = Annotated[Pair[T], AfterValidator(_check_interval)]
#: A value, or a list of two of them.
OneOrTwo = Annotated[
    Annotated[Pair[T], Tag("pair")] | Annotated[T, Tag("value")], Discriminator(_count_values)
]

Positive = Annotated[float, Field(gt=0)]
Share = Annotated[float, Field(gt=0, le=1)]
Poisson = Annotated[float, Field(ge=0, le=0.5)]
Count = Annotated[int, Field(ge=1, le=10000)]
Index = Annotated[int, Field(ge=0)]
Hurst = Annotated[float, Field(gt=0, le=1, description="Hurst exponent in (0, 1]")]
Law = Annotated[Literal[tuple(sorted(LAWS))], Field(description="traction law")]
PredictedLaw = Annotated[Literal[PREDICTED], Field(description="traction law")]

Length = quantity("length", "m")
WaveNumber = quantity("wave number", "1/m")
Pressure = quantity("pressure", "Pa")
Frequency = quantity("frequency", "Hz")
Time = quantity("time", "s")
Modulus = quantity("modulus", "Pa", "modulus")
Energy = quantity("energy per area", "J/m^2", "work_of_adhesion")
Range = quantity("length", "m", "range")
Thickness = quantity("length", "m", "thickness")
SkinThickness = quantity("length", "m", "skin_thickness")


class Labelled(Section):
    """Text about an entry."""

    label: Text = needed("name for readers")
    source: Text = needed("where the values or the data come from")
    note: str = optional("a remark for readers")


class Direction(Section):
    """Direction of a rough surface."""

    anisotropy: Annotated[float, Field(ge=1, le=100)] = optional(
        "long over short correlation length; default 1", 1.0
    )
    angle: Annotated[float, Field(ge=-180, le=180)] = optional(
        "of the long correlation length from x, in degrees", 0.0
    )
