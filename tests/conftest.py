"""Profiles of property tests (``--hypothesis-profile=deep``); how tests share processes."""

import pytest
from hypothesis import HealthCheck, settings

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


def pytest_collection_modifyitems(items):
    """Keep tests of the workflow in one process (``-n 2 --dist loadgroup``): they share a run."""
    for item in items:
        if item.get_closest_marker("workflow"):
            item.add_marker(pytest.mark.xdist_group("workflow"))
