"""What the models of the configuration are made of: sections, numbers and values with units."""

import difflib
import inspect
import re
from collections.abc import Callable, Iterable
from typing import Annotated, Any, ClassVar, Literal, TypeVar

import pydantic
from pydantic import AfterValidator, BaseModel, ConfigDict, Field, PlainValidator

from stickiness.plausibility import LIMITS
from stickiness.traction_laws import LAWS, PREDICTED
from stickiness.units import si

T = TypeVar("T")


def _complete_schema(schema, section):
    """Give a JSON schema a title, a docstring, and groups of keys that exclude each other."""
    schema["title"] = re.sub("(?<=[a-z])(?=[A-Z])", " ", section.__name__).capitalize()
    schema["description"] = inspect.getdoc(section)
    for group in section.one_of:
        choices = [{"required": choice.split(" and ")} for choice in group]
        schema.setdefault("allOf", []).append({"oneOf": choices})


class Section(BaseModel):
    """Keys that stand together.

    Models check a configuration and document it; rules and scripts receive the plain dictionaries
    that were checked. The docstring of a model introduces its table in docs/configuration.md.
    An error goes on behind the path of the key: with a colon, a dot and a further key, or else with
    its value.
    """

    model_config = ConfigDict(extra="forbid", strict=True, json_schema_extra=_complete_schema)
    #: Groups of choices such as "a" and "b and c", of which exactly one must be given.
    one_of: ClassVar[tuple[tuple[str, ...], ...]] = ()

    @pydantic.model_validator(mode="before")
    @classmethod
    def _check_keys(cls, given):
        if not isinstance(given, dict):
            return given
        fields = cls.model_fields
        for key in [key for key in given if key not in fields]:
            raise ValueError(f": unknown key {key!r}; {suggest(key, fields)}")
        for key, field in fields.items():
            if field.is_required() and key not in given:
                meaning = f" ({field.description})" if field.description else ""
                raise ValueError(f": the key {key!r} is missing{meaning}")
        for group in cls.one_of:
            if sum(given.keys() >= {*choice.split(" and ")} for choice in group) != 1:
                raise ValueError(f": give exactly one of: {'; '.join(group)}")
        return given

    @pydantic.model_validator(mode="after")
    def _check_together(self, info: pydantic.ValidationInfo):
        for problem in self._problems(info.context or {}):
            raise ValueError(problem if problem.startswith(":") else f".{problem}")
        return self

    def _problems(self, context):
        """Yield what is wrong with several keys together: ``: …`` or ``key = value …``."""
        return ()


class Quantity(float):
    """A value in SI units, written as it was given: ``'50 um'``."""

    def __new__(cls, text: str, unit: str) -> "Quantity":
        """Read a text; a ValueError says what is wrong with it."""
        value = super().__new__(cls, si(text, unit))
        value.text = text
        return value

    def __repr__(self) -> str:
        return repr(self.text)


def unknown(key: str, value: str, known: Iterable[str]) -> str:
    """Say that a name is unknown, and which may be meant."""
    return f"{key} = {value!r} is unknown; {suggest(value, known)}"


def suggest(value: Any, known: Iterable[str]) -> str:
    """Ask whether the closest of the known names is meant; without one, list them all."""
    known = list(known)
    close = difflib.get_close_matches(str(value), known, n=1)
    return f"did you mean {close[0]!r}?" if close else f"choose one of {', '.join(known)}"


def needed(text: str) -> Any:
    return Field(description=text)


def optional(text: str) -> Any:
    return Field(None, description=text)


def demand(test: Callable[[Any], bool], text: str) -> AfterValidator:
    """Return the check of a value by a test; `text` says what the value must be."""

    def check(value: Any) -> Any:
        if not test(value):
            raise ValueError(f"{value!r} {text}")
        return value

    return AfterValidator(check)


def choose(test: Callable[[Any], bool], met: Any, otherwise: Any) -> Any:
    """Return the type of a value that is `met` if it passes the test, else `otherwise`."""
    return Annotated[
        Annotated[met, pydantic.Tag("<met>")] | Annotated[otherwise, pydantic.Tag("<otherwise>")],
        pydantic.Discriminator(lambda value: "<met>" if test(value) else "<otherwise>"),
    ]


def by_type(kind: type, of_kind: Any, otherwise: Any) -> Any:
    """Return the type of a value that is `of_kind` if it is a `kind`, else `otherwise`."""
    return choose(lambda value: isinstance(value, kind), of_kind, otherwise)


def number(**limits: float) -> Any:
    return Annotated[float, Field(**limits)]


def whole(**limits: int) -> Any:
    return Annotated[int, Field(**limits)]


def one_or_two(kind: Any) -> Any:
    """Return the type of a value or of a list of two of them."""
    return by_type(list, Pair[kind], kind)


def both(first: Any, second: Any) -> Any:
    """Return the type of a list of two values of different types."""
    return Annotated[tuple[first, second], Field(strict=False)]


def quantity(word: str, unit: str, limits: str = "") -> Any:
    """Return the type of a text with a unit, positive and possible by the named limits."""

    def read(given: Any) -> "Quantity":
        value = Quantity(given, unit)
        if not value > 0:
            raise ValueError(f"{given!r} must be positive")
        if limits and not (one := LIMITS[limits]).least <= value <= one.most:
            between = f"{one.least:g} … {one.most:g} {unit}"
            raise ValueError(f"{given!r} must be in {between}: {one.reason}")
        return value

    schema = pydantic.WithJsonSchema({"type": "string", "quantity": word})
    return Annotated[Quantity, PlainValidator(read), schema]


def _differ(values):
    # Pressures in various units are equal within rounding.
    texts = {f"{value:.9e}" if isinstance(value, float) else str(value) for value in values}
    return len(texts) == len(values)


Text = Annotated[str, Field(min_length=1)]
Name = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9._-]*$")]
Names = Annotated[dict[Name, T], Field(min_length=1)]
Several = Annotated[list[T], Field(min_length=1), demand(_differ, "must not repeat a value")]
AtLeastTwo = Annotated[list[T], Field(min_length=2)]
Pair = Annotated[list[T], Field(min_length=2, max_length=2)]
Interval = Annotated[
    Pair[T], demand(lambda pair: pair[0] < pair[1], "must be [low, high] with low < high")
]

Positive = number(gt=0)
Share = number(gt=0, le=1)
Poisson = number(ge=0, le=0.5)
Count = whole(ge=1, le=10000)
CoarseCount = whole(ge=32, le=10000)
Index = whole(ge=0)
Pixels = whole(ge=4, multiple_of=2)
Values = Several[Positive]
Loads = Annotated[Values, Field(description="mean pressures over E* q0 h_rms")]
Hurst = Annotated[float, Field(gt=0, le=1, description="Hurst exponent in (0, 1]")]
Magnification = Annotated[float, Field(gt=1, description="q1/q0, above 1")]
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


class Labelled(Section):
    """Text about an entry."""

    label: Text = needed("name for readers")
    source: Text = needed("where the values or the data come from")
    note: str = optional("a remark for readers")


class Grid(Section):
    """Values spaced evenly on a logarithmic axis."""

    minimum: Positive = needed("smallest value")
    maximum: Positive = needed("largest value")
    per_decade: whole(ge=1, le=200) = needed("values per decade")

    def _problems(self, context):
        if not self.minimum < self.maximum:
            yield f"minimum = {self.minimum:g} must be below maximum = {self.maximum:g}"
