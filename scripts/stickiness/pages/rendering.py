"""Pages and tables from templates, with filters that write numbers and symbols."""

from __future__ import annotations

import base64
import re
import struct
from collections.abc import Iterable
from pathlib import Path
from typing import Any
from urllib.parse import quote, unquote

import jinja2
import numpy as np
from markupsafe import Markup, escape

from stickiness import datasets, formatting
from stickiness.criteria.pair import DEPENDS, TOUCHES

TEMPLATES = Path(__file__).with_name("templates")  #: of pages, and parts that others include
FORMATS = ("number", "percent", "change", "interval", "with_error", "amount", "quantity")
DOI = re.compile(r"doi:(10\.\d{4,9}/(?:\([^\s()]*\)|[^\s,;:()&]*[^\s,;:()&.])+)")
# Symbols as texts of datasets and labels spell them, escaped: h_rms, q0, x^2, m^(2/3).
LOWERED = re.compile(
    r"(?<![A-Za-z_])([A-Za-zΔκσ](?:&#39;|'){0,2})_([A-Za-z]+(?:,[A-Z]+)?|\d)(?![A-Za-z0-9_])"
    r"|(?<!\w)([qCσ])([01])(?![A-Za-z0-9_])"
)
RAISED = re.compile(
    r"(?<=[\w)*>])\^(?:\(((?:[^()]|\([^()]*\))+)\)|(-?\d+(?:\.\d+)?|[A-Za-z](?!\w)))"
)
# Spaces within a number: beside its signs and before its unit.
WITHIN = re.compile(
    r"(?<=\S) (?=[×±%=])|(?<=[×±≤≥<=]) (?=[\d−(])|(?<=&lt;) (?=\d)"
    r"|(?<=\d) (?=to \d)|(?<= to) (?=\d)"
    r"|(?<=[\d)⁰¹²³⁴-⁹]) (?=[GMkmµn]?(?:Pa|m|J|N|Hz|s)(?:/m²)?(?![A-Za-z0-9]))"
)
LONGEST_TEXT = 100_000  # characters; what is longer is a picture or a script


def write_page(template: str | Path, page: str | Path, **values: Any) -> None:
    """Render a template and write the page, whole or not at all."""
    template = Path(template)
    text = make_environment(template.parent, page).get_template(template.name).render(values)
    with datasets.whole_file(page) as path:
        path.write_text(text, encoding="utf-8")


def make_environment(folder: str | Path, page: str | Path = "page") -> jinja2.Environment:
    """Environment for the templates in a folder; links are relative to the folder of `page`."""

    def href(target: str | Path) -> str:
        path = Path(formatting.relative_path(Path(target), Path(page).parent))
        return path.as_uri() if path.is_absolute() else quote(path.as_posix())

    def limited(numbers: Iterable[float], unit: str) -> str:
        value, low, high = map(float, numbers)
        write = formatting.in_unit(unit) if unit else formatting.in_units_of(1.0)
        return formatting.limited(value, low, high, write)

    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader([folder, TEMPLATES]),
        autoescape=lambda name: ".html" in (name or ""),
        undefined=jinja2.StrictUndefined,  # a name that nobody gives is an error
        finalize=keep_whole,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters |= {name: getattr(formatting, name) for name in FORMATS} | {
        "fixed": lambda value, digits=2: f"{float(value):.{digits}f}",
        "limited": limited,
        "typeset": typeset,
        "parameters": datasets.parameters,
        "capital": lambda text: text[0].upper() + text[1:],
        "breakable": lambda text: Markup(re.sub("([/_])", r"\1<wbr>", str(escape(text)))),
        "href": href,
        "place": lambda target: re.sub(r"^(\.\./)+", "", unquote(href(target))),
    }
    environment.tests["finite"] = lambda value: np.isfinite(value)
    environment.globals["np"] = np
    # Codes of verdicts that sentences differ by.
    environment.globals |= {"TOUCHES": TOUCHES, "DEPENDS": DEPENDS}
    environment.globals["table"] = lambda columns, rows: formatting.table(columns, rows).rstrip()
    return environment


@jinja2.pass_eval_context
def keep_whole(context: Any, value: Any) -> Any:
    """What a page of HTML is about to show, with no-break spaces inside its numbers."""
    if not (context.autoescape and isinstance(value, str) and len(value) < LONGEST_TEXT):
        return value
    kept = WITHIN.sub("\u00a0", value)
    return Markup(kept) if isinstance(value, Markup) else kept


def typeset(text: str) -> Markup:
    """Escaped text with its DOIs made links, and symbols such as h_rms, q0 and x^(2/3) set."""
    parts = DOI.split(str(escape(text)))
    for index, part in enumerate(parts):
        if index % 2:
            parts[index] = f'<a href="https://doi.org/{part}">doi:{part}</a>'
            continue
        part = re.sub(r"(?<=\d )um\b", "µm", part)
        part = LOWERED.sub(lambda m: f"{m[1] or m[3]}<sub>{m[2] or m[4]}</sub>", part)
        parts[index] = RAISED.sub(lambda m: f"<sup>{m[1] or m[2]}</sup>".replace("-", "−"), part)
    return Markup("".join(parts))


def embed_png(path: str | Path) -> dict[str, Any]:
    """A PNG as base64 text, with its name and size in pixels; ValueError if it is none."""
    content = Path(path).read_bytes()
    if not content.startswith(b"\x89PNG\r\n\x1a\n"):
        raise ValueError(f"{path}: not a PNG file; delete it and re-run")
    width, height = struct.unpack(">II", content[16:24])
    data = base64.b64encode(content).decode("ascii")
    return {"name": Path(path).stem, "data": data, "width": width, "height": height}
