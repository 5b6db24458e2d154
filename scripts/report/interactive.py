"""Interactive figures in a page of one file that needs no network: Bokeh, written into the page."""

from __future__ import annotations

from typing import Any

from bokeh.embed import components
from bokeh.models import Slider, UIElement
from bokeh.plotting import figure
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


def make_plot(sizing_mode: str = "stretch_width", **asked: Any) -> figure:
    """Empty plot, as wide as the page; `asked` are further arguments of Bokeh's `figure`.

    Dragging and scrolling stay the page's until a tool is chosen.
    """
    plot = figure(
        sizing_mode=sizing_mode,
        tools="pan,wheel_zoom,box_zoom,reset,save",
        active_drag=None,
        active_scroll=None,
        toolbar_location="above",
        **asked,
    )
    plot.toolbar.logo = None
    return plot


def make_slider(name: str, title: str, count: int, first: int) -> Slider:
    """Slider over `count` pictures, which its title names in place of their numbers."""
    return Slider(
        name=name,
        title=title,
        start=0,
        end=count - 1,
        value=first,
        step=1,
        show_value=False,
        sizing_mode="stretch_width",
    )
