"""Verdicts as a page of Markdown."""

import numpy as np

from pipeline.numbers import interval, table
from stickiness.adhesion import equivalent_sphere
from stickiness.core import datasets
from stickiness.criteria.pair import REGIMES, WORDS
from stickiness.criteria.registry import CRITERIA, EDGES

HEAD = """\
# Do they stick?

**Margin.** Attraction over repulsion at equal area of contact, by the edges of contact. A pair
sticks where it is above 1. It rests on two numbers. The area within the range of attraction comes
from a_V of the pair: Persson's theory on the spectrum of the surface, at the range of the material
over h_rms, times the ratio of simulation to theory ({ratio:.2f}). The effect of attraction at an
edge is that of Maugis' sphere with the same attractive area and the same edge.

**Limits.** The margin has two ends. The low one is that of the rough end of the surface at the
lowest a_V, the high one that of the smooth end at the highest a_V. Both include the error of the
model. Against full simulation this is a factor of {weak:g} for weak edges, and of {strong:g} up to
a Tabor parameter of {strongest:g}. A † marks pairs beyond what was simulated. They rest on closed
forms alone, and their factor is taken as {beyond:g}.

**Verdict.** *Depends*: 1 lies within the limits. *Undecided*: contact does not grow by itself, but
full contact would hold by its energy. P is the share of spectra, values of a_V and model errors
that agree with the measurement and stick. Only measured surfaces have one; *depends* then means a
P between 5 and 95 %.

**Edges.** The Tabor parameter of the edges says which regime holds. *Weak* (up to {weakest:g}): the
paper's criterion but for the effect at edges; range and work of adhesion matter. *Tough* (from
{tough:g} on, within {within:.0%} of JKR): the work of adhesion matters, the range only through a_V.
*Strong* (from {tough:g} on, not near JKR): the range is as large as the patches of contact are
wide and still matters. *Between*: neither weak nor tough.

**Other columns.** E* threshold: the modulus below which the pair sticks. DMT: the margin of the
paper's criterion in the same form, with the same a_V. Moduli that depend on the rate are taken at
1 Hz; verdicts.nc has other rates. For comparison, the a_V of a broad spectrum:
{constant}.

"""
COMPARED = """

# Criteria compared

Each row covers all materials and both ends of a surface. The second column is the adhesion length,
work of adhesion over E*, above which a pair sticks by the edges of contact. The others are the
modulus below which a pair sticks by another criterion, over the one by the edges. Figure 9 shows
the influence of the shortest wavelength.

"""
COLUMNS = (
    *("material", "surface", "verdict", "margin", "P", "edges", "DMT", "a_V of the pair"),
    *("E* threshold [MPa]", "criteria that disagree"),
)


def write_markdown(dataset, constant, materials, surfaces):
    """Text of the page; `constant` is a `MeasuredAv`."""
    head = HEAD.format(
        ratio=constant.over_lattice,
        constant=constant.describe(),
        weakest=equivalent_sphere.WEAK,
        tough=equivalent_sphere.TOUGH,
        within=equivalent_sphere.TOUGH_WITHIN,
        weak=equivalent_sphere.ERROR_WEAK,
        strong=equivalent_sphere.ERROR_STRONG,
        strongest=equivalent_sphere.STRONGEST_SIMULATED,
        beyond=equivalent_sphere.ERROR_BEYOND,
    )
    names = {name: datasets.parameters(data)["label"] for name, data in surfaces.items()}
    rows = [
        (
            materials[material]["label"],
            names[surface],
            *describe_pair(dataset.sel(material=material, surface=surface)),
        )
        for material in dataset.material.values
        for surface in dataset.surface.values
    ]
    return head + table(COLUMNS, rows) + COMPARED + compare_thresholds(dataset, names)


def describe_pair(pair):
    """Cells of a pair's row after material and surface."""
    differs = [CRITERIA[str(c)].label for c in pair.criterion.values[pair.disagrees == 1]]
    dmt = pair.margin.sel(criterion="violano") ** (5 / 3)  # h_rms limit over h_rms, as a ratio
    threshold = pair.modulus_threshold / 1e6
    regimes = dict.fromkeys(REGIMES[int(regime)] for regime in pair.regime.values)
    return (
        WORDS[int(pair.verdict)] + ("" if pair.simulated.all() else " †"),
        show_interval(pair.margin_low.min(), pair.margin_high.max()),
        f"{float(pair.probability):.0%}" if np.isfinite(pair.probability) else "–",
        f"{' to '.join(regimes)}, {show_interval(*np.sort(pair.edge_strength.values), 2)}",
        show_interval(dmt.min(), dmt.max()),
        show_interval(pair.pair_a_v_low.min(), pair.pair_a_v_high.max()),
        show_interval(threshold.sel(end="rough"), threshold.sel(end="smooth")),
        ", ".join(differs) or "none",
    )


def compare_thresholds(dataset, names):
    """Table of thresholds by every criterion, for each surface over all materials and both ends."""
    by = dataset.threshold_by_criterion
    by_edges = by.sel(criterion=EDGES)
    length = dataset.work_of_adhesion / by_edges * 1e9
    others = [c for c in CRITERIA.values() if c.has_length and c.name != EDGES]
    columns = [length, *(by.sel(criterion=c.name) / by_edges for c in others)]
    rows = []
    for surface in by.surface.values:
        cells = (column.sel(surface=surface) for column in columns)
        rows.append((names[surface], *(show_interval(x.min(), x.max(), 2) for x in cells)))
    heads = ("surface", "l_a at the threshold by the edges [nm]", *(c.label for c in others))
    return table(heads, rows)


def show_interval(low, high, digits=3):
    return interval(float(low), float(high), digits)
