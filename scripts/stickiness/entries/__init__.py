"""What may be said of materials and surfaces: their keys, with types, defaults, limits and texts.

`material` has the class that users make in Python and that files and the command fill,
`surface_entry` the descriptions that become a `Surface`. Both are models of pydantic, which is
imported when one is used.

A checked entry is a dictionary with the keys that users write. Every key is present: numbers are in
SI units, defaults are filled in, and what is absent is None. Numbers that had a unit remember their
text (`stickiness.units.Quantity`).
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from stickiness.entries.errors import EntryError

if TYPE_CHECKING:
    from stickiness.entries.fields import Section

__all__ = [
    "EntryError",
    "check_drawing",
    "check_heights",
    "check_material",
    "check_surface",
    "describe_keys",
    "list_common_materials",
    "list_measurements",
    "read_materials",
    "without_texts",
]


def check_material(entry: Mapping[str, Any]) -> dict[str, Any]:
    """Check an entry of a material, as files have it: values with units are texts.

    Parameters
    ----------
    entry : mapping
        Keys of a material as in docs/configuration.md. `label` and `source` may be missing, and
        None stands for what is absent, so that a checked entry may be checked again. `common`
        names one of `list_common_materials`, whose values other keys replace.

    Returns
    -------
    dict
        The checked entry.

    Raises
    ------
    EntryError
        If a key is unknown or missing, or has a value that cannot be used.

    Examples
    --------
    >>> tape = check_material(
    ...     {
    ...         "youngs_modulus": "0.2 MPa",
    ...         "poisson_ratio": 0.5,
    ...         "work_of_adhesion": "60 mJ/m^2",
    ...         "range": "0.3 nm",
    ...     }
    ... )
    >>> tape["youngs_modulus"] / 1e3, tape["law"], tape["dwell"]
    (200.0, 'exponential', None)
    """
    from stickiness.entries.material import Material

    return _check(Material, Material.complete(entry), {})


def check_surface(entry: Mapping[str, Any], *, arguments: bool = False) -> dict[str, Any]:
    """Check an entry of a real surface; see `check_material`.

    With `arguments` of Python, values with units may be numbers in SI units, too. A file that is
    measured is not looked for, since reading it tells more.
    """
    from stickiness.entries.surface_entry import AnySurface, SurfaceEntry

    context = {"arguments": arguments, "unread": True}
    return _check(AnySurface, SurfaceEntry.complete(entry), context)


def check_heights(options: Mapping[str, Any]) -> dict[str, Any]:
    """Check how heights in an array are analysed, with all keys in return.

    Lengths are numbers in m or texts with a unit; a ValueError says what is wrong.
    """
    from stickiness.entries.surface_entry import HeightsEntry

    return _check_arguments(HeightsEntry, options)


def check_drawing(parameters: Mapping[str, Any]) -> dict[str, Any]:
    """Check parameters of profiles on a drawing; see `check_heights`."""
    from stickiness.entries.surface_entry import SurfaceTextureEntry

    entry = SurfaceTextureEntry.complete({"kind": "surface_texture", **parameters})
    return _check_arguments(SurfaceTextureEntry, entry)


def without_texts(entry: Mapping[str, Any]) -> dict[str, Any]:
    """Return an entry without what only readers need, which must not start a simulation."""
    return {key: value for key, value in entry.items() if key not in ("label", "source", "note")}


def read_materials(path: str | Path) -> dict[str, dict[str, Any]]:
    """Read a YAML file of the form ``materials: {my_tape: {…}}``.

    Parameters
    ----------
    path : path
        The file; its keys are those of docs/configuration.md.

    Returns
    -------
    dict
        Checked entries by name.

    Raises
    ------
    EntryError
        If the file is not valid YAML, or if an entry is wrong.
    OSError
        If the file cannot be read.
    """
    from stickiness.entries.material import Materials
    from stickiness.entries.yaml_files import YamlError, read_yaml

    try:
        content = read_yaml(path)
    except YamlError as error:
        raise EntryError(str(path), None, str(error)) from None
    try:
        return _check(Materials, content, {})["materials"]
    except EntryError as error:
        key = f"{path}: {error.key}" if error.key else str(path)
        raise EntryError(key, error.value, error.message) from None


def list_common_materials() -> dict[str, dict[str, Any]]:
    """Return the entries of common materials by name, checked.

    Examples
    --------
    >>> print(list_common_materials()["natural_rubber"]["youngs_modulus"])
    1 MPa
    """
    from stickiness.entries.common_materials import read_common_materials

    return {name: check_material(entry) for name, entry in read_common_materials().items()}


def describe_keys(kind: str) -> dict[str, str]:
    """Return what the keys of a "material" or of a measured "surface" mean, by key.

    Examples
    --------
    >>> print(describe_keys("surface")["missing_value"])
    number that marks missing points besides NaN
    """
    from stickiness.entries.material import Material
    from stickiness.entries.surface_entry import MeasuredEntry

    models: dict[str, type[Section]] = {"material": Material, "surface": MeasuredEntry}
    texts = {}
    for key, schema in models[kind].model_json_schema()["properties"].items():
        text = schema["description"]
        *others, last = schema.get("enum", [""])
        if not all(choice in text for choice in (*others, last)):
            text = f"{', '.join(others)} or {last}: {text}"
        texts[key] = text
    return texts


def list_measurements(entry: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Return every measurement of a checked entry of a measured surface, with all of its keys."""
    return [dict(measurement) for measurement in entry["measurements"] or [entry]]


def _check_arguments(model: Any, arguments: Mapping[str, Any]) -> dict[str, Any]:
    """Return the checked arguments of a function."""
    from stickiness.entries.errors import argument_error

    try:
        return _check(model, arguments, None)
    except EntryError as error:
        raise argument_error(error) from None


def _check(model: Any, content: Any, context: dict[str, Any] | None) -> dict[str, Any]:
    """Return the checked content of a model, or of a union of models; `fields` has contexts."""
    import pydantic

    from stickiness.entries.errors import first_error

    adapter = pydantic.TypeAdapter(model)
    content = _drop_absent(content)
    try:
        checked = adapter.validate_python(content, context=context)
    except pydantic.ValidationError as error:
        raise first_error(error, content) from None
    return adapter.dump_python(checked)


def _drop_absent(content: Any) -> Any:
    """Return a content without keys that are None."""
    if not isinstance(content, Mapping):
        return content
    return {key: _drop_absent(value) for key, value in content.items() if value is not None}
