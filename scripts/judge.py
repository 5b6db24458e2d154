"""Verdict for every material on every real surface, by the derived criterion and by the others."""

import numpy as np
import xarray as xr

from _criteria import measured_a_v, surface_a_v
from _job import start
from _materials import material
from _model import logarithmic_grid
from _tables import table
from _uncertain import DRAWN, QUANTILES, at_frequencies, uncertain
from stickiness import criteria, datasets

ENDS = ("smooth", "rough")
NEEDED = ("h_rms", "rms_slope", "rms_curvature", "elastic_energy", "q0", "hurst")
DERIVED = "violano"
NOT_STICKY, DEPENDS, STICKY, UNDECIDED = range(4)
HEAD = """\
# Do they stick?

By the derived criterion, with a_V of the pair: theory on the surface's own spectrum at the
material's range over h_rms, times the ratio of simulation to theory ({ratio:.2f}), from the
lowest to the highest of the theory's variants and, for the smallest ranges, of Pastewka and
Robbins' estimate. For comparison the constant {constant}.

The margin is the largest rms height that sticks over the actual one, from the rough end of the
surface at the lowest a_V to its smooth end at the highest: above 1 sticks. P: share of the spectra
and a_V that agree with what was measured and stick, where there is a measurement. *Depends*: on
that range or on a_V (P between 5 and 95 %). Moduli that depend on the rate are taken at 1 Hz;
verdicts.nc has other rates. E* threshold: modulus below which the pair sticks. † marks pairs for
which the DMT limit, on which the criterion rests, does not hold (h_rms below the JTB limit, by the
factor given): attraction then pulls the surfaces closer, so that *sticky* stands but *not sticky*
becomes *undecided*.

"""
VERDICTS = ("not sticky", "depends", "sticky", "undecided")


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
    rows = [
        [
            [state(solid, surface.sel(end=end), a_v[name], constant) for end in ENDS]
            for name, surface in surfaces.items()
        ]
        for solid in materials.values()
    ]
    dims = ("material", "surface", "end")
    values = {
        key: (dims, [[[cell[key] for cell in row] for row in block] for block in rows])
        for key in rows[0][0][0]
        if key != "margins"
    }
    margins = [[[list(c["margins"].values()) for c in row] for row in block] for block in rows]
    dataset = xr.Dataset(
        values
        | {
            "margin": ((*dims, "criterion"), margins),
            "a_v": constant.value,
            "a_v_low": constant.low,
            "a_v_high": constant.high,
        },
        coords={
            "material": list(materials),
            "surface": list(surfaces),
            "end": list(ENDS),
            "criterion": list(rows[0][0][0]["margins"]),
        },
    )
    dataset = dataset.assign(probabilities(materials, surfaces, a_v))
    dataset = dataset.assign(rates(dataset, materials, frequencies))
    dataset["verdict"] = verdict(dataset)
    dataset["disagrees"] = disagreement(dataset)
    return annotated(dataset)


def probabilities(materials, surfaces, a_v):
    """Distribution of the derived criterion's margin on surfaces that were measured."""
    shape = (len(materials), len(surfaces))
    share, spectrum, from_a_v = (np.full(shape, np.nan) for _ in range(3))
    quantiles = np.full((*shape, len(QUANTILES)), np.nan)
    for i, solid in enumerate(materials.values()):
        for j, (name, surface) in enumerate(surfaces.items()):
            if all(drawn in surface for drawn in DRAWN):
                found = uncertain(solid, surface, a_v[name])
                share[i, j], quantiles[i, j] = found.probability, found.quantiles
                spectrum[i, j], from_a_v[i, j] = found.from_spectrum, found.from_a_v
    dims = ("material", "surface")
    return {
        "probability": (dims, share),
        "quantile": ("quantile", list(QUANTILES)),
        "margin_quantile": ((*dims, "quantile"), quantiles),
        "error_of_spectrum": (dims, spectrum),
        "error_of_a_v": (dims, from_a_v),
    }


def rates(dataset, materials, frequencies):
    """Modulus and limits of the margin at every frequency."""
    moduli = [np.atleast_1d(m.plane_strain.storage(frequencies)) for m in materials.values()]
    ends = dataset.margin_low.min("end"), dataset.margin_high.max("end")
    low, high = (
        [[at_frequencies(m, float(x), frequencies) for x in row] for m, row in pairs]
        for pairs in (list(zip(materials.values(), end.values, strict=True)) for end in ends)
    )
    dims = ("material", "surface", "frequency")
    return {
        "frequency": ("frequency", frequencies),
        "modulus": (("material", "frequency"), moduli),
        "modulus_quoted": ("material", [m.modulus for m in materials.values()]),
        "margin_low_at_rate": (dims, low),
        "margin_high_at_rate": (dims, high),
        "depends_on_rate": ("material", [int(m.depends_on_rate) for m in materials.values()]),
    }


def state(material, surface, a_v, constant):
    """Margins of all criteria for one material on one end of a surface, in SI units."""
    modulus, range_ = material.modulus, material.range
    work = material.work_of_adhesion
    length = work / modulus
    h, q0 = float(surface.h_rms), float(surface.q0)
    slope, curvature = float(surface.rms_slope), float(surface.rms_curvature)
    value, low, high = a_v.at(range_ / h)
    validity = criteria.dmt_validity(h, q0, length, range_)
    verdicts = {
        DERIVED: criteria.violano(h, q0, length, range_, value),
        "violano_constant": criteria.violano(h, q0, length, range_, constant.value),
        "violano_printed": criteria.violano_printed(h, q0, length, range_),
        "pastewka_robbins": criteria.pastewka_robbins(slope, curvature, length, range_),
        "fuller_tabor": criteria.fuller_tabor(h, curvature, length),
        "bearing_area": criteria.bearing_area(h, q0, length, range_),
        "persson_tosatti": criteria.persson_tosatti(float(surface.elastic_energy), length),
        "dahlquist": criteria.dahlquist(modulus),
    }
    return {
        "margins": {name: float(v.margin) for name, v in verdicts.items()},
        "margin_low": float(criteria.violano(h, q0, length, range_, low).margin),
        "margin_high": float(criteria.violano(h, q0, length, range_, high).margin),
        "modulus_threshold": criteria.modulus_threshold(h, q0, work, range_, value),
        "range_over_h_rms": range_ / h,
        "pair_a_v": value,
        "pair_a_v_low": low,
        "pair_a_v_high": high,
        "jtb_margin": float(validity.margin),
        "dmt_valid": int(validity.valid),
    }


def verdict(dataset):
    """Verdict over the whole range of the surface and the limits of a_V.

    On a measured surface it is that of the draws: sticky if at least 95 % of them stick, not sticky
    if at most 5 % do.

    Where the DMT limit does not hold, attraction pulls the surfaces closer than the repulsive gaps
    tell: what sticks there sticks all the more, but what does not is undecided.
    """
    surely = (dataset.margin_low > 1).all("end")
    possibly = (dataset.margin_high > 1).any("end")
    if "probability" in dataset:
        drawn = np.isfinite(dataset.probability)
        surely = surely.where(~drawn, dataset.probability >= QUANTILES[-1])
        possibly = possibly.where(~drawn, dataset.probability > QUANTILES[0])
    decided = NOT_STICKY + possibly.astype("i1") + surely.astype("i1")
    outside = (dataset.dmt_valid == 0).any("end")
    return decided.where((decided != NOT_STICKY) | ~outside, UNDECIDED).astype("i1")


def disagreement(dataset):
    """Tell which criteria say the opposite of the derived one at either end."""
    sticky = dataset.margin > 1
    differs = sticky != sticky.sel(criterion=DERIVED)
    return differs.any("end").astype("i1")


def annotated(dataset):
    return datasets.annotate(
        dataset,
        material=("1", "material"),
        surface=("1", "real surface"),
        end=("1", "smooth or rough end of what is known of the surface"),
        criterion=("1", "stickiness criterion"),
        margin=("1", "threshold over actual value in the criterion's own form; sticky above 1"),
        margin_low=("1", "margin of the derived criterion at the low limit of the pair's a_V"),
        margin_high=("1", "margin of the derived criterion at the high limit of the pair's a_V"),
        range_over_h_rms=("1", "range of attraction over rms height"),
        pair_a_v=("1", "a_V of the pair: its surface's spectrum, its range over h_rms"),
        pair_a_v_low=("1", "low limit of the pair's a_V"),
        pair_a_v_high=("1", "high limit of the pair's a_V"),
        jtb_margin=("1", "rms height over the smallest at which the DMT limit holds (JTB)"),
        modulus_threshold=("Pa", "plane-strain modulus below which the pair sticks"),
        dmt_valid=("1", "1 where the JTB condition for the DMT limit holds"),
        a_v=("1", "constant a_V of a broad spectrum, in the window of the fit"),
        a_v_low=("1", "a_V less its error"),
        a_v_high=("1", "a_V plus its error"),
        verdict=("1", "0 not sticky, 1 depends on what is not known, 2 sticky, 3 undecided"),
        probability=("1", "share of drawn spectra and a_V that stick", "surface not measured"),
        quantile=("1", "quantile of the draws"),
        margin_quantile=("1", "quantiles of the derived criterion's margin", "not measured"),
        error_of_spectrum=("1", "standard deviation of ln margin by the spectrum", "not measured"),
        error_of_a_v=("1", "standard deviation of ln margin by a_V", "not measured"),
        frequency=("Hz", "frequency of loading"),
        modulus=("Pa", "plane-strain storage modulus", "beyond the material's table"),
        modulus_quoted=("Pa", "plane-strain storage modulus at 1 Hz, of the quoted margins"),
        margin_low_at_rate=("1", "lowest margin at a frequency", "beyond the material's table"),
        margin_high_at_rate=("1", "highest margin at a frequency", "beyond the material's table"),
        depends_on_rate=("1", "1 where the modulus is given as a function of the frequency"),
        disagrees=("1", "1 where a criterion says the opposite of the derived one"),
    )


def markdown(dataset, constant, materials, surfaces):
    head = HEAD.format(ratio=constant.over_lattice, constant=constant.describe())
    pairs = [(m, s) for m in dataset.material.values for s in dataset.surface.values]
    columns = ("material", "surface", "verdict", "margin", "P", "a_V of the pair")
    columns += ("E* threshold [MPa]", "DMT", "criteria that disagree")
    return head + table(columns, [row(dataset, *pair, materials, surfaces) for pair in pairs])


def row(dataset, material, surface, materials, surfaces):
    pair = dataset.sel(material=material, surface=surface)
    rough, smooth = pair.sel(end="rough"), pair.sel(end="smooth")
    differs = [str(c) for c in pair.criterion.values if pair.disagrees.sel(criterion=c)]
    valid = bool(pair.dmt_valid.all())
    return (
        materials[material]["label"],
        datasets.parameters(surfaces[surface])["label"],
        VERDICTS[int(pair.verdict)] + ("" if valid else " †"),
        interval(pair.margin_low.min(), pair.margin_high.max()),
        f"{float(pair.probability):.0%}" if np.isfinite(pair.probability) else "–",
        interval(pair.pair_a_v_low.min(), pair.pair_a_v_high.max()),
        interval(rough.modulus_threshold / 1e6, smooth.modulus_threshold / 1e6),
        "holds" if valid else f"† {float(pair.jtb_margin.min()):.1g}",
        ", ".join(differs).replace("_", " ") or "none",
    )


def interval(low, high):
    low, high = float(low), float(high)
    return f"{low:.3g}" if np.isclose(low, high) else f"{low:.3g} … {high:.3g}"


if __name__ == "__main__":
    main(start(globals(), "judge"))
