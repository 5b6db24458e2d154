"""A material meets all that a surface may be: draws, ends, layers, two rough solids, direction."""

import numpy as np
import pytest
from helpers.analysed import LONGEST, fix_a_v, wall

from stickiness import Material, Surface, judge
from stickiness.criteria.pair import WORDS
from stickiness.remaining import Roughness
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.solids import Film, Layer, Skin
from stickiness.solids.moduli import Prony, Table
from stickiness.verdicts.judgement import describe_draws
from stickiness.verdicts.limits import QUANTILES, limit_between_ends, limit_drawn
from stickiness.verdicts.meeting import TOO_DIFFERENT, deviate, find_family, find_roughness, meet

pytestmark = pytest.mark.usefixtures("coarse_simulation")

TAPE = Material(youngs_modulus=0.1e6, work_of_adhesion=0.07, range=3e-10)
THIN_FILM_MODULUS = 0.1e9  # Young's modulus [Pa]
VISCOUS = Material(
    youngs_modulus_prony=Prony(1e6, ((1e9, 1e-3),)), work_of_adhesion=0.07, range=3e-10
)


def meet_roughness(material, surface):
    """Roughness that a material meets, without errors."""
    return find_roughness(material, surface, find_family(material, surface))


def meet_all(material, surface):
    """All that a material and a surface may be, together."""
    return meet(material, surface, DEFAULT_SHARE)


def find_margins(pair):
    return pair.adhesion_length / pair.remaining_threshold


def place_above_threshold(factor, surface):
    """A material whose work of adhesion is this factor above its threshold on a known surface."""
    pair = meet_all(VISCOUS, surface).ends
    return VISCOUS.replace(
        work_of_adhesion=factor * VISCOUS.work_of_adhesion / float(find_margins(pair)[0])
    )


@pytest.mark.slow
def test_errors_of_the_spectrum_pass_to_the_margin():
    """Of a tough pair the threshold is in proportion to the elastic energy."""
    judged = describe_draws(meet_all(VISCOUS, wall(draws=4000, scatter=0.1)))
    assert judged["error_of_spectrum"] == pytest.approx(0.2, rel=0.05)


@pytest.mark.slow
@pytest.mark.parametrize(("factor", "expected"), [(1.0, 0.5), (1.3, None), (2.0, 1.0), (0.5, 0.0)])
def test_draws_spread_over_the_error_of_the_model(factor, expected):
    """One spectrum: what is left are the model's errors, of which the limits cover 90 %.

    Half of the draws stick at the threshold, all or none of them well beyond the model's error.
    """
    surface = wall(draws=4000)
    meeting = meet_all(place_above_threshold(factor, surface), surface)
    pair = meeting.pair
    judged = describe_draws(meeting)
    assert judged["error_of_spectrum"] == pytest.approx(0, abs=1e-12)
    # What sticks is what keeps the wanted share.
    assert np.mean(pair.remaining > DEFAULT_SHARE) == pytest.approx(judged["probability"])
    if expected is not None:  # the binomial error of 4000 draws is below 0.008
        assert judged["probability"] == pytest.approx(expected, abs=0.025)
        return
    at_limits = [meeting.ends.take(0).deviating(eta) for eta in (-1, 0, 1)]
    # Standard errors of quantiles of 4000 draws are below 0.5 % of these.
    margins = meeting.limit(find_margins(pair), pair)
    np.testing.assert_allclose(margins, [find_margins(each) for each in at_limits], rtol=0.01)
    shares = meeting.limit(pair.remaining, pair)
    np.testing.assert_allclose(shares, [each.remaining for each in at_limits], rtol=0.03)


def test_limits_are_values_of_rows():
    """So that a limit of the share and that of the margin are on the same side of the threshold."""
    values = np.random.default_rng(0).normal(size=(5, 199))
    limits = limit_drawn(values)
    assert np.isin(limits, values).all()
    below = np.mean(values[:, None] <= limits[..., None], axis=-1)
    np.testing.assert_allclose(below, np.tile(QUANTILES, (5, 1)), atol=1 / 199)


@pytest.mark.parametrize("smooth", [[0.5, 0.3, 0.7], [0.9, 0.8, 1.0], [0.2, 0.1, 0.25]])
def test_between_ends_limits_are_the_farthest_and_the_value_that_of_the_rough_end(smooth):
    """Wherever the smooth end lies beside the rough one."""
    rough = [0.6, 0.4, 0.8]
    ends = Roughness(h_rms=np.array([1.0, 2.0]), q0=1.0, elastic_energy=1.0)
    rows = deviate(ends, is_drawn=False)
    assert rows.h_rms.tolist() == [1, 2] * 3
    assert rows.eta.tolist() == [0, 0, -1, -1, 1, 1]
    low, value, high = limit_between_ends(np.ravel([smooth, rough], order="F"))
    assert (low, value, high) == (min(smooth[1], rough[1]), rough[0], max(smooth[2], rough[2]))


def test_nothing_may_remain_on_a_layer_that_cannot_take_the_heights():
    values = np.linspace(1.0, 2.0, 20)
    withstands = values <= 1.95
    assert tuple(limit_drawn(values, withstands)) == (0.0, *limit_drawn(values)[1:])
    # Infinite moduli make no low limit that is not a number.
    assert limit_drawn(np.full(20, np.inf), withstands)[0] == 0


def test_draws_meet_draws_in_another_order_unless_they_are_the_same():
    def find_variances(surface, second=None):
        """Of the heights [um^2]."""
        return 1e12 * find_family(TAPE.replace(surface=second), surface).variance()

    first = wall(draws=12, scatter=0.3)
    alone = find_variances(first)
    assert find_variances(first, first) == pytest.approx(2 * alone)
    few = wall(draws=7, scatter=0.3)
    met = find_variances(first, few) - alone
    in_order = np.resize(find_variances(few), 12)
    assert np.sort(met) == pytest.approx(np.sort(in_order))
    assert not np.allclose(met, in_order)
    # One that is known between two ends lies anywhere between, whichever of both is measured.
    vague = wall(h_rms=2e-6)
    logs = np.log(find_variances(first, vague) - alone)
    assert np.sort(logs) == pytest.approx(np.log(np.geomspace(4, 16, 12)))
    assert np.ptp(np.diff(logs)) > 0.1
    assert find_variances(vague, first) == pytest.approx(alone + np.exp(logs))
    # Of two such, ends meet ends.
    both = meet_all(TAPE.replace(surface=vague), wall())
    assert not both.is_drawn
    assert both.pair.h_rms == pytest.approx(np.tile(np.sqrt([5.0, 20.0]), 3) * 1e-6)


def put_on_layer(thickness, backing="bonded"):
    """The tape as a layer."""
    return TAPE.replace(solid=Layer(thickness, 0.5, backing))


def layer_factor(k, backing):
    """S of an incompressible layer, as physics books have it."""
    if backing == "slip":
        return (np.cosh(2 * k) - 1) / (np.sinh(2 * k) + 2 * k)
    return (np.sinh(2 * k) - 2 * k) / (np.cosh(2 * k) + 2 * k**2 + 1)


@pytest.mark.parametrize("backing", ["bonded", "slip"])
def test_a_layer_takes_the_energy_of_its_response(backing):
    surface = wall()
    meeting = meet_all(put_on_layer(40e-6, backing), surface)
    data = surface.data
    q = np.geomspace(float(data.q0), float(data.q1), 20001)
    psd = np.exp(np.interp(np.log(q), np.log(data.wave_number), np.log(data.psd[0])))
    factor = layer_factor(np.minimum(q * 40e-6, 300), backing)
    ratio = np.trapezoid(q**3 * psd / factor, np.log(q)) / np.trapezoid(q**3 * psd, np.log(q))
    assert meeting.stiffening == pytest.approx([ratio, ratio], rel=1e-5)
    energy = ratio * data.elastic_energy.values
    assert meeting.ends.elastic_energy == pytest.approx(energy, rel=1e-5)
    compliance = layer_factor(float(data.q0) * 40e-6, backing)
    assert meeting.ends.rough.relative_compliance == pytest.approx(np.full(2, compliance))


def make_thin_tape(modulus):
    """The tape on a thin film, whose own Young's modulus stays as it is."""
    film = Film(THIN_FILM_MODULUS / modulus, 0.4, 4e-6)
    return TAPE.replace(youngs_modulus=modulus, solid=Layer(40e-6, 0.5, film))


def judge_at_moduli(moduli, draws):
    """Verdicts on the thin tape with these E* [Pa]."""
    tapes = [make_thin_tape(0.75 * float(modulus)) for modulus in moduli]
    surface = wall(h_rms=1.3e-6, draws=draws)
    return judge(tapes, {"wall": surface}, thresholds=False).sel(surface="wall")


@pytest.mark.slow
@pytest.mark.parametrize("draws", [0, 60])
def test_thresholds_and_curves_of_a_tape_keep_its_film(draws):
    tape = judge_at_moduli([0.1e6], draws).isel(material=0)
    at_thresholds = judge_at_moduli(tape.plane_strain_modulus_threshold.values, draws)
    np.testing.assert_allclose(np.diag(at_thresholds.remaining), DEFAULT_SHARE, rtol=1e-6)
    for place in (40, 55, 65):
        factor = float(tape.modulus_factor[place])
        other = judge_at_moduli([0.1e6 * factor], draws).isel(material=0)
        curve = tape.isel(modulus_factor=place)
        # The flow along the layer, which limits know, stays that of the pair.
        np.testing.assert_allclose(curve.remaining_by_modulus, other.remaining, rtol=2e-5)


@pytest.mark.slow
def test_a_rate_dependent_tape_has_its_film_at_every_rate_and_dwell():
    table = Table((1e-3, 1.0, 1e3), (10e3, 0.1e6, 3e6))
    slow = make_thin_tape(0.1e6).replace(youngs_modulus_table=table)
    rested = slow.replace(dwell=10.0)
    # The ratio of moduli is that to Young's modulus of the verdict.
    rested = rested.replace(solid=make_thin_tape(0.75 * rested.plane_strain_modulus).solid)
    surfaces = {"wall": wall(h_rms=1.3e-6)}
    frequencies = np.geomspace(1e-2, 1e2, 5)
    dataset = judge([slow, rested], surfaces, frequencies=frequencies, thresholds=False)
    by_rate, after_dwell = (dataset.isel(material=place, surface=0) for place in (0, 1))
    expected = judge_at_moduli(by_rate.modulus.values, draws=0).remaining
    np.testing.assert_allclose(by_rate.remaining_by_rate, expected, rtol=2e-5)
    (expected,) = judge_at_moduli([rested.plane_strain_modulus], draws=0).remaining.values
    ratio = [1, 1, rested.instant_ratio]
    np.testing.assert_allclose(after_dwell.remaining / ratio, expected, rtol=2e-5)


@pytest.mark.parametrize("factor", [1e-3, 0.5, 20.0])
@pytest.mark.parametrize(
    "make_solid",
    [
        lambda factor: Layer(40e-6, 0.5, Film(1e3 / factor, 0.4, 25e-6)),
        lambda factor: Skin(1e-6, 100.0 / factor, 0.35, 0.5),
    ],
    ids=["film", "skin"],
)
def test_the_response_is_that_of_solids_with_other_moduli(make_solid, factor):
    family = wall().family
    q0 = np.full(2, 2 * np.pi / LONGEST)
    changed, other = (
        Roughness.of(family, solid, q0=q0) for solid in (make_solid(1.0), make_solid(factor))
    )
    changed = changed.at_modulus(factor)
    for name in ("elastic_energy", "relative_compliance"):
        np.testing.assert_allclose(getattr(changed, name), getattr(other, name), rtol=1e-12)


def test_roughness_of_both_solids_adds():
    surface = wall(draws=4)
    both, one = (meet_all(each, surface) for each in (TAPE.replace(surface=surface), TAPE))
    assert both.ends.rms_curvature == pytest.approx(np.sqrt(2) * one.ends.rms_curvature)
    for of_both, of_one in ((both.ends, one.ends), (both.pair, one.pair)):
        for name in ("h_rms", "rms_slope"):
            assert getattr(of_both, name) == pytest.approx(np.sqrt(2) * getattr(of_one, name))
        assert of_both.elastic_energy == pytest.approx(2 * of_one.elastic_energy)
        assert of_both.q0 == pytest.approx(of_one.q0)
    assert both.ends.rough.anisotropy_error_factor == 1


def test_what_is_unresolved_is_told_by_the_coarser_of_two_measurements():
    fine, coarse = wall(draws=4), wall(draws=4, shortest=6e-7)
    both = meet_roughness(TAPE.replace(surface=coarse), fine)
    assert (both.unresolved > 0.01).all()


@pytest.mark.slow
def test_solids_of_very_different_scale_are_not_judged():
    steep = fix_a_v(Surface(wall(h_rms=1e-3).data.assign(q0=6e8)))
    dataset = judge([TAPE.replace(surface=steep)], [steep])
    assert dataset.not_judged.item() == TOO_DIFFERENT
    assert WORDS[dataset.verdict.item()] == "not judged"
    assert np.isnan(dataset.remaining).all()


@pytest.mark.parametrize(("axis_ratio", "factor"), [(1.0, 1), (4.0, 2)])
def test_a_direction_widens_limits(axis_ratio, factor):
    rough = meet_roughness(TAPE, wall(axis_ratio=axis_ratio))
    assert rough.anisotropy_error_factor == factor


def test_skewed_heights_of_two_solids_add_as_third_cumulants():
    shape = {"shape": 0.8, "shape_error": 0.4}
    plateau = wall(**shape)
    gaussian = wall()
    alone = meet_roughness(TAPE, plateau)
    first = meet_roughness(TAPE.replace(surface=gaussian), plateau)
    second = meet_roughness(TAPE.replace(surface=plateau), gaussian)
    twice = meet_roughness(TAPE.replace(surface=plateau), plateau)
    assert alone.shape == pytest.approx(0.8)
    # The skewness of one of two equal heights counts 1/sqrt(8).
    assert first.shape == pytest.approx(np.full(2, 0.8 / np.sqrt(8)))
    assert first.shape_error == pytest.approx(np.full(2, 0.4 / np.sqrt(8)))
    assert second.shape == pytest.approx(first.shape)
    assert second.shape_error == pytest.approx(first.shape_error)
    assert twice.shape == pytest.approx(2 * first.shape)
    assert twice.shape_error == pytest.approx(np.sqrt(2) * first.shape_error)
