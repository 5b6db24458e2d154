"""Thresholds put back into the verdict, and what is searched in vain."""

from dataclasses import replace

import numpy as np
import pytest

from stickiness import thresholds, verdict
from stickiness.criteria.thresholds import find_rate, find_threshold
from stickiness.persson import Persson
from stickiness.solids import Film, Layer
from stickiness.solids.moduli import Prony, Table
from stickiness.spectrum import SelfAffine
from stickiness.surface import synthesise

WALL = {"hurst": 0.8, "q0": 6e4, "q1": 6e7, "h_rms": 1e-6, "q_rolloff": 1.2e5}
TAPE = {"modulus": 1e6, "poisson": 0.5, "work_of_adhesion": 0.06, "range": 3e-9}
LAYER = Layer(30e-6, 0.5)
ON_FILM = Layer(30e-6, 0.5, Film(3000.0, 0.4, 25e-6))
SLOW = Prony(1e5, ((2e6, 0.1), (1e8, 1e-3)))
MATERIALS = {
    "deep": TAPE,
    "layer": TAPE | {"solid": LAYER},
    "slipping": TAPE | {"solid": replace(LAYER, backing="slip"), "wanted_share": 0.3},
    "on a film": TAPE | {"solid": ON_FILM},
    "compressible": TAPE | {"poisson": 0.3, "solid": Layer(10e-6, 0.3), "law": "van_der_waals"},
    "rested": TAPE | {"separation_factor": (2.0, 1.0, 4.0)},
}


def again(question, value, material):
    """Verdict with a threshold in the place of what is given."""
    wall, material = dict(WALL), dict(material)
    if question == "rms_height":
        wall["h_rms"] = value
    elif question == "modulus":
        if isinstance(film := getattr(material.get("solid"), "backing", None), Film):
            ratio = film.modulus_ratio * material["modulus"] / value
            solid = replace(material["solid"], backing=replace(film, modulus_ratio=ratio))
            material["solid"] = solid
        material["modulus"] = value
    elif question == "thickness":
        material["solid"] = replace(material["solid"], thickness=value)
    elif question == "rate":
        return again("modulus", SLOW.storage(value), material)
    return verdict(SelfAffine(**wall), a_v=(3.0, 3.0, 3.0), **material)


@pytest.mark.parametrize("name", MATERIALS)
def test_verdict_at_a_threshold_has_the_wanted_share(name):
    material = MATERIALS[name]
    found = thresholds(SelfAffine(**WALL), storage=SLOW, **material)
    wanted, tried = material.get("wanted_share", 0.1), 0
    for question in ("modulus", "rms_height", "thickness", "rate"):
        threshold = getattr(found, question)
        if threshold is None:
            continue
        assert threshold.low <= threshold.value <= threshold.high
        for place, value in enumerate(threshold):
            if 0 < value < np.inf:
                judged = again(question, value, material)
                shares = judged.remaining_limits if place else (judged.remaining,)
                assert min(np.abs(np.subtract(shares, wanted))) < 1e-3 * wanted
                tried += 1
    assert tried >= 9


def test_thresholds_of_what_is_measured_are_those_of_its_spectrum():
    heights = synthesise(SelfAffine(**WALL | {"q1": 6e6}), 256, 2 * np.pi / 6e4, 3)
    found = thresholds(heights, length=2 * np.pi / 6e4, **TAPE)
    judged = verdict(heights, length=2 * np.pi / 6e4, **TAPE)
    limits = np.multiply(judged.modulus_threshold_limits, 0.75)
    assert found.modulus == pytest.approx((0.75 * judged.modulus_threshold, *limits))
    # The verdict sticks below every threshold, and not above any.
    assert (judged.remaining > 0.1) == (found.rms_height.value > judged.spectrum.h_rms)


def test_no_thickness_or_rate_sticks_or_every_one_does():
    table = Table((0.1, 10.0), (1e5, 1e7))
    hard, between, soft = (
        thresholds(SelfAffine(**WALL), storage=table, **TAPE | {"solid": LAYER} | {"modulus": e})
        for e in (1e9, 1e6, 1e3)
    )
    assert hard.thickness == (np.inf,) * 3
    # Down to the rms height. There the layer is no linear one, which the limits know.
    assert soft.thickness.value == soft.thickness.low == 0
    layer = replace(LAYER, thickness=soft.thickness.high)
    assert layer.strain(1e-6, 1.2e5) == pytest.approx(0.3, rel=1e-3)
    assert table.storage(between.rate.value) == pytest.approx(between.modulus.value, rel=1e-4)
    assert find_rate(table, (0.0, 9e4, 2e7), (1e-3, 1e3)) == (0.0, 0.0, np.inf)
    peak = Table((0.01, 1.0, 100.0), (1e4, 1e6, 1e4))
    found = find_rate(peak, (1e5,) * 3, (1e-3, 1e3))
    assert found == (pytest.approx(0.1, rel=1e-4), pytest.approx(0.1, rel=1e-4), np.inf)


def test_several_crossings_widen_the_limits():
    """The low limit is before all crossings of a share, the high one after them."""

    def share(x):
        return 0.15 + 0.1 * np.sin(np.log(x)) - 0.02 * np.log(x)

    def limits(x):
        return share(x)[..., None] * np.ones(3)

    value, first, last = find_threshold(limits, 1e-2, 1e5, 0.1)
    for x in (value, first, last):
        assert share(x) == pytest.approx(0.1, abs=1e-6)
    assert share(first * 0.99) > 0.1 > share(first * 1.01)
    assert np.all(share(np.geomspace(last * 1.001, 1e5, 500)) < 0.1)
    assert first < last / 3
    beyond = [find_threshold(limits, 1e5, 1e-2, wanted) for wanted in (0.5, -1.0)]
    assert beyond == [(np.inf,) * 3, (0.0,) * 3]


def test_pressure_of_an_area_of_contact():
    spectrum, area = SelfAffine(**WALL), 0.1
    found = thresholds(spectrum, contact_area=area, **TAPE)
    theory = Persson(spectrum, correction="wang2017")
    areas = theory.area_fraction(np.array(found.pressure) / (1e6 / 0.75))
    assert areas == pytest.approx([area, 0.85 * area, 1.15 * area])
    # In proportion at small areas: A = (8/(pi gamma))^(1/2) p/(E* h'), gamma = 5/9.
    small = thresholds(spectrum, contact_area=0.005, **TAPE).pressure.value * 0.75 / 1e6
    assert small == pytest.approx(0.005 * np.sqrt(np.pi * 5 / 72) * spectrum.rms_slope, rel=1e-3)
    thin = thresholds(spectrum, contact_area=area, **TAPE | {"solid": Layer(2e-6, 0.5)})
    assert thin.pressure.low / thin.pressure.value < 0.6 < found.pressure.low / found.pressure.value
    with pytest.raises(ValueError, match=r"contact_area must be in \(0.005, 0.35\), got 5"):
        thresholds(spectrum, contact_area=5, **TAPE)
