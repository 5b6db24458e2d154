"""Files of the simulations behind the limits of verdicts, and the tables made of them."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from helpers.entries import complete
from helpers.jobs import make_job

from common import heights_table, limits_table, remaining_table
from common.config.campaigns import (
    BallSet,
    CoatedSet,
    CoatedSolid,
    LargerSet,
    RangeSet,
    SolidSet,
    TopographySet,
)
from common.model_surfaces import cell_size, make_heights
from common.topographies import make_set
from limits import (
    calibrate_limits,
    comparisons,
    measure_balls,
    measure_coated,
    measure_larger,
    measure_patches,
    measure_pull_offs,
    measure_ranges,
    measure_solids,
    measure_unresolved,
    tabulate_limits,
)
from stickiness import surface
from stickiness.remaining import sphere
from stickiness.remaining.calibration import find_spread
from stickiness.remaining.height_simulation import find_trial_states
from stickiness.remaining.prediction import predict
from stickiness.remaining.roughness import Roughness

SURFACE = {"role": "fitted", "hurst": 0.8, "magnification": 4.0, "window": 2.0, "points": 64}
LAYER = complete(
    SolidSet, **SURFACE, kind="layer", seeds=[5], thickness=0.5, poisson=0.4, backing="bonded"
)
SKIN = complete(
    SolidSet,
    **SURFACE | {"role": "unseen"},
    kind="skin",
    seeds=[6],
    thickness=0.1,
    poisson=0.5,
    skin_modulus_ratio=100.0,
    skin_poisson=0.35,
)
TOPOGRAPHY = {"role": "fitted", "family": "gaussian", "points": 128, "waves": 4, "seeds": [5]}
ROUGH = complete(TopographySet, **TOPOGRAPHY, shortest=4.0)
FINE = complete(TopographySet, **TOPOGRAPHY, shortest=2.0)
COARSE = complete(
    RangeSet,
    **TOPOGRAPHY | {"points": 32, "waves": 2},
    shortest=5.0,
    refinements=[{"ratio": 1.0, "finer": 2}, {"ratio": 0.25, "finer": 8}],
)
SCANNED = complete(LargerSet, **TOPOGRAPHY | {"waves": 2}, shortest=4.0, parts=[1, 2])
UNSEEN = complete(CoatedSet, **TOPOGRAPHY | {"points": 64}, shortest=3.0, stride=2)
COATING = {"thickness": 0.1, "poisson": 0.5, "energies": [0.5, 2.0], "pixels_in_zone": 1.0}
COATINGS = {
    "skin": complete(CoatedSolid, **COATING, skin_modulus_ratio=30.0, skin_poisson=0.35),
    "layer": complete(CoatedSolid, **COATING | {"thickness": 0.5}, backing="bonded"),
}

BALL = {"role": "fitted", "law": "exponential", "hurst": 0.8, "waves": [0.5], "heights": [0.1, 2.0]}
BALL |= {"shortest": 0.5, "side": 6.0, "points": 64, "places": 2, "seeds": [5]}
STIFFNESSES = (0.0, 0.05, 2.0)


def tabulate(folder, kind, script, settings, **campaign):
    """Table of one file for each setting."""
    paths = []
    for number, setting in enumerate(settings):
        seed = str(setting["seeds"][0])
        wildcards = {"limits_kind": kind, "limits_set": f"set_{number}", "seed": seed}
        paths.append(folder / kind / f"set_{number}" / f"seed{seed}.nc")
        params = {"setting": setting, "campaign": campaign}
        script.main(make_job(paths[-1], params, wildcards))
    output = folder / f"{kind}.csv"
    wildcards = SimpleNamespace(limits_kind=kind)
    tabulate_limits.main(SimpleNamespace(input=paths, output=[output], wildcards=wildcards))
    return limits_table.read(output, kind)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("limits")


@pytest.fixture(scope="module")
def solids(folder):
    campaign = {
        "law": "exponential",
        "energies": [0.3, 1.3],
        "pixels_in_zone": {"layer": [8], "skin": [8]},
    }
    return tabulate(folder, "solids", measure_solids, [LAYER, SKIN], **campaign)


@pytest.fixture(scope="module")
def patches(folder):
    sizes = [{"waves": 4, "count": 1}, {"waves": 2, "count": 2}]
    campaign = {"range": 0.15, "patches": sizes}
    return tabulate(folder, "patches", measure_patches, [ROUGH], **campaign)


@pytest.fixture(scope="module")
def ranges(folder):
    campaign = {"law": "exponential", "works": 3, "shares": [0.03, 0.8]}
    return tabulate(folder, "ranges", measure_ranges, [COARSE], **campaign)


@pytest.fixture(scope="module")
def pull_offs(folder):
    refinements = [{"ratio": 1.0, "finer": 2}, {"ratio": 0.5, "finer": 4}]
    campaign = {
        "law": "exponential",
        "works": 2,
        "shares": [0.1, 0.4],
        "squeeze": 0.1,
        "steps": 20,
    }
    settings = [COARSE | {"refinements": refinements}]
    return tabulate(folder, "pull_offs", measure_pull_offs, settings, **campaign)


@pytest.fixture(scope="module")
def larger(folder):
    return tabulate(folder, "larger", measure_larger, [SCANNED], range=0.15, count=1)


@pytest.fixture(scope="module")
def unresolved(folder):
    campaign = {"ranges": [0.3], "strides": [2]}
    return tabulate(folder, "unresolved", measure_unresolved, [ROUGH, FINE], **campaign)


@pytest.fixture(scope="module")
def coated(folder):
    campaign = {"law": "exponential", "solids": COATINGS}
    return tabulate(folder, "coated", measure_coated, [UNSEEN], **campaign)


@pytest.fixture(scope="module")
def balls(folder):
    settings = [complete(BallSet, **BALL, tabor=tabor) for tabor in STIFFNESSES]
    return tabulate(folder, "balls", measure_balls, settings)


def test_rows_of_solids_tell_set_and_role(solids):
    assert solids["set"].tolist() == ["set_0"] * 2 + ["set_1"] * 2
    assert solids.role.tolist() == ["fitted"] * 2 + ["unseen"] * 2
    assert solids.kind.tolist() == ["layer"] * 2 + ["skin"] * 2
    assert solids.seed.tolist() == [5, 5, 6, 6]
    assert solids.energy_ratio.tolist() == [0.3, 1.3] * 2


def test_shares_on_solids_lie_between_full_contact_and_all(solids):
    assert (solids.simulated > 1 - 1 / solids.energy_ratio).all()
    assert solids.simulated.between(0, 1).all()
    assert (solids.full_contact_energy > solids.half_space_energy).all()
    assert (solids.adhesion_length / solids.full_contact_energy).values == pytest.approx(
        solids.energy_ratio.values, rel=1e-4
    )
    # The zone has so many pixels on a half-space.
    pixel = solids.window * 2 * np.pi / solids.points
    zone = solids.range**2 / (solids.energy_ratio * solids.half_space_energy)
    assert (zone / pixel).values == pytest.approx(8, rel=1e-4)


@pytest.mark.parametrize("setting", [LAYER, SKIN], ids=["layer", "skin"])
def test_theory_needs_no_heights(solids, setting):
    """What the table holds of a surface is what theory takes of its heights."""
    row = solids[solids.kind == setting["kind"]].iloc[0]
    solid = measure_solids.make_solid(setting)
    heights = make_heights(setting, setting["points"], setting["seeds"][0])
    spectrum = surface.realised_spectrum(heights, cell_size(setting))
    prediction = predict(spectrum, row.adhesion_length, row.range, q0=1.0, solid=solid)
    rebuilt = Roughness(
        h_rms=1.0,
        q0=1.0,
        elastic_energy=row.full_contact_energy,
        half_space_energy=row.half_space_energy,
        q1=row.q1,
        rms_slope=row.rms_slope,
        relative_compliance=row.relative_compliance,
        flow=row.flow,
        solid=row.kind,
    )
    assert rebuilt.share(row.adhesion_length, row.range) == pytest.approx(
        prediction.separation, rel=1e-3, abs=1e-6
    )
    high = rebuilt.deviating(1)
    assert high.share(row.adhesion_length, row.range) == pytest.approx(
        prediction.approach_limits[1], rel=1e-3
    )


def test_a_patch_of_the_whole_surface_tells_the_same(patches):
    (whole,) = patches[patches.patch_waves == 4].itertuples()
    for share in limits_table.SHARES:
        of_patch = getattr(whole, f"threshold_{share}")
        assert of_patch == pytest.approx(getattr(whole, f"whole_threshold_{share}"), abs=0.02)
        assert getattr(whole, f"share_{share}") == pytest.approx(int(share) / 100, abs=5e-3)
    assert whole.full_contact_energy == pytest.approx(whole.whole_full_contact_energy, rel=0.03)


def test_thresholds_rise_with_the_share(patches):
    for columns in (
        [f"threshold_{share}" for share in limits_table.SHARES],
        *([f"q{number}_10", f"q{number}_30"] for number in (1, 2, 3, 4)),
    ):
        assert (np.diff(patches[columns].values, axis=1) > 0).all()


@pytest.mark.parametrize(("count", "bumps"), [(5, 3), (9, 5)])
def test_patches_stand_side_by_side(count, bumps):
    """Bumps in the first row and the first column of a chessboard of three by three."""
    heights = np.zeros((96, 96))
    heights[12:20, 12::32] = 1
    heights[12::32, 12:20] = 1
    tiles = list(measure_patches.cut(heights, waves=6, patch_waves=2, count=count))
    assert [tile.shape for tile in tiles] == [(32, 32)] * count
    assert sum(np.ptp(tile) > 0.5 for tile in tiles) == bumps
    for tile in tiles:
        assert tile.mean() == pytest.approx(0, abs=1e-12)


def test_autocorrelation_of_waves():
    """One wave along a side: cos at every shift, whose square is a half and cube vanishes."""
    wave = np.cos(2 * np.pi * np.arange(32) / 32)[:, None] + np.zeros(32)
    autocorrelation = measure_patches.find_autocorrelation(3 * wave + 1)
    np.testing.assert_allclose(autocorrelation, wave, atol=1e-12)


def test_shorter_ranges_lie_between_bound_and_chord(ranges):
    assert ranges.groupby("adhesion_length").size().tolist() == [2, 2, 2]
    assert set(ranges.is_between) == {0, 1}
    shorter = ranges[ranges.range_ratio < 1]
    # Between the points of a coarse grid contact is not seen to end.
    assert (shorter.bound < shorter.simulated + 5e-3).all()
    assert (shorter.simulated < shorter.chord).all()
    same = ranges[(ranges.range_ratio == 1) & (ranges.is_between == 0)]
    assert same.simulated.values == pytest.approx(same.chord.values, rel=0.08)


def test_states_and_paths_pull_off_alike(pull_offs):
    """A tension that grows and mean gaps that grow end at the same tension on one grid."""
    assert pull_offs.groupby("adhesion_length").size().tolist() == [2, 2]
    same = pull_offs[pull_offs.range_ratio == 1]
    predicted = same.adhesion_length * same.share / same.distance
    assert predicted.values == pytest.approx(same.pull_off.values, rel=0.15)
    assert pull_offs.share.values == pytest.approx(pull_offs.path_share.values, abs=0.02)


def test_what_is_calibrated_is_what_a_verdict_says(pull_offs):
    """Pull-off by the states of the coarse grid, but for the middle of simulated ones."""
    states = find_trial_states(make_set(COARSE, COARSE["seeds"][0]), 4 * np.pi)
    rough = measure_pull_offs.judge_states(states, pixel=np.pi / 8)
    spread = find_spread("states", "ln_tension")
    shortening = find_spread("states", "shortening")
    calibrated = comparisons.of_pull_offs(pull_offs, shortening.value)
    said = rough.tension(*calibrated.rows[["adhesion_length", "range"]].values.T)
    expected = np.exp(calibrated.simulated + spread.value - calibrated.error)
    # At a work that was simulated, rounding decides which of two ranges bounds the share.
    np.testing.assert_allclose(said, expected, rtol=0.02)


def test_exponents_and_errors_of_pull_offs_are_found():
    """Distances that fall with the root of the range, but for 10 % at every second work."""
    rows = pd.DataFrame({"range_ratio": np.tile([1.0, 0.5, 0.25], 40), "distance": 2.0})
    rows = rows.assign(role="fitted", share=0.2, path_share=0.2, adhesion_length=0.1)
    rows = rows.assign(energy_ratio=0.5)
    factor = np.repeat([1.1, 1 / 1.1], 60)
    rows["pull_off"] = 0.1 * 0.2 / (2.0 * np.sqrt(rows.range_ratio)) * factor
    shortening, fitted = calibrate_limits.fit_pull_offs(rows)
    assert shortening[0] == pytest.approx(0.5, abs=0.01)
    assert abs(fitted.error) == pytest.approx(np.log(1.1), abs=0.02)
    full = rows.assign(energy_ratio=2.0)
    _, fitted = calibrate_limits.fit_pull_offs(pd.concat([rows, full]))
    assert len(fitted.rows) == len(rows)  # full contact is left out


def test_works_are_those_of_the_states_and_between():
    heights = make_set(COARSE, 5)
    states = find_trial_states(heights, 4 * np.pi, pull=False)
    works = measure_ranges.choose_works(states, shares=[0.0, 1.0], most=1000)
    nodes = [work for work, is_between in works if not is_between]
    between = [work for work, is_between in works if is_between]
    assert nodes == pytest.approx(states.simulated_length)
    assert between == pytest.approx(np.sqrt(nodes[1:] * np.array(nodes[:-1])))


def test_thinned_grids_lack_what_they_do_not_show(unresolved):
    resolved = unresolved[unresolved.shortest == 4]
    lost = unresolved[unresolved.shortest == 2]
    assert abs(resolved.lacking).max() < 1e-3
    assert lost.lacking.min() > 0.01
    # Above full contact both agree, whatever the grid.
    assert unresolved.thinned_60.values == pytest.approx(unresolved.full_60.values, abs=0.02)


def test_a_scan_of_half_the_side_tells_less_of_a_contact(larger):
    same, half = larger.itertuples()
    assert same.is_judged == half.is_judged == 1
    # A patch of the whole surface is simulated, and no longer waves are expected.
    assert (same.is_simulated, same.longer) == (1, 0)
    assert half.longer > 0
    for row in (same, half):
        assert row.low_10 < row.whole_threshold_10 < row.high_10
        assert row.value_10 < row.value_30
    assert half.high_10 - half.low_10 > 2 * (same.high_10 - same.low_10)


def test_maps_lack_energy_below_a_skin_rather_than_on_a_layer(coated):
    assert coated.solid.tolist() == ["skin"] * 2 + ["layer"] * 2
    assert coated.energy_ratio.tolist() == [0.5, 2.0] * 2
    assert (coated.simulated > 1 - 1 / coated.energy_ratio).all()
    lacking = coated.full_contact_energy / coated.map_full_contact_energy
    on_half_space = coated.half_space_energy / coated.map_half_space_energy
    assert (lacking > on_half_space).tolist() == [True, True, False, False]


def test_a_scan_shows_long_waves_alone():
    """Two waves are within four pixels of the map of 16 points, and eight are not."""
    x = 2 * np.pi * np.arange(32) / 32
    shown = 3 * np.cos(2 * x)[:, None] + np.sin(x)
    heights = shown + 0.5 * np.cos(8 * x)[:, None] + 1
    map_heights, side = measure_coated.scan(heights, {"stride": 2, "waves": 1})
    np.testing.assert_allclose(map_heights, shown[::2, ::2], atol=1e-12)
    assert side == pytest.approx(2 * np.pi)


def test_stiff_balls_pull_off_as_rigid_ones(balls):
    """Boundary elements at a small Tabor parameter, and sums at the height of first touch."""
    rigid, stiff, soft = (rows for _, rows in balls.groupby("tabor"))
    np.testing.assert_allclose(stiff.simulated, rigid.simulated, rtol=0.1)
    is_rough = rigid.height.values == 2.0
    assert (soft.simulated.values > rigid.simulated.values)[is_rough].all()
    assert rigid.height.tolist() == [0.1, 0.1, 2.0, 2.0]


@pytest.mark.parametrize("tabor", STIFFNESSES)
def test_a_smooth_ball_is_that_of_maugis(tabor):
    ball = measure_balls.make_ball("exponential", tabor)
    shape = measure_balls.curve(np.zeros((128, 128)), 6 / 128)
    pull = measure_balls.touching_force if tabor == 0 else measure_balls.pull_off_force
    smooth = Roughness(h_rms=1e-9, q0=1.0, elastic_energy=1e-18)
    maugis = sphere.pull_off(smooth, ball.radius, ball.law.adhesion_length, ball.law.range)
    # Maugis' law of constant traction and this one differ by a few per cent between JKR and DMT.
    assert pull(shape, 6.0, ball.law) == pytest.approx(maugis.force, rel=0.1)


@pytest.mark.parametrize(
    ("read", "lacking"),
    [
        (lambda path: limits_table.read(path, "solids"), "kind"),
        (heights_table.read, "magnification"),
        (remaining_table.read, "magnification"),
    ],
)
def test_a_table_without_a_column_is_refused(tmp_path, read, lacking):
    path = tmp_path / "some.csv"
    path.write_text("set,role,hurst\nx,fitted,0.8\n")
    with pytest.raises(ValueError, match=f"some.csv: lacks the columns {lacking}"):
        read(path)
    with pytest.raises(ValueError, match="no such file"):
        read(tmp_path / "none.csv")


def test_tables_are_described(folder, solids):
    lines = (folder / "solids.csv").read_text().splitlines()
    comment = [line for line in lines if line.startswith("#")]
    assert any("limits_measured" in line for line in comment)
    assert max(map(len, comment)) <= 100
    assert len(pd.read_csv(folder / "solids.csv", comment="#")) == len(solids)
