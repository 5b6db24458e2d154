"""Measured heights as they are simulated: thinned, mirrored, and of one size for every surface.

Heights and their mirror images are periodic. They keep flat tops flat, which a smooth correction of
the steps between opposite sides bends: on patches of a honed surface it raised the work of adhesion
at which a tenth remains ten times.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.measured import periodic
from stickiness.measured.psd import autocorrelation
from stickiness.remaining.full_contact import full_contact_energy

MOST_POINTS = 128  #: of the grid without its mirror images, along the longer side
FEWEST_POINTS = 32  #: along the shorter side
STANDARD_HEIGHT = 0.01  #: rms height of what is simulated, over the first side of the map
DECIMALS = 10  #: of these heights; an instrument resolves far less
_ROUNDING = 1e-9


@dataclass(frozen=True, eq=False)
class StandardMap:
    """Heights of a map or of a part of it, which are periodic together with their mirror images."""

    heights: NDArray  #: over `height_unit`, ``(n0, n1)``
    sides: tuple[float, float]  #: over the first side of the whole map
    height_unit: float  #: [length]

    @property
    def independent_areas(self) -> float:
        """Number of independent heights: 1 over the mean square of the autocorrelation."""
        return float(1 / np.mean(np.square(autocorrelation(self.heights))))


@dataclass(frozen=True, eq=False)
class StandardHeights:
    """Heights of a map and of its quarters."""

    whole: StandardMap
    quarters: tuple[StandardMap, ...]
    length_unit: float  #: first side of the whole map [length]
    #: Energy of full contact of the map's waves up to the cutoff, per nominal area [length]
    resolved_energy: float
    pixel: float  #: of the thinned grid [length]


def standardise(
    heights: ArrayLike,
    sides: tuple[float, float],
    cutoff: float = np.inf,
    most_points: int = MOST_POINTS,
    is_noise_beyond: bool = False,
) -> StandardHeights:
    """Thin levelled heights and their quarters.

    Large maps are thinned to every second, third … point. That keeps the distribution of the
    heights and the flat tops, which a filter would cover with ripples.

    Parameters
    ----------
    heights : (nx, ny) array
        Levelled heights [length].
    sides : pair of floats
        Sides of the map [length].
    cutoff : float
        Highest wave number of `StandardHeights.resolved_energy` [1/length].
    most_points : int
        Points of the grid along the longer side, at most.
    is_noise_beyond : bool
        Whether waves beyond the cutoff are none of the surface, and are filtered out.

    Raises
    ------
    ValueError
        If the map has fewer than `FEWEST_POINTS` along a side.
    """
    heights = np.asarray(heights, dtype=float)
    if min(heights.shape) < FEWEST_POINTS:
        raise ValueError(
            f"heights must have {FEWEST_POINTS} points along each side, got {heights.shape}"
        )
    steps = tuple(side / n for side, n in zip(sides, heights.shape, strict=True))
    # Thin the longer side to as many points, but leave enough of them across a narrow strip.
    stride = -(-max(heights.shape) // most_points)
    stride = min(stride, min(heights.shape) // FEWEST_POINTS)

    def thin(part: NDArray) -> StandardMap:
        # A grid whose halves the solvers can thin again.
        counts = tuple(n // (4 * stride) * (4 * stride) for n in part.shape)
        part = part[: counts[0], : counts[1]]
        part_sides = tuple(n * step / sides[0] for n, step in zip(counts, steps, strict=True))
        thinned = part[::stride, ::stride]
        # Heights of one size for every surface, rounded: last bits do not matter.
        height_unit = float(np.std(thinned)) / STANDARD_HEIGHT
        standard = np.round((thinned - thinned.mean()) / height_unit, DECIMALS)
        return StandardMap(standard, part_sides, height_unit)

    mirrored = periodic.periodise(heights, "mirror")
    mirrored_sides = 2 * sides[0], 2 * sides[1]
    resolved = periodic.filter_waves(mirrored, mirrored_sides, cutoff * (1 + _ROUNDING))
    if is_noise_beyond:
        heights = resolved[: heights.shape[0], : heights.shape[1]]
    half_x, half_y = (n // 2 for n in heights.shape)
    quarters = [
        thin(heights[along_x, along_y])
        for along_x in (slice(None, half_x), slice(-half_x, None))
        for along_y in (slice(None, half_y), slice(-half_y, None))
    ]
    return StandardHeights(
        whole=thin(heights),
        quarters=tuple(quarters),
        length_unit=sides[0],
        resolved_energy=full_contact_energy(resolved, 1.0, mirrored_sides, edges="given"),
        pixel=stride * max(steps),
    )
