"""Content of a file of measured heights: NetCDF, numpy, text or an instrument's format.

Instruments' own formats (AFM, white light, focus variation, profilometers; some forty of them) are
read by SurfaceTopography, an optional dependency (envs/instruments.txt).
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from stickiness.core.units import si
from stickiness.measured import text_matrix

Length = str | float  # "10 um", or metres

INSTRUMENT = "instrument"
OWN_FORMATS = ("netcdf", "numpy", "text")
INSTALL = "pip install -c envs/constraints.txt -r envs/instruments.txt"

_SUFFIXES = {".nc": "netcdf", ".nc4": "netcdf", ".cdf": "netcdf", ".npz": "numpy", ".npy": "numpy"}
_TEXT_OF_INSTRUMENTS = (".xyz", ".hfm", ".sdf", ".nms")  # readable, but no matrix of heights
_UTF16 = (b"\xff\xfe", b"\xfe\xff")
_X_NAMES = ("x", "lon", "longitude", "easting")
_Y_NAMES = ("y", "lat", "latitude", "northing")


@dataclass(frozen=True)
class Raw:
    """Content of a file, heights in the file's own unit."""

    heights: NDArray  # (nx, ny), the first axis along x, or a line profile (n,); NaN where missing
    # grid steps [m]; None: the file does not tell (all below likewise)
    steps: tuple[float, ...] | None
    unit: str | None  # of the heights
    source: str  # file, and variable or channel
    positions: NDArray | None = None  # (n,), where a line profile was taken if not evenly
    position_unit: str | None = None


def format_of(path: str | Path, fmt: str | None = None) -> str:
    """Return which reader a file needs: "netcdf", "numpy", "text" or "instrument".

    The name decides for NetCDF and numpy; any other file is a text matrix if it is text, and an
    instrument's if it is binary or bears the name of an instrument's text format. `fmt` says it
    outright: one of these four, or SurfaceTopography's name of a format ("di", "sur", "x3p" …).
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
    return "text" if head.startswith(_UTF16) or b"\0" not in head else INSTRUMENT


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
        return _read_instrument(path, None if fmt == INSTRUMENT else fmt, channel)
    if kind == "netcdf":
        return _read_netcdf(path, variable)
    return _read_numpy(path, variable) if kind == "numpy" else _read_text(path)


def metres(value: Length, name: str) -> float:
    """Convert "10 um", or a number of metres, to metres; errors name `name`."""
    try:
        length = value if isinstance(value, int | float) else si(value, "m")
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from None
    if not (np.isfinite(length) and length > 0):
        raise ValueError(f"{name} must be positive and finite, got {value!r}")
    return float(length)


def sides(value: Length | Sequence[Length], shape: tuple[int, ...], name: str) -> tuple[float, ...]:
    """Sides along every axis; a single value is that along x, with square pixels."""
    if isinstance(value, str | int | float):
        x = metres(value, name)
        return tuple(x * n / shape[0] for n in shape)
    if len(value) != len(shape):
        many = "one length or two (x, y)" if len(shape) == 2 else "one length for a line profile"
        raise ValueError(f"{name} must be {many}, got {value!r}")
    return tuple(metres(v, name) for v in value)


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
        raise ValueError(f"{path}: not a readable numpy file ({error})") from error
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
    heights = text.values.T
    if len(heights) == 1:
        return Raw(heights[0], None, text.value_unit, str(path))
    if len(heights) == 2 and heights.shape[1] > 2:
        return Raw(heights[1], None, text.value_unit, str(path), positions=heights[0])
    steps = None
    if text.width is not None:
        # Without a height the pixels are square.
        size = text.width if text.height is None else (text.width, text.height)
        size = sides(size, heights.shape, f"{path}: Width, Height in the header")
        steps = tuple(side / n for side, n in zip(size, heights.shape, strict=True))
    return Raw(heights, steps, text.value_unit, str(path))


def _read_instrument(path: Path, fmt: str | None, channel: str | int | None) -> Raw:
    if not can_read_instruments():
        raise ValueError(
            f"{path}: instruments' formats need SurfaceTopography, which is not installed; "
            f"run {INSTALL}"
        )
    reader = _guard(path, lambda io: io.open_topography(str(path), format=fmt))
    info = _channel(reader, channel, path)
    source = f"{path}: {info.name}"
    if not _holds_heights(info):
        heights = ", ".join(repr(c.channel_id) for c in reader.channels if _holds_heights(c))
        raise ValueError(f"{source} holds no heights; channels that do: {heights or 'none'}")
    # If the file does not hold the size, the caller must give it; until then it is in pixels.
    known = info.physical_sizes is not None
    size = {} if known else {"physical_sizes": tuple(float(n) for n in info.nb_grid_pts)}
    data = _guard(path, lambda _: reader.topography(channel_index=info.index, **size))
    unit = data.unit
    scale = metres(f"1 {unit}", f"{source}: unit of length in the file") if known and unit else None
    # Points that could not be measured come masked.
    heights = _floats(np.ma.filled(np.ma.asarray(data.heights(), dtype=float), np.nan))
    if heights.ndim == 1:
        positions = np.asarray(data.positions(), dtype=float) if scale else None
        return Raw(heights, None, unit, source, positions, unit)
    steps = None
    if scale is not None:
        steps = tuple(
            float(side) * scale / n
            for side, n in zip(data.physical_sizes, heights.shape, strict=True)
        )
    return Raw(heights, steps, unit, source)


def _holds_heights(channel) -> bool:
    # A pair stands for (lateral, data) where these differ in kind: no heights.
    return channel.is_height_channel and not isinstance(channel.unit, tuple)


def _guard(path: Path, call: Callable):
    """Call SurfaceTopography; whatever it raises becomes one line that names the file."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of its own dependencies
        from SurfaceTopography import IO

        try:
            return call(IO)
        except Exception as error:  # readers of broken files raise nearly anything
            reason = " ".join(str(error).split()) or "no reason given"
            raise ValueError(
                f"{path}: SurfaceTopography cannot read it ({type(error).__name__}: {reason[:200]})"
            ) from error


def _channel(reader, wanted: str | int | None, path: Path):
    """Return the channel named (or counted from 0), else the file's default."""
    channels = reader.channels
    if wanted is None:
        return reader.default_channel
    if isinstance(wanted, int) and 0 <= wanted < len(channels):
        return channels[wanted]
    named = [c for c in channels if wanted in (c.channel_id, c.name)]
    if not named:
        names = ", ".join(repr(c.channel_id) for c in channels)
        raise ValueError(f"{path}: no channel {wanted!r}; the file has {names}")
    return named[0]


def _floats(values) -> NDArray:
    return np.array(values, dtype=float)
