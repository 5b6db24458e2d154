"""Solve contact without adhesion for many seeds, on several grids and to several tolerances.

Any number and kind of seeds can be drawn from the result, to see how their means scatter and how
far these are from the best mean of all: fine seeds on every grid, more seeds on 2 points per
shortest wavelength, and still more of which only the long waves are described.
"""

from functools import partial
from itertools import product

import numpy as np

from common.clock import time_task
from common.contact_curves import COARSE, CONTACT_VARIABLES, DESCRIBED_FROM, SOLVED_FROM, load_curve
from common.conventions import logarithmic_grid
from common.job import start
from common.model_surfaces import cell_size, model_spectrum
from stickiness import surface as synthesis
from stickiness.accuracy import multilevel
from tradeoff import measuring

FINEST_TOLERANCE = 1e-12  # the reference of the other tolerances
TIMED_CONTACT_VARIABLES = CONTACT_VARIABLES | {
    "seconds": ("s", "processor time of all loads"),
    "coarse_seed": "seed of a realisation that is solved on the coarse grid alone",
    "describing_seconds": ("s", "processor time to describe one seed"),
}


def main(job):
    params = job.params
    surface = job.params.case
    counts = job.params.counts
    ranges = logarithmic_grid(params.gaps)
    usual = params.tolerance
    loads = np.array(params.pressures)
    length = cell_size(surface)

    def list_seeds(kind, start):
        first = params.first_seed + start
        return range(first, first + counts[kind])

    fine = list_seeds("fine", 0)
    coarse = list_seeds("coarse", SOLVED_FROM)
    described = list_seeds("described", DESCRIBED_FROM)

    def solve(pixels, tolerance, seed):
        heights, finer = measuring.make_heights(surface, pixels, seed)
        slope = synthesis.moments(finer, length).rms_slope
        return load_curve(heights, length, loads, ranges, tolerance).assign(rms_slope=slope)

    # Only a few seeds are solved on the finest grid, which is the reference of the others.
    *grids, finest = [COARSE, *params.pixels]
    few = fine[: counts["finest"]]
    wanted = [
        *product(grids, [usual], fine),
        *product([finest], [usual], few),
        *product([params.at_pixels], [*params.tolerances, FINEST_TOLERANCE], few),
        *product([COARSE], [usual], coarse),
    ]
    describe = partial(multilevel.descriptors, model_spectrum(surface), length)
    waves, seconds = time_task(describe, coarse)
    other_waves, other_seconds = time_task(describe, described)
    dataset = measuring.record(wanted, solve).assign(
        long_waves=(("coarse_seed", "descriptor"), waves),
        other_long_waves=(("other", "descriptor"), other_waves),
        describing_seconds=np.mean([seconds / len(coarse), other_seconds / len(described)]),
    )
    names = list(multilevel.DESCRIPTORS)
    measuring.write(
        dataset.assign_coords(coarse_seed=coarse, other=described, descriptor=names),
        job.output[0],
        "contact of many realisations with several grids and tolerances",
        {**surface, "tolerance": usual, "at_pixels": params.at_pixels},
        **TIMED_CONTACT_VARIABLES,
    )


if __name__ == "__main__":
    main(start(globals()))
