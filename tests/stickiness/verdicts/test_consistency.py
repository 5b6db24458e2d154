"""The verdict, the share, the probability, the margin and the threshold of a pair agree."""

from typing import Any, NamedTuple

import numpy as np
import pytest
import xarray as xr
from helpers.analysed import A_V, wall

from stickiness import Material, judge
from stickiness.criteria.pair import FULL_SHARE, MOST_STRAIN, WORDS
from stickiness.entries import check_material
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.solids import HALF_SPACE
from stickiness.verdicts import curves, meeting
from stickiness.verdicts.judgement import LEAST_MODULUS
from stickiness.verdicts.limits import LIMITS, read_limited

pytestmark = pytest.mark.usefixtures("coarse_simulation")

SURFACES = ("a", "b", "c", "rough", "x")
ROUGH_MATERIAL = "rough"  # surface of materials that are rough themselves; it was not measured
FILM = {"youngs_modulus": "1 GPa", "poisson_ratio": 0.4, "thickness": "20 um"}
SERIES = {"equilibrium": "20 kPa", "terms": [["0.1 MPa", "1 s"], ["10 MPa", "1 ms"]]}
TABLE = [["1 mHz", "10 kPa"], ["1 Hz", "0.2 MPa"], ["100 Hz", "1 MPa"], ["1 kHz", "0.96 MPa"]]


class Judged(NamedTuple):
    """Entries of materials, the materials, and the verdicts on all surfaces."""

    entries: dict[str, dict[str, Any]]
    materials: dict[str, Material]
    verdicts: xr.Dataset


def make_entry(rng):
    """Entry of any kind: modulus, layer, dwell, pressure, roughness and law are drawn."""
    entry = {
        "work_of_adhesion": f"{10 ** rng.uniform(-2, 0)!r} J/m^2",
        "poisson_ratio": 0.5,
        "range": f"{10 ** rng.uniform(-10, -7.5)!r} m",
    }
    depends_on_rate = rng.random() < 0.5
    if not depends_on_rate:
        entry["youngs_modulus"] = f"{10 ** rng.uniform(3, 8)!r} Pa"
    elif rng.integers(2) == 0:
        entry["youngs_modulus_prony"] = SERIES
    else:
        entry["youngs_modulus_table"] = TABLE
    if rng.random() < 0.7:
        entry["thickness"] = f"{10 ** rng.uniform(-0.5, 2.5)!r} um"
        entry["backing"] = ("bonded", "slip", FILM)[rng.integers(3)]
    dwell = {"dwell": "10 s"} if depends_on_rate else {}
    pressed = {"pressed": "1 MPa"}
    rough = {"surface": ROUGH_MATERIAL}
    tail = {"law": "van_der_waals"}
    for option in (dwell, pressed, rough, tail):
        if rng.random() < 0.3:
            entry |= option
    return check_material(entry)


def make_wall(rng, draws):
    """Surface with draws if it was measured."""
    longest = 10 ** rng.uniform(-4, -2)
    h_rms = 10 ** rng.uniform(-7.5, -5)
    return wall(
        h_rms=0.8 * h_rms,
        draws=draws,
        apart=1.5,
        scatter=0.2,
        longest=longest,
        shortest=1e-3 * longest,
        axis_ratio=rng.choice([1.0, 3.0]),
    )


@pytest.fixture(scope="module")
def judged():
    """Verdicts on many materials and surfaces of all kinds."""
    rng = np.random.default_rng(5)
    entries = {str(i): make_entry(rng) for i in range(30)}
    walls = {name: make_wall(rng, 60 * (name < ROUGH_MATERIAL)) for name in SURFACES}
    materials = {name: Material.from_entry(entry, walls) for name, entry in entries.items()}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(meeting, "surface_a_v", lambda *_: A_V)
        for axis in ("MODULUS", "ROUGHNESS", "DWELL"):  # of curves, which take most of the time
            patch.setattr(curves, f"{axis}_FACTORS", np.ones(1))
        verdicts = judge(materials, walls, frequencies=np.geomspace(1e-4, 1e4, 5), thresholds=False)
        some = {name: materials[name] for name in list(materials)[:15]}
        on_two = {name: walls[name] for name in ("a", ROUGH_MATERIAL)}
        with_thresholds = judge(some, on_two, curves=False)
    return Judged(entries, materials, verdicts), with_thresholds


@pytest.mark.slow
def test_share_margin_threshold_and_probability_say_the_same(judged):
    """Without any tolerance: there are no ties among random numbers."""
    verdicts = judged[0].verdicts
    agree = np.testing.assert_array_equal
    low, value, high = (verdicts.remaining.sel(limit=name, drop=True) for name in LIMITS)
    words = np.array(WORDS)[verdicts.verdict.values]
    assert set(words.ravel()) == set(WORDS[:5])
    agree(verdicts.remaining >= DEFAULT_SHARE, verdicts.margin >= 1)
    thresholds = verdicts.margin * verdicts.plane_strain_modulus
    # Where any modulus would do, no number is a threshold.
    found = verdicts.plane_strain_modulus_threshold
    is_number = np.isfinite(found)
    assert is_number.mean() > 0.9
    np.testing.assert_allclose(
        found.where(is_number), thresholds.where(is_number), rtol=1e-12, atol=LEAST_MODULUS
    )
    given = found * verdicts.quoted_modulus / verdicts.plane_strain_modulus
    np.testing.assert_allclose(verdicts.modulus_threshold, given, rtol=1e-12)
    agree(value >= DEFAULT_SHARE, thresholds.sel(limit="value") >= verdicts.plane_strain_modulus)
    sticks = np.isin(words, ["sticks", "sticks fully"])
    fails = np.isin(words, ["does not stick", "adheres locally, does not hold"])
    agree(sticks, low >= DEFAULT_SHARE)
    agree(fails, high < DEFAULT_SHARE)
    agree(words == "sticks fully", low >= FULL_SHARE)
    drawn = np.isfinite(verdicts.probability).values
    least = verdicts.probability_low.values[drawn]
    most = verdicts.probability.values[drawn]
    agree(sticks[drawn], least > 0.95)
    agree(fails[drawn], most <= 0.05)
    assert (least <= most).all()
    # Draws scatter about both ends of the surface by less than a factor of ten in strain.
    far = (verdicts.layer_strain > 10 * MOST_STRAIN).all("end").values[drawn]
    assert (most[far] > 0.95).any()
    assert (least[far] == 0).all()
    strained = (verdicts.layer_strain > MOST_STRAIN).any("end").values
    nothing = (low == 0) & (thresholds.sel(limit="low") == 0)
    assert nothing.values[~drawn & strained].all()


@pytest.mark.slow
def test_pairs_are_on_the_same_side_of_all_thresholds_as_their_shares(judged):
    words = set()
    outside = 0
    (_, materials, _), verdicts = judged
    cells = [
        verdicts.sel(material=name, surface=surface)
        for name in verdicts.material.values
        for surface in verdicts.surface.values
    ]
    for pair in cells:
        material = materials[str(pair.material.values)]
        _, *limits = read_limited(pair.remaining)
        low_keeps, high_keeps = (limit >= DEFAULT_SHARE for limit in limits)
        words.add((low_keeps, high_keeps))
        value, least, most = read_limited(pair.rms_height_threshold)
        assert least <= value <= most
        drawn = bool(np.isfinite(pair.probability))
        # Of two rough solids it is that of the pair.
        of_pair = float(np.sqrt(pair.pair_h_rms.prod()) if drawn else pair.pair_h_rms[-1])
        height = float(pair.rms_height) if material.surface is None else of_pair
        assert (least > height, most > height) == (low_keeps, high_keeps)
        _, slowest, fastest = read_limited(pair.rate_threshold)
        has_rate = material.depends_on_rate and material.dwell is None
        assert np.isnan(fastest) == (not has_rate)
        if has_rate:
            assert (slowest > 1, fastest > 1) == (low_keeps, high_keeps)
        _, thinnest, thickest = read_limited(pair.thickness_threshold)
        assert np.isnan(thickest) == (material.solid == HALF_SPACE)
        if material.solid != HALF_SPACE:
            thickness = material.solid.thickness
            # Between its limits a layer on a film may stick where thicker ones do not.
            assert low_keeps >= (thickest < thickness)
            assert high_keeps <= (thinnest < thickness)
            outside += not thinnest < thickness < thickest
    assert len(words) == 3
    assert outside > 3
