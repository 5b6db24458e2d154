"""From a file to a page: measured surfaces as the workflow analyses, judges and shows them."""

import json
from typing import NamedTuple

import numpy as np
import pytest
import xarray as xr
from helpers.pages import Page, make_job
from matplotlib.colors import to_hex

from criteria import judge_surface
from report import write_surface
from stickiness import Material, Surface, datasets, judge, surface, verdict
from stickiness.criteria.pair import NOT_JUDGED, TOUCHES, WORDS
from stickiness.entries import check_material, check_surface
from stickiness.formatting import number, with_error
from stickiness.measured import topography
from stickiness.pages import contact_figure, plotting, surface_figures
from stickiness.pages.rows import describe_pair
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.spectrum import SelfAffine
from stickiness.verdicts.limits import read_limited
from stickiness.verdicts.meeting import find_family, find_roughness
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
            code="",
        )
    )
    return {"surface": surface_file, "verdicts": verdicts}


def write_page(analysed, folder, materials=MATERIALS, judged=None):
    """The page of an analysed surface, by the rules that judge it, unless it is, and write it."""
    inputs = judged or judge_by_rule(analysed, folder, materials)
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
    assert surface_figures.find_curves(pairs, ["gel"]) == {}
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
    axes = surface_figures.find_curves(pairs, ["steel", "gel"])
    assert [curve.place for curve in axes["modulus"].curves] == [0, 1]
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
    alone = surface_figures.find_curves(pairs, ["gel"])
    assert alone["modulus"].label == "Young's modulus E [MPa]"


@pytest.mark.slow
def test_rates_that_stick_are_told_with_both_limits(pairs):
    pair = pairs.sel(material="gel")
    _, *rates = read_limited(pair.rate_threshold)
    low, high = (f"{number(rate, 2)} Hz" for rate in rates)
    assert tell_rates(pair) == f"sticks below {low}, and may stick below {high}"
    assert tell_rates(pairs.sel(material="steel")) == ""


@pytest.mark.slow
def test_the_contact_shown_is_that_of_the_states_that_decided(single):
    """Its energies give the share that states alone leave of the work of adhesion."""
    materials = {"tape": TAPE, "gel": MATERIALS["gel"]}
    pairs = judge_data(single.data, materials)
    contact = contact_figure.find_contact(single.data, pairs)
    assert [state.title for state in contact.states[:2]] == ["soft tape", "gel <soft>"]
    assert contact.sides == pytest.approx((40e-6, 40e-6))
    wall = Surface(single.data)
    states = wall.simulated.whole
    lacking = np.median(wall.lacking, keepdims=True)
    for name, state in zip(materials, contact.states, strict=False):
        pair = pairs.sel(material=name)
        length = np.array([float(pair.work_of_adhesion / pair.plane_strain_modulus)])
        range_ = np.array([float(pair.range)])
        shift = wall.simulated.find_shift(length, range_, "exponential", lacking)
        length *= np.exp(shift)
        (index,) = states.find_deepest(length, range_)
        # The potential of the gaps shown, of which bins have their mean, and the energy stored.
        attracted = np.exp(-state.gap / range_).mean()
        share = attracted - states.elastic_energy[index] / length
        assert share == pytest.approx(states.share(length, range_), abs=0.02)
        assert state.area == pytest.approx(states.gap_share[index, 0], abs=0.02)
        assert state.gap.shape == (32, 32)
    # The tape is softer than the gel at 1 Hz, and touches more. The last state is that of its
    # threshold, where both are between.
    tape, gel, threshold = (state.area for state in contact.states)
    assert gel < threshold < tape
    assert contact.threshold_of == "soft tape"
    assert contact.states[-1].title == "soft tape at its threshold"


@pytest.mark.slow
def test_the_file_keeps_the_map_as_it_lies(single):
    """In surfaces that touch at the summit, the first state, gaps follow from the heights."""
    data = single.data
    unit = float(data.standard_height_unit.isel(part=0))
    heights = unit * data.standard_heights.values
    bins = data.trial_gap_bin.isel(trial=0).values
    gap = data.trial_gap.isel(part=0, trial=0).values[bins]
    # A bin ends at 1.17 times its beginning.
    np.testing.assert_allclose(gap, heights.max() - heights, rtol=0.17)


@pytest.mark.slow
def test_page_shows_the_contact_that_decided(single, folder):
    film = check_material(GEL | {"label": "film", "thickness": "1 um"})
    rough = check_material(STEEL | {"label": "rough", "surface": "plate"})
    materials = {"tape": TAPE, "film": film}
    page = write_page(single, folder / "shown", materials)
    page.check("Where it touches", "The contact of film is not shown", "by 32 points")
    assert page.html.count('alt="Contact on the measured heights at zero load"') == 2
    assert len(page.html) < 1e6
    assert "Bokeh" not in page.html
    pairs = judge_data(single.data, {"film": film, "rough": rough})
    contact = contact_figure.find_contact(single.data, pairs)
    assert contact.states == []
    assert contact.not_kept == ["film"]  # theory decided on two rough solids
    # Files of older versions keep no gaps.
    pairs = judge_data(single.data, {"tape": TAPE})
    without = single.data.drop_vars("trial_gap_bin")
    assert contact_figure.find_contact(without, pairs).not_kept == ["soft tape"]


@pytest.mark.slow
def test_states_of_a_layer_are_shown_where_they_are_at_hand(single):
    film = Material(
        youngs_modulus="3 MPa",
        poisson_ratio=0.5,
        thickness="1 um",
        work_of_adhesion="0.1 J/m^2",
        range="0.3 nm",
    )
    wall = Surface(single.data)
    pairs = judge({"film": film}, {"plate": wall}, curves=False, thresholds=False)
    rough = find_roughness(film, wall, find_family(film, wall))
    assert rough.simulated is not wall.simulated
    given = {"film": contact_figure.Simulated(rough.simulated, rough.lacking)}
    contact = contact_figure.find_contact(single.data, pairs.sel(surface="plate"), given)
    is_among = [
        any(
            np.array_equal(contact.states[0].gap, states.find_gap(k))
            for k in range(len(states.gap))
        )
        for states in (rough.simulated.whole, wall.simulated.whole)
    ]
    assert is_among == [True, False]
    assert contact.not_kept == []


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


def test_contact_is_orange_and_the_first_row_on_top():
    gap = np.full((8, 4), 1e-6)
    gap[:, 0] = 0.0
    state = contact_figure.State("tape", gap)
    contact = contact_figure.Contact([state], (8e-3, 4e-3), "", [])
    with plotting.open_figure([], "A", 2) as panels:
        contact_figure.draw_state(panels["A"], contact, state)
        (image,) = panels["A"].images
        assert panels["A"].get_ylim() == (4.0, 0.0)
        assert panels["A"].get_title() == "tape\nabout 25 % in contact"
        assert to_hex(panels["A"].get_facecolor()) == plotting.RED.lower()
    assert image.get_array().mask[0].all()
    np.testing.assert_allclose(image.get_array()[1:].compressed(), 1.0)  # um
