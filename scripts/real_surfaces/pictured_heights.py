"""Measured heights as pictures of their contact press them: periodic, on a grid of given size."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from common.config.entries import measurements
from real_surfaces.measured_surface import find_cutoff, read_levelled
from stickiness.measured import periodic, topography

WAY = "smooth"  # a tapered rim is flat: it sticks better than the surface
MOST_PIXELS, LEAST_PIXELS = 8, 4  # per shortest wavelength
_ROUNDING = 1e-9
# Why a surface has no pictures.
NOT_JUDGED = "the surface is not judged"
NO_MAP = "it was measured along lines only, and contact needs a map of heights"


@dataclass(frozen=True)
class Pictured:
    """Periodic heights [m], sides [m], shortest wave [m], change of the heights over their rms.

    The change is the rms one by which the heights were made periodic, before waves were left out.
    """

    heights: NDArray
    sides: tuple[float, float]
    shortest_wavelength: float
    change: float

    @property
    def h_rms(self) -> float:
        """Root mean square of the heights about their mean [m]."""
        return float(np.std(self.heights))

    def places(self, step: int = 1) -> tuple[NDArray, NDArray]:
        """Middles of blocks of `step` by `step` pixels along both sides [m]."""
        shape = (n // step for n in self.heights.shape)
        return tuple(
            (np.arange(n) + 0.5) * side / n for n, side in zip(shape, self.sides, strict=True)
        )


def read_map(asked, finest):
    """First measurement that is a map: levelled heights, its own cutoff [1/m]; None if none is.

    `finest` is the cutoff of the surface.
    """
    for index, (_, measurement) in enumerate(measurements(asked)):
        heights = read_levelled(measurement)
        if isinstance(heights, topography.Topography):
            return heights, find_cutoff(asked, index, heights, finest)
    return None


def name_measurement(asked, heights):
    """Which of several measurements is pictured; empty where there is one."""
    return heights.source if len(measurements(asked)) > 1 else ""


def prepare(heights, q_cutoff, points):
    """`Pictured` heights without waves beyond the cutoff [1/m], the map or the grid.

    `points` is the largest number along a side; fewer are taken where they resolve all waves.
    """
    whole = periodic.periodise(heights.heights, WAY)
    waves = max(heights.size) / (2 * np.pi)  # per wave number along the longer side
    nyquist = np.pi / max(heights.dx, heights.dy)
    q_max = min(q_cutoff, nyquist, points / (LEAST_PIXELS * waves)) * (1 - _ROUNDING)
    pixels = min(MOST_PIXELS, points / (waves * q_max)) * (1 - _ROUNDING)
    limited = periodic.band_limited(whole, heights.size, q_max, pixels)
    change = float(np.std(whole - heights.heights) / np.std(heights.heights))
    return Pictured(limited - limited.mean(), heights.size, 2 * np.pi / q_max, change)


def halve(field):
    """Mean of every block of two by two points."""
    return field.reshape(field.shape[0] // 2, 2, field.shape[1] // 2, 2).mean(axis=(1, 3))
