"""Measured topographies and line profiles: reading, missing points, levelling. Lengths in metres.

Axes: ``heights[i, j]`` is the height at x_i, y_j. Instruments and images store a matrix whose rows
run along y; such a matrix is transposed on reading.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from stickiness.measured import readers
from stickiness.measured.levelling import (
    MAX_MISSING,
    Detrend,
    Missing,
    Rim,
    complete_rectangle,
    complete_run,
    detrend,
    detrend_profile,
    fill_missing,
    fill_profile,
    rms_of_known,
    without_rims,
)
from stickiness.measured.plausibility import doubt_sizes, doubt_values
from stickiness.measured.raw import Length, Raw, metres, sides
from stickiness.measured.spikes import Spikes, find_spikes

Size = Length | Sequence[Length] | None

_WGS84_A, _WGS84_E2 = 6378137.0, 6.69437999014e-3  # semi-major axis [m], eccentricity squared


class _Heights:
    """What maps and profiles have in common."""

    heights: NDArray
    missing: int
    as_read: NDArray | None

    def h_rms_as_read(self, kind: Detrend = "plane") -> float:
        """Root mean square height with the points that were dropped or masked, levelled [m]."""
        if self.as_read is None:
            return self.h_rms
        return rms_of_known(self.as_read, kind)

    @property
    def h_rms(self) -> float:
        """Root mean square height about the mean [m]."""
        return float(np.std(self.heights))

    @property
    def missing_fraction(self) -> float:
        """Share of the points that were missing."""
        return self.missing / self.heights.size


@dataclass(frozen=True)
class Topography(_Heights):
    """Heights of a surface on a rectangular grid."""

    heights: NDArray  #: (nx, ny), the first axis along x [m]
    dx: float  #: grid step along x [m]
    dy: float  #: along y [m]
    source: str  #: file (and variable) of the heights
    missing: int = 0  #: number of points that were missing and have been interpolated
    cropped: float = 0.0  #: share of the measured points that was cut off to leave no missing ones
    dropped: int = 0  #: number of points that were measured beside missing ones and not used
    spikes: int = 0  #: number of points far off their neighbours, not used
    #: As `heights` before anything was dropped, masked or filled, NaN where missing; None if
    #: nothing was dropped or masked.
    as_read: NDArray | None = None
    doubts: tuple[str, ...] = ()  #: why no verdict should rest on the heights

    @property
    def size(self) -> tuple[float, float]:
        """Sides along x and y [m]."""
        return self.heights.shape[0] * self.dx, self.heights.shape[1] * self.dy

    def detrended(self, kind: Detrend = "plane") -> Topography:
        """Return the topography levelled by `detrend`."""
        return replace(self, heights=detrend(self.heights, kind))

    def to_xarray(self) -> xr.DataArray:
        """Return the heights along `x` and `y` with units, so that ``.plot()`` labels itself."""
        positions = {
            axis: (axis, step * np.arange(n), {"units": "m", "long_name": f"position along {axis}"})
            for axis, step, n in zip("xy", (self.dx, self.dy), self.heights.shape, strict=True)
        }
        attributes = {"units": "m", "long_name": "height"}
        return xr.DataArray(self.heights, positions, ("x", "y"), "height", attributes)


@dataclass(frozen=True)
class Profile(_Heights):
    """Heights along a line, evenly spaced."""

    heights: NDArray  #: (n,) [m]
    dx: float  #: step [m]
    source: str  #: file (and variable or channel)
    missing: int = 0  #: this and those after `largest_gap` as in `Topography`
    #: Largest distance between neighbouring points as measured [m]; above `dx` if they were
    #: unevenly spaced and have been interpolated.
    largest_gap: float = 0.0
    dropped: int = 0
    spikes: int = 0
    as_read: NDArray | None = None
    doubts: tuple[str, ...] = ()

    @property
    def length(self) -> float:
        """Length of the line [m]."""
        return len(self.heights) * self.dx

    def detrended(self, kind: Detrend = "plane") -> Profile:
        """Return the profile levelled by `detrend_profile`."""
        return replace(self, heights=detrend_profile(self.heights, kind))


def read(
    path: str | Path,
    *,
    length: Size = None,
    pixel_size: Size = None,
    height_unit: str | None = None,
    position_unit: str | None = None,
    variable: str | None = None,
    channel: str | int | None = None,
    format: str | None = None,
    missing_value: float | None = None,
    missing: Missing = "fill",
    max_missing: float = MAX_MISSING,
    missing_rim: Rim = "detect",
    spikes: Spikes = "mask",
) -> Topography | Profile:
    """Read a topography or a line profile.

    Parameters
    ----------
    path : str or Path
        NetCDF (.nc), numpy (.npz, .npy), text, or a file as an instrument wrote it.
    length : length or pair of lengths, optional
        Side of the measured area, along x and y: "10 um", ("10 um", "20 um") or metres. A single
        value is the side along x, the pixels are square. Overrides what the file says.
    pixel_size : length or pair of lengths, optional
        Grid step, instead of `length`.
    height_unit, position_unit : str, optional
        Unit of the heights, and of the positions of a line profile: "nm", if the file does not say
        so.
    variable : str, optional
        NetCDF variable or npz key. Default: the only two-dimensional one, else the only profile.
    channel : str or int, optional
        Channel of an instrument's file, by name or counted from 0. Default: the file's own.
    format : str, optional
        "netcdf", "numpy", "text", "instrument" or SurfaceTopography's name of a format, if the
        file's name and content mislead.
    missing_value : float, optional
        Number that marks missing points, besides NaN and masked values.
    missing : {"fill", "crop", "refuse"}
        "fill": interpolate missing points harmonically from their neighbours, which smooths the
        surface there. "crop": keep the largest rectangle (or stretch of a profile) without any.
        "refuse": raise.
    max_missing : float
        Largest share of missing points, those dropped included, that may be filled.
    missing_rim : int or "detect"
        Width of the rim around missing points in which measured points are dropped [points];
        "detect" as in `levelling.without_rims`.
    spikes : {"mask", "keep"}
        Take points far off all their neighbours (`spikes.find_spikes`) for missing, or not.

    Returns
    -------
    Topography or Profile
        A profile if the file holds one: a one-dimensional array or channel, or text in one
        column (heights) or two (positions, heights). Uneven positions are interpolated linearly
        to as many even ones.

    Raises
    ------
    ValueError
        If the file does not hold one usable array, its size or unit is unknown or of a wrong
        dimension, or too much is missing. The message names file, variable and remedy.

    Notes
    -----
    In NetCDF the axis named x (or lon) is x, else the last one; grid steps come from evenly
    spaced coordinates with a unit of length. A text matrix may have a header as Gwyddion
    writes it (Width, Height, Value units); other headers are SurfaceTopography's. Text in three
    columns is a list of points x y z on a grid. `doubts` of what is returned say which values
    are none that surfaces have (`stickiness.measured.plausibility`).
    """
    path = Path(path)
    if not path.is_file():
        raise FileNotFoundError(f"no topography file {str(path)!r}")
    if length is not None and pixel_size is not None:
        raise ValueError("give length or pixel_size, not both")
    if not 0 <= max_missing < 1:
        raise ValueError(f"max_missing must be in 0 <= f < 1, got {max_missing!r}")
    if missing not in ("fill", "crop", "refuse"):
        raise ValueError(f"missing must be 'fill', 'crop' or 'refuse', got {missing!r}")
    if missing_rim != "detect" and not (isinstance(missing_rim, int) and missing_rim >= 0):
        raise ValueError(f"missing_rim must be a number of points or 'detect', got {missing_rim!r}")
    if spikes not in ("mask", "keep"):
        raise ValueError(f"spikes must be 'mask' or 'keep', got {spikes!r}")
    raw = readers.read(path, format, variable, channel)
    heights = raw.heights
    if missing_value is not None:
        heights = np.where(heights == missing_value, np.nan, heights)
    limit = 0.0 if missing == "refuse" else max_missing
    rule = _Rule(missing, missing_rim, limit, spikes, raw.source)
    if heights.ndim == 1:
        found = _profile(_positions(raw, length, pixel_size, position_unit), heights, rule)
    else:
        found = _map(heights, _steps(raw, length, pixel_size, position_unit), rule)
    scale = _scale(raw.source, "height_unit", height_unit, raw.unit)
    as_read = None if found.as_read is None else found.as_read * scale
    found = replace(found, heights=found.heights * scale, as_read=as_read)
    if np.ptp(found.heights) == 0:
        flat = found.heights.flat[0]
        raise ValueError(f"{raw.source}: all heights are {flat:g} m; nothing to analyse")
    steps = (found.dx,) if heights.ndim == 1 else (found.dx, found.dy)
    doubts = [*found.doubts, *doubt_sizes(found.heights, steps)]
    return replace(found, doubts=tuple(f"{raw.source}: {doubt}" for doubt in doubts))


@dataclass(frozen=True)
class _Rule:
    """What to do with points that are missing or wrong."""

    missing: Missing
    rim: Rim
    limit: float  #: largest share that is filled
    spikes: Spikes
    source: str

    def drop(self, heights: NDArray) -> tuple[NDArray, int, int]:
        """Heights without rims and spikes, and the numbers of both."""
        left, dropped = without_rims(heights, self.rim)
        if self.spikes == "keep":
            return left, dropped, 0
        spikes = find_spikes(left)
        return np.where(spikes, np.nan, left), dropped, int(np.count_nonzero(spikes))

    def name(self, dropped: int, spikes: int) -> str:
        """Source with what was taken out, for messages on missing points."""
        beside = f", {dropped} points beside missing ones dropped" if dropped else ""
        return f"{self.source}{beside}{f', {spikes} spikes masked' if spikes else ''}"


def _map(heights: NDArray, steps: Sequence[float], rule: _Rule) -> Topography:
    left, dropped, spikes = rule.drop(heights)
    as_read, doubts = heights if dropped or spikes else None, tuple(doubt_values(left))
    if rule.missing == "crop":
        left = left[complete_rectangle(np.isfinite(left), rule.source)]
    filled, count = fill_missing(left, rule.limit, rule.name(dropped, spikes))
    cropped = 1 - left.size / heights.size
    numbers = count, cropped, dropped, spikes
    return Topography(filled, *steps, rule.source, *numbers, as_read, doubts)


def _profile(x: NDArray, heights: NDArray, rule: _Rule) -> Profile:
    order = np.argsort(x, kind="stable")
    x, whole = x[order], heights[order]
    heights, dropped, spikes = rule.drop(whole)
    as_read, doubts = whole if dropped or spikes else None, tuple(doubt_values(heights))
    source = rule.source
    if rule.missing == "crop":
        kept = complete_run(np.isfinite(heights), source)
        x, heights = x[kept], heights[kept]
    if len(x) < 2 or not np.all(np.diff(x) > 0):
        raise ValueError(f"{source}: positions of a line profile must all differ")
    filled, count = fill_profile(x, heights, rule.limit, rule.name(dropped, spikes))
    gaps = np.diff(x)
    even = np.linspace(x[0], x[-1], len(x))
    step = float(even[1] - even[0])
    if np.ptp(gaps) > 1e-3 * step:
        filled = np.interp(even, x, filled)
    numbers = count, float(gaps.max()), dropped, spikes
    return Profile(filled, step, source, *numbers, as_read, doubts)


def _positions(raw: Raw, length: Size, pixel_size: Size, position_unit: str | None) -> NDArray:
    """Positions of a profile's points [m], from the caller or else from the file."""
    n = len(raw.heights)
    if length is not None:
        return np.arange(n) * sides(length, (n,), f"{raw.source}: length")[0] / n
    if pixel_size is not None:
        return np.arange(n) * sides(pixel_size, (1,), f"{raw.source}: pixel_size")[0]
    if raw.positions is None:
        raise ValueError(
            f"{raw.source}: the file does not tell the profile's length; give length or pixel_size"
        )
    if not np.all(np.isfinite(raw.positions)):
        raise ValueError(f"{raw.source}: a position of the profile is missing")
    return raw.positions * _scale(raw.source, "position_unit", position_unit, raw.position_unit)


def _scale(source: str, key: str, given: str | None, in_file: str | None) -> float:
    """Metres per unit, from the caller or the file, which must agree."""
    units = [unit for unit in (given, in_file) if unit is not None]
    if not units:
        what = key.replace("_unit", "")
        raise ValueError(f"{source}: the file does not tell the unit of {what}; give {key}")
    scales = [metres(f"1 {unit}", f"{source}: {key}") for unit in units]
    if not np.isclose(scales[0], scales[-1], rtol=1e-12, atol=0):
        raise ValueError(
            f"{source}: {key} = {given!r}, but the file says {in_file!r}; "
            f"leave {key} out, or correct the file"
        )
    return scales[0]


def jacksboro() -> Topography:
    """Elevations about the Jacksboro fault, Tennessee: matplotlib's sample data set.

    344 x 403 points (SRTM, 3 arc seconds); the steps in degrees are converted on the WGS 84
    ellipsoid at the mean latitude, so that they differ along x (west to east) and y.
    """
    from matplotlib import cbook  # nothing else here needs it

    with cbook.get_sample_data("jacksboro_fault_dem.npz") as data:
        latitude = np.deg2rad((float(data["ymin"]) + float(data["ymax"])) / 2)
        heights = np.ascontiguousarray(data["elevation"].T, dtype=float)
        dx, dy = float(data["dx"]), float(data["dy"])
    east, north = metres_per_degree(latitude)
    source = "matplotlib sample data jacksboro_fault_dem.npz: elevation"
    return Topography(heights, dx * east, dy * north, source)


def metres_per_degree(latitude: float) -> tuple[float, float]:
    """Length of a degree of longitude and of latitude on WGS 84 [m] at `latitude` [rad]."""
    w = 1 - _WGS84_E2 * np.sin(latitude) ** 2
    east = _WGS84_A / np.sqrt(w) * np.cos(latitude)
    north = _WGS84_A * (1 - _WGS84_E2) / w**1.5
    return float(np.deg2rad(east)), float(np.deg2rad(north))


def _steps(
    raw: Raw, length: Size, pixel_size: Size, position_unit: str | None
) -> tuple[float, ...]:
    """Grid steps [m], from the caller or else from the file."""
    shape = raw.heights.shape
    if length is not None:
        size = sides(length, shape, f"{raw.source}: length")
        return tuple(side / n for side, n in zip(size, shape, strict=True))
    if pixel_size is not None:
        return sides(pixel_size, (1, 1), f"{raw.source}: pixel_size")
    if raw.grid is not None:
        scale = _scale(raw.source, "position_unit", position_unit, raw.position_unit)
        return tuple(step * scale for step in raw.grid)
    if raw.steps is None:
        raise ValueError(
            f"{raw.source}: the file does not tell its size; give length or pixel_size"
        )
    return raw.steps
