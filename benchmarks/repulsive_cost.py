"""Cost of the repulsive solver beside itself: growth with the grid, load curves, memory.

Example::

    python benchmarks/repulsive_cost.py --sizes 256 512 1024
"""

import argparse
import os
import time
import tracemalloc

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"

import numpy as np  # noqa: E402 - the number of threads must be set before numpy is loaded

from stickiness import repulsive, spectrum, surface  # noqa: E402
from stickiness.contact import half_space  # noqa: E402

Q0 = 2 * np.pi
LOADS = (0.003, 0.01, 0.065, 0.3, 1.0, 3.0)


def options():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=[256, 512, 1024])
    parser.add_argument("--hurst", type=float, default=0.8)
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2])
    return parser.parse_args()


def heights_of(n, hurst, seed, pixels=8):
    s = spectrum.SelfAffine(hurst=hurst, q0=Q0, q1=Q0 * n / pixels, h_rms=1.0)
    return surface.synthesise(s, n=n, length=1.0, seed=seed)


def timed(heights, load):
    begin = time.process_time()
    contact = repulsive.solve(heights, 1.0, load * Q0)
    return time.process_time() - begin, contact


def growth(chosen):
    """FFT pairs at fixed pixels per wavelength, averaged over seeds and three loads."""
    last = None
    for n in chosen.sizes:
        pairs = [
            timed(heights_of(n, chosen.hurst, seed), load)[1].fft_pairs
            for seed in chosen.seeds
            for load in (0.01, 0.065, 0.3)
        ]
        mean = float(np.mean(pairs))
        factor = "" if last is None else f", {mean / last:.2f} times those of the grid before"
        print(f"n = {n}: {mean:.1f} FFT pairs ({min(pairs):.1f} to {max(pairs):.1f}){factor}")
        last = mean


def curve(chosen):
    """Twelve loads from 0.003 to 0.3 on the largest grid, in units of single solutions."""
    n = chosen.sizes[-1]
    heights = heights_of(n, chosen.hurst, chosen.seeds[0])
    timed(heights, 0.065)  # plans
    begin = time.process_time()
    pairs = sum(
        contact.fft_pairs
        for contact in repulsive.load_path(heights, 1.0, Q0 * np.geomspace(0.003, 0.3, 12))
    )
    seconds = time.process_time() - begin
    for load in (0.003, 0.065, 0.3):
        alone, contact = timed(heights, load)
        print(
            f"n = {n}: 12 loads cost {seconds / alone:.1f} solutions at load {load:g} "
            f"({pairs / contact.fft_pairs:.1f} by FFT pairs)"
        )


def memory(chosen):
    """Largest memory of a solution, the operators it makes included, in arrays of the grid."""
    n = chosen.sizes[-1]
    heights = heights_of(n, chosen.hurst, chosen.seeds[0])
    for load in LOADS:
        half_space.clear_caches()
        tracemalloc.start()
        contact = repulsive.solve(heights, 1.0, load * Q0)
        peak = tracemalloc.get_traced_memory()[1] / heights.nbytes
        tracemalloc.stop()
        print(
            f"n = {n}, load {load:g}, area {contact.area_fraction:.3f}: {peak:.1f} arrays "
            "beside the heights"
        )


def main():
    chosen = options()
    growth(chosen)
    curve(chosen)
    memory(chosen)


if __name__ == "__main__":
    main()
