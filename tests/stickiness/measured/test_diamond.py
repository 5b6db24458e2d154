"""Ultrananocrystalline diamond at three scales: each is predicted from the other two.

docs/findings.md has the table of these numbers. Limits of 90 %, of the spectrum and of the mean of
a measurement, are 1.645 standard errors of ln C.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy import special

from stickiness.measured import instrument_spectrum, stitching, topography
from stickiness.measured.instrument_spectrum import TrustedWaves
from stickiness.measured.psd import merge_rings
from stickiness.statistics import COVERS

FILE = Path(__file__).parents[3] / "config/topographies/uncd_diamond.nc"
NM = 1e-9


def level(variable, detrend="plane"):
    return topography.read(FILE, variable=variable).detrended(detrend)


@pytest.fixture(scope="module")
def spectra():
    """Spectra of the stylus, the TEM, and the AFM as if its tip were sharp."""
    tip = TrustedWaves(tip_radius=5e-6)
    return {
        "stylus": instrument_spectrum.analyse(level("stylus", "quadratic"), instrument=tip),
        "TEM": instrument_spectrum.analyse(level("TEM"), alone=False),
        "AFM": instrument_spectrum.analyse(level("AFM")),
    }


def compare(whole, third, longest, shortest):
    """Mean of ln(measured C/predicted C) in a band over its limit of 90 %, and three moments.

    Errors of a prediction are taken as fully correlated, as they nearly are. Each moment, of h_rms,
    rms slope and elastic energy, is the measured value and both limits of the predicted one.
    """
    rings = third.narrow.between(2 * np.pi / longest, 2 * np.pi / shortest)
    q, mean, dof = merge_rings(rings, rings.psd, 10)
    # Within the stitched band the rings tell, beyond it the fitted law.
    stitched = whole.rings
    inside = (q >= stitched.q[0]) & (q <= stitched.q[-1])
    places = np.log(q), np.log(stitched.q)
    logs = np.log(stitched.psd) + special.digamma(stitched.dof) - np.log(stitched.dof)
    errors = np.sqrt(special.polygamma(1, stitched.dof))
    log_psd = np.where(inside, np.interp(*places, logs), np.log(whole.fit.psd(q)))
    error = np.where(inside, np.interp(*places, errors), whole.fit.log_psd_se(q))
    weight = 1 / special.polygamma(1, dof)
    offset = np.log(mean) - special.digamma(dof) + np.log(dof) - log_psd
    limit = COVERS * np.hypot(weight @ error / weight.sum(), weight.sum() ** -0.5)
    area = instrument_spectrum.ring_areas(q, 0.0)
    moments = {}
    for name, order, power in (("h_rms", 0, 0.5), ("rms_slope", 2, 0.5), ("energy", 1, 1.0)):
        scale = area * q**order / (4.0 if name == "energy" else 1.0)
        psds = (mean, *(np.exp(log_psd + side * limit) for side in (-1, 1)))
        moments[name] = [(scale @ psd) ** power for psd in psds]
    return weight @ offset / weight.sum(), limit, moments


def are_inside(moments):
    return [low < value < high for value, low, high in moments.values()]


def test_rms_heights_of_the_levelled_measurements():
    heights = [level("AFM"), level("TEM"), level("stylus", "quadratic")]
    rms_heights = [each.h_rms / NM for each in heights]
    np.testing.assert_allclose(rms_heights, [4.69, 3.48, 12.12], atol=0.01)
    assert [each.doubts for each in heights] == [()] * 3


def test_the_tip_of_the_afm_leaves_no_waves():
    for radius in (17 * NM, 26 * NM):
        with pytest.raises(ValueError, match="shape of the tip ends the spectrum everywhere"):
            instrument_spectrum.analyse(
                level("AFM"), instrument=TrustedWaves(tip_radius=radius), alone=False
            )


def test_stylus_and_tem_leave_a_gap_that_decides(spectra):
    whole = stitching.stitch([spectra["TEM"], spectra["stylus"]])
    (gap,) = whole.gaps
    np.testing.assert_allclose(2 * np.pi / gap.q, [1.95e-6, 58e-9], rtol=0.01)
    drawn = stitching.draw(whole, 1000, seed=1).family
    for values, limits in (
        (np.sqrt(drawn.variance()), [17e-9, 54e-9]),
        (drawn.energy(), [1.0e-9, 13e-9]),
    ):
        np.testing.assert_allclose(np.quantile(values, (0.05, 0.95)), limits, rtol=0.15)
    assert whole.fit.hurst == pytest.approx(0.89, abs=0.1)
    assert COVERS * whole.fit.hurst_se == pytest.approx(0.52, abs=0.1)


@pytest.mark.parametrize(
    ("longest", "shortest", "offset", "holds"),
    # The tip blurs waves shorter than about 16 nm.
    [(58, 25, 1.1, True), (25, 16, 0.25, True), (16, 8, -2.4, False)],
)
def test_afm_from_stylus_and_tem(spectra, longest, shortest, offset, holds):
    whole = stitching.stitch([spectra["TEM"], spectra["stylus"]])
    afm = instrument_spectrum.analyse(level("AFM"), demand=False)
    mean, limit, moments = compare(whole, afm, longest * NM, shortest * NM)
    assert mean == pytest.approx(offset, abs=0.2)
    assert (abs(mean) < limit) == holds
    assert are_inside(moments) == [holds] * 3


@pytest.mark.parametrize(
    ("third", "others", "longest", "shortest", "offset"),
    [
        # Waves of 18 to 58 nm fall faster than with H = 1, the most that is assumed in the gap.
        ("TEM", ("AFM", "stylus"), 58e-9, 17.8e-9, 2.7),
        # A law fitted below 60 nm knows nothing of the roll-off.
        ("stylus", ("AFM", "TEM"), 75e-6, 1.95e-6, -4.6),
    ],
)
def test_profiles_are_outside_what_the_others_predict(
    spectra, third, others, longest, shortest, offset
):
    whole = stitching.stitch([spectra[name] for name in others])
    mean, limit, moments = compare(whole, spectra[third], longest, shortest)
    assert mean == pytest.approx(offset, abs=0.2)
    if third == "TEM":
        assert abs(mean) > limit
    assert are_inside(moments) == [False, third == "stylus", False]


def test_waves_that_the_tem_does_not_resolve_lie_within_the_limits(spectra):
    whole = stitching.stitch([spectra["TEM"], spectra["stylus"]])
    beyond = instrument_spectrum.analyse(level("TEM"), demand=False)
    mean, limit, _ = compare(whole, beyond, 17e-9, 8.6e-9)
    assert abs(mean) < limit


def test_the_law_stays_when_the_afm_counts_to_where_it_agrees(spectra):
    sharp = instrument_spectrum.analyse(
        level("AFM"), instrument=TrustedWaves(fit_to=16 * NM), alone=False
    )
    plain = stitching.stitch([replace(sharp, trusted=False), spectra["TEM"], spectra["stylus"]])
    more = stitching.stitch([sharp, spectra["TEM"], spectra["stylus"]])
    assert abs(more.fit.hurst - plain.fit.hurst) < COVERS * plain.fit.hurst_se
    energies = [np.median(stitching.draw(s, 500, seed=1).family.energy()) for s in (plain, more)]
    assert energies[1] == pytest.approx(energies[0], rel=0.2)
