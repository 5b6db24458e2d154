"""Measured topographies and line profiles: reading, missing points, levelling. Lengths in metres.

Axes: ``heights[i, j]`` is the height at x_i, y_j. Instruments and images store a matrix whose rows
run along y; such a matrix is transposed on reading.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field, replace
from pathlib import Path
from typing import Any, Self, get_args

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from stickiness.arguments import numbers, positive, with_gaps
from stickiness.measured import levelling, readers, scanning
from stickiness.measured.doubts import doubt_pixels, doubt_sizes, doubt_values
from stickiness.measured.features import Feature
from stickiness.measured.guess import Guess, guess_fault, guess_pattern
from stickiness.measured.levelling import MAX_MISSING, Detrend, Missing, Rim, Spikes
from stickiness.measured.readers.raw import Length, Raw, fold, metres, metres_per, sides
from stickiness.measured.scanning import Scan
from stickiness.units import is_unit

Size = Length | Sequence[Length] | None
_CHOICES = {"missing": Missing, "spikes": Spikes, "scan": Scan}
_MARK = 1.70141e38  # as Surfer and others mark missing points, or more
# Names of steps that are counted.
DROP_RIMS = "drop points beside missing ones"
MASK_SPIKES = "mask spikes"
FILL = "fill missing points"
LEVEL = "level"
_EVEN = 1e-3  # of a step, by which gaps between points of a profile may differ
_UNITS_OF_LENGTH = ("m", "cm", "mm", "um", "nm", "angstrom", "pm", "inch", "mil")


@dataclass(frozen=True)
class Step:
    """Something that was done to heights between their file and their spectrum."""

    name: str  #: what was done to what
    points: int = 0  #: how many it filled, or took out
    parameters: Mapping[str, Any] = field(default_factory=dict)  #: arguments that call for it
    remark: str = ""  #: what was found and done, if the caller did not ask for it
    guess: Guess | None = None  #: on which it rests

    def __str__(self) -> str:
        chosen = ", ".join(f"{key}: {value}" for key, value in self.parameters.items())
        many = f"{self.points} point{'' if self.points == 1 else 's'}" if self.points else ""
        return ", ".join(filter(None, (f"{self.name} ({chosen})" if chosen else self.name, many)))


@dataclass(frozen=True)
class _Heights:
    """What maps and profiles have in common."""

    heights: NDArray
    dx: float
    _: KW_ONLY
    processing: tuple[Step, ...] = ()  #: what was done to the heights, in order
    as_read: NDArray | None = None  #: heights [m] before anything was done to them
    unused: NDArray | None = None  #: whether a point that was read is masked, dropped or cut off
    doubts: tuple[str, ...] = ()  #: why no verdict should rest on the heights
    others: tuple[str, ...] = ()  #: channels or variables to choose from, if none was named
    contradictions: tuple[str, ...] = ()  #: what the caller said otherwise than the file
    periodic: bool = False  #: whether the heights go on periodically, as the file says
    feature: Feature | None = None  #: that decides the energy

    @property
    def h_rms(self) -> float:
        """Root mean square height about the mean [m]: Sq of ISO 25178-2, Pq of a profile."""
        return float(np.std(self.heights))

    @property
    def remarks(self) -> tuple[str, ...]:
        """What was done to the heights that the caller did not ask for."""
        source = self.source  # type: ignore[attr-defined]  # comes after dy in Topography
        return tuple(f"{source}: {step.remark}" for step in self.processing if step.remark)

    @property
    def guesses(self) -> tuple[Guess, ...]:
        """Questions that the data leave open, and that steps of `processing` answer by a guess."""
        return tuple(step.guess for step in self.processing if step.guess is not None)

    def count(self, name: str) -> int:
        """Points that a step of `processing` filled or took out; 0 if it was not taken."""
        return sum(step.points for step in self.processing if step.name == name)

    def tell_steps(self) -> str:
        """Steps that were taken, in a line; empty if the heights were levelled alone."""
        source = self.source  # type: ignore[attr-defined]
        is_told = any(step.name != LEVEL for step in self.processing)
        return f"{source}: {'; '.join(map(str, self.processing))}" if is_told else ""

    @property
    def missing_fraction(self) -> float:
        """Share of the points that were missing or not used, and are interpolated."""
        return self.count(FILL) / self.heights.size

    @property
    def cropped_fraction(self) -> float:
        """Share of the measured points that was cut off to leave no missing ones."""
        return 0.0 if self.as_read is None else 1 - self.heights.size / self.as_read.size

    @property
    def steps(self) -> tuple[float, ...]:
        """Grid steps along every axis [m]."""
        return (self.dx,)

    @property
    def size(self) -> tuple[float, ...]:
        """Sides along every axis [m]."""
        return tuple(n * step for n, step in zip(self.heights.shape, self.steps, strict=True))

    def to_xarray(self) -> xr.DataArray:
        """Return the heights along `x` (and `y`) with units, so that ``.plot()`` labels itself."""
        labelled = xr.DataArray(
            self.heights,
            dims=("x", "y")[: self.heights.ndim],
            name="height",
            attrs={"units": "m", "long_name": "height"},
        )
        for axis, step in zip(labelled.dims, self.steps, strict=True):
            labelled[axis] = step * np.arange(labelled.sizes[axis])
            labelled[axis].attrs = {"units": "m", "long_name": f"position along {axis}"}
        return labelled

    def h_rms_as_read(self) -> float:
        """Root mean square height with the points that were dropped or masked, levelled [m]."""
        if self.as_read is None or not (self.count(DROP_RIMS) or self.count(MASK_SPIKES)):
            return self.h_rms
        trends = [each.parameters["detrend"] for each in self.processing if each.name == LEVEL]
        return levelling.rms_of_known(self.as_read, trends[-1] if trends else "mean")

    def detrended(self, kind: Detrend = "plane") -> Self:
        """Return the same measurement less its mean, plane (line) or quadratic trend.

        "detect" chooses a plane, or a quadratic trend with a remark; see `levelling.find_form`. Of
        periodic heights it subtracts the mean alone, for less a plane they are periodic no more.
        """
        remark = ""
        if kind == "detect":
            share = None if self.periodic else levelling.find_form(self.heights)
            kind = "mean" if self.periodic else "plane"
            if share is not None:
                kind = "quadratic"
                curvature = max(map(abs, levelling.find_curvatures(self.heights, self.steps)))
                remark = (
                    f"a curved form (radius {1 / curvature:.3g} m), which is {100 * share:.3g} % "
                    "of the variance of the heights, was subtracted; to keep it, give detrend: "
                    "plane"
                )
        levelled = levelling.detrend(self.heights, kind)
        periodic = self.periodic and kind == "mean"
        step = Step(LEVEL, parameters={"detrend": kind}, remark=remark)
        return replace(
            self, heights=levelled, processing=(*self.processing, step), periodic=periodic
        )


@dataclass(frozen=True)
class Topography(_Heights):
    """Heights of a surface on a rectangular grid."""

    heights: NDArray  #: (nx, ny), finite, the first axis along x [m]
    dx: float  #: grid steps along x and y [m]
    dy: float
    source: str  #: file (and variable or channel) of the heights, for messages

    @property
    def steps(self) -> tuple[float, float]:
        """Grid steps along x and y [m]."""
        return self.dx, self.dy

    @property
    def size(self) -> tuple[float, float]:
        """Sides along x and y [m]."""
        return self.heights.shape[0] * self.dx, self.heights.shape[1] * self.dy


@dataclass(frozen=True)
class Profile(_Heights):
    """Evenly spaced heights along a line."""

    heights: NDArray  #: (n,), finite [m]
    dx: float  #: step [m]
    source: str  #: file (and variable or channel) of the heights, for messages
    largest_gap: float = 0.0  #: between neighbours as measured [m]; above `dx` if uneven


class UntoldError(ValueError):
    """A file does not tell its size or units.

    Parameters
    ----------
    source : str
        The file.
    unknown : dict
        What it does not tell, with the arguments of `read` that would, each instead of the others.
    """

    def __init__(self, source: str, unknown: Mapping[str, Sequence[str]]) -> None:
        self.source = source
        self.unknown = unknown
        super().__init__(self.tell({}))

    def tell(self, names: Mapping[str, str]) -> str:
        """Say what is missing, with other names for the arguments, such as options of a command."""
        wanted = []
        for keys in self.unknown.values():
            first, *others = (names.get(key, key) for key in keys)
            wanted.append(first + "".join(f" (or {other})" for other in others))
        return (
            f"{self.source}: the file does not tell {' or '.join(self.unknown)}; "
            f"give {' and '.join(wanted)}"
        )


def read(
    path: str | Path,
    *,
    length: Size = None,
    pixel_size: Size = None,
    height_unit: str | None = None,
    height_factor: float = 1.0,
    position_unit: str | None = None,
    variable: str | None = None,
    channel: str | int | None = None,
    format: str | None = None,
    missing_value: float | None = None,
    missing: Missing = "fill",
    max_missing: float = MAX_MISSING,
    missing_rim: Rim = "detect",
    spikes: Spikes = "mask",
    scan: Scan = "detect",
) -> Topography | Profile:
    """Read a topography or a line profile.

    Parameters
    ----------
    path : str or Path
        NetCDF (.nc), numpy (.npz, .npy), MATLAB, HDF5, text, a map as another program wrote it, or
        a file of an instrument.
    length : length or pair of lengths, optional
        Side of the measured area, along x and y: "10 um", ("10 um", "20 um") or metres. A single
        value is the side along x, the pixels are square. Overrides what the file says.
    pixel_size : length or pair of lengths, optional
        Grid step, instead of `length`.
    height_unit, position_unit : str, optional
        Unit of the heights, and of positions, if the file does not tell: "nm".
    height_factor : float
        What all heights are multiplied by; -1 turns a replica upside down.
    variable : str, optional
        NetCDF variable or npz key. Default: the only two-dimensional one, else the only profile.
    channel : str or int, optional
        Channel of an instrument's file, by name or number. Default: the file's first of heights.
    format : str, optional
        "netcdf", "numpy", "text", "instrument" or SurfaceTopography's name of a format, if the
        file's name and content mislead.
    missing_value : float, optional
        Number that marks missing points, besides NaN and masked values.
    missing : {"fill", "crop", "refuse"}
        "fill": interpolate missing points from their neighbours, which smooths the surface there.
        "crop": keep the largest rectangle (or stretch of a profile) without any.
    max_missing : float
        Largest share of missing points, those dropped included, that may be filled.
    missing_rim : int or "detect"
        Width of the rim around missing points in which measured points are dropped [points]
        (`levelling.without_rims`).
    spikes : {"mask", "keep"}
        Take points far off all their neighbours (`levelling.find_spikes`) for missing, or not.
    scan : {"detect", "mend", "align", "keep"}
        What scanning leaves in a map (`scanning.mend`): "detect" mends what is found with
        certainty, "align" also sets the median of every row to zero.

    Returns
    -------
    Topography or Profile
        A profile if the file holds one: a one-dimensional array or channel, or text in one
        column (heights) or two (positions, heights). Uneven positions are interpolated linearly
        to as many even ones.

    Raises
    ------
    ValueError
        If the file does not hold one usable array, its size or unit is unknown or of a wrong
        dimension, or too much is missing.

    Notes
    -----
    In NetCDF the axis named x (or lon) is x, else the last one. A text matrix may have a header as
    Gwyddion writes it. Text in three columns is a list of points x y z on a grid.
    """
    path = Path(path)
    if not path.is_file():
        raise FileNotFoundError(f"no topography file {str(path)!r}")
    if length is not None and pixel_size is not None:
        raise ValueError("give length or pixel_size, not both")
    _check_options(max_missing, missing_rim, missing=missing, spikes=spikes, scan=scan)

    # What the file holds; the caller must say what it leaves open.
    raw = readers.read(path, format, variable, channel)
    size = length or pixel_size
    _ask_for_units(raw, size, height_unit, position_unit)
    raw = _fold(raw, length)

    # The numbers without marks of missing points, their places and their unit.
    heights, mark_notices = _find_marks(raw, missing_value)
    places = _find_places(raw, length, pixel_size, position_unit)
    is_native = readers.format_of(path, format) == readers.INSTRUMENT
    scale, unit_notices = _find_scale(raw, height_unit, is_native)
    size_notices = [] if size is None else _contradict_size(raw, places, position_unit)

    measurement = from_array(
        heights,
        places,
        missing=missing,
        max_missing=max_missing,
        missing_rim=missing_rim,
        spikes=spikes,
        scan=scan,
        source=raw.source,
        scale=height_factor * scale,
    )
    reading = tuple(Step("read", remark=remark) for remark in raw.remarks)
    is_whole = measurement.heights.shape == heights.shape
    return replace(
        measurement,
        others=raw.others,
        contradictions=(*mark_notices, *unit_notices, *size_notices),
        processing=reading + measurement.processing,
        periodic=raw.periodic and is_whole,
    )


def from_array(
    heights: ArrayLike,
    steps: ArrayLike,
    *,
    missing: Missing = "fill",
    max_missing: float = MAX_MISSING,
    missing_rim: Rim = "detect",
    spikes: Spikes = "mask",
    scan: Scan = "detect",
    source: str = "heights",
    scale: float = 1.0,
) -> Topography | Profile:
    """Clean and check heights in an array, as `read` does those of a file.

    Parameters
    ----------
    heights : (nx, ny) or (n,) array
        Map, the first axis along x, or line profile; NaN or masked where missing.
    steps : float, pair of float or (n,) array
        Grid step [m] along both axes, or along each. Of a profile its step, or the positions of
        its points [m], in any order: uneven ones are interpolated linearly to as many even ones.
    missing, max_missing, missing_rim, spikes, scan
        As of `read`.
    source : str
        Name of the heights in messages.
    scale : float
        Metres per unit of `heights`, negative to turn them upside down. Doubts about values are
        about numbers as they are given.

    Returns
    -------
    Topography or Profile
        Heights in metres, without missing points.

    Raises
    ------
    ValueError
        If the heights are no map or profile or all equal, if positions coincide, or if too much is
        missing.

    Examples
    --------
    >>> heights = 1e-6 * np.cos(0.1 * np.arange(32.0))[:, None] * np.ones(32)
    >>> heights[7, 5] = np.nan
    >>> wall = from_array(heights, steps=1e-6)
    >>> print(wall.processing[-1])
    fill missing points (missing: fill), 1 point
    """
    _check_options(max_missing, missing_rim, missing=missing, spikes=spikes, scan=scan)
    heights, places, done = _arrange(heights, steps, source)

    # Points beside missing ones, scars and spikes are taken for missing.
    as_measured, dropped = levelling.without_rims(heights, missing_rim)
    done.append(Step(DROP_RIMS, dropped, {"missing_rim": missing_rim}))
    mended = scanning.mend(as_measured, scan, abs(scale))
    done += [Step("mend the scan", 0, {"scan": scan}, remark) for remark in mended.remarks]
    if scan == "detect" and mended.questions:
        done[-1] = replace(done[-1], guess=guess_fault(mended.questions))
    if scan == "detect" and mended.kept:
        done.append(Step("keep a pattern", 0, {"scan": scan}, guess=guess_pattern(mended.kept)))
    scarred = int(np.count_nonzero(np.isnan(mended.heights) & ~np.isnan(as_measured)))
    is_spike = np.zeros(heights.shape, dtype=bool)
    if spikes == "mask":
        is_spike = levelling.find_spikes(mended.heights)
    masked = int(np.count_nonzero(is_spike))
    done.append(Step(MASK_SPIKES, masked, {"spikes": spikes}))
    usable = np.where(is_spike, np.nan, mended.heights)
    unused = np.isnan(usable)

    # Missing points are cut off or filled.
    kept = (slice(None),) * heights.ndim
    if missing == "crop":
        kept = levelling.complete_rectangle(~unused, source)
    losses = {
        "points beside missing ones dropped": dropped,
        "spikes masked": masked,
        "points of scars masked": scarred,
    }
    told = "".join(f", {count} {loss}" for loss, count in losses.items() if count)
    limit = 0.0 if missing == "refuse" else max_missing
    if heights.ndim == 1:
        places = places[kept]
    filled, missing_count = levelling.fill_missing(usable[kept], limit, source + told, places)
    done.append(Step("cut off missing points", heights.size - filled.size, {"missing": missing}))
    done.append(Step(FILL, missing_count, {"missing": missing}))

    # Heights of a profile are interpolated to even positions, and all are converted to metres.
    spacing = places
    largest_gap = 0.0
    if heights.ndim == 1:
        filled, spacing, largest_gap = _resample(filled, places, source)
        if largest_gap > (1 + _EVEN) * spacing[0]:
            done.append(Step("interpolate at even positions", filled.size))
    if scale < 0:
        done.append(Step("turn upside down", heights.size, {"invert": True}))
    filled = filled * scale
    if np.ptp(filled) == 0:
        raise ValueError(f"{source}: all heights are {filled.flat[0]:g} m; nothing to analyse")

    # Doubts about values are about those in the file.
    known = as_measured[~unused]
    are_whole = bool(np.all(known == np.rint(known)))
    doubts = [*mended.doubts, *doubt_values(known), *doubt_sizes(filled, spacing, are_whole)]
    is_cut_off = np.ones(heights.shape, dtype=bool)
    is_cut_off[kept] = False
    record: dict[str, Any] = {
        "processing": tuple(step for step in done if step.points or step.remark or step.guess),
        "as_read": heights * scale,
        "unused": (unused | is_cut_off) & np.isfinite(heights),
        "doubts": tuple(f"{source}: {doubt}" for doubt in doubts),
    }
    if heights.ndim == 1:
        return Profile(filled, float(spacing[0]), source, largest_gap, **record)
    return Topography(filled, float(spacing[0]), float(spacing[1]), source, **record)


def _arrange(
    heights: ArrayLike, steps: ArrayLike, source: str
) -> tuple[NDArray, NDArray, list[Step]]:
    """Heights in order, with the steps of a map or positions on a line, and what was done."""
    known = with_gaps("heights", heights)
    if known.ndim not in (1, 2) or known.size == 0:
        raise ValueError(
            f"{source}: heights must be a map (nx, ny) or a profile (n,), got shape {known.shape}"
        )
    if known.ndim == 1:
        return *_sort_profile(known, steps, source), []
    spacing = np.broadcast_to(positive(steps=steps)[0], 2)
    return _keep_one_copy(known, spacing) if np.isfinite(known).any() else (known, spacing, [])


def _keep_one_copy(heights: NDArray, steps: NDArray) -> tuple[NDArray, NDArray, list[Step]]:
    """Heights and steps of one tile, each point once, and what was done.

    Copies tell nothing more of the surface.
    """
    done = []
    tile = levelling.find_tile(heights)
    if tile != heights.shape:
        copies = " x ".join(str(round(n / m)) for n, m in zip(heights.shape, tile, strict=True))
        points = " x ".join(map(str, tile))
        copied = f"the map is {copies} copies or mirror images of one tile of {points} points"
        done.append(Step("keep one tile", remark=f"{copied}; one is used"))
        heights = heights[: tile[0], : tile[1]]
    repeats = levelling.find_repeats(heights)
    if max(repeats) > 1:
        times = " x ".join(map(str, repeats))
        remark = f"every point is repeated {times} times; it is used once"
        done.append(Step("keep every point once", remark=remark))
        heights = heights[:: repeats[0], :: repeats[1]]
        steps = np.multiply(steps, repeats)
    return heights, steps, done


def _check_options(max_missing: float, missing_rim: object, **choices: str) -> None:
    """Check how missing points, spikes and faults of the scan are to be treated."""
    if not 0 <= max_missing < 1:
        raise ValueError(f"max_missing must be in 0 <= f < 1, got {max_missing!r}")
    if missing_rim != "detect" and not (isinstance(missing_rim, int) and missing_rim >= 0):
        raise ValueError(f"missing_rim must be a number of points or 'detect', got {missing_rim!r}")
    for name, choice in choices.items():
        *others, last = map(repr, get_args(_CHOICES[name]))
        if repr(choice) not in (*others, last):
            raise ValueError(f"{name} must be {', '.join(others)} or {last}, got {choice!r}")


def _sort_profile(heights: NDArray, steps: ArrayLike, source: str) -> tuple[NDArray, NDArray]:
    """Heights and positions of a profile in ascending order, from its step or its positions."""
    positions = numbers("steps", steps)
    if positions.ndim == 0:
        positions = positive(steps=steps)[0] * np.arange(len(heights))
    if positions.shape != heights.shape:
        raise ValueError(
            f"{source}: steps must be one step or {len(heights)} positions, got shape "
            f"{positions.shape}"
        )
    order = np.argsort(positions, kind="stable")
    positions = positions[order]
    if len(positions) < 2:
        raise ValueError(f"{source}: one number is no map and no profile")
    repeated = positions[1:][~(np.diff(positions) > 0)]
    if repeated.size:
        raise ValueError(
            f"{source}: positions of a line profile must all differ, but "
            f"{len(np.unique(repeated))} occur twice or more, the first is {repeated[0]:g}: "
            "average their heights, or give one line of them"
        )
    return heights[order], positions


def _resample(heights: NDArray, positions: NDArray, source: str) -> tuple[NDArray, NDArray, float]:
    """Heights of a profile at even positions, their step, and the largest gap there was."""
    if len(positions) < 2:
        raise ValueError(f"{source}: a line profile needs two points at least")
    even = np.linspace(positions[0], positions[-1], len(positions))
    step = float(even[1] - even[0])
    gaps = np.diff(positions)
    if np.ptp(gaps) > _EVEN * step:
        heights = np.interp(even, positions, heights)
    return heights, np.array([step]), float(gaps.max())


def _find_places(raw: Raw, length: Size, pixel_size: Size, position_unit: str | None) -> NDArray:
    """Grid steps of a map, or positions of a profile's points [m], from the caller or the file."""
    shape = raw.heights.shape
    if raw.places is not None and not np.all(np.isfinite(raw.places)):
        raise ValueError(f"{raw.source}: a position of the profile is missing")
    if length is not None:
        steps = np.divide(sides(length, shape, f"{raw.source}: length"), shape)
    elif pixel_size is not None:
        steps = np.array(sides(pixel_size, (1,) * len(shape), f"{raw.source}: pixel_size"))
    else:
        assert raw.places is not None  # `_ask_for_units` has seen to it
        return raw.places * _convert(raw.source, "position_unit", position_unit, raw.place_unit)
    if len(shape) == 2:
        return steps
    if raw.places is None or not np.ptp(raw.places) > 0:
        return np.arange(shape[0]) * steps[0]
    return raw.places * steps[0] / _steps(raw.places, raw)  # which may be uneven


def _steps(places: NDArray, raw: Raw) -> NDArray:
    """Steps of a map, or the mean step of the points of a profile."""
    return places if raw.heights.ndim == 2 else np.ptp(places, keepdims=True) / (len(places) - 1)


def _fold(raw: Raw, length: Size) -> Raw:
    """Take a column of heights for the map that two sides mean, if its pixels are square."""
    if not isinstance(length, list | tuple) or raw.heights.ndim == 2 or raw.places is not None:
        return raw
    folded = fold(raw.heights, [metres(side, "length") for side in length])
    if folded is None:
        return raw
    points = " x ".join(map(str, folded.shape))
    remark = f"one column of heights, taken for a map of {points} points row by row"
    return replace(raw, heights=folded, remarks=(*raw.remarks, remark))


def _find_marks(raw: Raw, missing_value: float | None) -> tuple[NDArray, list[str]]:
    """Heights with NaN in place of marks of missing points, and a notice of one that is not there.

    Numbers near the largest of single precision are marks in any file.
    """
    is_given = raw.heights == missing_value
    is_missing = is_given | (raw.heights == raw.missing_value) | (np.abs(raw.heights) >= _MARK)
    heights = np.where(is_missing, np.nan, raw.heights)
    is_in_any_file = missing_value in (None, raw.missing_value) or abs(missing_value) >= _MARK
    if is_in_any_file or is_given.any():
        return heights, []
    notice = f"{raw.source}: no point is {missing_value:.9g}, the missing_value given"
    if (known := heights[np.isfinite(heights)]).size:
        notice += f"; heights in the file are {known.min():.9g} to {known.max():.9g}"
    return heights, [notice]


def _ask_for_units(raw: Raw, size, height_unit, position_unit) -> None:
    """Name all keys at once that the file leaves open."""
    unknown: dict[str, tuple[str, ...]] = {}
    if size is None and raw.places is None:
        unknown["its size"] = ("length", "pixel_size")
    elif size is None and raw.place_unit is None and position_unit is None:
        unknown["the unit of position"] = ("position_unit",)
    if height_unit is None and raw.unit is None:
        unknown["the unit of height"] = ("height_unit",)
    if unknown:
        raise UntoldError(raw.source, unknown)


def _find_scale(raw: Raw, height_unit: str | None, is_native: bool) -> tuple[float, list[str]]:
    """Metres per unit of the heights, and a notice of a unit given that is not used."""
    # Readers of instruments' formats without a choice of the unit give metres, as nobody says them.
    if not (is_native and raw.unit == "m" and height_unit is not None):
        return _convert(raw.source, "height_unit", height_unit, raw.unit), []
    if metres_per(height_unit, "height_unit") == 1:
        return 1.0, []
    return 1.0, [f"{raw.source}: the heights are in m; height_unit = {height_unit!r} is not used"]


def _contradict_size(raw: Raw, places: NDArray, position_unit: str | None) -> list[str]:
    """Say if the size given is not that in the file; without a unit, not that in any unit."""
    told = None if raw.places is None else _steps(raw.places, raw)
    unit = raw.place_unit if is_unit(raw.place_unit or "") else position_unit
    notices = []
    if told is not None and np.all(told > 0) and (unit or np.any(told != 1)):  # 1: of pixels
        units = [unit] if unit else _UNITS_OF_LENGTH
        factors = [metres_per(each, "position_unit") for each in units]
        ratios = _steps(places, raw) / told
        # Sides may count from the first to the last point.
        tolerance = max(0.01, 1.1 / min(raw.heights.shape))
        is_told = np.isclose(ratios[:, None], factors, rtol=tolerance, atol=0).any(axis=1)
        ratio = ratios[np.argmin(is_told)]
        how = (
            f", {ratio / factors[0]:.3g} times the size in the file"
            if unit
            else f"; with it, a unit of position in the file would be {ratio:.3g} m, which none is"
        )
        if not is_told.all():
            notices.append(f"{raw.source}: the size given is used{how}")
    if raw.heights.ndim == 2:
        ratio_told = None if told is None else told[0] / told[1]
        notices += doubt_pixels(raw.source, raw.heights.shape, places, ratio_told)
    return notices


def _convert(source: str, key: str, from_caller: str | None, in_file: str | None) -> float:
    """Metres per unit, from the caller or the file, which must agree where the file is legible."""
    if from_caller is not None and in_file is not None and not is_unit(in_file):
        in_file = None
    units = [unit for unit in (from_caller, in_file) if unit is not None]
    scales = [metres_per(unit, f"{source}: {key}") for unit in units]
    if not np.isclose(scales[0], scales[-1], rtol=1e-12, atol=0):
        raise ValueError(
            f"{source}: {key} = {from_caller!r}, but the file says {in_file!r}; leave {key} out, "
            "or correct the file"
        )
    return scales[0]
