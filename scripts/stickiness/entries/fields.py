"""What models are made of: sections, numbers and values with units.

Models are validated in one of two contexts. None, or one with `arguments`, is that of arguments in
Python: values with units are numbers in SI units or texts, and improbable ones are allowed. Any
other is that of files, in which values with units are texts.
"""

import inspect
import math
import re
from collections.abc import Hashable, Mapping
from functools import reduce
from operator import or_
from typing import Annotated, Any, ClassVar, Literal, TypeVar, get_args

import numpy as np
from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Discriminator,
    Field,
    GetCoreSchemaHandler,
    PlainSerializer,
    PlainValidator,
    Strict,
    Tag,
    ValidationInfo,
    WithJsonSchema,
    model_validator,
)
from pydantic_core import CoreSchema

from stickiness.entries.errors import EntryError, suggest
from stickiness.formatting import printable
from stickiness.plausibility import PLAUSIBLE
from stickiness.traction_laws import LAWS, PREDICTED
from stickiness.units import Quantity

T = TypeVar("T")


class _Absent:
    """Mark of an optional value: None is its default, but cannot be given."""

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        """Return the schema of the value that can be given."""
        kinds = [kind for kind in get_args(source) if kind is not type(None)]
        return handler(reduce(or_, kinds))


Maybe = Annotated[T | None, _Absent()]
#: Values are written as they are; a float would lose its text.
KEPT = PlainSerializer(lambda value: value)


def complete_schema(schema: dict[str, Any], section: type["Section"]) -> None:
    """Give a JSON schema a title, a docstring, and groups of keys that exclude each other."""
    title = re.sub("(?<=[a-z])(?=[A-Z])", " ", section.__name__.removesuffix("Entry"))
    schema["title"] = title.capitalize()
    introduction, *_ = (inspect.getdoc(section) or "").partition("\n\nParameters\n")
    schema["description"] = introduction
    for key in section.only_in_python:
        del schema["properties"][key]
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
    #: Keys with values that no file can hold.
    only_in_python: ClassVar[tuple[str, ...]] = ()

    @model_validator(mode="before")
    @classmethod
    def check_keys(cls, entry: Any, info: ValidationInfo) -> Any:
        """Check that no key is unknown, and that of keys that exclude each other one is there."""
        if not isinstance(entry, dict):
            return entry
        unusable = () if info.context is None else cls.only_in_python
        known = [key for key in cls.model_fields if key not in unusable]
        for key in entry:
            if key not in known:
                text = f"the key is unknown; {suggest(key, known)}"
                raise EntryError(str(key), None, text)
        for group in cls.one_of:
            complete = [choice for choice in group if entry.keys() >= {*choice.split(" and ")}]
            if len(complete) != 1:
                raise EntryError("", None, f"give exactly one of: {'; '.join(group)}")
        return entry

    def fill_in(self, key: str, value: Any) -> None:
        """Give a key a value that was not given, also where the section cannot be changed."""
        self.__dict__[key] = value


def needed(text: str) -> Any:
    return Field(description=text)


def optional(text: str, default: Any = None) -> Any:
    """Return an optional field; the text tells its default, unless that is None or false."""
    if default not in (None, False) and "default" not in text:
        text = f"{text}; default {'true' if default is True else default}"
    return Field(default, description=text)


def quantity(word: str, unit: str, limits: str = "", zero: bool = False) -> Any:
    """Return the type of a value with a unit, positive and possible by the named limits.

    With `zero`, Python may have it, too, for what is absent in files.
    """

    def read(value: Any, info: ValidationInfo) -> float:
        return read_quantity(value, info, unit, limits, zero)

    schema = WithJsonSchema({"type": "string", "quantity": word, "unit": unit})
    return Annotated[float, PlainValidator(read), KEPT, schema]


def read_quantity(
    value: Any, info: ValidationInfo, unit: str, limits: str = "", zero: bool = False
) -> float:
    """Return a value in its SI unit; see `quantity`."""
    if isinstance(value, Quantity):
        return value
    if info.context is None or info.context.get("arguments"):
        return _read_argument(value, unit, limits, zero)
    quantity = Quantity.read(value, unit)
    if not 0 < quantity < math.inf:
        raise ValueError("must be positive and finite")
    if limits:
        possible = PLAUSIBLE[limits]
        if not possible.least <= quantity <= possible.most:
            between = f"{possible.least:g} … {possible.most:g} {unit}"
            raise ValueError(f"must be in {between}: {possible.reason}")
    return quantity


def _read_argument(value: Any, unit: str, limits: str, zero: bool) -> float:
    """Return a text with a unit, or a number in SI units, that need not be probable."""
    if isinstance(value, str):
        quantity: float = Quantity.read(value, unit)
    else:
        array = np.asarray(value)
        if array.ndim or array.dtype.kind not in "iuf":
            raise ValueError(f"must be a number in {unit}, or a text with its unit")
        quantity = float(array)
    if not (0 < quantity < math.inf or (zero and quantity == 0)):
        raise ValueError(f"must be {'zero or ' if zero else ''}positive and finite")
    if limits and not 1e-30 <= quantity <= 1e30:  # else products of it may leave floats
        raise ValueError(f"must be between 1e-30 and 1e30 {unit}: {PLAUSIBLE[limits].reason}")
    return quantity


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


def _show(text: str) -> str:
    if not (shown := printable(text)):
        raise ValueError("must have characters that can be shown")
    return shown


def _count_values(value: Any) -> Hashable:
    return "pair" if isinstance(value, list | tuple) else "value"


Text = Annotated[str, Field(min_length=1)]
Shown = Annotated[Text, AfterValidator(_show)]
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
Law = Annotated[Literal[tuple(sorted(LAWS))], Field(description="traction law")]  # type: ignore[valid-type]
PredictedLaw = Annotated[Literal[PREDICTED], Field(description="traction law")]  # type: ignore[valid-type]

Length = quantity("length", "m")
WaveNumber = quantity("wave number", "1/m")
Pressure = quantity("pressure", "Pa")
Frequency = quantity("frequency", "Hz")
Time = quantity("time", "s")
Pressed = quantity("pressure", "Pa", zero=True)
Modulus = quantity("modulus", "Pa", "youngs_modulus")
Energy = quantity("energy per area", "J/m^2", "work_of_adhesion")
Range = quantity("length", "m", "range")
Thickness = quantity("length", "m", "thickness")
SkinThickness = quantity("length", "m", "skin_thickness")


class Labelled(Section):
    """Text about an entry."""

    #: Texts of an entry outside files, where they may be missing.
    unstated: ClassVar[dict[str, str]]

    label: Shown = needed("name for readers")
    source: Shown = needed("where the values or the data come from")
    note: Maybe[Annotated[str, AfterValidator(printable)]] = optional("a remark for readers")

    @classmethod
    def complete(cls, entry: Mapping[str, Any]) -> dict[str, Any]:
        """Return an entry with texts about it; a common material has its own."""
        return dict(entry) if entry.get("common") is not None else cls.unstated | dict(entry)


class Direction(Section):
    """Direction of a rough surface."""

    anisotropy: Annotated[float, Field(ge=1, le=100)] = optional(
        "long over short correlation length; default 1", 1.0
    )
    angle: Annotated[float, Field(ge=-180, le=180)] = optional(
        "of the long correlation length from x, in degrees", 0.0
    )


def document(section: type[Labelled]) -> None:
    """Give a class that users make in Python a docstring and a signature, from its keys."""
    types = {"string": "str", "boolean": "bool", "number": "float", "integer": "int"}
    schemas = section.model_json_schema()["properties"]
    lines = ["Parameters", "----------"]
    parameters = []
    for key, field in section.model_fields.items():
        schema = schemas.get(key, {})
        unit = schema.get("unit")
        kind = f"float [{unit}] or str" if unit else types.get(schema.get("type", ""), "")
        lines += [f"{key} : {kind}".rstrip(" :"), f"    {field.description}"]
        default = inspect.Parameter.empty if field.is_required() else field.default
        default = section.unstated.get(key, default)
        parameters.append(inspect.Parameter(key, inspect.Parameter.KEYWORD_ONLY, default=default))
    introduction, heading, rest = (inspect.getdoc(section) or "").partition("Raises\n")
    section.__doc__ = introduction + "\n".join([*lines, "", heading]) + rest
    section.__signature__ = inspect.Signature(parameters)
