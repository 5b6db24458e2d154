"""What remains along the modulus, the heights and the rate."""

from functools import cache

import numpy as np
import pytest
import xarray as xr

from common.materials import read_material
from common.verdicts import find_limits
from criteria.verdicts import DWELL_FACTORS, MODULUS_FACTORS, ROUGHNESS_FACTORS, judge_pairs
from stickiness.remaining import predict
from stickiness.remaining.prediction import DEFAULT_SHARE, FILM_FACTORS
from stickiness.spectrum import SelfAffine

HEIGHTS, Q0 = np.array([1e-6, 1.5e-6]), 6e4


def rough(h_rms):
    return SelfAffine(hurst=0.8, q0=Q0, q1=1e3 * Q0, h_rms=h_rms)


ENERGY = np.array([rough(h).elastic_energy() for h in HEIGHTS])
TAPE = {"youngs_modulus": "0.4 MPa", "poisson_ratio": 0.5}
TAPE |= {"work_of_adhesion": "70 mJ/m^2", "range": "3 nm"}
SERIES = {"equilibrium": "0.1 MPa", "terms": [["0.5 MPa", "0.1 s"], ["1 GPa", "1 us"]]}
SLOW = {key: value for key, value in TAPE.items() if key != "youngs_modulus"}
SLOW |= {"youngs_modulus_prony": SERIES}
RESTED = SLOW | {"dwell": "0.2 s", "broken_at": "3 Hz"}
THICK, THIN = "40 um", "7 um"  # layers that can take the heights, and that cannot
FREQUENCIES, DRAWS = np.geomspace(1e-4, 1e6, 21), 60


def made_roughness(solid, drawn):
    """Roughness of a pair, with spectra drawn around its middle if it was measured."""
    layered = "thickness" in solid
    compliance, factor = (0.5, 1.3) if layered else (1.0, 1.0)
    along = {"h_rms": HEIGHTS, "rms_slope": np.ones(2), "rms_curvature": np.full(2, 1e7)}
    along |= {"elastic_energy": factor * ENERGY, "half_space_energy": ENERGY}
    along |= dict.fromkeys(("a_v", "a_v_low", "a_v_high"), np.full(2, 3.0))
    data = {name: ("end", values) for name, values in along.items()}
    data |= {"q0": Q0, "relative_compliance": compliance, "anisotropy_error_factor": 1.0}
    if drawn:
        h = np.random.default_rng(1).lognormal(np.log(1.2e-6), 0.35, DRAWS)
        energy = ENERGY[0] * (h / HEIGHTS[0]) ** 2
        draws = {"h_rms": h, "q0": np.full(DRAWS, Q0), "elastic_energy": factor * energy}
        draws |= {"half_space_energy": energy}
        data |= {f"{name}_draws": ("draw", values) for name, values in draws.items()}
    data["film_response"] = ("end", "response", "factor"), np.zeros((2, 2, len(FILM_FACTORS)))
    return xr.Dataset(data).assign(stiffening=("end", np.full(2, factor)))


def judge(entries, drawn, frequencies):
    solids = [read_material(entry) for entry in entries.values()]
    roughness = [[made_roughness(entry, drawn)] for entry in entries.values()]
    found = judge_pairs(solids, roughness, frequencies)
    return found.assign_coords(material=list(entries)).squeeze("surface")


@cache
def followed(drawn, thickness=THICK):
    """Curves beside what is stored of the pairs."""
    layer = TAPE | {"thickness": thickness}
    entries = {"tape": TAPE, "slow": SLOW, "layer": layer, "rested": RESTED}
    return judge(entries, drawn, FREQUENCIES)


def follow_at(moduli, drawn):
    """Share and limits of the tape at these E* [Pa]."""
    entries = {
        i: TAPE | {"youngs_modulus": f"{0.75 * float(x)!r} Pa"} for i, x in enumerate(moduli)
    }
    found = judge(entries, drawn, np.ones(1))
    return [x.transpose(..., "material") for x in (found.remaining, *find_limits(found))]


@pytest.fixture(scope="module", params=[False, True], ids=["given", "measured"])
def curves(request):
    return followed(request.param)


@pytest.mark.slow
@pytest.mark.parametrize("axis", ["modulus", "roughness", "rate", "dwell"])
@pytest.mark.parametrize("thickness", [THICK, THIN])
@pytest.mark.parametrize("drawn", [False, True])
def test_at_the_pair_itself_curves_are_what_is_stored(drawn, thickness, axis):
    found = followed(drawn, thickness)
    along = {"modulus": MODULUS_FACTORS, "roughness": ROUGHNESS_FACTORS, "rate": FREQUENCIES}
    along = (along | {"dwell": DWELL_FACTORS})[axis]
    at = {"frequency" if axis == "rate" else f"{axis}_factor": np.argmin(abs(np.log(along)))}
    there, expected = found.isel(at), (found.remaining, *find_limits(found))
    rested = there.material == "rested"
    known = {"rate": ~rested, "dwell": rested}.get(axis, slice(None))
    for name, values in zip(("", "_low", "_high"), expected, strict=True):
        curve = there[f"remaining_by_{axis}{name}"]
        np.testing.assert_allclose(curve[known], values[known], rtol=1e-9)
    assert (there.remaining > 0.01).all()
    assert (there.remaining < 0.99 * there.separation_factor).all()
    assert (float(expected[1].sel(material="layer")) == 0) == (thickness == THIN)


@pytest.mark.parametrize("drawn", [False, True])
def test_curves_cross_the_wanted_share_at_the_threshold(drawn):
    tape = followed(drawn).sel(material="tape")
    thresholds = tape.modulus_threshold.values
    share, _, _ = follow_at(thresholds, drawn)
    np.testing.assert_allclose(np.diag(share), DEFAULT_SHARE, rtol=1e-6)
    limits = [float(x) for x in find_limits(tape, "modulus_threshold")]
    assert limits[0] < min(thresholds) < max(thresholds) < limits[1]
    _, low, high = follow_at(limits, drawn)
    # Quantiles of thresholds and of shares interpolate between different draws.
    np.testing.assert_allclose([low[0], high[1]], DEFAULT_SHARE, rtol=0.02 if drawn else 1e-6)
    margins = np.array([float(x) for x in find_limits(tape, "margin")])
    np.testing.assert_allclose(limits, margins * read_material(TAPE).modulus)
    # On a measured surface the limits have the errors of the spectrum and of the model.
    of_model = float(tape.modulus_threshold_low.min()), float(tape.modulus_threshold_high.max())
    assert (limits[0] < of_model[0] and limits[1] > of_model[1]) == drawn


@pytest.mark.parametrize("drawn", [False, True])
def test_every_material_has_its_own_law(drawn):
    hard = TAPE | {"youngs_modulus": "100 GPa", "range": "30 nm"}
    laws = ("exponential", "van_der_waals")
    found = judge({law: hard | {"law": law} for law in laws} | {"none": hard}, drawn, FREQUENCIES)
    for law in laws:
        given = 0.07 / (100e9 / 0.75), 3e-8
        expected = [predict(rough(h), *given, law=law).separation for h in HEIGHTS]
        np.testing.assert_allclose(found.remaining.sel(material=law), expected, rtol=1e-9)
    tail, short = (found.sel(material=law) for law in laws[::-1])
    assert np.all(tail.remaining > 5 * short.remaining)
    names = ["remaining", "remaining_by_modulus", "pull_off", "remaining_quantile"]
    xr.testing.assert_equal(
        found[names].sel(material="none", drop=True), short[names].drop_vars("material")
    )
    if drawn:
        assert np.all(tail.remaining_quantile > 3 * short.remaining_quantile)


def test_a_factor_on_the_heights_is_another_surface(curves):
    length, reach = 0.07 / (0.4e6 / 0.75), 3e-9
    for place in (0, 10, 20, 32):
        scaled = [rough(h * ROUGHNESS_FACTORS[place]) for h in HEIGHTS]
        expected = [predict(spectrum, length, reach).separation for spectrum in scaled]
        found = curves.remaining_by_roughness.sel(material="tape").isel(roughness_factor=place)
        np.testing.assert_allclose(found, expected, rtol=1e-9)


def test_the_rate_counts_by_the_modulus(curves):
    moduli = read_material(SLOW).plane_strain.storage(FREQUENCIES)
    drawn = not float(curves.remaining_quantile.isnull().all())
    for name, expected in zip(("", "_low", "_high"), follow_at(moduli, drawn), strict=True):
        found = curves[f"remaining_by_rate{name}"].sel(material="slow")
        np.testing.assert_allclose(found, expected, rtol=1e-9)


@pytest.mark.parametrize("factor", [1e-4, 1.0, 1e3])
def test_the_dwell_counts_by_the_relaxed_modulus_and_the_factor(curves, factor):
    """Curves of dwells are verdicts of materials with these dwells."""
    drawn = not float(curves.remaining_quantile.isnull().all())
    entry = RESTED | {"dwell": f"{0.2 * factor!r} s"}
    expected = judge({"other": entry}, drawn, np.ones(1)).sel(material="other")
    found = curves.sel(material="rested").isel(dwell_factor=np.argmin(abs(DWELL_FACTORS - factor)))
    shares = (expected.remaining, *find_limits(expected))
    for name, values in zip(("", "_low", "_high"), shares, strict=True):
        np.testing.assert_allclose(found[f"remaining_by_dwell{name}"], values, rtol=1e-9)
    solid = read_material(entry)
    series = solid.plane_strain
    assert solid.modulus == series.relaxation(0.2 * factor)
    value, low, high = solid.separation_factor
    assert (value, low, high) == series.separation_factor(0.2 * factor, 3.0)
    x = 0.07 / solid.modulus
    shares = [predict(rough(h), x, 3e-9).separation for h in HEIGHTS]
    np.testing.assert_allclose(expected.remaining, np.multiply(value, shares), rtol=1e-6)
    assert (expected.separation_factor_high == pytest.approx(high)).all()


def test_the_curve_of_a_table_ends_where_the_table_does():
    pairs = [["0.01 Hz", "0.1 MPa"], ["1 Hz", "0.2 MPa"], ["100 Hz", "0.6 MPa"]]
    tape = {key: value for key, value in RESTED.items() if key != "youngs_modulus_prony"}
    tape |= {"youngs_modulus_table": pairs, "dwell": "1 s", "broken_at": "10 Hz"}
    found = judge({"tape": tape}, False, np.ones(1)).sel(material="tape")
    known = np.isfinite(found.remaining_by_dwell_low)
    covered = abs(np.log10(DWELL_FACTORS * np.pi**2)) <= 2  # 0.01 to 100 Hz are 10 s to 1 ms
    np.testing.assert_array_equal(known, covered)
    value, low, high = read_material(tape).separation_factor
    # E' goes as powers log10(2)/2 and log10(3)/2 of the frequency below and above 1 Hz.
    relaxed = 0.2 / np.pi ** np.log10(2)
    assert (value, low, high) == pytest.approx((0.2 * 3**0.5 / relaxed, 1.0, 0.6 / relaxed))


def test_limits_of_a_dwell_are_those_of_the_factor():
    elastic = {"label": "a", "plane_strain_modulus": f"{read_material(RESTED).modulus!r} Pa"}
    elastic |= {"work_of_adhesion": "70 mJ/m^2", "range": "3 nm"}
    for drawn in (False, True):
        both = judge({"rested": RESTED, "elastic": elastic}, drawn, np.ones(1))
        limits = [find_limits(both.sel(material=name)) for name in ("rested", "elastic")]
        (low, high), (least, most) = [[float(x) for x in pair] for pair in limits]
        top = float(both.separation_factor_high.sel(material="rested").max())
        assert top > 1000  # 1 GPa over 0.1 MPa and some
        # At the high limit the factor multiplies the area in contact, or the share if that is more.
        given = 0.07 / read_material(RESTED).modulus, 3e-9
        alone = [predict(rough(h), *given) for h in HEIGHTS]
        more = max(max(one.area_at_zero_load, one.separation) for one in alone) * (top - 1)
        if drawn:  # few draws have both limits at once
            assert least <= low < 2 * least
            assert most < high <= most + more * 1.01
        else:
            assert (low, high) == pytest.approx((least, most + more))
