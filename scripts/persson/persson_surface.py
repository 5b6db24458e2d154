"""Theory's attractive area on the spectrum of a real surface, as an a_V at every range."""

import numpy as np
import xarray as xr

from pipeline.conventions import VARIANT, annotate, logarithmic_grid
from pipeline.error_budgets import theory_parts
from pipeline.job import start
from pipeline.real_spectra import real_spectrum
from stickiness import criteria
from stickiness.accuracy.error_models import read_models
from stickiness.core import datasets
from stickiness.core.budget import Part, with_budget
from stickiness.criteria.a_v_table import theory_a_v

NEEDED = ("psd", "hurst", "q0", "q1", "rms_slope", "rms_curvature")


def main(job):
    surface = datasets.read(job.input.surface, NEEDED)
    ranges = logarithmic_grid(job.params.ranges)
    load, gamma = job.params.pressure, job.params.gamma
    names, a_v, edge = a_v_of(surface, "rough", ranges, load, gamma)
    if not same_shape(surface):
        # The law beyond the instrument's band is known with an error, which is that of a_V too.
        more, other, _ = a_v_of(surface, "smooth", ranges, load, gamma)
        names, a_v = [*names, *(f"{name}, smooth end" for name in more)], [*a_v, *other]
    dataset = xr.Dataset(
        {"a_v": (("variant", "range"), a_v), "edge_range": edge},
        coords={"variant": names, "range": ranges},
    )
    dataset = annotate(
        dataset,
        variant=("1", "variant of the theory, or the edge law below the edge range"),
        a_v=("1", "a_V = A_ad/((3/2) p (range/h_rms)^(2/3)), constant below the edge range"),
        edge_range=("1", "range over h_rms below which the edge law takes over from theory"),
    )
    datasets.write(
        add_budgets(dataset, surface, load, read_models(job.input.laws)),
        job.output[0],
        title="a_V by Persson's theory on the spectrum of a real surface",
        parameters={**datasets.parameters(surface), "pressure": load, "gamma": gamma},
    )


def add_budgets(dataset, surface, load, models):
    """The quoted a_V with its errors: as measured, or how far the others are if that is more."""
    at = {"hurst": float(surface.hurst), "magnification": float(surface.q1 / surface.q0)}
    a_v = dataset.a_v.assign_coords(pressure=load, **at)
    spread = abs(a_v - a_v.sel(variant=VARIANT)).max("variant")
    parts = theory_parts(models, "attractive_area", a_v)
    text = f"of {VARIANT} as measured, or how far the others are if that is more; of others not "
    model = Part(np.maximum(parts["model"].error, spread), f"{text}measured")
    return with_budget(dataset, "a_v", **parts | {"model": model})


def a_v_of(surface, end, ranges, load, gamma):
    """a_V by every variant and by the edge law on one end of a surface, and the edge range."""
    edge, q0 = edge_a_v(surface, end), float(surface.q0)
    return theory_a_v(real_spectrum(surface, end), ranges, load, edge, q0=q0, gamma=gamma)


def same_shape(surface):
    """Whether both ends differ by a factor only, which drops out of a_V."""
    ratio = surface.psd.isel(end=0) / surface.psd.isel(end=-1)
    return bool(np.ptp(ratio.values) < 1e-6 * ratio.values.max())


def edge_a_v(surface, end):
    """a_V equivalent to Pastewka and Robbins' attractive area, from slope and curvature."""
    known = surface.sel(end=end)
    moments = (float(known[name]) for name in ("h_rms", "rms_slope", "rms_curvature"))
    return criteria.pastewka_robbins_a_v(float(surface.q0), *moments)


if __name__ == "__main__":
    main(start(globals(), "persson_surface", real_surface="asphalt"))
