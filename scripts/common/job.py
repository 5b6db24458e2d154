"""Start of every script: the job that it runs, and its log.

A script that is started alone, in an editor or a terminal, plans its job itself::

    python scripts/figures/plot_fig3.py results/standard/figures/fig3.png
"""

import argparse
import logging
import os
import platform
import sys
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

PROJECT = Path(__file__).parents[2]
STYLE = {"level": logging.INFO, "format": "%(asctime)s %(levelname)s %(message)s", "force": True}


def start(names: dict[str, Any]) -> Any:
    """Return the job's `snakemake` object, open its log and report errors to it.

    `names` are the ``globals()`` of the script, which hold `snakemake` if Snakemake runs it. If it
    is started alone, the words of its command name the file to make; log and errors then go to the
    terminal, or to the debugger.
    """
    # Beside the code if possible, for runs in all folders; machines that share it may differ.
    place = PROJECT if os.access(PROJECT, os.W_OK) else Path()
    compiled = Path(place, ".snakemake", "loops", platform.node()).absolute()
    os.environ.setdefault("NUMBA_CACHE_DIR", str(compiled))
    # Files are written whole, under names of their own; locks only fail where there are none.
    os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")
    if "snakemake" not in names:
        job = read_command(Path(names["__file__"]), sys.argv[1:])
        logging.basicConfig(**STYLE)
        return job
    job = names["snakemake"]
    Path(job.log[0]).parent.mkdir(parents=True, exist_ok=True)
    logging.basicConfig(filename=job.log[0], filemode="w", **STYLE)
    sys.excepthook = report_error
    return job


def report_error(kind: type[BaseException], error: BaseException, trace: Any) -> None:
    """Write one line to the terminal, and the same with the traceback to the log."""
    line = f"{kind.__name__}: {error}"
    logging.error("%s", line, exc_info=(kind, error, trace))
    print(line, file=sys.stderr)


def mock(
    wanted: str,
    config: Mapping[str, Any] | None = None,
    configfiles: Iterable[str] = (),
    **wildcards: str,
) -> Any:
    """Return the job of a rule, or of a file, as Snakemake would hand it to the script.

    Nothing runs: what the job reads has to be there when the script opens it. Folders of its
    outputs are made.

    Parameters
    ----------
    wanted : str
        Name of the rule, or one of the files that the job makes.
    config : mapping, optional
        Keys of the configuration that differ, as in ``{"fidelity": "draft"}``.
    configfiles : iterable of str
        Files of such keys.
    **wildcards : str
        Wildcards of the rule.

    Returns
    -------
    snakemake.iocontainers.Snakemake
        The job, with `input`, `output`, `params`, `wildcards`, `log` and `config`.

    Raises
    ------
    snakemake.exceptions.RuleException, snakemake.exceptions.WorkflowError
        If no rule makes the file, or wildcards are missing.

    Examples
    --------
    A job of a finished run, by its rule or by its file::

        part = mock("answer_case", case="mine")
        figure = mock("results/standard/figures/fig3.png")
    """
    from snakemake.target_jobs import TargetSpec

    if wildcards or wanted.isidentifier():
        target = {"target_jobs": [TargetSpec(wanted, wildcards)]}
    else:
        target = {"targets": {wanted}}
    return _plan_job(lambda dag: next(iter(dag.targetjobs)), config, configfiles, **target)


def read_command(script: Path, words: list[str]) -> Any:
    """Return the job of a script that is started alone, by the words of its command.

    Without a file it is the first job of the whole run that the script is for.
    """
    from snakemake.cli import parse_config
    from snakemake.exceptions import RuleException, WorkflowError

    about = "Snakemake runs this script. It also runs alone, e.g. in a debugger."
    parser = argparse.ArgumentParser(description=about)
    parser.add_argument("file", nargs="?", help="a file that it makes; default the first of a run")
    parser.add_argument("--config", nargs="+", metavar="KEY=VALUE", help="as of snakemake")
    parser.add_argument(
        "--configfile", nargs="+", default=(), metavar="FILE", help="as of snakemake"
    )
    given = parser.parse_args(words)
    targets = {"targets": {given.file}} if given.file else {}
    name = f"scripts/{script.absolute().parent.name}/{script.name}"

    def choose(dag: Any) -> Any:
        return _first_of(dag.targetjobs if given.file else dag.jobs, name)

    try:
        job = _plan_job(choose, parse_config(given.config), given.configfile, **targets)
    except (LookupError, RuleException, WorkflowError) as error:
        sys.exit(f"{name}: {error}")
    for path in job.input:
        if not Path(path).exists():
            sys.exit(f"{name}: {path} is not made yet; run: snakemake -j1 {path}")
    print(f"{name}: makes {', '.join(job.output)}", file=sys.stderr)
    return job


def _plan_job(
    choose: Callable[[Any], Any],
    config: Mapping[str, Any] | None = None,
    configfiles: Iterable[str] = (),
    **targets: Any,
) -> Any:
    """Plan a run for some targets, by default for all, and return one of its jobs."""
    from snakemake.api import SnakemakeApi
    from snakemake.iocontainers import Snakemake
    from snakemake.settings.enums import Quietness
    from snakemake.settings.types import (
        ConfigSettings,
        DAGSettings,
        OutputSettings,
        ResourceSettings,
    )

    settings = ConfigSettings(config=config or {}, configfiles=[*map(Path, configfiles)])
    with SnakemakeApi(OutputSettings(quiet={Quietness.ALL})) as api:
        opened = api.workflow(
            ResourceSettings(cores=1), config_settings=settings, snakefile=PROJECT / "Snakefile"
        )
        opened.dag(DAGSettings(**targets))
        # What a dry-run does; the interface ends with it, and has no jobs.
        workflow = opened._workflow
        workflow._prepare_dag(forceall=False, ignore_incomplete=True, lock_warn_only=True)
        workflow._build_dag()
        job = choose(workflow.dag)
        rule = job.rule
        made = Snakemake(
            job.input,
            job.output,
            job.params,
            job.wildcards,
            job.threads,
            job.resources,
            job.log,
            workflow.globals["config"],
            rule.name,
            None,
        )
    for path in made.output:
        Path(path).parent.mkdir(parents=True, exist_ok=True)
    return made


def _first_of(jobs: Iterable[Any], script: str) -> Any:
    """First job, in the order of their files, that a script is for."""
    found = [
        job
        for job in jobs
        if job.rule.script and job.format_wildcards(job.rule.script) == f"../{script}"
    ]
    if not found:
        raise LookupError("makes none of the files wanted; name one that it makes")
    return min(found, key=lambda job: list(job.output))
