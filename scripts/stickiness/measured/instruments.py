"""Files as instruments wrote them, by SurfaceTopography, an optional dependency."""

from __future__ import annotations

import difflib
import re
import warnings
from collections.abc import Callable
from pathlib import Path

import numpy as np

from stickiness.measured.raw import Raw, metres

_HEAD = 4096  # bytes by which SurfaceTopography tells formats
_LONGEST = 200  # characters of a reader's own words
# Names of channels that hold something else, some of them in metres, unless they say height.
_NO_HEIGHTS = re.compile(
    r"phase|error|deflection|amplitude|current|potential|friction|intensity|quality|confidence"
    r"|adhesion|dissipation|stiffness|modulus|deformation|thumbnail",
    re.IGNORECASE,
)
_HEIGHTS = re.compile(r"height|topo", re.IGNORECASE)


def read(path: Path, fmt: str | None, channel: str | int | None) -> Raw:
    """Read a channel of heights, by default the file's own; `fmt` as SurfaceTopography names it.

    A ValueError says in the reader's own words what is wrong with the file, or which channels
    hold heights.
    """
    reader = _open(path, fmt)
    channels, default = _guard(path, lambda: (reader.channels, reader.default_channel))
    info = default if channel is None else _channel(channels, channel, path)
    source = f"{path}: {info.name}"
    if not holds_heights(info):
        heights = ", ".join(repr(c.channel_id) for c in channels if holds_heights(c))
        raise ValueError(f"{source} holds no heights; channels that do: {heights or 'none'}")
    # If the file does not hold the size, the caller must give it; until then it is in pixels.
    known = info.physical_sizes is not None
    size = {} if known else {"physical_sizes": tuple(float(n) for n in info.nb_grid_pts)}
    data = _guard(path, lambda: reader.topography(channel_index=info.index, **size))
    unit = data.unit
    scale = metres(f"1 {unit}", f"{source}: unit of length in the file") if known and unit else None
    # Points that could not be measured come masked.
    heights = np.array(np.ma.filled(np.ma.asarray(data.heights(), dtype=float), np.nan), float)
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


def holds_heights(channel) -> bool:
    """Whether a channel of SurfaceTopography's holds heights."""
    name = str(channel.name).rsplit("/", 1)[-1]
    if _NO_HEIGHTS.search(name) and not _HEIGHTS.search(name):
        return False
    # A pair stands for (lateral, data) where these differ in kind: no heights.
    return channel.is_height_channel and not isinstance(channel.unit, tuple)


def _open(path: Path, fmt: str | None):
    """Open a file. Of several readers that fail, the one of its format has the word."""
    io = _library()
    if fmt is not None and fmt not in io.lookup_reader_by_format:
        known = sorted(io.lookup_reader_by_format)
        close = difflib.get_close_matches(fmt, known, n=1)
        hint = f"did you mean {close[0]!r}?" if close else f"it knows {', '.join(known)}"
        raise ValueError(f"{path}: SurfaceTopography has no format {fmt!r}; {hint}")
    if fmt is not None:
        return _guard(path, lambda: io.open_topography(str(path), format=fmt), fmt)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return io.open_topography(str(path))
    except Exception:  # the names of all formats tried help nobody
        for name in _likely(io, path):
            _guard(path, lambda name=name: io.open_topography(str(path), format=name), name)
        raise ValueError(
            f"{path}: neither its content nor its name is of a format that SurfaceTopography "
            "reads; export it as a text matrix, .nc or .npy, or give format"
        ) from None


def _likely(io, path: Path) -> list[str]:
    """Formats that a file claims by its first bytes, else by its name."""
    head = path.read_bytes()[:_HEAD]
    by_head = [r.format() for r in io.readers if str(r.can_read(head)).endswith("YES")]
    suffix = path.suffix.lower().lstrip(".")
    named = [r for r in io.readers if suffix in (r.file_extensions() or ())]
    if b"\0" in head:
        named = [r for r in named if "text/plain" not in (r.mime_types() or ())]
    return by_head or [r.format() for r in named]


def _library():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of its own dependencies
        from SurfaceTopography import IO
    return IO


def _guard(path: Path, call: Callable, fmt: str = ""):
    """Call SurfaceTopography; whatever it raises becomes one line that names the file."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return call()
        except Exception as error:  # readers of broken files raise nearly anything
            words = " ".join(re.sub("'?<_io[^>]*>'?", "", str(error)).split())
            reason = f"{type(error).__name__}: {words[:_LONGEST]}".removesuffix(": ")
            as_format = f" as {fmt}" if fmt else ""
            raise ValueError(
                f"{path}: SurfaceTopography cannot read it{as_format} ({reason}); is the file "
                "complete?"
            ) from error


def _channel(channels, wanted: str | int, path: Path):
    """Return the channel named, or counted from 0."""
    if isinstance(wanted, int) and 0 <= wanted < len(channels):
        return channels[wanted]
    named = [c for c in channels if wanted in (c.channel_id, c.name)]
    if not named:
        names = ", ".join(repr(c.channel_id) for c in channels if holds_heights(c))
        raise ValueError(
            f"{path}: no channel {wanted!r}; the file has {names or 'no channel of heights'}"
        )
    return named[0]
