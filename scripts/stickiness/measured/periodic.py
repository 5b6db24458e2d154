"""Measured heights made periodic, for a solver of periodic surfaces.

There are three ways, and their difference shows the error. A taper pulls the rim of the scan to the
mean plane; a rim so flat sticks better than the surface. A mirror keeps every height, but slopes
change sign across the seams. It takes four times the points, unless a solver knows of it (its
argument `mirrored`). A smooth correction takes away the steps between opposite sides and hardly
changes heights further in (Moisan 2011, doi:10.1007/s10851-010-0227-1).
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import fft

from stickiness.measured.psd import power_spectrum
from stickiness.spectrum.kinds import Shells

Periodisation = Literal["taper", "mirror", "smooth", "given"]


def periodise(heights: ArrayLike, kind: Periodisation) -> NDArray:
    """Return levelled heights that are periodic without a jump.

    Parameters
    ----------
    heights : (nx, ny) array
        Levelled heights, in any unit.
    kind : {"taper", "mirror", "smooth", "given"}
        "taper": the heights about their mean, times a taper that is 1 except in a cosine rim over
        an eighth of a side at either end. "mirror": the heights and their mirror images.
        "smooth": the heights less the smoothest map that has the same steps between opposite
        sides. "given": no change.

    Returns
    -------
    (nx, ny) array, or (2 nx, 2 ny) for "mirror"

    Raises
    ------
    ValueError
        If the heights are no map, or `kind` is unknown.
    """
    heights = np.asarray(heights, dtype=float)
    if heights.ndim != 2:
        raise ValueError(f"heights must be a map (nx, ny), got shape {heights.shape}")
    if kind == "given":
        return heights
    if kind == "mirror":
        wide = np.concatenate([heights, heights[::-1]])
        return np.concatenate([wide, wide[:, ::-1]], axis=1)
    if kind == "smooth":
        return heights - _steps_between_sides(heights)
    if kind != "taper":
        raise ValueError(f"kind must be 'taper', 'mirror', 'smooth' or 'given', got {kind!r}")
    taper = _taper_side(heights.shape[0])[:, None] * _taper_side(heights.shape[1])
    return taper * (heights - np.sum(taper * heights) / taper.sum())


def _taper_side(points: int) -> NDArray:
    """Taper along one side, which falls to zero over an eighth of it at either end."""
    position = (np.arange(points) + 0.5) / points
    depth = np.minimum(np.minimum(position, 1 - position) / 0.125, 1.0)
    return np.sin(np.pi / 2 * depth) ** 2


def _steps_between_sides(heights: NDArray) -> NDArray:
    """Map of zero mean whose periodic Laplacian vanishes but for the steps across the border."""
    steps = np.zeros_like(heights)
    across = heights[-1] - heights[0]
    along = heights[:, -1] - heights[:, 0]
    steps[0] += across
    steps[-1] -= across
    steps[:, 0] += along
    steps[:, -1] -= along
    curvature = [2 * np.cos(2 * np.pi * fft.fftfreq(n)) - 2 for n in heights.shape]
    laplacian = curvature[0][:, None] + curvature[1]
    laplacian[0, 0] = 1.0  # the mean of the steps is zero
    return fft.ifft2(fft.fft2(steps) / laplacian).real


def filter_waves(heights: NDArray, sides: tuple[float, float], q_max: float) -> NDArray:
    """Periodic heights (nx, ny) without waves beyond `q_max`, on the same grid."""
    return fft.ifft2(_modes_below(heights, sides, q_max)).real


def _modes_below(heights: NDArray, sides: tuple[float, float], q_max: float) -> NDArray:
    """Fourier transform of periodic heights, zero beyond a wave number."""
    modes = fft.fft2(heights)
    qx, qy = (
        2 * np.pi * np.rint(fft.fftfreq(n, 1 / n)) / side
        for n, side in zip(heights.shape, sides, strict=True)
    )
    modes[np.hypot(qx[:, None], qy) > q_max] = 0.0
    return modes


def shells(heights: ArrayLike, sides: tuple[float, float]) -> Shells:
    """Spectrum of periodic heights (nx, ny) on a period of any sides, in 200 shells per decade."""
    heights = np.asarray(heights, dtype=float)
    dx = sides[0] / heights.shape[0]
    dy = sides[1] / heights.shape[1]
    plane = power_spectrum(heights, dx, dy)
    dqx, dqy = plane.steps
    variance = (plane.psd * plane.multiplicity * dqx * dqy).ravel()[1:]
    q = plane.q.ravel()[1:]
    index = np.rint(np.log10(q / q.min()) * 200).astype(int)
    total = np.bincount(index, weights=variance)
    has_waves = total > 1e-24 * total.sum()  # the rest is rounding
    total = total[has_waves]
    mean_q2 = np.bincount(index, weights=variance * q**2)[has_waves] / total
    return Shells(np.sqrt(mean_q2), total)
