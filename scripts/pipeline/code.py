"""What code a script runs, as a hash that comments, docstrings and layout do not change."""

from __future__ import annotations

import ast
import hashlib
from collections.abc import Iterator
from functools import cache
from pathlib import Path


def code_of(scripts: str, script: str) -> str:
    """Hash of the syntax of a rule's script and of all that it imports from below `scripts`.

    Parameters
    ----------
    scripts : str
        Folder of all scripts and packages.
    script : str
        As the rule names it, relative to the folder of rules.
    """
    folder = Path(scripts)
    first = Path(scripts, "..", "rules", script).resolve()
    found, todo = {first}, [first]
    while todo:
        for path in imports(todo.pop(), folder):
            if path not in found:
                found.add(path)
                todo.append(path)
    names = sorted((path.relative_to(folder).as_posix(), path) for path in found)
    text = "\n".join(f"{name}: {syntax(path)}" for name, path in names)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


@cache
def syntax(path: Path) -> str:
    """The syntax tree of a file as text, without docstrings."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    for node in ast.walk(tree):
        body = getattr(node, "body", None)
        if isinstance(body, list) and body and is_text(body[0]):
            node.body = body[1:]
    return ast.dump(tree)


def is_text(statement: ast.stmt) -> bool:
    """Whether a statement is nothing but a string."""
    value = getattr(statement, "value", None) if isinstance(statement, ast.Expr) else None
    return isinstance(value, ast.Constant) and isinstance(value.value, str)


@cache
def imports(path: Path, scripts: Path) -> tuple[Path, ...]:
    """Files below `scripts` that a file imports, packages on the way to them included."""
    return tuple(
        file
        for module in modules(ast.parse(path.read_text(encoding="utf-8")))
        for file in files_of(module, scripts)
    )


def modules(tree: ast.Module) -> Iterator[str]:
    """Names that are imported anywhere in a file and may be modules."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def files_of(module: str, scripts: Path) -> Iterator[Path]:
    """Files that are read when a module is imported; none for what lies elsewhere."""
    path = scripts
    for part in module.split("."):
        path = path / part
        file = (
            path.with_suffix(".py") if path.with_suffix(".py").is_file() else path / "__init__.py"
        )
        if file.is_file():
            yield file
