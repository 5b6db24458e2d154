"""From a file to a page: measured surfaces as the workflow analyses, judges and shows them."""

import json
from typing import NamedTuple

import numpy as np
import pytest
import xarray as xr
from bokeh.models import DataRange1d, Div
from helpers.pages import Page, make_job

from criteria import judge_surface
from real_surfaces import picture_contact
from report import write_surface
from stickiness import Material, Surface, datasets, judge, surface, verdict
from stickiness.criteria.pair import NOT_JUDGED, TOUCHES, WORDS
from stickiness.entries import check_material, check_surface, without_texts
from stickiness.formatting import amount, number, with_error
from stickiness.measured import topography
from stickiness.pages import (
    contact_figure,
    interactive,
    plotting,
    pressed_heights,
    surface_figures,
)
from stickiness.pages.pressed_heights import MeasuredMap, Picture
from stickiness.pages.rows import describe_pair
from stickiness.pages.surface_page import list_loads
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.spectrum import SelfAffine
from stickiness.verdicts.limits import read_limited
from stickiness.verdicts.wording import tell_rates

pytestmark = pytest.mark.usefixtures("coarse_simulation")

STEEL = {"label": "steel", "plane_strain_modulus": "230 GPa", "work_of_adhesion": "0.1 J/m^2"}
STEEL |= {"range": "0.3 nm"}
SERIES = {"equilibrium": "10 kPa", "terms": [["100 GPa", "1 ms"]]}
GEL = {"label": "gel <soft>", "youngs_modulus_prony": SERIES, "poisson_ratio": 0.5}
GEL |= {"work_of_adhesion": "50 mJ/m^2", "range": "0.3 nm"}
MATERIALS = {"gel": check_material(GEL), "steel": check_material(STEEL)}
STEEL_ALONE = {"steel": MATERIALS["steel"]}
TAPE = check_material(STEEL | {"label": "soft tape", "plane_strain_modulus": "1 MPa"})
WALL = {"kind": "self_affine", "hurst": 0.8, "shortest_wavelength": "1 um"}


class Analysed(NamedTuple):
    """A surface: its checked entry, and the file that the rule writes, read back."""

    entry: dict
    data: xr.Dataset


def scan(path, seed=1, spoiled=()):
    """Text file of a patch of a rough surface, in nm, with other values at some points."""
    s = SelfAffine(hurst=0.8, q0=1.0, q1=100.0, h_rms=300.0, q_rolloff=6.0)
    h = surface.synthesise(s, n=256, length=2 * np.pi, seed=seed)[:128, :128]
    for place, value in dict(spoiled).items():
        h[place] = value
    rows = "\n".join("\t".join(f"{v:.4f}" for v in row) for row in h.T)
    path.write_text("# Width: 40 µm\n# Value units: nm\n" + rows, encoding="utf-8")
    return str(path)


def analyse(path, **keys):
    entry = check_surface({"kind": "measured", "label": "plate & co", "source": "own"} | keys)
    made = {"surface": "plate", **entry}
    Surface.from_entry(entry).write(path, title="a", parameters=made)
    return Analysed(entry, datasets.read(path))


def judge_data(data, materials=MATERIALS):
    """Verdicts of all materials on one surface, of which some materials are, too."""
    plate = {"plate": Surface(data)}
    solids = {name: Material.from_entry(entry, plate) for name, entry in materials.items()}
    return judge(solids, plate, curves=False, thresholds=False).sel(surface="plate")


def judge_by_rule(analysed, folder, materials):
    """Files of an analysed surface and of its verdicts, by their names as inputs of rules."""
    surface_file = str(folder / "plate.nc")
    datasets.write(analysed.data, surface_file, title="a", parameters={"surface": "plate"})
    verdicts = str(folder / "verdicts.nc")
    judge_surface.main(
        make_job(
            {"surface": surface_file, "material_surfaces": [surface_file]},
            {"verdicts": verdicts, "contact_laws": str(folder / "laws.json")},
            {"real_surface": "plate"},
            materials=materials,
            material_surfaces=["plate"],
            label=analysed.entry["label"],
        )
    )
    return {"surface": surface_file, "verdicts": verdicts}


def write_page(analysed, folder, materials=MATERIALS, judged=None, **pictures):
    """The page of an analysed surface, by the rules that judge it, unless it is, and write it."""
    inputs = (judged or judge_by_rule(analysed, folder, materials)) | pictures
    page = folder / "report/surfaces/plate.html"
    write_surface.main(make_job(inputs, {"page": str(page)}, surface=analysed.entry))
    return Page(page.read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("plate")


@pytest.fixture(scope="module")
def single(folder):
    return analyse(folder / "single.nc", file=scan(folder / "a.txt"))


@pytest.fixture(scope="module")
def judged(single, folder):
    """Files of the surface of a single scan and of its verdicts."""
    return judge_by_rule(single, folder / "page", MATERIALS)


@pytest.fixture(scope="module")
def page(single, folder, judged):
    return write_page(single, folder / "page", judged=judged)


@pytest.fixture(scope="module")
def pairs(judged):
    """Verdicts on the surface of a single scan."""
    return datasets.read(judged["verdicts"]).sel(surface="plate")


@pytest.fixture(scope="module")
def taped(single, folder):
    """The same files with the verdict of soft tape."""
    return judge_by_rule(single, folder / "taped", {"tape": TAPE})


@pytest.mark.slow
def test_each_end_has_its_own_a_v_where_they_differ_in_shape(single, folder):
    one, other = Surface(single.data).a_v
    assert one is other
    on = analyse(folder / "on2.nc", file=scan(folder / "a.txt"), extend_to="50 nm")
    smooth, rough = (a_v.theory[:2, 0] for a_v in Surface(on.data).a_v)
    # The rough end has the lower H, and a_V of the edges grows as zeta^((5H - 3)/3): both variants
    # of the theory have it lower there, by some per cent.
    assert np.all(rough < 0.99 * smooth)


@pytest.mark.slow
def test_the_page_shows_what_is_in_the_files(page, single, pairs):
    share = float(pairs.remaining.sel(material="gel").max())
    page.check(
        f"{number(100 * share, 2)} %",
        "gel <soft>",
        "plate & co",
        "E* = 230 GPa",
        with_error(single.data.hurst, single.data.hurst_total_error),
    )
    assert {link for link in page.links if not link.startswith(("#", "https://doi.org/"))} == {
        *("../../plate.nc", "../../verdicts.nc")
    }
    # Steel is stiff and does not stick; the gel is soft at 1 Hz and stiff beyond its relaxation.
    assert pairs.verdict.sel(material="steel") < TOUCHES
    assert page.html.count("Bokeh.logger.set_level") == 1
    assert 'id="reading"' not in page.html  # the map is used as it was read


@pytest.mark.slow
def test_profiles_and_parametric_surfaces_have_pages(folder):
    s = SelfAffine(hurst=0.8, q0=1.0, q1=200.0, h_rms=300.0)
    h = surface.synthesise(s, n=512, length=2 * np.pi, seed=8)[:, 9]
    (folder / "line.txt").write_text("\n".join(f"{0.1 * i:.2f}\t{z:.3f}" for i, z in enumerate(h)))
    units = {"height_unit": "nm", "position_unit": "um"}
    line = analyse(folder / "line.nc", file=str(folder / "line.txt"), **units)
    assert "anisotropy" not in line.data
    page = write_page(line, folder, STEEL_ALONE)
    page.check()
    assert 'id="reading"' not in page.html
    sand = WALL | {"longest_wavelength": "1 mm", "h_rms": ["1 um", "3 um"]}
    page = write_page(analyse(folder / "sand.nc", **sand), folder, STEEL_ALONE)
    page.check("rms height 1 … 3 µm")


@pytest.mark.slow
def test_an_implausible_surface_is_not_judged_and_its_page_says_why(folder):
    zeros = {(i, j): 0 for i in range(0, 128, 5) for j in range(0, 128, 4)}
    file = scan(folder / "zeros.txt", spoiled=zeros)
    withheld = analyse(folder / "zeros.nc", file=file)
    gel = {"gel": check_material(GEL | {"range": "0.3 um"})}
    judged = judge_by_rule(withheld, folder, gel)
    pairs = datasets.read(judged["verdicts"]).sel(surface="plate")
    assert (pairs.verdict == NOT_JUDGED).all()
    assert np.isnan(pairs.probability).all()
    assert not pairs.disagrees.any()
    text = write_page(withheld, folder, judged=judged).text
    assert "range = 3e-07" in text
    assert "missing_value: 0" in text
    assert surface_figures.find_curves(pairs, ["gel"], ["gel"]) == {}
    row = describe_pair(pairs.sel(material="gel"))
    assert row["text"]["remaining"] == "–"
    ignored = analyse(folder / "told.nc", file=file, plausibility="ignore")
    assert (judge_data(ignored.data).verdict != NOT_JUDGED).all()


@pytest.mark.slow
def test_the_rule_writes_what_the_library_answers(single, folder):
    """Also of a material that is rough itself, and without NaN."""
    materials = MATERIALS | {"rough": check_material(STEEL | {"surface": "plate"})}
    files = judge_by_rule(single, folder / "answers", materials)
    pairs = datasets.read(files["verdicts"]).sel(surface="plate")
    laws = json.loads((folder / "answers/laws.json").read_text(), parse_constant=pytest.fail)
    assert laws["surface"] == "plate & co"
    plate = Surface(single.data)
    for (name, entry), law in zip(materials.items(), laws["pairs"], strict=True):
        answer = verdict(plate, Material.from_entry(entry, {"plate": plate}))
        assert law == {"material": entry["label"]} | json.loads(json.dumps(answer.to_dict()))
        assert answer.word == WORDS[int(pairs.verdict.sel(material=name))]
        stored = read_limited(pairs.modulus_threshold.sel(material=name))
        assert stored == (answer.modulus_threshold, *answer.modulus_threshold_limits)


def test_a_pair_is_not_judged_if_the_surface_of_its_material_is_not(single):
    spiky = Surface(single.data.assign_attrs(not_judged="a spike"))
    steel = Material.from_entry(MATERIALS["steel"] | {"surface": "spiky"}, {"spiky": spiky})
    verdicts = judge([steel], [Surface(single.data)], curves=False, thresholds=False)
    assert verdicts.verdict == NOT_JUDGED
    assert verdicts.not_judged == "a spike"


def test_a_tilt_is_no_other_picture():
    s = SelfAffine(hurst=0.8, q0=2 * np.pi, q1=128 * np.pi, h_rms=1e-3)
    heights = surface.synthesise(s, n=256, length=1.0, seed=4) + np.linspace(0, 0.1, 256)
    wall = Surface.from_heights(1e-3 * heights, length=1e-3)
    assert not surface_figures.shows_change(wall.data)


def test_heights_as_read_are_kept_with_what_is_not_used():
    s = SelfAffine(hurst=0.8, q0=1.0, q1=25.0, h_rms=1.0)
    heights = surface.synthesise(s, n=200, length=2 * np.pi, seed=4)[:180, :150]
    heights[20:24, 40:45] = np.nan
    heights[101, 71] = 40.0  # a spike
    read = topography.from_array(heights, 1.0, missing="crop", missing_rim=0, scale=1e-6)
    np.testing.assert_array_equal(read.as_read, 1e-6 * heights)
    assert read.unused.sum() == heights.size - 20 - read.heights.size
    kept = topography.from_array(heights, 1.0, missing_rim=0)
    assert np.argwhere(kept.unused).tolist() == [[101, 71]]
    # Thinned to every second point, the spike is still there.
    data = Surface.from_heights(1e-6 * heights, (180e-6, 150e-6), missing_rim=0).data
    assert data.heights_as_read.shape == data.unused.shape == (90, 75)
    assert np.argwhere(data.unused.values).tolist() == [[50, 35]]
    np.testing.assert_allclose(data.heights_as_read, 1e-6 * heights[::2, ::2], rtol=1e-6)


@pytest.mark.slow
def test_curves_pass_through_the_pair_as_it_is(pairs):
    axes = surface_figures.find_curves(pairs, ["steel", "gel"], ["gel"])
    assert [curve.shown for curve in axes["modulus"].curves] == [False, True]
    shown = {name: [curve.label for curve in axis.curves] for name, axis in axes.items()}
    both = ["steel", "gel <soft>"]
    assert shown == {"modulus": both, "roughness": both, "rate": ["gel <soft>"]}
    assert axes["modulus"].label == "modulus E or E*, as given [MPa]"
    pair = pairs.sel(material="gel")
    actual = {"modulus": float(pair.quoted_modulus) / 1e6, "roughness": 1.0, "rate": 1.0}
    for name, axis in axes.items():
        assert axis.wanted == DEFAULT_SHARE
        drawn = axis.curves[-1].own
        np.testing.assert_allclose(
            drawn[["low", "value", "high"]], 100 * pair.remaining.values, rtol=1e-9
        )
        assert drawn.x == pytest.approx(actual[name], rel=0.01)
    # From a decade below the threshold and the material's modulus to a decade above them.
    reach = surface_figures.find_moduli(pair) / 1e6
    ends = axes["modulus"].curves[-1].points.x.agg(["min", "max"])
    np.testing.assert_allclose(ends, [reach.min() / 10, reach.max() * 10], rtol=0.3)
    alone = surface_figures.find_curves(pairs, ["gel"], ["gel"])
    assert alone["modulus"].label == "Young's modulus E [MPa]"


@pytest.mark.slow
def test_rates_that_stick_are_told_with_both_limits(pairs):
    pair = pairs.sel(material="gel")
    _, *rates = read_limited(pair.rate_threshold)
    low, high = (f"{number(rate, 2)} Hz" for rate in rates)
    assert tell_rates(pair) == f"sticks below {low}, and may stick below {high}"
    assert tell_rates(pairs.sel(material="steel")) == ""


@pytest.fixture(scope="module")
def picture(single):
    """Contact and pull-off of coarser and higher heights, which are solved faster."""
    s = SelfAffine(hurst=0.8, q0=6.0, q1=16.0, h_rms=1e-6)
    h = surface.synthesise(s, n=64, length=2 * np.pi, seed=4)
    heights = topography.Topography(h, 40e-6 / 64, 40e-6 / 64, "here")
    measured = MeasuredMap(heights, cutoff=2 * np.pi / 2.5e-6)
    ends = {"q0": float(single.data.q0), "q1": float(single.data.q1)}
    rough = pressed_heights.prepare(measured, 128)
    contact = pressed_heights.press(rough, ends["q0"], measured.cutoff)
    rough = pressed_heights.prepare(measured, 64)
    pull_off = pressed_heights.separate(rough, Material.from_entry(TAPE), **ends)
    return Picture(
        contact.assign_attrs(measurement="data/b.txt"),
        pull_off.assign_attrs(material="soft tape", moment=""),
    )


def save_picture(folder, picture):
    """Paths of the files of a picture, by the names of the rule's inputs."""
    paths = {name: str(folder / f"{name}.nc") for name in picture._fields}
    for name, path in paths.items():
        datasets.write(getattr(picture, name), path, title="a", parameters={})
    return paths


@pytest.mark.slow
def test_page_shows_contact_and_pull_off(single, folder, picture):
    place = folder / "pictured"
    materials = {"gel": MATERIALS["gel"], "tape": TAPE}
    page = write_page(single, place, materials, **save_picture(place, picture))
    contact, pull_off = picture
    page.check(
        f"{100 * float(contact.area_fraction[0]):.2g}",
        f"to {100 * float(pull_off.separation.sel(limit='high')):.2g} %)",
        "soft tape is pressed on",
        "gel <soft> at 1 Hz",
    )
    assert "data/b.txt" in page.html
    assert len(page.html) < 4e6


@pytest.mark.slow
def test_the_rule_names_the_material_that_is_pulled_off(single, folder, taped, monkeypatch):
    monkeypatch.setattr(pressed_heights, "CONTACT_POINTS", 64)
    monkeypatch.setattr(pressed_heights, "PULL_OFF_POINTS", 32)
    inputs = {"surface": str(folder / "single.nc")}
    outputs = {name: str(folder / f"ruled/{name}.nc") for name in Picture._fields}
    made = {"surface": without_texts(single.entry), "material": "tape"}
    for changes, reason in (
        ({}, "the shortest range that the grid resolves"),
        ({"surface": "plate"}, "the material has a roughness of its own"),
    ):
        entry = without_texts(TAPE | changes) | {"label": TAPE["label"]}
        job = make_job(inputs, outputs, {"real_surface": "plate"}, **made, entry=entry)
        picture_contact.main(job)
        page = write_page(single, folder / "ruled", judged=taped, **outputs)
        page.check(f"The pull-off of soft tape is not simulated: {reason}")


@pytest.mark.slow
def test_pressures_are_given_for_deep_and_smooth_solids(single, picture):
    rough = check_material(STEEL | {"label": "rough", "surface": "plate"})
    film = check_material(GEL | {"label": "film", "thickness": "1 mm"})
    pairs = judge_data(single.data, MATERIALS | {"rough": rough, "film": film})
    assert pairs.half_space.values.tolist() == [1, 1, 0, 0]
    rows = list_loads(picture.contact, pairs.sel(material=pairs.half_space == 1))
    assert [list(row["pressures"]) for row in rows] == [["gel <soft> at 1 Hz", "steel"]] * 8
    first = float(picture.contact.mean_pressure[0]) * 230e9
    assert rows[0]["pressures"]["steel"] == amount(first, "Pa", 2)
    assert all("±" in row[name] for row in rows for name in ("area", "gap"))


def test_the_first_row_of_a_map_is_on_top():
    heights = xr.DataArray(np.zeros((8, 4)), {"x": np.arange(8.0), "y": np.arange(4.0)})
    heights[:, 0] = 1.0
    with plotting.open_figure([], "A", 2) as panels:
        surface_figures.draw_heights(panels["A"], heights)
        bottom, top = panels["A"].get_ylim()
        picture = panels["A"].images[0]
    assert (bottom, top) == (3.0, 0.0)
    assert picture.origin == "upper"
    assert np.all(picture.get_array()[0] == 1.0)


@pytest.mark.slow
def test_both_figures_show_the_contact_and_the_curve(picture, tmp_path):
    contact, pull_off = picture
    nothing = xr.Dataset(attrs={"left_out": "it is dark"})
    for shown in ((contact, pull_off), (contact, nothing), (nothing, nothing)):
        contact_figure.draw_still(*shown, tmp_path / "still.png")
        assert (tmp_path / "still.png").read_bytes().startswith(b"\x89PNG")
    codes, widest = contact_figure.code_maps(contact)
    assert codes.shape == (8, 64, 64)
    touching = (codes == contact_figure.CONTACT).transpose(0, 2, 1)
    assert np.all(contact.contact.values[touching] >= 0.5)
    gaps = np.minimum(contact.gap.values, widest)[~touching]
    shown = codes.transpose(0, 2, 1)[~touching] * widest / (contact_figure.CONTACT - 1)
    np.testing.assert_allclose(shown, gaps, atol=0.002 * widest)
    drawn = interactive.draw_contact(contact, pull_off, list("abcdefgh"))
    assert drawn.select_one({"type": Div}).render_as_text  # "gel <soft>" is a label, not a tag
    assert drawn.select_one({"type": DataRange1d, "flipped": True})  # the first row is on top
    slider = drawn.select_one({"name": "load"})
    assert (slider.start, slider.end) == (0, 7)
    curves, _, _, (lowest, highest) = contact_figure.follow_tension(pull_off)
    assert sum(len(curve["gap"]) for _, _, curve in curves) == pull_off.sizes["state"]
    assert lowest < 0 < max(curves[1][2]["tension"]) < highest
