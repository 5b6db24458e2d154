"""Numbers of README.md and docs: as committed, as the results have them, and in their marks."""

import importlib.util
import re
from pathlib import Path

import pytest
import yaml

from pipeline import quoted
from pipeline.quoted.sources import WORDS, Sources, say_range

ROOT = Path(__file__).parents[2]
RESULTS, DRAFT = (ROOT / "results" / name for name in ("standard", "draft"))
MADE = all((folder / "report/report.html").exists() for folder in (RESULTS, DRAFT))


def load(name):
    spec = importlib.util.spec_from_file_location(name, ROOT / f"docs/{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


filling = load("fill_numbers")
COMMITTED = yaml.safe_load((ROOT / "docs/numbers.yaml").read_text(encoding="utf-8"))
NUMBERS = COMMITTED["numbers"]
PAGES = {path.name: path.read_text(encoding="utf-8") for path in filling.PAGES}


@pytest.mark.slow
@pytest.mark.parametrize("page", PAGES)
def test_pages_have_the_committed_numbers(page):
    assert PAGES[page] == filling.fill(PAGES[page], NUMBERS), "run: make numbers"


def test_every_committed_number_is_quoted():
    used = {name for page in PAGES.values() for name in filling.names_in(page)}
    assert used == NUMBERS.keys()


@pytest.mark.parametrize("page", PAGES)
def test_marks_are_closed_and_begin_no_line_of_prose(page):
    """A line that begins with a comment is a block of HTML, in which Markdown is not read."""
    comments = re.findall(r"<!--(.*?)-->", PAGES[page])
    assert comments[1::2] == ["/"] * (len(comments) // 2)
    assert "/" not in comments[::2]
    alone = re.compile(r"\s*<!--[\w./]+-->\s*")
    for line in PAGES[page].splitlines():
        assert not line.lstrip().startswith("<!--") or alone.fullmatch(line), line


def test_grades_and_verdicts_add_up():
    grades = [WORDS.index(NUMBERS[f"claims.{name}"]) for name in ("reproduced", "qualified", "not")]
    assert sum(grades) == int(NUMBERS["claims.graded"]), "a claim is not decided: say so in README"
    assert len(NUMBERS["claims.failed"].split(",")) == grades[-1]
    pairs = [int(NUMBERS[f"pairs.{name}"]) for name in ("stick", "touch", "not", "depend")]
    assert sum(pairs) == int(NUMBERS["pairs"]), "a pair is not judged: say so in README"


@pytest.mark.slow
@pytest.mark.skipif(not MADE, reason="needs results/standard and results/draft")
def test_committed_numbers_are_those_of_the_results():
    found = quoted.quote_all(Sources(RESULTS, DRAFT, ROOT))
    times = {name for name in found if name.startswith("time.")}  # of another run, or machine
    assert {k: v for k, v in found.items() if k not in times} == {
        k: v for k, v in NUMBERS.items() if k not in times
    }


def test_a_number_and_a_table_are_filled_in():
    page = "a **<!--share-->old<!--/-->** b\n\n  <!--rows--><!--/-->\n"
    filled = filling.fill(page, {"share": "7 %", "rows": "| x |\n| --- |\n"})
    assert filled == (
        "a **<!--share-->7 %<!--/-->** b\n\n  <!--rows-->\n\n  | x |\n  | --- |\n\n  <!--/-->\n"
    )
    assert filling.fill(filled, {"share": "7 %", "rows": "| x |\n| --- |\n"}) == filled


def test_an_unknown_number_is_named():
    with pytest.raises(ValueError, match=r"'share\.none'.*pipeline/quoted"):
        filling.fill("<!--share.none-->1<!--/-->", {"share": "7 %"})


def test_two_numbers_of_one_name_are_refused(monkeypatch):
    monkeypatch.setattr(quoted, "list_numbers", lambda sources: [("pairs", "1"), ("pairs", "2")])
    with pytest.raises(ValueError, match="pairs"):
        quoted.quote_all(None)


def test_a_range_is_one_number_where_its_ends_agree():
    assert say_range([2.281, 2.614]) == "2.3 to 2.6"
    assert say_range([0.7484, 0.7496]) == "0.75"
