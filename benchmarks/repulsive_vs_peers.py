"""Compare the repulsive solver with Tamaas and ContactMechanics: one run, one thread each.

All codes get the same heights, loads and residual; the residual each really reached is measured
with the same independent function, and so is how far areas and mean gaps lie apart. Example::

    python benchmarks/repulsive_vs_peers.py --sizes 512 1024 2048 --seeds 1 2 --output peers.csv

Times are processor seconds on one thread, the median of a few runs where those are short. Compare
ratios within a run rather than seconds.
"""

import argparse
import csv
import itertools
import os
import time
from pathlib import Path

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"

import contact_codes  # noqa: E402 - the number of threads must be set before numpy is loaded
import numpy as np  # noqa: E402

from stickiness import spectrum, surface  # noqa: E402
from stickiness.contact import half_space  # noqa: E402

OURS = "stickiness"
CODES = {
    OURS: contact_codes.stickiness,
    "tamaas": contact_codes.tamaas,
    "contactmechanics": contact_codes.contact_mechanics,
}
FIELDS = {
    "n": "5d",
    "hurst": "5.1f",
    "load": "6.3f",
    "seed": "4d",
    "code": "16s",
    "seconds": "9.3f",
    "pairs": "8.1f",
    "iterations": "10d",
    "residual": "8.1e",
    "area": "8.5f",
    "area_off": "9.1e",
    "gap_off": "8.1e",
    "ratio": "7.1f",
    "over_pairs": "10.2f",
}


def options():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=[512, 1024])
    parser.add_argument("--loads", type=float, nargs="+", default=[0.01, 0.065, 0.3])
    parser.add_argument("--hurst", type=float, nargs="+", default=[0.8, 0.5])
    parser.add_argument("--seeds", type=int, nargs="+", default=[1])
    parser.add_argument("--codes", nargs="+", choices=sorted(CODES), default=list(CODES))
    parser.add_argument("--tol", type=float, default=1e-8, help="residual over h_rms")
    parser.add_argument("--pixels", type=int, default=8, help="per shortest wavelength")
    parser.add_argument("--output", type=Path, help="CSV file to write as well")
    return parser.parse_args()


def heights_of(n, hurst, seed, pixels):
    q0 = 2 * np.pi
    s = spectrum.SelfAffine(hurst=hurst, q0=q0, q1=q0 * n / pixels, h_rms=1.0)
    return surface.synthesise(s, n=n, length=1.0, seed=seed)


def warm_up(n):
    """Load libraries and plan the transforms of a grid: set-up is timed for no code."""
    contact_codes.stickiness(heights_of(n, 0.8, 0, 8), 1.0, 0.5, 1e-2)
    heights = heights_of(64, 0.8, 0, 8)
    for code in CODES.values():
        try:
            code(heights, 1.0, 0.5, 1e-6)
        except ImportError:
            continue


def timed(code, *arguments, budget=3.0):
    """Run of median time among as many as fit into some seconds, five at most."""
    runs = [code(*arguments)]
    while len(runs) < 5 and sum(run.seconds for run in runs) + runs[0].seconds < budget:
        runs.append(code(*arguments))
    return sorted(runs, key=lambda run: run.seconds)[len(runs) // 2]


def seconds_of_a_pair(n):
    """A forward and a backward transform in double precision, on their own."""
    operator = half_space.half_space((n, n), (1.0, 1.0))
    field, out = np.ones((n, n)), np.empty((n, n))
    times = []
    for _ in range(9):
        begin = time.process_time()
        operator.compliance(field, out)
        times.append(time.process_time() - begin)
    return float(np.median(times))


def compare(chosen, n, hurst, load, seed):
    """One dictionary per code for a case."""
    heights = heights_of(n, hurst, seed, chosen.pixels)
    first = None
    for name in chosen.codes:
        try:
            run = timed(CODES[name], heights, 1.0, load * 2 * np.pi, chosen.tol)
        except ImportError as error:
            print(f"{n:5d} {name}: not installed ({error}); see envs/peers.txt")
            continue
        residual, mean_gap = contact_codes.complementarity(run.pressure, heights, 1.0)
        row = {
            "n": n,
            "hurst": hurst,
            "load": load,
            "seed": seed,
            "code": name,
            "seconds": run.seconds,
            "pairs": run.fft_pairs,
            "iterations": run.iterations,
            "residual": residual,
            "area": float(np.mean(run.pressure > 0)),
        }
        first = first or row | {"gap": mean_gap}
        row["area_off"] = abs(row["area"] / first["area"] - 1)
        row["gap_off"] = abs(mean_gap / first["gap"] - 1)
        row["ratio"] = run.seconds / first["seconds"]
        if name == OURS:
            row["over_pairs"] = run.seconds / (run.fft_pairs * seconds_of_a_pair(n))
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
    for name in ("area_off", "gap_off", "residual"):
        print(f"largest {name}: {max(row[name] for row in rows):.1e}")


def main():
    chosen = options()
    for n in chosen.sizes:
        warm_up(n)
    print(" ".join(FIELDS))
    rows = []
    cases = itertools.product(chosen.sizes, chosen.hurst, chosen.loads, chosen.seeds)
    for case in cases:
        for row in compare(chosen, *case):
            rows.append(row)
            print(line(row), flush=True)
        if chosen.output:
            write(chosen.output, rows)
    summary(rows)


def write(path, rows):
    with path.open("w", newline="") as file:
        table = csv.DictWriter(file, FIELDS, restval="")
        table.writeheader()
        for row in rows:
            table.writerow({k: f"{v:.6g}" if isinstance(v, float) else v for k, v in row.items()})


if __name__ == "__main__":
    main()
