"""Experiments of the configuration in SI units, swept over what is not known."""

import numpy as np
import pytest
from helpers.experiments import known, make_experiments, observe, seen

from pipeline.experiments.entries import read_observations

STICKS = seen("sticks", True)
SWEPT = {
    "hurst": known([0.5, 0.8], "assumed"),
    "work_of_adhesion": known(["10 mJ/m^2", "40 mJ/m^2"]),
    "h_rms": known("1 um"),
}


def test_every_combination_of_what_is_plausible_is_there_once():
    found = observe(STICKS, **SWEPT)
    pairs = list(zip(found.inputs["hurst"], found.inputs["work_of_adhesion"], strict=True))
    hursts, works = (0.5, 0.4**0.5, 0.8), (0.01, 0.02, 0.04)  # low, geometric middle, high
    expected = sorted((hurst, work) for hurst in hursts for work in works)
    np.testing.assert_allclose(sorted(pairs), expected)
    np.testing.assert_allclose(found.inputs["h_rms"], np.full(9, 1e-6))


def test_the_middle_has_every_input_in_its_middle():
    found = observe(STICKS, **SWEPT)
    assert found.inputs["hurst"][found.middle] == pytest.approx(0.4**0.5)
    assert found.inputs["work_of_adhesion"][found.middle] == pytest.approx(0.02)
    assert observe(STICKS).middle == 0


def test_along_an_input_the_others_stay_in_their_middle():
    found = observe(STICKS, **SWEPT)
    for name, other in (("hurst", "work_of_adhesion"), ("work_of_adhesion", "hurst")):
        along = found.along(name)
        np.testing.assert_allclose(found.inputs[name][along], found.axes[name])
        assert np.ptp(found.inputs[other][along]) == 0
        assert found.inputs[other][along[0]] == found.inputs[other][found.middle]


def test_what_may_be_zero_is_swept_from_zero():
    young = known("0.75 MPa")
    found = observe(
        STICKS, plane_strain_modulus=None, youngs_modulus=young, poisson_ratio=known([0.0, 0.5])
    )
    np.testing.assert_allclose(found.inputs["modulus"], [0.75e6, 0.8e6, 1e6])


def test_plane_strain_modulus_is_as_given_or_that_of_youngs():
    assert observe(STICKS).inputs["modulus"].tolist() == [1e6]
    young = {"youngs_modulus": known("0.75 MPa"), "poisson_ratio": known(0.5)}
    found = observe(STICKS, plane_strain_modulus=None, **young)
    np.testing.assert_allclose(found.inputs["modulus"], [1e6])  # E/(1 - 1/4)


@pytest.mark.parametrize(
    ("observed", "limits"),
    [
        (seen("work_of_approach", "30 mJ/m^2"), (0.03, 0.03)),
        (seen("roughness_at_a_tenth", ["1 um", "2000 nm"]), (1e-6, 2e-6)),
        (seen("relative_pull_off", [0.1, 0.2]), (0.1, 0.2)),
        (seen("sticks", False), (0.0, 0.0)),
        (seen("work_of_separation", relation="cycle_loss", factor=[1.0, 1.4]), (1.0, 1.4)),
        (seen("work_of_approach", relation="conformal_contact"), (1.0, 1.0)),
    ],
)
def test_what_was_observed_is_read_in_si_units(observed, limits):
    found = observe(observed)
    assert (found.low, found.high) == pytest.approx(limits, rel=1e-12)


def test_errors_and_grades_are_read():
    found = observe(seen("work_of_approach", relation="conformal_contact", error="4 mJ/m^2"))
    assert found.error == pytest.approx(0.004)
    assert found.grades["work_of_approach"] == "read"
    assert found.grades["range"] == "assumed"
    assert observe(STICKS).error == 0


def test_cases_come_in_the_order_of_the_configuration_with_what_they_inherit():
    found = list(read_observations(make_experiments()))
    assert [f"{o.experiment}/{o.name}" for o in found] == ["ball/limit", "ball/work", "plate/steel"]
    assert [len(o.inputs["modulus"]) for o in found] == [3, 3, 3]
    assert [o.inputs.get("radius", [None])[0] for o in found] == [5e-3, 5e-3, None]
    assert ["h_rms" in o.inputs for o in found] == [False, True, True]
