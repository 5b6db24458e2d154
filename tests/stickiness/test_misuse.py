"""What a user may get wrong is refused by name, not answered with a number that means nothing."""

import numpy as np
import pytest

from stickiness import adhesive, criteria, dmt, repulsive, spectrum, surface, units
from stickiness.accuracy import model_choice, multilevel
from stickiness.adhesive import edge_zone
from stickiness.criteria import a_v_table, equivalent_sphere, formulas
from stickiness.measured import instrument_spectrum, levelling, psd, topography
from stickiness.persson import Persson
from stickiness.plausibility import PlausibilityWarning
from stickiness.repulsive import richardson, subpixel
from stickiness.solids import moduli

SIDE = 2 * np.pi
BAND = spectrum.SelfAffine(hurst=0.8, q0=1.0, q1=4.0, h_rms=1.0)
HEIGHTS = surface.synthesise(BAND, 16, SIDE, seed=1)
HOLED = HEIGHTS.copy()
HOLED[3, 4] = np.nan
MASKED = np.ma.masked_greater(HEIGHTS, 1.0)
LAW = adhesive.Exponential(0.01, 0.1)


def band(**changes):
    return spectrum.SelfAffine(**({"hurst": 0.8, "q0": 1.0, "q1": 4.0, "h_rms": 1.0} | changes))


def analysed(heights):
    return instrument_spectrum.analyse(topography.Topography(heights, 1.0, 1.0, "test"))


def press(heights=HEIGHTS, length=SIDE, pressure=0.1, **options):
    return repulsive.solve(heights, length, pressure, **options)


MISUSES = [
    (lambda: press(HOLED), "heights must be finite, got"),
    (lambda: press(MASKED), "heights must not be masked, got"),
    (lambda: press(HEIGHTS > 0), "heights must be real numbers"),
    (lambda: press(length=-1.0), "length must be positive"),
    (lambda: press(pressure="0.1"), "pressure must be a number"),
    (lambda: press(pressure=-0.1), "pressure must be non-negative"),
    (lambda: press(tol=10.0), "tol must be positive and at most"),
    (lambda: press(start=HEIGHTS), "start must be a Contact"),
    (lambda: surface.synthesise(BAND, 16, SIDE, None), "seed must be an integer"),
    (lambda: surface.synthesise(BAND, 16, SIDE, 1, "uniform"), "amplitudes must be 'gaussian' or"),
    (lambda: surface.synthesise("steel", 16, SIDE, 1), "spectrum must be"),
    (lambda: surface.lattice_spectrum(BAND, SIDE / 3), "window does not hold"),
    (lambda: surface.lattice_spectrum(BAND, 1e6 * SIDE), "must be in the inverse of its unit"),
    (lambda: surface.moments(HOLED, SIDE), "heights must be finite"),
    (lambda: surface.moments(HEIGHTS[:4], SIDE), "heights must be a square"),
    (lambda: surface.realised_spectrum(0 * HEIGHTS, SIDE), "heights must not be flat"),
    (lambda: band(hurst="0.8"), "hurst must be a number"),
    (lambda: band(q0=1e-200, q1=1e-199), "take a unit of length"),
    (lambda: BAND.psd(np.nan), "q must not be negative or NaN"),
    (lambda: Persson(HEIGHTS), "spectrum must be a Spectrum"),
    (lambda: dmt.attractive_area(press(), 0.1), "gap must be a number"),
    (lambda: dmt.adhesive_pressure(press().gap, 0.1), "law must be"),
    (lambda: criteria.inverse_kappa(np.nan), "inverse_kappa_ad must be"),
    (lambda: criteria.pastewka_robbins_a_v_power_law(0.8, 0.5), "magnification must be at least 1"),
    (lambda: formulas.jtb_limit(1.0, None, 0.1), "adhesion_length must be a number, got None"),
    (lambda: multilevel.descriptors(BAND, SIDE, 3), "seeds must be"),
    (lambda: subpixel.boundary_strip(HEIGHTS), "contact must be a non-em"),
    (
        lambda: dmt.sum_over_gaps([0.3, 0.2, 0.1], [3, 2, 1], LAW.traction),
        "ranges must be an increasing sequence",
    ),
    (lambda: dmt.sum_over_gaps([0.1, 0.2], [1, 2, 3], LAW.traction), "with one area each"),
    (lambda: a_v_table.local_a_v(0.1, 0.0, 0.1), "pressure must be positive"),
    (
        lambda: a_v_table.edge_range([1, 2], [np.nan, 1], [1, 1]),
        "infinite must be positive and finite",
    ),
    (
        lambda: equivalent_sphere.attraction(1, 1, 1, 0.1, 0.1, 2, kappa_rep=np.nan),
        "kappa_rep must be positive",
    ),
    (lambda: equivalent_sphere.error_factor(1.0, -1.0), "strength must be positive"),
    (
        lambda: model_choice.relative_error(
            {("maugis", 0.8): ((), 0, 0)}, "maugis", 0.8, 32, 0.0, 0.1, 0.1
        ),
        "values must be positive",
    ),
    (lambda: edge_zone.resolution(0.1, 0.0, 0.1), "range must be positive"),
    (lambda: moduli.Prony(1.0, ((1.0, 2.0, 3.0),)), "terms must be pairs"),
    (
        lambda: moduli.crossings(moduli.Constant(1.0), 2.0, [2.0, 1.0]),
        "frequencies must be one increasing",
    ),
    (lambda: moduli.crossings(moduli.Constant(1.0), 2.0, [-1.0, 1.0]), "frequencies must be posit"),
    (lambda: richardson.estimate("area", [1, 2], 0, 1), "quantity must be one of area_fr"),
    (lambda: richardson.estimate("mean_gap", [1], 0, 1), "two or three grids, got 1"),
    (lambda: richardson.estimate("mean_gap", [1, np.nan], 0, 1), "values and part must be finite"),
    (lambda: richardson.estimate("mean_gap", [1, 2], 0, -1), "edges must not be negative"),
    (lambda: levelling.fill_missing(HEIGHTS * np.nan, 1), "256 of 256 points, which are all,"),
    (lambda: psd.power_spectrum(1e160 * HEIGHTS, 1.0), "heights leave the range of floats"),
    (lambda: psd.power_spectrum(0 * HEIGHTS, 1.0).anisotropy(1.0, 3.0), "no modes between"),
    (lambda: analysed(0 * HEIGHTS + 3), "heights must not be flat, got 3 thr"),
    (lambda: instrument_spectrum.tip_cutoff(HEIGHTS, (1.0, 1.0), 0.0), "radius must be positive"),
    (lambda: instrument_spectrum.Limits(resolution=0.0), "resolution must be positive"),
    (lambda: units.si("nan m", "m"), "not finite"),
]


@pytest.mark.parametrize(("call", "message"), MISUSES, ids=[message for _, message in MISUSES])
def test_misuse_is_refused_by_name(call, message):
    with pytest.raises(ValueError, match=message):
        call()


def test_a_missing_argument_is_named_with_its_function():
    with pytest.raises(TypeError, match="jtb_limit: missing a required argument"):
        formulas.jtb_limit(1.0)


@pytest.mark.parametrize("kind", [int, np.uint8, np.float32])
def test_heights_of_any_kind_of_number_are_taken_as_they_are(kind):
    heights = (10 * HEIGHTS + 40).astype(kind)
    heights = np.repeat(heights, 2, axis=1)[:, ::2]  # of any layout
    before = heights.copy()
    contact = press(heights)
    again = press(heights.astype(float))
    assert contact.gap.tobytes() == again.gap.tobytes()
    assert np.array_equal(heights, before), "the caller's heights were changed"


TOO_COARSE = adhesive.Maugis(0.01, 0.002)
DOUBTS = [
    (lambda: press(pressure=1e5), "divide pascals by E"),
    (lambda: adhesive.solve(HEIGHTS, SIDE, LAW, pressure=1e5), "divide pascals by E"),
    (lambda: press(length=1e-6 * SIDE), "must be in one unit"),
    (
        lambda: adhesive.solve(HEIGHTS, SIDE, TOO_COARSE, pressure=0.1),
        "Take pixels of at most 0.0002 ",
    ),
]


@pytest.mark.parametrize(("call", "message"), DOUBTS, ids=[message for _, message in DOUBTS])
def test_what_is_probably_a_mistake_is_said(call, message):
    with pytest.warns(PlausibilityWarning, match=message):
        call()
