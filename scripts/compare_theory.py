"""Theory on the lattice spectrum of a case against its simulation, with the errors of both.

Theory's heights are Gaussian without end, those of a window end at its highest summit. Where theory
puts the mean gap near or above it, the window holds too few summits to be compared with.
"""

import numpy as np
import xarray as xr

from _job import start
from _model import DESCRIBED, spectrum_of, window_of
from stickiness import datasets, surface

WINDOWS = 64  # random ones, whose highest summits are averaged
LONG_WAVES = 16.0  # wave number over q0 up to which waves matter to the highest summit
MARGIN = 0.75  # over h_rms, of theory's mean gap below the highest summit
COMPARED = ("area_fraction", "mean_gap", "attractive_area")


def main(job):
    simulated = datasets.read(job.input.ensemble, [f"{name}_mean" for name in COMPARED])
    theory = datasets.read(job.input.theory, COMPARED)
    dataset = xr.Dataset()
    for name in COMPARED:
        mean = simulated[f"{name}_mean"].where(simulated[f"{name}_mean"] > 0)
        errors = [
            simulated[f"{name}_{kind}"] for kind in ("standard_error", "discretisation_error")
        ]
        ratio = theory[name] / mean
        dataset[f"{name}_difference"] = ratio - 1
        dataset[f"{name}_difference_error"] = ratio * np.hypot(*errors) / mean
    dataset["highest_summit"] = highest_summit(datasets.parameters(simulated))
    holds = theory.mean_gap.isel(variant=0) < dataset.highest_summit - MARGIN
    dataset["window_holds"] = holds.drop_vars("variant").astype("i1")
    datasets.write(
        annotated(dataset),
        job.output[0],
        title="theory on the lattice spectrum against simulation",
        parameters=datasets.parameters(simulated),
    )


def highest_summit(made):
    """Mean height over h_rms of the highest point of a window."""
    spectrum, length = spectrum_of(made), window_of(made)
    if spectrum.magnification > LONG_WAVES:
        spectrum = spectrum.truncated(LONG_WAVES * spectrum.q0)
    points = int(4 * spectrum.magnification * length * spectrum.q0 / (2 * np.pi))
    summits = [
        surface.synthesise(spectrum, points, length, seed, made.get("amplitudes", "gaussian")).max()
        for seed in range(WINDOWS)
    ]
    return float(np.mean(summits)) / spectrum.h_rms


def annotated(dataset):
    texts = {name: DESCRIBED[name] for name in ("pressure", "range")}
    texts["highest_summit"] = ("1", "mean height of a window's highest point over h_rms")
    texts["window_holds"] = (
        "1",
        f"1 where theory's mean gap is {MARGIN:g} h_rms or more below the highest summit",
    )
    texts["variant"] = ("1", "variant of the theory")
    for name in COMPARED:
        text = f"theory over simulation less 1: {DESCRIBED[name][1]}"
        texts[f"{name}_difference"] = ("1", text, "nothing simulated within the range")
        texts[f"{name}_difference_error"] = (
            "1",
            f"{text}: sampling and discretisation error in quadrature",
            "nothing simulated within the range, or a single seed",
        )
    return datasets.annotate(dataset, **texts)


if __name__ == "__main__":
    main(start(globals(), "compare_theory", case="H0.8_zeta64"))
