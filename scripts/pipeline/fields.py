"""Fields of one realisation at a few loads, for pictures."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import xarray as xr

from pipeline.conventions import DESCRIBED
from stickiness.core import datasets


def fields(states: Sequence[Any], pressures: Any, surface: xr.Dataset, **texts: str) -> xr.Dataset:
    """Gap, pressure and residual of states with these attributes, one for each pressure.

    `texts` say what `contact_pressure` and `residual` are.
    """
    dims = ("pressure", "x", "y")
    dataset = xr.Dataset(
        {
            "gap": (dims, [state.gap for state in states]),
            "contact_pressure": (dims, [state.pressure for state in states]),
            "residual": ("pressure", [state.residual for state in states]),
        },
        coords={"pressure": pressures, "x": surface.x, "y": surface.y},
    )
    described = {name: ("1", text) for name, text in texts.items()}
    return datasets.annotate(
        dataset, pressure=DESCRIBED["pressure"], gap=DESCRIBED["gap"], **described
    )
