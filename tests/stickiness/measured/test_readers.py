"""One map in the files of many programs: read as from .npy, or refused in one line that helps."""

import io
import struct
import warnings
from pathlib import Path
from types import SimpleNamespace

import h5py
import numpy as np
import pytest
import scipy.io
import tifffile
import xarray as xr
from PIL import Image, TiffImagePlugin

from stickiness import Surface
from stickiness.measured import topography
from stickiness.measured.readers import grids, instruments

pytestmark = pytest.mark.processors

NX, NY, STEP = 24, 16, 2.0  # um
MAP = np.random.default_rng(4).normal(size=(NY, NX)).round(5)  # um, rows along y
X, Y = STEP * np.arange(NX), STEP * np.arange(NY)
MESH = np.meshgrid(X, Y)
POINTS = np.stack([*MESH, MAP], axis=-1).reshape(-1, 3)
JITTER = np.random.default_rng(0).normal(0, 0.03, (NX * NY, 2))

UNIT = {"height_unit": "um"}
PLACED = UNIT | {"position_unit": "um"}
SIZED = UNIT | {"length": "48 um"}
COUNTED = SIZED | {"height_unit": "1e-5 um"}


def lines(table, separator=" ", form="{:.5f}"):
    return "\n".join(separator.join(form.format(v) for v in row) for row in table) + "\n"


def npy(array):
    file = io.BytesIO()
    np.save(file, array)
    return file.getvalue()


def beside(*columns):
    """The points with more columns."""
    return np.column_stack([POINTS, *columns])


def surface_topography():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of what it imports
        import SurfaceTopography
    return SurfaceTopography


def contact_engineering(path, unit="um", periodic=False):
    surface_topography().Topography(
        MAP.T, (NX * STEP, NY * STEP), unit=unit, periodic=periodic
    ).to_netcdf(str(path))


def line_of_contact_engineering(path):
    surface_topography().NonuniformLineScan(X, MAP[0], unit="um").to_netcdf(str(path))


def matlab_7_3(path, **arrays):
    with h5py.File(path, "w", userblock_size=512) as file:
        for name, array in arrays.items():
            file.create_dataset(name, data=np.transpose(np.atleast_2d(array))).attrs[
                "MATLAB_class"
            ] = np.bytes_("double")
    head = b"MATLAB 7.3 MAT-file".ljust(124) + struct.pack("<H", 0x200) + b"IM"
    with path.open("r+b") as file:
        file.write(head)


def hdf5(path, units=None, **arrays):
    with h5py.File(path, "w") as file:
        for name, array in arrays.items():
            file[name] = array
            if units:
                file[name].attrs["units"] = units


def tiff(path, description=None, values=MAP):
    tags = TiffImagePlugin.ImageFileDirectory_v2()
    if description:
        tags[270], tags[282], tags[283] = description, 1 / STEP, 1 / STEP
    values = values.astype("f4") if values is MAP else values
    Image.fromarray(values).save(path, tiffinfo=tags)


def pages(path, values=MAP):
    tifffile.imwrite(path, values)


def netcdf(path, values, kind="NETCDF4", keep=None):
    """A NetCDF file of the last axes y and x, of which so many bytes are kept."""
    dims = ("t", "y", "x")[3 - values.ndim :]
    xr.Dataset({"z": (dims, values)}).to_netcdf(path, format=kind)
    path.write_bytes(path.read_bytes()[:keep])


def nothing_but_size(path):
    """A file of more bytes than are read, which takes no room on most disks."""
    with path.open("wb") as file:
        file.truncate(9 * 2**27 + 2**20)


def component(name, kind, content):
    return name.encode() + b"\0" + kind.encode() + content


def packed(name, *components):
    content = b"".join(components)
    return name.encode() + b"\0" + struct.pack("<I", len(content)) + content


def gwyddion(path, unit="", scale=1.0, titles=("Z",)):
    """A .gwy file of equal channels, lengths in m and heights without a unit."""
    heights = (scale * MAP).astype("<f8")
    field = packed(
        "GwyDataField",
        component("xres", "i", struct.pack("<i", NX)),
        component("yres", "i", struct.pack("<i", NY)),
        component("xreal", "d", struct.pack("<d", NX * STEP * 1e-6)),
        component("yreal", "d", struct.pack("<d", NY * STEP * 1e-6)),
        component("si_unit_xy", "o", packed("GwySIUnit", component("unitstr", "s", b"m\0"))),
        component(
            "si_unit_z", "o", packed("GwySIUnit", component("unitstr", "s", unit.encode() + b"\0"))
        ),
        component("data", "D", struct.pack("<I", MAP.size) + heights.tobytes()),
    )
    channels = []
    for number, title in enumerate(titles):
        channels.append(component(f"/{number}/data/title", "s", title.encode() + b"\0"))
        channels.append(component(f"/{number}/data", "o", field))
    path.write_bytes(b"GWYP" + packed("GwyContainer", *channels))


def simple_field(path, fields=""):
    head = f"Gwyddion Simple Field 1.0\nXRes = {NX}\nYRes = {NY}\n{fields}".encode()
    head += b"\0" * (4 - len(head) % 4)
    path.write_bytes(head + MAP.astype("<f4").tobytes())


ENDS = (0, X[-1], 0, Y[-1], MAP.min(), MAP.max())
ZYGO = (
    'Zygo {} Data File - Format {}\n{} 8 1 0 "date"\n0 0 0 0 0 0\n0 0 24 16\n"a"\n"b"\n"c"\n'
    '0 0.5 6.328e-07 0 1 0 2e-06 0\n24 16 0 0 0 0 "lens"\n0 0 0 0 0 0 0 0 0 0\n'
    '1 0 0 0 0 0 0 0 0\n0 ""\n1 0\n""\n#\n'
)
WAVES = np.rint(MAP * 1e-6 / (0.5 * 6.328e-7 / 32768)).astype(int)
KEYENCE = (
    '"Model","VK-X3000 Series"\n"XY Calibration","2000","nm"\n"Horizontal","24"\n'
    '"Vertical","16"\n"Unit","um"\n\n"Height"\n'
)
NANOSCOPE = (
    "\\Samps/line: 24\n\\Number of lines: 16\n\\Scan Size: 48 32 ~m\n"
    "\\@2:Z scale: V [Sens. Zsens] (0.0067 V/LSB) 5 V\nHeight(um)\n"
)
ESRI = "ncols 24\nnrows 16\nxllcorner 0\nyllcorner 0\ncellsize 2\nNODATA_value -9999\n"
SDF = (
    "ManufacID = a\nCreateDate = 010120261200\nModDate = 010120261200\nNumPoints = 24\n"
    "NumProfiles = 16\nXscale = 2e-6\nYscale = 2e-6\nZscale = 1e-6\nZresolution = -1\n"
    "Compression = 0\nDataType = 7\nCheckType = 0\n*\n" + lines(MAP) + "*\n"
)
GSF = "XReal = 48e-6\nYReal = 32e-6\nXYUnits = m\n"
STRUCTURED = np.rec.fromarrays(POINTS.T, names="x,y,z")

# What is read as the map in .npy is: name of the file; a text, an array or what writes it; options.
READ = {
    "contact.engineering": ("a.nc", contact_engineering, {}),
    "contact.engineering, no unit": ("a.nc", lambda p: contact_engineering(p, None), PLACED),
    "MATLAB": ("a.mat", lambda p: scipy.io.savemat(p, {"Z": MAP}), SIZED),
    "MATLAB, positions": (
        "a.mat",
        lambda p: scipy.io.savemat(p, {"X": X, "Y": Y, "Z": MAP}),
        PLACED,
    ),
    "MATLAB, meshgrid": (
        "a.mat",
        lambda p: scipy.io.savemat(p, {"X": MESH[0], "Y": MESH[1], "h": MAP}),
        PLACED,
    ),
    "MATLAB 7.3": ("a.mat", lambda p: matlab_7_3(p, X=MESH[0], Y=MESH[1], Z=MAP), PLACED),
    "HDF5": ("a.h5", lambda p: hdf5(p, data=MAP), SIZED),
    "HDF5 with units": ("a.h5", lambda p: hdf5(p, "um", x=X, y=Y, z=MAP), {}),
    "HDF5 with the size of a pixel": ("a.h5", lambda p: hdf5(p, "um", dx=STEP, z=MAP), {}),
    "npz, the first axis along x": (
        "a.npz",
        lambda p: np.savez(p, x=MESH[0].T, y=MESH[1].T, z=MAP.T),
        PLACED,
    ),
    "npz of points": (
        "a.npz",
        lambda p: np.savez(p, x=POINTS[:, 0], y=POINTS[:, 1], z=POINTS[:, 2]),
        PLACED,
    ),
    "leading axis": ("a.npy", MAP[None], SIZED),
    "structured array": ("a.npy", STRUCTURED, PLACED),
    "float TIFF": ("a.tif", tiff, SIZED),
    "TIFF of ImageJ": ("a.tif", lambda p: tiff(p, "ImageJ=1.54\nunit=micron\n"), UNIT),
    "gwy without a unit": ("a.gwy", gwyddion, UNIT),
    "simple field": ("a.gsf", lambda p: simple_field(p, GSF), UNIT),
    "simple field without a size": ("a.gsf", simple_field, SIZED),
    "Surfer": (
        "a.grd",
        "DSAA\n24 16\n{} {}\n{} {}\n{} {}\n".format(*ENDS) + lines(MAP),
        PLACED,
    ),
    "Surfer, binary": (
        "a.grd",
        lambda p: p.write_bytes(
            b"DSBB" + struct.pack("<2h6d", NX, NY, *ENDS) + MAP.astype("<f4").tobytes()
        ),
        PLACED,
    ),
    "ESRI": ("a.asc", ESRI + lines(MAP), PLACED),
    "Zygo, points": ("a.xyz", ZYGO.format("XYZ", 1, 1) + lines(POINTS / (2, 2, 1)) + "#\n", {}),
    "Zygo, points of others": ("a.xyz", ZYGO.format("XYZ", 1, 0) + lines(POINTS / (2, 2, 1)), UNIT),
    "Zygo, phase": (
        "a.asc",
        ZYGO.format("ASCII", 2, 1) + "#\n" + lines(WAVES, form="{}") + "#\n",
        {},
    ),
    "Keyence": ("a.csv", KEYENCE + lines(MAP, ",", '"{:.5f}"'), {}),
    "NanoScope": ("a.txt", NANOSCOPE + lines(MAP.reshape(-1, 1)), {}),
    "named columns": (
        "a.csv",
        "X (mm),Y (mm),Z (nm)\n" + lines(POINTS * (1e-3, 1e-3, 1e3), ",", "{:.8f}"),
        {},
    ),
    "units below names": (
        "a.txt",
        "z\tx\ty\n[um]\t[um]\t[um]\n" + lines(POINTS[:, [2, 0, 1]], "\t"),
        {},
    ),
    "quoted": ("a.csv", '"Height","um"\n' + lines(MAP, ",", '"{:.5f}"'), {"length": "48 um"}),
    "quoted decimal commas": (
        "a.csv",
        lines(MAP, ",", '"{:.5f}"').replace(".", ","),
        SIZED,
    ),
    "points and colours": ("a.xyz", lines(beside(*np.full((3, MAP.size), 200))), PLACED),
    "points with an index": (
        "a.xyz",
        "# i x y z\n" + lines(np.column_stack([np.arange(MAP.size), POINTS])),
        PLACED,
    ),
    "a count before points": ("a.xyz", f"{MAP.size}\n" + lines(POINTS), PLACED),
    "counts before a matrix": ("a.txt", f"{NX} {NY}\n" + lines(MAP), SIZED),
    "lines of a scan": (
        "a.xyz",
        "\n".join(lines(block) for block in POINTS.reshape(NY, NX, 3)),
        PLACED,
    ),
    "one column, counts": ("a.txt", "# nx: 24\n# ny: 16\n" + lines(MAP.reshape(-1, 1)), SIZED),
    "one column, sides": (
        "a.txt",
        "# Width: 48 um\n# Height: 32 um\n# Value units: um\n" + lines(MAP.reshape(-1, 1)),
        {},
    ),
    "numpy by another name": ("a.txt", npy(MAP), SIZED),
    "columns y x z": (
        "a.csv",
        "Y (um),X (um),Z (um)\n" + lines(POINTS[:, [1, 0, 2]], ","),
        {},
    ),
    "rows and columns": (
        "a.csv",
        "row,col,height_um\n" + lines(POINTS[:, [1, 0, 2]], ","),
        PLACED,
    ),
    "NanoScope, not square": (
        "a.txt",
        "\\Scan Size: 48 um\n\\Aspect ratio: 1.5:1\n\nHeight(um)\n" + lines(MAP),
        UNIT,
    ),
    "several fields in a line": (
        "a.txt",
        "Width: 48 um Height: 32 um, 24 x 16 pixels\n" + lines(MAP),
        UNIT,
    ),
    "several fields in a German line": (
        "a.txt",
        "Breite: 48 um, Höhe: 32 um\n" + lines(MAP).replace(".", ","),
        UNIT,
    ),
    "one column below its columns and a resolution": (
        "a.txt",
        f"# columns: {NX}\n# {NX} x {NY} pixels\n" + lines(MAP.reshape(-1, 1)),
        SIZED,
    ),
    "one column below a resolution": (
        "a.txt",
        "24 x 16 pixels\n" + lines(MAP.reshape(-1, 1)),
        SIZED,
    ),
    "one column and two sides": (
        "a.txt",
        lines(MAP.reshape(-1, 1)),
        UNIT | {"length": ["48 um", "32 um"]},
    ),
    "commas for thousands": ("a.txt", lines(1e5 * MAP, "\t", "{:,.1f}"), COUNTED),
    "points for thousands": (
        "a.txt",
        lines(1e5 * MAP, ";", "{:,.1f}").translate(str.maketrans(",.", ".,")),
        COUNTED,
    ),
    "commas for millions": (
        "a.csv",
        lines(1e8 * MAP, ",", '"{:,.0f}"'),
        SIZED | {"height_unit": "1e-8 um"},
    ),
    "apostrophes": ("a.txt", lines(1e5 * MAP, form="{:,.1f}").replace(",", "'"), COUNTED),
    "signs of print": ("a.txt", lines(MAP).replace("-", "\u2212"), SIZED),
    "powers of Fortran": ("a.txt", lines(MAP, form="{:.6E}").replace("E", "D"), SIZED),
    "surface data": ("a.txt", "aISO-1.0\n" + SDF, {}),
    "surface data before the standard": ("a.sdf", "aBCR-1.0\n" + SDF, {}),
    "gwy in a unit": ("a.gwy", lambda p: gwyddion(p, "Angstrom", 1e4), {}),
    "npz with the size of a pixel": ("a.npz", lambda p: np.savez(p, z=MAP, dx=STEP), PLACED),
    "npy of points": ("a.npy", POINTS, PLACED),
    "TIFF of 64 bits": ("a.tif", pages, SIZED),
    "TIFF of counts": (
        "a.tif",
        lambda p: tiff(p, values=np.rint(1e5 * MAP).astype("i4")),
        COUNTED,
    ),
    "NetCDF of one map": ("a.nc", lambda p: netcdf(p, MAP[None]), SIZED),
    "points beside a grid": ("a.xyz", lines(POINTS + np.c_[JITTER, 0 * JITTER[:, 0]]), PLACED),
}


def write(folder, name, content):
    path = folder / name
    if callable(content):
        content(path)
    elif isinstance(content, str):
        path.write_text(content)
    elif isinstance(content, bytes):
        path.write_bytes(content)
    else:
        np.save(path, content)
    return path


@pytest.mark.parametrize("kind", READ)
def test_every_file_of_a_map_gives_what_npy_gives(tmp_path, kind):
    name, content, options = READ[kind]
    same = topography.read(write(tmp_path, "same.npy", MAP), **SIZED)
    found = topography.read(write(tmp_path, name, content), **options)
    assert found.heights.shape == same.heights.shape == (NX, NY)
    tolerance = 2e-3 if kind == "points beside a grid" else 1e-6
    assert found.steps == pytest.approx(same.steps, rel=tolerance)
    np.testing.assert_allclose(found.heights, same.heights, atol=2e-11)
    assert found.contradictions == ()
    told = {
        "points and colours",
        "points with an index",
        "points beside a grid",
        "one column and two sides",
    }
    assert bool(found.remarks) == (kind in told)


@pytest.mark.parametrize(
    ("header", "mark", "options"),
    [
        ("", "inf", SIZED),
        ("", "1e300", SIZED),
        (ESRI.partition("NODATA")[0], "-9999", PLACED | {"missing_value": -9999}),
        (ESRI.partition("NODATA")[0], "-9999", PLACED),
    ],
)
def test_a_mark_in_the_first_place_is_missing(tmp_path, header, mark, options):
    path = write(tmp_path, "a.txt", header + mark + lines(MAP)[lines(MAP).index(" ") :])
    found = topography.read(path, **options)
    assert found.contradictions == ()
    assert found.heights.shape == (NX, NY)
    assert found.missing == 1


SCATTERED = np.random.default_rng(1).random((500, 3))
LINE = lines(np.column_stack([X, X % 7]))
# What is refused: name of the file, content, options, words of the error.
REFUSED = {
    "two maps": ("a.txt", lines(MAP) + "\n" + lines(MAP), SIZED, "two blocks of 16 rows; give one"),
    "two profiles": ("a.txt", LINE + "# next\n" + LINE, PLACED, "two blocks of 24 rows"),
    "scattered points": ("a.xyz", lines(SCATTERED), PLACED, "resample them to a regular grid"),
    "a cloud of points": (
        "a.xyz",
        lines(np.column_stack([SCATTERED, SCATTERED])),
        PLACED,
        "a table of 500 rows in 6 columns is no map",
    ),
    "a wrong count": ("a.xyz", "99\n" + lines(POINTS), PLACED, "counts 99 points, but 384 follow"),
    "repeated positions": ("a.txt", LINE + LINE, PLACED, "24 occur twice or more"),
    "units of positions": (
        "a.txt",
        "X (mm)\tY (um)\tZ (um)\n" + lines(POINTS, "\t"),
        {},
        "in mm and um; write both in one unit",
    ),
    "points for thousands": (
        "a.csv",
        lines(1000 * MAP, ";", "{:,.0f}").replace(",", "."),
        SIZED,
        "may have decimal points or points for thousands",
    ),
    "a few commas for thousands": (
        "a.txt",
        lines(400 * MAP, "\t", "{:,.0f}"),
        SIZED,
        "may have decimal commas or commas for thousands",
    ),
    "heights in waves": (
        "a.asc",
        "Wavelength\t7\t4\t600\nRAW_DATA\n" + lines(MAP),
        SIZED,
        "apply it to the heights",
    ),
    "a negative unit": ("a.txt", lines(MAP), SIZED | {"height_unit": "-1 um"}, "above zero"),
    "fields": ("a.npy", np.rec.fromarrays([X, X], names="a,b"), SIZED, "with the fields a, b"),
    "many maps": ("a.npy", np.stack([MAP, MAP]), SIZED, "got shape (2, 16, 24); save one map"),
    "complex numbers": ("a.npy", MAP * 1j, SIZED, "holds no real numbers"),
    "two matrices": (
        "a.mat",
        lambda p: scipy.io.savemat(p, {"a": MAP, "b": MAP}),
        SIZED,
        "found ['a', 'b']; choose one by channel",
    ),
    "uneven positions": ("a.h5", lambda p: hdf5(p, x=X**2, y=Y, z=MAP), UNIT, "'x' is not evenly"),
    "a missing position": (
        "a.npz",
        lambda p: np.savez(p, x=np.where(X == 6, np.nan, X), z=MAP[0]),
        PLACED,
        "a position of the profile is missing",
    ),
    "no matrix": ("a.mat", lambda p: scipy.io.savemat(p, {"a": "text"}), SIZED, "no matrix of"),
    "colours": ("a.tif", lambda p: tiff(p, values=np.zeros((9, 9, 3), "u1")), SIZED, "colours or"),
    "half a simple field": (
        "a.gsf",
        b"Gwyddion Simple Field 1.0\nXRes = 9\nYRes=9\n\0",
        SIZED,
        "its end is missing",
    ),
    "another unit": (
        "a.gwy",
        lambda p: gwyddion(p, "V"),
        SIZED,
        "no channel of heights: it has 'Z' (V)",
    ),
    "a current": ("a.gwy", lambda p: gwyddion(p, "A"), {}, "of heights: it has 'Z' (A)"),
    "half of NetCDF 3": (
        "a.nc",
        lambda p: netcdf(p, MAP, "NETCDF3_64BIT", keep=1000),
        SIZED,
        "incomplete or damaged",
    ),
    "maps in NetCDF": (
        "a.nc",
        lambda p: netcdf(p, np.stack([MAP, MAP])),
        SIZED,
        "no map or profile, but 'z' of 2 x 16 x 24 points; save one map",
    ),
    "pages": ("a.tif", lambda p: pages(p, np.stack([MAP, MAP])), SIZED, "several pages; save"),
    "points of few digits": (
        "a.xyz",
        lines(POINTS / 50, form="{:.1f}"),
        PLACED,
        "places, and several of them at x = 0, y = 0: export positions with more digits",
    ),
    "points and commas in one column": (
        "a.txt",
        "1.026,00\n1.031,50\n998,20\n",
        SIZED,
        "may hold two numbers, or one with a comma",
    ),
    "points for thousands and decimals": (
        "a.txt",
        "1.026,00\t1.5\n998,20\t1.6\n",
        SIZED,
        "line 1: '.' separates decimals, but thousands elsewhere",
    ),
    "one column and the sides of a strip": (
        "a.txt",
        lines(MAP[0, :, None]),
        UNIT | {"length": ["48 um", "2 um"]},
        "one length for a line profile",
    ),
    "too large": (
        "a.npy",
        nothing_but_size,
        SIZED,
        "1209 MB are more than the 1208 MB that are read",
    ),
    "one number": ("a.txt", "5", SIZED, "one number is no map and no profile"),
    "half a grid": ("a.grd", "DSAA\n24 16\n0 1\n0 1\n0 1\n1 2 3\n", PLACED, "has 3 heights, but"),
    "half a binary grid": ("a.grd", b"DSBB\1\0", PLACED, "its end is missing"),
    "half of Zygo's": (
        "a.xyz",
        "Zygo XYZ Data File - Format 1\n0 0\n",
        {},
        "Zygo's software cannot",
    ),
    "a picture": (
        "a.png",
        b"\x89PNG\r\n\x1a\n",
        SIZED,
        "a picture (PNG), no map of heights; export",
    ),
    "a mesh": ("a.stl", "solid a\nfacet normal 0 0 1\n", SIZED, "a mesh of triangles (STL)"),
    "an unknown file": (
        "a.dat",
        b"\1\0\2" * 99,
        SIZED,
        "no reader takes it; export the heights as",
    ),
    "a square of unknown bytes": ("a.dat", b"\1\0" * 1201**2, SIZED, "no reader knows its first"),
}


@pytest.mark.parametrize("kind", REFUSED)
def test_other_files_are_refused_in_one_line_that_helps(tmp_path, kind):
    name, content, options, words = REFUSED[kind]
    path = write(tmp_path, name, content)
    with pytest.raises(ValueError, match=name) as caught:
        topography.read(path, **options)
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("kind", "wanted"),
    [
        ("gwy without a unit", {"height_unit"}),
        ("ESRI", {"height_unit", "position_unit"}),
        ("Surfer", {"height_unit", "position_unit"}),
        ("MATLAB", {"height_unit", "length"}),
        ("quoted", {"length"}),
    ],
)
def test_only_what_a_file_lacks_is_asked_for(tmp_path, kind, wanted):
    name, content, _ = READ[kind]
    with pytest.raises(topography.UntoldError) as caught:
        topography.read(write(tmp_path, name, content))
    assert {keys[0] for keys in caught.value.unknown.values()} == wanted


UNEVEN = lines(np.column_stack([X**2, X]))
# What an option says otherwise than the file: name, content, options, words, and the side taken.
CONTRADICTED = {
    "a size": ("a.nc", contact_engineering, {"length": "96 um"}, "used, 2 times the size", 96),
    "positions": ("a.txt", LINE, PLACED | {"length": "96 um"}, "used, 2 times the size", 96),
    "positions without a unit": (
        "a.txt",
        LINE,
        UNIT | {"length": "96 um"},
        "a unit of position in the file would be 2e-06 m, which none is",
        96,
    ),
    "points": ("a.xyz", lines(POINTS), PLACED | {"length": "96 um"}, "used, 2 times the size", 96),
    "pixels": (
        "a.npz",
        lambda p: np.savez(p, z=MAP, dx=STEP),
        UNIT | {"pixel_size": "3 um"},
        "would be 1.5e-06 m",
        72,
    ),
    "a mark": ("a.npy", MAP, SIZED | {"missing_value": -9999}, "no point is -9999, the", 48),
}


@pytest.mark.parametrize("kind", CONTRADICTED)
def test_what_is_said_otherwise_than_in_the_file(tmp_path, kind):
    name, content, options, words, side = CONTRADICTED[kind]
    found = topography.read(write(tmp_path, name, content), **options)
    (told,) = found.contradictions
    assert words in told
    assert found.size[0] == pytest.approx(side * 1e-6)


def test_an_uneven_line_of_contact_engineering(tmp_path):
    line_of_contact_engineering(tmp_path / "a.nc")
    found = topography.read(tmp_path / "a.nc")
    np.testing.assert_allclose(found.heights, 1e-6 * MAP[0], rtol=1e-12)
    assert found.dx == pytest.approx(STEP * 1e-6)


def test_heights_are_found_beside_a_first_channel_without_them():
    phase, height = (
        SimpleNamespace(
            name=name,
            channel_id=name,
            index=index,
            unit="um",
            is_height_channel=True,
            is_uniform=True,
            nb_grid_pts=(NX, NY),
            physical_sizes=(NX * STEP, NY * STEP),
        )
        for index, name in enumerate(["Phase", "Height"])
    )
    maps = [surface_topography().Topography(z.T, (48, 32), unit="um") for z in (0 * MAP, MAP)]
    reader = SimpleNamespace(
        channels=[phase, height],
        default_channel=phase,
        topography=lambda channel_index: maps[channel_index],
    )
    found = instruments.read_channel(Path("a.spm"), reader)
    np.testing.assert_array_equal(found.heights, MAP.T)


def test_channels_of_one_title_are_told_apart(tmp_path):
    gwyddion(tmp_path / "a.gwy", "m", titles=("Z", "Z", "Z#2"))
    found = grids.read_gwyddion(tmp_path / "a.gwy")
    assert found.source.endswith("Z#1")
    assert found.others == ("Z#2", "Z#2#2")


def test_periodic_heights_are_analysed_as_such_unless_told_otherwise(tmp_path):
    contact_engineering(tmp_path / "a.nc", periodic=True)
    same = write(tmp_path, "same.npy", MAP)
    as_file = Surface.read(tmp_path / "a.nc").data
    by_hand = Surface.read(same, **SIZED, window="none", detrend="mean").data
    np.testing.assert_allclose(as_file.psd, by_hand.psd, rtol=1e-6)
    assert "periodic; they were analysed less their mean and without a taper" in as_file.remarks
    # Less a plane they are periodic no more.
    levelled = Surface.read(tmp_path / "a.nc", detrend="plane").data
    np.testing.assert_allclose(levelled.psd, Surface.read(same, **SIZED).data.psd, rtol=1e-6)
    assert "periodic" not in levelled.remarks
