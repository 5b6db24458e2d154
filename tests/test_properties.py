"""What must hold for every surface, load and unit: scaling, order, conservation, symmetry."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from stickiness import adhesive, continuum, criteria, dmt, repulsive, sampling, surface
from stickiness.persson import Persson
from stickiness.spectrum import SelfAffine

TOL = 1e-8
N = 24

hursts = st.floats(0.1, 1.0)
loads = st.floats(-4, 0.3).map(lambda x: 10**x)  # over E* q0 h_rms
factors = st.floats(-9, 9).map(lambda x: 10**x)
seeds = st.integers(0, 2**31)
grids = st.sampled_from([15, 16, 17, 24])
laws = st.sampled_from([adhesive.Maugis, adhesive.Exponential, adhesive.LennardJones])


def heights_of(seed, n=N, hurst=0.8, magnification=4.0, unit=1.0, h_rms=1.0):
    s = SelfAffine(hurst=hurst, q0=1 / unit, q1=magnification / unit, h_rms=h_rms)
    return surface.synthesise(s, n, 2 * np.pi * unit, seed)


def pressed(heights, load, length=2 * np.pi):
    return repulsive.solve(heights, length, load, tol=TOL)


def adhered(heights, law, eps, tension, load, length=2 * np.pi):
    return adhesive.solve(heights, length, law(tension * eps, eps), pressure=load, tol=TOL)


# --- scale ---


@given(seeds, hursts, loads, factors, factors)
def test_contact_scales_with_lengths_and_with_heights(seed, hurst, load, unit, flat):
    """Lengths may be in any unit; heights times a factor take pressures with them."""
    h = heights_of(seed, hurst=hurst)
    one = pressed(h, load)
    other = pressed(h * unit * flat, load * flat, 2 * np.pi * unit)
    assert other.area_fraction == pytest.approx(one.area_fraction, abs=1.5 / h.size)
    assert other.mean_gap / (unit * flat) == pytest.approx(one.mean_gap, rel=1e-6, abs=10 * TOL)


@given(hursts, st.floats(0.05, 8), loads, factors, factors, st.floats(-3, 1))
def test_theory_scales(hurst, decades, load, unit, flat, log_gap):
    zeta = 10**decades
    one = Persson(SelfAffine(hurst=hurst, q0=1.0, q1=zeta, h_rms=1.0))
    other = Persson(SelfAffine(hurst=hurst, q0=1 / unit, q1=zeta / unit, h_rms=unit * flat))
    u = 10**log_gap
    assert other.area_fraction(load * flat) == pytest.approx(one.area_fraction(load), rel=1e-9)
    gap = other.mean_gap(load * flat) / (unit * flat)
    assert gap == pytest.approx(one.mean_gap(load), rel=1e-8, abs=1e-12)
    share = other.gap_cumulative(u * unit * flat, load * flat)
    assert share == pytest.approx(one.gap_cumulative(u, load), rel=1e-6, abs=1e-9)


@given(factors, st.floats(-6, 1), st.floats(-6, 1), factors)
def test_criteria_do_not_know_the_unit(h_rms, log_adhesion, log_range, unit):
    eps = 10**log_range * h_rms
    la, q0 = 10**log_adhesion * eps, 0.1 / h_rms
    for criterion in (criteria.bearing_area, criteria.violano_printed, criteria.dmt_validity):
        one = criterion(h_rms, q0, la, eps).margin
        other = criterion(h_rms * unit, q0 / unit, la * unit, eps * unit).margin
        assert other == pytest.approx(one, rel=1e-7)


@given(
    arrays.arrays(float, (3, 4), elements=st.floats(0.01, 1.0)),
    st.floats(-0.5, 0.5),
    st.integers(1, 10**6),
    factors,
)
def test_limits_of_fine_grids_scale(values, part, edges, factor):
    one = continuum.estimate("mean_gap", list(values), part, edges)
    other = continuum.estimate("mean_gap", list(factor * values), factor * part, edges)
    np.testing.assert_allclose(other.value, factor * one.value, rtol=1e-12)
    # An error below the rounding of the values is none.
    np.testing.assert_allclose(other.error, factor * one.error, rtol=1e-9, atol=1e-18 * factor)


@given(seeds, factors, st.floats(-5, 5))
def test_means_shift_and_scale_with_what_is_averaged(seed, factor, shift):
    rng = np.random.default_rng(seed)
    control = rng.normal(size=(60, 1))
    values = control[:20, 0] + rng.normal(size=20)
    one = sampling.controlled_mean(values, control[:20], control[20:])
    other = sampling.controlled_mean(factor * (values + shift), control[:20], control[20:])
    assert other.mean == pytest.approx(factor * (one.mean + shift), rel=1e-8, abs=1e-8 * factor)
    assert other.standard_error == pytest.approx(factor * one.standard_error, rel=1e-6)


# --- order ---


@given(seeds, hursts, loads, st.floats(1.01, 10))
def test_area_grows_and_gap_falls_with_load(seed, hurst, load, more):
    h = heights_of(seed, hurst=hurst)
    light, heavy = pressed(h, load), pressed(h, load * more)
    assert light.area_fraction <= heavy.area_fraction + 0.5 / h.size
    assert heavy.mean_gap <= light.mean_gap + 10 * TOL


@given(hursts, st.floats(0.05, 6), loads, st.floats(1.001, 100))
def test_order_in_theory(hurst, decades, load, more):
    theory = Persson(SelfAffine(hurst=hurst, q0=1.0, q1=10**decades, h_rms=1.0))
    assert theory.area_fraction(load) <= theory.area_fraction(load * more)
    assert theory.mean_gap(load) >= theory.mean_gap(load * more)
    gaps = np.geomspace(1e-6, 1e3, 19)
    assert np.all(np.diff(theory.gap_cumulative(gaps, load)) >= -1e-12)


@given(seeds, loads, st.floats(-5, 1), st.floats(1.01, 30), st.booleans())
def test_attraction_grows_with_the_range(seed, load, log_range, more, subpixel):
    contact = pressed(heights_of(seed), load)
    near, far = 10**log_range, 10**log_range * more
    area = dmt.attractive_area(contact.gap, [near, far], subpixel=subpixel)
    assert area[0] <= area[1] + 1e-12
    # At one strength, not at one work of adhesion, for which a longer range is a weaker pull.
    tractions = [
        dmt.adhesive_pressure(contact.gap, adhesive.Exponential(0.1 * r, r)) for r in (near, far)
    ]
    assert tractions[0] <= tractions[1] * (1 + 1e-12)


# --- conservation ---


@given(seeds, grids, hursts, loads)
def test_mean_pressure_complementarity_and_energy(seed, n, hurst, load):
    h = heights_of(seed, n, hurst)
    c = pressed(h, load)
    assert c.pressure.mean() == pytest.approx(load, rel=1e-11)
    assert c.pressure.min() >= 0
    assert c.gap.min() >= 0
    assert np.max(c.pressure * c.gap) <= 2 * TOL * c.pressure.max()
    # What the pressure stores is half its work on the displacement u = gap + h - shift; in full
    # contact nothing can be stored beyond what flattens the surface.
    stored = 0.5 * np.mean(c.pressure * (c.gap + h - c.shift))
    k = np.hypot(*np.meshgrid(*[np.fft.fftfreq(n, 1 / n)] * 2))
    flattened = 0.25 * np.sum(k * np.abs(np.fft.fft2(h) / n**2) ** 2)
    assert -1e-9 <= stored <= flattened * (1 + 1e-6) + 1e-9


@given(seeds, laws, loads, st.floats(-1, 1), st.floats(-4, 0))
def test_adhesive_balance(seed, law, load, log_range, log_tension):
    a = adhered(heights_of(seed, 16), law, 10**log_range, 10**log_tension, load)
    unit = max(a.law.strength, 2.0)  # of pressure: residuals are relative to it
    assert a.repulsive_pressure - a.adhesive_pressure == pytest.approx(load, abs=10 * TOL * unit)
    assert a.pressure.mean() == pytest.approx(load, abs=10 * TOL * unit)
    assert a.gap.min() >= (0 if a.law.hard_wall else -a.law.range)
    assert 0 <= a.repulsive_area_fraction + a.adhesive_area_fraction <= 1 + 1e-12


@given(hursts, st.floats(0.01, 8), loads, st.sampled_from(["yang2008", "wang2017", "xu2024"]))
def test_probabilities_add_up_to_one(hurst, decades, load, correction):
    spectrum = SelfAffine(hurst=hurst, q0=1.0, q1=10**decades, h_rms=1.0)
    theory = Persson(spectrum, correction=correction)
    total = theory.area_fraction(load) + theory.gap_cumulative(np.inf, load)
    assert total == pytest.approx(1, abs=1e-8)


# --- symmetry ---


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


@given(seeds, laws, loads, st.integers(0, 30))
def test_symmetry_of_adhesive_contact(seed, law, load, shift):
    """Where the state is unique: adhesion too weak for jumps."""
    h = heights_of(seed, 16)
    one = adhered(h, law, 1.0, 0.05, load)
    other = adhered(np.roll(h, shift, 0).T, law, 1.0, 0.05, load)
    assert other.mean_gap == pytest.approx(one.mean_gap, rel=1e-5, abs=1e-5)


@given(seeds, grids)
def test_moments_do_not_know_shift_mirror_or_sign(seed, n):
    h = heights_of(seed, n)
    one = surface.moments(h, 1.0)
    for other in (np.roll(h, 5, 0), h[::-1], -h):
        found = surface.moments(other, 1.0)
        assert found.m40 == pytest.approx(one.m40, rel=1e-9)
        assert found.m22 == pytest.approx(one.m22, rel=1e-9)
    assert surface.moments(h.T, 1.0).m20 == pytest.approx(one.m02, rel=1e-9)


# --- determinism ---


@given(seeds, grids, hursts, loads)
def test_the_same_input_gives_the_same_bits(seed, n, hurst, load):
    fields = []
    for _ in range(2):
        h = heights_of(seed, n, hurst)
        c = pressed(h, load)
        fields.append((h.tobytes(), c.pressure.tobytes(), c.gap.tobytes(), c.shift))
    assert fields[0] == fields[1]


@given(seeds, laws)
def test_the_same_adhesion_gives_the_same_bits(seed, law):
    states = [adhered(heights_of(seed, 16), law, 0.5, 0.1, 0.05) for _ in range(2)]
    assert states[0].gap.tobytes() == states[1].gap.tobytes()
    assert states[0].pressure.tobytes() == states[1].pressure.tobytes()
