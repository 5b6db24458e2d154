"""Pages for readers: what a verdict rests on, with its figures, in one file that needs no network.

- `surface_page`: the page of one surface, with the verdicts on it
- `rows`: a pair as a row of a table
- `surface_figures`, `contact_figure`, `interactive`: its figures, for print and for the screen
- `rendering`: templates, with filters that write numbers and symbols
- `plotting`: the look of all figures

The templates of pages are in `templates/`. Words for a pair are in `stickiness.verdicts.wording`.
"""

__all__ = [
    "contact_figure",
    "interactive",
    "plotting",
    "rendering",
    "rows",
    "surface_figures",
    "surface_page",
]
