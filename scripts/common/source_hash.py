"""Hash of the code that a script runs. Comments, docstrings and layout do not change it."""

import ast
import contextlib
import hashlib
import json
import os
from functools import cache
from pathlib import Path

SCRIPTS = Path(__file__).parents[1]
DOCUMENTED = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
CACHE = Path(".snakemake/source_hashes.json")  # below the folder of the run


def source_hash(script: str) -> str:
    """Return a hash of a script and of all modules below ``scripts/`` that it imports.

    A rule has it among its parameters, so that a job runs again when its code changes.

    Parameters
    ----------
    script : str
        Path below ``scripts/``, such as ``"adhesion/solve_adhesive.py"``.
    """
    found, queue = {}, [SCRIPTS / script]
    while queue:
        path = queue.pop()
        if path not in found:
            found[path], names = read_source(path)
            queue += [modules()[name] for name in names if name in modules()]
    lines = sorted(f"{path.relative_to(SCRIPTS)}: {digest}" for path, digest in found.items())
    return hashlib.sha256("\n".join(lines).encode()).hexdigest()[:16]


@cache
def modules() -> dict[str, Path]:
    """Files below ``scripts/`` by the dotted names under which they are imported."""
    files = {path.relative_to(SCRIPTS).with_suffix(""): path for path in SCRIPTS.rglob("*.py")}
    return {".".join(name.parts).removesuffix(".__init__"): path for name, path in files.items()}


@cache
def read_source(path: Path) -> tuple[str, list[str]]:
    """Return the hash of one file and the names it imports; parse it only if it has changed."""
    stamp = [path.stat().st_mtime_ns, path.stat().st_size]
    entry = load_cache().get(str(path))
    if entry is None or entry[0] != stamp:
        tree = normalise(ast.parse(path.read_bytes()))
        digest = hashlib.sha256(ast.dump(tree).encode()).hexdigest()
        entry = load_cache()[str(path)] = [stamp, digest, sorted(imported_names(tree))]
    return entry[1], entry[2]


def normalise(tree: ast.Module) -> ast.Module:
    """Remove the docstrings; a syntax tree has neither comments nor layout."""
    for node in ast.walk(tree):
        if isinstance(node, DOCUMENTED) and ast.get_docstring(node, clean=False) is not None:
            del node.body[0]
    return tree


def imported_names(tree: ast.Module) -> set[str]:
    """Dotted names of everything imported, and of the packages on the way to it."""
    names = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
    parts = (name.split(".") for name in names)
    return {".".join(each[: end + 1]) for each in parts for end in range(len(each))}


@cache
def load_cache() -> dict[str, list]:
    """Read what earlier runs found, by path; nothing if there is no such file."""
    with contextlib.suppress(OSError, ValueError):
        return json.loads(CACHE.read_text(encoding="utf-8"))
    return {}


def save_cache() -> None:
    """Keep what was found for the next run, where the folder may be written to."""
    text = json.dumps(load_cache())
    with contextlib.suppress(OSError):
        if CACHE.exists() and CACHE.read_text(encoding="utf-8") == text:
            return
        CACHE.parent.mkdir(exist_ok=True)
        part = CACHE.with_suffix(f".{os.getpid()}")
        part.write_text(text, encoding="utf-8")
        part.replace(CACHE)
