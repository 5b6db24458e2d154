"""What made the results: versions of codes and parameters of the simulations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import xarray as xr

from common.formatting import number
from stickiness import datasets

Context = dict[str, Any]


def describe_provenance(files: Sequence[xr.Dataset], ensembles: Sequence[xr.Dataset]) -> Context:
    """Versions that the files record (all, where they differ) and parameters of ensembles."""
    versions: dict[str, set[str]] = {}
    for file in files:
        for name, value in file.attrs.items():
            if name.startswith("version_"):
                versions.setdefault(name.removeprefix("version_"), set()).add(str(value))
    return {
        "versions": [(name, ", ".join(sorted(found))) for name, found in sorted(versions.items())],
        "mixed": sorted(name for name, found in versions.items() if len(found) > 1),
        "ensembles": [describe_ensemble(datasets.parameters(ensemble)) for ensemble in ensembles],
    }


def describe_ensemble(made: Mapping[str, Any]) -> Context:
    """Parameters of an ensemble."""
    return {
        "case": made["case"],
        "hurst": number(made["hurst"]),
        "magnification": number(made["magnification"]),
        "grid": f"{made['grid_points']} × {made['grid_points']}",
        "pixels": number(made["pixels_per_wavelength"]),
        "tolerance": number(made["tolerance"]),
        "residual": number(made["largest_residual"], 2),
        "seeds": list_seeds(made["seeds"]),
        "means": name_estimator(made),
    }


def name_estimator(made: Mapping[str, Any]) -> str:
    """Estimator of the means, with the seeds it uses besides those of the ensemble."""
    if made["estimator"] == "plain":
        return "plain"
    controls = f"{made['coarse_seeds']} coarse seeds, {made['descriptor_seeds']} long-wave controls"
    return f"multilevel: {controls}"


def list_seeds(seeds: Sequence[int]) -> str:
    """Seeds, with unbroken runs shortened: 1 … 8."""
    seeds = sorted(seeds)
    unbroken = len(seeds) > 2 and seeds == list(range(seeds[0], seeds[-1] + 1))
    return f"{seeds[0]} … {seeds[-1]}" if unbroken else ", ".join(map(str, seeds))
