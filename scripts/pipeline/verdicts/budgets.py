"""Error budgets of verdicts: by the spectrum of a surface, by a_V and by the model of the edges."""

import numpy as np
import xarray as xr

from pipeline.verdicts.a_v import CLOSED, LIMITS, between
from stickiness.core.budget import Part, absent, with_budget
from stickiness.core.statistics import COVERS
from stickiness.criteria.registry import EDGES


def add_budgets(dataset, constant, draws):
    """Add error budgets to what is quoted of pairs: the spectrum, and a_V with the model."""
    dataset = with_budget(dataset, "a_v", **constant.parts(constant.value))
    ends = (dataset[f"pair_a_v{end}"] for end in ("", "_low", "_high"))
    dataset = with_budget(dataset, "pair_a_v", model=between(*ends), **CLOSED)
    rest = CLOSED | {"sampling": None}
    ours = dataset.criterion == EDGES
    # Ends of a surface that was not measured are two surfaces, each known exactly.
    spectrum = dataset.error_of_spectrum.fillna(0.0)
    text = "of the spectrum measured; none of one end of what is given"
    low, high = dataset.margin_low, dataset.margin_high
    model = between(dataset.margin, low, high).error.where(ours)
    rest["sampling"] = Part(dataset.margin * np.expm1(COVERS * spectrum).where(ours, 0.0), text)
    others = f"{LIMITS}; other criteria state none"
    dataset = with_budget(dataset, "margin", model=Part(model, others), **rest)
    moduli = [dataset[f"modulus_threshold{end}"] for end in ("", "_low", "_high")]
    # How the threshold follows the margin.
    slope = np.log(moduli[2] / moduli[1]) / np.log(high / low)
    rest["sampling"] = Part(moduli[0] * np.expm1(COVERS * spectrum * slope), text)
    dataset = with_budget(dataset, "modulus_threshold", model=between(*moduli), **rest)
    by_criterion = {
        name: Part(xr.where(ours, part.error, fill), part.text)
        for name, part, fill in (
            ("sampling", rest["sampling"], 0.0),
            ("model", Part(between(*moduli).error, others), np.nan),
        )
    }
    dataset = with_budget(dataset, "threshold_by_criterion", **(rest | by_criterion))
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
