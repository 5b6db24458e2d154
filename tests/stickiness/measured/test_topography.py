"""Measured files read as maps and profiles: formats, units, missing points, levelling."""

from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from stickiness import Surface, surface
from stickiness.measured import levelling, readers, topography
from stickiness.spectrum import SelfAffine

pytestmark = pytest.mark.processors

VOID = 32767
HEADER = "# Channel: Z\n# Width: 10.00 µm\n# Height: 25 µm\n# Value units: nm\n"
METRES = {"length": "1 um", "height_unit": "m"}


def bcr(path, counts):
    """Write counts (rows along y) in the BCR-STM format: 0.5 nm a count, 4 by 3 nm a pixel."""
    ny, nx = counts.shape
    header = (
        f"fileformat = bcrstm\nheadersize = 2048\nxpixels = {nx}\nypixels = {ny}\n"
        f"xlength = {4 * nx}\nylength = {3 * ny}\nxunit = nm\nyunit = nm\nzunit = nm\n"
        f"bit2nm = 0.5\nintelmode = 1\nvoidpixels = {VOID}\n"
    )
    path.write_bytes(header.encode().ljust(2048) + counts.astype("<i2").tobytes())
    return path


@pytest.fixture
def counts():
    return np.random.default_rng(5).integers(-900, 900, size=(12, 10))


@pytest.fixture
def matrix():
    """Rows along y, as instruments store them: 5 rows, 4 columns."""
    return np.random.default_rng(3).normal(size=(5, 4)).round(6)


def write(path, matrix, separator="\t", header="", comma=False, encoding="utf-8"):
    text = "\n".join(separator.join(f"{v:.6f}" for v in row) for row in matrix)
    text = header + (text.replace(".", ",") if comma else text) + "\n"
    path.write_text(text, encoding=encoding)
    return path


# Formats


@pytest.mark.parametrize(
    ("separator", "comma"),
    [(" ", False), (",", False), (", ", False), (";", False), (";", True), ("\t", True)],
)
def test_every_separator_and_comma_gives_the_same_heights(tmp_path, matrix, separator, comma):
    path = write(tmp_path / "a.txt", matrix, separator, comma=comma)
    t = topography.read(path, pixel_size="2 nm", height_unit="um")
    np.testing.assert_allclose(t.heights, matrix.T * 1e-6, rtol=1e-15)
    assert (t.dx, t.dy, t.count(topography.FILL)) == (2e-9, 2e-9, 0)


@pytest.mark.parametrize(
    ("header", "content"),
    [
        ("", "19,876\t20,123\n21,004\t0,500\n"),
        ("", "19,876;20,123\n21,004;-0,5\n"),
        ("", "19,876 20,123\n2101,004 22,001\n"),
        ("# Breite: 1,000 mm\n", "19,876\t20,123\n21,004\t22,001\n"),
        ("# Werteinheit: um\n", "19,876\n20,123\n19,455\n"),
    ],
)
def test_commas_that_can_only_be_decimal_ones(tmp_path, header, content):
    (tmp_path / "a.txt").write_text(header + content)
    heights = readers.read(tmp_path / "a.txt").heights
    numbers = np.array(content.replace(",", ".").replace(";", " ").split(), float)
    np.testing.assert_array_equal(np.ravel(heights.T), numbers)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "latin-1", "utf-16"])
def test_header_of_gwyddion_tells_size_and_unit(tmp_path, matrix, encoding):
    path = write(tmp_path / "a.txt", matrix, header=HEADER, encoding=encoding)
    t = topography.read(path, height_unit="1e-9 m")  # the same unit as in the file
    # 4 columns over 10 um, 5 rows over 25 um
    np.testing.assert_allclose([t.dx, t.dy], [2.5e-6, 5e-6], rtol=1e-12)
    np.testing.assert_allclose(t.heights, matrix.T * 1e-9, rtol=1e-12)
    given = topography.read(path, length=["1 mm", "2 mm"])
    np.testing.assert_allclose(given.size, [1e-3, 2e-3], rtol=1e-12)
    square = topography.read(path, length="8 um")
    np.testing.assert_allclose([square.dx, square.dy], [2e-6, 2e-6], rtol=1e-12)


def test_uncommented_header_lines_and_missing_marks(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("Profile data\nWidth: 3 um\nValue units: nm\n1;2;3;\n4;---;6;\n7;8;9;\n")
    t = topography.read(path, max_missing=0.2)
    # The missing one is the mean of its four neighbours 2, 4, 6, 8.
    np.testing.assert_allclose(t.heights, 1e-9 * np.arange(1, 10).reshape(3, 3).T)
    assert t.count(topography.FILL) == 1
    # A first row that begins with a missing point is no header.
    for first in ("---;2;3", ";2;3", "NaN;2;3"):
        path.write_text(f"Width: 3 um\nValue units: nm\n{first}\n4;5;6\n7;8;9\n")
        t = topography.read(path, max_missing=0.2)
        assert t.heights.shape == (3, 3)
        assert t.count(topography.FILL) == 1


@pytest.mark.parametrize(
    ("content", "shape", "missing"),
    [
        ("1;2;3\n4;5;\n7;8;9\n", (3, 3), 1),  # the last of a row
        ("1,2,\n4,,6\n7,8,9\n", (3, 3), 2),  # of the first
        ("1\t2\t3\t\n4\t5\t6\t\n", (3, 2), 0),  # a separator behind every row
        ("1;2;;\n4;5;6;\n7;8;9;\n", (3, 3), 1),  # the same, and the last of a row
    ],
)
def test_empty_cells_are_missing_points(tmp_path, content, shape, missing):
    (tmp_path / "a.csv").write_text(content)
    t = topography.read(tmp_path / "a.csv", pixel_size="1 um", height_unit="um", max_missing=0.5)
    assert t.heights.shape == shape
    assert t.count(topography.FILL) == missing


@pytest.mark.parametrize(("step", "form"), [(1 / 3, "{:.2f}"), (0.0195, "{:.3f}")])
def test_positions_of_few_digits_are_on_their_grid(tmp_path, step, form):
    heights = np.random.default_rng(0).random((20, 30))
    heights[[3, 4, 9]] = np.nan  # rows of points that are left out
    lines = [
        f"{form.format(step * i)} {form.format(2 * step * j)} {heights[i, j]:.6f}"
        for i, j in np.argwhere(np.isfinite(heights))
    ]
    (tmp_path / "a.txt").write_text("# nx: 20 ny: 30\n" + "\n".join(lines))
    raw = readers.read(tmp_path / "a.txt")
    np.testing.assert_allclose(raw.heights, heights, atol=1e-6)
    np.testing.assert_allclose(raw.places, [step, 2 * step], rtol=0.01)


def test_numpy_files_and_the_choice_of_a_key(tmp_path, matrix):
    np.save(tmp_path / "a.npy", matrix)
    np.savez(tmp_path / "one.npz", z=matrix, x=np.arange(4))
    np.savez(tmp_path / "two.npz", a=matrix, b=matrix, line=np.arange(3))
    steps = {"pixel_size": ("1 um", "2 um"), "height_unit": "nm"}
    for name, key in (("a.npy", None), ("one.npz", None), ("two.npz", "b")):
        t = topography.read(tmp_path / name, **steps, variable=key)
        np.testing.assert_allclose(t.heights, matrix.T * 1e-9, rtol=1e-15)
        np.testing.assert_allclose([t.dx, t.dy], [1e-6, 2e-6], rtol=1e-12)
    with pytest.raises(ValueError, match=r"two.npz.*\['a', 'b'\]"):
        topography.read(tmp_path / "two.npz", **METRES)
    with pytest.raises(ValueError, match=r"no key 'c'.*'line'"):
        topography.read(tmp_path / "two.npz", variable="c", **METRES)
    line = topography.read(tmp_path / "two.npz", variable="line", **METRES)
    assert isinstance(line, topography.Profile)


@pytest.mark.parametrize("dims", [("y", "x"), ("x", "y")])
def test_netcdf_takes_units_and_steps_from_the_file(tmp_path, matrix, dims):
    x, y = np.arange(4), np.arange(5)
    values = matrix if dims == ("y", "x") else matrix.T
    coordinates = {"x": ("x", 0.5 * x, {"units": "um"}), "y": ("y", 3.0 * y, {"units": "um"})}
    data = xr.Dataset({"height": (dims, values, {"units": "nm"})}, coordinates)
    data.to_netcdf(tmp_path / "a.nc")
    t = topography.read(tmp_path / "a.nc")
    np.testing.assert_allclose(t.heights, matrix.T * 1e-9, rtol=1e-15)
    np.testing.assert_allclose([t.dx, t.dy], [0.5e-6, 3e-6], rtol=1e-12)
    with pytest.raises(ValueError, match="no variable 'depth'.*'height'"):
        topography.read(tmp_path / "a.nc", variable="depth")
    data.assign_coords(x=("x", x**2, {"units": "um"})).to_netcdf(tmp_path / "uneven.nc")
    with pytest.raises(ValueError, match="uneven.nc.*'x' is not evenly spaced"):
        topography.read(tmp_path / "uneven.nc")


def test_file_of_an_instrument_tells_size_unit_and_missing_points(tmp_path, counts):
    t = topography.read(bcr(tmp_path / "a.bcr", counts))
    np.testing.assert_allclose([t.dx, t.dy], [4e-9, 3e-9], rtol=1e-12)
    assert t.heights.shape == (10, 12)
    # Instruments may count y upwards or downwards: the spectrum does not care.
    upright = min(
        np.abs(t.heights - 0.5e-9 * c.T).max() for c in (counts, counts[::-1], counts[:, ::-1])
    )
    assert upright < 1e-20
    plane = np.add.outer(3 * np.arange(12), 2 * np.arange(10))
    holes = plane.copy()
    holes[4, 5] = holes[7, 2] = VOID
    path = bcr(tmp_path / "b.bcr", holes)
    filled = topography.read(path)
    assert filled.count(topography.FILL) == 2
    whole = topography.read(bcr(tmp_path / "c.bcr", plane))
    # Harmonic filling continues a plane exactly.
    np.testing.assert_allclose(filled.heights, whole.heights, atol=1e-20)
    with pytest.raises(ValueError, match=r"2 of 120 points \(1\.7 %\) are missing"):
        topography.read(path, missing="refuse")
    cropped = topography.read(path, missing="crop")
    assert cropped.count(topography.FILL) == 0
    assert cropped.cropped_fraction == pytest.approx(1 - cropped.heights.size / 120)


@pytest.mark.parametrize(
    ("name", "content", "kind"),
    [
        ("a.txt", b"1 2\n3 4\n", "text"),
        ("a.dat", "1 2\n".encode("utf-16"), "text"),
        ("a.dat", b"header\n" * 2000 + b"\0\1\2", "instrument"),
        ("a.txt", b"# pixel size = 1e-6 m\n1 2 3\n", "instrument"),
        ("a.txt", b"X;Y;valid\n[mm];[mm];[1/0]\n1;2;1\n", "instrument"),
        ("a.npz", b"", "numpy"),
    ],
)
def test_format_follows_from_name_and_content(tmp_path, name, content, kind):
    (tmp_path / name).write_bytes(content)
    assert readers.format_of(tmp_path / name) == kind
    assert readers.format_of(tmp_path / name, "text") == "text"
    assert readers.format_of(tmp_path / name, "di") == "instrument"


@pytest.mark.parametrize(
    ("name", "unit", "is_height", "holds"),
    [
        ("Height", "m", True, True),
        ("Measurement_000/Channel_000/Error", None, True, False),
        ("Adhesion", ("nm", "V"), True, False),
        ("UserIn0", "m", False, False),
    ],
)
def test_channels_of_heights(name, unit, is_height, holds):
    channel = SimpleNamespace(name=name, unit=unit, is_height_channel=is_height)
    assert readers.holds_heights(channel) == holds


@pytest.mark.parametrize(
    ("name", "skewed", "options", "asks"),
    [
        ("wall_replica.txt", True, {}, True),
        ("mold 2.txt", True, {}, True),
        ("wall_replica.txt", True, {"invert": True}, False),
        ("wall_replica.txt", True, {"invert": False}, False),
        ("wall_replica.txt", False, {}, False),
        ("cast_iron.txt", True, {}, False),
        ("broadcast.txt", True, {}, False),
    ],
)
def test_heights_of_a_replica_are_turned_or_asked_about(tmp_path, name, skewed, options, asks):
    rough = SelfAffine(hurst=0.8, q0=6.3e4, q1=1.5e6, h_rms=1.0)
    heights = surface.synthesise(rough, 64, 1e-4, seed=2)
    heights = np.exp(0.6 * heights) if skewed else heights
    np.savetxt(tmp_path / name, heights.T)
    sides = {"length": "100 um", "height_unit": "um"}
    found = Surface.read(tmp_path / name, **sides, **options)
    options_asked = [reading.guess.options[1] for reading in found.readings]
    assert options_asked == ([{"invert": True}] if asks else [])
    for reading in found.readings:
        skewness = float(reading.surface.data.skewness)
        assert skewness == pytest.approx(-float(found.data.skewness), rel=1e-6)
    sign = -1 if options.get("invert") else 1
    as_array = Surface.from_heights(sign * 1e-6 * heights, 1e-4)
    assert float(found.data.skewness) == pytest.approx(float(as_array.data.skewness), rel=1e-6)
    turned = Surface.from_heights(1e-6 * heights, 1e-4, **options)
    assert float(turned.data.skewness) == pytest.approx(float(as_array.data.skewness), rel=1e-6)


# Errors name file, value and remedy in one line


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"channel": "Phase"}, r"a\.bcr: no channel 'Phase'; the file has 'Default'"),
        ({"variable": "z"}, "an instrument file has no variables; give channel"),
        ({"height_unit": "um"}, "height_unit = 'um', but the file says 'nm'"),
        ({"format": "x3p"}, r"a\.bcr: SurfaceTopography cannot read it"),
        ({"format": "tiff2000"}, "SurfaceTopography has no format 'tiff2000'; it knows al3d, "),
        ({"format": "text"}, r"a\.bcr: its header says 'bit2nm = 0.5', .* give format: instrument"),
        ({"length": "1 um", "pixel_size": "1 nm"}, "length or pixel_size, not both"),
        ({"length": "1 kg"}, "length.*'1 kg'"),
        ({"length": "-1 um"}, "length must be positive.*'-1 um'"),
        ({"height_unit": "parsec per fortnight"}, "height_unit"),
        ({"max_missing": 1.5}, "max_missing.*1.5"),
        ({"missing": "guess"}, "missing must be 'fill', 'crop' or 'refuse', got 'guess'"),
        ({"missing_rim": -1}, "missing_rim.*-1"),
        ({"spikes": "drop"}, "spikes must be 'mask' or 'keep', got 'drop'"),
    ],
)
def test_arguments_that_do_not_fit_the_file(tmp_path, counts, arguments, message):
    path = bcr(tmp_path / "a.bcr", counts)
    with pytest.raises(ValueError, match=message) as caught:
        topography.read(path, **arguments)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("name", "content", "arguments", "message"),
    [
        ("a.txt", "1 2 3\n4 5 6\n", {"channel": "Height"}, "a text file has no channels"),
        ("a.nc", "not binary at all", {}, "a.nc: not a readable NetCDF file"),
        ("a.txt", "1\n2\n3\n", {"length": ["1 m", "2 m"]}, "one length for a line profile"),
        *(
            ("a.txt", f"19,876{mark}20,123\n21,004{mark}{last}\n", {}, r"'19,876' may have decimal")
            for mark, last in (("\t", "998"), (";", "22,001"), (" ", "22,001"))
        ),
        ("a.txt", "19,876\n20,123\n19,455\n", {}, "'19,876' may hold two numbers, or one with"),
    ],
)
def test_files_that_do_not_fit_the_arguments(tmp_path, name, content, arguments, message):
    (tmp_path / name).write_text(content)
    with pytest.raises(ValueError, match=message):
        topography.read(tmp_path / name, height_unit="m", **arguments)
    with pytest.raises(FileNotFoundError, match="nowhere"):
        topography.read(tmp_path / "nowhere.txt")


# Line profiles


@pytest.mark.parametrize("header", ["# nx: 40\n", "# rows: 40\n", "# columns: 2\n"])
def test_headers_of_profiles_count_points_or_the_table(tmp_path, header):
    path = tmp_path / "line.txt"
    path.write_text(header + "\n".join(f"{i} {i % 7}" for i in range(40)))
    assert readers.read(path).heights.shape == (40,)
    path.write_text("# nx: 50\n" + "\n".join(f"{i} {i % 7}" for i in range(40)))
    with pytest.raises(ValueError, match="2 columns, but its header says '# nx: 50'"):
        readers.read(path)


def test_profiles_of_one_column_and_with_uneven_positions(tmp_path):
    path = tmp_path / "line.txt"
    path.write_text("\n".join(map(str, range(20))))
    p = topography.read(path, height_unit="nm", length="10 um")
    assert (p.dx, *p.size) == pytest.approx((0.5e-6, 10e-6))
    np.testing.assert_allclose(p.heights, 1e-9 * np.arange(20), atol=1e-24)
    x = np.array([0.0, 1.0, 2.5, 3.0, 4.0, 6.0])
    path.write_text("\n".join(f"{a};{3 * a + 1}" for a in x[::-1]))
    p = topography.read(path, height_unit="nm", position_unit="um")
    # Linear interpolation keeps a line; six points from 0 to 6 um.
    np.testing.assert_allclose(p.heights, 1e-9 * (3 * np.linspace(0, 6, 6) + 1), rtol=1e-12)
    assert (p.dx, p.largest_gap) == pytest.approx((1.2e-6, 2e-6))
    np.testing.assert_allclose(p.detrended().heights, 0, atol=1e-22)


def test_profile_from_netcdf_with_missing_points(tmp_path):
    heights = np.arange(10.0)
    heights[[3, 9]] = np.nan
    along = ("s", np.arange(10), {"units": "mm"})
    data = xr.Dataset({"z": ("s", heights, {"units": "um"})}, coords={"s": along})
    data.to_netcdf(tmp_path / "a.nc")
    p = topography.read(tmp_path / "a.nc", max_missing=0.2)
    assert (p.count(topography.FILL), p.dx) == (2, pytest.approx(1e-3))
    # A line goes on as a line inside; at the end the last height does.
    np.testing.assert_allclose(p.heights, 1e-6 * np.array([*range(9), 8]), atol=1e-20)
    cropped = topography.read(tmp_path / "a.nc", missing="crop")
    np.testing.assert_allclose(cropped.heights, 1e-6 * np.arange(4, 9), atol=1e-20)


# Missing points


@pytest.mark.parametrize("share", [0.05, 0.3, 0.7])
def test_largest_complete_rectangle_equals_brute_force(share):
    known = np.random.default_rng(2).random((9, 7)) > share
    found = known[levelling.complete_rectangle(known)]
    windows = (
        known[a:b, c:d]
        for a in range(9)
        for b in range(a + 1, 10)
        for c in range(7)
        for d in range(c + 1, 8)
    )
    assert found.all()
    assert found.size == max(window.size for window in windows if window.all())
    with pytest.raises(ValueError, match="here: every point is missing"):
        levelling.complete_rectangle(np.zeros((3, 3), dtype=bool), "here")


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
    assert levelling.without_rims(spoilt, 1)[1] == 12 * 10 - 80  # a width that is given
    # Where nothing stands out or is missing, nothing is dropped.
    assert levelling.without_rims(with_hole(width, scale=0.5)[0])[1] == 0
    assert levelling.without_rims(heights)[1] == 0


@pytest.mark.parametrize("missing", ["fill", "crop"])
def test_rims_are_dropped_on_reading(tmp_path, missing):
    spoilt, heights = with_hole(1)
    np.save(tmp_path / "map.npy", spoilt)
    np.save(tmp_path / "line.npy", spoilt[25])
    given = {"pixel_size": "1 um", "height_unit": "um", "missing": missing, "max_missing": 0.3}
    plane = topography.read(tmp_path / "map.npy", **given)
    line = topography.read(tmp_path / "line.npy", **given)
    assert (plane.count(topography.DROP_RIMS), line.count(topography.DROP_RIMS)) == (40, 2)
    assert plane.h_rms < 1.1e-6 * np.std(heights)
    assert (
        topography.read(tmp_path / "map.npy", **given, missing_rim=0).count(topography.DROP_RIMS)
        == 0
    )
    message = r"npy, 40 points beside missing ones dropped: 120 of 3000"
    with pytest.raises(ValueError, match=message):
        topography.read(tmp_path / "map.npy", **given | {"missing": "fill", "max_missing": 0.03})


# Steps, levelling, and what maps tell


def test_what_was_done_is_listed_in_order():
    spoilt, _ = with_hole(1)
    spoilt[5, 6] += 1e3 * np.std(np.diff(spoilt[:15], axis=0))
    twice = spoilt.repeat(2, axis=1)
    found = topography.from_array(twice, 1e-6, max_missing=0.3, scale=1e-6).detrended("quadratic")
    assert [str(step) for step in found.processing] == [
        "keep every point once",
        "drop points beside missing ones (missing_rim: detect), 40 points",
        "mask spikes (spikes: mask), 1 point",
        "fill missing points (missing: fill), 121 points",
        "level (detrend: quadratic)",
    ]
    (remark,) = found.remarks
    assert remark.startswith("heights: every point is repeated 1 x 2 times")
    assert found.tell_steps().startswith("heights: keep every point once; drop points beside")
    # Nothing is told of heights that were levelled alone.
    assert (
        topography.from_array(spoilt[:15, :10], 1e-6, spikes="keep").detrended().tell_steps() == ""
    )
    line = topography.from_array(np.arange(6.0) ** 2, np.arange(6.0) ** 1.1)
    assert [str(step) for step in line.processing] == ["interpolate at even positions, 6 points"]


@pytest.mark.parametrize(("kind", "terms"), [("mean", 1), ("plane", 3), ("quadratic", 6)])
def test_levelling_equals_a_dense_least_squares_fit(kind, terms):
    rng = np.random.default_rng(5)
    x, y = np.meshgrid(np.arange(23.0), np.arange(17.0), indexing="ij")
    heights = rng.normal(size=x.shape) + 4 - x + 0.2 * y + 0.3 * x * y - 0.1 * x**2
    monomials = [np.ones_like(x), x, y, x * x, x * y, y * y][:terms]
    for known in (np.ones(x.shape, bool), rng.random(x.shape) > 0.1):
        design = np.stack([m[known] for m in monomials], axis=1)
        rest = heights[known] - design @ np.linalg.lstsq(design, heights[known], rcond=None)[0]
        # Rounding of heights of order 100.
        found = levelling.rms_of_known(np.where(known, heights, np.nan), kind)
        assert found == pytest.approx(np.sqrt(np.mean(rest**2)), rel=1e-9)
        if known.all():
            levelled = levelling.detrend(heights, kind)
            np.testing.assert_allclose(levelled.ravel(), rest, atol=1e-10)
    with pytest.raises(ValueError, match="detrend.*'cubic'"):
        levelling.detrend(heights, "cubic")


@pytest.mark.parametrize("options", [{}, {"missing": "crop"}, {"spikes": "keep", "missing_rim": 1}])
def test_an_array_is_cleaned_as_a_file_is(tmp_path, options):
    heights = np.random.default_rng(2).normal(size=(30, 20)).cumsum(axis=0)
    heights[10, 4:7] = np.nan
    heights[20, 10] = 1e3
    np.save(tmp_path / "map.npy", heights.T)
    np.save(tmp_path / "profile.npy", heights[:, 5])
    options = {"max_missing": 0.3} | options
    for name, values, steps in (("map", heights, (2e-6, 1e-6)), ("profile", heights[:, 5], 2e-6)):
        file = tmp_path / f"{name}.npy"
        unit = {"pixel_size": steps, "height_unit": "um"}
        from_file = topography.read(file, **unit, **options)
        masked = np.ma.masked_invalid(values)
        for array in (values, masked):
            same = topography.from_array(array, steps, scale=1e-6, source=str(file), **options)
            assert np.array_equal(same.heights, from_file.heights)
            assert same.steps == pytest.approx(from_file.steps, rel=1e-14)
            for field in ("processing", "doubts", "source"):
                assert getattr(same, field) == getattr(from_file, field)


@pytest.mark.parametrize(
    ("heights", "steps", "words"),
    [
        (np.ones(5), 1e-6, "nothing to analyse"),
        (np.ones((2, 2, 2)), 1e-6, "a map"),
        (np.arange(5.0), [1.0, 1.0, 2.0, 3.0, 4.0], "must all differ"),
        (np.arange(5.0), [1.0, 2.0], "one step or 5 positions"),
        (np.eye(4), -1.0, "positive"),
        (np.full((4, 4), np.nan), 1.0, "which are all"),
    ],
)
def test_arrays_that_hold_no_surface_are_refused(heights, steps, words):
    with pytest.raises(ValueError, match=words):
        topography.from_array(heights, steps)


@pytest.mark.parametrize("repeats", [(1, 1), (2, 1), (3, 5), (4, 4)])
def test_points_that_enlarging_repeats_are_counted(repeats):
    heights = np.random.default_rng(0).normal(size=(20, 12))
    heights[3, 4] = np.nan
    large = heights.repeat(repeats[0], 0).repeat(repeats[1], 1)
    assert levelling.find_repeats(large) == repeats
    assert levelling.find_repeats(large[1:, :-1] if max(repeats) > 1 else large) == (1, 1)
    assert levelling.find_repeats(np.ones((6, 6))) == (1, 1)
