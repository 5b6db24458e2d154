"""The line of every finished job, the time left and the summary, from made-up events."""

import io
import logging

import pytest
import xarray as xr
from snakemake_interface_logger_plugins.common import LogEvent

from pipeline import run_summary
from pipeline.run_summary import Job, Progress
from stickiness.core import datasets


@pytest.fixture
def clock(monkeypatch):
    """A clock that the test sets."""
    now = [100.0]
    monkeypatch.setattr(run_summary.time, "monotonic", lambda: now[0])
    return now


def told(progress, event, **extra):
    progress.emit(logging.makeLogRecord({"event": event, **extra}))


@pytest.fixture
def progress(clock, tmp_path):
    """Five jobs: quick ones of 1 s and a slow one of 10 s, by earlier runs; one is not known."""
    log = tmp_path / "slow.log"
    log.write_text("first\nValueError: too rough\n\n")
    jobs = {number: Job("quick", f"quick {number}", 1.0, started=clock[0]) for number in (1, 2, 3)}
    jobs[4] = Job("slow", "slow 4", 10.0, str(log), started=clock[0])
    jobs[5] = Job("other", "other 5", None, started=clock[0])
    return Progress(jobs, cores=2, stream=io.StringIO())


def run(progress, clock, numbers, each=2.0):
    for number in numbers:
        told(progress, LogEvent.JOB_STARTED, jobs=[number])
        clock[0] += each
        told(progress, LogEvent.JOB_FINISHED, job_id=number)


def test_line_of_a_job(progress, clock):
    run(progress, clock, [1])
    assert progress.stream.getvalue() == "[1/5] quick 1, 2 s\n"


def test_time_left_follows_what_jobs_took_earlier(progress, clock):
    run(progress, clock, [1, 2, 3])
    # 3 s of earlier work took 6 s; left are 10 s and one that counts as the mean, 13/4 s.
    assert progress.left() == pytest.approx(2 * (10 + 13 / 4))
    assert progress.stream.getvalue().endswith("[3/5] quick 3, 2 s; about 26 s left\n")


def test_no_guess_from_too_few_jobs(progress, clock):
    run(progress, clock, [1, 2])
    assert progress.left() is None


def test_opening(progress):
    # 13 s and one unknown of 13/4 s on two cores.
    assert progress.opening() == "5 jobs to run; by earlier runs about 8 s"
    unknown = Progress({1: Job("a", "a", None), 2: Job("b", "b", None)})
    assert unknown.opening() == "2 jobs to run"


def test_summary_of_a_run_that_ended_well(progress, clock, tmp_path):
    run(progress, clock, [1, 2, 3, 4, 5], each=60)
    text = run_summary.summary(
        progress,
        7,
        {"results": str(tmp_path), "report": str(tmp_path / "missing.html")},
        [("claims", "3 reproduced")],
    )
    head, *lines = text.strip().splitlines()
    assert head == "Done in 5 min: 5 jobs ran, 7 were up to date."
    assert lines == [
        "  ran       quick 3, slow 1, other 1",
        f"  results   {tmp_path}",
        "  claims    3 reproduced",
    ]


def test_summary_names_the_job_that_failed_and_what_its_log_says(progress, clock):
    run(progress, clock, [1, 2])
    told(progress, LogEvent.JOB_ERROR, jobid=4)
    told(progress, LogEvent.JOB_ERROR, jobid=4)  # told twice where it is tried again
    text = run_summary.summary(progress, 0, {})
    assert "Stopped after 4 s: 2 jobs ran, 0 were up to date, 1 failed, 2 were not reached." in text
    assert "failed    slow 4" in text
    assert "ValueError: too rough" in text
    assert "slow.log" in text
    assert "the same command again" in text


def test_target_rules_are_not_counted(progress):
    told(progress, LogEvent.JOB_FINISHED, job_id=0)
    assert progress.stream.getvalue() == ""


def test_jobs_that_a_checkpoint_adds_are_told(progress, clock):
    """The graph is asked for them when the first of them begins; the rest then counts, too."""
    run(progress, clock, [1, 2, 3, 4])
    asked = []

    def more():
        asked.append(1)
        return {number: Job("late", f"late {number}", 4.0) for number in (6, 7)}

    progress.more = more
    run(progress, clock, [5, 6, 7])
    lines = progress.stream.getvalue().splitlines()
    assert lines[4].startswith("[5/5] other 5")
    assert lines[5].startswith("[6/7] late 6, 2 s; about")
    assert lines[6] == "[7/7] late 7, 2 s"
    assert len(asked) == 1


def test_summary_names_the_cases_that_missed_their_accuracy(tmp_path):
    for name, text in (("mine", "mine: error 0.3 of 0.2 asked"), ("yours", "")):
        dataset = datasets.annotate(xr.Dataset({"value": 1}), value=("1", "some value"))
        dataset.attrs |= {"missed": text} if text else {}
        datasets.write(dataset, tmp_path / f"{name}.nc", title="answer", parameters={})
    files = [str(tmp_path / f"{name}.nc") for name in ("mine", "yours", "not_yet")]
    assert run_summary.missed(files) == [("missed", "mine: error 0.3 of 0.2 asked")]


def test_own_lines_replace_those_of_the_terminal_alone():
    logger = logging.Logger("some")
    for name in ("DefaultStreamHandler", "DefaultLogFileHandler"):
        handler = logging.StreamHandler(io.StringIO())
        handler.name = name
        logger.addHandler(handler)
    run_summary.quieten(logger)
    logger.info("Finished jobid 3", extra={"event": LogEvent.JOB_FINISHED, "job_id": 3})
    logger.info("Select jobs to execute...")
    logger.error("Error in rule x", extra={"event": LogEvent.JOB_ERROR, "jobid": 3})
    terminal, file = (handler.stream.getvalue() for handler in logger.handlers)
    assert terminal == "Error in rule x\n"
    assert file.count("\n") == 3


@pytest.mark.parametrize(
    ("seconds", "text"), [(4.4, "4 s"), (99, "99 s"), (130, "2 min"), (11160, "3.1 h")]
)
def test_duration(seconds, text):
    assert run_summary.duration(seconds) == text
