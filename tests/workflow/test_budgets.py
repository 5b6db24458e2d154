"""Every number that a complete run leaves has an error budget, or a reason why it has none."""

import fnmatch
from pathlib import Path

import numpy as np
import pytest
import yaml

from stickiness import datasets
from stickiness import error_budget as budget

pytestmark = pytest.mark.workflow

EXEMPTIONS = yaml.safe_load(Path(__file__).with_name("exemptions.yaml").read_text(encoding="utf-8"))


def quoted(dataset):
    """Names of data, without what is part of a budget."""
    parts = {f"{name}{ending}" for name in dataset.data_vars for ending in budget.ENDINGS}
    return [name for name in dataset.data_vars if name not in parts]


def exempt(file, name):
    return any(
        fnmatch.fnmatch(file, one["files"]) and any(fnmatch.fnmatch(name, p) for p in one["names"])
        for one in EXEMPTIONS
    )


def assert_consistent(dataset, name, file):
    """Total, largest source and texts agree with the parts."""
    error, total = dataset[f"{name}_error"], dataset[f"{name}_total_error"]
    assert list(error.source.values) == list(budget.SOURCES), (file, name)
    assert error.attrs["units"] == dataset[name].attrs["units"], (file, name)
    assert all(f"{source}: " in error.attrs["comment"] for source in budget.SOURCES), (file, name)
    assert not (error < 0).any(), (file, name)
    parts = error.transpose("source", *total.dims).values
    np.testing.assert_allclose(np.linalg.norm(parts, axis=0), total.values, err_msg=file)
    largest = dataset[f"{name}_dominant"].values
    chosen = np.take_along_axis(parts, np.maximum(largest, 0)[None], 0)[0]
    known = (largest != budget.NONE) & np.isfinite(total.values)
    assert np.array_equal(chosen[known], parts.max(0)[known]), (file, name)


def test_every_number_has_a_consistent_budget_or_a_reason(finished):
    results, missing, count = finished / "results/tiny", [], 0
    for path in sorted(results.rglob("*.nc")):
        file, dataset = path.relative_to(results).as_posix(), datasets.read(path)
        for name in quoted(dataset):
            if all(f"{name}{ending}" in dataset for ending in budget.ENDINGS):
                assert_consistent(dataset, name, file)
                count += 1
            elif not exempt(file, name):
                missing.append(f"{file}: {name}")
    assert missing == []
    assert count > 100
