"""`Surface` from whatever source, and what two rough solids have in common."""

import warnings

import numpy as np
import pytest
from helpers.analysed import wall

from stickiness import Material, Surface, judge, thresholds, verdict
from stickiness.adhesive import solve
from stickiness.criteria.pair import NOT_JUDGED
from stickiness.plausibility import PlausibilityWarning
from stickiness.solids import Layer
from stickiness.spectrum import SelfAffine
from stickiness.surface import lattice_spectrum, realised_spectrum, synthesise
from stickiness.traction_laws import Exponential
from stickiness.verdicts.surface_data import tabulate_ends

pytestmark = pytest.mark.usefixtures("coarse_simulation")

BAND = {"hurst": 0.8, "q0": 6e5, "q1": 6e7}
TAPE = {"youngs_modulus": 2e6, "work_of_adhesion": 0.06, "range": 3e-10}
SIDE = 2 * np.pi / 6e5


@pytest.fixture(scope="module")
def measured():
    heights = synthesise(SelfAffine(**BAND, h_rms=1e-7), n=256, length=SIDE, seed=1)
    return Surface.from_heights(heights, SIDE)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Surface.from_drawing(Ra=(3e-7, 1e-8)), "Ra must be .low, high., got"),
        (lambda: Surface.from_drawing(Ra=(1e-7, 2e-7, 3e-7)), "Ra must have at most 2 values"),
        (lambda: Surface.from_drawing(Ra=1e-7, Rq=1e-7), "exactly one of: Ra; Rq"),
        (
            lambda: Surface.from_spectrum(
                SelfAffine(**BAND, h_rms=2e-7), SelfAffine(**BAND, h_rms=1e-7)
            ),
            "rough must have the higher rms height",
        ),
        (
            lambda: Surface.from_spectrum(
                SelfAffine(**BAND, h_rms=1e-7), SelfAffine(**BAND | {"q1": 6e8}, h_rms=2e-7)
            ),
            "rough must have the band",
        ),
        (
            lambda: Surface.from_heights(np.ones((8, 8)), SIDE, extend_to="1 kg"),
            "is in kg",
        ),
        (lambda: Surface.from_heights(np.ones((8, 8)), SIDE, channel=1), "channel: the key is unk"),
        (lambda: Surface.from_heights(np.ones((8, 8)), "1"), "length '1' has no unit"),
        (lambda: Surface.from_profile(np.ones(20), "1,5 mm"), "length '1,5 mm' holds a comma"),
        (
            lambda: Surface.from_heights(np.ones((8, 8)), SIDE, window="box"),
            "window must be one of",
        ),
        (lambda: Surface.from_drawing(Ra="0.4 mm", RSm="60 um"), "is too narrow"),
        (lambda: judge(Material(**TAPE), [wall()]), "materials must be a list or"),
        (lambda: judge([Material(**TAPE)], [SelfAffine(**BAND, h_rms=1e-7)]), "surfaces must be"),
        (lambda: verdict(Material(**TAPE), wall()), "surface must be a Surface"),
        (lambda: verdict("wall.txt", Material(**TAPE)), "Surface.read opens a file"),
        (lambda: Material(**TAPE, surface=SelfAffine(**BAND, h_rms=1e-7)), "surface must be"),
    ],
)
def test_mistakes_are_named(make, message):
    with pytest.raises(ValueError, match=message):
        make()


@pytest.mark.slow
def test_two_rough_solids_may_change_places(measured):
    """One measured, the other known exactly: the draws of the measured one decide in both."""
    known = Surface.from_spectrum(SelfAffine(**BAND, h_rms=1e-7))
    first = verdict(measured, Material(**TAPE, surface=known))
    second = verdict(known, Material(**TAPE, surface=measured))
    assert first.remaining == pytest.approx(second.remaining, rel=1e-9)
    assert first.remaining_limits == pytest.approx(second.remaining_limits, rel=1e-9)


@pytest.mark.slow
def test_profiles_of_a_worn_surface_tell_what_remains_on_it():
    """Against simulation on the heights, of which profiles of 16 of the longest waves are cut."""
    count = 16
    length = count * SIDE
    spectrum = SelfAffine(hurst=0.8, q0=6e5, q1=6e6, h_rms=1e-7)
    heights = synthesise(spectrum, n=512, length=length, seed=40, skewness=-1.0)
    adhesion_length = 0.5 * realised_spectrum(heights, length).elastic_energy()
    law = Exponential(adhesion_length, np.sqrt(2 * length / 512 * adhesion_length))
    state = solve(heights, length, law, pressure=0.0, start="separation", tol=1e-3)
    share = -state.energy / adhesion_length
    material = Material(
        youngs_modulus=1e6, work_of_adhesion=adhesion_length * 4e6 / 3, range=law.range
    )

    def find_shares(profile, **shape):
        surface = Surface.from_profile(profile, length, extend_to=SIDE / 10, plausibility="ignore")
        surface = Surface(surface.data.assign(shape))
        judged = judge([material], [surface], curves=False, thresholds=False)
        return judged.remaining.sel(limit=["low", "high"]).values.ravel()

    for profile in (heights[0], heights[:, 256]):
        low, high = find_shares(profile)
        assert low < share < high
        # The spectrum alone does not tell.
        assert find_shares(profile, shape=0.0, shape_error=0.0)[1] < share


def test_a_continued_spectrum_has_the_end_of_the_measured_one_once():
    """The last ring of 52 x 52 points lies within 1 % of that end."""
    rough = SelfAffine(hurst=0.8, q0=6e5, q1=3.6e6, h_rms=1e-7)
    heights = synthesise(rough, n=52, length=4 * SIDE, seed=1)
    extended = Surface.from_heights(heights, 4 * SIDE, extend_to=SIDE / 100)
    assert np.diff(np.log(extended.data.wave_number)).min() > 0.05


def test_nothing_is_said_of_a_pair_that_is_not_judged():
    noise = 1e-9 * np.random.default_rng(1).normal(size=(128, 128))
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # of limits that there are not
        answer = thresholds(noise, length=1e-5, **TAPE)
    assert np.isnan(answer.modulus).all()
    rough = Surface.from_spectrum(SelfAffine(**BAND, h_rms=1e-12))
    with pytest.warns(PlausibilityWarning, match="h_rms = 1e-12 .* atoms are larger"):
        answer = verdict(rough, Material(**TAPE))
    assert judge([Material(**TAPE)], [rough]).verdict == NOT_JUDGED
    assert "modulus_threshold" not in answer.to_dict()


@pytest.mark.parametrize("q0", [1e-3, 1.0, 1e3])
def test_strain_of_a_thin_incompressible_layer_is_finite(q0):
    """It tends to 3 h_rms/(q0 d^2) of a plate that is sheared between parallel walls."""
    layer = Layer(thickness=5e-5, poisson=0.5)
    assert layer.strain(1e-6, q0) == pytest.approx(3 * 1e-6 / (q0 * 5e-5**2), rel=1e-9)


def test_a_periodic_cell_keeps_the_direction_of_its_heights():
    ground = SelfAffine(**BAND, h_rms=1e-7, anisotropy=4.0)
    shells = lattice_spectrum(ground, length=2 * SIDE)
    columns = Surface.from_spectrum(shells).find_columns()
    assert columns["anisotropy_error_factor"] == pytest.approx(2.0)


@pytest.mark.slow
def test_masked_points_of_heights_count_as_missing():
    band = SelfAffine(hurst=0.8, q0=6e5, q1=3e7, h_rms=1e-7)
    heights = synthesise(band, n=128, length=SIDE, seed=1)
    missing = np.zeros(heights.shape, dtype=bool)
    missing[30, 60:64] = True
    missing[20, 5] = True
    of_masked = np.ma.array(np.where(missing, 1e300, heights), mask=missing)
    of_missing = np.where(missing, np.nan, heights)
    for answer in (verdict, thresholds):
        masked = answer(of_masked, length=SIDE, **TAPE)
        assert repr(masked) == repr(answer(of_missing, length=SIDE, **TAPE))
    complete = thresholds(heights, length=SIDE, **TAPE)
    assert masked.modulus.value == pytest.approx(complete.modulus.value, rel=0.02)


@pytest.mark.parametrize("unit", [1.0, 1e-6])
def test_the_reference_line_of_a_spectrum_of_its_exponent_is_the_spectrum(unit):
    s = SelfAffine(hurst=0.8, q0=3.0 / unit, q1=300.0 / unit, h_rms=unit)
    ends = tabulate_ends(s, s)
    assert ends.C0_reference_upper[0] == pytest.approx(s.C0, rel=1e-9)
