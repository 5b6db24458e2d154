"""The verdict, the share, the probability, the margin and the threshold of a pair agree."""

import re
from itertools import product

import numpy as np
import pytest
from helpers.analysed import A_V, fix_a_v, wall

from common.materials import read_material
from common.verdicts import find_limits, find_value
from criteria import pair_roughness, verdicts
from criteria.thresholds import find_thresholds
from report.table_rows import describe_pair
from stickiness.criteria.pair import FULL_SHARE, MOST_STRAIN, SIGNS, WORDS
from stickiness.criteria.registry import REMAINING
from stickiness.remaining.prediction import DEFAULT_SHARE
from stickiness.solids import HALF_SPACE
from stickiness.units import si

LIMITED = ("remaining", "pull_off", "margin", "modulus_threshold")
FILM = {"youngs_modulus": "1 GPa", "poisson_ratio": 0.4, "thickness": "20 um"}
SERIES = {"equilibrium": "20 kPa", "terms": [["0.1 MPa", "1 s"], ["10 MPa", "1 ms"]]}
TABLE = [["1 mHz", "10 kPa"], ["1 Hz", "0.2 MPa"], ["100 Hz", "1 MPa"], ["1 kHz", "0.5 MPa"]]


def make_material(rng):
    """Entry of any kind: modulus, layer, dwell, pressure, roughness and law are drawn."""
    entry = {"work_of_adhesion": f"{10 ** rng.uniform(-2, 0)!r} J/m^2", "poisson_ratio": 0.5}
    entry |= {"range": f"{10 ** rng.uniform(-10, -7.5)!r} m"}
    rated = rng.random() < 0.5
    if not rated:
        entry["youngs_modulus"] = f"{10 ** rng.uniform(3, 8)!r} Pa"
    else:
        forms = {"youngs_modulus_prony": SERIES}, {"youngs_modulus_table": TABLE}
        entry |= forms[rng.integers(2)]
    if rng.random() < 0.7:
        entry["thickness"] = f"{10 ** rng.uniform(-0.5, 2.5)!r} um"
        entry["backing"] = ("bonded", "slip", FILM)[rng.integers(3)]
    options = {"dwell": "10 s"} if rated else {}, {"pressed": "1 MPa"}, {"surface": "given"}
    for option in (*options, {"law": "van_der_waals"}):
        entry |= option if rng.random() < 0.3 else {}
    return entry


def make_wall(rng, draws):
    """Analysed surface, with draws if it was measured."""
    longest, h_rms = 10 ** rng.uniform(-4, -2), 10 ** rng.uniform(-7.5, -5)
    spread = {"draws": draws, "apart": 1.5, "scatter": 0.2}
    more = {"longest": longest, "shortest": 1e-3 * longest, "axis_ratio": rng.choice([1.0, 3.0])}
    return wall(0.8 * h_rms, **spread, **more)


@pytest.fixture(scope="module")
def judged():
    """Entries of materials, verdicts on surfaces, and thresholds on two of these."""
    rng = np.random.default_rng(5)
    entries = {str(i): make_material(rng) for i in range(30)}
    walls = {name: make_wall(rng, 60 * (name < "given")) for name in ("a", "b", "c", "given", "x")}
    solids = {name: read_material(entry) for name, entry in entries.items()}
    with pytest.MonkeyPatch.context() as patch:
        fix_a_v(patch)
        patch.setattr(pair_roughness, "find_end_a_v", lambda *given: A_V)
        for axis in ("MODULUS", "ROUGHNESS", "DWELL"):  # of curves, which take most of the time
            patch.setattr(verdicts, f"{axis}_FACTORS", np.ones(1))
        found = verdicts.find_verdicts(solids, walls, walls, np.geomspace(1e-4, 1e4, 5))
        some = dict(list(entries.items())[:15])
        thresholds = [
            find_thresholds(found.sel(surface=[on], material=list(some)), walls[on], walls, some)
            for on in ("a", "given")
        ]
        return entries, found, thresholds


@pytest.mark.slow
def test_values_lie_within_limits(judged):
    for name in LIMITED:
        found = judged[1].sel(criterion=REMAINING) if name == "margin" else judged[1]
        triples = [
            (find_limits(found, name)[0], find_value(found, name), find_limits(found, name)[1])
        ]
        triples.append([found[f"{name}{ending}"] for ending in ("_low", "", "_high")])
        for low, value, high in triples:
            assert ((low <= value * (1 + 1e-9)) & (value <= high * (1 + 1e-9))).all(), name


@pytest.mark.slow
def test_share_margin_threshold_and_probability_say_the_same(judged):
    """Without any tolerance: there are no ties among random numbers."""
    found, agree = judged[1], np.testing.assert_array_equal
    low, high = find_limits(found)
    words = np.array(WORDS)[found.verdict.values]
    assert set(words.ravel()) == set(WORDS[:5])
    margins, thresholds = (find_limits(found, name) for name in ("margin", "modulus_threshold"))
    for limit, margin, threshold in zip((low, high), margins, thresholds, strict=True):
        agree(limit >= DEFAULT_SHARE, margin >= 1)
        np.testing.assert_allclose(margin * found.modulus_quoted, threshold, rtol=1e-12)
    values = find_value(found), find_value(found, "modulus_threshold")
    agree(values[0] >= DEFAULT_SHARE, values[1] >= found.modulus_quoted)
    sticks = np.isin(words, ["sticks", "sticks fully"])
    no = np.isin(words, ["does not stick", "adheres locally, does not hold"])
    agree(sticks, low >= DEFAULT_SHARE)
    agree(no, high < DEFAULT_SHARE)
    agree(words == "sticks fully", low >= FULL_SHARE)
    drawn = np.isfinite(found.probability).values
    least, most = found.probability_low.values[drawn], found.probability.values[drawn]
    agree(sticks[drawn], least > 0.95)
    agree(no[drawn], most <= 0.05)
    strained = (found.layer_strain > MOST_STRAIN).any("end").values
    assert (least <= most).all()
    # Draws scatter about both ends of the surface by less than a factor of ten in strain.
    far = (found.layer_strain > 10 * MOST_STRAIN).all("end").values[drawn]
    assert (most[far] > 0.95).any()
    assert (least[far] == 0).all()
    assert ((low == 0) & (thresholds[0] == 0)).values[~drawn & strained].all()


@pytest.mark.slow
def test_pairs_are_on_the_same_side_of_all_thresholds_as_their_shares(judged):
    words, outside = set(), []
    for found, material in product(judged[2], judged[2][0].material.values):
        pair, solid = found.sel(material=material).squeeze(), read_material(judged[0][material])
        low, high = (float(limit) >= DEFAULT_SHARE for limit in find_limits(pair))
        words.add((low, high))
        (value, least, most), (_, slowest, fastest), (_, thinnest, thickest) = (
            [float(pair[f"{asked}_threshold{end}"]) for end in SIGNS]
            for asked in ("rms_height", "rate", "thickness")
        )
        drawn = bool(np.isfinite(pair.probability))
        height = float(np.sqrt(pair.pair_h_rms.prod()) if drawn else pair.pair_h_rms[-1])
        assert least <= value <= most
        assert (least > height, most > height) == (low, high)
        assert np.isnan(fastest) == (not solid.depends_on_rate or np.isfinite(solid.dwell))
        assert np.isnan(fastest) or (slowest > 1, fastest > 1) == (low, high)
        assert np.isnan(thickest) == (solid.solid == HALF_SPACE)
        if solid.solid != HALF_SPACE:
            thickness = solid.solid.thickness
            # Between its limits a layer on a film may stick where thicker ones do not.
            assert low >= (thickest < thickness)
            assert high <= (thinnest < thickness)
            outside.append(not thinnest < thickness < thickest)
    assert len(words) == 3
    assert sum(outside) > 3


@pytest.mark.slow
def test_texts_do_not_contradict_the_verdict(judged):
    for name, entry in judged[0].items():
        for surface in judged[1].surface.values:
            pair = judged[1].sel(material=name, surface=surface)
            row, shares = describe_pair(pair, entry), find_limits(pair)
            for text in (*row["text"].values(), row["threshold"], row["modulus"]):
                assert not re.search(r"nan|\(–|– \(|to –|inf", text), text
                assert text != "–" or np.isnan(pair.probability)
            assert len(set(re.findall(r"\w?Pa", row["threshold"]))) <= 1  # one unit
            if row["word"] == "depends":
                assert row["text"]["probability"][0] not in "<>"
                assert row["unknown"] in ("layer", "surface", "model")
            # As shown, the modulus is on the same side of the limits as the share.
            given = read_shown(row["modulus"])
            assert given == pytest.approx(0.75 * float(pair.modulus_quoted), rel=0.01)
            for text, share in zip((row["sticks_below"], row["fails_above"]), shares, strict=True):
                assert not text or (read_shown(text) >= given) == (share >= DEFAULT_SHARE)


def read_shown(text):
    """Pa of a modulus as shown, such as "E = 0.2 MPa"."""
    digits = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
    number = re.sub("^10(?=[⁻⁰¹²³⁴-⁹])", "1 × 10", text.removeprefix("E = "))
    return si(number.translate(digits).replace(" × 10", "e"), "Pa")
