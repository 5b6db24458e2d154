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
FREQUENCIES = np.geomspace(1e-4, 1e4, 5)
SERIES = {"equilibrium": "20 kPa", "terms": [["0.1 MPa", "1 s"], ["10 MPa", "1 ms"]]}
TABLE = [["1 mHz", "10 kPa"], ["1 Hz", "0.2 MPa"], ["100 Hz", "1 MPa"], ["1 kHz", "0.5 MPa"]]


def random_materials(rng, number):
    """Entries of materials of every kind: moduli, layers, dwell, pressure, roughness, law."""
    found = {}
    for name in map(str, range(number)):
        entry = {"label": name, "work_of_adhesion": f"{10 ** rng.uniform(-2, 0):.3g} J/m^2"}
        entry |= {"range": f"{10 ** rng.uniform(-10, -7.5):.3g} m", "poisson_ratio": 0.5}
        kind = rng.integers(4)
        entry |= (
            {"youngs_modulus_prony": SERIES},
            {"youngs_modulus_table": TABLE},
            *[{"youngs_modulus": f"{10 ** rng.uniform(3, 8):.3g} Pa"}] * 2,
        )[kind]
        if kind < 2 and rng.random() < 0.5:
            entry |= {"dwell": "10 s", "broken_at": "10 Hz"}
        backing = rng.integers(4)
        if backing < 3:
            entry["thickness"] = f"{10 ** rng.uniform(-0.5, 2.5):.3g} um"
            film = {"youngs_modulus": "1 GPa", "poisson_ratio": 0.4}
            film["thickness"] = f"{10 ** rng.uniform(0, 2):.3g} um"
            entry["backing"] = ("bonded", "slip", film)[backing]
        entry |= {"pressed": "1 MPa"} if rng.random() < 0.3 else {}
        entry |= {"surface": "given"} if rng.random() < 0.2 else {}
        found[name] = entry | {"law": rng.choice(["exponential", "van_der_waals"])}
    return found


def random_wall(rng, draws):
    """Analysed surface, with draws if it was measured."""
    q0, h = 2 * np.pi / 10 ** rng.uniform(-4, -2), 10 ** rng.uniform(-7.5, -5)
    both = [SelfAffine(hurst=0.8, q0=q0, q1=1e3 * q0, h_rms=f * h) for f in (0.8, 1.2)]
    q = np.geomspace(q0, 1e3 * q0, 30)
    both = [Tabulated(q, one.psd(q)) for one in both]
    names = ("h_rms", "rms_slope", "rms_curvature")
    data = {name: ("end", [getattr(one, name) for one in both]) for name in names}
    data["elastic_energy"] = "end", [one.elastic_energy() for one in both]
    data["psd"] = ("end", "wave_number"), [one.psd(q) for one in both]
    if draws:
        factor = np.exp(0.2 * rng.normal(size=draws))
        energy = data["elastic_energy"][1]
        data["h_rms_draws"] = "draw", h * factor
        data["elastic_energy_draws"] = "draw", factor**2 * np.sqrt(np.prod(energy))
        data["q0_draws"] = "draw", q0 * np.exp(0.1 * rng.normal(size=draws))
    found = xr.Dataset(data, coords={"end": list(ENDS), "wave_number": q})
    return found.assign(q0=q0, q1=q[-1], hurst=0.8, axis_ratio=rng.choice([1.0, 3.0]))


@pytest.fixture(scope="module")
def judged():
    """Entries of random materials, and verdicts on random surfaces."""
    rng = np.random.default_rng(5)
    entries = random_materials(rng, 30)
    surfaces = {"given": random_wall(rng, 0), "smooth": random_wall(rng, 0)}
    surfaces |= {f"measured {i}": random_wall(rng, 60) for i in range(3)}
    solids = {name: read_material(entry) for name, entry in entries.items()}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(verdicts, "find_a_v", lambda surface: (A_V, A_V))
        patch.setattr(pair_roughness, "find_end_a_v", lambda *given: A_V)
        for axis in ("MODULUS", "ROUGHNESS", "DWELL"):  # of curves, which take most of the time
            patch.setattr(verdicts, f"{axis}_FACTORS", np.ones(1))
        return entries, verdicts.find_verdicts(solids, surfaces, surfaces, FREQUENCIES)


@pytest.mark.slow
def test_values_lie_within_limits(judged):
    _, found = judged
    for name in LIMITED:
        low, high = find_limits(found, name)
        one = found.sel(criterion=REMAINING) if name == "margin" else found
        value = find_value(one, name)
        assert ((low <= value * (1 + 1e-9)) & (value <= high * (1 + 1e-9))).all(), name
        for end in ENDS:
            three = [one[f"{name}{x}"].sel(end=end) for x in ("_low", "", "_high")]
            assert (three[0] <= three[1] * (1 + 1e-9)).all(), name
            assert (three[1] <= three[2] * (1 + 1e-9)).all(), name


@pytest.mark.slow
def test_share_margin_threshold_and_probability_say_the_same(judged):
    """Without any tolerance: there are no ties among random numbers."""
    _, found = judged
    low, high = find_limits(found)
    words = np.array(WORDS)[found.verdict.values]
    assert {word: (words == word).any() for word in WORDS[:5]} == dict.fromkeys(WORDS[:5], True)
    for limit, margin in zip((low, high), find_limits(found, "margin"), strict=True):
        np.testing.assert_array_equal(limit >= DEFAULT_SHARE, margin >= 1)
    thresholds = find_limits(found, "modulus_threshold")
    for margin, threshold in zip(find_limits(found, "margin"), thresholds, strict=True):
        np.testing.assert_allclose(margin * found.modulus_quoted, threshold, rtol=1e-12)
    sticks = np.isin(words, ["sticks", "sticks fully"])
    np.testing.assert_array_equal(sticks, low >= DEFAULT_SHARE)
    np.testing.assert_array_equal(words == "sticks fully", low >= FULL_SHARE)
    np.testing.assert_array_equal(
        words == "depends", (low < DEFAULT_SHARE) & ~(high < DEFAULT_SHARE)
    )
    drawn = np.isfinite(found.probability).values
    assert 0 < drawn.sum() < drawn.size
    np.testing.assert_array_equal(sticks[drawn], (found.probability_low > 0.95).values[drawn])
    no = np.isin(words, ["does not stick", "sticks only locally"])
    np.testing.assert_array_equal(no[drawn], (found.probability <= 0.05).values[drawn])
    strained = (found.layer_strain > MOST_STRAIN).any("end").values
    assert (found.probability_low <= found.probability).values[drawn].all()
    assert (found.probability_low < found.probability).values[drawn & strained].any()
    assert ((low == 0) & (thresholds[0] == 0)).values[~drawn & strained].all()


@pytest.mark.slow
def test_texts_do_not_contradict_the_verdict(judged):
    entries, found = judged
    for name, entry in entries.items():
        for surface in found.surface.values:
            pair = found.sel(material=name, surface=surface)
            row, (low, high) = describe_pair(pair, entry), find_limits(pair)
            for text in (*row["text"].values(), row["threshold"], row["modulus"]):
                assert not re.search(r"nan|\(–|– \(|to –|inf", text), text
                assert text != "–" or np.isnan(pair.probability)
            if row["word"] == "depends":
                assert row["text"]["probability"][0] not in "<>"
                assert row["unknown"] in ("layer", "surface", "model")
            # The modulus is told from the limits at which the verdict changes.
            texts = [row["modulus"], row["sticks_below"], row["fails_above"]]
            unit = 1 - entry["poisson_ratio"] ** 2
            given, *bounds = (read_shown(text) / unit if text else np.nan for text in texts)
            assert given == pytest.approx(float(pair.modulus_quoted), rel=0.01)
            for bound, limit in zip(bounds, (low, high), strict=True):
                if np.isfinite(bound):
                    assert (bound >= given) == (limit >= DEFAULT_SHARE)


def read_shown(text):
    """Pa of a modulus as shown, such as "E = 0.2 MPa"."""
    number, unit = re.fullmatch(r"E\*? = (.+) (\w*Pa)", text).groups()
    digits = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
    number = re.sub(r"^10(?=[⁻⁰-⁹¹²³])", "1 × 10", number).translate(digits)
    return float(number.replace(" × 10", "e")) * {"": 1, "k": 1e3, "M": 1e6, "G": 1e9}[unit[:-2]]
