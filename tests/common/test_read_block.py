"""Solutions that a case wants, from the files that hold them among other seeds and loads."""

import numpy as np
import pytest
import xarray as xr

from common.model_surfaces import read_block
from stickiness import datasets

RESOLUTIONS = [2.0, 4.0]


def value(seed, pressure):
    return 10 * seed + pressure


@pytest.fixture
def save(tmp_path):
    """A function that writes a file of seeds and pressures, and returns its path."""

    def write(seeds, pressures, resolutions=RESOLUTIONS):
        values = [[[value(seed, p) for p in pressures] for _ in resolutions] for seed in seeds]
        dataset = xr.Dataset(
            {
                "area": (("seed", "resolution", "pressure"), np.array(values, float)),
                "iterations": (("seed", "pressure"), np.ones((len(seeds), len(pressures)), int)),
                "rms_slope": ("seed", np.array(seeds, float)),
            },
            {"seed": list(seeds), "pressure": list(pressures), "resolution": resolutions},
        )
        texts = {name: ("1", name) for name in dataset.variables}
        path = str(tmp_path / f"seeds{seeds[0]}-{seeds[-1]}_p{pressures[0]}.nc")
        parameters = {"seeds": list(seeds)}
        datasets.write(datasets.annotate(dataset, **texts), path, title="", parameters=parameters)
        return path

    return write


def check(found, seeds, pressures):
    assert found.seed.values.tolist() == list(seeds)
    assert found.pressure.values.tolist() == list(pressures)
    want = [[value(seed, pressure) for pressure in pressures] for seed in seeds]
    np.testing.assert_array_equal(found.area.isel(resolution=-1), want)
    np.testing.assert_array_equal(found.rms_slope, list(seeds))
    assert found.iterations.dtype.kind == "i"
    assert found.area.attrs["long_name"] == "area"


def test_seeds_and_pressures_that_are_wanted_are_taken_from_files_side_by_side(save):
    paths = [save([1, 2, 3], [0.1, 0.3]), save([1, 2, 3, 4, 5], [0.2]), save([4, 5, 6], [0.1, 0.3])]
    check(
        read_block(paths, ["area"], [1, 2, 3, 4, 5], [0.1, 0.2, 0.3]), range(1, 6), [0.1, 0.2, 0.3]
    )
    check(read_block(paths, ["area"], [2, 4], [0.3]), [2, 4], [0.3])


def test_what_two_files_hold_is_taken_once(save):
    paths = [save([1, 2], [0.1, 0.2]), save([2, 3], [0.2, 0.3, 0.1])]
    check(read_block(paths, ["area"], [1, 2, 3], [0.1, 0.2]), [1, 2, 3], [0.1, 0.2])


def test_without_pressures_files_need_not_have_the_same_grids(save):
    paths = [save([1, 2], [0.1]), save([3], [0.1], RESOLUTIONS[:1])]
    found = read_block(paths, ["area"], [1, 3])
    assert found.seed.values.tolist() == [1, 3]
    assert found.area.isel(seed=1, pressure=0).isnull().values.tolist() == [False, True]


def test_what_no_file_holds_is_named(save):
    paths = [save([1, 2], [0.1]), save([1], [0.2])]
    with pytest.raises(datasets.DatasetError, match=r"seeds1-1_p0\.2\.nc: no solution of seed 3"):
        read_block(paths, ["area"], [1, 2, 3], [0.1])
    with pytest.raises(datasets.DatasetError, match=r"seed 2 in .*: no solution at pressure 0\.2"):
        read_block(paths, ["area"], [1, 2], [0.1, 0.2])
