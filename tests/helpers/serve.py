"""Commands of a program, each in a fork of this process, which has imported its libraries once.

``serve.py snakemake`` runs Snakemake. Of the project it imports nothing, as the copies of it that
are asked for differ. ``serve.py stickiness`` runs the command of the library, which simulates
contact on a coarse grid there.

A line of input asks for a command, as JSON: its folder, arguments, environment and the files for
what it prints. Each line is answered with the exit code, once the command has ended.
"""

import json
import os
import runpy
import signal
import sys
import traceback

LONGEST = 600  # seconds


def prepare_snakemake():
    """Import what Snakemake and the rules of the project need."""
    import pint  # noqa: F401
    import pydantic  # noqa: F401
    import scipy.optimize  # noqa: F401
    from snakemake.cli import get_argument_parser
    from snakemake.jobs import Job

    get_argument_parser()  # imports the plugins
    Job.message = None  # in its place, a dry-run lists the files of a job, which tests read


def prepare_stickiness():
    """Import what a verdict and its page need."""
    import warnings
    from functools import partial

    import numpy as np

    import stickiness
    import stickiness.pages.surface_page  # noqa: F401
    from stickiness.verdicts import simulated_surface

    simulated_surface.standardise = partial(simulated_surface.standardise, most_points=32)
    # A verdict loads the loops that are compiled.
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        waves = stickiness.spectrum.SelfAffine(hurst=0.8, q0=2 * np.pi, q1=16 * np.pi, h_rms=0.01)
        heights = 1e-6 * stickiness.surface.synthesise(waves, 64, 1.0, seed=1)
        wall = stickiness.Surface.from_heights(heights, length=1e-6)
        stickiness.verdict(wall, youngs_modulus=1e6, work_of_adhesion=0.05, range=3e-10)


PREPARE = {"snakemake": prepare_snakemake, "stickiness": prepare_stickiness}


def serve(program):
    """Answer every line."""
    PREPARE[program]()
    for line in sys.stdin:
        child = os.fork()
        if child == 0:
            run(program, **json.loads(line))
        print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), flush=True)


def run(program, folder, arguments, environment, output, errors):
    """``python -m PROGRAM`` with these arguments in this folder."""
    signal.alarm(LONGEST)
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(environment)
    printed = os.O_WRONLY | os.O_CREAT | os.O_TRUNC
    files = [os.open(os.devnull, os.O_RDONLY), os.open(output, printed)]
    files.append(files[1] if errors == output else os.open(errors, printed))
    for stream, file in enumerate(files):
        os.dup2(file, stream)
    sys.path[0] = folder
    sys.argv = [program, *arguments]
    code = 0
    try:
        runpy.run_module(program, run_name="__main__", alter_sys=True)
    except SystemExit as ended:
        code = ended.code if isinstance(ended.code, int) else int(ended.code is not None)
        if isinstance(ended.code, str):
            print(ended.code, file=sys.stderr)
    except BaseException:
        traceback.print_exc()
        code = 1
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)  # to take down all that is imported takes longer than most commands


if __name__ == "__main__":
    serve(sys.argv[1])
