"""What remains along the modulus, the heights and the rate."""

from functools import cache

import numpy as np
import pytest
from helpers.analysed import wall

from stickiness import Material, judge
from stickiness.remaining import predict
from stickiness.solids import Layer
from stickiness.solids.moduli import Prony, Table
from stickiness.spectrum import SelfAffine
from stickiness.verdicts.curves import DWELL_FACTORS, MODULUS_FACTORS, ROUGHNESS_FACTORS

pytestmark = pytest.mark.usefixtures("coarse_simulation")

HEIGHTS = np.array([1e-6, 1.5e-6])
Q0 = 6e4
TAPE = Material(youngs_modulus=0.4e6, work_of_adhesion=0.07, range=3e-9)
SLOW = TAPE.replace(youngs_modulus_prony=Prony(0.1e6, ((0.5e6, 0.1), (1e9, 1e-6))))
RESTED = SLOW.replace(dwell=0.2)
THICK = 40e-6  # of a layer that can take the heights [m]
THIN = 7e-6  # of one that cannot
FREQUENCIES = np.geomspace(1e-4, 1e6, 21)
DRAWS = 60


def make_spectrum(h_rms):
    return SelfAffine(hurst=0.8, q0=Q0, q1=1e3 * Q0, h_rms=h_rms)


@cache
def make_surface(drawn):
    """Surface between two spectra, with spectra drawn around the first if it was measured."""
    smooth, rough = HEIGHTS
    band = {"longest": 2 * np.pi / Q0, "shortest": 2e-3 * np.pi / Q0}
    return wall(smooth, draws=DRAWS * drawn, apart=rough / smooth, scatter=0.35, **band)


def judge_on_surface(materials, drawn, frequencies=(1.0,)):
    surfaces = {"wall": make_surface(drawn)}
    dataset = judge(materials, surfaces, frequencies=frequencies, thresholds=False)
    return dataset.sel(surface="wall")


@cache
def follow(drawn, thickness=THICK):
    """Curves beside what is stored of the pairs."""
    layer = TAPE.replace(solid=Layer(thickness, 0.5))
    materials = {"tape": TAPE, "slow": SLOW, "layer": layer, "rested": RESTED}
    return judge_on_surface(materials, drawn, FREQUENCIES)


def judge_at(moduli, drawn):
    """Share of the tape at these E* [Pa], with its limits, ``(modulus, limit)``."""
    tapes = [TAPE.replace(youngs_modulus=0.75 * float(modulus)) for modulus in moduli]
    return judge_on_surface(tapes, drawn).remaining


@pytest.fixture(scope="module", params=[False, True], ids=["given", "measured"])
def drawn(request):
    return request.param


@pytest.mark.slow
@pytest.mark.parametrize(
    ("axis", "dimension", "points"),
    [
        ("modulus", "modulus_factor", MODULUS_FACTORS),
        ("roughness", "roughness_factor", ROUGHNESS_FACTORS),
        ("rate", "frequency", FREQUENCIES),
        ("dwell", "dwell_factor", DWELL_FACTORS),
    ],
)
@pytest.mark.parametrize("thickness", [THICK, THIN])
def test_at_the_pair_itself_curves_are_what_is_stored(drawn, thickness, axis, dimension, points):
    dataset = follow(drawn, thickness)
    pair_itself = dataset.isel({dimension: np.argmin(abs(np.log(points)))})
    rested = dataset.material == "rested"
    followed = {"rate": ~rested, "dwell": rested}.get(axis, rested | True)
    np.testing.assert_allclose(
        pair_itself[f"remaining_by_{axis}"].sel(material=followed),
        dataset.remaining.sel(material=followed),
        rtol=1e-9,
    )
    low, value, _ = dataset.remaining.transpose("limit", ...)
    slow = value.sel(material=~rested)  # after a dwell, half of the draws are pulled off fast
    assert (slow > 0.01).all()
    assert (slow < 0.99).all()
    assert (float(low.sel(material="layer")) == 0) == (thickness == THIN)


@pytest.mark.parametrize("place", [0, 10, 20, 32])
def test_a_factor_on_the_heights_is_another_surface(place):
    length = TAPE.work_of_adhesion / TAPE.plane_strain_modulus
    smooth, rough = (make_spectrum(h * ROUGHNESS_FACTORS[place]) for h in HEIGHTS)
    expected = [
        predict(rough, length, TAPE.range).separation_limits[0],
        predict(rough, length, TAPE.range).separation,
        predict(smooth, length, TAPE.range).approach_limits[1],
    ]
    curve = follow(drawn=False).remaining_by_roughness.sel(material="tape")
    np.testing.assert_allclose(curve.isel(roughness_factor=place), expected, rtol=1e-9)


def test_the_rate_counts_by_the_modulus(drawn):
    moduli = SLOW.plane_strain.storage(FREQUENCIES)
    slow = follow(drawn).sel(material="slow")
    np.testing.assert_allclose(slow.remaining_by_rate, judge_at(moduli, drawn), rtol=1e-9)


@pytest.mark.parametrize("factor", [1e-4, 1.0, 1e3])
def test_the_dwell_counts_by_the_relaxed_modulus(drawn, factor):
    """Curves of dwells are verdicts of materials with these dwells."""
    other = RESTED.replace(dwell=0.2 * factor)
    verdict = judge_on_surface([other], drawn).isel(material=0)
    curve = follow(drawn).sel(material="rested")
    curve = curve.isel(dwell_factor=np.argmin(abs(DWELL_FACTORS - factor)))
    np.testing.assert_allclose(curve.remaining_by_dwell, verdict.remaining, rtol=1e-9)
    series = other.plane_strain
    assert other.plane_strain_modulus == series.relaxation(0.2 * factor)
    length = other.work_of_adhesion / other.plane_strain_modulus
    expected = predict(make_spectrum(HEIGHTS[-1]), length, 3e-9).separation
    assert drawn or float(verdict.remaining.sel(limit="value")) == pytest.approx(expected, rel=1e-6)


def test_the_curve_of_a_table_ends_where_the_table_does():
    table = Table((0.01, 1.0, 100.0), (0.1e6, 0.2e6, 0.6e6))
    tape = RESTED.replace(youngs_modulus_table=table, dwell=1.0)
    dataset = judge_on_surface([tape], drawn=False)
    known = np.isfinite(dataset.remaining_by_dwell.isel(material=0).sel(limit="low"))
    covered = abs(np.log10(DWELL_FACTORS * np.pi**2)) <= 2  # 0.01 to 100 Hz are 10 s to 1 ms
    np.testing.assert_array_equal(known, covered)
    # E' goes as a power of log10(2)/2 of the frequency below 1 Hz.
    relaxed = 0.2 / np.pi ** np.log10(2)
    assert tape.instant_ratio == pytest.approx(0.6 / relaxed)


def test_limits_of_a_dwell_end_at_the_instantaneous_modulus(drawn):
    elastic = TAPE.replace(plane_strain_modulus=RESTED.plane_strain_modulus)
    dataset = judge_on_surface({"rested": RESTED, "elastic": elastic}, drawn)
    low, _, high = dataset.remaining.sel(material="rested").values
    least, _, most = dataset.remaining.sel(material="elastic").values
    ratio = RESTED.instant_ratio
    assert ratio > 1000  # 1 GPa over 0.1 MPa and some
    if drawn:  # few draws have both limits at once
        assert least <= low < 2 * least
        assert most < high <= ratio * most * 1.01
    else:
        assert (low, high) == pytest.approx((least, ratio * most))
