"""What must hold for every surface, load and unit: scaling, order, conservation, symmetry."""

from tempfile import TemporaryDirectory

import numpy as np
import pytest
import xarray as xr
from hypothesis import example, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from stickiness import adhesive, criteria, datasets, dmt, repulsive, surface
from stickiness.accuracy import multilevel
from stickiness.criteria import a_v_table, equivalent_sphere
from stickiness.measured import instrument_spectrum, stitching
from stickiness.measured.topography import Topography
from stickiness.persson import Persson
from stickiness.solids.moduli import Prony, Table, crossings
from stickiness.spectrum import SelfAffine, Shells

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


@pytest.mark.filterwarnings("ignore:heights of")  # whose unit is not the length's
@given(seeds, hursts, loads, factors, factors)
def test_contact_scales_with_lengths_and_with_heights(seed, hurst, load, unit, flat):
    """Lengths may be in any unit; heights times a factor take pressures with them."""
    h = heights_of(seed, hurst=hurst)
    one = pressed(h, load)
    other = pressed(h * unit * flat, load * flat, 2 * np.pi * unit)
    assert other.area_fraction == pytest.approx(one.area_fraction, abs=1.5 / h.size)
    assert other.mean_gap / (unit * flat) == pytest.approx(one.mean_gap, rel=1e-6, abs=10 * TOL)


def assert_theory_scales(one, other, load, unit, flat):
    assert other.area_fraction(load * flat) == pytest.approx(one.area_fraction(load), rel=1e-9)
    gap = other.mean_gap(load * flat) / (unit * flat)
    assert gap == pytest.approx(one.mean_gap(load), rel=1e-8, abs=1e-12)


@pytest.mark.slow
@given(hursts, st.floats(0.05, 8), loads, factors, factors, st.floats(-3, 1))
def test_theory_scales(hurst, decades, load, unit, flat, log_gap):
    zeta, u = 10**decades, 10**log_gap
    one = Persson(SelfAffine(hurst=hurst, q0=1.0, q1=zeta, h_rms=1.0))
    other = Persson(SelfAffine(hurst=hurst, q0=1 / unit, q1=zeta / unit, h_rms=unit * flat))
    assert_theory_scales(one, other, load, unit, flat)
    share = other.gap_cumulative(u * unit * flat, load * flat)
    assert share == pytest.approx(one.gap_cumulative(u, load), rel=1e-6, abs=1e-9)


@given(arrays.arrays(float, 5, elements=st.floats(1e-6, 1.0)), hursts, loads, factors, factors)
def test_theory_of_shells_scales(variance, hurst, load, unit, flat):
    """Spectra with gaps between few shells, over up to eight decades."""
    q = np.array([1.0, 1.001, 30.0, 1e4, 1e8])
    variance = variance * q ** (-2 * hurst)
    one = Persson(Shells(q, variance))
    other = Persson(Shells(q / unit, variance * (unit * flat) ** 2))
    assert_theory_scales(one, other, load, unit, flat)
    whole = one.area_fraction(load) + one.gap_cumulative(np.inf, load)
    assert whole == pytest.approx(1, abs=1e-8)


@given(factors, st.floats(-6, 1), st.floats(-6, 1), factors)
def test_criteria_do_not_know_the_unit(h_rms, log_adhesion, log_range, unit):
    eps = 10**log_range * h_rms
    la, q0 = 10**log_adhesion * eps, 0.1 / h_rms
    for criterion in (criteria.bearing_area, criteria.violano_printed, criteria.dmt_validity):
        one = criterion(h_rms, q0, la, eps).margin
        other = criterion(h_rms * unit, q0 / unit, la * unit, eps * unit).margin
        assert other == pytest.approx(one, rel=1e-7)


@given(seeds, factors, st.floats(-5, 5))
def test_means_shift_and_scale_with_what_is_averaged(seed, factor, shift):
    rng = np.random.default_rng(seed)
    control = rng.normal(size=(60, 1))
    values = control[:20, 0] + rng.normal(size=20)
    one = multilevel.controlled_mean(values, control[:20], control[20:])
    other = multilevel.controlled_mean(factor * (values + shift), control[:20], control[20:])
    assert other.mean == pytest.approx(factor * (one.mean + shift), rel=1e-8, abs=1e-8 * factor)
    assert other.standard_error == pytest.approx(factor * one.standard_error, rel=1e-6)


@given(st.floats(-12, 3), st.floats(-6, 7), factors, st.floats(0, 3), st.floats(-9, 9))
def test_edge_adhesion_does_not_know_the_unit(log_range, log_adhesion, h, log_slope, log_unit):
    eps, unit = 10**log_range * h, 10**log_unit
    lengths = np.array([h, 0.1 * h, 10**log_adhesion * eps, eps])  # h_rms, q0, l_a, range
    lengths[1] = 0.1 / h
    powers = np.array([1, -1, 1, 1])
    one, other = (
        equivalent_sphere.attraction(*each[:2], 10**log_slope, *each[2:], 3.0)
        for each in (lengths, lengths * unit**powers)
    )
    assert other.ratio == pytest.approx(one.ratio, rel=1e-7)
    assert other.strength == pytest.approx(one.strength, rel=1e-9)
    assert 0 < one.effect <= equivalent_sphere.weak_effect(one.attractive_over_contact) * (1 + 1e-9)


@pytest.mark.slow
@settings(max_examples=5)
@given(seeds, hursts, st.floats(-9, 9), st.floats(-6, 0))
def test_a_measured_law_does_not_know_the_unit(seed, hurst, log_unit, log_flat):
    unit, height = 10**log_unit, 10 ** (log_unit + log_flat)
    h = heights_of(seed, 32, hurst, 12)
    limits = instrument_spectrum.Limits(detect=False)
    maps = Topography(h, 1.0, 1.0, "one"), Topography(h * height, unit, unit, "other")
    one, other = (instrument_spectrum.analyse(each, "none", limits).fit for each in maps)
    assert other.hurst == pytest.approx(one.hurst, abs=1e-7)
    assert other.hurst_se == pytest.approx(one.hurst_se, rel=1e-5)
    assert other.psd(1 / unit) == pytest.approx(one.psd(1.0) * height**2 * unit**2, rel=1e-6)


@given(st.floats(-12, 3), factors, st.floats(0.01, 0.9))
def test_areas_of_a_power_law_have_one_edge_and_their_attraction_scales(log_range, factor, power):
    ranges = np.geomspace(1e-3, 10, 41) * 10**log_range
    area = 0.1 * (ranges / ranges[-1]) ** power
    apart = (ranges / ranges[20]) ** -power
    edge = a_v_table.edge_range(ranges, apart, np.ones(41))
    assert edge == pytest.approx(ranges[20] * a_v_table.PARTED ** (-1 / power), rel=1e-6) or (
        edge == ranges[0]
    )
    found = [
        dmt.attraction_of_areas(area, ranges * f, adhesive.Exponential(0.1 * f, ranges[30] * f))
        for f in (1.0, factor)
    ]
    assert found[1] == pytest.approx(found[0], rel=1e-9)


# --- order ---


@given(st.floats(-6, 6), st.floats(-12, 12), st.floats(1.001, 1e6))
@example(2.0, 0.0, 2.0)
def test_effect_falls_with_the_tabor_parameter_of_the_edge(log_t, log_tau, more):
    """A stronger traction bends the gap shut and narrows the zone that it acts in.

    Its attraction is sigma_0 (c^2 arccos(a/c) + a sqrt(c^2 - a^2)), and it closes the gap at c by
    sigma_0 (sqrt(c^2 - a^2) arccos(a/c) - c + a). Of a narrow zone, with s = (c/a)^2 - 1, these
    grow as s^(1/2) and s: the attraction falls no faster than s^(-1/2), which the rising traction
    outweighs. Of a zone far wider than the contact they grow as s and s^(1/2): once most of the gap
    is closed, s falls as sigma_0^(-2) and the attraction as sigma_0^(-1), until s is about 1.
    The attraction relative to DMT's thus falls at most as sigma_0^(-2), and as sigma_0^(-1) at most
    if the zone is at no sigma_0 wide enough for the second regime, which it is from t = 19.9 on.
    """
    t, tau = 10**log_t, 10**log_tau
    soft, tough = equivalent_sphere.effect(t, tau), equivalent_sphere.effect(t, tau * more)
    assert tough <= soft * (1 + 1e-9)
    assert tough * more**2 >= soft * (1 - 1e-9)
    if t <= 19.9:
        assert tough * more >= soft * (1 - 1e-9)


@given(st.floats(-8, 8), st.floats(-8, 8), st.floats(0.01, 8), st.floats(0.01, 0.99))
def test_moduli_rise_with_the_rate_and_pass_a_threshold_once(rest, glassy, decades, share):
    solid = Prony(10**rest, ((10**glassy, 1.0), (10**glassy, 10**decades)))
    frequencies = np.geomspace(1e-12, 1e6, 181)
    moduli = solid.storage(frequencies)
    assert np.all(np.diff(moduli) >= -1e-12 * moduli[1:])
    assert 10**rest <= moduli[0] <= moduli[-1] <= 10**rest + 2 * 10**glassy * (1 + 1e-12)
    threshold = moduli[0] ** (1 - share) * moduli[-1] ** share
    if moduli[-1] / moduli[0] < 1 + 1e-6:
        return
    ((found, upwards),) = crossings(solid, threshold, frequencies)
    assert upwards
    table = Table(tuple(frequencies), tuple(moduli))
    assert table.storage(found) == pytest.approx(threshold, rel=1e-9)


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


# --- conservation, determinism ---


@given(seeds, grids, hursts, loads)
def test_mean_pressure_complementarity_and_energy(seed, n, hurst, load):
    h = heights_of(seed, n, hurst)
    c = pressed(h, load)
    assert c.pressure.mean() == pytest.approx(load, rel=1e-11)
    assert min(c.pressure.min(), c.gap.min()) >= 0
    assert np.max(c.pressure * c.gap) <= 2 * TOL * c.pressure.max()
    # What the pressure stores is half its work on the displacement u = gap + h - shift; in full
    # contact nothing can be stored beyond what flattens the surface.
    stored = 0.5 * np.mean(c.pressure * (c.gap + h - c.shift))
    k = np.hypot(*np.meshgrid(*[np.fft.fftfreq(n, 1 / n)] * 2))
    flattened = 0.25 * np.sum(k * np.abs(np.fft.fft2(h) / n**2) ** 2)
    assert -1e-9 <= stored <= flattened * (1 + 1e-6) + 1e-9
    again, same = heights_of(seed, n, hurst), pressed(h, load)
    assert again.tobytes() == h.tobytes()
    assert same.pressure.tobytes() == c.pressure.tobytes()
    assert (same.gap.tobytes(), same.shift) == (c.gap.tobytes(), c.shift)


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
    rough = SelfAffine(hurst=hurst, q0=1.0, q1=10**decades, h_rms=1.0)
    theory = Persson(rough, correction=correction)
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


@given(seeds, grids)
def test_moments_do_not_know_shift_mirror_or_sign(seed, n):
    h = heights_of(seed, n)
    one = surface.moments(h, 1.0)
    for other in (np.roll(h, 5, 0), h[::-1], -h):
        found = surface.moments(other, 1.0)
        assert found.m40 == pytest.approx(one.m40, rel=1e-9)
        assert found.m22 == pytest.approx(one.m22, rel=1e-9)
    assert surface.moments(h.T, 1.0).m20 == pytest.approx(one.m02, rel=1e-9)


@pytest.mark.slow
@settings(max_examples=3)
@given(seeds, hursts)
def test_spectra_and_their_stitching_do_not_depend_on_order(seed, hurst):
    """The same maps give the same bits, and stitch to one spectrum in whatever order."""
    limits = instrument_spectrum.Limits(detect=False)
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
    assert one.spectrum.rings.psd.tobytes() == same.spectrum.rings.psd.tobytes()
    np.testing.assert_allclose(other.spectrum.rings.psd, one.spectrum.rings.psd, rtol=1e-9)
    assert other.spectrum.fit.hurst == pytest.approx(one.spectrum.fit.hurst, abs=1e-6)
    assert other.scatter == pytest.approx(one.scatter, rel=1e-6)


# --- files ---

texts = st.text(st.characters(codec="utf-8", exclude_characters="\0", exclude_categories=["Cs"]))


@pytest.mark.slow
@settings(max_examples=6)
@given(
    arrays.arrays(float, st.tuples(st.just(2), st.integers(1, 3)), elements=st.floats(width=64)),
    arrays.arrays(np.int8, 2, elements=st.integers(-128, 127)),
    st.lists(texts, min_size=2, max_size=2),
    st.dictionaries(st.text("abc_", min_size=1), st.floats(allow_nan=False) | st.none() | texts),
)
def test_files_give_back_every_bit(values, outcomes, words, parameters):
    """NaN, infinite and denormal numbers, small integers and any text."""
    data = xr.Dataset(
        {
            "value": (("point", "kind"), values),
            "outcome": ("point", outcomes),
            "text": ("point", np.array(words, dtype=object)),
        }
    )
    for name in data:
        data[name].attrs = {"units": "1", "long_name": "any", "nan_means": "nothing"}
    with TemporaryDirectory() as folder:
        path = f"{folder}/one.nc"
        datasets.write(data, path, title="any", parameters=parameters)
        again = datasets.read(path, data.variables)
    assert datasets.parameters(again) == parameters
    assert again.value.values.tobytes() == values.tobytes()
    assert np.array_equal(again.outcome, outcomes)
    assert again.outcome.dtype == outcomes.dtype
    assert list(again.text.values) == words
