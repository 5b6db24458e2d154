"""Files and entries of measured surfaces that are wrong: an error, or no verdict, in words."""

import bz2
import gzip
import io
import lzma
import re
import warnings
import zipfile

import h5py
import netCDF4
import numpy as np
import openpyxl
import pytest
import xarray as xr

import stickiness
from stickiness import Surface, surface
from stickiness.measured import topography
from stickiness.pages.rendering import make_environment
from stickiness.plausibility import PlausibilityWarning
from stickiness.spectrum import SelfAffine
from stickiness.verdicts.rough_surface import NEEDED

pytestmark = pytest.mark.usefixtures("coarse_simulation")

N = 128
ROUGH = surface.synthesise(  # in um, on 2 mm
    SelfAffine(hurst=0.8, q0=np.pi, q1=np.pi * N / 2, h_rms=1.0), N, 2.0, seed=4
)
ENTRY = {"length": "2 mm", "height_unit": "um"}
GWYDDION = "# Width: 2 mm\n# Height: 2 mm\n# Value units: um\n"


def table(heights=ROUGH, separator="\t", comma=False):
    rows = "\n".join(separator.join(f"{v:.4f}" for v in row) for row in heights.T)
    return rows.replace(".", ",") if comma else rows


def points(keep=slice(None), shift=0.0):
    x, y = np.meshgrid(np.arange(N), np.arange(N), indexing="ij")
    list_ = np.column_stack([x.ravel() + shift * np.sin(x.ravel()), y.ravel(), ROUGH.ravel()])
    return "\n".join(" ".join(f"{v:.5f}" for v in row) for row in list_[keep])


def changed(*places, value):
    heights = ROUGH + 0.0
    for place in places:
        heights[place] = value
    return heights


def zeros(share):
    chosen = np.random.default_rng(0).random(ROUGH.shape) < share
    return np.where(chosen, 0.0, ROUGH + 5.0)


def analyse(folder, content, name="a.txt", **entry):
    """Analyse a file with this content: text, bytes, an array or a data set."""
    if isinstance(content, np.ndarray):
        name, entry = "a.npy", ENTRY | entry
        np.save(folder / name, content.T)
    elif isinstance(content, xr.Dataset):
        name = "a.nc"
        content.to_netcdf(folder / name)
    else:
        raw = content if isinstance(content, bytes) else content.encode()
        (folder / name).write_bytes(raw)
    return Surface.read(folder / name, **entry).data


def netcdf(z="um", x="mm", y="mm"):
    places = np.linspace(0, 2, N)
    coordinates = {"x": ("x", places, {"units": x}), "y": ("y", places, {"units": y})}
    return xr.Dataset({"z": (("x", "y"), ROUGH, {"units": z})}, coordinates)


def archive(name, content="1 2 3"):
    """A zip archive with one file."""
    raw = io.BytesIO()
    with zipfile.ZipFile(raw, "w", zipfile.ZIP_DEFLATED) as zipped:
        zipped.writestr(name, content)
    return raw.getvalue()


def x3p(drop=None, axis="I"):
    """An X3P file of the rough heights; without a member, or with another kind of axis."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of what it imports
        from SurfaceTopography import Topography
    raw = io.BytesIO()
    Topography(ROUGH, (2.0, 2.0), unit="mm").scale(1e-3).to_x3p(raw)
    changed = io.BytesIO()
    with zipfile.ZipFile(raw) as old, zipfile.ZipFile(changed, "w") as new:
        for member in old.namelist():
            content = old.read(member)
            if member == "main.xml":
                content = content.replace(b"<AxisType>I", f"<AxisType>{axis}".encode())
            if member != drop:
                new.writestr(member, content)
    return changed.getvalue()


def mitutoyo():
    """A workbook of a Mitutoyo SurfTest: positions in mm and heights in um of a profile."""
    book = openpyxl.Workbook()
    data = book.active
    data.title = "DATA"
    data["A1"] = "Ra 0.8 um"
    for row, height in enumerate(ROUGH[:4].ravel(), start=1):
        data.cell(row, 5, row * 2e-3)
        data.cell(row, 6, float(height))
    certificate = book.create_sheet("Certificate")
    certificate["E2"] = "24 Nov 2025"
    certificate["E48"] = "0.8 mm"
    raw = io.BytesIO()
    book.save(raw)
    return raw.getvalue()


def promise(folder=None):
    """A numpy file whose header promises more than there is; in an archive of a folder."""
    raw = io.BytesIO()
    header = {"descr": "<f8", "fortran_order": False, "shape": (10**6, 10**7)}
    np.lib.format.write_array_header_1_0(raw, header)
    content = raw.getvalue() + bytes(800)
    return content if folder is None else archive(folder, content)


def endless():
    """A workbook that unpacks to more than its reader can take."""
    return archive("xl/workbook.xml", bytes(70_000_000))


def unfilled():
    """A NetCDF file of many points, none of which is written."""
    file = netCDF4.Dataset("memory.nc", "w", memory=1)
    for axis, count in (("x", 10**6), ("y", 10**7)):
        file.createDimension(axis, count)
    file.createVariable("z", "f8", ("x", "y"), chunksizes=(1000, 1000), zlib=True).units = "um"
    return bytes(file.close())


def hdf5(**arrays):
    """An HDF5 file, which SurfaceTopography reads as an instrument's."""
    raw = io.BytesIO()
    with h5py.File(raw, "w") as file:
        for name, values in arrays.items():
            file[name] = values
    return raw.getvalue()


# What is refused: content of the file, keys of the entry, words of the error.
HEADER = "# x-pixels = 128\n# x-length = 5\n# z-unit = nm\n"
HDF5 = hdf5(height=ROUGH)
TORN = "incomplete or damaged"
NO_UNITS = "unit of position or the unit of height; give position_unit and height_unit"
LINE = "\n".join(f"{i} {z}" for i, z in enumerate(ROUGH[0]))
HALF = np.where(ROUGH > 0, np.nan, ROUGH)
REFUSED = {
    "an array shorter than its header": (promise(), {"name": "a.npy", **ENTRY}, "shorter than its"),
    "an archive of such an array": (
        promise("z.npy"),
        {"name": "a.npz", **ENTRY},
        "more memory than",
    ),
    "a workbook that unpacks to more": (
        endless(),
        {"name": "a.xlsx"},
        "unpacks to 70 MB, more than",
    ),
    "too many points": (
        unfilled(),
        {"name": "a.nc", **ENTRY},
        "1000000 x 10000000 points are more",
    ),
    "other rows": ("# rows: 256\n" + table(), ENTRY, "128 rows"),
    "x y z of other columns": ("# nx: 64 ny: 128\n" + points(), ENTRY, "128 columns"),
    "decimal commas": (table(ROUGH + 9, ",", comma=True), ENTRY, "256 columns"),
    **{
        line: (f"# {line}\n" + table(), ENTRY, f"'# {line}'")
        for line in ("z factor: 0.5 nm per count", "Vertical scale: 0.5 um")
    },
    "a header as text": ("# pixel size = 1e-6 m\n" + table(), {"format": "text"}, "instrument"),
    "x y z off the grid": (points(shift=0.3), ENTRY, "three columns"),
    "few x y z": (points(slice(None, None, 40)), ENTRY, "three columns"),
    "x y z twice": (points() + "\n0 0 1", ENTRY, "16385 points at 16384 places, and several"),
    "x y z without a unit": (points(), {"height_unit": "um"}, "give position_unit"),
    "numbered rows": (
        table(np.vstack([np.arange(N), ROUGH])),
        ENTRY,
        "the first column rises in even steps of 1",
    ),
    "ragged rows": (table() + "\n1.0\t2.0", ENTRY, "line 129: 2 numbers"),
    "words among numbers": ("1 2\n3 x\n", ENTRY, "line 2:"),
    "no numbers": ("nothing\n", ENTRY, "no line of numbers found"),
    "no unit": (table(), {"length": "2 mm"}, "tell the unit of height; give height_unit"),
    "no size": (table(), {"height_unit": "um"}, "size; give length (or pixel_size)"),
    "neither": (table(), {}, "size or the unit of height; give length"),
    "a profile without units": (LINE, {}, NO_UNITS),
    "another unit": (GWYDDION + table(), {"height_unit": "nm"}, "'nm'"),
    "no length": (GWYDDION.replace("units: um", "units: V") + table(), {}, "'1 V' is in V"),
    "a voltage in NetCDF": (netcdf(z="V"), {}, "a length is wanted, e.g. '10 um'"),
    "degrees in NetCDF": (netcdf(x="degrees"), {}, "size; give length (or pixel_size)"),
    "three by three": (ROUGH[:3, :3], {}, "3 x 3 points"),
    "flat": (np.ones((N, N)), {}, "all heights are 1e-06 m; nothing to analyse"),
    "all missing": (np.full((N, N), np.nan), {}, "16384 points, which are all, are missing"),
    "missing": (HALF, {"missing": "refuse"}, "more than the 0.0 % that are filled"),
    "no npz": (b"not binary at all", {"name": "a.npz", **ENTRY}, "not a readable numpy file"),
    "torn": (b"DIGITAL SURF\0\0\0\1\2", {"name": "a.sur"}, TORN),
    "half a file": (HDF5[: len(HDF5) // 2], {"name": "a.dat"}, TORN),
    "gzip": (gzip.compress(b"1 2"), ENTRY, "compressed (gzip): unpack it"),
    "bzip2": (bz2.compress(b"1 2"), {"name": "a.npy"}, "compressed (bzip2): unpack it"),
    "xz": (lzma.compress(b"1 2"), ENTRY, "compressed (xz): unpack it"),
    "7z": (b"7z\xbc\xaf\x27\x1c\0", ENTRY, "compressed (7z): unpack it"),
    "compress": (b"\x1f\x9d\x90", ENTRY, "compressed (compress): unpack it"),
    "a zip": (archive("a.txt"), ENTRY, "is a zip archive: unpack it"),
    "an X3P with absolute axes": (x3p(axis="A"), {"name": "a.x3p"}, "export the heights"),
    "an X3P without data": (x3p(drop="bindata/data.bin"), {"name": "a.x3p"}, "X3P file cannot be"),
    "half a zip": (archive("a.txt")[:40], ENTRY, "its end is missing: copy it again"),
    "an Excel sheet as text": (archive("xl/workbook.xml"), {"name": "a.csv"}, "as text (CSV)"),
    "old Excel": (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", ENTRY, "Excel workbook: save"),
    "an empty file": ("", ENTRY, "the file is empty: copy it again"),
    "a torn text": (HEADER + "1 2 3 4\n5 6\n", {"format": "asc"}, "truncated"),
}
# What is read but not judged: heights, keys of the entry, words of the reasons.
BLURRED = surface.synthesise(SelfAffine(hurst=0.8, q0=3, q1=20, h_rms=1), N, 2.1, 1)
NOISE = np.random.default_rng(0).standard_normal((N, N))
WAVE = np.sin(np.arange(N) * np.pi / 8)[:, None] * np.ones(N)
SPIKES = changed((slice(None, None, 5), slice(None, None, 7)), value=40.0)
WITHHELD = {
    "zeros": (zeros(0.05), {}, "0.051 of the points"),
    "a saturated block": (changed((slice(30), slice(30)), value=3.7), {}, "missing_value: 3.7"),
    "few levels": (np.round(2 * ROUGH), {}, "different heights"),
    "spikes kept": (changed((60, 70), value=1e6), {"spikes": "keep"}, "range over 1 m"),
    "spikes everywhere": (SPIKES, {}, "H = -"),
    "2 m for 2 mm": (ROUGH, {"length": "2 m"}, "the side of 2 m is longer"),
    "160 m in NetCDF": (netcdf(x="km", y="km"), {}, "the side of"),
    "heights in mm": (ROUGH, {"height_unit": "mm"}, "range over"),
    "too flat to be": (ROUGH * 1e-6, {}, "the rms slope between points is"),
    "ten by ten": (ROUGH[:10, :10], {}, "10 x 10 points"),
    "a short profile": (ROUGH[0, :30], {}, "of 30 points"),
    "half missing": (HALF, {}, "more than 10 %"),
    "a profile of noise": (NOISE.ravel(), {}, "goes as q^"),
    "a profile that grows": (np.diff(NOISE.ravel()), {}, "no fit to the spectrum"),
    "one wave": (WAVE, {"window": "none"}, "a period of 0.00025 m"),
    "a grating": (np.sign(WAVE + 1e-3) + 0.1 * ROUGH, {}, "a period of 0.00025 m"),
    "heights in m as um": (ROUGH * 1e-5, {}, "m, below 5e-11 m: atoms are larger"),
    "a picture scaled to 1": ((ROUGH - ROUGH.min()) / np.ptp(ROUGH), {}, "exactly 0 to 1, as"),
    "grey levels": (
        np.rint(30 * ROUGH + 128),
        {"length": "0.3 mm"},
        "whole numbers with an rms slope of",
    ),
    "noise extended": (NOISE, {"extend_to": "1 nm"}, "outside 0 < H <= 1"),
    "noise": (NOISE, {}, "outside 0 < H <= 1"),
    "blurred": (BLURRED, {}, "it falls as blur does"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_a_wrong_file_is_refused_with_its_name_and_what_helps(tmp_path, name):
    content, entry, words = REFUSED[name]
    with pytest.raises(ValueError, match=str(tmp_path)) as caught:
        analyse(tmp_path, content, **entry)
    message = str(caught.value)
    assert "\n" not in message
    assert words in message


@pytest.mark.processors
@pytest.mark.parametrize("name", WITHHELD)
def test_an_implausible_measurement_is_not_judged(tmp_path, name):
    content, entry, words = WITHHELD[name]
    found = analyse(tmp_path, content, **entry)
    assert words in found.not_judged
    # What the stages behind need to make its page.
    assert all(np.isfinite(found[variable]).all() for variable in NEEDED)
    assert Surface(found).a_v
    told = analyse(tmp_path, content, **entry, plausibility="ignore")
    assert told.not_judged == ""
    assert "(plausibility: ignore)" in told.remarks


def test_tiles_that_repeat_are_used_once(tmp_path):
    single = analyse(tmp_path, ROUGH)
    tiled = analyse(tmp_path, np.tile(ROUGH, (2, 2)), length="4 mm")
    for name in ("h_rms", "q0", "elastic_energy", "h_rms_measured"):
        np.testing.assert_array_equal(tiled[name], single[name])
    assert "2 x 2 copies or mirror images of one tile of 128 x 128 points" in tiled.remarks
    assert "of one tile" in " ".join(Surface(tiled).remarks)
    mirrored = np.block([[ROUGH, ROUGH[:, ::-1]], [ROUGH[::-1], ROUGH[::-1, ::-1]]])
    mirrored = analyse(tmp_path, mirrored, length="4 mm")
    enlarged = analyse(tmp_path, np.kron(ROUGH, np.ones((3, 3))))
    for same in (mirrored, enlarged):
        np.testing.assert_array_equal(same.elastic_energy, single.elastic_energy)
    assert "repeated 3 x 3 times" in enlarged.remarks
    assert analyse(tmp_path, np.tile(ROUGH, (1, 3)), length=["2 mm", "6 mm"]).remarks != ""
    assert single.remarks == ""


@pytest.mark.parametrize("axis", ["map", "profile"])
def test_the_form_of_a_lens_is_subtracted_and_told(tmp_path, axis):
    points = 4 * N if axis == "profile" else N
    x = (2 * np.arange(points) + 1) / points - 1  # over half a side of 1 mm
    if axis == "profile":
        content = ROUGH[:4].ravel() + 250.0 * x**2
    else:
        content = ROUGH + 250.0 * x[:, None] ** 2 + 125.0 * x**2  # um: radii of 2 mm and 4 mm
    found = analyse(tmp_path, content)
    same = analyse(tmp_path, content, detrend="quadratic")
    for name in ("h_rms", "elastic_energy"):
        np.testing.assert_array_equal(found[name], same[name])
    radius = float(re.search(r"radius (\S+) m", found.remarks)[1])
    assert radius == pytest.approx(0.002, rel=0.02)
    assert "subtracted" in remarks(found)
    kept = analyse(tmp_path, content, detrend="plane")
    assert float(kept.h_rms_measured) > 5 * float(found.h_rms_measured)
    assert (kept.remarks, same.remarks) == ("", "")


def test_pixels_that_are_not_square_are_told_unless_the_file_has_them(tmp_path):
    sides = {"length": ["2 mm", "1 mm"], "height_unit": "um"}
    (told,) = Surface(analyse(tmp_path, ROUGH, **sides)).remarks
    assert "sides of 0.002 x 0.001 m mean pixels of 1.56e-05 x 7.81e-06 m" in told
    header = GWYDDION.replace("Height: 2 mm", "Height: 1 mm")
    assert Surface(analyse(tmp_path, header + table(), **sides)).remarks == ()
    with pytest.warns(PlausibilityWarning, match=r"pixels of 1.56e-05 x 7.81e-06 m"):
        Surface.from_heights(1e-6 * ROUGH, (2e-3, 1e-3))


def test_workbooks_of_mitutoyo_and_x3p_are_read(tmp_path):
    profile = topography.from_array(1e-6 * ROUGH[:4].ravel(), 2e-6)
    (tmp_path / "a.xlsx").write_bytes(mitutoyo())
    for options in ({}, {"format": "mitutoyo"}):
        found = topography.read(tmp_path / "a.xlsx", **options)
        np.testing.assert_allclose(found.heights, profile.heights, rtol=1e-9, atol=1e-15)
        assert found.dx == pytest.approx(2e-6)
    (tmp_path / "a.x3p").write_bytes(x3p())
    found = topography.read(tmp_path / "a.x3p")
    np.testing.assert_allclose(found.heights, 1e-6 * ROUGH, atol=1e-15)
    assert found.steps == pytest.approx((2e-3 / N,) * 2)


def test_headers_of_gwyddion_in_german_are_read(tmp_path):
    header = "# Kanal: Höhe\n# Breite: 2,5 mm\n# Höhe: 2,5 mm\n# Werteinheiten: µm\n"
    (tmp_path / "a.txt").write_text(header + table(comma=True), encoding="utf-8")
    found = topography.read(tmp_path / "a.txt")
    assert found.size == pytest.approx((2.5e-3, 2.5e-3))
    np.testing.assert_allclose(found.heights, 1e-6 * ROUGH, atol=1e-10)


HARMLESS = ("X Resolution: 0.15625 um", "Lines: 500/mm", "columns: 128, rows: 128", "x scale: 2")


@pytest.mark.parametrize("line", HARMLESS)
def test_headers_that_state_neither_counts_nor_factors_are_passed_over(tmp_path, line):
    assert analyse(tmp_path, f"# {line}\n" + table(), **ENTRY).not_judged == ""


@pytest.mark.parametrize(
    ("content", "entry"),
    [
        ("# nx: 128 ny: 128\n" + points(), ENTRY),
        ("# columns: 3\n# rows: 16384\n" + points(), ENTRY),
        (points(), {"height_unit": "um", "pixel_size": f"{2 / N} mm"}),
        ("# Lateral units: m\n# Value units: um\n" + points(), {"length": "2 mm"}),
        (points(np.random.default_rng(0).permutation(N**2)[:16200]), ENTRY),
        (
            "# h = 128\n# w = 128\n# pixel size = 1.5625e-5 m\n"
            "# height conversion factor (-> m) = 8.6e-8\n" + table(ROUGH / 0.086),
            {},
        ),
    ],
)
def test_texts_of_the_same_heights_give_the_same_and_are_judged(tmp_path, content, entry):
    found, expected = analyse(tmp_path, content, **entry), analyse(tmp_path, ROUGH)
    for name in ("h_rms_measured", "h_rms", "q0"):
        np.testing.assert_allclose(found[name], expected[name], rtol=1e-3)
    assert found.not_judged == ""
    assert (int(found.masked_spikes), int(found.dropped_points)) == (0, 0)


def test_a_masked_spike_changes_nothing_and_is_told(tmp_path):
    clean = analyse(tmp_path, ROUGH)
    found = analyse(tmp_path, changed((60, 70), value=1e6))
    assert found.not_judged == ""
    assert int(found.masked_spikes) == 1
    for name in ("h_rms", "h_rms_measured", "hurst", "elastic_energy"):
        np.testing.assert_allclose(found[name], clean[name], rtol=2e-3)
    # One point of 1 m in 128 x 128.
    assert float(found.h_rms_as_read) == pytest.approx(1 / 128, rel=0.01)
    assert "7.81 mm" in remarks(found)
    assert "spikes: keep" in remarks(found)


@pytest.mark.parametrize(
    ("content", "name", "key"),
    [
        (hdf5(height=ROUGH, other=NOISE, phase=NOISE), "a.dat", "channel"),
        (xr.Dataset({"height": (("x", "y"), ROUGH), "other": ("x", ROUGH[0])}), "a.nc", "variable"),
    ],
)
def test_a_choice_among_data_sets_is_told_unless_it_is_made(tmp_path, content, name, key):
    found = analyse(tmp_path, content, name, **ENTRY)
    assert found.choices == f"{tmp_path / name}: height | other"
    assert analyse(tmp_path, content, name, **ENTRY, **{key: "height"}).choices == ""


def remarks(dataset):
    """What the page remarks on a measured surface."""
    macros = make_environment("report").get_template("macros.html.j2").module
    return str(macros.remarks(dataset)).replace("\u00a0", " ")


def test_remarks_name_what_is_wrong(tmp_path):
    islands = [(i, j) for i in range(5, N, 25) for j in range(5, N, 25)]  # 25 of 16384
    many = analyse(tmp_path, changed(*islands, value=9.0))
    assert int(many.masked_spikes) == 25
    assert "25" in remarks(many)
    noise = analyse(tmp_path, NOISE).assign(anisotropy=0.8)
    # On the exponent, the direction and the roll-off, beside those on the ends.
    assert remarks(noise).count("<li>") > remarks(analyse(tmp_path, ROUGH)).count("<li>") == 2


#: What is wrong with numbers or units, and how the first reason begins.
CAUSES = {
    "zeros for missing points": (zeros(0.015), "0.01. of the points have the one value 0"),
    "zeros that whiten the spectrum": (zeros(0.4), "0.[34]. of the points have the one value 0"),
    "heights in m": (1e-6 * ROUGH, "the rms height is .*e-13 m, below 5e-11 m"),
    "heights in nm": (1e3 * ROUGH, "the heights range over|the rms slope"),
}


@pytest.mark.parametrize(("heights", "words"), CAUSES.values(), ids=CAUSES)
def test_the_cause_is_the_first_reason_and_the_first_warning(tmp_path, heights, words):
    np.save(tmp_path / "a.npy", heights.T)
    verdict = stickiness.verdict(
        Surface.read(tmp_path / "a.npy", **ENTRY),
        youngs_modulus=1e6,
        work_of_adhesion=0.05,
        range=3e-10,
    )
    assert re.match(f".*a.npy: ({words})", verdict.not_judged[0])
    assert verdict.doubts[0] == verdict.not_judged[0]
    assert not any("give heights in m" in doubt for doubt in verdict.doubts)
