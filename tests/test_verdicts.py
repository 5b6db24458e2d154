"""The a_V of a pair and the verdict that follows."""

import numpy as np
import pytest
import xarray as xr

import judge
import persson_surface
from _criteria import SurfaceAv
from stickiness import criteria
from stickiness.persson import Persson
from stickiness.spectrum import SelfAffine

LOAD = 0.065


def edge_ratio(hurst, magnification):
    """Theory's a_V of the edges over the one equivalent to Pastewka and Robbins'."""
    spectrum = SelfAffine(hurst=hurst, q0=1.0, q1=magnification, h_rms=1.0)
    ranges = np.geomspace(1e-12, 10, 105)
    areas = Persson(spectrum, variant="almqvist2011").gap_cumulative(ranges, LOAD)
    a_v = areas / (1.5 * LOAD * ranges ** (2 / 3))
    edge = persson_surface.edge_range(ranges, a_v)
    theirs = criteria.pastewka_robbins_a_v(1.0, 1.0, spectrum.rms_slope, spectrum.rms_curvature)
    return float(a_v[ranges == edge][0]) / theirs


@pytest.mark.parametrize("hurst", [0.6, 0.7, 0.8, 0.9])
def test_edges_grow_with_magnification_as_pastewka_and_robbins_have_it(hurst):
    # Theirs rests on rms slope and curvature alone and knows nothing of Persson's theory. 0.03 is
    # small against the exponents (5H - 3)/3 of 0 to 0.5, and what two decades leave of transients.
    exponent = np.log(edge_ratio(hurst, 1e6) / edge_ratio(hurst, 1e4)) / np.log(100)
    assert abs(exponent) < 0.03


@pytest.mark.parametrize("magnification", [1e3, 1e5])
def test_edges_agree_with_pastewka_and_robbins_at_the_papers_hurst_exponent(magnification):
    # Estimates of the contact area alone differ by kappa = 2 against 2.36. Away from H = 0.8 the
    # prefactors part, and both enter the limits of a pair's a_V.
    assert edge_ratio(0.8, magnification) == pytest.approx(1, rel=0.25)


def test_pair_takes_its_own_range():
    ranges = np.array([1e-4, 1e-2, 1.0])
    theory = np.array([[4.0, 2.0, 1.0], [2.0, 2.0, 3.0]])
    pair = SurfaceAv(ranges, theory, quoted=0, ratio=1.5, relative_error=0.1)
    value, low, high = pair.at(1e-4)
    assert (value, low, high) == pytest.approx((6.0, 3.0 * 0.9, 6.0 * 1.1))
    assert pair.at(1e-3)[0] == pytest.approx(1.5 * np.sqrt(4.0 * 2.0))  # halfway in logarithms
    assert pair.at(1e-9) == pytest.approx(pair.at(1e-4))


@pytest.mark.parametrize(
    ("low", "high", "valid", "expected"),
    [
        ((2.0, 1.5), (3.0, 2.0), (1, 1), "sticky"),
        ((2.0, 1.5), (3.0, 2.0), (0, 0), "sticky"),
        ((2.0, 0.5), (3.0, 0.9), (1, 1), "depends"),
        ((0.8, 0.5), (1.2, 0.6), (0, 1), "depends"),
        ((0.5, 0.1), (0.9, 0.2), (1, 1), "not sticky"),
        ((0.5, 0.1), (0.9, 0.2), (1, 0), "undecided"),
    ],
)
def test_verdict(low, high, valid, expected):
    ends = {"end": ["smooth", "rough"]}
    data = {"margin_low": low, "margin_high": high, "dmt_valid": valid}
    dataset = xr.Dataset({name: ("end", list(v)) for name, v in data.items()}, coords=ends)
    assert judge.VERDICTS[int(judge.verdict(dataset))] == expected
