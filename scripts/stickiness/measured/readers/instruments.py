"""Files of instruments, read by SurfaceTopography.

It is imported when it is needed, which takes two seconds.
"""

from __future__ import annotations

import io
import re
import warnings
import zipfile
from collections.abc import Callable
from pathlib import Path

import numpy as np

from stickiness.measured.readers.raw import Raw, check_count, metres_per

EXPORT = "export the heights as text (a matrix or x y z), .npy, .nc, .gsf or X3P"
#: First bytes of surface data files, before the standard and of ISO 25178-71: else the same.
SDF = (b"aBCR-1.0", b"bBCR-1.0", b"aISO-1.0", b"bISO-1.0")
_X3P = "main.xml"  # in the archive
_HDF5 = b"\x89HDF"  # first bytes of many formats

# Channels that hold something else, some of them in metres, unless they say height.
NO_HEIGHTS = re.compile(
    r"phase|error|deflection|amplitude|current|potential|friction|intensity|quality|confidence"
    r"|adhesion|dissipation|stiffness|modulus|deformation|thumbnail",
    re.IGNORECASE,
)
HEIGHTS = re.compile(r"height|topo", re.IGNORECASE)


def read_channel(path: Path, reader, channel: str | int | None = None) -> Raw:
    """Read a channel of heights of a file that `open_reader` has opened."""
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
    check_count(info.nb_grid_pts)
    # If the file does not hold the size, the caller must give it; until then it is in pixels.
    is_even = info.is_uniform is not False
    has_size = info.physical_sizes is not None
    size = {"physical_sizes": tuple(float(n) for n in info.nb_grid_pts)}
    size = size if is_even and not has_size else {}
    data = _call(path, lambda: reader.topography(channel_index=info.index, **size))
    # Points that could not be measured come masked.
    heights = np.array(np.ma.filled(np.ma.asarray(data.heights(), dtype=float), np.nan), float)
    unit = data.unit
    places = None
    place_unit = unit
    if heights.ndim == 1 and (has_size or not is_even):
        places = np.asarray(data.positions(), dtype=float)
    elif has_size:
        told = np.array(data.physical_sizes, dtype=float)
        if unit:
            told = told * metres_per(unit, f"{info.name}: unit of length in the file")
            place_unit = "m"
        places = told / heights.shape
    others = [str(c.channel_id) for c in usable if channel is None and c.index != info.index]
    periodic = is_even and bool(data.is_periodic)
    return Raw(heights, source, unit, tuple(others), places, place_unit, periodic)


def open_reader(path: Path, fmt: str | None = None):
    """Open a file with SurfaceTopography, or say in one line why it cannot."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of what SurfaceTopography imports
        from SurfaceTopography import IO
    if fmt is not None and fmt not in IO.lookup_reader_by_format:
        formats = ", ".join(sorted(IO.lookup_reader_by_format))
        raise ValueError(f"SurfaceTopography has no format {fmt!r}; it knows {formats}")
    with path.open("rb") as file:
        head = file.read(len(SDF[0]))
    if head not in SDF[:2]:
        return _call(path, lambda: IO.open_topography(str(path), format=fmt))
    content = io.BytesIO(head.replace(b"BCR", b"ISO") + path.read_bytes()[len(head) :])
    return _call(path, lambda: IO.open_topography(content, format="sdf"))


def holds_heights(channel) -> bool:
    """Whether a channel of SurfaceTopography's holds heights."""
    name = str(channel.name).rsplit("/", 1)[-1]
    other = NO_HEIGHTS.search(name) and not HEIGHTS.search(name)
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
        return f"the X3P file cannot be read ({_find_reason(path, 'x3p') or words}): {EXPORT}"
    if isinstance(error, IO.CorruptFile):
        return f"the file is incomplete or damaged ({words}): copy it again"
    reason = f"{type(error).__name__}: {words}".removesuffix(": ")
    if isinstance(error, IO.CannotDetectFileFormat):
        if zipfile.is_zipfile(path):
            return "the file is a zip archive: unpack it, and give the file of heights"
        # Readers that know the first bytes may find that others are missing. To those that do not,
        # a file of any bytes may be a torn one.
        with path.open("rb") as file:
            head = file.read(512)
        for reader in IO.readers:
            can_read = getattr(reader, "can_read", None)  # which early versions do not have
            is_sure = can_read is None or can_read(head).name == "YES" or head.startswith(_HDF5)
            if reader.format() == "hgt" or not is_sure and b"\0" in head:
                continue
            try:
                reader(str(path))
            except IO.CorruptFile as damage:
                return _find_damage(path, damage)
            except Exception:  # of other formats
                continue
        return (
            f"no reader takes it; {EXPORT} (Gwyddion reads most formats and writes these), or give "
            "format to see what its reader says"
        )
    return f"SurfaceTopography cannot read it ({reason}); is the file complete? Else {EXPORT}"
