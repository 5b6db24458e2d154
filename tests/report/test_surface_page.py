"""From a file to a page: measured surfaces as the workflow analyses and shows them."""

import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from bokeh.models import Line, Scatter
from helpers.pages import find_long_captions, find_raw_symbols

from common.formatting import number
from criteria import judging, pair_roughness
from criteria.classification import find_doubts, find_limits
from criteria.judge import describe_page
from criteria.materials import read_material
from real_surfaces import analyse_surface, contact_measured
from report import captions, remaining_curves, surface_figure, surface_texts, write_surface
from report.surface_texts import say_what_was_seen
from report.verdict_texts import describe_pair
from stickiness import datasets, surface
from stickiness.criteria.pair import NOT_JUDGED
from stickiness.measured import topography
from stickiness.spectrum import SelfAffine

TEMPLATE = Path(__file__).parents[2] / "report" / "surface.html.j2"
MATERIALS = {
    "gel": {
        "label": "gel <soft>",
        "youngs_modulus_prony": {"equilibrium": "10 kPa", "terms": [["100 GPa", "1 ms"]]},
        "poisson_ratio": 0.5,
        "work_of_adhesion": "50 mJ/m^2",
        "range": "0.3 nm",
        "source": "own",
    },
    "steel": {
        "label": "steel",
        "plane_strain_modulus": "230 GPa",
        "work_of_adhesion": "0.1 J/m^2",
        "range": "0.3 nm",
        "source": "own",
    },
}


def scan(path, seed=1, micrometres=40.0, n=128):
    """Text file of a patch of a rough surface, in nm."""
    s = SelfAffine(hurst=0.8, q0=1.0, q1=100.0, h_rms=300.0, q_rolloff=6.0)
    h = surface.synthesise(s, n=2 * n, length=2 * np.pi, seed=seed)[:n, :n]
    header = f"# Width: {micrometres} µm\n# Value units: nm\n"
    rows = "\n".join("\t".join(f"{v:.4f}" for v in row) for row in h.T)
    path.write_text(header + rows, encoding="utf-8")
    return str(path)


def analysed(path, **asked):
    """The file that the rule writes, read back."""
    asked = {"kind": "measured", "label": "plate & co", "source": "own", **asked}
    dataset = analyse_surface.annotate(analyse_surface.analyse(asked))
    datasets.write(dataset, path, title="a", parameters={"surface": "plate", **asked})
    return datasets.read(path)


def judged(found, materials=MATERIALS):
    solids = {name: read_material(entry) for name, entry in materials.items()}
    frequencies = np.geomspace(1e-4, 1e6, 21)
    return judging.find_verdicts(solids, {"plate": found}, {}, frequencies)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("plate")


@pytest.fixture(scope="module")
def single(folder):
    return analysed(folder / "single.nc", file=scan(folder / "a.txt"))


@pytest.fixture(scope="module")
def stitched(folder):
    files = [
        {"file": scan(folder / "b.txt", seed=2)},
        {"file": scan(folder / "c.txt", seed=3), "length": "15 um"},
    ]
    return analysed(folder / "both.nc", measurements=files, detrend="quadratic")


def page_of(found, folder, bem=None, **pictures):
    pairs = judged(found).sel(surface="plate")
    surface_figure.draw_surface(found, folder / "plate.png")
    return write_surface.render(
        TEMPLATE,
        folder / "report/surfaces/plate.html",
        files={
            "surface": folder / "plate.nc",
            "verdicts": folder / "verdicts.nc",
            "measured_contact": folder / "contact.nc" if bem is not None else "",
        },
        surface=found,
        pairs=pairs,
        materials=MATERIALS,
        figures={
            "surface": captions.embed_figure(folder / "plate.png", write_surface.CAPTION),
            **(pictures or {"curves": draw_curves(pairs, folder)}),
        },
        bem=bem,
    )


def draw_curves(pairs, folder):
    return write_surface.draw_curves(pairs, MATERIALS, folder / "plate_curves.png")


@pytest.fixture(scope="module")
def page(single, folder):
    return page_of(single, folder)


@pytest.fixture(scope="module")
def pairs(single):
    """Verdicts on the surface of a single scan."""
    return judged(single).sel(surface="plate")


def test_measured_surface_says_all_that_the_criteria_need(single):
    assert set(judging.OF_SURFACES) <= set(single.variables)
    assert float(single.h_rms.sel(end="smooth")) < float(single.h_rms.sel(end="rough"))
    # The scan is a quarter of a periodic surface of 80 um with an rms height of 300 nm.
    assert float(single.h_rms_measured) == pytest.approx(300e-9, rel=0.5)
    assert float(single.q_cutoff) == float(single.q1)
    assert single.heights.dims == ("x", "y")
    assert np.std(single.h_rms_draws) > 0


def test_stitched_surface_keeps_its_measurements(stitched):
    assert stitched.sizes["measurement"] == 2
    assert np.isfinite(float(stitched.scatter))
    # 15 um instead of 40 um with the same heights are another, steeper surface: C is lower by
    # (15/40)^4 at wave numbers higher by 40/15, which is not on the same line.
    assert float(stitched.scatter) > 0.3
    assert "2 measurements stitched" in stitched.attrs["remarks"]


def test_points_dropped_beside_missing_ones_are_told(folder, single):
    path = Path(scan(folder / "rim.txt"))
    heights = np.loadtxt(path)
    heights[39:51, 39:51] += 1e5
    heights[40:50, 40:50] = np.nan
    head = "\n".join(path.read_text(encoding="utf-8").splitlines()[:2]) + "\n"
    path.write_text(head, encoding="utf-8")
    with path.open("a", encoding="utf-8") as file:
        np.savetxt(file, heights, delimiter="\t")
    found = analysed(folder / "rim.nc", file=str(path))
    assert int(found.dropped_points) == 12**2 - 10**2
    assert "44 points" in found.attrs["remarks"]
    assert (
        dict(write_surface.list_parameters(found))["dropped beside missing points"] == "44 points"
    )
    assert float(found.h_rms_measured) == pytest.approx(float(single.h_rms_measured), rel=0.05)


def test_law_carried_on_reaches_its_end_and_opens_up(folder):
    found = analysed(folder / "on.nc", file=scan(folder / "a.txt"), extend_to="10 nm")
    assert float(found.q1) == pytest.approx(2 * np.pi / 10e-9)
    assert float(found.wave_number[-1]) == pytest.approx(float(found.q1))
    smooth, rough = found.psd.values
    beyond = found.wave_number.values > float(found.q_cutoff) * 1.001
    np.testing.assert_allclose(rough[~beyond], smooth[~beyond])
    ratio = rough[beyond] / smooth[beyond]
    assert np.all(np.diff(ratio) > 0)
    assert "extrapolated, not measured" in found.attrs["remarks"]


def test_each_end_has_its_own_a_v_where_they_differ_in_shape(single, folder):
    one, other = pair_roughness.find_a_v(single)
    assert one is other
    found = analysed(folder / "on2.nc", file=scan(folder / "a.txt"), extend_to="50 nm")
    smooth, rough = (a_v.theory[:2, 0] for a_v in pair_roughness.find_a_v(found))
    # The rough end has the lower H, and a_V of the edges grows as zeta^((5H - 3)/3): both variants
    # of the theory have it lower there, by some per cent.
    assert np.all(rough < 0.99 * smooth)


@pytest.mark.slow
def test_profile_goes_all_the_way(folder):
    s = SelfAffine(hurst=0.8, q0=1.0, q1=200.0, h_rms=300.0)
    h = surface.synthesise(s, n=512, length=2 * np.pi, seed=8)[:, 9]
    (folder / "line.txt").write_text("\n".join(f"{0.1 * i:.2f}\t{z:.3f}" for i, z in enumerate(h)))
    found = analysed(
        folder / "line.nc",
        file=str(folder / "line.txt"),
        height_unit="nm",
        position_unit="um",
    )
    assert "line profile: isotropy is assumed" in found.attrs["remarks"]
    assert "anisotropy" not in found
    assert "line profile" in page_of(found, folder)


@pytest.mark.slow
def test_page_shows_verdicts_errors_and_reasons(single, folder):
    steep = single.assign(rms_slope=single.rms_slope.copy(data=[1.9, 2.1]))
    page = page_of(steep, folder)
    text = re.sub(r"<(style|script)\b.*?</\1>|<[^>]+>", " ", page, flags=re.S)
    text = text.replace("\u00a0", " ")
    assert "gel &lt;soft&gt;" in page
    assert "plate &amp; co" in page
    for words in ("Hurst exponent H", "shortest wavelength of the instrument", "half the Nyquist"):
        assert words in text
    for name in ("Dahlquist", "Pastewka–Robbins", "Fuller–Tabor", "Persson–Tosatti"):
        assert name in text
    assert "considers no roughness at all" in text
    assert "The rms slope is 2.00 ± 0.16. Linear elasticity and small slopes are assumed" in text
    assert "E* = 230 GPa" in text
    # Steel is stiff and does not stick; the gel is soft at 1 Hz and stiff beyond its relaxation.
    assert re.search(r"sticks\s+below [\d. ×⁰-⁹]+ Hz", text)
    words = " ".join(text.split())
    assert "Steel does not stick: nothing of its work of adhesion remains." in words
    assert re.search(r"For gel &lt;soft&gt; it depends: [\d. …]+ % \([\d.]+ to [\d.]+ %\)", text)
    assert "†" not in text


@pytest.mark.slow
def test_page_shows_contact_with_adhesion_of_periodic_heights(single, folder):
    period = float(2 * np.pi / single.q0)
    s = SelfAffine(hurst=0.8, q0=2 * np.pi / period, q1=16 * np.pi / period, h_rms=1e-6)
    heights = surface.synthesise(s, n=32, length=period, seed=1)
    given = topography.Topography(heights, period / 32, period / 32, "here")
    gel = {"plane_strain_modulus": "25 MPa", "work_of_adhesion": "50 mJ/m^2", "range": "0.2 um"}
    setting = contact_measured.Setting(
        pressures=np.array([1e5]) / 25e6,
        absolute=True,
        material=read_material(gel),
        ranges=np.geomspace(0.01, 1, 9),
        pixels=4,
        tolerance=1e-4,
        gamma=0.45,
        ways=("given",),
        own_grid=True,
    )
    bem = contact_measured.solve(given, float(single.q0), 1.0, setting)
    page = page_of(single, folder, contact_measured.annotate(bem))
    text = words_of(page)
    assert "The heights are periodic as they stand" in text
    assert "The same contact with full adhesion" in text
    assert "100 kPa" in text
    assert "tapered" not in text


def spoiled(path, values):
    """The scan with some heights replaced, by row and column of the file."""
    lines = Path(scan(path)).read_text(encoding="utf-8").splitlines()
    for (row, column), value in values.items():
        fields = lines[2 + row].split("\t")
        lines[2 + row] = "\t".join([*fields[:column], str(value), *fields[column + 1 :]])
    path.write_text("\n".join(lines), encoding="utf-8")
    return str(path)


def words_of(page):
    return " ".join(re.sub(r"<(style|script)\b.*?</\1>|<[^>]+>", " ", page, flags=re.S).split())


@pytest.mark.slow
def test_an_implausible_surface_is_not_judged_and_its_page_says_why(folder):
    zeros = {(i, j): 0 for i in range(0, 128, 4) for j in range(0, 128, 5)}
    found = analysed(folder / "zeros.nc", file=spoiled(folder / "zeros.txt", zeros))
    pairs = judged(found).sel(surface="plate")
    assert (pairs.verdict == NOT_JUDGED).all()
    assert np.isnan(pairs.probability).all()
    assert not pairs.disagrees.any()
    text = words_of(page_of(found, folder))
    assert "Not judged. The measurement has what no surface has" in text
    assert "of the points have the one value 0" in text
    assert "give missing_value: 0" in text
    assert "does not stick" not in text
    assert "sticks below" not in text
    assert "Criteria that disagree" not in text
    assert "Verdict at" not in text
    assert (
        describe_pair(pairs.sel(material="gel")).keys()
        == (
            describe_pair(
                judged(found.assign_attrs(not_judged="")).sel(material="gel", surface="plate")
            )
        ).keys()
    )
    rows = describe_page(judged(found), MATERIALS, {"plate": "plate"})["pairs"]
    assert ("steel", "plate", "not judged", "–") in [row[:4] for row in rows]
    told = analysed(
        folder / "told.nc", file=spoiled(folder / "zeros.txt", zeros), plausibility="ignore"
    )
    assert (judged(told).verdict != NOT_JUDGED).all()


def test_a_pair_is_not_judged_if_the_surface_of_its_material_is_not(single, folder):
    doubtful = single.assign_attrs(not_judged="a spike")
    materials = {"a": read_material(MATERIALS["steel"]), "b": read_material(MATERIALS["steel"])}
    materials["b"] = replace(materials["b"], surface="own")
    doubts = find_doubts(materials, {"plate": single}, {"own": doubtful})
    assert doubts.values.tolist() == [[""], ["a spike"]]


@pytest.mark.slow
def test_page_names_all_rms_heights_and_the_spikes(single, page, folder):
    assert "the same with the points not used" not in words_of(page)
    found = analysed(folder / "spike.nc", file=spoiled(folder / "spike.txt", {(60, 70): 1e6}))
    text = words_of(page_of(found, folder))
    for words in (
        *("rms height by the spectrum, up to q 1", "rms height of the levelled heights"),
        *("the same with the points not used 7.8", "spikes, not used 1 points"),
        "(spikes: keep uses them)",
    ):
        assert words in text
    assert "not judged" not in text
    np.testing.assert_allclose(found.h_rms, single.h_rms, rtol=1e-3)


@pytest.mark.slow
def test_page_shows_no_raw_symbol_and_short_captions(single, folder, monkeypatch):
    monkeypatch.setitem(MATERIALS["gel"], "label", "gel, l_a = 0.05 range")
    made = datasets.parameters(single) | {"label": "C0 = 10⁻³ m^0.4"}
    found = single.assign_attrs(
        parameters=json.dumps(made), remarks="h_rms is small; C falls as q^-5.3"
    )
    page = page_of(found, folder)
    assert find_raw_symbols(page) == []
    assert "<title>C₀\u00a0=\u00a010⁻³\u00a0m⁰·⁴" in page
    assert find_long_captions(page) == []


@pytest.mark.slow
def test_page_fetches_nothing(page):
    assert "<script src" not in page
    files = {"../report.html", "../../plate.nc", "../../verdicts.nc"}
    written = re.sub(r"<script\b.*?</script>", "", page, flags=re.S)
    for address in re.findall(r'(?:src|href)="([^"]*)"', written):
        assert address in files or address.startswith(("#", "data:", "https://doi.org/10."))


@pytest.mark.slow
def test_page_shows_what_remains_of_judged_pairs_alone(page, pairs):
    assert page.count("Bokeh.logger.set_level") == 1
    assert 'id="curves"' in page
    labels = {name: MATERIALS[name]["label"] for name in ("steel", "gel")}
    found = remaining_curves.trace_all(pairs, labels)
    assert {axis: [one.label for one in traces] for axis, traces in found.items()} == {
        "modulus": ["steel", "gel <soft>"],
        "roughness": ["steel", "gel <soft>"],
        "rate": ["gel <soft>"],
    }
    for axis, traces in found.items():
        gel = traces[-1]
        drawn = [gel.rough[gel.own], gel.smooth[gel.own]]
        at_pair = pairs.remaining.sel(material="gel", end=["rough", "smooth"]).values
        np.testing.assert_allclose(drawn, 100 * at_pair, rtol=1e-9)
        assert gel.at[gel.own].endswith("E* = 5.3 MPa") == (axis != "roughness")
    withheld = pairs.assign(verdict=pairs.verdict * 0 + NOT_JUDGED)
    assert remaining_curves.draw_interactive(withheld, labels) is None


@pytest.mark.slow
def test_three_materials_are_shown_at_first(pairs):
    five = xr.concat([pairs.sel(material="gel")] * 5, "material").assign_coords(
        material=list("abcde")
    )
    tabs = remaining_curves.draw_interactive(five, {name: name for name in "abcde"})
    for panel in tabs.tabs:
        (legend,) = panel.child.legend
        assert legend.click_policy == "hide"
        visible = [{r.visible for r in item.renderers} for item in legend.items]
        assert visible == [{True}] * 3 + [{False}] * 2
        looks = {
            tuple(
                str(getattr(r.glyph, "line_dash" if isinstance(r.glyph, Line) else "marker"))
                for r in item.renderers
                if isinstance(r.glyph, Line | Scatter)
            )
            for item in legend.items
        }
        assert len(looks) == 5


@pytest.mark.slow
def test_threshold_of_a_stitched_surface_has_the_errors_of_its_margin(stitched):
    """Measurements that differ widen both, beyond what the model alone does."""
    pair = judged(stitched).sel(surface="plate", material="steel")
    shown = describe_pair(pair)
    thresholds = np.array([float(x) for x in find_limits(pair, "modulus_threshold")])
    margins = np.array([float(x) for x in find_limits(pair, "margin")])
    np.testing.assert_allclose(thresholds, float(pair.modulus_quoted) * margins)
    text = " to ".join(number(float(x) / 1e6, 2) for x in thresholds)
    assert shown["threshold"].endswith(f"({text})")
    of_model = float(pair.modulus_threshold_high.max() / pair.modulus_threshold_low.min())
    assert thresholds[1] / thresholds[0] > 1.5 * of_model


@pytest.mark.slow
def test_page_of_a_stitched_surface_names_every_file(stitched, folder):
    page = page_of(stitched, folder)
    assert "b.txt" in page
    assert "c.txt" in page
    assert "factor between measurements in C" in page


@pytest.mark.slow
def test_page_of_a_parametric_surface(folder):
    asked = {
        "kind": "self_affine",
        "label": "sand",
        "hurst": 0.8,
        "longest_wavelength": "1 mm",
        "shortest_wavelength": "1 um",
        "h_rms": ["1 um", "3 um"],
        "source": "own",
    }
    dataset = analyse_surface.annotate(analyse_surface.self_affine(asked))
    datasets.write(dataset, folder / "sand.nc", title="a", parameters=asked)
    page = page_of(datasets.read(folder / "sand.nc"), folder)
    assert "sand" in page
    assert "half the Nyquist" not in page


@pytest.mark.slow
def test_error_of_the_share_by_the_spectrum_is_part_of_what_was_drawn(pairs):
    pair = pairs.sel(material="gel")
    error = float(pair.remaining_error.sel(source="sampling", end="rough"))
    low, _, high = pair.remaining_quantile.values
    # The draws have the errors of the model as well.
    assert 0 < error < (high - low) / 2
    relative = error / float(pair.remaining.sel(end="rough"))
    stress = pair.pull_off_error.sel(source="sampling", end="rough") / pair.pull_off.sel(
        end="rough"
    )
    assert float(stress) == pytest.approx(relative)


@pytest.mark.slow
def test_rates_of_the_page_follow_the_modulus(pairs):
    pair = pairs.sel(material="gel")
    solid = read_material(MATERIALS["gel"])
    at = pair.modulus.values
    np.testing.assert_allclose(at, solid.plane_strain.storage(pair.frequency.values))
    assert write_surface.describe_rate(solid, pair, [1e30]) == "sticks at every frequency"
    assert write_surface.describe_rate(solid, pair, [1.0]) == "sticks at none"


def test_errors_of_sizes_cover_what_those_of_the_fit_do():
    ends = {"end": ["smooth", "rough"], "draw": [0, 1]}
    sizes = {"h_rms": ("end", [0.9e-6, 1.1e-6]), "rms_slope": ("end", [0.19, 0.21])}
    measured = xr.Dataset(sizes, coords=ends)
    assert surface_texts.describe_height(measured) == "(1.00 ± 0.16) µm"
    assert surface_texts.describe_slope(measured) == "0.200 ± 0.016"
    assert surface_texts.describe_height(measured.drop_vars("draw")) == "0.9 … 1.1 µm"


def test_a_page_says_at_once_what_was_not_seen(single):
    said = say_what_was_seen(single)
    assert said.startswith("Measured: heights of ")
    assert said.endswith("Shorter waves are not counted; they would lower what remains.")
    longer = single.assign(q1=100 * single.q1, missing_fraction=0.29)
    said = say_what_was_seen(longer.rename(heights="profile"))
    assert "not counted" not in said
    assert "are assumed. It was measured along lines" in said
    assert said.endswith("29 % of the points are missing.")
    assert say_what_was_seen(single.drop_vars("q_cutoff")) == ""


@pytest.mark.parametrize(
    ("slopes", "words"), [([0.4, 2.3], "The rms slope is 0.4 … 2.3. "), ([0.4, 1.0], "")]
)
def test_steep_surfaces_have_a_remark(slopes, words):
    surface = xr.Dataset({"rms_slope": ("end", slopes)}, coords={"end": ["smooth", "rough"]})
    text = surface_texts.warn_of_slope(surface)
    assert text.startswith(words)
    assert ("small slopes are assumed" in text) == bool(words)
