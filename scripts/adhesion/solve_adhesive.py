"""Bring realisations into adhesive contact at the mean gaps they have without adhesion.

At a prescribed mean gap the whole attraction shows; a press would jump where the pressure falls on
closing. Every state is solved on every second point of the grid of the surface and, of some seeds,
on all of them, but for what the grid does not resolve, attraction so strong that the window closes
altogether, and where the DMT sum is good enough. Long ranges may do with grids half as fine.
"""

import logging
from functools import partial

import numpy as np
import xarray as xr

from common import adhesion_sets, conventions
from common.adhesion_sets import AXES, LOOSEST, STATE, axes, scaled_law, solve_at_gap
from common.job import start
from common.model_surfaces import each_seed, pixels, read_first
from stickiness import datasets, dmt
from stickiness.adhesive import edge_zone
from stickiness.repulsive import half_space, solver, subpixel
from stickiness.surface import resample

ALONE = {
    "area_alone": "contact area without adhesion over nominal area, by pixels",
    "mean_gap": "mean gap over h_rms, with and without adhesion",
    "edge_gap": "gap next to the contact without adhesion over h_rms",
}
DMT = {"attraction_dmt": "attraction over the gaps without adhesion, p_ad/(E* q0 h_rms)"}
HALF = "the seed is solved on half the grid alone"
ADHESIVE_STATE_VARIABLES = {
    **{name: ("1", text, HALF) for name, text in (ALONE | DMT).items()},
    **{n: ("1", text, f"DMT sum, {adhesion_sets.MISSING}, or {HALF}") for n, text in STATE.items()},
    "pressure": "mean pressure without adhesion at the same mean gap over E* q0 h_rms",
    "rms_slope": conventions.RMS_SLOPE,
}
SHARE = 0.01  # tolerance over the strength of the law in units of the flattening pressure
FINE = 8  # points per shortest wavelength of which half are enough for long ranges


def main(job):
    first = read_first(job.input.surfaces)
    adhesion = job.params.adhesion
    length = float(first.window_length)
    refine = adhesion["refine"]
    points = refine * first.sizes["x"]
    finest = refine * pixels(first)
    ranges = axes(adhesion)[2].values
    half_from = np.inf if adhesion["half_from"] is None else adhesion["half_from"]
    wide = (ranges >= half_from) & (finest >= FINE)
    coarser = np.where(wide, 2, 1)
    pixel = xr.DataArray(length / points * coarser, dims=AXES[2])
    chosen = combinations(adhesion, pixel, np.array(job.params.full))

    def solve(steps, surface):
        fine = resample(surface.height.values, points)
        parts = []
        finenesses = [finest / step for step in steps]
        resolution = xr.DataArray(finenesses, dims="resolution", name="resolution")
        for factor in np.unique(coarser):
            here = coarser == factor
            subset = adhesion | {"range_over_h_rms": ranges[here]}
            grids = [fine[:: factor * step, :: factor * step] for step in steps]
            solved = states(grids, length, subset, chosen[:, :, here])
            parts.append(xr.concat(solved, resolution, coords="minimal"))
        return xr.concat(parts, AXES[2], data_vars="all") if len(parts) > 1 else parts[0]

    by_grids = [
        each_seed(partial(solve, steps), job.input.surfaces, seeds)
        for steps, seeds in job.params.grids
        if seeds
    ]
    dataset = xr.concat(by_grids, "seed", join="outer")
    title = "adhesive contact of realisations at given mean gaps"
    parameters = {
        **datasets.parameters(first),
        "seeds": dataset.seed.values.tolist(),
        "q0_h_rms": adhesion["q0_h_rms"],
        "law": adhesion["law"],
        "refine": refine,
        "coarser": coarser.tolist(),
        "pixel": pixel.values.tolist(),
        "strongest": adhesion_sets.STRONGEST,
        "coarsest": edge_zone.COARSEST,
    }
    dataset = conventions.annotate(dataset, **ADHESIVE_STATE_VARIABLES)
    dataset = conventions.add_convergence(dataset, LOOSEST)
    datasets.write(dataset, job.output[0], title=title, parameters=parameters)


def combinations(adhesion, pixel, full):
    """Choose the points (pressure, l_a/range, range) to solve in full that the grid resolves."""
    _, lengths, ranges = axes(adhesion)
    adhesion_length = lengths / adhesion["q0_h_rms"] * ranges
    resolved = edge_zone.resolution(pixel, ranges, adhesion_length) <= edge_zone.COARSEST
    missing = full.any(axis=0) & ~resolved.transpose(*AXES[1:]).values
    logging.info("%d points of l_a/range and range are not resolved", missing.sum())
    return full & ~missing


def states(grids, length, adhesion, chosen, loosest=LOOSEST):
    """Solve the adhesive states on grids from coarse to fine, NaN where none is chosen.

    Returns a dataset for each grid, which also holds the DMT sum. Grids have to resolve the edges
    of contact, as `combinations` sees to: else the coarser grid starts states too close to contact.
    """
    pressures = axes(adhesion)[0]
    tolerance = min(adhesion_sets.TIGHTEST, loosest)
    paths = [solver.load_path(grid, length, pressures.values, tol=tolerance) for grid in grids]
    by_load = []
    for contacts, chosen_here in zip(zip(*paths, strict=True), chosen, strict=True):
        solved = []
        closing = {}
        for heights, contact in zip(grids, contacts, strict=True):
            # The coarser grid starts the finer one.
            of_load, closing = states_at_load(
                heights=heights,
                length=length,
                adhesion=adhesion,
                contact=contact,
                chosen=chosen_here,
                loosest=loosest,
                coarser=closing,
            )
            solved.append(of_load)
        by_load.append(solved)
    return [xr.concat(loads, pressures) for loads in zip(*by_load, strict=True)]


def states_at_load(heights, length, adhesion, contact, chosen, loosest, coarser):
    """Solve the states at the mean gap of one contact without adhesion.

    Returns a dataset, and the change of the gap by strong adhesion at every point that is solved.
    That of a grid half as fine, `coarser`, is where strong adhesion starts.
    """
    _, lengths, ranges = axes(adhesion)
    units = [scaled_law(adhesion, adhesion["law"], 1.0, range_) for range_ in ranges.values]
    sums = [dmt.adhesive_pressure(contact.gap, law) for law in units]
    attraction = np.outer(lengths, sums)  # in proportion to the length
    solvable = chosen & (attraction <= adhesion_sets.STRONGEST * contact.mean_pressure)
    strong = attraction > adhesion_sets.NEARLY_LINEAR * contact.mean_pressure
    flattening = half_space.measure_slope(heights, (length, length)) / 2
    tightest = min(adhesion_sets.TIGHTEST, loosest)
    values = {name: np.full(chosen.shape, np.nan) for name in STATE}
    closing = {}
    # Of each range from the weakest adhesion on: states so far, by adhesion length and gap.
    weaker = {k: [(0.0, contact.gap)] for k in range(ranges.size)}
    for j, k in np.argwhere(solvable).tolist():
        law = scaled_law(adhesion, adhesion["law"], lengths.values[j], ranges.values[k])
        if (j, k) in coarser:
            start = contact.gap + half_space.interpolate(coarser[j, k], heights.shape)
        else:
            start = extrapolate(weaker[k], law.adhesion_length)
        tolerance = min(max(tightest, SHARE * law.strength / flattening), loosest)
        state = solve_at_gap(heights, length, law, contact, tolerance, start=np.maximum(start, 0.0))
        for name in STATE:
            values[name][j, k] = getattr(state, adhesion_sets.ATTRIBUTES.get(name, name))
        weaker[k] = [weaker[k][-1], (law.adhesion_length, state.gap)]
        if strong[j, k]:
            closing[j, k] = (state.gap - contact.gap).astype(np.float32)
    alone = {
        "area_alone": contact.area_fraction,
        "mean_gap": contact.mean_gap,
        "edge_gap": subpixel.edge_gap(contact.gap),
    }
    values["attraction_dmt"] = attraction
    dataset = xr.Dataset(
        {name: (AXES[1:], value) for name, value in values.items()} | alone,
        coords={axis.name: axis for axis in (lengths, ranges)},
    )
    return dataset, closing


def extrapolate(weaker, adhesion_length):
    """Gap at an adhesion length, on the line through those of the last two that are weaker."""
    if len(weaker) == 1:
        return weaker[0][1]
    (first_length, first_gap), (last_length, last_gap) = weaker
    slope = (last_gap - first_gap) / (last_length - first_length)
    return last_gap + slope * (adhesion_length - last_length)


if __name__ == "__main__":
    main(start(globals()))
