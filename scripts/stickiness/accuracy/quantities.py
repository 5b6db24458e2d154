"""The quantities that a case may ask for: one column of numbers each, or several.

To add a quantity, add a `Column`. If it cannot be taken from areas and gaps, give the function that
measures it on a solution as well.
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
    #: Means of the ensemble that it needs, by their names in the file; by default the variable's.
    means: tuple[str, ...] = ()
    quantity: str = ""  #: that a case names, if it is not the name of the column
    #: where along `range` or `gap`, over h_rms
    at: Mapping[str, float] = field(default_factory=dict)
    file: str = "ensemble"  #: or the fit ``a_v`` or ``kappa``
    #: Takes heights (n, n) over h_rms and the side of the cell over 1/q0, and returns what measures
    #: the quantity on a solution, from its gaps (n, n) over h_rms. Solvers call it for every
    #: solution, which may thus serve any case. Theory does not give such a quantity, and its errors
    #: have no model.
    measure: Callable[[NDArray, float], Callable[[NDArray], float]] | None = None


def slope_within_contact(heights: NDArray, length: float) -> Callable[[NDArray], float]:
    """Return what gives, from gaps, the rms gradient of heights (n, n) over the points in contact.

    Gaps are 0 in contact; without contact the result is NaN. `length` is the side of the cell in
    the unit of the heights. Derivatives are taken in Fourier space, as in `surface.moments`, so
    that full contact has the rms slope of the surface.
    """
    n = heights.shape[0]
    waves = np.fft.rfft2(heights)
    kx = 2 * np.pi / length * np.fft.fftfreq(n, 1 / n)[:, None]
    ky = 2 * np.pi / length * np.fft.rfftfreq(n, 1 / n)[None, :]
    squares = [np.fft.irfft2(1j * k * waves, s=heights.shape) ** 2 for k in (kx, ky)]
    square = np.sum(squares, axis=0)

    def measure(gap: NDArray) -> float:
        touching = gap == 0
        return float(np.sqrt(square[touching].mean())) if touching.any() else np.nan

    return measure


def _attractive_area(range: float) -> Column:
    label = f"attractive area at range {range:g}"
    return Column(
        name=f"attractive_area_{range:g}",
        text=f"{label} h_rms over nominal area",
        label=label,
        variable="attractive_area",
        quantity="attractive_area",
        at={"range": range},
    )


_TABLE = (
    Column(
        name="area",
        text="repulsive contact area over nominal area",
        label="contact area",
        variable="area_fraction",
    ),
    Column(name="mean_gap", text="mean gap over h_rms", label="mean gap", variable="mean_gap"),
    _attractive_area(0.01),
    _attractive_area(0.1),
    Column(
        name="gap_distribution",
        text="P(u) times h_rms at gap 0.1 h_rms",
        label="P(u) at gap 0.1",
        variable="gap_density",
        means=("attractive_area", "gap_density"),
        at={"gap": 0.1},
    ),
    Column(
        name="a_v",
        text="a_V",
        label="a_V",
        variable="a_v",
        means=("attractive_area",),
        file="a_v",
    ),
    Column(
        name="kappa",
        text="kappa_rep",
        label="κ",
        variable="kappa",
        means=("area_fraction",),
        file="kappa",
    ),
    Column(
        name="contact_slope",
        text="rms gradient of the heights within the contact over q0 h_rms",
        label="rms slope within the contact",
        variable="contact_slope",
        measure=slope_within_contact,
    ),
)

COLUMNS = {column.name: column for column in _TABLE}
QUANTITIES = tuple(dict.fromkeys(column.quantity or column.name for column in _TABLE))
MEASURED = {column.name: column.measure for column in _TABLE if column.measure}
# What a case holds unless it names its quantities, and what figures and report need.
MODELLED = tuple(name for name in QUANTITIES if name not in MEASURED)


def columns_of(names: Iterable[str]) -> tuple[str, ...]:
    """Return the names of the columns of some quantities."""
    return tuple(c.name for name in names for c in _TABLE if name == (c.quantity or c.name))


def means_of(names: Iterable[str]) -> set[str]:
    """Return the names of the ensemble's means that some quantities need."""
    columns = [COLUMNS[name] for name in columns_of(names)]
    return {mean for column in columns for mean in column.means or (column.variable,)}


def has_error_model(column: str) -> bool:
    """Whether the errors of a column were measured."""
    return column in columns_of(MODELLED)
