"""Hash of the code that a script runs. Comments, docstrings and layout do not change it."""

import ast
import contextlib
import hashlib
import json
import os
from functools import cache
from pathlib import Path

SCRIPTS = Path(__file__).parents[1]
CACHE = Path(".snakemake/source_hashes.json")  # below the folder of the run


def source_hash(script: str) -> str:
    """Return a hash of a script, given by its path below ``scripts/``, and of its imports there.

    A rule has it among its parameters, so that a job runs again when its code changes.
    """
    digests, queue = {}, [SCRIPTS / script]
    while queue:
        path = queue.pop()
        if path not in digests:
            digests[path], imported = read_source(path)
            queue += [find_modules()[name] for name in imported if name in find_modules()]
    lines = sorted(f"{path.relative_to(SCRIPTS)}: {digest}" for path, digest in digests.items())
    return hashlib.sha256("\n".join(lines).encode()).hexdigest()[:16]


@cache
def find_modules() -> dict[str, Path]:
    files = {path.relative_to(SCRIPTS).with_suffix(""): path for path in SCRIPTS.rglob("*.py")}
    return {".".join(name.parts).removesuffix(".__init__"): path for name, path in files.items()}


@cache
def read_source(path: Path) -> tuple[str, list[str]]:
    """Return the hash of one file and the names it imports; parse it only if it has changed."""
    stamp = [path.stat().st_mtime_ns, path.stat().st_size]
    entry = load_cache().get(str(path))
    if entry is None or entry[0] != stamp:
        tree = ast.parse(path.read_bytes())
        for node in ast.walk(tree):
            documented = ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef
            if isinstance(node, documented) and ast.get_docstring(node, clean=False) is not None:
                del node.body[0]
        digest = hashlib.sha256(ast.dump(tree).encode()).hexdigest()
        entry = load_cache()[str(path)] = [stamp, digest, sorted(imported_names(tree))]
    return entry[1], entry[2]


def imported_names(tree: ast.Module) -> set[str]:
    """Dotted names of everything imported, and of the packages on the way to it."""
    names = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import | ast.ImportFrom):
            package = f"{node.module}." if isinstance(node, ast.ImportFrom) else ""
            names |= {package + alias.name for alias in node.names}
    parts = (name.split(".") for name in names)
    return {".".join(each[: end + 1]) for each in parts for end in range(len(each))}


@cache
def load_cache() -> dict[str, list]:
    with contextlib.suppress(OSError, ValueError):
        return json.loads(CACHE.read_text(encoding="utf-8"))
    return {}


def save_cache() -> None:
    """Keep what was found for the next run, where the folder may be written to."""
    with contextlib.suppress(OSError):
        CACHE.parent.mkdir(exist_ok=True)
        part = CACHE.with_suffix(f".{os.getpid()}")  # other runs never read half a file
        part.write_text(json.dumps(load_cache()), encoding="utf-8")
        part.replace(CACHE)
