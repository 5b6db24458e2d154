"""The page of one surface: verdicts and their reasons, curves, contact, parameters, spectrum."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from stickiness.pages import contact_figure, plotting, surface_figures
from stickiness.pages.rendering import TEMPLATES, embed_png, write_page
from stickiness.pages.rows import describe_pair, describe_surface, explain
from stickiness.statistics import COVERS
from stickiness.verdicts import wording
from stickiness.verdicts.limits import read_limited
from stickiness.verdicts.pair_variables import (
    BY_GAUSSIAN_THEORY,
    BY_SHAPED_THEORY,
    CONTACT_AREA,
    DECIDED_BY,
    THRESHOLDS,
)


def write_surface_page(
    page: str | Path,
    *,
    entry: Mapping[str, Any],
    surface: xr.Dataset,
    verdicts: xr.Dataset,
    files: Mapping[str, str | Path],
    own: Sequence[str] | None = None,
    simulated: Mapping[str, contact_figure.Simulated] | None = None,
    drawn: Mapping[str, list[dict[str, Any]]] | None = None,
) -> None:
    """Write the page of a surface.

    Parameters
    ----------
    page : path
        The page that is written.
    entry : mapping
        Entry of the surface, for what readers are told of its origin.
    surface : Dataset
        `Surface.data`.
    verdicts : Dataset
        What `judge` returns, with curves and thresholds, for this surface alone.
    files : mapping
        Files of data that the page links to: surface and verdicts.
    own : sequence of str, optional
        Names of the materials that are shown, and the others in tables on request. By default all.
    simulated : mapping of str to contact_figure.Simulated, optional
        States simulated with layers, by the names of the materials; files do not keep them.
    drawn : mapping, optional
        What `draw_surface` returns for this surface, if it is drawn already.
    """
    pairs = verdicts.squeeze("surface")
    names = list(map(str, pairs.material.values))
    own = names if own is None else [name for name in names if name in own]
    names = [*own, *(name for name in names if name not in own)]
    at_first = own or names[: surface_figures.SHOWN]
    rows = [describe_verdict(pairs.sel(material=name)) | {"mine": name in own} for name in names]
    axes = surface_figures.find_curves(pairs, at_first)
    curves = [
        draw_panel(surface_figures.draw_curves, part)
        for axis in axes.values()
        for part in surface_figures.split_curves(axis)
    ]
    shown = pairs.sel(material=at_first)
    contact = contact_figure.find_contact(surface, shown, simulated)
    write_page(
        TEMPLATES / "surface.html.j2",
        page,
        files=files,
        surface=surface,
        made=entry,
        sizes=describe_surface(surface),
        is_larger=plotting.is_larger(surface),
        covers=COVERS,
        **(drawn or draw_surface(surface)),
        wanted=float(pairs.wanted_share),
        doubts=list_doubts(rows if not own else [row for row in rows if row["mine"]]),
        not_judged=surface.attrs.get("not_judged", ""),
        contact_area=CONTACT_AREA,
        theories=(DECIDED_BY[BY_GAUSSIAN_THEORY], DECIDED_BY[BY_SHAPED_THEORY]),
        verdicts=rows,
        axes=list(axes),
        curves=curves,
        contact=contact,
        states=[
            draw_panel(contact_figure.draw_state, contact, state)
            for state in (contact.states if contact else ())
        ],
    )


def draw_surface(surface: xr.Dataset) -> dict[str, list[dict[str, Any]]]:
    """Pictures of the surface alone: heights and spectrum, and heights as they were read."""
    pictured = [surface[name] for name in ("heights", "profile") if name in surface][:1]
    outline = surface.get("feature_outline")
    panels = [draw_panel(surface_figures.draw_heights, heights, outline) for heights in pictured]
    panels.append(draw_panel(surface_figures.draw_spectrum, surface))
    reading = []
    if "heights_as_read" in surface and surface_figures.shows_change(surface):
        ways = (surface_figures.draw_as_read, surface_figures.draw_as_used)
        reading = [draw_panel(draw, surface) for draw in ways]
    return {"panels": panels, "reading": reading}


def describe_verdict(pair: xr.Dataset) -> dict[str, Any]:
    """Verdict on one material, with every criterion's reason."""
    return describe_pair(pair) | {
        "thresholds": {
            name: read_limited(pair[name]) for name in THRESHOLDS if not np.isnan(pair[name]).any()
        },
        "criteria": explain(pair) if wording.is_judged(pair) else [],
    }


def list_doubts(rows: Sequence[Mapping[str, Any]]) -> list[str]:
    """Doubts about the pairs of these rows, once each; those about some materials name them."""
    pairs = [row["pair"] for row in rows]
    doubts = [pair.doubts.item().splitlines() for pair in pairs]
    told = []
    for pair, its_doubts in zip(pairs, doubts, strict=True):
        about_material = pair.material_doubts.item().splitlines()
        reasons = pair.not_judged.item().splitlines()
        for doubt in its_doubts:
            if doubt in reasons:
                continue
            is_common = doubt not in about_material and all(doubt in each for each in doubts)
            name = "" if is_common else f"{pair.material_label.item()}: "
            told.append(name + wording.tell_doubt(doubt))
    return list(dict.fromkeys(told))


def draw_panel(*drawn: Any) -> dict[str, Any]:
    """Picture of one panel as text for a page; arguments as of `surface_figures.draw_panel`."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "picture.png")
        surface_figures.draw_panel(*drawn, output=file)
        return embed_png(file)
