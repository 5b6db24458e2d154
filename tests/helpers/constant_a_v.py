"""A table of a_V with one value."""

from types import SimpleNamespace

import numpy as np


class ConstantAv:
    """A table of a_V that has one value, 20 % low and 30 % high ends."""

    bounds = {"magnification": (10.0, 1e8), "range": (1e-12, 1.0)}  # noqa: RUF012

    def a_v_at(self, hurst, pressure, range_over_h_rms, magnification):
        value = np.full(np.broadcast(range_over_h_rms, magnification).shape, 3.0)
        return SimpleNamespace(value=value, low=0.8 * value, high=1.3 * value)
