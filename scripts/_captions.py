"""Figures and their captions as parts of an HTML page."""

from __future__ import annotations

import base64
import re
import struct
from pathlib import Path
from typing import Any

from docutils.core import publish_doctree, publish_parts
from docutils.writers.html5_polyglot import Writer
from jinja2 import Environment, FileSystemLoader, StrictUndefined, Template
from markupsafe import Markup, escape

_RST = {
    "raw_enabled": False,
    "file_insertion_enabled": False,
    "math_output": "MathML",  # the default would link a style sheet
    "report_level": 5,
    "_disable_config": True,
}
_DOI = re.compile(r"doi:(10\.\d{4,9}/(?:\([^\s()]*\)|[^\s,;:()&]*[^\s,;:()&.])+)")


def template_of(path: str | Path) -> Template:
    """Template of a page: values are escaped, and an unknown one is an error."""
    path = Path(path)
    environment = Environment(
        loader=FileSystemLoader(path.parent),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["linked"] = linked
    return environment.get_template(path.name)


def linked(text: str) -> Markup:
    """Escaped text with its DOIs made links."""
    return Markup(_DOI.sub(r'<a href="https://doi.org/\1">doi:\1</a>', str(escape(text))))


def figure(path: str | Path, caption: str) -> dict[str, Any]:
    """A PNG as a data URI, with its caption as HTML and an alternative text.

    Raises
    ------
    ValueError
        If the file is not a PNG.
    """
    content = Path(path).read_bytes()
    if not content.startswith(b"\x89PNG\r\n\x1a\n"):
        raise ValueError(f"{path}: not a PNG file; delete it and re-run")
    width, height = struct.unpack(">II", content[16:24])
    name = Path(path).stem
    return {
        "name": name,
        "title": f"Figure {name.removeprefix('fig')}",
        "data": base64.b64encode(content).decode("ascii"),
        "width": width,
        "height": height,
        "caption": caption_html(caption),
        "alt": first_sentence(caption),
    }


def caption_html(caption: str) -> Markup:
    """Caption in reStructuredText as HTML; docutils escapes what is not markup."""
    parts = publish_parts(caption, writer=Writer(), settings_overrides=_RST)
    return Markup(parts["body"])


def first_sentence(caption: str) -> str:
    """The caption's first sentence without markup."""
    text = " ".join(publish_doctree(caption, settings_overrides=_RST).astext().split())
    return re.split(r"(?<=[\w)%]{2}\.)\s(?=[A-Z])", text, maxsplit=1)[0]
