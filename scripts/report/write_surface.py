"""The page of one surface: verdicts and their reasons, curves, contact, parameters, spectrum."""

import tempfile

import numpy as np

from common import provided
from common.job import start
from common.materials import find_doubts
from common.table_rows import describe_pair, describe_surface, explain
from common.templates import write_page
from common.verdict_texts import describe_larger, describe_moment
from report import interactive, pages, surface_figures
from stickiness import datasets
from stickiness.adhesive import edge_zone
from stickiness.criteria.pair import NOT_JUDGED
from stickiness.formatting import amount, number, quantity_with_error, with_error
from stickiness.measured.stitching import MOST_UNRESOLVED
from stickiness.plausibility import LIMITS
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.statistics import COVERS
from stickiness.verdicts.limits import read_limited
from stickiness.verdicts.material import Material
from stickiness.verdicts.thresholds import CONTACT_AREA, THRESHOLDS

QUOTED_RANGE = 0.03  # over h_rms, at which a_V of the measured heights is quoted


def main(job):
    inputs = job.input
    entries = job.params.materials
    surface = datasets.read(inputs.surface, ["h_rms", "rms_slope", "psd"])
    verdicts = datasets.read(inputs.verdicts, ["verdict", "remaining"])
    pairs = verdicts.sel(surface=job.wildcards.real_surface)
    names = provided.user_defined_first(map(str, pairs.material.values), provided.MATERIALS)
    mine = [name for name in names if name not in provided.MATERIALS]
    at_first = mine or names[: surface_figures.SHOWN]

    surface_figures.draw_surface(surface, job.output.figure)
    labels = {name: entries[name]["label"] for name in names}
    followed = surface_figures.find_curves(pairs, labels, at_first)
    surface_figures.draw_still(followed, job.output.curves)
    curves = followed and {
        "interactive": interactive.embed(interactive.draw_curves(followed)),
        "still": pages.embed_png(job.output.curves),
    }
    contact = inputs.get("contact") and describe_contact(inputs, entries, mine)
    bem = inputs.get("measured_contact")
    write_page(
        inputs.template,
        job.output.page,
        files=dict(inputs.items()),
        surface=surface,
        made=job.params.surface,
        sizes=describe_surface(surface),
        covers=COVERS,
        figure=pages.embed_png(job.output.figure),
        reading=embed_reading(surface),
        wanted=DEFAULT_SHARE,
        labels=job.params.labels,
        doubts=[doubt for name in names for doubt in find_doubts(entries[name])],
        contact_area=CONTACT_AREA,
        most_unresolved=MOST_UNRESOLVED,
        largest_slope=LIMITS["rms_slope"].usual,
        verdicts=[
            describe_verdict(pairs.sel(material=name), entries[name]) | {"mine": name in mine}
            for name in names
        ],
        shown_at_first=len(at_first),
        curves=curves,
        contact=contact,
        bem=bem and describe_measured_contact(datasets.read(bem, ["a_v"])),
        library=interactive.library() if curves or contact else "",
    )


def embed_reading(surface):
    """Pictures of a map before and after it is levelled; None of other surfaces."""
    if "heights_as_read" not in surface:
        return None
    with tempfile.TemporaryDirectory() as folder:
        surface_figures.draw_reading(surface, f"{folder}/reading.png")
        return pages.embed_png(f"{folder}/reading.png")


def describe_verdict(pair, entry):
    """Verdict on one material, with its properties as given and every criterion's reason."""
    judged = int(pair.verdict) != NOT_JUDGED
    return describe_pair(pair, entry) | {
        "material": entry["label"],
        "entry": entry,
        "thresholds": {
            name: read_limited(pair[name]) for name in THRESHOLDS if not np.isnan(pair[name]).any()
        },
        "criteria": explain(pair, float(pair.work_of_adhesion)) if judged else [],
        "larger": describe_larger(pair),
    }


def describe_contact(files, entries, mine):
    """Simulated contact and pull-off of the measured heights; None where there is no map."""
    contact = datasets.read(files.contact)
    pull_off = datasets.read(files.pull_off)
    if contact.attrs["left_out"]:
        return None
    loads = list_loads(contact, [entries[name] for name in mine])
    texts = []
    for load in loads:
        pressures = [f"{pressure} for {label}" for label, pressure in load["pressures"].items()]
        pressure = ", ".join(pressures) or f"{load['pressure']} E* q₀ hᵣₘₛ"
        texts.append(
            f"Mean pressure: {pressure}. Contact area: {load['area']}. Mean gap: {load['gap']}."
        )
    pulled = entries[datasets.parameters(pull_off)["material"]]
    compared = () if pull_off.attrs["left_out"] else ("separation", "pull_off")
    outside = [name for name in compared if not overlap(pull_off, name)]
    return {
        "interactive": interactive.embed(interactive.draw_contact(contact, pull_off, texts)),
        "still": pages.embed_png(files.contact_figure),
        "data": contact,
        "loads": loads,
        "pulled": pulled["label"],
        "moment": describe_moment(Material.from_entry(pulled | {"surface": None})),
        "pull_off": pull_off,
        "outside": outside,
        "pulled_works": {name: read_limited(pull_off[name]) for name in compared},
        "too_high": all(
            read_limited(pull_off[name]).value < read_limited(pull_off[f"predicted_{name}"]).value
            for name in outside
        ),
    }


def list_loads(contact, entries):
    """Texts of every load: pressure over E* and for each suited material, area and mean gap."""
    # Suited are materials that are deep and smooth, as the simulated solid is.
    suited = [
        Material.from_entry(entry)
        for entry in entries
        if entry["thickness"] is None and entry["surface"] is None
    ]
    rows = []
    for index in range(contact.sizes["pressure"]):
        load = contact.isel(pressure=index)
        area = with_error(100 * load.area_fraction, 100 * load.area_fraction_discretisation_error)
        gap = quantity_with_error(
            float(load.mean_gap), float(load.mean_gap_discretisation_error), "m"
        )
        pressures = {}
        for material in suited:
            name = f"{material.label} {describe_moment(material)}".strip()
            pressure = float(load.mean_pressure) * material.plane_strain_modulus
            pressures[name] = amount(pressure, "Pa", 2)
        rows.append(
            {
                "pressure": number(load.pressure, 2),
                "pressures": pressures,
                "area": f"({area}) %",
                "gap": gap,
            }
        )
    return rows


def overlap(pull_off, name):
    """Whether the limits of simulation and model have values in common."""
    simulated, predicted = (read_limited(pull_off[each]) for each in (name, f"predicted_{name}"))
    return simulated.low <= predicted.high and predicted.low <= simulated.high


def describe_measured_contact(bem):
    """Contact of the measured heights; its errors are by half the resolution and both ways."""
    quoted = bem.interp({"range": QUOTED_RANGE})
    fine = quoted.isel(resolution=-1)
    change = quoted.diff("resolution").isel(resolution=-1).mean("periodisation")
    spread = (fine.max("periodisation") - fine.min("periodisation")) / 2
    return {
        "fine": fine,
        "mean": fine.mean("periodisation"),
        "error": np.hypot(spread, change),
        "largest_edge_pixel": edge_zone.COARSEST,
    }


if __name__ == "__main__":
    main(start(globals()))
