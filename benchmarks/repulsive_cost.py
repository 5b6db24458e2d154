"""Cost of the repulsive solver against the grid.

Writes a table and a plot of processor time, memory and FFT pairs, beside a bare pair of transforms,
the limit of any such method. Example::

    python benchmarks/repulsive_cost.py --sizes 512 1024 2048 4096 8192 --output docs
"""

import argparse
import csv
import os
import time
import tracemalloc
from pathlib import Path

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"

import matplotlib  # noqa: E402 - the number of threads must be set before numpy is loaded
import numpy as np  # noqa: E402

matplotlib.use("Agg")
from matplotlib import pyplot as plt  # noqa: E402

from stickiness import repulsive, spectrum, surface  # noqa: E402
from stickiness.repulsive import half_space  # noqa: E402

Q0 = 2 * np.pi
LOADS = (0.01, 0.1)
FIELDS = ("n", "load", "area", "seconds", "pairs", "pair_seconds", "gigabytes", "arrays")
_OFTEN = 2048  # sides up to which the least of three times counts
_ONCE = 4096  # sides beyond which operators are made within the only time
COLOURS = {0.01: "#0072b2", 0.1: "#d55e00"}


def options():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=[512, 1024, 2048])
    parser.add_argument("--hurst", type=float, default=0.8)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--output", type=Path, default=Path("docs"), help="folder")
    return parser.parse_args()


def heights_of(n, hurst, seed, pixels=8):
    s = spectrum.SelfAffine(hurst=hurst, q0=Q0, q1=Q0 * n / pixels, h_rms=1.0)
    return surface.synthesise(s, n=n, length=1.0, seed=seed)


def timed(heights, load):
    begin = time.process_time()
    contact = repulsive.solve(heights, 1.0, load * Q0)
    return time.process_time() - begin, contact


def peak(heights, load):
    """Bytes beside the heights with the operators it makes, time and solution of a load."""
    half_space.clear_caches()
    tracemalloc.start()
    seconds, contact = timed(heights, load)
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return most, seconds, contact


def seconds_of_a_pair(n, times):
    """Processor time of a forward and a backward transform in double precision, blocked."""
    operator = half_space.half_space((n, n), (1.0, 1.0))
    field, out = np.ones((n, n)), np.empty((n, n))
    spent = []
    for _ in range(times):
        begin = time.process_time()
        operator.compliance(field, out)
        spent.append(time.process_time() - begin)
    return min(spent)


def growth(chosen):
    """Rows of the table, a solution each."""
    rows = []
    for n in chosen.sizes:
        heights = heights_of(n, chosen.hurst, chosen.seed)
        runs = 3 if n <= _OFTEN else 1
        for load in LOADS:
            most, seconds, contact = peak(heights, load)
            if n <= _ONCE:
                seconds = min(timed(heights, load)[0] for _ in range(runs))
            pair = seconds_of_a_pair(n, 3 * runs)
            figures = contact.area_fraction, seconds, contact.fft_pairs, pair
            figures = [float(f"{x:.4g}") for x in (*figures, most / 1e9, most / heights.nbytes)]
            rows.append(dict(zip(FIELDS, (n, load, *figures), strict=True)))
            print(rows[-1], flush=True)
    return rows


def write(path, rows):
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, FIELDS, lineterminator="\n")
        table.writeheader()
        table.writerows(rows)


def draw(path, rows):
    figure, (times, memory, pairs) = plt.subplots(1, 3, figsize=(9.5, 3.4), layout="constrained")
    panels = ((times, "seconds"), (memory, "gigabytes"), (pairs, "pairs"))
    for load, marker in zip(LOADS, "os", strict=True):
        among = [row for row in rows if row["load"] == load]
        n = [row["n"] for row in among]
        for axes, name in panels:
            label = f"load {load:g} $E^* q_0 h_\\mathrm{{rms}}$"
            values = [row[name] for row in among]
            axes.plot(n, values, marker=marker, color=COLOURS[load], label=label)
    n = sorted({row["n"] for row in rows})
    bare = [min(row["pair_seconds"] for row in rows if row["n"] == m) for m in n]
    times.plot(n, bare, "k^--", label="one bare FFT pair")
    memory.plot(n, [8e-9 * m**2 for m in n], "k--", label="one array of the grid")
    titles = ("processor time [s]", "memory beside the heights [GB]", "FFT pairs")
    for (axes, _), title in zip(panels, titles, strict=True):
        axes.set_xscale("log", base=2)
        axes.set_xticks(n, [str(m) for m in n])
        axes.set_xlabel("points along a side")
        axes.set_title(title, fontsize=10)
        axes.grid(alpha=0.3)
    times.set_yscale("log")
    memory.set_yscale("log")
    pairs.set_ylim(bottom=0)
    times.legend(fontsize=8, loc="lower right")
    memory.legend(fontsize=8)
    figure.savefig(path, dpi=150)


def main():
    chosen = options()
    rows = growth(chosen)
    write(chosen.output / "repulsive_cost.csv", rows)
    draw(chosen.output / "repulsive_cost.png", rows)


if __name__ == "__main__":
    main()
