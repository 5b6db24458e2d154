"""Verdict for every material on every surface, by the edges of contact and other criteria."""

import numpy as np
import xarray as xr

from pipeline.conventions import logarithmic_grid
from pipeline.job import start
from pipeline.numbers import interval
from pipeline.tables import table
from pipeline.verdicts.a_v import measured_a_v, surface_a_v
from pipeline.verdicts.budgets import budgeted
from pipeline.verdicts.materials import material
from pipeline.verdicts.thresholds import POWERS, threshold
from pipeline.verdicts.uncertainty import DRAWN, QUANTILES, uncertain
from stickiness import criteria
from stickiness.adhesion import equivalent_sphere
from stickiness.core import datasets

ENDS = ("smooth", "rough")
NEEDED = ("h_rms", "rms_slope", "rms_curvature", "elastic_energy", "q0", "hurst")
EDGES = "edge_adhesion"
FULL_CONTACT = "persson_tosatti"
NOT_STICKY, DEPENDS, STICKY, UNDECIDED = range(4)
WEAK, BETWEEN, TOUGH, STRONG = range(4)
DIMS = ("material", "surface", "end")
HEAD = """\
# Do they stick?

By attraction at the edges of the contact (stickiness.edge_adhesion): attraction over repulsion at
equal area of contact, above 1 sticks. It takes the area within the range of attraction from a_V
of the pair (theory on the surface's own spectrum at the material's range over h_rms, times the
ratio of simulation to theory, {ratio:.2f}), and what attraction does at an edge from the sphere of
Maugis that has the same attractive area and the same edge. The strength of the edges, Tabor's
parameter, tells which model that is: *weak* (up to {weakest:g}), the paper's criterion but for
the effect at edges, range and work of adhesion matter; *tough* (from {tough:g} on, within
{within:.0%} of JKR), the work of adhesion alone, the range only through a_V; *strong* (from
{tough:g} on, but not near JKR), attraction reaches as far as the patches of contact are wide, so
that the range still matters; or *between*.

The margin goes from the rough end of the surface at the lowest a_V to its smooth end at the
highest, the model's own error included: against full simulation a factor of {weak:g} for weak
edges and of {strong:g} up to a strength of {strongest:g}; † marks pairs beyond what was simulated,
which rest on closed forms alone and for which {beyond:g} is taken. P: share of the spectra, a_V and
model errors that agree with what was measured and stick, where there is a measurement. *Depends*:
on that range (P between 5 and 95 %). *Undecided*: contact does not grow by itself, but if full
once it would hold by its energy. Moduli that depend on the rate are taken at 1 Hz; verdicts.nc
has other rates. E* threshold: modulus below which the pair sticks. DMT: the margin, in the same
form, of the paper's criterion with the same a_V; for comparison the constant
{constant}.

"""
COMPARED = """

# Criteria compared

For each surface, over all materials and both of its ends: adhesion length, work of adhesion over
E*, above which the pair sticks by the edges; and the modulus below which a pair sticks by another
criterion, over the one by the edges. Figure 9 shows what the shortest wavelength does to them.

"""
VERDICTS = ("not sticky", "depends", "sticky", "undecided")
REGIMES = ("weak", "between", "tough", "strong")


def main(job):
    constant = measured_a_v(job.input, job.params.pressure)
    names = job.params.surfaces
    surfaces = dict(zip(names, (datasets.read(f, NEEDED) for f in job.input.surfaces), strict=True))
    a_v = dict(zip(names, (surface_a_v(f, constant) for f in job.input.theories), strict=True))
    materials = {name: material(entry) for name, entry in job.params.materials.items()}
    frequencies = logarithmic_grid(job.params.frequencies)
    dataset = judged(materials, surfaces, a_v, constant, frequencies)
    datasets.write(
        dataset,
        job.output.dataset,
        title="verdicts of the stickiness criteria",
        parameters={"materials": job.params.materials, "pressure": job.params.pressure},
    )
    with datasets.whole_file(job.output.table) as path:
        text = markdown(dataset, constant, job.params.materials, surfaces)
        path.write_text(text, encoding="utf-8")


def judged(materials, surfaces, a_v, constant, frequencies):
    """Every criterion for every material on both ends of every surface."""
    pairs = known(materials, surfaces, a_v)
    margins = every_margin(pairs, constant)
    of_edges = edges(pairs)
    by_criterion = thresholds(pairs, margins, of_edges["modulus_threshold"][1])
    dataset = xr.Dataset(
        {
            "margin": ((*DIMS, "criterion"), np.stack(list(margins.values()), axis=-1)),
            "a_v": constant.value,
            "a_v_low": constant.low,
            "a_v_high": constant.high,
            **{name: pairs[name] for name in ("pair_a_v", "pair_a_v_low", "pair_a_v_high")},
            "range_over_h_rms": (DIMS, pairs.range.values / pairs.h_rms.values),
            **of_edges,
            "work_of_adhesion": ("material", [m.work_of_adhesion for m in materials.values()]),
            "threshold_by_criterion": ((*DIMS, "criterion"), by_criterion),
        },
        coords={
            "material": list(materials),
            "surface": list(surfaces),
            "end": list(ENDS),
            "criterion": list(margins),
        },
    )
    dataset = dataset.assign(probabilities(materials, surfaces, a_v))
    dataset = dataset.assign(rates(pairs, materials, frequencies))
    dataset["verdict"] = verdict(dataset)
    dataset["disagrees"] = disagreement(dataset)
    draws = {name: surface.sizes.get("draw", 0) for name, surface in surfaces.items()}
    return budgeted(annotated(dataset), constant, draws)


def known(materials, surfaces, a_v):
    """What the criteria need of every pair in SI units, all on the dimensions `DIMS`."""
    solids = materials.values()
    by_end = ("h_rms", "rms_slope", "rms_curvature", "elastic_energy")
    pairs = xr.Dataset(
        {
            "modulus": ("material", [solid.modulus for solid in solids]),
            "work": ("material", [solid.work_of_adhesion for solid in solids]),
            "range": ("material", [solid.range for solid in solids]),
            "q0": ("surface", [float(surface.q0) for surface in surfaces.values()]),
            **{
                name: (
                    DIMS[1:],
                    [surface[name].sel(end=list(ENDS)) for surface in surfaces.values()],
                )
                for name in by_end
            },
        }
    )
    found = [
        [[a_v[name].at(solid.range / h) for h in surface.h_rms.sel(end=list(ENDS)).values]
         for name, surface in surfaces.items()]
        for solid in solids
    ]  # fmt: skip
    for name, values in zip(("", "_low", "_high"), np.moveaxis(found, -1, 0), strict=True):
        pairs[f"pair_a_v{name}"] = DIMS, values
    pairs["length"] = pairs.work / pairs.modulus
    return xr.broadcast(pairs)[0].transpose(*DIMS)


def every_margin(pairs, constant):
    """Margins of all criteria."""
    h, q0, length, reach = (pairs[name].values for name in ("h_rms", "q0", "length", "range"))
    slope, curvature = pairs.rms_slope.values, pairs.rms_curvature.values
    verdicts = {
        "violano": criteria.violano(h, q0, length, reach, pairs.pair_a_v.values),
        "violano_constant": criteria.violano(h, q0, length, reach, constant.value),
        "violano_printed": criteria.violano_printed(h, q0, length, reach),
        "pastewka_robbins": criteria.pastewka_robbins(slope, curvature, length, reach),
        "fuller_tabor": criteria.fuller_tabor(h, curvature, length),
        "bearing_area": criteria.bearing_area(h, q0, length, reach),
        FULL_CONTACT: criteria.persson_tosatti(pairs.elastic_energy.values, length),
        "dahlquist": criteria.dahlquist(pairs.modulus.values),
    }
    ours = attraction(pairs, pairs.length.values, pairs.pair_a_v.values).ratio
    return {EDGES: ours} | {name: verdict.margin for name, verdict in verdicts.items()}


def thresholds(pairs, margins, by_edges):
    """Modulus below which each criterion calls a pair sticky, that of the edges being known."""
    length, work = pairs.length.values, pairs.work.values
    found = {
        name: work / threshold(name, margins[name], length) if name in POWERS else np.nan * work
        for name in margins
    }
    found["dahlquist"] = np.full_like(work, criteria.DAHLQUIST_LIMIT)
    found[EDGES] = by_edges
    return np.stack(list(found.values()), axis=-1)


def attraction(pairs, length, a_v):
    """`equivalent_sphere.attraction` of all pairs."""
    h, q0, slope, reach = (pairs[name].values for name in ("h_rms", "q0", "rms_slope", "range"))
    return equivalent_sphere.attraction(h, q0, slope, length, reach, a_v)


def limits(pairs, length):
    """Lowest and highest attraction over repulsion, for the limits of a_V and of the model."""
    low, high = (
        attraction(pairs, length, pairs[f"pair_a_v_{limit}"].values) for limit in ("low", "high")
    )
    return low.ratio / low.error_factor, high.ratio * high.error_factor


def edges(pairs):
    """What the edges of every pair are, and the modulus at which attraction balances repulsion."""
    found = attraction(pairs, pairs.length.values, pairs.pair_a_v.values)
    low, high = limits(pairs, pairs.length.values)
    h, q0, reach = (pairs[name].values for name in ("h_rms", "q0", "range"))
    thresholds = [
        threshold_length(pairs, *limit) for limit in (("", 0), ("_low", -1), ("_high", 1))
    ]
    validity = criteria.dmt_validity(h, q0, pairs.length.values, reach)
    t, tau = found.attractive_over_contact, found.strength
    regime = np.select(
        [tau <= equivalent_sphere.WEAK, tau < equivalent_sphere.TOUGH, found.tough],
        [WEAK, BETWEEN, TOUGH],
        STRONG,
    )
    values = {
        "margin_low": low,
        "margin_high": high,
        "modulus_threshold": pairs.work.values / thresholds[0],
        "modulus_threshold_low": pairs.work.values / thresholds[1],
        "modulus_threshold_high": pairs.work.values / thresholds[2],
        "edge_strength": tau,
        "attractive_over_contact": t,
        "over_dmt": found.effect,
        "regime": regime.astype("i1"),
        "simulated": found.simulated.astype("i1"),
        "jtb_margin": validity.margin,
    }
    return {name: (DIMS, value) for name, value in values.items()}


def threshold_length(pairs, end, sign):
    """Adhesion length at which attraction balances repulsion, at one limit of a_V and model."""
    h, q0, slope, reach = (pairs[name].values for name in ("h_rms", "q0", "rms_slope", "range"))
    a_v, by_edges = pairs[f"pair_a_v{end}"].values, equivalent_sphere.adhesion_length_threshold
    length = by_edges(h, q0, slope, reach, a_v)
    if not sign:
        return length
    # The model's error is that at the threshold it has without.
    error = equivalent_sphere.attraction(h, q0, slope, length, reach, a_v).error_factor
    return by_edges(h, q0, slope, reach, a_v, error**sign)


def probabilities(materials, surfaces, a_v):
    """Distribution of the margin on surfaces that were measured."""
    shape = (len(materials), len(surfaces))
    share, spectrum, from_model = (np.full(shape, np.nan) for _ in range(3))
    quantiles = np.full((*shape, len(QUANTILES)), np.nan)
    for i, solid in enumerate(materials.values()):
        for j, (name, surface) in enumerate(surfaces.items()):
            if all(drawn in surface for drawn in DRAWN):
                found = uncertain(solid, surface, a_v[name])
                share[i, j], quantiles[i, j] = found.probability, found.quantiles
                spectrum[i, j], from_model[i, j] = found.from_spectrum, found.from_model
    return {
        "probability": (DIMS[:2], share),
        "quantile": ("quantile", list(QUANTILES)),
        "margin_quantile": ((*DIMS[:2], "quantile"), quantiles),
        "error_of_spectrum": (DIMS[:2], spectrum),
        "error_of_model": (DIMS[:2], from_model),
    }


def rates(pairs, materials, frequencies):
    """Modulus and limits of the margin at every frequency."""
    moduli = [np.atleast_1d(m.plane_strain.storage(frequencies)) for m in materials.values()]
    modulus = xr.DataArray(moduli, dims=("material", "frequency"))
    # Beyond a material's table there is none.
    length = (pairs.work / modulus.where(modulus.notnull(), 1.0)).transpose("frequency", *DIMS)
    known = modulus.notnull().transpose("frequency", "material").values[..., None]
    low, high = limits(pairs, length.values)
    dims = ("frequency", "material", "surface")
    return {
        "frequency": ("frequency", frequencies),
        "modulus": modulus,
        "modulus_quoted": ("material", [m.modulus for m in materials.values()]),
        "margin_low_at_rate": (dims, np.where(known, low.min(axis=-1), np.nan)),
        "margin_high_at_rate": (dims, np.where(known, high.max(axis=-1), np.nan)),
        "depends_on_rate": ("material", [int(m.depends_on_rate) for m in materials.values()]),
    }


def verdict(dataset):
    """Verdict over the whole range of the surface, the limits of a_V and the model's error.

    On a measured surface it is that of the draws: sticky if at least 95 % of them stick, not sticky
    if at most 5 % do.

    The criterion asks whether contact grows by itself. Where it does not, but the energy of full
    contact is less than the work of adhesion, history decides: undecided.
    """
    surely = (dataset.margin_low > 1).all("end")
    possibly = (dataset.margin_high > 1).any("end")
    if "probability" in dataset:
        drawn = np.isfinite(dataset.probability)
        surely = surely.where(~drawn, dataset.probability >= QUANTILES[-1])
        possibly = possibly.where(~drawn, dataset.probability > QUANTILES[0])
    decided = NOT_STICKY + possibly.astype("i1") + surely.astype("i1")
    holds = (dataset.margin.sel(criterion=FULL_CONTACT, drop=True) > 1).any("end")
    return decided.where((decided != NOT_STICKY) | ~holds, UNDECIDED).astype("i1")


def disagreement(dataset):
    """Tell which criteria say the opposite of that of the edges at either end."""
    sticky = dataset.margin > 1
    differs = sticky != sticky.sel(criterion=EDGES)
    return differs.any("end").astype("i1")


def annotated(dataset):
    of_edges = "attraction over repulsion at equal area of contact, by the edges"
    threshold = "plane-strain modulus below which the pair sticks"
    return datasets.annotate(
        dataset,
        material=("1", "material"),
        surface=("1", "real surface"),
        end=("1", "smooth or rough end of what is known of the surface"),
        criterion=("1", "stickiness criterion"),
        margin=("1", "threshold over actual value in the criterion's own form; sticky above 1"),
        margin_low=("1", f"{of_edges}, at the low limits of a_V and of the model"),
        margin_high=("1", f"{of_edges}, at the high limits of a_V and of the model"),
        range_over_h_rms=("1", "range of attraction over rms height"),
        pair_a_v=("1", "a_V of the pair: its surface's spectrum, its range over h_rms"),
        pair_a_v_low=("1", "low limit of the pair's a_V"),
        pair_a_v_high=("1", "high limit of the pair's a_V"),
        edge_strength=("1", "Tabor's parameter of the edges of contact, l_a d/range^2"),
        attractive_over_contact=("1", "area within the range over area of contact"),
        over_dmt=("1", "attraction over that of the DMT limit, at equal area of contact"),
        regime=("1", "edges: 0 weak, 1 between, 2 tough (JKR), 3 strong, not JKR"),
        simulated=("1", "1 where full simulation bears the model out"),
        jtb_margin=("1", "rms height over the smallest at which the DMT limit holds (JTB)"),
        modulus_threshold=("Pa", threshold),
        modulus_threshold_low=("Pa", f"{threshold}, at the low limits of a_V and of the model"),
        modulus_threshold_high=("Pa", f"{threshold}, at the high limits of a_V and of the model"),
        work_of_adhesion=("J/m^2", "work of adhesion"),
        threshold_by_criterion=("Pa", "plane-strain modulus below which a criterion says sticky"),
        a_v=("1", "constant a_V of a broad spectrum, in the window of the fit"),
        a_v_low=("1", "a_V less its error"),
        a_v_high=("1", "a_V plus its error"),
        verdict=("1", "0 not sticky, 1 depends on what is not known, 2 sticky, 3 undecided"),
        probability=("1", "share of draws that stick", "surface not measured"),
        quantile=("1", "quantile of the draws"),
        margin_quantile=("1", "quantiles of the margin by the edges", "not measured"),
        error_of_spectrum=("1", "standard deviation of ln margin by the spectrum", "not measured"),
        error_of_model=("1", "standard deviation of ln margin by a_V and model", "not measured"),
        frequency=("Hz", "frequency of loading"),
        modulus=("Pa", "plane-strain storage modulus", "beyond the material's table"),
        modulus_quoted=("Pa", "plane-strain storage modulus at 1 Hz, of the quoted margins"),
        margin_low_at_rate=("1", "lowest margin at a frequency", "beyond the material's table"),
        margin_high_at_rate=("1", "highest margin at a frequency", "beyond the material's table"),
        depends_on_rate=("1", "1 where the modulus is given as a function of the frequency"),
        disagrees=("1", "1 where a criterion says the opposite of that of the edges"),
    )


def markdown(dataset, constant, materials, surfaces):
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
    pairs = [(m, s) for m in dataset.material.values for s in dataset.surface.values]
    columns = ("material", "surface", "verdict", "margin", "P", "edges", "DMT", "a_V of the pair")
    columns += ("E* threshold [MPa]", "criteria that disagree")
    verdicts = table(columns, [row(dataset, *pair, materials, surfaces) for pair in pairs])
    return head + verdicts + COMPARED + comparison(dataset, surfaces)


def comparison(dataset, surfaces):
    """Table of thresholds by every criterion, for each surface over all materials and both ends."""
    by = dataset.threshold_by_criterion
    over = by / by.sel(criterion=EDGES)
    names = [str(name) for name in by.criterion.values if name in POWERS]
    length = dataset.work_of_adhesion / by.sel(criterion=EDGES) * 1e9
    rows = [
        (
            datasets.parameters(surfaces[name])["label"],
            span(length.sel(surface=name).min(), length.sel(surface=name).max(), 2),
            *(
                span(*(end(over.sel(surface=name, criterion=one)) for end in (np.min, np.max)), 2)
                for one in names
            ),
        )
        for name in by.surface.values
    ]
    columns = ("surface", "l_a at the threshold by the edges [nm]")
    return table((*columns, *(name.replace("_", " ") for name in names)), rows)


def row(dataset, material, surface, materials, surfaces):
    pair = dataset.sel(material=material, surface=surface)
    rough, smooth = pair.sel(end="rough"), pair.sel(end="smooth")
    differs = [str(c) for c in pair.criterion.values if pair.disagrees.sel(criterion=c)]
    dmt = pair.margin.sel(criterion="violano") ** (5 / 3)  # h_rms limit over h_rms, as a ratio
    return (
        materials[material]["label"],
        datasets.parameters(surfaces[surface])["label"],
        VERDICTS[int(pair.verdict)] + ("" if pair.simulated.all() else " †"),
        span(pair.margin_low.min(), pair.margin_high.max()),
        f"{float(pair.probability):.0%}" if np.isfinite(pair.probability) else "–",
        edges_text(pair),
        span(dmt.min(), dmt.max()),
        span(pair.pair_a_v_low.min(), pair.pair_a_v_high.max()),
        span(rough.modulus_threshold / 1e6, smooth.modulus_threshold / 1e6),
        ", ".join(differs).replace("_", " ") or "none",
    )


def edges_text(pair):
    """Regime of the edges with their strength."""
    regimes = dict.fromkeys(REGIMES[int(regime)] for regime in pair.regime.values)
    return f"{' to '.join(regimes)}, {span(*np.sort(pair.edge_strength.values), 2)}"


def span(low, high, digits=3):
    return interval(float(low), float(high), digits)


if __name__ == "__main__":
    main(start(globals(), "judge"))
