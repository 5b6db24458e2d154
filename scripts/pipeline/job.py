"""What every script shares: its log, and a stand-in for Snakemake when it is run by hand."""

from __future__ import annotations

import logging
import sys
from pathlib import Path
from typing import Any


def start(names: dict[str, Any], rule: str, **wildcards: Any) -> Any:
    """Return the job's `snakemake` object, with log and error reporting set up.

    Parameters
    ----------
    names : dict
        ``globals()`` of the script. Run by Snakemake it holds `snakemake`; run by hand
        (``python scripts/NAME.py case=H0.8_zeta64 fidelity=draft``) the job of `rule` with these
        wildcards is looked up in the workflow, so that a script can be debugged alone, from the
        project's top folder.
    rule, **wildcards
        Example job for a run by hand.
    """
    job = names.get("snakemake") or job_of(rule, **wildcards | given())
    Path(job.log[0]).parent.mkdir(parents=True, exist_ok=True)
    logging.basicConfig(
        filename=job.log[0],
        filemode="w",
        level=logging.INFO,
        format="%(asctime)s %(levelname)s %(message)s",
        force=True,
    )
    sys.excepthook = _report
    return job


def _report(kind: type[BaseException], error: BaseException, trace: Any) -> None:
    """One line on the terminal, the trace in the log."""
    # A ValueError says itself what is wrong with the input; anything else needs its trace.
    shown = None if issubclass(kind, ValueError) else (kind, error, trace)
    logging.error("%s: %s", kind.__name__, error, exc_info=shown)
    print(f"{kind.__name__}: {error}", file=sys.stderr)


def given() -> dict[str, str]:
    """What the command line says as KEY=VALUE: wildcards, or the fidelity."""
    return dict(argument.split("=", 1) for argument in sys.argv[1:])


def job_of(rule: str, **wildcards: Any) -> Any:
    """The job of `rule` with these wildcards: `input`, `output`, `params`, `log` as in a run."""
    from types import SimpleNamespace

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
        workflow = workflow_api._workflow
        found = workflow.get_rule(rule)
        values = Wildcards(fromdict={key: str(value) for key, value in wildcards.items()})
        inputs, *_ = found.expand_input(values, groupid=None)
        outputs, _ = found.expand_output(values)
        params, _ = found.expand_params(values, inputs, outputs, found)
        log = found.expand_log(values)
        return SimpleNamespace(
            rule=rule, wildcards=values, input=inputs, output=outputs, params=params, log=log
        )
