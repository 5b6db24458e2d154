"""Means drawn from files of `measure_seeds`, as a case with given settings would take them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from pipeline.tradeoff.measuring import derived
from stickiness.accuracy import multilevel
from stickiness.accuracy.choice import COARSE_SEEDS, SEEDS
from stickiness.accuracy.error_models import COARSE, Settings
from stickiness.contact import grid_limit

KEPT = ("area_fraction", "mean_gap", "attractive_area", "rms_slope")
LEVEL = ("mean", "standard_error")
FINEST = 32  # pixels of the reference in files of `measure_grids`
FEWEST_FINE = 32  # seeds of a grid that means are drawn from; the finest may have fewer


@dataclass(frozen=True)
class Bank:
    """Values of one surface, the last axis running over loads and all entries of quantities.

    Attributes
    ----------
    fine : dict of (seed, entry) array
        By pixels per shortest wavelength, 2 included.
    coarse, fixed : (seed, entry) array
        More seeds on 2 pixels; seeds of fixed amplitudes on 4.
    controls, elsewhere : (seed, descriptor) array
        Long waves of the coarse seeds and of those that are not solved.
    pressure, quantity : (entry,) array
        What the entries are.
    truth : (entry,) array
        Best estimate of the mean over all surfaces, on the finest grid.
    truth_error : (entry,) array
        Its standard error.
    pool : (entry,) array
        Mean of the fine seeds alone, on the finest grid: what plain means drawn from them scatter
        about.
    offsets : dict of pair of (entry,) arrays
        By pixels, relative error of the mean by the grid, and the standard error of that; none if
        no grid is fine enough to tell.
    """

    fine: dict[int, NDArray]
    coarse: NDArray
    fixed: NDArray
    controls: NDArray
    elsewhere: NDArray
    pressure: NDArray
    quantity: NDArray
    truth: NDArray
    truth_error: NDArray
    pool: NDArray
    offsets: dict[int, tuple[NDArray, NDArray]]

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


class Draws:
    """Repeated estimates from random ones of a bank's seeds.

    Drawn with replacement: a mean of few of them then scatters about that of all as it would about
    that of the whole ensemble. Within one repetition more seeds hold all those of fewer, as the
    rounds of a case do.
    """

    def __init__(self, bank: Bank, repetitions: int, described: int, seed: int = 1):
        rng = np.random.default_rng(seed)
        self.bank, self.levels = bank, {}
        count = min(len(fine) for fine in bank.fine.values() if len(fine) >= FEWEST_FINE)
        self.fine = rng.integers(count, size=(SEEDS[-1], repetitions))
        self.many = rng.integers(len(bank.coarse), size=(repetitions, COARSE_SEEDS[-1]))
        self.others = rng.integers(len(bank.elsewhere), size=(repetitions, described))

    def __call__(self, settings: Settings) -> tuple[NDArray, NDArray]:
        """Relative errors and standard errors of the repetitions, `(repetition, entry)`.

        The standard errors are relative to the mean estimated, the errors to that of the bank.
        """
        bank, chosen = self.bank, self.fine[: settings.seeds]
        fine = bank.fine[settings.pixels_per_wavelength][chosen]
        if settings.coarse_seeds:
            twin, level = bank.fine[COARSE][chosen], self.level(settings.coarse_seeds)
            found, truth = multilevel.corrected_mean(fine, twin, level), bank.truth
        else:
            found, truth = multilevel.plain_mean(fine), bank.pool
        return found.mean / truth - 1, found.standard_error / np.abs(found.mean)

    def level(self, count: int) -> multilevel.Estimate:
        """Means of so many coarse solutions, for all repetitions."""
        if count not in self.levels:
            bank = self.bank
            found = [
                multilevel.controlled_mean(
                    bank.coarse[many[:count]], bank.controls[many[:count]], bank.elsewhere[others]
                )
                for many, others in zip(self.many, self.others, strict=True)
            ]
            parts = (np.array([getattr(one, name) for one in found]) for name in LEVEL)
            self.levels[count] = multilevel.Estimate(*parts, np.empty(0))
        return self.levels[count]


def bank_of(measured: xr.Dataset, finest: xr.Dataset | None = None) -> Bank:
    """`Bank` from a file of `measure_seeds`.

    Parameters
    ----------
    measured
        The file. Its finest grid, of fewer seeds than the others, is the reference of the truth.
    finest
        A file of `measure_grids` of the same surface that holds a finer grid still.
    """
    pixels = [int(p) for p in measured.pixels.values]
    solved = {p: one_grid(measured, p) for p in pixels}
    entries = {p: stacked(derived(one)) for p, one in solved.items()}
    fine = {p: values for p, (values, *_) in entries.items()}
    _, quantity, pressure = entries[COARSE]
    more = {kind: stacked(derived(renamed(measured, kind)))[0] for kind in ("coarse", "fixed")}
    controls, elsewhere = measured.long_waves.values, measured.other_long_waves.values
    if finest is None:
        last, best = pixels[-1], pixels[-2]
        pairs = {best: (fine[best][: len(fine[last])], fine[last])}
    else:
        best, grids = pixels[-1], by_pixels(finest)
        pairs = {p: (grids[p], grids[FINEST]) for p in grids if best <= p < FINEST}
    ratio = pairs[best][1].sum(0) / pairs[best][0].sum(0)
    estimate = multilevel.multilevel_mean(
        fine[best], fine[COARSE], more["coarse"], controls, elsewhere
    )
    return Bank(
        fine=fine,
        **more,
        controls=controls,
        elsewhere=elsewhere,
        pressure=pressure,
        quantity=quantity,
        truth=estimate.mean * ratio,
        truth_error=estimate.standard_error * ratio,
        pool=fine[best].mean(0) * ratio,
        offsets=offsets_of({p: values for p, values in fine.items() if p <= best}, pairs, best)
        if finest is not None or pixels[-1] >= FINEST
        else {},
    )


def offsets_of(fine, pairs, best):
    """Relative errors by the grid and their standard errors; see `Bank`.

    Up to the `best` grid with many seeds against it, from there on with few against the finest.
    """

    def compared(coarse, exact):
        count = len(exact)
        noise = (coarse / exact.mean(0) - exact * coarse.mean(0) / exact.mean(0) ** 2).std(0)
        return coarse.mean(0) / exact.mean(0) - 1, noise / np.sqrt(max(count - 1, 1))

    found = {p: compared(*pair) for p, pair in pairs.items()}
    for p, values in fine.items():
        if p < best:
            off, noise = compared(values, fine[best])
            found[p] = (1 + off) * (1 + found[best][0]) - 1, np.hypot(noise, found[best][1])
    return found


def by_pixels(finest: xr.Dataset) -> dict[int, NDArray]:
    """Values `(seed, entry)` by grid from a file of `measure_grids`."""
    grids = finest.isel(setting=np.flatnonzero(finest.knob == "pixels"))
    pixels = grids.pixels.values
    solved = {int(p): grids.isel(setting=int(np.argmax(pixels == p))) for p in pixels}
    return {
        p: stacked(derived(one.assign(attractive_area=extrapolated(solved[p // 2], one))))[0]
        for p, one in solved.items()
        if p // 2 in solved
    }


def one_grid(measured: xr.Dataset, pixels: int) -> xr.Dataset:
    """Solutions on one grid, of all seeds that have them, in the limit of fine grids."""
    one = measured.sel(pixels=pixels)
    one = one.isel(seed=np.flatnonzero(one.area_fraction.notnull().all("pressure").values))
    if pixels == COARSE:
        return one
    half = measured.sel(pixels=pixels // 2, seed=one.seed)
    return one.assign(attractive_area=extrapolated(half, one))


def extrapolated(half: xr.Dataset, one: xr.Dataset) -> xr.DataArray:
    """Attractive areas, extrapolated from below the edge gap as those of ensembles are."""
    edge_gap = one.edge_gap.mean("seed")
    return grid_limit.estimate(
        "attractive_area",
        [half.attractive_area, one.attractive_area],
        one.attractive_area - one.pixel_attractive_area,
        one.edges,
        (one["range"] / edge_gap).where(edge_gap > 0, np.inf),
    ).value


def renamed(measured: xr.Dataset, kind: str) -> xr.Dataset:
    """More seeds of a kind under the names of the fine ones."""
    names = {f"{kind}_{name}": name for name in (*KEPT, "seed")}
    return measured[[f"{kind}_{name}" for name in KEPT]].rename(names)


def stacked(quantities: dict[str, xr.DataArray]) -> tuple[NDArray, NDArray, NDArray]:
    """Values `(seed, entry)` of all quantities at all loads, and quantity and load of an entry."""
    values, names, loads = [], [], []
    for name, of_seeds in quantities.items():
        of_seeds = of_seeds.transpose("seed", "pressure", ...)
        flat = of_seeds.values.reshape(of_seeds.shape[:2] + (-1,))
        values.append(flat.reshape(len(flat), -1))
        names += [name] * (flat.shape[1] * flat.shape[2])
        loads += list(np.repeat(of_seeds.pressure.values, flat.shape[2]))
    return np.concatenate(values, axis=1), np.array(names), np.array(loads)
