"""Contact of the measured heights themselves, as texts for the page of their surface."""

import numpy as np

from common.conventions import LOAD
from common.formatting import NOTHING, interval, number, quantity, with_error
from stickiness.adhesive import edge_zone
from stickiness.criteria import equivalent_sphere

QUOTED_RANGE = 0.03  # over h_rms, as the caption of the table says
WAYS = {"taper": "tapered", "mirror": "mirrored", "given": "as they stand"}


def describe_loads(bem):
    """One row a load: area and a_V both ways, their error, and theory on the same heights."""
    rows = []
    for pressure in bem.pressure.values:
        at = bem.sel(pressure=pressure).interp({"range": QUOTED_RANGE})
        rows.append(
            {
                "pressure": number(float(pressure)),
                "area": compare(at, "area_fraction", "theory_area_fraction"),
                "a_v": compare(at, "a_v", "theory_a_v"),
            }
        )
    return rows


def describe_adhesion(bem):
    """One row a load: areas and mean gap with full adhesion, beside those without; empty if none.

    Contact is counted in pixels with adhesion, and by sub-pixel edges without.
    """
    if "adhesive_contact_area" not in bem:
        return []
    rows = []
    for pressure in bem.pressure.values:
        at = bem.sel(pressure=pressure)
        applied = at.applied_pressure.values
        rows.append(
            {
                "pressure": number(float(pressure)),
                "applied": quantity(float(applied.min()), float(applied.max()), "Pa"),
                "residual": number(float(at.adhesive_residual.max()), 2),
            }
            | {
                name: with_error(*combine_ways(at[variable]))
                for name, variable in {
                    "area": "adhesive_contact_area",
                    "attractive": "adhesive_attractive_area",
                    "gap": "adhesive_mean_gap",
                    "area_alone": "area_fraction",
                    "gap_alone": "mean_gap",
                }.items()
            }
        )
    return rows


def describe_edges(bem):
    """Whether the finer grid resolves the edges of contact with adhesion, as a sentence."""
    if "edge_resolution" not in bem:
        return ""
    coarse = float(bem.edge_resolution.isel(resolution=-1).max())
    limit = number(edge_zone.COARSEST)
    if coarse <= edge_zone.COARSEST:
        return "The grid resolves the edges of contact."
    return (
        f"The grid does not resolve the edges of contact: a pixel is {number(coarse, 2)} times "
        f"the length over which attraction bends the surfaces together, and should be at most "
        f"{limit} times that. The change from half the resolution does not bound this error."
    )


def compare(at, name, theory):
    """Simulation with all its errors, by both ways to make heights periodic, and theory."""
    value, error = combine_ways(at[name])
    return {
        "value": with_error(value, error),
        "ways": [
            f"{WAYS[way]} {number(float(at[name].sel(periodisation=way).isel(resolution=-1)), 2)}"
            for way in map(str, at.periodisation.values)
        ],
        "theory": interval(*sorted(map(float, at[theory].values)), 2),
    }


def combine_ways(values):
    """Mean of both ways. Its error: half their difference and the change from half resolution."""
    fine = values.isel(resolution=-1)
    change = values.diff("resolution").isel(resolution=-1).mean("periodisation")
    return float(fine.mean()), float(np.hypot(np.ptp(fine.values) / 2, change))


def describe_pair(bem, solid, surface):
    """a_V at a material's range on the pressed heights, and the onset that follows.

    Both are a dash where the range lies outside the gaps computed. The onset is a dash, too, where
    the range is below the gap of the pixels next to the contact, which the grid does not resolve.
    """
    at = bem.sel(pressure=LOAD, method="nearest")
    h = float(np.sqrt(np.prod(surface.h_rms.values)))
    ratio = solid.range / h
    ranges = at["range"].values
    if not ranges[0] <= ratio <= ranges[-1]:
        return {"range": number(ratio, 2), "a_v": NOTHING, "margin": NOTHING, "resolved": False}
    value, error = combine_ways(at.a_v.interp({"range": ratio}))
    resolved = ratio >= float(at.edge_gap.isel(resolution=-1).max())
    length = solid.work_of_adhesion / solid.modulus
    limits = [max(value - error, 0.01 * value), value + error]
    slope = float(np.sqrt(np.prod(surface.rms_slope.values)))
    found = equivalent_sphere.attraction(h, float(surface.q0), slope, length, solid.range, limits)
    margins = found.ratio * found.error_factor ** np.array([-1.0, 1.0])
    return {
        "range": number(ratio, 2),
        "a_v": with_error(value, error),
        "margin": interval(*map(float, margins), 2) if resolved else NOTHING,
        "resolved": resolved,
    }
