"""What all tests share: profiles of property tests, caches, and no test left out in CI.

``pytest --hypothesis-profile=deep tests/stickiness`` tries many more examples.
"""

import atexit
import os
import platform
import shutil
import sys
import tempfile
from functools import partial
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

from stickiness.remaining import height_simulation
from stickiness.remaining.height_simulation import find_pull_offs, find_trial_states
from stickiness.verdicts import simulated_surface

# The same examples every time and few of them: a test that fails now and then helps nobody.
settings.register_profile(
    "quick",
    derandomize=True,
    database=None,
    deadline=None,
    max_examples=12,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.register_profile(
    "deep", settings.get_profile("quick"), derandomize=False, max_examples=300
)
settings.load_profile("quick")

# Runs of the workflow that tests start, and those of this folder, use what these tests compile.
_LOOPS = Path(__file__).parents[1] / ".snakemake/loops" / platform.node()
os.environ.setdefault("NUMBA_CACHE_DIR", str(_LOOPS))

# Snakemake keeps sources in the user's cache, also in runs that tests start. An account without a
# home, or with one that cannot be written, gets a cache for the length of the tests.
_HOME = os.path.expanduser("~")
_CACHE = Path(os.environ.get("XDG_CACHE_HOME") or Path(_HOME, ".cache"))
try:
    _CACHE.mkdir(parents=True, exist_ok=True)
    _WRITABLE = os.access(_CACHE, os.W_OK)
except OSError:
    _WRITABLE = False
if not _WRITABLE:
    os.environ["XDG_CACHE_HOME"] = tempfile.mkdtemp()
    atexit.register(shutil.rmtree, os.environ["XDG_CACHE_HOME"], ignore_errors=True)


def pytest_addoption(parser):
    parser.addoption("--fix", action="store_true", help="write tables of what numbers were anew")


def pytest_configure(config):
    if config.getoption("fix") and config.getoption("numprocesses", None):
        raise pytest.UsageError("--fix writes a table from one process: leave out -n, or give -n0")


# Where CI runs, on Linux, all can be installed that a test needs, but for these and what CI says.
_MAY_BE_SKIPPED = ["Slurm", "SLURM_PROOF", "Tamaas 2.9.0 misplaces"]
_MAY_BE_SKIPPED += filter(None, [os.environ.get("MAY_BE_SKIPPED")])
_IN_CI = bool(os.environ.get("CI")) and sys.platform == "linux"


def _refuse_skip(report: pytest.TestReport | pytest.CollectReport) -> None:
    """Let a test fail that is skipped without need."""
    if not (_IN_CI and report.skipped) or hasattr(report, "wasxfail"):
        return
    reason = str(report.longrepr[2] if isinstance(report.longrepr, tuple) else report.longrepr)
    if not any(excuse in reason for excuse in _MAY_BE_SKIPPED):
        report.outcome = "failed"
        report.longrepr = f"CI must not skip this: {reason}"


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport():
    report = yield
    _refuse_skip(report)
    return report


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report():
    report = yield
    _refuse_skip(report)
    return report


_FOUND = {}  # states of contact


def _find_once(find, heights, length, **options):
    """What is found by `find`, once on the same heights for all tests of a process."""
    key = (find, heights.tobytes(), heights.shape, length, *options.values())
    if key not in _FOUND:
        _FOUND[key] = find(heights, length, **options)
    return _FOUND[key]


@pytest.fixture(scope="module")
def coarse_simulation():
    """Contact on measured heights is simulated on a coarse grid, a tenth of the work, and once.

    For tests of what is done with the simulated states, rather than of their numbers.
    """
    with pytest.MonkeyPatch.context() as patch:
        coarse = partial(simulated_surface.standardise, most_points=32)
        patch.setattr(simulated_surface, "standardise", coarse)
        for find in (find_trial_states, find_pull_offs):
            patch.setattr(height_simulation, find.__name__, partial(_find_once, find))
        yield
