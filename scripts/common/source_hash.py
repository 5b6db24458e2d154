"""What code a script runs, as a hash that comments, docstrings and layout do not change."""

import contextlib
import hashlib
import json
import os
import re
import sys
from bisect import bisect_left
from dis import Bytecode, opmap
from functools import cache
from pathlib import Path
from types import CodeType
from typing import Any

NOP = opmap["NOP"]
# In the folder of the run; another Python compiles to something else.
MEMORY = Path(f".snakemake/code-{sys.implementation.cache_tag}.json")

# The module, and what is imported of it: between parentheses, or on one line; or modules alone.
# A syntax tree would say the same, but building it takes as long as all the rest.
IMPORT = re.compile(
    r"^[ \t]*(?:from[ \t]+([\w.]+)[ \t]+import[ \t]+(?:\(([^)]*)\)|(.*))|import[ \t]+(.*))", re.M
)


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
    text = "\n".join(f"{name}: {read(path)[0]}" for name, path in names)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


@cache
def read(path: Path) -> tuple[str, list[str]]:
    """Hash of what a file is compiled to, and full names of all that it imports.

    A file that is as it was when a run before this one read it, by time of change and size, is
    not compiled again.
    """
    status = path.stat()
    stamp = [status.st_mtime_ns, status.st_size]
    known, *found = memory().get(str(path), [None])
    if known != stamp:
        found = [instructions(path), names_imported(path.read_text(encoding="utf-8"))]
        memory()[str(path)] = [stamp, *found]
    return tuple(found)


@cache
def memory() -> dict[str, list[Any]]:
    """What runs found in files, by path; it is empty if it cannot be read."""
    try:
        return json.loads(MEMORY.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}


def remember() -> None:
    """Keep what was found in files for the next run, where the folder may be written to."""
    with contextlib.suppress(OSError):
        MEMORY.parent.mkdir(exist_ok=True)
        part = MEMORY.with_suffix(f".{os.getpid()}")
        part.write_text(json.dumps(memory()), encoding="utf-8")
        part.replace(MEMORY)


def instructions(path: Path) -> str:
    """Hash of what a file is compiled to, without docstrings, assertions and line numbers."""
    code = compile(path.read_bytes(), path.name, "exec", optimize=2)
    return hashlib.sha256(repr(parts_of(code)).encode()).hexdigest()


def parts_of(constant: Any) -> Any:
    """A compiled constant as something whose text is always the same."""
    if isinstance(constant, CodeType):
        names = constant.co_names, constant.co_varnames, constant.co_freevars, constant.co_cellvars
        counts = constant.co_argcount, constant.co_posonlyargcount, constant.co_kwonlyargcount
        inner = [parts_of(each) for each in constant.co_consts]
        return constant.co_name, constant.co_flags, counts, names, *work_of(constant), inner
    return sorted(map(repr, constant)) if isinstance(constant, frozenset) else constant


def work_of(code: CodeType) -> tuple[bytes, list[tuple[int, ...]]]:
    """Instructions, and which of them stand under which handler of exceptions.

    Left out are instructions that do nothing, one of which is left of a docstring.
    """
    kept = [i for i in range(0, len(code.co_code), 2) if code.co_code[i] != NOP]
    handled = [
        (*(bisect_left(kept, at) for at in (e.start, e.end, e.target)), e.depth, e.lasti)
        for e in Bytecode(code).exception_entries
    ]
    return b"".join(code.co_code[i : i + 2] for i in kept), handled


@cache
def imports(path: Path, scripts: Path) -> frozenset[Path]:
    """Files below `scripts` that a file imports, packages on the way to them included."""
    return frozenset(file for name in read(path)[1] for file in files_of(name, scripts))


def names_imported(text: str) -> list[str]:
    """Full names of all that a text imports, each of which may be a module."""
    names = []
    for module, several, some, modules in IMPORT.findall(re.sub(r"#.*", "", text)):
        listed = (several or some or modules).split(",")
        first = [part.split()[0] for part in listed if part.strip()]
        names += [f"{module}.{name}" if module else name for name in first]
    return names


def files_of(module: str, scripts: Path) -> list[Path]:
    """Files that are read when a module is imported; none for what lies elsewhere."""
    parts, known = module.split("."), find_modules(scripts)
    names = (".".join(parts[: end + 1]) for end in range(len(parts)))
    return [known[name] for name in names if name in known]


@cache
def find_modules(scripts: Path) -> dict[str, Path]:
    """Files below `scripts` by the full names of their modules."""
    paths = {path.relative_to(scripts).with_suffix(""): path for path in scripts.rglob("*.py")}
    names = {place.as_posix().replace("/", "."): path for place, path in paths.items()}
    return {name.removesuffix(".__init__"): path for name, path in names.items()}
