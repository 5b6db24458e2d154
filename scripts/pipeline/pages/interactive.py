"""Interactive figures in a page of one file that needs no network: Bokeh, written into the page."""

from __future__ import annotations

from bokeh.embed import components
from bokeh.models import UIElement
from bokeh.resources import Resources
from markupsafe import Markup


def library() -> Markup:
    """Bokeh itself as script elements, once a page, for its head: 1.7 MB."""
    scripts = Resources(mode="inline", components=["bokeh", "bokeh-widgets"]).js_raw[:-1]
    quiet = 'Bokeh.logger.set_level("error");'  # in place of the last, which says its level
    return Markup("\n").join(Markup(f"<script>{text}</script>") for text in (*scripts, quiet))


def embed(figure: UIElement) -> Markup:
    """The element and the script that draw one figure where they stand; needs `library`."""
    script, element = components(figure)
    return Markup(element + script)
