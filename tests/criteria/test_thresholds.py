"""Thresholds of pairs beside the library's, and put back into the verdict."""

import json

import numpy as np
import pytest
import xarray as xr

from common.materials import read_material
from common.verdicts import find_limits
from criteria import verdicts
from criteria.pair_roughness import ENDS
from criteria.thresholds import ASKED, find_thresholds
from stickiness import thresholds
from stickiness.criteria.a_v_table import SurfaceAv
from stickiness.criteria.pair import SIGNS
from stickiness.spectrum import SelfAffine, Tabulated

A_V = SurfaceAv(np.array([1e-9, 1.0]), np.full((2, 2), 3.0), 0.1)
Q = np.geomspace(6e4, 6e7, 200)
SHAPE = SelfAffine(hurst=0.8, q0=Q[0], q1=Q[-1], h_rms=1.0)
FREQUENCIES = np.geomspace(1e-3, 1e3, 13)
TAPE = {"label": "tape", "youngs_modulus": "1 MPa", "poisson_ratio": 0.5}
TAPE |= {"work_of_adhesion": "60 mJ/m^2", "range": "3 nm", "source": "made up"}
SERIES = {"equilibrium": "0.1 MPa", "terms": [["2 MPa", "0.1 s"], ["100 MPa", "1 ms"]]}
SLOW = {key: value for key, value in TAPE.items() if key != "youngs_modulus"}
SLOW |= {"youngs_modulus_prony": SERIES}
LAYER = TAPE | {"thickness": "20 um"}
BACKING = {"youngs_modulus": "3 GPa", "poisson_ratio": 0.4, "thickness": "25 um"}
MATERIALS = {"deep": TAPE, "slow": SLOW, "layer": LAYER, "film": LAYER | {"backing": BACKING}}


@pytest.fixture(autouse=True)
def fixed_a_v(monkeypatch):
    """Of a_V nothing here depends, and theory takes its time."""
    monkeypatch.setattr(verdicts, "find_a_v", lambda surface: (A_V, A_V))


def spectrum(h_rms):
    return Tabulated(Q, h_rms**2 * SHAPE.psd(Q))


def wall(h_rms=1e-6, apart=1.0, draws=0):
    """Analysed surface whose rough end is so many times as high as the smooth one."""
    ends = [spectrum(h_rms * factor) for factor in (1, apart)]
    names = ("h_rms", "rms_slope", "rms_curvature")
    data = {name: ("end", [getattr(one, name) for one in ends]) for name in names}
    data["elastic_energy"] = "end", [one.elastic_energy() for one in ends]
    data["psd"] = ("end", "wave_number"), [one.psd(Q) for one in ends]
    if draws:
        h = h_rms * np.random.default_rng(1).lognormal(0.0, 0.2, draws)
        data["h_rms_draws"] = "draw", h
        data["q0_draws"] = "draw", np.full(draws, Q[0])
        data["elastic_energy_draws"] = "draw", spectrum(1.0).elastic_energy() * h**2
    data |= {"q0": Q[0], "q1": Q[-1], "hurst": 0.8}
    dataset = xr.Dataset(data, coords={"end": list(ENDS), "wave_number": Q})
    return dataset.assign_attrs(parameters=json.dumps({"label": "wall", "kind": "self_affine"}))


def judge(entries, surface):
    solids = {name: read_material(entry) for name, entry in entries.items()}
    found = verdicts.find_verdicts(solids, {"wall": surface}, {}, FREQUENCIES)
    return find_thresholds(found, surface, {}, entries).sel(surface="wall")


def three(pair, name):
    return [float(pair[f"{name}{end}"]) for end in SIGNS]


@pytest.mark.parametrize("name", MATERIALS)
def test_a_surface_that_is_known_has_the_thresholds_of_the_library(name):
    solid = read_material(MATERIALS[name])
    pair = judge({name: MATERIALS[name]}, wall()).sel(material=name)
    known = {"modulus": solid.modulus * 0.75, "poisson": 0.5, "solid": solid.solid}
    known |= {"work_of_adhesion": solid.work_of_adhesion, "range": solid.range}
    storage = solid.plane_strain if name == "slow" else None
    if storage is not None:  # E* as the modulus is
        known |= {"modulus": solid.modulus, "poisson": None}
    found = thresholds(spectrum(1e-6), storage=storage, **known)
    values = found.rms_height, found.thickness, found.rate, found.pressure
    for asked, expected in zip(ASKED, values, strict=True):
        expected = expected or (np.nan,) * 3
        assert three(pair, asked) == pytest.approx(tuple(expected), rel=1e-3, nan_ok=True)
    assert np.isfinite(three(pair, "rms_height_threshold")).all()
    assert np.isfinite(three(pair, "rate_threshold")).all() == (name == "slow")


@pytest.mark.parametrize(("apart", "draws"), [(2.0, 0), (1.5, 40)])
def test_verdict_and_thresholds_of_random_pairs_agree(apart, draws):
    """A pair is on the same side of all its limits as its share is."""
    rng, words, outside = np.random.default_rng(3), set(), []
    layers = [{}, {"backing": "bonded"}, {"backing": BACKING}]
    entries = {
        str(i): SLOW
        | {"work_of_adhesion": f"{float(10 ** rng.uniform(-3, 0))!r} J/m^2"}
        | (layers[i % 3] and layers[i % 3] | {"thickness": f"{float(rng.uniform(3, 90))!r} um"})
        for i in range(15)
    }
    found = judge(entries, wall(1e-6, apart, draws))
    for name, entry in entries.items():
        pair = found.sel(material=name)
        low, high = (float(limit) >= 0.1 for limit in find_limits(pair))
        words.add((low, high))
        height, (value, least, most) = 1e-6 * apart**0.5, three(pair, "rms_height_threshold")
        assert least <= value <= most
        assert (least > height, most > height) == (low, high)
        _, slowest, fastest = three(pair, "rate_threshold")
        assert (slowest > 1, fastest > 1) == (low, high)
        _, thinnest, thickest = three(pair, "thickness_threshold")
        if "thickness" in entry:
            thickness = read_material(entry).solid.thickness
            # Between its limits a layer on a film may stick where thicker ones do not.
            assert low >= (thickest < thickness)
            assert high <= (thinnest < thickness)
            outside.append(not thinnest < thickness < thickest)
        else:
            assert np.isnan(thinnest)
    assert len(words) == 3
    assert sum(outside) > 3
