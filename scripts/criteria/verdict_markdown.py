"""Verdicts as a page of Markdown."""

from common.formatting import NOTHING, interval, percent, table
from criteria.texts import (
    MPA,
    describe_pull_off,
    describe_share,
    describe_threshold,
    show_probability,
    show_stress,
)
from criteria.words import find_limits
from stickiness.criteria.pair import FULL_SHARE, NOT_JUDGED, WORDS
from stickiness.criteria.registry import CRITERIA, EDGES, REMAINING
from stickiness.criteria.verdict import THEORY_ERROR
from stickiness.remaining.prediction import DEFAULT_SHARE

HEAD = """\
# Do they stick?

**What remains.** Share of the work of adhesion w that remains on the rough surface. A pair sticks
if at least {wanted} remains. The share follows from w/U_full, the work of adhesion over the elastic
energy of full contact. For H > 1/2 the rms height and the longest waves set this energy. The range
of the attraction matters less the larger w/U_full is. Limits are in brackets. Those of the model
cover 90 % where more than 5 % remains. On a measured surface limits are quantiles of 5 and 95 %
over the spectra that agree with the measurement and over the errors of the model. On one from the
literature they are the limits of the model at the plausible ends of what is known of it. A share
below 0.1 % is written as 0 %.

**Verdict.** *Sticks*: at least {wanted} remains, within all limits. *Sticks fully*: at least {full}
does. *Depends*: {wanted} lies within the limits. *Touches without hold*: less than {wanted}
remains, but contact grows by itself at the finest wave. *Does not stick*: contact does not grow by
itself either. *Not judged*: the measurement has what no surface has; its page says what, and what
helps.

**Margin.** Adhesion length w/E* over the one at which {wanted} remains, within its limits; above 1
the pair sticks. **E* threshold**: the modulus below which it sticks. Both have the same relative
errors. E* = E/(1 − ν²) is the plane-strain modulus; the column before has that of the material at
1 Hz. Below 1 Pa and above 10 TPa thresholds are bounds.

**Pull-off.** Largest mean tension on separation. Close to full contact its high limit is the
strength of the attraction, because that state was not simulated.

**P.** Share of the spectra and errors of the model that agree with the measurement and stick. Only
measured surfaces have one.

**Onset at the finest wave.** Attraction over repulsion at equal area of contact, by the edges of
contact. Above 1 contact grows by itself at the finest wave. That does not tell whether it holds.
It rests on a_V of the pair: Persson's theory on the spectrum of the surface, at the range of the
material over h_rms. Its error is taken as {theory}. **DMT**: the margin of the paper's
criterion in the same form, with the same a_V.

**Layers.** A material with a thickness is a layer. What remains, and Persson–Tosatti's criterion,
know that; the other criteria and the onset take a half-space.

Moduli that depend on the rate are taken at 1 Hz; verdicts.nc has other rates.

"""
COMPARED = """

# Criteria compared

Each row covers all materials and both ends of a surface. The second column is the adhesion length,
work of adhesion over E*, above which {wanted} of the work of adhesion remains. The others are the
modulus below which a pair sticks by another criterion, over the one below which {wanted} remains.
Figure 9 shows the influence of the shortest wavelength.

"""
COLUMNS = (
    *("material", "surface", "verdict", "remains", "pull-off [kPa]", "E* [MPa]"),
    *("E* threshold [MPa]", "P", "w/U_full", "margin"),
    *("onset at the finest wave", "DMT", "criteria that disagree"),
)


def write_markdown(dataset, materials, names):
    """Text of the page; `names` are the labels of the surfaces."""
    wanted = percent(DEFAULT_SHARE)
    head = HEAD.format(
        wanted=wanted,
        full=percent(FULL_SHARE),
        theory=percent(THEORY_ERROR),
    )
    rows = [
        (
            materials[material]["label"],
            names[surface],
            *describe_pair(dataset.sel(material=material, surface=surface)),
        )
        for material in dataset.material.values
        for surface in dataset.surface.values
    ]
    return (
        head
        + table(COLUMNS, rows)
        + COMPARED.format(wanted=wanted)
        + compare_thresholds(dataset, names)
    )


def describe_pair(pair):
    """Cells of a pair's row after material and surface."""
    if int(pair.verdict) == NOT_JUDGED:
        return WORDS[NOT_JUDGED], *[NOTHING] * (len(COLUMNS) - 3)
    differs = [CRITERIA[str(c)].label for c in pair.criterion.values[pair.disagrees == 1]]
    dmt = pair.margin.sel(criterion="violano") ** (5 / 3)  # h_rms limit over h_rms, as a ratio
    onset = pair.margin.sel(criterion=EDGES)
    return (
        WORDS[int(pair.verdict)],
        describe_share(pair),
        describe_pull_off(pair),
        show_stress(float(pair.modulus_quoted), MPA),
        describe_threshold(pair),
        show_probability(pair),
        show_interval(pair.energy_ratio.min(), pair.energy_ratio.max(), 2),
        show_interval(*find_limits(pair, "margin"), 2),
        show_interval(onset.min(), onset.max(), 2),
        show_interval(dmt.min(), dmt.max(), 2),
        ", ".join(differs) or "none",
    )


def compare_thresholds(dataset, names):
    """Table of thresholds by every criterion, for each surface over all materials and both ends."""
    by = dataset.threshold_by_criterion
    ours = by.sel(criterion=REMAINING)
    length = dataset.work_of_adhesion / ours * 1e9
    others = [c for c in CRITERIA.values() if c.has_length and c.name != REMAINING]
    columns = [length, *(by.sel(criterion=c.name) / ours for c in others)]
    rows = []
    for surface in by.surface.values:
        cells = [column.sel(surface=surface) for column in columns]
        if ours.sel(surface=surface).isnull().all():  # not judged
            continue
        rows.append((names[surface], *(show_interval(x.min(), x.max(), 2) for x in cells)))
    heads = ("surface", "l_a at the threshold [nm]", *(c.label for c in others))
    return table(heads, rows)


def show_interval(low, high, digits=3):
    return interval(float(low), float(high), digits)
