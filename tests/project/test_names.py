"""Words of one meaning: retired names stay out of modules, functions, classes and columns."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
#: Retired names, by what is said instead.
RETIRED = {
    "continuum value, correction": r"grid_limits|class Limit\b",
    "plausible range": r"plausibility\.LIMITS|plausibility import.*\bLIMITS\b",
    "threshold": r"h_rms_limit",
    "trusted waves": r"instrument_spectrum\.Limits|_LIMIT_KEYS",
    "eta, error of the model": r"\bdeviation_sign\b|DEVIATIONS",
    "family of spectra": r"pair_roughness|shorter_waves",
    "campaign": r"limits_kind|limits_set",
}


@pytest.mark.parametrize("said", RETIRED)
def test_retired_names_do_not_come_back(said):
    places = [
        f"{path.relative_to(ROOT)}: {match[0]}"
        for folder in ("scripts", "rules")
        for path in (ROOT / folder).rglob("*.*")
        if path.suffix in (".py", ".smk", ".j2")
        for match in re.finditer(RETIRED[said], path.read_text(encoding="utf-8"))
    ]
    assert places == []
