"""What code a script runs, as a hash that comments, docstrings and layout do not change."""

import ast
import hashlib
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from types import CodeType
from typing import Any

DOCUMENTED = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)


def code_of(scripts: str, script: str) -> str:
    """Hash of a rule's script and of all that it imports from below the folder `scripts`.

    `script` is as the rule names it, relative to the folder of rules.
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
    text = "\n".join(f"{name}: {instructions(path)}" for name, path in names)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


@cache
def parsed(path: Path) -> tuple[ast.Module, list[str]]:
    """Syntax tree of a file without docstrings, and the names it imports that may be modules."""
    tree, names = ast.parse(path.read_text(encoding="utf-8")), []
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            names += [f"{node.module}.{alias.name}" for alias in node.names]
        elif isinstance(node, DOCUMENTED) and ast.get_docstring(node, clean=False) is not None:
            node.body = node.body[1:] or [ast.copy_location(ast.Pass(), node.body[0])]
    return tree, names


@cache
def instructions(path: Path) -> str:
    """What a file is compiled to, without docstrings, assertions and line numbers, as text."""
    return repr(parts_of(compile(parsed(path)[0], path.name, "exec", optimize=2)))


def parts_of(constant: Any) -> Any:
    """A compiled constant as something whose text is always the same."""
    if isinstance(constant, CodeType):
        names = constant.co_names, constant.co_varnames, constant.co_freevars, constant.co_cellvars
        counts = constant.co_argcount, constant.co_posonlyargcount, constant.co_kwonlyargcount
        inner = [parts_of(each) for each in constant.co_consts]
        return constant.co_name, constant.co_flags, counts, names, constant.co_code, inner
    return sorted(map(repr, constant)) if isinstance(constant, frozenset) else constant


@cache
def imports(path: Path, scripts: Path) -> tuple[Path, ...]:
    """Files below `scripts` that a file imports, packages on the way to them included."""
    return tuple(file for module in parsed(path)[1] for file in files_of(module, scripts))


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
