"""Pages of Markdown from templates, in which all their prose lives."""

from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from common.formatting import number, percent, table
from stickiness import datasets


def write_page(template: str | Path, page: str | Path, **values: Any) -> None:
    """Render a template and write the page, whole or not at all."""
    with datasets.whole_file(page) as path:
        path.write_text(render(template, **values), encoding="utf-8")


def render(template: str | Path, **values: Any) -> str:
    """Render a template of Markdown; a name that it uses and nobody gave is an error.

    Templates have the filters `number` and `percent`, and `table(columns, rows)`.
    """
    template = Path(template)
    environment = Environment(
        loader=FileSystemLoader(template.parent),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters |= {"number": number, "percent": percent}
    environment.globals["table"] = lambda columns, rows: table(columns, rows).rstrip("\n")
    return environment.get_template(template.name).render(values)
