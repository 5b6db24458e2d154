"""Commands of a program, each in a fork of this process, which has imported its libraries once.

``serve.py snakemake`` runs Snakemake, and the scripts of its jobs in further forks. Copies of the
project that have scripts of their own import these anew. ``serve.py stickiness`` runs the command
of the library, which simulates contact on a coarse grid there.

A line of input asks for a command, as JSON: its folder, arguments, environment and the files for
what it prints. Each line is answered with the exit code, once the command has ended.
"""

import contextlib
import importlib
import json
import os
import runpy
import select
import signal
import socket
import sys
import tempfile
from pathlib import Path

LONGEST = 1800  # seconds
SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
PROJECT = {path.stem for path in SCRIPTS.iterdir()}  # its packages
# What the rules and several of their scripts import.
USED = ("common.config.load", "common.paper", "stickiness.pages.surface_page")
USED += ("stickiness.verdicts.verdict", "matplotlib.backends.backend_pdf", "netCDF4", "pint")
USED += ("PIL.PngImagePlugin", "openpyxl", "scipy.optimize", "scipy.stats")


def prepare_snakemake(address):
    """Import what Snakemake, the rules and the scripts of the project need."""
    from snakemake.cli import get_argument_parser
    from snakemake.jobs import Job
    from snakemake.script import PythonScript

    get_argument_parser()  # imports the plugins
    Job.message = None  # in its place, a dry-run lists the files of a job, which tests read
    ask = [sys.executable, "-IS", str(Path(__file__).with_name("ask.py")), address]

    def execute_script(job, fname, edit=False):
        job._execute_cmd("{ask:q} {fname:q}", ask=ask, fname=fname)

    PythonScript.execute_script = execute_script

    sys.path.insert(0, str(SCRIPTS))
    for module in USED:
        importlib.import_module(module)
    sys.path.remove(str(SCRIPTS))


def prepare_stickiness(_):
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
    with tempfile.TemporaryDirectory() as place, socket.socket(socket.AF_UNIX) as scripts:
        scripts.bind(f"{place}/scripts")
        scripts.listen()
        PREPARE[program](f"{place}/scripts")
        for line in sys.stdin:
            print(attend(program, json.loads(line), scripts), flush=True)


def attend(program, order, scripts):
    """Exit code of a command, and meanwhile a fork for every script that it asks for."""
    ended, running = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(ended)
        run(program, **order)
    os.close(running)
    while ended not in select.select([ended, scripts], [], [])[0]:
        asking, _ = scripts.accept()
        if os.fork() == 0:
            run_script(asking)
        asking.close()
    os.close(ended)
    code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    with contextlib.suppress(ChildProcessError):
        while True:
            os.wait()  # for scripts
    return code


def run(program, folder, arguments, environment, output, errors):
    """``python -m PROGRAM`` with these arguments in this folder."""
    printed = os.O_WRONLY | os.O_CREAT | os.O_TRUNC
    files = [os.open(os.devnull, os.O_RDONLY), os.open(output, printed)]
    files.append(files[1] if errors == output else os.open(errors, printed))
    scripts = f"{folder}/scripts" if program == "snakemake" else SCRIPTS
    settle(folder, environment, files, scripts)
    sys.path[0] = folder
    sys.argv = [program, *arguments]
    code = execute(lambda: runpy.run_module(program, run_name="__main__", alter_sys=True))
    os._exit(code)  # to take down all that is imported takes longer than most commands


def run_script(asking):
    """``python SCRIPT``, as `ask.py` asks for it."""
    files = socket.recv_fds(asking, 1, 3)[1]
    with asking.makefile() as sent:
        order = json.load(sent)
    script = order["script"]
    paths = order["environment"]["PYTHONPATH"].split(os.pathsep)  # the scripts of the run first
    settle(order["folder"], order["environment"], files, scripts=paths[0])
    sys.path[:1] = [os.path.dirname(script), *paths]
    sys.argv = [script]
    code = execute(lambda: runpy.run_path(script, run_name="__main__"))
    asking.sendall(str(code).encode())
    os._exit(code)


def settle(folder, environment, files, scripts):
    """Take a folder, an environment, files for the streams, and the modules of some scripts."""
    signal.alarm(LONGEST)
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(environment)
    for stream, file in enumerate(files):
        os.dup2(file, stream)
    if os.path.realpath(scripts) != str(SCRIPTS):
        for name in list(sys.modules):
            if name.partition(".")[0] in PROJECT:
                del sys.modules[name]


def execute(start):
    """Exit code of what is started, as Python ends with it."""
    code = 0
    try:
        start()
    except SystemExit as ended:
        code = ended.code if isinstance(ended.code, int) else int(ended.code is not None)
        if isinstance(ended.code, str):
            print(ended.code, file=sys.stderr)
    except BaseException:
        sys.excepthook(*sys.exc_info())
        code = 1
    sys.stdout.flush()
    sys.stderr.flush()
    return code


if __name__ == "__main__":
    serve(sys.argv[1])
