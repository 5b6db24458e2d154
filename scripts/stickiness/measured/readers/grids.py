"""Maps as other programs write them and SurfaceTopography does not read them.

Gwyddion's files and simple field, TIFF, Surfer's grids, MetroPro's text.
"""

from __future__ import annotations

import re
import struct
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stickiness.measured.readers.instruments import (
    EXPORT,
    HEIGHTS,
    NO_HEIGHTS,
    open_reader,
    read_channel,
)
from stickiness.measured.readers.raw import Raw, is_length, metres

_GSF = b"Gwyddion Simple Field 1."
_TIFF = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")
_DSBB = b"DSBB"
_ZYGO_MISSING = 2147483640  # or more
_ZYGO_STEPS = {0: 4096, 1: 32768, 2: 131072}  # of phase per wave, by "PhaseRes"


def is_binary(head: bytes) -> bool:
    """Whether a file begins as one that `find_reader` reads, though it may hold no zero byte."""
    return head.startswith((_GSF, _DSBB, *_TIFF))


def find_reader(path: Path) -> Callable[[Path], Raw] | None:
    """Reader of a file by its first bytes, if one of this module's reads it."""
    with path.open("rb") as file:
        head = file.read(len(_GSF))
    if head.startswith(_GSF):
        return read_simple_field
    if head.startswith(_DSBB):
        return read_surfer_binary
    return read_tiff if head.startswith(_TIFF) else None


def read_simple_field(path: Path) -> Raw:
    """Read Gwyddion's simple field (.gsf), after its public specification."""
    raw = path.read_bytes()
    end = raw.find(b"\0")
    lines = raw[:end].decode("utf-8", errors="replace").splitlines()[1:]
    fields = {
        key.strip(): value.strip() for key, _, value in (line.partition("=") for line in lines)
    }
    try:
        counts = int(fields["XRes"]), int(fields["YRes"])
    except (KeyError, ValueError):
        raise ValueError("its header tells no XRes and YRes; export it again") from None
    start = (end // 4 + 1) * 4
    if end < 0 or len(raw) - start < 4 * counts[0] * counts[1]:
        raise ValueError("the file is incomplete, its end is missing: copy it again")
    heights = np.frombuffer(raw, "<f4", counts[0] * counts[1], start).reshape(counts[::-1])
    size = [fields.get(name) for name in ("XReal", "YReal")]
    places = None if None in size else np.array(size, dtype=float) / counts
    unit = fields.get("XYUnits") or None
    title = fields.get("Title", "field")
    heights = heights.T.astype(float)
    return Raw(heights, f"{path}: {title}", fields.get("ZUnits") or None, (), places, unit)


def read_gwyddion(path: Path, channel: str | int | None = None) -> Raw:
    """Read a channel of a .gwy file in a unit of length, or else without one.

    SurfaceTopography takes A, which is ampere there, for ångström.
    """
    raw = path.read_bytes()
    content, _ = _read_object(raw, 4)
    fields = [
        (key, value)
        for key, value in content.items()
        if re.fullmatch(r"/\d+/data", key) and isinstance(value, dict) and "data" in value
    ]
    titles = [str(content.get(f"{key}/title") or key) for key, _ in fields]
    units = [_unit(field.get("si_unit_z")) for _, field in fields]
    titles = [
        title if titles.count(title) == 1 else f"{title}#{titles[: i + 1].count(title)}"
        for i, title in enumerate(titles)
    ]
    lengths = [i for i, unit in enumerate(units) if unit and is_length(unit)]
    usable = lengths or [i for i, unit in enumerate(units) if not unit]
    named = [i for i in usable if HEIGHTS.search(titles[i])]
    chosen = [i for i in usable if i in named or not NO_HEIGHTS.search(titles[i])] or usable
    chosen = chosen if lengths else named or chosen
    if channel is not None:
        chosen = [i for number, i in enumerate(usable) if channel in (number, titles[i])]
    if not chosen or len(chosen) > 1 and not lengths:
        told = ", ".join(f"{title!r} ({unit})" for title, unit in zip(titles, units, strict=True))
        asked = "" if channel is None else f" {channel!r}"
        raise ValueError(f"no channel{asked} of heights: it has {told or 'none'}; {EXPORT}")
    key, field = fields[chosen[0]]
    counts = int(field["xres"]), int(field["yres"])
    heights = np.array(field["data"]).reshape(counts[::-1]).T
    if (mask := content.get(key.replace("/data", "/mask"))) is not None:
        heights = np.where(np.reshape(mask["data"], counts[::-1]).T > 0.5, np.nan, heights)
    places = np.abs([field["xreal"], field["yreal"]]) / counts
    others = tuple(titles[i] for i in usable if channel is None and i != chosen[0])
    unit = _unit(field.get("si_unit_xy"))
    source = f"{path}: {titles[chosen[0]]}"
    return Raw(heights, source, units[chosen[0]], others, places if places.all() else None, unit)


def _unit(unit: dict | None) -> str | None:
    return (unit or {}).get("unitstr") or None


def _read_object(raw: bytes, start: int) -> tuple[dict[str, Any], int]:
    """Components of an object at a place in a .gwy file, and the place behind it."""
    start = raw.index(b"\0", start) + 1  # its name is not used
    (size,) = struct.unpack_from("<I", raw, start)
    start += 4
    end = start + size
    content = {}
    while start < end:
        stop = raw.index(b"\0", start)
        name = raw[start:stop].decode("utf-8", errors="replace")
        content[name], start = _read_value(raw, stop + 2, raw[stop + 1 : stop + 2].decode())
    return content, end


def _read_value(raw: bytes, start: int, kind: str) -> tuple[Any, int]:
    """A component of this kind: a letter for an atom, an object or a string, a capital for many."""
    if kind.isupper():
        (count,) = struct.unpack_from("<I", raw, start)
        start += 4
        if kind in "CIQD":
            values = np.frombuffer(
                raw, {"C": "i1", "I": "<i4", "Q": "<i8", "D": "<f8"}[kind], count, start
            )
            return values, start + values.nbytes
        many = []
        for _ in range(count):
            value, start = _read_value(raw, start, kind.lower())
            many.append(value)
        return many, start
    if kind == "o":
        return _read_object(raw, start)
    if kind == "s":
        stop = raw.index(b"\0", start)
        return raw[start:stop].decode("utf-8", errors="replace"), stop + 1
    form = {"b": "<b", "c": "<b", "i": "<i", "q": "<q", "d": "<d"}[kind]
    return struct.unpack_from(form, raw, start)[0], start + struct.calcsize(form)


def read_tiff(path: Path) -> Raw:
    """Read a TIFF: of Park Systems by SurfaceTopography, of others one channel of numbers.

    Whole numbers of 16 bits or more are counts, of which the caller gives the unit.
    """
    try:
        return read_channel(path, open_reader(path))
    except ValueError:  # of other programs
        pass
    import tifffile  # SurfaceTopography needs it, too
    from PIL import Image  # so does matplotlib

    pages = 1
    mode = ""
    tags: dict[int, Any] = {}
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            with Image.open(path) as image:
                pages = getattr(image, "n_frames", 1)
                mode = image.mode
                tags = dict(getattr(image, "tag_v2", {}))
                pixels = np.array(image)
    except Exception as error:  # of broken files, nearly anything
        try:  # which reads all kinds of numbers, but not all compressed
            pixels = tifffile.imread(path)
        except Exception:
            raise ValueError(
                f"not a readable TIFF ({error}); save it uncompressed, in 32-bit floats, or "
                f"{EXPORT}"
            ) from error
    if pages > 1 or pixels.ndim > 2 and pixels.shape[-1] > 4:
        raise ValueError("the TIFF has several pages; save that of the heights alone")
    if pixels.ndim != 2 or pixels.dtype.itemsize < 2:
        raise ValueError(
            f"the TIFF holds colours or grey levels ({mode}), no heights: save it in 32-bit "
            f"floats, or {EXPORT}"
        )
    places, unit = _find_resolution(tags)
    return Raw(pixels.T.astype(float), str(path), None, (), places, unit)


def _find_resolution(tags: dict[int, Any]) -> tuple[NDArray | None, str | None]:
    """Size of a pixel as ImageJ writes it; others write dots per inch of a print."""
    described = re.search(r"^unit=(.+)$", str(tags.get(270, "")), re.MULTILINE)
    if not described or not str(tags[270]).startswith("ImageJ"):
        return None, None
    per_unit = [float(tags.get(tag, 0)) for tag in (282, 283)]
    unit = described[1].strip().replace("\\u00B5", "µ")
    unit = {"micron": "um", "microns": "um", "inch": "inch"}.get(unit, unit)
    if not min(per_unit) > 0 or unit in ("pixel", "pixels"):
        return None, None
    return 1 / np.array(per_unit), unit


def read_surfer_binary(path: Path) -> Raw:
    """Read a grid of Surfer 6 (.grd, DSBB)."""
    raw = path.read_bytes()
    nx, ny, *ends = struct.unpack_from("<2h6d", raw, 4)
    if len(raw) < 56 + 4 * nx * ny:
        raise ValueError("the file is incomplete, its end is missing: copy it again")
    values = np.frombuffer(raw, "<f4", nx * ny, 56)
    return _of_surfer(path, values.astype(float), (nx, ny), ends)


def read_surfer_text(path: Path, words: list[str]) -> Raw:
    """Read a text grid of Surfer (.grd, DSAA) by its words."""
    try:
        nx, ny = map(int, words[1:3])
        ends = [float(word) for word in words[3:9]]
        values = np.array([float(word) for word in words[9:]])
    except ValueError as error:
        raise ValueError(f"the grid of Surfer cannot be read ({error})") from None
    if len(values) != nx * ny:
        raise ValueError(
            f"the grid of Surfer has {len(values)} heights, but its header says {nx} x {ny}; is "
            "the file complete?"
        )
    return _of_surfer(path, values, (nx, ny), ends)


def _of_surfer(path: Path, values: NDArray, counts: tuple[int, int], ends: list[float]) -> Raw:
    heights = values.reshape(counts[::-1]).T
    # The sides go from the first to the last point.
    places = np.array([ends[1] - ends[0], ends[3] - ends[2]]) / (np.array(counts) - 1)
    return Raw(heights, str(path), None, (), places)


def read_zygo(path: Path, lines: list[str]) -> Raw:
    """Read the text of Zygo's MetroPro: points of phase, or its whole numbers (reference guide)."""
    try:
        blocks = [i for i, line in enumerate(lines) if line.strip() == "#"]
        software = int(lines[1].split()[0])
        _, _, nx, ny = (int(word) for word in lines[3].split()[:4])
        optics = [float(word) for word in lines[7].split()[:7]]
        pixel = optics[6]
        heights = np.full((ny, nx), np.nan)
        if "XYZ" in lines[0]:
            rows = [line.split() for line in lines[blocks[0] + 1 :] if line.strip() != "#"]
            points = np.array([row for row in rows if len(row) == 3 and row[2] != "No"], float)
            column, row = (points[:, :2] - points[:, :2].min(axis=0)).astype(int).T
            heights = np.full((max(ny, row.max() + 1), max(nx, column.max() + 1)), np.nan)
            heights[row, column] = points[:, 2]
            # Other software than MetroPro lets its user choose.
            unit = "um" if software == 1 else None
        else:
            words = " ".join(lines[blocks[-2] + 1 : blocks[-1]]).split()
            phase = np.array(words, dtype=float).reshape(ny, nx)
            step = optics[1] * optics[2] * optics[4] / _ZYGO_STEPS[int(lines[10].split()[0])]
            heights = np.where(phase >= _ZYGO_MISSING, np.nan, step * phase)
            unit = "m"
    except (ValueError, IndexError, KeyError) as error:
        raise ValueError(
            f"the text of Zygo's software cannot be read ({error}); is it complete? Else save it "
            "as .dat, .datx or XYZ"
        ) from None
    places = np.full(2, metres(pixel, "CameraRes")) if pixel > 0 else None
    return Raw(heights.T, str(path), unit, (), places, "m")
