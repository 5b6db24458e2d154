"""Files of YAML: materials of the command, and the configuration of the workflow."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import yaml


class YamlError(ValueError):
    """A file is no YAML with keys and values; the message does not name it."""


_Loader: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)  # libyaml where it is built in


class _UniqueKeys(_Loader):  # type: ignore[misc]  # known when it runs
    """Loader that refuses a key given twice, of which YAML would keep the second."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Any, Any]:
        seen = set()
        for key, _ in node.value:
            if key.value in seen and key.value != "<<":
                problem = f"the key {key.value!r} is given twice"
                raise yaml.constructor.ConstructorError(
                    problem=problem, problem_mark=key.start_mark
                )
            seen.add(key.value)
        return super().construct_mapping(node, deep)


def read_yaml(path: str | Path) -> dict[str, Any]:
    """Read a file of keys and values.

    Raises
    ------
    YamlError
        If it is not valid, with the line and what is wrong.
    FileNotFoundError
        If there is none.
    """
    try:
        text = Path(path).read_text(encoding="utf-8")
        content = yaml.load(text, _UniqueKeys)
    except FileNotFoundError:
        raise
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", "it is no text in UTF-8")
        raise YamlError(f"cannot be read as YAML: {reason}") from None
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        problem = getattr(error, "problem", error)
        line = f"line {mark.line + 1}: " if mark else ""
        if mark and "\t" in "".join(text.splitlines()[mark.line : mark.line + 1]):
            problem = "it holds a tab: indent with blanks"
        raise YamlError(f"{line}not valid YAML: {problem}") from None
    if not isinstance(content, dict):
        found = "nothing" if content is None else type(content).__name__
        raise YamlError(f"must hold keys and values, found {found}")
    return content
