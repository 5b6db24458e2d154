"""The hash of a job's code follows what it runs, and nothing else."""

import ast
from pathlib import Path

import pytest

from common import source_hash as code


@pytest.fixture
def hashed(tmp_path):
    """A script that uses one module of a package, and a function that hashes it."""
    files = {
        "scripts/stage/rule.py": "from part import used\n\n\ndef main():\n    return used.one()\n",
        "scripts/part/__init__.py": '"""A part."""\n',
        "scripts/part/used.py": "def one():\n    return 1\n",
        "scripts/part/unused.py": "def two():\n    return 2\n",
    }
    (tmp_path / "rules").mkdir()
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text, encoding="utf-8")

    def hash_now():
        for cached in (code.read, code.memory, code.imports, code.find_modules):
            cached.cache_clear()
        return code.code_of(str(tmp_path / "scripts"), "../scripts/stage/rule.py")

    return tmp_path / "scripts", hash_now


@pytest.mark.parametrize("name", ["stage/rule.py", "part/used.py", "part/__init__.py"])
def test_a_change_of_what_runs_changes_it(hashed, name):
    folder, hash_now = hashed
    before = hash_now()
    with (folder / name).open("a", encoding="utf-8") as file:
        file.write("\nMORE = 1\n")
    assert hash_now() != before


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("part/used.py", '# A comment.\ndef one():\n    """A docstring."""\n\n    return  1\n'),
        ("part/unused.py", "def two():\n    return 3\n"),
        ("part/__init__.py", '"""Other words."""\n'),
    ],
)
def test_words_and_what_does_not_run_leave_it(hashed, name, text):
    folder, hash_now = hashed
    before = hash_now()
    (folder / name).write_text(text, encoding="utf-8")
    assert hash_now() == before


def test_what_is_tried_counts(hashed):
    folder, hash_now = hashed
    body = "def one():\n{}\n    except ValueError:\n        return 2\n"
    before = None
    for tried in ("    try:\n        a()\n        b()", "    a()\n    try:\n        b()"):
        (folder / "part/used.py").write_text(body.format(tried), encoding="utf-8")
        assert hash_now() != before
        before = hash_now()


def test_a_module_that_is_imported_within_a_function_counts(hashed):
    folder, hash_now = hashed
    (folder / "part/used.py").write_text(
        "def one():\n    from part import unused\n\n    return unused.two()\n", encoding="utf-8"
    )
    before = hash_now()
    (folder / "part/unused.py").write_text("def two():\n    return 3\n", encoding="utf-8")
    assert hash_now() != before


@pytest.mark.slow
def test_imports_are_those_of_the_syntax_tree():
    scripts = Path(__file__).parents[2] / "scripts"
    for file in scripts.rglob("*.py"):
        text, names = file.read_text(encoding="utf-8"), []
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.Import):
                names += [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom):
                names += [f"{node.module}.{alias.name}" for alias in node.names]
        assert sorted(code.names_imported(text)) == sorted(names), file


def test_files_as_they_were_are_not_compiled_again(hashed, tmp_path, monkeypatch):
    folder, hash_now = hashed
    monkeypatch.setattr(code, "MEMORY", tmp_path / "memory/code.json")
    before = hash_now()
    code.remember()
    compiled = []
    compile_one = code.instructions
    monkeypatch.setattr(
        code, "instructions", lambda path: compiled.append(path.name) or compile_one(path)
    )
    assert hash_now() == before
    assert compiled == []
    (folder / "part/used.py").write_text("def one():\n    return 10\n", encoding="utf-8")
    assert hash_now() != before
    assert compiled == ["used.py"]


def test_a_memory_that_cannot_be_read_or_written_does_no_harm(hashed, tmp_path, monkeypatch):
    _, hash_now = hashed
    before = hash_now()
    (tmp_path / "memory").write_text("not a folder", encoding="utf-8")
    monkeypatch.setattr(code, "MEMORY", tmp_path / "memory/code.json")
    assert hash_now() == before
    code.remember()
    monkeypatch.setattr(code, "MEMORY", tmp_path / "memory")
    assert hash_now() == before
