"""Every kind of file that a complete run leaves can be read, written and read again."""

import numpy as np
import pytest

from stickiness import datasets

pytestmark = pytest.mark.workflow


def kinds(results):
    """One file of every kind: what stage wrote it and the variables it holds."""
    found = {}
    for path in sorted(results.rglob("*.nc")):
        dataset = datasets.read(path)
        stage = path.relative_to(results).parts[0]
        found.setdefault((stage, frozenset(dataset.variables)), (path, dataset))
    return found


def assert_round_trip(dataset, path):
    """The same values, types, texts and parameters after writing to `path` and reading."""
    made, title = datasets.parameters(dataset), dataset.attrs["title"]
    datasets.write(dataset, path, title=title, parameters=made)
    again = datasets.read(path, dataset.variables)
    assert datasets.parameters(again) == made
    assert again.attrs["title"] == title
    for name, variable in dataset.variables.items():
        other = again.variables[name]
        assert other.dims == variable.dims, name
        assert other.dtype.kind == variable.dtype.kind, name
        assert other.attrs.keys() == variable.attrs.keys(), name
        for key, text in variable.attrs.items():
            assert np.array_equal(other.attrs[key], text), (name, key)
        if variable.dtype.kind == "f":
            assert other.values.tobytes() == variable.values.tobytes(), name
        else:
            assert np.array_equal(other.values, variable.values), name


def test_every_kind_of_file_round_trips(finished, tmp_path):
    found = kinds(finished / "results/tiny")
    assert len({stage for stage, _ in found}) >= 9
    for path, dataset in found.values():
        assert_round_trip(dataset, tmp_path / path.relative_to(finished.folder))
