"""Compare the repulsive solver with Tamaas and ContactMechanics: one run, one thread each.

All codes get the same heights, loads and residual; the residual each really reached is measured
with the same independent function. Example::

    python benchmarks/repulsive_vs_peers.py --sizes 512 1024 2048 --loads 0.01 0.065 0.3

Times are processor seconds on one thread; compare ratios within a run rather than seconds.
"""

import argparse
import itertools
import os

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"

import contact_codes  # noqa: E402 - the number of threads must be set before numpy is loaded
import numpy as np  # noqa: E402

from stickiness import spectrum, surface  # noqa: E402

CODES = {
    "stickiness": contact_codes.stickiness,
    "tamaas": contact_codes.tamaas,
    "contactmechanics": contact_codes.contact_mechanics,
}
HEADER = (
    "  n    H    load   seed code              seconds  FFT pairs  iter  residual   area   ratio"
)


def options():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=[512, 1024])
    parser.add_argument("--loads", type=float, nargs="+", default=[0.01, 0.065, 0.3])
    parser.add_argument("--hurst", type=float, nargs="+", default=[0.8, 0.5])
    parser.add_argument("--seeds", type=int, nargs="+", default=[1])
    parser.add_argument("--codes", nargs="+", choices=sorted(CODES), default=list(CODES))
    parser.add_argument("--tol", type=float, default=1e-8, help="residual over h_rms")
    parser.add_argument("--pixels", type=int, default=8, help="per shortest wavelength")
    return parser.parse_args()


def heights_of(n, hurst, seed, pixels):
    q0 = 2 * np.pi
    s = spectrum.SelfAffine(hurst=hurst, q0=q0, q1=q0 * n / pixels, h_rms=1.0)
    heights = surface.synthesise(s, n=n, length=1.0, seed=seed)
    heights = np.asarray(getattr(heights, "heights", heights), dtype=float)
    return heights / heights.std()


def warm_up(n):
    """Load libraries and plan the transforms of a grid: set-up is timed for no code."""
    contact_codes.stickiness(heights_of(n, 0.8, 0, 8), 1.0, 0.5, 1e-2)
    heights = heights_of(64, 0.8, 0, 8)
    for code in CODES.values():
        try:
            code(heights, 1.0, 0.5, 1e-6)
        except ImportError:
            continue


def main():
    chosen = options()
    ratios = {name: [] for name in chosen.codes}
    for n in chosen.sizes:
        warm_up(n)
    print(HEADER)
    cases = itertools.product(chosen.sizes, chosen.hurst, chosen.loads, chosen.seeds)
    for n, hurst, load, seed in cases:
        heights = heights_of(n, hurst, seed, chosen.pixels)
        reference = None
        for name in chosen.codes:
            try:
                run = CODES[name](heights, 1.0, load * 2 * np.pi, chosen.tol)
            except ImportError as error:
                print(f"{n:5d} {name}: not installed ({error}); see envs/peers.txt")
                continue
            reference = reference or run.seconds
            ratio = run.seconds / reference
            ratios[name].append(ratio)
            residual = contact_codes.complementarity(run.pressure, heights, 1.0)
            pairs = "-" if run.fft_pairs is None else f"{run.fft_pairs:.1f}"
            iterations = "-" if run.iterations is None else run.iterations
            print(
                f"{n:5d} {hurst:4.1f} {load:7.3f} {seed:5d} {name:16s} {run.seconds:9.3f} "
                f"{pairs:>10s} {iterations:>5} {residual:9.1e} {np.mean(run.pressure > 0):7.4f} "
                f"{ratio:7.1f}",
                flush=True,
            )
    for name, values in ratios.items():
        if values:
            mean = np.exp(np.mean(np.log(values)))
            print(f"geometric mean of time over {chosen.codes[0]}: {name} {mean:.1f}")


if __name__ == "__main__":
    main()
