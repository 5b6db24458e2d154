"""Solve many realisations on several grids, more on 2 pixels, and describe still more.

From them any number and kind of seeds can be drawn: what their means scatter by, and how far they
are from the best mean of all.
"""

import logging

import numpy as np
import xarray as xr

from pipeline.coarse_solutions import DESCRIBED_FROM, SOLVED_FROM
from pipeline.contact_curves import COARSE, load_curve
from pipeline.conventions import VARIABLES, cell_size, grid_points, logarithmic_grid, model_spectrum
from pipeline.job import start
from pipeline.tradeoff.measuring import pair_seconds, timed
from stickiness.accuracy import multilevel
from stickiness.core import datasets
from stickiness.surfaces import synthesis

KEPT = ("area_fraction", "mean_gap", "attractive_area", "rms_slope")
CONTINUUM = ("pixel_area_fraction", "pixel_attractive_area", "edges", "edge_gap")


def main(job):
    asked, first = job.params.case, job.params.first_seed
    counts, finest = job.params.counts, max(job.params.pixels)
    pixels = [COARSE, *job.params.pixels]
    few, fixed, coarse, described = (
        first + offset + np.arange(counts[name])
        for name, offset in (
            ("fine", 0),
            ("fixed", 0),
            ("coarse", SOLVED_FROM),
            ("described", DESCRIBED_FROM),
        )
    )
    # Few are solved on the finest grid, which is the reference of the others.
    most = [counts["finest"] if p == finest else len(few) for p in pixels]
    walk = Walk(
        asked, job.params.pressures, logarithmic_grid(job.params.gaps), job.params.tolerance
    )
    fine = xr.concat(
        [walk.seeds(few[:count], p) for p, count in zip(pixels, most, strict=True)],
        xr.DataArray(pixels, dims="pixels", name="pixels"),
        join="outer",
    )
    dataset = fine[[*KEPT, *CONTINUUM, "seconds"]].assign_coords(seed=few)
    others = {"fixed": (fixed, 4, "fixed"), "coarse": (coarse, COARSE, "gaussian")}
    for kind, (seeds, points, amplitudes) in others.items():
        more = walk.seeds(seeds, points, amplitudes)[[*KEPT, "seconds"]]
        dataset = dataset.merge(more.rename({name: f"{kind}_{name}" for name in (*more, "seed")}))
    spectrum, length = model_spectrum(asked), cell_size(asked)
    seconds = []
    for name, seeds in (("long_waves", coarse), ("other_long_waves", described)):
        rows, taken = timed(lambda s=seeds: multilevel.descriptors(spectrum, length, s))
        dataset[name] = ("coarse_seed" if name == "long_waves" else "other", "descriptor"), rows
        seconds.append(taken / len(seeds))
    dataset = dataset.assign_coords(descriptor=list(multilevel.DESCRIPTORS), other=described)
    dataset = dataset.assign(describing_seconds=np.mean(seconds), pair_time=pair_seconds())
    datasets.write(
        annotated(dataset),
        job.output[0],
        title="many realisations on several grids",
        parameters={**asked, "tolerance": job.params.tolerance},
    )


class Walk:
    """Solves seeds of one surface at given loads."""

    def __init__(self, asked, pressures, ranges, tolerance):
        self.asked, self.length = asked, cell_size(asked)
        self.spectrum = model_spectrum(asked)
        self.path = np.array(pressures), ranges, tolerance

    def seeds(self, seeds, pixels, amplitudes="gaussian"):
        """Contact of every seed on one grid, and the processor time it took."""
        found = []
        for seed in seeds:
            curve, seconds = timed(lambda s=seed: self.one(int(s), pixels, amplitudes))
            found.append(curve.assign(seconds=seconds))
        logging.info("%d seeds on %d pixels per wavelength", len(seeds), pixels)
        return xr.concat(found, xr.DataArray(seeds, dims="seed", name="seed"))

    def one(self, seed, pixels, amplitudes):
        """Contact of one seed at every load."""
        # Two pixels do not hold the shortest waves' slope: those surfaces are sampled from four.
        n = grid_points(self.asked, max(pixels, 2 * COARSE))
        heights = synthesis.synthesise(self.spectrum, n, self.length, seed, amplitudes)
        slope = synthesis.moments(heights, self.length).rms_slope
        step = max(2 * COARSE // pixels, 1)
        sampled = np.ascontiguousarray(heights[::step, ::step])
        return load_curve(sampled, self.length, *self.path).assign(rms_slope=slope)


def annotated(dataset):
    texts = {name: VARIABLES[name] for name in ("pressure", "range")}
    for prefix in ("", "fixed_", "coarse_"):
        texts |= {
            f"{prefix}{name}": (*VARIABLES[name], "not solved on this grid") for name in KEPT[:3]
        }
        texts[f"{prefix}rms_slope"] = ("1", "rms gradient over q0 h_rms", "not solved on this grid")
        texts[f"{prefix}seconds"] = ("s", "processor time of all loads", "not solved on this grid")
        texts[f"{prefix}seed"] = ("1", "seed of the realisation")
    missing = "not solved on this grid"
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
        pair_time=("s", "processor time of a pair of transforms of 1024 x 1024 doubles"),
    )


if __name__ == "__main__":
    main(start(globals(), "measure_seeds", trade_case="H0.8_zeta32"))
