"""The report's page, from small made-up data whose texts and numbers are known."""

import copy
import json
import re
from collections import defaultdict
from dataclasses import replace
from html import unescape
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from bokeh.models import MultiLine, Scatter
from helpers.experiments import EXPERIMENTS, make_dataset
from helpers.pages import LINE, LINES, RAW, find_long_captions, find_raw_symbols

from common import formatting as numbers
from criteria import texts
from report import captions, pairs_figure, surface_texts, write_report
from report import report_parts as report
from report.benchmarks import processor_time, run_times
from report.provenance import describe_provenance
from stickiness import error_budget as budget
from stickiness.criteria.errata import ERRATA
from stickiness.criteria.pair import DEPENDS, NOT_STICKY, STICKY, TOUCHES
from stickiness.criteria.registry import EDGES, REMAINING

TEMPLATE = Path(__file__).parents[2] / "report" / "report.html.j2"
CAPTIONS = sorted(TEMPLATE.parent.glob("*.rst"))
NASTY = '<script>alert("1 & 2")</script>'
GRADES = ("reproduced", "reproduced with a qualification", "not reproduced", "undecided")
VOID = {"meta", "link", "img", "br", "wbr", "input", "hr"}


def made_by(dataset, **parameters):
    return dataset.assign_attrs(parameters=json.dumps(parameters), version_numpy="9.8.7")


def budgeted(dataset, name, **errors):
    """The dataset with a budget of one of its variables; sources left out have no part."""
    value = dataset[name] = dataset[name].assign_attrs(units="1", long_name=name)
    parts = {
        source: budget.Part(xr.DataArray(errors.get(source, 0.0), dims=value.dims), "made up")
        if source in errors
        else budget.absent("made up")
        for source in budget.SOURCES
    }
    return budget.with_budget(dataset, name, **parts)


@pytest.fixture(scope="module")
def made_claims():
    count = len(GRADES)
    columns = {
        "statement": [f"statement {n}" for n in range(1, count)] + [NASTY],
        "quantity": [f"quantity {n}" for n in range(count)],
        "value": [1.8912, -2.0, 3.0, 4.0],
        "claimed": [2.0, np.nan, 3.0, 4.0],
        "verdict": list(GRADES),
        "remark": [f"remark {n}, doi:10.1016/0043-1648(90)90154-3." for n in range(count)],
        "sources": ["out/a/x.nc", "", "out/b/seed1.nc out/b/seed2.nc", "out/a/x.nc"],
    }
    data = {name: ("claim", np.array(values)) for name, values in columns.items()}
    errata = {str(erratum.number): {"some_number": 0.5} for erratum in ERRATA}
    dataset = xr.Dataset(data, coords={"claim": range(1, count + 1)})
    errors = {"sampling": [0.0315, np.nan, 0.1, 0.1], "discretisation": [0.0102, 0.0, 0.0, 0.0]}
    return made_by(budgeted(dataset, "value", **errors), errata=errata)


@pytest.fixture(scope="module")
def made_verdicts():
    """Two materials on two surfaces: jelly sticks to glass, depends on sand; iron does neither.

    Iron touches glass without hold. On sand, the other criterion says the opposite of the verdict
    for iron alone.
    """
    derived = [[[9.0, 8.0], [2.0, 0.5]], [[0.1, 0.1], [0.01, 0.01]]]
    other = [[[9.0, 8.0], [2.0, 0.5]], [[0.1, 0.1], [3.0, 2.0]]]
    onset = [[[9.0, 8.0], [2.0, 0.5]], [[5.0, 4.0], [0.1, 0.1]]]
    remaining = np.array([[[0.7, 0.5], [0.3, 0.02]], [[0.01, 0.01], [0.0, 0.0]]])
    pull_off = 1e4 * remaining
    dims = ("material", "surface", "end")
    dataset = xr.Dataset(
        {
            "margin": ((*dims, "criterion"), np.stack([derived, onset, other], axis=-1)),
            "modulus_quoted": ("material", [4e3 / 3, 2e9]),
            "modulus_threshold": (dims, np.full((2, 2, 2), 2.5e6)),
            "remaining": (dims, remaining),
            "remaining_low": (dims, 0.8 * remaining),
            "remaining_high": (dims, 1.2 * remaining),
            "pull_off": (dims, pull_off),
            "pull_off_low": (dims, 0.5 * pull_off),
            "pull_off_high": (dims, 2 * pull_off),
            "stiffening": (dims, np.ones(remaining.shape)),
            "layer_strain": (dims, np.zeros(remaining.shape)),
            "energy_ratio": (dims, np.array(derived) / 2),
            "verdict": (dims[:2], [[STICKY, DEPENDS], [TOUCHES, NOT_STICKY]]),
            "modulus_threshold_low": (dims, np.full((2, 2, 2), 1.5e6)),
            "modulus_threshold_high": (dims, np.full((2, 2, 2), 4.5e6)),
            "margin_low": (dims, np.array(derived) * 0.9),
            "margin_high": (dims, np.array(derived) * 1.1),
            "pair_a_v": (dims, np.full((2, 2, 2), 3.0)),
            "pair_a_v_low": (dims, np.full((2, 2, 2), 2.0)),
            "pair_a_v_high": (dims, np.full((2, 2, 2), 4.0)),
            "probability": (dims[:2], [[np.nan, 0.42], [np.nan, 0.0]]),
            "probability_total_error": (dims[:2], [[np.nan, 0.06], [np.nan, 0.013]]),
            "margin_quantile": ((*dims[:2], "quantile"), np.tile([0.5, 1.0, 2.0], (2, 2, 1))),
            "error_of_spectrum": (dims[:2], np.full((2, 2), 0.3)),
            "error_of_model": (dims[:2], np.full((2, 2), 0.4)),
            "disagrees": (
                (*dims[:2], "criterion"),
                [[[0, 0, 0], [0, 0, 0]], [[0, 1, 0], [0, 0, 1]]],
            ),
        },
        coords={
            "material": ["jelly", "iron"],
            "surface": ["glass", "sand"],
            "end": ["smooth", "rough"],
            "criterion": [REMAINING, EDGES, "bearing_area"],
        },
    )
    model = np.full((2, 2, 2, 3), 0.5)
    dataset = budgeted(dataset, "margin", model=model)
    materials = {
        "jelly": {
            "label": "jelly & cream",
            "youngs_modulus": "1 kPa",
            "poisson_ratio": 0.5,
            "work_of_adhesion": "50 mJ/m^2",
            "range": "1 nm",
            "source": "own",
        },
        "iron": {
            "label": "iron",
            "plane_strain_modulus": "2 GPa",
            "work_of_adhesion": "1 J/m^2",
            "range": "1 nm",
        },
    }
    return made_by(dataset, materials=materials, pressure=0.065)


@pytest.fixture(scope="module")
def made_surfaces():
    known = xr.Dataset(
        {
            "h_rms": ("end", [2e-7, 2e-6]),
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
    return {
        "glass": made_by(known, kind="self_affine", label="glass pane", note="typical"),
        "sand": made_by(measured, kind="measured", label="sand < 1 mm", source="own"),
    }


def ensemble(seeds=(1, 2), residual=1e-6):
    """Area 0.05 ± 0.01 ± 0.002, gap 1 ± 0.001 ± 0.02, attractive area 2 range^(2/3)."""
    ranges = np.geomspace(1e-3, 1, 200)
    sampled = len(seeds) > 1
    data = {
        "residual": (("seed", "resolution", "pressure"), np.full((len(seeds), 2, 2), residual)),
        "attractive_area_mean": (("pressure", "range"), np.tile(2 * ranges ** (2 / 3), (2, 1))),
    }
    for name, mean, sampling, discretisation in (
        ("area_fraction", 0.05, 0.01, 0.002),
        ("mean_gap", 1.0, 0.001, 0.02),
    ):
        data[f"{name}_mean"] = ("pressure", [mean, 7.0])
        data[f"{name}_standard_error"] = ("pressure", [sampling if sampled else np.nan, 7.0])
        data[f"{name}_discretisation_error"] = ("pressure", [discretisation, 7.0])
    for name in ("standard_error", "discretisation_error"):
        data[f"attractive_area_{name}"] = data["attractive_area_mean"][0], np.zeros((2, 200))
    coords = {"seed": list(seeds), "resolution": [2, 4], "pressure": [0.06, 0.3], "range": ranges}
    return made_by(
        xr.Dataset(data, coords=coords),
        case="case_of_two",
        hurst=0.8,
        magnification=64,
        grid_points=256,
        pixels_per_wavelength=4,
        tolerance=1e-6,
        largest_residual=residual,
        seeds=list(seeds),
        estimator="multilevel" if sampled else "plain",
        coarse_seeds=32,
        descriptor_seeds=100,
    )


@pytest.fixture
def claims(made_claims):
    return copy.deepcopy(made_claims)


@pytest.fixture
def verdicts(made_verdicts):
    return copy.deepcopy(made_verdicts)


@pytest.fixture
def surfaces(made_surfaces):
    return copy.deepcopy(made_surfaces)


@pytest.fixture(scope="module")
def figures(tmp_path_factory):
    from matplotlib.figure import Figure

    made, folder = [], tmp_path_factory.mktemp("figures")
    for number in range(1, 7):
        path = folder / f"fig{number}.png"
        Figure(figsize=(2, 1)).savefig(path, dpi=50)
        made.append(
            captions.embed_figure(path, f"Caption {number} of *a* & b < gamma. More {{words}}.")
        )
    return made


@pytest.fixture(scope="module")
def benchmarks(tmp_path_factory):
    folder = tmp_path_factory.mktemp("benchmarks")
    (folder / "slow_rule" / "case").mkdir(parents=True)
    head = "s\th:m:s\tmax_rss\tcpu_time\n"
    (folder / "slow_rule" / "case" / "seed1.tsv").write_text(head + "10.5\t0:00:10\t200.0\t9.0\n")
    (folder / "slow_rule" / "case" / "seed2.tsv").write_text(head + "30.25\t0:00:30\t100.0\t28.5\n")
    (folder / "write_report.tsv").write_text(
        head + "99.0\t0:01:39\t999.0\t99.0\n"
    )  # an earlier run
    (folder / "quick_rule.tsv").write_text(head + "0.5\t0:00:00\tNA\tNA\n")
    return folder


def comparison():
    """Theory 10 % above simulation, known to 3 %, at every load."""
    ranges = np.geomspace(1e-3, 1, 20)
    shape = (1, 5)
    data = {}
    for kind, value in (("difference", 0.1), ("difference_total_error", 0.03)):
        for name in ("area_fraction", "mean_gap"):
            data[f"{name}_{kind}"] = (("variant", "pressure"), np.full(shape, value))
        full = np.full((*shape, 20), value)
        data[f"attractive_area_{kind}"] = (("variant", "pressure", "range"), full)
    coords = {"variant": ["a"], "pressure": [0.01, 0.03, 0.1, 0.3, 0.5], "range": ranges}
    return made_by(xr.Dataset(data, coords=coords), case="case_of_two")


def answer(sampling=0.01):
    """Area 0.05 ± 0.01 ± 0.002, gap 1 ± 0.001 ± 0.02, and a solver's part of 1e-6 in both."""
    errors = {
        "discretisation": [[0.002, 0], [0.02, 0]],
        "solver": [[1e-6, 0], [1e-6, 0]],
        "sampling": [[sampling, 0], [0.001, 0]],
    }
    dims = ("column", "pressure")
    dataset = xr.Dataset(
        {
            "value": (dims, [[0.05, 7.0], [1.0, 7.0]]),
        },
        coords={"column": ["area", "mean_gap"], "pressure": [0.06, 0.3]},
    )
    dataset = budgeted(dataset, "value", **errors)
    return made_by(dataset, case="case_of_two", accuracy=0.03)


def experiments(entries=EXPERIMENTS):
    """A ball that holds and is missed, and a plate that does not stick."""
    ball = {
        "quantity": "work_of_separation",
        "observed": (0.03, 0.03),
        "predicted": (0.02, 0.01, 0.025),
        "outcome": 0,
        "effect_of_input": 1.4142,
        "most_effective_input": "longest_wavelength",
        "waves_in_contact": 3.3,
        "by_relation": 1,
        "tests": 0,
        "criteria": {"violano": 2, EDGES: 0},
    }
    plate = {
        "quantity": "sticks",
        "observed": (0.0, 0.0),
        "predicted": (0.05, 0.01, 0.12),
        "value_inside": 1,
        "criteria": {"violano": 1},
    }
    return make_dataset({"ball/work": ball, "plate/steel": plate}, entries)


TRADEOFF = {
    "figure": {
        "name": "tradeoff",
        "data": "",
        "width": 100,
        "height": 50,
        "alt": "What it costs.",
        "caption": "What it costs.",
        "details": "",
    },
    "source": "config/trade.csv",
    "tables": [(["seeds", "area", "cost"], [["4 plain", "13 %", "40"]])],
    "presets": [
        {
            "name": "quick",
            "asked": "30 %",
            "settings": {
                "pixels_per_wavelength": 4,
                "tolerance": 1e-4,
                "seeds": 3,
                "coarse_seeds": 32,
            },
            "cost": "120",
            "errors": ["1 %"] * 6,
        }
    ],
}


@pytest.fixture(scope="module")
def page(render):
    """The page with plain spaces inside its numbers."""
    return render().replace("\u00a0", " ")


@pytest.fixture(scope="module")
def render(made_claims, made_verdicts, made_surfaces, figures, benchmarks):
    """The page, with other results where they are given."""
    results = report.Results(
        claims=made_claims,
        verdicts=made_verdicts,
        experiments=experiments(),
        surfaces=made_surfaces,
        ensembles=[ensemble()],
        answers=[answer()],
        comparisons=[comparison()],
        criterion=criterion(),
        paths={
            "claims": "out/claims.nc",
            "verdicts": "out/verdicts.nc",
            "criterion": "out/map.nc",
            "experiments": "out/experiments.nc",
            "surfaces": {name: f"out/surfaces/{name}.nc" for name in made_surfaces},
            "ensembles": {"case_of_two": "out/ensembles/case_of_two.nc"},
            "answers": {"case_of_two": "out/cases/case_of_two.nc"},
            "comparisons": {"case_of_two": "out/fits/case_of_two.nc"},
            "figures": {figure["name"]: [f"out/a/{figure['name']}.nc"] for figure in figures},
        },
    )

    def render(**others):
        return write_report.render(
            TEMPLATE,
            "out/report/report.html",
            replace(results, **others),
            figures=figures,
            experiments_figure=figures[0] | {"name": "experiments", "alt": "What was observed."},
            tradeoff=TRADEOFF,
            benchmarks=benchmarks,
            fidelity="draft",
        )

    return render


class Reader(HTMLParser):
    """Nesting errors, tags with their attributes, and texts of a page."""

    def __init__(self, page):
        super().__init__()
        self.open, self.errors, self.tags, self.texts = [], [], [], []
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.errors.append((tag, self.getpos()))

    def handle_data(self, data):
        self.texts.append(data)

    def attributes(self, tag):
        return [attributes for name, attributes in self.tags if name == tag]

    @property
    def text(self):
        return " ".join(" ".join(self.texts).split())


def test_page_is_well_formed(page):
    reader = Reader(page)
    assert not reader.errors
    assert not reader.open
    identities = [attributes["id"] for _, attributes in reader.tags if "id" in attributes]
    assert len(identities) == len(set(identities))
    targets = [a["href"][1:] for a in reader.attributes("a") if a["href"].startswith("#")]
    assert set(targets) <= set(identities)


def test_tables_have_captions_and_scopes(page):
    reader = Reader(page)
    assert len(reader.attributes("table")) == len(reader.attributes("caption")) >= 8
    assert all("scope" in attributes for attributes in reader.attributes("th"))


def test_nothing_is_fetched(page):
    reader = Reader(page)
    assert not any("src" in attributes for attributes in reader.attributes("script"))
    for tag, attributes in reader.tags:
        assert not any(name.startswith("on") for name in attributes), tag
        for name in ("src", "srcset", "href", "data", "poster"):
            address = attributes.get(name, "")
            doi = tag == "a" and address.startswith("https://doi.org/10.")
            file = tag == "a" and re.fullmatch(r"(\.\./|surfaces/)[\w./]+\.(nc|html)", address)
            assert doi or file or address.startswith(("#", "data:")) or address == "", address
    assert not re.search(r"@import|url\(", re.sub(r"<script\b.*?</script>", "", page, flags=re.S))


def test_every_claim_and_figure_appears(page):
    reader = Reader(page)
    for number in range(1, 4):
        assert f"statement {number}" in reader.text
    for grade in GRADES:
        assert grade in reader.text
    images = reader.attributes("img")
    assert [image["alt"] for image in images] == [
        *(f"Figure {n}: Caption {n} of a & b < gamma." for n in range(1, 7)),
        "What was observed.",
        "What it costs.",
    ]
    assert all((image["width"], image["height"]) == ("100", "50") for image in images)
    assert "More {words}." in reader.text
    for erratum in ERRATA:
        assert str(captions.typeset(erratum.subject)) in page
    assert reader.text.count("some number = 0.5") == len(ERRATA)


def test_claims_show_value_error_and_files(page):
    text = Reader(page).text
    assert "1.891 ± 0.033" in text
    assert "by sampling : sampling 0.032 discretisation 0.01" in text  # largest first
    assert "sampling, not known" in text
    assert "−2 by sampling, not known : sampling not known quantity 1" in text
    assert "b/ seed1.nc and 1 more" in text
    assert "closed form" in text
    # The value leads to the first file behind it, a closed form's to the ledger.
    assert '<a class="data" href="../a/x.nc" title="a/x.nc">1.891 ± 0.033</a>' in page
    assert '<a class="data" href="../claims.nc" title="claims.nc">−2</a>' in page


def test_texts_are_escaped(page):
    assert NASTY not in page
    assert NASTY in unescape(page)
    assert "jelly &amp; cream" in page
    assert "sand &lt; 1 mm" in page
    assert "noisy &lt;spectrum&gt;" in page


def criterion():
    """Map of the paper's criterion: what of it the report shows."""
    values = {"a_v": 3.21, "a_v_low": 2.8, "a_v_high": 4.4}
    return xr.Dataset(values, attrs={"parameters": '{"pressure": 0.065}'})


def test_summary_counts(claims, verdicts):
    found = report.summarise(
        claims, verdicts, criterion(), [ensemble(), ensemble(seeds=range(1, 5))]
    )
    assert [(name, count) for name, count, _ in found["graded"]] == [(g, 1) for g in GRADES]
    assert (found["pairs"], found["sticky"], found["touching"]) == (4, 1, 1)
    assert (found["wanted"], found["full"]) == ("10 %", "80 %")
    assert [pair[:2] for pair in found["by_verdict"]] == [
        ("sticks", 1),
        ("depends", 1),
        ("touches without hold", 1),
        ("does not stick", 1),
    ]
    more = verdicts.assign(verdict=verdicts.verdict + 1)
    fully = report.summarise(claims, more, criterion(), [ensemble()])
    assert (fully["sticky"], fully["touching"]) == (2, 1)
    assert fully["by_verdict"][0][:2] == ("sticks fully", 1)
    assert (found["a_v"], found["a_v_range"]) == ("3.2", "2.8 … 4.4")
    assert found["realisations"] == "2 … 4"


def test_every_verdict_stands_in_its_place(verdicts, surfaces):
    matrix = report.arrange_verdicts(verdicts, surfaces)
    assert [material["label"] for material in matrix["materials"]] == ["jelly & cream", "iron"]
    found = [[cell["verdict"] for cell in row["cells"]] for row in matrix["rows"]]
    assert found == [["sticks", "touches without hold"], ["depends", "does not stick"]]
    glass, sand = (row["cells"][0] for row in matrix["rows"])
    assert glass["remaining"] == "50 … 70 % (40 to 84 %)"
    assert glass["pull_off"] == "at least 2.5"  # near full contact, not simulated
    assert (sand["margin"], sand["limits"]) == ("0.5 … 2.0", "0.5 … 2.0")
    assert sand["remaining"] == "2 … 30 % (1.6 to 36 %)"
    assert sand["threshold"] == "2.5 (1.5 to 4.5)"
    assert (glass["own_modulus"], iron_modulus(matrix)) == ("0.0013", "2000")
    assert sand["energy_ratio"] == "0.25 … 1.0"
    iron = matrix["rows"][1]["cells"][1]
    assert (iron["remaining"], iron["pull_off"]) == ("0 %", "–")
    assert matrix["materials"][0]["work_of_adhesion"] == "50 mJ/m²"


BEYOND = f"> {numbers.number(1e7)}"


def iron_modulus(matrix):
    return matrix["rows"][1]["cells"][1]["own_modulus"]


@pytest.mark.parametrize(
    ("values", "limits", "text"),
    [
        ((3.5e6, 3.5e6), (0.79e6, 30e6), "3.5 (0.79 to 30)"),
        ((2e6, 1e6), (0.5e6, 4e6), "1 … 2 (0.5 to 4)"),
        ((8e-3, 8e-3), (1e-3, 0.9), f"< {numbers.number(1e-6)}"),
        ((0.5, 3e6), (0.0, 4e6), f"< {numbers.number(1e-6)} … 3 (0 to 4)"),
        ((2e12, 1e20), (1.5e11, 1e21), f"2 × 10⁶ … {BEYOND} (1.5 × 10⁵ to {BEYOND})"),
        ((np.nan, np.nan), (np.nan, np.nan), "–"),
    ],
)
def test_thresholds_have_one_unit_and_all_limits(verdicts, values, limits, text):
    pair = verdicts.sel(material="jelly", surface="sand")
    found = pair.assign(
        modulus_threshold=("end", list(values)),
        modulus_threshold_low=("end", [limits[0]] * 2),
        modulus_threshold_high=("end", [limits[1]] * 2),
    )
    assert texts.describe_threshold(found) == text
    drawn = found.assign(modulus_threshold_quantile=("quantile", [1e6, 2e6, 4e6]))
    if np.isfinite(limits[0]):
        assert texts.describe_threshold(drawn).endswith("(1 to 4)")


def test_every_judged_pair_is_on_one_axis(verdicts, surfaces):
    pairs = report.arrange_verdicts(verdicts, surfaces)["pairs"]
    plot = pairs_figure.draw_pairs(verdicts, pairs)
    points = [r for r in plot.renderers if isinstance(r.glyph, Scatter)]
    names = ("verdict", "ratio", "share", "low", "high")
    shown = defaultdict(list)
    for data in (r.data_source.data for r in points):
        rows = zip(*(data[n] for n in ("material", "surface", *names)), strict=True)
        for material, surface, *row in rows:
            shown[material, surface].append(row)
    assert len(shown) == 4
    (word, *less), (_, *more) = shown["jelly & cream", "sand < 1 mm"]
    assert word == "depends"
    assert less == pytest.approx([0.25, 2.0, 1.6, 2.0])
    assert more == pytest.approx([1.0, 30.0, 30.0, 36.0])
    ((_, *alone),) = shown["iron", "glass pane"]  # both ends agree
    assert alone == pytest.approx([0.05, 1.0, 0.8, 1.2])
    doubtful = [pair | {"grade": -1} for pair in pairs]
    (line,) = pairs_figure.draw_pairs(verdicts, doubtful).renderers  # the model alone
    at = line.data_source.data
    shares = np.interp(np.log([0.3, 2.0]), np.log(at["x"]), at["y"])
    assert shares == pytest.approx([0.44, 51.8], rel=0.02)


def test_both_ends_of_a_pair_are_one_line(verdicts, surfaces):
    pairs = report.arrange_verdicts(verdicts, surfaces)["pairs"]
    plot = pairs_figure.draw_pairs(verdicts, pairs)
    lines = [r.data_source.data for r in plot.renderers if isinstance(r.glyph, MultiLine)]
    drawn = sorted(tuple(xs) for data in lines for xs in data["xs"])
    assert drawn == [(0.005,), (0.05,), (0.25, 1.0), (4.0, 4.5)]


def test_verdicts_are_worded_on_the_page(page):
    text = Reader(page).text
    for words in (
        "sticks 50 … 70 % (40 to 84 %)",
        "depends 2 … 30 % (1.6 to 36 %)",
        "touches without hold 1 % (0.8 to 1.2 %)",
        "does not stick 0 %",
        "1 of 4 pairs stick. 1 touch without hold",
    ):
        assert words in text
    assert "†" not in text


def test_experiments_are_on_the_page(page):
    text = Reader(page).text
    for words in (
        # The ball's relation is no test.
        "overlap with 1 of 1 published observations whatever the unknown inputs, with 0 for some "
        "of them, and with 0 for none. The value itself agrees with 1.",
        "Ball 1999 held work of separation 30 mJ/m² (relation) read 20 mJ/m² (10 … 25 mJ/m²) "
        "missed longest wave (factor 1.4) 3.3, too few ✓ ✗",
        "hard plate steel on steel sticks does not stick read 5 % (1 to 12 %) compatible, value "
        "too no unknown input flat ≈ –",
        "Ball 1999 : the ball was wet",
        "soft ball : Ball, J. Made Up 1, 2 (1999). Not found: the color of the ball",
        "hard plate : no source.",
    ):
        assert words in text, words
    assert '<a class="data" href="../experiments.nc" title="experiments.nc">20 mJ/m²' in page
    assert 'href="#experiments"' in page


@pytest.mark.slow
def test_notes_of_experiments_are_on_the_page(render):
    noted = copy.deepcopy(EXPERIMENTS)
    noted["plate"]["note"] = "Two plates & a < b."
    text = Reader(render(experiments=experiments(noted))).text
    assert "hard plate : no source. Two plates & a < b." in text


def test_verdicts_are_said_in_a_sentence(verdicts):
    expected = {
        ("jelly", "glass"): "Jelly sticks: 50 … 70 % (40 to 84 %) of its work of adhesion remains.",
        ("jelly", "sand"): "For jelly it depends: 2 … 30 % (1.6 to 36 %) of its work of adhesion "
        "remains, and 10 % is wanted.",
        ("iron", "glass"): "Iron touches without hold: 1 % (0.8 to 1.2 %) of its work of adhesion "
        "remains, though contact grows by itself at the finest wave.",
        ("iron", "sand"): "Iron does not stick: nothing of its work of adhesion remains.",
    }
    for (material, surface), sentence in expected.items():
        pair = verdicts.sel(material=material, surface=surface)
        assert texts.say_verdict(material, pair) == sentence


def test_limits_on_a_measured_surface_are_those_of_its_draws(verdicts):
    pair = verdicts.sel(material="jelly", surface="glass")
    quantiles = xr.DataArray([0.31, 0.6, 0.77], dims="quantile")
    found = texts.describe_share(pair.assign(remaining_quantile=quantiles))
    assert found == "50 … 70 % (31 to 77 %)"


def test_errors_of_a_pair_are_told_where_it_was_drawn(verdicts, surfaces):
    pairs = report.arrange_verdicts(verdicts, surfaces)["pairs"]
    assert [(pair["material"], pair["name"]) for pair in pairs][:2] == [
        ("jelly & cream", "glass"),
        ("jelly & cream", "sand"),
    ]
    on_glass, on_sand = pairs[:2]
    assert on_glass["probability"] == on_glass["errors"] == "–"
    assert on_sand["probability"] == "42 %"
    assert pairs[3]["probability"] == "< 1.3 %"  # of no draw, which are few
    assert on_sand["errors"] == "spectrum 30 %, model 40 %"
    assert on_sand["error"] == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("text", "html"),
    [
        ("u/h_rms, q0 h'_rms", "u/h<sub>rms</sub>, q<sub>0</sub> h&#39;<sub>rms</sub>"),
        ("a_V,PR ~ zeta^((5H-3)/3)", "a<sub>V,PR</sub> ~ ζ<sup>(5H−3)/3</sup>"),
        ("C0 = 1e-3 m^0.4", "C<sub>0</sub> = 10⁻³ m<sup>0.4</sup>"),
        ("shape_a q01 x_rms_y", "shape_a q01 x_rms_y"),
        ("2.15 +- 0.15 um [um] <= 2", "2.15 ± 0.15 µm [µm] ≤ 2"),
        ("zeta = 6.77e+04 (-0.3, -1e5)", "ζ = 6.77 × 10⁴ (−0.3, −10⁵)"),
        ("p_ad/2p_rep, w/U_full", "p<sub>ad</sub>/2p<sub>rep</sub>, w/U<sub>full</sub>"),
        (
            "<i> & doi:10.1234/q0",
            '&lt;i&gt; &amp; <a href="https://doi.org/10.1234/q0">doi:10.1234/q0</a>',
        ),
    ],
)
def test_symbols_are_set(text, html):
    assert captions.typeset(text) == html


def test_titles_have_symbols_of_plain_letters():
    assert captions.plain("C0 = 10⁻³ m^0.4 & l_a < h_rms") == "C₀ = 10⁻³ m⁰·⁴ & lₐ < hᵣₘₛ"


def raw(data):
    """The same data with symbols in every label, as a user may write them."""
    made = json.loads(data.attrs["parameters"])
    for entry in made.get("materials", {}).values():
        entry["label"] += ", l_a = 0.05 range"
    if "label" in made:
        made["label"] += ", C0 = 10⁻³ m^0.4"
    return data.assign_attrs(parameters=json.dumps(made))


@pytest.mark.slow
def test_no_raw_symbol_is_shown(render, verdicts, surfaces, claims):
    assert find_raw_symbols("<p>a_b</p><p>m^2</p><code>c_d</code><img alt='e_f'>") == [
        *("a_b", "m^2", "e_f"),
    ]
    labelled = {name: raw(data) for name, data in surfaces.items()}
    quantities = claims.quantity.values.astype(object)
    quantities[0] = "p_ad/2p_rep at l_a/range = 0.1, m^0.4"
    asked = claims.assign(quantity=("claim", quantities.astype(str)))
    page = render(verdicts=raw(verdicts), surfaces=labelled, claims=asked)
    assert find_raw_symbols(page) == []
    assert "l<sub>a</sub>\u00a0=\u00a00.05 range" in page


@pytest.mark.slow
def test_captions_on_the_page_are_short(render):
    assert find_long_captions(f"<table><caption>{'long ' * 96}</caption></table>")
    folded = f"<table><caption>Short.<details>{'long ' * 96}</details></caption></table>"
    assert find_long_captions(folded) == []
    assert find_long_captions(render()) == []


@pytest.mark.parametrize("path", CAPTIONS, ids=lambda path: path.stem)
def test_a_caption_is_short_and_its_symbols_are_set(path, tmp_path):
    from matplotlib.figure import Figure

    picture = tmp_path / f"{path.stem}.png"
    Figure(figsize=(1, 1)).savefig(picture)
    made = captions.embed_figure(picture, path.read_text(encoding="utf-8"))
    first, details = (
        re.sub("<[^>]*>", "", unescape(str(made[part]))) for part in ("caption", "details")
    )
    assert 0 < len(first) <= LINE * LINES
    assert not RAW.search(first + details)
    assert not RAW.search(made["alt"])
    assert "system-message" not in made["caption"] + made["details"]
    assert details or not path.stem.startswith("fig")


def test_disagreement_counts_pairs_by_verdict_and_names_them(verdicts, surfaces):
    found = report.find_disagreements(verdicts, surfaces)
    assert [(word, total) for word, _, total in found["heads"]] == [
        ("sticks", 1),
        ("depends", 1),
        ("touches without hold", 1),
        ("does not stick", 1),
    ]
    onset, row = found["rows"]
    assert (onset["criterion"], onset["counts"]) == ("onset at the finest wave", [0, 0, 1, 0])
    assert onset["sticky"] == ["iron on glass pane"]
    assert (row["criterion"], row["counts"]) == ("bearing area (BAM)", [0, 0, 0, 1])
    assert row["sticky"] == ["iron on sand < 1 mm"]
    assert row["not_sticky"] == []


def test_surfaces_with_and_without_errors(surfaces):
    glass, sand = (report.describe_surface(*item) for item in surfaces.items())
    assert (glass["hurst"], sand["hurst"]) == ("0.8", "0.700 ± 0.020")
    assert (glass["c0"], sand["c0"]) == ("(1 … 100) × 10⁻⁵", "0.00530 ± 0.00040")
    assert glass["h_rms"] == "0.2 … 2 µm"
    assert sand["remarks"] == ["noisy <spectrum>"]


def test_bound_of_prefactor_for_another_hurst_exponent(surfaces):
    steeper = surfaces["glass"].assign(hurst=0.9)
    assert surface_texts.describe_line(steeper).startswith("≤ ")


def test_error_budget():
    budget = report.describe_budgets(answer())
    area, gap = budget["rows"]
    assert (budget["load"], budget["asked"]) == ("0.06", "3 %")
    assert area["errors"]["sampling"] == "20 %"
    assert area["errors"]["discretisation"] == "4 %"
    assert (area["dominates"], gap["dominates"]) == ("sampling", "discretisation")
    # sqrt(0.01^2 + 0.002^2) = 0.0102; the solver's part is far smaller.
    assert area["value"] == "0.050 ± 0.010"
    assert gap["errors"]["solver"] == "< 0.01 %"


def test_error_budget_of_a_single_seed_leaves_sampling_open():
    area = report.describe_budgets(answer(sampling=np.nan))["rows"][0]
    assert area["errors"]["sampling"] == "–"
    assert area["dominates"] == "sampling, not known"


def test_theory_is_compared_at_three_loads():
    rows = report.compare_theory([comparison()])
    assert [row["load"] for row in rows] == ["0.03", "0.1", "0.3"]
    assert all(cell == "(+10.0 ± 3.0) %" for row in rows for cell in row["cells"].values())


def test_run_times_add_up(benchmarks):
    times = run_times(benchmarks)
    slow, quick = times["rows"]
    assert slow == {
        "rule": "slow_rule",
        "jobs": 2,
        "total": "40.8",  # 10.5 + 30.25
        "processor": "37.5",  # 9 + 28.5
        "longest": "30.2",
        "memory": "200",
    }
    assert (quick["rule"], quick["memory"]) == ("quick_rule", "–")
    assert (times["jobs"], times["total"], times["processor"]) == (3, "41.2", "37.5")


def test_processor_time_of_some_jobs(benchmarks):
    assert processor_time(benchmarks, "seed2") == 28.5
    with pytest.raises(FileNotFoundError, match=r"no benchmark nobody\.tsv"):
        processor_time(benchmarks, "nobody")


def test_mixed_versions_are_pointed_out(claims):
    other = claims.assign_attrs(version_numpy="1.0")
    found = describe_provenance([claims, other], [])
    assert found["versions"] == [("numpy", "1.0, 9.8.7")]
    assert found["mixed"] == ["numpy"]
    assert describe_provenance([claims, claims], [])["mixed"] == []


@pytest.mark.parametrize(
    ("seeds", "want"),
    [((1, 2), "multilevel: 32 coarse seeds, 100 long-wave controls"), ((5,), "plain")],
)
def test_estimator_of_an_ensemble_is_named(seeds, want):
    (row,) = describe_provenance([], [ensemble(seeds=seeds)])["ensembles"]
    assert row["means"] == want


def test_not_a_png_is_refused(tmp_path):
    path = tmp_path / "fig1.png"
    path.write_text("no picture")
    with pytest.raises(ValueError, match="fig1.png: not a PNG"):
        captions.embed_figure(path, "")


def test_caption_cannot_smuggle_html():
    html = captions.caption_html(".. raw:: html\n\n   <b>bold</b>\n\nText <i>& more.")
    assert "<b>" not in html
    assert "&lt;i&gt;&amp; more." in html


def test_accuracy_that_was_not_reached_is_named():
    budget = report.describe_budgets(answer().assign_attrs(missed="mine: error 0.2 of 0.03"))
    assert budget["asked"] == "3 %, not reached"
