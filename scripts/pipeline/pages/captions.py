"""Figures and their captions as parts of an HTML page."""

from __future__ import annotations

import base64
import os
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


# Symbols as the texts of datasets spell them, escaped, and how a page shows them.
_GREEK = {"kappa": "κ", "zeta": "ζ", "sigma": "σ", "theta": "θ", "beta": "β", "Delta": "Δ"}
_SUBSCRIPTED = re.compile(
    r"(?<!\w)(h(?:&#39;|'){0,2}|[aAlpκσΔ])_(rms|ad|rep|nom|th|V,PR|V|a|r)(?![A-Za-z0-9_])"
    r"|(?<!\w)([qCσ])([01])(?![A-Za-z0-9_])"
)
_RAISED = re.compile(r"(?<=[\w)*>])\^(?:\(((?:[^()]|\([^()]*\))+)\)|(-?\d+(?:\.\d+)?))")


def template_of(path: str | Path, page: str | Path) -> Template:
    """Template of a page: values are escaped, and an unknown one is an error.

    Links to other files are relative to the folder in which `page` will lie, whatever that is
    called: ``{{ path | href }}``, or for the reader ``{{ path | place }}``.
    """
    path = Path(path)
    environment = Environment(
        loader=FileSystemLoader(path.parent),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )

    def href(target: str | Path) -> str:
        return Path(os.path.relpath(target, Path(page).parent)).as_posix()

    environment.filters |= {
        "typeset": typeset,
        "href": href,
        "place": lambda target: re.sub(r"^(\.\./)+", "", href(target)),
        "breakable": lambda text: Markup(re.sub("([/_])", r"\1<wbr>", str(escape(text)))),
    }
    return environment.get_template(path.name)


def typeset(text: str) -> Markup:
    """Escaped text with its DOIs made links, and symbols such as h_rms, q0 and x^(2/3) set."""
    parts = _DOI.split(str(escape(text)))
    parts[::2] = map(_symbols, parts[::2])
    parts[1::2] = [f'<a href="https://doi.org/{doi}">doi:{doi}</a>' for doi in parts[1::2]]
    return Markup("".join(parts))


def _symbols(text: str) -> str:
    """Symbols of an escaped text as HTML."""
    for name, letter in _GREEK.items():
        text = re.sub(rf"\b{name}(?=\b|_|\d)", letter, text)
    text = _SUBSCRIPTED.sub(
        lambda found: f"{found[1] or found[3]}<sub>{found[2] or found[4]}</sub>", text
    )
    return _RAISED.sub(lambda found: f"<sup>{found[1] or found[2]}</sup>".replace("-", "−"), text)


def embed_figure(path: str | Path, caption: str) -> dict[str, Any]:
    """A PNG as a data URI, with its caption as HTML and an alternative text."""
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
    """Caption in reStructuredText as HTML, symbols set; docutils escapes what is not markup."""
    body = publish_parts(caption, writer=Writer(), settings_overrides=_RST)["body"]
    pieces = re.split(r"(<[^>]*>)", body)
    pieces[::2] = map(_symbols, pieces[::2])
    return Markup("".join(pieces))


def first_sentence(caption: str) -> str:
    """The caption's first sentence without markup."""
    text = " ".join(publish_doctree(caption, settings_overrides=_RST).astext().split())
    return re.split(r"(?<=[\w)%]{2}\.)\s(?=[A-Z])", text, maxsplit=1)[0]
