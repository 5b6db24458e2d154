"""Error budgets of a complete run are consistent, and quoted numbers have one."""

import numpy as np
import pytest

from stickiness import datasets
from stickiness import error_budget as budget

pytestmark = pytest.mark.workflow

# Numbers that the report quotes: each must have an error budget.
QUOTED = {
    "contact/ensembles/*.nc": ["area_fraction_mean", "mean_gap_mean", "attractive_area_mean"],
    "fits/a_v/ensembles/*.nc": ["a_v_mean"],
    "fits/kappa/*.nc": ["kappa"],
    "cases/*.nc": ["value"],
    "claims/claims.nc": ["value"],
}


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


def test_budgets_are_consistent(finished):
    results, count = finished / "results/tiny", 0
    for path in sorted(results.rglob("*.nc")):
        file, dataset = path.relative_to(results).as_posix(), datasets.read(path)
        for name in dataset.data_vars:
            if all(f"{name}{ending}" in dataset for ending in budget.ENDINGS):
                assert_consistent(dataset, name, file)
                count += 1
    assert count > 100


@pytest.mark.parametrize("pattern", QUOTED)
def test_quoted_numbers_have_a_budget(finished, pattern):
    paths = sorted((finished / "results/tiny").glob(pattern))
    assert paths
    for path in paths:
        needed = {f"{name}{ending}" for name in QUOTED[pattern] for ending in budget.ENDINGS}
        assert needed <= set(datasets.read(path).data_vars), path
