"""The verdict, the share, the probability, the margin and the threshold of a pair agree."""

import re

import numpy as np
import pytest
import xarray as xr

from common.materials import read_material
from common.verdicts import find_limits, find_value
from criteria import pair_roughness, verdicts
from criteria.pair_roughness import ENDS
from report.table_rows import describe_pair
from stickiness.criteria.a_v_table import SurfaceAv
from stickiness.criteria.pair import FULL_SHARE, MOST_STRAIN, WORDS
from stickiness.criteria.registry import REMAINING
from stickiness.remaining.prediction import DEFAULT_SHARE
from stickiness.spectrum import SelfAffine, Tabulated

A_V = SurfaceAv(np.array([1e-12, 1.0]), np.full((2, 2), 3.0), 0.1)
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
    q0, h = 2 * np.pi / 10 ** rng.uniform(-4, -2), 10 ** rng.uniform(-7.5, -5)
    q = np.geomspace(q0, 1e3 * q0, 30)
    both = [SelfAffine(hurst=0.8, q0=q0, q1=q[-1], h_rms=f * h) for f in (0.8, 1.2)]
    both = [Tabulated(q, one.psd(q)) for one in both]
    names = ("h_rms", "rms_slope", "rms_curvature")
    data = {name: ("end", [getattr(one, name) for one in both]) for name in names}
    data["elastic_energy"] = "end", [one.elastic_energy() for one in both]
    data["psd"] = ("end", "wave_number"), [one.psd(q) for one in both]
    if draws:
        factor = np.exp(0.2 * rng.normal(size=draws))
        energy = np.sqrt(np.prod(data["elastic_energy"][1]))
        drawn = {"h_rms": h * factor, "elastic_energy": factor**2 * energy}
        drawn["q0"] = q0 * np.exp(0.1 * rng.normal(size=draws))
        data |= {f"{name}_draws": ("draw", values) for name, values in drawn.items()}
    found = xr.Dataset(data, coords={"end": list(ENDS), "wave_number": q})
    return found.assign(q0=q0, q1=q[-1], hurst=0.8, axis_ratio=rng.choice([1.0, 3.0]))


@pytest.fixture(scope="module")
def judged():
    """Entries of materials, and verdicts on surfaces."""
    rng = np.random.default_rng(5)
    entries = {str(i): make_material(rng) for i in range(30)}
    walls = {name: make_wall(rng, 60 * (name < "given")) for name in ("a", "b", "c", "given", "x")}
    solids = {name: read_material(entry) for name, entry in entries.items()}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(verdicts, "find_a_v", lambda surface: (A_V, A_V))
        patch.setattr(pair_roughness, "find_end_a_v", lambda *given: A_V)
        for axis in ("MODULUS", "ROUGHNESS", "DWELL"):  # of curves, which take most of the time
            patch.setattr(verdicts, f"{axis}_FACTORS", np.ones(1))
        return entries, verdicts.find_verdicts(solids, walls, walls, np.geomspace(1e-4, 1e4, 5))


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
    number, prefix = re.fullmatch(r"E = (.+) (\w?)Pa", text).groups()
    digits = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
    number = re.sub("^10(?=[⁻⁰¹²³⁴-⁹])", "1 × 10", number).translate(digits).replace(" × 10", "e")
    return float(number) * {"": 1, "k": 1e3, "M": 1e6, "G": 1e9}[prefix]
