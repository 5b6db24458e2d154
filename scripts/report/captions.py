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
from xarray import Dataset

from common.formatting import keep_whole, write_powers

_RST = {
    "raw_enabled": False,
    "file_insertion_enabled": False,
    "math_output": "MathML",  # the default would link a style sheet
    "report_level": 5,
    "_disable_config": True,
}
_DOI = re.compile(r"doi:(10\.\d{4,9}/(?:\([^\s()]*\)|[^\s,;:()&]*[^\s,;:()&.])+)")
_LONGEST_TEXT = 100_000  # characters; beyond are pictures

# Symbols as the texts of datasets spell them, escaped, and how a page shows them.
_GREEK = {"kappa": "κ", "zeta": "ζ", "sigma": "σ", "theta": "θ", "beta": "β", "Delta": "Δ"}
_SUBSCRIPTED = re.compile(
    r"(?<![A-Za-z_])([A-Za-zκΔσ](?:&#39;|'){0,2})_([A-Za-z]+(?:,[A-Z]+)?|\d)(?![A-Za-z0-9_])"
    r"|(?<!\w)([qCσ])([01])(?![A-Za-z0-9_])"
)
_RAISED = re.compile(
    r"(?<=[\w)*>])\^(?:\(((?:[^()]|\([^()]*\))+)\)|(-?\d+(?:\.\d+)?|[A-Za-z](?!\w)))"
)
_TAGS = re.compile(r"<(/?su[bp])>")
_LOW = str.maketrans("0123456789aehijklmnoprstuvx", "₀₁₂₃₄₅₆₇₈₉ₐₑₕᵢⱼₖₗₘₙₒₚᵣₛₜᵤᵥₓ")
_HIGH = str.maketrans("0123456789.−()n", "⁰¹²³⁴⁵⁶⁷⁸⁹·⁻⁽⁾ⁿ")


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
        finalize=keep_numbers_whole,
        trim_blocks=True,
        lstrip_blocks=True,
    )

    def href(target: str | Path) -> str:
        return Path(os.path.relpath(target, Path(page).parent)).as_posix()

    environment.filters |= {
        "typeset": typeset,
        "plain": plain,
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


def plain(text: str) -> str:
    """Text without markup whose symbols are set with what letters there are: for titles."""
    parts = _TAGS.split(_symbols(text))
    for index in range(2, len(parts), 4):
        parts[index] = parts[index].translate(_LOW if parts[index - 1] == "sub" else _HIGH)
    return "".join(part for index, part in enumerate(parts) if index % 2 == 0)


def keep_numbers_whole(value: Any) -> Any:
    """What a template is about to show, its numbers unbroken; scripts and pictures as they are."""
    if not isinstance(value, str) or len(value) > _LONGEST_TEXT or "<script" in value:
        return value
    kept = keep_whole(value)
    return Markup(kept) if isinstance(value, Markup) else kept


def _symbols(text: str) -> str:
    """Symbols and powers of ten of an escaped text as HTML."""
    text = write_powers(text)
    for name, letter in _GREEK.items():
        text = re.sub(rf"\b{name}(?=\b|_|\d)", letter, text)
    text = _SUBSCRIPTED.sub(
        lambda found: f"{found[1] or found[3]}<sub>{found[2] or found[4]}</sub>", text
    )
    return _RAISED.sub(lambda found: f"<sup>{found[1] or found[2]}</sup>".replace("-", "−"), text)


def embed_figure(path: str | Path, caption: str) -> dict[str, Any]:
    """A PNG as a data URI, with an alternative text and its caption as HTML.

    The first paragraph is the caption, those that follow are details for a fold.
    """
    content = Path(path).read_bytes()
    if not content.startswith(b"\x89PNG\r\n\x1a\n"):
        raise ValueError(f"{path}: not a PNG file; delete it and re-run")
    width, height = struct.unpack(">II", content[16:24])
    name = Path(path).stem
    first, _, details = caption.strip().partition("\n\n")
    return {
        "name": name,
        "title": f"Figure {name.removeprefix('fig')}",
        "data": base64.b64encode(content).decode("ascii"),
        "width": width,
        "height": height,
        "caption": caption_html(first),
        "details": caption_html(details),
        "alt": first_sentence(first),
    }


def say_measurement(dataset: Dataset) -> str:
    """Which of several measurements a picture has, for a caption; empty where there is one."""
    name = dataset.attrs["measurement"]
    return f"The heights are those of the first map measured, ``{name}``. " if name else ""


def caption_html(caption: str) -> Markup:
    """Caption in reStructuredText as HTML; docutils escapes what is not markup."""
    body = publish_parts(caption, writer=Writer(), settings_overrides=_RST)["body"]
    return Markup(" ".join(body.split()))


def first_sentence(caption: str) -> str:
    """The caption's first sentence without markup."""
    text = " ".join(publish_doctree(caption, settings_overrides=_RST).astext().split())
    return re.split(r"(?<=[\w)%]{2}\.)\s(?=[A-Z])", text, maxsplit=1)[0]
