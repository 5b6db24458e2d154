"""Pools of solved seeds from files of `measure_contact`, and means resampled from them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from stickiness.accuracy import multilevel
from stickiness.accuracy.error_models import COARSE, Settings
from stickiness.accuracy.settings import COARSE_SEEDS, SEEDS
from stickiness.repulsive import richardson
from tradeoff.measuring import derive_columns

KEPT = ("area_fraction", "mean_gap", "attractive_area", "rms_slope")
LEVEL = ("mean", "standard_error")
FEWEST_FINE = 32  # seeds of a grid that means are drawn from; the finest may have fewer


@dataclass(frozen=True)
class SeedPool:
    """Solved seeds of one surface, the last axis running over loads and entries of quantities.

    Attributes
    ----------
    fine : dict of (seed, entry) array
        By pixels per shortest wavelength, 2 included.
    coarse : (seed, entry) array
        More seeds on 2 pixels.
    controls, elsewhere : (seed, descriptor) array
        Descriptors of the long waves of the coarse seeds and of those that are not solved.
    pressure, quantity : (entry,) array
        What the entries are.
    truth : (entry,) array
        Best estimate of the mean over all surfaces, on the finest grid.
    truth_error : (entry,) array
        Its standard error.
    fine_mean : (entry,) array
        Mean of the fine seeds alone, on the finest grid, about which plain means drawn from them
        scatter.
    grid_errors : dict of pair of (entry,) arrays
        By pixels, relative error of the mean by the grid, and its standard error.
    """

    fine: dict[int, NDArray]
    coarse: NDArray
    controls: NDArray
    elsewhere: NDArray
    pressure: NDArray
    quantity: NDArray
    truth: NDArray
    truth_error: NDArray
    fine_mean: NDArray
    grid_errors: dict[int, tuple[NDArray, NDArray]]

    def by_quantity(self, errors: NDArray) -> dict[tuple[str, float], NDArray]:
        """Root mean square over the entries of each quantity at each load; leading axes stay."""
        keys = dict.fromkeys(zip(self.quantity.tolist(), self.pressure.tolist(), strict=True))
        return {
            (quantity, load): np.sqrt(
                np.mean(
                    errors[..., (self.quantity == quantity) & (self.pressure == load)] ** 2, axis=-1
                )
            )
            for quantity, load in keys
        }


class Resampling:
    """Repeated estimates from random seeds of a pool.

    Seeds are drawn with replacement: a mean of few of them then scatters about that of all as it
    would about that of the whole ensemble. Within one repetition more seeds hold all those of
    fewer, as the rounds of a case do.
    """

    def __init__(self, pool: SeedPool, repetitions: int, described: int, seed: int = 1):
        rng = np.random.default_rng(seed)
        self.pool, self.levels = pool, {}
        count = min(len(fine) for fine in pool.fine.values() if len(fine) >= FEWEST_FINE)
        self.fine = rng.integers(count, size=(SEEDS[-1], repetitions))
        self.many = rng.integers(len(pool.coarse), size=(repetitions, COARSE_SEEDS[-1]))
        self.others = rng.integers(len(pool.elsewhere), size=(repetitions, described))

    def draw(self, settings: Settings) -> tuple[NDArray, NDArray]:
        """Relative errors and standard errors of the repetitions, `(repetition, entry)`.

        The standard errors are relative to the mean estimated, the errors to that of the pool.
        """
        pool, chosen = self.pool, self.fine[: settings.seeds]
        fine = pool.fine[settings.pixels_per_wavelength][chosen]
        if settings.coarse_seeds:
            twin, level = pool.fine[COARSE][chosen], self.solve_level(settings.coarse_seeds)
            found, truth = multilevel.corrected_mean(fine, twin, level), pool.truth
        else:
            found, truth = multilevel.plain_mean(fine), pool.fine_mean
        return found.mean / truth - 1, found.standard_error / np.abs(found.mean)

    def solve_level(self, count: int) -> multilevel.Estimate:
        """Estimate the means of so many coarse solutions, for all repetitions."""
        if count not in self.levels:
            pool = self.pool
            found = [
                multilevel.controlled_mean(
                    pool.coarse[many[:count]], pool.controls[many[:count]], pool.elsewhere[others]
                )
                for many, others in zip(self.many, self.others, strict=True)
            ]
            parts = (np.array([getattr(one, name) for one in found]) for name in LEVEL)
            self.levels[count] = multilevel.Estimate(*parts, np.empty(0))
        return self.levels[count]


def make_pool(measured: xr.Dataset) -> SeedPool:
    """Make the pool of a file of `measure_contact`.

    Its finest grid, with fewer seeds than the others, is the reference of the truth.
    """
    pixels = [int(p) for p in measured.pixels.values]
    entries = {p: flatten(derive_columns(select_grid(measured, p))) for p in pixels}
    fine = {p: values for p, (values, *_) in entries.items()}
    _, quantity, pressure = entries[COARSE]
    coarse = flatten(derive_columns(rename_seeds(measured, "coarse")))[0]
    controls, elsewhere = measured.long_waves.values, measured.other_long_waves.values
    best, last = pixels[-2:]
    pairs = {best: (fine[best][: len(fine[last])], fine[last])}
    ratio = pairs[best][1].sum(0) / pairs[best][0].sum(0)
    estimate = multilevel.multilevel_mean(fine[best], fine[COARSE], coarse, controls, elsewhere)
    return SeedPool(
        fine=fine,
        coarse=coarse,
        controls=controls,
        elsewhere=elsewhere,
        pressure=pressure,
        quantity=quantity,
        truth=estimate.mean * ratio,
        truth_error=estimate.standard_error * ratio,
        fine_mean=fine[best].mean(0) * ratio,
        grid_errors=measure_grid_errors(
            {p: values for p, values in fine.items() if p <= best}, pairs, best
        ),
    )


def measure_grid_errors(fine, pairs, best):
    """Relative errors by the grid and their standard errors; see `SeedPool`.

    Up to the `best` grid with many seeds against it, from there on with few against the finest.
    """

    def compare(coarse, exact):
        count = len(exact)
        noise = (coarse / exact.mean(0) - exact * coarse.mean(0) / exact.mean(0) ** 2).std(0)
        return coarse.mean(0) / exact.mean(0) - 1, noise / np.sqrt(max(count - 1, 1))

    found = {p: compare(*pair) for p, pair in pairs.items()}
    for p, values in fine.items():
        if p < best:
            off, noise = compare(values, fine[best])
            found[p] = (1 + off) * (1 + found[best][0]) - 1, np.hypot(noise, found[best][1])
    return found


def select_grid(measured: xr.Dataset, pixels: int) -> xr.Dataset:
    """Select one grid and the seeds solved on it; areas are in the limit of fine grids."""
    one = measured.sel(pixels=pixels)
    one = one.isel(seed=np.flatnonzero(one.area_fraction.notnull().all("pressure").values))
    if pixels == COARSE:
        return one
    half = measured.sel(pixels=pixels // 2, seed=one.seed)
    return one.assign(attractive_area=extrapolate_area(half, one))


def extrapolate_area(half: xr.Dataset, one: xr.Dataset) -> xr.DataArray:
    """Extrapolate attractive areas from below the edge gap, as those of ensembles are."""
    edge_gap = one.edge_gap.mean("seed")
    return richardson.estimate(
        "attractive_area",
        [half.attractive_area, one.attractive_area],
        one.attractive_area - one.pixel_attractive_area,
        one.edges,
        (one["range"] / edge_gap).where(edge_gap > 0, np.inf),
    ).value


def rename_seeds(measured: xr.Dataset, kind: str) -> xr.Dataset:
    """Give more seeds of a kind the names of the fine ones."""
    names = {f"{kind}_{name}": name for name in (*KEPT, "seed")}
    return measured[[f"{kind}_{name}" for name in KEPT]].rename(names)


def flatten(quantities: dict[str, xr.DataArray]) -> tuple[NDArray, NDArray, NDArray]:
    """Flatten all quantities at all loads to `(seed, entry)`; quantity and load of each entry."""
    values, names, loads = [], [], []
    for name, of_seeds in quantities.items():
        of_seeds = of_seeds.transpose("seed", "pressure", ...)
        flat = of_seeds.values.reshape(of_seeds.shape[:2] + (-1,))
        values.append(flat.reshape(len(flat), -1))
        names += [name] * (flat.shape[1] * flat.shape[2])
        loads += list(np.repeat(of_seeds.pressure.values, flat.shape[2]))
    return np.concatenate(values, axis=1), np.array(names), np.array(loads)
