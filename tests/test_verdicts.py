"""The a_V of a pair and the verdict that follows."""

import numpy as np
import pytest
import xarray as xr

import judge
import persson_surface
from _criteria import SurfaceAv
from stickiness import criteria
from stickiness.a_v_table import edge_range, local_a_v
from stickiness.persson import Persson
from stickiness.spectrum import SelfAffine

LOAD = 0.065


def edge_ratio(hurst, magnification):
    """Theory's a_V of the edges over the one equivalent to Pastewka and Robbins'."""
    spectrum = SelfAffine(hurst=hurst, q0=1.0, q1=magnification, h_rms=1.0)
    ranges = np.geomspace(1e-12, 10, 105)
    a_v = [
        local_a_v(Persson(spectrum, variant=variant).gap_cumulative(ranges, LOAD), LOAD, ranges)
        for variant in persson_surface.VARIANTS
    ]
    edge = edge_range(ranges, *a_v)
    at_edge = np.exp(np.interp(np.log(edge), np.log(ranges), np.log(a_v[0])))
    theirs = criteria.pastewka_robbins_a_v(1.0, 1.0, spectrum.rms_slope, spectrum.rms_curvature)
    return float(at_edge) / theirs


@pytest.mark.parametrize("hurst", [0.6, 0.7, 0.8, 0.9])
def test_edges_grow_with_magnification_as_pastewka_and_robbins_have_it(hurst):
    # Theirs rests on rms slope and curvature alone and knows nothing of Persson's theory. 0.03 is
    # small against the exponents (5H - 3)/3 of 0 to 0.5, and what two decades leave of transients.
    exponent = np.log(edge_ratio(hurst, 1e6) / edge_ratio(hurst, 1e4)) / np.log(100)
    assert abs(exponent) < 0.03


@pytest.mark.parametrize("magnification", [1e3, 1e5])
@pytest.mark.parametrize("hurst", [0.6, 0.7, 0.8, 0.9])
def test_edges_agree_with_pastewka_and_robbins(hurst, magnification):
    # Estimates of the contact area alone differ by kappa = 2 against 2.36; both enter the limits
    # of a pair's a_V.
    assert edge_ratio(hurst, magnification) == pytest.approx(1.1, rel=0.35)


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
