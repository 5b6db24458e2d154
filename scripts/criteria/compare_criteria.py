"""Adhesion that each criterion asks for, over roughness and over the shortest wavelength.

Surfaces with one Hurst exponent, the range as unit of length: once over h_rms at fixed cutoffs,
once over the magnification at fixed h_rms and longest wavelength, which tells what criteria make
of the finest waves.
"""

from dataclasses import replace

import numpy as np
import xarray as xr

from pipeline.conventions import logarithmic_grid
from pipeline.job import start
from pipeline.verdicts.a_v import CLOSED, between, measured_a_v
from pipeline.verdicts.thresholds import threshold
from stickiness import criteria
from stickiness.adhesion import equivalent_sphere
from stickiness.core import datasets
from stickiness.core.budget import with_budget
from stickiness.criteria.a_v_table import NEEDED, AvTable
from stickiness.surfaces.spectrum import SelfAffine

EDGES = "edge_adhesion"
LOW, HIGH = f"{EDGES}_low", f"{EDGES}_high"


def main(job):
    asked, load = job.params.compared, job.params.pressure
    table = AvTable(datasets.read(job.input.a_v_table, NEEDED))
    constant = measured_a_v(job.input, load).value
    roughness = logarithmic_grid(asked["h_rms_over_range"])
    zetas = logarithmic_grid(asked["magnification"])
    over_h, over_zeta = (
        thresholds(asked["hurst"], asked["range_times_q0"], *at, load, table, constant)
        for at in (
            (roughness, np.full_like(roughness, asked["quoted_magnification"])),
            (np.full_like(zetas, asked["quoted_h_rms_over_range"]), zetas),
        )
    )
    dataset = xr.Dataset(
        {
            "against_roughness": (("criterion", "h_rms_over_range"), list(over_h.values())),
            "against_magnification": (("criterion", "magnification"), list(over_zeta.values())),
        },
        coords={
            "h_rms_over_range": roughness,
            "magnification": zetas,
            "criterion": list(over_h),
        },
    )
    datasets.write(
        budgeted(annotated(dataset)),
        job.output[0],
        title="adhesion at the threshold of stickiness by every criterion",
        parameters={**asked, "pressure": load, "constant_a_v": constant},
    )


def thresholds(hurst, q0, h, zeta, load, table, constant):
    """Adhesion length over range at which each criterion begins to call surfaces sticky."""
    spectra = [
        SelfAffine(hurst=hurst, q0=q0, q1=q0 * one, h_rms=rms)
        for rms, one in zip(h, zeta, strict=True)
    ]
    slope, curvature, energy = np.transpose(
        [(s.rms_slope, s.rms_curvature, s.elastic_energy()) for s in spectra]
    )
    a_v = table.a_v_at(hurst, load, 1 / h, zeta)
    verdicts = {
        "violano": criteria.violano(h, q0, 1.0, 1.0, a_v.value),
        "violano_constant": criteria.violano(h, q0, 1.0, 1.0, constant),
        "violano_printed": criteria.violano_printed(h, q0, 1.0, 1.0),
        "pastewka_robbins": criteria.pastewka_robbins(slope, curvature, 1.0, 1.0),
        "fuller_tabor": criteria.fuller_tabor(h, curvature, 1.0),
        "bearing_area": criteria.bearing_area(h, q0, 1.0, 1.0),
        "persson_tosatti": criteria.persson_tosatti(energy, 1.0),
    }
    found = {name: threshold(name, verdict.margin, 1.0) for name, verdict in verdicts.items()}
    by_edges = equivalent_sphere.adhesion_length_threshold
    for name, limit, sign in ((EDGES, "value", 0), (LOW, "high", 1), (HIGH, "low", -1)):
        prefactor = getattr(a_v, limit)
        length = by_edges(h, q0, slope, 1.0, prefactor)
        # The model's error is that at the threshold it has without.
        error = equivalent_sphere.attraction(h, q0, slope, length, 1.0, prefactor).error_factor
        found[name] = by_edges(h, q0, slope, 1.0, prefactor, error**sign)
    return found


def budgeted(dataset):
    """Thresholds with their errors; criteria but that of the edges state none."""
    for name in ("against_roughness", "against_magnification"):
        value = dataset[name]
        ends = (value.sel(criterion=end, drop=True) for end in (LOW, HIGH))
        model = between(value, *ends)
        model = replace(model, error=model.error.where(value.criterion == EDGES))
        dataset = with_budget(dataset, name, model=model, **CLOSED)
    return dataset


def annotated(dataset):
    text = "adhesion length over range above which the criterion calls the surface sticky"
    return datasets.annotate(
        dataset,
        h_rms_over_range=("1", "rms height over range"),
        magnification=("1", "highest over lowest wave number"),
        criterion=("1", "stickiness criterion; of the edges also its low and high end"),
        against_roughness=("1", text),
        against_magnification=("1", text),
    )


if __name__ == "__main__":
    main(start(globals(), "compare_criteria"))
