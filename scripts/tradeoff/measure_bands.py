"""Solve the same realisations cut at lower magnifications, and theory on the spectra so cut.

What the waves beyond a cut change, theory may know better than it knows the value itself.
"""

import logging

import numpy as np

from common.contact_curves import load_curve
from common.conventions import Q0, VARIABLES, logarithmic_grid
from common.job import start
from common.model_surfaces import model_spectrum
from common.theory import contact_of
from stickiness import datasets
from stickiness import surface as synthesis
from stickiness.persson.theory import Persson
from tradeoff import measuring

LENGTH = 2 * np.pi / Q0  # a window of one longest wavelength, on which wave numbers are integers
KEPT = ["area_fraction", "mean_gap", "attractive_area", "rms_slope"]


def main(job):
    bands, pressures = job.params.bands, np.array(job.params.pressures)
    cuts, ranges = np.array(bands["magnification"]), logarithmic_grid(job.params.gaps)
    surface = {"hurst": float(job.wildcards.hurst), "magnification": int(cuts[-1])}
    spectrum, seeds = model_spectrum(surface), np.arange(1, bands["seeds"] + 1)
    points = np.minimum(bands["finest"] * cuts, bands["most_points"])
    rows = []
    for seed in seeds:
        heights = synthesis.synthesise(spectrum, int(points[-1]), LENGTH, int(seed))
        curves = []
        for cut, n in zip(cuts, points, strict=True):
            left = filter_below(heights, int(cut))
            slope = synthesis.moments(left, LENGTH).rms_slope
            sampled = measuring.sample(left, len(left) // n)
            curve, seconds = measuring.time_task(
                lambda h=sampled: load_curve(h, LENGTH, pressures, ranges, job.params.tolerance)
            )
            curves.append(curve.assign(rms_slope=slope, seconds=seconds))
            logging.info("seed %d, magnification %d, %d points", seed, cut, n)
        rows.append(measuring.stack(curves, "magnification", cuts))
    lattice = synthesis.lattice_spectrum(spectrum, LENGTH)
    parts = [
        contact_of(Persson(lattice.truncated(float(cut) * Q0)), pressures, ranges) for cut in cuts
    ]
    theory = measuring.stack(parts, "magnification", cuts)
    dataset = measuring.stack(rows, "seed", seeds)[[*KEPT, "seconds"]].merge(
        theory.rename({name: f"theory_{name}" for name in KEPT})
    )
    dataset = dataset.assign(
        pair_time=measuring.time_transforms(), points=("magnification", points)
    )
    datasets.write(
        annotate(dataset),
        job.output[0],
        title="the same realisations cut at lower magnifications",
        parameters={**surface, "finest": bands["finest"]},
    )


def filter_below(heights, cut):
    """Keep the waves of a periodic surface up to a wave number, in units of 2 pi over the side."""
    n, waves = len(heights), np.fft.rfft2(heights)
    q = np.hypot(np.fft.fftfreq(n, 1 / n)[:, None], np.arange(n // 2 + 1))
    return np.fft.irfft2(np.where(q <= cut * (1 + 1e-9), waves, 0), s=heights.shape)


def annotate(dataset):
    texts = {name: VARIABLES[name] for name in (*KEPT[:3], "pressure", "range")}
    texts["rms_slope"] = ("1", "rms gradient over q0 h_rms")
    for name in KEPT:
        texts[f"theory_{name}"] = ("1", f"{texts[name][1]}, by theory on the lattice spectrum")
    return datasets.annotate(
        dataset,
        **texts,
        **measuring.SHARED_TEXTS,
        magnification=("1", "magnification at which the spectrum is cut; h_rms is that of all"),
        points=("1", "grid points along a side"),
        seconds=("s", "processor time of all loads"),
    )


if __name__ == "__main__":
    main(start(globals(), "measure_bands", hurst="0.8"))
