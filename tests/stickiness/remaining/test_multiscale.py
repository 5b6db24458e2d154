"""Persson's multiscale adhesion: the walk against exact and finite-difference solutions, limits."""

from math import erf, pi, sqrt

import numpy as np
import pytest
from references.adhesion import AdhesiveWave
from scipy.linalg import solve_banded
from scipy.special import ndtr

from stickiness.remaining import multiscale
from stickiness.remaining.multiscale import (
    Absorbed,
    area_fraction,
    group_shells,
    remaining_adhesion,
)
from stickiness.spectrum.kinds import SelfAffine, Shells, Tabulated


def power_law(magnification=16.0, hurst=0.8):
    return SelfAffine(hurst=hurst, q0=1.0, q1=magnification, h_rms=1.0)


@pytest.fixture
def no_pull_off(monkeypatch):
    """Share and area only, which take a fraction of the time."""
    monkeypatch.setattr(multiscale, "_pull_off", lambda walk, w: np.nan)


def test_walk_is_exact_for_a_boundary_at_rest():
    walk = Absorbed(0.3, 5)
    for v in (0.1, 1.0, 30.0):
        area = walk.remaining(v, 0.2, 0.2)
        walk.lose(v, 0.2, area)
        assert area == pytest.approx(erf(0.5 / sqrt(2 * v)), rel=1e-14)


def test_walk_from_a_boundary_that_recedes_evenly():
    start, speed = 0.4, 0.7
    v = np.geomspace(1e-3, 10, 120)
    walk, before = Absorbed(0.0, len(v)), start
    for x in v:
        boundary = start + speed * x
        area = walk.remaining(x, (before + boundary) / 2, boundary)
        walk.lose(x, (before + boundary) / 2, area)
        before = boundary
    there = np.array([start, -start]) + speed * v[-1]
    exact = ndtr(there / sqrt(v[-1])) @ [1, -np.exp(-2 * start * speed)]
    assert area == pytest.approx(exact, rel=1e-3)


def march_by_finite_differences(s, weight, steps=3000, points=3000):
    """Adhesion length and area of a single shell with q = h_rms = 1, V from 0 to 1/4."""
    begun = 0.02 * s  # nothing has been lost before
    v = np.linspace(begun, 0.25, steps + 1)
    energy, area = s + begun, 1.0
    boundary = sqrt(energy / 2)
    x, h = np.linspace(0, 4.0, points, retstep=True)  # above the boundary
    density = np.exp(-((x - boundary) ** 2) / (2 * begun)) / sqrt(2 * pi * begun)
    for dv in np.diff(v):
        energy += dv * area * (weight + (1 - weight) * area**2)
        moved, boundary = boundary, sqrt(energy / area / 2)
        drift = (boundary - moved) / dv
        bands = np.zeros((3, points))
        bands[0, 2:] = -dv / (2 * h**2) + drift * dv / (2 * h)
        bands[1] = 1 + dv / h**2
        bands[2, :-2] = -dv / (2 * h**2) - drift * dv / (2 * h)
        bands[1, 0] = bands[1, -1] = 1
        density[0] = density[-1] = 0
        density = solve_banded((1, 1), bands, density)
        area = h * density.sum()
    return energy / area, area


@pytest.mark.slow
@pytest.mark.parametrize(("s", "weight"), [(0.05, 0.45), (0.2, 0.1)])
def test_march_agrees_with_finite_differences(no_pull_off, s, weight):
    w, area = march_by_finite_differences(s, weight)
    found = remaining_adhesion(Shells([1.0], [1.0]), w, weight, nodes=4)
    assert found.share * w == pytest.approx(s, rel=0.01)
    assert found.area == pytest.approx(area, rel=0.003)


@pytest.mark.parametrize("magnification", [1.01, 16.0, 1e6])
def test_without_adhesion_the_area_is_that_of_repulsive_contact(magnification):
    spectrum = power_law(magnification)
    v = spectrum.rms_slope**2 / 4
    found = area_fraction(spectrum, 1e-9, 0.3 * sqrt(v))
    assert found == pytest.approx(erf(0.3 / sqrt(2)), rel=2e-3)


@pytest.mark.parametrize("spectrum", [power_law(), power_law(1e6, 0.3)])
def test_strong_adhesion_makes_full_contact(no_pull_off, spectrum):
    ratio = 1e3
    found = remaining_adhesion(spectrum, ratio * spectrum.elastic_energy())
    assert found.area == pytest.approx(1, abs=1e-6)
    assert found.share == pytest.approx(1 - 1 / ratio, abs=1e-6)
    assert found.approach == found.separation == found.share


@pytest.mark.parametrize("magnification", [1.01, 1e6])
@pytest.mark.parametrize("hurst", [0.3, 0.8])
def test_any_adhesion_and_magnification(no_pull_off, magnification, hurst):
    spectrum = power_law(magnification, hurst)
    ratios = np.geomspace(1e-3, 1e3, 9)
    shares = [remaining_adhesion(spectrum, x * spectrum.elastic_energy()).share for x in ratios]
    assert np.all(np.diff(shares) >= 0)
    assert shares[0] == 0
    assert shares[-1] > 0.99


@pytest.mark.slow
@pytest.mark.parametrize("spectrum", [power_law(), Shells([1.0, 2.0, 5.0], [1.0, 0.2, 0.02])])
def test_scales_are_fine_enough(spectrum):
    w = 1.2 * spectrum.elastic_energy()
    normal, fine = (remaining_adhesion(spectrum, w, nodes=nodes) for nodes in (1.0, 2.0))
    assert normal.share == pytest.approx(fine.share, rel=5e-3)
    assert normal.area == pytest.approx(fine.area, rel=5e-3)
    assert normal.pull_off == pytest.approx(fine.pull_off, rel=5e-3)


@pytest.mark.parametrize(
    ("weight", "nothing", "five_percent"),
    [(0.1, 0.2, 0.530), (0.45, 0.67, 0.962), (1.0, 1.28, 1.464)],
)
def test_onset_of_adhesion_depends_on_the_weight(no_pull_off, weight, nothing, five_percent):
    spectrum = power_law(32.0)
    energy = spectrum.elastic_energy()
    assert remaining_adhesion(spectrum, nothing * energy, weight).share == 0
    found = remaining_adhesion(spectrum, five_percent * energy, weight).share
    assert found == pytest.approx(0.05, rel=0.01)


def test_nothing_remains_of_weak_adhesion():
    assert remaining_adhesion(power_law(), 1e-3) == multiscale.MultiscaleAdhesion(0.0, 0.0, 0.0)


@pytest.mark.slow
def test_units_do_not_matter():
    one = remaining_adhesion(power_law(), 0.6)
    other = SelfAffine(hurst=0.8, q0=1e6, q1=16e6, h_rms=2e-6)
    found = remaining_adhesion(other, 0.6 * 1e6 * (2e-6) ** 2)
    assert found.share == pytest.approx(one.share, rel=1e-4)
    assert found.pull_off == pytest.approx(2 * one.pull_off, rel=1e-3)


def test_shells_and_tables_agree_with_the_continuous_spectrum(no_pull_off):
    spectrum = power_law()
    q = np.geomspace(1, 16, 1001)
    middle = np.sqrt(q[1:] * q[:-1])
    shells = Shells(middle, np.diff(spectrum.variance_below(q)))
    table = Tabulated(q[::100], spectrum.psd(q[::100]))
    share = remaining_adhesion(spectrum, 0.6).share
    for other in (shells, table):
        assert remaining_adhesion(other, 0.6).share == pytest.approx(share, rel=0.01)


def test_grouped_shells_keep_slope_and_energy():
    shells = Shells(np.arange(1.0, 200.0), np.arange(1.0, 200.0) ** -2.6)
    grouped = group_shells(shells)
    assert len(grouped.q) <= multiscale.MOST_SHELLS
    assert grouped.rms_slope == pytest.approx(shells.rms_slope, rel=1e-12)
    assert grouped.elastic_energy() == pytest.approx(shells.elastic_energy(), rel=1e-12)


def test_opening_tension_against_a_single_wave():
    """Tension in the trough of Johnson's wave on snapping into full contact over sigma_a."""
    ratios = []
    for alpha in (AdhesiveWave.CRITICAL_ALPHA, AdhesiveWave.LARGEST_ALPHA * (1 - 1e-6)):
        amplitude = 1e-3
        length = (alpha * pi * amplitude) ** 2 / 2
        wave = AdhesiveWave(amplitude, 1.0, length)
        trough = wave.full_contact_amplitude - wave.turning_points[1][1]
        ratios.append(trough / sqrt(length * 2 * pi / 2))
    assert ratios == pytest.approx([1.40, 1.17], abs=0.005)


@pytest.mark.parametrize("ratio", [0.0, -1.0, np.nan])
def test_arguments_are_checked(ratio):
    with pytest.raises(ValueError, match="adhesion_length"):
        remaining_adhesion(power_law(), ratio)
    with pytest.raises(ValueError, match="weight"):
        remaining_adhesion(power_law(), 1.0, weight=1.5)
    with pytest.raises(ValueError, match="Spectrum"):
        remaining_adhesion(None, 1.0)
