"""Experiments of the configuration in SI units, swept over what is not known."""

import numpy as np
import pytest
from helpers.experiments import known, make_experiments, observe, seen

from experiments.entries import MIDDLE, combine_inputs, read_observations

STICKS = seen("sticks", True)
SWEPT = {
    "hurst": known([0.5, 0.8], "assumed"),
    "work_of_adhesion": known(["10 mJ/m^2", "40 mJ/m^2"]),
    "h_rms": known("1 um"),
}


def test_combinations_are_the_middle_then_each_end_then_all_corners():
    ends = {"a": np.array([1.0, 4.0]), "b": np.array([7.0]), "c": np.array([10.0, 1000.0])}
    found = combine_inputs(ends, ("a", "c"))
    rows = [(2, 100), (1, 100), (4, 100), (2, 10), (2, 1000)]  # geometric middles 2 and 100
    corners = [(1, 10), (1, 1000), (4, 10), (4, 1000)]
    np.testing.assert_allclose(np.transpose([found["a"], found["c"]]), rows + corners)
    np.testing.assert_array_equal(found["b"], np.full(9, 7.0))


@pytest.mark.parametrize("count", [2, 3, 6])
def test_the_sweep_is_no_full_product(count):
    swept = tuple("abcdef"[:count])
    ends = {name: np.array([1.0, 4.0]) for name in swept}
    found = np.transpose([*combine_inputs(ends, swept).values()])
    assert found.shape == (1 + 2 * count + 2**count, count)
    assert len({tuple(row) for row in found}) == len(found)
    np.testing.assert_array_equal(
        np.sum(found != 2, axis=1)[: 1 + 2 * count], [0] + [1] * 2 * count
    )
    assert np.all(found[1 + 2 * count :] != 2)


def test_a_configured_sweep_is_in_si_units():
    found = observe(STICKS, **SWEPT)
    # In the order of the conditions, where the work of adhesion is before the Hurst exponent.
    assert found.swept == ("work_of_adhesion", "hurst")
    works = [0.02, 0.01, 0.04, 0.02, 0.02, 0.01, 0.01, 0.04, 0.04]
    middle = 0.4**0.5
    hursts = [middle, middle, middle, 0.5, 0.8, 0.5, 0.8, 0.5, 0.8]
    np.testing.assert_allclose(found.inputs["work_of_adhesion"], works)
    np.testing.assert_allclose(found.inputs["hurst"], hursts)
    np.testing.assert_allclose(found.inputs["h_rms"], np.full(9, 1e-6))


def test_along_an_input_the_others_stay_in_their_middle():
    found = observe(STICKS, **SWEPT)
    ends = {"hurst": (0.5, 0.4**0.5, 0.8), "work_of_adhesion": (0.01, 0.02, 0.04)}
    for name, other in (("hurst", "work_of_adhesion"), ("work_of_adhesion", "hurst")):
        along = found.along(name)
        assert along[1] == MIDDLE
        np.testing.assert_allclose(found.inputs[name][along], ends[name])
        np.testing.assert_allclose(found.inputs[other][along], [ends[other][1]] * 3)


def test_what_may_be_zero_is_swept_from_zero_through_half():
    young = known("0.75 MPa")
    found = observe(
        STICKS, plane_strain_modulus=None, youngs_modulus=young, poisson_ratio=known([0.0, 0.5])
    )
    # E/(1 - nu^2) at 1/4, which is half of the high end, at 0 and at 1/2.
    expected = [0.8e6, 0.75e6, 1e6]
    np.testing.assert_allclose(found.inputs["modulus"][[MIDDLE, 1, 2]], expected)


def test_plane_strain_modulus_is_as_given_or_that_of_youngs():
    assert set(observe(STICKS).inputs["modulus"]) == {1e6}
    young = {"youngs_modulus": known("0.75 MPa"), "poisson_ratio": known(0.5)}
    found = observe(STICKS, plane_strain_modulus=None, **young)
    np.testing.assert_allclose(found.inputs["modulus"], 1e6)  # E/(1 - 1/4)


@pytest.mark.parametrize(
    ("observed", "limits"),
    [
        (seen("work_of_approach", "30 mJ/m^2"), (0.03, 0.03)),
        (seen("limiting_roughness", ["1 um", "2000 nm"]), (1e-6, 2e-6)),
        (seen("relative_pull_off", [0.1, 0.2]), (0.1, 0.2)),
        (seen("sticks", False), (0.0, 0.0)),
        (seen("sticks", True), (1.0, 1.0)),
        (seen("work_of_separation", relation="cycle_loss", factor=[1.0, 1.4]), (1.0, 1.4)),
        (seen("work_of_approach", relation="conformal_contact", factor=[0.9, 1]), (0.9, 1.0)),
    ],
)
def test_what_was_observed_is_read_in_si_units(observed, limits):
    found = observe(observed)
    assert (found.low, found.high) == pytest.approx(limits, rel=1e-12)


def test_errors_and_grades_are_read():
    relation = {"relation": "conformal_contact", "factor": [1, 2], "error": "4 mJ/m^2"}
    found = observe(seen("work_of_approach", **relation))
    assert found.relation == "conformal_contact"
    assert found.error == pytest.approx(0.004)
    assert found.grades["work_of_approach"] == "read"
    assert found.grades["range"] == "assumed"
    assert (observe(STICKS).error, observe(STICKS).relation) == (0, None)


def test_level_silence_and_publication_are_read_or_have_their_defaults():
    more = {"level": 0.03, "silent": ["dahlquist"]}
    found = observe(seen("limiting_roughness", "1 um", **more), published=False)
    assert (found.level, found.silent, found.published) == (0.03, ("dahlquist",), False)
    plain = observe(seen("limiting_roughness", "1 um"))
    assert (plain.level, plain.silent, plain.published) == (0.1, (), True)


def test_cases_come_in_the_order_of_the_configuration_with_what_they_inherit():
    found = list(read_observations(make_experiments()))
    assert [f"{o.experiment}/{o.name}" for o in found] == ["ball/limit", "ball/work", "plate/steel"]
    assert [o.label for o in found] == ["lost", "held", "steel on steel"]
    assert [o.swept for o in found] == [("longest_wavelength",)] * 2 + [("plane_strain_modulus",)]
    assert [o.inputs.get("radius", [None])[0] for o in found] == [5e-3, 5e-3, None]
    assert ["h_rms" in o.inputs for o in found] == [False, True, True]
