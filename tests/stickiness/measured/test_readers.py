"""Files of many programs: read as one map, or refused in one line that helps.

The files and what is expected of each are in `tests/data/instruments`, with the table files.yaml. A
new format or dialect needs a file there and a row.
"""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import yaml

from stickiness import Surface
from stickiness.measured import topography
from stickiness.measured.readers import instruments

pytestmark = pytest.mark.processors

FILES = Path(__file__).parents[2] / "data/instruments"
ROWS = yaml.safe_load((FILES / "files.yaml").read_text())
EXPECTATIONS = (
    *("missing", "offset", "tolerance", "remark", "source", "others"),
    *("contradiction", "side", "refused"),
)
MAP = np.load(FILES / "map.npy")  # um, rows along y
SIZED = {"height_unit": "um", "length": "36 um"}


def test_every_file_has_a_row():
    of_other_tests = {"files.yaml", "line_of_contact_engineering.nc", "periodic.nc"}
    assert {row["file"] for row in ROWS} == {file.name for file in FILES.iterdir()} - of_other_tests


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row["file"])
def test_a_file_is_read_as_the_map_or_refused(row):
    path = FILES / row["file"]
    arguments = {key: row[key] for key in row if key not in ("file", *EXPECTATIONS)}
    if "refused" in row:
        with pytest.raises(ValueError, match=path.name) as caught:
            topography.read(path, **arguments)
        assert row["refused"] in str(caught.value)
        assert "\n" not in str(caught.value)
        return
    found = topography.read(path, **arguments)
    told = [row[key] for key in ("remark",) if key in row]
    assert len(found.remarks) == len(told)
    assert all(words in remark for words, remark in zip(told, found.remarks, strict=True))
    if "source" in row:
        assert found.source == f"{path}: {row['source']}"
        assert found.others == tuple(row.get("others", found.others))
    if "contradiction" in row:
        (contradiction,) = found.contradictions
        assert row["contradiction"] in contradiction
        assert found.size[0] == pytest.approx(row["side"] * 1e-6)
        return
    assert found.contradictions == ()
    assert found.steps == pytest.approx((2e-6, 2e-6), rel=row.get("tolerance", 1e-6))
    missing = row.get("missing", 0)
    assert found.count(topography.FILL) == missing
    # A step of phase in a file of Zygo's is 10 pm.
    heights = found.heights.T.ravel()[missing:]
    expected = MAP + row.get("offset", 0.0)
    np.testing.assert_allclose(heights, 1e-6 * expected.ravel()[missing:], atol=2e-11)


@pytest.mark.parametrize(
    ("size", "words"),
    [
        (9 * 2**27 + 2**20, "1209 MB are more than the 1208 MB that are read"),
        (2 * 1201**2, "no reader knows its first bytes; export"),
    ],
)
def test_files_of_unknown_bytes_are_refused_by_their_size(tmp_path, size, words):
    path = tmp_path / "a.dat"
    with path.open("wb") as file:
        file.write(b"\1\0")
        file.truncate(size)
    with pytest.raises(ValueError, match="a.dat") as caught:
        topography.read(path, **SIZED)
    assert words in str(caught.value)


def test_an_uneven_line_of_contact_engineering():
    found = topography.read(FILES / "line_of_contact_engineering.nc")
    np.testing.assert_allclose(found.heights, 1e-6 * MAP[0], rtol=1e-12)
    assert found.dx == pytest.approx(2e-6)


def test_heights_are_found_beside_a_first_channel_without_them():
    shape = MAP.T.shape
    size = tuple(2.0 * n for n in shape)
    phase, height = (
        SimpleNamespace(
            name=name,
            channel_id=name,
            index=index,
            unit="um",
            is_height_channel=True,
            is_uniform=True,
            nb_grid_pts=shape,
            physical_sizes=size,
        )
        for index, name in enumerate(["Phase", "Height"])
    )
    reader = SimpleNamespace(
        channels=[phase, height],
        default_channel=phase,
        topography=lambda channel_index: SimpleNamespace(
            heights=lambda: channel_index * MAP.T,
            unit="um",
            physical_sizes=size,
            is_periodic=False,
        ),
    )
    found = instruments.read_channel(Path("a.spm"), reader)
    np.testing.assert_array_equal(found.heights, MAP.T)


def test_periodic_heights_are_analysed_as_such_unless_told_otherwise():
    as_file = Surface.read(FILES / "periodic.nc").data
    same = FILES / "map.npy"
    by_hand = Surface.read(same, **SIZED, window="none", detrend="mean").data
    np.testing.assert_allclose(as_file.psd, by_hand.psd, rtol=1e-6)
    assert "periodic; they were analysed less their mean and without a taper" in as_file.remarks
    # Less a plane they are periodic no more.
    levelled = Surface.read(FILES / "periodic.nc", detrend="plane").data
    np.testing.assert_allclose(levelled.psd, Surface.read(same, **SIZED).data.psd, rtol=1e-6)
    assert "periodic" not in levelled.remarks
