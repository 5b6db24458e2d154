"""What a user may get wrong is refused by name, not answered with a number that means nothing."""

import numpy as np
import pytest

import stickiness
from stickiness import (
    Material,
    Surface,
    adhesive,
    criteria,
    dmt,
    full_contact_energy,
    repulsive,
    spectrum,
    surface,
    units,
    verdict,
)
from stickiness.accuracy import model_choice, multilevel
from stickiness.adhesive import edge_zone
from stickiness.criteria import a_v_theory, equivalent_sphere, formulas
from stickiness.measured import instrument_spectrum, levelling, periodic, psd, topography
from stickiness.persson import Persson
from stickiness.plausibility import PlausibilityWarning
from stickiness.remaining import measure, predict, share
from stickiness.remaining.zero_load import share_at_zero_load
from stickiness.repulsive import richardson, subpixel
from stickiness.solids import Film, HalfSpace, Layer, Skin
from stickiness.solids.moduli import Constant, Prony, Table
from stickiness.spectrum import Shells, Tabulated, combine

SIDE = 2 * np.pi
BAND = spectrum.SelfAffine(hurst=0.8, q0=1.0, q1=4.0, h_rms=1.0)
HEIGHTS = surface.synthesise(BAND, 16, SIDE, seed=1)
HOLED = HEIGHTS.copy()
HOLED[3, 4] = np.nan
MASKED = np.ma.masked_greater(HEIGHTS, 1.0)
LAW, LONG = adhesive.Exponential(0.01, 0.1), adhesive.Exponential(0.3, 0.5)
LAYER = Layer(0.1, 0.3)
EPS, ONES, SERIES = np.geomspace(1e-3, 1.0, 31), np.ones((9, 1)), Prony(1e4, ((3e4, 1.0),))


def band(**changes):
    return spectrum.SelfAffine(**({"hurst": 0.8, "q0": 1.0, "q1": 4.0, "h_rms": 1.0} | changes))


def analysed(heights):
    return instrument_spectrum.analyse(topography.Topography(heights, 1.0, 1.0, "test"))


def press(heights=HEIGHTS, length=SIDE, pressure=0.1, **options):
    return repulsive.solve(heights, length, pressure, **options)


def attract(heights=HEIGHTS, length=SIDE, **options):
    return adhesive.solve(heights, length, LONG, pressure=0.1, **options)


def hold(**control):
    return adhesive.solve(HEIGHTS, SIDE, LONG, **control)


def follow(values=(0.1, 0.2), **options):
    return list(adhesive.path(HEIGHTS, SIDE, LONG, values, **options))


def average(fine, coarse, many):
    return multilevel.multilevel_mean(fine, coarse, many, ONES, ONES)


GEL = Material(youngs_modulus=1e5, work_of_adhesion=0.05, range=3e-10)


def judge(surface=None, h_rms=1e-6, **changes):
    surface = band(q0=6e4, q1=6e8, h_rms=h_rms) if surface is None else surface
    gel = {"youngs_modulus": 1e5, "work_of_adhesion": 0.05, "range": 3e-10}
    return verdict(surface, **gel | changes)


MISUSES = [
    (lambda: press(HOLED), "heights must be finite, got"),
    (lambda: press(MASKED), "heights must not be masked, got"),
    (lambda: press(HEIGHTS > 0), "heights must be real numbers"),
    (lambda: press(length=-1.0), "length must be one or two positive numbers, .* got -1.0"),
    (lambda: press(pressure="0.1"), "pressure must be a number"),
    (lambda: press(pressure=-0.1), "pressure must be non-negative"),
    (lambda: press(tol=10.0), "tol must be positive and at most"),
    (lambda: press(start=HEIGHTS), "start must be a Contact"),
    (lambda: press([[1.0, 2.0], [3.0]]), "heights must have rows of one length"),
    (lambda: press(pressure=True), "pressure must be a number, got True"),
    (lambda: list(repulsive.load_path(HEIGHTS, SIDE, [0.1, "a"])), "pressures must be a number"),
    (lambda: press(np.zeros(4)), "heights must be a grid"),
    (lambda: press(pressure=np.nan), "pressure must be"),
    (lambda: press(max_iterations=0), "max_iterations must be"),
    (lambda: press(start=repulsive.solve(np.eye(4), 1.0, 0.1)), "same grid"),
    (lambda: press(threads=0), "threads must be an integer of at least 1, got 0"),
    (lambda: press(solid=Layer), "solid must be solids.HalfSpace.. or a solids.Layer"),
    (lambda: press(periodic="free"), "periodic must be True or False"),
    (lambda: press(mirrored="yes"), "mirrored must be True or False, got 'yes'"),
    (lambda: press(periodic=False, mirrored=True), "mirrored=True is for a periodic surface"),
    (lambda: hold(pressure=0.1, mirrored=1), "mirrored must be True or False, got 1"),
    (lambda: press(periodic=False, solid=LAYER), "periodic=False is for a half-space only"),
    (lambda: hold(), "exactly one of pressure and mean_gap"),
    (lambda: hold(mean_gap=[1, 2]), "mean_gap must be a finite number"),
    (lambda: hold(mean_gap=-10.0), "mean_gap must be at least"),
    (lambda: hold(mean_gap=10.0, start="separation"), "follow the mean gap"),
    (lambda: adhesive.solve(HEIGHTS, SIDE, adhesive.Maugis, pressure=0.1), "must be a TractionLaw"),
    (lambda: attract(start="middle"), "start must be 'approach'"),
    (lambda: attract(start=np.zeros((3, 3))), r"start has the shape \(3, 3\)"),
    (lambda: follow((0.1,)), "values must be at least two"),
    (lambda: follow((0.1, 0.1, 0.2)), "values must differ from one to the next"),
    (lambda: follow(control="force"), "control must be"),
    (lambda: follow(balance=0.0), "balance must be"),
    (lambda: attract(start=1j * HEIGHTS), "start must be real numbers, got .* complex128"),
    (lambda: next(adhesive.path(HEIGHTS, SIDE, LONG, ("1", "2"))), "values must be real numbers"),
    (lambda: surface.synthesise(BAND, 16, SIDE, None), "seed must be an integer"),
    (lambda: surface.synthesise(BAND, 16, SIDE, 1, "uniform"), "amplitudes must be 'gaussian' or"),
    (lambda: surface.synthesise(BAND, 16, SIDE, 1, skewness=4.1), "skewness must be .*got 4.1"),
    (lambda: surface.synthesise(BAND, 16, SIDE, 1, skewness=np.nan), "skewness must be .*got nan"),
    (lambda: surface.synthesise(BAND, 16, SIDE, 1, skewness="1"), "skewness must be a number"),
    (lambda: surface.synthesise(BAND, 16, 0.9 * SIDE, 0), "longest wavelength"),
    (lambda: surface.synthesise(BAND, 7, SIDE, 0), "n >= 8"),
    (lambda: surface.synthesise(BAND, 1, SIDE, 0), "n must"),
    (lambda: surface.synthesise(BAND, 16, np.nan, 0), "length must"),
    (lambda: surface.synthesise(band(q0=1.1, q1=1.3), 16, SIDE, 0), "no wave vector"),
    (lambda: surface.synthesise("steel", 16, SIDE, 1), "spectrum must be"),
    (lambda: surface.lattice_spectrum(BAND, SIDE / 3), "window does not hold"),
    (lambda: surface.lattice_spectrum(BAND, 1e6 * SIDE), "must be in the inverse of its unit"),
    (lambda: surface.moments(HOLED, SIDE), "heights must be finite"),
    (lambda: surface.moments(HEIGHTS[:4], SIDE), "heights must be a square"),
    (lambda: surface.realised_spectrum(0 * HEIGHTS, SIDE), "heights must not be flat"),
    (lambda: band(q0=1e150, q1=1e151), r"q0 = 1e\+150, .* take a unit of length"),
    (lambda: band(hurst="0.8"), "hurst must be a number"),
    (lambda: band(q0=1e-200, q1=1e-199), "take a unit of length"),
    (lambda: BAND.psd(np.nan), "q must not be negative or NaN"),
    (lambda: band(hurst=1.2), "hurst must"),
    (lambda: band(q0=0.0), "q0 must"),
    (lambda: band(q1=1.0), "q1 must"),
    (lambda: band(C0=1.0), "one of h_rms and C0"),
    (lambda: band(h_rms=-1.0), "h_rms must"),
    (lambda: band(q_rolloff=0.5), "q_rolloff must"),
    (lambda: band(anisotropy=0.5), "anisotropy must"),
    (lambda: band(anisotropy=2e4), "anisotropy must be between 1 and 10000"),
    (lambda: band(anisotropy="4"), "anisotropy must be a number"),
    (lambda: band(angle="x"), "angle must"),
    (lambda: band(anisotropy=1e4, q1=1e154), "leave the range of floats"),
    (lambda: BAND.moment(3), "order must"),
    (lambda: BAND.truncated(11.0), "q1 must"),
    (lambda: combine(BAND, BAND).truncated(0.5), "q1 must"),
    (lambda: combine(BAND, Shells([1.0], [1.0])), "lattice_spectrum"),
    (lambda: combine(BAND, 1.0), "takes spectra one by one, .* got float"),
    (lambda: Tabulated([1.0, 2.0], [1.0, 2.0, 3.0]), "q and C"),
    (lambda: Tabulated([2.0, 1.0], [1.0, 1.0]), "q must .*increasing"),
    (lambda: Tabulated([0.0, 1.0], [1.0, 1.0]), "q must be positive"),
    (lambda: Tabulated([1.0, 2.0], [1.0, 0.0]), r"C\[1\]"),
    (lambda: Shells([1.0], [-1.0]), "variance must"),
    (lambda: Shells([2.0, 1.0], [1.0, 1.0]), "increasing"),
    (lambda: Shells([1.0], [1.0]).psd(1.0), "single shell"),
    (lambda: Persson(HEIGHTS), "spectrum must be a Spectrum"),
    (lambda: Persson(BAND, variant="persson2001"), "variant must"),
    (lambda: Persson(BAND, correction="persson2001"), "correction must"),
    (lambda: Persson(BAND, gamma=0.0), "gamma must"),
    (lambda: Persson(BAND, gamma=0.01, correction="wang2017"), "gamma must"),
    (lambda: Persson(BAND, nodes=0), "nodes must"),
    (lambda: Persson(BAND).mean_gap(0.0), "p must"),
    (lambda: Persson(BAND).area_fraction(-1.0), "p must"),
    (lambda: Persson(BAND).area_fraction(0.1, magnification=0.5), "magnification must"),
    (lambda: Persson(BAND).gap_density(-1.0, 0.1), "u must"),
    (lambda: Persson(BAND).pressure_at(1e4), "mean_gap must lie"),
    (lambda: dmt.attractive_area(press(), 0.1), "gap must be a number"),
    (lambda: dmt.adhesive_pressure(press().gap, 0.1), "law must be"),
    (lambda: dmt.attractive_area([[0.0, -1e-9]], 0.1), "gap must not be negative"),
    (lambda: dmt.attractive_area([[0.0, 1.0]], 0.0), "eps must be positive"),
    (lambda: dmt.attractive_area([[0.0, 1.0]], 1.0, [[1, 0]]), "contact must be a boolean"),
    (lambda: dmt.attractive_area([0.0, 1.0], 1.0, subpixel=True), "gap must be at least two-dim"),
    (lambda: dmt.edge_gap([0.0, 1.0]), "two-dimensional"),
    (lambda: dmt.weak_attraction([1, 2], [2, 1], [-1, -2]), "three or more increasing"),
    (lambda: dmt.weak_attraction([3, 2, 1], [1, 2, 3], [-3, -2, -1]), "three or more incr"),
    (lambda: dmt.weak_attraction([1, 2, 3], [3, 2], [-1, -2, -3]), "each of 3 pressures"),
    (lambda: dmt.weak_attraction([1, 2, 3], [3, 2, 1], [1, 2, 3]), "potential a negative one"),
    (lambda: dmt.local_exponent([1.0, 2.0], [1.0, 2.0]), "eps must be an increasing"),
    (lambda: dmt.fit_a_v(EPS, EPS, 0.1, window=(0.1, 0.01)), "window must be two"),
    (lambda: dmt.fit_a_v(EPS, EPS, 0.1, window=(2.0, 3.0)), "must hold at least two"),
    (lambda: dmt.fit_a_v(EPS, EPS[1:], 0.1), "area must be finite and match"),
    (lambda: dmt.fit_a_v(EPS, EPS, [0.1, 0.2]), "pressure must have the shape"),
    (lambda: dmt.fit_a_v(EPS, EPS, 0.0), "pressure must be positive"),
    (lambda: criteria.inverse_kappa(np.nan), "inverse_kappa_ad must be"),
    (lambda: criteria.pastewka_robbins_a_v_power_law(0.8, 0.5), "magnification must be at least 1"),
    (lambda: criteria.violano(2, 0.03, 0.01, np.nan, 3), "^range must be positive and finite"),
    (lambda: criteria.pastewka_robbins(0.0, 1.0, 1.0, 1.0), "rms_slope must"),
    (lambda: criteria.pastewka_robbins(1.0, 1.0, 1.0, 1.0, -1.0), "interaction_range must"),
    (lambda: criteria.pastewka_robbins_a_v_power_law(1.0, 10.0), "hurst must be below 1"),
    (lambda: criteria.fuller_tabor(1.0, 1.0, 1.0, radius=0.0), "radius must"),
    (lambda: criteria.bearing_area(1.0, 1.0, 1.0, 0.0), "range must"),
    (lambda: criteria.persson_tosatti(0.0, 1.0), "elastic_energy must"),
    (lambda: criteria.dahlquist(-1.0), "modulus_pa must"),
    (lambda: formulas.jtb_limit(1.0, None, 0.1), "adhesion_length must be a number, got None"),
    (lambda: multilevel.descriptors(BAND, SIDE, 3), "seeds must be"),
    (lambda: multilevel.descriptors(BAND, SIDE, [1], "gaussian", 0.5), "cutoff must be at least 1"),
    (lambda: multilevel.descriptors(BAND, SIDE, [1], "uniform"), "amplitudes must be"),
    (lambda: multilevel.descriptors(BAND, 0.01, [1]), "the window does not hold the band"),
    (lambda: multilevel.descriptors(BAND, np.nan, [1]), "length must be one positive number"),
    (lambda: average([1], [1], [1, 2]), "fine must hold at least 2 samples"),
    (lambda: average([1, np.nan], [1, 2], [1, 2]), "fine must be finite"),
    (lambda: average([1, 2], [1, 2, 3], [1, 2]), r"coarse must be of .*\(2,\)"),
    (lambda: average([1, 2], [1, 2], [[1], [2]]), "many must be of shape"),
    (lambda: multilevel.controlled_mean(np.ones(8), np.ones(8), ONES), "controls must be of shape"),
    (lambda: multilevel.controlled_mean(np.ones(9), ONES, np.ones((9, 2))), "elsewhere must be of"),
    (lambda: multilevel.controlled_mean(np.ones(11), *np.ones((2, 11, 2))), "at least 12 samples"),
    (lambda: subpixel.boundary_strip(HEIGHTS), "contact must be a non-em"),
    (
        lambda: dmt.sum_over_gaps([0.3, 0.2, 0.1], [3, 2, 1], LAW.traction),
        "ranges must be an increasing sequence",
    ),
    (lambda: dmt.sum_over_gaps([0.1, 0.2], [1, 2, 3], LAW.traction), "with one area each"),
    (lambda: a_v_theory.local_a_v(0.1, 0.0, 0.1), "pressure must be positive"),
    (
        lambda: a_v_theory.edge_range([1, 2], [np.nan, 1], [1, 1]),
        "infinite must be positive and finite",
    ),
    (
        lambda: equivalent_sphere.attraction(1, 1, 1, 0.1, 0.1, 2, kappa_rep=np.nan),
        "kappa_rep must be positive",
    ),
    (lambda: equivalent_sphere.error_factor(1.0, -1.0), "strength must be positive"),
    (lambda: equivalent_sphere.attraction(0.0, 1.0, 1.0, 0.1, 0.1, 1.0), "h_rms must"),
    (lambda: equivalent_sphere.attraction(1.0, 1.0, 0.0, 0.1, 0.1, 1.0), "rms_slope must"),
    (lambda: equivalent_sphere.attraction(1.0, 1.0, 1.0, 0.1, 0.0, 1.0), "range must"),
    (lambda: equivalent_sphere.attraction(1.0, 1.0, 1.0, 0.1, 0.1, 0.0), "a_v must"),
    (lambda: measure(HEIGHTS, SIDE, LONG, 0.0), "squeeze must"),
    (lambda: measure(HEIGHTS, SIDE, LONG, np.nan), "squeeze must"),
    (lambda: measure(HEIGHTS, SIDE, "exponential", 0.1), "law must be a TractionLaw"),
    (lambda: measure(HEIGHTS, SIDE, adhesive.Exponential(0.3, 0.1), 0.1), "Take pixels of at most"),
    (lambda: predict(BAND, 1.0, 0.1, q0=1e150), r"q0 = 1e\+150 is far outside the wave numbers"),
    (
        lambda: predict(BAND, 1.0, 0.1, solid=Layer(1e-300, 0.3)),
        "thickness = 1e-300 is out of proportion to the waves",
    ),
    (lambda: predict(BAND, 1.0, 1e150), "out of proportion to the rms height"),
    (lambda: predict(BAND, 1.0, 1e-300), "out of proportion to the rms height"),
    (lambda: predict(BAND, 1e40, 1e-3), "give the work of adhesion over"),
    (lambda: predict(BAND, 1, 1, law="maugis"), "law must be one of exponential, van_der_waals, g"),
    (lambda: share.tough_share(0.0, 0.4), "energy_ratio must"),
    (lambda: judge(length=1e-4), "length is of heights alone"),
    (lambda: verdict(BAND), "give either a material or its properties"),
    (lambda: verdict(BAND, GEL, youngs_modulus=1e5), "give either a material or its properties"),
    (lambda: Surface.from_drawing(), "give exactly one of: Ra; Rq"),
    (lambda: Surface.from_drawing(Ra=-1e-6), "Ra must be positive"),
    (lambda: Surface.from_heights(np.ones(8), 1e-3), r"an \(nx, ny\) array, got the shape"),
    (lambda: Surface.from_profile(np.ones((8, 8)), 1e-3), r"an \(n,\) array, got the shape"),
    (
        lambda: stickiness.judge([], [Surface.from_spectrum(BAND)]),
        "materials must be a list or a mapping",
    ),
    (lambda: stickiness.judge([GEL], []), "surfaces must be a list or a mapping of .*: empty list"),
    (
        lambda: stickiness.judge([HEIGHTS], [Surface.from_spectrum(BAND)]),
        "materials must be .* of Material, got: list of ndarray$",
    ),
    (lambda: judge(HEIGHTS), "length is missing"),
    (lambda: judge(np.ones((8, 16)), length=1e-3), r"both sides of heights of the shape \(8, 16\)"),
    (lambda: judge(np.ones((1, 1)), length=1e-3), r"at least 4 x 4 points, got \(1, 1\)"),
    (lambda: judge(np.ones((0, 0)), length=1e-3), r"at least 4 x 4 points, got \(0, 0\)"),
    (lambda: Surface.from_profile([], 1e-3), "at least 16 points, got 0"),
    (
        lambda: judge(np.full((8, 8), np.nan), length=1e-3),
        "64 of 64 points, which are all, are missing: give",
    ),
    (
        lambda: judge(np.where(HEIGHTS > 0, np.nan, 1e-6 * HEIGHTS), length=1e-3),
        r"heights: \d+ of 256 points .* are missing, more than the 10.0 % that are filled",
    ),
    (
        lambda: stickiness.thresholds(
            band(q0=6e4, q1=6e8, h_rms=1e-6),
            Material(
                youngs_modulus=1e5,
                poisson_ratio=0.3,
                work_of_adhesion=0.05,
                range=3e-10,
                solid=Layer(1e-300, 0.3),
            ),
        ),
        "thickness = 1e-300 is out of proportion to the waves",
    ),
    (lambda: judge(range=1e-300), "range must be between 1e-30 and 1e30 m, got 1e-300"),
    (
        lambda: judge(youngs_modulus=1e-300),
        "youngs_modulus must be between 1e-30 and 1e30 Pa, got 1e-300",
    ),
    (
        lambda: judge(work_of_adhesion=1e300),
        r"work_of_adhesion must be between 1e-30 and 1e30 J/m\^2, got 1e\+300",
    ),
    (lambda: share.tough_share(np.nan, 0.4), "energy_ratio must"),
    (lambda: share.tough_share(np.inf, 0.4), "energy_ratio must"),
    (lambda: Layer(np.inf, 0.3), "thickness must be positive and finite"),
    (lambda: Layer(1.0, 0.6), "poisson must be non-negative and at most 0.5, got 0.6"),
    (lambda: Layer(1.0, 0.3, "glued"), "backing must be 'bonded', 'slip' or a Film.*'glued'"),
    (lambda: Film(0.0, 0.4, 1.0), "modulus_ratio must be positive"),
    (lambda: Skin(0.0, 9.0, 0.4, 0.5), "thickness must be positive"),
    (lambda: Skin(1.0, -9.0, 0.4, 0.5), "modulus_ratio must be positive"),
    (lambda: Skin(1.0, 9.0, 0.6, 0.5), "skin_poisson must be non-negative and at most 0.5"),
    (lambda: Skin(1.0, 9.0, 0.4, -0.1), "poisson must be non-negative and at most 0.5"),
    (lambda: HalfSpace().compliance(0.0), "q must be positive and finite, got 0"),
    (lambda: Constant(-1.0), "modulus must be positive"),
    (lambda: Prony(0.0, ((1.0, 1.0),)), "equilibrium must be positive"),
    (lambda: Prony(1.0, ()), "must not be empty"),
    (lambda: Table((1.0,), (1.0,)), "two pairs"),
    (lambda: Table((2.0, 1.0), (1.0, 1.0)), "must increase"),
    (lambda: SERIES.storage(0.0), "frequency must be positive"),
    (lambda: SERIES.relaxation(-1.0), "time must be positive"),
    (
        lambda: model_choice.relative_error(
            {("maugis", 0.8): ((), 0, 0)}, "maugis", 0.8, 32, 0.0, 0.1, 0.1
        ),
        "values must be positive",
    ),
    (lambda: edge_zone.resolution(0.1, 0.0, 0.1), "range must be positive"),
    (lambda: Prony(1.0, ((1.0, 2.0, 3.0),)), "terms must be pairs"),
    (lambda: richardson.estimate("area", [1, 2], 0, 1), "quantity must be one of area_fr"),
    (lambda: richardson.estimate("mean_gap", [1], 0, 1), "two or three grids, got 1"),
    (lambda: richardson.estimate("mean_gap", [1, np.nan], 0, 1), "values and part must be finite"),
    (lambda: richardson.estimate("mean_gap", [1, 2], 0, -1), "edges must not be negative"),
    (lambda: levelling.fill_missing(HEIGHTS * np.nan, 1), "256 of 256 points, which are all,"),
    (lambda: periodic.periodise(np.zeros(5), "taper"), r"map \(nx, ny\)"),
    (lambda: periodic.periodise(np.zeros((5, 5)), "fold"), "'smooth' or 'given', got 'fold'"),
    (lambda: psd.power_spectrum(np.zeros(5), 1.0), "heights must be a grid"),
    (lambda: psd.power_spectrum(np.zeros((3, 9)), 1.0), r"at least 4 x 4 points, got \(3, 9\)"),
    (lambda: psd.power_spectrum(HEIGHTS, 1.0, np.inf), "dy must be one positive number.*inf"),
    (lambda: psd.power_spectrum(HEIGHTS, 1.0, taper="hamming"), "taper must be.*'hamming'"),
    (lambda: psd.profile_spectrum(np.ones(8), 1.0, "hann"), "at least 16"),
    (lambda: psd.profile_spectrum(np.ones((20, 20)), 1.0, "hann"), "1D"),
    (lambda: psd.profile_spectrum(np.ones(20), 0.0, "hann"), "dx must be one positive number"),
    (lambda: psd.profile_spectrum(np.ones(20), 1.0, "box"), "taper must be"),
    (lambda: psd.power_spectrum(1e160 * HEIGHTS, 1.0), r"heights must be .* in size, got .*e\+160"),
    (lambda: psd.power_spectrum(0 * HEIGHTS, 1.0).anisotropy(1.0, 3.0), "no modes between"),
    (lambda: analysed(0 * HEIGHTS + 3), "heights must not be flat, got 3 thr"),
    (lambda: instrument_spectrum.tip_cutoff(HEIGHTS, (1.0, 1.0), 0.0), "radius must be positive"),
    (lambda: instrument_spectrum.TrustedWaves(resolution=0.0), "resolution must be positive"),
    (lambda: units.si("nan m", "m"), "not finite"),
]


@pytest.mark.parametrize(("call", "message"), MISUSES, ids=[message for _, message in MISUSES])
def test_misuse_is_refused_by_name(call, message):
    with pytest.raises(ValueError, match=message):
        call()


#: Everything public that takes heights and a length, by name.
ENTRIES = {
    "repulsive.solve": press,
    "load_path": lambda *surface: list(repulsive.load_path(*surface, [0.1])),
    "adhesive.solve": attract,
    "adhesive.path": lambda *surface: next(adhesive.path(*surface, LONG, (0.1, 0.2))),
    "measure": lambda *surface: measure(*surface, LONG, 0.1),
    "share_at_zero_load": lambda *surface: share_at_zero_load(*surface, LONG),
    "moments": surface.moments,
    "realised_spectrum": surface.realised_spectrum,
    "full_contact_energy": lambda heights, length: full_contact_energy(heights, 1e6, length),
    "from_heights": Surface.from_heights,
    "from_profile": lambda heights, length: Surface.from_profile(np.ravel(heights), length),
    "verdict": lambda heights, length: judge(heights, length=length),
}
LENGTHS = [1e-300, 1e300, -1.0, np.nan, (1.0, 1.0, 1.0), [[1.0, 1.0]], (1.0, 1e-300), ()]
NO_LENGTHS = ["1", None, True, 1 + 0j, {}, ["1", "1"], np.ma.masked]
WRONG_HEIGHTS = {
    "complex": HEIGHTS + 0j,
    "huge": 1e150 * HEIGHTS,
    "tiny": 1e-300 * HEIGHTS,
    "booleans": HEIGHTS > 0,
    "texts": HEIGHTS.astype(str),
    "objects": HEIGHTS.astype(object),
    "durations": np.zeros(HEIGHTS.shape, "m8[s]"),
    "no points": HEIGHTS[:0, :0],
}


@pytest.mark.parametrize("length", LENGTHS + NO_LENGTHS, ids=repr)
@pytest.mark.parametrize("entry", ENTRIES)
def test_no_entry_takes_a_wrong_length(entry, length):
    with pytest.raises(ValueError, match=r"^length (must|is|'1' has no unit)"):
        ENTRIES[entry](HEIGHTS, length)


@pytest.mark.parametrize("kind", WRONG_HEIGHTS)
@pytest.mark.parametrize("entry", ENTRIES)
def test_no_entry_takes_wrong_heights(entry, kind):
    with pytest.raises(ValueError, match=r"^(heights|surface|a profile) must"):
        ENTRIES[entry](WRONG_HEIGHTS[kind], 1.0)


@pytest.mark.filterwarnings("ignore:(heights of|pressure =)")
@pytest.mark.parametrize(("height", "side"), [(1e39, 1e-39), (1e-39, 1e39), (1e39, 1e39)])
def test_any_unit_that_is_taken_gives_the_same_contact(height, side):
    contact = press(height * HEIGHTS, side * SIDE, 0.1 * height / side)
    assert contact.area_fraction == press().area_fraction
    scaled = adhesive.Exponential(0.3 * height * (height / side), 0.5 * height)
    state = adhesive.solve(height * HEIGHTS, side * SIDE, scaled, pressure=0.1 * height / side)
    assert state.repulsive_area_fraction == attract().repulsive_area_fraction
    curvature = surface.moments(height * HEIGHTS, side * SIDE).rms_curvature
    expected = surface.moments(HEIGHTS, SIDE).rms_curvature
    assert curvature * side * (side / height) == pytest.approx(expected)


def test_energy_of_one_length_is_that_of_square_pixels():
    energy = full_contact_energy(HEIGHTS[:8], 1.0, 1.0, edges="given")
    assert energy == full_contact_energy(HEIGHTS[:8], 1.0, (1.0, 2.0), edges="given")


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
    (lambda: press(pressure=1e5), "pressure = 100000.0"),
    (lambda: adhesive.solve(HEIGHTS, SIDE, LAW, pressure=1e5), "pressure = 100000.0"),
    (lambda: press(length=1e-6 * SIDE), "length = "),
    (
        lambda: adhesive.solve(HEIGHTS, SIDE, TOO_COARSE, pressure=0.1),
        "Take pixels of at most 0.0002 ",
    ),
]


@pytest.mark.parametrize(("call", "message"), DOUBTS, ids=[message for _, message in DOUBTS])
def test_what_is_probably_a_mistake_is_said(call, message):
    with pytest.warns(PlausibilityWarning, match=message):
        call()
