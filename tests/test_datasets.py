"""NetCDF between stages: whole or not at all, checked when read."""

import numpy as np
import pytest
import xarray as xr

from stickiness import datasets


@pytest.fixture
def dataset():
    data = xr.Dataset({"area": ("pressure", [0.1, 0.2])}, coords={"pressure": [1.0, 2.0]})
    return datasets.annotate(data, area=("1", "area fraction"), pressure=("1", "mean pressure"))


def write(dataset, path, **parameters):
    datasets.write(dataset, path, title="a test", parameters=parameters)


def test_round_trip(dataset, tmp_path):
    path = tmp_path / "below" / "file.nc"
    write(dataset, path, seed=3, hurst=0.8)
    again = datasets.read(path, ["area"])
    xr.testing.assert_identical(again.drop_attrs(deep=False), dataset.drop_attrs(deep=False))
    assert datasets.parameters(again) == {"seed": 3, "hurst": 0.8}
    assert {"version_numpy", "version_fftw", "version_stickiness"} <= again.attrs.keys()
    assert [file.name for file in path.parent.iterdir()] == ["file.nc"]


def test_same_content_is_the_same_bytes(dataset, tmp_path):
    for name in ("a.nc", "b.nc"):
        write(dataset, tmp_path / name, seed=1)
    assert (tmp_path / "a.nc").read_bytes() == (tmp_path / "b.nc").read_bytes()


def test_nan_must_be_explained(dataset, tmp_path):
    dataset["area"][0] = np.nan
    with pytest.raises(datasets.DatasetError, match="'area' holds values that are not finite"):
        write(dataset, tmp_path / "file.nc")
    assert not list(tmp_path.iterdir())
    datasets.annotate(dataset, area=("1", "area fraction", "not measured"))
    write(dataset, tmp_path / "file.nc")


def test_units_are_asked_for(dataset, tmp_path):
    del dataset["area"].attrs["units"]
    with pytest.raises(datasets.DatasetError, match="'area' lacks units"):
        write(dataset, tmp_path / "file.nc")


def test_failure_leaves_the_old_file_and_nothing_else(tmp_path):
    path = tmp_path / "table.md"
    path.write_text("old")

    def fail():
        with datasets.whole_file(path) as temporary:
            temporary.write_text("half")
            raise RuntimeError

    with pytest.raises(RuntimeError):
        fail()
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_leftovers_of_a_killed_job_are_removed(tmp_path):
    (tmp_path / ".table.md.abcd_123.md").write_text("half")
    (tmp_path / ".table-2.md.abcd_123.md").write_text("another job's, still being written")
    with datasets.whole_file(tmp_path / "table.md") as temporary:
        temporary.write_text("whole")
    names = {file.name for file in tmp_path.iterdir()}
    assert names == {"table.md", ".table-2.md.abcd_123.md"}


def test_reading_names_file_and_variable(dataset, tmp_path):
    path = tmp_path / "file.nc"
    with pytest.raises(datasets.DatasetError, match=r"file\.nc: no such file"):
        datasets.read(path)
    write(dataset, path)
    with pytest.raises(datasets.DatasetError, match=r"file\.nc: lacks the variable 'gap'"):
        datasets.read(path, ["area", "gap"])


@pytest.mark.parametrize("content", [b"", b"not NetCDF at all", b"\x89HDF\r\n\x1a\n truncated"])
def test_foreign_and_truncated_files(content, tmp_path):
    path = tmp_path / "file.nc"
    path.write_bytes(content)
    with pytest.raises(datasets.DatasetError, match=r"file\.nc: not a readable NetCDF file"):
        datasets.read(path)
