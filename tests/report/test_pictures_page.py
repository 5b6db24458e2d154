"""Pictures of contact on the page of a measured surface, as a browser shows and prints them."""

import base64
import hashlib
import json
import re
from html import unescape

import numpy as np
import pytest
import xarray as xr
from workflow.test_report_browser import CHROMIUM, as_printed, chromium, probed

from criteria.materials import read_material
from real_surfaces import pictured_heights, press_measured, pull_measured
from real_surfaces.pictured_heights import NO_MAP, NOT_JUDGED
from report import provided, stills, write_surface
from stickiness import datasets, surface
from stickiness.measured.topography import Topography
from stickiness.spectrum import SelfAffine

from .test_surface_page import MATERIALS, analysed, judged, page_of, scan

TAPE = MATERIALS["steel"] | {"label": "soft tape", "plane_strain_modulus": "1 MPa"}
pytestmark = pytest.mark.slow
in_a_browser = pytest.mark.skipif(CHROMIUM is None, reason="no chromium on the path")
# Bokeh draws below shadow roots. Every step waits until it has drawn.
PROBE = """
addEventListener("load", async () => {
  const drawn = () => new Promise((done) => setTimeout(done, 1000));
  const below = (root) => [...root.querySelectorAll("*")].flatMap(
    (e) => [e, ...(e.shadowRoot ? below(e.shadowRoot) : [])]);
  const pictures = () => below(document.body).filter((e) => e.tagName == "CANVAS" && e.width > 99)
    .map((e) => e.toDataURL());
  const words = () => below(document.body).filter((e) => e.classList.contains("bk-clearfix"))
    .map((e) => e.textContent);
  const model = (name) => Bokeh.documents.map((d) => d.get_model_by_name(name)).find((m) => m);
  const found = [];
  const tell = async (step) => {
    await drawn();
    found.push({ step, pictures: pictures(), words: words(), width: innerWidth,
      scroll: document.documentElement.scrollWidth,
      beyond: below(document.body).filter((e) => e.checkVisibility() && !e.closest(".wide, .frame")
        && !e.classList.contains("bk-GlyphRenderer")  // which draws on the canvas alone
        && e.getBoundingClientRect().right > innerWidth + 1).map((e) => e.className) });
  };
  await drawn();
  await tell("shown");
  model("load").value = 0;
  await tell("light");
  model("load").value = 7;
  await tell("heavy");
  model("moment").value = 0;
  await tell("apart");
  model("layer").active = 1;
  await drawn();  // a new layout: without a window it is drawn with the next change
  model("moment").value = 1;
  await tell("heights");
  const told = document.createElement("pre");
  told.textContent = JSON.stringify(found);
  told.id = "told";
  document.body.append(told);
});
"""


def pictured_plate():
    """Heights for the pictures: coarser and higher ones than those analysed, which take longer."""
    s = SelfAffine(hurst=0.8, q0=6.0, q1=16.0, h_rms=1e-6)
    h = surface.synthesise(s, n=64, length=2 * np.pi, seed=4)
    return Topography(h, 40e-6 / 64, 40e-6 / 64, "here")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("pictures")


@pytest.fixture(scope="module")
def plate(folder):
    return analysed(folder / "plate.nc", file=scan(folder / "a.txt"))


@pytest.fixture(scope="module")
def paths(folder, plate):
    """The four files of pictures that the page is given."""
    heights, cutoff = pictured_plate(), 2 * np.pi / 40e-6 * 16
    q0, q1 = float(plate.q0), float(plate.q1)
    names = ("touch.nc", "touch.png", "pull_off.nc", "pull_off.png")
    found = [folder / name for name in names]
    pressed = press_measured.press(heights, q0, cutoff, 128)
    datasets.write(pressed, found[0], title="a", parameters={"surface": "plate"})
    stills.draw_touch(pressed, found[1])
    pictured = pictured_heights.prepare(heights, cutoff, 64)
    pulled = pull_measured.simulate(pictured, (q0, q1), read_material(TAPE), "exponential", 0.1)
    made = {"surface": "plate", "material": "tape", **TAPE}
    datasets.write(pulled, found[2], title="a", parameters=made)
    stills.draw_pull_off(pulled, found[3])
    return found


@pytest.fixture(scope="module")
def materials():
    return MATERIALS | {"tape": TAPE}


def describe(plate, paths, materials):
    pairs = judged(plate, materials).sel(surface="plate")
    return write_surface.describe_pictures(paths, pairs, materials)


@pytest.fixture(scope="module")
def page(plate, folder, paths, materials):
    text = page_of(plate, folder, curves=None, **describe(plate, paths, materials))
    path = folder / "page.html"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def steps(page, folder):
    return {width: walk(page, folder, width) for width in (1280, 500)}


def walk(page, folder, width):
    """What the page shows after every step, by the step's name."""
    copy = folder / f"walk-{width}.html"
    text = page.read_text(encoding="utf-8")
    body, end, rest = text.rpartition("</body>")
    copy.write_text(f"{body}<script>{PROBE}</script>{end}{rest}", encoding="utf-8")
    time = "--virtual-time-budget=15000"
    dom, console = chromium(copy, folder / "profile", "--dump-dom", time, width=width)
    told = re.search(r'<pre id="told">(.*?)</pre>', dom, re.S)
    assert told, dom[:2000]
    assert console == []
    return {step["step"]: step for step in json.loads(unescape(told[1]))}


def seen(step):
    """Hash of every plot: the first of its two canvases, which has the glyphs."""
    contents = [base64.b64decode(each.split(",")[1]) for each in step["pictures"][::2]]
    return [hashlib.sha256(content).hexdigest() for content in contents]


@in_a_browser
def test_sliders_change_the_pictures_and_the_words(steps):
    at = {name: seen(step) for name, step in steps[1280].items()}
    assert len(at["shown"]) == 3  # map, curve and map
    for one, other, which in (
        ("shown", "light", 0),
        ("light", "heavy", 0),
        ("heavy", "apart", 1),
        ("heavy", "apart", 2),
        ("apart", "heights", 0),
    ):
        changed = [a != b for a, b in zip(at[one], at[other], strict=True)]
        assert changed[which], (one, other, changed)
    words = {name: " ".join(step["words"]) for name, step in steps[1280].items()}
    assert "for soft tape" in words["light"]
    assert words["light"] != words["heavy"]
    assert "Separation." in words["heavy"]
    assert "Approach." in words["apart"]


@in_a_browser
@pytest.mark.parametrize("width", [1280, 500])
def test_pictures_fit_the_window(steps, width):
    for step in steps[width].values():
        assert step["scroll"] <= step["width"] <= width
        assert step["beyond"] == []


@in_a_browser
def test_paper_has_the_stills_and_the_screen_the_figures(page, folder):
    screen, _ = probed(page, folder)
    paper, _ = probed(page, folder, 680, as_printed)
    assert len(paper["images"]) == len(screen["images"]) + 2


def test_page_loads_nothing_and_is_small(page):
    text = page.read_text(encoding="utf-8")
    assert not re.search(r"<(script|link|img)[^>]+(src|href)=\"https?:", text)
    assert len(text) < 4e6


def test_page_says_what_the_pictures_leave_out(page):
    text = re.sub(r"<(style|script)>.*?</\1>|<[^>]+>", " ", page.read_text("utf-8"), flags=re.S)
    words = " ".join(text.split())
    for sentence in (
        "Finer waves split every contact into smaller ones.",
        "To make the heights periodic they were changed by",
        "The attraction reaches",
        "not 0.3 nm : the grid resolves no shorter one.",
        "The longer range and the missing waves let more adhesion remain",
        "In a simulation with adhesion, soft tape is pressed on with at least",
        "Work of separation by the model, the same heights and range",
        "The verdict: energy gained by the model, all of the spectrum, range 0.3 nm",
        "Pull-off [kPa]",
    ):
        assert sentence in words, sentence


@pytest.mark.parametrize("missing", [True, False])
def test_page_says_what_lets_more_remain_and_what_rate_the_solid_has(
    plate, paths, folder, materials, missing
):
    """Of a material that depends on rate, with and without waves that the grid lacks."""
    pulled = datasets.read(paths[2])
    if not missing:
        pulled["judged_wavelength"] = pulled.shortest_wavelength
    made = datasets.parameters(pulled)
    entry = MATERIALS["gel"] if missing else TAPE
    path = folder / f"rated_{missing}.nc"
    datasets.write(pulled, path, title="a", parameters={"surface": "plate", **made, **entry})
    found = describe(plate, [*paths[:2], path, paths[3]], materials)
    text = page_of(plate, folder, curves=None, **found)
    rate = "as an elastic solid with its modulus at 1\u00a0Hz"
    assert (rate in text) is missing
    why = "The longer range and the missing waves let" if missing else "The longer range lets"
    assert f"{why} more adhesion remain" in text


def test_surfaces_without_a_map_or_a_verdict_have_no_pictures(plate, paths, materials, folder):
    left_out = folder / "left_out.nc"
    for reason, shown in ((NO_MAP, False), (NOT_JUDGED, False), ("nothing remains", True)):
        empty = xr.Dataset(attrs={"left_out": reason})
        made = {"surface": "plate", "material": "tape", **TAPE}
        datasets.write(empty, left_out, title="a", parameters=made)
        found = describe(plate, [left_out, paths[1], left_out, paths[3]], materials)
        assert found["touch"] is None
        assert (found["pull_off"] is not None) is shown
    text = page_of(plate, folder, curves=None, **found)
    assert "Pull-off of soft tape is not simulated: nothing remains." in text
    assert 'id="touch"' not in text
    assert "Bokeh" not in text


def test_the_material_pulled_is_the_first_own_one_or_the_softest():
    soft = MATERIALS["steel"] | {"plane_strain_modulus": "1 kPa"}
    given = {"steel": MATERIALS["steel"], "pdms": soft}
    assert provided.choose_pictured(given) == "pdms"
    assert provided.choose_pictured(given | {"mine": MATERIALS["steel"], "too": soft}) == "mine"
