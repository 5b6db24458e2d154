"""Measured topographies: reading, filling missing points, levelling. Lengths in metres.

Axes: ``heights[i, j]`` is the height at x_i, y_j. Instruments and images store a matrix whose rows
run along y; such a matrix is transposed on reading.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from . import textmatrix
from .levelling import MAX_MISSING, Detrend, detrend, fill_missing
from .units import si

Length = str | float  # "10 um", or metres

_X_NAMES = ("x", "lon", "longitude", "easting")
_Y_NAMES = ("y", "lat", "latitude", "northing")
_WGS84_A, _WGS84_E2 = 6378137.0, 6.69437999014e-3  # semi-major axis [m], eccentricity squared


@dataclass(frozen=True)
class Topography:
    """Heights of a surface on a rectangular grid.

    Attributes
    ----------
    heights : (nx, ny) array
        Heights [m], the first axis along x.
    dx, dy : float
        Grid steps along x and y [m].
    source : str
        File (and variable) the heights came from.
    missing : int
        Number of points that were missing and have been interpolated.
    """

    heights: NDArray
    dx: float
    dy: float
    source: str
    missing: int = 0

    @property
    def size(self) -> tuple[float, float]:
        """Sides along x and y [m]."""
        return self.heights.shape[0] * self.dx, self.heights.shape[1] * self.dy

    @property
    def h_rms(self) -> float:
        """Root mean square height about the mean [m]."""
        return float(np.std(self.heights))

    @property
    def missing_fraction(self) -> float:
        """Share of the points that were missing."""
        return self.missing / self.heights.size

    def detrended(self, kind: Detrend = "plane") -> Topography:
        """Return the topography levelled by `detrend`."""
        return replace(self, heights=detrend(self.heights, kind))


def read(
    path: str | Path,
    *,
    length: Length | Sequence[Length] | None = None,
    pixel_size: Length | Sequence[Length] | None = None,
    height_unit: str | None = None,
    variable: str | None = None,
    missing_value: float | None = None,
    max_missing: float = MAX_MISSING,
) -> Topography:
    """Read a topography from NetCDF (.nc), numpy (.npz, .npy) or a text matrix (anything else).

    Parameters
    ----------
    path : str or Path
        The file.
    length : length or pair of lengths, optional
        Side of the measured area, along x and y: "10 um", ("10 um", "20 um") or metres. A single
        value is the side along x, the pixels are square. Overrides what the file says.
    pixel_size : length or pair of lengths, optional
        Grid step, instead of `length`.
    height_unit : str, optional
        Unit of the numbers: "nm", if the file does not say so itself.
    variable : str, optional
        NetCDF variable or npz key. Default: the only two-dimensional one.
    missing_value : float, optional
        Number that marks missing points, besides NaN and masked values.
    max_missing : float
        Largest share of missing points that may be filled.

    Returns
    -------
    Topography
        With missing points interpolated harmonically from their neighbours. That is smooth and
        takes out roughness there, hence `max_missing`.

    Raises
    ------
    ValueError
        If the file does not hold one usable 2D array, its size or unit is unknown or of a wrong
        dimension, or too much is missing. The message names file, variable and remedy.
    FileNotFoundError
        If there is no such file.

    Notes
    -----
    In NetCDF the axis named x (or lon) is x, else the last one; grid steps come from evenly
    spaced coordinates with a unit of length. A text matrix may have a header as Gwyddion
    writes it (Width, Height, Value units).
    """
    path = Path(path)
    if not path.is_file():
        raise FileNotFoundError(f"no topography file {str(path)!r}")
    if length is not None and pixel_size is not None:
        raise ValueError("give length or pixel_size, not both")
    if not 0 <= max_missing < 1:
        raise ValueError(f"max_missing must be in 0 <= f < 1, got {max_missing!r}")
    suffix = path.suffix.lower()
    if suffix in (".nc", ".nc4", ".cdf"):
        raw = _read_netcdf(path, variable)
    elif suffix in (".npz", ".npy"):
        raw = _read_numpy(path, variable)
    else:
        raw = _read_text(path)
    heights = raw.heights
    if missing_value is not None:
        heights = np.where(heights == missing_value, np.nan, heights)
    steps = _steps(raw, length, pixel_size)
    heights = heights * _height_scale(raw, height_unit)
    filled, missing = fill_missing(heights, max_missing, raw.source)
    if np.ptp(filled) == 0:
        raise ValueError(f"{raw.source}: all heights are {filled.flat[0]:g} m; nothing to analyse")
    return Topography(filled, *steps, raw.source, missing)


def _height_scale(raw: _Raw, height_unit: str | None) -> float:
    """Metres per unit of height, given by the caller or by the file, which must not disagree."""
    units = [unit for unit in (height_unit, raw.unit) if unit is not None]
    if not units:
        raise ValueError(
            f"{raw.source}: the file does not tell the unit of height; give height_unit"
        )
    scales = [_metres(f"1 {unit}", f"{raw.source}: height_unit") for unit in units]
    if not np.isclose(scales[0], scales[-1], rtol=1e-12, atol=0):
        raise ValueError(
            f"{raw.source}: height_unit = {height_unit!r}, but the file says {raw.unit!r}; "
            "leave height_unit out, or correct the file"
        )
    return scales[0]


def jacksboro() -> Topography:
    """Elevations about the Jacksboro fault, Tennessee: matplotlib's sample data set.

    344 x 403 points (SRTM, 3 arc seconds); the steps in degrees are converted on the WGS 84
    ellipsoid at the mean latitude, so that they differ along x (west to east) and y.
    """
    # Only this reader needs matplotlib.
    from matplotlib import cbook

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
    raw: _Raw,
    length: Length | Sequence[Length] | None,
    pixel_size: Length | Sequence[Length] | None,
) -> tuple[float, float]:
    """Grid steps [m] as the caller says, else as the file does."""
    shape = raw.heights.shape
    if length is not None:
        sides = _sides(length, shape, f"{raw.source}: length")
        return sides[0] / shape[0], sides[1] / shape[1]
    if pixel_size is not None:
        return _sides(pixel_size, (1, 1), f"{raw.source}: pixel_size")
    if raw.steps is None:
        raise ValueError(
            f"{raw.source}: the file does not tell its size; give length or pixel_size"
        )
    return raw.steps


def _metres(value: Length, name: str) -> float:
    """Convert "10 um", or a number of metres, to metres; errors name `name`."""
    try:
        metres = value if isinstance(value, int | float) else si(value, "m")
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from None
    if not (np.isfinite(metres) and metres > 0):
        raise ValueError(f"{name} must be positive and finite, got {value!r}")
    return float(metres)


@dataclass(frozen=True)
class _Raw:
    """What a file holds: heights (nx, ny) in its own unit, what it tells of steps [m] and unit."""

    heights: NDArray
    steps: tuple[float, float] | None
    unit: str | None
    source: str


def _sides(
    value: Length | Sequence[Length], shape: tuple[int, int], name: str
) -> tuple[float, float]:
    if isinstance(value, str | int | float):
        x = _metres(value, name)
        return x, x * shape[1] / shape[0]
    if len(value) != 2:
        raise ValueError(f"{name} must be one length or two (x, y), got {value!r}")
    x, y = (_metres(v, name) for v in value)
    return x, y


def _choose(names: Sequence[str], wanted: str | None, path: Path, what: str, every: list) -> str:
    if wanted is not None:
        if wanted not in every:
            raise ValueError(f"{path}: no {what} {wanted!r}; the file has {sorted(every)}")
        if wanted not in names:
            raise ValueError(f"{path}: {what} {wanted!r} is not two-dimensional")
        return wanted
    if len(names) != 1:
        raise ValueError(
            f"{path}: needs one two-dimensional {what}, found {sorted(names)}; name one as variable"
        )
    return names[0]


def _read_netcdf(path: Path, variable: str | None) -> _Raw:
    import xarray as xr  # as matplotlib above: only this format needs it

    try:
        dataset = xr.load_dataset(path)
    except (OSError, ValueError) as error:
        raise ValueError(f"{path}: not a readable NetCDF file ({error})") from error
    names = [str(n) for n, v in dataset.data_vars.items() if v.ndim == 2]
    name = _choose(names, variable, path, "variable", [str(n) for n in dataset.variables])
    data = dataset[name]
    first, second = (str(d).lower() for d in data.dims)
    transpose = not (first in _X_NAMES or second in _Y_NAMES)
    data = data.transpose() if transpose else data
    steps = tuple(_coordinate_step(dataset, str(d), path) for d in data.dims)
    return _Raw(
        np.array(data.values, dtype=float),
        None if None in steps else steps,
        data.attrs.get("units"),
        f"{path}: {name}",
    )


def _coordinate_step(dataset, name: str, path: Path) -> float | None:
    """Step of an evenly spaced coordinate with a unit of length [m]; None if it has no unit."""
    if name not in dataset.coords or "units" not in dataset[name].attrs:
        return None
    x = np.asarray(dataset[name].values, dtype=float)
    steps = np.diff(x)
    if len(steps) == 0 or np.ptp(steps) > 1e-3 * abs(steps.mean()):
        raise ValueError(f"{path}: coordinate {name!r} is not evenly spaced; resample the data")
    try:
        unit = si(f"1 {dataset[name].attrs['units']}", "m")
    except ValueError:
        return None  # degrees, pixels: the caller must say
    return abs(float(steps.mean())) * unit


def _read_numpy(path: Path, variable: str | None) -> _Raw:
    try:
        loaded = np.load(path, allow_pickle=False)
    except (OSError, ValueError) as error:
        raise ValueError(f"{path}: not a readable numpy file ({error})") from error
    if isinstance(loaded, np.ndarray):
        if loaded.ndim != 2:
            raise ValueError(f"{path}: needs a two-dimensional array, got shape {loaded.shape}")
        return _Raw(loaded.T.astype(float), None, None, str(path))
    with loaded:
        arrays = {name: loaded[name] for name in loaded.files}
    names = [n for n, a in arrays.items() if a.ndim == 2]
    name = _choose(names, variable, path, "key", list(arrays))
    return _Raw(arrays[name].T.astype(float), None, None, f"{path}: {name}")


def _read_text(path: Path) -> _Raw:
    text = textmatrix.parse(path)
    heights = text.values.T
    steps = None
    if text.width is not None:
        # Without a height the pixels are square.
        sides = text.width if text.height is None else (text.width, text.height)
        width, height = _sides(sides, heights.shape, f"{path}: Width, Height in the header")
        steps = width / heights.shape[0], height / heights.shape[1]
    return _Raw(heights, steps, text.value_unit, str(path))
