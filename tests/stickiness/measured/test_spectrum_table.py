"""A spectrum from a table: the same in every convention."""

import numpy as np
import pytest

from stickiness import Surface
from stickiness.entries import EntryError, check_surface
from stickiness.measured.spectrum_table import read_spectrum
from stickiness.spectrum import SelfAffine

ROUGH = SelfAffine(hurst=0.8, q0=6e4, q1=6e7, h_rms=1e-6)
Q = np.geomspace(6e4, 6e7, 40)
C = ROUGH.psd(Q)
TURN = 2 * np.pi
#: Header, waves, values and convention of the same spectrum.
TABLES = {
    "wave numbers": ("q [1/um],PSD [um^4]", Q * 1e-6, C * 1e24, "variance"),
    "spatial frequencies": (
        "spatial frequency [1/um],2D PSD [um^4]",
        Q / TURN * 1e-6,
        C * TURN**2 * 1e24,
        "variance",
    ),
    "contact.engineering": (
        "Wavelength (nm),PSD (nm^4)",
        TURN / Q * 1e9,
        C * TURN**2 * 1e36,
        "fourier",
    ),
    "Gwyddion": ("k [1/m],W [m^3]", Q, TURN * Q * C, "radial"),
    "Gwyddion, per frequency": ("f [1/m],W [m^3]", Q / TURN, TURN**2 * Q * C, "radial"),
}


def write(path, header, waves, values):
    rows = (f"{wave:.12g},{value:.12g}\n" for wave, value in zip(waves, values, strict=True))
    path.write_text(header + "\n" + "".join(rows), encoding="utf-8")
    return path


@pytest.mark.parametrize("name", TABLES)
def test_every_convention_is_the_same_spectrum(tmp_path, name):
    *table, convention = TABLES[name]
    found = read_spectrum(write(tmp_path / "a.csv", *table), convention)
    np.testing.assert_allclose(found.psd(Q[1:-1]), C[1:-1], rtol=1e-9)
    assert found.h_rms == pytest.approx(1e-6, rel=1e-6)


def test_an_entry_is_the_surface_of_its_spectrum(tmp_path):
    *table, convention = TABLES["contact.engineering"]
    path = str(write(tmp_path / "a.csv", *table))
    entry = check_surface({"kind": "spectrum", "file": path, "convention": convention})
    ours, theirs = Surface.from_entry(entry), Surface.from_spectrum(ROUGH)
    assert ours.rms_height == pytest.approx(theirs.rms_height, rel=1e-6)
    energies = [float(each.data.elastic_energy[0]) for each in (ours, theirs)]
    assert energies[0] == pytest.approx(energies[1], rel=1e-6)


@pytest.mark.parametrize(
    ("header", "convention", "words"),
    [
        ("q,PSD", "variance", "named with their units"),
        ("x [um],PSD [um^4]", "variance", "needs columns of the waves"),
        ("q [1/um],PSD [um^3]", "variance", "a number in m"),  # of profiles
        ("k [1/um],W [um^4]", "radial", "a number in m"),
        ("q [um],PSD [um^4]", "variance", "is a length; a wave number is wanted"),
        ("q [1/um],f [1/um]", "variance", "may both be the waves"),
    ],
)
def test_a_table_of_another_kind_is_refused(tmp_path, header, convention, words):
    path = str(write(tmp_path / "a.csv", header, Q, C))
    with pytest.raises(EntryError, match=words) as caught:
        check_surface({"kind": "spectrum", "file": path, "convention": convention})
    assert caught.value.key.endswith("file")
