"""Elastic energy of roughness on layers."""

import numpy as np
import pytest
from scipy import integrate

from stickiness.solids import Layer
from stickiness.spectrum import SelfAffine, Shells, Tabulated

ROUGH = SelfAffine(hurst=0.8, q0=1.0, q1=1e4, h_rms=1.0, q_rolloff=3.0)
SPECTRA = [
    ROUGH,
    SelfAffine(hurst=0.3, q0=1.0, q1=2.0, h_rms=1.0),
    Tabulated([1.0, 2.0, 7.0, 100.0], [1.0, 0.3, 0.02, 1e-7]),
]


@pytest.mark.parametrize("rough", SPECTRA, ids=lambda s: type(s).__name__)
@pytest.mark.parametrize("power", [0, 1, 2])
def test_powers_have_closed_forms(rough, power):
    for low, high in ((rough.q0, rough.q1), (1.1, 1.9), (0.1, 1.5), (5.0, 1e9)):
        found = rough.integrate(lambda q: q**power, low, high)
        expected = rough.variance_below(high, power) - rough.variance_below(low, power)
        assert found == pytest.approx(float(expected), rel=1e-11)


@pytest.mark.slow
@pytest.mark.parametrize("rough", SPECTRA, ids=lambda s: type(s).__name__)
@pytest.mark.parametrize("thickness", [1e-4, 0.05, 1.0, 3.0])
@pytest.mark.parametrize(("poisson", "backing"), [(0.5, "bonded"), (0.3, "slip"), (0.4, "bonded")])
def test_energy_on_a_layer(rough, thickness, poisson, backing):
    solid = Layer(thickness, poisson, backing)

    def integrand(log_q):
        q = np.exp(log_q)
        return np.pi / 2 * q**3 * rough.psd(q) / solid.factor(q)

    knots = np.log(rough.knots)
    number = len(knots) - 1
    edges = np.interp(np.linspace(0, number, 60 * number + 1), np.arange(number + 1), knots)
    expected = sum(
        integrate.fixed_quad(integrand, a, b, n=10)[0]  # with 12 points the same to 1e-13
        for a, b in zip(edges[:-1], edges[1:], strict=True)
    )
    assert rough.elastic_energy(solid) == pytest.approx(expected, rel=1e-10)


def test_energy_of_shells_is_a_sum():
    shells = Shells([1.0, 2.0, 5.0], [0.5, 0.2, 0.1])
    solid = Layer(0.3, 0.5)
    expected = np.sum(shells.variance * solid.stiffness(shells.q)) / 2
    assert shells.elastic_energy(solid) == pytest.approx(expected, rel=1e-14)
