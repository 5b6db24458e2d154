"""Spectra of real surfaces, as configured and as analysed."""

import pytest

from criteria.pair_roughness import real_spectrum
from real_surfaces import analyse_surface
from real_surfaces.analyse_surface import configured_spectrum

STEEL = {"kind": "self_affine", "hurst": 0.8, "h_rms": ["0.5 um", "1 um"]}
STEEL |= {"longest_wavelength": "20 um", "shortest_wavelength": "10 nm"}


def test_a_wave_number_is_its_wavelength():
    numbers = {key: value for key, value in STEEL.items() if "wavelength" not in key}
    given = configured_spectrum(numbers | {"q0": "314159.265 1/m", "q1": "628.3185307 1/um"}, 0)
    assert given.q0 == pytest.approx(configured_spectrum(STEEL, 0).q0, rel=1e-6)
    assert given.q1 == pytest.approx(configured_spectrum(STEEL, 0).q1, rel=1e-6)


@pytest.mark.parametrize(("end", "h_rms"), [("smooth", 0.5e-6), ("rough", 1e-6)])
def test_the_dataset_gives_the_spectrum_back(end, h_rms):
    dataset = analyse_surface.self_affine(STEEL)
    given = configured_spectrum(STEEL, {"smooth": 0, "rough": -1}[end])
    found = real_spectrum(dataset, end)
    assert found.h_rms == pytest.approx(h_rms, rel=1e-6)
    assert found.rms_slope == pytest.approx(given.rms_slope, rel=1e-6)


def test_waves_beyond_q1_do_not_count():
    dataset = analyse_surface.self_affine(STEEL)
    q1 = float(dataset.wave_number[20])
    found = real_spectrum(dataset.assign(q1=q1))
    assert found.q1 == pytest.approx(q1)
    assert found.rms_slope < 0.5 * real_spectrum(dataset).rms_slope


def test_a_prefactor_has_the_unit_of_its_hurst_exponent():
    asked = {key: value for key, value in STEEL.items() if key != "h_rms"}
    found = configured_spectrum(asked | {"C0": "1e-3 m^0.4"}, 0)
    q = 1e6
    assert float(found.psd(q)) == pytest.approx(1e-3 * q**-3.6)
