"""Compare the repulsive solver with ASPHER, Tamaas and ContactMechanics, one thread each.

Every code runs in a process of its own, one at a time, and gets the same heights and loads. The
error it really reached is measured with the same independent function (`complementarity`); where
that is above the tolerance the code runs again with a tighter one. Codes that are not installed
are left out. Example::

    python benchmarks/repulsive_vs_peers.py --sizes 512 1024 2048 --seeds 1 2 --output peers.csv

With ``--free`` the surfaces have free edges, loads are small, and the other code is ASPHER's active
sets, whose clusters limit its error to some 1e-6::

    python benchmarks/repulsive_vs_peers.py --free --tol 1e-5 --sizes 1024 2048 4096

Times are processor seconds on one thread, the least of a few runs where those are short. Compare
ratios within a run rather than seconds.
"""

import argparse
import itertools
import multiprocessing
import os
from concurrent.futures import ProcessPoolExecutor

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"

import contact_codes  # noqa: E402 - the number of threads must be set before numpy is loaded
import numpy as np  # noqa: E402
import pandas as pd  # noqa: E402

from stickiness import spectrum, surface  # noqa: E402

OURS = "stickiness"  # in the name of every driver of this project
LOADS = [0.0005, 0.003, 0.01, 0.065, 0.3]
SMALL_LOADS = [0.001, 0.004, 0.015]  # areas of 0.03 to 0.9 %
Q0 = 2 * np.pi
TIGHTER = 4  # runs at tighter and tighter tolerances until the error is met


def options():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=[512, 1024])
    parser.add_argument("--free", action="store_true", help="free edges, at small loads")
    parser.add_argument("--loads", type=float, nargs="+")
    parser.add_argument("--hurst", type=float, nargs="+", default=[0.8])
    parser.add_argument("--seeds", type=int, nargs="+", default=[1])
    parser.add_argument("--codes", nargs="+")
    parser.add_argument("--tol", type=float, default=1e-8, help="mean gap of contact over h_rms")
    parser.add_argument("--pixels", type=int, default=8, help="per shortest wavelength")
    parser.add_argument("--output", help="CSV file to write as well")
    chosen = parser.parse_args()
    chosen.loads = chosen.loads or (SMALL_LOADS if chosen.free else LOADS)
    chosen.codes = chosen.codes or (
        contact_codes.FREE_EDGES if chosen.free else contact_codes.CODES
    )
    return chosen


def heights_of(n, hurst, seed, pixels):
    s = spectrum.SelfAffine(hurst=hurst, q0=Q0, q1=Q0 * n / pixels, h_rms=1.0)
    return surface.synthesise(s, n=n, length=1.0, seed=seed)


def driver(name):
    """Function that runs a code."""
    return {**contact_codes.CODES, **contact_codes.FREE_EDGES}[name]


def warm_up(name, n):
    """Load a code and, if it is ours, prepare for a grid: plans and compilation are not timed."""
    heights = heights_of(n, 0.8, 0, min(8, n // 8))
    for pressure in (0.5, 0.005):  # dense and dilute contact
        driver(name)(heights, 1.0, pressure, 1e-2)


def start(names):
    """One process for each code that is installed."""
    workers = {}
    for name in names:
        context = multiprocessing.get_context("spawn")
        worker = ProcessPoolExecutor(max_workers=1, mp_context=context)
        try:
            worker.submit(warm_up, name, 128).result()
        except ImportError as error:
            print(f"{name}: left out, not installed ({error}); see envs/peers.txt, envs/aspher.txt")
            worker.shutdown()
            continue
        workers[name] = worker
    return workers


def measure(name, case, pixels, tol, most=5, budget=3.0):
    """Row of a code for a case, its fastest run among as many as fit into some seconds."""
    n, hurst, load, seed = case
    if name == OURS:
        warm_up(name, n)
    heights = heights_of(n, hurst, seed, pixels)
    code, asked = driver(name), tol
    periodic = name in contact_codes.CODES
    for _ in range(TIGHTER):
        run = code(heights, 1.0, load * Q0, asked)
        error, mean_gap = contact_codes.complementarity(run.pressure, heights, 1.0, periodic)
        if error <= tol:
            break
        asked *= 0.7 * tol / error
    seconds = [run.seconds]
    while len(seconds) < most and sum(seconds) + seconds[0] < budget:
        seconds.append(code(heights, 1.0, load * Q0, asked).seconds)
    return {
        **dict(zip(("n", "hurst", "load", "seed"), case, strict=True)),
        "code": name,
        "seconds": min(seconds),
        "pairs": run.fft_pairs,
        "iterations": run.iterations,
        "error": error,
        "area": float(np.mean(run.pressure > 0)),
        "gap": mean_gap,
    }


def main():
    chosen = options()
    workers = start(sorted(chosen.codes, key=lambda name: OURS not in name))  # ours comes first
    tables = []
    for case in itertools.product(chosen.sizes, chosen.hurst, chosen.loads, chosen.seeds):
        jobs = (
            worker.submit(measure, name, case, chosen.pixels, chosen.tol).result()
            for name, worker in workers.items()
        )
        table = pd.DataFrame(jobs)
        for name in ("area", "gap"):
            table[f"{name}_off"] = abs(table[name] / table[name][0] - 1)
        table["ratio"] = table.seconds / table.seconds[0]
        tables.append(table)
        shown = table.drop(columns="gap")
        print(shown.to_string(index=False, float_format="{:.4g}".format), flush=True)
    found = pd.concat(tables)
    if chosen.output:
        found.to_csv(chosen.output, index=False, float_format="%.6g")
    for worker in workers.values():
        worker.shutdown()
    print("\ntimes the processor time of this solver, in the geometric mean, and at the extremes")
    ratios = found.groupby(["code", "n"]).ratio
    mean = ratios.apply(lambda values: np.exp(np.log(values).mean()))
    print(pd.DataFrame({"mean": mean, "min": ratios.min(), "max": ratios.max()}).round(1))
    print(f"largest differences and error:\n{found[['area_off', 'gap_off', 'error']].max()}")


if __name__ == "__main__":
    main()
