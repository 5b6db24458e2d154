"""Contact of measured heights themselves, made periodic in two ways, beside theory on the same."""

import numpy as np
import xarray as xr

from pipeline import measured_surface
from pipeline.contact_curves import load_curve
from pipeline.conventions import VARIANT, logarithmic_grid
from pipeline.job import start
from stickiness.config import checks
from stickiness.core import datasets
from stickiness.core.units import si
from stickiness.measured import periodic, topography
from stickiness.persson.theory import Persson

WAYS = ("taper", "mirror")
LARGEST = 2048  # grid points a side
KEPT = ("area_fraction", "mean_gap", "edge_gap", "residual", "attractive_area")


def main(job):
    surface = datasets.read(job.input.surface, ["q0", "q_cutoff"])
    asked = job.params.surface
    heights = chosen(asked)
    ranges = logarithmic_grid(job.params.gaps)
    q_max = highest(asked["bem"], float(surface.q_cutoff))
    dataset = solved(
        heights,
        q0=float(surface.q0),
        q_max=q_max,
        pressures=np.sort(asked["bem"]["pressures"]),
        ranges=ranges,
        pixels=job.params.pixels_per_wavelength,
        tolerance=job.params.tolerance,
        gamma=job.params.gamma,
    )
    datasets.write(
        annotated(dataset),
        job.output[0],
        title=f"contact of measured heights: {asked['label']}",
        parameters={"surface": job.wildcards.real_surface, "source": heights.source, **asked},
    )


def chosen(asked):
    """The levelled map that is to be pressed."""
    index = asked["bem"].get("measurement", 0)
    one = checks.measurements(asked)[index][1]
    heights = measured_surface.read(one)
    if isinstance(heights, topography.Profile):
        raise ValueError(f"{heights.source} is a line profile; bem needs a map of heights")
    return heights.detrended(one.get("detrend", "plane"))


def highest(bem, cutoff):
    """Highest wave number pressed: the instrument's, or a lower one as configured."""
    if "shortest_wavelength" not in bem:
        return cutoff
    asked = 2 * np.pi / si(bem["shortest_wavelength"], "m")
    if asked > cutoff * (1 + 1e-9):
        raise ValueError(
            f"bem.shortest_wavelength = {bem['shortest_wavelength']!r} is below the instrument's "
            f"{2 * np.pi / cutoff:.3g} m; leave it out or give a longer one"
        )
    return asked


def solved(heights, *, q0, q_max, pressures, ranges, pixels, tolerance, gamma):
    """Contact and theory for both ways of making the heights periodic.

    Pressures are over E* q0 h_rms, gaps over h_rms, with the h_rms of each periodic surface.
    """
    blocks = []
    for way in WAYS:
        whole = periodic.periodise(heights.heights, way)
        sides = whole.shape[0] * heights.dx, whole.shape[1] * heights.dy
        check_size(sides, q_max, pixels)
        pressed = periodic.band_limited(whole, sides, q_max, pixels)
        h_rms = float(np.std(pressed))
        scaled, lengths = (pressed - pressed.mean()) / h_rms, tuple(q0 * s for s in sides)
        curves = [
            load_curve(scaled[::step, ::step], lengths, pressures, ranges, tolerance)[list(KEPT)]
            for step in (2, 1)
        ]
        resolution = xr.DataArray([pixels / 2, float(pixels)], dims="resolution", name="resolution")
        block = xr.concat(curves, resolution)
        theory = Persson(periodic.shells(scaled, lengths), variant=VARIANT, gamma=gamma)
        areas = [theory.gap_cumulative(ranges, p) for p in pressures]
        block["theory_attractive_area"] = (("pressure", "range"), areas)
        block["theory_area_fraction"] = "pressure", [theory.area_fraction(p) for p in pressures]
        blocks.append(block.assign(h_rms=h_rms))
    dataset = xr.concat(
        blocks, xr.DataArray(list(WAYS), dims="periodisation", name="periodisation")
    )
    for name in ("attractive_area", "theory_attractive_area"):
        scale = 1.5 * dataset.pressure * dataset["range"] ** (2 / 3)
        dataset[name.replace("attractive_area", "a_v")] = dataset[name] / scale
    return dataset.assign(q1=q_max)


def check_size(sides, q_max, pixels):
    points = max(sides) * q_max / (2 * np.pi) * pixels
    if points > LARGEST:
        shortest = 2 * np.pi / q_max * points / LARGEST
        raise ValueError(
            f"bem needs {points:.0f} grid points a side, more than {LARGEST}; give "
            f"bem.shortest_wavelength of {shortest:.3g} m or more"
        )


def annotated(dataset):
    return datasets.annotate(
        dataset,
        periodisation=("1", "way in which the heights were made periodic"),
        resolution=("1", "grid points per shortest wavelength, at least"),
        pressure=("1", "mean pressure over E* q0 h_rms"),
        range=("1", "range of attraction over h_rms"),
        area_fraction=("1", "repulsive contact area over nominal area"),
        mean_gap=("1", "mean gap over h_rms"),
        edge_gap=("1", "gap of the pixels next to the contact over h_rms: smallest range resolved"),
        residual=("1", "complementarity residual over h_rms"),
        attractive_area=("1", "area with gaps between 0 and the range, over nominal area"),
        theory_attractive_area=("1", "the same by theory on the spectrum of the same heights"),
        theory_area_fraction=("1", "contact area by theory on the spectrum of the same heights"),
        a_v=("1", "a_V = A_ad/((3/2) p (range/h_rms)^(2/3))"),
        theory_a_v=("1", "a_V by theory on the spectrum of the same heights"),
        h_rms=("m", "rms height of the periodic surface"),
        q1=("1/m", "highest wave number of the heights pressed"),
    )


if __name__ == "__main__":
    main(start(globals(), "contact_measured", real_surface="jacksboro"))
