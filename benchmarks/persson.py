"""Persson's theory: digits against nodes, time, and the gamma that simulations ask for.

Examples::

    PYTHONPATH=scripts python benchmarks/persson.py digits
    PYTHONPATH=scripts python benchmarks/persson.py speed
    PYTHONPATH=scripts python benchmarks/persson.py gamma --results results/standard
"""

import argparse
import os
import time
from pathlib import Path

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"

import numpy as np  # noqa: E402 - the number of threads must be set before numpy is loaded
import xarray as xr  # noqa: E402
from scipy.optimize import minimize_scalar  # noqa: E402

from stickiness import surface  # noqa: E402
from stickiness.persson import Persson  # noqa: E402
from stickiness.spectrum import SelfAffine, Shells  # noqa: E402

VARIANTS = ("afferrante2018", "almqvist2011")
CORRECTIONS = ("yang2008", "wang2017", "xu2024")
LOADS = (1e-6, 0.01, 0.065, 1.0)
PAPER_LOADS = (0.0065, 0.03, 0.07, 0.13, 0.2, 0.26, 0.33, 0.39, 0.46, 0.52)
PAPER_MAGNIFICATIONS = (10.0, 100.0, 500.0, 1e3, 5e3, 1e4, 2e4, 5e4)


def options():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=("digits", "speed", "gamma"))
    parser.add_argument("--results", type=Path, default=Path("results/standard"))
    parser.add_argument("--case", default="H0.8_zeta32_wide", help="for the attractive area")
    parser.add_argument("--bootstraps", type=int, default=2000)
    return parser.parse_args()


def power_law(magnification, hurst=0.8, rolloff=None):
    return SelfAffine(hurst=hurst, q0=1.0, q1=magnification, h_rms=1.0, q_rolloff=rolloff)


def digits(_):
    """Largest relative errors over loads, gaps and variants, against three times the nodes."""
    spectra = {
        "zeta = 1.001": power_law(1.001),
        "zeta = 5e4": power_law(5e4),
        "zeta = 1e8, H = 0.05": power_law(1e8, 0.05),
        "zeta = 1e8, H = 1": power_law(1e8, 1.0),
        "roll-off": power_law(1e4, rolloff=30.0),
        "five shells": Shells(np.sqrt([1, 2, 4, 5, 8]), [1, 0.4, 0.2, 0.2, 0.05]),
        "lattice": surface.lattice_spectrum(power_law(64.0), 2 * np.pi),
    }
    print("nodes: largest relative error of mean gap, P(u), its integral; of normalisation; CPU ms")
    for name, spectrum in spectra.items():
        best = evaluate(spectrum, 3.0)
        for nodes in (0.5, 0.75, 1.0, 1.5, 2.0):
            begin = time.process_time()
            values = evaluate(spectrum, nodes)
            spent = (time.process_time() - begin) / (len(VARIANTS) * len(LOADS))
            seen = best[1] > 1e-12 * best[1].max(axis=-1, keepdims=True)
            errors = [
                np.max(np.abs(a / b - 1), where=True if a.ndim < 3 else seen, initial=0)
                for a, b in zip(values[:3], best[:3], strict=True)
            ]
            norm = np.max(np.abs(values[3]))
            print(
                f"{name:22} {nodes:4} "
                + " ".join(f"{x:.0e}" for x in (*errors, norm))
                + f" {1e3 * spent:.0f}"
            )


def evaluate(spectrum, nodes):
    u, p = np.geomspace(1e-6, 8, 60) * spectrum.h_rms, np.array(LOADS) * spectrum.h_rms
    parts = []
    for variant in VARIANTS:
        theory = Persson(spectrum, variant, nodes=nodes)
        total = theory.gap_cumulative(np.inf, p) + theory.area_fraction(p) - 1
        parts.append(
            (theory.mean_gap(p), theory.gap_density(u, p), theory.gap_cumulative(u, p), total)
        )
    return [np.stack(column) for column in zip(*parts, strict=True)]


def speed(_):
    """CPU time of single loads and of Figures 1 and 3."""
    u = np.geomspace(1e-4, 10, 400)
    for magnification in (1e3, 5e4, 1e8):
        spent = []
        for repeat in range(10):
            theory = Persson(power_law(magnification))
            begin = time.process_time()
            theory.gap_density(u, 0.065 + 1e-6 * repeat)
            spent.append(time.process_time() - begin)
        print(f"zeta = {magnification:g}, one load, 400 gaps: {1e3 * np.median(spent):.1f} ms")
    begin = time.process_time()
    figures(u)
    print(f"Figures 1 and 3: {time.process_time() - begin:.1f} s")


def figures(u):
    """All that Figures 1 and 3 of the paper show, both variants."""
    for variant in VARIANTS:
        for magnification in PAPER_MAGNIFICATIONS:
            for hurst in (0.7, 0.8, 0.9):
                theory = Persson(power_law(magnification, hurst), variant)
                loads = np.append(0.065, theory.pressure_at([1.37, 2.0]))
                theory.gap_density(u, loads)
                theory.gap_cumulative(u, loads)
        Persson(power_law(1e3), variant).gap_cumulative(u, PAPER_LOADS)


def gamma(chosen):
    """The gamma that agrees best with simulated contact, by correction and quantity.

    Each realisation is compared with the theory on its own spectrum, which takes most of the
    scatter between seeds away; what is left is resampled over seeds for a 95 % interval.
    """
    for path in sorted((chosen.results / "contact/ensembles").glob("*.nc")):
        case = path.stem
        seeds = realisations(chosen.results, case)
        report(chosen, case, "area_fraction", seeds, area_ratios)
        report(chosen, case, "mean_gap", seeds, gap_ratios)
        if case == chosen.case:
            report(chosen, case, "attractive_area", seeds, attractive_ratios)


def realisations(results, case):
    """Spectrum of every realisation and what was simulated on it, loads from 0.0065 up."""
    seeds = []
    with xr.open_dataset(results / "contact/ensembles" / f"{case}.nc") as ensemble:
        simulated = ensemble.sel(pressure=ensemble.pressure > 0.006).isel(resolution=-1).load()
    for seed in simulated.seed.values:
        with xr.open_dataset(results / "surfaces" / case / f"seed{seed}.nc") as made:
            variance = made.realised_variance.values
            spectrum = Shells(made.wave_number.values[variance > 0], variance[variance > 0])
        seeds.append((spectrum, simulated.sel(seed=seed)))
    return seeds


def area_ratios(theory, simulated):
    """Ln of theory over simulation at each load."""
    return np.log(theory.area_fraction(simulated.pressure.values) / simulated.area_fraction.values)


def gap_ratios(theory, simulated):
    return np.log(theory.mean_gap(simulated.pressure.values) / simulated.mean_gap.values)


def attractive_ratios(theory, simulated):
    """At gaps of 0.01 to 0.3 h_rms and four loads."""
    some = simulated.sel(
        pressure=[0.0065, 0.03, 0.13, 0.33], range=[0.01, 0.1, 0.3], method="nearest"
    )
    values = theory.gap_cumulative(some["range"].values, some.pressure.values)
    return np.log(values / some.attractive_area.values).ravel()


def report(chosen, case, name, seeds, ratios):
    coarse = name == "attractive_area"
    grid = np.array([0.3, 0.45, 0.65, 0.9]) if coarse else np.linspace(0.1, 1.0, 19)
    for correction in CORRECTIONS:
        table = np.array(
            [
                [ratios(Persson(s, gamma=g, correction=correction), simulated) for g in grid]
                for s, simulated in seeds
            ]
        )  # (seed, gamma, load)
        rng = np.random.default_rng(1)
        draws = rng.integers(len(seeds), size=(chosen.bootstraps, len(seeds)))
        samples = [best_gamma(grid, table[draw].mean(axis=0))[0] for draw in draws]
        low, high = np.percentile(samples, [2.5, 97.5])
        at, misfit = best_gamma(grid, table.mean(axis=0))
        own = Persson(seeds[0][0], correction=correction).gamma
        _, at_own = misfit_at(grid, table.mean(axis=0), own)
        print(
            f"{case:17} {name:15} {correction}: gamma = {at:.3f} ({low:.3f} to {high:.3f}), "
            f"rms deviation {100 * misfit:.1f} %, at gamma = {own:.3f} {100 * at_own:.1f} %",
            flush=True,
        )


def misfit_at(grid, table, value):
    """Deviations at one gamma, between those on the grid, and their root mean square."""
    # ln A is nearly linear in ln gamma
    coefficients = np.polynomial.polynomial.polyfit(np.log(grid), table, min(4, len(grid) - 1))
    deviations = np.polynomial.polynomial.polyval(np.log(value), coefficients)
    return deviations, float(np.sqrt(np.mean(deviations**2)))


def best_gamma(grid, table):
    found = minimize_scalar(
        lambda g: misfit_at(grid, table, g)[1], bounds=(grid[0], grid[-1]), method="bounded"
    )
    return float(found.x), float(found.fun)


if __name__ == "__main__":
    asked = options()
    {"digits": digits, "speed": speed, "gamma": gamma}[asked.what](asked)
