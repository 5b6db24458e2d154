"""Hash of the code that a script runs. Comments, docstrings and layout do not change it.

A table of a module, which has its name and lies beside it, is part of its code.

`source_hash` and `save_cache` share one `SourceReader`, which parses every file once a run and
keeps what it read for the next run.
"""

import ast
import contextlib
import hashlib
import json
import os
from functools import cached_property
from pathlib import Path

SCRIPTS = Path(__file__).parents[1]
# What starts every script changes no result.
NO_PART = {"common.job"}


class SourceReader:
    """Digests and imports of the modules in a folder, kept in a file from run to run.

    Attributes
    ----------
    scripts
        Folder of the modules.
    cache
        File that keeps the entries, below the folder of the run.
    entries
        By path: time and size of the file, its digest, and the names that it imports.
    """

    def __init__(self, scripts: Path, cache: Path):
        self.scripts = scripts
        self.cache = cache
        self.checked = set()  # paths whose entries were compared with their files in this run

    @cached_property
    def entries(self) -> dict[str, list]:
        """Entries of earlier runs, to which this run adds its own."""
        with contextlib.suppress(OSError, ValueError):
            return json.loads(self.cache.read_text(encoding="utf-8"))
        return {}

    @cached_property
    def modules(self) -> dict[str, Path]:
        """Files by dotted name."""
        modules = {}
        for path in self.scripts.rglob("*.py"):
            parts = path.relative_to(self.scripts).with_suffix("").parts
            modules[".".join(parts).removesuffix(".__init__")] = path
        return modules

    def hash(self, script: str) -> str:
        """Hash of a script and of everything that it imports, directly or not."""
        digests = {}
        queue = [self.scripts / script]
        while queue:
            path = queue.pop()
            if path not in digests:
                digests[path], imported = self.read(path)
                names = self.modules.keys() & ({*imported} - NO_PART)
                queue += [self.modules[name] for name in names]
                table = path.with_suffix(".csv")
                queue += [table] if table.exists() else []
        lines = sorted(f"{path.relative_to(self.scripts)}: {d}" for path, d in digests.items())
        return hashlib.sha256("\n".join(lines).encode()).hexdigest()[:16]

    def read(self, path: Path) -> tuple[str, list[str]]:
        """Return the digest of one file and the names it imports; parse it only if it changed."""
        key = str(path)
        if key not in self.checked:
            status = path.stat()
            stamp = [status.st_mtime_ns, status.st_size]
            if key not in self.entries or self.entries[key][0] != stamp:
                self.entries[key] = [stamp, *parse(path)]
            self.checked.add(key)
        _, digest, imported = self.entries[key]
        return digest, imported

    def save(self) -> None:
        """Keep the entries for the next run, where the folder may be written to."""
        with contextlib.suppress(OSError):
            self.cache.parent.mkdir(exist_ok=True)
            part = self.cache.with_suffix(f".{os.getpid()}")  # other runs never read half a file
            part.write_text(json.dumps(self.entries), encoding="utf-8")
            part.replace(self.cache)


def parse(path: Path) -> tuple[str, list[str]]:
    """Return the digest of the code of a file without its docstrings, and the names it imports."""
    if path.suffix != ".py":
        return hashlib.sha256(path.read_bytes()).hexdigest(), []
    tree = ast.parse(path.read_bytes())
    for node in ast.walk(tree):
        documented = ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef
        if isinstance(node, documented) and ast.get_docstring(node, clean=False) is not None:
            del node.body[0]
    digest = hashlib.sha256(ast.dump(tree).encode()).hexdigest()
    return digest, sorted(imported_names(tree))


def imported_names(tree: ast.Module) -> set[str]:
    """Dotted names of everything imported, and of the packages on the way to it."""
    names = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import | ast.ImportFrom):
            package = f"{node.module}." if isinstance(node, ast.ImportFrom) else ""
            names |= {package + alias.name for alias in node.names}
    parts = [name.split(".") for name in names]
    return {".".join(each[: end + 1]) for each in parts for end in range(len(each))}


#: Reader of this project's scripts, for one run of the workflow.
READER = SourceReader(SCRIPTS, Path(".snakemake/source_hashes.json"))


def source_hash(script: str) -> str:
    """Return a hash of a script, given by its path below ``scripts/``, and of its imports there.

    A rule has it among its parameters, so that a job runs again when its code changes.
    """
    return READER.hash(script)


def save_cache() -> None:
    """Keep what was read for the next run."""
    READER.save()
