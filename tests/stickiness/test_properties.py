"""What must hold for every surface, load and unit: scaling, order, conservation, symmetry."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from stickiness import adhesive, dmt, repulsive, surface
from stickiness.criteria import equivalent_sphere
from stickiness.measured import instrument_spectrum, stitching
from stickiness.measured.topography import Topography
from stickiness.persson import Persson
from stickiness.spectrum import SelfAffine

TOL = 1e-8
N = 24

hursts = st.floats(0.1, 1.0)
loads = st.floats(-4, 0.3).map(lambda x: 10**x)  # over E* q0 h_rms
factors = st.floats(-9, 9).map(lambda x: 10**x)
seeds = st.integers(0, 2**31)
grids = st.sampled_from([15, 16, 17, 24])


def heights_of(seed, n=N, hurst=0.8, magnification=4.0, unit=1.0, h_rms=1.0):
    s = SelfAffine(hurst=hurst, q0=1 / unit, q1=magnification / unit, h_rms=h_rms)
    return surface.synthesise(s, n, 2 * np.pi * unit, seed)


def pressed(heights, load, length=2 * np.pi):
    return repulsive.solve(heights, length, load, tol=TOL)


@pytest.mark.slow
@given(hursts, st.floats(0.05, 8), loads, factors, factors, st.floats(-3, 1))
def test_theory_scales(hurst, decades, load, unit, flat, log_gap):
    zeta, u = 10**decades, 10**log_gap
    one = Persson(SelfAffine(hurst=hurst, q0=1.0, q1=zeta, h_rms=1.0))
    other = Persson(SelfAffine(hurst=hurst, q0=1 / unit, q1=zeta / unit, h_rms=unit * flat))
    assert other.area_fraction(load * flat) == pytest.approx(one.area_fraction(load), rel=1e-9)
    gap = other.mean_gap(load * flat) / (unit * flat)
    assert gap == pytest.approx(one.mean_gap(load), rel=1e-8, abs=1e-12)
    share = other.gap_cumulative(u * unit * flat, load * flat)
    assert share == pytest.approx(one.gap_cumulative(u, load), rel=1e-6, abs=1e-9)


@pytest.mark.slow
@settings(max_examples=5)
@given(seeds, hursts, st.floats(-9, 9), st.floats(-6, 0))
def test_a_measured_law_does_not_know_the_unit(seed, hurst, log_unit, log_flat):
    unit, height = 10**log_unit, 10 ** (log_unit + log_flat)
    h = heights_of(seed, 32, hurst, 12)
    limits = instrument_spectrum.TrustedWaves(detect=False)
    maps = Topography(h, 1.0, 1.0, "one"), Topography(h * height, unit, unit, "other")
    one, other = (instrument_spectrum.analyse(each, "none", limits).fit for each in maps)
    assert other.hurst == pytest.approx(one.hurst, abs=1e-7)
    assert other.hurst_se == pytest.approx(one.hurst_se, rel=1e-5)
    assert other.psd(1 / unit) == pytest.approx(one.psd(1.0) * height**2 * unit**2, rel=1e-6)


@given(st.floats(-6, 6), st.floats(-12, 12), st.floats(1.001, 1e6))
@example(2.0, 0.0, 2.0)
def test_effect_falls_with_the_tabor_parameter_of_the_edge(log_t, log_tau, more):
    """A stronger traction bends the gap shut and narrows the zone that it acts in.

    Relative to DMT's the attraction falls at most as sigma_0^(-2), and as sigma_0^(-1) where the
    zone is never far wider than the contact, which it is from t = 19.9 on.
    """
    t, tau = 10**log_t, 10**log_tau
    soft, tough = equivalent_sphere.effect(t, tau), equivalent_sphere.effect(t, tau * more)
    assert tough <= soft * (1 + 1e-9)
    assert tough * more**2 >= soft * (1 - 1e-9)
    if t <= 19.9:
        assert tough * more >= soft * (1 - 1e-9)


@given(seeds, grids, hursts, loads, st.floats(1.01, 10), st.floats(-5, 1), st.booleans())
def test_order_with_load_and_range(seed, n, hurst, load, more, log_range, subpixel):
    """Area and attraction grow, the gap falls."""
    h = heights_of(seed, n, hurst)
    light, heavy = pressed(h, load), pressed(h, load * more)
    assert light.area_fraction <= heavy.area_fraction + 0.5 / h.size
    assert heavy.mean_gap <= light.mean_gap + 10 * TOL
    ranges = [10**log_range, 10**log_range * more**3]
    area = dmt.attractive_area(light.gap, ranges, subpixel=subpixel)
    assert area[0] <= area[1] + 1e-12
    # At one strength, not at one work of adhesion, for which a longer range is a weaker pull.
    tractions = [dmt.adhesive_pressure(light.gap, adhesive.Exponential(0.1 * r, r)) for r in ranges]
    assert tractions[0] <= tractions[1] * (1 + 1e-12)


@given(hursts, st.floats(0.01, 8), loads, st.sampled_from(["yang2008", "wang2017", "xu2024"]))
def test_probabilities_add_up_to_one(hurst, decades, load, correction):
    rough = SelfAffine(hurst=hurst, q0=1.0, q1=10**decades, h_rms=1.0)
    theory = Persson(rough, correction=correction)
    total = theory.area_fraction(load) + theory.gap_cumulative(np.inf, load)
    assert total == pytest.approx(1, abs=1e-8)


@given(seeds, grids, loads, st.tuples(st.integers(0, 30), st.integers(0, 30)), st.booleans())
def test_shift_mirror_and_transpose_of_heights(seed, n, load, shift, transpose):
    h = heights_of(seed, n)

    def moved(field):
        field = np.roll(field, shift, (0, 1))[::-1]
        return field.T if transpose else field

    one, other = pressed(h, load), pressed(moved(h), load)
    assert other.area_fraction == pytest.approx(one.area_fraction, abs=1.5 / h.size)
    np.testing.assert_allclose(other.gap, moved(one.gap), atol=1e-6)
    for subpixel in (False, True):
        areas = [dmt.attractive_area(c.gap, 0.3, subpixel=subpixel) for c in (one, other)]
        assert areas[0] == pytest.approx(areas[1], abs=2.5 / h.size)


@pytest.mark.slow
@settings(max_examples=3)
@given(seeds, hursts)
def test_spectra_and_their_stitching_do_not_depend_on_order(seed, hurst):
    """The same maps give the same bits, and stitch to one spectrum in whatever order."""
    limits = instrument_spectrum.TrustedWaves(detect=False)
    wide, close = (
        instrument_spectrum.analyse(
            Topography(heights_of(seed + k, 64, hurst, 24)[: 64 - k], step, step, "map"),
            "none",
            limits,
        )
        for k, step in ((0, 1.0), (1, 0.5))
    )
    one, same, other = (
        stitching.stitch(each) for each in ([wide, close], [wide, close], [close, wide])
    )
    assert one.rings.psd.tobytes() == same.rings.psd.tobytes()
    np.testing.assert_allclose(other.rings.psd, one.rings.psd, rtol=1e-9)
    assert other.fit.hurst == pytest.approx(one.fit.hurst, abs=1e-6)
    assert other.scatter == pytest.approx(one.scatter, rel=1e-6)
