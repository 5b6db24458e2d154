"""Bring one realisation into adhesive contact at the mean gaps it has without adhesion.

At a prescribed mean gap the attraction shows whole: in the mean pressure that is left, and in the
area. A press would jump where the pressure falls on closing. Every state is solved on the grid of
the realisation and on every second point of it. What the grid does not resolve is left out, and so
is attraction so strong that the window closes altogether.
"""

import itertools
import logging

import numpy as np
import xarray as xr

from _adhesion import DESCRIBED as ADHESION_DESCRIBED
from _adhesion import MISSING, axis, roughness, scaled_law
from _job import start
from _model import pixels
from stickiness import adhesive, cohesive_zone, datasets, dmt, repulsive
from stickiness.surface import resample

STATE = {
    "external_pressure": "mean pressure over E* q0 h_rms",
    "repulsive_pressure": "repulsive part of the mean pressure over E* q0 h_rms",
    "attraction": "attractive part of the mean pressure over E* q0 h_rms",
    "repulsive_area": "repulsive contact area over nominal area, by pixels",
    "attractive_area": "area within the range of attraction, not in contact, over nominal area",
    "elastic_energy": "elastic energy per nominal area over E* q0 h_rms^2",
    "interaction_energy": "energy of the attraction per nominal area over E* q0 h_rms^2",
    "residual": "unbalanced pressure over the strength or the flattening pressure",
    "iterations": "iterations of conjugate gradients",
}
ALONE = {
    "area_alone": "contact area without adhesion over nominal area, by pixels",
    "mean_gap": "mean gap over h_rms, the same with and without adhesion",
    "edge_gap": "gap next to the contact without adhesion over h_rms",
}
STRONGEST = 8.0  # attraction over repulsion, in the DMT limit, that is still looked at
TIGHTEST = 1e-7  # tolerance: far below the errors of grid and sampling


def main(job):
    surface = datasets.read(job.input.surface, ["height", "window_length", "rms_slope"])
    asked = job.params.adhesion
    length, refine = float(surface.window_length), asked["bem"].get("refine", 1)
    heights = resample(surface.height.values, refine * len(surface.height))
    chosen = list(combinations(asked, length / len(heights)))
    solved = [
        states(heights[::step, ::step], length, asked, chosen, max(job.params.tolerance, TIGHTEST))
        for step in (2, 1)
    ]
    made = datasets.parameters(surface)
    finest = refine * pixels(surface)
    resolution = xr.DataArray([finest / 2, finest], dims="resolution", name="resolution")
    dataset = xr.concat(solved, resolution, coords="minimal")
    dataset["rms_slope"] = surface.rms_slope.sel(source="heights", drop=True)
    datasets.write(
        annotated(dataset),
        job.output[0],
        title="adhesive contact of one realisation at given mean gaps",
        parameters={
            **made,
            "q0_h_rms": roughness(asked),
            "law": asked["bem"]["law"],
            "refine": refine,
            "pixel": length / len(heights),
            "strongest": STRONGEST,
            "coarsest": cohesive_zone.COARSEST,
        },
    )


def combinations(asked, pixel):
    """Indices (l_a/range, range) that the grid resolves, with their traction laws."""
    lengths = axis("adhesion_length_over_range", asked).values
    ranges = axis("range_over_h_rms", asked).values
    for j, k in itertools.product(range(len(lengths)), range(len(ranges))):
        law = scaled_law(asked, asked["bem"]["law"], lengths[j], ranges[k])
        if (
            cohesive_zone.resolution(pixel, law.range, law.adhesion_length)
            <= cohesive_zone.COARSEST
        ):
            yield j, k, law
        else:
            logging.info("l_a/range %g, range %g: not resolved", lengths[j], ranges[k])


def states(heights, length, asked, chosen, tolerance):
    """Adhesive states on one grid, NaN where there is none."""
    pressures = np.sort(np.array(asked["bem"]["pressures"], dtype=float))
    lengths, ranges = axis("adhesion_length_over_range", asked), axis("range_over_h_rms", asked)
    shape = len(pressures), lengths.size, ranges.size
    values = {name: np.full(shape, np.nan) for name in (*STATE, "attraction_dmt")}
    alone = {name: np.empty(len(pressures)) for name in ALONE}
    for i, contact in enumerate(repulsive.load_path(heights, length, pressures, tol=tolerance)):
        alone["area_alone"][i] = contact.area_fraction
        alone["mean_gap"][i] = contact.mean_gap
        alone["edge_gap"][i] = dmt.edge_gap(contact.gap)
        for j, k, law in chosen:
            attraction = float(np.mean(law.traction(contact.gap), where=contact.gap > 0))
            attraction *= 1 - contact.area_fraction
            if attraction > STRONGEST * pressures[i]:
                continue
            values["attraction_dmt"][i, j, k] = attraction
            for name, value in closed(heights, length, law, contact, tolerance).items():
                values[name][i, j, k] = value
    dims = "pressure", "adhesion_length_over_range", "range_over_h_rms"
    return xr.Dataset(
        {name: (dims, value) for name, value in values.items()}
        | {name: ("pressure", value) for name, value in alone.items()},
        coords={"pressure": pressures} | {a.name or a.dims[0]: a for a in (lengths, ranges)},
    )


def closed(heights, length, law, contact, tolerance):
    """State at the mean gap of a contact without adhesion, reached from that contact."""
    state = adhesive.solve(
        heights, length, law, mean_gap=contact.mean_gap, start=contact, tol=tolerance
    )
    logging.info(
        "n = %d, p = %.3g, l_a %.3g, range %g: area %.4f, residual %.1e, %d iterations",
        len(heights),
        contact.mean_pressure,
        law.adhesion_length,
        law.range,
        state.repulsive_area_fraction,
        state.residual,
        state.iterations,
    )
    return {
        "external_pressure": state.mean_pressure,
        "repulsive_pressure": state.repulsive_pressure,
        "attraction": state.adhesive_pressure,
        "repulsive_area": state.repulsive_area_fraction,
        "attractive_area": state.adhesive_area_fraction,
        "elastic_energy": state.elastic_energy,
        "interaction_energy": state.interaction_energy,
        "residual": state.residual,
        "iterations": state.iterations,
    }


def annotated(dataset):
    return datasets.annotate(
        dataset,
        pressure=("1", "mean pressure without adhesion at the same mean gap over E* q0 h_rms"),
        resolution=("1", "grid points per shortest wavelength"),
        rms_slope=("1", "rms gradient of this realisation over q0 h_rms"),
        attraction_dmt=(
            "1",
            "attraction over the gaps without adhesion, p_ad/(E* q0 h_rms)",
            MISSING,
        ),
        **{name: ADHESION_DESCRIBED[name] for name in dataset.dims if name in ADHESION_DESCRIBED},
        **{name: ("1", text) for name, text in ALONE.items()},
        **{name: ("1", text, MISSING) for name, text in STATE.items()},
    )


if __name__ == "__main__":
    main(start(globals(), "solve_adhesive", adhesion="fig4b_rough", seed=1))
