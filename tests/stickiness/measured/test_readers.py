"""Files as instruments wrote them, line profiles, channels, units and missing points."""

from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from stickiness.measured import instruments, levelling, readers, topography

VOID = 32767


def bcr(path, counts, void=True):
    """Write counts (rows along y) in the BCR-STM format: 0.5 nm a count, 4 by 3 nm a pixel."""
    ny, nx = counts.shape
    header = (
        f"fileformat = bcrstm\nheadersize = 2048\nxpixels = {nx}\nypixels = {ny}\n"
        f"xlength = {4 * nx}\nylength = {3 * ny}\nxunit = nm\nyunit = nm\nzunit = nm\n"
        f"bit2nm = 0.5\nintelmode = 1\nvoidpixels = {VOID if void else 0}\n"
    )
    path.write_bytes(header.encode().ljust(2048) + counts.astype("<i2").tobytes())
    return path


@pytest.fixture
def counts():
    return np.random.default_rng(5).integers(-900, 900, size=(12, 10))


@pytest.fixture
def instrument():
    if not readers.can_read_instruments():
        pytest.skip("SurfaceTopography is not installed (envs/instruments.txt)")


# Instruments' formats


@pytest.mark.slow
@pytest.mark.usefixtures("instrument")
def test_file_of_an_instrument_tells_size_and_unit(tmp_path, counts):
    t = topography.read(bcr(tmp_path / "a.bcr", counts))
    np.testing.assert_allclose([t.dx, t.dy], [4e-9, 3e-9], rtol=1e-12)
    assert t.heights.shape == (10, 12)
    # Instruments may count y upwards or downwards: the spectrum does not care.
    upright = min(
        np.abs(t.heights - 0.5e-9 * c.T).max() for c in (counts, counts[::-1], counts[:, ::-1])
    )
    assert upright < 1e-20


@pytest.mark.slow
@pytest.mark.usefixtures("instrument")
def test_what_an_instrument_marks_as_missing_is_missing(tmp_path, counts):
    plane = np.add.outer(3 * np.arange(12), 2 * np.arange(10))
    holes = plane.copy()
    holes[4, 5] = holes[7, 2] = VOID
    path = bcr(tmp_path / "a.bcr", holes)
    filled = topography.read(path)
    assert filled.missing == 2
    whole = topography.read(bcr(tmp_path / "b.bcr", plane))
    # Harmonic filling goes on a plane exactly.
    np.testing.assert_allclose(filled.heights, whole.heights, atol=1e-20)
    with pytest.raises(ValueError, match=r"2 of 120 points \(1\.7 %\) are missing"):
        topography.read(path, missing="refuse")
    cropped = topography.read(path, missing="crop")
    assert cropped.missing == 0
    assert cropped.cropped == pytest.approx(1 - cropped.heights.size / 120)


@pytest.mark.slow
@pytest.mark.usefixtures("instrument")
@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"channel": "Phase"}, r"a\.bcr: no channel 'Phase'; the file has 'Default'"),
        ({"channel": 7}, r"a\.bcr: no channel 7"),
        ({"variable": "z"}, "variable is for NetCDF and npz"),
        ({"height_unit": "um"}, "height_unit = 'um', but the file says 'nm'"),
        ({"format": "x3p"}, r"a\.bcr: SurfaceTopography cannot read it"),
        ({"format": "tiff2000"}, "SurfaceTopography has no format 'tiff2000'; it knows al3d, "),
        ({"format": "x3"}, "has no format 'x3'; did you mean 'x3p'?"),
        ({"missing": "guess"}, "missing must be 'fill', 'crop' or 'refuse', got 'guess'"),
    ],
)
def test_what_does_not_fit_the_file_is_said_in_one_line(tmp_path, counts, arguments, message):
    path = bcr(tmp_path / "a.bcr", counts)
    with pytest.raises(ValueError, match=message) as caught:
        topography.read(path, **arguments)
    assert "\n" not in str(caught.value)


@pytest.mark.usefixtures("instrument")
def test_broken_file_of_an_instrument_is_named(tmp_path):
    path = tmp_path / "torn.sur"
    path.write_bytes(b"DIGITAL SURF\0\0\0\1\2")
    with pytest.raises(ValueError, match=r"torn\.sur: SurfaceTopography cannot read it") as caught:
        topography.read(path)
    assert "\n" not in str(caught.value)


def test_without_the_optional_dependency_the_message_says_what_to_install(
    tmp_path, counts, monkeypatch
):
    monkeypatch.setattr(readers, "find_spec", lambda _: None)
    path = bcr(tmp_path / "a.bcr", counts)
    with pytest.raises(ValueError, match=r"need SurfaceTopography.*envs/instruments\.txt"):
        topography.read(path)


@pytest.mark.parametrize(
    ("name", "content", "kind"),
    [
        ("a.txt", b"1 2\n3 4\n", "text"),
        ("a.dat", "1 2\n".encode("utf-16"), "text"),
        ("a.dat", b"header\n" * 2000 + b"\0\1\2", "instrument"),
        ("a.xyz", b"1 2 3\n", "text"),
        ("a.sdf", b"1 2 3\n", "instrument"),
        ("a.txt", b"# pixel size = 1e-6 m\n1 2 3\n", "instrument"),
        ("a.txt", b"X;Y;valid\n[mm];[mm];[1/0]\n1;2;1\n", "instrument"),
        ("a.NC", b"", "netcdf"),
        ("a.npz", b"", "numpy"),
    ],
)
def test_format_follows_from_name_and_content(tmp_path, name, content, kind):
    (tmp_path / name).write_bytes(content)
    assert readers.format_of(tmp_path / name) == kind
    assert readers.format_of(tmp_path / name, "text") == "text"
    assert readers.format_of(tmp_path / name, "di") == "instrument"


def test_channels_are_of_instruments(tmp_path):
    (tmp_path / "a.txt").write_text("1 2 3\n4 5 6\n")
    with pytest.raises(ValueError, match=r"a\.txt: a text file has no channels"):
        topography.read(tmp_path / "a.txt", channel="Height")


@pytest.mark.parametrize(
    ("name", "unit", "is_height", "holds"),
    [
        ("Height", "m", True, True),
        ("ZSensor", "nm", True, True),
        ("Height (measured, retrace)", "m", True, True),
        ("Error corrected height", "m", True, True),
        ("Default", None, True, True),
        ("Phase", None, True, False),
        ("Measurement_000/Channel_000/Error", None, True, False),
        ("Lock-In Amplitude", "m", True, False),
        ("Adhesion", ("nm", "V"), True, False),
        ("UserIn0", "m", False, False),
    ],
)
def test_channels_of_heights(name, unit, is_height, holds):
    channel = SimpleNamespace(name=name, unit=unit, is_height_channel=is_height)
    assert instruments.holds_heights(channel) == holds


# Lists of points


@pytest.mark.parametrize(("step", "form"), [(1 / 3, "{:.2f}"), (0.0195, "{:.3f}")])
def test_positions_of_few_digits_are_on_their_grid(tmp_path, step, form):
    rng = np.random.default_rng(0)
    heights = rng.random((20, 30))
    heights[[3, 4, 9]] = np.nan  # rows of points that are left out
    lines = [
        f"{form.format(step * i)} {form.format(2 * step * j)} {heights[i, j]:.6f}"
        for i, j in np.argwhere(np.isfinite(heights))
    ]
    (tmp_path / "a.txt").write_text("# nx: 20 ny: 30\n" + "\n".join(lines))
    raw = readers.read(tmp_path / "a.txt")
    np.testing.assert_allclose(raw.heights, heights, atol=1e-6)
    np.testing.assert_allclose(raw.grid, [step, 2 * step], rtol=0.01)


# Line profiles


@pytest.mark.parametrize("header", ["# nx: 40\n", "# rows: 40\n", "# columns: 2\n"])
def test_headers_of_profiles_count_points_or_the_table(tmp_path, header):
    path = tmp_path / "line.txt"
    path.write_text(header + "\n".join(f"{i} {i % 7}" for i in range(40)))
    assert readers.read(path).heights.shape == (40,)
    path.write_text("# nx: 50\n" + "\n".join(f"{i} {i % 7}" for i in range(40)))
    with pytest.raises(ValueError, match="2 columns, but its header says '# nx: 50'"):
        readers.read(path)


def test_profile_of_one_column_needs_its_length(tmp_path):
    path = tmp_path / "line.txt"
    path.write_text("\n".join(map(str, range(20))))
    with pytest.raises(ValueError, match="does not tell the profile's length"):
        topography.read(path, height_unit="nm")
    p = topography.read(path, height_unit="nm", length="10 um")
    assert isinstance(p, topography.Profile)
    assert (p.dx, p.length) == pytest.approx((0.5e-6, 10e-6))
    np.testing.assert_allclose(p.heights, 1e-9 * np.arange(20), atol=1e-24)
    with pytest.raises(ValueError, match="one length for a line profile"):
        topography.read(path, height_unit="nm", length=["10 um", "20 um"])


def test_profile_with_uneven_positions_is_resampled(tmp_path):
    x = np.array([0.0, 1.0, 2.5, 3.0, 4.0, 6.0])
    path = tmp_path / "line.csv"
    path.write_text("\n".join(f"{a};{3 * a + 1}" for a in x[::-1]))
    with pytest.raises(ValueError, match="unit of position; give position_unit"):
        topography.read(path, height_unit="nm")
    p = topography.read(path, height_unit="nm", position_unit="um")
    # Linear interpolation keeps a line; six points from 0 to 6 um.
    np.testing.assert_allclose(p.heights, 1e-9 * (3 * np.linspace(0, 6, 6) + 1), rtol=1e-12)
    assert (p.dx, p.largest_gap) == pytest.approx((1.2e-6, 2e-6))
    np.testing.assert_allclose(p.detrended().heights, 0, atol=1e-22)


def test_profile_from_netcdf_with_missing_points(tmp_path):
    heights = np.arange(10.0)
    heights[[3, 9]] = np.nan
    data = xr.Dataset(
        {"z": ("s", heights, {"units": "um"})}, coords={"s": ("s", np.arange(10), {"units": "mm"})}
    )
    data.to_netcdf(tmp_path / "a.nc")
    p = topography.read(tmp_path / "a.nc", max_missing=0.2)
    assert (p.missing, p.dx) == (2, pytest.approx(1e-3))
    # A line goes on as a line inside; at the end the last height does.
    np.testing.assert_allclose(p.heights, 1e-6 * np.array([*range(9), 8]), atol=1e-20)
    cropped = topography.read(tmp_path / "a.nc", missing="crop")
    np.testing.assert_allclose(cropped.heights, 1e-6 * np.arange(4, 9), atol=1e-20)


def test_positions_must_differ(tmp_path):
    (tmp_path / "a.txt").write_text("0 1\n1 2\n1 3\n")
    with pytest.raises(ValueError, match="must all differ"):
        topography.read(tmp_path / "a.txt", height_unit="m", position_unit="m")


# The largest rectangle without missing points


def test_largest_complete_rectangle_equals_brute_force():
    rng = np.random.default_rng(2)
    for share in (0.05, 0.3, 0.7):
        known = rng.random((9, 7)) > share
        found = known[levelling.complete_rectangle(known)]
        assert found.all()
        largest = max(
            known[a:b, c:d].size
            for a in range(9)
            for b in range(a + 1, 10)
            for c in range(7)
            for d in range(c + 1, 8)
            if known[a:b, c:d].all()
        )
        assert found.size == largest


def test_longest_run_and_nothing_known():
    known = np.array([1, 1, 0, 1, 1, 1, 0, 1], dtype=bool)
    assert levelling.complete_run(known) == slice(3, 6)
    with pytest.raises(ValueError, match="here: every point is missing"):
        levelling.complete_rectangle(np.zeros((3, 3), dtype=bool), "here")
