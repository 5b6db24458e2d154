"""Adhesion that each criterion asks for."""

import numpy as np
import pytest
from helpers.constant_a_v import ConstantAv

from criteria import compare_criteria
from stickiness import criteria
from stickiness.spectrum import SelfAffine

ASKED = {
    "hurst": 0.8,
    "range_times_q0": 1e-6,
    "h_rms_over_range": {"minimum": 10, "maximum": 1e4, "per_decade": 2},
    "quoted_h_rms_over_range": 1000,
    "magnification": {"minimum": 10, "maximum": 1e5, "per_decade": 2},
    "quoted_magnification": 1e4,
}


@pytest.mark.slow
def test_which_criteria_know_the_finest_waves():
    data = compare_criteria.compare(ASKED, 0.065, ConstantAv(), 3.0).against_magnification
    change = data.isel(magnification=-1) / data.isel(magnification=0)
    unmoved = ["violano_constant", "violano_printed", "bearing_area"]
    np.testing.assert_allclose(change.sel(criterion=unmoved), 1, rtol=1e-12)
    assert change.sel(criterion="fuller_tabor") > 10
    assert change.sel(criterion="pastewka_robbins") < 0.1
    # every threshold is where its criterion's margin is 1
    at = float(data.sel(criterion="pastewka_robbins", magnification=10))
    s = SelfAffine(hurst=0.8, q0=1e-6, q1=1e-5, h_rms=1000.0)
    found = criteria.pastewka_robbins(s.rms_slope, s.rms_curvature, at, 1.0)
    assert found.margin == pytest.approx(1, rel=1e-12)
