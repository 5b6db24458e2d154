"""Adhesion that remains on elastic layers: simulated, predicted, and both together."""

import numpy as np
import pytest
from scipy import optimize

from stickiness import adhesive, surface
from stickiness.remaining import measure, predict
from stickiness.remaining.share import spring_share
from stickiness.solids import HalfSpace, Layer
from stickiness.spectrum import SelfAffine

LENGTH = 4 * np.pi
ROUGH = SelfAffine(hurst=0.8, q0=1.0, q1=4.0, h_rms=1.0)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("solid", "ratio"),
    [
        (Layer(0.2, 0.5, "slip"), 0.5),
        (Layer(0.5, 0.5, "slip"), 1.0),
        (Layer(1.0, 0.5), 1.5),
        (Layer(3.0, 0.5), 1.0),
        (Layer(0.2, 0.5), 1.0),
    ],
    ids=str,
)
def test_predicted_limits_hold_what_was_simulated(solid, ratio):
    rough = SelfAffine(hurst=0.8, q0=1.0, q1=8.0, h_rms=1.0)
    heights = surface.synthesise(rough, n=64, length=LENGTH, seed=1)
    held = surface.realised_spectrum(heights, LENGTH)
    work = ratio * held.elastic_energy(solid)
    range_ = np.sqrt(2 * LENGTH / 64 * work)
    law = adhesive.Exponential(work, range_)
    found = measure(heights, LENGTH, law, squeeze=10.0, half_grid=False, solid=solid)
    expected = predict(held, work, range_, solid=solid)
    assert expected.energy_ratio == pytest.approx(ratio)
    low, high = expected.separation_limits
    assert low <= found.separation <= high
    assert low <= found.bound <= high
    low, high = expected.pull_off_limits
    assert low <= found.pull_off <= high


@pytest.mark.parametrize(("ratio", "reach"), [(0.3, 0.5), (1.0, 0.2), (1.0, 1.0), (3.0, 0.5)])
def test_springs_by_the_state_of_each_point(ratio, reach):
    """Deepest state at every height by search, mean over Gaussian heights by quadrature."""
    gaps = np.concatenate([[0.0], np.geomspace(1e-4, 20, 2000)])

    def energy(clearance):
        return float(np.min((gaps - clearance) ** 2 - ratio * np.exp(-gaps / reach)))

    heights, step = np.linspace(-6, 6, 601, retstep=True)
    weights = np.exp(-(heights**2) / 2) / np.sqrt(2 * np.pi) * step

    def gained(level):
        return sum(w * energy(level - z) for w, z in zip(weights, heights, strict=True))

    settings = {"bounds": (-0.2, 3.0), "method": "bounded", "options": {"xatol": 0.02}}
    best = optimize.minimize_scalar(gained, **settings)
    assert spring_share(ratio, reach) == pytest.approx(-best.fun / ratio, abs=2e-3)


def test_thick_layers_are_half_spaces():
    half = predict(ROUGH, 0.5, 0.1)
    assert predict(ROUGH, 0.5, 0.1, solid=HalfSpace()) == half
    thick = predict(ROUGH, 0.5, 0.1, solid=Layer(1e3, 0.5))
    for name in ("separation", "pull_off", "separation_limits", "tabor", "energy_ratio"):
        assert getattr(thick, name) == pytest.approx(getattr(half, name), rel=1e-9)
