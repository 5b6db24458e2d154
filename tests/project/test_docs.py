"""Documentation that can go stale: configuration, links, files named, pictures, examples, pages."""

import importlib.util
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[2]
PAGES = ["README.md", *(f"docs/{p.name}" for p in sorted(ROOT.glob("docs/*.md")))]


def script_of_docs(name):
    spec = importlib.util.spec_from_file_location(name, ROOT / f"docs/{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("page", PAGES)
def test_links_between_pages_lead_somewhere(page):
    text = (ROOT / page).read_text(encoding="utf-8")
    for target in re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", text):
        if not target.startswith(("https://", "http://")):
            assert ((ROOT / page).parent / target).exists(), f"{page}: {target}"


@pytest.mark.slow
def test_library_example_runs(tmp_path):
    done = subprocess.run(
        [sys.executable, ROOT / "examples/library.py"],
        cwd=tmp_path,
        env={"PYTHONPATH": str(ROOT / "scripts"), "OMP_NUM_THREADS": "1", "PATH": ""},
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    found = dict(line.split(" = ", 1) for line in done.stdout.splitlines() if " = " in line)
    area, theory = (float(found[name].split()[0]) for name in ("contact area", "area by theory"))
    assert area == pytest.approx(theory, rel=0.3)
    assert 2 * 0.065 / 3 < area < 0.065 * 3
    assert float(found["a_V"].split()[0]) > 1
    assert done.stdout.startswith("sticks: ")


def test_tutorial_can_be_walked():
    text = (ROOT / "docs/tutorial.md").read_text(encoding="utf-8")
    steps = script_of_docs("walk_tutorial").steps(text)
    assert steps[0][1].startswith("make install\n")
    commands = [step for _, step in steps if step]
    assert "".join(commands).count("```") == 0
    assert sum("snakemake -j2 results/draft/report" in step for step in commands) >= 3
    for step in commands:
        done = subprocess.run(["bash", "-nc", step], capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr


def test_version_is_the_same_everywhere():
    from stickiness import __version__

    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    project = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    changes = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert citation["version"] == __version__
    assert re.findall(r"^## (\d.*)$", changes, re.M)[0] == (
        f"{__version__} - {citation['date-released']}"
    )
    assert f'version = "{__version__}"' in project
    # What the citation file format asks for.
    assert {"cff-version", "message", "title", "authors"} <= citation.keys()


def test_changelog_keeps_its_form():
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    headings = re.findall(r"^### (.*)$", text, re.M)
    assert set(headings) <= {"Added", "Changed", "Deprecated", "Removed", "Fixed", "Security"}
    newest, *releases = re.findall(r"^## (.*)$", text, re.M)
    assert newest == "Unreleased"
    dated = [re.fullmatch(r"(\d+)\.(\d+)\.(\d+) - (\d{4}-\d\d-\d\d)", name) for name in releases]
    assert all(dated), releases
    versions = [tuple(map(int, found.groups()[:3])) for found in dated]
    assert versions == sorted(versions, reverse=True)


def test_metadata_of_the_catalog():
    catalog = yaml.safe_load((ROOT / ".snakemake-workflow-catalog.yml").read_text(encoding="utf-8"))
    assert catalog["usage"]["software-stack-deployment"]["conda"] is True
    assert catalog["usage"]["report"] is True


# Folders that pages name files by; the packages below `scripts` stand without it in tables.
FOLDERS = ("scripts", "rules", "config", "benchmarks", "examples", "envs", "profiles", "tests")
PACKAGES = ("stickiness", "common")


def paths_of(page):
    """Files and folders of the project that a page names; those with a placeholder are left out."""
    text = (ROOT / page).read_text(encoding="utf-8")
    named = re.findall(rf"(?<![\w/.-])((?:{'|'.join(FOLDERS + PACKAGES)})/[\w/.<>*-]*)", text)
    return [path.rstrip(".") for path in named if not re.search(r"[<>*]", path)]


@pytest.mark.parametrize("page", PAGES)
def test_files_that_pages_name_exist(page):
    for path in paths_of(page):
        folder = "scripts/" if path.startswith(PACKAGES) else ""
        assert (ROOT / folder / path).exists(), f"{page}: {path}"


def test_map_leads_to_solver_fit_verdict_and_errors():
    named = set(paths_of("README.md"))
    assert {
        "scripts/stickiness/contact/solver.py",
        "scripts/stickiness/criteria/a_v_fit.py",
        "scripts/stickiness/criteria/registry.py",
        "scripts/stickiness/core/budget.py",
    } <= named


def test_pages_are_few_and_readme_is_short():
    assert len(PAGES) <= 1 + 9
    assert len((ROOT / "README.md").read_text(encoding="utf-8").splitlines()) <= 120


def test_anchors_between_pages_exist():
    def anchors(page):
        headings = re.findall(r"^#+ (.*)$", page.read_text(encoding="utf-8"), re.M)
        return {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings}

    for page in PAGES:
        text = (ROOT / page).read_text(encoding="utf-8")
        for target, anchor in re.findall(r"\]\(([^)#\s]*)#([^)]+)\)", text):
            file = (ROOT / page).parent / target if target else ROOT / page
            assert anchor in anchors(file), f"{page}: {target}#{anchor}"


@pytest.fixture(scope="module")
def draw_rules():
    return script_of_docs("draw_rules")


def test_arrows_that_follow_from_others_are_left_out(draw_rules):
    arrows = {("a", "b"), ("b", "c"), ("c", "d"), ("a", "c"), ("a", "d"), ("x", "d")}
    kept = {("a", "b"), ("b", "c"), ("c", "d"), ("x", "d")}
    assert draw_rules.reduce_arrows(arrows) == kept


@pytest.mark.slow
@pytest.mark.workflow
def test_pictures_of_the_rules_are_up_to_date(draw_rules):
    for picture, (names, arrows) in draw_rules.wanted().items():
        assert min(len(names), len(arrows)) > 10
        assert draw_rules.shown(picture) == (names, arrows), "run: python docs/draw_rules.py"


NOTEBOOK = ROOT / "examples/from_heights_to_verdict.ipynb"


def test_notebook_is_kept_without_outputs():
    cells = json.loads(NOTEBOOK.read_text(encoding="utf-8"))["cells"]
    code = [cell for cell in cells if cell["cell_type"] == "code"]
    assert len(code) > 10
    for cell in code:
        assert cell["outputs"] == []
        assert cell["execution_count"] is None


@pytest.mark.slow
@pytest.mark.workflow
def test_notebook_runs(monkeypatch):
    """In its own folder, as Jupyter runs it; the verdicts are those of the tutorial's wall."""
    nbformat, nbclient = pytest.importorskip("nbformat"), pytest.importorskip("nbclient")
    monkeypatch.setenv("PYTHONPATH", str(ROOT / "scripts"))
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    nbclient.NotebookClient(
        notebook, timeout=300, resources={"metadata": {"path": str(NOTEBOOK.parent)}}
    ).execute()
    outputs = [out for cell in notebook.cells for out in cell.get("outputs", [])]
    said = "".join(out["text"] for out in outputs if out["output_type"] == "stream")
    hurst, error = map(float, re.search(r"^H +?= ([\d.]+) ± ([\d.]+)", said, re.M).groups())
    assert abs(hurst - 0.8) < 3 * error
    assert re.findall(r"^([a-z ]+): [\d.e-]+ of the work of adhesion", said, re.M) == [
        "does not stick",
        "sticks",
    ]
    pictures = [out for out in outputs if "image/png" in out.get("data", {})]
    assert len(pictures) >= 8


@pytest.fixture(scope="module")
def pages(tmp_path_factory):
    """The pages as `make docs` builds them, warnings being errors, but for the notebook's run."""
    pytest.importorskip("sphinx")
    folder = tmp_path_factory.mktemp("pages")
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-c", "docs"]
    done = subprocess.run(
        [*command, "-D", "nb_execution_mode=off", ".", str(folder)],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return folder


@pytest.mark.slow
def test_reference_has_every_public_name_of_the_library(pages):
    from sphinx.util.inventory import InventoryFile

    import stickiness

    with (pages / "objects.inv").open("rb") as file:
        listed = InventoryFile.load(file, "", os.path.join)
    listed = {name for kind, names in listed.items() if kind.startswith("py:") for name in names}
    assert "stickiness.verdict" in listed
    modules = [name for name in dir(stickiness) if name not in ("verdict", "__version__")]
    for module in modules:
        part = getattr(stickiness, module)
        for name in getattr(part, "__all__", []):
            value = getattr(part, name)
            places = {part.__name__, getattr(value, "__module__", None)}
            if not callable(value):  # constants are described where they are defined
                places |= {one.rpartition(".")[0] for one in listed if one.endswith(f".{name}")}
            found = {f"{place}.{name}" for place in places} & listed
            assert found, f"{part.__name__}.{name}: not in docs/library, or not described"


@pytest.mark.slow
def test_links_between_built_pages_lead_somewhere(pages):
    """Links that lead to a file in the pages, such as those from README.md to docs."""
    checked = 0
    for page in [*pages.glob("*.html"), *pages.glob("docs/*.html")]:
        text = page.read_text(encoding="utf-8")
        for target in re.findall(r'(?:href|src)="([^"#?]+)[^"]*"', text):
            if not re.match(r"[a-z]+:", target):
                assert (page.parent / target).exists(), f"{page.relative_to(pages)}: {target}"
                checked += 1
    assert checked > 100
