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
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from stickiness.accuracy.error_models import Surface
from stickiness.arguments import positive
from stickiness.criteria.formulas import jtb_limit

AXES = ("magnification", "pressure", "range_over_h_rms", "strength")
COLUMNS = ("law", "hurst", *AXES, "ratio", "error")
_ROUNDING = 1e-9  # relative, of the ends of an axis


class Lattice(NamedTuple):
    """Ratio of 1/kappa_ad, full over DMT, as measured for one law and Hurst exponent."""

    axes: tuple[NDArray, ...]  #: logarithms of the values along `AXES`
    log_ratio: NDArray  #: on the product of the axes, NaN where not measured
    error: NDArray  #: of this logarithm


ErrorTable = Mapping[tuple[str, float], Lattice]  #: by law and Hurst exponent


def relative_error(table: ErrorTable, law: str, hurst: float, *values: float) -> float:
    """Largest relative error of the DMT sum in 1/kappa_ad, NaN outside the table.

    It is ``|DMT/full - 1|`` with the ratio as far from 1 as its error allows. The values are in the
    order of `AXES`; between the lattice's points, logarithms are linear.
    """
    if (law, hurst) not in table:
        return np.nan
    positive(values=values)
    lattice = table[law, hurst]
    # Without neighbours, outside the table, no corner is left.
    corners = [
        _neighbours(axis, np.log(value)) for axis, value in zip(lattice.axes, values, strict=True)
    ]
    if not all(corners):
        return np.nan
    # Linear interpolation between the corners of the cell that holds the point.
    mean = 0.0
    spread = 0.0
    for corner in product(*corners):
        index = tuple(place for place, _ in corner)
        weight = np.prod([share for _, share in corner])
        mean += weight * lattice.log_ratio[index]
        spread += weight * lattice.error[index]
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
        *points, log_ratios, errors = np.transpose(rows)
        axes = []
        places = []
        for values in points:
            axis, place = np.unique(values, return_inverse=True)
            axes.append(axis)
            places.append(place)
        shape = tuple(len(axis) for axis in axes)
        lattice = Lattice(tuple(axes), np.full(shape, np.nan), np.full(shape, np.nan))
        lattice.log_ratio[tuple(places)] = log_ratios
        lattice.error[tuple(places)] = errors
        lattices[group] = lattice
    return lattices


@dataclass(frozen=True, eq=False)
class Choice:
    """Model of every point, arrays (pressures, adhesion lengths, ranges), each in rising order."""

    full: NDArray  #: bool: whether the full model is to be solved, else the DMT sum
    dmt_error: NDArray  #: relative error of the DMT sum by the table, NaN outside it
    jtb: NDArray  #: bool: whether the condition of Joe, Thouless and Barber for that limit holds


def choose(entry: Mapping[str, Any], surface: Mapping[str, Any], table: ErrorTable) -> Choice:
    """Choose the model for every point of an entry of `adhesion`, and its model surface."""
    pressures = np.sort(np.array(entry["pressures"], dtype=float))
    lengths = np.sort(np.array(entry["adhesion_length_over_range"], dtype=float))
    ranges = np.sort(np.array(entry["range_over_h_rms"], dtype=float))
    q0_h_rms = entry["q0_h_rms"]
    shape = (len(pressures), len(lengths), len(ranges))
    # In units of 1/q0.
    limit = jtb_limit(1.0, lengths[:, None] * ranges * q0_h_rms, ranges * q0_h_rms)
    jtb = np.broadcast_to(q0_h_rms > limit, shape)
    error = np.full(shape, np.nan)
    kind = Surface.of(surface)
    if kind.kind_measured and kind.window == 1:
        for i, j, k in np.ndindex(shape):
            strength = lengths[j] / q0_h_rms
            error[i, j, k] = relative_error(
                table,
                entry["law"],
                kind.hurst,
                kind.magnification,
                float(pressures[i]),
                float(ranges[k]),
                strength,
            )
    good = jtb & (error <= (entry["accuracy"] or 0.0))
    full = {"dmt": np.zeros(shape, bool), "full": np.ones(shape, bool), "auto": ~good}
    return Choice(full=full[entry["model"]], dmt_error=error, jtb=jtb)
