"""Content of a file of measured heights: NetCDF, numpy, plain text or an instrument's format.

`read` looks whether a file can be read at all, finds its kind by its name and its first bytes, and
hands it to the reader of that kind: `arrays` reads files of arrays, `text` tables, `instruments`
what SurfaceTopography reads, `grids` what other programs write and it does not read. Each of them
returns a `Raw`. What none of them reads is refused: heights would be wrong without notice.
"""

from __future__ import annotations

import zipfile
from pathlib import Path

from stickiness.measured.readers import arrays, grids, instruments, text
from stickiness.measured.readers.instruments import holds_heights
from stickiness.measured.readers.raw import INCOMPLETE, MOST_POINTS, Raw, read_head

__all__ = ["INSTRUMENT", "Raw", "find_misfit", "find_packing", "format_of", "holds_heights", "read"]

INSTRUMENT = "instrument"
_CHOICES = {"text": None, INSTRUMENT: "channel", "netcdf": "variable", "numpy": "variable"}
_KINDS = {  # by the end of the name
    **dict.fromkeys((".nc", ".nc4", ".cdf"), "netcdf"),
    **dict.fromkeys((".npz", ".npy"), "numpy"),
    **dict.fromkeys((".hfm", ".nms"), INSTRUMENT),  # text, but no matrix of heights
}
_OF_SURFACE_TOPOGRAPHY = {  # its names of formats that are read here
    "mat": arrays.read_matlab,
    "h5": arrays.read_hdf5,
    "gwy": grids.read_gwyddion,
}

_MOST_BYTES = 9 * MOST_POINTS  # of a file, or of what an archive holds
_MOST_OF_WORKBOOK = 2**26  # bytes; a reader of workbooks takes 50 times as many
_WORKBOOK = "xl/workbook.xml"  # in the archive
_SHEETS_OF_MITUTOYO = (b'name="DATA"', b'name="Certificate"')
_EXCEL = (
    "an Excel workbook: save its sheet of heights as text (CSV), without other columns; a profile "
    "of Mitutoyo SurfTest may stay an .xlsx with its sheets DATA and Certificate"
)
_UNPACK = "unpack it, and give the file inside"
_NO_HEIGHTS = f"no map of heights; {instruments.EXPORT}"
_REFUSED = {  # by the first bytes
    b"\x1f\x8b": f"compressed (gzip): {_UNPACK}",
    b"\x1f\x9d": f"compressed (compress): {_UNPACK}",
    b"BZh": f"compressed (bzip2): {_UNPACK}",
    b"\xfd7zXZ\0": f"compressed (xz): {_UNPACK}",
    b"7z\xbc\xaf\x27\x1c": f"compressed (7z): {_UNPACK}",
    b"\xd0\xcf\x11\xe0": _EXCEL,  # of an old version
    b"DSRB": "a grid of Surfer 7: save it as Surfer 6 text (DSAA)",
    b"\x89PNG": f"a picture (PNG), {_NO_HEIGHTS}",
    b"\xff\xd8\xff": f"a picture (JPEG), {_NO_HEIGHTS}",
    b"GIF8": f"a picture (GIF), {_NO_HEIGHTS}",
    b"%PDF": f"a PDF, {_NO_HEIGHTS}",
    b"ply": f"a mesh or cloud of points (PLY), {_NO_HEIGHTS}",
    b"solid ": f"a mesh of triangles (STL), {_NO_HEIGHTS}",
}


def find_packing(path: str | Path) -> str:
    """What to do with a file before it can be read, if it is packed or empty; else nothing."""
    head = read_head(path, 8)
    if not head:
        return "the file is empty: copy it again"
    if head.startswith(b"PK\3\4"):
        return _find_packing_of_zip(path)
    content = next((told for start, told in _REFUSED.items() if head.startswith(start)), "")
    return content and f"the file is {content}"


def _find_packing_of_zip(path: str | Path) -> str:
    """What to do with a zip archive, as workbooks and some instruments' files are."""
    if not zipfile.is_zipfile(path):
        return INCOMPLETE
    with zipfile.ZipFile(path) as archive:
        is_workbook = _WORKBOOK in archive.namelist()
        most = _MOST_OF_WORKBOOK if is_workbook else _MOST_BYTES
        size = sum(member.file_size for member in archive.infolist())
        if size > most:
            return (
                f"it unpacks to {size / 1e6:.0f} MB, more than the {most / 1e6:.0f} MB that "
                "are read: export a part of the heights, or every second point"
            )
        sheets = archive.read(_WORKBOOK) if is_workbook else b""
    is_read = not is_workbook or all(sheet in sheets for sheet in _SHEETS_OF_MITUTOYO)
    return "" if is_read else f"the file is {_EXCEL}"


def format_of(path: str | Path, fmt: str | None = None) -> str:
    """Return which reader a file needs: "netcdf", "numpy", "text" or "instrument"."""
    if fmt is not None:
        return fmt if fmt in _CHOICES else INSTRUMENT
    if kind := _KINDS.get(Path(path).suffix.lower()):
        return kind
    head = read_head(path, 1 << 20)  # headers in text may be long
    if head.startswith(b"\x93NUMPY"):
        return "numpy"
    is_binary = b"\0" in head and not head.startswith(text.UTF16)
    is_known = head.startswith(instruments.SDF) or grids.find_reader(head)
    return INSTRUMENT if is_binary or is_known or text.is_of_instrument(head) else "text"


def find_misfit(kind: str, **choices: str | int | None) -> tuple[str, str] | None:
    """Key of a choice that files of this kind do not have, and what to do instead."""
    right = _CHOICES[kind]
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
        if kind == "text":
            return text.read_text(path)
        if kind == "netcdf":
            return arrays.read_netcdf(path, variable)
        if kind == "numpy":
            return arrays.read_numpy(path, variable)
        return _read_binary(path, None if fmt == INSTRUMENT else fmt, channel)
    except MemoryError as error:
        raise ValueError(f"{path}: it takes more memory than there is ({error})") from error
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from error


def _read_binary(path: Path, fmt: str | None, channel: str | int | None) -> Raw:
    """Read a file of an instrument, or one of another program that is no text."""
    if fmt is None and (read_grid := grids.find_reader(read_head(path, 32))):
        return read_grid(path)
    reader = instruments.open_reader(path, fmt)
    name = reader.format()
    if read_own := _OF_SURFACE_TOPOGRAPHY.get(name):
        return read_own(path, channel)
    if name == "hgt" and fmt is None and path.suffix.lower() != ".hgt":
        # Any file of so many bytes is one.
        raise ValueError(f"no reader knows its first bytes; {instruments.EXPORT}")
    return instruments.read_channel(path, reader, channel)
