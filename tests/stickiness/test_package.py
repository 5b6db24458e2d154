"""What `import stickiness` shows, and what it loads."""

import doctest
import importlib
import inspect
import subprocess
import sys
from pathlib import Path

import pytest

import stickiness

SCRIPTS = Path(stickiness.__file__).parents[1]
EXAMPLES = [file for file in SCRIPTS.rglob("*.py") if ">>> " in file.read_text(encoding="utf-8")]


@pytest.mark.parametrize("name", dir(stickiness))
def test_every_name_is_there_and_explained(name):
    assert getattr(stickiness, name)
    assert name == "__version__" or f"`{name}`" in stickiness.__doc__


@pytest.mark.parametrize("name", sorted({*dir(stickiness)} - {"__version__", "accuracy"}))
def test_public_functions_and_methods_are_annotated(name):
    found = getattr(stickiness, name)
    public = [found, *(getattr(found, one) for one in dir(found) if one[0] != "_")]
    public += [one for kind in public if inspect.isclass(kind) for one in vars(kind).values()]
    functions = [one for one in public if inspect.isfunction(one) and one.__name__[0] != "_"]
    ours = [one for one in functions if one.__module__.startswith("stickiness")]
    assert ours
    for function in ours:
        needed = {*inspect.signature(function).parameters, "return"} - {"self", "cls"}
        assert needed <= inspect.get_annotations(function).keys(), function.__qualname__


PACKAGES = [file.parent for file in SCRIPTS.glob("stickiness/**/__init__.py")]


@pytest.mark.parametrize(
    "name",
    [".".join(folder.relative_to(SCRIPTS).parts) for folder in PACKAGES]
    + ["stickiness.surface", "stickiness.dmt", "stickiness.datasets"],
)
def test_what_is_public_is_listed_and_there(name):
    module = importlib.import_module(name)
    assert module.__all__
    names = {}
    exec(f"from {name} import *", names)
    assert {*module.__all__} <= names.keys()


def test_verdict_is_the_function_whatever_was_imported_before():
    from stickiness import verdict
    from stickiness.verdicts.verdict import verdict as defined

    assert verdict is defined is stickiness.verdict


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="'stickiness' has no attribute 'spectra'"):
        _ = stickiness.spectra


def test_importing_loads_neither_scipy_nor_matplotlib():
    code = (
        "import stickiness, sys; dir(stickiness); "
        "sys.exit(' '.join({'scipy', 'matplotlib', 'xarray'} & sys.modules.keys()) or 0)"
    )
    run = subprocess.run([sys.executable, "-c", code], cwd=SCRIPTS, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr


@pytest.mark.parametrize("file", EXAMPLES, ids=lambda file: file.stem)
def test_examples_in_the_documentation(file):
    parts = file.relative_to(SCRIPTS).with_suffix("").parts
    found = doctest.testmod(importlib.import_module(".".join(parts)))
    assert found.attempted
    assert not found.failed
