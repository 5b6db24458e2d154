"""The quantities that a case may ask for: one entry of `TABLE` each.

To add one, add an entry. If the quantity cannot be taken from areas and gaps, give the function
that measures it on a solution as well.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Column:
    """One number of a quantity at each load."""

    name: str  #: in the tables of errors and in the answer to a case
    text: str  #: in files of results
    label: str  #: in the report
    variable: str  #: in the file of results, without an ending such as ``_mean``
    heading: str = ""  #: of a narrow table
    #: where along `range` or `gap`, over h_rms
    at: Mapping[str, float] = field(default_factory=dict)
    file: str = "ensemble"  #: or the fit ``a_v`` or ``kappa``


@dataclass(frozen=True)
class Quantity:
    """What a case may ask for."""

    name: str
    columns: tuple[Column, ...]
    #: Means of the ensemble that it needs: ``area_fraction``, ``mean_gap``, ``attractive_area``,
    #: ``gap_density``, or its name if it is measured.
    means: tuple[str, ...]
    #: Measures it on one solution, from heights (n, n) over h_rms, gaps (n, n) over h_rms and
    #: the side of the cell over 1/q0. Solvers call it if a case asks for the quantity; theory
    #: cannot give it.
    measure: Callable[[NDArray, NDArray, float], float] | None = None
    #: Whether its errors were measured. Cases have all such quantities by default.
    has_error_model: bool = True

    @property
    def needs_gaps(self) -> bool:
        """Whether it needs attractive areas, which take longer to evaluate than area and gap."""
        return "attractive_area" in self.means


def slope_within_contact(heights: NDArray, gap: NDArray, length: float) -> float:
    """Return the rms gradient of heights (n, n) over the points in contact; NaN without contact.

    Gaps are 0 in contact; `length` is the side of the cell in the unit of the heights. Derivatives
    are taken in Fourier space, as in `surface.moments`, so that full contact has the rms slope of
    the surface.
    """
    touching = gap == 0
    if not touching.any():
        return np.nan
    n = heights.shape[0]
    waves = np.fft.rfft2(heights)
    kx = 2 * np.pi / length * np.fft.fftfreq(n, 1 / n)[:, None]
    ky = 2 * np.pi / length * np.fft.rfftfreq(n, 1 / n)[None, :]
    square = sum(np.fft.irfft2(1j * k * waves, s=heights.shape) ** 2 for k in (kx, ky))
    return float(np.sqrt(square[touching].mean()))


TABLE = (
    Quantity(
        "area",
        (
            Column(
                "area", "repulsive contact area over nominal area", "contact area", "area_fraction"
            ),
        ),
        ("area_fraction",),
    ),
    Quantity(
        "mean_gap",
        (Column("mean_gap", "mean gap over h_rms", "mean gap", "mean_gap"),),
        ("mean_gap",),
    ),
    Quantity(
        "attractive_area",
        tuple(
            Column(
                f"attractive_area_{at:g}",
                f"attractive area at range {at:g} h_rms over nominal area",
                f"attractive area at range {at:g}",
                "attractive_area",
                heading=f"A_ad({at:g})",
                at={"range": at},
            )
            for at in (0.01, 0.1)
        ),
        ("attractive_area",),
    ),
    Quantity(
        "gap_distribution",
        (
            Column(
                "gap_distribution",
                "P(u) times h_rms at gap 0.1 h_rms",
                "P(u) at gap 0.1",
                "gap_density",
                heading="P(u)",
                at={"gap": 0.1},
            ),
        ),
        ("attractive_area", "gap_density"),
    ),
    Quantity(
        "a_v",
        (Column("a_v", "a_V", "a_V", "a_v", heading="a_V", file="a_v"),),
        ("attractive_area",),
    ),
    Quantity(
        "kappa", (Column("kappa", "kappa_rep", "κ", "kappa", file="kappa"),), ("area_fraction",)
    ),
    Quantity(
        "contact_slope",
        (
            Column(
                "contact_slope",
                "rms gradient of the heights within the contact over q0 h_rms",
                "rms slope within the contact",
                "contact_slope",
                heading="slope in contact",
            ),
        ),
        ("contact_slope",),
        measure=slope_within_contact,
        has_error_model=False,
    ),
)

QUANTITIES = {quantity.name: quantity for quantity in TABLE}
COLUMNS = {column.name: column for quantity in TABLE for column in quantity.columns}
# What a case holds unless it names its quantities, and what figures and report need.
MODELLED = tuple(quantity.name for quantity in TABLE if quantity.has_error_model)
MEASURED = {quantity.name: quantity.measure for quantity in TABLE if quantity.measure}


def columns_of(names: Iterable[str]) -> tuple[str, ...]:
    """Return the names of the columns of some quantities."""
    return tuple(column.name for name in names for column in QUANTITIES[name].columns)


def has_error_model(column: str) -> bool:
    """Whether the errors of a column were measured."""
    return column in columns_of(MODELLED)
