"""Reading, filling and levelling of measured topographies, and the catalogue of surfaces."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from common.config import load
from stickiness.measured import levelling, text_matrix, topography
from stickiness.units import si

CONFIG = Path(__file__).parents[3] / "config"


@pytest.fixture
def matrix():
    """Rows along y, as instruments store them: 5 rows, 4 columns."""
    return np.random.default_rng(3).normal(size=(5, 4)).round(6)


def write(path, matrix, separator="\t", header="", comma=False):
    text = "\n".join(separator.join(f"{v:.6f}" for v in row) for row in matrix)
    path.write_text(header + (text.replace(".", ",") if comma else text) + "\n", encoding="utf-8")
    return path


HEADER = "# Channel: Z\n# Width: 10.00 µm\n# Height: 25 µm\n# Value units: nm\n"


def test_heights_as_a_data_array_lie_where_they_were_measured():
    heights = np.arange(6.0).reshape(3, 2)
    found = topography.Topography(heights, 0.5, 2.0, "test").to_xarray()
    assert found.sel(x=1.0, y=2.0) == heights[2, 1]
    assert [found[name].attrs["units"] for name in ("x", "y")] == ["m", "m"]
    assert found.attrs == {"units": "m", "long_name": "height"}


# Text matrices


@pytest.mark.parametrize(
    ("separator", "comma"),
    [("\t", False), (" ", False), (",", False), (", ", False), (";", False), (";", True)]
    + [("\t", True), (" ", True)],
)
def test_every_separator_and_decimal_comma_gives_the_same_heights(
    tmp_path, matrix, separator, comma
):
    path = write(tmp_path / "a.txt", matrix, separator, comma=comma)
    t = topography.read(path, pixel_size="2 nm", height_unit="um")
    assert t.heights.shape == (4, 5)
    np.testing.assert_allclose(t.heights, matrix.T * 1e-6, rtol=1e-15)
    assert (t.dx, t.dy, t.missing) == (2e-9, 2e-9, 0)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "latin-1", "utf-16"])
def test_header_of_gwyddion_tells_size_and_unit(tmp_path, matrix, encoding):
    path = write(tmp_path / "a.txt", matrix, header=HEADER)
    path.write_text(path.read_text(encoding="utf-8"), encoding=encoding)
    t = topography.read(path)
    # 4 columns over 10 um, 5 rows over 25 um
    np.testing.assert_allclose([t.dx, t.dy], [2.5e-6, 5e-6], rtol=1e-12)
    np.testing.assert_allclose(t.size, [10e-6, 25e-6], rtol=1e-12)
    np.testing.assert_allclose(t.heights, matrix.T * 1e-9, rtol=1e-12)
    assert t.source == str(path)


def test_the_caller_overrides_the_header(tmp_path, matrix):
    path = write(tmp_path / "a.txt", matrix, header=HEADER)
    t = topography.read(path, length=["1 mm", "2 mm"])
    np.testing.assert_allclose(t.size, [1e-3, 2e-3], rtol=1e-12)


def test_units_of_height_must_not_disagree(tmp_path, matrix):
    path = write(tmp_path / "a.txt", matrix, header=HEADER)
    same = topography.read(path, height_unit="1e-9 m")
    np.testing.assert_allclose(same.heights, 1e-9 * matrix.T, rtol=1e-12)
    with pytest.raises(ValueError, match="height_unit = 'm', but the file says 'nm'"):
        topography.read(path, height_unit="m")


def test_a_flat_surface_is_refused(tmp_path):
    path = write(tmp_path / "a.txt", np.ones((8, 8)), header=HEADER)
    with pytest.raises(ValueError, match="all heights are 1e-09 m"):
        topography.read(path)


def test_one_length_means_square_pixels(tmp_path, matrix):
    path = write(tmp_path / "a.txt", matrix)
    t = topography.read(path, length="8 um", height_unit="nm")
    np.testing.assert_allclose([t.dx, t.dy], [2e-6, 2e-6], rtol=1e-12)


def test_uncommented_header_lines_and_missing_marks(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("Profile data\nWidth: 3 um\nValue units: nm\n1;2;3;\n4;---;6;\n7;8;9;\n")
    raw = text_matrix.parse(path)
    np.testing.assert_array_equal(raw.values, [[1, 2, 3], [4, np.nan, 6], [7, 8, 9]])
    t = topography.read(path, max_missing=0.2)
    assert t.missing == 1
    # The mean of the four neighbours 2, 4, 6, 8.
    assert t.heights[1, 1] == pytest.approx(5e-9, rel=1e-12)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("1 2\n3 x\n", r"line 2: 'x' is not a number"),
        ("# c\n1 2\n3 4 5\n", r"line 3: 3 numbers where the first row has 2"),
        ("nothing here\n", "no line of numbers"),
        ("", "no line of numbers"),
    ],
)
def test_broken_text_is_named_with_its_line(tmp_path, text, message):
    path = tmp_path / "broken.txt"
    path.write_text(text)
    with pytest.raises(ValueError, match=message) as error:
        topography.read(path, length="1 um", height_unit="nm")
    assert "broken.txt" in str(error.value)


# Arguments and other formats


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"height_unit": "nm"}, "does not tell its size; give length or pixel_size"),
        ({"length": "1 um"}, "does not tell the unit of height; give height_unit"),
        ({"length": "1 um", "pixel_size": "1 nm"}, "length or pixel_size, not both"),
        ({"length": "1 kg", "height_unit": "nm"}, "length.*'1 kg'"),
        ({"length": "-1 um", "height_unit": "nm"}, "length must be positive.*'-1 um'"),
        ({"length": ["1 um"] * 3, "height_unit": "nm"}, "one length or two"),
        ({"length": "1 um", "height_unit": "parsec per fortnight"}, "height_unit"),
        ({"length": "1 um", "height_unit": "nm", "max_missing": 1.5}, "max_missing.*1.5"),
    ],
)
def test_what_the_file_does_not_tell_must_be_told(tmp_path, matrix, arguments, message):
    path = write(tmp_path / "bare.txt", matrix)
    with pytest.raises(ValueError, match=message):
        topography.read(path, **arguments)


def test_no_such_file(tmp_path):
    with pytest.raises(FileNotFoundError, match="nowhere"):
        topography.read(tmp_path / "nowhere.txt")


@pytest.mark.parametrize("suffix", ["npy", "npz"])
def test_numpy_files(tmp_path, matrix, suffix):
    path = tmp_path / f"a.{suffix}"
    if suffix == "npy":
        np.save(path, matrix)
    else:
        np.savez(path, z=matrix, x=np.arange(4))
    t = topography.read(path, pixel_size=("1 um", "2 um"), height_unit="nm")
    np.testing.assert_allclose(t.heights, matrix.T * 1e-9, rtol=1e-15)
    np.testing.assert_allclose([t.dx, t.dy], [1e-6, 2e-6], rtol=1e-12)


def test_npz_names_its_keys_when_the_choice_is_not_clear(tmp_path, matrix):
    path = tmp_path / "two.npz"
    np.savez(path, a=matrix, b=matrix, line=np.arange(3))
    arguments = {"length": "1 um", "height_unit": "m"}
    with pytest.raises(ValueError, match=r"two.npz.*\['a', 'b'\]"):
        topography.read(path, **arguments)
    with pytest.raises(ValueError, match=r"no key 'c'.*'line'"):
        topography.read(path, variable="c", **arguments)
    assert isinstance(topography.read(path, variable="line", **arguments), topography.Profile)
    assert topography.read(path, variable="b", **arguments).source.endswith("two.npz: b")


@pytest.mark.parametrize("dims", [("y", "x"), ("x", "y")])
def test_netcdf_takes_units_and_steps_from_the_file(tmp_path, matrix, dims):
    path = tmp_path / "a.nc"
    values = matrix if dims == ("y", "x") else matrix.T
    data = xr.Dataset(
        {"height": (dims, values, {"units": "nm"})},
        coords={
            "x": ("x", 0.5 * np.arange(4), {"units": "um"}),
            "y": ("y", 3.0 * np.arange(5), {"units": "um"}),
        },
    )
    data.to_netcdf(path)
    t = topography.read(path)
    np.testing.assert_allclose(t.heights, matrix.T * 1e-9, rtol=1e-15)
    np.testing.assert_allclose([t.dx, t.dy], [0.5e-6, 3e-6], rtol=1e-12)
    with pytest.raises(ValueError, match="no variable 'depth'.*'height'"):
        topography.read(path, variable="depth")


def test_netcdf_with_uneven_coordinates_is_refused(tmp_path, matrix):
    path = tmp_path / "a.nc"
    x = ("x", [0.0, 1.0, 2.0, 4.0], {"units": "um"})
    xr.Dataset({"z": (("y", "x"), matrix, {"units": "nm"})}, coords={"x": x}).to_netcdf(path)
    with pytest.raises(ValueError, match="a.nc.*'x' is not evenly spaced"):
        topography.read(path)


@pytest.mark.parametrize("name", ["a.nc", "a.npz"])
def test_files_that_are_not_what_their_name_says(tmp_path, name):
    (tmp_path / name).write_text("not binary at all")
    with pytest.raises(ValueError, match=f"{name}: not a readable"):
        topography.read(tmp_path / name)


def test_the_number_that_marks_missing_points(tmp_path):
    matrix = np.arange(100.0).reshape(10, 10)
    matrix[4, 5] = -9999
    path = write(tmp_path / "a.txt", matrix)
    t = topography.read(path, length="1 um", height_unit="m", missing_value=-9999)
    # The matrix is a plane, which harmonic filling continues exactly.
    assert t.heights[5, 4] == pytest.approx(45.0, rel=1e-12)
    assert t.missing_fraction == 0.01


def test_jacksboro_has_the_steps_of_the_ellipsoid():
    t = topography.jacksboro()
    assert t.heights.shape == (403, 344)
    assert t.heights.min() == 236
    assert t.heights.max() == 1076
    # The usual series for the length of a degree on WGS 84, independent of the radii of curvature
    # used; its coefficients are rounded to 1 cm in 111 km.
    phi = np.deg2rad((36.73291666666667 + 36.44625) / 2)
    north = 111132.92 - 559.82 * np.cos(2 * phi) + 1.175 * np.cos(4 * phi)
    east = 111412.84 * np.cos(phi) - 93.5 * np.cos(3 * phi) + 0.118 * np.cos(5 * phi)
    np.testing.assert_allclose([t.dx, t.dy], np.array([east, north]) / 1200, rtol=1e-6)


# Filling and levelling


def test_holes_in_a_plane_are_filled_exactly():
    x, y = np.meshgrid(np.arange(30.0), np.arange(20.0), indexing="ij")
    plane = 1 + 0.3 * x - 0.2 * y
    holed = plane.copy()
    holed[10:16, 5:9] = np.nan  # inside: the discrete Laplacian of a plane vanishes
    holed[3, 3] = np.inf
    filled, missing = levelling.fill_missing(holed)
    assert missing == 25
    np.testing.assert_allclose(filled, plane, atol=1e-12)


def test_filling_makes_no_new_extremes_and_keeps_the_rest():
    heights = np.random.default_rng(0).normal(size=(40, 50))
    hole = np.random.default_rng(1).random((40, 50)) < 0.08
    hole[0, :3] = hole[-3:, -1] = True  # at the edge and in a corner too
    filled, missing = levelling.fill_missing(np.where(hole, np.nan, heights))
    assert missing == hole.sum()
    np.testing.assert_array_equal(filled[~hole], heights[~hole])
    assert filled.max() <= heights[~hole].max()
    assert filled.min() >= heights[~hole].min()


def with_hole(width, scale=100.0):
    """A rough map with a hole of 10 x 8 points, whose rim of so many points is far off."""
    heights = np.random.default_rng(2).normal(size=(60, 50)).cumsum(0).cumsum(1)
    rim = np.zeros(heights.shape, bool)
    rim[20 - width : 30 + width, 30 - width : 38 + width] = True
    spoilt = heights + scale * np.std(np.diff(heights, axis=0)) * rim
    spoilt[20:30, 30:38] = np.nan
    return spoilt, heights


@pytest.mark.parametrize("width", [0, 1, 2, 3])
def test_rims_are_dropped_as_far_as_they_stand_out(width):
    spoilt, heights = with_hole(width)
    kept, dropped = levelling.without_rims(spoilt)
    assert dropped == (10 + 2 * width) * (8 + 2 * width) - 80
    known = np.isfinite(kept)
    np.testing.assert_array_equal(kept[known], heights[known])
    assert levelling.without_rims(spoilt, 1)[1] == 12 * 10 - 80  # as asked for


def test_rims_stay_where_nothing_stands_out_or_is_missing():
    spoilt, heights = with_hole(1, scale=0.5)
    assert levelling.without_rims(spoilt)[1] == 0
    assert levelling.without_rims(heights)[1] == 0
    holes = np.random.default_rng(4).random(heights.shape) < 0.05
    assert levelling.without_rims(np.where(holes, np.nan, heights))[1] == 0


@pytest.mark.parametrize("missing", ["fill", "crop"])
def test_rims_are_dropped_on_reading(tmp_path, missing):
    spoilt, heights = with_hole(1)
    np.save(tmp_path / "map.npy", spoilt)
    np.save(tmp_path / "line.npy", spoilt[25])
    asked = {"pixel_size": "1 um", "height_unit": "um", "missing": missing, "max_missing": 0.3}
    plane = topography.read(tmp_path / "map.npy", **asked)
    line = topography.read(tmp_path / "line.npy", **asked)
    assert (plane.dropped, line.dropped) == (40, 2)
    assert plane.h_rms < 1.1e-6 * np.std(heights)
    plane = topography.read(tmp_path / "map.npy", **asked, missing_rim=0)
    assert plane.dropped == 0
    with pytest.raises(ValueError, match="missing_rim.*-1"):
        topography.read(tmp_path / "map.npy", **asked, missing_rim=-1)
    with pytest.raises(
        ValueError, match=r"npy, 40 points beside missing ones dropped: 120 of 3000"
    ):
        topography.read(tmp_path / "map.npy", **asked | {"missing": "fill", "max_missing": 0.03})


@pytest.mark.parametrize("share", [0.2, 1.0])
def test_too_many_missing_points_are_refused(share):
    heights = np.zeros(1000).reshape(20, 50)
    heights.ravel()[: int(1000 * share)] = np.nan
    with pytest.raises(ValueError, match=rf"scan\.nc: {int(1000 * share)} of 1000 points"):
        levelling.fill_missing(heights, source="scan.nc")


@pytest.mark.parametrize(("kind", "terms"), [("mean", 1), ("plane", 3), ("quadratic", 6)])
def test_levelling_equals_a_dense_least_squares_fit(kind, terms):
    rng = np.random.default_rng(5)
    x, y = np.meshgrid(np.arange(23.0), np.arange(17.0), indexing="ij")
    heights = rng.normal(size=x.shape) + 4 - x + 0.2 * y + 0.3 * x * y - 0.1 * x**2
    monomials = [np.ones_like(x), x, y, x * x, x * y, y * y][:terms]
    design = np.stack([m.ravel() for m in monomials], axis=1)
    fitted = design @ np.linalg.lstsq(design, heights.ravel(), rcond=None)[0]
    expected = heights - fitted.reshape(heights.shape)
    # Rounding of heights of order 100.
    np.testing.assert_allclose(levelling.detrend(heights, kind), expected, atol=1e-10)


def test_levelling_of_a_topography_keeps_what_it_came_with(tmp_path, matrix):
    path = write(tmp_path / "a.txt", matrix, header=HEADER)
    raw = topography.read(path)
    level = raw.detrended("mean")
    assert (level.dx, level.dy, level.source) == (raw.dx, raw.dy, raw.source)
    assert level.h_rms == pytest.approx(raw.h_rms, rel=1e-12)
    assert abs(level.heights.mean()) < 1e-14 * raw.h_rms
    with pytest.raises(ValueError, match="detrend.*'cubic'"):
        raw.detrended("cubic")


# The catalogue


def test_catalogue_of_surfaces_is_valid_and_states_its_sources():
    pytest.importorskip("yaml")
    surfaces = load.load(CONFIG / "surfaces.yaml")["surfaces"]
    assert all(len(s["source"]) > 20 for s in surfaces.values())
    # Claims of the paper on asphalt and polished steel, as numbers.
    assert si(surfaces["asphalt"]["C0"][1], "m^0.4") == 1e-3
    wavelength = si(surfaces["asphalt"]["longest_wavelength"], "m")
    assert 2 * np.pi / wavelength == pytest.approx(1e3, rel=1e-3)
    steel = surfaces["polished_steel"]
    q0 = 2 * np.pi / si(steel["longest_wavelength"], "m")
    # "of the order of 0.1": within a factor two
    assert 0.05 < q0 * si(steel["h_rms"], "m") < 0.2
