"""The verdict on every pair, its limits, and which pairs are not judged."""

import numpy as np
import xarray as xr

from common.verdicts import find_limits
from stickiness.criteria.pair import NOT_JUDGED, decide
from stickiness.criteria.registry import EDGES


def decide_pairs(dataset):
    """Code of the verdict over the whole range of the surface and the limits of the model."""
    low, high = find_limits(dataset)
    grows = (dataset.margin.sel(criterion=EDGES, drop=True) > 1).any("end")
    return low.copy(data=decide(low, high, grows))


def find_doubts(materials, surfaces, material_surfaces):
    """Why pairs are not judged, for reasons of either surface; empty for those that are."""

    def find_reasons(material, surface):
        both = (surface, material_surfaces.get(material.surface))
        given = (one.attrs.get("not_judged") for one in both if one is not None)
        return "\n".join(filter(None, given))

    doubts = [
        [find_reasons(m, surface) for surface in surfaces.values()] for m in materials.values()
    ]
    return xr.DataArray(np.array(doubts, dtype=object), dims=("material", "surface"))


def withhold(dataset):
    """The dataset without any number of pairs where there are doubts about a surface."""
    judged = dataset.not_judged == ""
    if judged.all():
        return dataset
    found = {}
    with xr.set_options(keep_attrs=True):
        for name, values in dataset.items():
            if values.dtype.kind == "f" and {"material", "surface"} <= set(values.dims):
                reasons = filter(None, (values.attrs.get("nan_means"), "not judged"))
                found[name] = values.where(judged).transpose(*values.dims)
                found[name].attrs["nan_means"] = ", or ".join(reasons)
        for name, code in (("verdict", NOT_JUDGED), ("disagrees", 0)):
            found[name] = dataset[name].where(judged, code).astype("i1")
    return dataset.assign(found)
