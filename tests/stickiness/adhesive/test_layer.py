"""Adhesive contact of elastic layers."""

import numpy as np
import pytest
from references.contact import elastic_pressure

from stickiness import adhesive, repulsive, spectrum, surface
from stickiness.adhesive import Exponential, LennardJones, Maugis
from stickiness.solids import Film, Layer

LENGTH = 4 * np.pi
SIDES = (LENGTH, LENGTH)
ROUGH = spectrum.SelfAffine(hurst=0.8, q0=1.0, q1=4.0, h_rms=1.0)
SOLIDS = [
    Layer(0.4, 0.5),
    Layer(0.4, 0.2),
    Layer(1.0, 0.5, "slip"),
    Layer(0.5, 0.4, Film(1e4, 0.4, 0.1)),
]


@pytest.fixture(scope="module")
def heights():
    return surface.synthesise(ROUGH, n=64, length=LENGTH, seed=3)


def full_energy(heights, solid):
    """Elastic energy of full contact."""
    return 0.5 * float(np.mean(heights * elastic_pressure(heights, SIDES, solid)))


@pytest.mark.slow
@pytest.mark.parametrize("solid", SOLIDS, ids=str)
@pytest.mark.parametrize("kind", [Exponential, Maugis, LennardJones])
@pytest.mark.parametrize("control", ["pressure", "mean_gap"])
def test_states_are_in_equilibrium(heights, solid, kind, control):
    energy = full_energy(heights, solid)
    law = kind(energy, 1.0)
    prescribed = {"pressure": 0.05 * energy} if control == "pressure" else {"mean_gap": 0.8}
    a = adhesive.solve(heights, LENGTH, law, tol=1e-8, solid=solid, **prescribed)
    elastic = elastic_pressure(a.gap + heights, SIDES, solid)
    reaction = elastic + law.traction(a.gap) + a.mean_pressure
    unit = max(np.sqrt(np.mean(elastic_pressure(heights, SIDES, solid) ** 2)), law.strength)
    away = a.gap > 0 if law.hard_wall else np.ones(a.gap.shape, bool)
    assert np.abs(reaction[away]).max(initial=0) < 2e-8 * unit
    if law.hard_wall:
        assert reaction[~away].min(initial=0) > -2e-8 * unit
    assert a.elastic_energy == pytest.approx(0.5 * np.mean((a.gap + heights) * elastic), rel=1e-9)
    assert a.repulsive_pressure - a.adhesive_pressure == pytest.approx(
        a.mean_pressure, abs=1e-7 * unit
    )


def test_weak_adhesion_is_contact_without(heights):
    solid = Layer(0.4, 0.5)
    law = Exponential(1e-9, 1.0)
    adhesion = adhesive.solve(heights, LENGTH, law, pressure=1.0, solid=solid)
    contact = repulsive.solve(heights, LENGTH, 1.0, solid=solid)
    np.testing.assert_allclose(adhesion.gap, contact.gap, atol=1e-6)


@pytest.mark.slow
def test_a_path_balances_its_energies(heights):
    """The work at given mean gaps knows nothing of the compression of the layer as a whole."""
    law = Exponential(full_energy(heights, SOLIDS[0]), 1.5)
    fine = {"tol": 1e-6, "balance": 1e-4, "solid": SOLIDS[0]}
    points = list(adhesive.path(heights, LENGTH, law, (4.0, 1.0), control="mean_gap", **fine))
    gain = points[-1].state.energy - points[0].state.energy
    assert len(points) > 10
    assert all(point.event is None for point in points)
    assert sum(point.work for point in points) == pytest.approx(gain, rel=2e-3)
