"""The report, from small made-up results whose texts and numbers are known."""

import json
import re
from collections import defaultdict

import numpy as np
import pytest
import xarray as xr
from bokeh.models import Scatter
from helpers.entries import model_surface
from helpers.experiments import make_dataset
from helpers.pages import Page, make_job
from matplotlib.figure import Figure

from common import heights_table, remaining_models
from common.pairs import arrange_pairs
from report import pages, write_report
from stickiness import Material, datasets
from stickiness import error_budget as budget
from stickiness.criteria.pair import DEPENDS, NOT_STICKY, STICKY, TOUCHES, WORDS
from stickiness.criteria.registry import EDGES, REMAINING
from stickiness.entries import check_material, check_surface
from stickiness.formatting import number, percent
from stickiness.pages import interactive, rendering
from stickiness.pages.rows import describe_surface
from stickiness.remaining.prediction import predict
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.spectrum import SelfAffine
from stickiness.verdicts.wording import describe_material, tell_change, tell_threshold

NASTY = '<script>alert("1 & 2")</script>'
GRADES = (
    "reproduced",
    "reproduced with a qualification",
    "not reproduced",
    "not decided",
    "not checked: the configuration differs",
)


def made_by(dataset, **parameters):
    return dataset.assign_attrs(parameters=json.dumps(parameters), version_numpy="9.8.7")


def budgeted(dataset, name, **errors):
    """The dataset with a budget of one of its variables; sources left out have no part."""
    value = dataset[name] = dataset[name].assign_attrs(units="1", long_name=name)
    parts = {
        source: budget.ErrorComponent(
            xr.DataArray(errors.get(source, 0.0), dims=value.dims), "made up"
        )
        if source in errors
        else budget.not_applicable("made up")
        for source in budget.SOURCES
    }
    return budget.with_budget(dataset, name, **parts)


LAWS, TRADE = "config/accuracy.csv", "config/tradeoff.csv"
HEIGHTS = "config/heights.csv"
QUICK = {"pixels_per_wavelength": 4, "tolerance": 1e-4, "seeds": 3, "coarse_seeds": 32}
PRESETS = {
    "fidelities": {"quick": QUICK},
    "presets": {"accuracy": {"quick": 0.3}, "pressures": [0.065]},
    "surface": model_surface(hurst=0.8, magnification=64),
    "descriptor_seeds": 2048,
}


GLASS = {"kind": "self_affine", "label": "glass pane", "note": "typical", "hurst": 0.8}
GLASS |= {"h_rms": "1 um", "longest_wavelength": "10 um", "shortest_wavelength": "1 nm"}
SAND = {"kind": "measured", "label": "sand < 1 mm", "source": "own", "file": "sand.txt"}
SURFACES = {"glass": check_surface(GLASS), "sand": check_surface(SAND)}
LABELS = {name: entry["label"] for name, entry in SURFACES.items()}
JELLY = {"label": "jelly & cream", "youngs_modulus": "1 kPa", "poisson_ratio": 0.5}
IRON = {"label": "iron", "plane_strain_modulus": "2 GPa"}
BOTH = {"work_of_adhesion": "50 mJ/m^2", "range": "1 nm", "source": "own"}
MATERIALS = {"jelly": check_material(JELLY | BOTH), "iron": check_material(IRON | BOTH)}


@pytest.fixture(scope="module")
def claims():
    count = len(GRADES)
    columns = {
        "statement": [f"statement {n}" for n in range(1, count)] + [NASTY],
        "quantity": [f"quantity {n}" for n in range(count)],
        "value": [1.8912, -2.0, 3.0, 4.0, 5.0],
        "claimed": [2.0, np.nan, 3.0, 4.0, 5.0],
        "verdict": list(GRADES),
        "remark": [f"remark {n}, doi:10.1016/0043-1648(90)90154-3." for n in range(count)],
        "sources": ["out/a/x.nc", "", "out/b/seed1.nc out/b/seed2.nc", "out/a/x.nc", ""],
        "difference": ["", "", "", "", "loops.fig4a.surface: H = 0.6 (paper: 0.8)"],
    }
    data = {name: ("claim", np.array(values)) for name, values in columns.items()}
    errata = {str(number): {"some_number": 0.5} for number in range(1, 7)}
    dataset = xr.Dataset(data, coords={"claim": range(1, count + 1)})
    errors = {
        "sampling": [0.0315, np.nan, 0.1, 0.1, 0.0],
        "discretisation": [0.0102, 0.0, 0.0, 0.0, 0.0],
    }
    return made_by(budgeted(dataset, "value", **errors), errata=errata)


@pytest.fixture(scope="module")
def verdicts():
    """Jelly sticks to glass and depends on sand; iron adheres locally to glass alone.

    On sand, the other criterion says the opposite of the verdict for iron alone.
    """
    derived = [[[9.0, 8.0], [2.0, 0.5]], [[0.1, 0.1], [0.01, 0.01]]]
    other = [[[9.0, 8.0], [2.0, 0.5]], [[0.1, 0.1], [3.0, 2.0]]]
    onset = [[[9.0, 8.0], [2.0, 0.5]], [[5.0, 4.0], [0.1, 0.1]]]
    remaining = np.array([[[0.7, 0.5], [0.3, 0.02]], [[0.01, 0.01], [0.0, 0.0]]])
    dims, ones = ("material", "surface", "end"), np.ones((2, 2, 2))
    solids = list(map(Material.from_entry, MATERIALS.values()))
    thresholds = np.full((2, 2, 3), [1.6e6, 2.4e6, 4.8e6])  # of E*
    youngs = np.array([0.75, 1.0])[:, None, None]  # over E*; iron has no Poisson's ratio
    smooth, rough = np.moveaxis(remaining, -1, 0)
    limits = {
        "remaining": np.stack([0.8 * rough, rough, 1.2 * smooth], axis=-1),
        "pull_off": 1e4 * np.stack([0.5 * rough, rough, 2 * smooth], axis=-1),
        "modulus_threshold": youngs * thresholds,
        "plane_strain_modulus_threshold": thresholds,
        "pair_a_v": np.full((2, 2, 3), [2.1, 3.0, 3.9]),
        "margin": np.full((2, 2, 3), [0.5, 1.0, 2.0]),
        "rate_threshold": np.full((2, 2, 3), np.nan),
    }
    by_criterion = np.stack([derived, onset, other], axis=-1)
    dataset = xr.Dataset(
        {
            **{name: ((*dims[:2], "limit"), values) for name, values in limits.items()},
            "margin_by_criterion": ((*dims, "criterion"), by_criterion),
            "wanted_share": DEFAULT_SHARE,
            "material_label": ("material", [solid.label for solid in solids]),
            "material_doubts": ("material", ["", ""]),
            "properties": ("material", list(map(describe_material, solids))),
            "quoted_modulus": ("material", [1e3, 2e9]),
            "plane_strain_modulus": ("material", [4e3 / 3, 2e9]),
            "poisson_ratio": ("material", [0.5, np.nan]),
            "work_of_adhesion": ("material", [0.05, 0.05]),
            "work_on_smooth": ("material", [0, 0]),
            "half_space": ("material", [1, 1]),
            "range": ("material", [1e-9, 1e-9]),
            "depends_on_rate": ("material", [1, 0]),
            "dwell": ("material", [np.nan, np.nan]),
            "pair_rms_slope": (dims, 0.2 * ones),
            "stiffening": (dims, ones),
            "layer_strain": (dims, 0 * ones),
            "energy_ratio": (dims, np.array(derived) / 2),
            "verdict": (dims[:2], [[STICKY, DEPENDS], [TOUCHES, NOT_STICKY]]),
            "probability": (dims[:2], [[np.nan, 0.42], [np.nan, 0.0]]),
            "probability_low": (dims[:2], [[np.nan, 0.42], [np.nan, 0.0]]),
            "error_of_spectrum": (dims[:2], 0.3 * ones[0]),
            "error_of_map": (dims[:2], 0 * ones[0]),
            "error_of_model": (dims[:2], 0.4 * ones[0]),
            "scan": (dims[1], [np.nan, 1e-3]),
            **{name: (dims[:2], np.full((2, 2), "", "O")) for name in ("not_judged", "questions")},
            "disagrees": ((*dims[:2], "criterion"), [[[0] * 3] * 2, [[0, 1, 0], [0, 0, 1]]]),
            "decided_by": (dims[:2], [[0, 0], [0, 0]]),
        },
        coords={
            "material": ["jelly", "iron"],
            "surface": ["glass", "sand"],
            "end": ["smooth", "rough"],
            "criterion": [REMAINING, EDGES, "bearing_area"],
            "limit": ["low", "value", "high"],
        },
    )
    return made_by(dataset, pressure=0.065)


@pytest.fixture(scope="module")
def surfaces():
    known = xr.Dataset(
        {
            "h_rms": ("end", [2e-7, 2e-6]),
            "rms_slope": ("end", [0.1, 0.2]),
            "C0_reference_upper": ("end", [1e-5, 1e-3]),
            "hurst": 0.8,
            "q0": 1e3,
            "q1": 1e9,
        },
        coords={"end": ["smooth", "rough"]},
    )
    measured = known.assign(hurst=0.7, C0_reference=5.3e-3)
    for name, error in {"hurst": 0.02, "C0_reference": 4e-4}.items():
        measured = budgeted(measured, name, sampling=error)
    known = budgeted(known, "hurst")
    measured = measured.assign_attrs(remarks="noisy <spectrum>")
    return {"glass": made_by(known), "sand": made_by(measured)}


def ensemble():
    """Area 0.05 ± 0.01 ± 0.002, gap 1 ± 0.001 ± 0.02, attractive area 2 range^(2/3)."""
    ranges = np.geomspace(1e-3, 1, 20)
    area = ("pressure", "range"), np.tile(2 * ranges ** (2 / 3), (2, 1))
    data = {
        "residual": (("seed", "resolution", "pressure"), np.full((2, 2, 2), 1e-6)),
        "attractive_area_mean": area,
        **{
            f"attractive_area_{name}": (area[0], np.zeros((2, 20)))
            for name in ("standard_error", "discretisation_error")
        },
    }
    kinds = ("mean", "standard_error", "discretisation_error")
    for name, *known in (("area_fraction", 0.05, 0.01, 0.002), ("mean_gap", 1.0, 0.001, 0.02)):
        for kind, value in zip(kinds, known, strict=True):
            data[f"{name}_{kind}"] = "pressure", [value, 7.0]
    coords = {"seed": [1, 2], "resolution": [2, 4], "pressure": [0.06, 0.3], "range": ranges}
    made = {"case": "case_of_two", "hurst": 0.8, "magnification": 64, "grid_points": 256}
    made |= {"pixels_per_wavelength": 4, "tolerance": 1e-6, "largest_residual": 1e-6}
    made |= {"seeds": [1, 2], "estimator": "multilevel", "coarse_seeds": 32}
    return made_by(xr.Dataset(data, coords=coords), descriptor_seeds=100, **made)


def comparison():
    """Theory 10 % above simulation, known to 3 %, at every load."""
    dims, shape = ("variant", "pressure", "range"), (1, 5, 20)
    data = {
        f"{name}_{kind}": (dims[:count], np.full(shape[:count], value))
        for name, count in (("area_fraction", 2), ("mean_gap", 2), ("attractive_area", 3))
        for kind, value in (("difference", 0.1), ("difference_total_error", 0.03))
    }
    coords = {"variant": ["a"], "pressure": [0.01, 0.03, 0.1, 0.3, 0.5]}
    coords |= {"range": np.geomspace(1e-3, 1, 20)}
    return made_by(xr.Dataset(data, coords=coords), case="case_of_two")


def answer():
    """Area 0.05 ± 0.01 ± 0.002, gap 1 ± 0.001 ± 0.02, and a solver's part of 1e-6 in both."""
    errors = {
        "discretisation": [[0.002, 0], [0.02, 0]],
        "solver": [[1e-6, 0], [1e-6, 0]],
        "sampling": [[0.01, 0], [0.001, 0]],
    }
    values = {"value": (("column", "pressure"), [[0.05, 7.0], [1.0, 7.0]])}
    coords = {"column": ["area", "mean_gap"], "pressure": [0.06, 0.3]}
    dataset = budgeted(xr.Dataset(values, coords=coords), "value", **errors)
    made = made_by(dataset, case="case_of_two", accuracy=0.03)
    return made.assign_attrs(missed="mine: 0.2 of 0.03")


def experiments():
    """A ball that holds and is missed, and a plate that does not stick."""
    ball = {"quantity": "work_of_separation", "observed": (0.03, 0.03), "by_relation": 1}
    ball |= {"predicted": (0.02, 0.01, 0.025), "outcome": 0, "tests": 0, "effect_of_input": 1.4142}
    ball |= {"most_effective_input": "longest_wavelength", "criteria": {"violano": 2, EDGES: 0}}
    plate = {"quantity": "sticks", "observed": (0.0, 0.0), "predicted": (0.05, 0.01, 0.12)}
    return make_dataset({"ball/work": ball, "plate/steel": plate | {"criteria": {"violano": 1}}})


@pytest.fixture(scope="module")
def page(claims, verdicts, surfaces, tmp_path_factory):
    """The report on files with these results, by the names of the rule's inputs."""
    a_v = xr.Dataset({"a_v": 3.21, "a_v_total_error": 0.8})
    results = {
        "claims": claims,
        "verdicts": verdicts,
        "criterion": made_by(a_v, pressure=0.065),
        "experiments": experiments(),
        "surfaces": surfaces,
        "ensembles": {"case_of_two": ensemble()},
        "comparisons": {"case_of_two": comparison()},
        "answers": {"case_of_two": answer()},
    }
    folder = tmp_path_factory.mktemp("results")

    def save(dataset, path):
        dataset = dataset.copy(deep=True)
        for name, values in dataset.variables.items():
            values.attrs = {"units": "1", "long_name": name, "nan_means": "made up"} | values.attrs
        made = json.loads(dataset.attrs["parameters"])
        datasets.write(dataset, path, title="made up", parameters=made)
        return str(path)

    def draw(name):
        path, caption = folder / f"{name}.png", folder / f"{name}.rst"
        Figure(figsize=(2, 1)).savefig(path, dpi=50)
        caption.write_text(f"Caption of *{name}* & b < gamma. More {{words}}.\n\nDetails.")
        return str(path), str(caption)

    inputs = {"template": "report/report.html.j2", "laws": LAWS, "trade": TRADE}
    inputs["heights"] = HEIGHTS
    for kind, found in results.items():
        inputs[kind] = (
            [save(each, folder / kind / f"{name}.nc") for name, each in found.items()]
            if isinstance(found, dict)
            else save(found, folder / f"{kind}.nc")
        )
    figures = [draw(f"fig{number}") for number in range(1, 4)]
    inputs["figures"], inputs["captions"] = map(list, zip(*figures, strict=True))
    inputs["experiments_figure"], inputs["experiments_caption"] = draw("experiments")
    inputs["trade_figure"], inputs["trade_caption"] = draw("tradeoff")
    pixels = xr.Dataset(
        {"pixels_in_zone": ("adhesion_length_over_range", [4.8, 1.234])},
        coords={"adhesion_length_over_range": [0.05, 0.2]},
        attrs={"parameters": "{}"},
    )
    inputs["adhesive_maps"] = save(pixels, folder / "maps.nc")
    path = folder / "report/report.html"
    settings = {"presets": PRESETS, "fidelity": "draft", "surfaces": SURFACES}
    settings["materials"] = MATERIALS
    differs = {"here": "ε/h_rms = 0.1", "paper": "0.0075", "equal": False, "key": "adhesion.fig2"}
    settings["panels"] = [{"panel": "2G–I", "parameters": [differs]}]
    settings["figure_sources"] = {f"fig{n}": [inputs["claims"]] for n in range(1, 4)}
    write_report.main(make_job(inputs, {"page": str(path)}, **settings))
    return Page(path.read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def pairs(verdicts):
    return arrange_pairs(verdicts, LABELS)


@pytest.mark.slow
def test_the_report_shows_what_is_in_the_files(page):
    page.check(
        *(f"1 {word}" for word in (*GRADES, *WORDS[:4])),
        NASTY,
        "1 of 4 pairs",
        "3.2 Between 2.4 and 4",
        "1.891 ± 0.033 by sampling : sampling 0.032 discretisation 0.01",  # largest first
        "−2 by sampling, not known : sampling not known quantity 1",
        "area 0.050 ± 0.010 4 % < 0.01 % 20 % 0 % 0 % sampling",
        "0.3 10.0 ± 3.0 10.0 ± 3.0 10.0 ± 3.0",  # the last load of theory against simulation
        "0.700 ± 0.020",
        "E = 1 kPa, ν = 0.5",
        "1.2 pixels in the zone of attraction",
        "ε/h rms = 0.1 (paper: 0.0075) by",
        "≠ not checked: the configuration differs loops.fig4a.surface: H = 0.6 (paper: 0.8)",
        "≠ not checked: the configuration differs: the configuration changes",  # legend
        # Experiments.
        "30 mJ/m² (relation)",
        "20 mJ/m² (10 … 25 mJ/m²)",
        "(factor 1.4)",
    )
    for row in remaining_models.condense(heights_table.read(HEIGHTS))[:-1]:
        names = ("gaussian", "gaussian_little", "other", "other_little")
        errors = " ".join(percent(row[name]) for name in names)
        serves = "surface" if row["model"] in ("bound", "states") else "pair"
        page.check(f"{number(row['seconds'], 1)} s a {serves} {errors}")
    assert page.text.count("some number = 0.5") == 6
    assert NASTY not in page.html
    images = [attributes for tag, attributes in page.tags if tag == "img"]
    assert [(image["width"], image["height"]) for image in images] == [("100", "50")] * 5
    assert images[0]["alt"] == "Figure 1: Caption of fig1 & b < gamma."
    assert {"../claims.nc", "surfaces/glass.html"} <= set(page.links)
    # A value leads to the first file behind it, a closed form to the ledger.
    assert re.search(r'href="[^"]*out/a/x.nc"[^>]*>1.891', page.html)
    assert re.search(r'href="../claims.nc"[^>]*>−2', page.html)


def test_rows_of_pairs(pairs, verdicts):
    jelly_glass, jelly_sand, iron_glass, iron_sand = pairs
    assert [pair["word"] for pair in pairs] == [WORDS[c] for c in (STICKY, DEPENDS, TOUCHES, 0)]
    glass, sand, iron = jelly_glass["text"], jelly_sand["text"], iron_sand["text"]
    assert glass["remaining"] == "50 % (40 to 84 %)"
    assert glass["pull_off"] == "at least 2.5 kPa"  # near full contact, not simulated
    assert (sand["margin"], sand["energy_ratio"]) == ("0.5 to 2", "0.25 … 1")
    # Moduli as they were given.
    assert sand["threshold"] == "E = 1.8 MPa (1.2 to 3.6 MPa)"
    assert iron["threshold"] == "E* = 2.4 MPa (1.6 to 4.8 MPa)"
    assert (glass["modulus"], iron["modulus"]) == ("E = 1 kPa", "E* = 2 GPa")
    assert (iron["remaining"], iron["pull_off"]) == ("0 %", "0 Pa")
    # Probabilities are known where spectra were drawn.
    assert glass["probability"] == glass["errors"] == "–"
    assert (sand["probability"], iron["probability"]) == ("42 %", "0 %")
    assert jelly_sand["change"] == "sticks below E = 1.8 MPa (1.2 to 3.6 MPa); it is 1 kPa"
    assert iron_sand["change"] == "sticks below E* = 2.4 MPa (1.6 to 4.8 MPa); it is 2 GPa"
    assert "a map, on which contact can be simulated" in jelly_sand["widest"]
    assert iron_sand["widest"] == ""
    assert (jelly_sand["moment"], iron_sand["moment"]) == ("at 1 Hz", "")
    assert sand["errors"] == "spectrum 30 %, map 0 %, model 40 %"
    assert jelly_sand["sort"]["errors"] == pytest.approx(0.5)
    assert all(pair["mine"] for pair in pairs)


@pytest.mark.parametrize(
    ("value", "limits", "text", "change"),
    [
        (3.5e6, (0.79e6, 30e6), "E = 3.5 MPa (0.79 to 30 MPa)", "below E = 3.5 MPa (0.79 to 30"),
        (3e6, (0.0, 4e6), "E = 3 MPa (0 to 4 MPa)", "below E = 3 MPa (0 to 4 MPa); it is 1 kPa"),
        (0.2, (0.0, 0.9), "none", "at no modulus; it is 1 kPa"),
        (1e20, (1e20, 1e20), "any", "at any modulus; it is 1 kPa"),
        (
            *(1e20, (1.5e11, 1e21), "E = 150 GPa at least, probably any"),
            "below E = 150 GPa, and probably at any modulus; it is 1 kPa",
        ),
        (
            *(0.0, (0.0, 2.15e9), "none, or E = 2.15 GPa at most"),
            "at no modulus, or below E = 2.15 GPa; it is 1 kPa",
        ),
    ],
)
def test_thresholds_have_one_unit_and_all_limits(verdicts, value, limits, text, change):
    pair = verdicts.sel(material="jelly", surface="sand")
    low, high = limits
    found = pair.assign(modulus_threshold=("limit", [low, value, high]))
    assert tell_threshold(found) == text
    assert tell_change(found).startswith(f"sticks {change}")


def test_every_judged_pair_is_on_one_axis(pairs):
    plot = interactive.draw_pairs(pairs)
    shown = defaultdict(list)
    for renderer in plot.renderers:
        if isinstance(renderer.glyph, Scatter):
            data = renderer.data_source.data
            names = ("material", "surface", "word", "ratio", "share", "low", "high")
            for material, surface, *row in zip(*(data[name] for name in names), strict=True):
                shown[material, surface].append(row)
    assert len(shown) == 4
    ((word, *numbers),) = shown["jelly & cream", "sand < 1 mm"]
    assert word == "depends"
    assert numbers == pytest.approx([0.25, 2.0, 1.6, 36.0])
    doubtful = [pair | {"code": -1} for pair in pairs]
    (line,) = interactive.draw_pairs(doubtful).renderers  # the model alone
    at = line.data_source.data
    shares = np.interp(np.log([0.5, 2.0]), np.log(at["x"]), at["y"])
    # As of a spectrum of H = 0.8 with very many waves.
    rough = SelfAffine(hurst=0.8, q0=1.0, q1=1e9, h_rms=1.0)
    lengths = np.array([0.5, 2.0]) * rough.elastic_energy()
    expected = [100 * predict(rough, length, 1e-6).separation for length in lengths]
    assert shares == pytest.approx(expected, rel=0.02)


def test_disagreement_counts_pairs_by_verdict(verdicts):
    assert write_report.find_disagreements(verdicts) == {
        "onset at the finest wave": {WORDS[TOUCHES]: 1},
        "bearing area (BAM)": {WORDS[NOT_STICKY]: 1},
    }


def test_sizes_of_surfaces_with_and_without_errors(surfaces):
    known, measured = (describe_surface(surfaces[name]) for name in ("glass", "sand"))
    assert known == {"height": "0.2 … 2 µm", "slope": "0.1 … 0.2", "line": "10⁻⁵ … 0.001"}
    assert measured["line"] == "0.00530 ± 0.00040"
    steeper = surfaces["glass"].assign(hurst=0.9)
    assert describe_surface(steeper)["line"].startswith("≤ ")
    sizes = {"h_rms": ("end", [0.9e-6, 1.1e-6]), "rms_slope": ("end", [0.19, 0.21])}
    found = describe_surface(surfaces["sand"].assign(sizes).assign_coords(draw=[0, 1]))
    assert (found["height"], found["slope"]) == ("(1.00 ± 0.16) µm", "0.200 ± 0.016")


def test_mixed_versions_are_all_listed(claims):
    other = claims.assign_attrs(version_numpy="1.0")
    assert write_report.list_versions([claims, other]) == {"numpy": ["1.0", "9.8.7"]}


def test_not_a_png_is_refused(tmp_path):
    path = tmp_path / "fig1.png"
    path.write_text("no picture")
    with pytest.raises(ValueError, match="fig1.png: not a PNG"):
        rendering.embed_png(path)


def test_caption_cannot_smuggle_html():
    html = pages.convert_rst(".. raw:: html\n\n   <b>bold</b>\n\nText <i>& more.")
    assert "<b>" not in html
    assert "&lt;i&gt;&amp; more." in html
