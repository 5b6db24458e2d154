"""The repulsive solution against those of Tamaas and ContactMechanics (envs/peers.txt)."""

import importlib.util
import pathlib
import warnings

import numpy as np
import pytest
from stickiness import repulsive

pytestmark = pytest.mark.peers

DRIVERS = pathlib.Path(__file__).parents[1] / "benchmarks" / "contact_codes.py"
REASON = "reference code not installed: pip install -r envs/peers.txt"


@pytest.fixture(params=["tamaas", "ContactMechanics"])
def code(request):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the peers warn of a missing MPI on import
        pytest.importorskip(request.param, reason=REASON)
    spec = importlib.util.spec_from_file_location("contact_codes", DRIVERS)
    drivers = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(drivers)
    return {"tamaas": drivers.tamaas, "ContactMechanics": drivers.contact_mechanics}[request.param]


def white_to(n, modes, hurst, seed):
    rng = np.random.default_rng(seed)
    k = np.fft.fftfreq(n, 1 / n)
    radius = np.hypot(k[:, None], k[None, :])
    amplitude = np.where(
        (radius >= 1) & (radius <= modes), np.maximum(radius, 1) ** -(1 + hurst), 0
    )
    heights = np.fft.ifft2(np.fft.fft2(rng.standard_normal((n, n))) * amplitude).real
    return heights / heights.std()


@pytest.mark.parametrize("hurst", [0.5, 0.8])
@pytest.mark.parametrize("scaled_pressure", [0.01, 0.1, 0.5])
@pytest.mark.parametrize("n", [128, 81])
def test_same_solution(code, n, scaled_pressure, hurst):
    heights = white_to(n, n // 8, hurst, seed=1)
    pressure = scaled_pressure * 2 * np.pi
    ours = repulsive.solve(heights, 1.0, pressure, tol=1e-9)
    theirs = code(heights, 1.0, pressure, 1e-9)
    assert theirs.pressure.mean() == pytest.approx(pressure, rel=1e-9)
    # residuals of 1e-9 in the gap times the largest stiffness pi n / sqrt(2) of the grid, with a
    # margin of ten since the codes define their residuals differently
    np.testing.assert_allclose(theirs.pressure, ours.pressure, atol=1e-9 * np.pi * n * 10)
    # single points at zero pressure and zero gap may fall on either side
    assert np.mean(theirs.pressure > 0) == pytest.approx(ours.area_fraction, abs=3 / n**2)
