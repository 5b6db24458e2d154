"""The page of one surface: verdicts and their reasons, curves, contact, parameters, spectrum."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from stickiness.formatting import amount, number, quantity_with_error, with_error
from stickiness.pages import contact_figure, interactive, plotting, surface_figures
from stickiness.pages.pressed_heights import Picture
from stickiness.pages.rendering import TEMPLATES, embed_png, write_page
from stickiness.pages.rows import describe_pair, describe_surface, explain
from stickiness.statistics import COVERS
from stickiness.verdicts import wording
from stickiness.verdicts.judgement import BY_GAUSSIAN_THEORY, BY_SHAPED_THEORY, DECIDED_BY
from stickiness.verdicts.limits import read_limited
from stickiness.verdicts.thresholds import CONTACT_AREA, THRESHOLDS


def write_surface_page(
    page: str | Path,
    *,
    entry: Mapping[str, Any],
    surface: xr.Dataset,
    verdicts: xr.Dataset,
    picture: Picture | None,
    files: Mapping[str, str | Path],
    own: Sequence[str] | None = None,
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
    picture : Picture or None
        What `picture_contact` returns; None of a surface that was not measured.
    files : mapping
        Files of data that the page links to: surface, verdicts and, with a picture, contact and
        pull_off.
    own : sequence of str, optional
        Names of the materials that are shown first, and the others on request. By default all.
    """
    pairs = verdicts.squeeze("surface")
    names = list(map(str, pairs.material.values))
    own = names if own is None else [name for name in names if name in own]
    names = [*own, *(name for name in names if name not in own)]
    at_first = own or names[: surface_figures.SHOWN]
    rows = [describe_verdict(pairs.sel(material=name)) | {"mine": name in own} for name in names]
    followed = surface_figures.find_curves(pairs, names, at_first)
    curves: dict[str, Any] = {}
    if followed:
        curves["interactive"] = interactive.embed(interactive.draw_curves(followed))
        curves["still"] = [draw_panel(surface_figures.draw_still, a) for a in followed.values()]
        curves["axes"] = list(followed)
    reading = []
    if "heights_as_read" in surface and surface_figures.shows_change(surface):
        ways = (surface_figures.draw_as_read, surface_figures.draw_as_used)
        reading = [draw_panel(draw, surface) for draw in ways]
    pictured = [surface[name] for name in ("heights", "profile") if name in surface][:1]
    panels = [draw_panel(surface_figures.draw_heights, heights) for heights in pictured]
    panels.append(draw_panel(surface_figures.draw_spectrum, surface))
    contact = None
    if picture is not None:
        suited = [name for name in own if pairs.half_space.sel(material=name)]
        contact = describe_contact(picture, pairs.sel(material=suited))
    write_page(
        TEMPLATES / "surface.html.j2",
        page,
        files=files,
        surface=surface,
        made=entry,
        sizes=describe_surface(surface),
        is_larger=plotting.is_larger(surface),
        covers=COVERS,
        panels=panels,
        reading=reading,
        wanted=float(pairs.wanted_share),
        doubts=list_doubts(rows if not own else [row for row in rows if row["mine"]]),
        not_judged=surface.attrs.get("not_judged", ""),
        contact_area=CONTACT_AREA,
        theories=(DECIDED_BY[BY_GAUSSIAN_THEORY], DECIDED_BY[BY_SHAPED_THEORY]),
        verdicts=rows,
        shown_at_first=len(at_first),
        curves=curves,
        contact=contact,
        library=interactive.library() if curves or contact else "",
    )


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


def draw_png(draw: Callable[..., None], *shown: Any) -> dict[str, Any]:
    """Picture that a function draws into a file, its `output`, as text for a page."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "picture.png")
        draw(*shown, output=file)
        return embed_png(file)


def draw_panel(*drawn: Any) -> dict[str, Any]:
    """Picture of one panel; arguments as of `surface_figures.draw_panel`."""
    return draw_png(surface_figures.draw_panel, *drawn)


def describe_contact(picture: Picture, suited: xr.Dataset) -> dict[str, Any] | None:
    """Simulated contact and pull-off of the measured heights; None where there is no map.

    `suited` are the pairs whose material is as the simulated solid: deep and smooth.
    """
    contact, pull_off = picture
    if contact.attrs["left_out"]:
        return None
    loads = list_loads(contact, suited)
    texts = []
    for load in loads:
        pressures = [f"{pressure} for {label}" for label, pressure in load["pressures"].items()]
        pressure = ", ".join(pressures) or f"{load['pressure']} E* q₀ hᵣₘₛ"
        texts.append(
            f"Mean pressure: {pressure}. Contact area: {load['area']}. Mean gap: {load['gap']}."
        )
    compared = () if pull_off.attrs["left_out"] else ("separation", "pull_off")
    outside = [name for name in compared if not overlap(pull_off, name)]
    return {
        "interactive": interactive.embed(interactive.draw_contact(contact, pull_off, texts)),
        "still": [draw_png(contact_figure.draw_still, contact, pull_off)],
        "data": contact,
        "loads": loads,
        "pulled": pull_off.attrs["material"],
        "moment": pull_off.attrs["moment"],
        "pull_off": pull_off,
        "outside": outside,
        "pulled_works": {name: read_limited(pull_off[name]) for name in compared},
        "too_high": all(
            read_limited(pull_off[name]).value < read_limited(pull_off[f"predicted_{name}"]).value
            for name in outside
        ),
    }


def list_loads(contact: xr.Dataset, suited: xr.Dataset) -> list[dict[str, Any]]:
    """Texts of every load: pressure over E* and for each suited material, area and mean gap."""
    moduli = {}
    for name in suited.material.values:
        pair = suited.sel(material=name)
        label = f"{pair.material_label.item()} {wording.tell_moment(pair)}".strip()
        moduli[label] = float(pair.plane_strain_modulus)
    rows = []
    for index in range(contact.sizes["pressure"]):
        load = contact.isel(pressure=index)
        area = with_error(100 * load.area_fraction, 100 * load.area_fraction_discretisation_error)
        gap = quantity_with_error(
            float(load.mean_gap), float(load.mean_gap_discretisation_error), "m"
        )
        pressures = {
            label: amount(float(load.mean_pressure) * modulus, "Pa", 2)
            for label, modulus in moduli.items()
        }
        rows.append(
            {
                "pressure": number(load.pressure, 2),
                "pressures": pressures,
                "area": f"({area}) %",
                "gap": gap,
            }
        )
    return rows


def overlap(pull_off: xr.Dataset, name: str) -> bool:
    """Whether the limits of simulation and model have values in common."""
    simulated, predicted = (read_limited(pull_off[each]) for each in (name, f"predicted_{name}"))
    return bool(simulated.low <= predicted.high and predicted.low <= simulated.high)
