"""Commands of Snakemake, each in a fork of this process, which has imported its libraries once.

A line of input asks for one, as JSON: its folder, arguments, environment and the file for what it
prints. Of the project nothing is imported here, as the copies of it that are asked for differ.
"""

import json
import os
import runpy
import signal
import sys

import pint  # noqa: F401
import pydantic  # noqa: F401
import scipy.optimize  # noqa: F401
from snakemake.cli import get_argument_parser
from snakemake.jobs import Job

LONGEST = 600  # seconds


def serve():
    """Answer every line with the exit code of its command, once it has ended."""
    get_argument_parser()  # imports the plugins
    Job.message = None  # in its place, a dry-run lists the files of a job, which tests read
    for line in sys.stdin:
        child = os.fork()
        if child == 0:
            run(**json.loads(line))
            return
        print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), flush=True)


def run(folder, arguments, environment, output):
    """``python -m snakemake`` with these arguments in this folder."""
    signal.alarm(LONGEST)
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(environment)
    nothing = os.open(os.devnull, os.O_RDONLY)
    file = os.open(output, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
    for end, stream in ((nothing, 0), (file, 1), (file, 2)):
        os.dup2(end, stream)
    sys.path[0] = folder
    sys.argv = ["snakemake", *arguments]
    runpy.run_module("snakemake", run_name="__main__", alter_sys=True)


if __name__ == "__main__":
    serve()
