"""Entries of materials and surfaces in the configuration, checked, with values in SI units.

A checked entry is a dictionary with the keys that users write. Every key is present: numbers are in
SI units, defaults are filled in, and what is absent is None. Numbers that had a unit remember their
text (`stickiness.units.Quantity`).

The models that check entries need pydantic. It is imported when an entry is checked, since most
jobs get entries that were checked before.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from stickiness.entries.errors import EntryError

__all__ = [
    "EntryError",
    "check_material",
    "check_surface",
    "list_common_materials",
    "list_measurements",
    "read_materials",
    "without_texts",
]


def check_material(entry: Mapping[str, Any], *, numbers: bool = True) -> dict[str, Any]:
    """Check an entry of a material.

    Parameters
    ----------
    entry : mapping
        Keys of a material as in docs/configuration.md. `label` and `source` may be missing, and
        None stands for what is absent, so that a checked entry may be checked again. `common`
        names one of `list_common_materials`, whose values other keys replace.
    numbers : bool
        Whether values with units may also be numbers in SI units. In files they are texts.

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
    ...         "work_of_adhesion": 0.06,
    ...         "range": "0.3 nm",
    ...     }
    ... )
    >>> tape["youngs_modulus"] / 1e3, tape["law"], tape["dwell"]
    (200.0, 'exponential', None)
    """
    from stickiness.entries.material_entry import Material

    entry = dict(entry)
    if entry.get("common") is None:
        entry = {"label": "the material", "source": "not stated"} | entry
    return _check(Material, entry, numbers)


def check_surface(entry: Mapping[str, Any], *, numbers: bool = True) -> dict[str, Any]:
    """Check an entry of a real surface; see `check_material`.

    A file that is measured is not looked for, since reading it tells more.
    """
    from stickiness.entries.surface_entry import Surface

    entry = {"label": "the surface", "source": "not stated"} | dict(entry)
    return _check(Surface, entry, numbers)


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
    import yaml

    from stickiness.entries.material_entry import Materials

    try:
        content = yaml.safe_load(Path(path).read_text(encoding="utf-8"))
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise EntryError(str(path), None, f"not valid YAML: {error}") from None
    try:
        return _check(Materials, content, numbers=False)["materials"]
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


def list_measurements(entry: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Return every measurement of a checked entry of a measured surface, with all of its keys."""
    return [dict(measurement) for measurement in entry["measurements"] or [entry]]


def _check(model: Any, content: Any, numbers: bool) -> dict[str, Any]:
    """Return the checked content of a model, or of a union of models."""
    import pydantic

    from stickiness.entries.errors import first_error

    adapter = pydantic.TypeAdapter(model)
    content = _drop_absent(content)
    try:
        checked = adapter.validate_python(content, context={"numbers": numbers, "unread": True})
    except pydantic.ValidationError as error:
        raise first_error(error, content) from None
    return adapter.dump_python(checked)


def _drop_absent(content: Any) -> Any:
    """Return a content without keys that are None."""
    if not isinstance(content, Mapping):
        return content
    return {key: _drop_absent(value) for key, value in content.items() if value is not None}
