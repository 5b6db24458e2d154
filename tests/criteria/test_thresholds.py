"""Thresholds of pairs beside the library's."""

import numpy as np
import pytest
from helpers.analysed import fix_a_v, wall

from common.materials import read_material
from criteria import verdicts
from criteria.pair_roughness import real_spectrum
from criteria.thresholds import ASKED, find_thresholds
from stickiness import thresholds
from stickiness.criteria.pair import SIGNS

TAPE = {"label": "tape", "youngs_modulus": "1 MPa", "poisson_ratio": 0.5}
TAPE |= {"work_of_adhesion": "60 mJ/m^2", "range": "3 nm", "source": "made up"}
SERIES = {"equilibrium": "0.1 MPa", "terms": [["2 MPa", "0.1 s"], ["100 MPa", "1 ms"]]}
SLOW = {key: value for key, value in TAPE.items() if key != "youngs_modulus"}
SLOW |= {"youngs_modulus_prony": SERIES}
LAYER = TAPE | {"thickness": "20 um"}
BACKING = {"youngs_modulus": "3 GPa", "poisson_ratio": 0.4, "thickness": "25 um"}
MATERIALS = {"deep": TAPE, "slow": SLOW, "layer": LAYER, "film": LAYER | {"backing": BACKING}}


@pytest.mark.parametrize("name", MATERIALS)
def test_a_surface_that_is_known_has_the_thresholds_of_the_library(name, monkeypatch):
    fix_a_v(monkeypatch)
    solid, surface = read_material(MATERIALS[name]), wall(apart=1.0)
    pairs = verdicts.find_verdicts({name: solid}, {"": surface}, {}, np.geomspace(1e-3, 1e3, 13))
    pair = find_thresholds(pairs, surface, {}, {name: MATERIALS[name]}).squeeze()
    known = {"modulus": solid.modulus * 0.75, "poisson": 0.5, "solid": solid.solid}
    known |= {"work_of_adhesion": solid.work_of_adhesion, "range": solid.range}
    storage = solid.plane_strain if name == "slow" else None
    if storage is not None:  # E* as the modulus is
        known |= {"modulus": solid.modulus, "poisson": None}
    found = thresholds(real_spectrum(surface), storage=storage, **known)
    values = found.rms_height, found.thickness, found.rate, found.pressure
    ours = {asked: tuple(float(pair[f"{asked}{end}"]) for end in SIGNS) for asked in ASKED}
    for asked, expected in zip(ASKED, values, strict=True):
        expected = tuple(expected or (np.nan,) * 3)
        assert ours[asked] == pytest.approx(expected, rel=1e-3, nan_ok=True)
    assert np.isfinite(ours["rms_height_threshold"]).all()
    assert np.isfinite(ours["rate_threshold"]).all() == (name == "slow")
