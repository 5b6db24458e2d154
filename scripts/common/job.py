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

    `names` are the ``globals()`` of the script, which hold `snakemake` if Snakemake runs it. Run by
    hand, from the project's top folder, a script looks its job up in the workflow.
    """
    job = names.get("snakemake")
    if job is None:
        job = find_job(rule, wildcards | dict(argument.split("=", 1) for argument in sys.argv[1:]))
    Path(job.log[0]).parent.mkdir(parents=True, exist_ok=True)
    style = {"level": logging.INFO, "format": "%(asctime)s %(levelname)s %(message)s"}
    logging.basicConfig(filename=job.log[0], filemode="w", force=True, **style)
    sys.excepthook = report_error
    # Beside the code if possible, for runs in all folders; machines that share it may differ.
    project = Path(__file__).parents[2]
    place = project if os.access(project, os.W_OK) else Path()
    compiled = Path(place, ".snakemake", "loops", platform.node()).absolute()
    os.environ.setdefault("NUMBA_CACHE_DIR", str(compiled))
    return job


def report_error(kind: type[BaseException], error: BaseException, trace: Any) -> None:
    """Write one line to the terminal, and the same with the traceback to the log."""
    line = f"{kind.__name__}: {error}"
    logging.error("%s", line, exc_info=(kind, error, trace))
    print(line, file=sys.stderr)


def find_job(rule: str, wildcards: dict[str, Any]) -> SimpleNamespace:
    """Return the job of a rule with `input`, `output`, `params` and `log` as in a run."""
    from snakemake.api import SnakemakeApi
    from snakemake.rules import Wildcards
    from snakemake.settings.types import ConfigSettings, OutputSettings, ResourceSettings

    config = ConfigSettings(config={k: wildcards.pop(k) for k in ("fidelity",) if k in wildcards})
    with SnakemakeApi(OutputSettings(quiet=None)) as api:
        run = api.workflow(
            ResourceSettings(cores=1), config_settings=config, snakefile=Path("Snakefile")
        )
        # The documented API runs workflows but does not show single jobs.
        definition = run._workflow.get_rule(rule)
        values = Wildcards(fromdict=wildcards)
        inputs, *_ = definition.expand_input(values, groupid=None)
        outputs, _ = definition.expand_output(values)
        params, _ = definition.expand_params(values, inputs, outputs, definition)
        return SimpleNamespace(
            rule=rule,
            wildcards=values,
            params=params,
            input=inputs,
            output=outputs,
            log=definition.expand_log(values),
        )
