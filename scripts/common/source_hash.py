"""Hash of the code that a script runs. Comments, docstrings and layout do not change it."""

import ast
import hashlib
from functools import cache
from pathlib import Path

SCRIPTS = Path(__file__).parents[1]


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
def read_source(path: Path) -> tuple[str, set[str]]:
    """Return the hash of one file, and the names it imports with the packages on the way."""
    tree, names = ast.parse(path.read_bytes()), set()
    for node in ast.walk(tree):
        match node:
            case ast.Import() | ast.ImportFrom():
                package = f"{node.module}." if isinstance(node, ast.ImportFrom) else ""
                names |= {package + alias.name for alias in node.names}
            case ast.Module() | ast.ClassDef() | ast.FunctionDef() | ast.AsyncFunctionDef():
                if ast.get_docstring(node, clean=False) is not None:
                    del node.body[0]
    parts = (name.split(".") for name in names)
    imported = {".".join(each[: end + 1]) for each in parts for end in range(len(each))}
    return hashlib.sha256(ast.dump(tree).encode()).hexdigest(), imported
