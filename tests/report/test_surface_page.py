"""From a file to a page: measured surfaces as the workflow analyses, judges and shows them."""

import json
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
import xarray as xr
from helpers.pages import Page, make_job
from real_surfaces.measured_maps import MeasuredMap

from common import contact_picture, conventions
from criteria import judge_surface
from real_surfaces import contact_measured, picture_contact
from report import surface_figures, write_surface
from stickiness import Material, Surface, datasets, judge, surface
from stickiness.criteria.pair import NOT_JUDGED, STICKY, TOUCHES
from stickiness.entries import check_material, check_surface
from stickiness.formatting import in_unit, limited, number, with_error
from stickiness.measured import topography
from stickiness.pages.rows import describe_pair, list_rates
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.spectrum import SelfAffine
from stickiness.verdicts.limits import read_limited

pytestmark = pytest.mark.usefixtures("coarse_simulation")

STEEL = {"label": "steel", "plane_strain_modulus": "230 GPa", "work_of_adhesion": "0.1 J/m^2"}
STEEL |= {"range": "0.3 nm"}
SERIES = {"equilibrium": "10 kPa", "terms": [["100 GPa", "1 ms"]]}
GEL = {"label": "gel <soft>", "youngs_modulus_prony": SERIES, "poisson_ratio": 0.5}
GEL |= {"work_of_adhesion": "50 mJ/m^2", "range": "0.3 nm"}
MATERIALS = {"gel": check_material(GEL), "steel": check_material(STEEL)}
TAPE = check_material(STEEL | {"label": "soft tape", "plane_strain_modulus": "1 MPa"})
WALL = {"kind": "self_affine", "hurst": 0.8, "shortest_wavelength": "1 um"}
FREQUENCIES = {"minimum": 1e-4, "maximum": 1e6, "per_decade": 2}


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
    """Verdicts of all materials on one surface."""
    solids = {name: Material.from_entry(entry) for name, entry in materials.items()}
    frequencies = np.geomspace(1e-4, 1e6, 21)
    return judge(solids, {"plate": Surface(data)}, frequencies=frequencies).sel(surface="plate")


def write_page(analysed, folder, materials=MATERIALS, bem=None, **pictures):
    """The page of an analysed surface, by the rules that judge it and write it."""
    parameters = {"surface": "plate"}
    surface_file = str(folder / "plate.nc")
    datasets.write(analysed.data, surface_file, title="a", parameters=parameters)
    judged = {"verdicts": str(folder / "verdicts.nc"), "contact_laws": str(folder / "laws.json")}
    params = {"materials": materials, "labels": {"plate": analysed.entry["label"]}}
    inputs = {"surface": surface_file, "material_surfaces": []}
    wildcards = {"real_surface": "plate"}
    more = {"material_surfaces": [], "frequencies": FREQUENCIES}
    judge_surface.main(make_job(inputs, judged, wildcards, **params, **more))

    inputs = {"template": "report/surface.html.j2", "surface": surface_file, **judged, **pictures}
    if bem is not None:
        inputs["measured_contact"] = str(folder / "bem.nc")
        datasets.write(bem, inputs["measured_contact"], title="a", parameters=parameters)
    outputs = {"page": str(folder / "report/surfaces/plate.html")}
    outputs |= {name: str(folder / f"{name}.png") for name in ("figure", "curves")}
    write_surface.main(make_job(inputs, outputs, wildcards, surface=analysed.entry, **params))
    return Page(Path(outputs["page"]).read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("plate")


@pytest.fixture(scope="module")
def single(folder):
    return analyse(folder / "single.nc", file=scan(folder / "a.txt"))


@pytest.fixture(scope="module")
def page(single, folder):
    return write_page(single, folder)


@pytest.fixture(scope="module")
def pairs(single):
    """Verdicts on the surface of a single scan."""
    return judge_data(single.data)


@pytest.mark.slow
def test_stitched_surface_keeps_its_measurements_and_names_every_file(folder):
    files = [
        {"file": scan(folder / "b.txt", seed=2)},
        {"file": scan(folder / "c.txt", seed=3), "length": "15 um"},
    ]
    stitched = analyse(folder / "both.nc", measurements=files, detrend="quadratic")
    assert stitched.data.sizes["measurement"] == 2
    # 15 um instead of 40 um with the same heights are another, steeper surface: C is lower by
    # (15/40)^4 at wave numbers higher by 40/15, which is not on the same line.
    assert 0.3 < float(stitched.data.scatter) < np.inf
    page = write_page(stitched, folder)
    page.check()
    assert "b.txt" in page.html
    assert "c.txt" in page.html


@pytest.mark.slow
def test_law_carried_on_reaches_its_end_and_opens_up(folder):
    on = analyse(folder / "on.nc", file=scan(folder / "a.txt"), extend_to="10 nm")
    data = on.data
    assert float(data.q1) == pytest.approx(2 * np.pi / 10e-9)
    assert float(data.wave_number[-1]) == pytest.approx(float(data.q1))
    smooth, rough = data.psd.values
    beyond = data.wave_number.values > float(data.q_cutoff) * 1.001
    np.testing.assert_allclose(rough[~beyond], smooth[~beyond])
    ratio = rough[beyond] / smooth[beyond]
    assert np.all(np.diff(ratio) > 0)
    write_page(on, folder).check("10 nm")


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


def tell(pair, quantity, unit):
    return limited(*read_limited(pair[quantity]), in_unit(unit))


@pytest.mark.slow
def test_the_page_tells_what_would_make_pairs_stick(page, folder):
    """As the files say it, which hold no NaN."""
    stored = datasets.read(folder / "verdicts.nc").sel(surface="plate")
    laws = json.loads((folder / "laws.json").read_text(), parse_constant=pytest.fail)
    assert laws["surface"] == "plate & co"
    for (name, entry), law in zip(MATERIALS.items(), laws["pairs"], strict=True):
        pair = stored.sel(material=name)
        for quantity, unit in (("rms_height_threshold", "m"), ("contact_pressure", "Pa")):
            page.check(tell(pair, quantity, unit))
        if name == "gel":
            page.check(tell(pair, "rate_threshold", "Hz"))
        assert np.isnan(pair.rate_threshold).all() == (name != "gel")
        assert law["material"] == entry["label"]
        assert law["modulus"]["value"] == float(pair.modulus_quoted)
        _, *limits = read_limited(pair.remaining * pair.work_of_adhesion)
        work = law["effective_work_of_adhesion"]
        assert [work["low"], work["high"]] == pytest.approx(limits)
        assert law["pull_off_stress"]["low"] == read_limited(pair.pull_off).low


def test_page_of_a_material_with_a_dwell_has_its_ratio_and_thresholds(folder):
    """Acrylic tape on a rough wall, at 1 Hz and after an hour."""
    series = {"equilibrium": "54 kPa", "terms": [["126 kPa", "400 s"]]}
    tape = GEL | {"label": "tape", "youngs_modulus_prony": series, "work_of_adhesion": "70 mJ/m^2"}
    rested = tape | {"label": "rested tape", "dwell": "3600 s"}
    materials = {"tape": check_material(tape), "rested": check_material(rested)}
    wall = WALL | {"longest_wavelength": "10 mm", "h_rms": "45 um"}
    analysed = analyse(folder / "wall.nc", **wall)
    codes = judge_data(analysed.data, materials).verdict
    assert codes.values.tolist() == [TOUCHES, STICKY]
    write_page(analysed, folder / "rested", materials).check(
        "allow for up to 3.3 times the work",
        "70 kPa; its modulus after 1 h of dwell is 54 kPa",
        "82 kPa (70 to 98 kPa)",
        "82 kPa (70 to 140 kPa)",
        "E = 180 kPa",
    )


@pytest.mark.slow
def test_profiles_and_parametric_surfaces_have_pages(folder):
    s = SelfAffine(hurst=0.8, q0=1.0, q1=200.0, h_rms=300.0)
    h = surface.synthesise(s, n=512, length=2 * np.pi, seed=8)[:, 9]
    (folder / "line.txt").write_text("\n".join(f"{0.1 * i:.2f}\t{z:.3f}" for i, z in enumerate(h)))
    units = {"height_unit": "nm", "position_unit": "um"}
    line = analyse(folder / "line.nc", file=str(folder / "line.txt"), **units)
    assert "anisotropy" not in line.data
    write_page(line, folder).check()
    sand = WALL | {"longest_wavelength": "1 mm", "h_rms": ["1 um", "3 um"]}
    write_page(analyse(folder / "sand.nc", **sand), folder).check("rms height 1 … 3 µm")


@pytest.mark.slow
def test_page_tells_of_steep_slopes_missing_points_and_contact_of_periodic_heights(single, folder):
    q0 = float(single.data.q0)
    period = 2 * np.pi / q0
    s = SelfAffine(hurst=0.8, q0=q0, q1=8 * q0, h_rms=1e-6)
    heights = surface.synthesise(s, n=32, length=period, seed=1)
    given = topography.Topography(heights, period / 32, period / 32, "here")
    gel = {"plane_strain_modulus": "25 MPa", "work_of_adhesion": "50 mJ/m^2", "range": "0.2 um"}
    bem = {"periodic": True, "pressures": ["100 kPa"], "adhesion": gel}
    entry = check_surface({"kind": "measured", "file": "here", "bem": bem})
    contact = contact_measured.solve(
        given,
        q0,
        q_max=1.0,
        bem=entry["bem"],
        ranges=np.geomspace(0.01, 1, 9),
        pixels=4,
        tolerance=1e-4,
        gamma=0.45,
    )
    odd = single.data.assign(
        rms_slope=single.data.rms_slope.copy(data=[1.9, 2.1]),
        q1=100 * single.data.q1,
        missing_fraction=single.data.missing_fraction.copy(data=0.29),
    )
    odd = odd.assign_attrs(remarks="h_rms is small; C falls as q^-5.3")
    contact = conventions.annotate(contact, **contact_measured.VARIABLE_TEXTS)
    page = write_page(single._replace(data=odd), folder, bem=contact)
    page.check("2.00 ± 0.16", "29 %", "100 kPa")


@pytest.mark.slow
def test_an_implausible_surface_is_not_judged_and_its_page_says_why(folder):
    zeros = {(i, j): 0 for i in range(0, 128, 5) for j in range(0, 128, 4)}
    file = scan(folder / "zeros.txt", spoiled=zeros)
    withheld = analyse(folder / "zeros.nc", file=file)
    pairs = judge_data(withheld.data)
    assert (pairs.verdict == NOT_JUDGED).all()
    assert np.isnan(pairs.probability).all()
    assert not pairs.disagrees.any()
    gel = {"gel": check_material(GEL | {"range": "0.3 um"})}
    text = write_page(withheld, folder, gel).text
    assert "0.3 µm" in text
    assert "missing_value: 0" in text
    assert not surface_figures.find_curves(pairs, {"gel": "gel"}, ["gel"])
    row = describe_pair(pairs.sel(material="gel"), MATERIALS["gel"])
    assert row["text"]["remaining"] == "–"
    ignored = analyse(folder / "told.nc", file=file, plausibility="ignore")
    assert (judge_data(ignored.data).verdict != NOT_JUDGED).all()


def test_a_pair_is_not_judged_if_the_surface_of_its_material_is_not(single):
    spiky = Surface(single.data.assign_attrs(not_judged="a spike"))
    steel = Material.from_entry(MATERIALS["steel"] | {"surface": "spiky"}, {"spiky": spiky})
    verdicts = judge([steel], [Surface(single.data)], curves=False, thresholds=False)
    assert verdicts.verdict == NOT_JUDGED
    assert verdicts.not_judged == "a spike"


@pytest.mark.slow
def test_page_has_all_rms_heights_and_the_spikes(single, folder):
    spiky = analyse(folder / "spike.nc", file=scan(folder / "spike.txt", spoiled={(70, 60): 1e6}))
    assert int(spiky.data.masked_spikes) == 1
    write_page(spiky, folder).check("rms height with the points not used 7.8")
    np.testing.assert_allclose(spiky.data.h_rms, single.data.h_rms, rtol=1e-3)


@pytest.mark.slow
def test_the_page_has_pictures_of_a_map_as_read_and_as_used(page, folder):
    assert 'id="reading"' in page.html
    profile = folder / "profile.txt"
    heights = surface.synthesise(SelfAffine(hurst=0.8, q0=1, q1=50, h_rms=9), 512, 6.3, seed=1)
    np.savetxt(profile, heights[0])
    line = analyse(folder / "line.nc", file=str(profile), length="40 um", height_unit="nm")
    assert 'id="reading"' not in write_page(line, folder).html


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
    labels = {name: MATERIALS[name]["label"] for name in ("steel", "gel")}
    curves_by_axis = surface_figures.find_curves(pairs, labels, ["gel"])
    assert [curve.shown for curve in curves_by_axis["modulus"]] == [False, True]
    shown = {axis: [curve.label for curve in curves] for axis, curves in curves_by_axis.items()}
    both = ["steel", "gel <soft>"]
    assert shown == {"modulus": both, "roughness": both, "rate": ["gel <soft>"]}
    at_pair = 100 * pairs.remaining.sel(material="gel").values
    for axis, curves in curves_by_axis.items():
        drawn = curves[-1].own
        np.testing.assert_allclose(drawn[["low", "value", "high"]], at_pair, rtol=1e-9)
        assert drawn.x == pytest.approx(5.3 if axis == "modulus" else 1, rel=0.01)


@pytest.mark.slow
def test_rates_of_the_page_follow_the_modulus(pairs):
    pair = pairs.sel(material="gel")
    solid = Material.from_entry(MATERIALS["gel"])
    np.testing.assert_allclose(pair.modulus, solid.plane_strain.storage(pair.frequency.values))
    # Within the limits of the threshold some rates may stick, and where the verdict is "sticks",
    # 1 Hz is among those that stick.
    rates = list_rates(pair)
    assert (rates[0] > 1) == (read_limited(pair.remaining).low >= DEFAULT_SHARE)
    _, *limits = read_limited(pair.modulus_threshold)
    np.testing.assert_allclose(solid.plane_strain.storage(np.array(rates)), limits, rtol=0.1)


@pytest.fixture(scope="module")
def pictures(single, folder):
    """Files of contact and pull-off, of coarser and higher heights, which are solved faster."""
    s = SelfAffine(hurst=0.8, q0=6.0, q1=16.0, h_rms=1e-6)
    h = surface.synthesise(s, n=64, length=2 * np.pi, seed=4)
    heights = topography.Topography(h, 40e-6 / 64, 40e-6 / 64, "here")
    measured = MeasuredMap(heights, cutoff=2 * np.pi / 2.5e-6)
    q0 = float(single.data.q0)
    rough = picture_contact.prepare(measured, 128)
    contact = picture_contact.press(rough, q0, measured.cutoff)
    pull_off = picture_contact.separate(
        picture_contact.prepare(measured, 64),
        Material.from_entry(TAPE),
        q0=q0,
        q1=float(single.data.q1),
        squeeze=0.1,
    )
    return save_pictures(folder, contact.assign_attrs(measurement="data/b.txt"), pull_off)


def save_pictures(folder, contact, pull_off):
    paths = {name: str(folder / f"{name}.nc") for name in ("contact", "pull_off")}
    datasets.write(contact, paths["contact"], title="a", parameters={"surface": "plate"})
    parameters = {"surface": "plate", "material": "tape", **TAPE}
    datasets.write(pull_off, paths["pull_off"], title="a", parameters=parameters)
    still = str(folder / "plate_contact.png")
    contact_picture.draw_still(contact, pull_off, still)
    return paths | {"contact_figure": still}


@pytest.mark.slow
def test_page_shows_contact_and_pull_off(single, folder, pictures):
    pictured = write_page(single, folder / "pictured", MATERIALS | {"tape": TAPE}, **pictures)
    pull_off = datasets.read(pictures["pull_off"])
    contact = datasets.read(pictures["contact"])
    pictured.check(
        f"{100 * float(contact.area_fraction[0]):.2g}",
        f"to {100 * float(pull_off.separation.sel(limit='high')):.2g} %)",
    )
    assert "data/b.txt" in pictured.html
    assert len(pictured.html) < 4e6


@pytest.mark.slow
def test_page_says_why_there_is_no_pull_off_and_nothing_where_there_is_no_map(
    single, folder, pictures
):
    materials = MATERIALS | {"tape": TAPE}
    empty = xr.Dataset(attrs={"left_out": "nothing remains"})
    contact = datasets.read(pictures["contact"])
    place = folder / "left_out"
    page = write_page(single, place, materials, **save_pictures(place, contact, empty))
    page.check("not simulated: nothing remains.")
    page = write_page(single, place, materials, **save_pictures(place, empty, empty))
    page.check()
    assert "not simulated" not in page.text
