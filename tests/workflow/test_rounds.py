"""A case that gives an accuracy draws its seeds in rounds: no more than it needs, none twice."""

import os
import signal
import subprocess
import time

import pytest

from stickiness import datasets

pytestmark = pytest.mark.workflow

TINY = ["--configfile", "config/config.yaml", "config/tiny.yaml"]
CASE = "  mine: {{surface: H0.7_zeta64, pressures: [0.1], quantities: [area], {}}}\n"
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
    files = (workflow / "results/tiny/bem/mine").glob("*.nc")
    return (
        done.stdout,
        datasets.read(workflow / ANSWER),
        {path.name: path.stat().st_mtime_ns for path in files},
    )


def test_rounds(fresh):
    asks(fresh, "accuracy: 0.4")
    said, answer, easy = answered(fresh)
    asked = datasets.parameters(answer)
    assert asked["settings"]["seeds"] == len(easy)
    assert "missed" not in answer.attrs
    assert "missed" not in said
    assert (answer.total_error <= 0.4 * answer.value).all()
    # Nothing is left to do, and every job was told, those after the last round included.
    assert fresh.planned(ANSWER) == {}
    assert "answer_case 1" in said
    assert "average_ensemble 1" in said

    # More accuracy adds seeds, up to the cap: told, not failed.
    asks(fresh, f"accuracy: 0.05, at_most: {len(easy) + 2}, sampling: plain")
    said, answer, hard = answered(fresh)
    assert len(hard) == len(easy) + 2
    assert {name: hard[name] for name in easy} == easy
    assert answer.attrs["missed"].startswith("mine: error 0.")
    assert f"at the cap, {len(hard)} seeds" in answer.attrs["missed"]
    assert answer.attrs["missed"] in said
    rounds = sorted((fresh / "results/tiny/draws/mine").glob("*.nc"))
    last = datasets.read(rounds[-1])
    assert last.next_seeds == last.seeds == len(hard)

    # Less than that takes from what is there.
    asks(fresh, "accuracy: 0.4")
    planned = fresh.planned(ANSWER)
    assert "solve_repulsive" not in planned, planned


def test_killed_between_rounds(fresh):
    asks(fresh, "accuracy: 0.25, sampling: plain")
    process = subprocess.Popen(
        fresh.command(ANSWER, *TINY),
        cwd=fresh.folder,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    first = fresh / "results/tiny/draws/mine/round1.nc"
    while not first.exists():
        assert process.poll() is None, "the run ended before it could be killed"
        time.sleep(0.05)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    written = first.stat().st_mtime_ns
    assert int(datasets.read(first).next_seeds) > int(datasets.read(first).seeds)

    _, answer, _ = answered(fresh)
    assert first.stat().st_mtime_ns == written
    assert "missed" not in answer.attrs
    assert (answer.total_error <= 0.25 * answer.value).all()
