"""A case that gives an accuracy draws its seeds in rounds: no more than it needs, none twice."""

import os
import re
import signal
import subprocess
import time

import pytest

from stickiness.core import datasets

pytestmark = pytest.mark.workflow

TINY = ["--configfile", "config/config.yaml", "config/tiny.yaml"]
CASE = "  mine: {{surface: H0.7_zeta64, pressures: [0.05], quantities: [area], {}}}\n"
ANSWER = "results/tiny/cases/mine.nc"


def asks(workflow, text):
    """Let the case ask for something."""
    config = (workflow / "config/tiny.yaml").read_text(encoding="utf-8").split("cases:\n")[0]
    (workflow / "config/tiny.yaml").write_text(
        f"{config}cases:\n{CASE.format(text)}", encoding="utf-8"
    )


def answered(workflow):
    """Run, and return what was said, the answer, and when each seed's file was written."""
    done = workflow.snakemake(ANSWER)
    assert done.returncode == 0, done.stdout
    files = (workflow / "results/tiny/contact/mine").glob("*.nc")
    return (
        done.stdout,
        datasets.read(workflow / ANSWER),
        {path.name: path.stat().st_mtime_ns for path in files},
    )


def kill_after_first_round(workflow):
    process = subprocess.Popen(
        workflow.command(ANSWER, *TINY),
        cwd=workflow.folder,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    first = workflow / "results/tiny/draws/mine/round1.nc"
    deadline = time.monotonic() + 1200
    while not first.exists():
        assert time.monotonic() < deadline, "no round within twenty minutes"
        assert process.poll() is None, "the run ended before it could be killed"
        time.sleep(0.05)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    return first


def test_rounds(fresh):
    """Killed between rounds and resumed, asked for more up to a cap, and for less."""
    # So hopeful a first round, of three seeds, that it takes a second.
    fresh.edit("scripts/stickiness/stopping.py", "START = 1.5", "START = 5.0")
    asks(fresh, "accuracy: 0.3")
    first = kill_after_first_round(fresh)
    begun = {path: path.stat().st_mtime_ns for path in (fresh / "results").rglob("seed*.nc")}
    assert datasets.read(first).next_seeds > datasets.read(first).seeds

    said, answer, easy = answered(fresh)
    assert {path: path.stat().st_mtime_ns for path in begun} == begun
    assert datasets.parameters(answer)["settings"]["seeds"] == len(easy)
    assert (answer.value_total_error <= 0.3 * answer.value).all()
    assert "missed" not in {*answer.attrs, *said.split()}
    # Jobs after the last round are told as well, and then nothing is left to do.
    ran = re.search(r"^  ran +(.*)", said, re.M)[1]
    assert "average_ensemble 1" in ran
    assert "answer_case 1" in ran
    counts = re.search(r"(\d+) jobs ran, (\d+) were up to date", said).groups()
    rounds = len(list((fresh / "results/tiny/draws/mine").glob("*.nc")))
    assert sum(map(int, counts)) == 2 * len(easy) + rounds + 2  # average_ensemble and answer_case
    assert fresh.planned(ANSWER) == {}

    # More accuracy adds seeds, up to the cap: that is told, not a failure.
    asks(fresh, f"accuracy: 0.15, at_most: {len(easy) + 1}, sampling: plain")
    said, answer, hard = answered(fresh)
    assert len(hard) == len(easy) + 1
    assert {name: hard[name] for name in easy} == easy
    assert answer.attrs["missed"].startswith("mine: error 0.")
    assert f"at the cap, {len(hard)} seeds" in answer.attrs["missed"]
    assert answer.attrs["missed"] in said

    # Less than that takes from what is there.
    asks(fresh, "accuracy: 0.3")
    planned = fresh.planned(ANSWER)
    assert planned
    assert "solve_repulsive" not in planned, planned
