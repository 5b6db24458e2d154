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
#: What files may leave open: asked anew of every file.
OF_FILE = ("length", "height_unit", "position_unit", "channel", "variable", "format", "pixel_size")
#: Kinds of surfaces: what they are called, their models, and their first keys with values.
SURFACES: dict[str, tuple[str, type[Section], dict[str, str]]] = {
    EXAMPLE: ("the example, a painted wall", MeasuredEntry, {"height_factor": "1", "contact": ""}),
    "measured": (
        "a file of heights",
        MeasuredEntry,
        {"length": "", "height_unit": "", "height_factor": "1", "contact": ""},
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
    "surface_texture": ("a drawing", SurfaceTextureEntry, {"Ra": "0.8 um", "RSm": "0.1 mm"}),
}
#: First keys of the material. A common material fills in some of them.
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
    "label": "name",
    "youngs_modulus": "Young's modulus",
    "poisson_ratio": "Poisson's ratio",
    "range": "range of the attraction",
    "pressed": "preload",
    "contact": "side of the contact",
    "h_rms": "rms height",
    "hurst": "Hurst exponent",
}


class Field(NamedTuple):
    """A key of the schema as a text or a choice, with a slider over decades if it has ends."""

    key: str
    title: str
    description: str
    unit: str
    text: str  #: at first
    choices: list[str]
    ends: tuple[float, float] | None  #: of the slider


def make_field(section: type[Section], key: str, text: str = "") -> Field:
    """Describe a key of a model by its schema."""
    schema = section.model_json_schema()["properties"][key]
    # One value or two may stand for a range: its unit is that of one.
    units = [each["unit"] for each in (schema, *schema.get("oneOf", ())) if "unit" in each]
    return Field(
        key=key,
        title=title(key),
        description=schema["description"],
        unit=units[0] if units else "",
        text=text,
        choices=schema.get("enum", []),
        ends=SLIDERS.get(key),
    )


def title(key: str) -> str:
    """Return what readers call a key."""
    words = TITLES.get(key, key.replace("_", " "))
    return words[0].upper() + words[1:]


def list_titles() -> dict[str, str]:
    """Titles of all fields, by key."""
    of_surfaces = [key for _, _, keys in SURFACES.values() for key in keys]
    return {key: title(key) for key in (*command.OPTIONS, *of_surfaces)}


def make_form() -> dict[str, Any]:
    """Return what the template of the form shows.

    The first fields of every kind of surface and of the material, and those behind "More": the
    other options of the command.
    """
    at_first = command.TEXTS["defaults"] | read_example("material")
    surfaces = {
        kind: (
            name,
            [make_field(section, key, text) for key, text in keys.items()],
            [
                make_field(section, key)
                for key in command.TEXTS["surface"]
                if section is MeasuredEntry and key not in ("label", *keys)
                if kind != EXAMPLE or key not in OF_FILE
            ],
        )
        for kind, (name, section, keys) in SURFACES.items()
    }
    return {
        "surfaces": surfaces,
        "material": [make_field(Material, key, at_first.get(key, "")) for key in MATERIAL],
        "more_fields": [
            make_field(Material, key)
            for key in ("label", *command.TEXTS["material"])
            if key not in ("common", *MATERIAL)
        ],
        "elastic": ELASTIC,
        "of_file": OF_FILE,
    }


def read_example(group: str) -> dict[str, str]:
    """Values that the example of the command gives, by key."""
    words = [word for word in command.TEXTS["example"][group] if word != EXAMPLE_FILE]
    keys = {option: key for key, option in command.OPTIONS.items()}
    return {keys[option]: text for option, text in zip(words[::2], words[1::2], strict=True)}
