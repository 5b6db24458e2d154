"""What a run tells: a line for every job, a summary, the failed job; and Snakemake's own report."""

import re

import pytest

pytestmark = pytest.mark.workflow


def test_a_run_tells_every_job_and_ends_with_a_summary(finished):
    text = finished.run.stdout
    total = int(re.search(r"^(\d+) jobs to run", text, re.M)[1])
    lines = re.findall(rf"^\[ *(\d+)/{total}\] (\w+)", text, re.M)
    assert [int(number) for number, _ in lines] == list(range(1, total + 1))
    assert "Finished jobid" not in text
    summary = text[text.index("Done in") :]
    assert f"{total} jobs ran, 0 were up to date." in summary
    assert "report    results/tiny/report/report.html" in summary
    counts = re.search(r"^  claims +(.*)", summary, re.M)[1]
    assert sum(map(int, re.findall(r"\d+", counts))) == 18


def test_a_failed_run_names_the_job_and_its_error(copy_of_finished):
    copy_of_finished.edit(
        "scripts/map_criterion.py",
        "def main(job):",
        'def main(job):\n    raise ValueError("spoilt")',
    )
    done = copy_of_finished.snakemake("results/tiny/criteria/map.nc")
    assert done.returncode != 0
    summary = done.stdout[done.stdout.index("Stopped after") :]
    assert "1 failed" in summary
    assert re.search(r"failed +map_criterion\n +\S+ \S+ ERROR ValueError: spoilt", summary)
    assert "results/tiny/logs/map_criterion.log" in summary


def test_snakemakes_own_report(finished, tmp_path):
    page = tmp_path / "report.html"
    done = finished.snakemake("--report", str(page))
    assert done.returncode == 0, done.stdout
    text = page.read_text(encoding="utf-8")
    for words in (
        "Do two rough solids stick?",
        "Figures",
        "Claims",
        "Verdicts",
        "Surfaces",
        "fig7.png",
    ):
        assert words in text
