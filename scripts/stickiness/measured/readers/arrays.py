"""Files of arrays: NetCDF, numpy, MATLAB and HDF5.

A matrix has its rows along y in all of them, as in text, unless positions beside it or names of
dimensions say otherwise.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from stickiness.measured.readers.instruments import (
    HEIGHTS,
    may_name_heights,
    open_reader,
    read_channel,
)
from stickiness.measured.readers.points import map_points, read_columns
from stickiness.measured.readers.raw import (
    MOST_POINTS,
    Raw,
    check_count,
    find_step,
    is_length,
    metres_per,
    read_head,
    split_unit,
)

_POSITION = re.compile(r"(?:^|.*[/_])([xy])[-_]?([xy]|s|v|i|grid|mesh|data|pos\w*|coord\w*|axis)?$")
# A number beside a matrix: the size of its pixels, along one axis or both.
_STEP = re.compile(r"(?:^|.*[/_])(?:d_?(?=[xy])|(?:pixel_?size|step|spacing)_?(?=[xy]?$))([xy]?)$")
_NUMBERS = "biuf"  # kinds of real numbers


def read_netcdf(path: Path, variable: str | None) -> Raw:
    """Read a variable of a NetCDF file."""
    dataset = _open_netcdf(path)
    for each in dataset.variables.values():
        check_count(each.shape)
    if variable in (None, "heights") and _is_of_contact_engineering(dataset):
        return replace(read_channel(path, open_reader(path, "nc")), source=f"{path}: heights")
    name, others = _choose(dataset.variables, dataset.data_vars, variable, "variable")
    heights = dataset[name].astype(float)

    # The last axis is x, unless names of dimensions say otherwise.
    if heights.ndim == 2:
        first, second = (str(dimension).lower() for dimension in heights.dims)
        first_is_x = first in ("x", "lon", "longitude", "easting")
        second_is_y = second in ("y", "lat", "latitude", "northing")
        if not (first_is_x or second_is_y):
            heights = heights.transpose()

    # Positions along a line, or steps of a map, if all coordinates have units.
    places = None
    place_unit = None
    coordinates = [dataset[dimension] for dimension in heights.dims]
    units = [_find_unit(each.attrs) for each in coordinates]
    if heights.ndim == 1 and units[0] is not None:
        places = coordinates[0].values.astype(float)
        place_unit = units[0]
    elif heights.ndim == 2 and all(unit is not None and is_length(unit) for unit in units):
        # Not degrees or pixels, for which the caller must say the size.
        steps = [
            find_step(each.values, str(each.name)) * metres_per(str(unit), str(each.name))
            for each, unit in zip(coordinates, units, strict=True)
        ]
        places = np.array(steps)
        place_unit = "m"
    return Raw(
        heights=np.array(heights.values),
        source=f"{path}: {name}",
        unit=_find_unit(heights.attrs),
        others=others,
        places=places,
        place_unit=place_unit,
    )


def _open_netcdf(path: Path):
    """Data set of a NetCDF file without axes of one, in memory if it has room there."""
    import xarray as xr  # only this format needs it

    # Where the end of a file of NetCDF 3 is missing, the other library reads zeros.
    engine = "scipy" if read_head(path, 4) in (b"CDF\1", b"CDF\2") else "netcdf4"
    try:
        with xr.open_dataset(path, engine=engine) as dataset:
            if all(each.size <= MOST_POINTS for each in dataset.variables.values()):
                dataset = dataset.load().squeeze()
    except MemoryError:
        raise
    except Exception as error:  # libraries raise nearly anything of broken files
        raise ValueError(
            "not a readable NetCDF file: it is of another kind, incomplete or damaged"
        ) from error
    return dataset


def _is_of_contact_engineering(dataset) -> bool:
    """Whether a dataset is a topography as SurfaceTopography and contact.engineering write it."""
    if "heights" not in dataset.variables:
        return False
    attributes = dataset["x"].attrs if "x" in dataset.variables else {}
    return "length" in attributes or "periodic" in attributes or dataset["heights"].dims == ("n",)


def _find_unit(attributes: Mapping) -> str | None:
    unit = attributes.get("units", attributes.get("unit"))
    if unit is None:
        return None
    return unit.decode() if isinstance(unit, bytes) else str(unit)


def _choose(
    arrays: Mapping, candidates: Mapping, wanted: str | None, what: str
) -> tuple[str, tuple[str, ...]]:
    """Array to read: the one wanted; else the only map or the only profile, and the others."""
    if wanted is not None:
        if wanted not in arrays:
            raise ValueError(f"no {what} {wanted!r}; the file has {sorted(arrays)}")
        candidates = {wanted: arrays[wanted]}
    usable = [name for name in candidates if arrays[name].ndim in (1, 2)]
    if not usable:
        shapes = {name: " x ".join(map(str, arrays[name].shape)) for name in candidates}
        contents = ", ".join(f"{name!r} of {shape} points" for name, shape in shapes.items())
        raise ValueError(f"no map or profile, but {contents or 'nothing'}; save one map")
    usable = [name for name in usable if may_name_heights(name)] or usable
    eligible = [name for name in usable if arrays[name].ndim == 2] or usable
    named = [name for name in eligible if HEIGHTS.search(name)]
    if len(named) == 1:
        eligible = named
    if len(eligible) != 1:
        raise ValueError(
            f"needs one two-dimensional {what}, or one profile, found {sorted(eligible)}; choose "
            f"one by {'channel' if what == 'channel' else 'variable'}"
        )
    return eligible[0], tuple(name for name in usable if name != eligible[0])


def read_numpy(path: Path, variable: str | None) -> Raw:
    """Read an array of a numpy file, or an archive of them."""
    try:
        # An array is not read yet: its header may promise more than there is.
        loaded = np.load(path, allow_pickle=False, mmap_mode="r")
    except (OSError, ValueError) as error:
        # numpy takes what it does not know for a pickle, and advises to load it all the same.
        reason = "it holds no plain array" if re.search("pickle|objects", str(error)) else error
        if "mmap length" in str(error):
            reason = "it is shorter than its header says: copy it again"
        raise ValueError(f"not a readable numpy file ({reason})") from error
    if not isinstance(loaded, np.ndarray):
        with loaded:
            return _read_arrays(dict(loaded), str(path), variable)
    check_count(loaded.shape)
    if loaded.dtype.names:
        fields = {name: loaded[name] for name in loaded.dtype.names}
        if not {"x", "y", "z"} <= {name.lower() for name in fields} and len(fields) > 1:
            raise ValueError(
                f"a structured array with the fields {', '.join(fields)}: save that of the "
                "heights as a plain array, or call them x, y and z"
            )
        return _read_arrays(fields, str(path))
    heights = _squeeze(loaded)
    if heights.ndim not in (1, 2):
        raise ValueError(
            f"needs a two-dimensional array or a profile, got shape {loaded.shape}; save one "
            "map of them"
        )
    return _read_alone(Raw(_as_real(heights, "the array").T, str(path)))


def _squeeze(array: NDArray) -> NDArray:
    """Array without leading or trailing axes of one, as long as it is no map."""
    while array.ndim > 2 and 1 in (array.shape[0], array.shape[-1]):
        array = array[0] if array.shape[0] == 1 else array[..., 0]
    return array


def _as_real(array: NDArray, name: str) -> NDArray:
    if array.dtype.kind not in _NUMBERS:
        raise ValueError(f"{name} holds no real numbers (it is of {array.dtype})")
    return np.array(array, dtype=float)


def _read_arrays(
    arrays: Mapping[str, NDArray],
    source: str,
    wanted: str | int | None = None,
    what: str = "key",
    units: Mapping[str, str] | None = None,
) -> Raw:
    """Find the heights among named arrays, and the positions that belong to them.

    `wanted` is the name of their array or its number among the maps, `what` what the format calls
    its arrays, and `units` has units by name.
    """
    in_names = {name: unit for name in arrays if (unit := split_unit(name)[1])}
    units = in_names | dict(units or {})
    arrays = {name: _squeeze(np.asarray(array)) for name, array in arrays.items()}
    if isinstance(wanted, int):
        maps = [name for name, array in arrays.items() if array.ndim == 2]
        if not 0 <= wanted < len(maps):
            raise ValueError(f"no {what} {wanted!r}; the file has {sorted(arrays)}")
        wanted = maps[wanted]

    # The heights are one of the arrays that hold no positions.
    names_of_positions = _find_positions(arrays)
    candidates = {
        name: array
        for name, array in arrays.items()
        if array.dtype.kind in _NUMBERS
        and name not in names_of_positions.values()
        and array.size > 1
    }
    name, others = _choose(arrays, candidates, wanted, what)
    heights = _as_real(arrays[name], f"{what} {name!r}")
    raw = Raw(heights, f"{source}: {name}", units.get(name), others)

    # Positions belong to them if they have as many points; else numbers may tell their steps.
    x, y = (arrays.get(names_of_positions.get(axis, "")) for axis in "xy")
    place_units = {units.get(each) for each in names_of_positions.values()} - {None}
    place_unit = place_units.pop() if len(place_units) == 1 else None
    placed = _place_line(raw, x, y) if heights.ndim == 1 else _place_map(raw, x, y)
    if placed.places is not None:
        return replace(placed, place_unit=place_unit)
    steps, step_unit = _find_steps(arrays, units)
    return _read_alone(replace(placed, places=steps, place_unit=step_unit))


def _place_line(raw: Raw, x: NDArray | None, y: NDArray | None) -> Raw:
    """Heights of points x y z on their grid, or a profile with positions, if these are its own."""
    along = [each for each in (x, y) if each is not None and each.shape == raw.heights.shape]
    if len(along) < 2:
        return replace(raw, places=np.array(along[0], dtype=float)) if along else raw
    grid = map_points(np.stack([*along, raw.heights]).astype(float))
    return replace(raw, **grid._asdict())


def _place_map(raw: Raw, x: NDArray | None, y: NDArray | None) -> Raw:
    """Heights of a matrix along x and y, with the steps of positions, if these are its own."""
    # A mesh shows along which axis it changes; of lines only their numbers of points may.
    first_is_x = False
    shape = raw.heights.shape
    if x is not None and x.ndim == 2:
        first_is_x = bool(x[0, 0] != x[-1, 0])
    elif x is not None and y is not None:
        first_is_x = (x.size, y.size) == shape != shape[::-1]
    heights = raw.heights if first_is_x else raw.heights.T
    lines = {name: _line(each) for name, each in (("x", x), ("y", y)) if each is not None}
    if tuple(line.size for line in lines.values()) != heights.shape:
        return replace(raw, heights=heights)
    steps = np.array([find_step(line, name) for name, line in lines.items()])
    return replace(raw, heights=heights, places=steps)


def _line(positions: NDArray) -> NDArray:
    """Positions along the axis of a mesh on which they change."""
    if positions.ndim == 1:
        return positions
    return positions[0] if positions[0, 0] != positions[0, -1] else positions[:, 0]


def _read_alone(raw: Raw) -> Raw:
    """Read an array without positions beside it, only steps: its columns are as those of a text."""
    table = read_columns(np.atleast_2d(raw.heights))
    if table.places is None and raw.places is not None:
        is_line = raw.heights.ndim == 1
        places = raw.places[0] * np.arange(len(raw.heights)) if is_line else raw.places
        table = table._replace(places=places)
    return replace(raw, **table._asdict())


def _find_steps(
    arrays: Mapping[str, NDArray], units: Mapping[str, str]
) -> tuple[NDArray | None, str | None]:
    """Steps along x and y that numbers beside a matrix tell, and their unit."""
    step_by_axis: dict[str, tuple[float, str | None]] = {}
    for name, array in arrays.items():
        match = _STEP.match(split_unit(name.lower())[0])
        if match is None or array.size != 1 or array.dtype.kind not in "iuf":
            continue
        step = float(array.flat[0]), units.get(name)
        if step_by_axis.setdefault(match[1], step) != step:
            return None, None  # those of several maps
    along_x = step_by_axis.get("x", step_by_axis.get(""))
    along_y = step_by_axis.get("y", along_x)
    if along_x is None or along_y is None:
        return None, None
    (dx, unit), (dy, other_unit) = along_x, along_y
    if not (0 < dx < np.inf and 0 < dy < np.inf):
        return None, None
    return np.array([dx, dy]), unit if unit == other_unit else None


def _find_positions(arrays: Mapping[str, NDArray]) -> dict[str, str]:
    """Arrays of positions along x and y, by their names; maps only if they are none of heights."""
    name_by_axis: dict[str, str] = {}
    for name, array in arrays.items():
        match = _POSITION.match(split_unit(name.lower())[0])
        is_line = array.ndim == 1 and array.size > 1
        if match and array.dtype.kind in _NUMBERS and (is_line or _is_mesh(array)):
            name_by_axis.setdefault(match[1], name)
    return name_by_axis


def _is_mesh(array: NDArray) -> bool:
    """Whether a matrix holds positions, which change along one axis only."""
    if array.ndim != 2 or min(array.shape) < 2:
        return False
    return any(
        np.allclose(lines, lines[:1], rtol=1e-9, atol=0) and lines[0, 0] != lines[0, -1]
        for lines in (array, array.T)
    )


def read_matlab(path: Path, wanted: str | int | None) -> Raw:
    """Read a matrix of a MATLAB file."""
    if read_head(path, 10) == b"MATLAB 7.3":
        arrays, units = _load_hdf5(path)
        arrays = {name: array.T for name, array in arrays.items()}  # stored columns first
    else:
        import scipy.io

        units = {}
        arrays = {
            name: array
            for name, array in scipy.io.loadmat(path).items()
            if isinstance(array, np.ndarray) and array.dtype.kind in _NUMBERS
        }
    arrays = {name: array.ravel() if 1 in array.shape else array for name, array in arrays.items()}
    if not arrays:
        raise ValueError("the file holds no matrix of numbers; save one, e.g. save('map.mat', 'Z')")
    return _read_arrays(arrays, str(path), wanted, "channel", units)


def read_hdf5(path: Path, wanted: str | int | None) -> Raw:
    """Read a dataset of an HDF5 file."""
    arrays, units = _load_hdf5(path)
    if not arrays:
        raise ValueError("the file holds no matrix of numbers; export one as text, .nc or .npy")
    return _read_arrays(arrays, str(path), wanted, "channel", units)


def _load_hdf5(path: Path) -> tuple[dict[str, NDArray], dict[str, str]]:
    """All arrays of numbers in an HDF5 file, and their units."""
    import h5py  # SurfaceTopography needs it, too

    arrays: dict[str, NDArray] = {}
    units: dict[str, str] = {}

    def take(name: str, node) -> None:
        for key, value in node.attrs.items():
            if _STEP.match(split_unit(key.lower())[0]) and np.size(value) == 1:
                arrays[f"{name}/{key}"] = np.asarray(value)
        is_text = node.attrs.get("MATLAB_class") == b"char"
        if not isinstance(node, h5py.Dataset) or is_text or name.startswith("#"):
            return
        if node.dtype.kind in _NUMBERS and node.ndim <= 3 and node.size > 0:
            arrays[name] = node[...]
            if (unit := _find_unit(node.attrs)) is not None:
                units[name] = unit

    with h5py.File(path, "r") as file:
        take("", file)
        file.visititems(take)
    return arrays, units
