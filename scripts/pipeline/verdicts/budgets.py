"""Error budgets of verdicts: by the spectrum, by a_V and by the model of what remains."""

from dataclasses import replace

import numpy as np
import xarray as xr

from pipeline.verdicts.a_v import CLOSED, OF_MODEL, between_limits
from stickiness.core.budget import Part, absent, with_budget
from stickiness.core.statistics import COVERS
from stickiness.criteria.registry import REMAINING


def add_budgets(dataset, constant, draws):
    """Add error budgets to what is quoted of pairs: the spectrum, and the model."""
    dataset = with_budget(dataset, "a_v", **constant.parts(constant.value))
    model = between_limits(dataset, "pair_a_v")
    dataset = with_budget(dataset, "pair_a_v", model=model, **CLOSED)
    rest = CLOSED | {"sampling": None}
    ours = dataset.criterion == REMAINING
    # Ends of a surface that was not measured are two surfaces, each known exactly.
    spectrum = dataset.error_of_spectrum.fillna(0.0)
    text = "of the spectrum measured; none of one end of what is given"
    model = between_limits(dataset, "margin").error.where(ours)
    rest["sampling"] = Part(dataset.margin * np.expm1(COVERS * spectrum).where(ours, 0.0), text)
    others = f"{OF_MODEL}; other criteria state none"
    dataset = with_budget(dataset, "margin", model=Part(model, others), **rest)
    # The threshold is the modulus times the margin, and has the same relative errors.
    sampling = dataset.modulus_threshold * np.expm1(COVERS * spectrum)
    rest["sampling"] = Part(sampling, text)
    model = between_limits(dataset, "modulus_threshold")
    dataset = with_budget(dataset, "modulus_threshold", model=model, **rest)
    low, *_, high = dataset.remaining_quantile.transpose("quantile", ...)
    from_spectrum = Part(((high - low) / 2).fillna(0.0), f"{text}; holds the model's as well")
    for name, sampled in (("remaining", from_spectrum), ("pull_off", None)):
        part = sampled or Part(dataset[name] * from_spectrum.error / dataset.remaining, text)
        rest["sampling"] = replace(part, error=part.error.fillna(0.0))
        dataset = with_budget(dataset, name, model=between_limits(dataset, name), **rest)
    rest["sampling"] = Part(sampling, text)
    rest["sampling"] = Part(xr.where(ours, sampling, 0.0), text)
    model = Part(xr.where(ours, model.error, np.nan), others)
    dataset = with_budget(dataset, "threshold_by_criterion", model=model, **rest)
    share, number = dataset.probability, xr.DataArray(list(draws.values()), dims="surface")
    scatter = COVERS * np.sqrt(share * (1 - share) / number.where(number > 0))
    inside = absent("drawn")
    return with_budget(
        dataset,
        "probability",
        discretisation=inside,
        solver=CLOSED["solver"],
        sampling=Part(scatter.fillna(0.0), "of the number of draws"),
        bandwidth=CLOSED["bandwidth"],
        model=inside,
    )
