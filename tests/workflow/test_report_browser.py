"""The report and the pages of surfaces as a real browser shows and prints them.

Chromium runs without a window and without a network. A probe, a script appended to a copy of the
page, measures the page in the browser and puts what it found at its end.
"""

import base64
import json
import re
import struct
import subprocess
from functools import cache
from html import unescape
from urllib.parse import unquote

import pytest
from helpers.browser import CHROMIUM

from stickiness.pages import plotting

pytestmark = [
    pytest.mark.workflow,
    pytest.mark.skipif(CHROMIUM is None, reason="no chromium on the path (apt install chromium)"),
]
FLAGS = "--headless --no-sandbox --disable-gpu --disable-quic --disable-dev-shm-usage"
FLAGS += " --disable-sync --no-first-run --disable-background-networking --disable-component-update"
FLAGS += " --hide-scrollbars --enable-logging=stderr --virtual-time-budget=5000"
FLAGS = [*FLAGS.split(), "--host-resolver-rules=MAP * ~NOTFOUND"]
A4 = 680  # CSS pixels between the margins of 15 mm
PROBE = """
setTimeout(() => {
  for (const details of document.querySelectorAll("details")) details.open = true;
  const name = (e) => `${e.tagName}#${e.id}.${e.className}`;
  const boxed = (e) => e.closest(".wide, .frame, nav.contents, .skip") !== null;
  const shown = (e) => e.getClientRects().length > 0;
  const found = {
    width: innerWidth,
    scroll: document.documentElement.scrollWidth,
    beyond: [...document.body.querySelectorAll("*")]
      .filter((e) => !boxed(e) && e.getBoundingClientRect().right > innerWidth + 1).map(name),
    scrolling: [...document.querySelectorAll(".wide, .frame")]
      .filter((e) => e.scrollWidth > e.clientWidth + 1).map(name),
    images: [...document.images].filter(shown)
      .map((e) => [e.complete, e.naturalWidth, e.clientWidth]),
    interactive: [...document.querySelectorAll(".interactive")].filter(shown)
      .map((e) => e.querySelector("[data-root-id] > *")?.clientHeight ?? 0),
    loaded: performance.getEntriesByType("resource").map((entry) => entry.name.slice(0, 200))
      .filter((address) => !address.startsWith("data:")),
    // Each column as written, after each press of its button, and as it would print.
    tables: [...document.querySelectorAll("table.sortable")].map((table) => {
      const heads = [...table.tHead.rows[0].cells];
      const column = (i) => [...table.tBodies[0].rows].map(
        (row) => row.cells[i].dataset.value ?? row.cells[i].textContent.trim());
      return [table.className, heads.flatMap((head, i) => {
        const button = head.querySelector("button");
        if (!button) return [];
        const states = [column(i)];
        for (let press = 0; press < 2; ++press) {
          button.click();
          states.push(column(i));
        }
        dispatchEvent(new Event("beforeprint"));
        states.push(column(i));
        dispatchEvent(new Event("afterprint"));
        button.click();
        return [states];
      })];
    }),
  };
  const told = document.createElement("pre");
  told.textContent = JSON.stringify(found);
  told.id = "told";
  document.body.append(told);
}, 2000);  // Bokeh has drawn by then
"""


@cache
def probed(page, folder, width=1280, change=None):
    """What the probe finds in a page, changed by `change`, at a width of the window."""
    text = page.read_text(encoding="utf-8")
    copy = folder / f"{page.stem}-{width}.html"
    text = change(text) if change else text
    body, end, rest = text.rpartition("</body>")  # scripts of the page may have the word as well
    copy.write_text(f"{body}<script>{PROBE}</script>{end}{rest}", encoding="utf-8")
    command = [CHROMIUM, *FLAGS, f"--user-data-dir={folder / 'profile'}", copy.as_uri()]
    command += [f"--window-size={width},2000", "--dump-dom"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=600, check=False)
    console = [line for line in done.stderr.splitlines() if "CONSOLE" in line]
    dom = done.stdout
    told = re.search(r'<pre id="told">(.*?)</pre>', dom, re.S)
    assert told, dom[:2000]
    return json.loads(unescape(told[1])), console


def as_printed(text):
    """The page with its style for print on the screen, and none for small screens."""
    assert "@media print" in text
    return text.replace("@media screen and", "@media not all and").replace(
        "@media print", "@media screen"
    )


@pytest.fixture(scope="module")
def report(finished):
    return finished / "results/tiny/report/report.html"


@pytest.fixture(scope="module")
def measured_page(finished):
    return finished / "results/tiny/report/surfaces/uncd_diamond.html"


@pytest.fixture(scope="module")
def scratch(tmp_path_factory):
    return tmp_path_factory.mktemp("browser")


@pytest.fixture(params=["report", "measured_page"])
def page(request):
    return request.getfixturevalue(request.param)


def pixels_per_inch(page):
    """Resolution at which a page's first picture was drawn."""
    text = page.read_text(encoding="utf-8")
    png = base64.b64decode(re.search(r'<img src="data:image/png;base64,([^"]+)', text)[1])
    at = png.index(b"pHYs") + 4
    return struct.unpack(">I", png[at : at + 4])[0] * 0.0254


@pytest.mark.parametrize(
    ("width", "change", "smallest"),
    [(1280, None, 10), (500, None, 9), (A4, as_printed, 9)],  # no headless window is narrower
    ids=["laptop", "phone", "paper"],
)
def test_fits_and_is_legible(page, scratch, width, change, smallest):
    found, console = probed(page, scratch, width, change)
    assert found["scroll"] <= found["width"] <= width
    assert found["beyond"] == []
    # Only the matrix, a column for every material, may scroll in its frame, and not on paper.
    assert width == 500 or set(found["scrolling"]) <= ({"DIV#matrix.wide"} if not change else set())
    assert found["loaded"] == console == []
    letters = ("font.size", "axes.titlesize", "xtick.labelsize", "legend.fontsize")
    size = min(plotting.mpl.rcParams[name] for name in letters)
    assert found["images"]
    for complete, natural, shown in found["images"]:
        assert complete
        assert size / 72 * pixels_per_inch(page) * shown / natural >= smallest  # CSS pixels


def test_the_interactive_figure_is_drawn_and_not_printed(report, scratch):
    on_screen, console = probed(report, scratch)
    assert console == []
    assert min(on_screen["interactive"]) > 300  # CSS pixels
    printed, _ = probed(report, scratch, A4, as_printed)
    assert printed["interactive"] == []


def ordered(values):
    """Numbers of a column that are known; texts have the order of the language."""
    known = [value for value in values if value not in ("", "nan")]
    assert all(value in ("", "nan") for value in values[len(known) :])  # unknown ones come last
    try:
        return list(map(float, known))
    except ValueError:
        return []


def test_tables_sort(page, scratch):
    found, _ = probed(page, scratch)
    names = {name.split()[0] for name, _ in found["tables"]}
    assert names == ({"claims", "matrix", "pairs"} if page.stem == "report" else {"pairs"})
    for _, columns in found["tables"]:
        assert len(columns) >= 4
        for written, up, down, printed in columns:
            assert sorted(up) == sorted(down) == sorted(written)
            assert printed == written
            assert ordered(up) == sorted(ordered(up))
            assert ordered(down) == sorted(ordered(down), reverse=True)
        assert any(up != down for _, up, down, _ in columns)  # a press changes the order


def test_links_to_files_lead_somewhere(page):
    text = re.sub(r"<script\b.*?</script>", "", page.read_text(encoding="utf-8"), flags=re.S)
    targets = [unquote(unescape(target)) for target in re.findall(r'href="([^"#]+)"', text)]
    files = [target for target in targets if not target.startswith(("https://", "data:"))]
    assert any(file.endswith(".nc") for file in files)
    for file in files:
        assert (page.parent / file).is_file(), file
