"""Adhesive parameters of the configuration in the units of the simulations.

Those are h_rms for gaps and ranges and E* q0 h_rms for pressures, so that the strength
sigma0/E* = l_a/range becomes (l_a/range)/(q0 h_rms).
"""

import logging

import numpy as np
import xarray as xr

from common.ensemble_means import fine
from stickiness import adhesive
from stickiness.traction_laws import LAWS

MISSING = "the grid does not resolve the edge, or a window closes"
OUTSIDE = "outside the table of measured errors"

# Relative. Of 264 states (magnifications 32 to 128) solved to their tolerance and to 1e-7 none
# changed by more than 1.5e-6 of the load. Of 24 (range 0.1 h_rms, l_a/range 0.05 to 0.4) solved to
# 1e-7 and to 1e-9, two of the stickiest ended on another branch, the others changed by less than
# 3e-8. Where a jump ends depends on the steps of the descent: with other steps 32 of 1396 states
# moved by more than 1e-4 of the load, up to 11 % of it, nearly all with attraction above 1.5 times
# the load. The mean over four seeds moves less than the error here.
SOLVER = 2e-6
BRANCH = 0.03  # relative error where the branch is uncertain
BRANCHING = 1.5  # attraction over the load from which it is
STRONGEST = 8.0  # attraction over repulsion, by the DMT sum, that is still looked at
# Attraction over repulsion, by the DMT sum, up to which the answer is nearly linear in it: weaker
# states on the same grid are then a better start than the state on a grid half as fine.
NEARLY_LINEAR = 0.1
LEAST = 20  # states of a loop at least, loading or unloading
# Tolerances of states: tighter than without adhesion, and the tighter the weaker the attraction is:
# the area of single pixels is all that weak adhesion changes. Against the tightest everywhere, 3 of
# 264 states have one pixel more or less.
TIGHTEST = 1e-7
LOOSEST = 1e-5

AXES = ("pressure", "adhesion_length_over_range", "range_over_h_rms")

#: What files keep of an adhesive state.
STATE = {
    "external_pressure": "mean pressure over E* q0 h_rms",
    "repulsive_pressure": "repulsive part of the mean pressure over E* q0 h_rms",
    "attraction": "attractive part of the mean pressure over E* q0 h_rms",
    "repulsive_area": "area at a gap of zero over nominal area, by pixels",
    "net_repulsive_area": "area at a gap of zero and compressed over nominal area, by pixels",
    "attractive_area": "area within the range of attraction, not in contact, over nominal area",
    "elastic_energy": "elastic energy per nominal area over E* q0 h_rms^2",
    "interaction_energy": "energy of the attraction per nominal area over E* q0 h_rms^2",
    "residual": "unbalanced pressure over the strength or the flattening pressure",
    "iterations": "iterations of conjugate gradients",
}
ATTRIBUTES = {  # of the state, where its name is another
    "external_pressure": "mean_pressure",
    "attraction": "adhesive_pressure",
    "repulsive_area": "repulsive_area_fraction",
    "net_repulsive_area": "net_repulsive_area_fraction",
    "attractive_area": "adhesive_area_fraction",
}


def axes(adhesion):
    """Pressures, adhesion lengths and ranges of a set, each in increasing order."""
    points = {
        "pressure": adhesion["pressures"],
        "adhesion_length_over_range": adhesion["adhesion_length_over_range"],
        "range_over_h_rms": adhesion["range_over_h_rms"],
    }
    increasing = {name: np.sort(np.array(values, float)) for name, values in points.items()}
    return tuple(
        xr.DataArray(increasing[name], dims=name, name=name, coords={name: increasing[name]})
        for name in AXES
    )


def count_points(parameters):
    """Points of the finest grid by range, from the parameters of a file of states."""
    side = parameters["grid_points"] * parameters["refine"]
    return (side / xr.DataArray(parameters["coarser"], dims=AXES[2])) ** 2


def seeds_on_both(states):
    """Seeds whose states are solved on the finest grid, too."""
    solved = fine(states.area_alone).notnull()
    return states.seed[solved.all(set(solved.dims) - {"seed"})]


def scaled_law(adhesion, kind, adhesion_length_over_range, range_over_h_rms):
    """A traction law of this kind in the units of the simulations."""
    strength = adhesion_length_over_range / adhesion["q0_h_rms"]
    return LAWS[kind](adhesion_length=strength * range_over_h_rms, range=range_over_h_rms)


def solve_at_gap(heights, length, law, contact, tolerance, start=None):
    """Solve the adhesive state at the mean gap of a contact without adhesion.

    The descent begins at the gap `start`, or, if that is None, at the gap without adhesion.
    """
    start = contact.gap if start is None else start
    state = adhesive.solve(
        heights, length, law, mean_gap=contact.mean_gap, start=start, tol=tolerance
    )
    logging.info(
        f"n = {len(heights)}, p = {contact.mean_pressure:.3g}, l_a {law.adhesion_length:.3g}, "
        f"range {law.range:g}: area {state.repulsive_area_fraction:.4f}, "
        f"residual {state.residual:.1e}, {state.iterations} iterations"
    )
    return state


def pressure_at(states, curve):
    """Pressure without adhesion at the area of adhesive contact, NaN beyond the curve of areas."""
    # The curve may be on another grid, or without its pixels: it is scaled to the area at this gap.
    area = states.repulsive_area / states.area_alone * curve.sel(pressure=states.pressure)
    loads = np.log(curve.pressure.values)

    def invert(wanted, tabulated):
        return np.exp(np.interp(np.log(wanted), np.log(tabulated), loads, np.nan, np.nan))

    curve = curve.rename(pressure="load")
    return xr.apply_ufunc(invert, area, curve, input_core_dims=[[], ["load"]], vectorize=True)


def solver_error(states):
    """Relative error by the solver, and by the branch on which it ends, at every point of a set."""
    attraction_over_load = states.attraction_dmt / states.pressure
    branching = (attraction_over_load > BRANCHING).any(["seed", "resolution"])
    return SOLVER + BRANCH * branching
