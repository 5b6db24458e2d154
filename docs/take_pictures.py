"""Take pictures and example pages of README.md and docs from results/standard.

Pictures of pages are as Chromium shows them. The examples are the report of that run and the page
of the tutorial's wall, without Bokeh's scripts, which `conf.py` puts back.
"""

from __future__ import annotations

import base64
import io
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image, ImageChops

DOCS = Path(__file__).parent
RESULTS = DOCS.parent / "results/standard"
FLAGS = ("--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--no-first-run")
FLAGS += ("--virtual-time-budget=8000",)  # until scripts have drawn
# Page, height of the window, and what is hidden.
PAGES = {
    "verdicts": (
        "report/report.html",
        2000,
        "nav, main > :not(#verdicts), #verdicts > :not(#matrix) { display: none !important }"
        ".page { display: block !important }",
    ),
    "surface": (
        "../example/run/wall.html",
        1300,
        "main > :not(h1, #contact, #contact + figure){ display: none !important }",
    ),
}
FIGURES = ("fig11", "fig12", "fig13", "fig14", "limits")


def shot(browser: str, page: Path, height: int, hidden: str) -> Image.Image:
    """The page in a window 1280 wide, without white at its end."""
    with tempfile.TemporaryDirectory() as folder:
        copy, png = Path(folder, "page.html"), Path(folder, "page.png")
        text = page.read_text(encoding="utf-8").replace(
            "</head>", f"<style>{hidden}</style></head>"
        )
        copy.write_text(text, encoding="utf-8")
        where = f"--user-data-dir={folder}/profile"
        size = f"--window-size=1280,{height}"
        command = [browser, *FLAGS, where, size, f"--screenshot={png}", copy.as_uri()]
        subprocess.run(command, check=True, capture_output=True)
        picture = Image.open(png).convert("RGB")
    white = Image.new("RGB", picture.size, "white")
    bottom = ImageChops.difference(picture, white).getbbox()[3]
    return picture.crop((0, 0, picture.width, min(bottom + 10, picture.height)))


def judge_wall() -> Path:
    """Make the page of the tutorial's wall and tape."""
    folder = RESULTS.parent / "example"
    folder.mkdir(parents=True, exist_ok=True)
    wall = folder / "wall.txt"
    size = ("--length", "2 mm", "--height-unit", "um")
    tape = ("--modulus", "0.2 MPa", "--work", "60 mJ/m^2", "--label", "painted wall")
    for command in (
        ("-m", "stickiness.example_wall", wall),
        ("-m", "stickiness", wall, *size, *tape, "--output", folder / "run"),
    ):
        environment = os.environ | {"PYTHONPATH": "scripts"}
        subprocess.run([sys.executable, *command], cwd=DOCS.parent, env=environment, check=True)
    return folder / "run/wall.html"


def copy_example(page: Path) -> None:
    """Write a page to docs/example, with small pictures, and without Bokeh and links to data."""
    text = page.read_text(encoding="utf-8")
    scripts = r"<script[^>]*>\s*/\* BEGIN (bokeh[\w.-]*\.js) \*/.*?</script>"
    text = re.sub(scripts, r'<script src="\1"></script>', text, flags=re.DOTALL)
    link = r'<a [^>]*?href="(?!https?:|#|data:)[^"]*"[^>]*>(.*?)</a>'
    text = re.sub(link, r"\1", text, flags=re.DOTALL)
    text = re.sub(r"data:image/png;base64,([\w+/=]+)", shrink, text)
    copy = DOCS / "example" / page.name
    copy.parent.mkdir(exist_ok=True)
    copy.write_text(text, encoding="utf-8")


def shrink(found: re.Match) -> str:
    """Return the picture of a page in a smaller format."""
    picture, small = Image.open(io.BytesIO(base64.b64decode(found[1]))), io.BytesIO()
    picture.convert("RGB").quantize(128).convert("RGB").save(small, "WEBP", lossless=True)
    return f"data:image/webp;base64,{base64.b64encode(small.getvalue()).decode()}"


def main() -> None:
    """Take all pictures and copy the examples anew."""
    browser = shutil.which("chromium") or shutil.which("google-chrome")
    if browser is None:
        sys.exit("no chromium on the path (apt install chromium)")
    wall = judge_wall()
    for name, (page, height, hidden) in PAGES.items():
        picture = shot(browser, RESULTS / page, height, hidden)
        picture.quantize(128).save(DOCS / f"{name}.png", optimize=True)
    for name in FIGURES:
        picture = Image.open(RESULTS / f"figures/{name}.png").convert("RGB")
        picture.quantize(128).save(DOCS / f"{name}.png", optimize=True)
    for page in (RESULTS / "report/report.html", wall):
        copy_example(page)


if __name__ == "__main__":
    main()
