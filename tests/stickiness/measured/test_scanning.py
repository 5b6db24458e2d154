"""Faults of scanning are found and mended, and surfaces without them stay to the bit."""

import numpy as np
import pytest
import scipy

from common.topographies import FAMILIES, make_topography
from stickiness import Surface, thresholds
from stickiness.entries import check_heights
from stickiness.measured import scanning, topography
from stickiness.measured.levelling import detrend
from stickiness.measured.measurement import Measurement
from stickiness.remaining.errors import PATCH
from stickiness.remaining.trial_states import DEFAULT_SHARE

N = 128
ROW = np.arange(N)


def rough(seed=0, hurst=0.8, longest=0.1, ratio=1.0, across=0.0, n=N):
    """Self-affine map of unit rms, whose lay makes an angle with x."""
    q = n * np.array(np.meshgrid(np.fft.fftfreq(n), np.fft.fftfreq(n), indexing="ij"))
    along = np.cos(across) * q[0] + np.sin(across) * q[1]
    beside = np.cos(across) * q[1] - np.sin(across) * q[0]
    q = np.hypot(along * np.sqrt(ratio), beside / np.sqrt(ratio))
    noise = np.random.default_rng(seed).standard_normal((n, n))
    modes = np.fft.fft2(noise) * np.maximum(q, 1 / longest) ** (-1 - hurst)
    modes[0, 0] = 0
    heights = np.fft.ifft2(modes).real
    return heights / heights.std()


SURFACES = {
    "isotropic": rough,
    "ground": lambda seed: rough(seed, longest=0.15, ratio=6.0, across=np.pi / 2),
    "honed": lambda seed: make_topography("plateau_honed", N, 8, seed),
}


def rows(heights, strength, rng):
    return heights + rng.normal(0, strength, N)


def tilts(heights, strength, rng):
    tilted = np.linspace(-1, 1, N)[:, None] * rng.normal(0, strength, N)
    return rows(heights, strength / 2, rng) + tilted


def jump(heights, strength, rng):
    return heights + strength * rng.choice([-1, 1]) * (rng.integers(20, 100) <= ROW)


def creep(heights, strength, rng):
    return heights + strength * np.exp(-ROW / 8)


def creep_of_logarithm(heights, strength, rng):
    return heights - strength * np.log((1 + ROW / 3) / (1 + N / 3))


def drift(heights, strength, rng):
    t = np.linspace(-1, 1, N)
    return heights + strength * (t**2 + 0.3 * t**3 + rng.uniform(-1, 1) * t)


def bow(heights, strength, rng):
    return drift(heights.T, strength, rng).T


def scars(heights, strength, rng):
    heights = heights.copy()
    for row in rng.choice(np.arange(3, N - 3, 4), 9, replace=False):
        first = rng.integers(0, 80)
        points = slice(first, first + rng.integers(15, 40))
        heights[points, row : row + rng.choice([1, 2])] += rng.normal(strength, strength / 4)
    return heights


def hum(heights, strength, rng):
    """Pickup sample after sample, with a fly-back as long as the row."""
    samples = ROW[:, None] + 2.03 * N * ROW
    return heights + strength * np.sin(2 * np.pi * samples / 7.3 + rng.uniform(0, 6))


FAULTS = {
    rows: (0.3, 1.0),
    tilts: (0.5, 1.0),
    jump: (4.0, 10.0),
    creep: (15.0, 40.0),
    creep_of_logarithm: (10.0, 40.0),
    drift: (30.0, 60.0),
    bow: (30.0, 60.0),
    scars: (8.0, 15.0),
    hum: (0.3, 1.0),
}
CASES = [(fault, strength) for fault, strengths in FAULTS.items() for strength in strengths]


def slope(heights):
    return np.sqrt(sum(np.mean(np.diff(heights, axis=axis) ** 2) for axis in (0, 1)))


def used(heights, **options):
    """Heights as they are used, and the remarks."""
    read = topography.from_array(1e-9 * heights, 20e-9, **options)
    return detrend(read.heights) * 1e9, read.remarks


@pytest.mark.parametrize("name", SURFACES)
@pytest.mark.parametrize(("fault", "strength"), CASES)
def test_fault_is_found_and_mended(fault, strength, name):
    for seed in range(3):
        true = SURFACES[name](seed)
        faulty = fault(true, strength, np.random.default_rng(100 + seed))
        heights, remarks = used(faulty)
        assert remarks, seed
        before = np.std(detrend(faulty - true))
        # Offsets keep what is smooth over several rows.
        assert np.std(detrend(heights - true)) < max(0.6 * before, 0.25)
        assert np.std(heights) == pytest.approx(np.std(detrend(true)), rel=0.12)
        assert slope(heights) == pytest.approx(slope(true), rel=0.15)


def find_threshold(heights):
    material = {"youngs_modulus": "8 GPa", "work_of_adhesion": "50 mJ/m^2", "range": "0.3 nm"}
    surface = Surface.from_heights(1e-9 * heights, 2.5e-6)
    return thresholds(surface, **material).modulus


@pytest.fixture(scope="module")
def true_threshold():
    return find_threshold(rough()).value


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::stickiness.plausibility.PlausibilityWarning")
@pytest.mark.parametrize("fault", [rows, creep, scars])
def test_limits_contain_the_truth(fault, true_threshold):
    found = find_threshold(fault(rough(), FAULTS[fault][1], np.random.default_rng(0)))
    assert found.low < true_threshold < found.high
    assert found.value == pytest.approx(true_threshold, rel=0.35)


def energy(heights):
    """Elastic energy of full contact, up to a factor, of the heights and their mirror images."""
    orders = np.hypot(*np.meshgrid(ROW, ROW, indexing="ij"))
    return np.sum(orders * scipy.fft.dctn(detrend(heights), norm="ortho") ** 2)


def test_limits_of_maps_hold_what_mending_leaves():
    """Mended heights have the energy of the true ones, beside the error of an even map."""
    errors = []
    for number, family in enumerate(FAMILIES):
        true = make_topography(family, N, 4, 11)
        true = true / true.std()
        for fault, (_, strength) in FAULTS.items():
            mended, remarks = used(fault(true, strength, np.random.default_rng(number)))
            assert remarks, (family, fault)
            errors.append(np.log(energy(mended) / energy(true)))
    of_map = PATCH.half_width(0.1, 115, DEFAULT_SHARE)
    added = np.hypot(of_map, np.quantile(np.abs(errors), 0.9)) / of_map - 1
    assert added < 0.1


@pytest.mark.parametrize("fault", [rows, jump, creep, scars, hum])
def test_fast_axis_may_be_either(fault):
    strength = FAULTS[fault][1]
    faulty = fault(rough(), strength, np.random.default_rng(0))
    along, remarks = used(faulty)
    across, transposed = used(np.ascontiguousarray(faulty.T))
    np.testing.assert_allclose(across.T, along, atol=1e-9)
    assert len(remarks) == len(transposed) == 1
    assert remarks != transposed


def directional():
    for seed in range(3):
        for across in (0.0, np.pi / 2, 0.3):
            for ratio in (6.0, 30.0):
                yield f"ground {ratio:g} {across:.1f}", rough(seed, 0.6, 0.2, ratio, across)
        for family in ("turned", "printed", "terraced", "plateau_honed", "scratched"):
            heights = make_topography(family, N, 6, seed)
            yield family, heights
            yield f"{family}, transposed", heights.T
        # The same in all rows.
        for hurst in (0.5, 0.8):
            profile = rough(seed, hurst, 0.2)[5]
            lay = np.tile(profile / profile.std(), (N, 1))
            yield f"lay {hurst}", lay + 0.1 * rough(seed, longest=0.05)
            yield f"steps {hurst}", np.rint(2 * lay) + 0.1 * rough(seed, longest=0.05)
    for family in FAMILIES:
        yield family, make_topography(family, N, 4, 7, shortest=2.0)


def test_surfaces_with_a_direction_stay_to_the_bit():
    surfaces = list(directional())
    assert len(surfaces) > 60
    for name, heights in surfaces:
        mended = scanning.mend(heights)
        assert mended.heights is heights, (name, mended.remarks)
        assert not mended.doubts, name


@pytest.mark.parametrize("form", ["sphere", "cylinder", "cap"])
def test_forms_are_left_to_levelling(form):
    x, y = np.meshgrid(*2 * [np.linspace(-1, 1, N)], indexing="ij")
    forms = {"sphere": x**2 + y**2, "cylinder": x**2, "cap": np.sqrt(4 - x**2 - y**2)}
    heights = rough() + 30 * forms[form]
    assert scanning.mend(heights).heights is heights


def test_noise_of_points_and_gratings_are_no_offsets_of_rows():
    noise = np.random.default_rng(0).standard_normal((N, N))
    for heights in (noise, rough(longest=0.3) + 0.1 * noise):
        assert scanning.mend(heights).heights is heights
    for period in (3, 4, 6, 64):
        grating = (period // 2 <= ROW % period) + 0.05 * rough()
        assert scanning.mend(grating).heights is grating


@pytest.mark.parametrize("sign", [1, -1])
def test_an_oblique_wave_that_is_resolved_is_asked_about(sign):
    heights = rough() + 4.0 * np.sin(2 * np.pi * (ROW[:, None] / 12.6 + sign * ROW / 7.45))
    mended = scanning.mend(heights)
    assert mended.heights is heights
    assert mended.remarks == []
    assert "of 12.6 points along x and 7.45 points along y" in mended.kept
    # Whoever says that all of it is a fault has it subtracted.
    subtracted = scanning.mend(heights, "mend")
    assert np.std(subtracted.heights - rough()) < 0.1 * np.std(heights - rough())
    (guess,) = topography.from_array(heights, 1e-9).guesses
    assert guess.options == ({"scan": "keep"}, {"scan": "mend"})


def test_the_period_and_the_amplitude_of_hum_are_told():
    along = ROW[:, None] / 11.37 + ROW / 2.06
    _, (remark,) = used(rough() + 2.0 * np.sin(2 * np.pi * along))
    assert "amplitude 2 nm, of 11.4 points along x and 2.06 points along y" in remark


def test_keep_and_align():
    faulty = rows(rough(), 0.3, np.random.default_rng(0))
    kept, remarks = used(faulty, scan="keep")
    assert not remarks
    np.testing.assert_allclose(kept, detrend(faulty), atol=1e-9)
    aligned, remarks = used(rough(), scan="align")
    np.testing.assert_allclose(np.ptp(np.median(aligned, axis=0)), 0, atol=0.15)
    assert "scan: align" in remarks[-1]


def test_remarks_name_rows_and_heights():
    _, (remark,) = used(rough() + 5.0 * (ROW >= 40))
    assert "from row 40 along y on" in remark
    assert "nm off" in remark
    faulty = scars(rough(), 12.0, np.random.default_rng(1))
    _, (remark,) = used(faulty)
    assert "scars" in remark
    assert "streaks along x" in remark


def test_scars_are_shown_as_unused():
    heights = rough()
    heights[30:60, 50] += 12
    read = topography.from_array(1e-9 * heights, 20e-9)
    assert read.unused[31:59, 50].all()
    assert read.count(topography.FILL) == read.unused.sum() <= 34
    np.testing.assert_array_equal(read.as_read, 1e-9 * heights)


def test_missing_points_do_not_hide_faults():
    faulty = rows(rough(), 0.5, np.random.default_rng(0))
    faulty[20:30, 40:50] = np.nan
    heights, (remark,) = used(faulty)
    assert "random heights" in remark
    assert np.isfinite(heights).all()


def test_what_cannot_be_mended_is_not_judged():
    tiles = rough()
    tiles[:64, 60:] += 5
    tiles[64:, 60:] -= 3
    assert "tiles are stitched" in scanning.mend(tiles).doubts[0]
    swamped = rows(rough(), 200.0, np.random.default_rng(0))
    assert "scan again" in scanning.mend(swamped).doubts[0]


def test_measurement_takes_the_key():
    faulty = 1e-9 * rows(rough(), 0.8, np.random.default_rng(0))
    assert Measurement.from_array(faulty, 20e-9, check_heights({})).heights.remarks
    assert not Measurement.from_array(
        faulty, 20e-9, check_heights({"scan": "keep"})
    ).heights.remarks
    with pytest.raises(
        ValueError, match="scan must be 'detect', 'mend', 'align' or 'keep', got 'flat'"
    ):
        topography.from_array(faulty, 20e-9, scan="flat")


def test_parts_without_a_point_are_no_obstacle():
    faulty = jump(rough(), 10.0, np.random.default_rng(0))
    faulty[:20] = np.nan
    mended = scanning.mend(faulty)
    assert len(mended.remarks) == 1
    assert np.nanstd(mended.heights) == pytest.approx(np.std(rough()), rel=0.1)
