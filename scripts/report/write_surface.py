"""Page of one surface: verdicts and their reasons, curves, contact, parameters and spectrum."""

import numpy as np
import xarray as xr

from common import provided
from common.conventions import LOAD
from common.formatting import NOTHING, interval, number, quantity, with_error
from common.job import start
from criteria.materials import RATE_KEYS, describe_modulus, read_material
from criteria.texts import describe_pull_off, describe_share
from report import contact_figure, interactive, pages, surface_figures
from report.table_rows import describe_pair, describe_surface, explain
from stickiness import datasets
from stickiness.adhesive import edge_zone
from stickiness.criteria import equivalent_sphere
from stickiness.criteria.pair import NOT_JUDGED
from stickiness.remaining.prediction import DEFAULT_SHARE
from stickiness.solids.moduli import crossings
from stickiness.statistics import COVERS

MANY_MISSING = 0.05  # share of the points from which the reader is told at once
MOST_SLOPE = 1.0  # rms, up to which slopes count as small
QUOTED_RANGE = 0.03  # over h_rms, at which a_V of the measured heights is quoted
MODEL_TOO_HIGH = 0.05  # remaining share below which the model exceeds simulations


def main(job):
    surface = datasets.read(job.input.surface, ["h_rms", "rms_slope", "psd"])
    verdicts = datasets.read(job.input.verdicts, ["remaining", "verdict", "margin"])
    pairs = verdicts.sel(surface=job.wildcards.real_surface)
    materials = datasets.parameters(verdicts)["materials"]
    names = provided.user_defined_first(map(str, pairs.material.values), provided.MATERIALS)
    mine = provided.user_defined(names, provided.MATERIALS)
    labels = {name: materials[name]["label"] for name in names}

    surface_figures.draw_surface(surface, job.output.figure)
    surface_figures.draw_curves(pairs, labels, job.output.curves)
    curves = surface_figures.draw_interactive(pairs, labels)
    contact = describe_contact(job.input, pairs, {name: materials[name] for name in mine})
    measured_contact = job.input.get("measured_contact")
    bem = datasets.read(measured_contact, ["a_v"]) if measured_contact else None
    pages.write_page(
        job.input.template,
        job.output.page,
        files=dict(job.input.items()),
        report=f"{job.output.page.rsplit('/', 2)[0]}/report.html",
        surface=surface,
        made=datasets.parameters(surface),
        sizes=describe_sizes(surface),
        figure=pages.embed_png(job.output.figure),
        wanted=DEFAULT_SHARE,
        verdicts=[
            describe_verdict(pairs.sel(material=name), materials[name]) | {"mine": name in mine}
            for name in names
        ],
        shown_at_first=surface_figures.SHOWN,
        curves={
            "interactive": interactive.embed(curves),
            "still": pages.embed_png(job.output.curves),
        }
        if curves
        else None,
        contact=contact,
        bem=None
        if bem is None
        else describe_measured_contact(bem, surface, {n: materials[n] for n in names}),
        library=interactive.library() if curves or contact else "",
    )


def describe_sizes(surface):
    """What the template cannot compute: sizes with errors, and what was seen of the surface."""
    low, high = surface.C0.values
    found = describe_surface(surface) | {
        "steep": float(surface.rms_slope.max()) > MOST_SLOPE,
        "prefactor": interval(float(low), float(high)),
        "many_missing": float(surface.get("missing_fraction", 0)) > MANY_MISSING,
    }
    if "C0_relative_error" in surface:
        # A factor: C0 is known at q = 1, far from the data.
        factor = float(np.exp(COVERS * surface.C0_relative_error))
        found["prefactor"] = f"{number(float(low), 2)} ×÷ {number(factor, 2)}"
    if "q_cutoff" in surface:
        found |= {
            "longest": 2 * np.pi / float(surface.wave_number.min()),
            "finest": 2 * np.pi / float(surface.q_cutoff),
            "assumed": 2 * np.pi / float(surface.q1),
            "extended": float(surface.q1) > float(surface.q_cutoff) * (1 + 1e-9),
            "not_used": int(surface.dropped_points) + int(surface.masked_spikes) > 0,
        }
    if "scatter" in surface:
        found["scatter"] = float(np.exp(surface.scatter))
    return found


def describe_verdict(pair, entry):
    """Verdict on one material, the rates at which it sticks, and every criterion's reason."""
    solid, judged = read_material(entry), int(pair.verdict) != NOT_JUDGED
    rated = solid.depends_on_rate and judged
    return describe_pair(pair) | {
        "material": entry["label"],
        "modulus": describe_modulus(entry),
        "rates": list_rates(solid, pair) if rated else [],
        "criteria": explain(pair, solid.work_of_adhesion) if judged else [],
    }


def list_rates(solid, pair):
    """Frequencies at which the pair sticks, as texts, for the thresholds at both ends."""
    texts = []
    for threshold in dict.fromkeys(map(float, pair.modulus_threshold.sel(end=["rough", "smooth"]))):
        found = crossings(solid.plane_strain, threshold, pair.frequency.values)
        words = [f"{'below' if up else 'above'} {number(f, 2)} Hz" for f, up in found]
        if not words:
            highest = np.nanmax(pair.modulus.values)
            words = ["at every frequency" if highest < threshold else "at no frequency"]
        texts.append(" and ".join(words))
    return list(dict.fromkeys(texts))


def describe_contact(files, pairs, own):
    """Simulated contact and pull-off of the measured heights; None where there is no map.

    `own` are the entries of the user's materials by name.
    """
    if not files.get("contact"):
        return None
    contact, pull_off = datasets.read(files.contact), datasets.read(files.pull_off)
    if contact.attrs["left_out"]:
        return None
    solids = {entry["label"]: read_material(entry) for entry in own.values()}
    loads = contact_figure.list_loads(contact, solids)
    figure = contact_figure.draw_interactive(contact, pull_off, loads)
    made = datasets.parameters(pull_off)
    found = {
        "interactive": interactive.embed(figure),
        "still": pages.embed_png(files.contact_figure),
        "data": contact,
        "grid": " by ".join(str(2 * contact.sizes[axis]) for axis in ("x", "y")),
        "coarse": exceeds(contact.shortest_wavelength, contact.cutoff_wavelength),
        "loads": loads,
        "pulled": made["label"],
        "pull_off": pull_off,
        "separated": not pull_off.attrs["left_out"],
    }
    if found["separated"]:
        disagreeing = [name for name in ("separation", "pull_off") if not overlap(pull_off, name)]
        too_high = all(pull_off[name] < pull_off[f"predicted_{name}"] for name in disagreeing)
        found |= {
            "pull_off_grid": " by ".join(str(pull_off.sizes[axis]) for axis in ("x", "y")),
            "rated": any(key in made for key in RATE_KEYS),
            "longer_range": exceeds(pull_off["range"], pull_off.material_range),
            "missing_waves": exceeds(pull_off.shortest_wavelength, pull_off.judged_wavelength),
            "disagreeing": disagreeing,
            "known_too_high": too_high and float(pull_off.separation) < MODEL_TOO_HIGH,
            "compared": [
                {"remaining": describe_share(each), "pull_off": describe_pull_off(each)}
                for each in (
                    as_pair(pull_off, ""),
                    as_pair(pull_off, "predicted_"),
                    pairs.sel(material=made["material"]),
                )
            ],
        }
    return found


def exceeds(length, other):
    """Whether a length is longer than another by more than rounding."""
    return float(length) > 1.001 * float(other)


def overlap(pull_off, name):
    """Whether the limits of simulation and model have values in common."""
    low, high, model_low, model_high = (
        float(pull_off[f"{prefix}{name}_{end}"])
        for prefix in ("", "predicted_")
        for end in ("low", "high")
    )
    return low <= model_high and model_low <= high


def as_pair(pull_off, prefix):
    """Simulated or predicted numbers as a verdict has those of a pair, at ends that agree."""
    names = {"remaining": "separation", "pull_off": "pull_off"}
    found = {
        f"{name}{end}": pull_off[f"{prefix}{simulated}{end}"]
        for name, simulated in names.items()
        for end in ("", "_low", "_high")
    }
    # Where this is large the model knows no pull-off. A simulation does.
    found["energy_ratio"] = pull_off.energy_ratio * bool(prefix)
    return xr.Dataset(found).expand_dims(end=2)


def describe_measured_contact(bem, surface, materials):
    """Contact of the measured heights with error estimates, as rows; loads where `bem` asks."""
    loads = []
    for pressure in bem.pressure.values:
        at = bem.sel(pressure=pressure).interp({"range": QUOTED_RANGE})
        row = {"pressure": float(pressure)}
        for name in ("area_fraction", "a_v"):
            row[name] = {
                "value": combine_ways(at[name]),
                "ways": dict(
                    zip(
                        map(str, at.periodisation.values),
                        map(float, at[name].isel(resolution=-1)),
                        strict=True,
                    )
                ),
                "theory": sorted(map(float, at[f"theory_{name}"].values)),
            }
        loads.append(row)
    found = {
        "loads": loads,
        "periodic": "given" in bem.periodisation.values,
        "load": LOAD,
        "margins": [
            {"material": entry["label"]} | find_onset(bem, read_material(entry), surface)
            for entry in materials.values()
        ],
        "adhesive": [],
    }
    if "adhesive_contact_area" in bem:
        found |= {
            "adhesive": [describe_adhesive_load(bem.sel(pressure=p)) for p in bem.pressure.values],
            "edge_pixel": float(bem.edge_resolution.isel(resolution=-1).max()),
            "largest_edge_pixel": edge_zone.COARSEST,
        }
    return found


def describe_adhesive_load(at):
    """Areas and mean gap with full adhesion beside those without, each with its error."""
    names = ("adhesive_contact_area", "area_fraction", "adhesive_attractive_area")
    names += ("adhesive_mean_gap", "mean_gap")
    applied = at.applied_pressure.values
    return {
        "pressure": float(at.pressure),
        "applied": quantity(float(applied.min()), float(applied.max()), "Pa"),
        "values": [combine_ways(at[name]) for name in names],
        "residual": float(at.adhesive_residual.max()),
    }


def combine_ways(values):
    """Mean over both ways to make heights periodic, and its error.

    The error is half the difference of the two and the change from half the resolution.
    """
    fine = values.isel(resolution=-1)
    change = values.diff("resolution").isel(resolution=-1).mean("periodisation")
    return float(fine.mean()), float(np.hypot(np.ptp(fine.values) / 2, change))


def find_onset(bem, solid, surface):
    """a_V at a material's range on the pressed heights, and the onset that follows, as texts.

    There is no a_V where the range lies outside the gaps computed, and no onset where it is below
    the gap of the pixels next to the contact, which the grid does not resolve.
    """
    at = bem.sel(pressure=LOAD, method="nearest")
    h = float(np.sqrt(np.prod(surface.h_rms.values)))
    ratio = solid.range / h
    found = {"range": number(ratio, 2), "a_v": NOTHING, "margin": NOTHING, "resolved": False}
    ranges = at["range"].values
    if not ranges[0] <= ratio <= ranges[-1]:
        return found
    value, error = combine_ways(at.a_v.interp({"range": ratio}))
    found |= {"a_v": with_error(value, error)}
    if ratio < float(at.edge_gap.isel(resolution=-1).max()):
        return found
    length = solid.work_of_adhesion / solid.modulus
    limits = [max(value - error, 0.01 * value), value + error]
    slope = float(np.sqrt(np.prod(surface.rms_slope.values)))
    onset = equivalent_sphere.attraction(h, float(surface.q0), slope, length, solid.range, limits)
    margins = onset.ratio * onset.error_factor ** np.array([-1.0, 1.0])
    return found | {"margin": interval(*map(float, margins), 2), "resolved": True}


if __name__ == "__main__":
    main(start(globals(), "write_surface", real_surface="jacksboro"))
