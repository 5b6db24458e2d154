"""One row of the claims ledger, and what every claim needs to state its numbers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import xarray as xr

from pipeline.conventions import LOAD
from stickiness.core import budget, datasets

REPRODUCED = "reproduced"
QUALIFIED = "reproduced with a qualification"
NOT = "not reproduced"
OPEN = "not decided at this resolution"

Files = Mapping[str, xr.Dataset]


@dataclass(frozen=True)
class Claim:
    """One row of the ledger.

    Attributes
    ----------
    number : int
        Position in the ledger.
    statement : str
        What the paper claims.
    quantity : str
        What `value` is, with its unit.
    value, claimed : float
        Measured value, and the paper's (NaN where it gives none).
    verdict : str
        One of the verdicts above.
    remark : str
        The qualification or the reason, with its numbers.
    sources : tuple of str
        Names of the files that the claim was judged by, that of the value first.
    errors : mapping of str to float
        What the value errs by, covering 90 %, by its source; NaN where that is not known, and
        none of a source that does not apply.
    comment : str
        Why errors are not known or do not apply, or what they are.
    """

    number: int
    statement: str
    quantity: str
    value: float
    claimed: float
    verdict: str
    remark: str
    sources: tuple[str, ...]
    errors: Mapping[str, float] = field(default_factory=dict)
    comment: str = "as in the file of the value"

    @property
    def uncertainty(self) -> float:
        """All errors in quadrature; NaN where one of them is not known."""
        return float(np.linalg.norm([*self.errors.values()])) if self.errors else 0.0


def graded(fully: bool, partly: bool) -> str:
    """Verdict from whether the claim holds outright or within limits that the remark states."""
    return REPRODUCED if fully else QUALIFIED if partly else NOT


def errors_of(data: xr.Dataset, name: str) -> dict[str, float]:
    """Errors of a mean by their source."""
    return {s: float(budget.part(data, name, s)) for s in budget.SOURCES}


def total_error(data: xr.Dataset, name: str) -> xr.DataArray:
    """All errors of a mean in quadrature."""
    return data[f"{name}_total_error"]


def quoted(value: float, error: float) -> str:
    """Value with its error, if it has one."""
    return f"{float(value):.2f}" + (f" ± {float(error):.2f}" if np.isfinite(error) else "")


def at_load(data: xr.Dataset) -> xr.Dataset:
    """The point next to the load of the paper's figures."""
    return data.sel(pressure=LOAD, method="nearest")


def sample(data: xr.Dataset) -> str:
    """Magnification and window of a simulated case in words."""
    asked = datasets.parameters(data)
    waves = asked.get("window", 1)
    return f"zeta = {asked['magnification']:g}, window of {waves:g} longest wave{'s'[: waves > 1]}"


def power(number: float) -> str:
    """Magnification in words, 1000 or 5e4."""
    return f"{number:g}" if number < 1e4 else f"{number:.2g}".replace("e+0", "e")
