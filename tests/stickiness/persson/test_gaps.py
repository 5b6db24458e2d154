"""Gaps where contact is lost: the interpolated ones against the sum over scales itself."""

import numpy as np
import pytest
from scipy.special import erf

from stickiness.persson import Persson
from stickiness.persson.gaps import LostContact, gap_curve, gap_profile, scaled_gap
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
    "two shells": Shells([3.0, 3000.0], [1.0, 1e-4]),
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


@pytest.mark.parametrize("variant", ["afferrante2018", "almqvist2011"])
@pytest.mark.parametrize(
    ("name", "load", "most"),
    [
        ("narrow", 0.065, 700),
        ("broad", 0.065, 800),
        ("flat", 0.065, 800),
        ("lattice", 0.065, 3200),
        ("wide lattice", 0.001, 3200),
        ("two shells", 1.95, 900),
        ("two shells", 9.0, 5000),  # next to full contact, where Gaussians are narrow
    ],
)
def test_few_gaussians_are_enough_for_the_density_of_gaps(name, load, most, variant):
    theory, fine = (Persson(SPECTRA[name], variant, nodes=nodes) for nodes in (1, 2))
    u = np.geomspace(1e-4, 10.0, 15)
    density, best = theory.gap_density(u, load), fine.gap_density(u, load)
    seen = best > 1e-9 * best.max()
    np.testing.assert_allclose(density[seen], best[seen], rtol=2e-7)
    # 450 to 620 of power laws, up to 2700 of lattices
    assert len(gap_profile(theory._setting, variant, load, 17.0).weight) < most


@pytest.mark.parametrize("load", [3.0, 5.0])
def test_next_to_full_contact_panels_stay_few(load):
    """Gaussians of a broad spectrum move by many thousands of their widths: 2000 panels of ten."""
    spectrum = SPECTRA["broad"]
    theory = Persson(spectrum)
    pressure = load * spectrum.rms_slope / 2
    profile = gap_profile(theory._setting, "afferrante2018", pressure, 17.0)
    assert len(profile.weight) < 22000
    whole = theory.gap_cumulative(np.inf, pressure) + theory.area_fraction(pressure)
    assert whole == pytest.approx(1.0, abs=1e-10)
