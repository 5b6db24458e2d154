"""Start of every script: the job that it runs, and its log."""

import logging
import os
import platform
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any


def start(names: dict[str, Any], rule: str, **wildcards: Any) -> Any:
    """Return the job's `snakemake` object, open its log and report errors to it.

    Run by hand, from the project's top folder, a script looks its job up in the workflow:
    ``PYTHONPATH=scripts python scripts/fits/fit_a_v.py case=H0.8_zeta128 fidelity=draft``.

    Parameters
    ----------
    names : dict
        The ``globals()`` of the script, which hold `snakemake` if Snakemake runs it.
    rule : str
        Name of the rule, for a run by hand.
    wildcards
        Wildcards for a run by hand, unless the command line has others.
    """
    job = names.get("snakemake")
    if job is None:
        given = dict(argument.split("=", 1) for argument in sys.argv[1:])
        job = find_job(rule, wildcards | given)
    Path(job.log[0]).parent.mkdir(parents=True, exist_ok=True)
    style = {"level": logging.INFO, "format": "%(asctime)s %(levelname)s %(message)s"}
    logging.basicConfig(filename=job.log[0], filemode="w", force=True, **style)
    sys.excepthook = report_error
    # Machines that share the folder may have different processors.
    compiled = Path(".snakemake", "loops", platform.node()).absolute()
    os.environ.setdefault("NUMBA_CACHE_DIR", str(compiled))
    return job


def report_error(kind: type[BaseException], error: BaseException, trace: Any) -> None:
    """Write one line to the terminal, and the same with the traceback to the log."""
    line = f"{kind.__name__}: {error}"
    logging.error("%s", line, exc_info=(kind, error, trace))
    print(line, file=sys.stderr)


def find_job(rule: str, wildcards: dict[str, Any]) -> SimpleNamespace:
    """Return the job of a rule with `input`, `output`, `params` and `log` as in a run.

    The documented API of Snakemake runs workflows but does not show single jobs, so this takes the
    rule from the workflow behind it.
    """
    from snakemake.api import SnakemakeApi
    from snakemake.rules import Wildcards
    from snakemake.settings.types import ConfigSettings, OutputSettings, ResourceSettings

    config = {key: wildcards.pop(key) for key in ("fidelity",) if key in wildcards}
    with SnakemakeApi(OutputSettings(quiet=None)) as api:
        found = api.workflow(
            ResourceSettings(cores=1),
            config_settings=ConfigSettings(config=config),
            snakefile=Path("Snakefile"),
        )._workflow.get_rule(rule)
        job = SimpleNamespace(rule=rule, wildcards=Wildcards(fromdict=wildcards))
        job.input, *_ = found.expand_input(job.wildcards, groupid=None)
        job.output, _ = found.expand_output(job.wildcards)
        job.params, _ = found.expand_params(job.wildcards, job.input, job.output, found)
        job.log = found.expand_log(job.wildcards)
        return job
