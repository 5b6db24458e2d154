"""Materials in every form: by properties, and by entries of the configuration."""

from dataclasses import replace

import numpy as np
import pytest

from stickiness import Material, Surface
from stickiness.entries import check_material
from stickiness.solids import HALF_SPACE, Film, Layer, Skin
from stickiness.solids.moduli import Prony, Table
from stickiness.spectrum import SelfAffine

SERIES = Prony(1e4, ((3e4, 1.0), (2e5, 1e-3)))
TABLE = Table((1e-2, 1e2), (50e3, 0.5e6))
TAPE = Material(modulus=0.1e6, poisson=0.5, work_of_adhesion=0.07, range=3e-10)
TEXTS = {"label": "tape", "work_of_adhesion": "70 mJ/m^2", "range": "0.3 nm"}
SERIES_TEXTS = {"equilibrium": "10 kPa", "terms": [["30 kPa", "1 s"], ["0.2 MPa", "1 ms"]]}
TABLE_TEXTS = [["10 mHz", "50 kPa"], ["0.1 kHz", "0.5 MPa"]]
FILM_TEXTS = {"youngs_modulus": "3 GPa", "poisson_ratio": 0.4, "thickness": "25 um"}


def read(**texts):
    return Material.from_entry(check_material(TEXTS | texts))


@pytest.mark.parametrize(
    ("texts", "modulus", "depends_on_rate"),
    [
        ({"plane_strain_modulus": "2 MPa"}, 2e6, False),
        ({"youngs_modulus": "3 MPa", "poisson_ratio": 0.5}, 4e6, False),
        (
            {"youngs_modulus_prony": SERIES_TEXTS, "poisson_ratio": 0.5},
            SERIES.storage(1.0) / 0.75,
            True,
        ),
        (
            {"youngs_modulus_table": TABLE_TEXTS, "poisson_ratio": 0},
            np.sqrt(50e3 * 0.5e6),
            True,
        ),
    ],
)
def test_modulus_in_every_form(texts, modulus, depends_on_rate):
    material = read(**texts)
    assert material.plane_strain_modulus == pytest.approx(modulus)
    assert material.depends_on_rate == depends_on_rate


@pytest.mark.parametrize(
    ("texts", "expected"),
    [
        ({"youngs_modulus": "0.1 MPa"}, TAPE),
        (
            {"youngs_modulus": "0.1 MPa", "thickness": "50 um", "backing": "slip"},
            replace(TAPE, solid=Layer(50e-6, 0.5, "slip")),
        ),
        (
            {"youngs_modulus": "0.1 MPa", "thickness": "50 um", "backing": FILM_TEXTS},
            replace(TAPE, solid=Layer(50e-6, 0.5, Film(3e4, 0.4, 25e-6))),
        ),
        (
            {"youngs_modulus": "0.1 MPa", "law": "van_der_waals", "pressed": "1 MPa"},
            replace(TAPE, law="van_der_waals", pressed=1e6),
        ),
        (
            {"youngs_modulus_prony": SERIES_TEXTS, "dwell": "10 s"},
            replace(TAPE, modulus=SERIES, dwell=10.0),
        ),
        ({"youngs_modulus_table": TABLE_TEXTS}, replace(TAPE, modulus=TABLE)),
    ],
)
def test_entries_are_the_same_materials_as_properties(texts, expected):
    material = read(poisson_ratio=0.5, **texts)
    for name in ("work_of_adhesion", "range", "poisson", "law", "pressed", "dwell"):
        ours = getattr(material, name)
        theirs = getattr(expected, name)
        assert ours == theirs or ours == pytest.approx(theirs, rel=1e-12), name
    assert material.plane_strain_modulus == pytest.approx(expected.plane_strain_modulus, rel=1e-12)
    assert material.instant_ratio == pytest.approx(expected.instant_ratio, rel=1e-12)
    waves = np.geomspace(1e3, 1e8, 7)
    np.testing.assert_allclose(material.solid.factor(waves), expected.solid.factor(waves))
    assert (material.solid == HALF_SPACE) == (expected.solid == HALF_SPACE)


def test_the_surface_of_a_rough_material_is_found_by_name():
    wall = Surface.from_spectrum(SelfAffine(hurst=0.8, q0=6e4, q1=6e6, h_rms=1e-6))
    entry = check_material(TEXTS | {"plane_strain_modulus": "1 MPa", "surface": "wall"})
    assert Material.from_entry(entry, {"wall": wall}).surface is wall


def test_materials_are_read_from_a_file(tmp_path):
    path = tmp_path / "materials.yaml"
    keys = "plane_strain_modulus: 1 MPa, work_of_adhesion: 50 mJ/m^2, range: 0.3 nm"
    about = "label: a, source: b"
    path.write_text(f"materials:\n  one: {{{keys}, {about}}}\n")
    assert Material.read(path).plane_strain_modulus == 1e6
    assert Material.read(path, "one").work_of_adhesion == pytest.approx(0.05)
    second = f"  two: {{{keys}, {about}}}\n".replace("1 MPa", "2 MPa")
    path.write_text(path.read_text() + second)
    assert Material.read(path, "two").plane_strain_modulus == 2e6
    with pytest.raises(ValueError, match="one, two"):
        Material.read(path)


def test_a_dwell_decides_by_the_relaxed_modulus():
    at_once = replace(TAPE, modulus=SERIES)
    rested = replace(at_once, dwell=10.0)
    assert at_once.plane_strain_modulus == pytest.approx(SERIES.storage(1.0) / 0.75)
    assert at_once.instant_ratio == 1
    assert rested.plane_strain_modulus == pytest.approx(SERIES.relaxation(10.0) / 0.75)
    assert rested.instant_ratio == pytest.approx(SERIES.relaxation(1e-30) / SERIES.relaxation(10.0))
    tabulated = replace(TAPE, modulus=TABLE, dwell=1.0)
    assert tabulated.instant_ratio == pytest.approx(max(TABLE.moduli) / TABLE.relaxation(1.0))


@pytest.mark.parametrize(
    ("properties", "message"),
    [
        ({"modulus": -1.0}, "modulus must"),
        ({"work_of_adhesion": 0.0}, "work_of_adhesion must"),
        ({"range": np.inf}, "range must"),
        ({"pressed": -1.0}, "pressed must"),
        ({"poisson": 0.7}, "poisson must be above -1 and at most 0.5, got 0.7"),
        ({"law": "none"}, "law must be one of"),
        ({"solid": Layer(1e-5, 0.3)}, "must equal the solid's, 0.3"),
        ({"dwell": 10.0}, "needs a modulus that depends on time"),
        ({"modulus": SERIES, "dwell": 0.0}, "dwell must"),
        ({"modulus": Table((10.0, 100.0), (1e5, 1e6))}, "the table must cover the frequency"),
        ({"modulus": TABLE, "dwell": 1e4}, "the table must cover the frequency"),
        ({"modulus": TABLE, "dwell": 1e9}, "the table must cover the frequency"),
    ],
)
def test_impossible_materials_are_refused(properties, message):
    with pytest.raises(ValueError, match=message):
        replace(TAPE, **properties)


def test_a_modulus_is_young_s_of_an_incompressible_solid_by_default():
    bare = {"modulus": 2e5, "work_of_adhesion": 0.06, "range": 3e-10}
    assert Material(**bare).plane_strain_modulus == pytest.approx(2e5 / 0.75)
    assert Material(**bare, poisson=None).plane_strain_modulus == pytest.approx(2e5)


@pytest.mark.parametrize(
    ("properties", "doubted"),
    [
        ({"work_of_adhesion": 2.0}, "work_of_adhesion = 2 is outside"),
        ({"work_of_adhesion": 2.0, "work_on_smooth": True}, ""),
        ({"work_of_adhesion": 0.19}, ""),
        ({"poisson": -0.9}, "poisson = -0.9 is outside 0 to 0.5"),
        ({"solid": Skin(2e-3, 10.0, 0.3, 0.5)}, "skin_thickness = 0.002 is outside"),
    ],
)
def test_improbable_properties_are_doubted(properties, doubted):
    doubts = replace(TAPE, **properties).doubts
    assert [doubt[: len(doubted)] for doubt in doubts] == [doubted] * bool(doubted)
    assert not any("adhesives" in doubt for doubt in doubts)
