"""What remains along the modulus, the heights and the rate."""

from functools import cache

import numpy as np
import pytest
import xarray as xr

from common.materials import read_material
from common.verdicts import find_limits
from criteria.curves import MODULUS_FACTORS, ROUGHNESS_FACTORS, follow, follow_remaining
from criteria.judging import judge_measured, judge_pairs, stack_pairs
from criteria.pair_roughness import PairRoughness
from stickiness.criteria.a_v_table import SurfaceAv
from stickiness.remaining import predict
from stickiness.remaining.prediction import DEFAULT_SHARE, Roughness
from stickiness.spectrum import SelfAffine

A_V = SurfaceAv(np.array([1e-9, 1.0]), np.full((2, 2), 3.0), 0, 0.1)
HEIGHTS, Q0 = np.array([1e-6, 1.5e-6]), 6e4


def rough(h_rms):
    return SelfAffine(hurst=0.8, q0=Q0, q1=1e3 * Q0, h_rms=h_rms)


ENERGY = np.array([rough(h).elastic_energy() for h in HEIGHTS])
TAPE = {"youngs_modulus": "0.4 MPa", "poisson_ratio": 0.5}
TAPE |= {"work_of_adhesion": "70 mJ/m^2", "range": "3 nm"}
SERIES = {"equilibrium": "0.1 MPa", "terms": [["0.5 MPa", "0.1 s"], ["1 GPa", "1 us"]]}
FILM = {"youngs_modulus": "3 GPa", "poisson_ratio": 0.4, "thickness": "25 um"}
ENTRIES = {
    "tape": TAPE,
    "slow": {**TAPE, "youngs_modulus_prony": SERIES},
    "layer": TAPE | {"thickness": "40 um"},
    "film": TAPE | {"thickness": "40 um", "backing": FILM},
}
ENTRIES["slow"].pop("youngs_modulus")
FREQUENCIES, DRAWS = np.geomspace(1e-4, 1e6, 21), 60


def made_roughness(solid, drawn, strain=0.1):
    """Surface of a pair, with spectra drawn around its middle if it was measured."""
    layered = "thickness" in solid
    compliance, factor = (0.5, 1.3) if layered else (1.0, 1.0)
    draws = None
    if drawn:
        h = np.random.default_rng(1).lognormal(np.log(1.2e-6), 0.35, DRAWS)
        energy = ENERGY[0] * (h / HEIGHTS[0]) ** 2
        draws = Roughness(h, np.full(DRAWS, Q0), factor * energy, compliance, energy)
    return PairRoughness(
        h_rms=HEIGHTS,
        rms_slope=np.ones(2),
        rms_curvature=np.full(2, 1e7),
        elastic_energy=factor * ENERGY,
        energy_ratio_to_half_space=np.full(2, factor),
        layer_strain=np.full(2, strain if layered else 0.0),
        q0=Q0,
        a_v=(A_V, A_V),
        relative_compliance=compliance,
        half_space_energy=ENERGY,
        anisotropy_error_factor=1.0,
        samples=draws,
    )


@cache
def followed(drawn, strain=0.1):
    """Curves beside what is stored of the pairs."""
    solids = [read_material(entry) for entry in ENTRIES.values()]
    roughness = [[made_roughness(entry, drawn, strain)] for entry in ENTRIES.values()]
    pair = stack_pairs(solids, roughness)
    rates = np.array([np.atleast_1d(s.plane_strain.storage(FREQUENCIES)) for s in solids])
    found = judge_pairs(pair, solids, roughness) | judge_measured(solids, roughness)
    found |= follow_remaining(pair, solids, roughness, rates) | {"frequency": FREQUENCIES}
    coords = {"material": list(ENTRIES), "surface": ["wall"], "end": ["smooth", "rough"]}
    return xr.Dataset(found, coords=coords).squeeze("surface")


def follow_at(moduli, drawn):
    """Share and limits of the tape at these E* [Pa]."""
    solids, roughness = [read_material(TAPE)], [[made_roughness(TAPE, drawn)]]
    pair, column = stack_pairs(solids, roughness), np.reshape(moduli, (-1, 1))
    found = follow(pair, solids, roughness, "modulus_factor", column, np.ones(len(moduli)))
    return [values.squeeze(("material", "surface")) for values in found]


@pytest.fixture(scope="module", params=[False, True], ids=["given", "measured"])
def curves(request):
    return followed(request.param)


@pytest.mark.slow
@pytest.mark.parametrize("axis", ["modulus", "roughness", "rate"])
@pytest.mark.parametrize("strain", [0.1, 0.5])
@pytest.mark.parametrize("drawn", [False, True])
def test_at_the_pair_itself_curves_are_what_is_stored(drawn, strain, axis):
    found = followed(drawn, strain=strain)
    along = {"modulus": MODULUS_FACTORS, "roughness": ROUGHNESS_FACTORS, "rate": FREQUENCIES}[axis]
    at = {"frequency" if axis == "rate" else f"{axis}_factor": np.argmin(abs(np.log(along)))}
    there, expected = found.isel(at), (found.remaining, *find_limits(found))
    known = there.material != "film" if axis != "roughness" else np.full(4, True)
    for name, values in zip(("", "_low", "_high"), expected, strict=True):
        curve = there[f"remaining_by_{axis}{name}"]
        np.testing.assert_allclose(curve[known], values[known], rtol=1e-9)
    assert (there.remaining > 0.01).all()
    assert (there.remaining < 0.99).all()
    assert (float(expected[1].sel(material="layer")) == 0) == (strain > 0.3)


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


def test_a_factor_on_the_heights_is_another_surface(curves):
    length, reach = 0.07 / (0.4e6 / 0.75), 3e-9
    for place in (0, 10, 20, 32):
        scaled = [rough(h * ROUGHNESS_FACTORS[place]) for h in HEIGHTS]
        expected = [predict(spectrum, length, reach).separation for spectrum in scaled]
        found = curves.remaining_by_roughness.sel(material="tape").isel(roughness_factor=place)
        np.testing.assert_allclose(found, expected, rtol=1e-9)


def test_the_rate_counts_by_the_modulus(curves):
    moduli = read_material(ENTRIES["slow"]).plane_strain.storage(FREQUENCIES)
    drawn = not float(curves.remaining_quantile.isnull().all())
    for name, expected in zip(("", "_low", "_high"), follow_at(moduli, drawn), strict=True):
        found = curves[f"remaining_by_rate{name}"].sel(material="slow")
        np.testing.assert_allclose(found, expected, rtol=1e-9)


def test_an_elastic_backing_has_no_curve_along_the_modulus(curves):
    film = curves.sel(material="film")
    assert np.isnan(film.remaining_by_modulus).all()
    assert np.isnan(film.remaining_by_rate_low).all()
    assert np.isfinite(film.remaining_by_roughness).all()
