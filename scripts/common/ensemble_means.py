"""Mean and errors of quantities with the dimensions `seed` and `resolution`.

A mean stands for the whole ensemble of surfaces that the case's window can hold, Gaussian unless
the case says otherwise. It is the plain one over the seeds, or if there are coarse solutions of
many more seeds the multilevel one of `stickiness.accuracy.multilevel`.
"""

from dataclasses import dataclass, replace
from functools import partial
from typing import NamedTuple

import numpy as np
import xarray as xr

from stickiness.accuracy import multilevel

SUFFIXES = {
    "mean": "ensemble mean",
    "standard_error": "standard error of the ensemble mean",
    "discretisation_error": "change from half the resolution",
}
FEWEST = 8  # seeds from which on a slope fitted to them is better than a ratio
PREFIX = "coarse_"  # of what an ensemble's file keeps of coarse solutions, and of their seeds


class Mean(NamedTuple):
    """A mean over the ensemble, and its standard error."""

    value: xr.DataArray
    standard_error: xr.DataArray


@dataclass(frozen=True)
class Coarse:
    """A quantity of seeds that are solved on the coarsest grid alone, and their long waves."""

    values: xr.DataArray  # along `seed`, without `resolution`
    controls: xr.DataArray  # long waves of these seeds
    elsewhere: xr.DataArray  # and of many more
    # Values of the control for the seeds of the mean; None: those seeds on the coarsest grid. Of
    # another model it is not in proportion: from `FEWEST` seeds on its coefficient is a slope.
    twin: xr.DataArray | None = None


def coarse(ensemble, quantity):
    """Evaluate a quantity on the coarse solutions of an ensemble; None if it has none."""
    if f"{PREFIX}seed" not in ensemble.dims:
        return None
    names = {n: n.removeprefix(PREFIX) for n in ensemble.variables if n.startswith(PREFIX)}
    solved = ensemble[list(names)].rename(names)
    return Coarse(quantity(solved), ensemble.long_waves, ensemble.other_long_waves)


def mean(values):
    """Plain mean over seeds on the fine grid."""
    return fine(values).mean("seed")


def standard_error(values):
    """Sampling error of the plain mean on the fine grid; NaN for a single seed."""
    return scatter(fine(values))


def discretisation_error(values):
    """Change of the mean from half the resolution, for errors of first order in the pixel size."""
    # Changes of either sign would cancel in the mean; the standard error in quadrature prevents it.
    change = fine(values.diff("resolution"))
    return np.hypot(change.mean("seed"), scatter(change).fillna(0))


def ensemble_mean(values, more=None):
    """Mean over the ensemble and its standard error, with `more` solutions on the coarsest grid.

    Plain without them, for a single seed, and, entry by entry, where some seed is not finite. If
    some seeds are missing on the finest grid alone, all seeds give the mean on the next one, and
    those solved on both correct it. The mean of those alone is taken where it is surer.
    """
    on_finest = fine(values).notnull().any(set(values.dims) - {"seed", "resolution"})
    if on_finest.any() and not on_finest.all() and values.sizes["resolution"] > 1:
        return _mean_from_half(values, on_finest, more)
    plain = Mean(mean(values), standard_error(values))
    if more is None or values.sizes["seed"] == 1:
        return plain

    # The values on the coarsest grid, or those of another model, of the same seeds.
    if more.twin is None:
        twin = values.isel(resolution=0, drop=True)
        combine = multilevel.multilevel_mean
    else:
        twin = more.twin
        combine = partial(multilevel.multilevel_mean, fewest=FEWEST)

    # As arrays with the seed first, zero in entries that are not finite in every seed.
    few = fine(values).transpose("seed", ...)
    dims = few.dims
    twin = twin.transpose(*dims)
    many = more.values.transpose(*dims)
    finite = np.all([np.isfinite(part).all("seed").values for part in (few, twin, many)], axis=0)
    combined = combine(
        fine=np.where(finite, few.values, 0.0),
        coarse=np.where(finite, twin.values, 0.0),
        many=np.where(finite, many.values, 0.0),
        controls=more.controls.values,
        elsewhere=more.elsewhere.values,
    )

    # Elsewhere the mean stays plain.
    value = plain.value.transpose(*dims[1:])
    error = plain.standard_error.transpose(*dims[1:])
    return Mean(
        value.copy(data=np.where(finite, combined.mean, value.values)),
        error.copy(data=np.where(finite, combined.standard_error, error.values)),
    )


def _mean_from_half(values, on_finest, more):
    """As `ensemble_mean`, with the seeds that are solved on both of the finest grids."""
    # The mean of these seeds alone.
    seeds = values[{"seed": on_finest}]
    more_of_seeds = more
    if more is not None and more.twin is not None:
        more_of_seeds = replace(more, twin=more.twin[{"seed": on_finest}])
    value, error = ensemble_mean(seeds, more_of_seeds)

    # The mean of all seeds on half the grid, corrected by these seeds.
    half = ensemble_mean(values.isel(resolution=slice(-1)), more)
    level = multilevel.Estimate(half.value.values, half.standard_error.values, np.nan)
    few = seeds[{"resolution": -1}].transpose("seed", ...).values
    twin = seeds[{"resolution": -2}].transpose("seed", ...).values
    one_sign = np.all(twin >= 0, axis=0) | np.all(twin <= 0, axis=0)
    corrected = multilevel.corrected_mean(few, twin, level, one_sign)

    surer = corrected.standard_error < error.values
    return Mean(
        value.copy(data=np.where(surer, corrected.mean, value.values)),
        error.copy(data=np.where(surer, corrected.standard_error, error.values)),
    )


def add_errors(dataset, name, values, more=None, plain=False, correction=None):
    """Add ``NAME_mean`` (`plain`: ``NAME``) of `values` to a dataset, and its `SUFFIXES`.

    `more` is the same of coarse solutions, see `coarse`. A `continuum_values.Limit` takes mean and
    discretisation error to the limit of fine grids; without it that error is the change from half
    the resolution.
    """
    value, error = ensemble_mean(values, more)
    if correction is None:
        left = discretisation_error(values)
    else:
        value = value + correction.shift
        left = correction.error
    return dataset.assign(
        {
            name if plain else f"{name}_mean": value,
            f"{name}_standard_error": error,
            f"{name}_discretisation_error": left.transpose(*value.dims),
        }
    )


def describe_errors(quantities, plain=False, discretisation=SUFFIXES["discretisation_error"]):
    """Describe the variables that `add_errors` adds for `quantities`, which are texts by name."""
    texts = {}
    for name, text in quantities.items():
        mean_text = text if plain else f"{text}: {SUFFIXES['mean']}"
        error = f"{text}: {SUFFIXES['standard_error']}"
        texts[name if plain else f"{name}_mean"] = ("1", mean_text)
        texts[f"{name}_standard_error"] = ("1", error, "a single seed")
        texts[f"{name}_discretisation_error"] = ("1", f"{text}: {discretisation}")
    return texts


def fine(values):
    """Values on the finest grid."""
    return values.isel(resolution=-1, drop=True)


def scatter(values):
    """Standard error of a plain mean over seeds; NaN for a single seed."""
    if values.sizes["seed"] == 1:
        return values.mean("seed") * np.nan
    return values.std("seed", ddof=1) / np.sqrt(values.count("seed"))
