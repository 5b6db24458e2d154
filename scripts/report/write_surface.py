"""Page of one surface: picture, spectrum, parameters, verdicts and their reasons."""

from pathlib import Path

import numpy as np

from common.conventions import LOAD
from common.formatting import NOTHING, amount, interval, number, percent, with_error
from common.job import start
from criteria.judging import OF_SURFACES, judge, read_surfaces
from criteria.materials import describe_modulus, read_material
from criteria.texts import say_verdict
from report import (
    captions,
    interactive,
    measured_contact,
    provided,
    pull_off,
    remaining_curves,
    touch,
)
from report.provided import own_first
from report.surface_figure import draw_surface
from report.surface_texts import (
    describe_height,
    describe_line,
    describe_slope,
    say_what_was_seen,
    warn_of_slope,
)
from report.verdict_texts import describe_pair, ends, explain
from stickiness import datasets
from stickiness.criteria.pair import NOT_JUDGED
from stickiness.remaining.prediction import DEFAULT_SHARE
from stickiness.solids.moduli import crossings
from stickiness.statistics import COVERS

CAPTION = """Heights and spectrum of the surface, with the fitted self-affine spectrum and the lines
of the paper.

Heights are those of the first measurement, levelled. Points of the spectrum are radial averages
with their sampling errors. Dotted: the cutoff of the instrument. Shaded: the end of the plateau
with its error, if there is one. Grey: the fit extrapolated beyond the instrument, with its error.
Errors cover 90 %.
"""
CURVES = """Share of the work of adhesion that remains on this surface, with limits.
Above the dashed line, at {wanted}, it sticks. Filled points: the pair as it is. {shown}

Lines: both ends of what is known of the surface. Of a measured surface these are quantiles of 16
and 84 % over the spectra compatible with the measurement; of one from the literature, plausible
ends. Shaded: limits. Of a measured surface these are quantiles of 5 and 95 % over the spectra and
the errors of the model; of one from the literature, the limits of the model at the plausible ends.
Those of the model cover 90 % where more than 5 % remains.

Linear elasticity and small slopes are assumed at all heights, also where the rms slope exceeds 1.

Modulus: against E* of the material, all else equal; open circles: the threshold. None of a layer
with an elastic backing, which would have to change as well.

Roughness: all heights times a factor, at an unchanged shape of the spectrum; the rms height is that
of the surface, midway between its ends. The roughness of the material's own, if it has one, changes
as well.

Rate: against the frequency of loading, of materials whose modulus depends on it; the work of
adhesion does not change.
"""
ON_SCREEN = "A press on a name hides its curves or shows them; at first {shown} are shown."
DRAWN = ("curves", "touch", "pull_off")  # interactive figures of a page


def main(job):
    surface = datasets.read(job.input.surface, OF_SURFACES)
    materials = job.params.materials
    pairs = write_verdicts(job, surface)
    draw_surface(surface, job.output.figure)
    page = render(
        job.input.template,
        job.output.page,
        files={
            "surface": job.input.surface,
            "verdicts": job.output.verdicts,
            "measured_contact": job.input.measured_contact[0] if job.input.measured_contact else "",
        },
        surface=surface,
        pairs=pairs,
        materials=materials,
        figures={
            "surface": captions.embed_figure(job.output.figure, CAPTION),
            "curves": draw_curves(pairs, materials, job.output.curves),
            **describe_pictures(job.input.pictures, pairs, materials),
        },
        bem=datasets.read(job.input.measured_contact[0], ["a_v"])
        if job.input.measured_contact
        else None,
    )
    with datasets.whole_file(job.output.page) as path:
        path.write_text(page, encoding="utf-8")


def write_verdicts(job, surface):
    """Verdict for every material on the surface, as they are written."""
    name, label = job.wildcards.real_surface, datasets.parameters(surface)["label"]
    own = read_surfaces(job.params.own, job.input.own)
    verdicts = judge({name: surface}, own, job.params)
    datasets.write(
        verdicts,
        job.output.verdicts,
        title=f"verdicts of the stickiness criteria: {label}",
        parameters={"materials": job.params.materials, "label": label},
    )
    return verdicts.sel(surface=name)


def draw_curves(pairs, materials, output):
    """Figure of what remains, and its picture, which is written; None if nothing is judged."""
    labels = {name: materials[name]["label"] for name in order(pairs)}
    remaining_curves.draw_static(pairs, labels, output)
    drawn = remaining_curves.draw_interactive(pairs, labels)
    if drawn is None:
        return None
    many = len(labels) > remaining_curves.SHOWN
    shown = ON_SCREEN.format(shown=remaining_curves.SHOWN) if many else ""
    caption = CURVES.format(wanted=percent(DEFAULT_SHARE), shown=shown)
    return {
        "figure": interactive.embed(drawn),
        "still": captions.embed_figure(output, caption),
    }


def order(pairs):
    """Names of the materials, the user's own first."""
    return own_first(map(str, pairs.material.values), provided.MATERIALS)


def render(template, page, *, files, surface, pairs, materials, figures, bem=None):
    """The page as text, with links to the files behind it from where it will lie.

    `figures` are that of the surface and those `DRAWN` that there are.
    """
    made = datasets.parameters(surface)
    names = order(pairs)
    any_drawn = any("figure" in (figures.get(name) or {}) for name in DRAWN)
    return captions.template_of(template, page).render(
        files_of=files,
        report=Path(page).parents[1] / "report.html",
        label=made["label"],
        kind=made["kind"].replace("_", "-"),
        source=made.get("source", ""),
        library=interactive.library() if any_drawn else "",
        figure=figures["surface"],
        **{name: figures.get(name) for name in DRAWN},
        seen=say_what_was_seen(surface),
        known=list_parameters(surface),
        remarks=[
            text
            for text in (
                *surface.attrs.get("remarks", "").split("; "),
                made.get("note"),
                warn_of_slope(surface),
            )
            if text
        ],
        measured=[t for t in surface.attrs.get("files", "").split("; ") if t],
        loads=measured_contact.describe_loads(bem) if bem is not None else [],
        periodic=bem is not None and "given" in bem.periodisation.values,
        adhesive_loads=measured_contact.describe_adhesion(bem) if bem is not None else [],
        edges=measured_contact.describe_edges(bem) if bem is not None else "",
        load=number(LOAD),
        wanted=percent(DEFAULT_SHARE),
        margins=[
            {"material": materials[name]["label"]}
            | measured_contact.describe_pair(bem, read_material(materials[name]), surface)
            for name in names
            if bem is not None
        ],
        not_judged=[t for t in surface.attrs.get("not_judged", "").split("\n") if t],
        verdicts=[
            describe_verdict(pairs.sel(material=name), surface, materials[name])
            | {"own": name not in provided.MATERIALS}
            for name in names
        ],
    )


def describe_pictures(paths, pairs, materials):
    """Contact and pull-off of measured heights, from the files of `find_pictures`, if any."""
    if not paths:
        return {}
    own = provided.own(map(str, pairs.material.values), provided.MATERIALS)
    solids = {materials[name]["label"]: read_material(materials[name]) for name in own}
    pressed, pressed_still, pulled, pulled_still = paths
    return {
        "touch": touch.describe(pressed, pressed_still, solids),
        "pull_off": pull_off.describe(pulled, pulled_still, lambda name: pairs.sel(material=name)),
    }


def list_parameters(surface):
    """Parameters of the surface with their errors, as pairs of name and text."""
    unit = surface.C0_reference_upper.attrs["units"]
    rows = [
        ("Hurst exponent H", with_error(float(surface.hurst), float(surface.hurst_total_error))),
        (f"C0 [{surface.C0.attrs['units']}]", describe_prefactor(surface)),
        (f"C0 at H = 0.8 [{unit}]", describe_line(surface)),
        *list_heights(surface),
        ("rms slope", describe_slope(surface)),
        ("q0 [1/m]", describe_lowest(surface)),
        ("roll-off", describe_roll_off(surface)),
        ("q1 [1/m]", number(float(surface.q1))),
    ]
    if "axis_ratio" in surface:
        rows.append(("ratio of correlation lengths", number(float(surface.axis_ratio), 2)))
    if "q_cutoff" in surface:
        wavelength = 2 * np.pi / float(surface.q_cutoff)
        text = f"{amount(wavelength, 'm')}: {surface.attrs['cutoff']}"
        rows.append(("shortest wavelength of the instrument", text))
        rows.append(("missing points, interpolated", percent(float(surface.missing_fraction))))
        rows.append(("dropped beside missing points", f"{int(surface.dropped_points)} points"))
        rows.append(("spikes, not used", f"{int(surface.masked_spikes)} points"))
        rows.append(("cut off for missing points", percent(float(surface.cropped_fraction))))
    if "anisotropy" in surface:
        rows.append(("dependence on direction, 0 … 2", number(float(surface.anisotropy), 2)))
    if "scatter" in surface:
        rows.append(("factor between measurements in C", number(np.exp(float(surface.scatter)), 3)))
    return rows


def list_heights(surface):
    """Rows of rms heights: by the spectrum, of the heights, and with the points not used."""
    if "h_rms_measured" not in surface:
        return [("rms height", describe_height(surface))]
    rows = [
        ("rms height by the spectrum, up to q1", describe_height(surface)),
        ("rms height of the levelled heights", show_height(surface.h_rms_measured)),
    ]
    if int(surface.dropped_points) + int(surface.masked_spikes):
        rows.append(("the same with the points not used", show_height(surface.h_rms_as_read)))
    return rows


def show_height(value):
    return amount(float(value), "m")


def describe_lowest(surface):
    """Wave number q0, of a roll-off with its error."""
    if "q_rolloff" in surface:
        return with_error(float(surface.q0), float(surface.q_rolloff_total_error))
    return number(float(surface.q0))


def describe_prefactor(surface):
    """C0, with a factor for its error: it is known at q = 1, far from the data."""
    c0 = surface.C0.values
    if "C0_relative_error" not in surface:
        return interval(*map(float, c0))
    factor = float(np.exp(COVERS * surface.C0_relative_error))
    return f"{number(float(c0[0]), 2)} ×÷ {number(factor, 2)}"


def describe_roll_off(surface):
    if "q_rolloff" not in surface:
        return "none found" if "fitted" in surface else NOTHING
    return f"{with_error(float(surface.q_rolloff), float(surface.q_rolloff_total_error))} 1/m"


def describe_verdict(pair, surface, entry):
    """Verdict of one material, with its errors and every criterion's reason."""
    solid = read_material(entry)
    return {
        "material": entry["label"],
        "sentence": say_verdict(entry["label"], pair),
        "modulus": describe_modulus(entry),
        **describe_pair(pair),
        "rate": describe_rate(solid, pair, ends(pair.modulus_threshold))
        if solid.depends_on_rate and int(pair.verdict) != NOT_JUDGED
        else NOTHING,
        "criteria": explain(pair, surface, solid.work_of_adhesion),
    }


def describe_rate(solid, pair, thresholds):
    """Frequencies at which the modulus passes the threshold, at both ends of the surface."""
    texts = []
    for threshold in dict.fromkeys(thresholds):
        found = crossings(solid.plane_strain, threshold, pair.frequency.values)
        words = [f"{'below' if up else 'above'} {number(f, 2)} Hz" for f, up in found]
        if not words:
            highest = np.nanmax(pair.modulus.values)
            words = ["at every frequency" if highest < threshold else "at none"]
        texts.append(" and ".join(words))
    return "sticks " + (" … ".join(dict.fromkeys(texts)))


if __name__ == "__main__":
    main(start(globals(), "write_surface", real_surface="jacksboro"))
