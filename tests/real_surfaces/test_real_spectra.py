"""Spectra of real surfaces, as configured and as analysed."""

import pytest

from stickiness import Surface
from stickiness.entries import check_surface
from stickiness.verdicts.surface_data import read_ends

STEEL = {
    "kind": "self_affine",
    "hurst": 0.8,
    "h_rms": ["0.5 um", "1 um"],
    "longest_wavelength": "20 um",
    "shortest_wavelength": "10 nm",
}


def make_surface(**changes):
    """The surface of steel with other keys; None leaves one out."""
    entry = {key: text for key, text in (STEEL | changes).items() if text is not None}
    return Surface.from_entry(check_surface(entry))


def test_a_wave_number_is_its_wavelength():
    by_number = make_surface(
        longest_wavelength=None,
        shortest_wavelength=None,
        q0="314159.265 1/m",
        q1="628.3185307 1/um",
    )
    for name in ("q0", "q1"):
        assert by_number.data[name] == pytest.approx(float(make_surface().data[name]), rel=1e-6)


def test_waves_beyond_q1_do_not_count():
    steel = make_surface()
    q1 = float(steel.data.wave_number[20])
    _, cut = read_ends(steel.data, highest=q1)
    assert cut.q1 == pytest.approx(q1)
    assert cut.rms_slope < 0.5 * steel.spectra[1].rms_slope


def test_a_prefactor_has_the_unit_of_its_hurst_exponent():
    spectrum, _ = make_surface(h_rms=None, C0="1e-3 m^0.4").spectra
    q = 1e6
    assert float(spectrum.psd(q)) == pytest.approx(1e-3 * q**-3.6)
