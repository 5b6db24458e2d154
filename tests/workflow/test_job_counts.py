"""README's numbers of jobs are those of a dry-run."""

from pathlib import Path

import pytest
import yaml

from pipeline.quoted.sources import Sources
from pipeline.quoted.times import quote_jobs

pytestmark = pytest.mark.workflow
ROOT = Path(__file__).parents[2]


def test_readme_has_the_jobs_of_a_run():
    numbers = yaml.safe_load((ROOT / "docs/numbers.yaml").read_text(encoding="utf-8"))["numbers"]
    found = quote_jobs(Sources(ROOT / "results/standard", ROOT / "results/draft", ROOT))
    assert found == {name: numbers[name] for name in found}, "run: make numbers"
