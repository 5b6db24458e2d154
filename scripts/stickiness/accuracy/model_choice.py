"""Which adhesive model a set of parameters gets: the DMT limit where it is good enough, or full.

The DMT limit costs nothing once the contact without adhesion is solved. Where it holds within the
accuracy asked is read off a table of its measured error, over all that a contact depends on: law,
Hurst exponent and magnification of the surface (Gaussian, a window of one longest wavelength),
pressure p/(E* q0 h_rms), range/h_rms and strength (l_a/range)/(q0 h_rms) of the attraction. Beyond
the table nothing is known, and the full model is chosen.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stickiness.arguments import positive
from stickiness.criteria.area_load import jtb_limit
from stickiness.units import si

AXES = ("magnification", "pressure", "range_over_h_rms", "strength")
COLUMNS = ("law", "hurst", *AXES, "ratio", "error")

_ROUNDING = 1e-9  # relative, of the ends of an axis


@dataclass(frozen=True, eq=False)
class ErrorTable:
    """Measured 1/kappa_ad, full over DMT, on a lattice of parameters for each law and H.

    `lattices` holds, by law and Hurst exponent, the logarithms of the values along `AXES`, and the
    logarithm of the ratio and its error on their product, NaN where nothing was measured.
    """

    lattices: Mapping[tuple[str, float], tuple[tuple[NDArray, ...], NDArray, NDArray]]

    def relative_error(self, law: str, hurst: float, *values: float) -> float:
        """Largest relative error of the DMT limit in 1/kappa_ad, NaN outside the table.

        It is ``|DMT/full - 1|`` with the ratio as far from 1 as its error allows. The values are in
        the order of `AXES`, positive and finite (else ValueError); between the lattice's points,
        logarithms are linear.
        """
        if (law, hurst) not in self.lattices:
            return np.nan
        positive(values=values)
        axes, ratio, error = self.lattices[law, hurst]
        weights = [_weights(axis, np.log(value)) for axis, value in zip(axes, values, strict=True)]
        if any(weight is None for weight in weights):
            return np.nan
        mean, spread = 0.0, 0.0
        for corner in product(*weights):
            index, share = zip(*corner, strict=True)
            mean += np.prod(share) * ratio[index]
            spread += np.prod(share) * error[index]
        return float(max(abs(np.expm1(-mean - spread)), abs(np.expm1(-mean + spread))))


def _weights(axis: NDArray, value: float) -> list[tuple[int, float]] | None:
    """Neighbouring points of an axis and their shares in a value between; None outside."""
    if not axis[0] - _ROUNDING <= value <= axis[-1] + _ROUNDING:
        return None
    exact = np.flatnonzero(np.isclose(axis, value, rtol=0, atol=_ROUNDING))
    if exact.size:
        return [(int(exact[0]), 1.0)]
    above = int(np.searchsorted(axis, value))
    share = float((value - axis[above - 1]) / (axis[above] - axis[above - 1]))
    return [(above - 1, 1 - share), (above, share)]


def read_table(path: str | Path) -> ErrorTable:
    """Read a table of `COLUMNS` from a CSV file.

    ValueError if the file is missing or has other columns, or a value is unusable; names the line.
    """
    try:
        lines = Path(path).read_text(encoding="utf-8").splitlines()
    except FileNotFoundError:
        raise ValueError(f"{path}: no such file; the target dmt_error makes it") from None
    reader = csv.DictReader(lines)
    if tuple(reader.fieldnames or ()) != COLUMNS:
        raise ValueError(f"{path}: the columns must be {','.join(COLUMNS)}, got {lines[:1]}")
    rows: dict[tuple[str, float], dict[tuple[float, ...], tuple[float, float]]] = {}
    for row in reader:
        try:
            hurst, *point, ratio, error = (float(row[name]) for name in COLUMNS[1:])
        except (TypeError, ValueError):
            hurst, point, ratio, error = 0.0, [0.0], 0.0, 0.0
        if min(*point, ratio) <= 0 or not error >= 0:
            raise ValueError(
                f"{path}: line {reader.line_num}: {lines[reader.line_num - 1]!r} must hold "
                "positive numbers after the law"
            )
        logs = tuple(float(value) for value in np.log(point))
        rows.setdefault((row["law"], hurst), {})[logs] = np.log(ratio), error / ratio
    return ErrorTable({group: _lattice(points) for group, points in rows.items()})


def _lattice(points):
    axes = tuple(np.unique(values) for values in zip(*points, strict=True))
    ratio, error = np.full((2, *map(len, axes)), np.nan)
    for point, values in points.items():
        index = tuple(int(np.searchsorted(a, v)) for a, v in zip(axes, point, strict=True))
        ratio[index], error[index] = values
    return axes, ratio, error


@dataclass(frozen=True, eq=False)
class Choice:
    """Model of every point, arrays (pressures, adhesion lengths, ranges), each in rising order."""

    full: NDArray  #: bool: whether the full model is to be solved, else the DMT limit
    dmt_error: NDArray  #: relative error of the DMT limit by the table, NaN outside it
    jtb: NDArray  #: bool: whether the condition of Joe, Thouless and Barber for that limit holds


def choose(asked: Mapping[str, Any], surface: Mapping[str, Any], table: ErrorTable) -> Choice:
    """Choose the model for every point of an entry `adhesion` of the configuration.

    `asked` is the entry, `surface` that of its model surface.
    """
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
    if is_tabulated(surface):
        kind = asked["law"], surface["hurst"], surface["magnification"]
        for i, j, k in np.ndindex(shape):
            point = pressures[i], ranges[k], lengths[j] / q0_h_rms
            error[i, j, k] = table.relative_error(*kind, *point)
    good = jtb & (error <= asked.get("accuracy", 0.0))
    full = {"dmt": np.zeros(shape, bool), "full": np.ones(shape, bool), "auto": ~good}
    return Choice(full[asked["model"]], error, jtb)


def is_tabulated(surface: Mapping[str, Any]) -> bool:
    """Whether a model surface is of the kind that the table was measured on."""
    return (
        surface.get("window", 1) == 1
        and "rolloff" not in surface
        and surface.get("amplitudes", "gaussian") == "gaussian"
    )


def roughness(asked: Mapping[str, Any]) -> float:
    """Dimensionless roughness q0 h_rms, given as such or by a window and an rms height."""
    if "q0_h_rms" in asked:
        return float(asked["q0_h_rms"])
    return 2 * np.pi / si(asked["window"], "m") * si(asked["h_rms"], "m")
