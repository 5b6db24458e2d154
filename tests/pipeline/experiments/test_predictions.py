"""Predictions for experiments: against thresholds solved apart, closed forms, relations."""

import numpy as np
import pytest
from helpers.experiments import known, observe, seen
from scipy.optimize import brentq

from pipeline.experiments import predictions
from stickiness.remaining import Roughness, predict, sphere
from stickiness.spectrum import SelfAffine

TENTH = seen("roughness_at_a_tenth", ["1 um", "2 um"])
LENGTH, RANGE = 0.05 / 1e6, 0.3e-9


def spectrum(h_rms=1.0, **more):
    given = {"hurst": 0.8, "q0": 2 * np.pi / 1e-4, "q1": 2 * np.pi / 1e-6} | more
    return SelfAffine(h_rms=h_rms, **given)


def predicted(observed=TENTH, **conditions):
    return predictions.predict_observation(observe(observed, **conditions))


@pytest.mark.parametrize(("sign", "row"), [(-1, 0), (0, 1), (1, 2)])
def test_between_flats_the_roughness_at_a_tenth_is_that_of_the_threshold(sign, row):
    unit = spectrum()

    def excess(log_h):
        h = np.exp(log_h)
        rough = Roughness(h, unit.q0, unit.elastic_energy() * h**2)
        return np.log(rough.threshold(RANGE, sign=sign) / LENGTH)

    expected = np.exp(brentq(excess, np.log(1e-8), np.log(1e-4)))
    assert predicted().tenth[row, 0] == pytest.approx(expected, rel=0.02)


def test_of_a_sphere_the_roughness_at_a_tenth_is_where_a_tenth_of_the_force_is_left():
    unit, h = spectrum(), predicted(radius=known("5 mm")).tenth[1, 0]
    rough = Roughness(h, unit.q0, unit.elastic_energy() * h**2)
    found = sphere.pull_off(rough, 5e-3, LENGTH, RANGE)
    assert found.relative == pytest.approx(0.1, rel=0.1)  # pull-off falls steeply there


def test_adhesion_falls_for_good():
    roughness = predictions.ROUGHNESS
    values = np.where(roughness < 1e-7, 1.0, 0.01)
    values[roughness > 1e-6] = 0.5  # it comes back
    values[roughness > 1e-5] = 0.01
    step = roughness[1] / roughness[0]
    assert 1e-5 / step < predictions.find_fall(values) < 1e-5 * step
    power = 1e-6 / roughness  # 0.1 at 10 um
    assert predictions.find_fall(power) == pytest.approx(1e-5, rel=1e-9)
    assert predictions.find_fall(np.zeros_like(roughness)) == roughness[0]
    assert predictions.find_fall(np.ones_like(roughness)) == roughness[-1]


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
        for name, values in (found.values | {"tenth": found.tenth}).items():
            assert np.all(np.diff(values, axis=0) >= 0), name
            assert values.shape == (3, 9)
        assert np.all(found.curve[1, :, 0] > 0.99)
        assert np.all(found.curve[1, :, -1] < 0.01)


def test_the_plateau_is_counted_from_its_end():
    with_plateau = predictions.describe_shape(0.8, 1e-4, 1e-5, 1e-7)
    s = spectrum(q1=2 * np.pi / 1e-7, q_rolloff=2 * np.pi / 1e-5)
    assert with_plateau.q0 == pytest.approx(2 * np.pi / 1e-5)
    assert with_plateau.elastic_energy == pytest.approx(s.elastic_energy(), rel=1e-6)
    assert with_plateau.rms_slope == pytest.approx(s.rms_slope, rel=1e-6)


def test_persson_and_tosatti_hold_up_to_the_root_of_the_energies():
    found = predictions.find_roughness(observe(TENTH))
    expected = np.sqrt(LENGTH / spectrum().elastic_energy())
    np.testing.assert_allclose(found["persson_tosatti"], [expected], rtol=1e-9)


def test_other_criteria_s_roughness_is_where_their_margin_is_one():
    observation = observe(TENTH, radius=known("5 mm"))
    for name, limit in predictions.find_roughness(observation).items():
        if name == "dahlquist":  # which looks at no roughness
            assert np.isnan(limit).all()
            continue
        margins = [
            predictions.find_margins(observation, limit * factor)[name][0, 0]
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


def test_conformal_contact_loses_its_elastic_energy():
    relation = seen("work_of_approach", relation="conformal_contact", error="4 mJ/m^2")
    energy = 1e6 * spectrum(1e-7).elastic_energy()
    assert 0 < energy < 0.01
    expected = [0.05 - energy - 0.004, 0.05 - energy + 0.004]
    assert limits_of(relation) == pytest.approx(expected, rel=1e-6)
    assert limits_of(relation, 1e-4) == [0, pytest.approx(0.004)]  # not below nothing


def test_a_cycle_loses_the_true_area_more():
    relation = seen("work_of_separation", relation="cycle_loss", factor=[1.0, 1.4])
    energy = 1e6 * spectrum(1e-7).elastic_energy()
    expected = [0.05 - energy + 0.05, 0.05 - energy + 1.4 * 0.05]
    assert limits_of(relation) == pytest.approx(expected, rel=1e-6)


def test_an_energy_ratio_is_a_roughness():
    relation = seen("roughness_at_a_tenth", relation="energy_ratio", factor=[0.4, 0.6])
    per_height = spectrum().elastic_energy()
    expected = [np.sqrt(LENGTH / (factor * per_height)) for factor in (0.6, 0.4)]
    for h_rms in (1e-7, 1e-6):  # at any
        assert limits_of(relation, h_rms) == pytest.approx(expected, rel=1e-6)


def test_without_error_every_input_is_in_its_middle():
    found = predictions.without_error(observe(TENTH, hurst=known([0.5, 0.8])))
    np.testing.assert_allclose(found.inputs["hurst"], [0.4**0.5])
    assert found.axes == {}
