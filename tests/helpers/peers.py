"""Reference codes (envs/peers.txt) and the drivers of the benchmarks that call them."""

import importlib
import importlib.util
import pathlib
import warnings

import pytest

BENCHMARKS = pathlib.Path(__file__).parents[2] / "benchmarks"


def import_peer(name):
    """Import a module of a reference code, or skip the test."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the codes warn of a missing MPI
        reason = "reference code not installed: pip install -r envs/peers.txt"
        pytest.importorskip(name.split(".")[0], reason=reason)
        return importlib.import_module(name)


def load_drivers(name):
    spec = importlib.util.spec_from_file_location(name, BENCHMARKS / f"{name}.py")
    drivers = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(drivers)
    return drivers
