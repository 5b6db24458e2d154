"""The hash of a job's code changes with the code that the job runs, and with nothing else."""

import ast
from pathlib import Path

import pytest

from common import source_hash as code

FILES = {
    "stage/rule.py": "from part import used\n\n\ndef main():\n    return used.one()\n",
    "part/__init__.py": '"""A part."""\n',
    "part/used.py": "def one():\n    from other import late\n\n    return late.three()\n",
    "part/unused.py": "def two():\n    return 2\n",
    "other/late.py": "def three():\n    return 3\n",
}
BODY = FILES["part/used.py"].split("\n", 1)[1]
REWORDED = f'# A comment.\ndef one():\n    """A docstring."""\n{BODY}'


@pytest.fixture
def hash_now(tmp_path):
    """Function that writes one file of the project and hashes the script, as a new process does."""

    def write(name, text):
        path = tmp_path / "scripts" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def changed(name=None, text=None, cache=".snakemake/source_hashes.json"):
        if name:
            write(name, text)
        reader = code.SourceReader(tmp_path / "scripts", tmp_path / cache)
        digest = reader.hash("stage/rule.py")
        reader.save()
        return digest

    for name, text in FILES.items():
        write(name, text)
    return changed


@pytest.mark.parametrize(
    "name", ["stage/rule.py", "part/__init__.py", "part/used.py", "other/late.py"]
)
def test_a_change_of_code_that_runs_changes_the_hash(hash_now, name):
    before = hash_now()
    assert hash_now(name, FILES[name] + "\nMORE = 1\n") != before
    assert hash_now(name, FILES[name]) == before


def test_the_start_of_scripts_is_no_part_of_their_code(hash_now):
    hash_now("common/job.py", "def start(names): ...\n")
    script = "from common.job import start\n" + FILES["stage/rule.py"]
    before = hash_now("stage/rule.py", script)
    assert hash_now("common/job.py", "def start(names):\n    return 1\n") == before


def test_a_table_beside_a_module_is_part_of_its_code(hash_now):
    before = hash_now()
    with_table = hash_now("part/used.csv", "a,b\n1,2\n")
    assert with_table != before
    assert hash_now("part/used.csv", "a,b\n1,3\n") != with_table
    assert hash_now("part/unused.csv", "a,b\n") == hash_now()


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("part/used.py", REWORDED),
        ("part/__init__.py", '"""Other words."""\n'),
        ("part/unused.py", "def two():\n    return 3\n"),
    ],
)
def test_comments_docstrings_layout_and_unused_modules_do_not(hash_now, name, text):
    before = hash_now()
    assert hash_now(name, text) == before


def test_files_that_did_not_change_are_not_parsed_again(hash_now, monkeypatch):
    before, parsed = hash_now(), []
    parse = code.ast.parse
    monkeypatch.setattr(code.ast, "parse", lambda text: parsed.append(text) or parse(text))
    assert hash_now() == before
    assert parsed == []
    assert hash_now("other/late.py", "def three():\n    return 30\n") != before
    assert len(parsed) == 1


def test_a_cache_that_cannot_be_read_or_written_does_no_harm(hash_now, tmp_path):
    before = hash_now()
    (tmp_path / "file").write_text("not a folder, and not JSON", encoding="utf-8")
    for cache in ("file", "file/below.json"):
        assert hash_now(cache=cache) == before


def test_scripts_name_the_module_of_what_a_package_loads_lazily():
    # The hash follows modules; `from stickiness import Surface` would hide that of `Surface`.
    modules = code.SourceReader(code.SCRIPTS, Path("unused")).modules
    trees = {name: ast.parse(path.read_bytes()) for name, path in modules.items()}
    lazy_packages = {
        name
        for name, tree in trees.items()
        if any(getattr(node, "name", "") == "__getattr__" for node in tree.body)
    }
    assert "stickiness" in lazy_packages
    hidden = {
        (name, f"{node.module}.{alias.name}")
        for name, tree in trees.items()
        if not name.startswith("stickiness")
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and node.module in lazy_packages
        for alias in node.names
        if f"{node.module}.{alias.name}" not in modules and alias.name != "__version__"
    }
    assert hidden == set()
