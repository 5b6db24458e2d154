"""Take the pictures of README.md and docs from results/standard, pages as Chromium shows them."""

from __future__ import annotations

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
        "report/surfaces/jacksboro.html",
        1300,
        "main > :not(h1, #contact, #contact + p, #contact + p + figure)"
        "{ display: none !important }",
    ),
}
FIGURES = ("fig11",)


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


def main() -> None:
    """Take all pictures anew."""
    browser = shutil.which("chromium") or shutil.which("google-chrome")
    if browser is None:
        sys.exit("no chromium on the path (apt install chromium)")
    for name, (page, height, hidden) in PAGES.items():
        picture = shot(browser, RESULTS / page, height, hidden)
        picture.quantize(128).save(DOCS / f"{name}.png", optimize=True)
    for name in FIGURES:
        picture = Image.open(RESULTS / f"figures/{name}.png").convert("RGB")
        picture.quantize(128).save(DOCS / f"{name}.png", optimize=True)


if __name__ == "__main__":
    main()
