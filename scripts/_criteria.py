"""The a_V that criteria use, with everything that is known of its error."""

import numpy as np
from stickiness import datasets


def measured_a_v(path, pressure):
    """Value and error of a_V from a fit file, in its first window.

    The error adds in quadrature the sampling error over seeds, the change with resolution and
    half the spread between the windows of the fit: the 2/3 law holds only roughly, so that the
    window is part of the answer.
    """
    fit = datasets.read(path, ["a_v_mean", "a_v_standard_error", "a_v_discretisation_error"])
    at_load = fit.sel(pressure=pressure, method="nearest")
    windows = at_load.a_v_mean.values
    parts = [
        float(at_load.a_v_standard_error.isel(window=0)),
        float(at_load.a_v_discretisation_error.isel(window=0)),
        float(windows.max() - windows.min()) / 2,
    ]
    return float(windows[0]), float(np.sqrt(np.nansum(np.square(parts))))
