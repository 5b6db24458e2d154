"""Means drawn from files of `measure_seeds`, as a case with given settings would take them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from _tradeoff import derived
from stickiness import continuum, sampling
from stickiness.accuracy import COARSE, Settings

KEPT = ("area_fraction", "mean_gap", "attractive_area", "rms_slope")


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

    def mean(self, pixels: int, rng: np.random.Generator, n: int, coarse: int, described: int):
        """Estimate from random ones of the seeds; plain if no coarse ones are asked for.

        Drawn with replacement: a mean of few of them then scatters about that of all as it would
        about that of the whole ensemble.
        """
        fine = self.fine[pixels]
        chosen = rng.choice(len(fine), n, replace=True)
        if not coarse:
            return fine[chosen].mean(0)
        many = rng.choice(len(self.coarse), coarse, replace=True)
        others = rng.choice(len(self.elsewhere), described, replace=True)
        return sampling.multilevel_mean(
            fine[chosen],
            self.fine[COARSE][chosen],
            self.coarse[many],
            self.controls[many],
            self.elsewhere[others],
        ).mean

    def errors(
        self, settings: Settings, repetitions: int, described: int, seed: int = 1
    ) -> NDArray:
        """Relative errors of repeated estimates, `(repetition, entry)`."""
        rng = np.random.default_rng(seed)
        chosen = settings.pixels_per_wavelength, rng, settings.seeds, settings.coarse_seeds
        found = [self.mean(*chosen, described) for _ in range(repetitions)]
        return np.array(found) / (self.truth if settings.coarse_seeds else self.pool) - 1

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
        ratio = fine[last].sum(0) / fine[best][: len(fine[last])].sum(0)
    else:
        best = pixels[-1]
        grids = finest.isel(setting=np.flatnonzero(finest.knob == "pixels"))
        at = [grids.isel(setting=int(np.argmax(grids.pixels.values == p))) for p in (best, 32)]
        ratio = np.divide(*(stacked(derived(one))[0].sum(0) for one in reversed(at)))
    estimate = sampling.multilevel_mean(
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
    )


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
    return continuum.estimate(
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
