"""Compare the adhesive solver with Tamaas and Adhesion: one run, one thread each.

All codes get the same heights, load and law; what each really reached is measured with the same
independent function, `adhesive_codes.assess`. Example::

    python benchmarks/adhesive_vs_peers.py --largest 512 --codes stickiness adhesion

Surfaces are self-affine with H = 0.8 and q0 h_rms = 0.1, the load is p/(E* q0 h_rms) = 0.065, the
law exponential unless told otherwise. Times are processor seconds on one thread; compare ratios
within a run rather than seconds. Tamaas solves at mean gaps and has to search for the load: the
columns "solves" and "last" tell how many solutions that took and how long the last one.
A time above --limit is a lower bound: the code was stopped, or would have searched on.
"""

import argparse
import csv
import os
import pathlib
import statistics
from dataclasses import dataclass

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"

import adhesive_codes  # noqa: E402 - the number of threads must be set before numpy is loaded
import numpy as np  # noqa: E402

from stickiness import adhesive, spectrum, surface  # noqa: E402

CODES = {
    "stickiness": adhesive_codes.stickiness,
    "adhesion": adhesive_codes.adhesion,
    "tamaas": adhesive_codes.tamaas,
}
LAWS = {"exponential": adhesive.Exponential, "maugis": adhesive.Maugis}
SCALED_PRESSURE, SLOPE, HURST = 0.065, 0.1, 0.8
HEADER = (
    "   n zeta eps/h l_a/eps code              seconds solves    last  iter  residual  contact  "
    "attract.        energy   ratio"
)


@dataclass(frozen=True)
class Case:
    """Grid, magnification, range over rms height and adhesion length over range."""

    n: int
    magnification: float
    range: float
    strength: float


CASES = (
    Case(256, 32, 1.0, 0.01),
    Case(512, 64, 1.0, 0.05),
    Case(512, 64, 0.1, 0.05),
    Case(1024, 128, 0.1, 0.05),
)


def options():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--largest", type=int, default=1024, help="leave out larger grids")
    parser.add_argument("--smallest", type=int, default=0, help="leave out smaller grids")
    parser.add_argument("--law", choices=sorted(LAWS), default="exponential")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--codes", nargs="+", choices=sorted(CODES), default=list(CODES))
    parser.add_argument("--limit", type=float, default=300.0, help="processor seconds of a run")
    parser.add_argument("--output", type=pathlib.Path, help="CSV file to append the results to")
    parser.add_argument("--tol", type=float, default=1e-8, help="asked for, over the strength")
    return parser.parse_args()


def problem(case, law, seed):
    """Heights in a unit cell, law and mean pressure over E*."""
    q0 = 2 * np.pi
    h_rms = SLOPE / q0
    s = spectrum.SelfAffine(hurst=HURST, q0=q0, q1=q0 * case.magnification, h_rms=h_rms)
    heights = surface.synthesise(s, n=case.n, length=1.0, seed=seed)
    range_ = case.range * h_rms
    law = LAWS[law](adhesion_length=case.strength * range_, range=range_)
    return heights, law, SCALED_PRESSURE * SLOPE


def report(case, name, run, reached, reference, output):
    row = {
        "n": case.n,
        "magnification": case.magnification,
        "range_over_h_rms": case.range,
        "adhesion_length_over_range": case.strength,
        "code": name,
        "seconds": round(run.seconds, 3),
        "solves": run.solves,
        "last": None if run.last is None else round(run.last, 3),
        "iterations": run.iterations,
        "residual": float(f"{reached.residual:.2e}"),
        "contact": round(reached.contact, 6),
        "attractive": round(reached.attractive, 6),
        "energy": float(f"{reached.energy:.9e}"),
        "ratio": round(run.seconds / reference, 2),
    }
    shown = {key: "-" if value is None else value for key, value in row.items()}
    print(
        "{n:4d} {magnification:4g} {range_over_h_rms:5g} {adhesion_length_over_range:7g} "
        "{code:16s} {seconds:8.2f} {solves:6d} {last:>7} {iterations:>5} {residual:9.1e} "
        "{contact:8.5f} {attractive:9.5f} {energy:13.6e} {ratio:>7}".format(**shown),
        flush=True,
    )
    if output is not None:
        output.parent.mkdir(parents=True, exist_ok=True)
        new = not output.exists()
        with output.open("a", newline="") as stream:
            writer = csv.DictWriter(stream, row)
            if new:
                writer.writeheader()
            writer.writerow(row)


def warm_up(names, law):
    """Load libraries and plan transforms: set-up is timed for no code."""
    heights, law, pressure = problem(Case(64, 8, 1.0, 0.01), law, 0)
    for name in names:
        try:
            CODES[name](heights, 1.0, law, pressure, 1e-3)
        except (ImportError, NotImplementedError):
            continue


def main():
    chosen = options()
    warm_up(chosen.codes, chosen.law)
    print(HEADER)
    for case in CASES:
        if not chosen.smallest <= case.n <= chosen.largest:
            continue
        heights, law, pressure = problem(case, chosen.law, chosen.seed)
        arguments = heights, 1.0, law, pressure, chosen.tol
        runs = [adhesive_codes.stickiness(*arguments) for _ in range(3)]
        ours = statistics.median_low(run.seconds for run in runs)
        for name in chosen.codes:
            try:
                run = CODES[name](*arguments, limit=chosen.limit)
            except ImportError as error:
                print(f"{case.n:4d} {name}: not installed ({error}); see envs/peers.txt")
            except NotImplementedError as error:
                print(f"{case.n:4d} {name}: {error}")
            else:
                reached = adhesive_codes.assess(run.gap, heights, 1.0, law, pressure)
                report(case, name, run, reached, ours, chosen.output)


if __name__ == "__main__":
    main()
