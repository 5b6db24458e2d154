"""Links between the pages lead somewhere, and the example of the library runs."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "config/README.md"]
PAGES += sorted(ROOT.glob("docs/*.md"))


def anchors(page):
    headings = re.findall(r"^#+ (.*)$", page.read_text(encoding="utf-8"), re.M)
    return {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page):
    for target in re.findall(r"\]\(([^)\s]+)\)", page.read_text(encoding="utf-8")):
        if not target.startswith(("https://", "http://")):
            file, _, anchor = target.partition("#")
            place = page.parent / file if file else page
            assert place.exists(), target
            assert not anchor or anchor in anchors(place), target


def test_paths_in_the_map_exist():
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    paths = re.findall(r"`((?:scripts|rules|report|config|docs|tests)/[\w./]+)`", text)
    assert len(paths) > 10
    assert [path for path in paths if not (ROOT / path).exists()] == []


# Heads of columns that every reader knows, or that name what the table is about.
PLAIN = """material surface errors source no claim claimed remark from subject printed correct proof
recomputed experiment quantity observed predicted outcome on paper remarks case value allowed cost
grid largest measured answer reason within the both ways heights theory without in all waves and
means below"""


def test_heads_of_tables_are_in_the_glossary():
    terms = re.findall(r"^\| ([^|]+) \|", (ROOT / "docs/glossary.md").read_text("utf-8"), re.M)
    known = {*PLAIN.split(), *re.findall(r"[\w*]+", re.sub(r"[\\_]", "", " ".join(terms)).lower())}
    missing = set()
    for page in sorted((ROOT / "report").glob("*.html.j2")):
        text = re.sub(r"{%.*?%}|{{.*?}}", " ", page.read_text(encoding="utf-8"))
        for head in re.findall(r'<th scope="col"[^>]*>(.*?)</th>', text):
            plain = re.sub(r"<br>.*|<[^>]*>|\[.*?\]|&\w+;", "", head).lower()
            words = re.findall(r"[^\W\d][\w*]*", plain)
            missing |= {(page.name, head, word) for word in words if word not in known}
    assert missing == set()


@pytest.mark.slow
def test_the_example_of_the_library_runs(tmp_path):
    done = subprocess.run(
        [sys.executable, ROOT / "examples/library.py"],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": str(ROOT / "scripts"), "OMP_NUM_THREADS": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    found = dict(line.split(" = ", 1) for line in done.stdout.splitlines() if " = " in line)
    area, theory = (float(found[name].split()[0]) for name in ("contact area", "predicted area"))
    assert area == pytest.approx(theory, rel=0.3)
    assert done.stdout.startswith("sticks: ")
