"""Mean and errors of quantities with the dimensions `seed` and `resolution`.

A mean stands for the whole ensemble of surfaces that the case's window can hold, Gaussian unless
the case says otherwise. It is the plain one over the seeds, or if there are coarse solutions of
many more seeds the multilevel one of `stickiness.accuracy.multilevel`.
"""

from dataclasses import dataclass, replace

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


@dataclass(frozen=True)
class Coarse:
    """A quantity of seeds that are solved on the coarsest grid alone, and their long waves."""

    values: xr.DataArray  # along `seed`, without `resolution`
    controls: xr.DataArray  # long waves of these seeds
    elsewhere: xr.DataArray  # and of many more
    # For the seeds of the mean, by default their values on the coarsest grid. From another model
    # it is not proportional to the values: from `FEWEST` seeds on its coefficient is a slope.
    twin: xr.DataArray | None = None


def coarse(ensemble, quantity):
    """A quantity of the coarse solutions of an ensemble, under names of fine ones; None without."""
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
    # In quadrature with the standard error, changes of either sign do not cancel.
    change = fine(values.diff("resolution"))
    return np.hypot(change.mean("seed"), scatter(change).fillna(0))


def ensemble_mean(values, more=None):
    """Mean over the ensemble and its standard error, with `more` solutions on the coarsest grid.

    Plain without them, for a single seed, and in entries that are not finite in every seed. If some
    seeds are missing on the finest grid alone, all seeds give the mean on the next one. The others
    correct it, wherever that has a smaller standard error than the mean of the others.
    """
    both = fine(values).notnull().any(set(values.dims) - {"seed", "resolution"})
    if both.any() and not both.all() and values.sizes["resolution"] > 1:
        return _mean_from_half(values, both, more)
    plain, count = (mean(values), standard_error(values)), values.sizes["seed"]
    if more is None or count == 1:
        return plain
    few = fine(values).transpose("seed", ...)
    twin, slopes = more.twin, {"fewest": FEWEST}
    if twin is None:
        twin, slopes = values.isel(resolution=0, drop=True), {}
    solved = [part.transpose(*few.dims) for part in (few, twin, more.values)]
    finite = np.all([np.isfinite(part).all("seed").values for part in solved], axis=0)
    solved = [np.where(finite, part.values, 0.0) for part in solved]
    waves = more.controls.values, more.elsewhere.values
    found = multilevel.multilevel_mean(*solved, *waves, **slopes)
    best, error = (part.transpose(*few.dims[1:]) for part in plain)
    return (
        best.copy(data=np.where(finite, found.mean, best.values)),
        error.copy(data=np.where(finite, found.standard_error, error.values)),
    )


def _mean_from_half(values, both, more):
    """As `ensemble_mean`, with the seeds that are solved on both of the finest grids."""
    others, fewer = values[{"seed": both}], more
    if more is not None and more.twin is not None:
        fewer = replace(more, twin=more.twin[{"seed": both}])
    best, error = ensemble_mean(others, fewer)
    half = ensemble_mean(values.isel(resolution=slice(-1)), more)
    few, twin = (others[{"resolution": k}].transpose("seed", ...).values for k in (-1, -2))
    one_sign = np.all(twin >= 0, axis=0) | np.all(twin <= 0, axis=0)
    level = multilevel.Estimate(*(part.values for part in half), np.nan)
    found = multilevel.corrected_mean(few, twin, level, one_sign)
    surer = found.standard_error < error.values
    return (
        best.copy(data=np.where(surer, found.mean, best.values)),
        error.copy(data=np.where(surer, found.standard_error, error.values)),
    )


def add_errors(dataset, name, values, more=None, plain=False, limit=None):
    """Add ``NAME_mean`` (`plain`: ``NAME``) of `values` to a dataset, and its `SUFFIXES`.

    `more` is the same of coarse solutions, see `coarse`. A `grid_limits.Limit` takes mean and
    discretisation error to the limit of fine grids; else that is the change from half of it.
    """
    best, error = ensemble_mean(values, more)
    best = best if limit is None else best + limit.shift
    left = discretisation_error(values) if limit is None else limit.error
    return dataset.assign(
        {
            name if plain else f"{name}_mean": best,
            f"{name}_standard_error": error,
            f"{name}_discretisation_error": left.transpose(*best.dims),
        }
    )


def describe_errors(quantities, plain=False, discretisation=SUFFIXES["discretisation_error"]):
    """Texts of what `add_errors` adds for `quantities`, texts by names."""
    texts = {}
    for name, text in quantities.items():
        mean_text = text if plain else f"{text}: {SUFFIXES['mean']}"
        error = f"{text}: {SUFFIXES['standard_error']}"
        texts[name if plain else f"{name}_mean"] = ("1", mean_text)
        texts[f"{name}_standard_error"] = ("1", error, "a single seed")
        texts[f"{name}_discretisation_error"] = ("1", f"{text}: {discretisation}")
    return texts


def fine(values):
    return values.isel(resolution=-1, drop=True)


def scatter(values):
    if values.sizes["seed"] == 1:
        return values.mean("seed") * np.nan
    return values.std("seed", ddof=1) / np.sqrt(values.count("seed"))
