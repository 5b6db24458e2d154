"""Cost of the repulsive solver against the grid.

Writes a table and a plot of time, memory and FFT pairs, beside a bare pair of transforms, the limit
of any such method. Processor time is that of all threads; elapsed time means little while other
jobs run. Example::

    python benchmarks/repulsive_cost.py --sizes 512 1024 2048 4096 8192 --output docs
    python benchmarks/repulsive_cost.py --sizes 512 2048 16384 --threads 1 2 --output .
"""

import argparse
import itertools
import os
import time
import tracemalloc
from pathlib import Path

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"

import numpy as np  # noqa: E402 - the number of threads must be set before numpy is loaded
import pandas as pd  # noqa: E402
from matplotlib import pyplot as plt  # noqa: E402

from stickiness import repulsive, spectrum, surface  # noqa: E402
from stickiness.repulsive import half_space  # noqa: E402

Q0 = 2 * np.pi
_OFTEN = 2048  # sides up to which the least of three times counts
_ONCE = 4096  # sides beyond which operators are made within the only time
COLOURS = ("#0072b2", "#d55e00", "#009e73")  # of loads
LINES = ("-", ":", "-.")  # of numbers of threads


def options():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=[512, 1024, 2048])
    parser.add_argument("--loads", type=float, nargs="+", default=[0.01, 0.1])
    parser.add_argument("--threads", type=int, nargs="+", default=[1])
    parser.add_argument("--hurst", type=float, default=0.8)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--output", type=Path, default=Path("docs"), help="folder")
    return parser.parse_args()


def heights_of(n, hurst, seed, pixels=8):
    s = spectrum.SelfAffine(hurst=hurst, q0=Q0, q1=Q0 * n / pixels, h_rms=1.0)
    return surface.synthesise(s, n=n, length=1.0, seed=seed)


def timed(heights, load, threads):
    """Processor time, elapsed time and solution of a load."""
    begin = time.process_time(), time.perf_counter()
    contact = repulsive.solve(heights, 1.0, load * Q0, threads=threads)
    return time.process_time() - begin[0], time.perf_counter() - begin[1], contact


def peak(heights, load, threads):
    """Bytes beside the heights with the operators it makes, times and solution of a load."""
    half_space.clear_caches()
    tracemalloc.start()
    times = timed(heights, load, threads)
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return most, *times


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
    """Return the table, a row for each solution."""
    rows = []
    timed(heights_of(64, chosen.hurst, chosen.seed), 0.1, 1)  # compiles loops
    for n in chosen.sizes:
        heights = heights_of(n, chosen.hurst, chosen.seed)
        runs = 3 if n <= _OFTEN else 1
        for load in chosen.loads:
            found = {threads: peak(heights, load, threads) for threads in chosen.threads}
            times = {threads: [one[1:3]] for threads, one in found.items()}
            if n <= _ONCE:  # in turn, for a fair comparison
                times = {threads: [] for threads in chosen.threads}
                for _, threads in itertools.product(range(runs), chosen.threads):
                    times[threads].append(timed(heights, load, threads)[:2])
            pair = seconds_of_a_pair(n, 3 * runs)
            for threads, (most, *_, contact) in found.items():
                seconds, elapsed = np.min(times[threads], axis=0)
                row = {"n": n, "load": load, "threads": threads, "area": contact.area_fraction}
                row |= {"seconds": seconds, "elapsed": elapsed, "pairs": contact.fft_pairs}
                row |= {"pair_seconds": pair, "over_pair": seconds / pair}
                rows.append(row | {"gigabytes": most / 1e9, "arrays": most / heights.nbytes})
                print(rows[-1], flush=True)
    return pd.DataFrame(rows)


def draw(path, table):
    figure, (times, memory, pairs) = plt.subplots(1, 3, figsize=(9.5, 3.6), layout="constrained")
    panels = ((times, "elapsed"), (memory, "gigabytes"), (pairs, "pairs"))
    loads, counts = sorted(set(table.load)), sorted(set(table.threads))
    for (load, threads), rows in table.groupby(["load", "threads"]):
        label = f"load {load:g} $E^* q_0 h_\\mathrm{{rms}}$"
        label += f", {threads} threads" if threads > 1 else ""
        style = {"color": COLOURS[loads.index(load)], "linestyle": LINES[counts.index(threads)]}
        for axes, name in panels:
            axes.plot(rows.n, rows[name], marker="o", label=label, **style)
    bare = table.groupby("n").pair_seconds.min()
    times.plot(bare.index, bare, "k^--")
    memory.plot(bare.index, 8e-9 * bare.index**2, "k--")
    titles = ("elapsed time [s]", "memory beside the heights [GB]", "FFT pairs")
    for (axes, _), title in zip(panels, titles, strict=True):
        axes.set_xscale("log", base=2)
        axes.set_xticks(bare.index, bare.index.astype(str))
        axes.set_xlabel("points along a side")
        axes.set_title(title, fontsize=10)
        axes.grid(alpha=0.3)
    times.set_yscale("log")
    memory.set_yscale("log")
    pairs.set_ylim(bottom=0)
    times.text(
        bare.index[-1], 0.25 * bare.iloc[-1], "bare FFT pair", ha="right", va="top", fontsize=8
    )
    memory.text(
        bare.index[-1],
        1.3e-9 * bare.index[-1] ** 2,
        "array of the grid",
        ha="right",
        va="top",
        fontsize=8,
    )
    figure.legend(
        *pairs.get_legend_handles_labels(), loc="outside lower center", ncols=4, fontsize=8
    )
    figure.savefig(path, dpi=150)


def main():
    chosen = options()
    table = growth(chosen)
    table.to_csv(chosen.output / "repulsive_cost.csv", index=False, float_format="%.4g")
    draw(chosen.output / "repulsive_cost.png", table)


if __name__ == "__main__":
    main()
