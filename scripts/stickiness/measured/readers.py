"""Content of a file of measured heights: NetCDF, numpy, text or an instrument's format.

Instruments' own formats (AFM, white light, focus variation, profilometers; some forty of them) are
read by SurfaceTopography, an optional dependency (envs/instruments.txt).
"""

from __future__ import annotations

from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from stickiness.measured import instruments, text_header, text_matrix, text_points
from stickiness.measured.raw import Raw, sides
from stickiness.units import si

INSTRUMENT = "instrument"
OWN_FORMATS = ("netcdf", "numpy", "text")
INSTALL = "pip install -c envs/constraints.txt -r envs/instruments.txt"

_SUFFIXES = {".nc": "netcdf", ".nc4": "netcdf", ".cdf": "netcdf", ".npz": "numpy", ".npy": "numpy"}
_TEXT_OF_INSTRUMENTS = (".hfm", ".sdf", ".nms")  # readable, but no matrix of heights
_UTF16 = (b"\xff\xfe", b"\xfe\xff")
_X_NAMES = ("x", "lon", "longitude", "easting")
_Y_NAMES = ("y", "lat", "latitude", "northing")


def format_of(path: str | Path, fmt: str | None = None) -> str:
    """Return which reader a file needs: "netcdf", "numpy", "text" or "instrument".

    The name decides for NetCDF and numpy. Any other file is a text matrix if it is text, and an
    instrument's if it is binary, bears the name of an instrument's text format, or has a header
    in an instrument's words. `fmt` says it outright: one of these four, or SurfaceTopography's
    name of a format ("di", "sur", "x3p" …).
    """
    if fmt is not None:
        return fmt if fmt in OWN_FORMATS else INSTRUMENT
    suffix = Path(path).suffix.lower()
    if suffix in _SUFFIXES:
        return _SUFFIXES[suffix]
    if suffix in _TEXT_OF_INSTRUMENTS:
        return INSTRUMENT
    with Path(path).open("rb") as file:
        head = file.read(1 << 20)  # headers in text may be long
    if not head.startswith(_UTF16) and b"\0" in head:
        return INSTRUMENT
    header, _ = text_matrix.split_header(text_matrix.decode(head[: len(head) // 2 * 2]))
    return INSTRUMENT if text_header.is_of_instrument(header) else "text"


def can_read_instruments() -> bool:
    """Whether SurfaceTopography is installed."""
    return find_spec("SurfaceTopography") is not None


def read(
    path: Path,
    fmt: str | None = None,
    variable: str | None = None,
    channel: str | int | None = None,
) -> Raw:
    """Read a file with the reader that `format_of` names.

    Raises
    ------
    ValueError
        If the file is not what its name or `fmt` says, if it does not hold one usable array or
        channel, or if `variable` (NetCDF, npz) or `channel` (instruments) does not apply to it.
    """
    kind = format_of(path, fmt)
    if channel is not None and kind != INSTRUMENT:
        raise ValueError(f"{path}: a {kind} file has no channels; leave channel out")
    if variable is not None and kind in (INSTRUMENT, "text"):
        raise ValueError(f"{path}: variable is for NetCDF and npz, this is of kind {kind!r}")
    if kind == INSTRUMENT:
        if not can_read_instruments():
            raise ValueError(
                f"{path}: instruments' formats need SurfaceTopography, which is not installed; "
                f"run {INSTALL}"
            )
        return instruments.read(path, None if fmt == INSTRUMENT else fmt, channel)
    if kind == "netcdf":
        return _read_netcdf(path, variable)
    return _read_numpy(path, variable) if kind == "numpy" else _read_text(path)


def _choose(
    arrays: dict[str, int], candidates: Sequence[str], wanted: str | None, path: Path, what: str
) -> str:
    """Name of the array to read, of `arrays` with their dimensions: one map, else one profile."""
    if wanted is not None:
        if wanted not in arrays:
            raise ValueError(f"{path}: no {what} {wanted!r}; the file has {sorted(arrays)}")
        if arrays[wanted] not in (1, 2):
            raise ValueError(f"{path}: {what} {wanted!r} is neither a map (2D) nor a profile (1D)")
        return wanted
    maps = [name for name in candidates if arrays[name] == 2]
    found = maps or [name for name in candidates if arrays[name] == 1]
    if len(found) != 1:
        raise ValueError(
            f"{path}: needs one two-dimensional {what}, or one profile, found {sorted(found)}; "
            "name one as variable"
        )
    return found[0]


def _read_netcdf(path: Path, variable: str | None) -> Raw:
    import xarray as xr  # only this format needs it

    try:
        dataset = xr.load_dataset(path)
    except (OSError, ValueError) as error:
        raise ValueError(f"{path}: not a readable NetCDF file ({error})") from error
    arrays = {str(n): v.ndim for n, v in dataset.variables.items()}
    name = _choose(arrays, [str(n) for n in dataset.data_vars], variable, path, "variable")
    data = dataset[name]
    source, unit = f"{path}: {name}", data.attrs.get("units")
    if data.ndim == 1:
        along = str(data.dims[0])
        positions, position_unit = None, None
        if along in dataset.coords and "units" in dataset[along].attrs:
            positions = np.array(dataset[along].values, dtype=float)
            position_unit = dataset[along].attrs["units"]
        return Raw(_floats(data.values), None, unit, source, positions, position_unit)
    first, second = (str(d).lower() for d in data.dims)
    data = data if first in _X_NAMES or second in _Y_NAMES else data.transpose()
    steps = tuple(_coordinate_step(dataset, str(d), path) for d in data.dims)
    return Raw(_floats(data.values), None if None in steps else steps, unit, source)


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


def _read_numpy(path: Path, variable: str | None) -> Raw:
    try:
        loaded = np.load(path, allow_pickle=False)
    except (OSError, ValueError) as error:
        # numpy takes what it does not know for a pickle, and advises to load it all the same.
        reason = "it holds no plain array" if "pickle" in str(error) else error
        raise ValueError(f"{path}: not a readable numpy file ({reason})") from error
    if isinstance(loaded, np.ndarray):
        if loaded.ndim not in (1, 2):
            raise ValueError(
                f"{path}: needs a two-dimensional array or a profile, got shape {loaded.shape}"
            )
        return Raw(_floats(loaded.T), None, None, str(path))
    with loaded:
        arrays = {name: loaded[name] for name in loaded.files}
    dimensions = {name: array.ndim for name, array in arrays.items()}
    name = _choose(dimensions, list(arrays), variable, path, "key")
    return Raw(_floats(arrays[name].T), None, None, f"{path}: {name}")


def _read_text(path: Path) -> Raw:
    text = text_matrix.parse(path)
    table = text.values.T.shape
    if text_points.is_list(text.values):
        heights, grid = text_points.to_map(path, text.values)
        text_header.check_counts(path, text.header, heights.shape, table)
        units = {"unit": text.value_unit, "position_unit": text.lateral_unit}
        return Raw(heights, None, source=str(path), grid=grid, **units)
    heights = text.values.T
    is_profile = len(heights) == 1 or (len(heights) == 2 and heights.shape[1] > 2)
    # Headers of profiles count points along x, or rows of the table.
    also = [(heights.shape[1], 1)] if is_profile else []
    text_header.check_counts(path, text.header, table, *also)
    if len(heights) == 1:
        return Raw(heights[0], None, text.value_unit, str(path))
    if is_profile:
        units = {"unit": text.value_unit, "position_unit": text.lateral_unit}
        return Raw(heights[1], None, source=str(path), positions=heights[0], **units)
    steps = None
    if text.width is not None:
        # Without a height the pixels are square.
        size = text.width if text.height is None else (text.width, text.height)
        size = sides(size, heights.shape, f"{path}: Width, Height in the header")
        steps = tuple(side / n for side, n in zip(size, heights.shape, strict=True))
    return Raw(heights, steps, text.value_unit, str(path))


def _floats(values) -> NDArray:
    return np.array(values, dtype=float)
