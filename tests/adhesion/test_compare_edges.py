"""Attraction at the edges of contact, from simulation."""

import numpy as np
import xarray as xr

from adhesion import compare_edges
from stickiness.criteria import equivalent_sphere


def test_simulation_of_spheres_is_the_model_of_the_edges():
    """Realisations that behave as the equivalent sphere give a ratio of 1, at any load and area."""
    loads, q0_h_rms = np.geomspace(0.01, 0.3, 9), 0.1
    ranges, lengths = np.array([0.03, 0.1]), np.array([1e-3, 0.1])
    gaps = np.geomspace(1e-3, 10, 400)
    area = 0.9 * loads  # without adhesion
    attractive = 1.3 * loads[:, None] * gaps ** (2 / 3)
    alone = xr.Dataset(
        {
            "pixel_area_fraction": (("resolution", "pressure"), [area]),
            "attractive_area": (("resolution", "pressure", "range"), [attractive]),
        },
        coords={"pressure": loads, "range": gaps, "resolution": [8.0]},
    )
    at = loads[[3, 4]]
    dims = ("pressure", "adhesion_length_over_range", "range_over_h_rms")
    held = 1.1 * at[:, None, None]  # load without adhesion at the area with it
    strength = lengths[:, None] / q0_h_rms
    t = 1.3 / 0.9 * ranges ** (2 / 3)
    tau = equivalent_sphere.edge_strength(t, strength * 0.9)
    ratio = strength * 1.3 * ranges ** (2 / 3) * equivalent_sphere.effect(t, tau)
    adhesive = xr.Dataset(
        {
            "external_pressure": (dims, held * (1 - ratio)),
            "repulsive_area": (dims, 0.9 * held * np.ones((1, 2, 2))),
            "attraction_dmt": (dims, strength * 1.3 * at[:, None, None] * ranges ** (2 / 3)),
            "area_alone": ("pressure", 0.9 * at),
        },
        coords=dict(zip(dims, (at, lengths, ranges), strict=True)),
    ).expand_dims(resolution=[8.0])
    made = {"law": "maugis", "grid_points": 512, "refine": 1, "coarser": [1, 1]}
    made |= {"q0_h_rms": q0_h_rms, dims[1]: lengths, dims[2]: ranges, "pressures": at}
    found = compare_edges.compare(adhesive, alone, made, -1)
    np.testing.assert_allclose(found.effect, found.effect_model, rtol=1e-3)
    few = compare_edges.compare(adhesive, alone, made | {"grid_points": 64}, -1)
    assert few.effect.isnull().all()
    np.testing.assert_allclose(found.edge_strength.transpose(*dims)[0], tau, rtol=1e-3)
