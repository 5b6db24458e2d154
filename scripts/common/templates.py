"""Templates of pages and tables, with filters that write numbers for readers."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import jinja2
import numpy as np

from common import formatting
from stickiness import datasets


def make_environment(folder: str | Path) -> jinja2.Environment:
    """Environment for the templates in a folder; a name that nobody gives is an error."""
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(folder),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters |= {
        "fixed": lambda value, digits=2: f"{float(value):.{digits}f}",
        "g": lambda value, digits=6: f"{float(value):.{digits}g}",
        "power": write_power,
        "plus_minus": write_with_error,
        "percent": lambda share: formatting.percent(float(share)),
        "change": lambda share: formatting.change(float(share)),
        "number": formatting.number,
        "amount": lambda value, unit, digits: formatting.amount(float(value), unit, digits),
    }
    environment.tests["finite"] = np.isfinite
    environment.globals["table"] = lambda columns, rows: formatting.table(columns, rows).rstrip()
    return environment


def write_page(template: str | Path, page: str | Path, **values: Any) -> None:
    """Render a template and write the page, whole or not at all."""
    template = Path(template)
    text = make_environment(template.parent).get_template(template.name).render(values)
    with datasets.whole_file(page) as path:
        path.write_text(text, encoding="utf-8")


def write_power(value: float) -> str:
    """Magnification as 1000 or 5e4."""
    value = float(value)
    return f"{value:g}" if value < 1e4 else f"{value:.2g}".replace("e+0", "e")


def write_with_error(pair: tuple[float, float]) -> str:
    """Value with its error, if that is known."""
    value, error = pair
    return f"{value:.2f}" + (f" ± {error:.2f}" if np.isfinite(error) else "")
