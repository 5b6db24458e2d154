"""From limits of the share to words, and which error is the widest."""

import numpy as np
import pytest

from stickiness import Surface, verdict
from stickiness.criteria.pair import WORDS, decide
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.spectrum import SelfAffine
from stickiness.statistics import COVERS
from stickiness.surface import synthesise
from stickiness.verdicts.wording import tell_widest

pytestmark = pytest.mark.usefixtures("coarse_simulation")


@pytest.mark.parametrize(
    ("low", "high", "grows", "expected"),
    [
        (0.8, 1.0, True, "sticks fully"),
        (0.79, 1.0, False, "sticks"),  # the onset does not matter here
        (0.1, 0.2, False, "sticks"),
        (0.09, 1.0, True, "depends"),
        (0.0, 0.1, False, "depends"),
        (0.0, 0.09, True, "adheres locally, does not hold"),
        (0.0, 0.09, False, "does not stick"),
    ],
)
def test_word_follows_from_the_limits_of_the_share(low, high, grows, expected):
    assert WORDS[int(decide(low, high, grows, DEFAULT_SHARE))] == expected


@pytest.mark.parametrize(
    ("known", "widest", "remedy"),
    [
        ({}, "spectrum", "a finer map"),
        ({"extend_to": 0.25e-6}, "map", "a larger map"),  # there are no shorter waves
    ],
)
@pytest.mark.filterwarnings("ignore::stickiness.plausibility.PlausibilityWarning")
def test_errors_of_a_map_add_up_and_the_widest_is_named(known, widest, remedy):
    side = 4e-6
    waves = SelfAffine(hurst=0.5, q0=4 * np.pi / side, q1=32 * np.pi / side, h_rms=5e-9)
    heights = synthesise(waves, 128, side, seed=3)
    rough = Surface.from_heights(heights, length=side, detrend="mean", window="none", **known)
    cell = verdict(rough, youngs_modulus=3e7, work_of_adhesion=0.05, range=3e-10).cell
    errors = {name: float(cell[f"error_of_{name}"]) for name in ("spectrum", "map", "model")}
    assert max(errors, key=errors.get) == widest
    assert remedy in tell_widest(cell)
    # In quadrature they are the error of the margin, whose limits cover 90 %.
    low, _, high = np.log(cell.margin.values)
    total = np.hypot.reduce(list(errors.values()))
    assert total == pytest.approx((high - low) / 2 / COVERS, rel=0.25)
