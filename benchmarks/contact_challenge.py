"""The contact-mechanics challenge: its problem on surfaces of its spectrum, or on its own heights.

Mueser et al., Tribol. Lett. 65, 118 (2017), doi:10.1007/s11249-017-0900-2; defined by Mueser and
Dapp, arXiv:1512.02403. The published heights do not come with this project, so realisations of the
same spectrum stand in for them: side 0.1 mm, Hurst exponent 0.8, waves from 0.1 mm to 0.1 um,
spectrum flat above 20 um, rms gradient 1. E* = 25 MPa; exponential attraction of 50 mJ/m^2 and
range 2.071 nm above a hard wall. Examples::

    python benchmarks/contact_challenge.py                  # without adhesion, 10 min of processor
    python benchmarks/contact_challenge.py --adhesion --points 2048 --loads 0.01    # 4 min
    python benchmarks/contact_challenge.py --heights surface.npy --height-unit um

4096 points a side are 4.1 per shortest wavelength. The attraction bends the surfaces together over
range^2 E*/w = 2.1 nm, which a pixel of 24 nm does not resolve: contact with adhesion depends on the
grid.
"""

import argparse
import os
import time
import warnings

os.environ.setdefault("OMP_NUM_THREADS", "1")  # before numpy is loaded

import numpy as np  # noqa: E402

from stickiness import adhesive, repulsive, spectrum, surface  # noqa: E402
from stickiness.measured import topography  # noqa: E402
from stickiness.plausibility import PlausibilityWarning  # noqa: E402
from stickiness.repulsive import half_space, subpixel  # noqa: E402

# Lengths in um, pressures over E*.
SIDE, ROLLOFF, SHORTEST, HURST = 100.0, 20.0, 0.1, 0.8
MODULUS, WORK, RANGE = 25e6, 50e-3, 2.071e-3
LAW = adhesive.Exponential(adhesion_length=WORK / MODULUS * 1e6, range=RANGE)
LOADS = [0.0005, 0.001, 0.003, 0.01, 0.03, 0.1]  # the challenge compares at 0.01
TOLERANCE = 1e-3  # with adhesion; areas change by less than 1e-3 of themselves below it


def options():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--adhesion", action="store_true", help="solve with adhesion, too")
    parser.add_argument("--points", type=int, default=4096, help="along a side of the finer grid")
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--loads", type=float, nargs="+", default=LOADS)
    parser.add_argument("--tol", type=float, default=1e-5)
    parser.add_argument("--heights", help="file of periodic heights instead of realisations")
    parser.add_argument("--height-unit", default="um", help="of that file")
    parser.add_argument("--length", default="0.1 mm", help="side of that file")
    return parser.parse_args()


def surfaces_of(chosen):
    """Name, heights and side [um] of every surface, on the finer grid."""
    if chosen.heights:
        found = topography.read(
            chosen.heights, length=chosen.length, height_unit=chosen.height_unit, missing="refuse"
        )
        step = max(1, len(found.heights) // chosen.points)
        yield "file", found.heights[::step, ::step] * 1e6, found.size[0] * 1e6
        return
    band = {"q0": 2 * np.pi / SIDE, "q1": 2 * np.pi / SHORTEST, "q_rolloff": 2 * np.pi / ROLLOFF}
    s = spectrum.SelfAffine(hurst=HURST, C0=1.0, **band)
    points = max(chosen.points, 4096)  # a coarser grid takes every second point of a fine one
    for seed in chosen.seeds:
        heights = surface.synthesise(s, points, SIDE, seed=seed)
        heights /= surface.moments(heights, SIDE).rms_slope
        step = points // chosen.points
        yield f"seed {seed}", heights[::step, ::step], SIDE


def describe(name, heights, side):
    """Print moments, and the gradient on 512 points a side as published."""
    moments = surface.moments(heights, side)
    step = max(1, len(heights) // 512)
    slope = half_space.measure_slope(heights[::step, ::step], (side, side))
    print(
        f"{name}: h_rms {moments.h_rms:.4f} um, rms gradient {moments.rms_slope:.4f}, on every "
        f"{step}. point {slope:.5f}, 1/rms Laplacian {1e3 / moments.rms_curvature:.2f} nm"
    )


def areas(contact):
    """Share of the points in contact, as counted and with edges between the points."""
    touching = contact.gap <= 0
    return float(touching.mean()), float(touching.mean() - subpixel.boundary_strip(touching))


def main():
    chosen = options()
    warnings.simplefilter("ignore", PlausibilityWarning)  # that pixels are too large is the point
    for name, heights, side in surfaces_of(chosen):
        describe(name, heights, side)
        print("  p/E*     area      error     counted   mean gap [um]  error")
        start = time.process_time()
        paths = (
            repulsive.load_path(heights[::step, ::step], side, sorted(chosen.loads), tol=chosen.tol)
            for step in (2, 1)
        )
        for coarse, fine in zip(*paths, strict=True):
            # The larger of two differences: from the grid half as fine, and from the linear
            # extrapolation of the areas counted in pixels.
            (coarse_counted, coarse_area), (counted, area) = areas(coarse), areas(fine)
            line = 2 * counted - coarse_counted
            error = max(abs(area - coarse_area), abs(area - line))
            print(
                f"  {fine.mean_pressure:.4f}   {area:.6f}  {error:.6f}  {counted:.6f}"
                f"  {fine.mean_gap:.5f}        {abs(fine.mean_gap - coarse.mean_gap):.5f}",
                flush=True,
            )
            if chosen.adhesion:
                # From the contact without adhesion, which leads to the state with the widest gaps.
                load = fine.mean_pressure
                state = adhesive.solve(heights, side, LAW, load, start=fine, tol=TOLERANCE)
                counted, area = areas(state)
                print(
                    f"  adhesive {area:.6f}            {counted:.6f}  {state.mean_gap:.5f}",
                    flush=True,
                )
        print(f"{name}: {time.process_time() - start:.0f} s of processor")


if __name__ == "__main__":
    main()
