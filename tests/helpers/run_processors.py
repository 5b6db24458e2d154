"""Run the tests marked `processors` as other processors would, and fail if one of them fails.

Processors differ in the last bits of floating point: they sum in other orders, and some multiply
and add without rounding in between. OpenBLAS, numpy and numba hold code for many processors and can
be told which to take. Other arguments are those of pytest.
"""

import os
import subprocess
import sys
import time

import numpy as np

# What a kernel of OpenBLAS needs, in numpy's words for groups of instructions.
KERNELS = {"Prescott": "X86_V2", "Haswell": "X86_V3", "Zen": "X86_V3", "SkylakeX": "X86_V4"}

# Where marked tests are; to collect all others takes longer than to run these.
PLACES = ("tests/stickiness", "tests/real_surfaces/test_wrong_files.py")


def settings():
    """Name, environment variables and reason to skip, or None, of every setting.

    Libraries do not affect one another's arithmetic, so that one setting has the plainest of all.
    """
    config = np.show_config("dicts")
    extensions = config["SIMD Extensions"]
    runs = [*extensions["baseline"], *extensions["found"]]
    blas = config["Build Dependencies"]["blas"]
    beside = {
        "Prescott": {
            "NUMBA_CPU_NAME": "generic",
            "NPY_DISABLE_CPU_FEATURES": " ".join(extensions["found"]),
        },
        "Zen": {"OMP_NUM_THREADS": "2", "OPENBLAS_NUM_THREADS": "2"},
    }
    for kernel, needs in KERNELS.items():
        variables = beside.get(kernel, {})
        name = " and ".join([f"OpenBLAS for {kernel}", *variables])
        reason = None
        if "openblas" not in blas["name"]:
            reason = f"numpy uses {blas['name']}, not OpenBLAS"
        elif "DYNAMIC_ARCH" not in blas.get("openblas configuration", ""):
            reason = "OpenBLAS is built for one processor"
        elif needs not in runs:
            reason = f"this processor lacks the instructions {needs}"
        if reason is None:
            variables["OPENBLAS_CORETYPE"] = kernel
        elif variables:  # of the other libraries all the same
            name += f", but {reason}"
            reason = None
        yield name, variables, reason


def main(arguments):
    """Run all settings, one after the other, and print a line for each."""
    failed = []
    for name, variables, reason in settings():
        if reason is not None:
            print(f"{name}: skipped, {reason}", flush=True)
            continue
        environment = os.environ | {"OMP_NUM_THREADS": "1"} | variables
        command = [sys.executable, "-m", "pytest", "-m", "processors", *PLACES, *arguments]
        start = time.monotonic()
        done = subprocess.run(command, env=environment, capture_output=True, text=True)
        lines = done.stdout.strip().splitlines()
        print(f"{name}: {lines[-1] if lines else 'no output'}", end=" ")
        print(f"({time.monotonic() - start:.0f} s in all)", flush=True)
        if done.returncode:
            failed.append(name)
            print(done.stdout + done.stderr, flush=True)
    if failed:
        sys.exit("failed: " + ", ".join(failed))


if __name__ == "__main__":
    main(sys.argv[1:])
