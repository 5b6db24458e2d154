"""Solve many realisations on several grids, more on 2 pixels, and describe still more.

Any number and kind of seeds can be drawn from them, to see how their means scatter and how far
these are from the best mean of all.
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

KEPT = ("area_fraction", "mean_gap", "attractive_area", "rms_slope")
CONTINUUM = ("pixel_area_fraction", "pixel_attractive_area", "edges", "edge_gap")


def main(job):
    surface, counts = job.params.case, job.params.counts
    pixels, finest = [COARSE, *job.params.pixels], max(job.params.pixels)
    firsts = {"fine": 0, "fixed": 0, "coarse": SOLVED_FROM, "described": DESCRIBED_FROM}
    seeds = {
        kind: job.params.first_seed + offset + np.arange(counts[kind])
        for kind, offset in firsts.items()
    }
    ranges = logarithmic_grid(job.params.gaps)
    path = np.array(job.params.pressures), ranges, job.params.tolerance
    fine = []
    for p in pixels:
        # Few seeds are solved on the finest grid, which is the reference of the others.
        few = seeds["fine"][: counts["finest"]] if p == finest else seeds["fine"]
        fine.append(solve_seeds(surface, path, few, p))
    dataset = measuring.stack(fine, "pixels", pixels, join="outer")[[*KEPT, *CONTINUUM, "seconds"]]
    dataset = dataset.assign_coords(seed=seeds["fine"])
    for kind, p, amplitudes in (("fixed", 4, "fixed"), ("coarse", COARSE, "gaussian")):
        more = solve_seeds(surface, path, seeds[kind], p, amplitudes)[[*KEPT, "seconds"]]
        dataset = dataset.merge(more.rename({name: f"{kind}_{name}" for name in (*more, "seed")}))
    given, seconds = (model_spectrum(surface), cell_size(surface)), []
    for name, dim, kind in (
        ("long_waves", "coarse_seed", "coarse"),
        ("other_long_waves", "other", "described"),
    ):
        rows, taken = measuring.time_task(lambda k=kind: multilevel.descriptors(*given, seeds[k]))
        dataset[name] = (dim, "descriptor"), rows
        seconds.append(taken / counts[kind])
    dataset = dataset.assign_coords(
        descriptor=list(multilevel.DESCRIPTORS), other=seeds["described"]
    )
    dataset = dataset.assign(
        describing_seconds=np.mean(seconds), pair_time=measuring.time_transforms()
    )
    datasets.write(
        annotate(dataset),
        job.output[0],
        title="many realisations on several grids",
        parameters={**surface, "tolerance": job.params.tolerance},
    )


def solve_seeds(surface, path, seeds, pixels, amplitudes="gaussian"):
    """Solve every seed on one grid at the loads of `path`, and time it."""
    found = []
    for seed in seeds:
        curve, seconds = measuring.time_task(
            lambda s=seed: solve_seed(surface, path, int(s), pixels, amplitudes)
        )
        found.append(curve.assign(seconds=seconds))
    logging.info("%d seeds on %d pixels per wavelength", len(seeds), pixels)
    return measuring.stack(found, "seed", seeds)


def solve_seed(surface, path, seed, pixels, amplitudes):
    """Solve one seed at every load."""
    # Two pixels do not hold the shortest waves' slope: those surfaces are sampled from four.
    n, length = grid_points(surface, max(pixels, 2 * COARSE)), cell_size(surface)
    heights = synthesis.synthesise(model_spectrum(surface), n, length, seed, amplitudes)
    slope = synthesis.moments(heights, length).rms_slope
    sampled = measuring.sample(heights, max(2 * COARSE // pixels, 1))
    return load_curve(sampled, length, *path).assign(rms_slope=slope)


def annotate(dataset):
    missing = "not solved on this grid"
    texts = {name: VARIABLES[name] for name in ("pressure", "range")}
    for prefix in ("", "fixed_", "coarse_"):
        texts |= {f"{prefix}{name}": (*VARIABLES[name], missing) for name in KEPT[:3]}
        texts[f"{prefix}rms_slope"] = ("1", "rms gradient over q0 h_rms", missing)
        texts[f"{prefix}seconds"] = ("s", "processor time of all loads", missing)
        texts[f"{prefix}seed"] = measuring.SHARED_TEXTS["seed"]
    return datasets.annotate(
        dataset,
        **texts,
        pixel_area_fraction=("1", "contact area counted in pixels, over nominal area", missing),
        pixel_attractive_area=("1", "attractive area counted in pixels", missing),
        edges=("1", "pixel sides between contact and gap", missing),
        edge_gap=("1", "gap of the pixels next to the contact over h_rms", missing),
        pixels=("1", "grid points per shortest wavelength"),
        other=("1", "seed of a realisation that is not solved"),
        descriptor=("1", "what is described, lengths in units of 1/q0 and heights of h_rms"),
        long_waves=("1", "descriptors of the long waves of the coarse seeds"),
        other_long_waves=("1", "descriptors of the long waves of seeds that are not solved"),
        describing_seconds=("s", "processor time to describe one seed"),
        pair_time=measuring.SHARED_TEXTS["pair_time"],
    )


if __name__ == "__main__":
    main(start(globals(), "measure_seeds", trade_case="H0.8_zeta32"))
