"""Compare the adhesive solver with Tamaas and Adhesion: one run, one thread each.

All codes get the same heights, load and law; what each really reached is measured with the same
independent function, `adhesive_codes.assess`. Example::

    python benchmarks/adhesive_vs_peers.py --largest 512 --codes stickiness adhesion

Surfaces are self-affine with H = 0.8 and q0 h_rms = 0.1, the load is p/(E* q0 h_rms) = 0.065, the
law exponential unless told otherwise. Times are processor seconds on one thread; compare ratios
within a run rather than seconds. Tamaas solves at mean gaps and has to search for the load: the
columns "solves" and "last" tell how many solutions that took and how long the last one. A time
above --limit is a lower bound: the code was stopped, or would have searched on.
"""

import argparse
import os
import statistics

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"

import adhesive_codes  # noqa: E402 - the number of threads must be set before numpy is loaded
import numpy as np  # noqa: E402
import pandas as pd  # noqa: E402

from stickiness import adhesive, spectrum, surface  # noqa: E402

CODES = {name: getattr(adhesive_codes, name) for name in ("stickiness", "adhesion", "tamaas")}
LAWS = {"exponential": adhesive.Exponential, "maugis": adhesive.Maugis}
SCALED_PRESSURE, SLOPE, HURST = 0.065, 0.1, 0.8
# Grid, magnification, range over rms height, adhesion length over range.
CASES = ((256, 32, 1.0, 0.01), (512, 64, 1.0, 0.05), (512, 64, 0.1, 0.05), (1024, 128, 0.1, 0.05))


def options():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--largest", type=int, default=1024, help="leave out larger grids")
    parser.add_argument("--law", choices=sorted(LAWS), default="exponential")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--codes", nargs="+", choices=sorted(CODES), default=list(CODES))
    parser.add_argument("--limit", type=float, default=300.0, help="processor seconds of a run")
    parser.add_argument("--output", help="CSV file to write the results to")
    parser.add_argument("--tol", type=float, default=1e-8, help="residual over the strength")
    return parser.parse_args()


def problem(case, law, seed):
    """Heights in a unit cell, law and mean pressure over E*."""
    n, magnification, range_over_h_rms, strength = case
    q0 = 2 * np.pi
    h_rms = SLOPE / q0
    s = spectrum.SelfAffine(hurst=HURST, q0=q0, q1=q0 * magnification, h_rms=h_rms)
    heights = surface.synthesise(s, n=n, length=1.0, seed=seed)
    range_ = range_over_h_rms * h_rms
    return (
        heights,
        LAWS[law](adhesion_length=strength * range_, range=range_),
        SCALED_PRESSURE * SLOPE,
    )


def measure(name, case, problem, chosen):
    """Row of a code for a case, or the reason why there is none."""
    heights, law, pressure = problem
    row = dict(zip(("n", "zeta", "range", "strength"), case, strict=True)) | {"code": name}
    arguments = heights, 1.0, law, pressure, chosen.tol
    try:
        run = CODES[name](*arguments, limit=chosen.limit)
    except ImportError as error:
        return row | {"failed": f"not installed ({error}); see envs/peers.txt"}
    except NotImplementedError as error:
        return row | {"failed": str(error)}
    times = [run.seconds]
    if name == "stickiness":  # which is so fast that a single run says little
        times += [CODES[name](*arguments).seconds for _ in range(2)]
    reached = adhesive_codes.assess(run.gap, heights, 1.0, law, pressure)
    row |= {"seconds": statistics.median_low(times), "solves": run.solves, "last": run.last}
    return row | {"iterations": run.iterations} | vars(reached)


def main():
    chosen = options()
    for name in chosen.codes:  # loads libraries and plans transforms, which is timed for no code
        measure(name, (64, 8, 1.0, 0.01), problem((64, 8, 1.0, 0.01), chosen.law, 0), chosen)
    tables = []
    for case in CASES:
        if case[0] <= chosen.largest:
            given = problem(case, chosen.law, chosen.seed)
            table = pd.DataFrame([measure(name, case, given, chosen) for name in chosen.codes])
            table["ratio"] = table.seconds / table.seconds[0]
            print(table.to_string(index=False, float_format="{:.6g}".format), flush=True)
            tables.append(table)
    if chosen.output:
        pd.concat(tables).to_csv(chosen.output, index=False, float_format="%.9g")


if __name__ == "__main__":
    main()
