"""NetCDF files between the stages: written whole or not at all, checked when read."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Iterable, Mapping
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from . import __version__

_TEXTS = ("units", "long_name", "nan_means")
_CODES = ("numpy", "scipy", "pyfftw", "xarray", "netCDF4")


class DatasetError(ValueError):
    """A file between stages is missing, unreadable or lacks what the reader needs."""


def provenance() -> dict[str, str]:
    """Versions of this package and of the codes that its numbers depend on."""
    codes = {f"version_{name.lower()}": version(name) for name in _CODES}
    return {"version_stickiness": __version__, **codes, "version_fftw": _fftw_version()}


def _fftw_version() -> str:
    import pyfftw  # here, not above: figures and reports need no FFTW

    return str(pyfftw.fftw_version)


def annotate(dataset: xr.Dataset, **described: tuple[str, ...]) -> xr.Dataset:
    """Set `units`, `long_name` and, if a variable may hold NaN, what that means (in this order)."""
    for name, texts in described.items():
        dataset[name].attrs = dict(zip(_TEXTS, texts, strict=False))
    return dataset


def write(
    dataset: xr.Dataset, path: str | Path, *, title: str, parameters: Mapping[str, Any]
) -> None:
    """Write a dataset with its parameters and provenance, whole or not at all.

    Parameters
    ----------
    dataset : xarray.Dataset
        Every variable and coordinate carries `units` and `long_name`, and `nan_means` if it holds
        values that are not finite.
    path : path
        Target. The data go to a temporary file beside it that takes its name once complete.
    title : str
        What the file holds.
    parameters : mapping
        What made it; stored as JSON in the attribute `parameters`.

    Raises
    ------
    DatasetError
        If a variable lacks one of these texts.
    """
    path = Path(path)
    for name in dataset.variables:
        values, attributes = dataset[name].values, dataset[name].attrs
        missing = {"units", "long_name"} - attributes.keys()
        if missing:
            raise DatasetError(f"{path}: variable {name!r} lacks {', '.join(sorted(missing))}")
        unexplained = values.dtype.kind == "f" and "nan_means" not in attributes
        if unexplained and not np.isfinite(values).all():
            raise DatasetError(f"{path}: variable {name!r} holds values that are not finite")
    dataset = dataset.assign_attrs(
        title=title,
        Conventions="CF-1.11",
        parameters=json.dumps(parameters, sort_keys=True),
        **provenance(),
    )
    with whole_file(path) as temporary:
        dataset.to_netcdf(temporary, engine="netcdf4")


def read(path: str | Path, variables: Iterable[str] = ()) -> xr.Dataset:
    """Read a dataset into memory and check that it holds `variables`.

    Raises
    ------
    DatasetError
        Naming the file and, if one is missing, the variable.
    """
    path = Path(path)
    try:
        with xr.open_dataset(path, engine="netcdf4") as opened:
            dataset = opened.load()
    except FileNotFoundError:
        raise DatasetError(f"{path}: no such file; the rule that makes it has not run") from None
    except (OSError, ValueError, RuntimeError) as error:
        raise DatasetError(
            f"{path}: not a readable NetCDF file ({error}); delete it and re-run"
        ) from None
    missing = [name for name in variables if name not in dataset.variables]
    if missing:
        raise DatasetError(f"{path}: lacks the variable {missing[0]!r}; delete it and re-run")
    return dataset


def parameters(dataset: xr.Dataset) -> dict[str, Any]:
    """The parameters that made a dataset, as given to `write`."""
    return json.loads(dataset.attrs["parameters"])


class whole_file:  # noqa: N801 (a context manager, used as a verb)
    """Context manager: a temporary path that replaces `path` on success and vanishes on failure."""

    def __init__(self, path: str | Path):
        self._path = Path(path)

    def __enter__(self) -> Path:
        folder, name, suffix = self._path.parent, self._path.name, self._path.suffix
        folder.mkdir(parents=True, exist_ok=True)
        # What a killed job left. Should an orphan still write to it, only its own end fails.
        for leftover in folder.glob(f".{name}.????????{suffix}"):
            leftover.unlink(missing_ok=True)
        handle, name = tempfile.mkstemp(dir=folder, prefix=f".{name}.", suffix=suffix)
        os.close(handle)
        self._temporary = Path(name)
        return self._temporary

    def __exit__(self, kind: type | None, *_: object) -> None:
        if kind is None:
            self._temporary.chmod(0o666 & ~_umask())
            self._temporary.replace(self._path)
        else:
            self._temporary.unlink(missing_ok=True)


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
