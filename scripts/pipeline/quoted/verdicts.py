"""Verdicts of pairs, and what other criteria say of them."""

import numpy as np
import xarray as xr

from pipeline.claims.criterion import CRYSTAL, EXAMPLES, PRINTED_LIMITS
from pipeline.claims.remaining import find_modulus, find_roughness
from pipeline.numbers import number, percent, table
from pipeline.pages.report import count_verdicts, labels_of
from pipeline.pages.verdict_texts import describe_pair
from pipeline.quoted.sources import Sources, say_count, say_range
from stickiness import criteria
from stickiness.core import datasets
from stickiness.criteria.pair import DEPENDS, NOT_STICKY, STICKS_FULLY, STICKY, TOUCHES
from stickiness.criteria.registry import EDGES, FULL_CONTACT, REMAINING
from stickiness.remaining import Roughness
from stickiness.remaining.prediction import DEFAULT_SHARE, ONSET_ERROR, SHORT_RANGE
from stickiness.remaining.share import ONSET, tough_share, weak_share

BELOW = 0.3, 0.4, 0.5  # w/U_full near the onset
TERRAIN = "jacksboro"  # left out where thresholds are compared
RIVALS = {
    "full_contact": FULL_CONTACT,
    "bearing_area": "bearing_area",
    "fuller_tabor": "fuller_tabor",
    "pastewka_robbins": "pastewka_robbins",
    "paper": "violano",
    "paper_constant": "violano_constant",
    "paper_printed": "violano_printed",
    "onset": EDGES,
}


def quote_counts(sources: Sources) -> dict[str, str]:
    verdicts = sources.read("criteria/verdicts")
    counts = count_verdicts(verdicts)
    return {
        "pairs": str(verdicts.verdict.size),
        "pairs.stick": str(counts[STICKY] + counts[STICKS_FULLY]),
        "pairs.fully": say_count(counts[STICKS_FULLY]),
        "pairs.touch": str(counts[TOUCHES]),
        "pairs.depend": str(counts[DEPENDS]),
        "pairs.not": str(counts[NOT_STICKY]),
        "wanted_share": percent(DEFAULT_SHARE),
    }


def quote_pairs(sources: Sources) -> dict[str, str]:
    """Every pair's verdict and what remains, materials in rows."""
    verdicts = sources.read("criteria/verdicts")
    materials = datasets.parameters(verdicts)["materials"]
    names = [str(name) for name in verdicts.surface.values]
    labels = labels_of({name: sources.read(f"real_surfaces/{name}") for name in names})
    rows = [
        (
            materials[str(material)]["label"],
            *(describe_cell(verdicts.sel(material=material, surface=name)) for name in names),
        )
        for material in verdicts.material.values
    ]
    return {"pairs.table": table(("", *(labels[name] for name in names)), rows)}


def describe_cell(pair: xr.Dataset) -> str:
    """Verdict, and what remains unless that is nothing."""
    found = describe_pair(pair)
    nothing = found["remaining"] == percent(0.0)
    return found["verdict"] + ("" if nothing else f", {found['remaining']}")


def quote_limits(sources: Sources) -> dict[str, str]:
    """Factors of the limits of the margin."""
    verdicts = sources.read("criteria/verdicts")
    margin = verdicts.margin.sel(criterion=REMAINING)
    return {
        "margin.below": say_range(margin / verdicts.margin_low, 3),
        "margin.above": say_range(verdicts.margin_high / margin, 3),
    }


def quote_rivals(sources: Sources) -> dict[str, str]:
    """Thresholds of E* of other criteria over that of the verdict, terrain aside."""
    verdicts = sources.read("criteria/verdicts")
    threshold = verdicts.threshold_by_criterion
    everywhere = threshold / threshold.sel(criterion=REMAINING)
    ratio = everywhere.sel(surface=verdicts.surface != TERRAIN)
    texts = {f"rival.{name}": say_range(ratio.sel(criterion=c)) for name, c in RIVALS.items()}
    differ = verdicts.disagrees.sel(criterion=[FULL_CONTACT, "bearing_area"]).sum(
        ("material", "surface")
    )
    return texts | {
        "rival.onset.everywhere": say_range(everywhere.sel(criterion=EDGES)),
        "rival.full_contact.pairs": say_count(int(differ[0])),
        "rival.bearing_area.pairs": say_count(int(differ[1])),
    }


def quote_roughness(sources: Sources) -> dict[str, str]:
    """h_rms/range up to which the paper's examples stick, by its formula and by what remains."""
    m = sources.read("criteria/map")
    shortest = datasets.parameters(m)["shortest_over_range"]
    printed = criteria.h_rms_limit(EXAMPLES, CRYSTAL, 1.0, criteria.PRINTED_A_V)
    edges, dmt, constant = (
        interpolate_at_crystal(m[f"h_rms_limit{end}"]) for end in ("_edges", "", "_constant")
    )
    lower = [float(np.exp((dmt - constant).interp(range_times_q0=np.log(q)))) for q in EXAMPLES]
    ratio = m.h_rms_limit / m.h_rms_limit_edges
    rows, stated, over = [], [], []
    for q0, said, formula in zip(EXAMPLES, PRINTED_LIMITS, printed, strict=True):
        value, low, high = (find_roughness(q0, shortest, sign) for sign in (0, -1, 1))
        onset = float(np.exp(edges.interp(range_times_q0=np.log(q0))))
        texts = [number(x, 2) for x in (said, formula, onset, value, low, high)]
        rows.append((number(q0), *texts[:4], f"{texts[4]} to {texts[5]}"))
        stated.append(number(said / value, 2))
        over.append(number(onset / said, 2))
    heads = ("range·q0", "h_rms/range as the paper states it", "with 9/4")
    heads += ("onset at the finest wave", f"{percent(DEFAULT_SHARE)} remains", "its limits")
    return {
        "roughness.table": table(heads, rows),
        "roughness.dmt": percent(float(abs(ratio - 1).max())),
        "roughness.constant": say_range(lower),
        "roughness.stated_over": f"{stated[0]}, {stated[1]} and {stated[2]}",
        "roughness.onset_over": f"{over[0]}, {over[1]} and {over[2]}",
    }


def interpolate_at_crystal(limit: xr.DataArray) -> xr.DataArray:
    """Logarithm of h_rms/range at the l_a/range of a crystal, by that of range q0."""
    logs = np.log(limit)
    names = ("range_times_q0", "adhesion_length_over_range")
    logs = logs.assign_coords({name: np.log(logs[name]) for name in names})
    return logs.interp(adhesion_length_over_range=np.log(CRYSTAL))


def quote_onset(sources: Sources) -> dict[str, str]:
    """Work of adhesion over the energy of full contact at which contact holds, short ranges."""
    rough = Roughness(h_rms=1.0, q0=1.0, elastic_energy=1.0)
    low, value, high = (float(rough.threshold(SHORT_RANGE, sign=sign)) for sign in (1, 0, -1))
    weak = [f"{100 * share:.1f}" for share in weak_share(BELOW, SHORT_RANGE)]
    return {
        "onset": f"{ONSET:.2f} ± {ONSET_ERROR:.2f}",
        "onset.weak": f"{', '.join(weak[:-1])} and {weak[-1]} %",
        "onset.tough": percent(float(tough_share(BELOW[-1]))),
        "onset.wanted": f"{value:.2f} ({low:.2f} to {high:.2f})",
    }


def quote_asphalt(sources: Sources) -> dict[str, str]:
    """Modulus below which the paper's block sticks to asphalt."""
    asphalt = sources.read("real_surfaces/asphalt")
    rough, smooth = (asphalt.sel(end=end) for end in ("rough", "smooth"))
    ends = [1e3 * find_modulus(end, 0) for end in (rough, smooth)]
    limits = 1e3 * find_modulus(rough, -1), 1e3 * find_modulus(smooth, 1)
    return {
        "asphalt.modulus": f"{say_range(ends)} kPa",
        "asphalt.rough": f"{number(ends[0], 2)} kPa",
        "asphalt.limits": f"{say_range(limits)} kPa",
    }


def quote_jtb(sources: Sources) -> dict[str, str]:
    """h_rms over the least that the DMT limit requires, materials on polished steel."""
    margin = sources.read("criteria/verdicts").jtb_margin.sel(surface="polished_steel", end="rough")
    return {
        "jtb.above": say_range(margin.where(margin > 1, drop=True)),
        "jtb.below": say_range(margin.where(margin <= 1, drop=True)),
    }


NUMBERS = (
    *(quote_counts, quote_pairs, quote_limits, quote_rivals),
    *(quote_roughness, quote_onset, quote_asphalt, quote_jtb),
)
