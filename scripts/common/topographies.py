"""Synthetic topographies of many families, to try limits on surfaces that nothing was fitted to.

Every family is made on a grid of twice the points, and then filtered: what is finer than the
shortest wave goes, and the band ends there abruptly. Features have the size of the longest wave.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from common.conventions import Q0
from stickiness.spectrum import SelfAffine, Spectrum, Tabulated
from stickiness.surface import sample_modes, skew_modes, sum_modes

FINER = 2  # points of the grid on which families are made, over those asked for
ROUNDING = 1e-9
SKEWNESS = 1.2  # of log-normal heights
FEATURES = 1  # stream of random numbers for features; waves have the seed's own


class Cell(NamedTuple):
    """Periodic square on which a topography is made."""

    points: int  # of the grid, along a side
    waves: float  # longest waves, or features, along a side
    band: float  # shortest waves along a side
    seed: int

    @property
    def side(self) -> float:
        """Side in units of 1/q0."""
        return self.waves * 2 * np.pi / Q0

    @property
    def q1(self) -> float:
        """Largest wave number."""
        return Q0 * self.band / self.waves

    def random(self) -> np.random.Generator:
        """Random numbers for features."""
        return np.random.default_rng([self.seed, FEATURES])

    def axes(self) -> tuple[NDArray, NDArray]:
        """Coordinates along the sides, in sides, as a column and a row."""
        axis = np.arange(self.points) / self.points
        return axis[:, None], axis[None, :]


def make_topography(
    family: str, points: int, waves: float, seed: int, shortest: float = 4.0, **parameters
) -> NDArray:
    """Periodic heights of zero mean and unit rms.

    Parameters
    ----------
    family : str
        Name in `FAMILIES`.
    points : int
        Grid points along a side.
    waves : float
        Longest waves, or features, along a side.
    seed : int
        Of the realisation.
    shortest : float
        Shortest wavelength in pixels, at least 2. Shorter waves are filtered out.
    **parameters
        Of the family's function.

    Returns
    -------
    (points, points) array

    Raises
    ------
    ValueError
        If the family is unknown, or the shortest wave has fewer than two pixels or is not below the
        longest.
    """
    if family not in FAMILIES:
        raise ValueError(f"family must be one of {', '.join(FAMILIES)}, got {family!r}")
    if not 2 <= shortest < points / waves:
        raise ValueError(
            f"shortest must be from 2 to below {points / waves:g} pixels of the longest wave, "
            f"got {shortest!r}"
        )
    cell = Cell(FINER * points, waves, points / shortest, seed)
    heights = limit_band(FAMILIES[family](cell, **parameters), points, cell.band)
    return heights / heights.std()


def make_set(setting: dict, seed: int) -> NDArray:
    """Heights of one realisation of a set of the configuration."""
    of_family = {"hurst": setting["hurst"], "skewness": setting.get("height_skewness")}
    parameters = {name: value for name, value in of_family.items() if value is not None}
    return make_topography(
        setting["family"],
        setting["points"],
        setting["waves"],
        seed,
        setting["shortest"],
        **parameters,
    )


def limit_band(heights: NDArray, points: int, band: float) -> NDArray:
    """Heights without their mean and without more than `band` waves a side, on another grid."""
    modes = fft.fft2(heights) / heights.size
    index = np.arange(-((points - 1) // 2), (points - 1) // 2 + 1)
    i, j = np.meshgrid(index, index, indexing="ij")
    is_kept = (np.hypot(i, j) <= band * (1 + ROUNDING)) & ((i != 0) | (j != 0))
    limited = np.zeros((points, points), dtype=complex)
    limited[i[is_kept], j[is_kept]] = modes[i[is_kept], j[is_kept]]
    return fft.ifft2(limited).real * limited.size


def sum_waves(cell: Cell, spectrum: Spectrum, skewness: float = 0.0) -> NDArray:
    """Random waves of a spectrum, of unit rms height, log-normal to a skewness."""
    i, j, variance = spectrum.modes(cell.side)
    modes = sample_modes(variance, cell.seed, "gaussian")
    is_kept = np.hypot(i, j) <= cell.band * (1 + ROUNDING)
    i = i[is_kept]
    j = j[is_kept]
    modes = skew_modes(i, j, modes[is_kept], skewness)
    heights = sum_modes(i, j, modes, cell.points)
    return heights / heights.std()


def self_affine(
    cell: Cell,
    hurst: float = 0.8,
    shortest: float = 1.0,
    longest: float = 1.0,
    skewness: float = 0.0,
) -> NDArray:
    """Self-affine waves; `longest` is over 1/q0, `shortest` over the end of the band."""
    spectrum = SelfAffine(hurst=hurst, q0=Q0 / longest, q1=cell.q1 / shortest, h_rms=1.0)
    return sum_waves(cell, spectrum, skewness)


def gaussian(cell: Cell, hurst: float = 0.8) -> NDArray:
    """Gaussian heights."""
    return self_affine(cell, hurst)


def skewed_up(cell: Cell, hurst: float = 0.8, skewness: float = SKEWNESS) -> NDArray:
    """Peaks on a plain, as after blasting."""
    return self_affine(cell, hurst, skewness=skewness)


def skewed_down(cell: Cell, hurst: float = 0.8, skewness: float = -SKEWNESS) -> NDArray:
    """A plateau with valleys, as after wear."""
    return self_affine(cell, hurst, skewness=skewness)


def squared(cell: Cell, hurst: float = 0.8) -> NDArray:
    """Squares of Gaussian heights: peaks on a plain."""
    return np.square(self_affine(cell, hurst))


def squared_down(cell: Cell, hurst: float = 0.8) -> NDArray:
    """The same upside down."""
    return -squared(cell, hurst)


def exponential(cell: Cell, hurst: float = 0.8) -> NDArray:
    """Exponentials of Gaussian heights: high peaks."""
    return np.exp(self_affine(cell, hurst))


def exponential_down(cell: Cell, hurst: float = 0.8) -> NDArray:
    """The same upside down: deep pits."""
    return -exponential(cell, hurst)


def tops_cut(cell: Cell, hurst: float = 0.8) -> NDArray:
    """Gaussian heights, flat from half an rms height on."""
    return np.minimum(self_affine(cell, hurst), 0.5)


def valleys_cut(cell: Cell, hurst: float = 0.8) -> NDArray:
    """Gaussian heights, flat below half an rms height under the mean."""
    return np.maximum(self_affine(cell, hurst), -0.5)


def plateau_honed(cell: Cell, cut: float = 0.3, softness: float = 0.05) -> NDArray:
    """Crossed grooves, and then tops cut softly at `cut` rms heights."""
    heights = self_affine(cell) - 2 * crossed_grooves(cell)
    heights = (heights - heights.mean()) / heights.std()
    return cut - softness * np.logaddexp(0.0, (cut - heights) / softness) + 0.05 * fine(cell)


def crossed_grooves(cell: Cell) -> NDArray:
    """Depth, at most 1, of grooves in two directions that are 67 degrees apart."""
    random = cell.random()
    number = max(round(cell.waves / 3), 1)
    depths = [
        groove(cell, normal, place, width)
        for normal in ((2, 3), (2, -3))
        for place, width in random.uniform((0.0, 0.1), (1.0, 0.2), (number, 2))
    ]
    return np.max(depths, axis=0)


def groove(cell: Cell, normal: tuple[int, int], place: float, width: float) -> NDArray:
    """Depth, at most 1, of straight grooves with a `width` over the longest wave."""
    distance = groove_distance(cell, normal, place)
    return np.exp(-0.5 * (distance / (0.5 * width)) ** 2)


def groove_distance(cell: Cell, normal: tuple[int, int], place: float) -> NDArray:
    """Distance from periodic lines, over the longest wave; `normal` counts them along the sides."""
    x, y = cell.axes()
    phase = normal[0] * x + normal[1] * y - place
    return (phase - np.rint(phase)) * cell.waves / np.hypot(*normal)


def fine(cell: Cell, longest: float = 0.25, hurst: float = 0.6) -> NDArray:
    """Roughness finer than the features, of unit rms height."""
    longest = max(longest, 1.5 * Q0 / cell.q1)
    return self_affine(cell, hurst, longest=longest)


def terraced(cell: Cell, step: float = 0.9) -> NDArray:
    """Long waves in steps, softened over about a pixel, with fine roughness."""
    heights = step * np.rint(self_affine(cell, shortest=cell.q1 / (3 * Q0)) / step)
    return soften(heights, 0.2 / cell.band) + 0.08 * fine(cell)


def soften(heights: NDArray, width: float) -> NDArray:
    """Gaussian average over a `width` in sides."""
    points = len(heights)
    i = fft.fftfreq(points, 1 / points)
    gain = np.exp(-0.5 * (2 * np.pi * i * width) ** 2)
    return fft.ifft2(fft.fft2(heights) * gain[:, None] * gain).real


def scratched(cell: Cell, depth: float = 3.0) -> NDArray:
    """Gaussian roughness with straight narrow grooves between ridges."""
    random = cell.random()
    heights = self_affine(cell)
    for _ in range(max(round(1.5 * cell.waves), 2)):
        normal = random.integers(1, 3), random.choice([-2, -1, 1, 2])
        distance = groove_distance(cell, normal, random.random()) / random.uniform(0.06, 0.15)
        # A Mexican hat: what a groove lost stands beside it.
        profile = (1 - distance**2) * np.exp(-0.5 * distance**2)
        heights -= depth * random.uniform(0.3, 1.0) * profile
    return heights


def dimpled(cell: Cell, depth: float = 5.0) -> NDArray:
    """Gaussian roughness with round pits."""
    random = cell.random()
    pits = np.zeros((cell.points, cell.points))
    for square in square_distances(cell, random, each=0.7):
        radius = random.uniform(0.25, 0.5)
        pit = random.uniform(0.5, 1.0) * np.maximum(1 - square / radius**2, 0.0) ** 2
        np.maximum(pits, pit, out=pits)
    return self_affine(cell) - depth * pits


def square_distances(cell: Cell, random: np.random.Generator, each: float):
    """Squares of the distances from random points, over the longest wave; `each` per its square."""
    x, y = cell.axes()
    for centre in random.random((max(round(each * cell.waves**2), 2), 2)):
        dx, dy = (
            (axis - place - np.rint(axis - place)) * cell.waves
            for axis, place in zip((x, y), centre, strict=True)
        )
        yield dx**2 + dy**2


def cobbled(cell: Cell, roughness: float = 0.05) -> NDArray:
    """Round caps side by side, with fine roughness."""
    random = cell.random()
    heights = np.full((cell.points, cell.points), -np.inf)
    for square in square_distances(cell, random, each=4.0):
        top = random.uniform(0.0, 0.3)
        np.maximum(heights, top - square * random.uniform(0.7, 1.5), out=heights)
    heights = (heights - heights.mean()) / heights.std()
    return heights + roughness * fine(cell)


def beaded(cell: Cell) -> NDArray:
    """Craters of beads side by side, with fine roughness: cobbles upside down."""
    return -cobbled(cell)


def turned(cell: Cell, roughness: float = 0.15) -> NDArray:
    """Ridges between the grooves of a round tool, which wanders a little, with roughness."""
    return 4 * feed_phase(cell) ** 2 - 0.33 + roughness * fine(cell, longest=0.5)


def printed(cell: Cell, roughness: float = 0.15) -> NDArray:
    """Rounded tops of printed lines, which wander a little, with roughness."""
    return np.sqrt(1.05 - 4 * feed_phase(cell) ** 2) + roughness * fine(cell, longest=0.5)


def feed_phase(cell: Cell, wander: float = 0.06) -> NDArray:
    """Distance from the nearest line, from -1/2 to 1/2 of their distance."""
    x, _ = cell.axes()
    shift = self_affine(cell, shortest=cell.q1 / (3 * Q0))
    phase = round(cell.waves) * x + wander * shift
    return phase - np.rint(phase)


def bifractal(cell: Cell, long_hurst: float = 0.9, short_hurst: float = 0.4) -> NDArray:
    """Gaussian heights, smooth in long waves and rough in short ones."""
    q = np.geomspace(Q0, cell.q1, 3)
    exponents = -2 * (1 + np.array([long_hurst, short_hurst]))
    psd = np.cumprod(np.append(1.0, (q[1:] / q[:-1]) ** exponents))
    return sum_waves(cell, Tabulated(q, psd))


def rolloff(cell: Cell, hurst: float = 0.8) -> NDArray:
    """Gaussian heights, self-affine in waves shorter than 1/q0, with a plateau up to the side."""
    spectrum = SelfAffine(
        hurst=hurst, q0=Q0 / cell.waves, q1=cell.q1, h_rms=1.0, q_rolloff=Q0 * (1 + ROUNDING)
    )
    return sum_waves(cell, spectrum)


def ground(cell: Cell, hurst: float = 0.8, anisotropy: float = 4.0) -> NDArray:
    """Gaussian heights with a direction."""
    # The band ends at one wave number in all directions.
    q1 = cell.q1 * np.sqrt(anisotropy)
    return sum_waves(cell, SelfAffine(hurst=hurst, q0=Q0, q1=q1, h_rms=1.0, anisotropy=anisotropy))


#: Functions of a `Cell` and of parameters, by the name of the family.
FAMILIES: dict[str, Callable[..., NDArray]] = {
    function.__name__: function
    for function in (
        *(gaussian, skewed_up, skewed_down, squared, squared_down, exponential, exponential_down),
        *(tops_cut, valleys_cut, plateau_honed, terraced, scratched, dimpled),
        *(cobbled, beaded, turned, printed, bifractal, rolloff, ground),
    )
}
