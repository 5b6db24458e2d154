"""Values that theory carries to a broader spectrum, against simulations of that spectrum."""

from pathlib import Path

import numpy as np
import pytest

from cases import answer_case
from stickiness import dmt, repulsive, spectrum, surface
from stickiness.accuracy.error_models import Surface, read_models
from stickiness.accuracy.prediction import Problem
from stickiness.statistics import COVERS

ROOT = Path(__file__).parents[2]
COLUMNS, SEEDS = ["area", "mean_gap"], range(8101, 8107)


def simulated(hurst, magnification, pressures):
    """Area and mean gap, `(seed, column, pressure)`, on four points per shortest wavelength."""
    band = spectrum.SelfAffine(hurst=hurst, q0=1.0, q1=magnification, h_rms=1.0)
    values = []
    for seed in SEEDS:
        heights = surface.synthesise(band, 4 * magnification, 2 * np.pi, seed)
        of_loads = [repulsive.solve(heights, 2 * np.pi, load, tol=1e-5) for load in pressures]
        values.append(
            [
                [one.area_fraction - dmt.boundary_strip(one.gap == 0) for one in of_loads],
                [one.mean_gap for one in of_loads],
            ]
        )
    return np.array(values)


@pytest.mark.slow
@pytest.mark.parametrize("hurst", [0.5, 0.8])
def test_carried_values_are_within_their_errors(hurst):
    """From magnification 16 to 64, the same long waves in both; the errors are of use, too."""
    pressures = np.array([0.03, 0.2])
    plan = {
        "surface": {"hurst": hurst, "magnification": 16},
        "carry_to": 64,
        "pressures": pressures.tolist(),
    }
    narrow, broad = (simulated(hurst, zeta, pressures) for zeta in (16, 64))
    # Six surfaces do not know the mean change any better than this.
    noise = (broad - narrow).std(0, ddof=1) / np.sqrt(len(SEEDS))
    narrow, broad = narrow.mean(0), broad.mean(0)
    change, size = answer_case.extrapolate(plan, COLUMNS, (0.01, 0.1))
    models = read_models(ROOT / "config/accuracy.csv")
    problem = Problem(models, Surface.of(plan["surface"]), plan["pressures"], COLUMNS)
    claimed = answer_case.extrapolation_errors(problem, plan["carry_to"], narrow, size)
    off = np.abs(narrow + change - broad)
    # Errors that cover 90 %: of four one may be beyond, but not by far.
    ratio = off / np.hypot(claimed, COVERS * noise)
    assert np.sum(ratio <= 1) >= 3, ratio
    assert ratio.max() <= 1.5, ratio
    # Left as it is, a value is wrong by much more than that in area.
    assert (claimed[0] < 0.4 * np.abs(broad - narrow)[0]).all(), claimed[0] / (broad - narrow)[0]
