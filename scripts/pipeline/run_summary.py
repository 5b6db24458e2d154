"""What a run tells a person: a line for every finished job, with the time left, and a summary."""

from __future__ import annotations

import logging
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TextIO

from snakemake_interface_logger_plugins.common import LogEvent

from pipeline.pages.benchmarks import benchmark_lines

# Said by Snakemake of every job; a line of ours takes their place on the terminal. Its own log file
# keeps them.
REPLACED = {
    LogEvent.JOB_INFO,
    LogEvent.JOB_STARTED,
    LogEvent.JOB_FINISHED,
    LogEvent.PROGRESS,
    LogEvent.SHELLCMD,
}
FEW = 3  # finished jobs before the time left is told


@dataclass
class Job:
    """A job of this run.

    Attributes
    ----------
    rule, name : str
        Its rule; rule and wildcards for the reader.
    expected : float or None
        Seconds that it took earlier, or that jobs of its rule took; None if there were none.
    log : str
        Its log file, if it has one.
    """

    rule: str
    name: str
    expected: float | None
    log: str = ""
    started: float = field(default_factory=time.monotonic)


class Progress(logging.Handler):
    """Prints a line for every job that finishes, and remembers what happened for the summary.

    Parameters
    ----------
    jobs : mapping of int to Job
        Jobs that are to run, by Snakemake's number.
    cores : int
        Number of jobs that may run at once, for the first guess of the time needed.
    stream : file
        Where to print.
    more : callable, optional
        The jobs that are to run by now, called when one begins that is not known: what a round of
        seeds asks for next is known only once it has been assessed.
    """

    def __init__(
        self,
        jobs: Mapping[int, Job],
        cores: int = 1,
        stream: TextIO = sys.stderr,
        more: Callable[[], Mapping[int, Job]] = dict,
    ):
        super().__init__()
        self.more = more
        self.jobs, self.cores, self.stream = dict(jobs), max(cores, 1), stream
        self.finished: list[int] = []
        self.failed: list[int] = []
        self.began = time.monotonic()

    def emit(self, record: logging.LogRecord) -> None:
        event = getattr(record, "event", None)
        if event == LogEvent.JOB_STARTED:
            if set(record.jobs) - self.jobs.keys():
                self.jobs = {**self.more(), **self.jobs}
            for number in set(record.jobs) & self.jobs.keys():
                self.jobs[number].started = time.monotonic()
        elif event == LogEvent.JOB_ERROR and record.jobid in self.jobs:
            self.failed.append(record.jobid)
        elif event == LogEvent.JOB_FINISHED and record.job_id in self.jobs:
            self.finished.append(record.job_id)
            print(self.line(record.job_id), file=self.stream, flush=True)

    def line(self, number: int) -> str:
        """The line of a job that has just finished."""
        job, total = self.jobs[number], len(self.jobs)
        took = time.monotonic() - job.started
        left = self.left()
        rest = "" if left is None else f"; about {duration(left)} left"
        return (
            f"[{len(self.finished):>{len(str(total))}}/{total}] {job.name}, {duration(took)}{rest}"
        )

    def opening(self) -> str:
        """The first line: what is to be done, and how long that took earlier, if it is known."""
        known = [job.expected for job in self.jobs.values() if job.expected is not None]
        line = f"{len(self.jobs)} jobs to run"
        if len(known) < len(self.jobs) / 2:
            return line
        total = sum(self.expected().values())
        return f"{line}; by earlier runs about {duration(total / self.cores)}"

    def expected(self) -> dict[int, float]:
        """Seconds of every job; one that is not known counts as the mean of those that are."""
        known = [job.expected for job in self.jobs.values() if job.expected is not None]
        mean = sum(known) / len(known) if known else 1.0
        return {n: mean if j.expected is None else j.expected for n, j in self.jobs.items()}

    def left(self) -> float | None:
        """Seconds left, if the rest goes as the jobs so far did against what was expected."""
        rest = self.jobs.keys() - set(self.finished)
        if len(self.finished) < FEW or not rest:
            return None
        expected = self.expected()
        done = sum(expected[number] for number in self.finished)
        return (time.monotonic() - self.began) * sum(expected[number] for number in rest) / done


def quieten(logger: logging.Logger) -> None:
    """Keep what `Progress` says in its own words off the terminal."""

    def other(record: logging.LogRecord) -> bool:
        selecting = str(record.msg).startswith("Select jobs to execute")
        return getattr(record, "event", None) not in REPLACED and not selecting

    for handler in logger.handlers:
        if handler.name == "DefaultStreamHandler":
            handler.addFilter(other)


def jobs_of(dag: Any) -> dict[int, Job]:
    """Jobs of Snakemake's graph that are to run and make files."""
    todo = [job for job in dag.needrun_jobs() if job.output]
    own = {job: seconds(job.benchmark) for job in todo}
    by_rule: dict[str, list[float]] = {}
    for job in dag.jobs:
        took = own.get(job) or seconds(job.benchmark)
        if took is not None:
            by_rule.setdefault(job.rule.name, []).append(took)

    def expected(job: Any) -> float | None:
        if own[job] is not None:
            return own[job]
        others = by_rule.get(job.rule.name)
        return sum(others) / len(others) if others else None

    return {
        job.jobid: Job(
            job.rule.name, name_of(job), expected(job), str(job.log[0]) if job.log else ""
        )
        for job in todo
    }


def seconds(benchmark: str | None) -> float | None:
    """Time of an earlier run of a job, by its benchmark file."""
    try:
        return benchmark_lines(Path(benchmark))[-1][0]
    except (TypeError, OSError, ValueError, IndexError):
        return None


def name_of(job: Any) -> str:
    return " ".join([job.rule.name, *map(str, job.wildcards)])


def duration(seconds: float) -> str:
    """Time for people: 4 s, 12 min, 3.1 h."""
    if seconds < 99.5:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5940 else f"{seconds / 3600:.1f} h"


def summary(
    progress: Progress,
    reused: int,
    results: Mapping[str, str],
    grades: Iterable[tuple[str, str]] = (),
) -> str:
    """The last words of a run.

    Parameters
    ----------
    progress
        What happened.
    reused : int
        Number of jobs whose files were up to date.
    results : mapping of str to str
        Where the results are, by what they are; those that exist are named.
    grades
        Further lines, such as which claims hold.
    """
    ran = Counter(progress.jobs[number].rule for number in progress.finished)
    failed = list(dict.fromkeys(progress.failed))
    waiting = len(progress.jobs) - len(set(progress.finished) | set(failed))
    took = duration(time.monotonic() - progress.began)
    counts = f"{len(progress.finished)} jobs ran, {reused} were up to date"
    if failed or waiting:
        head = f"Stopped after {took}: {counts}, {len(failed)} failed, {waiting} were not reached."
    else:
        head = f"Done in {took}: {counts}."
    lines = [("ran", ", ".join(f"{rule} {count}" for rule, count in ran.most_common()))]
    for number in failed:
        job = progress.jobs[number]
        lines += [("failed", job.name), ("", last_line(job.log)), ("its log", job.log)]
    lines += [(what, path) for what, path in results.items() if Path(path).exists()]
    lines += list(grades)
    if failed or waiting:
        lines.append(("to go on", "the same command again"))
    return "\n".join(["", head, *(f"  {what:<9} {text}" for what, text in lines if text)])


def graded(results: str) -> list[tuple[str, str]]:
    """Which claims hold and which pairs stick, by the ledger and the verdicts among the results."""
    from pipeline.pages.verdict_texts import STICKINESS
    from stickiness.core import datasets

    lines = []
    claims, verdicts = Path(results, "claims/claims.nc"), Path(results, "criteria/verdicts.nc")
    if claims.exists():
        counts = Counter(map(str, datasets.read(claims, ["verdict"]).verdict.values))
        lines.append(("claims", counted(counts)))
    if verdicts.exists():
        codes = datasets.read(verdicts, ["verdict"]).verdict.values.ravel()
        lines.append(("pairs", counted(Counter(STICKINESS[code] for code in codes))))
    return lines


def missed(files: Iterable[str]) -> list[tuple[str, str]]:
    """Cases that were not solved as accurately as they ask for, by their files that exist."""
    from stickiness.core import datasets

    answers = (datasets.read(path) for path in files if Path(path).exists())
    return [("missed", text) for answer in answers if (text := answer.attrs.get("missed"))]


def counted(counts: Counter[str]) -> str:
    return ", ".join(f"{count} {word}" for word, count in counts.most_common())


def last_line(path: str) -> str:
    """Last line of a log that says anything."""
    try:
        lines = Path(path).read_text(encoding="utf-8", errors="replace").split("\n")
    except OSError:
        return ""
    return next((line.strip() for line in reversed(lines) if line.strip()), "")
