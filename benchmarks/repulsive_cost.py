"""Cost of the repulsive solver against the grid.

Writes a table and a plot of processor time, memory and FFT pairs, beside a bare pair of transforms,
the limit of any such method. Example::

    python benchmarks/repulsive_cost.py --sizes 512 1024 2048 4096 8192 --output docs
"""

import argparse
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
LOADS = (0.01, 0.1)
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
    """Return the table, a row for each solution."""
    rows = []
    for n in chosen.sizes:
        heights = heights_of(n, chosen.hurst, chosen.seed)
        runs = 3 if n <= _OFTEN else 1
        for load in LOADS:
            most, seconds, contact = peak(heights, load)
            if n <= _ONCE:
                seconds = min(timed(heights, load)[0] for _ in range(runs))
            row = {"n": n, "load": load, "area": contact.area_fraction, "seconds": seconds}
            row |= {"pairs": contact.fft_pairs, "pair_seconds": seconds_of_a_pair(n, 3 * runs)}
            rows.append(row | {"gigabytes": most / 1e9, "arrays": most / heights.nbytes})
            print(rows[-1], flush=True)
    return pd.DataFrame(rows)


def draw(path, table):
    figure, (times, memory, pairs) = plt.subplots(1, 3, figsize=(9.5, 3.4), layout="constrained")
    panels = ((times, "seconds"), (memory, "gigabytes"), (pairs, "pairs"))
    for (load, rows), marker in zip(table.groupby("load"), "os", strict=True):
        label = f"load {load:g} $E^* q_0 h_\\mathrm{{rms}}$"
        for axes, name in panels:
            axes.plot(rows.n, rows[name], marker=marker, color=COLOURS[load], label=label)
    bare = table.groupby("n").pair_seconds.min()
    times.plot(bare.index, bare, "k^--", label="one bare FFT pair")
    memory.plot(bare.index, 8e-9 * bare.index**2, "k--", label="one array of the grid")
    titles = ("processor time [s]", "memory beside the heights [GB]", "FFT pairs")
    for (axes, _), title in zip(panels, titles, strict=True):
        axes.set_xscale("log", base=2)
        axes.set_xticks(bare.index, bare.index.astype(str))
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
    table = growth(chosen)
    table.to_csv(chosen.output / "repulsive_cost.csv", index=False, float_format="%.4g")
    draw(chosen.output / "repulsive_cost.png", table)


if __name__ == "__main__":
    main()
