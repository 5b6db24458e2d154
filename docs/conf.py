"""Sphinx: README.md, docs, the notebook and the library's reference as pages (`make docs`).

The root of the project is the folder of sources, so that links between files lead to the same place
on a git host and in the pages.
"""

import os
import sys
from pathlib import Path

import bokeh
from sphinx.util.inspect import TypeAliasForwardRef

SCRIPTS = str(Path(__file__).parents[1] / "scripts")
sys.path.insert(0, SCRIPTS)
os.environ["PYTHONPATH"] = SCRIPTS  # of the notebook's kernel

from stickiness import __version__ as release  # noqa: E402, F401

project = "stickiness"
root_doc = "docs/index"
include_patterns = ["README.md", "CHANGELOG.md", "CONTRIBUTING.md", "docs/**.md"]
include_patterns += ["config/README.md", "examples/*"]
exclude_patterns = [
    *(".*", "**/__pycache__", "*.egg-info", "docs/_build", "examples/*.py"),
    *("benchmarks", "data", "envs", "logs", "profiles", "report", "results"),
    *("rules", "scripts", "tests"),
]
extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.napoleon",
]
myst_heading_anchors = 3
myst_enable_extensions = ["amsmath", "dollarmath"]

nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 300

default_role = "code"
autodoc_member_order = "bysource"
autodoc_preserve_defaults = True
autodoc_type_aliases = {name: name for name in ("ArrayLike", "NDArray")}
# Within other types, such as tuples, it would be shown as a reference.
TypeAliasForwardRef.__repr__ = lambda alias: alias.name
autodoc_typehints_format = "short"
autosummary_generate = False
napoleon_google_docstring = False
napoleon_use_param = False
napoleon_use_rtype = False
python_maximum_signature_line_length = 88

html_theme = "furo"
html_show_copyright = False
html_title = f"{project} {release}"


def setup(app):
    """Let the folder of the pages open at the index, and have the examples in it."""
    app.connect("build-finished", write_entrance)
    app.connect("build-finished", copy_examples)


def write_entrance(app, error):
    """Write an index.html that leads to the index page."""
    page = f"{app.config.root_doc}.html"
    if app.builder.format == "html" and error is None:
        text = (
            f'<meta http-equiv="refresh" content="0; url={page}"><a href="{page}">{project}</a>\n'
        )
        (Path(app.outdir) / "index.html").write_text(text, encoding="utf-8")


def copy_examples(app, error):
    """Copy the example pages, and put in the scripts that `take_pictures.py` left out."""
    if app.builder.format == "html" and error is None:
        target = Path(app.outdir) / "docs/example"
        target.mkdir(parents=True, exist_ok=True)
        for page in Path(__file__).parent.glob("example/*.html"):
            text = page.read_text(encoding="utf-8")
            script = Path(bokeh.__file__).parent / "server/static/js/bokeh.min.js"
            inline = f"<script>{script.read_text(encoding='utf-8')}</script>"
            text = text.replace(f'<script src="{script.name}"></script>', inline)
            (target / page.name).write_text(text, encoding="utf-8")
