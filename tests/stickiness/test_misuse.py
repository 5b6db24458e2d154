"""What a user may get wrong is refused by name, not answered with a number that means nothing."""

import numpy as np
import pytest

from stickiness import adhesive, criteria, dmt, repulsive, spectrum, surface, units
from stickiness.accuracy import model_choice, multilevel
from stickiness.criteria import a_v_table, equivalent_sphere
from stickiness.measured import instrument_spectrum, psd, topography
from stickiness.persson import Persson
from stickiness.plausibility import PlausibilityWarning
from stickiness.repulsive import subpixel
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


MISUSES = {
    "heights with a hole": (lambda: press(HOLED), "heights must be finite, got"),
    "masked heights": (lambda: press(MASKED), "heights must not be masked, got"),
    "a mask for heights": (lambda: press(HEIGHTS > 0), "heights must be real numbers"),
    "negative length": (lambda: press(length=-1.0), "length must be positive"),
    "text for a pressure": (lambda: press(pressure="0.1"), "pressure must be a number"),
    "no pressure": (lambda: press(pressure=None), "pressure must be a number"),
    "tension": (lambda: press(pressure=-0.1), "pressure must be non-negative"),
    "tolerance in the wrong unit": (lambda: press(tol=10.0), "tol must be positive and at most"),
    "heights for a start": (lambda: press(start=HEIGHTS), "start must be a Contact"),
    "no seed": (lambda: surface.synthesise(BAND, 16, SIDE, None), "seed must be an integer"),
    "negative seed": (lambda: surface.synthesise(BAND, 16, SIDE, -1), "seed must be an integer"),
    "a name for a spectrum": (lambda: surface.synthesise("steel", 16, SIDE, 1), "spectrum must be"),
    "window too small": (lambda: surface.lattice_spectrum(BAND, SIDE / 3), "window does not hold"),
    "window in micrometres, waves per metre": (
        lambda: surface.lattice_spectrum(BAND, 1e6 * SIDE),
        "must be in the inverse of its unit",
    ),
    "window not a number": (lambda: surface.lattice_spectrum(BAND, np.nan), "length must be"),
    "moments of holes": (lambda: surface.moments(HOLED, SIDE), "heights must be finite"),
    "moments of a strip": (lambda: surface.moments(HEIGHTS[:4], SIDE), "heights must be a square"),
    "spectrum of a plane": (
        lambda: surface.realised_spectrum(0 * HEIGHTS, SIDE),
        "heights must not be flat",
    ),
    "Hurst exponent as text": (lambda: band(hurst="0.8"), "hurst must be a number"),
    "height as text": (lambda: band(h_rms="1 nm"), "h_rms must be a number, got '1 nm'"),
    "beyond floats": (lambda: band(q0=1e-200, q1=1e-199), "take a unit of length"),
    "psd at NaN": (lambda: BAND.psd(np.nan), "q must not be negative or NaN"),
    "heights for theory": (lambda: Persson(HEIGHTS), "spectrum must be a Spectrum"),
    "several resolutions": (
        lambda: Persson(BAND).area_fraction(0.1, magnification=[1, 2]),
        "magnification must be a number",
    ),
    "a contact for its gap": (lambda: dmt.attractive_area(press(), 0.1), "gap must be a number"),
    "heights for a gap": (lambda: dmt.attractive_area(HEIGHTS, 0.1), "gap must not be negative"),
    "a number for a law": (lambda: dmt.adhesive_pressure(press().gap, 0.1), "law must be"),
    "slope not a number": (lambda: criteria.inverse_kappa(np.nan), "inverse_kappa_ad must be"),
    "Hurst exponent above 1": (
        lambda: criteria.violano_c0_limit(1.5, 1, 1, 1, 1),
        r"hurst must be in \(0, 1\]",
    ),
    "magnification below 1": (
        lambda: criteria.pastewka_robbins_a_v_power_law(0.8, 0.5),
        "magnification must be at least 1",
    ),
    "one seed for several": (lambda: multilevel.descriptors(BAND, SIDE, 3), "seeds must be"),
    "a gap for its contact": (lambda: subpixel.boundary_strip(HEIGHTS), "contact must be a non-em"),
    "ranges the wrong way round": (
        lambda: dmt.attraction_of_areas([0.3, 0.2, 0.1], [3, 2, 1], LAW),
        "ranges must be an increasing sequence",
    ),
    "too few areas": (
        lambda: dmt.attraction_of_areas([0.1, 0.2], [1, 2, 3], LAW),
        "with one area each",
    ),
    "no load": (lambda: a_v_table.local_a_v(0.1, 0.0, 0.1), "pressure must be positive"),
    "areas of NaN": (
        lambda: a_v_table.edge_range([1, 2], [np.nan, 1], [1, 1]),
        "infinite must be positive and finite",
    ),
    "slope of area not a number": (
        lambda: equivalent_sphere.attraction(1, 1, 1, 0.1, 0.1, 2, kappa_rep=np.nan),
        "kappa_rep must be positive",
    ),
    "error at no strength": (
        lambda: equivalent_sphere.error_factor(1.0, -1.0),
        "strength must be positive",
    ),
    "DMT error at no load": (
        lambda: model_choice.ErrorTable({("maugis", 0.8): ((), 0, 0)}).relative_error(
            "maugis", 0.8, 32, 0.0, 0.1, 0.1
        ),
        "values must be positive",
    ),
    "terms that are no pairs": (
        lambda: moduli.Prony(1.0, ((1.0, 2.0, 3.0),)),
        "terms must be pairs",
    ),
    "falling frequencies": (
        lambda: moduli.crossings(moduli.Constant(1.0), 2.0, [2.0, 1.0]),
        "frequencies must be one increasing",
    ),
    "spectrum of masked heights": (
        lambda: psd.power_spectrum(MASKED, 1.0),
        "heights must not be masked",
    ),
    "spectrum beyond floats": (
        lambda: psd.power_spectrum(1e160 * HEIGHTS, 1.0),
        "heights leave the range of floats",
    ),
    "lay of a plane": (
        lambda: psd.power_spectrum(0 * HEIGHTS, 1.0).anisotropy(1.0, 3.0),
        "no modes between",
    ),
    "a plane, lifted": (lambda: analysed(0 * HEIGHTS + 3), "heights must not be flat, got 3 thr"),
    "a flat line": (
        lambda: instrument_spectrum.analyse(topography.Profile(np.ones(64), 1.0, "test")),
        "heights must not be flat",
    ),
    "an instrument without resolution": (
        lambda: instrument_spectrum.Limits(resolution=0.0),
        "resolution must be positive",
    ),
    "a fit from a negative wavelength": (
        lambda: instrument_spectrum.Limits(fit_from=-1.0),
        "fit_from must be positive",
    ),
    "NaN with a unit": (lambda: units.si("nan m", "m"), "not finite"),
}


@pytest.mark.parametrize("name", MISUSES)
def test_misuse_is_refused_by_name(name):
    call, message = MISUSES[name]
    with pytest.raises(ValueError, match=message):
        call()


@pytest.mark.parametrize("kind", [int, np.uint8, np.float32])
def test_heights_of_any_kind_of_number_are_taken_as_they_are(kind):
    heights = (10 * HEIGHTS + 40).astype(kind)
    before = heights.copy()
    contact = press(heights)
    again = press(heights.astype(float))
    assert contact.gap.tobytes() == again.gap.tobytes()
    assert np.array_equal(heights, before), "the caller's heights were changed"


TOO_COARSE = adhesive.Maugis(0.01, 0.002)
DOUBTS = {
    "pressure in pascals": (lambda: press(pressure=1e5), "divide pascals by E"),
    "pressure in pascals, adhesive": (
        lambda: adhesive.solve(HEIGHTS, SIDE, LAW, pressure=1e5),
        "divide pascals by E",
    ),
    "pressure in pascals, theory": (lambda: Persson(BAND).area_fraction(1e5), "divide pascals by"),
    "heights in um, length in m": (lambda: press(length=1e-6 * SIDE), "must be in one unit"),
    "heights in m, length in nm": (lambda: press(length=1e9 * SIDE), "must be in one unit"),
    "heights in um, length in m, adhesive": (
        lambda: adhesive.solve(HEIGHTS, 1e-6 * SIDE, adhesive.Exponential(1e-3, 1.0), pressure=0),
        "must be in one unit",
    ),
    "range far below what the pixels show": (
        lambda: adhesive.solve(HEIGHTS, SIDE, TOO_COARSE, pressure=0.1),
        "Take pixels of at most 0.0002 ",
    ),
}


@pytest.mark.parametrize("name", DOUBTS)
def test_what_is_probably_a_mistake_is_said(name):
    call, message = DOUBTS[name]
    with pytest.warns(PlausibilityWarning, match=message):
        call()


@pytest.mark.parametrize("magnification", [4.0, 1e4])
def test_surfaces_of_unit_height_and_steep_slopes_are_no_mistake(magnification):
    """Nothing is warned of: slopes of 30 and pressures above 1 are normal in units of h_rms."""
    theory = Persson(spectrum.SelfAffine(hurst=0.6, q0=1.0, q1=magnification, h_rms=1.0))
    assert theory.area_fraction(20.0) > 0.4
    contact = press(10 * HEIGHTS, pressure=20.0)
    assert 0 < contact.area_fraction < 1
