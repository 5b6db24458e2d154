"""What remains on given heights, by simulated states, against an independent minimiser."""

import numpy as np
import pytest
from references.energy_minimiser import find_full_contact_energy, minimise

from stickiness import adhesive, surface
from stickiness.measured.periodic import periodise
from stickiness.remaining.height_simulation import (
    find_trial_states,
    simulate_heights,
    simulate_standard,
)
from stickiness.remaining.standard_heights import standardise
from stickiness.spectrum import SelfAffine

N = 64
WAVES = 2
ROUGH = SelfAffine(hurst=0.8, q0=2 * np.pi * WAVES, q1=2 * np.pi * 4 * WAVES, h_rms=0.01)
TRANSFORMS = {
    "Gaussian": lambda z: z,
    "squared": lambda z: z**2,
    "valleys cut": lambda z: np.maximum(z, -0.5),
    "tops cut": lambda z: np.minimum(z, 0.5),
}

pytestmark = pytest.mark.filterwarnings("ignore::stickiness.plausibility.PlausibilityWarning")


def make_heights(kind, n=N, seed=3):
    heights = surface.synthesise(ROUGH, n=n, length=1.0, seed=seed)
    heights = TRANSFORMS[kind](heights / heights.std())
    return 0.01 * (heights - heights.mean()) / heights.std()


@pytest.fixture(scope="module")
def gaussian():
    return simulate_heights(make_heights("Gaussian"), (1.0, 1.0))


@pytest.fixture(scope="module", params=TRANSFORMS)
def simulated(request):
    heights = make_heights(request.param)
    return heights, find_trial_states(heights, 1.0)


@pytest.mark.parametrize("kind", TRANSFORMS)
def test_states_of_a_mirrored_map_are_those_of_its_period(kind):
    heights = make_heights(kind)[:32, :48]
    period = periodise(heights, "mirror")
    quarter = find_trial_states(heights, (0.5, 0.75), mirrored=True)
    whole = find_trial_states(period, (1.0, 1.5))
    assert quarter.full_contact_energy == pytest.approx(whole.full_contact_energy)
    works = quarter.simulated_length
    np.testing.assert_allclose(works, whole.simulated_length[: works.size])
    shares = [each.simulated_share[: works.size] for each in (quarter, whole)]
    np.testing.assert_allclose(*shares, rtol=0.01)


@pytest.mark.parametrize("energy_ratio", [0.25, 0.6, 1.1])
@pytest.mark.parametrize("factor", [1.0, 3.0])
def test_states_bound_the_share_of_an_independent_minimiser(simulated, energy_ratio, factor):
    heights, states = simulated
    length = energy_ratio * find_full_contact_energy(heights)
    range_ = factor * np.sqrt(2 / N * length)
    starts = [np.maximum(c * heights.std() - heights, 0) for c in (0.0, 0.6, 1.4, 2.5)]
    share = minimise(heights, length, range_, [*starts, np.zeros_like(heights)])
    (low,) = states.share(np.array([length]), np.array([range_]))
    assert low <= share + 2e-4
    assert low >= 0.85 * share - 0.01
    if factor == 1.0:
        (high,) = states.find_high_bound(np.array([length]), np.array([range_]))
        assert high >= share - 2e-4


@pytest.mark.parametrize("kind", ["Gaussian", "tops cut"])
def test_limits_hold_at_a_range_that_the_grid_does_not_resolve(kind):
    fine = surface.synthesise(ROUGH, n=4 * N, length=1.0, seed=3)
    fine = TRANSFORMS[kind](fine / fine.std())
    # The same waves on both grids.
    modes = np.fft.fft2(fine)
    index = np.abs(np.fft.fftfreq(4 * N, 1 / (4 * N)))
    modes[np.maximum(index[:, None], index) >= N / 2] = 0.0
    fine = 0.01 * np.fft.ifft2(modes).real / fine.std()
    states = find_trial_states(fine[::4, ::4], 1.0)
    length = 0.6 * states.full_contact_energy
    range_ = np.sqrt(2 / (4 * N) * length)
    law = adhesive.Exponential(length, range_)
    energies = [
        adhesive.solve(fine, 1.0, law, pressure=0.0, start=start, tol=1e-4).energy
        for start in ("approach", "separation")
    ]
    share = -min(energies) / length
    (low,) = states.share(np.array([length]), np.array([range_]))
    (high,) = states.find_high_bound(np.array([length]), np.array([range_]))
    assert range_ < 0.6 * states.simulated_range[np.searchsorted(states.simulated_length, length)]
    assert 0.7 * share < low < share < high < 2 * share
    signs = np.array([-1.0, 0.0, 1.0])
    between = states.share_between(
        np.full(3, length), np.full(3, range_), law="exponential", eta=signs
    )
    assert np.all(np.diff(between) > 0)
    assert low <= between[0] <= share
    assert between[2] <= high
    assert between[1] == pytest.approx(share, rel=0.15)


def test_full_contact_and_no_contact_are_exact():
    states = find_trial_states(make_heights("Gaussian"), 1.0)
    energy = find_full_contact_energy(make_heights("Gaussian"))
    assert states.full_contact_energy == pytest.approx(energy, rel=1e-12)
    strong = np.array([1e4 * energy])
    (share,) = states.share(strong, np.array([1e-6]))
    assert share == pytest.approx(1 - 1e-4, rel=1e-6)
    assert states.area(strong, np.array([1e-6])) == 1.0
    weak = np.array([1e-9 * energy])
    (share,) = states.share(weak, np.array([1e-4]))
    assert 0 <= share < 1e-3


def test_shares_rise_with_the_work_and_the_range(simulated):
    _, states = simulated
    lengths = np.geomspace(0.01, 30, 60) * states.full_contact_energy
    ranges = np.full(60, 0.002)
    assert np.all(np.diff(states.share(lengths, ranges)) >= -1e-12)
    wide = np.geomspace(1e-6, 1, 60)
    length = np.full(60, 0.5 * states.full_contact_energy)
    assert np.all(np.diff(states.share(length, wide)) >= -1e-12)


def test_states_of_scaled_heights_are_scaled():
    heights = make_heights("Gaussian")
    states = find_trial_states(heights, 1.0)
    scaled = find_trial_states(3e-6 * heights, 2e-4)
    again = states.scaled(height_unit=3e-6, length_unit=2e-4)
    for name in ("elastic_energy", "simulated_length", "simulated_range", "simulated_share"):
        np.testing.assert_allclose(getattr(again, name), getattr(scaled, name), rtol=2e-3)


@pytest.mark.parametrize("energy_ratio", [0.2, 0.8])
def test_states_bound_a_law_with_a_tail(simulated, energy_ratio):
    heights, states = simulated
    length = energy_ratio * states.full_contact_energy
    range_ = 0.6 * heights.std()
    law = adhesive.VanDerWaals(length, range_)
    energies = [
        adhesive.solve(heights, 1.0, law, pressure=0.0, start=start, tol=1e-4).energy
        for start in ("approach", "separation")
    ]
    share = max(-min(energies) / length, 0.0)
    (low,) = states.share(np.array([length]), np.array([range_]), "van_der_waals")
    assert 0.85 * share - 0.01 < low <= share + 2e-4


def test_contact_without_adhesion_bounds_less(gaussian):
    pressed = gaussian.without_adhesion()
    length = np.array([0.6 * gaussian.whole.full_contact_energy])
    arguments = (length, np.array([0.002]), "exponential", np.zeros(1))
    assert 0 < pressed.share(*arguments, np.zeros(1)) < gaussian.share(*arguments, np.zeros(1))
    assert not pressed.whole.has_adhesion.any()


def test_waves_that_are_not_simulated_take_adhesion_away_and_widen_the_limits(gaussian):
    length = np.full(3, 0.8 * gaussian.whole.full_contact_energy)
    signs = np.array([-1.0, 0.0, 1.0])

    def find_shares(lacking):
        full = np.full(3, lacking)
        return gaussian.share(length, np.full(3, 0.002), "exponential", full, signs)

    without = find_shares(0.0)
    with_waves = find_shares(0.3)
    assert np.all(np.diff(without) > 0)
    assert np.all(np.diff(with_waves) > 0)
    assert with_waves[1] < 0.9 * without[1]
    assert np.all(with_waves < without)
    # Limits are the further apart, the more energy lacks.
    ranges = np.full(2, 0.002)
    low_and_high = np.array([-1.0, 1.0])
    widths = [
        np.ptp(
            gaussian.find_shift(
                length[:2], ranges, "exponential", np.full(2, lacking), low_and_high
            )
        )
        for lacking in (0.0, 0.3, 3.0)
    ]
    assert np.all(np.diff(widths) > 0)


def test_in_full_contact_waves_that_are_not_simulated_cost_their_energy(gaussian):
    energies = [states.full_contact_energy for states in (gaussian.whole, *gaussian.quarters)]
    length = 30 * max(energies)
    one = np.ones(1)
    arguments = (length * one, 1e-4 * one, "exponential", 0.3 * one)
    low, value = (gaussian.share(*arguments, sign * one)[0] for sign in (-1.0, 0.0))
    assert value == pytest.approx(1 - 1.3 * energies[0] / length, abs=2e-4)
    # Quarters differ from the whole by their energies.
    assert value - 3 * max(energies) / length < low <= value


def test_last_bits_of_the_heights_do_not_matter():
    def simulate_filtered(heights):
        standard = standardise(heights, (1.0, 1.0), cutoff=2 * np.pi * 15, is_noise_beyond=True)
        return simulate_standard(standard)

    heights = make_heights("tops cut")
    first = simulate_filtered(heights)
    second = simulate_filtered(heights * (1 + 1e-15) + 1e-17)
    for one_part, other in zip(
        (first.whole, *first.quarters), (second.whole, *second.quarters), strict=True
    ):
        np.testing.assert_allclose(
            one_part.simulated_share, other.simulated_share, rtol=1e-12, atol=1e-15
        )


def test_a_narrow_strip_is_thinned_less():
    rough = SelfAffine(hurst=0.8, q0=8 * np.pi, q1=48 * np.pi, h_rms=0.01)
    strip = surface.synthesise(rough, n=512, length=1.0, seed=2)[:, :32]
    simulated = simulate_heights(strip, (1.0, 1 / 16), most_points=64)
    assert simulated.pixel == pytest.approx(1 / 512)
    assert np.isfinite(simulated.whole.simulated_share).all()
    with pytest.raises(ValueError, match="32 points"):
        simulate_heights(strip[:, :20], (1.0, 20 / 512))


def test_thinned_maps_keep_their_flat_tops():
    # Ripples of a filter on the plateaus would take the adhesion of worn surfaces away.
    rough = SelfAffine(hurst=0.5, q0=4 * np.pi, q1=64 * np.pi, h_rms=1.0)
    heights = surface.synthesise(rough, n=128, length=1.0, seed=5)
    heights = np.where(heights > -0.3, -0.3 + 0.05 * (heights + 0.3), heights)
    truth = find_trial_states(heights, 1.0)
    simulated = simulate_heights(heights, (1.0, 1.0), most_points=64)
    lacking = simulated.resolved_energy / simulated.whole.full_contact_energy - 1
    assert lacking == pytest.approx(0.0, abs=0.03)
    for place in (-12, -8, -4):
        length = truth.simulated_length[[place]]
        shares = [
            simulated.share(length, truth.simulated_range[[place]], "exponential", *each)[0]
            for each in [(np.zeros(1), np.array([sign])) for sign in (-1.0, 0.0, 1.0)]
        ]
        share = truth.simulated_share[place]
        assert share > 0.1
        assert shares[0] <= share <= shares[2]
        assert shares[1] == pytest.approx(share, rel=0.05)


def test_surfaces_that_touch_at_the_summit_hold_by_a_long_range_at_any_modulus():
    heights = make_heights("Gaussian")
    states = find_trial_states(heights, 1.0)
    range_ = 3 * heights.std()
    rigid = np.mean(np.exp(-(heights.max() - heights) / range_))
    stiff = np.array([1e-6 * states.full_contact_energy])
    assert rigid > 0.1
    assert states.share(stiff, np.array([range_])) == pytest.approx(rigid, rel=1e-2)


def test_states_keep_a_picture_of_their_gaps(simulated):
    heights, states = simulated
    assert states.gap_bin is None
    with pytest.raises(ValueError, match="not kept"):
        states.find_gap(0)
    kept = find_trial_states(heights, 1.0, pictured=True)
    for index, bins in enumerate(kept.gap_bin):
        counts = np.bincount(bins.ravel(), minlength=kept.gap_share.shape[1])
        np.testing.assert_allclose(counts / bins.size, kept.gap_share[index], rtol=1e-12)
    # Surfaces that touch at the summit, in bins that end at 1.17 times their beginning.
    np.testing.assert_allclose(kept.find_gap(0), heights.max() - heights, rtol=0.17)
    # The deepest state is the one that tells the share.
    lengths = kept.full_contact_energy * np.array([0.1, 0.5, 2.0])
    ranges = np.full(3, 0.2 * heights.std())
    for length, range_, share in zip(lengths, ranges, kept.share(lengths, ranges), strict=True):
        (deepest,) = kept.find_deepest(np.array([length]), np.array([range_]))
        attracted = np.exp(-kept.find_gap(deepest) / range_).mean()
        assert attracted - kept.elastic_energy[deepest] / length == pytest.approx(share, abs=1e-9)
