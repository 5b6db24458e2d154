"""Share of the work of adhesion that remains: limits, consistency, simulations."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import ndtr

from common import remaining_table
from stickiness import repulsive, surface
from stickiness.remaining import share as module
from stickiness.remaining.roughness import LASTING, Roughness
from stickiness.remaining.share import (
    FIRST_TOUCH,
    LIFT,
    count_scales,
    decay_energy,
    find_deepest_state,
    find_exponent,
    find_narrowest_wave,
    find_onset,
    remaining_share,
    tough_area,
    tough_share,
    tough_tension,
    weak_share,
)
from stickiness.spectrum import SelfAffine
from stickiness.traction_laws import LAWS, PREDICTED

pytestmark = pytest.mark.processors

TABLE = "config/remaining.csv"


ONSETS = [0.1, 0.4, 0.75]


@pytest.mark.parametrize("onset", ONSETS)
def test_energy_gained_grows_with_the_area_of_contact(onset):
    x = np.linspace(0.01, 4, 8001)
    slope = np.gradient(x * tough_share(x, onset), x)
    assert slope[5:-5] == pytest.approx(tough_area(x, onset)[5:-5], abs=1e-3)


@pytest.mark.parametrize("onset", ONSETS)
def test_tough_contact_tends_to_full_contact_and_to_nothing(onset):
    assert tough_share(50.0, onset) == pytest.approx(1 - 1 / 50, abs=1e-9)
    assert tough_share(1e-3 * onset, onset) == 0
    assert tough_area(1e-3 * onset, onset) == 0
    # Where the onset is that of full contact, so is what remains.
    x = np.array([0.9, 1.0, 1.5])
    assert tough_share(x, 1 - 1e-6) == pytest.approx(np.maximum(1 - 1 / x, 0), abs=2e-3)


@pytest.mark.parametrize("hurst", [0.3, 0.5, 0.65, 0.8, 0.95])
@pytest.mark.parametrize("magnification", [4.0, 64.0, 1e4])
def test_scales_are_those_of_the_spectrum(hurst, magnification):
    """By quadrature of the energy u per logarithm of the wave number."""
    rough = SelfAffine(hurst=hurst, q0=1.0, q1=magnification, h_rms=1.0)
    exponent = find_exponent(magnification, mean_wave_number=4 * rough.elastic_energy())
    for narrowest in (2.0, 0.5 * magnification):
        log_q = np.linspace(0, np.log(narrowest), 4001)
        density = np.exp(3 * log_q) * rough.psd(np.exp(log_q))
        total = np.trapezoid(density, log_q)
        expected = total**2 / np.trapezoid(density**2, log_q)
        scales = count_scales(narrowest, exponent)
        assert scales == pytest.approx(expected, rel=1e-4)


def test_the_onset_saturates_and_moves_with_the_scales():
    """At fixed waves the range stops mattering; energy at all scales moves the onset to 1."""
    magnification = 32.0
    waves = find_narrowest_wave(np.array([1e-3, 1e-5, 1e-12]) / magnification, magnification)
    assert waves == pytest.approx(waves[-1], rel=0.01)
    assert find_narrowest_wave(0.1, 1e9) == pytest.approx(11, rel=1e-6)

    onsets = {}
    for hurst in (0.5, 0.8):
        for magnification in (32.0, 1e4, 1e8):
            rough = SelfAffine(hurst=hurst, q0=1.0, q1=magnification, h_rms=1.0)
            wave = find_narrowest_wave(1e-12, magnification)
            exponent = find_exponent(magnification, 4 * rough.elastic_energy())
            scales = count_scales(wave, exponent)
            onsets[hurst, magnification] = find_onset(scales)
    assert onsets[0.5, 1e8] - onsets[0.5, 1e4] > 0.05
    assert onsets[0.8, 1e8] - onsets[0.8, 1e4] < 0.005
    assert onsets[0.5, 1e8] < 1


def test_attraction_of_long_range_needs_no_contact():
    # The mean gap at first touch is that of the heights' tail, far below the range.
    assert weak_share(1e-3, 100.0) == pytest.approx(1, abs=0.06)
    assert weak_share(1e-3, 0.04) < 1e-4


@pytest.mark.parametrize("law", PREDICTED)
@pytest.mark.parametrize("reach", [1e-6, 1e-3, 0.03, 1.0, 10.0])
def test_mean_attraction_is_that_of_gaussian_heights(law, reach):
    """Against adaptive quadrature over the gaps, decade by decade."""
    potential, ranges = LAWS[law](1.0, reach).potential, np.array([reach])
    ends = np.array([0, *np.geomspace(1e-9, 10, 11), 30])
    found = module._mean_attraction(ranges, module._GAPS)[0] - ndtr(-module._GAPS)
    if law != "exponential":
        found = found + module._mean_excess(ranges, law, module._GAPS.size)[0]
    for place in (0, 20, 80):
        mean_gap = module._GAPS[place]

        def density(gap, mean_gap=mean_gap):
            return -potential(gap) * np.exp(-((mean_gap - gap) ** 2) / 2) / np.sqrt(2 * np.pi)

        parts = [quad(density, *each, epsrel=1e-9) for each in zip(ends, ends[1:], strict=False)]
        expected = sum(value for value, _ in parts)
        assert found[place] == pytest.approx(expected, rel=1e-5, abs=1e-15)


def test_hard_surfaces_keep_the_attraction_of_their_gaps_at_first_touch():
    """Nothing is deformed: range^2 times the mean inverse square of the gap, and summits near."""
    reach = np.array([0.01, 0.03, 0.1])
    share = weak_share(1e-8, reach, law="van_der_waals")
    away = share / reach**2 * FIRST_TOUCH**2
    assert np.all((away > 1) & (away < 2))
    # an exponential law has next to nothing there
    assert weak_share(1e-8, 0.1) < 0.1 * share[2]


def test_tension_of_a_tail_is_the_slope_of_its_energy():
    """Twice the attraction over the separation, if the range is long."""
    x, far = 1e-8, 30.0
    share, tension, area = find_deepest_state(x, far, 0.2, law="van_der_waals")
    assert x * share / tension == pytest.approx((far + FIRST_TOUCH) / 2, rel=0.02)
    assert area == 0


def tough_energy(y, onset):
    """Elastic energy of tough contacts, the integral of y over the area."""
    area = tough_area(y, onset)
    steps = (y[1:] + y[:-1]) / 2 * np.diff(area)
    return area, np.append(0.0, np.cumsum(steps))


@pytest.mark.parametrize("onset", ONSETS)
def test_tough_contact_has_the_least_energy_of_its_areas(onset):
    """The least F - x A over areas is what remains at every x."""
    area, energy = tough_energy(np.linspace(1e-4, 12, 40001), onset)
    for x in (0.5, 0.8, 1.5, 3.0):
        total = energy - x * area
        assert -total.min() / x == pytest.approx(tough_share(x, onset), abs=1e-6)
        assert area[total.argmin()] == pytest.approx(tough_area(x, onset), abs=1e-3)


@pytest.mark.parametrize(
    ("x", "onset"), [(0.6, 0.4), (1.0, 0.4), (2.0, 0.4), (1.4, 0.9), (3.0, 0.95), (9.5, 0.8)]
)
def test_the_tension_is_the_steepest_rise_of_the_energy(x, onset):
    """By finite differences of energy over mean gap, down to the least one of the fit."""
    area, stored = tough_energy(np.linspace(1e-4, x, 80001), onset)
    gaps = np.geomspace(0.05, 10, 20001)
    energies = np.exp(-decay_energy(gaps)[0])
    resolved = (stored > 1e-9) & (stored < energies[0])
    area, stored = area[resolved], stored[resolved]
    gap = LIFT * np.interp(-stored, -energies, gaps)
    slope = np.diff(stored - x * area) / np.diff(gap)
    assert tough_tension(x, onset) == pytest.approx(slope.max(), rel=0.005)


def test_the_deeper_state_counts():
    x, e = np.geomspace(0.05, 3, 30)[:, None], np.geomspace(0.05, 3, 30)
    onset = np.broadcast_to(find_onset(find_narrowest_wave(e**2 / x, 32.0)), (30, 30))
    share, tension, area = find_deepest_state(x, e, onset, 0.2)
    remaining = remaining_share(x, e, onset, load_scale=0.2)
    assert np.all(share >= tough_share(x, onset))
    # Attraction over gaps flattens the heights, too, which tough contact follows anyway.
    is_tough = tough_share(x, onset) > weak_share(x, e, 0.2)
    assert 100 < is_tough.sum() < 800
    np.testing.assert_allclose(share[is_tough], remaining[is_tough], rtol=1e-12)
    assert np.all(remaining >= share * (1 - 1e-12))
    assert np.max(remaining - share) > 0.05
    assert np.all((area >= 0) & (area <= 1 + 1e-12) & (tension >= 0))


def test_energy_of_contact_without_adhesion():
    """`decay_energy` against the boundary element method, on a surface of many waves."""
    rough = SelfAffine(hurst=0.7, q0=1.0, q1=8.0, h_rms=1.0)
    heights = surface.synthesise(rough, n=128, length=8 * np.pi, seed=5)
    full = surface.realised_spectrum(heights, 8 * np.pi).elastic_energy()
    for pressure in (0.3, 0.1, 0.03):
        state = repulsive.solve(heights, 8 * np.pi, pressure)
        deflection = state.gap + heights
        stored = np.mean(state.pressure * (deflection - deflection.mean())) / 2
        decay, _ = decay_energy(state.gap.mean())
        assert decay == pytest.approx(-np.log(abs(stored) / full), rel=0.05)


def model(rows):
    """`Roughness` of which the rows of the table tell."""
    return Roughness(
        h_rms=1.0,
        q0=1.0,
        elastic_energy=rows.full_contact_energy.to_numpy(),
        q1=rows.magnification.to_numpy(),
        rms_slope=rows.rms_slope.to_numpy(),
    )


def test_energy_is_between_the_works():
    table = remaining_table.read(TABLE)
    table = table[table.separation.notna()]  # others rested at zero load
    assert np.all(table.approach <= 1.001 * table.bound + 1e-6)
    assert np.all(table.bound <= 1.001 * table.separation + 1e-6)


def test_preload_does_nothing_where_full_contact_does_not_last():
    """Pressed into full contact against touched, for strengths up to `LASTING`; beyond, it may."""
    table = remaining_table.read(TABLE).set_index(["set", "seed", "energy_ratio", "zone"])
    table = table[table.bound > 0.01]  # of less, 10 % is within the error of the steps
    pressed = table[table.pressed > 2 * table.rms_slope]
    touched = table[table.pressed == 0.1].loc[pressed.index]
    strength = pressed.adhesion_length / pressed.range / (pressed.rms_slope / 2)
    weak = (strength < LASTING).to_numpy()
    assert weak.sum() > 10
    for name in ("separation", "pull_off"):
        change = np.abs(pressed[name] / touched[name] - 1)
        assert change[weak].max() < 0.06
        assert change[~weak].max() > 0.1
    # The high limit that a preload brings is the strength, beyond all that was simulated.
    assert np.all(pressed.pull_off < pressed.adhesion_length / pressed.range)


def test_limits_cover_edges_sharper_than_the_finest_waves():
    """Nine in ten in cells of four waves, and four in five in those of two, which scatter more."""
    table = remaining_table.read(TABLE)
    # Cohesive zones narrower than a third of the finest waves (over 2 pi).
    rows = table[table.zone * table.magnification < 0.31]
    rough = replace(model(rows), waves=rows.window.to_numpy(float))
    _, low, high = rough.limit_share(rows.adhesion_length, rows.range)
    inside = (low <= rows.bound) & (rows.bound <= high)
    many = inside[rows.window == 4]
    few = inside[rows.window == 2]
    assert len(many) > 40
    assert len(few) > 200
    assert 0.86 <= many.mean() <= 0.96
    assert 0.79 <= few.mean() <= 0.96


@pytest.mark.parametrize("hurst", [0.5, 0.8])
@pytest.mark.parametrize("ratio", [0.5, 0.8])
@pytest.mark.parametrize("fine_zone", [0.25, 1.0])
def test_the_theory_follows_the_magnification(hurst, ratio, fine_zone):
    """Theory over simulation, of the same long waves with finer and finer ones.

    It stays within 20 % of its mean in cells of two waves, and within 25 % on single surfaces of
    one wave, whose ladders are longer.
    """
    table = remaining_table.read(TABLE)
    rows = table[(table.hurst == hurst) & (table.energy_ratio == ratio)]
    rows = rows[rows["set"].str.contains("_rest")]
    rows = rows[np.isclose(rows.zone * rows.magnification, fine_zone, rtol=1e-3)]
    for window, last, most in ((2, 16, 0.2), (1, 32, 0.25)):
        cells = rows[rows.window == window]
        followed = cells.seed.isin(cells.seed[cells.magnification == last])
        means = cells[followed].groupby("magnification")[["bound", "predicted"]].mean()
        assert len(means) >= 3
        over_simulated = means.predicted / means.bound
        assert np.all(np.abs(over_simulated / over_simulated.mean() - 1) < most)


def test_the_committed_predictions_are_those_of_the_code():
    table = remaining_table.read(TABLE)
    plain = table[~table["set"].str.contains("rolloff")]
    share = model(plain).share(plain.adhesion_length.to_numpy(), plain.range.to_numpy())
    assert share == pytest.approx(plain.predicted.to_numpy(), rel=1e-3, abs=1e-5)


@pytest.mark.parametrize("onset", [0.05, 0.47, 0.8, 0.99])
def test_tension_near_full_contact_grows_with_the_energy_ratio(onset):
    """It has no kink where the gap of the energy stored falls below the gaps of the fit."""
    energy_ratios = np.geomspace(8.0, 8e4, 60)
    rise = np.diff(np.log(tough_tension(energy_ratios, onset))) / np.diff(np.log(energy_ratios))
    assert rise.max() < 1.6
    assert rise[-9:].mean() == pytest.approx(1.0, abs=0.1)
