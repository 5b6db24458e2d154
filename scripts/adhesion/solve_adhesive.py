"""Bring realisations into adhesive contact at the mean gaps they have without adhesion.

At a prescribed mean gap the whole attraction shows; a press would jump where the pressure falls on
closing. Every state is solved on every second point of the grid of the surface and, of some seeds,
on all of them, but for what the grid does not resolve, attraction so strong that the window closes
altogether, and where the DMT sum is good enough. Long ranges may do with grids half as fine.
"""

import itertools
import logging
from functools import partial

import numpy as np
import xarray as xr

from common import adhesion_sets, conventions
from common.adhesion_sets import AXES, LOOSEST, STATE, axes, scaled_law
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
            solved = [states(grid, length, subset, chosen[:, :, here]) for grid in grids]
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


def states(heights, length, adhesion, chosen, loosest=LOOSEST):
    """Solve the adhesive states on one grid, NaN where none is chosen, and take the DMT sum."""
    pressures, lengths, ranges = axes(adhesion)
    flattening = half_space.measure_slope(heights, (length, length)) / 2
    values = {name: np.full(chosen.shape, np.nan) for name in STATE | DMT}
    alone = []
    tightest = min(adhesion_sets.TIGHTEST, loosest)
    path = solver.load_path(heights, length, pressures.values, tol=tightest)
    for i, contact in enumerate(path):
        alone.append((contact.area_fraction, contact.mean_gap, subpixel.edge_gap(contact.gap)))
        units = [scaled_law(adhesion, adhesion["law"], 1.0, range_) for range_ in ranges.values]
        sums = [dmt.adhesive_pressure(contact.gap, law) for law in units]
        values["attraction_dmt"][i] = np.outer(lengths, sums)  # in proportion to the length
        weaker = {}  # by range, the last state with weak adhesion
        # Of each range from the weakest adhesion on, which starts the next one.
        for j, k in itertools.product(range(lengths.size), range(ranges.size)):
            law = scaled_law(adhesion, adhesion["law"], lengths.values[j], ranges.values[k])
            attraction = values["attraction_dmt"][i, j, k]
            if chosen[i, j, k] and attraction <= adhesion_sets.STRONGEST * contact.mean_pressure:
                weak = attraction <= adhesion_sets.NEARLY_LINEAR * contact.mean_pressure
                weaker_state = weaker.get(k) if weak else None
                tolerance = min(max(tightest, SHARE * law.strength / flattening), loosest)
                state = adhesion_sets.solve_at_gap(
                    heights, length, law, contact, tolerance, weaker_state
                )
                for name in STATE:
                    values[name][i, j, k] = getattr(state, adhesion_sets.ATTRIBUTES.get(name, name))
                if weak:
                    weaker[k] = law.adhesion_length, state.gap
    return xr.Dataset(
        {name: (AXES, value) for name, value in values.items()}
        | {n: ("pressure", v) for n, v in zip(ALONE, np.transpose(alone), strict=True)},
        coords={axis.name: axis for axis in (pressures, lengths, ranges)},
    )


if __name__ == "__main__":
    main(start(globals()))
