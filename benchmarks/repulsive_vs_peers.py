"""Compare the repulsive solver with ASPHER, Tamaas and ContactMechanics, one thread each.

Every code runs in a process of its own, one at a time, and gets the same heights and loads. The
error it really reached is measured with the same independent function (`complementarity`); where
that is above the tolerance the code is run again with a tighter one. Codes that are not installed
are left out. Example::

    python benchmarks/repulsive_vs_peers.py --sizes 512 1024 2048 --seeds 1 2 --output peers.csv

Times are processor seconds on one thread, the least of a few runs where those are short. Compare
ratios within a run rather than seconds.
"""

import argparse
import csv
import itertools
import multiprocessing
import os
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"

import contact_codes  # noqa: E402 - the number of threads must be set before numpy is loaded
import numpy as np  # noqa: E402

from stickiness import spectrum, surface  # noqa: E402
from stickiness.repulsive import half_space  # noqa: E402

OURS = "stickiness"
_TIGHTER = 4  # runs at tighter and tighter tolerances until the error is met
FIELDS = {
    "n": "5d",
    "hurst": "5.1f",
    "load": "7.4f",
    "seed": "4d",
    "code": "16s",
    "seconds": "9.3f",
    "pairs": "8.1f",
    "iterations": "10d",
    "error": "8.1e",
    "area": "8.5f",
    "area_off": "9.1e",
    "gap_off": "8.1e",
    "ratio": "7.1f",
    "over_pairs": "10.2f",
}


def options():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=[512, 1024])
    parser.add_argument("--loads", type=float, nargs="+", default=[0.0005, 0.003, 0.01, 0.065, 0.3])
    parser.add_argument("--hurst", type=float, nargs="+", default=[0.8])
    parser.add_argument("--seeds", type=int, nargs="+", default=[1])
    parser.add_argument(
        "--codes", nargs="+", choices=sorted(contact_codes.CODES), default=list(contact_codes.CODES)
    )
    parser.add_argument(
        "--tol", type=float, default=1e-8, help="mean gap under the pressure, over h_rms"
    )
    parser.add_argument("--pixels", type=int, default=8, help="per shortest wavelength")
    parser.add_argument("--output", type=Path, help="CSV file to write as well")
    return parser.parse_args()


def heights_of(n, hurst, seed, pixels):
    q0 = 2 * np.pi
    s = spectrum.SelfAffine(hurst=hurst, q0=q0, q1=q0 * n / pixels, h_rms=1.0)
    return surface.synthesise(s, n=n, length=1.0, seed=seed)


def start(names):
    """One process for each code that is installed."""
    workers = {}
    for name in names:
        context = multiprocessing.get_context("spawn")
        worker = ProcessPoolExecutor(max_workers=1, mp_context=context)
        try:
            worker.submit(warm_up, name, 64).result()
        except ImportError as error:
            print(f"{name}: left out, not installed ({error}); see envs/peers.txt, envs/aspher.txt")
            worker.shutdown()
            continue
        workers[name] = worker
    return workers


def warm_up(name, n):
    """Load a code and, if it is ours, plan the transforms of a grid: set-up is timed for none."""
    contact_codes.CODES[name](heights_of(n, 0.8, 0, min(8, n // 8)), 1.0, 0.5, 1e-2)


def measure(name, case, pixels, tol, most=5, budget=3.0):
    """Row of a code for a case, its fastest run among as many as fit into some seconds."""
    n, hurst, load, seed = case
    if name == OURS:
        warm_up(name, n)
    heights = heights_of(n, hurst, seed, pixels)
    code, asked = contact_codes.CODES[name], tol
    for _ in range(_TIGHTER):
        run = code(heights, 1.0, load * 2 * np.pi, asked)
        error, mean_gap = contact_codes.complementarity(run.pressure, heights, 1.0)
        if error <= tol:
            break
        asked *= 0.7 * tol / error
    runs = [run.seconds]
    while len(runs) < most and sum(runs) + runs[0] < budget:
        runs.append(code(heights, 1.0, load * 2 * np.pi, asked).seconds)
    return {
        "n": n,
        "hurst": hurst,
        "load": load,
        "seed": seed,
        "code": name,
        "seconds": min(runs),
        "pairs": run.fft_pairs,
        "iterations": run.iterations,
        "error": error,
        "area": float(np.mean(run.pressure > 0)),
        "gap": mean_gap,
        "over_pairs": min(runs) / (run.fft_pairs * seconds_of_a_pair(n)) if name == OURS else None,
    }


def seconds_of_a_pair(n):
    """A forward and a backward transform in single precision, on their own."""
    operator = half_space.half_space((n, n), (1.0, 1.0), np.float32)
    field, out = np.ones((n, n), np.float32), np.empty((n, n), np.float32)
    times = []
    for _ in range(9):
        begin = time.process_time()
        operator.compliance(field, out)
        times.append(time.process_time() - begin)
    return min(times)


def compare(workers, chosen, case):
    """One dictionary per code for a case."""
    first = None
    for name, worker in workers.items():
        row = worker.submit(measure, name, case, chosen.pixels, chosen.tol).result()
        first = first or row
        row["area_off"] = abs(row["area"] / first["area"] - 1)
        row["gap_off"] = abs(row["gap"] / first["gap"] - 1)
        row["ratio"] = row["seconds"] / first["seconds"]
        yield row


def line(row):
    """Row of the table, empty where a code does not tell."""
    cells = []
    for name, form in FIELDS.items():
        width = int(form.split(".")[0].rstrip("ds"))
        cells.append(" " * width if row.get(name) is None else format(row[name], form))
    return " ".join(cells)


def geometric_mean(values):
    return float(np.exp(np.mean(np.log(values))))


def summary(rows):
    """Geometric mean and smallest ratio of every peer, over all and by size."""
    sizes = sorted({row["n"] for row in rows})
    for name in dict.fromkeys(row["code"] for row in rows):
        if name == OURS:
            continue
        for label, among in [("all", sizes), *((f"n = {n}", [n]) for n in sizes)]:
            ratios = [r["ratio"] for r in rows if r["code"] == name and r["n"] in among]
            print(
                f"{name}, {label}: {geometric_mean(ratios):.1f} times the time "
                f"({min(ratios):.1f} to {max(ratios):.1f}, {len(ratios)} cases)"
            )
    ours = [row for row in rows if row["code"] == OURS]
    for n in sizes:
        pairs = [row["pairs"] for row in ours if row["n"] == n]
        print(f"{OURS}, n = {n}: {geometric_mean(pairs):.1f} FFT pairs")
    for name in ("area_off", "gap_off", "error"):
        print(f"largest {name}: {max(row[name] for row in rows):.1e}")


def main():
    chosen = options()
    workers = start([OURS, *(name for name in chosen.codes if name != OURS)])
    print(" ".join(FIELDS))
    rows = []
    for case in itertools.product(chosen.sizes, chosen.hurst, chosen.loads, chosen.seeds):
        for row in compare(workers, chosen, case):
            rows.append(row)
            print(line(row), flush=True)
        if chosen.output:
            write(chosen.output, rows)
    for worker in workers.values():
        worker.shutdown()
    summary(rows)


def write(path, rows):
    with path.open("w", newline="") as file:
        table = csv.DictWriter(file, FIELDS, restval="", extrasaction="ignore")
        table.writeheader()
        for row in rows:
            table.writerow({k: f"{v:.6g}" if isinstance(v, float) else v for k, v in row.items()})


if __name__ == "__main__":
    main()
