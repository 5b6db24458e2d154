"""The theory guide: its worked examples are those of the code, and its equations have numbers."""

import re

import pytest
from helpers import worked_examples
from helpers.worked_examples import THEORY, compute, compute_layer, read_table

from stickiness.remaining.calibration import find_spread

CHAPTERS = sorted(THEORY.glob("*.md"))
ROUNDING = 6e-4  # of numbers with four digits


def read_chapter(name):
    return (THEORY / f"{name}.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("place", worked_examples.EXAMPLES, ids=" ".join)
def test_worked_examples_are_those_of_the_code(place):
    """Where the code has changed, tests/helpers/worked_examples.py writes their numbers anew."""
    on_page = read_table(place)
    computed = compute(place)
    assert on_page.keys() == computed[0].keys()
    for name, numbers in on_page.items():
        expected = [example[name] for example in computed]
        assert numbers == pytest.approx(expected, rel=ROUNDING), name


@pytest.mark.parametrize("number", [0.0, -1.0, 2.0, 39952.4, 3.0544e-8, 0.07271, 839.22, 1.00008])
def test_numbers_of_worked_examples_are_read_as_they_are_written(number):
    text = worked_examples.write_number(number)
    assert worked_examples.read_number(text) == pytest.approx(number, rel=5e-4)


def test_what_another_energy_ratio_in_one_over_x_would_cost():
    """Springs on the layer of the second column, with 1/x in place of that of the springs."""
    (factor,) = re.findall(r"modulus threshold (\d\.\d+) times as high", read_chapter("layers"))
    thickness, poisson, _ = worked_examples.LAYERS[1]
    threshold = 1e6 * compute_layer(*worked_examples.LAYERS[1])[r"$E^\ast_\mathrm{th}$ [MPa]"]
    other = compute_layer(thickness, poisson, float(factor) * threshold)
    springs = other[r"$S_\mathrm{spring}$"] * other[r"$x_\mathrm{s}/x$"]
    share = other[r"$(1-c_0)_+^2$"] * springs  # no other state holds
    assert share == pytest.approx(worked_examples.WANTED, rel=0.02)


def test_the_factor_of_the_pull_off_is_that_of_the_limits():
    (power,) = re.findall(r"e\^\{(0\.\d+)\}, \\frac\{s_Lw\}", read_chapter("adhesion"))
    assert float(power) == find_spread("spectrum", "ln_tension").value


def test_ratios_of_the_dmt_sum_are_those_of_the_findings():
    """The chapter has sum over simulation with limits, the findings the inverse with an error."""
    findings = (THEORY.parent / "findings.md").read_text(encoding="utf-8")
    cell = r" ([\d.]+) ± ([\d.]+) \|"
    found = re.findall(rf"^\| ([\d.]+) \|{cell}{cell}{cell}$", findings, re.M)
    limited = r" ([\d.]+), ([\d.]+) to ([\d.]+) \|"
    stated = re.findall(rf"^\| ([\d.]+) \|{limited}{limited}$", read_chapter("criteria"), re.M)
    assert len(stated) == len(found) == 6
    for (range_, *at_gap_and_area), (same_range, *ratios) in zip(stated, found, strict=True):
        area, area_error, gap, gap_error, *_ = map(float, ratios)
        expected = [
            1 / each
            for value, error in ((gap, gap_error), (area, area_error))
            for each in (value, value + error, value - error)
        ]
        assert range_ == same_range
        assert list(map(float, at_gap_and_area)) == pytest.approx(expected, rel=0.05)


@pytest.mark.parametrize("chapter", CHAPTERS, ids=lambda path: path.stem)
def test_equations_are_numbered_in_order(chapter):
    """Every set equation has a tag, and equations that are referred to exist."""
    text = chapter.read_text(encoding="utf-8")
    equations = re.findall(r"^\$\$(.*?)\$\$$", text, re.M | re.S)
    tags = [re.findall(r"\\tag\{(\d+)\.(\d+)\}", equation) for equation in equations]
    assert all(len(tag) == 1 for tag in tags)
    assert [int(number) for ((_, number),) in tags] == list(range(1, len(tags) + 1))
    assert len({number for ((number, _),) in tags}) <= 1


def test_equations_that_are_referred_to_exist():
    texts = [chapter.read_text(encoding="utf-8") for chapter in CHAPTERS]
    tags = {tag for text in texts for tag in re.findall(r"\\tag\{(\d+\.\d+)\}", text)}
    for text in texts:
        prose = re.sub(r"\$\$.*?\$\$", "", text, flags=re.S)
        named = re.findall(r"\((\d\.\d+)(?: to (\d\.\d+))?\)", prose)
        assert {tag for pair in named for tag in pair if tag} <= tags
