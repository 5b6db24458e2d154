"""Mean and errors of quantities with the dimensions `seed` and `resolution`."""

import numpy as np

SUFFIXES = {
    "mean": "mean over seeds",
    "standard_error": "standard error of the mean over seeds",
    "discretisation_error": "change from half the resolution",
}


def mean(values):
    """Mean over seeds on the fine grid."""
    return fine(values).mean("seed")


def standard_error(values):
    """Sampling error of the mean on the fine grid; NaN for a single seed."""
    return scatter(fine(values))


def discretisation_error(values):
    """Discretisation error of the mean, from the change between the coarse and the fine grid.

    The mean change and its own standard error in quadrature, so that changes of either sign do
    not cancel to nothing. With an error that falls at least in proportion to the pixel size, the
    change bounds what is left.
    """
    change = values.diff("resolution").isel(resolution=-1, drop=True)
    bias = change.mean("seed")
    return np.hypot(bias, scatter(change).fillna(0))


def with_errors(dataset, name, values, plain=False):
    """Add mean, standard error and discretisation error of `values` to a dataset.

    They are called ``NAME_mean``, ``NAME_standard_error`` and ``NAME_discretisation_error``; with
    `plain` the mean is just ``NAME``.
    """
    return dataset.assign(
        {
            name if plain else f"{name}_mean": mean(values),
            f"{name}_standard_error": standard_error(values),
            f"{name}_discretisation_error": discretisation_error(values),
        }
    )


def described(name, text, plain=False, units="1"):
    """Texts for `datasets.annotate` of what `with_errors` adds."""
    texts = {
        f"{name}_{suffix}": (units, f"{text}: {meaning}") for suffix, meaning in SUFFIXES.items()
    }
    texts[f"{name}_standard_error"] += ("a single seed",)
    if plain:
        texts[name] = (units, text)
        del texts[f"{name}_mean"]
    return texts


def fine(values):
    return values.isel(resolution=-1, drop=True)


def scatter(values):
    count = values.sizes["seed"]
    if count == 1:
        return values.mean("seed") * np.nan
    return values.std("seed", ddof=1) / np.sqrt(count)
