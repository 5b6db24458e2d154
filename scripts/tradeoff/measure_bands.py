"""Solve the same realisations cut at lower magnifications, and theory on the spectra so cut.

What the waves beyond a cut change, theory may know better than it knows the value itself.
"""

import logging

import numpy as np
import xarray as xr

from pipeline.contact_curves import load_curve
from pipeline.conventions import Q0, VARIABLES, logarithmic_grid, model_spectrum
from pipeline.job import start
from pipeline.theory import contact_of
from pipeline.tradeoff.measuring import pair_seconds, timed
from stickiness.core import datasets
from stickiness.persson.theory import Persson
from stickiness.surfaces import synthesis

LENGTH = 2 * np.pi / Q0  # a window of one longest wavelength, on which wave numbers are integers


def main(job):
    chosen, pressures = job.params.bands, np.array(job.params.pressures)
    cuts, ranges = np.array(chosen["magnification"]), logarithmic_grid(job.params.gaps)
    asked = {"hurst": float(job.wildcards.hurst), "magnification": int(cuts[-1])}
    spectrum, seeds = model_spectrum(asked), np.arange(1, chosen["seeds"] + 1)
    points = np.minimum(chosen["finest"] * cuts, chosen["most_points"])
    rows = []
    for seed in seeds:
        heights = synthesis.synthesise(spectrum, int(points[-1]), LENGTH, int(seed))
        curves = []
        for cut, n in zip(cuts, points, strict=True):
            left = below(heights, int(cut))
            slope = synthesis.moments(left, LENGTH).rms_slope
            sampled = np.ascontiguousarray(left[:: len(left) // n, :: len(left) // n])
            curve, seconds = timed(
                lambda h=sampled: load_curve(h, LENGTH, pressures, ranges, job.params.tolerance)
            )
            curves.append(curve.assign(rms_slope=slope, seconds=seconds))
            logging.info("seed %d, magnification %d, %d points", seed, cut, n)
        rows.append(xr.concat(curves, xr.DataArray(cuts, dims="magnification")))
    solved = xr.concat(rows, xr.DataArray(seeds, dims="seed", name="seed"))
    lattice = synthesis.lattice_spectrum(spectrum, LENGTH)
    parts = [
        contact_of(Persson(lattice.truncated(float(cut) * Q0)), pressures, ranges) for cut in cuts
    ]
    theory = xr.concat(parts, xr.DataArray(cuts, dims="magnification"))
    kept = ["area_fraction", "mean_gap", "attractive_area", "rms_slope"]
    dataset = solved[[*kept, "seconds"]].merge(
        theory.rename({name: f"theory_{name}" for name in kept})
    )
    dataset = dataset.assign_coords(magnification=cuts)
    dataset = dataset.assign(pair_time=pair_seconds(), points=("magnification", points))
    datasets.write(
        annotated(dataset, kept),
        job.output[0],
        title="the same realisations cut at lower magnifications",
        parameters={**asked, "finest": chosen["finest"]},
    )


def below(heights, cut):
    """The waves of a periodic surface up to a wave number, in units of 2 pi over the window."""
    waves = np.fft.rfft2(heights)
    n = len(heights)
    q = np.hypot(np.fft.fftfreq(n, 1 / n)[:, None], np.arange(n // 2 + 1))
    return np.fft.irfft2(np.where(q <= cut * (1 + 1e-9), waves, 0), s=heights.shape)


def annotated(dataset, kept):
    texts = {name: VARIABLES[name] for name in (*kept[:3], "pressure", "range")}
    texts["rms_slope"] = ("1", "rms gradient over q0 h_rms")
    for name in kept:
        texts[f"theory_{name}"] = ("1", f"{texts[name][1]}, by theory on the lattice spectrum")
    return datasets.annotate(
        dataset,
        **texts,
        seed=("1", "seed of the realisation"),
        magnification=("1", "magnification at which the spectrum is cut; h_rms is that of all"),
        points=("1", "grid points along a side"),
        seconds=("s", "processor time of all loads"),
        pair_time=("s", "processor time of a pair of transforms of 1024 x 1024 doubles"),
    )


if __name__ == "__main__":
    main(start(globals(), "measure_bands", hurst="0.8"))
