"""Variants and corrections of Persson's theory that stages compute beside each other."""

import numpy as np
import xarray as xr

from common.conventions import VARIANT, middles
from stickiness.persson.kernels import CORRECTIONS
from stickiness.persson.theory import Persson


def theories(spectrum, variants, gamma):
    """Theories of a spectrum by names: the `variants`, then the quoted one otherwise corrected."""
    first = Persson(spectrum, variants[0], gamma)
    named = {name: first.with_variant(name) for name in variants}
    for correction in CORRECTIONS[1:]:  # each with the gamma of its source
        name = f"{VARIANT}, {correction}"
        named[name] = Persson(spectrum, VARIANT, correction=correction)
    return named


def between_corrections(values):
    """Lowest and highest of the quoted variant by all its corrections, along `variant`."""
    names = [name for name in values["variant"].values if str(name).startswith(VARIANT)]
    chosen = values.sel(variant=names)
    return chosen.min("variant"), chosen.max("variant")


def evaluate(theory, pressures, ranges):
    """Contact that theory predicts at every pressure, with P(u) between neighbouring ranges."""
    gaps = middles(ranges)
    density = [theory.gap_density(gaps, load) for load in pressures]
    contact = contact_of(theory, pressures, ranges).assign_coords(gap=gaps)
    return contact.assign(gap_density=(("pressure", "gap"), density))


def contact_of(theory, pressures, ranges):
    """Quantities of a contact that theory predicts, under the names of `solve_repulsive`."""
    data = {
        "area_fraction": ("pressure", [float(theory.area_fraction(load)) for load in pressures]),
        "mean_gap": ("pressure", [float(theory.mean_gap(load)) for load in pressures]),
        "attractive_area": (
            ("pressure", "range"),
            [theory.gap_cumulative(ranges, load) for load in pressures],
        ),
        "rms_slope": theory.spectrum.rms_slope,
    }
    return xr.Dataset(data, coords={"pressure": np.asarray(pressures), "range": ranges})
