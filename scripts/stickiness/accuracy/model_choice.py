"""Which adhesive model a set of parameters gets: the DMT sum where it is good enough, or full.

The DMT sum costs nothing once the contact without adhesion is solved. A table of its measured
error says where it holds within an accuracy, by law, Hurst exponent and magnification of the
surface (Gaussian, a window of one longest wavelength), pressure p/(E* q0 h_rms), range/h_rms and
strength (l_a/range)/(q0 h_rms). Beyond the table nothing is known, and the full model is chosen.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stickiness.accuracy.error_models import Surface
from stickiness.arguments import positive
from stickiness.criteria.formulas import jtb_limit
from stickiness.units import si

AXES = ("magnification", "pressure", "range_over_h_rms", "strength")
COLUMNS = ("law", "hurst", *AXES, "ratio", "error")
_ROUNDING = 1e-9  # relative, of the ends of an axis

# By law and Hurst exponent: the logarithms of the values along `AXES`, and the logarithm of the
# ratio of 1/kappa_ad, full over DMT, and its error on their product, NaN where not measured.
ErrorTable = Mapping[tuple[str, float], tuple[tuple[NDArray, ...], NDArray, NDArray]]


def relative_error(table: ErrorTable, law: str, hurst: float, *values: float) -> float:
    """Largest relative error of the DMT sum in 1/kappa_ad, NaN outside the table.

    It is ``|DMT/full - 1|`` with the ratio as far from 1 as its error allows. The values are in the
    order of `AXES`; between the lattice's points, logarithms are linear.
    """
    if (law, hurst) not in table:
        return np.nan
    positive(values=values)
    axes, ratio, error = table[law, hurst]
    # Without neighbours, outside the table, no corner is left.
    corners = [_neighbours(axis, np.log(v)) for axis, v in zip(axes, values, strict=True)]
    if not all(corners):
        return np.nan
    mean, spread = 0.0, 0.0
    for corner in product(*corners):
        index, share = zip(*corner, strict=True)
        mean += np.prod(share) * ratio[index]
        spread += np.prod(share) * error[index]
    return float(max(abs(np.expm1(-mean - spread)), abs(np.expm1(-mean + spread))))


def _neighbours(axis: NDArray, value: float) -> list[tuple[int, float]]:
    """Neighbouring points of an axis and their shares in a value between; none outside."""
    if not axis[0] - _ROUNDING <= value <= axis[-1] + _ROUNDING:
        return []
    exact = np.flatnonzero(np.isclose(axis, value, rtol=0, atol=_ROUNDING))
    if exact.size:
        return [(int(exact[0]), 1.0)]
    above = int(np.searchsorted(axis, value))
    share = float((value - axis[above - 1]) / (axis[above] - axis[above - 1]))
    return [(above - 1, 1 - share), (above, share)]


def read_table(path: str | Path) -> ErrorTable:
    """Read a table of `COLUMNS` from a CSV file; a ValueError names the file and the line."""
    try:
        lines = Path(path).read_text(encoding="utf-8").splitlines()
    except FileNotFoundError:
        raise ValueError(f"{path}: no such file; the target dmt_error makes it") from None
    if tuple(lines[0].split(",")) != COLUMNS:
        raise ValueError(f"{path}: the columns must be {','.join(COLUMNS)}, got {lines[:1]}")
    groups: dict[tuple[str, float], list[list[float]]] = {}
    for number, line in enumerate(lines[1:], 2):
        law, *texts = line.split(",")
        try:
            hurst, *values, error = map(float, texts)
            if len(texts) + 1 != len(COLUMNS) or min(values) <= 0 or not error >= 0:
                raise ValueError
        except ValueError:
            wanted = f"{line!r} must hold positive numbers after the law"
            raise ValueError(f"{path}: line {number}: {wanted}") from None
        groups.setdefault((law, hurst), []).append([*np.log(values), error / values[-1]])
    lattices = {}
    for group, rows in groups.items():
        *points, ratios, errors = np.transpose(rows)
        axes, places = zip(*(np.unique(x, return_inverse=True) for x in points), strict=True)
        lattice = np.full((2, *map(len, axes)), np.nan)
        lattice[:, *places] = ratios, errors
        lattices[group] = axes, *lattice
    return lattices


@dataclass(frozen=True, eq=False)
class Choice:
    """Model of every point, arrays (pressures, adhesion lengths, ranges), each in rising order."""

    full: NDArray  #: bool: whether the full model is to be solved, else the DMT sum
    dmt_error: NDArray  #: relative error of the DMT sum by the table, NaN outside it
    jtb: NDArray  #: bool: whether the condition of Joe, Thouless and Barber for that limit holds


def choose(asked: Mapping[str, Any], surface: Mapping[str, Any], table: ErrorTable) -> Choice:
    """Choose the model for every point of an entry of `adhesion`, and its model surface."""
    pressures, lengths, ranges = (
        np.sort(np.array(asked[name], dtype=float))
        for name in ("pressures", "adhesion_length_over_range", "range_over_h_rms")
    )
    q0_h_rms = roughness(asked)
    shape = len(pressures), len(lengths), len(ranges)
    # In units of 1/q0.
    limit = jtb_limit(1.0, lengths[:, None] * ranges * q0_h_rms, ranges * q0_h_rms)
    jtb = np.broadcast_to(q0_h_rms > limit, shape)
    error = np.full(shape, np.nan)
    kind = Surface.of(surface)
    if kind.kind_measured and kind.window == 1:
        for i, j, k in np.ndindex(shape):
            point = pressures[i], ranges[k], lengths[j] / q0_h_rms
            of_surface = asked["law"], kind.hurst, kind.magnification
            error[i, j, k] = relative_error(table, *of_surface, *point)
    good = jtb & (error <= asked.get("accuracy", 0.0))
    full = {"dmt": np.zeros(shape, bool), "full": np.ones(shape, bool), "auto": ~good}
    return Choice(full[asked["model"]], error, jtb)


def roughness(asked: Mapping[str, Any]) -> float:
    """Dimensionless roughness q0 h_rms, given as such or by a window and an rms height."""
    if "q0_h_rms" in asked:
        return float(asked["q0_h_rms"])
    return 2 * np.pi / si(asked["window"], "m") * si(asked["h_rms"], "m")
