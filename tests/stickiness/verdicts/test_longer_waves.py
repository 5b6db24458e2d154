"""Waves longer than the scan: their energy, their limits, and surfaces larger than a patch."""

from dataclasses import replace

import numpy as np
import pytest

from stickiness import Material, Surface, judge
from stickiness.pages import plotting
from stickiness.remaining.errors import LARGER
from stickiness.solids import Layer
from stickiness.spectrum import SelfAffine
from stickiness.statistics import COVERS
from stickiness.surface import realised_spectrum, synthesise
from stickiness.verdicts.longer_waves import (
    FIRST_WAVE,
    LongerWaves,
    find_unlikeness,
    lengthen,
)
from stickiness.verdicts.meeting import find_family
from stickiness.verdicts.simulated_surface import find_simulated_shape
from stickiness.verdicts.surface_data import read_family

pytestmark = pytest.mark.usefixtures("coarse_simulation")

N = 512
SIDE = 1e-3
BAND = {"q0": 2 * np.pi / SIDE, "q1": 256 * np.pi / SIDE, "h_rms": 10e-6}
ROUGH = SelfAffine(hurst=0.8, **BAND)
TAPE = Material(youngs_modulus=1e6, work_of_adhesion=0.06, range=3e-10)


def take_patch(seed, parts, hurst=0.8, contact=None):
    """A surface of side `SIDE`, and what a square of 1/`parts` of its side tells of it."""
    heights = synthesise(SelfAffine(hurst=hurst, **BAND), n=N, length=SIDE, seed=seed)
    points = N // parts
    patch = heights[:points, -points:]
    resolved = 1.3 * 2 * np.pi / ROUGH.q1
    side = SIDE * points / N
    surface = Surface.from_heights(patch, side, contact=contact, fit_to=resolved)
    return heights, surface


@pytest.fixture(scope="module")
def patch():
    return take_patch(seed=1, parts=4)[1]


@pytest.mark.parametrize("order", [0, 1])
def test_moments_are_integrals_of_the_law(patch, order):
    """Where the law goes on to the contact."""
    data = patch.data
    contact = 10 * float(data.scan)
    waves = LongerWaves.draw(data, contact)
    goes_on = waves.q0 <= 2 * np.pi / contact * (1 + 1e-9)
    assert goes_on.mean() > 0.3
    hurst = np.clip(data.drawn_hurst.values, 0, 1)
    power = order - 2 * hurst
    fitted = float(data.q_fitted)
    end = waves.q[-1] * np.exp(waves.width / 2)
    integral = end**power - (FIRST_WAVE * 2 * np.pi / contact) ** power
    law = 2 * np.pi * data.drawn_first_psd.values * fitted ** (2 * hurst + 2) * integral / power
    mean = replace(waves, power=np.ones_like(waves.power)).family
    np.testing.assert_allclose(mean.variance(order)[goes_on], law[goes_on], rtol=0.01)


def test_few_waves_have_an_uncertain_power(patch):
    """The power of a ring is 1 in the mean, with the variance of so many independent waves."""
    contact = 10 * float(patch.data.scan)
    waves = LongerWaves.draw(patch.data, contact)
    many = waves.q > 4 * 2 * np.pi / contact
    count = np.pi * waves.q[many] ** 2 * waves.width / (2 * np.pi / contact) ** 2
    power = waves.power[:, many]
    assert power.mean() == pytest.approx(1, abs=3 / np.sqrt(power.size * count.min()))
    assert power.var(axis=0) * count == pytest.approx(1, rel=0.5)


@pytest.mark.parametrize("hurst", [0.6, 0.7, 0.8, 0.9])
def test_sums_over_a_lattice_equal_integrals_from_the_first_wave(hurst):
    indices = np.arange(-1500, 1501)
    steps = np.hypot(indices[:, None], indices)
    steps = steps[(steps > 0) & (steps <= 1500)]
    for order in (0, 1):
        power = order - 2 * hurst  # of the integral of q^(1 + order) q^(-2 (H + 1))
        expected = 2 * np.pi * (1500**power - FIRST_WAVE**power) / power
        assert np.sum(steps ** (power - 2)) == pytest.approx(expected, rel=0.05)


def test_a_contact_as_large_as_the_scan_changes_nothing(patch):
    same = lengthen(patch.data, float(patch.data.scan))
    assert same.identical(patch.data)


def test_where_a_rolloff_is_seen_longer_waves_hardly_matter():
    bent = SelfAffine(hurst=0.8, q_rolloff=16 * np.pi / SIDE, **BAND)
    surface = Surface.from_heights(synthesise(bent, n=512, length=SIDE, seed=2), SIDE)
    assert "q_rolloff" in surface.data
    longer = lengthen(surface.data, 100 * SIDE, error=0.0)
    ratios = read_family(longer).energy() / surface.family.energy()
    assert np.quantile(ratios, (0.05, 0.95)) == pytest.approx([1, 1], abs=0.05)


def test_a_rolloff_below_the_fit_is_seen_in_the_longest_waves():
    """The fit begins at four waves of the scan, and sees roll-offs from about eight."""
    bent = SelfAffine(hurst=0.8, q_rolloff=16 * 2 * np.pi / SIDE, **BAND)
    for seed in (1, 2, 3):
        heights = synthesise(bent, n=1024, length=SIDE, seed=seed)
        surface = Surface.from_heights(
            heights[:341, :341], SIDE * 341 / 1024, contact=SIDE, fit_to=1.3 * 2 * np.pi / ROUGH.q1
        )
        assert "q_rolloff" not in surface.data
        energy = realised_spectrum(heights, SIDE).elastic_energy()
        # If the law went on, five times as much.
        assert 0.7 < np.median(surface.family.energy()) / energy < 1.5


def test_nothing_longer_than_half_the_scan_is_seen_in_the_longest_waves():
    """The law would go on to a contact with two to four times as much energy."""
    ended = SelfAffine(hurst=0.8, **BAND | {"q0": 8 * BAND["q0"]})
    ratios = []
    for seed in (1, 2, 3, 4):
        heights = synthesise(ended, n=N, length=SIDE, seed=seed)
        resolved = 1.3 * 2 * np.pi / ROUGH.q1
        surface = Surface.from_heights(heights[:128, :128], SIDE / 4, contact=SIDE, fit_to=resolved)
        assert "q_rolloff" not in surface.data
        energy = realised_spectrum(heights, SIDE).elastic_energy()
        ratios.append(np.median(surface.family.energy()) / energy)
    assert np.median(ratios) < 1.4


def test_longer_waves_meet_a_layer_draw_by_draw():
    """A layer stiffens the longest waves most: limits contain the energy of the whole surface."""
    layer = Layer(5e-5, poisson=0.5)
    soft = TAPE.replace(solid=layer)
    inside = []
    for seed in (1, 2, 3, 4):
        heights, known = take_patch(seed, parts=3, contact=SIDE)
        energy = realised_spectrum(heights, SIDE).elastic_energy(layer)
        drawn = find_family(soft, known).energy(layer)
        low, high = np.quantile(drawn, (0.05, 0.95))
        inside.append(low <= energy <= high)
    assert np.mean(inside) >= 0.75


def test_waves_that_are_assumed_are_not_shown_as_measured(patch):
    larger = take_patch(seed=1, parts=4, contact=SIDE)[1].data
    assert plotting.is_larger(larger)
    assert not plotting.is_larger(patch.data)
    measured = larger.wave_number[plotting.find_rings(larger)]
    scan = float(larger.scan)
    assert float(larger.wave_number.min()) < 2 * np.pi / (2 * scan)
    assert float(measured.min()) > 0.7 * 2 * np.pi / scan
    assert plotting.find_rings(patch.data)[0]


def test_a_contact_smaller_than_the_scan_is_an_error(patch):
    with pytest.raises(ValueError, match="give contact as at least the side of the scan, 250 µm"):
        take_patch(seed=1, parts=4, contact=SIDE / 5)


def test_heights_stand_for_a_contact_without_much_energy_in_longer_waves(patch):
    scan = float(patch.data.scan)
    slightly, larger = (lengthen(patch.data, times * scan) for times in (1.01, 10))
    assert "trial_energy" in slightly
    assert "trial_energy" not in larger


@pytest.mark.slow
def test_patches_tell_the_threshold_of_the_whole_surface():
    """Without longer waves small patches seem to stick more than the surface does."""
    inside = []
    ratios = {contact: [] for contact in (SIDE, None)}
    # How far the largest patches are off for want of longer waves is not looked at.
    looked_at = [(parts, SIDE) for parts in (2, 4, 8)] + [(parts, None) for parts in (4, 8)]
    for hurst in (0.8, 0.9):
        for seed in (1, 2, 3, 4):
            heights, _ = take_patch(seed, parts=8, hurst=hurst)
            whole = Surface.from_spectrum(realised_spectrum(heights, SIDE))
            patches = {
                f"{parts}{contact}": take_patch(seed, parts, hurst, contact)[1]
                for parts, contact in looked_at
            }
            judged = judge([TAPE], {"whole": whole} | patches, curves=False, thresholds=False)
            judged = judged.isel(material=0)
            threshold = judged.modulus_threshold
            low = threshold.sel(limit="low")
            high = threshold.sel(limit="high")
            truth = float(threshold.sel(surface="whole", limit="value"))
            contains = (low <= truth) & (truth <= high)
            inside += [bool(contains.sel(surface=f"{parts}{SIDE}")) for parts in (2, 4, 8)]
            value = threshold.sel(limit="value") / truth
            for contact, found in ratios.items():
                found += [float(value.sel(surface=f"{parts}{contact}")) for parts in (4, 8)]
    assert np.mean(inside) >= 0.9
    assert 0.8 < np.median(ratios[SIDE]) < 1.25
    assert np.median(ratios[None]) > 1.7


def test_uneven_scans_tell_less_of_a_larger_contact(patch):
    """The error goes with the energy in longer waves, and is none for Gaussian heights."""
    even = patch.data.assign(unevenness=0.0, shape=0.0).drop_vars("trial_energy")
    uneven = even.assign(unevenness=0.3)
    scan = float(patch.data.scan)
    of_scan = read_family(even).energy()

    def find_added(times):
        energies = [read_family(lengthen(data, times * scan)).energy() for data in (even, uneven)]
        longer = 1 - of_scan / np.maximum(energies[0], of_scan)
        return float(np.std(np.log(energies[1] / energies[0]))), float(np.mean(longer))

    added, longer = find_added(4)
    assert longer > 0.2
    assert added == pytest.approx(LARGER.half_width(longer, 0.3) / COVERS, rel=0.1)
    assert added > 2 * find_added(1.001)[0]
    assert LARGER.half_width(longer, 0.0) == 0
    assert find_unlikeness(0.3, -0.4) == pytest.approx(0.5)


def test_simulated_tops_tell_the_shape_of_the_heights(patch):
    """Skewness alone makes less of flat tops, on which little adhesion holds."""
    assert find_simulated_shape(patch.data.drop_vars("trial_energy")) is None
    heights, _ = take_patch(seed=1, parts=4)
    heights = heights[:256, -256:] - heights[:256, -256:].mean()
    cut = -1e-6 * np.logaddexp(0.0, -heights / 1e-6)
    surface = Surface.from_heights(cut, SIDE / 4)
    found = find_simulated_shape(surface.data)
    assert found.shape > surface.data.shape.item() > 0
    longer = lengthen(surface.data, 2 * SIDE / 4, error=0.0)
    assert longer["shape"].item() > surface.data["shape"].item()
    # Longer waves are halfway between heights of this shape and Gaussian ones.
    added = np.maximum(1 - surface.family.energy() / read_family(longer).energy(), 0)
    assert longer["shape"].item() == pytest.approx(found.shape * (1 - np.mean(added) / 2))
