"""Contact of measured heights with full adhesion, on two grids, at given loads."""

import logging
import warnings

import numpy as np
import xarray as xr

from stickiness.adhesive import edge_zone
from stickiness.adhesive import solver as adhesive
from stickiness.plausibility import PlausibilityWarning
from stickiness.repulsive import solver as repulsive

# Areas of contact change by less than 1e-3 of themselves from here to 1e-5 where the grid hardly
# resolves the attraction, which is where solutions are slow.
TOLERANCE = 1e-3
START = 1e-4  # of the contact without adhesion, over h_rms
ITERATIONS = 10000
TEXTS = {
    "adhesive_contact_area": ("1", "area at a gap of zero with adhesion, by pixels"),
    "adhesive_attractive_area": ("1", "area with gaps up to the range of attraction, by pixels"),
    "adhesive_mean_gap": ("1", "mean gap over h_rms with adhesion"),
    "adhesive_residual": ("1", "unbalanced pressure over the strength or the flattening pressure"),
    "edge_resolution": (
        "1",
        f"pixel over range^2 E*/w; edges of contact are resolved up to {edge_zone.COARSEST}",
    ),
    "applied_pressure": ("Pa", "mean pressure"),
}


def load_curves(heights, lengths, pressures, law, steps=(2, 1)):
    """Quantities with adhesion at every pressure, along `resolution` from coarse to fine."""
    curves = [load_curve(heights[::step, ::step], lengths, pressures, law) for step in steps]
    return xr.concat(curves, "resolution")


def load_curve(heights, lengths, pressures, law):
    """Quantities at every pressure, each from the contact without adhesion at the same pressure.

    This leads to the state with the widest gaps, where loading from afar ends. Whether the grid
    resolves the edges of contact is stored, so no warning says so.
    """
    rows = []
    for contact in repulsive.load_path(heights, lengths, pressures, tol=START):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", PlausibilityWarning)
            state = adhesive.solve(
                heights,
                lengths,
                law,
                pressure=contact.mean_pressure,
                start=contact,
                tol=TOLERANCE,
                max_iterations=ITERATIONS,
            )
        rows.append(measure(state))
        logging.info(
            f"n = {len(heights)}: with adhesion, load {len(rows)} of {len(pressures)}, area "
            f"{state.repulsive_area_fraction:.4f}, {state.iterations} iterations"
        )
    curve = xr.concat(rows, xr.DataArray(list(pressures), dims="pressure", name="pressure"))
    pixel = max(side / n for side, n in zip(lengths, heights.shape, strict=True))
    resolution = edge_zone.resolution(pixel, law.range, law.adhesion_length)
    return curve.assign(edge_resolution=resolution)


def measure(state):
    """Quantities of one state."""
    return xr.Dataset(
        {
            "adhesive_contact_area": state.repulsive_area_fraction,
            "adhesive_attractive_area": np.mean((state.gap > 0) & (state.gap <= state.law.range)),
            "adhesive_mean_gap": state.mean_gap,
            "adhesive_residual": state.residual,
        }
    )
