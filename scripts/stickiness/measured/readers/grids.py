"""Maps as other programs write them and SurfaceTopography does not read them.

Gwyddion's files and simple field, TIFF, Surfer's grids, MetroPro's text.
"""

from __future__ import annotations

import contextlib
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
    find_heights,
    open_reader,
    read_channel,
)
from stickiness.measured.readers.raw import INCOMPLETE, Raw, is_length, metres

_ZYGO_MISSING = 2147483640  # or more
_ZYGO_STEPS = {0: 4096, 1: 32768, 2: 131072}  # of phase per wave, by "PhaseRes"


def find_reader(head: bytes) -> Callable[[Path], Raw] | None:
    """Reader of a file by its first bytes, if one of this module's reads it."""
    readers = {
        b"Gwyddion Simple Field 1.": read_simple_field,
        b"DSBB": read_surfer_binary,
        **dict.fromkeys((b"II*\0", b"MM\0*", b"II+\0", b"MM\0+"), read_tiff),
    }
    return next((reader for start, reader in readers.items() if head.startswith(start)), None)


def read_simple_field(path: Path) -> Raw:
    """Read Gwyddion's simple field (.gsf), after its public specification."""
    content = path.read_bytes()
    end = content.find(b"\0")
    lines = content[:end].decode("utf-8", errors="replace").splitlines()[1:]
    pairs = (line.partition("=") for line in lines)
    fields = {key.strip(): told.strip() for key, _, told in pairs}
    try:
        counts = int(fields["XRes"]), int(fields["YRes"])
    except (KeyError, ValueError):
        raise ValueError("its header tells no XRes and YRes; export it again") from None
    # Heights begin at the next multiple of four bytes.
    start = (end // 4 + 1) * 4
    if end < 0 or len(content) - start < 4 * counts[0] * counts[1]:
        raise ValueError(INCOMPLETE)
    heights = np.frombuffer(content, "<f4", counts[0] * counts[1], start).reshape(counts[::-1])
    size = [fields.get(name) for name in ("XReal", "YReal")]
    return Raw(
        heights=heights.T.astype(float),
        source=f"{path}: {fields.get('Title', 'field')}",
        unit=fields.get("ZUnits") or None,
        places=None if None in size else np.array(size, dtype=float) / counts,
        place_unit=fields.get("XYUnits") or None,
    )


def read_gwyddion(path: Path, channel: str | int | None = None) -> Raw:
    """Read a channel of a .gwy file in a unit of length, or else without one.

    SurfaceTopography takes A, which is ampere there, for ångström.
    """
    fields = _list_fields(path)
    units = {title: _find_unit(field, "si_unit_z") for title, field in fields.items()}
    of_length = [title for title, unit in units.items() if unit and is_length(unit)]
    usable = of_length or [title for title, unit in units.items() if not unit]
    if channel is None:
        chosen = find_heights(usable)
    else:
        chosen = [title for number, title in enumerate(usable) if channel in (number, title)]
    if not chosen or (len(chosen) > 1 and not of_length):
        told = ", ".join(f"{title!r} ({unit})" for title, unit in units.items()) or "none"
        asked = "" if channel is None else f" {channel!r}"
        raise ValueError(f"no channel{asked} of heights: it has {told}; give channel, or {EXPORT}")

    title = chosen[0]
    field = fields[title]
    counts = int(field["xres"]), int(field["yres"])
    heights = np.array(field["data"]).reshape(counts[::-1]).T
    if (mask := field["mask"]) is not None:
        heights = np.where(np.reshape(mask["data"], counts[::-1]).T > 0.5, np.nan, heights)
    steps = np.abs([field["xreal"], field["yreal"]]) / counts
    return Raw(
        heights=heights,
        source=f"{path}: {title}",
        unit=units[title],
        others=tuple(each for each in usable if channel is None and each != title),
        places=steps if steps.all() else None,
        place_unit=_find_unit(field, "si_unit_xy"),
    )


def _list_fields(path: Path) -> dict[str, dict[str, Any]]:
    """Data fields of a .gwy file by title, with their masks; those of one title are numbered."""
    from SurfaceTopography.IO.GWY import _gwy_read_object

    with path.open("rb") as file:
        file.seek(4)  # behind the first bytes of every such file
        content = _gwy_read_object(file)["GwyContainer"]
    keys = [key for key in content if re.fullmatch(r"/\d+/data", key)]
    keys = [key for key in keys if "data" in content[key].get("GwyDataField", {})]
    titles = [str(content.get(f"{key}/title") or key) for key in keys]
    fields: dict[str, dict[str, Any]] = {}
    for number, (key, title) in enumerate(zip(keys, titles, strict=True), start=1):
        name = title if titles.count(title) == 1 else f"{title}#{titles[:number].count(title)}"
        while name in fields:  # as another's title is
            name = f"{name}#2"
        mask = content.get(key.replace("/data", "/mask"), {})
        fields[name] = content[key]["GwyDataField"] | {"mask": mask.get("GwyDataField")}
    return fields


def _find_unit(field: dict[str, Any], name: str) -> str | None:
    return field.get(name, {}).get("GwySIUnit", {}).get("unitstr") or None


def read_tiff(path: Path) -> Raw:
    """Read a TIFF: of Park Systems by SurfaceTopography, of others one channel of numbers.

    Whole numbers of 16 bits or more are counts, of which the caller gives the unit.
    """
    with contextlib.suppress(ValueError):  # of other programs
        return read_channel(path, open_reader(path))
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
    if pages > 1 or (pixels.ndim > 2 and pixels.shape[-1] > 4):
        raise ValueError("the TIFF has several pages; save that of the heights alone")
    if pixels.ndim != 2 or pixels.dtype.itemsize < 2:
        raise ValueError(
            f"the TIFF holds colours or grey levels ({mode}), no heights: save it in 32-bit "
            f"floats, or {EXPORT}"
        )
    steps, unit = _find_resolution(tags)
    return Raw(pixels.T.astype(float), str(path), places=steps, place_unit=unit)


def _find_resolution(tags: dict[int, Any]) -> tuple[NDArray | None, str | None]:
    """Size of a pixel as ImageJ writes it; others write dots per inch of a print."""
    description = str(tags.get(270, ""))
    described = re.search(r"^unit=(.+)$", description, re.MULTILINE)
    if not described or not description.startswith("ImageJ"):
        return None, None
    per_unit = [float(tags.get(tag, 0)) for tag in (282, 283)]
    unit = described[1].strip().replace("\\u00B5", "µ")
    if not min(per_unit) > 0 or unit in ("pixel", "pixels"):
        return None, None
    return 1 / np.array(per_unit), {"micron": "um", "microns": "um"}.get(unit, unit)


def read_surfer_binary(path: Path) -> Raw:
    """Read a grid of Surfer 6 (.grd, DSBB)."""
    content = path.read_bytes()
    if len(content) < 56:
        raise ValueError(INCOMPLETE)
    nx, ny, *ends = struct.unpack_from("<2h6d", content, 4)
    if len(content) < 56 + 4 * nx * ny:
        raise ValueError(INCOMPLETE)
    heights = np.frombuffer(content, "<f4", nx * ny, 56)
    return _of_surfer(path, heights.astype(float), (nx, ny), ends)


def read_surfer_text(path: Path, lines: list[str]) -> Raw:
    """Read a text grid of Surfer (.grd, DSAA)."""
    words = " ".join(lines).split()
    try:
        nx, ny = map(int, words[1:3])
        ends = [float(word) for word in words[3:9]]
        heights = np.array([float(word) for word in words[9:]])
    except ValueError as error:
        raise ValueError(f"the grid of Surfer cannot be read ({error})") from None
    if len(heights) != nx * ny:
        raise ValueError(
            f"the grid of Surfer has {len(heights)} heights, but its header says {nx} x {ny}; is "
            "the file complete?"
        )
    return _of_surfer(path, heights, (nx, ny), ends)


def _of_surfer(path: Path, heights: NDArray, counts: tuple[int, int], ends: list[float]) -> Raw:
    # The sides go from the first to the last point.
    steps = np.array([ends[1] - ends[0], ends[3] - ends[2]]) / (np.array(counts) - 1)
    return Raw(heights.reshape(counts[::-1]).T, str(path), places=steps)


def read_zygo(path: Path, lines: list[str]) -> Raw:
    """Read the text of Zygo's MetroPro: points of phase, or its whole numbers (reference guide)."""
    unit: str | None = "m"
    try:
        blocks = [number for number, line in enumerate(lines) if line.strip() == "#"]
        software = int(lines[1].split()[0])
        _, _, nx, ny = (int(word) for word in lines[3].split()[:4])
        scale, wavelength, _, obliquity, _, pixel = map(float, lines[7].split()[1:7])
        if "XYZ" in lines[0]:
            heights = _read_points_of_zygo(lines[blocks[0] + 1 :], (ny, nx))
            # Other software than MetroPro lets its user choose.
            unit = "um" if software == 1 else None
        else:
            words = " ".join(lines[blocks[-2] + 1 : blocks[-1]]).split()
            phase = np.array(words, dtype=float).reshape(ny, nx)
            step = scale * wavelength * obliquity / _ZYGO_STEPS[int(lines[10].split()[0])]
            heights = np.where(phase >= _ZYGO_MISSING, np.nan, step * phase)
    except (ValueError, IndexError, KeyError) as error:
        raise ValueError(
            f"the text of Zygo's software cannot be read ({error}); is it complete? Else save it "
            "as .dat, .datx or XYZ"
        ) from None
    steps = np.full(2, metres(pixel, "CameraRes")) if pixel > 0 else None
    return Raw(heights.T, str(path), unit, places=steps, place_unit="m")


def _read_points_of_zygo(lines: list[str], shape: tuple[int, int]) -> NDArray:
    """Heights (rows, columns) in lines "column row height"; "No Data" stands for missing ones."""
    words = [line.split() for line in lines if line.strip() != "#"]
    points = np.array([row for row in words if len(row) == 3 and row[2] != "No"], float)
    column, row = (points[:, :2] - points[:, :2].min(axis=0)).astype(int).T
    heights = np.full(np.maximum(shape, [row.max() + 1, column.max() + 1]), np.nan)
    heights[row, column] = points[:, 2]
    return heights
