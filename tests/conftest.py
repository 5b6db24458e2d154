"""Profiles of property tests: ``pytest --hypothesis-profile=deep tests/stickiness/core``."""

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
