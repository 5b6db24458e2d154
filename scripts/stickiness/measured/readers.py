"""Content of a file of measured heights: NetCDF, numpy, plain text or an instrument's format.

Instruments' formats (AFM, white light, focus variation, profilometers; some forty of them) are
read by SurfaceTopography. It is imported when it is needed: that takes two seconds.
"""

from __future__ import annotations

import re
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from stickiness.measured import plain_text
from stickiness.units import si

Length = str | float  # "10 um", or metres

INSTRUMENT = "instrument"

_FORMATS = ("netcdf", "numpy", "text")  # not by SurfaceTopography
_SUFFIXES = {
    **dict.fromkeys((".nc", ".nc4", ".cdf"), "netcdf"),
    **dict.fromkeys((".npz", ".npy"), "numpy"),
    **dict.fromkeys((".hfm", ".sdf", ".nms"), INSTRUMENT),  # text, but no matrix of heights
}
_X_NAMES = ("x", "lon", "longitude", "easting")
_Y_NAMES = ("y", "lat", "latitude", "northing")
# Channels that hold something else, some of them in metres, unless they say height.
_NO_HEIGHTS = re.compile(
    r"phase|error|deflection|amplitude|current|potential|friction|intensity|quality|confidence"
    r"|adhesion|dissipation|stiffness|modulus|deformation|thumbnail",
    re.IGNORECASE,
)
_HEIGHTS = re.compile(r"height|topo", re.IGNORECASE)
_LONGEST = 200  # characters of SurfaceTopography's words


@dataclass(frozen=True)
class Raw:
    """Content of a file; what the file does not tell is None."""

    heights: NDArray  #: (nx, ny), the first axis along x, or a line profile (n,); NaN where missing
    source: str  #: file, and variable or channel
    unit: str | None = None  #: of the heights
    #: Grid steps of a map, or positions (n,) of the points of a line profile.
    places: Sequence[float] | NDArray | None = None
    place_unit: str | None = None


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
    """Sides along every axis [m]; a single value is that along x, with square pixels."""
    if isinstance(value, str | int | float):
        x = metres(value, name)
        return tuple(x * n / shape[0] for n in shape)
    if len(value) != len(shape):
        many = "one length or two (x, y)" if len(shape) == 2 else "one length for a line profile"
        raise ValueError(f"{name} must be {many}, got {value!r}")
    return tuple(metres(v, name) for v in value)


def format_of(path: str | Path, fmt: str | None = None) -> str:
    """Return which reader a file needs: "netcdf", "numpy", "text" or "instrument".

    The name decides for NetCDF and numpy. Any other file is plain text if it is text, and an
    instrument's if it is binary, bears the name of an instrument's text format, or has a header
    in an instrument's words. `fmt` says it outright: one of these four, or SurfaceTopography's
    name of a format ("di", "sur", "x3p" …).
    """
    if fmt is not None:
        return fmt if fmt in _FORMATS else INSTRUMENT
    suffix = Path(path).suffix.lower()
    if suffix in _SUFFIXES:
        return _SUFFIXES[suffix]
    with Path(path).open("rb") as file:
        head = file.read(1 << 20)  # headers in text may be long
    if not head.startswith(plain_text.UTF16) and b"\0" in head:
        return INSTRUMENT
    header, _ = plain_text.split_header(plain_text.decode(head[: len(head) // 2 * 2]))
    return INSTRUMENT if plain_text.OF_INSTRUMENTS.search("\n".join(header)) else "text"


def read(path: Path, fmt=None, variable=None, channel=None) -> Raw:
    """Read a file with the reader that `format_of` names.

    A ValueError says that the file is not what its name or `fmt` says, that it does not hold one
    usable array or channel, or that `variable` or `channel` does not apply to it.
    """
    kind = format_of(path, fmt)
    if channel is not None and kind != INSTRUMENT:
        raise ValueError(f"{path}: a {kind} file has no channels; leave channel out")
    if variable is not None and kind in (INSTRUMENT, "text"):
        raise ValueError(f"{path}: variable is for NetCDF and npz, this is of kind {kind!r}")
    if kind == INSTRUMENT:
        return _read_instrument(path, None if fmt == INSTRUMENT else fmt, channel)
    if kind == "text":
        return _read_text(path)
    return (_read_netcdf if kind == "netcdf" else _read_numpy)(path, variable)


def _read_netcdf(path: Path, variable: str | None) -> Raw:
    import xarray as xr  # only this format needs it

    try:
        dataset = xr.load_dataset(path)
    except (OSError, ValueError) as error:
        raise ValueError(f"{path}: not a readable NetCDF file ({error})") from error
    name = _choose(dataset.variables, dataset.data_vars, variable, path, "variable")
    data = dataset[name].astype(float)
    known = {"source": f"{path}: {name}", "unit": data.attrs.get("units")}
    along = [dataset.get(dim) for dim in data.dims]
    if any(c is None or "units" not in c.attrs for c in along):
        along = None
    if data.ndim == 1:
        if along:
            known |= {"places": along[0].values.astype(float), "place_unit": along[0].units}
        return Raw(data.values, **known)
    first, second = (str(dim).lower() for dim in data.dims)
    if not (first in _X_NAMES or second in _Y_NAMES):
        data, along = data.transpose(), along and along[::-1]
    steps = [_find_step(coordinate, path) for coordinate in along or ()]
    if steps and None not in steps:
        known |= {"places": steps, "place_unit": "m"}
    return Raw(np.array(data.values), **known)


def _choose(arrays: Mapping, candidates: Mapping, wanted: str | None, path: Path, what: str) -> str:
    """Name of the array to read: the one wanted, else the only map, else the only profile."""
    if wanted is not None:
        if wanted not in arrays:
            raise ValueError(f"{path}: no {what} {wanted!r}; the file has {sorted(arrays)}")
        if arrays[wanted].ndim not in (1, 2):
            raise ValueError(f"{path}: {what} {wanted!r} is neither a map (2D) nor a profile (1D)")
        return wanted
    maps = [name for name in candidates if arrays[name].ndim == 2]
    found = maps or [name for name in candidates if arrays[name].ndim == 1]
    if len(found) != 1:
        raise ValueError(
            f"{path}: needs one two-dimensional {what}, or one profile, found {sorted(found)}; "
            "name one as variable"
        )
    return found[0]


def _find_step(coordinate, path: Path) -> float | None:
    """Step of an evenly spaced coordinate [m]; None if its unit is no length."""
    steps = np.diff(coordinate.values.astype(float))
    if len(steps) == 0 or np.ptp(steps) > 1e-3 * abs(steps.mean()):
        name = coordinate.name
        raise ValueError(f"{path}: coordinate {name!r} is not evenly spaced; resample the data")
    try:
        return abs(float(steps.mean())) * si(f"1 {coordinate.units}", "m")
    except ValueError:
        return None  # degrees, pixels: the caller must say


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
        return Raw(np.array(loaded.T, dtype=float), str(path))
    with loaded:
        arrays = dict(loaded)
    name = _choose(arrays, arrays, variable, path, "key")
    return Raw(np.array(arrays[name].T, dtype=float), f"{path}: {name}")


def _read_text(path: Path) -> Raw:
    values, header, fields = plain_text.parse(path)
    heights, known = values.T, {"source": str(path), "unit": fields.get("value unit")}
    if len(heights) == 3 and heights.shape[1] >= plain_text.FEWEST_POINTS:
        mapped, steps = plain_text.map_points(path, values)
        plain_text.check_counts(path, header, mapped.shape, heights.shape)
        return Raw(mapped, places=steps, place_unit=fields.get("lateral unit"), **known)
    if len(heights) == 1 or (len(heights) == 2 and heights.shape[1] > 2):
        # Headers of profiles count points along x, or rows of the table.
        plain_text.check_counts(path, header, heights.shape, (heights.shape[1], 1))
        if len(heights) == 1:
            return Raw(heights[0], **known)
        unit = fields.get("lateral unit")
        return Raw(heights[1], places=heights[0], place_unit=unit, **known)
    plain_text.check_counts(path, header, heights.shape)
    if "width" in fields:
        # Without a height the pixels are square.
        size = [fields[name] for name in ("width", "height") if name in fields]
        size = size if len(size) == 2 else size[0]
        size = sides(size, heights.shape, f"{path}: Width, Height in the header")
        steps = [side / n for side, n in zip(size, heights.shape, strict=True)]
        known |= {"places": steps, "place_unit": "m"}
    return Raw(heights, **known)


def _read_instrument(path: Path, fmt: str | None, channel: str | int | None) -> Raw:
    """Read a channel of heights; `fmt` as SurfaceTopography names it."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of what SurfaceTopography imports
        from SurfaceTopography import IO
    if fmt is not None and fmt not in IO.lookup_reader_by_format:
        known = ", ".join(sorted(IO.lookup_reader_by_format))
        raise ValueError(f"{path}: SurfaceTopography has no format {fmt!r}; it knows {known}")
    reader = _call(path, lambda: IO.open_topography(str(path), format=fmt))
    channels, info = _call(path, lambda: (reader.channels, reader.default_channel))
    heights_in = ", ".join(repr(c.channel_id) for c in channels if holds_heights(c))
    if channel is not None:
        named = [c for i, c in enumerate(channels) if channel in (i, c.channel_id, c.name)]
        if not named:
            there = heights_in or "no channel of heights"
            raise ValueError(f"{path}: no channel {channel!r}; the file has {there}")
        info = named[0]
    source = f"{path}: {info.name}"
    if not holds_heights(info):
        raise ValueError(f"{source} holds no heights; channels that do: {heights_in or 'none'}")
    # If the file does not hold the size, the caller must give it; until then it is in pixels.
    known = info.physical_sizes is not None
    size = {} if known else {"physical_sizes": tuple(float(n) for n in info.nb_grid_pts)}
    data = _call(path, lambda: reader.topography(channel_index=info.index, **size))
    # Points that could not be measured come masked.
    heights = np.array(np.ma.filled(np.ma.asarray(data.heights(), dtype=float), np.nan), float)
    unit = data.unit
    if not (known and unit):
        return Raw(heights, source, unit)
    if heights.ndim == 1:
        return Raw(heights, source, unit, np.asarray(data.positions(), dtype=float), unit)
    scale = metres(f"1 {unit}", f"{source}: unit of length in the file")
    lengths = zip(data.physical_sizes, heights.shape, strict=True)
    return Raw(heights, source, unit, [float(side) * scale / n for side, n in lengths], "m")


def holds_heights(channel) -> bool:
    """Whether a channel of SurfaceTopography's holds heights."""
    name = str(channel.name).rsplit("/", 1)[-1]
    if _NO_HEIGHTS.search(name) and not _HEIGHTS.search(name):
        return False
    # A pair stands for (lateral, data) where these differ in kind: no heights.
    return channel.is_height_channel and not isinstance(channel.unit, tuple)


def _call(path: Path, call: Callable):
    """Call SurfaceTopography; whatever it raises becomes one line that names the file."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return call()
        except Exception as error:  # readers of broken files raise nearly anything
            words = " ".join(re.sub("'?<_io[^>]*>'?", "", str(error)).split())
            reason = f"{type(error).__name__}: {words[:_LONGEST]}".removesuffix(": ")
            if type(error).__name__ == "CannotDetectFileFormat":
                reason = "no reader takes it; give format to see what its reader says"
            raise ValueError(
                f"{path}: SurfaceTopography cannot read it ({reason}); is the file complete? Else "
                "export it as a text matrix, .nc or .npy"
            ) from error
