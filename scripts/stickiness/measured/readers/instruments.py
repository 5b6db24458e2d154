"""Files of instruments, read by SurfaceTopography.

It is imported when it is needed, which takes two seconds.
"""

from __future__ import annotations

import io
import re
import warnings
import zipfile
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from stickiness.measured.readers.raw import Raw, check_count, read_head

EXPORT = "export the heights as text (a matrix or x y z), .npy, .nc, .gsf or X3P"
#: First bytes of surface data files, before the standard and of ISO 25178-71: else the same.
SDF = (b"aBCR-1.0", b"bBCR-1.0", b"aISO-1.0", b"bISO-1.0")
#: In names of channels and arrays; of a path, in the last of them.
HEIGHTS = re.compile(r"(?i)height|höhe|topo|z[ _-]?sensor|(?:^|[/_ ])zz?(?![a-z])")
_NO_HEIGHTS = re.compile(  # what channels hold else, some of it in metres
    r"(?i)phase|error|deflection|amplitude|current|potential|friction|intensity|quality|confidence"
    r"|adhesion|dissipation|stiffness|modulus|deformation|thumbnail|indentation|separation|slope"
)


def may_name_heights(name: str) -> bool:
    """Whether a name of a channel or an array is not that of something else than heights."""
    return not _NO_HEIGHTS.search(name) or bool(re.search("(?i)height|topo", name))


def find_heights(names: Sequence[str]) -> list[str]:
    """Names of heights, the likeliest first.

    What is called so wins over names that do not tell.

    Raises
    ------
    ValueError
        If several names may be meant, and none of them tells.
    """
    named = [name for name in names if HEIGHTS.search(name) and not _NO_HEIGHTS.search(name)]
    likely = named or [name for name in names if may_name_heights(name)]
    if len(likely) > 1 and not named:
        listed = ", ".join(map(repr, likely))
        raise ValueError(f"which of its channels holds the heights: {listed}? give channel")
    return likely


def holds_heights(channel) -> bool:
    """Whether a channel of SurfaceTopography's holds heights."""
    is_named = may_name_heights(str(channel.name).rsplit("/", 1)[-1])
    # A pair stands for (lateral, data) where these differ in kind: no heights.
    return channel.is_height_channel and is_named and not isinstance(channel.unit, tuple)


def read_channel(path: Path, reader, channel: str | int | None = None) -> Raw:
    """Read a channel of heights of a file that `open_reader` has opened."""
    channels, default = _call(path, lambda: (reader.channels, reader.default_channel))
    info = _choose_channel(channels, default, channel)
    check_count(info.nb_grid_pts)

    # If the file does not hold the size, the caller must give it; until then it is in pixels.
    is_even = info.is_uniform is not False
    has_size = info.physical_sizes is not None
    size = {}
    if is_even and not has_size:
        size["physical_sizes"] = tuple(float(points) for points in info.nb_grid_pts)
    measured = _call(path, lambda: reader.topography(channel_index=info.index, **size))
    # Points that could not be measured come masked.
    heights: NDArray = np.ma.asarray(measured.heights(), dtype=float).filled(np.nan)

    # Positions along a line, or steps of a map.
    places = None
    place_unit = measured.unit
    if heights.ndim == 1 and (has_size or not is_even):
        places = np.asarray(measured.positions(), dtype=float)
    elif has_size:
        places = np.array(measured.physical_sizes, dtype=float)
        places = places / heights.shape

    other_heights = (c for c in channels if holds_heights(c) and c.index != info.index)
    return Raw(
        heights=heights,
        source=f"{path}: {info.name}",
        unit=measured.unit,
        others=tuple(str(c.channel_id) for c in other_heights) if channel is None else (),
        places=places,
        place_unit=place_unit,
        periodic=is_even and bool(measured.is_periodic),
    )


def _choose_channel(channels: list, default, wanted: str | int | None):
    """Channel that is wanted by name or number; else the default one or another of heights."""
    usable = {str(each.channel_id): each for each in channels if holds_heights(each)}
    names = ", ".join(map(repr, usable))
    if wanted is None:
        likely = [usable[name] for name in find_heights(list(usable))]
        chosen = default if default in likely or not likely else likely[0]
    else:
        named = [c for i, c in enumerate(channels) if wanted in (i, c.channel_id, c.name)]
        if not named:
            has = names or "no channel of heights"
            raise ValueError(f"no channel {wanted!r}; the file has {has}")
        chosen = named[0]
    if not holds_heights(chosen):
        raise ValueError(f"{chosen.name} holds no heights; channels that do: {names or 'none'}")
    return chosen


def open_reader(path: Path, fmt: str | None = None):
    """Open a file with SurfaceTopography, or say in one line why it cannot."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of what SurfaceTopography imports
        from SurfaceTopography import IO
    if fmt is not None and fmt not in IO.lookup_reader_by_format:
        formats = ", ".join(sorted(IO.lookup_reader_by_format))
        raise ValueError(f"SurfaceTopography has no format {fmt!r}; it knows {formats}")
    head = read_head(path, len(SDF[0]))
    if head not in SDF[:2]:
        return _call(path, lambda: IO.open_topography(str(path), format=fmt))
    content = io.BytesIO(head.replace(b"BCR", b"ISO") + path.read_bytes()[len(head) :])
    return _call(path, lambda: IO.open_topography(content, format="sdf"))


def _call(path: Path, call: Callable):
    """Call SurfaceTopography; whatever it raises becomes one line that names the file."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return call()
        except Exception as error:  # readers of broken files raise nearly anything
            raise ValueError(_find_damage(path, error)) from error


def _find_damage(path: Path, error: Exception) -> str:
    """What is wrong with a file that SurfaceTopography cannot read, and what helps."""
    from SurfaceTopography import IO

    is_archive = zipfile.is_zipfile(path)
    words = " ".join(re.sub("'?<_io[^>]*>'?", "", str(error)).split())[:200]
    if is_archive and "main.xml" in zipfile.ZipFile(path).namelist():
        return f"the X3P file cannot be read ({_find_reason(path, 'x3p') or words}): {EXPORT}"
    if isinstance(error, IO.CorruptFile):
        return f"the file is incomplete or damaged ({words}): copy it again"
    if isinstance(error, IO.CannotDetectFileFormat):
        if is_archive:
            return "the file is a zip archive: unpack it, and give the file of heights"
        damage = _find_reader_that_finds_damage(path)
        return damage or (
            f"no reader takes it; {EXPORT} (Gwyddion reads most formats and writes these), or give "
            "format to see what its reader says"
        )
    reason = f"{type(error).__name__}: {words}".removesuffix(": ")
    return f"SurfaceTopography cannot read it ({reason}); is the file complete? Else {EXPORT}"


def _find_reason(path: Path, fmt: str) -> str:
    """What the reader of a format says of a file; empty if it takes it."""
    from SurfaceTopography import IO

    try:
        IO.lookup_reader_by_format[fmt](str(path)).topography(channel_index=0)
    except Exception as error:  # readers of broken files raise nearly anything
        return f"{type(error).__name__}: {' '.join(str(error).split())[:200]}".removesuffix(": ")
    return ""


def _find_reader_that_finds_damage(path: Path) -> str:
    """What a reader says that knows the first bytes of a file and misses others, if one does."""
    from SurfaceTopography import IO

    # To readers that do not know first bytes, a file of any bytes may be a torn one.
    head = read_head(path, 512)
    may_be_any = b"\0" in head and not head.startswith(b"\x89HDF")  # as many formats begin
    for reader in IO.readers:
        can_read = getattr(reader, "can_read", None)  # which early versions do not have
        is_sure = can_read is None or can_read(head).name == "YES"
        if reader.format() == "hgt" or (may_be_any and not is_sure):
            continue
        try:
            reader(str(path))
        except IO.CorruptFile as damage:
            return _find_damage(path, damage)
        except Exception:  # of other formats
            continue
    return ""
