"""The quantities that a case may ask for: one entry of `TABLE` each.

To add one, add an entry. If the quantity cannot be taken from areas and gaps, give the function
that measures it on a solution as well.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

# Means of an ensemble that follow from areas and gaps, and files that columns are read from.
_MEANS = ("area_fraction", "mean_gap", "attractive_area", "gap_density")
_FILES = ("ensemble", "a_v", "kappa")

Measure = Callable[[NDArray, NDArray, float], float]


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

    def __post_init__(self) -> None:
        if self.file not in _FILES:
            raise ValueError(f"column {self.name}: file = {self.file!r}, must be one of {_FILES}")


@dataclass(frozen=True)
class Quantity:
    """What a case may ask for."""

    name: str
    columns: tuple[Column, ...]
    means: tuple[str, ...]  #: of the ensemble, that it needs
    #: Measures it on one solution, from heights (n, n) over h_rms, gaps (n, n) over h_rms and
    #: the side of the cell over 1/q0. Solvers call it if a case asks for the quantity; theory
    #: cannot give it.
    measure: Measure | None = None
    #: Whether its errors were measured. Cases have all such quantities by default.
    has_error_model: bool = True

    def __post_init__(self) -> None:
        known = (*_MEANS, self.name) if self.measure else _MEANS
        for mean in self.means:
            if mean not in known:
                raise ValueError(f"quantity {self.name}: nothing makes the mean {mean!r}")

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


def _single(name: str, text: str, label: str, variable: str, means: Iterable[str], **more: Any):
    """Return a quantity of one column, both of one name."""
    of_quantity = {key: more.pop(key) for key in ("measure", "has_error_model") if key in more}
    column = Column(name, text, label, variable, **more)
    return Quantity(name, (column,), tuple(means), **of_quantity)


TABLE = (
    _single(
        "area",
        "repulsive contact area over nominal area",
        "contact area",
        "area_fraction",
        ["area_fraction"],
    ),
    _single(
        *("mean_gap", "mean gap over h_rms", "mean gap", "mean_gap", ["mean_gap"]),
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
        means=("attractive_area",),
    ),
    _single(
        "gap_distribution",
        "P(u) times h_rms at gap 0.1 h_rms",
        "P(u) at gap 0.1",
        "gap_density",
        ["attractive_area", "gap_density"],
        heading="P(u)",
        at={"gap": 0.1},
    ),
    _single(
        *("a_v", "a_V", "a_V", "a_v", ["attractive_area"]),
        heading="a_V",
        file="a_v",
    ),
    _single(
        *("kappa", "kappa_rep", "κ", "kappa", ["area_fraction"]),
        file="kappa",
    ),
    _single(
        "contact_slope",
        "rms gradient of the heights within the contact over q0 h_rms",
        "rms slope within the contact",
        "contact_slope",
        ["contact_slope"],
        heading="slope in contact",
        measure=slope_within_contact,
        has_error_model=False,
    ),
)

QUANTITIES = {quantity.name: quantity for quantity in TABLE}
COLUMNS = {column.name: column for quantity in TABLE for column in quantity.columns}
if len(QUANTITIES) < len(TABLE) or len(COLUMNS) < sum(len(each.columns) for each in TABLE):
    raise ValueError("two quantities or two columns have the same name")
# What a case holds unless it names its quantities, and what figures and report need.
MODELLED = tuple(quantity.name for quantity in TABLE if quantity.has_error_model)
MEASURED = {quantity.name: quantity.measure for quantity in TABLE if quantity.measure}


def columns_of(names: Iterable[str]) -> tuple[str, ...]:
    """Return the names of the columns of some quantities."""
    return tuple(column.name for name in names for column in QUANTITIES[name].columns)


def has_error_model(column: str) -> bool:
    """Whether the errors of a column were measured."""
    return column in columns_of(MODELLED)


def refuse_unknown(
    names: Iterable[str], key: str, *, by_theory: bool = False, within_accuracy: bool = False
) -> None:
    """Raise ValueError, naming the key, if a quantity is unknown or cannot be had as asked.

    `by_theory` and `within_accuracy` say whether theory has to give it, and whether an accuracy is
    asked for.
    """
    for name in names:
        if name not in QUANTITIES:
            raise ValueError(f"{key}: {name!r} is not one of {', '.join(QUANTITIES)}")
        quantity = QUANTITIES[name]
        if by_theory and quantity.measure:
            raise ValueError(f"{key}: theory does not give {name}; simulate it, or leave it out")
        if within_accuracy and not quantity.has_error_model:
            raise ValueError(
                f"{key}: the errors of {name} were not measured, so that no accuracy can be "
                "promised; give seeds in place of accuracy, or leave it out"
            )
