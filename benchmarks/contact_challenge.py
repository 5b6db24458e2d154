"""The contact-mechanics challenge: its problem on surfaces of its spectrum, or on its own heights.

Mueser et al., Tribol. Lett. 65, 118 (2017), doi:10.1007/s11249-017-0900-2; defined by Mueser and
Dapp, arXiv:1512.02403. The published heights do not come with this project, so realisations of the
same spectrum stand in for them: side 0.1 mm, Hurst exponent 0.8, waves from 0.1 mm to 0.1 um,
spectrum flat above 20 um, rms gradient 1. E* = 25 MPa; exponential attraction of 50 mJ/m^2 and
range 2.071 nm above a hard wall. Parts, each by itself or all in turn:

    python benchmarks/contact_challenge.py full         # whole surface, without adhesion
    python benchmarks/contact_challenge.py sticky       # whole surface, with adhesion, at one load
    python benchmarks/contact_challenge.py cells        # small cells, with adhesion, fine grids
    python benchmarks/contact_challenge.py long         # 512 points, 30 times the range
    python benchmarks/contact_challenge.py full --heights surface.npy --height-unit um

The largest parts take 10 to 15 min of processor: `full` (three surfaces), `cells`. `sticky` takes 4
min with --points 2048, and some 20 at 4096.

4096 points a side are 4.1 per shortest wavelength. The attraction bends the surfaces together over
range^2 E*/w = 2.1 nm, which a pixel of 24 nm does not resolve: contact then depends on the grid.
How much is measured on small cells of the same spectrum, whose grids go down to 3 nm.
"""

import argparse
import os
import time
import warnings
from dataclasses import replace

os.environ.setdefault("OMP_NUM_THREADS", "1")  # before numpy is loaded

import numpy as np  # noqa: E402
from scipy import optimize  # noqa: E402

from stickiness import adhesive, repulsive, spectrum, surface  # noqa: E402
from stickiness import surface as synthesis  # noqa: E402
from stickiness.measured import topography  # noqa: E402
from stickiness.plausibility import PlausibilityWarning  # noqa: E402
from stickiness.repulsive import half_space, richardson, subpixel  # noqa: E402

# Lengths in um, pressures over E*.
SIDE, ROLLOFF, SHORTEST, HURST = 100.0, 20.0, 0.1, 0.8
MODULUS, WORK, RANGE = 25e6, 50e-3, 2.071e-3
LAW = adhesive.Exponential(adhesion_length=WORK / MODULUS * 1e6, range=RANGE)
LOADS = (0.0005, 0.001, 0.003, 0.01, 0.03, 0.1)
REFERENCE = 0.01  # load at which the challenge compares
# Side of a cell, grids, seeds, loads: ever finer grids on small cells, ever larger cells.
CELLS = (
    (3.125, (64, 128, 256, 512), (1, 2, 3), (0.003, REFERENCE, 0.1)),
    (12.5, (256, 512, 1024), (1,), (REFERENCE,)),
    (25.0, (512, 1024, 2048), (1,), (REFERENCE,)),
    (3.125, (1024,), (2,), (REFERENCE,)),
    (50.0, (1024, 2048), (1,), (REFERENCE,)),
)
TOLERANCE = 1e-3  # with adhesion; areas change by less than 1e-3 of themselves below it


def main():
    asked = options()
    warnings.simplefilter("ignore", PlausibilityWarning)  # that pixels are too large is the point
    if asked.part in ("full", "all"):
        report_full(asked)
    if asked.part in ("sticky", "all"):
        report_sticky(asked)
    if asked.part in ("cells", "all"):
        report_cells(asked)
    if asked.part in ("long", "all"):
        report_long_range(asked)


def options():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "part", choices=("full", "sticky", "cells", "long", "all"), nargs="?", default="all"
    )
    parser.add_argument("--points", type=int, default=4096, help="finest grid of the whole surface")
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--amplitudes", choices=("gaussian", "fixed"), default="gaussian")
    parser.add_argument("--loads", type=float, nargs="+", help="mean pressures over E*")
    parser.add_argument("--tol", type=float, default=1e-5)
    parser.add_argument("--heights", help="file of periodic heights, in place of realisations")
    parser.add_argument("--height-unit", default="um", help="of that file")
    parser.add_argument("--length", default="0.1 mm", help="side of that file")
    return parser.parse_args()


def whole_spectrum():
    """Spectrum of the challenge with an rms gradient of 1."""
    band = {"q0": 2 * np.pi / SIDE, "q1": 2 * np.pi / SHORTEST, "q_rolloff": 2 * np.pi / ROLLOFF}
    steepness = spectrum.SelfAffine(hurst=HURST, C0=1.0, **band).rms_slope
    return spectrum.SelfAffine(hurst=HURST, C0=steepness**-2, **band)


def draw_cell(side, points, seed):
    """Heights of a cell too small for the longest waves, at the level of the whole spectrum."""
    whole = whole_spectrum()
    level = float(whole.psd(whole.q1)) * whole.q1 ** (2 * (HURST + 1))
    rolloff = 2 * np.pi / ROLLOFF if side > ROLLOFF else None
    s = spectrum.SelfAffine(
        hurst=HURST, C0=level, q0=2 * np.pi / side, q1=whole.q1, q_rolloff=rolloff
    )
    return surface.synthesise(s, points, side, seed=seed)


def surfaces_of(asked):
    """Name and heights of every surface asked for, on the finest grid, and its side [um]."""
    if asked.heights:
        found = topography.read(
            asked.heights, length=asked.length, height_unit=asked.height_unit, missing="refuse"
        )
        step = max(1, len(found.heights) // asked.points)
        yield "file", found.heights[::step, ::step] * 1e6, found.size[0] * 1e6
        return
    points = max(asked.points, 4096)  # a coarser grid takes every second point of a fine one
    for seed in asked.seeds:
        heights = surface.synthesise(
            whole_spectrum(), points, SIDE, seed=seed, amplitudes=asked.amplitudes
        )
        heights /= synthesis.moments(heights, SIDE).rms_slope
        step = points // asked.points
        yield f"seed {seed}", heights[::step, ::step], SIDE


def report_full(asked):
    """Whole surface without adhesion on two grids: areas and mean gaps."""
    loads = sorted(asked.loads or LOADS)
    print("\nwhole surface, without adhesion; area and mean gap [um] +- error of the grid")
    print("surface      p/E*      area     +-      counted  mean gap     +-")
    for name, heights, side in surfaces_of(asked):
        describe_heights(name, heights, side)
        start = time.process_time()
        solved = [press(heights[::step, ::step], side, loads, asked.tol) for step in (2, 1)]
        for (coarse, _), (fine, _) in zip(*solved, strict=True):
            area, area_error = continuum_area(coarse, fine)
            gap_error = abs(fine["mean_gap"] - coarse["mean_gap"])
            print(
                f"{name:8s} {fine['load']:8.4f}  {area:.6f} {area_error:.6f}  {fine['counted']:.6f}"
                f"  {fine['mean_gap']:.5f}  {gap_error:.5f}",
                flush=True,
            )
        print(f"{name}: {time.process_time() - start:.0f} s of processor")


def describe_heights(name, heights, side):
    """Print moments, and the gradient on 512 points a side as published."""
    moments = synthesis.moments(heights, side)
    step = max(1, len(heights) // 512)
    slope = half_space.measure_slope(heights[::step, ::step], (side, side))
    print(
        f"{name}: h_rms {moments.h_rms:.4f} um, rms gradient {moments.rms_slope:.4f}, on every "
        f"{step}. point {slope:.5f}, 1/rms Laplacian {1e3 * moments.rms_curvature**-1:.2f} nm"
    )


def press(heights, side, loads, tol):
    """Rows of quantities without adhesion, from load to load, and the solutions."""
    contacts = repulsive.load_path(heights, side, loads, tol=tol)
    return [(measure(c.gap, c.mean_pressure), c) for c in contacts]


def stick(heights, contact):
    """Quantities with adhesion at the load of a contact without it, which is the start.

    That leads to the state with the widest gaps at this load. An adhesive state at a much lower
    load as the start may skip it: descents over long ways pass barriers.
    """
    load = contact.mean_pressure
    state = adhesive.solve(heights, contact.length, LAW, load, start=contact, tol=TOLERANCE)
    row = measure(state.gap, load)
    row["attractive"] = float(np.mean((state.gap > 0) & (state.gap <= RANGE)))
    return row


def measure(gap, load):
    """Area and mean gap of one solution."""
    touching = gap <= 0
    counted = float(touching.mean())
    return {
        "load": load,
        "counted": counted,
        "area": counted - subpixel.boundary_strip(touching),
        "mean_gap": float(gap.mean()),
    }


def continuum_area(coarse, fine):
    """Area in the limit of fine grids: with sub-pixel edges, and an error.

    The error is the larger of two differences: from the grid half as fine, and from the linear
    extrapolation of the areas counted in pixels.
    """
    line = richardson.extrapolate(coarse["counted"], fine["counted"])
    return fine["area"], max(abs(fine["area"] - coarse["area"]), abs(fine["area"] - line))


def report_sticky(asked):
    """Whole surface with adhesion: slow, at the reference load unless told otherwise."""
    loads = sorted(asked.loads or [REFERENCE])
    print("\nwhole surface, with adhesion; its edges are not resolved")
    print("surface   points      p/E*  counted   area     mean gap  alone     alone   seconds")
    for name, heights, side in surfaces_of(asked):
        start = time.process_time()
        for without, contact in press(heights, side, loads, asked.tol):
            row = stick(heights, contact)
            print(
                f"{name:8s}  {len(heights):6d}  {row['load']:8.4f}  {row['counted']:.5f}"
                f"  {row['area']:.5f}  {row['mean_gap']:.5f}   {without['area']:.5f}"
                f"  {without['mean_gap']:.5f}  {time.process_time() - start:7.0f}",
                flush=True,
            )


def report_cells(asked):
    """Cells with adhesion on ever finer grids: how contact depends on pixel and cell."""
    print("\ncells; contact counted in pixels with and without adhesion, mean gaps [um]")
    print("  side seed  pixel/nm    p/E*   sticky    alone   ratio  attract.  gap      alone")
    for side, sizes, seeds, loads in CELLS:
        for seed in seeds:
            finest = draw_cell(side, max(sizes), seed)
            for points in sizes:
                step = max(sizes) // points
                report_cell(finest[::step, ::step], (side, seed), loads, asked.tol)


def report_cell(heights, where, loads, tol):
    """Print a row for each load, on one grid of one cell."""
    side, seed = where
    for without, contact in press(heights, side, loads, tol):
        row = stick(heights, contact)
        print(
            f"{side:6.3f} {seed:4d}  {1e3 * side / len(heights):8.2f}  {row['load']:6.4f}"
            f"  {row['counted']:.5f}  {without['counted']:.5f}"
            f"  {row['counted'] / without['counted']:.3f}   {row['attractive']:.5f}"
            f"  {row['mean_gap']:.5f}  {without['mean_gap']:.5f}",
            flush=True,
        )


def report_long_range(asked):
    """Pressure under 30 times the range on 512 points, at the displacement of 250 kPa without it.

    The one solution with adhesion whose value was found. There the displacement counts the mean
    deformation, by the stiffness of the longest wave: E* pi/side.
    """
    print("\n30 times the range, 512 points: kPa at the displacement of 250 kPa without adhesion")
    law = replace(LAW, range=30 * RANGE)
    for name, heights, side in surfaces_of(asked):
        step = max(1, len(heights) // 512)
        heights = np.ascontiguousarray(heights[::step, ::step])
        alone = repulsive.solve(heights, side, REFERENCE, tol=1e-6)
        pressure = hold_displacement(heights, side, law, alone)
        print(f"{name:8s}  {pressure * MODULUS / 1e3:.3f}", flush=True)


def hold_displacement(heights, side, law, alone):
    """Pressure with adhesion at the displacement of a contact without it."""

    def shift(pressure):
        state = adhesive.solve(heights, side, law, pressure, start=alone, tol=1e-6)
        return state.mean_gap - alone.mean_gap - (pressure - alone.mean_pressure) * side / np.pi

    pressure = alone.mean_pressure
    return optimize.newton(shift, pressure, x1=0.98 * pressure, tol=1e-6 * pressure)


if __name__ == "__main__":
    main()
