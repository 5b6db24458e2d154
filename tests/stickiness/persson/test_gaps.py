"""Gaps where contact is lost: the interpolated ones against the sum over scales itself."""

import numpy as np
import pytest
from scipy.special import erf

from stickiness.persson import Persson
from stickiness.persson.gaps import LostContact, gap_curve, scaled_gap
from stickiness.spectrum import SelfAffine, Shells
from stickiness.surface import lattice_spectrum


def power_law(magnification, hurst=0.8, **kwargs):
    return SelfAffine(hurst=hurst, q0=1.0, q1=magnification, h_rms=1.0, **kwargs)


SPECTRA = {
    "narrow": power_law(1.01),
    "broad": power_law(1e6),
    "flat": power_law(1e4, 0.3, q_rolloff=20.0),
    "lattice": lattice_spectrum(power_law(32.0), 2 * np.pi),
    "wide lattice": lattice_spectrum(power_law(16.0), 8 * np.pi),
    "two shells": Shells([1.0, 1000.0], [1.0, 1e-4]),
}


@pytest.mark.slow
@pytest.mark.parametrize("correction", ["yang2008", "xu2024"])
@pytest.mark.parametrize("name", list(SPECTRA))
@pytest.mark.parametrize("load", [1e-4, 0.065, 2.0])
def test_interpolated_gaps_are_those_summed(name, load, correction):
    setting = Persson(SPECTRA[name], correction=correction)._setting
    curve = gap_curve(setting, load)
    steps = np.random.default_rng(0).uniform(*curve.edges[[0, -1]], 300)
    lost = LostContact.at(setting, load, curve.y_end, steps)
    # one by one, so that each has scales of its own to be summed over
    parts = [LostContact.at(setting, load, curve.y_end, step) for step in steps[:, None]]
    smooth = np.log([scaled_gap(setting, load, part)[0] for part in parts])
    want = lost.y**2 - (load / erf(lost.y)) ** 2 / lost.rest + smooth
    # both err by some 1e-7; gaps below exp(-45) count as zero
    np.testing.assert_allclose(curve.log_gap(steps, lost), want, rtol=0, atol=1e-6)


@pytest.mark.parametrize("spectrum", [SPECTRA["broad"], SPECTRA["wide lattice"]])
def test_variants_share_gaps_and_differ_in_what_they_make_of_them(spectrum):
    u, p = np.geomspace(1e-3, 3.0, 9), np.array([0.01, 0.2])
    first = Persson(spectrum, gamma=0.5)
    other, alone = first.with_variant("almqvist2011"), Persson(spectrum, "almqvist2011", 0.5)
    assert (first.variant, other.variant) == ("afferrante2018", "almqvist2011")
    first.gap_density(u, p)
    np.testing.assert_array_equal(other.gap_density(u, p), alone.gap_density(u, p))
    assert np.all(other.gap_cumulative(u, p) != first.gap_cumulative(u, p))
    assert gap_curve(other._setting, 0.2) is gap_curve(first._setting, 0.2)
    with pytest.raises(ValueError, match="variant must"):
        first.with_variant("persson2001")
