"""A feature that decides the energy of a map: a step, scratch, weld bead, indent, particle, relief.

A spectrum stands for a surface if many waves, spread over the map, make its roughness. Then every
place stores about as much elastic energy in full contact. One feature may have the spectrum of many
waves, but it keeps them together. The local energy is the square of the heights whose waves are
multiplied by the root of q: its mean is the energy of full contact, up to a factor. Places are
squares, and bands across the map in all directions. The excess of a place is its share of the
energy less its share of the area. Above `LEAST_EXCESS` it is a feature.

All of 360 maps made with one feature have it, and 1 % of maps of the same spectra with random
phases. Of 2000 clean maps of 20 families, with two to eight waves a side, 2 % have one. Nearly all
of these are exponentials of Gaussian heights, where one peak decides. Random maps that are the same
in all rows have few waves, and a feature in up to 14 %. Knurls, weaves, gratings, Fresnel lenses
and reliefs of many shapes spread their energy and have none; see `doubts.find_pattern`, too.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray
from scipy import fft

from stickiness.formatting import amount, number
from stickiness.measured.levelling import complete_rectangle

LEAST_EXCESS = 0.38
CELLS = 32  #: along a side, of which places consist; also the fewest points
MOST_POINTS = 256  #: along a side; larger maps are thinned
DIRECTIONS = 24  #: of bands
TAIL = 0.01  #: share of the points of a place below its low level, and above its high one
LEAST_MORE = 0.05  #: excess of a band over that of a square; in a corner both are as good
#: Height of half a band over its surroundings, over that from its low to its high level
LEAST_STEP = 0.15


@dataclass(frozen=True)
class Feature:
    """A place of a map that stores much of the elastic energy of full contact."""

    shape: str  #: "step", "ridge" or "groove" across the map; else "raised patch" or "hollow"
    share: float  #: of the energy of full contact
    area: float  #: share of the area of the map
    outline: tuple[tuple[float, float], ...]  #: corners (x, y) of the place [m]
    centre: tuple[float, float]  #: (x, y) [m]
    angle: float | None  #: between x and a feature across the map, 0 to pi [rad]
    #: Ends along x and along y of the largest rectangle beside it [m]
    beside: tuple[tuple[float, float], ...]

    def __str__(self) -> str:
        x, y = (amount(position, "m", 2) for position in self.centre)
        where = f"around x = {x}, y = {y}"
        if self.angle is not None:
            degrees = f"{np.degrees(self.angle):.0f}"
            oblique = f"at {degrees}° to x through x = {x}, y = {y}"
            where = {"0": f"along x at y = {y}", "90": f"along y at x = {x}"}.get(degrees, oblique)
        share, area = (f"{number(100 * part, 2)} %" for part in (self.share, self.area))
        return (
            f"a {self.shape} {where}: {share} of the energy of full contact on {area} of the area"
        )


def find_feature(heights: ArrayLike, sides: tuple[float, float]) -> Feature | None:
    """Find the feature that decides the elastic energy of full contact with a map.

    Parameters
    ----------
    heights : (nx, ny) array
        Levelled heights [m].
    sides : pair of floats
        Sides of the map [m].

    Returns
    -------
    Feature or None
        None if the energy is spread over the map, and of fewer than `CELLS` points along a side.

    Examples
    --------
    >>> x, y = np.indices((64, 64)) * 1e-6
    >>> waves = 1e-8 * np.cos(x / 1e-6) * np.cos(y / 1e-6 + x / 2e-6)
    >>> find_feature(waves, (64e-6, 64e-6)) is None
    True
    >>> scratch = 3e-7 * np.exp(-(((x - 20e-6) / 2e-6) ** 2))
    >>> print(find_feature(waves - scratch, (64e-6, 64e-6)))
    a groove along y at x = 20 µm: 88 % of the energy of full contact on 6.2 % of the area
    """
    heights = np.asarray(heights, dtype=float)
    if min(heights.shape) < CELLS:
        return None
    stride = min(-(-max(heights.shape) // MOST_POINTS), min(heights.shape) // CELLS)
    heights = heights[::stride, ::stride]

    # Local energy of the heights and their mirror images, and the share that every cell has of it.
    qx, qy = (np.pi * np.arange(n) / side for n, side in zip(heights.shape, sides, strict=True))
    q = np.hypot(qx[:, None], qy)
    modes = np.sqrt(q) * fft.dctn(heights, norm="ortho")
    local_energy = fft.idctn(modes, norm="ortho") ** 2
    x, y = (np.arange(n) * CELLS // n for n in heights.shape)
    cell = CELLS * x[:, None] + y
    of_cells = np.bincount(cell.ravel(), weights=local_energy.ravel())
    if not of_cells.any():
        return None
    energy = of_cells / of_cells.sum()

    square = max(_squares(energy), key=lambda place: place.excess)
    band = max(_bands(energy), key=lambda place: place.excess)
    place = band if band.excess > square.excess + LEAST_MORE else square
    if place.excess <= LEAST_EXCESS:
        return None

    # Corners, middle and direction in metres, and the largest rectangle beside it.
    x, y = np.divmod(place.cells, CELLS)
    corners = np.concatenate([np.stack([x + i, y + j], axis=1) for i in (0, 1) for j in (0, 1)])
    points = corners / CELLS * np.array(sides)
    along = np.exp(1j * (place.angle or 0.0))
    angle = np.arctan2(sides[1] * along.imag, sides[0] * along.real) % np.pi
    is_beside = np.isin(np.arange(energy.size), place.cells, invert=True)
    rectangle = complete_rectangle(is_beside.reshape(CELLS, CELLS))
    ends = np.array([(cells.start, cells.stop) for cells in rectangle])
    beside = ends / CELLS * np.array(sides)[:, None]
    return Feature(
        shape=_name_shape(heights, cell, place),
        share=float(energy[place.cells].sum()),
        area=place.cells.size / energy.size,
        outline=tuple(map(tuple, points[scipy.spatial.ConvexHull(points).vertices].tolist())),
        centre=tuple(points.mean(axis=0).tolist()),
        angle=None if place.angle is None else float(angle),
        beside=tuple(map(tuple, beside.tolist())),
    )


class _Place(NamedTuple):
    """Cells of a square or band, by their places in the flattened map."""

    excess: float
    cells: NDArray  #: of a band in order, from one side of it to the other
    angle: float | None = None  #: of a band, with lengths over the sides of the map [rad]


def _squares(energy: NDArray) -> Iterator[_Place]:
    """Yield the square of the largest excess of every size, with lengths over the sides."""
    cells = np.arange(energy.size).reshape(CELLS, CELLS)
    for width in range(1, CELLS):
        windows = np.lib.stride_tricks.sliding_window_view(cells, (width, width))
        excess = energy[windows].sum(axis=(2, 3)) - width**2 / energy.size
        largest = np.unravel_index(excess.argmax(), excess.shape)
        yield _Place(excess[largest], windows[largest].ravel())


def _bands(energy: NDArray) -> Iterator[_Place]:
    """Yield the band of the largest excess in every direction."""
    x, y = np.indices((CELLS, CELLS))
    for angle in np.pi / DIRECTIONS * np.arange(DIRECTIONS):
        # Cells in the order of their distance from a line; rounding makes equals equal.
        distance = np.round(y * np.cos(angle) - x * np.sin(angle), 6)
        order = np.argsort(distance, axis=None, kind="stable")
        # The excess of a band is what this sum rises by from its first cell to its last.
        total = np.append(0.0, np.cumsum(energy[order] - 1 / energy.size))
        rise = total - np.minimum.accumulate(total)
        stop = int(rise.argmax())
        start = int(total[: stop + 1].argmin())
        yield _Place(rise[stop], order[start:stop], float(angle))


def _name_shape(heights: NDArray, cell: NDArray, place: _Place) -> str:
    """Name a feature by the heights in it and beside it, of which `cell` tells the cells."""
    is_within = np.isin(cell, place.cells)
    beside = np.median(heights[~is_within])
    low, high = np.quantile(heights[is_within], (TAIL, 1 - TAIL)) - beside
    if place.angle is None:
        return "raised patch" if high > -low else "hollow"
    # A step is below its surroundings in one half of the band, and above them in the other.
    halves = (np.isin(cell, half) for half in np.array_split(place.cells, 2))
    lower, upper = sorted(np.median(heights[half]) - beside for half in halves)
    if min(upper, -lower) > LEAST_STEP * (high - low):
        return "step"
    return "ridge" if high > -low else "groove"
