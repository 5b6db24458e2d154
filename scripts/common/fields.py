"""Fields of one realisation at a few loads, for pictures."""

from collections.abc import Sequence
from typing import Any

import xarray as xr

from common.conventions import annotate


def gather_fields(
    states: Sequence[Any], pressures: Any, surface: xr.Dataset, **texts: str
) -> xr.Dataset:
    """Gap, pressure and residual of one state a pressure; `texts` describe the latter two."""
    dims = ("pressure", "x", "y")
    dataset = xr.Dataset(
        {
            "gap": (dims, [state.gap for state in states]),
            "contact_pressure": (dims, [state.pressure for state in states]),
            "residual": ("pressure", [state.residual for state in states]),
        },
        coords={"pressure": pressures, "x": surface.x, "y": surface.y},
    )
    return annotate(dataset, **{name: ("1", text) for name, text in texts.items()})
