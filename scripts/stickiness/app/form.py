"""The form of the app, made from the schema of materials and surfaces."""

from __future__ import annotations

from typing import Any, NamedTuple

from stickiness import command
from stickiness.entries.fields import Section
from stickiness.entries.material import Material
from stickiness.entries.surface_entry import MeasuredEntry, SelfAffineEntry, SurfaceTextureEntry
from stickiness.plausibility import PLAUSIBLE

EXAMPLE = "example"
EXAMPLE_FILE = command.TEXTS["example"]["surface"][0]
#: Kinds of surfaces: what they are called, their models, and their keys with values at first.
SURFACES: dict[str, tuple[str, type[Section], dict[str, str]]] = {
    EXAMPLE: ("the example, a painted wall", MeasuredEntry, {"contact": ""}),
    "measured": (
        "a file of heights",
        MeasuredEntry,
        dict.fromkeys(("length", "height_unit", "position_unit", "channel", "contact"), ""),
    ),
    "self_affine": (
        "a spectrum",
        SelfAffineEntry,
        {
            "hurst": "0.8",
            "h_rms": "1 um",
            "longest_wavelength": "0.2 mm",
            "shortest_wavelength": "1 nm",
        },
    ),
    "surface_texture": ("a drawing", SurfaceTextureEntry, {"Ra": "0.8 um", "RSm": ""}),
}
#: Keys of the material. A common material fills in the first four.
ELASTIC = ("youngs_modulus", "work_of_adhesion", "range", "poisson_ratio")
MATERIAL = (*ELASTIC, "thickness", "pressed")
#: Ends of the sliders in SI units. A text may go beyond.
SLIDERS = {
    "youngs_modulus": (1e3, 1e10),
    "work_of_adhesion": (1e-3, PLAUSIBLE["work_of_adhesion"].usual),
    "thickness": (1e-7, PLAUSIBLE["thickness"].usual),
    "pressed": (1e3, 1e8),
    "h_rms": (1e-9, 1e-4),
    "height_factor": (0.1, 10.0),
}
#: What readers call keys whose own words they do not know.
TITLES = {
    "youngs_modulus": "Young's modulus",
    "poisson_ratio": "Poisson's ratio",
    "pressed": "preload",
    "h_rms": "rms height",
    "hurst": "Hurst exponent",
}


class Field(NamedTuple):
    """A key of the schema as a text of the form, with a slider over decades if it has ends."""

    key: str
    title: str
    description: str
    unit: str
    text: str  #: at first
    hint: str  #: the plausible range
    ends: tuple[float, float] | None  #: of the slider


def make_field(section: type[Section], key: str, text: str) -> Field:
    """Describe a key of a model by its schema."""
    schema = section.model_json_schema()["properties"][key]
    # One value or two may stand for a range: its unit is that of one.
    units = [each["unit"] for each in (schema, *schema.get("oneOf", ())) if "unit" in each]
    unit = units[0] if units else ""
    limits = PLAUSIBLE.get(key)
    return Field(
        key=key,
        title=title(key),
        description=schema["description"],
        unit=unit,
        text=text,
        hint=f"{limits.least:g} to {limits.most:g} {unit}" if limits else "",
        ends=SLIDERS.get(key),
    )


def title(key: str) -> str:
    """Return what readers call a key."""
    words = TITLES.get(key, key.replace("_", " "))
    return words[0].upper() + words[1:]


def list_titles() -> dict[str, str]:
    """Titles of all fields, by key."""
    of_surfaces = [key for _, _, keys in SURFACES.values() for key in keys]
    return {key: title(key) for key in (*MATERIAL, *of_surfaces, "height_factor")}


def make_form() -> dict[str, Any]:
    """Return what the template of the form shows: fields of the surfaces and of the material."""
    factor = {"height_factor": "1"}
    at_first = command.TEXTS["defaults"] | dict(read_example("material"))
    return {
        "surfaces": {
            kind: (
                name,
                [
                    make_field(section, key, text)
                    for key, text in (keys | (factor if section is MeasuredEntry else {})).items()
                ],
            )
            for kind, (name, section, keys) in SURFACES.items()
        },
        "material": [make_field(Material, key, at_first.get(key, "")) for key in MATERIAL],
        "elastic": ELASTIC,
    }


def read_example(group: str) -> dict[str, str]:
    """Values that the example of the command gives, by key."""
    words = [word for word in command.TEXTS["example"][group] if word != EXAMPLE_FILE]
    keys = {option: key for key, option in command.OPTIONS.items()}
    return {keys[option]: text for option, text in zip(words[::2], words[1::2], strict=True)}
