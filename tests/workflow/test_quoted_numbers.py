"""The report of a run and the numbers that README would quote from it agree."""

import re

import pytest

from pipeline.quoted import claims, experiments, verdicts
from pipeline.quoted.sources import WORDS, Sources

pytestmark = pytest.mark.workflow


def test_report_and_quoted_numbers_agree(finished):
    results = finished / "results/tiny"
    sources = Sources(results, results, finished.folder)
    page = re.sub(r"\s+", " ", (results / "report/report.html").read_text(encoding="utf-8"))
    pairs, grades = verdicts.quote_counts(sources), claims.quote_grades(sources)
    outcomes = experiments.quote_outcomes(sources)
    assert f"{pairs['pairs']} verdicts<" in page
    assert f"{pairs['pairs.stick']} of {pairs['pairs']} pairs stick" in page
    for name, word in (("touch", "touches without hold"), ("not", "does not stick")):
        assert f"</span>{pairs[f'pairs.{name}']} {word}<" in page or pairs[f"pairs.{name}"] == "0"
    assert f"{grades['claims.graded']} recomputed<" in page
    reproduced = WORDS.index(grades["claims.reproduced"])
    assert f"</span>{reproduced} reproduced<" in page
    count = {name: WORDS.index(text) for name, text in outcomes.items()}
    assert (
        f"overlap with {count['experiments.compatible']} of {count['experiments.tested']} published"
        in page
    )
    assert claims.quote_threshold(sources)["threshold"] in page
