"""Errors of the configuration: which key is wrong, its value, and what would be right."""

from __future__ import annotations

import difflib
import math
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:  # pydantic takes long to import, and jobs do not need it
    import pydantic


class EntryError(ValueError):
    """A key is unknown or missing, or its value cannot be used.

    Parameters
    ----------
    key : str
        The key, with dots and indices: ``cases.mine.pressures[1]``; may be empty.
    value : object
        Its value; None if there is none, or if it is the whole section.
    message : str
        What is wrong, or what would be right.
    """

    def __init__(self, key: str, value: Any, message: str) -> None:
        self.key = key
        self.value = value
        self.message = message
        shown = key if value is None else f"{key} = {value!r}"
        super().__init__(f"{shown}: {message}" if shown else message)


def argument_error(error: EntryError) -> ValueError:
    """Return the error as of an argument in Python: ``range must be positive, got -1.0``."""
    wanted, colon, reason = error.message.partition(":")
    if error.key and error.value is not None and wanted.startswith("must "):
        return ValueError(f"{error.key} {wanted}, got {error.value!r}{colon}{reason}")
    return error


def suggest(value: Any, names: Iterable[str]) -> str:
    """Ask whether the closest of the names is meant; without one, list them all."""
    names = list(names)
    close = difflib.get_close_matches(str(value), names, n=1)
    return f"did you mean {close[0]!r}?" if close else f"choose one of {', '.join(names)}"


def first_error(error: pydantic.ValidationError, content: Mapping[str, Any]) -> EntryError:
    """Return the first error that pydantic found in the content of a file or of an entry."""
    problem = error.errors()[0]
    key = _find_key(problem, content)
    reason = problem.get("ctx", {}).get("error")
    if isinstance(reason, EntryError):
        inner = reason.key
        separator = "." if key and inner and not inner.startswith("[") else ""
        return EntryError(f"{key}{separator}{inner}", reason.value, reason.message)
    value = problem["input"]
    # Messages about units begin with the text, which stands before them already.
    message = problem["msg"] if reason is None else str(reason).removeprefix(repr(value))
    message = message.lstrip(": ").replace("Input should", "must")
    if problem["type"] == "union_tag_invalid":
        value = problem["ctx"]["tag"]
        message = f"must be one of {problem['ctx']['expected_tags']}"
    if problem["type"] == "float_type" and isinstance(value, str):
        message += _ask_for_number(value)
    if problem["type"] == "string_type" and not isinstance(value, str | list | Mapping):
        message = "must be a text: YAML reads a number, a date or a truth value; put it in quotes"
    if problem["type"] == "string_too_short":
        message = "must not be empty"
    if problem["type"] == "missing":
        message = "the key is missing"
    if problem["type"] == "literal_error":
        message = f"must be one of {problem['ctx']['expected'].replace(' or ', ', ')}"
    if problem["type"] == "too_long":
        message = f"must have at most {problem['ctx']['max_length']} values"
    if problem["type"] == "too_short":
        message = f"must have at least {problem['ctx']['min_length']} values"
    # The value of a whole section would be too long for one line.
    if problem["type"] == "missing" or isinstance(value, Mapping):
        value = None
    return EntryError(key, value, message)


def _ask_for_number(text: str) -> str:
    """Ask for the number that is meant by a text in place of one."""
    is_share = text.rstrip().endswith("%")
    digits = text.rstrip(" %").replace(",", ".")
    try:
        number = float(digits) / (100 if is_share else 1)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        return ""
    # What YAML reads as a text, although it looks like a number.
    hint = "; leave off quotes, and write 1.0e-2 for 1e-2"
    return f"; did you mean {number:g}?" if is_share or "," in text else hint


def _find_key(problem: Any, content: Any) -> str:
    """Return the key of an error, without pydantic's names of alternatives."""
    key = ""
    for step in problem["loc"]:
        if isinstance(content, list | tuple) and isinstance(step, int):
            key += f"[{step}]"
            content = content[step] if step < len(content) else None
        elif isinstance(content, Mapping) and step in content:
            key += f".{step}"
            content = content[step]
    if problem["type"] == "missing":
        last = problem["loc"][-1]
        key += f"[{last}]" if isinstance(last, int) else f".{last}"
    if problem["type"].startswith("union_tag"):
        key += "." + problem["ctx"]["discriminator"].strip("'")
    return key.lstrip(".")
