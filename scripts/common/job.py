"""Start of every script: the job that it runs, and its log."""

import logging
import os
import platform
import sys
from pathlib import Path
from typing import Any


def start(names: dict[str, Any]) -> Any:
    """Return the job's `snakemake` object, open its log and report errors to it.

    `names` are the ``globals()`` of the script, which hold `snakemake` if Snakemake runs it.
    """
    if "snakemake" not in names:
        sys.exit("Snakemake runs this script; force one of its files: snakemake --force <file>")
    job = names["snakemake"]
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
