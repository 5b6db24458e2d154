"""HTML pages from templates: filters for numbers and symbols, embedded figures, links."""

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

from common import formatting
from common.formatting import keep_whole, write_powers
from stickiness import datasets

RST = {
    "raw_enabled": False,
    "file_insertion_enabled": False,
    "math_output": "MathML",  # the default would link a style sheet
    "report_level": 5,
    "_disable_config": True,
}
DOI = re.compile(r"doi:(10\.\d{4,9}/(?:\([^\s()]*\)|[^\s,;:()&]*[^\s,;:()&.])+)")
LONGEST_TEXT = 100_000  # characters; beyond are pictures
FORMATS = (
    *("number", "percent", "interval", "with_error", "amount", "quantity", "quantity_with_error"),
    *("difference", "superscripted"),
)

# Symbols as the texts of datasets spell them, escaped, and how a page shows them.
GREEK = {"kappa": "κ", "zeta": "ζ", "sigma": "σ", "theta": "θ", "beta": "β", "Delta": "Δ"}
SUBSCRIPTED = re.compile(
    r"(?<![A-Za-z_])([A-Za-zκΔσ](?:&#39;|'){0,2})_([A-Za-z]+(?:,[A-Z]+)?|\d)(?![A-Za-z0-9_])"
    r"|(?<!\w)([qCσ])([01])(?![A-Za-z0-9_])"
)
RAISED = re.compile(
    r"(?<=[\w)*>])\^(?:\(((?:[^()]|\([^()]*\))+)\)|(-?\d+(?:\.\d+)?|[A-Za-z](?!\w)))"
)
TAGS = re.compile(r"<(/?su[bp])>")
LOW = str.maketrans("0123456789aehijklmnoprstuvx", "₀₁₂₃₄₅₆₇₈₉ₐₑₕᵢⱼₖₗₘₙₒₚᵣₛₜᵤᵥₓ")
HIGH = str.maketrans("0123456789.−()n", "⁰¹²³⁴⁵⁶⁷⁸⁹·⁻⁽⁾ⁿ")


def write_page(template: str | Path, page: str | Path, **content: Any) -> None:
    """Render the template and write the page, whole or not at all."""
    text = load_template(template, page).render(**content)
    with datasets.whole_file(page) as path:
        path.write_text(text, encoding="utf-8")


def load_template(path: str | Path, page: str | Path) -> Template:
    """Template of a page: values are escaped, and an unknown one is an error.

    Links to other files are relative to the folder in which `page` will lie, whatever that is
    called: ``{{ path | href }}``, or for the reader ``{{ path | place }}``. The functions of
    `common.formatting` are filters: ``{{ value | with_error(error) }}``.
    """
    path = Path(path)
    environment = Environment(
        loader=FileSystemLoader(path.parent),
        autoescape=True,
        undefined=StrictUndefined,
        finalize=keep_numbers_whole,
        trim_blocks=True,
        lstrip_blocks=True,
    )

    def href(target: str | Path) -> str:
        return Path(os.path.relpath(target, Path(page).parent)).as_posix()

    environment.filters |= {name: getattr(formatting, name) for name in FORMATS}
    environment.filters |= {
        "typeset": typeset,
        "plain": plain,
        "href": href,
        "place": lambda target: re.sub(r"^(\.\./)+", "", href(target)),
        "breakable": lambda text: Markup(re.sub("([/_])", r"\1<wbr>", str(escape(text)))),
        "capital": capitalise,
    }
    return environment.get_template(path.name)


def typeset(text: str) -> Markup:
    """Escaped text with its DOIs made links, and symbols such as h_rms, q0 and x^(2/3) set."""
    parts = DOI.split(str(escape(text)))
    parts[::2] = map(set_symbols, parts[::2])
    parts[1::2] = [f'<a href="https://doi.org/{doi}">doi:{doi}</a>' for doi in parts[1::2]]
    return Markup("".join(parts))


def plain(text: str) -> str:
    """Text without markup whose symbols are set with what letters there are: for titles."""
    parts = TAGS.split(set_symbols(text))
    for index in range(2, len(parts), 4):
        parts[index] = parts[index].translate(LOW if parts[index - 1] == "sub" else HIGH)
    return "".join(part for index, part in enumerate(parts) if index % 2 == 0)


def capitalise(text: str) -> str:
    """Text whose first word, if it is all small, has its capital letter: not in "PDMS" or "pH"."""
    first = text.split(maxsplit=1)[0]
    return text[0].upper() + text[1:] if first.islower() else text


def keep_numbers_whole(value: Any) -> Any:
    """What a template is about to show, its numbers unbroken; scripts and pictures as they are."""
    if not isinstance(value, str) or len(value) > LONGEST_TEXT or "<script" in value:
        return value
    kept = keep_whole(value)
    return Markup(kept) if isinstance(value, Markup) else kept


def set_symbols(text: str) -> str:
    """Symbols and powers of ten of an escaped text as HTML."""
    text = write_powers(text)
    for name, letter in GREEK.items():
        text = re.sub(rf"\b{name}(?=\b|_|\d)", letter, text)
    text = SUBSCRIPTED.sub(
        lambda found: f"{found[1] or found[3]}<sub>{found[2] or found[4]}</sub>", text
    )
    return RAISED.sub(lambda found: f"<sup>{found[1] or found[2]}</sup>".replace("-", "−"), text)


def embed_png(path: str | Path) -> dict[str, Any]:
    """A PNG as base64 text, with its name and size in pixels.

    Raises
    ------
    ValueError
        If the file is no PNG.
    """
    content = Path(path).read_bytes()
    if not content.startswith(b"\x89PNG\r\n\x1a\n"):
        raise ValueError(f"{path}: not a PNG file; delete it and re-run")
    width, height = struct.unpack(">II", content[16:24])
    data = base64.b64encode(content).decode("ascii")
    return {"name": Path(path).stem, "data": data, "width": width, "height": height}


def embed_figure(path: str | Path, caption: str | Path) -> dict[str, Any]:
    """A PNG with its caption, a file in reStructuredText, as HTML, and an alternative text.

    The first paragraph is the caption, those that follow are details for a fold.
    """
    text = Path(caption).read_text(encoding="utf-8")
    first, _, details = text.strip().partition("\n\n")
    return embed_png(path) | {
        "title": f"Figure {Path(path).stem.removeprefix('fig')}",
        "caption": convert_rst(first),
        "details": convert_rst(details),
        "alt": first_sentence(first),
    }


def convert_rst(text: str) -> Markup:
    """Text in reStructuredText as HTML; docutils escapes what is not markup."""
    body = publish_parts(text, writer=Writer(), settings_overrides=RST)["body"]
    return Markup(" ".join(body.split()))


def first_sentence(text: str) -> str:
    """The first sentence of a text in reStructuredText, without markup."""
    words = " ".join(publish_doctree(text, settings_overrides=RST).astext().split())
    return re.split(r"(?<=[\w)%]{2}\.)\s(?=[A-Z])", words, maxsplit=1)[0]
