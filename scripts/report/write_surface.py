"""Page of one surface: verdicts and their reasons, curves, contact, parameters and spectrum."""

import numpy as np
import xarray as xr

from common import provided
from common.conventions import LOAD
from common.formatting import NOTHING, interval, number, quantity, with_error
from common.job import start
from common.materials import RATE_KEYS, describe_modulus, read_material
from common.templates import write_page
from common.verdicts import describe_pull_off, describe_share
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
COMPARED = ("adhesive_contact_area", "area_fraction", "adhesive_attractive_area")
COMPARED += ("adhesive_mean_gap", "mean_gap")
MODEL_TOO_HIGH = 0.05  # remaining share below which the model exceeds simulations


def main(job):
    inputs = job.input
    surface = datasets.read(inputs.surface, ["h_rms", "rms_slope", "psd"])
    verdicts = datasets.read(inputs.verdicts, ["remaining", "verdict", "margin"])
    pairs = verdicts.sel(surface=job.wildcards.real_surface)
    entries = datasets.parameters(verdicts)["materials"]
    names = provided.user_defined_first(map(str, pairs.material.values), provided.MATERIALS)
    materials = {name: entries[name] for name in names}
    labels = {name: entry["label"] for name, entry in materials.items()}
    mine = [name for name in names if name not in provided.MATERIALS]

    surface_figures.draw_surface(surface, job.output.figure)
    found = surface_figures.find_curves(pairs, labels)
    surface_figures.draw_still(found, job.output.curves)
    curves = contact = bem = None
    if found:
        curves = {
            "interactive": interactive.embed(surface_figures.draw_interactive(found)),
            "still": pages.embed_png(job.output.curves),
        }
    if inputs.get("contact"):
        contact = describe_contact(inputs, pairs, [materials[name] for name in mine])
    if inputs.get("measured_contact"):
        bem = describe_measured_contact(
            datasets.read(inputs.measured_contact, ["a_v"]), surface, materials.values()
        )
    write_page(
        inputs.template,
        job.output.page,
        files=dict(inputs.items()),
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
        curves=curves,
        contact=contact,
        bem=bem,
        library=interactive.library() if curves or contact else "",
    )


def describe_sizes(surface):
    """What the template cannot compute: sizes with errors, and what was seen of the surface."""
    low, high = surface.C0.values
    found = describe_surface(surface) | {
        "steep": float(surface.rms_slope.max()) > MOST_SLOPE,
        "prefactor": interval(low, high),
        "many_missing": float(surface.get("missing_fraction", 0)) > MANY_MISSING,
    }
    if "C0_relative_error" in surface:
        # A factor: C0 is known at q = 1, far from the data.
        factor = np.exp(COVERS * surface.C0_relative_error)
        found["prefactor"] = f"{number(low, 2)} ×÷ {number(factor, 2)}"
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
    return describe_pair(pair) | {
        "material": entry["label"],
        "modulus": describe_modulus(entry),
        "rates": list_rates(solid, pair) if solid.depends_on_rate and judged else [],
        "criteria": explain(pair, solid.work_of_adhesion) if judged else [],
    }


def list_rates(solid, pair):
    """Frequencies at which the pair sticks, as texts, for the thresholds at both ends."""
    texts = []
    for threshold in pair.modulus_threshold.sel(end=["rough", "smooth"]).values:
        found = crossings(solid.plane_strain, threshold, pair.frequency.values)
        words = [f"{'below' if up else 'above'} {number(f, 2)} Hz" for f, up in found]
        if not words:
            always = np.nanmax(pair.modulus.values) < threshold
            words = ["at every frequency" if always else "at no frequency"]
        texts.append(" and ".join(words))
    return list(dict.fromkeys(texts))


def describe_contact(files, pairs, mine):
    """Simulated contact and pull-off of the measured heights; None where there is no map."""
    contact, pull_off = datasets.read(files.contact), datasets.read(files.pull_off)
    if contact.attrs["left_out"]:
        return None
    solids = {entry["label"]: read_material(entry) for entry in mine}
    loads = contact_figure.list_loads(contact, solids)
    made = datasets.parameters(pull_off)
    figure = contact_figure.draw_interactive(contact, pull_off, loads)
    found = {
        "interactive": interactive.embed(figure),
        "still": pages.embed_png(files.contact_figure),
        "data": contact,
        "coarse": exceeds(contact.shortest_wavelength, contact.cutoff_wavelength),
        "loads": loads,
        "pulled": made["label"],
        "pull_off": pull_off,
        "separated": not pull_off.attrs["left_out"],
    }
    if found["separated"]:
        disagreeing = [name for name in ("separation", "pull_off") if not overlap(pull_off, name)]
        too_high = all(pull_off[name] < pull_off[f"predicted_{name}"] for name in disagreeing)
        compared = (
            as_pair(pull_off, ""),
            as_pair(pull_off, "predicted_"),
            pairs.sel(material=made["material"]),
        )
        found |= {
            "rated": any(key in made for key in RATE_KEYS),
            "longer_range": exceeds(pull_off["range"], pull_off.material_range),
            "missing_waves": exceeds(pull_off.shortest_wavelength, pull_off.judged_wavelength),
            "disagreeing": disagreeing,
            "known_too_high": too_high and float(pull_off.separation) < MODEL_TOO_HIGH,
            "compared": [
                {"remaining": describe_share(each), "pull_off": describe_pull_off(each)}
                for each in compared
            ],
        }
    return found


def exceeds(length, other):
    """Whether a length is longer than another by more than rounding."""
    return float(length) > 1.001 * float(other)


def overlap(pull_off, name):
    """Whether the limits of simulation and model have values in common."""
    low, model_low = pull_off[f"{name}_low"], pull_off[f"predicted_{name}_low"]
    high, model_high = pull_off[f"{name}_high"], pull_off[f"predicted_{name}_high"]
    return bool(low <= model_high and model_low <= high)


def as_pair(pull_off, prefix):
    """Simulated or predicted numbers under the names of a verdict, at ends that agree."""
    found = {
        f"{name}{end}": pull_off[f"{prefix}{simulated}{end}"]
        for name, simulated in (("remaining", "separation"), ("pull_off", "pull_off"))
        for end in ("", "_low", "_high")
    }
    # Where this is large the model knows no pull-off. A simulation does.
    found["energy_ratio"] = pull_off.energy_ratio * bool(prefix)
    return xr.Dataset(found).expand_dims(end=2)


def describe_measured_contact(bem, surface, materials):
    """Contact of the measured heights with error estimates, by load, with and without adhesion."""
    loads = [bem.sel(pressure=pressure) for pressure in bem.pressure.values]
    found = {
        "loads": [describe_load(load.interp({"range": QUOTED_RANGE})) for load in loads],
        "periodic": "given" in bem.periodisation.values,
        "load": LOAD,
        "margins": [find_onset(bem, entry, surface) for entry in materials],
        "adhesive": [],
    }
    if "adhesive_contact_area" in bem:
        found |= {
            "adhesive": list(map(describe_adhesive_load, loads)),
            "edge_pixel": float(bem.edge_resolution.isel(resolution=-1).max()),
            "largest_edge_pixel": edge_zone.COARSEST,
        }
    return found


def describe_load(at):
    """Area and a_V with their errors, by every way to make heights periodic and by theory."""
    ways = list(map(str, at.periodisation.values))
    return {"pressure": float(at.pressure)} | {
        name: {
            "value": combine_ways(at[name]),
            "ways": dict(zip(ways, at[name].isel(resolution=-1).values, strict=True)),
            "theory": np.sort(at[f"theory_{name}"].values),
        }
        for name in ("area_fraction", "a_v")
    }


def describe_adhesive_load(at):
    """Areas and mean gap with full adhesion beside those without, each with its error."""
    applied = at.applied_pressure.values
    return {
        "pressure": float(at.pressure),
        "applied": quantity(applied.min(), applied.max(), "Pa"),
        "values": [combine_ways(at[name]) for name in COMPARED],
        "residual": float(at.adhesive_residual.max()),
    }


def combine_ways(values):
    """Mean over both ways to make heights periodic; its error, also by half the resolution."""
    fine = values.isel(resolution=-1)
    change = values.diff("resolution").isel(resolution=-1).mean("periodisation")
    return float(fine.mean()), float(np.hypot(np.ptp(fine.values) / 2, change))


def find_onset(bem, entry, surface):
    """a_V at a material's range on the pressed heights, and the onset that follows, as texts."""
    solid = read_material(entry)
    at = bem.sel(pressure=LOAD, method="nearest")
    h, slope = (float(np.sqrt(np.prod(surface[name].values))) for name in ("h_rms", "rms_slope"))
    ratio = solid.range / h
    texts = {"a_v": NOTHING, "margin": NOTHING, "resolved": False}
    texts |= {"material": entry["label"], "range": number(ratio, 2)}
    # No a_V outside the gaps computed; no onset for ranges that the grid does not resolve.
    if not at["range"][0] <= ratio <= at["range"][-1]:
        return texts
    value, error = combine_ways(at.a_v.interp({"range": ratio}))
    texts["a_v"] = with_error(value, error)
    if ratio < float(at.edge_gap.isel(resolution=-1).max()):
        return texts
    length = solid.work_of_adhesion / solid.modulus
    limits = [max(value - error, 0.01 * value), value + error]
    onset = equivalent_sphere.attraction(h, float(surface.q0), slope, length, solid.range, limits)
    margins = onset.ratio * onset.error_factor ** np.array([-1.0, 1.0])
    return texts | {"margin": interval(*margins, 2), "resolved": True}


if __name__ == "__main__":
    main(start(globals(), "write_surface", real_surface="jacksboro"))
