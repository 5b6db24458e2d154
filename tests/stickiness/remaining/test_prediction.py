"""Predicted adhesion: inverse, limits, units, what must not matter."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from stickiness import adhesive
from stickiness.remaining import Roughness, predict
from stickiness.remaining.calibration import find_spread
from stickiness.remaining.roughness import LASTING, UNLIKE
from stickiness.spectrum import SelfAffine
from stickiness.surface import realised_spectrum, synthesise

pytestmark = pytest.mark.processors

TOUGH = {"adhesion_length": 1.0, "range": 1e-3}


def rough(**changes):
    return SelfAffine(**({"hurst": 0.8, "q0": 1.0, "q1": 1e4, "h_rms": 1.0} | changes))


@pytest.mark.parametrize("sign", [-1, 0, 1])
@pytest.mark.parametrize("share", [0.1, 0.5])
@pytest.mark.parametrize(
    "layer", [{}, {"solid": "layer", "relative_compliance": 0.3, "half_space_energy": 0.2}]
)
def test_threshold_is_the_inverse_of_the_share(share, sign, layer):
    surface = Roughness(h_rms=1.0, q0=1.0, elastic_energy=0.6, eta=sign, **layer)
    ranges = np.array([1e-4, 0.1, 0.5, 1.0])
    length = surface.threshold(ranges, share)
    assert surface.share(length, ranges) == pytest.approx(share, rel=1e-6)


def test_thresholds_of_tough_pairs_go_with_the_energy_alone():
    """If the mean wave number is the same over q0."""
    heights = np.array([0.8, 1.0, 1.25])
    surface = Roughness(h_rms=heights, q0=1 / heights**2, elastic_energy=0.6)
    assert np.ptp(np.log(surface.threshold(1e-4))) < 1e-3


def test_waves_that_take_energy_alone_leave_no_more():
    """Those beyond the resolution of an instrument are part of the energy, not of the slope."""
    energies = np.geomspace(0.1, 10.0, 31)
    surface = Roughness(h_rms=1.0, q0=1.0, elastic_energy=energies, rms_slope=0.4)
    for length, range_ in ((3.0, 1e-3), (0.3, 0.03), (0.03, 0.3)):
        assert (np.diff(surface.share(length, range_)) <= 1e-12).all()


def test_laws_are_told_apart_by_element():
    laws = np.array(["exponential", "van_der_waals"])
    both = Roughness(h_rms=1.0, q0=1.0, elastic_energy=0.6, law=laws)
    for place, law in enumerate(laws):
        alone = Roughness(h_rms=1.0, q0=1.0, elastic_energy=0.6, law=law)
        for ask in ("share", "tension", "distance", "zone"):
            found = getattr(both, ask)(np.full(2, 0.01), 0.1)
            assert found[place] == pytest.approx(getattr(alone, ask)(0.01, 0.1), rel=1e-12)
        high = alone.deviating(1)
        lengths = both.deviating(1).threshold(0.1)
        assert lengths[place] == pytest.approx(high.threshold(0.1), rel=1e-9)
        assert high.share(lengths[place], 0.1) == pytest.approx(0.1, rel=1e-6)


def test_simulated_hard_pairs_keep_what_is_predicted():
    """In a cell of four by four waves, which touch first at a gap of 3.4 rms heights."""
    length = 8 * np.pi
    heights = synthesise(rough(q1=16.0), n=256, length=length, seed=1)
    spectrum = realised_spectrum(heights, length)
    jumps = np.exp(find_spread("spectrum", "ln_path").high)
    inside = []
    for ratio, reach in product((0.01, 0.1), (0.1, 0.3)):
        work = ratio * spectrum.elastic_energy()
        law = adhesive.VanDerWaals(work, reach)
        found = adhesive.solve(heights, length, law, pressure=0.0, tol=1e-9)
        expected = predict(spectrum, work, reach, law="van_der_waals")
        low, high = expected.separation_limits
        inside.append(low < -found.energy / work < high / jumps)
        assert 0.4 < expected.separation * work / -found.energy < 2
        assert predict(spectrum, work, reach).separation < 0.6 * expected.separation
    # Limits cover 90 %; the one outside is 3 % off.
    assert sum(inside) >= 3


def test_the_share_grows_with_the_work_of_adhesion():
    surface = Roughness(h_rms=1.0, q0=1.0, elastic_energy=0.6)
    lengths = np.geomspace(1e-6, 1e3, 400)
    for reach in (1e-3, 0.1, 0.3, 0.7, 1.0, 3.0):
        assert np.all(np.diff(surface.share(lengths, reach)) >= -1e-12)


@pytest.mark.parametrize("unit", [1e-9, 1e6])
def test_units_do_not_matter(unit):
    found = predict(rough(), **TOUGH)
    scaled = rough(q0=1 / unit, q1=1e4 / unit, h_rms=unit)
    again = predict(scaled, adhesion_length=unit, range=1e-3 * unit)
    for name in ("separation", "pull_off", "approach_limits", "tabor", "energy_ratio"):
        assert getattr(again, name) == pytest.approx(getattr(found, name), rel=1e-9)


def test_a_plateau_counts_from_its_end():
    found = predict(rough(q_rolloff=4.0), **TOUGH)
    same = predict(rough(q_rolloff=4.0), **TOUGH, q0=4.0)
    assert found == same


def test_limits_are_wider_for_surfaces_with_a_direction():
    unlike = rough(anisotropy=4.0, angle=0.3)
    found = predict(unlike, **TOUGH)
    as_if = SelfAffine(hurst=0.8, q0=1.0, q1=1e4, h_rms=unlike.h_rms)
    length = TOUGH["adhesion_length"] * as_if.elastic_energy() / unlike.elastic_energy()
    alike = predict(as_if, length, TOUGH["range"])
    assert (found.anisotropy_error_factor, alike.anisotropy_error_factor) == (UNLIKE, 1)
    assert found.energy_ratio == pytest.approx(alike.energy_ratio)
    # By the direction the mean wave number is larger over q0: that counts as more scales.
    assert alike.separation_limits[0] < found.separation < alike.separation
    for name in ("separation_limits", "pull_off_limits"):
        wide, narrow = (np.ptp(np.log(getattr(each, name))) for each in (found, alike))
        assert wide > 1.1 * narrow
    surface = Roughness(
        h_rms=unlike.h_rms,
        q0=1.0,
        elastic_energy=unlike.elastic_energy(),
        anisotropy_error_factor=UNLIKE,
        eta=1,
    )
    length = surface.threshold(TOUGH["range"], 0.2)
    assert surface.share(length, TOUGH["range"]) == pytest.approx(0.2, rel=1e-6)


def test_limits_widen_steadily_with_the_direction():
    widening = [
        predict(rough(anisotropy=a), **TOUGH).anisotropy_error_factor
        for a in (1, 1.0001, 2, 3.9, 4, 99)
    ]
    assert widening[0] == 1
    assert widening[1:3] == pytest.approx([1, 2**0.5], abs=1e-4)
    assert widening[3:] == pytest.approx([2, 2, 99**0.5], abs=0.04)


@pytest.mark.parametrize("q1", [1.001, 1e4, 1e10])
def test_limits_hold_the_value(q1):
    for length in (1e-3, 0.3, 1.0, 10.0):
        found = predict(rough(q1=q1), adhesion_length=length, range=0.01)
        for name in ("approach", "separation", "pull_off"):
            low, high = getattr(found, f"{name}_limits")
            assert low <= getattr(found, name) <= high
            assert low < high


@pytest.mark.parametrize("name", ["adhesion_length", "range", "q0"])
@pytest.mark.parametrize("bad", [0.0, -1.0, np.nan, "1"])
def test_bad_arguments_are_named(name, bad):
    with pytest.raises(ValueError, match=name):
        predict(rough(), **(TOUGH | {name: bad}))


@pytest.mark.parametrize(("factor", "lasts"), [(0.98, False), (1.02, True)])
def test_full_contact_lasts_if_the_strength_exceeds_its_tension(factor, lasts):
    surface = Roughness(h_rms=1.0, q0=1.0, elastic_energy=0.5, rms_slope=1.0, eta=1)
    strength = factor * LASTING / 2
    held = surface.tension(0.1 * strength, 0.1, pressed=2.1)
    assert (held == pytest.approx(strength)) == lasts


def test_fast_separation_multiplies_the_high_limits_alone():
    slow = Roughness(h_rms=1.0, q0=1.0, elastic_energy=1.0, rms_slope=3.0)
    fast = replace(slow, instant_ratio=4.0)
    length, range_ = 0.8, 0.05
    for eta, factor in ((-1, 1), (0, 1), (0.5, 2), (1, 4), (2, 4)):
        quick = fast.deviating(eta)
        for quantity in (Roughness.share, Roughness.tension):
            expected = factor * quantity(slow.deviating(eta), length, range_)
            assert quantity(quick, length, range_) == pytest.approx(expected, rel=1e-12)
        at_threshold = quick.share(quick.threshold(range_, 0.2), range_)
        assert at_threshold == pytest.approx(0.2, rel=1e-6)
    strength = length / range_
    fastest = replace(slow, instant_ratio=1e4, eta=1)
    assert fastest.tension(length, range_) == pytest.approx(strength)


def test_a_range_that_holds_always_has_the_least_threshold_in_any_unit():
    lengths = []
    for unit in (1.0, 1e-6):
        surface = Roughness(h_rms=unit, q0=1 / unit, elastic_energy=0.6 * unit)
        lengths.append(surface.threshold(100 * unit, 0.1) / unit)
    assert lengths[0] < 1e-4
    assert lengths[1] == pytest.approx(lengths[0], rel=1e-9)
