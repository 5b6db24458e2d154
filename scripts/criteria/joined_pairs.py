"""Verdicts on pairs that were judged apart, in one dataset."""

import xarray as xr


def join_pairs(verdicts, dimension):
    """One dataset of verdicts on several surfaces, or of several materials on the same one."""
    joined = xr.concat(
        verdicts,
        dimension,
        data_vars="minimal",
        coords="minimal",
        compat="override",
        combine_attrs="override",
    )
    # Numbers may be missing for more reasons in one part than in another.
    for name in joined.variables:
        reasons = [each[name].attrs.get("nan_means", "") for each in verdicts]
        if any(reasons):
            joined[name].attrs["nan_means"] = max(reasons, key=len)
    return joined
