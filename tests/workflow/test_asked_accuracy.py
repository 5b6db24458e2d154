"""A case that gives an accuracy is answered, says what it missed, and keeps what is solved."""

import re

import pytest

from stickiness import datasets

pytestmark = pytest.mark.workflow

CASE = "  mine: {{surface: H0.7_zeta64, pressures: [0.05], quantities: [area], {}}}\n"
ANSWER = "results/tiny/cases/mine.nc"


def ask(workflow, text):
    """Let the case ask for something."""
    config = (workflow / "config/tiny.yaml").read_text(encoding="utf-8").split("cases:\n")[0]
    (workflow / "config/tiny.yaml").write_text(
        f"{config}cases:\n{CASE.format(text)}", encoding="utf-8"
    )


def answer(workflow):
    """Run, and return what was printed, the answer, and when each file of seeds was written."""
    done = workflow.snakemake(ANSWER)
    assert done.returncode == 0, done.stdout
    files = (workflow / "results/tiny/contact").glob("*/seeds*.nc")
    times = {path.name: path.stat().st_mtime_ns for path in files}
    return done.stdout, datasets.read(workflow / ANSWER), times


def test_accuracy_missed_and_reached(fresh):
    ask(fresh, "accuracy: 0.15, at_most: 2, sampling: plain")
    said, few, solved = answer(fresh)
    assert set(solved) == {"seeds1-2_p0.05.nc"}
    assert few.attrs["missed"].startswith("mine: error 0.")
    assert few.attrs["missed"] in said
    enough = int(re.search(r"set cases\.mine\.seeds to (\d+)", few.attrs["missed"])[1])

    ask(fresh, f"accuracy: 0.15, seeds: {enough}, sampling: plain")
    _, many, more = answer(fresh)
    firsts = [3, *range(9, enough + 1, 8)]
    lasts = [*(first - 1 for first in firsts[1:]), enough]
    new = [f"seeds{first}-{last}_p0.05.nc" for first, last in zip(firsts, lasts, strict=True)]
    assert set(more) == {*solved, *new}
    assert {name: more[name] for name in solved} == solved
    error = many.value_total_error / many.value
    assert (error < few.value_total_error / few.value).all()
    assert fresh.planned(ANSWER) == {}

    ask(fresh, "accuracy: 0.15, at_most: 2, sampling: plain")
    planned = fresh.planned(ANSWER)
    assert planned
    assert "solve_repulsive" not in planned, planned
