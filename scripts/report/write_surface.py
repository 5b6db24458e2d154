"""Verdict for every material on one surface, and the page of the surface.

It has verdicts and their reasons, curves, contact, parameters and spectrum.
"""

import json

import numpy as np

from common import provided
from common.formatting import amount, number, quantity_with_error, with_error
from common.job import start
from common.materials import find_doubts, read_material
from common.templates import write_page
from common.verdicts import describe_moment, find_limits, find_value
from criteria.thresholds import ASKED, find_thresholds
from criteria.verdicts import judge_materials, read_surfaces
from report import interactive, pages, surface_figures
from report.table_rows import describe_pair, describe_surface, explain
from stickiness import __version__, datasets
from stickiness.adhesive import edge_zone
from stickiness.criteria.pair import NOT_JUDGED, SIGNS, WORDS
from stickiness.criteria.thresholds import CONTACT_AREA
from stickiness.criteria.verdict import describe_contact_law
from stickiness.measured.stitching import MOST_UNRESOLVED
from stickiness.remaining.prediction import DEFAULT_SHARE
from stickiness.solids import HALF_SPACE
from stickiness.statistics import COVERS

QUOTED_RANGE = 0.03  # over h_rms, at which a_V of the measured heights is quoted


def main(job):
    inputs = job.input
    surface = datasets.read(inputs.surface, ["h_rms", "rms_slope", "psd"])
    entries, pairs = job.params.materials, judge(job).sel(surface=job.wildcards.real_surface)
    names = provided.user_defined_first(map(str, pairs.material.values), provided.MATERIALS)
    mine = [name for name in names if name not in provided.MATERIALS]
    at_first = mine or names[: surface_figures.SHOWN]

    surface_figures.draw_surface(surface, job.output.figure)
    labels = {name: entries[name]["label"] for name in names}
    found = surface_figures.find_curves(pairs, labels, at_first)
    surface_figures.draw_still(found, job.output.curves)
    curves = found and {
        "interactive": interactive.embed(interactive.draw_curves(found)),
        "still": pages.embed_png(job.output.curves),
    }
    contact = inputs.get("contact") and describe_contact(inputs, entries, mine)
    bem = inputs.get("measured_contact")
    write_page(
        inputs.template,
        job.output.page,
        files=dict(inputs.items()) | {"verdicts": job.output.verdicts},
        surface=surface,
        made=job.params.surface,
        sizes=describe_surface(surface),
        covers=COVERS,
        figure=pages.embed_png(job.output.figure),
        wanted=DEFAULT_SHARE,
        labels=job.params.labels,
        doubts=[doubt for name in names for doubt in find_doubts(entries[name])],
        contact_area=CONTACT_AREA,
        most_unresolved=MOST_UNRESOLVED,
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


def judge(job):
    """Write the verdicts on the surface, and return them."""
    surfaces = read_surfaces([job.wildcards.real_surface], [job.input.surface])
    material_surfaces = read_surfaces(job.params.material_surfaces, job.input.material_surfaces)
    verdicts = judge_materials(surfaces, material_surfaces, job.params)
    name, labels = job.wildcards.real_surface, job.params.labels
    verdicts = find_thresholds(verdicts, surfaces[name], material_surfaces, job.params.materials)
    title = f"verdicts of the stickiness criteria: {labels[name]}"
    parameters = {"materials": job.params.materials, "labels": labels}
    datasets.write(verdicts, job.output.verdicts, title=title, parameters=parameters)
    laws = [
        describe_law(verdicts.sel(material=material, surface=name), entry)
        for material, entry in job.params.materials.items()
    ]
    with datasets.whole_file(job.output.contact_laws) as path:
        made = {"version": __version__, "surface": labels[name], "pairs": laws}
        path.write_text(json.dumps(made, indent=1, ensure_ascii=False, allow_nan=False))
    return datasets.read(job.output.verdicts)


def describe_law(pair, entry):
    """Verdict and effective attraction of a pair for DEM and FE models."""
    solid = read_material(entry)
    limited = (
        [float(x) for x in (find_value(pair, name), *find_limits(pair, name))]
        for name in ("remaining", "pull_off")
    )
    word, ratio = WORDS[int(pair.verdict)], float(pair.energy_ratio.max())
    return {"material": entry["label"], **describe_contact_law(word, solid, *limited, ratio)}


def describe_verdict(pair, entry):
    """Verdict on one material, with its properties as given and every criterion's reason."""
    judged = int(pair.verdict) != NOT_JUDGED
    return describe_pair(pair, entry) | {
        "material": entry["label"],
        "entry": entry,
        "thresholds": {
            name: [float(pair[f"{name}{end}"]) for end in SIGNS]
            for name in ASKED
            if not np.isnan(pair[f"{name}_low"])
        },
        "criteria": explain(pair, float(pair.work_of_adhesion)) if judged else [],
    }


def describe_contact(files, entries, mine):
    """Simulated contact and pull-off of the measured heights; None where there is no map."""
    contact, pull_off = datasets.read(files.contact), datasets.read(files.pull_off)
    if contact.attrs["left_out"]:
        return None
    solids = {entries[name]["label"]: read_material(entries[name]) for name in mine}
    loads = list_loads(contact, solids)
    texts = []
    for load in loads:
        pressures = [f"{pressure} for {label}" for label, pressure in load["pressures"].items()]
        pressure = ", ".join(pressures) or f"{load['pressure']} E* q₀ hᵣₘₛ"
        area, gap = load["area"], load["gap"]
        texts.append(f"Mean pressure: {pressure}. Contact area: {area}. Mean gap: {gap}.")
    made = datasets.parameters(pull_off)
    compared = () if pull_off.attrs["left_out"] else ("separation", "pull_off")
    outside = [name for name in compared if not overlap(pull_off, name)]
    return {
        "interactive": interactive.embed(interactive.draw_contact(contact, pull_off, texts)),
        "still": pages.embed_png(files.contact_figure),
        "data": contact,
        "loads": loads,
        "pulled": entries[made["material"]]["label"],
        "moment": describe_moment(read_material(made)).partition(",")[0],
        "pull_off": pull_off,
        "outside": outside,
        "too_high": all(pull_off[name] < pull_off[f"predicted_{name}"] for name in outside),
    }


def list_loads(contact, materials):
    """Texts of every load: pressure over E* and for each suited material, area and mean gap."""
    # Suited are materials that are deep and smooth, as the simulated solid is.
    suited = {
        f"{label} {describe_moment(solid).partition(',')[0]}".strip(): solid.modulus
        for label, solid in materials.items()
        if solid.solid == HALF_SPACE and solid.surface is None
    }
    rows = []
    for at in (contact.isel(pressure=index) for index in range(contact.sizes["pressure"])):
        area = with_error(100 * at.area_fraction, 100 * at.area_fraction_discretisation_error)
        gap, gap_error = float(at.mean_gap), float(at.mean_gap_discretisation_error)
        pressures = {name: float(at.mean_pressure) * modulus for name, modulus in suited.items()}
        rows.append(
            {
                "pressure": number(at.pressure, 2),
                "pressures": {name: amount(p, "Pa", 2) for name, p in pressures.items()},
                "area": f"({area}) %",
                "gap": quantity_with_error(gap, gap_error, "m"),
            }
        )
    return rows


def overlap(pull_off, name):
    """Whether the limits of simulation and model have values in common."""
    low, model_low = pull_off[f"{name}_low"], pull_off[f"predicted_{name}_low"]
    high, model_high = pull_off[f"{name}_high"], pull_off[f"predicted_{name}_high"]
    return bool(low <= model_high and model_low <= high)


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
    main(start(globals(), "write_surface", real_surface="jacksboro"))
