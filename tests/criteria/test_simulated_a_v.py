"""The a_V that is quoted: of theory's edges, of simulations, at a pair's range."""

from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from criteria.simulated_a_v import measure_a_v
from stickiness import criteria, datasets
from stickiness import error_budget as budget
from stickiness.criteria.a_v_theory import VARIANTS, SurfaceAv, edge_range, local_a_v
from stickiness.persson import Persson
from stickiness.spectrum import SelfAffine

LOAD = 0.065


def edge_ratio(hurst, magnification):
    """Theory's a_V of the edges over the one equivalent to Pastewka and Robbins'."""
    spectrum = SelfAffine(hurst=hurst, q0=1.0, q1=magnification, h_rms=1.0)
    ranges = np.geomspace(1e-12, 10, 105)
    a_v = [
        local_a_v(Persson(spectrum, variant=variant).gap_cumulative(ranges, LOAD), LOAD, ranges)
        for variant in VARIANTS
    ]
    edge = edge_range(ranges, *a_v)
    at_edge = np.exp(np.interp(np.log(edge), np.log(ranges), np.log(a_v[0])))
    theirs = criteria.pastewka_robbins_a_v(1.0, 1.0, spectrum.rms_slope, spectrum.rms_curvature)
    return float(at_edge) / theirs


@pytest.mark.parametrize("hurst", [0.6, 0.7, 0.8, 0.9])
def test_edges_agree_with_pastewka_and_robbins(hurst):
    """Theirs rests on rms slope and curvature alone and knows nothing of Persson's theory."""
    ratios = [edge_ratio(hurst, zeta) for zeta in (1e3, 1e4, 1e5, 1e6)]
    # Estimates of the contact area alone differ by kappa = 2 against 2.36; both enter the limits
    # of a pair's a_V.
    assert ratios == pytest.approx([1.1] * 4, rel=0.35)
    # 0.03 is small against the exponents (5H - 3)/3 of 0 to 0.5, and what two decades leave of
    # transients.
    assert abs(np.log(ratios[3] / ratios[1]) / np.log(100)) < 0.03


def test_pair_takes_its_own_range():
    ranges = np.array([1e-4, 1e-2, 1.0])
    theory = np.array([[4.0, 2.0, 1.0], [2.0, 2.0, 3.0]])
    pair = SurfaceAv(ranges, 1.5 * theory, relative_error=0.1)
    value, low, high = pair.at(1e-4)
    assert (value, low, high) == pytest.approx((6.0, 3.0 * 0.9, 6.0 * 1.1))
    assert pair.at(1e-3)[0] == pytest.approx(1.5 * np.sqrt(4.0 * 2.0))  # halfway in logarithms
    assert pair.at(1e-9) == pytest.approx(pair.at(1e-4))
    for found, *expected in zip(
        pair.at(np.array([1e-4, 1.0])), pair.at(1e-4), (1.5, 1.35, 4.95), strict=True
    ):
        assert found == pytest.approx(expected)


def fit_file(path, name, coords, **parameters):
    """Fits of a_V over three intervals, as `fit_a_v` writes them."""
    dims = ("window", *coords)
    shape = (3, *(len(values) for values in coords.values()))
    data = xr.Dataset({name: (dims, np.full(shape, 2.0))}, coords=coords)
    described = {key: ("1", key) for key in data.variables}
    none = budget.not_applicable("made up")
    data = budget.with_budget(
        datasets.annotate(data, **described),
        name,
        discretisation=budget.ErrorComponent(0.1, "made up"),
        sampling=budget.ErrorComponent(0.38, "made up"),
        **dict.fromkeys(("solver", "bandwidth", "model"), none),
    )
    datasets.write(data, path, title="t", parameters=parameters)
    return path


@pytest.fixture(scope="module")
def inputs(tmp_path_factory):
    """Simulation with a_V = 2, theory 2 on the same spectrum and on all others."""
    folder, loads = tmp_path_factory.mktemp("a_v"), {"pressure": [0.03, 0.065]}
    variant = {"variant": ["afferrante2018"]}
    sweep = variant | {"hurst": [0.8], "magnification": [1e2, 1e4, 1e6], "load": [0]}
    return SimpleNamespace(
        a_v=fit_file(folder / "case.nc", "a_v_mean", loads),
        lattice=fit_file(folder / "lattice.nc", "a_v", variant | loads, hurst=0.8),
        theory=fit_file(folder / "theory.nc", "a_v", sweep),
    )


@pytest.mark.slow
def test_a_v_is_that_of_the_simulation_in_the_file(inputs):
    a_v, parts = measure_a_v(inputs, 0.065)
    assert a_v == 2.0
    assert parts["sampling"].error == pytest.approx(0.38)  # as the file states it, covering 90 %
    assert parts["discretisation"].error == pytest.approx(0.1)
    assert (parts["model"].error, parts["bandwidth"].error) == (0, 0)


def test_a_v_at_another_load_is_refused(inputs):
    with pytest.raises(
        ValueError, match=r"case.nc: has no a_V at criteria.a_v.pressure = 0.1;.*0.03"
    ):
        measure_a_v(inputs, 0.1)
