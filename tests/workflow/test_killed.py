"""A run that was killed outright goes on where it was, and nothing is corrupt."""

import os
import signal
import subprocess
import time

import pytest

from stickiness import datasets

pytestmark = pytest.mark.workflow

TARGET = "results/tiny/contact/ensembles/H0.8_zeta64.nc"
TINY = ["--configfile", "config/config.yaml", "config/tiny.yaml"]


def test_killed_run_resumes(fresh, finished):
    process = subprocess.Popen(
        fresh.command(TARGET, *TINY),
        cwd=fresh.folder,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    surfaces = fresh / "results/tiny/surfaces/H0.8_zeta64"
    deadline = time.monotonic() + 120
    while not list((fresh / "results/tiny/contact/H0.8_zeta64").glob("seed*.nc")):
        assert time.monotonic() < deadline, "no job finished within two minutes"
        assert process.poll() is None, "the run ended before it could be killed"
        time.sleep(0.05)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    assert not (fresh / TARGET).exists()

    finished_surfaces = {path: path.stat().st_mtime_ns for path in surfaces.glob("seed*.nc")}
    unlocked = fresh.snakemake("--unlock", TARGET)  # as Snakemake says
    assert unlocked.returncode == 0, unlocked.stdout
    done = fresh.snakemake("-j1", TARGET)
    assert done.returncode == 0, done.stdout
    # Of everything on the way, the same bits by one process at a time as by two.
    made = [path.relative_to(fresh.folder) for path in (fresh / "results").rglob("*.nc")]
    assert len(made) >= 4
    whole = [path for path, time in finished_surfaces.items() if path.stat().st_mtime_ns == time]
    assert whole, "what had been finished was made again"
    for path in made:
        assert datasets.read(fresh / path).identical(datasets.read(finished / path)), path
    assert not list((fresh / "results").rglob(".*-*.nc")), "a temporary file was left behind"


def test_lock_of_a_living_run_is_respected(fresh):
    process = subprocess.Popen(
        fresh.command("claims", *TINY),
        cwd=fresh.folder,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    try:
        deadline = time.monotonic() + 120
        while not list((fresh / ".snakemake/locks").glob("*.lock")):
            assert time.monotonic() < deadline
            time.sleep(0.05)
        second = fresh.snakemake("claims")
        assert second.returncode != 0
        assert "lock" in second.stdout.lower()
    finally:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
