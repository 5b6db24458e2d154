"""Runs that are killed and files that are damaged: nothing is lost, and the next run completes."""

import os
import shutil
import signal
import time

import psutil
import pytest

from stickiness import datasets

pytestmark = pytest.mark.workflow

SURFACE = "results/tiny/surfaces/H0.9_zeta64@4/seeds1-2.nc"
SOLVED = "results/tiny/contact/H0.9_zeta64@4_1e-06/seeds1-2_p0.0065_0.03_0.065_0.13_0.3.nc"


def wait_for(find, run):
    """What `find` finds, once it does."""
    deadline = time.monotonic() + 600
    while not (found := find()):
        assert time.monotonic() < deadline, "nothing within ten minutes"
        assert run.poll() is None, "the run has ended before"
        time.sleep(0.02)
    return found


def solving_jobs(run):
    """Processes of a run that solve for contacts."""
    found = []
    for child in psutil.Process(run.pid).children(recursive=True):
        try:
            if any(word.endswith("solve_repulsive.py") for word in child.cmdline()):
                found.append(child.pid)
        except psutil.Error:
            pass
    return found


def complete(workflow, finished):
    """Run again; results are those of an undisturbed run, to the bit."""
    done = workflow.snakemake("-j1", SOLVED)
    assert done.returncode == 0, done.stdout
    for path in (SURFACE, SOLVED):
        assert datasets.read(workflow / path).equals(datasets.read(finished / path))
    assert not list((workflow / "results").rglob(".*.nc")), "a temporary file was left behind"


def test_a_killed_job_and_a_killed_run_lose_nothing_that_was_finished(fresh, finished):
    alone = {"start_new_session": True}
    run = fresh.start(SOLVED, **alone)  # whose job is killed, as by the kernel when memory runs out
    os.kill(wait_for(lambda: solving_jobs(run), run)[0], signal.SIGKILL)
    output, _ = run.communicate(timeout=600)
    assert run.returncode != 0
    assert "solve_repulsive" in output
    assert "Error in rule solve_repulsive" in output
    assert not (fresh / SOLVED).exists()
    written = (fresh / SURFACE).stat().st_mtime_ns
    run = fresh.start(SOLVED, **alone)  # which is killed as a whole
    os.kill(wait_for(lambda: solving_jobs(run), run)[0], signal.SIGSTOP)  # until then
    second = fresh.snakemake(SOLVED)
    assert second.returncode != 0
    assert "lock" in second.stdout.lower()
    os.killpg(run.pid, signal.SIGKILL)
    run.communicate()
    unlocked = fresh.snakemake("--unlock", SOLVED)  # as Snakemake says
    assert unlocked.returncode == 0, unlocked.stdout
    complete(fresh, finished)
    assert (fresh / SURFACE).stat().st_mtime_ns == written


def test_truncated_and_misplaced_files_are_named(fresh, finished):
    other = SURFACE.replace("H0.9", "H0.7")
    for source, target in ((SURFACE, SURFACE), (SOLVED, SOLVED), (SURFACE, other)):
        (fresh / target).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(finished / source, fresh / target)
    content = (fresh / SURFACE).read_bytes()
    (fresh / SURFACE).write_bytes(content[: len(content) // 2])
    run = fresh.snakemake(SOLVED, SOLVED.replace("H0.9", "H0.7"))
    assert run.returncode != 0
    assert "Traceback" not in run.stdout
    assert f"{SURFACE}: not a readable NetCDF file" in run.stdout
    assert (
        f"{other}: holds what belongs in {SURFACE.removeprefix('results/')}; delete" in run.stdout
    )
    (fresh / SURFACE).unlink()
    complete(fresh, finished)
