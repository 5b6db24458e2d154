"""Verdict for every material on every real surface, by the derived criterion and by the others."""

import numpy as np
import xarray as xr

from _criteria import measured_a_v
from _job import start
from _tables import table
from stickiness import criteria, datasets
from stickiness.units import si

ENDS = ("smooth", "rough")
NEEDED = ("h_rms", "rms_slope", "rms_curvature", "elastic_energy", "q0", "hurst")
DERIVED = "violano"
VERDICTS = ("not sticky", "depends", "sticky")


def main(job):
    a_v = measured_a_v(job.input, job.params.pressure)
    surfaces = dict(zip(job.params.surfaces, job.input.surfaces, strict=True))
    surfaces = {name: datasets.read(path, NEEDED) for name, path in surfaces.items()}
    materials = {name: properties(entry) for name, entry in job.params.materials.items()}
    dataset = judged(materials, surfaces, a_v)
    datasets.write(
        dataset,
        job.output.dataset,
        title="verdicts of the stickiness criteria",
        parameters={"materials": job.params.materials, "pressure": job.params.pressure},
    )
    with datasets.whole_file(job.output.table) as path:
        path.write_text(markdown(dataset, a_v, job.params.materials, surfaces), encoding="utf-8")


def properties(entry):
    """Material in SI units: modulus [Pa], work of adhesion [J/m^2], range [m]."""
    if "plane_strain_modulus" in entry:
        modulus = si(entry["plane_strain_modulus"], "Pa")
    else:
        modulus = si(entry["youngs_modulus"], "Pa") / (1 - entry["poisson_ratio"] ** 2)
    return {
        "modulus": modulus,
        "work_of_adhesion": si(entry["work_of_adhesion"], "J/m^2"),
        "range": si(entry["range"], "m"),
    }


def judged(materials, surfaces, a_v):
    rows = [
        [
            [state(material, surface.sel(end=end), a_v) for end in ENDS]
            for surface in surfaces.values()
        ]
        for material in materials.values()
    ]
    dims = ("material", "surface", "end")
    names = list(rows[0][0][0]["margins"])
    coords = {"material": list(materials), "surface": list(surfaces), "end": list(ENDS)}

    def collect(key):
        return dims, [[[cell[key] for cell in row] for row in block] for block in rows]

    margins = [
        [[list(cell["margins"].values()) for cell in row] for row in block] for block in rows
    ]
    dataset = xr.Dataset(
        {
            "margin": ((*dims, "criterion"), margins),
            "margin_low": collect("low"),
            "margin_high": collect("high"),
            "modulus_threshold": collect("threshold"),
            "dmt_valid": collect("dmt_valid"),
            "a_v": ((), a_v.value),
            "a_v_low": ((), a_v.low),
            "a_v_high": ((), a_v.high),
        },
        coords=coords | {"criterion": names},
    )
    dataset["verdict"] = verdict(dataset)
    dataset["disagrees"] = disagreement(dataset)
    return annotated(dataset)


def state(material, surface, a_v):
    """Margins of all criteria for one material on one end of a surface, in SI units."""
    modulus, range_ = material["modulus"], material["range"]
    length = material["work_of_adhesion"] / modulus
    h, q0 = float(surface.h_rms), float(surface.q0)
    slope, curvature = float(surface.rms_slope), float(surface.rms_curvature)
    verdicts = (
        criteria.violano(h, q0, length, range_, a_v.value),
        criteria.violano_printed(h, q0, length, range_),
        criteria.pastewka_robbins(slope, curvature, length, range_),
        criteria.fuller_tabor(h, curvature, length),
        criteria.bearing_area(h, q0, length, range_),
        criteria.persson_tosatti(float(surface.elastic_energy), length),
        criteria.dahlquist(modulus),
    )
    return {
        "margins": {v.name: float(v.margin) for v in verdicts},
        "low": float(criteria.violano(h, q0, length, range_, a_v.low).margin),
        "high": float(criteria.violano(h, q0, length, range_, a_v.high).margin),
        "threshold": criteria.modulus_threshold(
            h, q0, material["work_of_adhesion"], range_, a_v.value
        ),
        "dmt_valid": int(criteria.dmt_validity(h, q0, length, range_).valid),
    }


def verdict(dataset):
    """2 if sticky over the whole surface range and the error of a_V, 0 if nowhere, else 1."""
    surely = (dataset.margin_low > 1).all("end")
    possibly = (dataset.margin_high > 1).any("end")
    return surely.astype("i1") + possibly.astype("i1")


def disagreement(dataset):
    """Criteria whose verdict at an end is the opposite of the derived one's there."""
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
        margin_low=("1", "margin of the derived criterion at the low end of a_V"),
        margin_high=("1", "margin of the derived criterion at the high end of a_V"),
        modulus_threshold=("Pa", "plane-strain modulus below which the pair sticks"),
        dmt_valid=("1", "1 where the JTB condition for the DMT limit holds"),
        a_v=("1", "a_V of the derived criterion"),
        a_v_low=("1", "a_V less its error"),
        a_v_high=("1", "a_V plus its error"),
        verdict=("1", "0 not sticky, 1 depends on what is not known, 2 sticky"),
        disagrees=("1", "1 where a criterion says the opposite of the derived one"),
    )


def markdown(dataset, a_v, materials, surfaces):
    head = (
        "# Do they stick?\n\n"
        f"Derived criterion with {a_v.describe()}. "
        "The margin is the largest rms height that sticks over the actual one, from the rough to "
        "the smooth end of what is known of the surface: above 1 sticks. E* threshold: modulus "
        "below which the pair sticks. † marks pairs for which the DMT limit, on which the "
        "criterion rests, does not hold.\n\n"
    )
    rows = []
    for material in dataset.material.values:
        for surface in dataset.surface.values:
            cell = dataset.sel(material=material, surface=surface)
            margin = cell.margin.sel(criterion=DERIVED)
            differs = [str(c) for c in cell.criterion.values if cell.disagrees.sel(criterion=c)]
            dagger = "" if bool(cell.dmt_valid.all()) else " †"
            rows.append(
                (
                    materials[material]["label"],
                    datasets.parameters(surfaces[surface])["label"],
                    VERDICTS[int(cell.verdict)] + dagger,
                    interval(margin.sel(end="rough"), margin.sel(end="smooth")),
                    interval(
                        *(cell.modulus_threshold.sel(end=e) / 1e6 for e in ("rough", "smooth"))
                    ),
                    ", ".join(differs) or "none",
                )
            )
    columns = (
        "material",
        "surface",
        "verdict",
        "margin",
        "E* threshold [MPa]",
        "criteria that disagree",
    )
    return head + table(columns, rows)


def interval(low, high):
    low, high = float(low), float(high)
    return f"{low:.3g}" if np.isclose(low, high) else f"{low:.3g} … {high:.3g}"


if __name__ == "__main__":
    main(start(globals(), "judge"))
