"""Surfaces by the parameters of drawings, and the parameters of measured heights."""

import numpy as np
import pytest
from references import profile_parameters

from stickiness import Surface
from stickiness.measured import texture
from stickiness.spectrum import SelfAffine

pytestmark = pytest.mark.processors

CUTOFF, FILTER, STEP = 0.8e-3, 2.5e-6, 1e-6
POINTS = int(7 * CUTOFF / STEP)

# ISO 4288 (1996), tables 1 and 3: largest Ra [um] or RSm [mm] of a row, and the cut-offs [m] of
# this row and the next.
ENDS_OF_RA = [(0.02, 0.08e-3), (0.1, 0.25e-3), (2.0, 0.8e-3), (10.0, 2.5e-3)]
NEXT_TO_RA = [(0.02, 0.25e-3), (0.1, 0.8e-3), (2.0, 2.5e-3), (10.0, 8e-3)]
ENDS_OF_RSM = [(0.04, 0.08e-3), (0.13, 0.25e-3), (0.4, 0.8e-3), (1.3, 2.5e-3)]
NEXT_TO_RSM = [(0.04, 0.25e-3), (0.13, 0.8e-3), (0.4, 2.5e-3), (1.3, 8e-3)]


def test_parameters_of_a_sine_are_its_closed_forms():
    heights = 1e-6 * np.sin(2 * np.pi * np.arange(POINTS) * STEP / 80e-6)
    ra, rq, rz, rsm = profile_parameters.evaluate(heights, STEP, CUTOFF, FILTER)
    passed = np.exp(-np.pi * (profile_parameters.ALPHA * 2.5 / 80) ** 2)
    assert ra == pytest.approx(2e-6 / np.pi * passed, rel=2e-3)
    assert rq == pytest.approx(1e-6 / np.sqrt(2) * passed, rel=2e-3)
    assert rz == pytest.approx(2e-6 * passed, rel=2e-3)
    assert rsm == pytest.approx(80e-6, rel=1e-6)


def test_synthetic_profiles_have_the_spectrum_of_their_surface():
    s = SelfAffine(hurst=0.8, q0=2e5, q1=2e6, h_rms=1e-6)
    rng = np.random.default_rng(1)
    lines = [profile_parameters.synthesise(s, 8192, 1e-7, rng) for _ in range(20)]
    assert np.mean(np.square(lines)) == pytest.approx(s.h_rms**2, rel=0.1)
    slope = np.diff(lines, axis=1) / 1e-7
    assert np.mean(slope**2) == pytest.approx(s.rms_slope**2 / 2, rel=0.15)


@pytest.mark.parametrize("rolloff", [0.03, 0.1, 0.3, 1.0])
@pytest.mark.parametrize("hurst", [0.6, 0.8, 1.0])
def test_energy_of_a_surface_lies_between_the_ends_of_its_drawing(hurst, rolloff):
    for seed, shortest in enumerate((1e-9, 1e-6)):
        band = {"q0": 2 * np.pi / (5 * CUTOFF), "q1": 2 * np.pi / shortest}
        s = SelfAffine(hurst=hurst, q_rolloff=2 * np.pi / (rolloff * CUTOFF), h_rms=1e-6, **band)
        rng = np.random.default_rng(seed)
        lines = [profile_parameters.synthesise(s, POINTS, STEP, rng) for _ in range(10)]
        measured = [profile_parameters.evaluate(h, STEP, CUTOFF, FILTER) for h in lines]
        # One profile of five sampling lengths scatters; a drawing means their mean.
        ra, rq, rz, rsm = np.mean(measured, axis=0)
        assert ra * texture.RQ_OVER_RA == pytest.approx(rq, rel=0.05)
        assert texture.RZ_OVER_RQ[0] < rz / rq < texture.RZ_OVER_RQ[1]
        for width, most in ((None, 60), (rsm, 8)):
            drawn = Surface.from_drawing(Ra=ra, RSm=width, lambda_c=CUTOFF)
            low, high = drawn.family.energy()
            assert low < s.elastic_energy() < high
            assert high < most * low


@pytest.mark.parametrize(
    ("ra", "rsm", "cutoff"),
    [
        (0.05e-6, 0, 0.25e-3),
        (0.8e-6, 0, 0.8e-3),
        (2e-6, 0, 0.8e-3),  # the end of a row belongs to it
        (0.8e-6, 1e-3, 2.5e-3),
        (99e-6, 0, 8e-3),
        # 2 % within and beyond the end of every row
        *[(0.98 * ra * 1e-6, 0, cutoff) for ra, cutoff in ENDS_OF_RA],
        *[(1.02 * ra * 1e-6, 0, cutoff) for ra, cutoff in NEXT_TO_RA],
        *[(1e-9, 0.98 * rsm * 1e-3, cutoff) for rsm, cutoff in ENDS_OF_RSM],
        *[(1e-9, 1.02 * rsm * 1e-3, cutoff) for rsm, cutoff in NEXT_TO_RSM],
    ],
)
def test_cutoffs_are_those_of_the_standard(ra, rsm, cutoff):
    assert texture.standard_cutoff(ra, rsm) == cutoff


def test_a_drawing_without_a_cutoff_has_that_of_the_standard():
    # Cut-offs of 0.8 and 2.5 mm; wave numbers of the surface are in inverse proportion.
    low, high = (float(Surface.from_drawing(Ra=each).data.q0) for each in (1.9e-6, 2.1e-6))
    assert low / high == pytest.approx(2.5 / 0.8, rel=1e-9)
    # Rq is 1.2533 times Ra on Gaussian heights.
    for height, q0 in ((1.9e-6, low), (2.1e-6, high)):
        of_rq = Surface.from_drawing(Rq=1.2533 * height)
        assert float(of_rq.data.q0) == pytest.approx(q0, rel=1e-9)


def test_parameters_of_heights_are_their_closed_forms(tmp_path):
    # Heights with an exponential distribution: Sa = 2/e, Sq = 1, Ssk = 2.
    level = -np.log1p(-(np.arange(2**16) + 0.5) / 2**16)
    np.save(tmp_path / "a.npy", np.random.default_rng(0).permutation(level).reshape(256, 256))
    surface = Surface.read(
        tmp_path / "a.npy", length="1 mm", height_unit="um", spikes="keep", detrend="mean"
    )
    data = surface.data
    sizes = [data[name] * 1e6 for name in ("mean_deviation", "h_rms_measured", "height_range")]
    np.testing.assert_allclose(sizes, [2 / np.e, 1, np.ptp(level)], rtol=1e-3)
    assert data.skewness == pytest.approx(2, rel=1e-2)
