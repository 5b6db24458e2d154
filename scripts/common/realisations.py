"""Files of a few realisations each: one after the other, and joined along `seed`."""

from collections.abc import Callable, Iterable, Sequence

import xarray as xr
from numpy.typing import NDArray

from stickiness import datasets


def each_seed(
    solve: Callable[[NDArray], xr.Dataset], surfaces: xr.Dataset, seeds: Sequence[int]
) -> xr.Dataset:
    """What `solve` makes of the heights of every seed, with the rms slope of the heights."""
    solved = [solve(surfaces.height.sel(seed=seed).values) for seed in seeds]
    dataset = xr.concat(solved, xr.DataArray(list(seeds), dims="seed", name="seed"))
    dataset["rms_slope"] = surfaces.rms_slope.sel(source="heights", seed=list(seeds), drop=True)
    return dataset


def read_first(path: str) -> xr.Dataset:
    """The first realisation in a file of surfaces."""
    return datasets.read(path, ["height", "window_length"]).isel(seed=0)


def read_all(paths: Iterable[str], variables: Iterable[str]) -> xr.Dataset:
    """The realisations of all files, with the attributes of the first."""
    return xr.concat([datasets.read(path, variables) for path in paths], "seed")
