"""The plan of the house: who may import whom, names, sizes, one file per rule."""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SCRIPTS, RULES, STAGE_TESTS = ROOT / "scripts", ROOT / "rules", ROOT / "tests/stages"
LIBRARY = SCRIPTS / "stickiness"
# A package imports from floors below its own, and from itself.
FLOORS = (
    {"core"},
    {"solids"},
    {"surfaces"},
    {"contact", "persson", "measured"},
    {"adhesion"},
    {"closed_forms"},
    {"remaining"},
    {"criteria", "accuracy"},
    {"config"},
)
FLOOR = {package: level for level, packages in enumerate(FLOORS) for package in packages}
# Public calls of the solvers, whose arguments are the user's.
MANY_PARAMETERS = {
    "contact/solver.py:solve",
    "adhesion/solver.py:solve",
    "adhesion/path.py:path",
    "criteria/verdict.py:verdict",
    "measured/topography.py:read",
}
MOST_LINES, MOST_PARAMETERS = 400, 8
NO_STAGE = {"common", "resources", "shared"}  # files of rules without a rule of their own

STAGES = sorted(p.name for p in SCRIPTS.iterdir() if p.is_dir() and any(p.glob("*.py")))
STAGES = [name for name in STAGES if name not in ("stickiness", "common")]
MODULES = sorted(SCRIPTS.rglob("*.py"))
TREES = {path: ast.parse(path.read_text()) for path in MODULES}


def name_of(path):
    """Dotted name of a module."""
    parts = path.relative_to(SCRIPTS).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


NAMES = {name_of(path) for path in MODULES}


def imports(path):
    """Line and dotted name of every module that a module imports, with the names taken from it."""
    for node in ast.walk(TREES[path]):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name, []) for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            taken = [alias.name for alias in node.names]
            inner = [name for name in taken if f"{node.module}.{name}" in NAMES]
            yield from ((node.lineno, f"{node.module}.{name}", []) for name in inner)
            if len(inner) < len(taken):
                yield node.lineno, node.module, [name for name in taken if name not in inner]


def where(path, line):
    return f"{path.relative_to(ROOT)}:{line}"


def refuse(faults, rule):
    assert not faults, f"{rule}:\n  " + "\n  ".join(faults)


def test_imports_go_down_only():
    faults = []
    for path in MODULES:
        own = name_of(path).split(".")
        for line, target, _ in imports(path):
            other = target.split(".")
            if target not in NAMES and other[0] not in ("stickiness", "common", *STAGES):
                continue
            place = f"{where(path, line)} imports {target}"
            if other[0] in STAGES:
                faults.append(f"{place}: move what is shared to pipeline")
            elif own[0] == "stickiness" and other[0] != "stickiness":
                faults.append(f"{place}: the library knows nothing of the pipeline")
            elif own[0] == "stickiness" and len(own) > 1 and own[1] in FLOOR and len(other) > 1:
                below = FLOOR.get(other[1], len(FLOORS))  # facades are above all
                if own[1] != other[1] and below >= FLOOR[own[1]]:
                    faults.append(f"{place}: not below {own[1]}")
    refuse(faults, "arrows of import go down only")


def test_every_package_of_the_library_has_a_floor():
    packages = {path.name for path in LIBRARY.iterdir() if (path / "__init__.py").exists()}
    assert packages == set(FLOOR)


def test_no_module_is_private_nor_reaches_for_private_names():
    faults = [
        f"{path.relative_to(ROOT)}: no leading underscore in a module's name"
        for path in MODULES
        if path.stem.startswith("_") and path.stem != "__init__"
    ]
    for path in MODULES:
        modules = set()  # names that stand for modules of the project
        for line, target, taken in imports(path):
            private = [name for name in taken if re.match("_(?!_)", name)]
            faults += [f"{where(path, line)}: {target}.{name}" for name in private]
            if target in NAMES:
                modules.add(target.split(".")[-1])
        for node in ast.walk(TREES[path]):
            if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
                private = node.attr.startswith("_") and not node.attr.startswith("__")
                if private and node.value.id in modules:
                    faults.append(f"{where(path, node.lineno)}: {node.value.id}.{node.attr}")
    refuse(faults, "private names stay in their module")


def test_modules_and_signatures_are_short():
    faults = []
    for path in MODULES:
        if SCRIPTS.joinpath("stickiness") in path.parents:
            lines = len(path.read_text().splitlines())
            if lines > MOST_LINES:
                faults.append(f"{path.relative_to(ROOT)} has {lines} lines: split it")
        for node in ast.walk(TREES[path]):
            if not isinstance(node, ast.FunctionDef):
                continue
            a = node.args
            count = len([x for x in a.posonlyargs + a.args + a.kwonlyargs if x.arg != "self"])
            key = f"{path.relative_to(LIBRARY) if LIBRARY in path.parents else path}:{node.name}"
            if count > MOST_PARAMETERS and key not in MANY_PARAMETERS:
                faults.append(f"{where(path, node.lineno)}: {node.name} has {count} parameters")
    refuse(faults, f"at most {MOST_LINES} lines and {MOST_PARAMETERS} parameters")


def rules_of(path):
    """Names of the rules in a file, and the scripts that they run, by the rule's name.

    Rules that a loop makes, one for each key of a table, have that key in the script's path.
    """
    text, found = path.read_text(encoding="utf-8"), {}
    blocks = re.split(r"^\s*(?:rule|checkpoint)(?: (\w+))?:\n", text, flags=re.M)
    for name, block in zip(blocks[1::2], blocks[2::2], strict=True):
        script = re.search(r'"\.\./scripts/([^"]+)\.py"', block)
        if script is None:
            continue
        if name is None:
            made = re.search(r'name:\s+f"([^"]+)"', block)[1]
            keys = re.findall(r'^    "(\w+)": \{', text, re.M)
            pattern = re.sub(r"\{[\w.]+\}", "{}", script[1])
            assert re.sub(r"\{\w+\}", "{}", made) == Path(pattern).name, (made, script[1])
            found |= {Path(pattern).name.format(key): pattern.format(key) for key in keys}
        else:
            found[name] = script[1]
    return found


@pytest.mark.parametrize("stage", STAGES)
def test_a_stage_has_one_script_for_each_of_its_rules(stage):
    path = RULES / f"{stage}.smk"
    assert path.exists(), f"scripts/{stage}/ has no rules/{stage}.smk"
    scripts = {p.stem for p in (SCRIPTS / stage).glob("*.py") if p.stem != "__init__"}
    run = rules_of(path)
    assert run == {name: f"{stage}/{name}" for name in scripts}, (
        f"rules/{stage}.smk and scripts/{stage}/ differ: a script is named after its rule"
    )


def test_there_are_eleven_figures():
    assert {f"plot_fig{n}" for n in range(1, 12)} == rules_of(RULES / "figures.smk").keys()


def test_stages_have_the_same_names_everywhere():
    of_rules = {p.stem for p in RULES.glob("*.smk")} - NO_STAGE
    assert of_rules == set(STAGES), "stages of rules/ and scripts/"
    tested = {p.name for p in STAGE_TESTS.iterdir() if p.is_dir() and p.name != "__pycache__"}
    assert tested == set(STAGES), "stages of scripts/ and tests/stages/"
