"""Load one realisation with growing adhesion: areas, and a map of the strongest, for Figure 2.

The grid is finer than that of the ensembles, since the attraction of the paper's maps acts over a
zone far narrower than the shortest wave.
"""

import logging

import numpy as np
import xarray as xr

from common.adhesion_sets import STATE, scaled_law
from common.conventions import add_convergence, annotate
from common.job import start
from common.model_surfaces import read_first
from stickiness import adhesive, datasets
from stickiness.adhesive import edge_zone
from stickiness.repulsive import solver
from stickiness.surface import resample

# Of the residual. With 1e-6 the areas change by less than 1 % on 1024 x 1024 points.
TOLERANCE = 1e-4
DIMS = ("adhesion_length_over_range", "pressure")
AREAS = {
    "repulsive_area": "repulsive_area_fraction",
    "net_repulsive_area": "net_repulsive_area_fraction",
    "attractive_area": "adhesive_area_fraction",
}
KEPT = (*AREAS, "residual", "iterations")
TEXTS = {
    **{name: STATE[name] for name in KEPT},
    "area_alone": "contact area without adhesion over nominal area, by pixels",
    "zone": "zone of the strongest adhesion: 0 apart, 1 gap within the range, "
    "2 contact in tension, 3 contact under compression",
    "pixels_in_zone": "pixels in the zone of attraction, range^2/l_a",
    "range_over_h_rms": "range over h_rms",
}


def main(job):
    surface = read_first(job.input.surfaces)
    adhesion = job.params.adhesion
    shown = adhesion["maps"]
    length = float(surface.window_length)
    points = max(surface.sizes["x"], job.params.points)
    heights = resample(surface.height.values, points)
    pressures = np.sort(np.array(shown["pressures"], dtype=float))
    lengths = np.sort(np.array(shown["adhesion_length_over_range"], dtype=float))
    range_ = shown["range_over_h_rms"]
    alone = solver.load_path(heights, length, pressures, tol=TOLERANCE)
    area_alone = [contact.area_fraction for contact in alone]
    laws = [scaled_law(adhesion, adhesion["law"], value, range_) for value in lengths]
    curves = [load(heights, length, law, pressures) for law in laws]
    resolutions = [
        edge_zone.resolution(length / points, law.range, law.adhesion_length) for law in laws
    ]
    side = np.arange(points) * length / points
    coords = {DIMS[0]: lengths, "pressure": pressures}
    coords |= {axis: (axis, side, surface[axis].attrs) for axis in ("x", "y")}
    dataset = xr.Dataset(
        {
            "area_alone": ("pressure", area_alone),
            "zone": (("pressure", "x", "y"), [find_zones(state, range_) for state in curves[-1]]),
            "pixels_in_zone": (DIMS[0], 1 / np.array(resolutions)),
            "range_over_h_rms": range_,
        },
        coords=coords,
    )
    for name in (*KEPT, "mean_gap"):
        attribute = AREAS.get(name, name)
        dataset[name] = DIMS, [[getattr(state, attribute) for state in curve] for curve in curves]
    dataset = add_convergence(annotate(dataset, **TEXTS), TOLERANCE)
    title = "areas and zones of one realisation in adhesive contact"
    settings = {"law": adhesion["law"], "q0_h_rms": adhesion["q0_h_rms"]}
    parameters = {**datasets.parameters(surface), **settings, "map_points": points}
    datasets.write(dataset, job.output[0], title=title, parameters=parameters)


def load(heights, length, law, pressures):
    """States under growing loads: each is where a press would find it on loading."""
    states = []
    for pressure in pressures:
        previous = states[-1] if states else None
        state = adhesive.solve(
            heights, length, law, pressure=pressure, start=previous, tol=TOLERANCE
        )
        logging.info(
            "l_a %.3g, p %.3g: %d iterations", law.adhesion_length, pressure, state.iterations
        )
        states.append(state)
    return states


def find_zones(state, range_):
    """Zone of every point, in the codes of the variable `zone`."""
    contact = state.gap == 0
    compressed = contact & (state.pressure > 0)
    attracted = ~contact & (state.gap <= range_)
    return np.select([compressed, contact, attracted], [3, 2, 1], 0).astype("i1")


if __name__ == "__main__":
    main(start(globals()))
