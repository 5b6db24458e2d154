"""Files and entries of measured surfaces that are wrong: an error, or no verdict, in words."""

import re

import numpy as np
import pytest
import xarray as xr

from real_surfaces import analyse_surface
from stickiness import surface
from stickiness.spectrum import SelfAffine

N = 128
ROUGH = surface.synthesise(  # in um, on 2 mm
    SelfAffine(hurst=0.8, q0=np.pi, q1=np.pi * N / 2, h_rms=1.0), N, 2.0, seed=4
)
ENTRY = {"length": "2 mm", "height_unit": "um"}
GWYDDION = "# Width: 2 mm\n# Height: 2 mm\n# Value units: um\n"


def table(heights=ROUGH, separator="\t", comma=False, form="{:.4f}"):
    rows = "\n".join(separator.join(form.format(v) for v in row) for row in heights.T)
    return rows.replace(".", ",") if comma else rows


def changed(*places, value):
    heights = ROUGH + 0.0
    for place in places:
        heights[place] = value
    return heights


def zeros(share):
    heights = ROUGH + 5.0
    heights[np.random.default_rng(0).random(heights.shape) < share] = 0.0
    return heights


def points(keep=slice(None), shift=0.0):
    x, y = np.meshgrid(np.arange(N), np.arange(N), indexing="ij")
    list_ = np.column_stack([x.ravel() + shift * np.sin(x.ravel()), y.ravel(), ROUGH.ravel()])
    return "\n".join(" ".join(f"{v:.5f}" for v in row) for row in list_[keep])


def text(content, **entry):
    def make(folder):
        (folder / "a.txt").write_text(content, encoding="utf-8")
        return {"file": str(folder / "a.txt"), **entry}

    return make


def array(heights, **entry):
    def make(folder):
        np.save(folder / "a.npy", heights.T)
        return {"file": str(folder / "a.npy"), **ENTRY, **entry}

    return make


def binary(name, content, **entry):
    def make(folder):
        (folder / name).write_bytes(content)
        return {"file": str(folder / name), **entry}

    return make


def netcdf(**units):
    def make(folder):
        x = np.linspace(0, 2, N)
        data = xr.Dataset(
            {"z": (("x", "y"), ROUGH, {"units": units.get("z", "um")})},
            coords={name: (name, x, {"units": units.get(name, "mm")}) for name in "xy"},
        )
        data.to_netcdf(folder / "a.nc")
        return {"file": str(folder / "a.nc")}

    return make


# What is refused, by the words of the error. All name the file.
REFUSED = {
    "header states other columns": (
        text("# x-pixels: 64\n" + table(), **ENTRY),
        ["128 columns", "'# x-pixels: 64'", "decimal commas"],
    ),
    "header states other rows": (
        text("# columns: 128\n# rows: 256\n" + table(), **ENTRY),
        ["128 rows", "'# rows: 256'", "complete"],
    ),
    "header states another resolution": (
        text("# Resolution: 256 x 256\n" + table(), **ENTRY),
        ["128 columns", "256 x 256"],
    ),
    "decimal commas between commas": (
        text(table(ROUGH + 9, ",", comma=True), **ENTRY),
        ["256 columns", "alternate", "separate by tabs or semicolons"],
    ),
    "a factor in the header": (
        text("# z factor: 0.5 nm per count\n" + table(), **ENTRY),
        ["'# z factor: 0.5 nm per count'", "not read", "format: instrument"],
    ),
    "a factor of the heights": (
        text("# Scale factor for heights = 2\n" + table(), **ENTRY),
        ["'# Scale factor for heights = 2'", "not read"],
    ),
    "a vertical scale": (
        text("# Vertical scale: 0.5 um\n" + table(), **ENTRY),
        ["'# Vertical scale: 0.5 um'", "not read"],
    ),
    "a factor of nothing else": (
        text("# Scale: 0.5 nm\n" + table(), **ENTRY),
        ["'# Scale: 0.5 nm'", "not read"],
    ),
    "a unit per count": (
        text("# Detector: 0.5 nm/count\n" + table(), **ENTRY),
        ["'# Detector: 0.5 nm/count'", "not read"],
    ),
    "x y z of another number of columns": (
        text("# nx: 64 ny: 128\n" + points(), **ENTRY),
        ["128 columns", "'# nx: 64 ny: 128'"],
    ),
    "an instrument's header, read as text": (
        text("# pixel size = 1e-6 m\n" + table(), format="text"),
        ["'# pixel size = 1e-6 m'", "give format: instrument"],
    ),
    "x y z off the grid": (
        text(points(shift=0.3), **ENTRY),
        ["three columns", "no even grid along x", "export a matrix"],
    ),
    "x y z of few points": (
        text(points(slice(None, None, 40)), **ENTRY),
        ["three columns", "empty", "resample"],
    ),
    "x y z twice": (text(points() + "\n0 0 1", **ENTRY), ["two points at one place"]),
    "x y z without a unit": (text(points(), height_unit="um"), ["give position_unit"]),
    "ragged rows": (text(table() + "\n1.0\t2.0", **ENTRY), ["line 129: 2 numbers", "128"]),
    "words among numbers": (text("1 2\n3 x\n", **ENTRY), ["line 2: 'x' is not a number"]),
    "no numbers": (text("nothing\n", **ENTRY), ["no line of numbers found"]),
    "no unit": (text(table(), length="2 mm"), ["unit of height; give height_unit"]),
    "no size": (text(table(), height_unit="um"), ["size; give length or pixel_size"]),
    "another unit than the file's": (
        text(GWYDDION + table(), height_unit="nm"),
        ["height_unit = 'nm'", "the file says 'um'"],
    ),
    "a unit that is no length": (
        text(GWYDDION.replace("units: um", "units: V") + table()),
        ["height_unit", "'1 V' is in V; a length is wanted"],
    ),
    "a voltage in NetCDF": (netcdf(z="V"), ["a length is wanted, e.g. '10 um'"]),
    "degrees in NetCDF": (netcdf(x="degrees"), ["size; give length or pixel_size"]),
    "ten by ten": (array(ROUGH[:10, :10]), ["10 x 10 points", "64 points along its shorter side"]),
    "a strip": (array(np.tile(ROUGH[:, :20], (9, 1))), ["1152 x 20 points", "64 points along its"]),
    "a short profile": (array(ROUGH[0, :30]), ["of 30 points", "a profile 256"]),
    "flat": (array(np.ones((N, N))), ["all heights are 1e-06 m; nothing to analyse"]),
    "all missing": (
        array(np.full((N, N), np.nan)),
        ["16384 of 16384 points, which are all, are missing"],
    ),
    "half missing": (
        array(np.where(ROUGH > 0, np.nan, ROUGH)),
        ["are missing, more than the 10.0 % that are filled", "missing: crop"],
    ),
    "three dimensions": (
        lambda folder: array(np.ones((3, 4, 5)))(folder),
        ["needs a two-dimensional array or a profile, got shape (5, 4, 3)"],
    ),
    "not what the name says": (
        binary("a.npz", b"not binary at all", **ENTRY),
        ["not a readable numpy file"],
    ),
    "a profile with two sides": (
        array(ROUGH[0], length=["1 mm", "2 mm"]),
        ["one length for a line profile"],
    ),
}
# The same of files of instruments.
BROKEN = {
    "a torn file": (
        binary("a.sur", b"DIGITAL SURF\0\0\0\1\2"),
        ["cannot read it as sur", "is the file complete?"],
    ),
    "bytes of no format": (
        binary("a.bin", b"\0\1\2\3" * 99),
        ["neither its content nor its name", "export it as a text matrix"],
    ),
    "a format that does not exist": (
        binary("a.dat", b"\0\1\2\3" * 99, format="x3"),
        ["no format 'x3'; did you mean 'x3p'?"],
    ),
    "a torn text of an instrument": (
        text("# x-pixels = 128\n# y-pixels = 128\n# x-length = 5\n# z-unit = nm\n1 2 3 4\n5 6\n"),
        ["different numbers of values", "truncated"],
    ),
    "pixels that its header contradicts": (
        text("# File Format = ASCII\n# x-pixels = 64\n# x-length = 5\n" + table()),
        ["number of columns", "does not match"],
    ),
}
# What is read but not judged, by the words of the reasons.
WITHHELD = {
    "zeros at 5 % of the points": (
        array(zeros(0.05)),
        ["0.051 of the points have the one value 0", "give missing_value: 0"],
    ),
    "a saturated block": (
        array(changed((slice(0, 30), slice(0, 30)), value=3.7)),
        ["the one value 3.7", "missing_value: 3.7"],
    ),
    "few levels": (array(np.round(2 * ROUGH)), ["different heights", "more digits"]),
    "spikes kept": (
        array(changed((60, 70), value=1e6), spikes="keep"),
        ["the heights range over 1 m, more than the side of 0.002 m", "H = -", "spikes"],
    ),
    "spikes everywhere": (
        array(changed((slice(None, None, 5), slice(None, None, 7)), value=40.0)),
        ["H = -", "noise, spikes or lost points"],
    ),
    "2 m for 2 mm": (array(ROUGH, length="2 m"), ["the side of 2 m is longer", "(2 mm, not 2 m?)"]),
    "160 m in NetCDF": (netcdf(x="km", y="km"), ["the side of", "longer than 0.5 m"]),
    "heights in mm for um": (array(ROUGH, height_unit="mm"), ["range over", "correct height_unit"]),
    "heights in m for um": (array(ROUGH, height_unit="m"), ["more than the side of 0.002 m"]),
    "too flat to be": (array(ROUGH * 1e-6), ["the rms slope between points is", "outside 1e-07"]),
    "noise": (
        array(np.random.default_rng(0).standard_normal((N, N))),
        ["outside 0 < H <= 1", "resolution or fit_to"],
    ),
    "rows in any order": (
        array(ROUGH[:, np.random.default_rng(0).permutation(N)]),
        ["outside 0 < H <= 1"],
    ),
    "blurred": (
        array(surface.synthesise(SelfAffine(hurst=0.8, q0=3, q1=40, h_rms=1), N, 2.1, 1)),
        ["it falls as blur does", "departs from a power law"],
    ),
}


def analyse(make, folder, **entry):
    asked = {"kind": "measured", "label": "a", "source": "own", **make(folder), **entry}
    return analyse_surface.analyse(asked)


@pytest.mark.parametrize("name", REFUSED)
def test_a_wrong_file_is_refused_with_its_name_and_what_helps(tmp_path, name):
    make, words = REFUSED[name]
    check_refused(make, words, tmp_path)


@pytest.mark.parametrize("name", BROKEN)
def test_a_broken_file_has_the_words_of_its_reader(tmp_path, name):
    make, words = BROKEN[name]
    check_refused(make, words, tmp_path)


def check_refused(make, words, folder):
    with pytest.raises(ValueError, match=re.escape(words[0])) as caught:
        analyse(make, folder)
    message = str(caught.value)
    assert str(folder) in message
    assert "\n" not in message
    for word in words:
        assert word in message


@pytest.mark.parametrize("name", WITHHELD)
def test_an_implausible_measurement_is_not_judged(tmp_path, name):
    make, words = WITHHELD[name]
    reasons = analyse(make, tmp_path).not_judged
    for word in words:
        assert word in reasons
    told = analyse(make, tmp_path, plausibility="ignore")
    assert told.not_judged == ""
    assert "(plausibility: ignore)" in told.remarks


def test_a_good_file_is_judged(tmp_path):
    found = analyse(text(GWYDDION + table()), tmp_path)
    assert found.not_judged == ""
    assert (int(found.masked_spikes), int(found.dropped_points)) == (0, 0)
    assert float(found.h_rms_as_read) == float(found.h_rms_measured)


HARMLESS = """
X Resolution: 0.15625 um
Y Resolution: 5 um
Resolution: 300 dpi
Grid: 10 x 10 um
W: 10 um
h = 3
Averaged lines: 4
Lines: 500/mm
Skipped columns: 2
nx: 128 ny: 128
columns: 128, rows: 128
Zoom factor: 20
Colour scale: 1
x scale: 2
Scale bar: 5 um
16 bits per pixel
"""
COMMENTS = [f"# {line}\n" for line in HARMLESS.strip().splitlines()]


@pytest.mark.parametrize("line", COMMENTS)
def test_headers_that_state_neither_counts_nor_factors_are_passed_over(tmp_path, line):
    found = analyse(text(line + table(), **ENTRY), tmp_path)
    assert found.not_judged == ""


@pytest.mark.parametrize(
    "make",
    [
        text(table(ROUGH, ";", comma=True), **ENTRY),
        text("# nx: 128 ny: 128\n" + points(), **ENTRY),
        text("# columns: 3\n# rows: 16384\n" + points(), **ENTRY),
        text("# x-pixels: 128\n# y-pixels: 128\n" + table(), **ENTRY),
        text(points(), height_unit="um", pixel_size=f"{2 / N} mm"),
        text("# Lateral units: m\n# Value units: um\n" + points(), length="2 mm"),
        text(points(np.random.default_rng(0).permutation(N**2)[:16200]), **ENTRY),
    ],
)
def test_other_texts_of_the_same_heights_give_the_same(tmp_path, make):
    expected = float(analyse(array(ROUGH), tmp_path).h_rms_measured)
    assert float(analyse(make, tmp_path).h_rms_measured) == pytest.approx(expected, rel=1e-3)


def test_the_header_of_an_instrument_tells_size_unit_and_factor(tmp_path):
    header = "# h = 128\n# w = 128\n# pixel size = 1.5625e-5 m\n"
    header += "# height conversion factor (-> m) = 8.6e-8\n"
    found = analyse(text(header + table(ROUGH / 0.086)), tmp_path)
    expected = analyse(array(ROUGH), tmp_path)
    for name in ("h_rms_measured", "h_rms", "q0"):
        np.testing.assert_allclose(found[name], expected[name], rtol=1e-4)


def test_a_masked_spike_changes_nothing_and_is_told(tmp_path):
    clean = analyse(array(ROUGH), tmp_path)
    found = analyse(array(changed((60, 70), value=1e6)), tmp_path)
    assert found.not_judged == ""
    assert int(found.masked_spikes) == 1
    assert "spikes, which are not used: 1 (spikes: keep uses them)" in found.remarks
    for name in ("h_rms", "h_rms_measured", "hurst", "elastic_energy"):
        np.testing.assert_allclose(found[name], clean[name], rtol=2e-3)
    # One point of 1 m in 128 x 128.
    assert float(found.h_rms_as_read) == pytest.approx(1 / 128, rel=0.01)


def test_many_spikes_and_those_that_change_the_rms_height_are_told_with_both_numbers(tmp_path):
    one = analyse(array(changed((60, 70), value=1e6)), tmp_path).remarks
    assert "the rms height is 7.81 mm with all points, " in one
    assert "without those not used: if they are part of the surface, give spikes: keep" in one
    islands = [(i, j) for i in range(5, N, 25) for j in range(5, N, 25)]  # 25 of 16384
    many = analyse(array(changed(*islands, value=9.0)), tmp_path)
    assert int(many.masked_spikes) == 25
    assert "0.0015 of the points of" in many.remarks
    few = analyse(array(changed((60, 70), value=9.0)), tmp_path)
    assert int(few.masked_spikes) == 1
    assert "with all points" not in few.remarks
