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


def test_units_names_and_nan_must_be_explained(dataset, tmp_path):
    without_units = dataset.copy(deep=True)
    del without_units["area"].attrs["units"]
    with pytest.raises(datasets.DatasetError, match="'area' lacks units"):
        write(without_units, tmp_path / "file.nc")
    dataset["area"][0] = np.nan
    with pytest.raises(datasets.DatasetError, match="'area' holds values that are not finite"):
        write(dataset, tmp_path / "file.nc")
    assert not list(tmp_path.iterdir())
    datasets.annotate(dataset, area=("1", "area fraction", "not measured"))
    write(dataset, tmp_path / "file.nc")
    # Texts have a name and no units.
    named = dataset.assign_coords(law=("pressure", ["hard", "soft"]))
    with pytest.raises(datasets.DatasetError, match="'law' lacks long_name"):
        write(named, tmp_path / "file.nc")
    write(datasets.annotate(named, law=("1", "traction law")), tmp_path / "file.nc")
    assert datasets.read(tmp_path / "file.nc").law.attrs == {"long_name": "traction law"}


def test_reading_names_file_and_variable(dataset, tmp_path):
    path = tmp_path / "file.nc"
    with pytest.raises(datasets.DatasetError, match=r"file\.nc: no such file"):
        datasets.read(path)
    dataset.to_netcdf(path, engine="netcdf4")
    with pytest.raises(datasets.DatasetError, match=r"file\.nc: not written by this project"):
        datasets.read(path, ["area"])
    write(dataset, path)
    with pytest.raises(datasets.DatasetError, match=r"file\.nc: lacks the variable 'gap'"):
        datasets.read(path, ["area", "gap"])


def test_foreign_and_truncated_files_are_refused(dataset, tmp_path):
    path = tmp_path / "file.nc"
    write(dataset, path)
    whole = path.read_bytes()
    parts = [whole[: int(share * len(whole))] for share in (0, 0.02, 0.5, 0.99)]
    for content in (*parts, b"not NetCDF at all", b"\x89HDF\r\n\x1a\n truncated"):
        path.write_bytes(content)
        with pytest.raises(datasets.DatasetError, match=r"file\.nc: .*delete it and re-run"):
            datasets.read(path, ["area"])


def test_a_file_of_another_place_is_refused(dataset, tmp_path):
    """Right variables, but of another seed or case: nothing else would tell."""
    one, other = tmp_path / "case/seed1.nc", tmp_path / "case/seed2.nc"
    write(dataset, one, seed=1)
    other.write_bytes(one.read_bytes())
    with pytest.raises(datasets.DatasetError, match=r"seed2\.nc: holds what belongs in case/seed1"):
        datasets.read(other, ["area"])
    (tmp_path / "elsewhere").mkdir()
    moved = (tmp_path / "case").rename(tmp_path / "elsewhere/case")  # all of it may move
    assert datasets.read(moved / "seed1.nc").equals(dataset)


def test_a_full_disk_leaves_the_old_file_and_says_so(dataset, tmp_path):
    path = tmp_path / "file.nc"
    write(dataset, path, seed=1)
    larger = xr.Dataset({"height": (("x", "y"), np.random.default_rng(1).normal(size=(200, 200)))})
    datasets.annotate(larger, height=("1", "height"))
    message = r"file\.nc: could not be written .*make room and run the same command again"
    resource = pytest.importorskip("resource")
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (50_000, hard))  # refuses what goes beyond
    try:
        with pytest.raises(datasets.WriteError, match=message):
            write(larger, path, seed=2)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert datasets.read(path).equals(dataset)
    assert list(tmp_path.iterdir()) == [path]
    write(larger, path, seed=2)
    assert datasets.read(path).equals(larger)


def test_a_folder_that_may_not_be_written_to_is_named(dataset, tmp_path, monkeypatch):
    """Root may write anywhere, so that the refusal of the system is made up."""
    path = tmp_path / "results" / "file.nc"
    write(dataset, path, seed=1)
    content = path.read_bytes()

    def refuse(*_, **__):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(xr.Dataset, "to_netcdf", refuse)
    message = r"file\.nc: could not be written .*allow writing in .*results and run"
    with pytest.raises(datasets.WriteError, match=message):
        write(dataset, path, seed=2)
    assert path.read_bytes() == content


def test_a_file_in_the_place_of_a_folder_is_an_error(dataset, tmp_path):
    (tmp_path / "results").write_text("a file", encoding="utf-8")
    with pytest.raises(datasets.WriteError, match=r"results/file\.nc: could not be written"):
        write(dataset, tmp_path / "results" / "file.nc")


def test_texts_that_are_joined_keep_their_length(tmp_path):
    for name, text in (("a", ""), ("b", "a longer text")):
        one = xr.Dataset({"t": ("x", np.array([text], dtype=object))})
        one = datasets.annotate(one, t=("1", "text"))
        datasets.write(one, tmp_path / f"{name}.nc", title="a", parameters={})
    both = xr.concat([datasets.read(tmp_path / f"{name}.nc") for name in "ab"], "x")
    datasets.write(both, tmp_path / "both.nc", title="a", parameters={})
    assert datasets.read(tmp_path / "both.nc").t.values.tolist() == ["", "a longer text"]


def test_a_damaged_attribute_is_named_with_its_file(monkeypatch, tmp_path):
    """netCDF4 reports it as an error of a Python attribute."""

    def fail(*arguments, **options):
        raise AttributeError("NetCDF: Can't open HDF5 attribute")

    monkeypatch.setattr(xr, "open_dataset", fail)
    with pytest.raises(datasets.DatasetError, match="damaged.nc: not a readable NetCDF file"):
        datasets.read(tmp_path / "damaged.nc")
