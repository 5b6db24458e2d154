"""Compare ways to a small sampling error: what each estimates, its variance and its cost.

Example::

    PYTHONPATH=scripts python benchmarks/sampling.py --hurst 0.8 --load 0.065 --output sampling.nc

Dimensionless as the pipeline: lengths in 1/q0, heights in h_rms, loads in E* q0 h_rms. Cost is
processor time of synthesis, solution and evaluation on one thread, relative to fine solutions of
the same run. Variances are relative to plain Gaussian seeds, with bootstrap errors.
"""

import argparse
import os
import time

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"

import numpy as np  # noqa: E402 - the number of threads must be set before numpy is loaded
import xarray as xr  # noqa: E402
from scipy import stats  # noqa: E402

from stickiness import datasets, dmt, repulsive, spectrum, surface  # noqa: E402
from stickiness.accuracy import multilevel  # noqa: E402
from stickiness.persson import Persson  # noqa: E402

RANGES = np.geomspace(1e-3, 1, 49)
QUANTITIES = ("A_rep", "mean gap", "A_ad(0.01)", "A_ad(0.1)", "a_V")
POOL, DRAWS = 10**6, 10**7  # first seeds of coarse solutions and of descriptors: none overlaps
PLAIN = 8  # seeds of the experiment that the others are measured against
DESIGNS = ((8, 64), (4, 32), (2, 32))


def options():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--hurst", type=float, default=0.8)
    parser.add_argument("--magnification", type=int, default=64)
    parser.add_argument("--window", type=int, default=1, help="side over longest wavelength")
    parser.add_argument("--load", type=float, default=0.065)
    parser.add_argument("--seeds", type=int, default=256, help="fine solutions")
    parser.add_argument("--pool", type=int, default=2048, help="coarse solutions of other seeds")
    parser.add_argument("--descriptors", type=int, default=2048, help="seeds per experiment")
    parser.add_argument("--brief", action="store_true", help="only what the default needs")
    parser.add_argument("--output", help="NetCDF file")
    chosen = parser.parse_args()
    if min(chosen.seeds // 8, chosen.pool // 64) < 4:
        parser.error("four repetitions take at least 32 seeds and a pool of 256")
    if chosen.window != 1 and not chosen.brief:
        parser.error("stratified draws are written for a window of one wavelength: add --brief")
    return chosen


class Case:
    """One model surface at one load, and the quantities of one solution."""

    def __init__(self, chosen):
        self.hurst, self.load = chosen.hurst, chosen.load
        self.magnification, self.length = chosen.magnification, 2 * np.pi * chosen.window

    def spectrum(self, magnification=None, **size):
        q1 = float(magnification or self.magnification)
        return spectrum.SelfAffine(hurst=self.hurst, q0=1.0, q1=q1, **(size or {"h_rms": 1.0}))

    def points(self, magnification, pixels):
        return round(magnification * pixels * self.length / (2 * np.pi))

    def heights(self, seed, pixels=8, magnification=None, amplitudes="gaussian"):
        n = self.points(magnification or self.magnification, pixels)
        s = self.spectrum(magnification)
        return surface.synthesise(s, n, self.length, seed, amplitudes)

    def measured(self, heights, tol=1e-6):
        contact = repulsive.solve(heights, self.length, self.load, tol=tol)
        strip = dmt.boundary_strip(contact.gap == 0)
        area = dmt.attractive_area(contact.gap, RANGES, subpixel=True)
        return self.quantities(contact.area_fraction - strip, contact.mean_gap, area)

    def theory(self, heights):
        model = Persson(surface.realised_spectrum(heights, self.length))
        area = model.gap_cumulative(RANGES, self.load)
        return self.quantities(
            float(model.area_fraction(self.load)), float(model.mean_gap(self.load)), area
        )

    def quantities(self, area_fraction, mean_gap, area):
        a_v = dmt.fit_a_v(RANGES, area, self.load).value
        at = [area[np.argmin(np.abs(RANGES - e))] for e in (0.01, 0.1)]
        return np.array([area_fraction, mean_gap, *at, a_v])


def sampled(function, seeds):
    """Rows of quantities and seconds per row."""
    function(seeds[0])  # plans and tables are no part of the cost
    start = time.process_time()
    rows = np.array([function(int(seed)) for seed in seeds])
    return rows, (time.process_time() - start) / len(rows)


def stratified(case, count, repetition):
    """`count` Gaussian surfaces whose four longest pairs of waves fill their space evenly.

    Scrambled Sobol points give both amplitudes of the longest waves, whose phases a translation
    removes, and both parts of the diagonal ones.
    """
    rng = np.random.default_rng(repetition)
    points = stats.qmc.Sobol(6, seed=rng).random(count)
    n = case.points(case.magnification, 8)
    s = case.spectrum(C0=1.0)
    part = np.sqrt(s.psd(np.array([1.0, np.sqrt(2)])) / 2) * n**2  # of one component, in q0 = 1
    for k, u in enumerate(points):
        heights = surface.synthesise(s, n, case.length, POOL * 100 + repetition * count + k)
        waves = np.fft.fft2(heights)
        longest = part[0] * np.sqrt(-2 * np.log1p(-u[:2]))
        diagonal = part[1] * stats.norm.ppf(u[2:]).reshape(2, 2) @ [1, 1j]
        where = ((1, 0), (0, 1), (1, 1), (1, -1))
        for (i, j), value in zip(where, (*longest, *diagonal), strict=True):
            waves[i, j], waves[-i, -j] = value, np.conj(value)
        heights = np.fft.ifft2(waves).real
        yield heights / heights.std()


def bootstrap(statistic, *samples, repeats=200):
    """Value and bootstrap error of a statistic over common rows."""
    rng = np.random.default_rng(0)
    picks = rng.integers(0, len(samples[0]), (repeats, len(samples[0])))
    again = [statistic(*(s[pick] for s in samples)) for pick in picks]
    return statistic(*samples), np.std(again, axis=0, ddof=1)


def unexplained(values, controls):
    """Share of the variance that a linear fit to the controls leaves, per degree of freedom."""
    design = np.column_stack([np.ones(len(values)), controls])
    residual = values - design @ np.linalg.lstsq(design, values, rcond=None)[0]
    return np.sum(residual**2, 0) / (len(values) - design.shape[1]) / values.var(0, ddof=1)


def own(values, controls):
    """The same, every quantity having the like one as its only control."""
    columns = [unexplained(values[:, [k]], controls[:, [k]])[0] for k in range(values.shape[1])]
    return np.array(columns)


class Table:
    """Rows of the study; prints as it goes."""

    def __init__(self):
        self.rows = []

    def add(self, name, estimates, cost, share, error, solves):
        self.rows.append((name, estimates, cost, share, error, solves))
        numbers = "  ".join(f"{v:8.4f}+-{e:6.4f}" for v, e in zip(share, error, strict=True))
        print(f"{name:34s} {solves:>8s} {cost:7.3f}  {numbers}", flush=True)

    def dataset(self):
        names, estimates, cost, share, error, solves = zip(*self.rows, strict=True)
        return xr.Dataset(
            {
                "estimates": ("choice", list(estimates)),
                "solves": ("choice", list(solves)),
                "cost": ("choice", list(cost)),
                "variance": (("choice", "quantity"), np.array(share)),
                "variance_error": (("choice", "quantity"), np.array(error)),
                "variance_times_cost": (
                    ("choice", "quantity"),
                    np.array(share) * np.array(cost)[:, None],
                ),
            },
            coords={"choice": list(names), "quantity": list(QUANTITIES)},
        )


def ensembles(case, fine, seconds, table):
    """Choices that draw the seeds in another way: variance of the mean of eight solutions."""
    plain = fine.var(0, ddof=1)
    seeds = np.arange(1, len(fine) + 1)
    fixed, cost = sampled(lambda k: case.measured(case.heights(k, amplitudes="fixed")), seeds)
    share, error = bootstrap(lambda a, b: b.var(0, ddof=1) / a.var(0, ddof=1), fine, fixed)
    print("  mean of fixed amplitudes over Gaussian:", np.round(fixed.mean(0) / fine.mean(0), 3))
    table.add("fixed amplitudes", "fixed-amplitude ensemble", cost / seconds, share, error, "8")
    mirrored, _ = sampled(lambda k: case.measured(-case.heights(k)), seeds)

    def of_pairs(a, b):
        return 2 * ((a + b) / 2).var(0, ddof=1) / a.var(0, ddof=1)

    table.add("antithetic pairs h, -h", "Gaussian", 1.0, *bootstrap(of_pairs, fine, mirrored), "8")
    sets = len(fine) // PLAIN
    means = [
        np.mean([case.measured(h) for h in stratified(case, PLAIN, r)], axis=0) for r in range(sets)
    ]
    share, error = bootstrap(lambda m: m.var(0, ddof=1) / (plain / PLAIN), np.array(means))
    table.add("stratified longest waves (Sobol)", "Gaussian", 1.0, share, error, "8")


def controls(case, fine, seconds, coarse, coarse_seconds, table):
    """Share of the variance left if the mean of the control were known, and cost of the control."""
    seeds = np.arange(1, len(fine) + 1)
    some = seeds[: min(64, len(seeds))]
    values, cost = sampled(lambda k: case.theory(case.heights(k, 2)), some)
    share = bootstrap(own, fine[: len(some)], values)
    table.add("control: theory, realised lattice", "Gaussian", cost / seconds, *share, "control")
    for magnification in (4, 8, 16, 32):
        if magnification < case.magnification:
            values, cost = sampled(
                lambda k, m=magnification: case.measured(case.heights(k, 4, m), 1e-4), seeds
            )
            name = f"control: magnification {magnification}"
            table.add(name, "Gaussian", cost / seconds, *bootstrap(own, fine, values), "control")
            pair = bootstrap(lambda a, b: unexplained(a, b[:, [0, 1, 4]]), fine, values)
            table.add(f"{name}, 3 of it", "Gaussian", cost / seconds, *pair, "control")
    x, cost = described(case, seeds)
    share = bootstrap(unexplained, fine, x)
    table.add("control: 7 long-wave descriptors", "Gaussian", cost / seconds, *share, "control")
    share = bootstrap(own, fine, coarse)
    cost = coarse_seconds / seconds
    table.add("control: 2 pixels per wavelength", "Gaussian", cost, *share, "control")


def described(case, seeds):
    start = time.process_time()
    x = multilevel.descriptors(case.spectrum(), case.length, seeds)
    return x, (time.process_time() - start) / len(x)


def experiments(case, chosen, fine, seconds, coarse, coarse_seconds, table):
    """Independent repetitions of whole experiments, against their own standard errors."""
    seeds = np.arange(chosen.pool) + POOL
    many, _ = sampled(lambda k: case.measured(case.heights(k, 2), 1e-4), seeds)
    x, _ = described(case, seeds)
    sets = len(fine) // 2
    elsewhere, cost = described(case, np.arange(sets * chosen.descriptors) + DRAWS)
    elsewhere = elsewhere.reshape(sets, chosen.descriptors, -1)
    everything = multilevel.multilevel_mean(
        fine, coarse, many, x, elsewhere.reshape(-1, x.shape[1])
    )
    print("  best mean     ", np.round(everything.mean, 5))
    print("  standard error", np.round(everything.standard_error, 5))
    print("  plain mean    ", np.round(fine.mean(0), 5), "of the same fine seeds")
    for few, pool in DESIGNS:
        for with_controls in (False, True):
            repeats = min(len(fine) // few, chosen.pool // pool)
            found = []
            for r in range(repeats):
                a, b = slice(r * few, (r + 1) * few), slice(r * pool, (r + 1) * pool)
                last = (x[b], elsewhere[r]) if with_controls else ()
                found.append(multilevel.multilevel_mean(fine[a], coarse[a], many[b], *last))
            spent = few * (seconds + coarse_seconds) + pool * coarse_seconds
            spent += with_controls * chosen.descriptors * cost
            name = f"{few} fine + {pool} coarse" + with_controls * " + descriptors"
            means = np.array([f.mean for f in found])
            plain = fine.var(0, ddof=1) / PLAIN
            share = bootstrap(lambda m, v=plain: m.var(0, ddof=1) / v, means)
            table.add(name, "Gaussian", spent / (PLAIN * seconds), *share, f"{few}+{pool}")
            stated = np.sqrt(np.mean([f.standard_error**2 for f in found], axis=0))
            scatter = means.std(0, ddof=1)
            away = (means.mean(0) - everything.mean) / (scatter / np.sqrt(repeats))
            print(f"  {repeats} times: stated error over scatter", np.round(stated / scatter, 2))
            print("  distance of their mean from the best one in its errors", np.round(away, 1))


def annotated(dataset):
    return datasets.annotate(
        dataset,
        choice=("1", "choice of sampling"),
        quantity=("1", "quantity"),
        estimates=("1", "ensemble whose mean is estimated"),
        solves=("1", "fine solutions, fine + coarse ones, or a control of known mean"),
        cost=("1", "cost over plain seeds: of the experiment, or of one control"),
        variance=(
            "1",
            "variance over that of eight plain seeds, or what a control leaves of it",
        ),
        variance_error=("1", "bootstrap error of the variance"),
        variance_times_cost=("1", "product of the two, of experiments"),
    )


def main():
    chosen = options()
    case, table = Case(chosen), Table()
    seeds = np.arange(1, chosen.seeds + 1)
    fine, seconds = sampled(lambda k: case.measured(case.heights(k)), seeds)
    coarse, coarse_seconds = sampled(lambda k: case.measured(case.heights(k, 2), 1e-4), seeds)
    print(f"H = {case.hurst}, zeta = {case.magnification}, load {case.load}, {seconds:.4f} s/solve")
    print("  standard deviation over mean", np.round(fine.std(0, ddof=1) / fine.mean(0), 3))
    print(f"{'choice':34s} {'solves':>8s} {'cost':>7s}  {'   '.join(QUANTITIES)}")
    unity = np.ones(len(QUANTITIES))
    table.add("plain Gaussian seeds", "Gaussian", 1.0, unity, 0 * unity, "8")
    if not chosen.brief:
        ensembles(case, fine, seconds, table)
        controls(case, fine, seconds, coarse, coarse_seconds, table)
    experiments(case, chosen, fine, seconds, coarse, coarse_seconds, table)
    if chosen.output:
        parameters = {k: v for k, v in vars(chosen).items() if k not in ("output", "brief")}
        datasets.write(
            annotated(table.dataset()),
            chosen.output,
            title="sampling error of ensembles: variance and cost of several choices",
            parameters=parameters,
        )


if __name__ == "__main__":
    main()
