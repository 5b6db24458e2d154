"""Thresholds put back into the verdict, and what is searched in vain."""

from dataclasses import replace

import numpy as np
import pytest
from helpers.analysed import fix_a_v

from stickiness import Material, Surface, thresholds, verdict
from stickiness.limited import Limited
from stickiness.persson import Persson
from stickiness.solids import Film, Layer, Skin
from stickiness.solids.moduli import Prony, Table
from stickiness.spectrum import SelfAffine
from stickiness.verdicts.thresholds import find_rate, find_threshold

pytestmark = pytest.mark.usefixtures("coarse_simulation")

TAPE = Material(youngs_modulus=1e6, work_of_adhesion=0.06, range=3e-9)
LAYER = Layer(30e-6, 0.5)
ON_FILM = Layer(30e-6, 0.5, Film(3000.0, 0.4, 25e-6))
SLOW = Prony(1e5, ((2e6, 0.1), (1e8, 1e-3)))
MATERIALS = {
    "deep": TAPE,
    "layer": TAPE.replace(solid=LAYER),
    "slipping": TAPE.replace(solid=replace(LAYER, backing="slip")),
    "on a film": TAPE.replace(solid=ON_FILM),
    "compressible": TAPE.replace(poisson_ratio=0.3, solid=Layer(10e-6, 0.3), law="van_der_waals"),
    "aged": TAPE.replace(solid=Skin(0.05e-6, 30.0, 0.35, 0.5)),
    "rested": TAPE.replace(youngs_modulus_prony=Prony(1e6, ((2e6, 400.0),)), dwell=3600.0),
    "slow": TAPE.replace(youngs_modulus_prony=SLOW),
}
WANTED = {"slipping": 0.3}  # shares of the work of adhesion


def make_spectrum(h_rms=1e-6):
    return SelfAffine(hurst=0.8, q0=6e4, q1=6e6, h_rms=h_rms, q_rolloff=1.2e5)


def make_wall(h_rms=1e-6):
    return fix_a_v(Surface.from_spectrum(make_spectrum(h_rms)))


def change_modulus(material, modulus):
    """The material with a Young's modulus of the verdict [Pa] and the same film or skin."""
    as_judged = 1 - material.poisson_ratio**2
    ratio = modulus / (as_judged * material.plane_strain_modulus)
    solid = material.solid
    if isinstance(solid, Skin):
        solid = replace(solid, modulus_ratio=solid.modulus_ratio / ratio)
    film = getattr(solid, "backing", None)
    if isinstance(film, Film):
        solid = replace(solid, backing=replace(film, modulus_ratio=film.modulus_ratio / ratio))
    if material.depends_on_rate:
        return material.replace(modulus=material.modulus.scaled(ratio))
    return material.replace(youngs_modulus=modulus, solid=solid)


def judge_again(question, value, material, wanted):
    """Verdict with a threshold in the place of what is given."""
    wall = make_wall()
    if question == "rms_height":
        wall = make_wall(value)
    elif question == "modulus":
        material = change_modulus(material, value)
    elif question == "thickness":
        material = material.replace(solid=replace(material.solid, thickness=value))
    elif question == "rate":
        material = material.replace(youngs_modulus=float(material.modulus.storage(value)))
    return verdict(wall, material, wanted_share=wanted)


@pytest.mark.parametrize("name", MATERIALS)
def test_verdict_at_a_threshold_has_the_wanted_share(name):
    material = MATERIALS[name]
    wanted = WANTED.get(name, 0.1)
    answer = thresholds(make_wall(), material, wanted_share=wanted)
    tried = 0
    for question in ("modulus", "rms_height", "thickness", "rate"):
        threshold = getattr(answer, question)
        if threshold is None:
            continue
        assert threshold.low <= threshold.value <= threshold.high
        for value in threshold:
            if 0 < value < np.inf:
                judged = judge_again(question, value, material, wanted)
                of_limit = value != threshold.value
                shares = judged.remaining_limits if of_limit else (judged.remaining,)
                assert min(np.abs(np.subtract(shares, wanted))) < 1e-3 * wanted
                tried += 1
    assert tried >= 6
    assert (answer.thickness is None) == (name in ("deep", "aged", "rested", "slow"))
    assert (answer.rate is None) == (name != "slow")


def test_no_modulus_sticks_below_a_skin_that_takes_too_much_to_bend():
    assert thresholds(make_wall(), TAPE).modulus.value > 1e4
    glass = TAPE.replace(solid=Skin(5e-6, 1e5, 0.2, 0.5))
    assert tuple(thresholds(make_wall(), glass).modulus) == (0, 0, 0)


def test_no_thickness_or_rate_sticks_or_every_one_does():
    table = Table((0.1, 10.0), (1e5, 1e7))
    hard, soft = (
        thresholds(make_wall(), TAPE.replace(youngs_modulus=modulus, solid=LAYER))
        for modulus in (1e9, 1e3)
    )
    assert hard.thickness == (np.inf,) * 3
    # Down to the rms height. There the layer is no linear one, which the limits know.
    assert soft.thickness.value == soft.thickness.low == 0
    layer = replace(LAYER, thickness=soft.thickness.high)
    assert layer.strain(1e-6, 1.2e5) == pytest.approx(0.3, rel=1e-3)
    between = thresholds(make_wall(), TAPE.replace(youngs_modulus_table=table, solid=LAYER))
    assert table.storage(between.rate.value) == pytest.approx(between.modulus.value, rel=1e-4)
    assert find_rate(table, Limited(value=9e4, low=0.0, high=2e7)) == (0.0, 0.0, np.inf)
    # Within noise a modulus may fall, and be equal to another one several times.
    dip = Table((0.01, 1.0, 10.0, 100.0), (1e4, 1e5, 0.97e5, 1e6))
    first = 0.01 * 9.9**2
    last = 10 * (99 / 97) ** (1 / np.log10(1 / 0.097))
    rate = find_rate(dip, Limited(*(0.99e5,) * 3))
    assert rate == pytest.approx((first, first, last), rel=1e-4)


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


@pytest.mark.parametrize("point", [0, 3, 11, 20, 21])
@pytest.mark.parametrize("shape", ["steady", "jump", "rounded"])
def test_a_share_that_is_the_wanted_one_at_a_point_of_the_search_is_found(point, shape):
    """Rounding decides on which side of the point the share lies, and not whether it is found."""
    points = np.geomspace(1e-9, 1e-5, 22)

    def remain(values):
        ratio = values[..., None] / points[point]
        shares = np.where(ratio <= 1, 0.9, 0.1) if shape == "jump" else 0.5 * ratio**-0.3
        if shape == "rounded" and len(values) < points.size:
            shares = shares * (1 - 1e-15)
        return shares * np.ones(3)

    threshold = find_threshold(remain, points[0], points[-1], 0.5)
    if point == 21:
        assert threshold == (np.inf,) * 3
    else:
        assert threshold == pytest.approx((points[point],) * 3, rel=1e-6)


def test_a_share_that_is_no_number_is_an_error():
    def remain(values):
        shares = 1 / (1 + values[..., None])
        return np.where(abs(values[..., None] - 1) < 0.3, np.nan, shares) * np.ones(3)

    with pytest.raises(ValueError, match="not a number"):
        find_threshold(remain, 1e-2, 1e2, 0.5)


def test_pressure_of_an_area_of_contact():
    area = 0.1
    pressure = thresholds(make_wall(), TAPE, contact_area=area).pressure
    theory = Persson(make_wall().spectra[-1], correction="wang2017")
    areas = theory.area_fraction(np.array(pressure) / TAPE.plane_strain_modulus)
    assert areas == pytest.approx([area, 0.85 * area, 1.15 * area])
    # In proportion at small areas: A = (8/(pi gamma))^(1/2) p/(E* h'), gamma = 5/9.
    small = thresholds(make_wall(), TAPE, contact_area=0.005).pressure.value
    expected = 0.005 * np.sqrt(np.pi * 5 / 72) * make_spectrum().rms_slope
    assert small / TAPE.plane_strain_modulus == pytest.approx(expected, rel=1e-3)
    with pytest.raises(ValueError, match="contact_area must be in 0.005 to 0.35, got 5"):
        thresholds(make_wall(), TAPE, contact_area=5)
