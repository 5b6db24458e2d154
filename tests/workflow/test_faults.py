"""Faults on the way: one message that says what to do, nothing lost, and the next run completes."""

import os
import shutil
import signal
import subprocess
import time

import psutil
import pytest

from stickiness import datasets

pytestmark = pytest.mark.workflow

RESULTS = "results/tiny"
SURFACE = f"{RESULTS}/surfaces/H0.9_zeta64/seeds1-2.nc"
SOLVED = f"{RESULTS}/contact/H0.9_zeta64/seeds1-2.nc"
TINY = ["--configfile", "config/config.yaml", "config/tiny.yaml"]


def errors(run):
    """The run has failed, and told so without a trace."""
    assert run.returncode != 0, run.stdout
    assert "Traceback" not in run.stdout, run.stdout
    return run.stdout


def completes(workflow, reference):
    run = workflow.snakemake(SOLVED)
    assert run.returncode == 0, run.stdout
    solved = datasets.read(workflow / SOLVED)
    assert solved.equals(reference)
    assert not list((workflow / "results").rglob(".*.nc")), "a temporary file was left behind"


@pytest.fixture
def solved(finished, fresh):
    """A folder with the surface and the solution of one case only, as a run left them."""
    for path in (SURFACE, SOLVED):
        (fresh / path).parent.mkdir(parents=True)
        shutil.copy2(finished / path, fresh / path)
    return fresh


@pytest.fixture
def reference(finished):
    return datasets.read(finished / SOLVED)


def test_killed_job(fresh, reference):
    """The job alone, as by the kernel when memory runs out."""
    run = subprocess.Popen(
        fresh.command(SOLVED, *TINY),
        cwd=fresh.folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    deadline, killed = time.monotonic() + 120, None
    while killed is None:
        assert time.monotonic() < deadline, "no job within two minutes"
        assert run.poll() is None, "the run ended before a job could be killed"
        for child in psutil.Process(run.pid).children(recursive=True):
            if any(word.endswith("solve_repulsive.py") for word in cmdline(child)):
                os.kill(child.pid, signal.SIGKILL)
                killed = child
        time.sleep(0.02)
    output, _ = run.communicate(timeout=120)
    assert run.returncode != 0
    assert "solve_repulsive" in output
    assert (fresh / SURFACE).exists(), "what had been finished is lost"
    assert not (fresh / SOLVED).exists()
    completes(fresh, reference)


def cmdline(process):
    try:
        return process.cmdline()
    except psutil.Error:
        return []


def test_truncated_and_foreign_files(solved, finished, reference):
    other = SURFACE.replace("H0.9", "H0.7")
    good = (solved / SURFACE).read_bytes()
    (solved / SURFACE).write_bytes(good[: len(good) // 2])
    (solved / other).parent.mkdir(parents=True)
    shutil.copy(finished / SURFACE, solved / other)
    said = errors(solved.snakemake("-k", SOLVED, SOLVED.replace("H0.9", "H0.7")))
    assert f"{SURFACE}: not a readable NetCDF file" in said
    assert f"{other}: holds what belongs in {SURFACE.removeprefix('results/')}; delete" in said
    (solved / SURFACE).unlink()
    completes(solved, reference)
    assert (solved / SURFACE).read_bytes() == good
