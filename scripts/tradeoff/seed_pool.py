"""Pools of solved seeds from files of `measure_contact`, and means resampled from them."""

from dataclasses import dataclass, field

import numpy as np

from common.contact_curves import SOLVED_FROM
from stickiness import datasets
from stickiness.accuracy import multilevel
from stickiness.accuracy.error_models import COARSE
from stickiness.accuracy.settings import COARSE_SEEDS, SEEDS
from stickiness.repulsive import richardson
from tradeoff.measuring import derive_columns, select

FEWEST_FINE = 32  # seeds of a grid that means are drawn from; the finest may have fewer
REPETITIONS = 60  # of means that are resampled
DESCRIBED_SEEDS = 2048


@dataclass
class SeedPool:
    """Solved seeds of one surface; an entry is one load of one column of a quantity."""

    fine: dict  # (seed, entry), by pixels per shortest wavelength, 2 included
    coarse: np.ndarray  # (seed, entry): more seeds on 2 pixels
    controls: np.ndarray  # (seed, descriptor): long waves of the coarse seeds
    elsewhere: np.ndarray  # (seed, descriptor): long waves of seeds that are not solved
    pressure: np.ndarray  # of the entries
    quantity: np.ndarray
    truth: np.ndarray  # best estimate of the mean over all surfaces, on the finest grid
    truth_error: np.ndarray  # its standard error
    fine_mean: np.ndarray  # mean of the fine seeds alone, about which their plain means scatter
    costs: dict = field(default_factory=dict)  # of all loads of a seed, by pixels or kind

    def by_quantity(self, errors):
        """Root mean square over the entries of each quantity at each load; leading axes stay."""
        keys = dict.fromkeys(zip(self.quantity.tolist(), self.pressure.tolist(), strict=True))
        found = {}
        for quantity, load in keys:
            entries = (self.quantity == quantity) & (self.pressure == load)
            found[quantity, load] = np.sqrt(np.mean(errors[..., entries] ** 2, axis=-1))
        return found

    def cost(self, settings):
        """Measured cost of a mean at all loads, without what a larger tolerance saves."""
        pixels = settings.pixels_per_wavelength
        total = settings.seeds * sum(self.costs[p] for p in {pixels, pixels // 2, COARSE})
        if settings.coarse_seeds:
            total += settings.coarse_seeds * self.costs["coarse"]
            total += DESCRIBED_SEEDS * self.costs["described"]
        return total


class Resampling:
    """Repeated estimates from random seeds of a pool."""

    def __init__(self, pool, repetitions=REPETITIONS, described=DESCRIBED_SEEDS):
        # With replacement: means of few seeds then scatter about the mean of all as they would
        # about the mean of the whole ensemble. More seeds include those of fewer, as in a case.
        rng = np.random.default_rng(1)
        self.pool, self.levels = pool, {}
        count = min(len(fine) for fine in pool.fine.values() if len(fine) >= FEWEST_FINE)
        self.fine = rng.integers(count, size=(SEEDS[-1], repetitions))
        self.many = rng.integers(len(pool.coarse), size=(repetitions, COARSE_SEEDS[-1]))
        self.others = rng.integers(len(pool.elsewhere), size=(repetitions, described))

    def draw(self, settings):
        """Relative errors of the means of every repetition, by quantity and load."""
        pool, chosen = self.pool, self.fine[: settings.seeds]
        fine, truth = pool.fine[settings.pixels_per_wavelength][chosen], pool.fine_mean
        mean = fine.mean(0)
        if count := settings.coarse_seeds:
            if count not in self.levels:
                self.levels[count] = self._average_coarse(count)
            twin, truth = pool.fine[COARSE][chosen], pool.truth
            mean = multilevel.corrected_mean(fine, twin, self.levels[count]).mean
        return pool.by_quantity(mean / truth - 1)

    def _average_coarse(self, count):
        pool = self.pool
        found = [
            multilevel.controlled_mean(
                pool.coarse[many[:count]], pool.controls[many[:count]], pool.elsewhere[others]
            )
            for many, others in zip(self.many, self.others, strict=True)
        ]
        mean, error = (np.array([getattr(e, k) for e in found]) for k in ("mean", "standard_error"))
        return multilevel.Estimate(mean, error, np.empty(0))


def make_pool(measured):
    """Make the pool of a file of `measure_contact`, and find its errors by the grid.

    The finest grid, which has fewer seeds, is the reference. The relative errors of the mean of
    every entry come with their standard error, by pixels.
    """
    usual = datasets.parameters(measured)["tolerance"]
    is_fine = (measured.seed < SOLVED_FROM).values
    fine_ones, coarse_ones = (
        measured.isel(solution=np.flatnonzero(k)) for k in (is_fine, ~is_fine)
    )
    *_, best, last = pixels = np.unique(measured.pixels).tolist()
    solved = {p: select(fine_ones, p, usual) for p in pixels}
    more, unit = select(coarse_ones, COARSE, usual), float(measured.pair_time)
    entries = {p: flatten(derive_columns(extrapolate(solved, p))) for p in pixels}
    fine = {p: values for p, (values, *_) in entries.items()}
    _, quantity, pressure = entries[COARSE]
    coarse = flatten(derive_columns(more))[0]
    controls, elsewhere = measured.long_waves.values, measured.other_long_waves.values
    few = fine[best][: len(fine[last])]
    ratio = fine[last].sum(0) / few.sum(0)
    estimate = multilevel.multilevel_mean(fine[best], fine[COARSE], coarse, controls, elsewhere)
    costs = {p: float(one.seconds.mean()) / unit for p, one in solved.items()}
    costs |= {
        "coarse": float(more.seconds.mean()) / unit,
        "described": float(measured.describing_seconds) / unit,
    }
    # Up to the `best` grid with many seeds against it, from there on with few against the finest.
    grid_errors = {best: compare_means(few, fine[last])}
    for p in pixels[:-2]:
        off, noise = compare_means(fine[p], fine[best])
        first, its_noise = grid_errors[best]
        grid_errors[p] = (1 + off) * (1 + first) - 1, np.hypot(noise, its_noise)
    pool = SeedPool(
        *(fine, coarse, controls, elsewhere, pressure, quantity),
        *(estimate.mean * ratio, estimate.standard_error * ratio, fine[best].mean(0) * ratio),
        costs,
    )
    return pool, grid_errors


def compare_means(coarse, exact):
    """Relative difference of two means over the same seeds, and its standard error."""
    noise = (coarse / exact.mean(0) - exact * coarse.mean(0) / exact.mean(0) ** 2).std(0)
    return coarse.mean(0) / exact.mean(0) - 1, noise / np.sqrt(max(len(exact) - 1, 1))


def extrapolate(solved, pixels):
    """Solutions on one grid, attractive areas in the limit of fine grids, as in ensembles."""
    one = solved[pixels]
    if pixels == COARSE:
        return one
    edge_gap, half = one.edge_gap.mean("seed"), solved[pixels // 2].sel(seed=one.seed)
    limit = richardson.estimate(
        "attractive_area",
        [half.attractive_area, one.attractive_area],
        one.attractive_area - one.pixel_attractive_area,
        one.edges,
        (one["range"] / edge_gap).where(edge_gap > 0, np.inf),
    )
    return one.assign(attractive_area=limit.value)


def flatten(quantities):
    """Flatten all quantities at all loads to `(seed, entry)`; quantity and load of each entry."""
    values, names, loads = [], [], []
    for name, of_seeds in quantities.items():
        of_seeds = of_seeds.transpose("seed", "pressure", ...)
        flat = of_seeds.values.reshape(of_seeds.shape[:2] + (-1,))
        values.append(flat.reshape(len(flat), -1))
        names += [name] * (flat.shape[1] * flat.shape[2])
        loads += list(np.repeat(of_seeds.pressure.values, flat.shape[2]))
    return np.concatenate(values, axis=1), np.array(names), np.array(loads)
