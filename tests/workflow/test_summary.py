"""What a run says at its end and of a job that fails; Snakemake's own report."""

import re

import pytest

from stickiness import datasets
from stickiness.criteria.pair import NOT_JUDGED

pytestmark = pytest.mark.workflow


def test_a_run_ends_with_a_summary(finished):
    text = finished.run.stdout
    assert re.search(r"^  report +results/tiny/report/report.html$", text, re.M)
    assert re.search(r"^  claims +\d+ ", text, re.M)
    assert re.search(r"^  pairs +\d+ ", text, re.M)


def test_a_bad_file_holds_up_what_needs_it_and_nothing_else(copy_of_finished):
    (copy_of_finished / "config/torn.txt").write_text("no heights\n", encoding="utf-8")
    copy_of_finished.add(
        "  torn: {kind: measured, label: torn, source: own, file: config/torn.txt, "
        "format: text, length: 1 mm, height_unit: um}\n"
        "  mine: {kind: self_affine, label: mine, source: own, hurst: 0.8, h_rms: 1 um, "
        "longest_wavelength: 1 mm, shortest_wavelength: 1 um}\n",
        "config/tiny_surfaces.yaml",
    )
    done = copy_of_finished.snakemake("verdicts", "surfaces")
    assert done.returncode != 0
    assert re.search(r"config/torn\.txt: .*no line of numbers", done.stdout)
    pages = copy_of_finished / "results/tiny/report/surfaces"
    assert (pages / "mine.html").exists()
    assert not (pages / "torn.html").exists()
    assert re.search(r"^  pages +results/tiny/report/surfaces/mine.html$", done.stdout, re.M)
    log = "results/tiny/logs/write_surface/report/surfaces/torn.log"
    *_, lines = done.stdout.partition("  failed    Fix what follows")
    why = r"ValueError: config/torn\.txt: no line of numbers found; .*"
    assert re.search(rf"^  failed    {why} \(log: {log}\)$", lines, re.M)
    why = r"ValueError: surfaces that are not judged, since they could not be read: torn"
    assert re.search(rf"^  failed    {why} \(log: .*check_surfaces.*\)$", lines, re.M)
    assert lines.count("  failed    ") == 2
    assert not re.search(r"^  claims ", done.stdout, re.M), "a count of an earlier run"
    # The tables have all surfaces.
    verdicts = datasets.read(copy_of_finished / "results/tiny/criteria/verdicts.nc")
    torn = verdicts.sel(surface="torn")
    assert (torn.verdict == NOT_JUDGED).all()
    assert torn.remaining.isnull().all()
    assert torn.rms_height.isnull()
    assert all("no line of numbers" in reason for reason in torn.not_judged.values)
    assert (verdicts.sel(surface="mine").verdict != NOT_JUDGED).all()
    table = (copy_of_finished / "results/tiny/criteria/verdicts.md").read_text(encoding="utf-8")
    assert re.search(r"\| torn \|.*not judged", table)
    # A second run fails as well, and makes no table again.
    again = copy_of_finished.snakemake("verdicts")
    assert again.returncode != 0
    assert not re.search(r"^rule judge:", again.stdout, re.M)


def test_a_failed_job_says_why_in_a_line_and_its_log_has_the_trace(copy_of_finished):
    copy_of_finished.edit(
        "scripts/criteria/map_criterion.py",
        "def main(job):",
        'def main(job):\n    raise ValueError("spoilt")',
    )
    done = copy_of_finished.snakemake("results/tiny/criteria/map.nc")
    assert done.returncode != 0
    assert "Error in rule map_criterion" in done.stdout
    assert re.search(r"^ValueError: spoilt$", done.stdout, re.M)
    log = copy_of_finished / "results/tiny/logs/map_criterion/criteria/map.log"
    place = log.relative_to(copy_of_finished.folder)
    assert f"  failed    ValueError: spoilt (log: {place})\n" in done.stdout
    text = log.read_text(encoding="utf-8")
    assert "Traceback" in text
    assert 'raise ValueError("spoilt")' in text
