"""What every script shares: its log, and the job that it is when it is run by hand."""

import logging
import os
import platform
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any


def start(names: dict[str, Any], rule: str, **wildcards: Any) -> Any:
    """Return the job's `snakemake` object; open its log and report errors to it.

    `names` are the ``globals()`` of the script, which hold `snakemake` if Snakemake runs it. By
    hand (from the project's top folder, ``PYTHONPATH=scripts python scripts/fits/fit_a_v.py
    case=H0.8_zeta128 fidelity=draft``) the job of `rule` is looked up in the workflow, with the
    wildcards given here unless the command line has others.
    """
    job = names.get("snakemake") or find_job(rule, **wildcards | arguments())
    Path(job.log[0]).parent.mkdir(parents=True, exist_ok=True)
    style = {"level": logging.INFO, "format": "%(asctime)s %(levelname)s %(message)s"}
    logging.basicConfig(filename=job.log[0], filemode="w", force=True, **style)
    sys.excepthook = report_error
    # Machines that share the folder may have unlike processors.
    compiled = Path(".snakemake", "loops", platform.node()).absolute()
    os.environ.setdefault("NUMBA_CACHE_DIR", str(compiled))
    return job


def report_error(kind: type[BaseException], error: BaseException, trace: Any) -> None:
    """Write one line to the terminal, and the same with the traceback to the log."""
    line = f"{kind.__name__}: {error}"
    logging.error("%s", line, exc_info=(kind, error, trace))
    print(line, file=sys.stderr)


def arguments() -> dict[str, str]:
    """What the command line says as KEY=VALUE: wildcards, or the fidelity."""
    return dict(argument.split("=", 1) for argument in sys.argv[1:])


def find_job(rule: str, **wildcards: Any) -> SimpleNamespace:
    """Job of a rule with these wildcards: `input`, `output`, `params` and `log` as in a run."""
    from snakemake.api import SnakemakeApi
    from snakemake.iocontainers import Wildcards
    from snakemake.settings.types import ConfigSettings, OutputSettings, ResourceSettings

    config = {key: wildcards.pop(key) for key in ("fidelity",) if key in wildcards}
    with SnakemakeApi(OutputSettings(quiet=None)) as api:
        workflow_api = api.workflow(
            ResourceSettings(cores=1),
            config_settings=ConfigSettings(config=config),
            snakefile=Path("Snakefile"),
        )
        found = workflow_api._workflow.get_rule(rule)
        values = Wildcards(fromdict={key: str(value) for key, value in wildcards.items()})
        inputs, *_ = found.expand_input(values, groupid=None)
        outputs, _ = found.expand_output(values)
        params, _ = found.expand_params(values, inputs, outputs, found)
        log = found.expand_log(values)
        return SimpleNamespace(
            rule=rule, wildcards=values, input=inputs, output=outputs, params=params, log=log
        )
