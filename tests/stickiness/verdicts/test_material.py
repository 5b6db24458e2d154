"""Materials in every form: by properties, and by entries of the configuration."""

import inspect

import numpy as np
import pytest

from stickiness import Material, Surface, thresholds, verdict
from stickiness.entries import EntryError, check_material
from stickiness.solids import HALF_SPACE, Film, Layer, Skin
from stickiness.solids.moduli import Prony, Table
from stickiness.spectrum import SelfAffine

SERIES = Prony(1e4, ((3e4, 1.0), (2e5, 1e-3)))
TABLE = Table((1e-2, 1e2), (50e3, 0.5e6))
TAPE = Material(youngs_modulus=0.1e6, work_of_adhesion=0.07, range=3e-10)
ADHESION = {"work_of_adhesion": 0.06, "range": 3e-10}
TEXTS = {"label": "tape", "work_of_adhesion": "70 mJ/m^2", "range": "0.3 nm"}
SERIES_TEXTS = {"equilibrium": "10 kPa", "terms": [["30 kPa", "1 s"], ["0.2 MPa", "1 ms"]]}
TABLE_TEXTS = [["10 mHz", "50 kPa"], ["0.1 kHz", "0.5 MPa"]]
SHEAR_TEXTS = [["10 mHz", "16666.6666666666 Pa"], ["0.1 kHz", "0.166666666666666 MPa"]]
FILM_TEXTS = {"youngs_modulus": "3 GPa", "poisson_ratio": 0.4, "thickness": "25 um"}


def read(**texts):
    return Material.from_entry(check_material(TEXTS | texts))


@pytest.mark.parametrize(
    ("texts", "expected"),
    [
        ({"youngs_modulus": "0.1 MPa"}, TAPE),
        (
            {"youngs_modulus": "0.1 MPa", "thickness": "50 um", "backing": "slip"},
            TAPE.replace(solid=Layer(50e-6, 0.5, "slip")),
        ),
        (
            {"youngs_modulus": "0.1 MPa", "thickness": "50 um", "backing": FILM_TEXTS},
            TAPE.replace(solid=Layer(50e-6, 0.5, Film(3e4, 0.4, 25e-6))),
        ),
        (
            {"youngs_modulus": "0.1 MPa", "law": "van_der_waals", "pressed": "1 MPa"},
            TAPE.replace(law="van_der_waals", pressed=1e6),
        ),
        (
            {"youngs_modulus_prony": SERIES_TEXTS, "dwell": "10 s"},
            TAPE.replace(youngs_modulus_prony=SERIES, dwell=10.0),
        ),
        ({"youngs_modulus_table": TABLE_TEXTS}, TAPE.replace(youngs_modulus_table=TABLE)),
        ({"shear_modulus": "100 kPa"}, TAPE.replace(youngs_modulus=0.3e6)),
        ({"shear_modulus_table": SHEAR_TEXTS}, TAPE.replace(youngs_modulus_table=TABLE)),
    ],
)
def test_entries_are_the_same_materials_as_properties(texts, expected):
    material = read(poisson_ratio=0.5, **texts)
    for name in ("work_of_adhesion", "range", "poisson_ratio", "law", "pressed", "dwell"):
        ours = getattr(material, name)
        theirs = getattr(expected, name)
        assert ours == theirs or ours == pytest.approx(theirs, rel=1e-12), name
    assert material.plane_strain_modulus == pytest.approx(expected.plane_strain_modulus, rel=1e-12)
    assert material.instant_ratio == pytest.approx(expected.instant_ratio, rel=1e-12)
    waves = np.geomspace(1e3, 1e8, 7)
    np.testing.assert_allclose(material.solid.factor(waves), expected.solid.factor(waves))
    assert (material.solid == HALF_SPACE) == (expected.solid == HALF_SPACE)


def test_a_shear_modulus_is_taken_with_poissons_ratio():
    ours = Material(shear_modulus=60e3, poisson_ratio=0.3, work_of_adhesion=0.05, range=3e-10)
    assert ours.quoted_modulus == pytest.approx(156e3, rel=1e-12)
    assert ours.replace(poisson_ratio=0.5).quoted_modulus == pytest.approx(180e3, rel=1e-12)
    assert ours.replace(youngs_modulus=1e5).quoted_modulus == 1e5
    entry = check_material(TEXTS | {"shear_modulus": "60 kPa"})
    assert str(entry["youngs_modulus"]) == "180 kPa"
    assert check_material(entry) == entry
    assert check_material({"common": "psa", "shear_modulus": "60 kPa"})["youngs_modulus"] == 180e3


RHEOMETERS = {
    "one line, angular": (
        "shear_modulus_table",
        "Angular Frequency [rad/s],G' [kPa],G'' [kPa]\n62.83185307,20,3\n0.06283185307,10,2\n",
    ),
    "units below": (
        "shear_modulus_table",
        "Sweep 1\nPoint\tFrequency\tStorage Modulus\tLoss Modulus\n\t[Hz]\t[Pa]\t[Pa]\n"
        "1\t0,01\t10000\t3000\n2\t10\t20000,0\t\n",
    ),
    "falling": (
        "shear_modulus_table",
        "Frequency (Hz),Storage modulus G' (kPa),Loss modulus G'' (kPa)\n10,20,3\n0.01,10,2\n",
    ),
    "German": (
        "shear_modulus_table",
        "Frequenz [Hz];Speichermodul G' [kPa]\n0,01;10,0\n10,0;20,0\n",
    ),
    "tension": ("youngs_modulus_table", "f (Hz);E′ (MPa)\n0,01;0,03\n10;0,06\n"),  # noqa: RUF001
}


@pytest.mark.parametrize("name", RHEOMETERS)
def test_a_table_is_read_from_a_file_of_a_rheometer(tmp_path, name):
    key, content = RHEOMETERS[name]
    path = tmp_path / "sweep.csv"
    path.write_text(content, encoding="utf-8")
    pairs = read(**{key: str(path)}).youngs_modulus_table
    np.testing.assert_allclose(pairs, [(0.01, 3e4), (10.0, 6e4)], rtol=1e-9)
    assert Material(**ADHESION, **{key: path}).youngs_modulus_table == pairs


@pytest.mark.parametrize(
    ("key", "content", "message"),
    [
        ("youngs_modulus_table", "Frequency [Hz],G' [kPa]\n1,20\n2,30\n", "G' with shear_modulus_"),
        ("shear_modulus_table", "Frequency [Hz],E' [kPa]\n1,20\n2,30\n", "E' goes with youngs_mod"),
        ("shear_modulus_table", "Frequency,G'\n1,20\n2,30\n", "named with their units"),
        (
            "youngs_modulus_table",
            "f [Hz];Storage modulus, G' [kPa]\n1;20\n2;30\n",
            "G' with shear_modulus_table",
        ),
        ("shear_modulus_table", "Frequency [Hz],G'' [kPa]\n1,20\n2,30\n", "of a storage modulus"),
        ("shear_modulus_table", "Frequency [Hz],G' [mm]\n1,20\n2,30\n", "is a length; a pressure"),
        (
            "shear_modulus_table",
            "omega [1/s],G' [Pa]\n1,20\n2,30\n",
            "omega is in 1/s: write rad/s",
        ),
        (
            "shear_modulus_table",
            "Frequency [Hz];G' [Pa];G' [Pa]\n1;20;2\n2;30;3\n",
            "may both be the modulus: leave one",
        ),
        ("shear_modulus_table", "G' [Pa]\n", "no line of numbers found"),
        ("shear_modulus_table", "f [Hz],G' [kPa]\n1,20\n2,10\n", "'10 kPa': at 2 Hz is below"),
    ],
)
def test_a_file_that_does_not_tell_which_modulus_is_refused(tmp_path, key, content, message):
    path = tmp_path / "sweep.csv"
    path.write_text(content)
    with pytest.raises(EntryError, match=message) as caught:
        read(**{key: str(path)})
    assert caught.value.key.startswith(key)


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
    at_once = TAPE.replace(youngs_modulus_prony=SERIES)
    rested = at_once.replace(dwell=10.0)
    assert at_once.depends_on_rate
    assert not TAPE.depends_on_rate
    assert at_once.plane_strain_modulus == pytest.approx(SERIES.storage(1.0) / 0.75)
    assert at_once.instant_ratio == 1
    assert rested.plane_strain_modulus == pytest.approx(SERIES.relaxation(10.0) / 0.75)
    assert rested.instant_ratio == pytest.approx(SERIES.relaxation(1e-30) / SERIES.relaxation(10.0))
    tabulated = TAPE.replace(youngs_modulus_table=TABLE, dwell=1.0)
    assert tabulated.instant_ratio == pytest.approx(max(TABLE.moduli) / TABLE.relaxation(1.0))


@pytest.mark.parametrize(
    ("properties", "message"),
    [
        ({"youngs_modulus": -1.0}, "youngs_modulus must be positive and finite, got -1.0"),
        ({"youngs_modulus": "2 kg"}, "youngs_modulus = '2 kg': is in kg; a pressure is wanted"),
        ({"youngs_modulus": SERIES}, "youngs_modulus must be a number in Pa, or a text"),
        ({"work_of_adhesion": 0.0}, "work_of_adhesion must"),
        ({"range": np.inf}, "range must"),
        ({"range": None}, "range: the key is missing"),
        ({"pressed": -1.0}, "pressed must be zero or positive"),
        ({"poisson_ratio": 0.7}, "poisson_ratio must be less than or equal to 0.5, got 0.7"),
        ({"law": "none"}, "law must be one of 'exponential', 'van_der_waals', got 'none'"),
        ({"tickness": "1 um"}, "tickness: the key is unknown; did you mean 'thickness'"),
        ({"solid": Layer(1e-5, 0.3)}, "poisson_ratio must equal the solid's, 0.3, got 0.5"),
        ({"solid": Layer}, "solid must be solids.HalfSpace"),
        ({"solid": Skin(1e-7, 0.5, 0.3, 0.5)}, "solid: has 0.5 times the modulus"),
        ({"surface": "wall"}, "surface must be a Surface, got 'wall': names"),
        ({"dwell": 10.0}, "dwell = 10.0: needs a modulus of time"),
        ({"youngs_modulus_prony": SERIES, "dwell": 0.0}, "dwell must"),
        ({"youngs_modulus_table": Table((10.0, 100.0), (1e5, 1e6))}, "10 Hz to 100 Hz .* 1 Hz, at"),
        ({"youngs_modulus_table": TABLE, "dwell": 1e4}, "must cover 1.01e-05 Hz, 1/.pi.2 dwell"),
        ({"youngs_modulus_table": TABLE, "dwell": 1e9}, "must cover"),
    ],
)
def test_impossible_materials_are_refused(properties, message):
    with pytest.raises(ValueError, match=message):
        TAPE.replace(**properties)


def test_keys_that_exclude_each_other_are_refused_together():
    with pytest.raises(ValueError, match="exactly one of: plane_strain_modulus; youngs_modulus;"):
        Material(**ADHESION, youngs_modulus=1e5, plane_strain_modulus=1e5)
    with pytest.raises(ValueError, match="thickness = 1e-05: is part of solid"):
        Material(**ADHESION, youngs_modulus=1e5, solid=Layer(1e-5, 0.5), thickness=1e-5)


def test_a_solid_is_incompressible_by_default_unless_its_plane_strain_modulus_is_given():
    of_youngs = Material(youngs_modulus=2e5, **ADHESION)
    assert of_youngs.plane_strain_modulus == pytest.approx(2e5 / 0.75)
    assert of_youngs.poisson_ratio == 0.5
    of_plane_strain = Material(plane_strain_modulus=2e5, **ADHESION)
    assert of_plane_strain.plane_strain_modulus == 2e5
    assert of_plane_strain.poisson_ratio is None
    of_file = {"youngs_modulus": "0.2 MPa", "work_of_adhesion": "70 mJ/m^2", "range": "0.3 nm"}
    assert check_material(of_file)["poisson_ratio"] == 0.5


def test_texts_with_units_are_numbers_in_si():
    texts = Material(youngs_modulus="0.1 MPa", work_of_adhesion="70 mJ/m^2", range="0.3 nm")
    assert texts.plane_strain_modulus == pytest.approx(TAPE.plane_strain_modulus, rel=1e-15)
    assert (texts.work_of_adhesion, texts.range) == pytest.approx((0.07, 3e-10), rel=1e-15)
    film = {"youngs_modulus": "3 GPa", "poisson_ratio": 0.4, "thickness": 25e-6}
    layer = texts.replace(thickness="50 um", backing=film).solid
    assert (layer.thickness, layer.backing.modulus_ratio) == pytest.approx((5e-5, 3e4))
    assert (layer.backing.poisson, layer.backing.thickness) == (0.4, 25e-6)


def test_a_material_is_the_entry_that_describes_it():
    layer = TAPE.replace(thickness="50 um", youngs_modulus_prony=SERIES)
    entry = layer.model_dump()
    assert (entry["plane_strain_modulus"], entry["pressed"]) == (None, None)
    assert Material.from_entry(entry) == layer
    assert Material.from_entry(entry).model_dump() == entry


def test_a_replaced_key_takes_the_place_of_those_that_exclude_it():
    rested = TAPE.replace(youngs_modulus_prony=SERIES, dwell=10.0)
    assert rested.youngs_modulus is None
    slow = rested.replace(youngs_modulus_table=TABLE, dwell=None)
    assert (slow.youngs_modulus_prony, slow.dwell) == (None, None)
    plane = slow.replace(plane_strain_modulus=rested.plane_strain_modulus)
    assert (plane.depends_on_rate, plane.poisson_ratio) == (False, None)
    layer = TAPE.replace(thickness=1e-5, backing="slip")
    assert layer.replace(solid=HALF_SPACE).solid == HALF_SPACE
    assert layer.replace(thickness=None).solid == HALF_SPACE
    assert layer.replace(pressed=1e4).solid == layer.solid
    assert (layer.pressed, TAPE.solid) == (0, HALF_SPACE)


def test_a_common_material_is_completed_by_keys_beside_it():
    tape = Material(common="psa", thickness="50 um")
    assert tape == Material.from_entry(check_material({"common": "psa", "thickness": "50 um"}))
    assert tape.replace(common=None, plane_strain_modulus=1e6, thickness=None).range == tape.range


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ({"modulus": 2e5}, {"youngs_modulus": 2e5}),
        ({"modulus": 2e5, "poisson": 0.3}, {"youngs_modulus": 2e5, "poisson_ratio": 0.3}),
        ({"modulus": 2e5, "poisson": None}, {"plane_strain_modulus": 2e5}),
        ({"modulus": SERIES}, {"youngs_modulus_prony": SERIES}),
        ({"modulus": TABLE}, {"youngs_modulus_table": TABLE}),
        (
            {"modulus": TABLE, "poisson": None},
            {"youngs_modulus_table": TABLE, "poisson_ratio": 0.0},
        ),
    ],
)
def test_old_names_work_and_are_told_of(old, new):
    with pytest.warns(DeprecationWarning, match="modulus is an old name: write") as caught:
        material = Material(**old, **ADHESION)
    assert material == Material(**new, **ADHESION)
    assert caught[0].filename == __file__
    with pytest.warns(DeprecationWarning, match="modulus is an old name"):
        assert TAPE.replace(**old) == TAPE.replace(**new)


@pytest.mark.parametrize("answer", [verdict, thresholds])
def test_verdicts_take_old_names(answer):
    rough = SelfAffine(hurst=0.8, q0=6e4, q1=6e6, h_rms=1e-6)
    with pytest.warns(DeprecationWarning, match="is an old name") as caught:
        old = answer(rough, modulus=2e5, poisson=0.3, **ADHESION)
    assert {warning.filename for warning in caught} == {__file__}
    new = answer(rough, youngs_modulus=2e5, poisson_ratio=0.3, **ADHESION)
    assert repr(old) == repr(new)


def test_attributes_have_their_old_names():
    with pytest.warns(DeprecationWarning, match="modulus is an old name"):
        assert TAPE.modulus == TAPE.youngs_modulus
    with pytest.warns(DeprecationWarning, match="poisson is an old name"):
        assert TAPE.poisson == TAPE.poisson_ratio
    with pytest.warns(DeprecationWarning, match="modulus is an old name"):
        assert TAPE.replace(youngs_modulus_prony=SERIES).modulus == SERIES


def test_help_tells_of_every_key():
    text = inspect.getdoc(Material)
    for key, field in Material.model_fields.items():
        assert f"\n{key}" in text
        assert field.description in text
    assert inspect.signature(Material).parameters.keys() == Material.model_fields.keys()


@pytest.mark.parametrize(
    ("properties", "doubted"),
    [
        ({"work_of_adhesion": 2.0}, "work_of_adhesion = 2 is outside"),
        ({"work_of_adhesion": 2.0, "work_on_smooth": True}, ""),
        ({"work_of_adhesion": 0.19}, ""),
        ({"poisson_ratio": -0.9}, "poisson_ratio = -0.9 is outside 0 to 0.5"),
        ({"solid": Skin(2e-3, 10.0, 0.3, 0.5)}, "skin_thickness = 0.002 is outside"),
    ],
)
def test_improbable_properties_are_doubted(properties, doubted):
    doubts = TAPE.replace(**properties).doubts
    assert [doubt[: len(doubted)] for doubt in doubts] == [doubted] * bool(doubted)
    assert not any("adhesives" in doubt for doubt in doubts)
