"""From a surface and a material to a verdict by one call."""

import json
import warnings

import numpy as np
import pytest

from stickiness import Material, surface, verdict
from stickiness.criteria.pair import TOUCHES, WORDS
from stickiness.criteria.registry import CRITERIA, EDGES, REMAINING
from stickiness.plausibility import PlausibilityWarning
from stickiness.remaining.roughness import PULL_OFF_UNKNOWN
from stickiness.solids import Layer
from stickiness.solids.moduli import Prony
from stickiness.spectrum import SelfAffine

pytestmark = pytest.mark.usefixtures("coarse_simulation")

ROUGH = SelfAffine(hurst=0.8, q0=6e4, q1=6e8, h_rms=1e-6)
SMOOTH = SelfAffine(hurst=0.8, q0=6e4, q1=6e8, h_rms=1e-8)
GEL = {"youngs_modulus": 0.1e6, "work_of_adhesion": 0.05, "range": 3e-10}


def test_soft_sticks_and_stiff_does_not():
    soft = verdict(ROUGH, **GEL | {"youngs_modulus": 10e3})
    stiff = verdict(ROUGH, **GEL | {"youngs_modulus": 1e11})
    assert (soft.word, stiff.word) == ("sticks fully", "does not stick")
    for found in (soft, stiff):
        assert found.margins[REMAINING] == found.margin
        assert found.margins.keys() == CRITERIA.keys()
        assert found.margin == pytest.approx(
            found.modulus_threshold / float(found.cell.quoted_modulus)
        )
        low, high = np.divide(found.margin_limits, found.margin)
        assert low < 1 < high
        limits = np.divide(found.modulus_threshold_limits, found.modulus_threshold)
        np.testing.assert_allclose(limits, [low, high])


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:rms_slope")  # of the finest waves: up to 1.9
@pytest.mark.parametrize("modulus", [5e3, 30e3, 40e3, 70e3])
def test_verdict_hardly_knows_the_finest_wave(modulus):
    """Three decades of finer waves; the onset at the finest wave moves by more than a factor."""
    finest = [SelfAffine(hurst=0.8, q0=6e4, q1=q1, h_rms=1e-6) for q1 in (6e7, 6e8, 6e9, 6e10)]
    found = [verdict(s, **GEL | {"youngs_modulus": modulus}) for s in finest]
    shares = np.array([one.remaining for one in found])
    assert len({one.word for one in found}) == 1
    assert np.ptp(shares) < 0.05 * shares.max()
    onsets = [one.margins[EDGES] for one in found]
    assert max(onsets) > 3 * min(onsets)


# Acrylic foam tape VHB, shear moduli of Foo et al., J. Appl. Phys. 111, 034102 (2012) times 3.
VHB = Prony(3 * 18e3, ((3 * 42e3, 400.0),))


@pytest.mark.parametrize(("h_rms", "longest"), [(7.5e-6, 0.2e-3), (53e-6, 10e-3)])
def test_tape_holds_on_abrasive_paper_and_on_a_rough_wall_after_an_hour(h_rms, longest):
    rough = SelfAffine(hurst=0.8, q0=2 * np.pi / longest, q1=40 * np.pi / longest, h_rms=h_rms)
    tape = Material(youngs_modulus_prony=VHB, work_of_adhesion=0.07, range=3e-10)
    at_once = verdict(rough, tape)
    rested = verdict(rough, tape.replace(dwell=3600.0))
    assert (at_once.word, rested.word) == (WORDS[TOUCHES], "sticks")


def test_wanted_share_moves_the_verdict():
    little = verdict(ROUGH, **GEL, wanted_share=0.01)
    much = verdict(ROUGH, **GEL, wanted_share=0.7)
    assert little.remaining == much.remaining
    assert little.margin > verdict(ROUGH, **GEL).margin > much.margin
    with pytest.raises(ValueError, match="wanted_share must be between 0 and 1, got 1"):
        verdict(ROUGH, **GEL, wanted_share=1)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"youngs_modulus": 0.7}, r"youngs_modulus = 0\.7 .* give it in Pa"),  # MPa
        ({"work_of_adhesion": 50}, r"work_of_adhesion = 50 .* J/m\^2"),  # mJ/m^2
        ({"work_of_adhesion": 5}, r"work_of_adhesion = 5 .* an energy of peeling"),
        ({"range": 3e-12}, r"range = 3e-12 .* give it in m"),
        ({"range": 3e-7}, r"range = 3e-07 is outside 1e-11 to 1e-07"),
        ({"solid": Layer(0.03, 0.5)}, r"thickness = 0\.03 .* give it in m"),
    ],
)
def test_improbable_values_are_warned_of_and_kept_as_doubts(change, message):
    with pytest.warns(PlausibilityWarning, match=message):
        doubtful = verdict(ROUGH, **GEL | change)
    assert len(doubtful.doubts) == 1
    first, *others = str(doubtful).splitlines()
    assert first.startswith(f"{doubtful.word}: ")
    assert others[0].endswith(": 1 µm")
    assert others[-1] == f"warning: {doubtful.doubts[0]}"
    sound = verdict(ROUGH, **GEL)
    assert sound.doubts == ()
    assert "warning" not in str(sound)


def test_a_range_far_above_the_heights_is_not_judged():
    answer = verdict(SelfAffine(hurst=0.8, q0=6e4, q1=6e8, h_rms=5e-9), **GEL | {"range": 6e-8})
    assert answer.word == "not judged"
    assert len(answer.doubts) == 1
    numbers = [answer.remaining, answer.pull_off, answer.margin, answer.modulus_threshold]
    assert np.isnan(numbers).all()
    assert np.isnan(answer.remaining_limits).all()
    first, height = str(answer).splitlines()
    assert first == f"not judged: {answer.doubts[0]}"
    assert height.endswith(": 5 nm")
    contact_law = answer.to_dict()
    assert contact_law["verdict"] == "not judged"
    assert "modulus_threshold" not in contact_law
    json.dumps(contact_law, allow_nan=False)


def test_answers_for_models_have_values_limits_and_units():
    answer = verdict(ROUGH, **GEL | {"youngs_modulus": 1e6})
    contact_law = answer.to_dict()
    low, high = answer.modulus_threshold_limits
    expected = {"value": answer.modulus_threshold, "low": low, "high": high, "unit": "Pa"}
    assert contact_law["modulus_threshold"] == {"symbol": "E", **expected}
    of_theory = contact_law["plane_strain_modulus_threshold"]
    assert of_theory["symbol"] == "E*"
    assert of_theory["value"] == pytest.approx(answer.modulus_threshold / 0.75)
    work = contact_law["effective_work_of_adhesion"]
    assert work["value"] == pytest.approx(answer.remaining * 0.05)
    assert contact_law["pull_off_stress"]["value"] == answer.pull_off
    # Near full contact only a low limit of the pull-off is known.
    nearly_full = verdict(SMOOTH, **GEL | {"youngs_modulus": 1e4})
    assert nearly_full.energy_ratio > PULL_OFF_UNKNOWN
    pull_off = nearly_full.to_dict()["pull_off_stress"]
    assert pull_off == {"low": nearly_full.pull_off_limits[0], "unit": "Pa"}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("known", "length", "factor", "messages"),
    [
        ({"q0": 1e3, "q1": 6e4, "h_rms": 1e-3}, 2e-3 * np.pi, 1, ["small slopes are assumed"]),
        (  # slopes as of 1 um on 2 mm
            {"q0": np.pi, "q1": 30, "h_rms": 1e-3},
            *(2, 1),
            ["length = 2 is outside 1e-09 to 0.5", "in m (2e-3 for 2 mm)"],
        ),
        (
            {"hurst": 0.3, "q0": 6e3, "q1": 2e5, "h_rms": 1e-6},
            *(2 * np.pi / 6e3, 1),
            ["waves that the instrument does not resolve decide"],
        ),
    ],
)
def test_heights_that_no_surface_has_are_warned_of(known, length, factor, messages):
    heights = factor * surface.synthesise(SelfAffine(**{"hurst": 0.8} | known), 128, length, 1)
    with pytest.warns(PlausibilityWarning) as caught:
        verdict(heights, length=length, **GEL)
    found = " ".join(str(warning.message) for warning in caught)
    assert all(message in found for message in messages), found


@pytest.mark.parametrize(("slope", "warned"), [(0.98, False), (1.02, True)])
def test_slopes_that_are_not_small_are_warned_of(slope, warned):
    s = SelfAffine(hurst=0.8, q0=6e4, q1=6e8, h_rms=1e-6 * slope / ROUGH.rms_slope)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        answer = verdict(s, **GEL)
    told = [str(one.message).partition("; ")[0] for one in caught]
    assert told == warned * ["rms_slope = 1.02 is outside 1e-07 to 1: small slopes are assumed"]
    assert ("doubtful" in str(answer).splitlines()[0]) == warned
