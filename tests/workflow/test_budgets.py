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


def missing(results, folder="."):
    """Files and names of numbers that have neither."""
    found = []
    for path in sorted((results / folder).rglob("*.nc")):
        file, dataset = path.relative_to(results).as_posix(), datasets.read(path)
        for name in quoted(dataset):
            whole = all(f"{name}{ending}" in dataset for ending in budget.ENDINGS)
            if not whole and not exempt(file, name):
                found.append(f"{file}: {name}")
    return found


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


def test_every_number_has_a_budget_or_a_reason(finished):
    assert missing(finished / "results/tiny") == []


def test_budgets_are_consistent(finished):
    results, count = finished / "results/tiny", 0
    for path in sorted(results.rglob("*.nc")):
        dataset = datasets.read(path)
        for name in quoted(dataset):
            if f"{name}_total_error" in dataset:
                assert_consistent(dataset, name, path.as_posix())
                count += 1
    assert count > 100


def test_a_number_without_a_budget_is_found(copy_of_finished):
    path = copy_of_finished / "results/tiny/fits/kappa/H0.8_zeta64.nc"
    dataset = datasets.read(path)
    made, title = datasets.parameters(dataset), dataset.attrs["title"]
    stripped = dataset.drop_vars("kappa_total_error").rename(kappa_fit="kappa_fitted")
    datasets.write(stripped, path, title=title, parameters=made)
    found = missing(copy_of_finished / "results/tiny", "fits/kappa")
    assert {"fits/kappa/H0.8_zeta64.nc: kappa", "fits/kappa/H0.8_zeta64.nc: kappa_fitted"} <= {
        *found
    }
