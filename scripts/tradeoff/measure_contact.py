"""Solve contact without adhesion for many seeds, on several grids and to several tolerances.

Any number and kind of seeds can be drawn from the result, to see how their means scatter and how
far these are from the best mean of all: fine seeds on every grid, more seeds on 2 points per
shortest wavelength, and still more of which only the long waves are described.
"""

from itertools import product

import numpy as np

from common.contact_curves import COARSE, DESCRIBED_FROM, SOLVED_FROM, load_curve
from common.contact_curves import VARIABLES as CURVES
from common.conventions import VARIABLES, logarithmic_grid
from common.job import start
from common.model_surfaces import cell_size, model_spectrum
from stickiness import surface as synthesis
from stickiness.accuracy import multilevel
from tradeoff import measuring

KEPT = ("area_fraction", "mean_gap", "attractive_area", "rms_slope", "seconds")
TEXTS = {name: VARIABLES[name] for name in ("pressure", "range", *KEPT[:3])} | {
    "rms_slope": ("1", "rms gradient over q0 h_rms"),
    "seconds": ("s", "processor time of all loads"),
    "pixel_area_fraction": ("1", "contact area counted in pixels, over nominal area"),
    "pixel_attractive_area": ("1", "attractive area counted in pixels"),
    "edges": ("1", "pixel sides between contact and gap"),
    "edge_gap": ("1", "gap of the pixels next to the contact over h_rms"),
    **{
        name: ("1", CURVES[name])
        for name in ("other", "descriptor", "long_waves", "other_long_waves")
    },
    "coarse_seed": ("1", "seed of a realisation that is solved on the coarse grid alone"),
    "describing_seconds": ("s", "processor time to describe one seed"),
}
FINEST_TOLERANCE = 1e-12  # the reference of the other tolerances


def main(job):
    params, surface, counts = job.params, job.params.case, job.params.counts
    ranges, usual = logarithmic_grid(params.gaps), params.tolerance
    loads, length = np.array(params.pressures), cell_size(surface)
    fine, coarse, described = (
        range(params.first_seed + start, params.first_seed + start + counts[kind])
        for kind, start in (("fine", 0), ("coarse", SOLVED_FROM), ("described", DESCRIBED_FROM))
    )

    def solve(pixels, tolerance, seed):
        heights, finer = measuring.make_heights(surface, pixels, seed)
        slope = synthesis.moments(finer, length).rms_slope
        curve = load_curve(heights, length, loads, ranges, tolerance)
        return curve.assign(rms_slope=slope)

    def solve_timed(*setting):
        curve, seconds = measuring.time_task(lambda: solve(*setting))
        return curve.assign(seconds=seconds)

    # Only a few seeds are solved on the finest grid, which is the reference of the others.
    *grids, finest = [COARSE, *params.pixels]
    few = fine[: counts["finest"]]
    wanted = [
        *product(grids, [usual], fine),
        *product([finest], [usual], few),
        *product([params.at_pixels], [*params.tolerances, FINEST_TOLERANCE], few),
        *product([COARSE], [usual], coarse),
    ]
    dataset = measuring.record(wanted, solve_timed)

    def describe(seeds):
        return multilevel.descriptors(model_spectrum(surface), length, seeds)

    waves, seconds = measuring.time_task(lambda: describe(coarse))
    other_waves, other_seconds = measuring.time_task(lambda: describe(described))
    dataset = dataset.assign(
        long_waves=(("coarse_seed", "descriptor"), waves),
        other_long_waves=(("other", "descriptor"), other_waves),
        describing_seconds=np.mean([seconds / len(coarse), other_seconds / len(described)]),
    ).assign_coords(coarse_seed=coarse, other=described, descriptor=list(multilevel.DESCRIPTORS))
    measuring.write(
        dataset[[name for name in TEXTS if name in dataset.data_vars]],
        job.output[0],
        "contact of many realisations with several grids and tolerances",
        {**surface, "tolerance": usual, "at_pixels": params.at_pixels},
        **TEXTS,
    )


if __name__ == "__main__":
    main(start(globals(), "measure_contact", trade_case="H0.8_zeta32"))
