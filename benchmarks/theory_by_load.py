"""Errors of Persson's theory by load in cells of many waves, and P(u) at small gaps on a fine grid.

Cells of 4 by 4 and 8 by 8 longest wavelengths have summits enough for small loads; theory is on
their discrete spectrum. Four points per shortest wavelength err by a few per cent in the area, and
hardly in the mean gap. Run it by hand (5 min):

    python benchmarks/theory_by_load.py
"""

import numpy as np

from stickiness import dmt, repulsive, spectrum, surface
from stickiness.persson import Persson
from stickiness.repulsive import subpixel

LOADS = np.array([0.003, 0.01, 0.03, 0.08, 0.15, 0.25, 0.5])  # over E* q0 h_rms, at h_rms = 1
CASES = ((0.8, 16, 8, 8), (0.8, 64, 4, 6), (0.5, 16, 8, 6))  # H, magnification, cell, seeds
CORRECTIONS = "yang2008", "wang2017", "xu2024"
POINTS = 4  # per shortest wavelength
RANGE, GAPS = 0.1, (0.5, 1.0)  # over h_rms, of A_ad and of P(u)
WIDTH = 1.15  # ratio of the ranges between which P(u) is taken
NAMES = ("area", "mean gap", f"A_ad({RANGE:g})", *(f"P({gap:g})" for gap in GAPS))
FINE = 16, 64, (1, 2, 3, 4)  # magnification, points per shortest wavelength, seeds
SMALL_GAPS = np.array([0.001, 0.003, 0.01, 0.03])


def main():
    print(f"theory over simulation less 1 [%] at loads {', '.join(map(str, LOADS))}")
    for hurst, zeta, cell, seeds in CASES:
        compare(hurst, zeta, cell, range(1, seeds + 1))
    print(f"d ln P/d ln u at u/h_rms = {', '.join(map(str, SMALL_GAPS))}")
    for load in (0.03, 0.065, 0.13):
        print(f"load {load:5.3f}:", np.round(exponents(load), 2), flush=True)


def compare(hurst, zeta, cell, seeds):
    """Print the errors of every correction with the standard errors of the simulation."""
    s = spectrum.SelfAffine(hurst=hurst, q0=1.0, q1=float(zeta), h_rms=1.0)
    length = 2 * np.pi * cell
    found = np.array([simulate(s, length, POINTS * zeta * cell, seed) for seed in seeds])
    mean = found.mean(axis=0)
    error = found.std(axis=0, ddof=1) / np.sqrt(len(seeds)) / mean
    lattice = surface.lattice_spectrum(s, length)
    for correction in CORRECTIONS:
        theory = by_theory(Persson(lattice, correction=correction))
        print(f"H = {hurst}, zeta = {zeta}, {cell} by {cell}, {correction}")
        for name, off, sampling in zip(NAMES, 100 * (theory / mean - 1), 100 * error, strict=True):
            cells = (f"{x:+6.1f} ± {e:3.1f}" for x, e in zip(off, sampling, strict=True))
            print(f"  {name:10s}", "  ".join(cells), flush=True)


def simulate(s, length, points, seed):
    """Quantities of one realisation in the order of `NAMES`, by load."""
    heights = surface.synthesise(s, points, length, seed=seed)
    rows = []
    for contact in repulsive.load_path(heights, length, LOADS, tol=1e-4):
        area = contact.area_fraction - subpixel.boundary_strip(contact.gap == 0)
        density = [gap_density(contact.gap, gap) for gap in GAPS]
        attractive = dmt.attractive_area(contact.gap, RANGE, subpixel=True)
        rows.append((area, contact.mean_gap, float(attractive), *density))
    return np.transpose(rows)


def by_theory(theory):
    rows = [theory.area_fraction(LOADS), theory.mean_gap(LOADS)]
    rows.append(theory.gap_cumulative(RANGE, LOADS))
    rows += [theory.gap_density(gap, LOADS) for gap in GAPS]
    return np.array([np.ravel(row) for row in rows])


def gap_density(gap, at, width=WIDTH):
    """P(u) between two ranges about a gap."""
    ranges = at * np.array([width**-0.5, width**0.5])
    low, high = (float(dmt.attractive_area(gap, one, subpixel=True)) for one in ranges)
    return (high - low) / np.diff(ranges)[0]


def exponents(load):
    """Exponents of P(u) at small gaps, each over a factor of 4, of a mean over realisations."""
    zeta, points, seeds = FINE
    s = spectrum.SelfAffine(hurst=0.8, q0=1.0, q1=float(zeta), h_rms=1.0)
    ends = np.multiply.outer([0.5, 2.0], SMALL_GAPS)
    density = np.zeros_like(ends)
    for seed in seeds:
        heights = surface.synthesise(s, points * zeta, 2 * np.pi, seed=seed)
        gap = repulsive.solve(heights, 2 * np.pi, load, tol=1e-4).gap
        density += [[gap_density(gap, at, width=1.4) for at in row] for row in ends]
    return np.log(density[1] / density[0]) / np.log(4)


if __name__ == "__main__":
    main()
