"""What campaigns are made of, on small surfaces and by hand."""

import numpy as np
import pytest
from helpers.campaigns import CAMPAIGNS, read
from helpers.entries import complete

from campaigns import balls, coated, patches, ranges, solids
from common.config.campaigns import RangeSet, SolidSet
from common.model_surfaces import cell_size, make_heights
from common.topographies import make_set
from stickiness import surface
from stickiness.remaining import sphere
from stickiness.remaining.errors import STATES_TENSION
from stickiness.remaining.height_simulation import find_pull_offs, find_trial_states
from stickiness.remaining.prediction import predict
from stickiness.remaining.roughness import Roughness
from stickiness.remaining.trial_states import SimulatedHeights

SURFACE = {"role": "fitted", "hurst": 0.8, "magnification": 4.0, "window": 2.0, "points": 64}
LAYER = SURFACE | {"kind": "layer", "thickness": 0.5, "poisson": 0.4, "backing": "bonded"}
SKIN = SURFACE | {"kind": "skin", "thickness": 0.1, "poisson": 0.5, "skin_modulus_ratio": 100.0}
SKIN |= {"skin_poisson": 0.35}
COARSE = complete(
    RangeSet,
    role="fitted",
    family="gaussian",
    points=32,
    waves=2,
    shortest=5.0,
    seeds=[5],
    refinements=[{"ratio": 1.0, "finer": 2}, {"ratio": 0.5, "finer": 4}],
)


@pytest.mark.parametrize("setting", [LAYER, SKIN], ids=["layer", "skin"])
def test_theory_needs_no_heights(setting):
    """What the table holds of a surface is what theory takes of its heights."""
    setting = complete(SolidSet, **setting, seeds=[5])
    shared = {"law": "exponential", "energies": [0.8], "pixels_in_zone": {setting["kind"]: [8]}}
    (row,) = solids.measure(setting, 5, shared)
    heights = make_heights(setting, setting["points"], 5)
    spectrum = surface.realised_spectrum(heights, cell_size(setting))
    prediction = predict(
        spectrum, row["adhesion_length"], row["range"], q0=1.0, solid=solids.make_solid(setting)
    )
    kept = ("half_space_energy", "q1", "rms_slope", "relative_compliance", "flow")
    rebuilt = Roughness(
        h_rms=1.0,
        q0=1.0,
        elastic_energy=row["full_contact_energy"],
        solid=setting["kind"],
        **{name: row[name] for name in kept},
    )
    asked = row["adhesion_length"], row["range"]
    assert rebuilt.share(*asked) == pytest.approx(prediction.separation, rel=1e-3)
    high = rebuilt.deviating(1).share(*asked)
    assert high == pytest.approx(prediction.approach_limits[1], rel=1e-3)


@pytest.mark.parametrize(("count", "bumps"), [(5, 3), (9, 5)])
def test_patches_stand_side_by_side(count, bumps):
    """Bumps in the first row and the first column of a chessboard of three by three."""
    heights = np.zeros((96, 96))
    heights[12:20, 12::32] = 1
    heights[12::32, 12:20] = 1
    tiles = list(patches.cut(heights, waves=6, patch_waves=2, count=count))
    assert [tile.shape for tile in tiles] == [(32, 32)] * count
    assert sum(np.ptp(tile) > 0.5 for tile in tiles) == bumps
    for tile in tiles:
        assert tile.mean() == pytest.approx(0, abs=1e-12)


def test_works_are_those_of_the_states_and_between():
    states = find_trial_states(make_set(COARSE, 5), 4 * np.pi)
    works = ranges.choose_works(states, shares=[0.0, 1.0], most=1000)
    nodes = [work for work, is_between in works if not is_between]
    between = [work for work, is_between in works if is_between]
    assert nodes == pytest.approx(states.simulated_length)
    assert between == pytest.approx(np.sqrt(nodes[1:] * np.array(nodes[:-1])))


def test_pull_offs_of_states_are_what_a_verdict_says():
    """Pull-off by the states of the coarse grid, but for the middle of simulated ones."""
    known = read("pull_offs")
    known = known[(known["set"] == "gaussian_1") & (known.energy_ratio < 1.4)]
    setting = CAMPAIGNS["pull_offs"]["sets"]["gaussian_1"]
    heights = make_set(setting, setting["seeds"][0])
    length = setting["waves"] * 2 * np.pi
    states = find_trial_states(heights, length)
    simulated = SimulatedHeights(
        whole=states,
        quarters=(states,),
        pull_offs=find_pull_offs(heights, length),
        resolved_energy=states.full_contact_energy,
        pixel=length / setting["points"],
        independent_areas=1.0,
    )
    rough = Roughness(
        h_rms=1.0, q0=1.0, elastic_energy=states.full_contact_energy, simulated=simulated
    )
    said = rough.tension(*known[["adhesion_length", "range"]].values.T)
    middle = STATES_TENSION.spread.value * STATES_TENSION.unit(known.lost_ratio)
    np.testing.assert_allclose(said, known.predicted * np.exp(middle), rtol=1e-3)


def test_a_scan_shows_long_waves_alone():
    """Two waves are within four pixels of the map of 16 points, and eight are not."""
    x = 2 * np.pi * np.arange(32) / 32
    shown = 3 * np.cos(2 * x)[:, None] + np.sin(x)
    heights = shown + 0.5 * np.cos(8 * x)[:, None] + 1
    map_heights = coated.scan(heights, {"stride": 2, "waves": 1})
    np.testing.assert_allclose(map_heights, shown[::2, ::2], atol=1e-12)


@pytest.mark.parametrize("tabor", [0.0, 0.05, 2.0])
def test_a_smooth_ball_is_that_of_maugis(tabor):
    ball = balls.make_ball("exponential", tabor)
    shape = balls.curve(np.zeros((128, 128)), 6 / 128)
    pull = balls.touching_force if tabor == 0 else balls.pull_off_force
    smooth = Roughness(h_rms=1e-9, q0=1.0, elastic_energy=1e-18)
    maugis = sphere.pull_off(smooth, ball.radius, ball.law.adhesion_length, ball.law.range)
    if tabor == 2.0:  # the zone is JKR's contact at pull-off
        assert np.cbrt(9 * np.pi / 8 * ball.law.adhesion_length * ball.radius**2) == pytest.approx(
            1
        )
    # Maugis' law of constant traction and this one differ by a few per cent between JKR and DMT.
    assert pull(shape, 6.0, ball.law) == pytest.approx(maugis.force, rel=0.1)
