"""What the limit of fine grids changes in the means of ensembles, and the error that is left.

For areas, gaps and P(u) `stickiness.repulsive.richardson` gives both. What derives from these means
inherits shift and error to first order.
"""

from dataclasses import dataclass

import numpy as np
import xarray as xr

from stickiness.repulsive import richardson

DIRECT = "error left in the limit of fine grids, covers 90 %"
LEFT = "left in the limit of fine grids"
FIRST_ORDER = "twice the change from half the resolution: of first order in the pixel"
INHERITED = "from the errors left in areas in the limit of fine grids"
EXTRAPOLATION = "extrapolation"  # ending of the name of what a mean in the file holds of it
_STEP = 1e-4  # share of a shift or an error in finite differences: first order is meant


@dataclass(frozen=True)
class Correction:
    """What to add to a mean over the solutions on the finest grid, and the error it then has."""

    shift: xr.DataArray
    error: xr.DataArray


def estimate(name, realisations, quantity):
    """Limit of the mean over seeds of a quantity, by the name of its rule in `richardson`."""
    fine = realisations.isel(resolution=-1, drop=True)
    values = quantity(realisations)
    climbs = np.inf
    if name == "attractive_area":
        edge_gap = fine.edge_gap.mean("seed")
        # Nothing is below the gap next to an edge where there is no edge.
        climbs = (fine["range"] / edge_gap).where(edge_gap > 0, np.inf)
    means = [values.isel(resolution=k, drop=True).mean("seed") for k in find_halved(realisations)]
    part = subpixel_part(name, fine, quantity(fine)).mean("seed")
    limit = richardson.estimate(name, means, part, fine.edges.sum("seed"), climbs)
    return Correction(limit.value - means[-1], limit.error)


def estimate_first_order(values):
    """Limit of the mean of a quantity that counts whole pixels at the edge: no shift, a wide error.

    A grid then leaves out as much as its last change: twice that covers single surfaces.
    """
    fine = values.isel(resolution=-1, drop=True).mean("seed")
    half = values.isel(resolution=-2, drop=True).mean("seed")
    return Correction(xr.zeros_like(fine), 2 * abs(fine - half))


def find_halved(realisations):
    """Indices, up to three, of the finest grids that are each twice as fine as the one before."""
    resolution = realisations.resolution.values
    grids = len(resolution)
    count = 1
    while count < min(grids, 3) and np.isclose(resolution[-count], 2 * resolution[-count - 1]):
        count += 1
    return list(range(grids - count, grids))


def subpixel_part(name, fine, values):
    """What sub-pixel edges contribute to a quantity on one grid, see `richardson.estimate`."""
    area = fine.area_fraction - fine.pixel_area_fraction
    if name == "area_fraction":
        return area
    if name == "mean_gap":
        return area * fine.edge_gap
    attractive = fine.attractive_area - fine.pixel_attractive_area
    if name == "attractive_area":
        return attractive
    share = (attractive / fine.attractive_area).where(fine.attractive_area > 0, 0.0)
    share = share.isel(range=slice(-1)).rename(range="gap")
    return values * share.assign_coords(gap=values.gap)


def inherit(ensemble, quantity, names):
    """Limit of what derives from the means `names` of an ensemble, to first order.

    The errors of one mean at all loads and ranges are taken to rise and fall together, those of
    different means to be independent.
    """
    means = {name: ensemble[f"{name}_mean"] for name in names}
    slope = ensemble.rms_slope.mean("seed")
    rest = xr.Dataset({"rms_slope": slope}, {"pressure": ensemble.pressure})
    unchanged = quantity(rest.assign(means))

    def change(name, by):
        moved = quantity(rest.assign({**means, name: means[name] + _STEP * by}))
        return (moved - unchanged) / _STEP

    shift = xr.zeros_like(unchanged)
    square = xr.zeros_like(unchanged)
    for name in names:
        square = square + change(name, ensemble[f"{name}_discretisation_error"]) ** 2
        if f"{name}_{EXTRAPOLATION}" in ensemble:
            shift = shift + change(name, ensemble[f"{name}_{EXTRAPOLATION}"])
    return Correction(shift, np.sqrt(square))
