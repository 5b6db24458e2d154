"""Predictions for experiments: against thresholds solved apart, closed forms, relations."""

import numpy as np
import pytest
from helpers.experiments import known, observe, seen
from scipy.optimize import brentq

from experiments import predictions
from stickiness.remaining import Roughness, predict, sphere
from stickiness.spectrum import SelfAffine

LIMIT = seen("limiting_roughness", ["1 um", "2 um"])
LENGTH, RANGE = 0.05 / 1e6, 0.3e-9


def spectrum(h_rms=1.0, **more):
    given = {"hurst": 0.8, "q0": 2 * np.pi / 1e-4, "q1": 2 * np.pi / 1e-6} | more
    return SelfAffine(h_rms=h_rms, **given)


def predicted(observed=LIMIT, **conditions):
    return predictions.predict_observation(observe(observed, **conditions))


@pytest.mark.parametrize("level", [0.03, 0.1, 0.3])
@pytest.mark.parametrize(("sign", "row"), [(-1, 0), (0, 1), (1, 2)])
def test_between_flats_the_limiting_roughness_is_that_of_the_threshold(sign, row, level):
    unit = spectrum()

    def excess(log_h):
        h = np.exp(log_h)
        rough = Roughness(h, unit.q0, unit.elastic_energy() * h**2)
        return np.log(rough.threshold(RANGE, level, sign) / LENGTH)

    expected = np.exp(brentq(excess, np.log(1e-8), np.log(1e-4)))
    assert predicted(LIMIT | {"level": level}).limit[row, 0] == pytest.approx(expected, rel=0.03)


@pytest.mark.parametrize("level", [0.03, 0.1, 0.5])
def test_of_a_sphere_the_limiting_roughness_is_where_the_level_of_the_force_is_left(level):
    unit = spectrum()
    h = predicted(LIMIT | {"level": level}, radius=known("5 mm")).limit[1, 0]
    rough = Roughness(h, unit.q0, unit.elastic_energy() * h**2)
    found = sphere.pull_off(rough, 5e-3, LENGTH, RANGE)
    assert found.relative == pytest.approx(level, rel=0.1)  # pull-off falls steeply there


def test_the_level_is_a_tenth_unless_it_is_given():
    limits = [predicted(LIMIT | more).limit for more in ({}, {"level": 0.1}, {"level": 0.2})]
    np.testing.assert_array_equal(limits[0], limits[1])
    assert np.all(limits[2] < limits[1])


def test_adhesion_falls_for_good():
    heights = np.geomspace(1e-9, 1e-3, 61)
    values = np.where(heights < 1e-7, 1.0, 0.01)
    values[heights > 1e-6] = 0.5  # it comes back
    values[heights > 1e-5] = 0.01
    step = heights[1] / heights[0]
    assert 1e-5 / step < predictions.find_fall(heights, values, 0.1) < 1e-5 * step


@pytest.mark.parametrize("level", [0.003, 0.1, 0.9])
def test_a_power_law_falls_to_a_level_where_it_has_it(level):
    heights = np.geomspace(1e-9, 1e-3, 23)
    found = predictions.find_fall(heights, (1e-7 / heights) ** 1.5, level)
    assert found == pytest.approx(1e-7 / level ** (2 / 3), rel=1e-9)


def test_to_nothing_adhesion_falls_in_proportion_to_the_logarithm_of_the_height():
    # From 0.4 to 0 between 1 and 100 um: 0.1 is left at three quarters of the way, 10^1.5 um.
    found = predictions.find_fall(np.array([1e-8, 1e-6, 1e-4]), np.array([1.0, 0.4, 0.0]), 0.1)
    assert found == pytest.approx(1e-6 * 10**1.5, rel=1e-9)


@pytest.mark.parametrize("value", [0.0, 0.05, 0.1, 0.2, 1.0])
def test_what_never_or_always_exceeds_the_level_falls_nowhere(value):
    heights = np.geomspace(1e-9, 1e-3, 7)
    assert np.isnan(predictions.find_fall(heights, np.full(7, value), 0.1))


def test_a_limiting_roughness_beyond_the_heights_is_an_error_that_names_the_case():
    soft = {"plane_strain_modulus": known("0.001 Pa")}  # which holds on any of these heights
    hard = {"plane_strain_modulus": known("1e30 Pa"), "range": known("1e-15 m")}  # and on none
    for conditions in (soft, soft | {"radius": known("5 mm")}, hard):
        with pytest.raises(ValueError, match="^mine.cases.one: adhesion falls to 0.1 at no rms"):
            predicted(**conditions)
    # Where the roughness is given, nothing but the limit is unknown.
    work = seen("work_of_approach", "1 mJ/m^2")
    found = predicted(work, plane_strain_modulus=known("0.001 Pa"), h_rms=known("1 um"))
    assert np.isnan(found.limit[1]).all()
    np.testing.assert_allclose(found.values["work_of_approach"][1], 0.05, rtol=1e-3)


@pytest.mark.parametrize("h_rms", ["0.2 um", "1 um", "3 um"])
def test_flats_are_predicted_as_by_the_library(h_rms):
    found = predicted(seen("work_of_approach", "1 mJ/m^2"), h_rms=known(h_rms))
    expected = predict(spectrum(float(h_rms.split()[0]) * 1e-6), LENGTH, RANGE)
    shares = [expected.separation_limits[0], expected.separation]
    np.testing.assert_allclose(found.values["remaining"][:2, 0], shares, rtol=1e-6)
    low, high = expected.approach_limits
    works = np.array([low, expected.approach, high]) * 0.05
    np.testing.assert_allclose(found.values["work_of_approach"][:, 0], works, rtol=1e-6)
    low, high = expected.separation_limits
    works = np.array([low, expected.separation, high]) * 0.05
    np.testing.assert_allclose(found.values["work_of_separation"][:, 0], works, rtol=1e-6)
    assert found.energy_ratio == pytest.approx(expected.energy_ratio, rel=1e-6)
    assert np.isnan(found.waves_in_contact).all()


def test_pull_off_of_smooth_flats_is_the_strength_of_the_law():
    found = predicted(seen("relative_pull_off", 0.5), h_rms=known("1e-19 m"))
    np.testing.assert_allclose(found.values["relative_pull_off"][1:, 0], 1, rtol=0.01)


@pytest.mark.parametrize(("radius", "rel"), [("100 m", 0.01), ("1 um", 0.34)])
def test_pull_off_of_a_sphere_is_what_remains_of_the_work(radius, rel):
    """In JKR's limit; a smaller sphere goes towards DMT, 4/3 of it, since the law reaches far."""
    work = seen("work_of_separation", "1 mJ/m^2")
    found = predicted(work, h_rms=known("1 um"), radius=known(radius)).values
    ratio = found["relative_pull_off"][1, 0] / (found["work_of_separation"][1, 0] / 0.05)
    assert 1 <= ratio <= 1 + rel
    assert (ratio > 1.2) == (radius == "1 um")


def test_waves_in_contact_are_those_across_jkr_s_contact():
    found = predicted(h_rms=known("1e-12 m"), radius=known("5 mm"))
    contact = 2 * (9 * np.pi / 8 * LENGTH * 5e-3**2) ** (1 / 3)
    assert found.waves_in_contact[0] == pytest.approx(contact / 1e-4, rel=0.01)


def test_limits_are_in_order_and_the_curve_falls():
    for radius in (None, known("5 mm")):
        found = predicted(
            seen("work_of_separation", "1 mJ/m^2"),
            h_rms=known(["10 nm", "10 um"]),
            hurst=known([0.5, 0.9]),
            radius=radius,
        )
        for name, values in (found.values | {"limit": found.limit}).items():
            assert np.all(np.diff(values, axis=0) >= 0), name
            assert values.shape == (3, 1 + 4 + 4)  # middle, ends and corners
        assert np.all(found.curve[1, :, 0] > 0.99)
        assert np.all(found.curve[1, :, -1] < 0.01)


def test_the_plateau_is_counted_from_its_end():
    with_plateau = predictions.describe_shape(0.8, 1e-4, 1e-5, 1e-7)
    s = spectrum(q1=2 * np.pi / 1e-7, q_rolloff=2 * np.pi / 1e-5)
    assert with_plateau.q0 == pytest.approx(2 * np.pi / 1e-5)
    assert with_plateau.elastic_energy == pytest.approx(s.elastic_energy(), rel=1e-6)
    assert with_plateau.rms_slope == pytest.approx(s.rms_slope, rel=1e-6)


def test_persson_and_tosatti_hold_up_to_the_root_of_the_energies():
    found = predictions.find_roughness(observe(LIMIT))
    expected = np.sqrt(LENGTH / spectrum().elastic_energy())
    assert found["persson_tosatti"] == pytest.approx(expected, rel=1e-9)


def test_criteria_s_roughness_is_that_of_the_middle():
    """Energies of full contact of H > 1/2 hardly differ; q0, which does, is swept."""
    found = predictions.find_roughness(
        observe(LIMIT, longest_wavelength=known(["50 um", "0.2 mm"]))
    )
    expected = np.sqrt(LENGTH / spectrum().elastic_energy())  # of 100 um, their geometric middle
    assert found["persson_tosatti"] == pytest.approx(expected, rel=1e-6)


def test_other_criteria_s_roughness_is_where_their_margin_is_one():
    observation = observe(LIMIT, radius=known("5 mm"))
    for name, limit in predictions.find_roughness(observation).items():
        if name == "dahlquist":  # which looks at no roughness
            assert np.isnan(limit)
            continue
        margins = [
            predictions.find_margins(observation, np.full(2, limit * factor))[name][0]
            for factor in (0.8, 1.0, 1.25)
        ]
        assert margins[0] > 1 > margins[2], name
        assert margins[1] == pytest.approx(1, rel=0.05), name


def test_dahlquist_s_margin_is_the_modulus():
    observation = observe(seen("sticks", True), h_rms=known("1 um"))
    margins = predictions.find_margins(observation, np.array([1e-6]))
    np.testing.assert_allclose(margins["dahlquist"], 1.0)  # 1 MPa over E*
    energy = spectrum(1e-6).elastic_energy()
    np.testing.assert_allclose(margins["persson_tosatti"], LENGTH / energy, rtol=1e-6)


def limits_of(observed, h_rms=1e-7, **conditions):
    observation = observe(observed, h_rms=known(f"{h_rms} m"), **conditions)
    shapes = predictions.shapes_of(observation)
    pair = predictions.make_pair(observation, shapes, np.array([[h_rms]]))
    return [float(limit[0]) for limit in predictions.find_observed(observation, pair)]


def test_conformal_contact_has_the_true_area_less_its_elastic_energy():
    more = {"relation": "conformal_contact", "factor": [1.0, 1.4], "error": "4 mJ/m^2"}
    relation = seen("work_of_approach", **more)
    energy = 1e6 * spectrum(1e-7).elastic_energy()
    assert 0 < energy < 0.01
    expected = [0.05 - energy - 0.004, 1.4 * 0.05 - energy + 0.004]
    assert limits_of(relation) == pytest.approx(expected, rel=1e-6)
    assert limits_of(relation, 1e-4) == [0, 0]  # not below nothing


def test_the_error_of_a_relation_may_be_all_that_is_left():
    relation = {"relation": "conformal_contact", "factor": [0.9, 1.0], "error": "4 mJ/m^2"}
    h = np.sqrt(0.052 / 1e6 / spectrum().elastic_energy())  # energy of full contact 52 mJ/m^2
    found = limits_of(seen("work_of_approach", **relation), h)
    assert found == [0, pytest.approx(0.05 - 0.052 + 0.004, rel=1e-4)]


def test_a_cycle_has_the_true_area_twice():
    relation = seen("work_of_separation", relation="cycle_loss", factor=[1.0, 1.4])
    energy = 1e6 * spectrum(1e-7).elastic_energy()
    expected = [2 * 0.05 - energy, 2 * 1.4 * 0.05 - energy]
    assert limits_of(relation) == pytest.approx(expected, rel=1e-6)
    # Over a cycle, just the work of adhesion on the true area is lost.
    on_approach = limits_of(seen("work_of_approach", relation="conformal_contact", factor=[1, 1.4]))
    assert np.subtract(limits_of(relation), on_approach) == pytest.approx([0.05, 1.4 * 0.05])


def test_an_energy_ratio_is_a_roughness():
    relation = seen("limiting_roughness", relation="energy_ratio", factor=[0.4, 0.6])
    per_height = spectrum().elastic_energy()
    expected = [np.sqrt(LENGTH / (factor * per_height)) for factor in (0.6, 0.4)]
    for h_rms in (1e-7, 1e-6):  # at any
        assert limits_of(relation, h_rms) == pytest.approx(expected, rel=1e-6)


def test_criteria_ask_for_adhesion_lengths_at_any_roughness():
    heights = np.array([[1e-7, 1e-6]] * 2)
    found = predictions.find_lengths(observe(LIMIT), heights)
    assert "dahlquist" not in found  # which knows none
    expected = heights[0] ** 2 * spectrum().elastic_energy() / LENGTH  # that of full contact
    np.testing.assert_allclose(found["persson_tosatti"][0], expected, rtol=1e-6)
    for name, ratio in found.items():
        margins = [predictions.find_margins(observe(LIMIT), h)[name] for h in heights.T]
        np.testing.assert_array_equal(ratio.T < 1, np.array(margins) > 1, err_msg=name)


def test_a_selection_has_its_combinations_alone():
    observation = observe(LIMIT, hurst=known([0.5, 0.8]))
    found = predictions.select(observation, [2, 0])
    np.testing.assert_allclose(found.inputs["hurst"], [0.8, 0.4**0.5])
    assert {len(values) for values in found.inputs.values()} == {2}
    assert found.experiment == observation.experiment
