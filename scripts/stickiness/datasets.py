"""NetCDF files between the stages: written whole or not at all, checked when read."""

from __future__ import annotations

import json
import os
import re
import shutil
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from importlib.metadata import version
from pathlib import Path
from typing import Any
from uuid import uuid4

import numpy as np
import xarray as xr

from stickiness import __version__
from stickiness.units import write_quantities

__all__ = [
    "DatasetError",
    "WriteError",
    "annotate",
    "demand",
    "flags",
    "parameters",
    "provenance",
    "read",
    "read_groups",
    "whole_file",
    "write",
]

# Sign conventions by names of variables; every file states them.
_SIGNS = {
    r"(\w+_)?mean_gap(_mean)?": "not negative; rigid displacement, distance of the mean planes of "
    "the elastic surface and the heights, without the mean compression of a layer",
    r"(edge_)?gap(_mean)?": "0 in contact, positive outside",
    r"(\w+_)?pressure(_mean)?": "positive in compression; the total load is the "
    "mean times the nominal area",
    r"attraction\w*": "positive where the surfaces attract each other",
    r"\w+_traction|(predicted_)?pull_off(_curve\w*)?": "positive in tension",
    r"interaction_energy": "negative where the surfaces attract each other",
    r"heights?": "positive towards the elastic solid",
}


class DatasetError(ValueError):
    """A file between stages is missing, unreadable or lacks what the reader needs."""


class WriteError(DatasetError, OSError):
    """A file could not be written."""


def provenance() -> dict[str, str]:
    """Versions of this package and of the codes that its numbers depend on."""
    import pyfftw  # here, not above: figures and reports need no FFTW

    names = ("numpy", "scipy", "pyfftw", "xarray", "netCDF4")
    codes = {f"version_{name.lower()}": version(name) for name in names}
    return {"version_stickiness": __version__} | codes | {"version_fftw": str(pyfftw.fftw_version)}


def annotate(dataset: xr.Dataset, **described: tuple[str, ...]) -> xr.Dataset:
    """Set `units`, `long_name`, what NaN means if it may occur, and the sign convention."""
    for name, texts in described.items():
        attributes = {}
        for pattern, convention in _SIGNS.items():
            if re.fullmatch(pattern, name):
                attributes["sign_convention"] = convention
        # The last text is given only where values may be missing.
        attributes |= zip(("units", "long_name", "nan_means"), texts, strict=False)
        dataset[name].attrs = attributes
    return dataset


def flags(words: Iterable[str], first: int = 0) -> dict[str, Any]:
    """Attributes that say what the codes `first`, `first` + 1, … mean (CF conventions §3.5)."""
    meanings = [word.replace(" ", "_") for word in words]
    codes = np.arange(first, first + len(meanings), dtype="i1")
    return {"flag_values": codes, "flag_meanings": " ".join(meanings)}


def write(
    dataset: xr.Dataset,
    path: str | Path,
    *,
    title: str,
    parameters: Mapping[str, Any],
    groups: Mapping[str, xr.Dataset] | None = None,
) -> None:
    """Write a dataset with its parameters (as JSON) and provenance, whole or not at all.

    Every variable needs `long_name`, numbers need `units`, and `nan_means` if some are not finite.
    Others of the same variables go into `groups` of the file.
    """
    path = Path(path)
    # Last parts of a path tell a result from others, wherever all of them are moved.
    relative = not path.is_absolute() and len(path.parts) > 1
    dataset = dataset.assign_attrs(
        title=title,
        Conventions="CF-1.11",
        parameters=json.dumps(write_quantities(parameters), sort_keys=True),
        written_as="/".join(path.parts[1:] if relative else path.parts[-2:]),
        **provenance(),
    )
    for name in dataset.variables:
        kind = dataset[name].dtype.kind
        attributes = dataset[name].attrs
        is_text = kind in "OU"
        if is_text:
            attributes.pop("units", None)
            dataset[name].encoding = {}  # texts joined keep the width of the first one's file
        for text in ("long_name",) if is_text else ("units", "long_name"):
            if text not in attributes:
                raise DatasetError(f"{path}: variable {name!r} lacks {text}")
        if kind == "f" and "nan_means" not in attributes and not np.isfinite(dataset[name]).all():
            raise DatasetError(f"{path}: variable {name!r} holds values that are not finite")
    with whole_file(path) as temporary:
        try:
            dataset.to_netcdf(temporary, engine="netcdf4")
            for name, other in (groups or {}).items():
                other.to_netcdf(temporary, engine="netcdf4", mode="a", group=name)
        except RuntimeError as error:  # what netCDF4 makes of a failing disk
            raise OSError(str(error)) from None


def read(path: str | Path, variables: Iterable[str] = ()) -> xr.Dataset:
    """Read a dataset into memory, check that it is the one of this name and holds `variables`."""
    path = Path(path)
    try:
        with xr.open_dataset(path, engine="netcdf4") as opened:
            dataset = opened.load()
    except FileNotFoundError:
        raise DatasetError(f"{path}: no such file; the rule that makes it has not run") from None
    except (OSError, ValueError, RuntimeError, AttributeError) as error:
        raise DatasetError(
            f"{path}: not a readable NetCDF file ({error}); delete it and re-run"
        ) from None
    if "parameters" not in dataset.attrs:
        raise DatasetError(f"{path}: not written by this project; delete it and re-run")
    written_as = dataset.attrs.get("written_as", path.name)
    if not path.absolute().as_posix().endswith(f"/{written_as}"):
        raise DatasetError(f"{path}: holds what belongs in {written_as}; delete it and re-run")
    demand(dataset, path, variables)
    return dataset


def demand(dataset: xr.Dataset, path: str | Path, variables: Iterable[str]) -> None:
    """Raise an error that names the file if a dataset lacks one of these variables."""
    missing = [name for name in variables if name not in dataset.variables]
    if missing:
        raise DatasetError(f"{path}: lacks the variable {missing[0]!r}; delete it and re-run")


def read_groups(path: str | Path) -> dict[str, xr.Dataset]:
    """Read the groups of a file into memory, by name; of a file that `read` can read."""
    import netCDF4

    def list_names(group: netCDF4.Dataset) -> list[str]:
        return [
            name
            for each in group.groups.values()
            for name in (each.path.strip("/"), *list_names(each))
        ]

    with netCDF4.Dataset(path) as opened:
        names = list_names(opened)
    return {name: xr.load_dataset(path, engine="netcdf4", group=name) for name in names}


def parameters(dataset: xr.Dataset) -> dict[str, Any]:
    """The parameters that made a dataset, as given to `write`."""
    return json.loads(dataset.attrs["parameters"])


@contextmanager
def whole_file(path: str | Path) -> Iterator[Path]:
    """Give a temporary path that replaces `path` on success and vanishes on failure."""
    path = Path(path)
    temporary = path.with_name(f".{path.name}.{uuid4().hex[:8]}{path.suffix}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        # What a killed job left. Should an orphan still write to it, only its own end fails.
        for leftover in path.parent.glob(f".{path.name}.????????{path.suffix}"):
            leftover.unlink(missing_ok=True)
        yield temporary
        temporary.replace(path)
    except OSError as error:
        raise WriteError(_explain(path, error)) from None
    finally:
        with suppress(OSError):
            temporary.unlink()


def _explain(path: Path, error: OSError) -> str:
    """Say what may have caused an error: who may write here, and the room left."""
    folder = path.parent
    while not os.path.exists(folder):  # which is False, too, where one may not look
        folder = folder.parent
    if isinstance(error, PermissionError) or not os.access(folder, os.W_OK):
        remedy = f"allow writing in {folder}"
    else:
        free = shutil.disk_usage(folder).free / 1e6
        remedy = f"{free:.0f} MB are free in {folder}; make room"
    return f"{path}: could not be written ({error}): {remedy} and run the same command again"
