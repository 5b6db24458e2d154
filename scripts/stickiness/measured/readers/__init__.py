"""Content of a file of measured heights: NetCDF, numpy, plain text or an instrument's format.

`arrays` reads files of arrays, `text` tables, `instruments` what SurfaceTopography reads, `grids`
what other programs write and it does not read. What none of them reads is refused: heights would be
wrong without notice.
"""

from __future__ import annotations

import zipfile
from pathlib import Path

from stickiness.measured.readers import arrays, grids, instruments, text
from stickiness.measured.readers.instruments import holds_heights
from stickiness.measured.readers.raw import (
    MOST_POINTS,
    Length,
    Raw,
    fold,
    metres,
    metres_per,
    sides,
)

__all__ = [
    "INSTRUMENT",
    "MOST_POINTS",
    "Length",
    "Raw",
    "find_misfit",
    "find_packing",
    "fold",
    "format_of",
    "holds_heights",
    "metres",
    "metres_per",
    "read",
    "sides",
]

INSTRUMENT = "instrument"
_MOST_BYTES = 9 * MOST_POINTS  # of a file, or of what an archive holds
_MOST_OF_WORKBOOK = 2**26  # bytes; a reader of workbooks takes 50 times as many
_EXCEL = (
    "the file is an Excel workbook: save its sheet of heights as text (CSV), without other "
    "columns; a profile of Mitutoyo SurfTest may stay an .xlsx with its sheets DATA and Certificate"
)
_MITUTOYO = (b'name="DATA"', b'name="Certificate"')  # sheets
_PACKINGS = {
    b"\x1f\x8b": "gzip",
    b"\x1f\x9d": "compress",
    b"BZh": "bzip2",
    b"\xfd7zXZ\0": "xz",
    b"7z\xbc\xaf\x27\x1c": "7z",
}
_NO_HEIGHTS = {
    b"\x89PNG": "a picture (PNG)",
    b"\xff\xd8\xff": "a picture (JPEG)",
    b"GIF8": "a picture (GIF)",
    b"%PDF": "a PDF",
    b"DSRB": "a grid of Surfer 7: save it as Surfer 6 text (DSAA)",
    b"ply": "a mesh or cloud of points (PLY)",
    b"solid ": "a mesh of triangles (STL)",
}


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
            is_workbook = "xl/workbook.xml" in archive.namelist()
            most = _MOST_OF_WORKBOOK if is_workbook else _MOST_BYTES
            if (size := sum(each.file_size for each in archive.infolist())) > most:
                return (
                    f"it unpacks to {size / 1e6:.0f} MB, more than the {most / 1e6:.0f} MB that "
                    "are read: export a part of the heights, or every second point"
                )
            if not is_workbook:
                return ""
            book = archive.read("xl/workbook.xml")
            return "" if all(sheet in book for sheet in _MITUTOYO) else _EXCEL
    if head.startswith(b"\xd0\xcf\x11\xe0"):  # of an old version
        return _EXCEL
    for start, packing in _PACKINGS.items():
        if head.startswith(start):
            return f"the file is compressed ({packing}): unpack it, and give the file inside"
    for start, content in _NO_HEIGHTS.items():
        if head.startswith(start):
            advice = "" if ":" in content else f", no map of heights; {instruments.EXPORT}"
            return f"the file is {content}{advice}"
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
    if suffix in (".hfm", ".nms"):  # text, but no matrix of heights
        return INSTRUMENT
    with Path(path).open("rb") as file:
        head = file.read(1 << 20)  # headers in text may be long
    if head.startswith(b"\x93NUMPY"):
        return "numpy"
    if (
        head.startswith(instruments.SDF)
        or grids.is_binary(head)
        or not head.startswith(text.UTF16)
        and b"\0" in head
    ):
        return INSTRUMENT
    return INSTRUMENT if text.is_of_instrument(head[: len(head) // 2 * 2]) else "text"


def find_misfit(kind: str, **choices: str | int | None) -> tuple[str, str] | None:
    """Key of a choice that files of this kind do not have, and what to do instead."""
    right = {"text": None, INSTRUMENT: "channel"}.get(kind, "variable")
    for key, choice in choices.items():
        if choice is not None and key != right:
            advice = f"give {right}" if right else f"leave {key} out"
            return key, f"{'an' if kind == INSTRUMENT else 'a'} {kind} file has no {key}s; {advice}"
    return None


def read(path: Path, fmt=None, variable=None, channel=None) -> Raw:
    """Read a file with the reader that `format_of` names; errors name the file."""
    try:
        if advice := find_packing(path):
            raise ValueError(advice)
        if (size := path.stat().st_size) > _MOST_BYTES:
            raise ValueError(
                f"{size / 1e6:.0f} MB are more than the {_MOST_BYTES / 1e6:.0f} MB that are read"
            )
        kind = format_of(path, fmt)
        if misfit := find_misfit(kind, channel=channel, variable=variable):
            raise ValueError(misfit[1])
        if kind == INSTRUMENT:
            return _read_binary(path, None if fmt == INSTRUMENT else fmt, channel)
        if kind == "text":
            return text.read_text(path)
        if kind == "netcdf":
            return arrays.read_netcdf(path, variable)
        return arrays.read_numpy(path, variable)
    except MemoryError as error:
        raise ValueError(f"{path}: it takes more memory than there is ({error})") from error
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from error


def _read_binary(path: Path, fmt: str | None, channel: str | int | None) -> Raw:
    """Read a file of an instrument, or one of another program that is no text."""
    if fmt is None and (own := grids.find_reader(path)):
        return own(path)
    reader = instruments.open_reader(path, fmt)
    name = reader.format()
    if name == "mat":
        return arrays.read_matlab(path, channel)
    if name == "h5":
        return arrays.read_hdf5(path, channel)
    if name == "gwy":
        return grids.read_gwyddion(path, channel)
    if name == "hgt" and fmt is None and path.suffix.lower() != ".hgt":
        # Any file of so many bytes is one.
        raise ValueError(f"no reader knows its first bytes; {instruments.EXPORT}")
    return instruments.read_channel(path, reader, channel)
