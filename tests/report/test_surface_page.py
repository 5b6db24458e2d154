"""From a file to a page: measured surfaces as the workflow analyses, judges and shows them."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from helpers.pages import Page, make_job

from common import contact_picture, conventions
from common.formatting import amount, number, with_error
from common.materials import read_material
from common.verdicts import find_limits
from criteria import pair_roughness, verdicts
from criteria.pair_roughness import find_doubts
from real_surfaces import analyse_surface, contact_measured, picture_contact
from report import surface_figures, write_surface
from report.table_rows import describe_pair, list_rates
from stickiness import datasets, surface
from stickiness.criteria.pair import NOT_JUDGED, SIGNS
from stickiness.measured import topography
from stickiness.remaining.prediction import DEFAULT_SHARE
from stickiness.spectrum import SelfAffine

STEEL = {"label": "steel", "plane_strain_modulus": "230 GPa", "work_of_adhesion": "0.1 J/m^2"}
STEEL |= {"range": "0.3 nm", "source": "own"}
SERIES = {"equilibrium": "10 kPa", "terms": [["100 GPa", "1 ms"]]}
GEL = {"label": "gel <soft>", "youngs_modulus_prony": SERIES, "poisson_ratio": 0.5}
GEL |= {"work_of_adhesion": "50 mJ/m^2", "range": "0.3 nm", "source": "own"}
MATERIALS = {"gel": GEL, "steel": STEEL}
TAPE = STEEL | {"label": "soft tape", "plane_strain_modulus": "1 MPa"}
WALL = {"kind": "self_affine", "hurst": 0.8, "shortest_wavelength": "1 um"}
PLATE = {"real_surface": "plate"}
FREQUENCIES = {"minimum": 1e-4, "maximum": 1e6, "per_decade": 2}


def scan(path, seed=1, spoiled=()):
    """Text file of a patch of a rough surface, in nm, with other values at some points."""
    s = SelfAffine(hurst=0.8, q0=1.0, q1=100.0, h_rms=300.0, q_rolloff=6.0)
    h = surface.synthesise(s, n=256, length=2 * np.pi, seed=seed)[:128, :128]
    for place, value in dict(spoiled).items():
        h[place] = value
    rows = "\n".join("\t".join(f"{v:.4f}" for v in row) for row in h.T)
    path.write_text("# Width: 40 µm\n# Value units: nm\n" + rows, encoding="utf-8")
    return str(path)


def analysed(path, analyse=analyse_surface.analyse, **asked):
    """The file that the rule writes, read back."""
    asked = {"kind": "measured", "label": "plate & co", "source": "own", **asked}
    datasets.write(analyse(asked), path, title="a", parameters={"surface": "plate", **asked})
    return datasets.read(path)


def judged(found, materials=MATERIALS):
    solids = {name: read_material(entry) for name, entry in materials.items()}
    return verdicts.find_verdicts(solids, {"plate": found}, {}, np.geomspace(1e-4, 1e6, 21))


def write_page(found, folder, materials=MATERIALS, bem=None, **pictures):
    """The page of an analysed surface, by the rules that judge it and write it."""
    paths = {name: str(folder / f"{name}.nc") for name in ("plate", "verdicts", "bem")}
    made = datasets.parameters(found) | {"surface": "plate"}
    datasets.write(found, paths["plate"], title="a", parameters=made)
    inputs = {"template": "report/surface.html.j2", "surface": paths["plate"]}
    inputs |= {"material_surfaces": [], **pictures}
    if bem is not None:
        datasets.write(bem, paths["bem"], title="a", parameters={"surface": "plate"})
        inputs["measured_contact"] = paths["bem"]
    outputs = {"page": str(folder / "report/surfaces/plate.html"), "verdicts": paths["verdicts"]}
    outputs |= {name: str(folder / f"{name}.png") for name in ("figure", "curves")}
    outputs["contact_laws"] = str(folder / "laws.json")
    asked = {"material_surfaces": [], "materials": materials, "frequencies": FREQUENCIES}
    asked |= {"surface": made, "labels": {"plate": made["label"]}}
    write_surface.main(make_job(inputs, outputs, wildcards=PLATE, **asked))
    return Page(Path(outputs["page"]).read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("plate")


@pytest.fixture(scope="module")
def single(folder):
    return analysed(folder / "single.nc", file=scan(folder / "a.txt"))


@pytest.fixture(scope="module")
def page(single, folder):
    return write_page(single, folder)


@pytest.fixture(scope="module")
def pairs(single):
    """Verdicts on the surface of a single scan."""
    return judged(single).sel(surface="plate")


@pytest.mark.slow
def test_stitched_surface_keeps_its_measurements_and_names_every_file(folder):
    files = [
        {"file": scan(folder / "b.txt", seed=2)},
        {"file": scan(folder / "c.txt", seed=3), "length": "15 um"},
    ]
    stitched = analysed(folder / "both.nc", measurements=files, detrend="quadratic")
    assert stitched.sizes["measurement"] == 2
    assert np.isfinite(float(stitched.scatter))
    # 15 um instead of 40 um with the same heights are another, steeper surface: C is lower by
    # (15/40)^4 at wave numbers higher by 40/15, which is not on the same line.
    assert float(stitched.scatter) > 0.3
    html = write_page(stitched, folder).html
    assert all(name in html for name in ("b.txt", "c.txt"))


@pytest.mark.slow
def test_extrapolated_law_reaches_its_end_and_opens_up(folder):
    found = analysed(folder / "on.nc", file=scan(folder / "a.txt"), extend_to="10 nm")
    assert float(found.q1) == pytest.approx(2 * np.pi / 10e-9)
    assert float(found.wave_number[-1]) == pytest.approx(float(found.q1))
    smooth, rough = found.psd.values
    beyond = found.wave_number.values > float(found.q_cutoff) * 1.001
    np.testing.assert_allclose(rough[~beyond], smooth[~beyond])
    ratio = rough[beyond] / smooth[beyond]
    assert np.all(np.diff(ratio) > 0)


@pytest.mark.slow
def test_each_end_has_its_own_a_v_where_they_differ_in_shape(single, folder):
    one, other = pair_roughness.find_a_v(single)
    assert one is other
    found = analysed(folder / "on2.nc", file=scan(folder / "a.txt"), extend_to="50 nm")
    smooth, rough = (a_v.theory[:2, 0] for a_v in pair_roughness.find_a_v(found))
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
        f"{with_error(single.hurst, single.hurst_total_error)}",
    )
    assert {link for link in page.links if not link.startswith(("#", "https://doi.org/"))} == {
        *("../../plate.nc", "../../verdicts.nc")
    }
    assert page.html.count("Bokeh.logger.set_level") == 1


@pytest.mark.slow
def test_thresholds_of_the_page_are_those_of_the_files(page, folder):
    """The files contain no NaN."""
    stored = datasets.read(folder / "verdicts.nc").sel(surface="plate")
    laws = json.loads((folder / "laws.json").read_text(), parse_constant=pytest.fail)
    assert laws["surface"] == "plate & co"
    for (name, entry), law in zip(MATERIALS.items(), laws["pairs"], strict=True):
        pair = stored.sel(material=name)
        for asked, unit in (("rms_height_threshold", "m"), ("contact_pressure", "Pa")):
            value, *limits = (amount(pair[f"{asked}{end}"], unit, 2) for end in SIGNS)
            assert "{} ({} to {})".format(value, *limits) in page.text
        rates = [amount(pair[f"rate_threshold{end}"], "Hz", 2) for end in SIGNS]
        assert ("{} ({} to {})".format(*rates) in page.text) == (name == "gel")
        assert law["material"] == entry["label"]
        assert law["modulus"]["value"] == float(pair.modulus_quoted)
        limits = [float(x * pair.work_of_adhesion) for x in find_limits(pair)]
        work = law["effective_work_of_adhesion"]
        assert [work["low"], work["high"]] == pytest.approx(limits)
        assert law["pull_off_stress"]["low"] == float(find_limits(pair, "pull_off")[0])


def test_page_of_a_material_with_a_dwell_names_it_and_shows_more_than_all_adhesion(folder):
    """Acrylic tape on a rough wall, at 1 Hz and after an hour."""
    series = {"equilibrium": "54 kPa", "terms": [["126 kPa", "400 s"]]}
    tape = {"label": "tape", "youngs_modulus_prony": series, "poisson_ratio": 0.5}
    tape |= {"work_of_adhesion": "70 mJ/m^2", "range": "0.3 nm", "source": "own"}
    rested = {"label": "rested tape", "dwell": "3600 s", "broken_at": "20 Hz"}
    wall = WALL | {"longest_wavelength": "10 mm", "h_rms": "45 um"}
    found = analysed(folder / "wall.nc", analyse_surface.self_affine, **wall)
    page = write_page(found, folder / "rested", {"tape": tape, "rested": tape | rested})
    page.check(
        *("1 Hz", "1 h", "20 Hz"),  # rates of the verdicts, and the dwell
        "3.3 (1 to 3.3)",  # factor of dissipation
        *("E = 72 kPa", "54 kPa"),  # limit of the threshold, and the relaxed modulus
        *("E = 86 kPa (72 to 110 kPa)", "E = 180 kPa"),
    )


@pytest.mark.slow
def test_profiles_and_parametric_surfaces_have_pages(folder):
    s = SelfAffine(hurst=0.8, q0=1.0, q1=200.0, h_rms=300.0)
    h = surface.synthesise(s, n=512, length=2 * np.pi, seed=8)[:, 9]
    (folder / "line.txt").write_text("\n".join(f"{0.1 * i:.2f}\t{z:.3f}" for i, z in enumerate(h)))
    units = {"height_unit": "nm", "position_unit": "um"}
    found = analysed(folder / "line.nc", file=str(folder / "line.txt"), **units)
    assert "anisotropy" not in found
    write_page(found, folder).check()
    sand = WALL | {"longest_wavelength": "1 mm", "h_rms": ["1 um", "3 um"]}
    found = analysed(folder / "sand.nc", analyse_surface.self_affine, **sand)
    page = write_page(found, folder)
    page.check("1 … 3 µm")


@pytest.mark.slow
def test_page_tells_of_steep_slopes_missing_points_and_contact_of_periodic_heights(single, folder):
    period = float(2 * np.pi / single.q0)
    s = SelfAffine(hurst=0.8, q0=2 * np.pi / period, q1=16 * np.pi / period, h_rms=1e-6)
    heights = surface.synthesise(s, n=32, length=period, seed=1)
    given = topography.Topography(heights, period / 32, period / 32, "here")
    gel = {"plane_strain_modulus": "25 MPa", "work_of_adhesion": "50 mJ/m^2", "range": "0.2 um"}
    asked = {"periodic": True, "pressures": ["100 kPa"], "adhesion": gel}
    more = {"ranges": np.geomspace(0.01, 1, 9), "pixels": 4, "tolerance": 1e-4, "gamma": 0.45}
    bem = contact_measured.solve(given, float(single.q0), 1.0, asked, **more)
    odd = single.assign(
        rms_slope=single.rms_slope.copy(data=[1.9, 2.1]),
        q1=100 * single.q1,
        missing_fraction=single.missing_fraction.copy(data=0.29),
    )
    odd = odd.assign_attrs(remarks="h_rms is small; C falls as q^-5.3")
    page = write_page(odd, folder, bem=conventions.annotate(bem, **contact_measured.VARIABLE_TEXTS))
    page.check("2.00 ± 0.16", "29 %", "100 kPa")


@pytest.mark.slow
def test_an_implausible_surface_is_not_judged_and_its_page_says_why(folder):
    zeros = {(i, j): 0 for i in range(0, 128, 5) for j in range(0, 128, 4)}
    file = scan(folder / "zeros.txt", spoiled=zeros)
    found = analysed(folder / "zeros.nc", file=file)
    pairs = judged(found).sel(surface="plate")
    assert (pairs.verdict == NOT_JUDGED).all()
    assert np.isnan(pairs.probability).all()
    assert not pairs.disagrees.any()
    text = write_page(found, folder, {"gel": GEL | {"range": "0.3 um"}}).text
    assert "range = 0.3 µm" in text
    assert "missing_value: 0" in text
    assert not surface_figures.find_curves(pairs, {"gel": "gel"}, ["gel"])
    assert describe_pair(pairs.sel(material="gel"), GEL)["text"]["remaining"] == "–"
    told = analysed(folder / "told.nc", file=file, plausibility="ignore")
    assert (judged(told).verdict != NOT_JUDGED).all()


def test_a_pair_is_not_judged_if_the_surface_of_its_material_is_not(single):
    assert find_doubts([single, None]) == ""
    assert find_doubts([single, single.assign_attrs(not_judged="a spike")]) == "a spike"


@pytest.mark.slow
def test_page_shows_the_rms_height_with_a_spike(single, folder):
    found = analysed(folder / "spike.nc", file=scan(folder / "spike.txt", spoiled={(70, 60): 1e6}))
    text = write_page(found, folder).text
    assert int(found.masked_spikes) == 1
    assert " 7.8" in text  # rms height with the spike
    np.testing.assert_allclose(found.h_rms, single.h_rms, rtol=1e-3)


@pytest.mark.slow
def test_curves_pass_through_the_pair_as_it_is(pairs):
    labels = {name: MATERIALS[name]["label"] for name in ("steel", "gel")}
    found = surface_figures.find_curves(pairs, labels, ["gel"])
    assert [one.shown for one in found["modulus"]] == [False, True]
    assert {axis: [one.label for one in curves] for axis, curves in found.items()} == {
        "modulus": ["steel", "gel <soft>"],
        "roughness": ["steel", "gel <soft>"],
        "rate": ["gel <soft>"],
    }
    at_pair = 100 * pairs.remaining.sel(material="gel", end=["rough", "smooth"]).values
    for axis, curves in found.items():
        drawn = curves[-1].own
        np.testing.assert_allclose([drawn.rough, drawn.smooth], at_pair, rtol=1e-9)
        assert drawn.x == pytest.approx(5.3 if axis == "modulus" else 1, rel=0.01)


@pytest.mark.slow
def test_rates_of_the_page_follow_the_modulus(pairs):
    pair, solid = pairs.sel(material="gel"), read_material(MATERIALS["gel"])
    np.testing.assert_allclose(pair.modulus, solid.plane_strain.storage(pair.frequency.values))
    for threshold, text in ((1e30, "at every frequency"), (1.0, "at no frequency")):
        at = pair.assign(modulus_threshold_quantile=0 * pair.margin_quantile + threshold)
        assert list_rates(solid, at) == [text]
    # Within the limits of the threshold some rates may stick, and where the verdict is "sticks",
    # 1 Hz is among those that stick.
    below, may = (re.fullmatch(r"below (.+) Hz", text)[1] for text in list_rates(solid, pair))
    raised = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
    at = [float(one.replace(" × 10", "e").translate(raised)) for one in (below, may)]
    assert (at[0] > 1) == bool(find_limits(pair)[0] >= DEFAULT_SHARE)
    moduli = solid.plane_strain.storage(np.array(at))
    limits = [float(x) for x in find_limits(pair, "modulus_threshold")]
    np.testing.assert_allclose(moduli, limits, rtol=0.1)  # of two digits


@pytest.fixture(scope="module")
def pictures(single, folder):
    """Files of contact and pull-off, of coarser and higher heights, which are solved faster."""
    s = SelfAffine(hurst=0.8, q0=6.0, q1=16.0, h_rms=1e-6)
    h = surface.synthesise(s, n=64, length=2 * np.pi, seed=4)
    heights, cutoff = topography.Topography(h, 40e-6 / 64, 40e-6 / 64, "here"), 2 * np.pi / 2.5e-6
    q0, q1 = float(single.q0), float(single.q1)
    contact = picture_contact.press(picture_contact.prepare(heights, cutoff, 128), q0, cutoff)
    rough = picture_contact.prepare(heights, cutoff, 64)
    tape = read_material(TAPE)
    pull_off = picture_contact.separate(rough, (q0, q1), tape, 0.1)
    made = {"contact": contact.assign_attrs(measurement="data/b.txt"), "pull_off": pull_off}
    return save_pictures(folder, **made)


def save_pictures(folder, contact, pull_off):
    paths = {name: str(folder / f"{name}.nc") for name in ("contact", "pull_off")}
    datasets.write(contact, paths["contact"], title="a", parameters={"surface": "plate"})
    made = {"surface": "plate", "material": "tape", **TAPE}
    datasets.write(pull_off, paths["pull_off"], title="a", parameters=made)
    still = str(folder / "plate_contact.png")
    contact_picture.draw_still(contact, pull_off, still)
    return paths | {"contact_figure": still}


@pytest.mark.slow
def test_page_shows_contact_and_pull_off(single, folder, pictures):
    pictured = write_page(single, folder / "pictured", MATERIALS | {"tape": TAPE}, **pictures)
    pull_off = datasets.read(pictures["pull_off"])
    contact = datasets.read(pictures["contact"])
    pictured.check(
        "Soft tape",  # the user's material comes first
        f"{100 * float(contact.area_fraction[0]):.2g}",
        f"to {100 * float(pull_off.separation_high):.2g} %)",
        "0.3 nm",  # range of the verdict
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
    page.check("nothing remains")
    page = write_page(single, place, materials, **save_pictures(place, empty, empty))
    page.check()
