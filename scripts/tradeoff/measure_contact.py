"""Solve contact without adhesion for many seeds, on several grids and to several tolerances.

Any number and kind of seeds can be drawn from the result, to see how their means scatter and how
far these are from the best mean of all: fine seeds on every grid, more seeds on 2 points per
shortest wavelength, and still more of which only the long waves are described.
"""

import logging

import numpy as np

from common.contact_curves import COARSE, DESCRIBED_FROM, SOLVED_FROM, load_curve
from common.conventions import VARIABLES, logarithmic_grid
from common.job import start
from common.model_surfaces import cell_size, grid_points, model_spectrum
from stickiness import datasets
from stickiness import surface as synthesis
from stickiness.accuracy import multilevel
from tradeoff import measuring
from tradeoff.measuring import stack

KEPT = ("area_fraction", "mean_gap", "attractive_area", "rms_slope")
CONTINUUM = ("pixel_area_fraction", "pixel_attractive_area", "edges", "edge_gap")
FINEST_TOLERANCE = 1e-12  # the reference of the other tolerances


def main(job):
    surface, counts = job.params.case, job.params.counts
    pixels, tolerance = [COARSE, *job.params.pixels], job.params.tolerance
    tolerances = [*job.params.tolerances, FINEST_TOLERANCE]
    ranges, loads = logarithmic_grid(job.params.gaps), np.array(job.params.pressures)
    first = job.params.first_seed
    fine = first + np.arange(counts["fine"])
    coarse = first + SOLVED_FROM + np.arange(counts["coarse"])
    described = first + DESCRIBED_FROM + np.arange(counts["described"])
    few = fine[: counts["finest"]]

    # Only a few seeds are solved on the finest grid, which is the reference of the others.
    on_grids = [
        solve_seeds(surface, (loads, ranges, tolerance), few if p == pixels[-1] else fine, p)
        for p in pixels
    ]
    dataset = stack(on_grids, "pixels", pixels, join="outer")[[*KEPT, *CONTINUUM, "seconds"]]
    to_tolerances = [
        solve_seeds(surface, (loads, ranges, value), few, job.params.at_pixels)
        for value in tolerances
    ]
    more = solve_seeds(surface, (loads, ranges, tolerance), coarse, COARSE)
    for kind, solved in (
        ("tolerance", stack(to_tolerances, "tolerance", tolerances)),
        ("coarse", more),
    ):
        solved = solved[[*KEPT, "seconds"]]
        dataset = dataset.merge(
            solved.rename({name: f"{kind}_{name}" for name in (*solved, "seed")})
        )

    seconds = []
    for name, dim, seeds in (
        ("long_waves", "coarse_seed", coarse),
        ("other_long_waves", "other", described),
    ):
        rows, taken = measuring.time_task(
            lambda s=seeds: multilevel.descriptors(model_spectrum(surface), cell_size(surface), s)
        )
        dataset[name] = (dim, "descriptor"), rows
        seconds.append(taken / len(seeds))
    dataset = dataset.assign_coords(descriptor=list(multilevel.DESCRIPTORS), other=described)
    dataset = dataset.assign(
        describing_seconds=np.mean(seconds), pair_time=measuring.time_transforms()
    )
    datasets.write(
        annotate(dataset),
        job.output[0],
        title="contact of many realisations with several grids and tolerances",
        parameters={**surface, "tolerance": tolerance},
    )


def solve_seeds(surface, path, seeds, pixels):
    """Solve every seed on one grid at the loads of `path`, and time it."""
    # Two points do not resolve the slope of the shortest waves: it is taken from four.
    n, length = grid_points(surface, max(pixels, 2 * COARSE)), cell_size(surface)

    def solve(seed):
        heights = synthesis.synthesise(model_spectrum(surface), n, length, int(seed))
        slope = synthesis.moments(heights, length).rms_slope
        heights = measuring.coarsen(heights, max(2 * COARSE // pixels, 1))
        return load_curve(heights, length, *path).assign(rms_slope=slope)

    timed = [measuring.time_task(lambda s=seed: solve(s)) for seed in seeds]
    logging.info("%d seeds on %d points, tolerance %g", len(seeds), pixels, path[-1])
    return stack([curve.assign(seconds=seconds) for curve, seconds in timed], "seed", seeds)


def annotate(dataset):
    missing = "not solved on this grid"
    texts = {name: VARIABLES[name] for name in ("pressure", "range")}
    for prefix in ("", "tolerance_", "coarse_"):
        texts |= {f"{prefix}{name}": (*VARIABLES[name], missing) for name in KEPT[:3]}
        texts[f"{prefix}rms_slope"] = ("1", "rms gradient over q0 h_rms", missing)
        texts[f"{prefix}seconds"] = ("s", "processor time of all loads", missing)
        texts[f"{prefix}seed"] = measuring.TEXTS["seed"]
    return datasets.annotate(
        dataset,
        **texts,
        **{name: measuring.TEXTS[name] for name in ("pixels", "tolerance", "pair_time")},
        pixel_area_fraction=("1", "contact area counted in pixels, over nominal area", missing),
        pixel_attractive_area=("1", "attractive area counted in pixels", missing),
        edges=("1", "pixel sides between contact and gap", missing),
        edge_gap=("1", "gap of the pixels next to the contact over h_rms", missing),
        other=("1", "seed of a realisation that is not solved"),
        descriptor=("1", "what is described, lengths in units of 1/q0 and heights of h_rms"),
        long_waves=("1", "descriptors of the long waves of the coarse seeds"),
        other_long_waves=("1", "descriptors of the long waves of seeds that are not solved"),
        describing_seconds=("s", "processor time to describe one seed"),
    )


if __name__ == "__main__":
    main(start(globals(), "measure_contact", trade_case="H0.8_zeta32"))
