"""Content of a file of measured heights: NetCDF, numpy, plain text or an instrument's format.

SurfaceTopography reads the formats of instruments; it is imported when it is needed, which takes
two seconds. But it takes every line of text that it cannot read for a header, in silence, and knows
neither decimal commas nor separators other than blanks. So plain text is read here, with the header
that Gwyddion writes. What neither reads is refused: heights would be wrong without notice.
"""

from __future__ import annotations

import re
import warnings
import zipfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from stickiness.units import si

Length = str | float  # "10 um", or metres

INSTRUMENT = "instrument"
_UTF16 = (b"\xff\xfe", b"\xfe\xff")  # first bytes
_EXCEL = (
    "the file is an Excel workbook: save its sheet of heights as text (CSV), without other "
    "columns; a profile of Mitutoyo SurfTest may stay an .xlsx with its sheets DATA and Certificate"
)
_MITUTOYO = (b'name="DATA"', b'name="Certificate"')  # sheets
_X3P = "main.xml"  # in the archive
_SLACK = 0.01  # of a step, by which positions may be off the grid
_MOST_EMPTY = 0.5  # share of the grid that may have no point; more are scattered points

# Channels that hold something else, some of them in metres, unless they say height.
_NO_HEIGHTS = re.compile(
    r"phase|error|deflection|amplitude|current|potential|friction|intensity|quality|confidence"
    r"|adhesion|dissipation|stiffness|modulus|deformation|thumbnail",
    re.IGNORECASE,
)
_HEIGHTS = re.compile(r"height|topo", re.IGNORECASE)
# How a row begins: with a number, or with missing points before one.
_NUMERIC = re.compile(r"(?:(?:-{1,3}|\*{1,3})?[\s;,]+)*(?:-?nan\b|[-+]?\.?\d)", re.IGNORECASE)
_FIELD = re.compile(
    r"^\W*(width|height|value unit|lateral unit|breite|höhe|werteinheit|laterale einheit)(?:s|en)?"
    r"\s*[:=]\s*(.+?)\s*$",
    re.I,
)
_GERMAN = {  # fields as Gwyddion writes them in German
    "breite": "width",
    "höhe": "height",
    "werteinheit": "value unit",
    "laterale einheit": "lateral unit",
}
# What SurfaceTopography takes from headers and this reader does not.
_OF_INSTRUMENTS = re.compile(
    r"pixel\s+size\s*=|height\s+conversion\s+factor|\b[xy]-length\b|\b[xyz]-unit\b|\bbit2nm\b"
    r"|wyko ascii|file format\s*=\s*ascii|^\W*unit (x|data)\s*=|^\W*scale [xy]\s*="
    r"|^\s*x;y;valid|^\s*scan data\b|^\W*lateral um",
    re.IGNORECASE | re.MULTILINE,
)
_FACTOR = re.compile(
    r"factor|scal(e|ing)\b|multiplier|conversion|(\bper|/)\s*(count|bit|digit|lsb)s?\b", re.I
)
# Factors of pictures and axes, unless heights are named beside them.
_OF_NO_HEIGHTS = re.compile(
    r"^(?!.*(\bz\b|height|vertical|count|data)).*(zoom|colou?r|\bbar\b|\b[xy]\b)", re.IGNORECASE
)
# A number of points: at the start of a line or after another number, without a unit.
_COUNT = r"(?:^\W*|\d[\s,;]+)(?:{})\s*[:=]\s*(\d+)(?![\w./])"
_COLUMNS = re.compile(_COUNT.format("nx|columns|cols|x[-_ ]?pixels?"), re.IGNORECASE)
_ROWS = re.compile(_COUNT.format("ny|rows|y[-_ ]?pixels?"), re.IGNORECASE)


@dataclass(frozen=True)
class Raw:
    """Content of a file; what the file does not tell is None."""

    heights: NDArray  #: (nx, ny), the first axis along x, or a line profile (n,); NaN where missing
    source: str  #: file, and variable or channel
    unit: str | None = None  #: of the heights
    others: tuple[str, ...] = ()  #: channels or variables to choose from, if none was named
    places: NDArray | None = None  #: steps of a map, or positions on a line (n,)
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


def find_packing(path: str | Path) -> str:
    """What to do with a file before it can be read, if it is packed or empty; else nothing."""
    with Path(path).open("rb") as file:
        head = file.read(8)
    if not head:
        return "the file is empty: copy it again"
    if head.startswith(b"PK\3\4"):
        if not zipfile.is_zipfile(path):
            return "the file is incomplete, its end is missing: copy it again"
        with zipfile.ZipFile(path) as archive:
            if "xl/workbook.xml" not in archive.namelist():
                return ""
            book = archive.read("xl/workbook.xml")
            return "" if all(sheet in book for sheet in _MITUTOYO) else _EXCEL
    if head.startswith(b"\xd0\xcf\x11\xe0"):  # of an old version
        return _EXCEL
    packings = {
        b"\x1f\x8b": "gzip",
        b"\x1f\x9d": "compress",
        b"BZh": "bzip2",
        b"\xfd7zXZ\0": "xz",
        b"7z\xbc\xaf\x27\x1c": "7z",
    }
    for start, packing in packings.items():
        if head.startswith(start):
            return f"the file is compressed ({packing}): unpack it, and give the file inside"
    return ""


def format_of(path: str | Path, fmt: str | None = None) -> str:
    """Return which reader a file needs: "netcdf", "numpy", "text" or "instrument"."""
    if fmt is not None:
        return fmt if fmt in ("netcdf", "numpy", "text") else INSTRUMENT
    suffix = Path(path).suffix.lower()
    if suffix in (".nc", ".nc4", ".cdf"):
        return "netcdf"
    if suffix in (".npz", ".npy"):
        return "numpy"
    if suffix in (".hfm", ".sdf", ".nms"):  # text, but no matrix of heights
        return INSTRUMENT
    with Path(path).open("rb") as file:
        head = file.read(1 << 20)  # headers in text may be long
    if not head.startswith(_UTF16) and b"\0" in head:
        return INSTRUMENT
    header, _ = _split_header(head[: len(head) // 2 * 2])
    return INSTRUMENT if _OF_INSTRUMENTS.search("\n".join(header)) else "text"


def read(path: Path, fmt=None, variable=None, channel=None) -> Raw:
    """Read a file with the reader that `format_of` names; errors name the file."""
    try:
        if advice := find_packing(path):
            raise ValueError(advice)
        kind = format_of(path, fmt)
        if channel is not None and kind != INSTRUMENT:
            raise ValueError(f"a {kind} file has no channels; leave channel out")
        if variable is not None and kind in (INSTRUMENT, "text"):
            raise ValueError(f"variable is for NetCDF and npz, this is of kind {kind!r}")
        if kind == INSTRUMENT:
            return _read_instrument(path, None if fmt == INSTRUMENT else fmt, channel)
        if kind == "text":
            return _read_text(path)
        if kind == "netcdf":
            return _read_netcdf(path, variable)
        return _read_numpy(path, variable)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from error


def _read_netcdf(path: Path, variable: str | None) -> Raw:
    import xarray as xr  # only this format needs it

    try:
        dataset = xr.load_dataset(path)
    except (OSError, ValueError) as error:
        raise ValueError(f"not a readable NetCDF file ({error})") from error
    name, others = _choose(dataset.variables, dataset.data_vars, variable, "variable")
    data = dataset[name].astype(float)
    if data.ndim == 2:
        first, second = (str(dim).lower() for dim in data.dims)
        first_is_x = first in ("x", "lon", "longitude", "easting")
        second_is_y = second in ("y", "lat", "latitude", "northing")
        if not (first_is_x or second_is_y):
            data = data.transpose()
    places = None
    place_unit = None
    coordinates = [dataset[dim] for dim in data.dims]
    if all("units" in c.attrs for c in coordinates):
        if data.ndim == 1:
            places = coordinates[0].values.astype(float)
            place_unit = coordinates[0].units
        else:
            steps = [_find_step(coordinate) for coordinate in coordinates]
            if None not in steps:
                places = np.array(steps)
                place_unit = "m"
    return Raw(
        heights=np.array(data.values),
        source=f"{path}: {name}",
        unit=data.attrs.get("units"),
        others=others,
        places=places,
        place_unit=place_unit,
    )


def _choose(
    arrays: Mapping, candidates: Mapping, wanted: str | None, what: str
) -> tuple[str, tuple[str, ...]]:
    """Array to read: the one wanted; else the only map or the only profile, and the others."""
    if wanted is not None:
        if wanted not in arrays:
            raise ValueError(f"no {what} {wanted!r}; the file has {sorted(arrays)}")
        if arrays[wanted].ndim not in (1, 2):
            raise ValueError(f"{what} {wanted!r} is neither a map (2D) nor a profile (1D)")
        return wanted, ()
    usable = [name for name in candidates if arrays[name].ndim in (1, 2)]
    eligible = [name for name in usable if arrays[name].ndim == 2] or usable
    if len(eligible) != 1:
        raise ValueError(
            f"needs one two-dimensional {what}, or one profile, found {sorted(eligible)}; name "
            "one as variable"
        )
    chosen = eligible[0]
    return chosen, tuple(name for name in usable if name != chosen)


def _find_step(coordinate) -> float | None:
    """Step of an evenly spaced coordinate [m]; None if its unit is no length."""
    steps = np.diff(coordinate.values.astype(float))
    if len(steps) == 0 or np.ptp(steps) > 1e-3 * abs(steps.mean()):
        raise ValueError(f"coordinate {coordinate.name!r} is not evenly spaced; resample the data")
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
        raise ValueError(f"not a readable numpy file ({reason})") from error
    if isinstance(loaded, np.ndarray):
        if loaded.ndim not in (1, 2):
            shape = loaded.shape
            raise ValueError(f"needs a two-dimensional array or a profile, got shape {shape}")
        return Raw(np.array(loaded.T, dtype=float), str(path))
    with loaded:
        arrays = dict(loaded)
    name, others = _choose(arrays, arrays, variable, "key")
    return Raw(np.array(arrays[name].T, dtype=float), f"{path}: {name}", others=others)


def _read_text(path: Path) -> Raw:
    """Read a matrix, one or two columns of a profile, or a list of points x y z."""
    header, rows = _split_header(path.read_bytes())
    if not rows:
        raise ValueError(
            "no line of numbers found; expected a matrix of heights, or give format: "
            "instrument if it is an instrument's file"
        )
    for line in header:
        if _OF_INSTRUMENTS.search(line):
            raise ValueError(
                f"its header says {line!r}, which the text reader does not take; give format: "
                "instrument"
            )
        if _FACTOR.search(line) and re.search(r"\d", line) and not _OF_NO_HEIGHTS.search(line):
            raise ValueError(
                f"its header says {line!r}, which is not read; apply it to the heights and remove "
                "the line, or try format: instrument"
            )
    matches = [match for match in map(_FIELD.match, header) if match]
    fields = {_GERMAN.get(match[1].lower(), match[1].lower()): match[2] for match in matches}
    if matches and matches[0][1].lower() in _GERMAN:
        fields = {name: text.replace(",", ".") for name, text in fields.items()}
    heights = _read_rows(rows).T
    places = None
    place_unit = fields.get("lateral unit")
    columns, count = heights.shape
    if columns > 3 and count > 3:
        _refuse_positions(heights)
    shapes = [heights.shape]  # (columns, rows) that the header may mean
    if columns == 3 and count >= 16:  # fewer rows of three numbers are a matrix
        heights, places = _map_points(heights)
        shapes.insert(0, heights.shape)
    elif columns == 1 or (columns == 2 and count > 2):
        # Headers of profiles count points along x, or rows of the table.
        shapes.append((count, 1))
        places = heights[0] if columns == 2 else None
        heights = heights[-1]
    elif "width" in fields:
        told = [fields[name] for name in ("width", "height") if name in fields]
        # Without a height the pixels are square.
        of_axes = told if len(told) == 2 else told[0]
        size = sides(of_axes, heights.shape, "Width, Height in the header")
        places = np.divide(size, heights.shape)
        place_unit = "m"
    _check_counts(header, shapes)
    return Raw(heights, str(path), fields.get("value unit"), (), places, place_unit)


def _refuse_positions(heights: NDArray) -> None:
    """Refuse a matrix whose first column or row has even steps, unlike the next: positions."""
    for name, lines in (("column", heights), ("row", heights.T)):
        steps = np.diff(lines[:2, 1:], axis=1)
        if not np.all(np.isfinite(steps)):
            continue
        is_even = np.ptp(steps, axis=1) <= 1e-3 * np.abs(steps.mean(axis=1))
        if is_even[0] and not is_even[1]:
            raise ValueError(
                f"the first {name} rises in even steps of {steps[0].mean():g}, as positions do: "
                "remove it if it holds no heights"
            )


def _check_counts(header: list[str], shapes: list[tuple[int, ...]]) -> None:
    """Check the columns and rows that a header names against the shapes that they may mean."""
    for axis, (name, pattern) in enumerate((("columns", _COLUMNS), ("rows", _ROWS))):
        for line in header:
            match = pattern.search(line)
            if match and int(match[1]) not in (shape[axis] for shape in shapes):
                raise ValueError(
                    f"{shapes[0][axis]} {name}, but its header says {line!r}; is the file "
                    "complete, and do decimal commas or separators split its numbers?"
                )


def _split_header(raw: bytes) -> tuple[list[str], list[tuple[int, str]]]:
    """Comments and lines before the first row, and the rows with their line numbers."""
    try:
        text = raw.decode("utf-16" if raw.startswith(_UTF16) else "utf-8-sig")
    except UnicodeDecodeError:
        text = raw.decode("latin-1")  # older instruments write µ as one byte
    header: list[str] = []
    rows: list[tuple[int, str]] = []
    for number, line in enumerate(text.splitlines(), start=1):
        stripped = line.strip(" \r\n")
        is_comment = stripped.startswith(("#", "%", "//"))
        if is_comment or not (rows or _NUMERIC.match(stripped)):
            header.append(stripped)
        elif stripped.strip():
            rows.append((number, stripped))
    return header, rows


def _read_rows(rows: list[tuple[int, str]]) -> NDArray:
    first = rows[0][1]
    separator = next((mark for mark in "\t;" if mark in first), None)  # None: any run of blanks
    # "1,5 2,5" has decimal commas, "1.5, 2.5" and "1,2,3" separating ones.
    if separator is None and re.search(r",\s|^[^ ]*,[^ ]*$", first):
        separator = ","
    missing = {"", "na", "n/a", "bad", "null", "none", "-nan", "-", "--", "---", "*", "***"}
    values: list[list[float]] = []
    for number, line in rows:
        fields = (line if separator == "," else line.replace(",", ".")).split(separator)
        if separator and len(fields) > 1 and not fields[-1].strip():
            fields.pop()  # a separator after the last number
        try:
            row = [np.nan if f.strip().lower() in missing else float(f) for f in fields]
        except ValueError as error:
            raise ValueError(
                f"line {number}: {error}; mark missing points by NaN and comment lines by #"
            ) from None
        if values and len(row) != len(values[0]):
            raise ValueError(
                f"line {number}: {len(row)} numbers where the first row has {len(values[0])}; "
                "every row needs as many"
            )
        values.append(row)
    matrix = np.array(values)
    # Do columns by turns hold whole numbers and their decimals: close to the next but one?
    pairs = matrix.shape[1] >= 4 and matrix.shape[1] % 2 == 0 and not np.any(matrix[:, 1::2] < 0)
    if separator == "," and "." not in first and pairs:
        beside = np.nanmedian(np.abs(np.diff(matrix, axis=1)))
        whole = np.nanmedian(np.abs(np.diff(matrix[:, ::2], axis=1)))
        if beside > 5 * whole:
            raise ValueError(
                f"{matrix.shape[1]} columns without a decimal point that alternate: "
                "decimal commas, which its separating commas hide; separate by tabs or "
                "semicolons, or write decimal points"
            )
    return matrix


def _map_points(points: NDArray) -> tuple[NDArray, NDArray]:
    """Heights (nx, ny) of points (3, n) in any order, NaN where there is none, and grid steps."""
    points = points[:, np.isfinite(points[:2]).all(axis=0)]
    i, dx = _index(points[0], "x")
    j, dy = _index(points[1], "y")
    heights = np.full((int(i.max()) + 1, int(j.max()) + 1), np.nan)
    if points.shape[1] < (1 - _MOST_EMPTY) * heights.size:
        raise ValueError(
            f"three columns, which as x y z leave most of a grid of {heights.shape[0]} x "
            f"{heights.shape[1]} points empty; resample them on a grid, or export a matrix"
        )
    if len(np.unique(i * heights.shape[1] + j)) < points.shape[1]:
        raise ValueError("as x y z it has two points at one place; remove one")
    heights[i, j] = points[2]
    return heights, np.array([dx, dy])


def _index(positions: NDArray, name: str) -> tuple[NDArray, float]:
    """Index of every position on an even grid, and its step."""
    levels = np.unique(positions)
    gaps = np.diff(levels)
    if gaps.size == 0:
        raise ValueError(f"three columns, which as x y z all have one {name}")
    gaps = gaps[gaps > _SLACK * gaps.max()]  # positions that differ by rounding only
    # Gaps of rounded positions differ: one step is the mean of the short ones, and then what
    # fits the whole side.
    step = gaps[gaps < 1.5 * gaps.min()].mean()
    step = float((levels[-1] - levels[0]) / np.rint(gaps / step).sum())
    index = (positions - levels[0]) / step
    if np.abs(index - np.rint(index)).max() > 10 * _SLACK:
        raise ValueError(
            f"three columns, which as x y z are on no even grid along {name}; resample "
            "them on a grid, or export a matrix"
        )
    return np.rint(index).astype(int), step


def _read_instrument(path: Path, fmt: str | None, channel: str | int | None) -> Raw:
    """Read a channel of heights; `fmt` as SurfaceTopography names it."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of what SurfaceTopography imports
        from SurfaceTopography import IO
    if fmt is not None and fmt not in IO.lookup_reader_by_format:
        formats = ", ".join(sorted(IO.lookup_reader_by_format))
        raise ValueError(f"SurfaceTopography has no format {fmt!r}; it knows {formats}")
    reader = _call(path, lambda: IO.open_topography(str(path), format=fmt))
    channels, info = _call(path, lambda: (reader.channels, reader.default_channel))
    usable = [c for c in channels if holds_heights(c)]
    heights_in = ", ".join(repr(c.channel_id) for c in usable)
    if channel is None and usable and not holds_heights(info):
        info = usable[0]
    if channel is not None:
        named = [c for i, c in enumerate(channels) if channel in (i, c.channel_id, c.name)]
        if not named:
            has = heights_in or "no channel of heights"
            raise ValueError(f"no channel {channel!r}; the file has {has}")
        info = named[0]
    source = f"{path}: {info.name}"
    if not holds_heights(info):
        raise ValueError(f"{info.name} holds no heights; channels that do: {heights_in or 'none'}")
    # If the file does not hold the size, the caller must give it; until then it is in pixels.
    has_size = info.physical_sizes is not None
    size = {} if has_size else {"physical_sizes": tuple(float(n) for n in info.nb_grid_pts)}
    data = _call(path, lambda: reader.topography(channel_index=info.index, **size))
    # Points that could not be measured come masked.
    heights = np.array(np.ma.filled(np.ma.asarray(data.heights(), dtype=float), np.nan), float)
    unit = data.unit
    places = None
    place_unit = "m"
    if has_size and unit and heights.ndim == 1:
        places = np.asarray(data.positions(), dtype=float)
        place_unit = unit
    elif has_size and unit:
        scale = metres(f"1 {unit}", f"{info.name}: unit of length in the file")
        places = np.array(data.physical_sizes, dtype=float) * scale / heights.shape
    others = [str(c.channel_id) for c in usable if channel is None and c.index != info.index]
    return Raw(heights, source, unit, tuple(others), places, place_unit)


def holds_heights(channel) -> bool:
    """Whether a channel of SurfaceTopography's holds heights."""
    name = str(channel.name).rsplit("/", 1)[-1]
    other = _NO_HEIGHTS.search(name) and not _HEIGHTS.search(name)
    # A pair stands for (lateral, data) where these differ in kind: no heights.
    return channel.is_height_channel and not other and not isinstance(channel.unit, tuple)


def _call(path: Path, call: Callable):
    """Call SurfaceTopography; whatever it raises becomes one line that names the file."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return call()
        except Exception as error:  # readers of broken files raise nearly anything
            raise ValueError(_find_damage(path, error)) from error


def _find_reason(path: Path, fmt: str) -> str:
    """What the reader of a format says of a file; empty if it takes it."""
    from SurfaceTopography import IO

    try:
        reader = IO.lookup_reader_by_format[fmt](str(path))
        reader.topography(channel_index=0)
    except Exception as error:  # readers of broken files raise nearly anything
        return f"{type(error).__name__}: {' '.join(str(error).split())[:200]}".removesuffix(": ")
    return ""


def _find_damage(path: Path, error: Exception) -> str:
    """What is wrong with a file that SurfaceTopography cannot read, and what helps."""
    from SurfaceTopography import IO

    words = " ".join(re.sub("'?<_io[^>]*>'?", "", str(error)).split())[:200]
    if zipfile.is_zipfile(path) and _X3P in zipfile.ZipFile(path).namelist():
        return (
            f"the X3P file cannot be read ({_find_reason(path, 'x3p') or words}): export the "
            "heights as a text matrix, .sur, .nc or .npy"
        )
    if isinstance(error, IO.CorruptFile):
        return f"the file is incomplete or damaged ({words}): copy it again"
    reason = f"{type(error).__name__}: {words}".removesuffix(": ")
    if isinstance(error, IO.CannotDetectFileFormat):
        if zipfile.is_zipfile(path):
            return "the file is a zip archive: unpack it, and give the file of heights"
        # Readers that know the first bytes may find that others are missing; any may be an hgt.
        for reader in (reader for reader in IO.readers if reader.format() != "hgt"):
            try:
                reader(str(path))
            except IO.CorruptFile as damage:
                return _find_damage(path, damage)
            except Exception:  # of other formats
                continue
        reason = "no reader takes it; give format to see what its reader says"
    return (
        f"SurfaceTopography cannot read it ({reason}); is the file complete? Else export it as a "
        "text matrix, .nc or .npy"
    )
