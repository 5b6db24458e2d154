"""Questions that a measurement leaves open: asked where they decide, harmless elsewhere."""

import json

import numpy as np
import pytest

from stickiness import Material, Surface, judge, surface
from stickiness.command import name_options
from stickiness.spectrum import SelfAffine
from stickiness.verdicts.limits import HIGH, LOW
from stickiness.verdicts.pair_variables import DIMENSIONS
from stickiness.verdicts.verdict import StickinessVerdict, verdict

pytestmark = pytest.mark.usefixtures("coarse_simulation")
SIDE = 200e-6
TAPE = Material(youngs_modulus=150e6, work_of_adhesion=0.05, range=0.3e-9)


def read(heights, **options):
    """The surface of heights whose shortest waves are told."""
    options = {"features": "keep", "extend_to": "6 um"} | options
    return Surface.from_heights(heights, SIDE, **options)


@pytest.fixture(scope="module")
def film():
    """Heights with the edge of a film of ten times their rms parallel to the rows."""
    rough = SelfAffine(
        hurst=0.8,
        q0=8 * np.pi / SIDE,
        q1=64 * np.pi / SIDE,
        q_rolloff=16 * np.pi / SIDE,
        h_rms=5e-8,
    )
    heights = surface.synthesise(rough, 128, SIDE, seed=3)
    return heights, np.where(np.arange(128) >= 57, 5e-7, 0.0)


def test_a_step_along_the_rows_is_a_question(film):
    heights, step = film
    tape = TAPE.replace(youngs_modulus=162e6)
    for faulty in (heights + step, (heights + step).T, heights[::-1] - step):
        asked = verdict(read(faulty), tape)
        kept, mended = (verdict(read(faulty, scan=scan), tape) for scan in ("keep", "mend"))
        assert asked.word == "depends"
        assert mended.word == "sticks"
        assert kept.word in ("does not stick", "adheres locally, does not hold")
        (question,) = asked.questions
        assert "500 nm" in question["question"]
        assert [answer["give"] for answer in question["answers"]] == [
            {"scan": "mend"},
            {"scan": "keep"},
        ]
        for answer, alone in zip(question["answers"], (mended, kept), strict=True):
            assert alone.questions == []
            assert answer["verdict"] == alone.word
            assert answer["remaining"][1] == alone.remaining
            # Limits hold whichever answer is right.
            for low, high, own in (
                (*asked.remaining_limits, alone.remaining_limits),
                (*asked.pull_off_limits, alone.pull_off_limits),
                (*asked.modulus_threshold_limits, alone.modulus_threshold_limits),
            ):
                assert low <= own[0] <= own[1] <= high


def test_curves_and_thresholds_contain_both_answers(film):
    heights, step = film
    both, mended, kept = (
        judge([TAPE], [read(heights + step, scan=scan)]) for scan in ("detect", "mend", "keep")
    )
    checked = [name for name, dims in DIMENSIONS.items() if "limit" in dims and name in both]
    assert len(checked) > 8
    for name in checked:
        for alone in (mended, kept):
            low, high = (both[name].isel(limit=place).values for place in (LOW, HIGH))
            assert not (alone[name].isel(limit=LOW).values < low).any(), name
            assert not (alone[name].isel(limit=HIGH).values > high).any(), name


def test_a_small_turn_turns_no_verdict(film):
    """Turned by 2 degrees, an edge is no jump: it is kept, and its answer is one of both."""
    heights, step = film
    x, y = np.indices(heights.shape)
    turned = heights + np.where(x - 57 - np.tan(np.radians(2)) * (y - 64) >= 0, 5e-7, 0.0)
    of_turned = verdict(read(turned), TAPE)
    asked = verdict(read(heights + step), TAPE)
    assert of_turned.questions == []
    low, high = asked.modulus_threshold_limits
    assert low < of_turned.modulus_threshold < high
    kept = asked.questions[0]["answers"][1]["modulus_threshold"][1]
    assert of_turned.modulus_threshold == pytest.approx(kept, rel=0.15)


def test_a_harmless_question_is_not_asked(film):
    heights, step = film
    small = read(heights + step / 6)
    (reading,) = small.readings
    assert "did the probe jump" in reading.guess.question
    answer = verdict(small, TAPE)
    assert answer.questions == []
    assert any("moved back" in doubt for doubt in answer.doubts)
    assert answer.word == verdict(read(heights), TAPE).word


def test_files_and_json_keep_questions(film, tmp_path):
    heights, step = film
    made = read(heights + step)
    made.write(tmp_path / "wall.nc", title="wall", parameters={})
    opened = Surface.open(tmp_path / "wall.nc")
    verdicts = [
        StickinessVerdict(judge([TAPE], [each], curves=False).isel(material=0, surface=0))
        for each in (made, opened)
    ]
    assert verdicts[0].word == verdicts[1].word == "depends"
    assert verdicts[0].questions[0]["question"] == verdicts[1].questions[0]["question"]
    limits = [each.modulus_threshold_limits for each in verdicts]
    assert limits[0] == pytest.approx(limits[1], rel=1e-9)
    told = json.loads(json.dumps(verdicts[0].to_dict(), allow_nan=False))
    (question,) = told["questions"]
    first, second = question["answers"]
    assert first["modulus_threshold"]["value"] > second["modulus_threshold"]["value"]
    text = name_options(str(verdicts[0]))
    assert "(give --scan mend): sticks" in text
    assert "(give --scan keep): " in text


def test_sure_mends_ask_nothing(film):
    heights, _ = film
    offsets = 1e-7 * np.random.default_rng(1).standard_normal(128)
    rows = read(heights + offsets)
    assert rows.readings == ()
    assert "random heights" in rows.data.attrs["remarks"]


def test_a_feature_is_a_question(film):
    """A particle decides; the part beside it tells of the surface elsewhere."""
    heights, _ = film
    x = np.arange(128)[:, None]
    particle = heights + 2e-6 * np.exp(-((x - 110) ** 2 + (x.T - 20) ** 2) / 60)
    asked = verdict(read(particle, features="detect"), TAPE)
    assert asked.word == "depends"
    (question,) = asked.questions
    assert question["question"].startswith("a raised patch around x = 180 µm, y = ")
    answers = {answer["give"]["features"]: answer for answer in question["answers"]}
    assert answers["beside"]["verdict"] == verdict(read(heights), TAPE).word == "sticks"
    beside = read(particle, features="beside")
    assert beside.readings == ()
    assert beside.scan < SIDE
    alone = verdict(beside, TAPE)
    assert alone.remaining == answers["beside"]["remaining"][1]
    low, high = alone.modulus_threshold_limits
    assert low < verdict(read(heights), TAPE).modulus_threshold < high


def test_a_part_that_is_too_small_is_not_judged(film):
    """A step in the middle leaves less than 64 points on either side."""
    heights, _ = film
    step = heights + 1e-6 * (np.arange(128)[:, None] + np.arange(128) > 128)
    answer = verdict(read(step, features="beside"), TAPE)
    assert answer.word == "not judged"
    assert "too few to judge (64 a side)" in answer.not_judged[0]


def test_a_feature_forbids_a_larger_contact(film):
    heights, step = film
    larger = {"contact": "2 mm"}
    answer = verdict(
        read(heights + step[:, None] * 2, features="detect", scan="keep", **larger), TAPE
    )
    assert answer.word == "not judged"
    assert "give features: beside" in answer.not_judged[0]
    even = verdict(read(heights, features="detect", **larger), TAPE)
    assert even.word != "not judged"


def test_where_waves_end_is_asked_where_that_decides():
    """An answer as measured is that of a surface whose waves are told to end there."""
    waves = SelfAffine(hurst=0.8, q0=8 * np.pi / SIDE, q1=128 * np.pi / SIDE, h_rms=15e-8)
    heights = surface.synthesise(waves, 128, SIDE, seed=3)
    rough = Surface.from_heights(heights, SIDE)
    told = Surface.from_heights(heights, SIDE, extend_to=1.005 * rough.shortest_resolved)
    assert told.as_measured is None
    asked = []
    for modulus in np.geomspace(8e6, 8e7, 40):
        tape = Material(youngs_modulus=modulus, work_of_adhesion=0.05, range=0.3e-9)
        open_ended, ended = (
            StickinessVerdict(judge([tape], [each], curves=False).isel(material=0, surface=0))
            for each in (rough, told)
        )
        if not open_ended.questions:
            assert open_ended.word != "depends" or ended.word == "depends"
            continue
        asked.append(modulus)
        assert open_ended.word == "depends" != ended.word
        (question,) = open_ended.questions
        go_on, end = question["answers"]
        assert go_on["verdict"] == "depends"
        assert go_on["give"] == {}
        assert end["verdict"] == ended.word
        assert end["remaining"][1] == pytest.approx(ended.remaining, rel=1e-4)
        limits = ended.modulus_threshold_limits
        assert (end["modulus_threshold"][0], end["modulus_threshold"][2]) == pytest.approx(
            limits, rel=1e-4
        )
    assert len(asked) >= 2
