"""Pictures and captions inside a page of HTML."""

import re
from pathlib import Path

from docutils.core import publish_parts
from docutils.writers.html5_polyglot import Writer
from markupsafe import Markup

from stickiness import datasets
from stickiness.pages.rendering import embed_png

RST = {
    "raw_enabled": False,
    "file_insertion_enabled": False,
    "math_output": "MathML",  # the default would link a style sheet
    "report_level": 5,
    "_disable_config": True,
}


def embed_figure(path, caption):
    """A PNG with its caption, a file in reStructuredText, as HTML; its first sentence as `alt`."""
    shown = convert_rst(Path(caption).read_text(encoding="utf-8"))
    return embed_png(path) | {
        "title": f"Figure {Path(path).stem.removeprefix('fig')}",
        "caption": shown,
        "alt": re.split(r"(?<=[\w)%]{2}\.)\s(?=[A-Z])", shown.striptags(), maxsplit=1)[0],
    }


def find_pixels(maps):
    """Pixels in the zone of attraction of the strongest adhesion of Figure 2's maps."""
    strongest = datasets.read(maps, ["pixels_in_zone"]).isel(adhesion_length_over_range=-1)
    return float(strongest.pixels_in_zone)


def convert_rst(text):
    """Text in reStructuredText as HTML; docutils escapes what is not markup."""
    body = publish_parts(text, writer=Writer(), settings_overrides=RST)["body"]
    return Markup(" ".join(body.split()))
