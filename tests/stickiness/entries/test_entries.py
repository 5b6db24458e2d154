"""Entries of materials and surfaces: checked, in SI units, complete."""

import pickle
import subprocess
import sys
import tomllib
from pathlib import Path

import jsonschema
import pytest

import stickiness
from stickiness import Material, entries
from stickiness.command import TEXTS, read_options
from stickiness.entries.material import Materials
from stickiness.solids import HALF_SPACE
from stickiness.units import Quantity, write_quantities

SCRIPTS = Path(stickiness.__file__).parents[1]
TAPE = {
    "youngs_modulus": "0.2 MPa",
    "poisson_ratio": 0.5,
    "work_of_adhesion": "60 mJ/m^2",
    "range": "0.3 nm",
}
SERIES = {"equilibrium": "30 kPa", "terms": [["0.3 MPa", "1 ms"]]}


def test_numbers_are_in_si_units_and_remember_their_text():
    tape = entries.check_material(TAPE | {"thickness": "50 um"})
    assert tape["youngs_modulus"] == pytest.approx(2e5)
    assert str(tape["youngs_modulus"]) == "0.2 MPa"
    assert tape["thickness"] == pytest.approx(5e-5)
    assert tape["backing"] == "bonded"
    assert tape["dwell"] is None


def test_a_checked_entry_may_be_checked_again_and_so_may_its_texts():
    film = {"youngs_modulus": "3 GPa", "poisson_ratio": 0.3, "thickness": "25 um"}
    tape = entries.check_material(TAPE | {"thickness": "50 um", "backing": film})
    assert entries.check_material(tape) == tape
    assert entries.check_material(write_quantities(tape)) == tape


def test_a_dwell_needs_a_modulus_of_time():
    series = {"youngs_modulus": None, "youngs_modulus_prony": SERIES, "dwell": "1 min"}
    tape = entries.check_material(TAPE | series)
    assert tape["dwell"] == 60.0
    ((modulus, time),) = tape["youngs_modulus_prony"]["terms"]
    assert (modulus, time) == (pytest.approx(3e5), 1e-3)


def test_sides_may_be_a_tuple_of_numbers():
    surface = {"kind": "measured", "file": "a", "length": (1e-6, 2e-6)}
    assert entries.check_surface(surface, arguments=True)["length"] == [1e-6, 2e-6]


def test_measurements_share_the_keys_beside_their_list():
    files = [{"file": "a"}, {"file": "b", "detrend": "mean", "length": ["1 um", "2 um"]}]
    surface = {"kind": "measured", "detrend": "quadratic", "measurements": files}
    first, second = entries.list_measurements(entries.check_surface(surface))
    assert (first["file"], first["detrend"], first["length"]) == ("a", "quadratic", None)
    assert (second["file"], second["detrend"], second["length"]) == ("b", "mean", [1e-6, 2e-6])
    (single,) = entries.list_measurements(entries.check_surface({"kind": "measured", "file": "a"}))
    assert (single["file"], single["window"], single["max_missing"]) == ("a", "detect", 0.1)


@pytest.mark.parametrize(
    ("check", "entry", "key", "value"),
    [
        (entries.check_material, TAPE | {"range": "0.3 mm"}, "range", "0.3 mm"),
        (entries.check_material, TAPE | {"tickness": "1 mm"}, "tickness", None),
        (entries.check_material, {}, "", None),
        (
            entries.check_surface,
            {"kind": "measured", "file": "a", "extend_to": "1 pm"},
            "extend_to",
            "1 pm",
        ),
        (entries.check_surface, {"kind": "measure"}, "kind", "measure"),
        (entries.check_surface, {}, "kind", None),
    ],
)
def test_an_error_has_a_key_and_a_value(check, entry, key, value):
    with pytest.raises(entries.EntryError) as caught:
        check(entry)
    assert (caught.value.key, str(caught.value.value)) == (key, str(value))


def test_a_storage_modulus_that_falls_is_refused_by_file_and_row(tmp_path):
    path = tmp_path / "tape.yaml"
    text = (
        "materials: {tape: {label: tape, source: own, poisson_ratio: 0.5, "
        "work_of_adhesion: 50 mJ/m^2, range: 0.3 nm, youngs_modulus_table: "
        "[[0.1 Hz, 50 kPa], [1 Hz, 49 kPa], [10 Hz, LAST]]}}"
    )
    path.write_text(text.replace("LAST", "48 kPa"), encoding="utf-8")
    assert len(entries.read_materials(path)["tape"]["youngs_modulus_table"]) == 3
    # Small falls must not add up to a large one.
    path.write_text(text.replace("LAST", "47 kPa"), encoding="utf-8")
    with pytest.raises(entries.EntryError, match=r"at 10 Hz .* does not fall") as caught:
        entries.read_materials(path)
    assert caught.value.key == f"{path}: materials.tape.youngs_modulus_table[2]"
    assert str(caught.value.value) == "47 kPa"


@pytest.mark.parametrize("name", ["2024_01", "no", "1.10", "2024-01-05"])
def test_a_name_that_yaml_takes_for_a_number_is_wanted_in_quotes(tmp_path, name):
    path = tmp_path / "tape.yaml"
    text = "{NAME: {label: a, source: b, common: psa}}"
    path.write_text(f"materials: {text.replace('NAME', name)}", encoding="utf-8")
    with pytest.raises(entries.EntryError, match="put it in quotes"):
        entries.read_materials(path)
    path.write_text(f"materials: {text.replace('NAME', repr(name))}", encoding="utf-8")
    assert list(entries.read_materials(path)) == [name]


def test_quantities_are_pickled_and_written():
    length = Quantity.read("10 um", "m")
    copy = pickle.loads(pickle.dumps(length))
    assert copy == length == pytest.approx(1e-5)
    assert (copy.text, repr(copy), f"{copy}") == ("10 um", "'10 um'", "10 um")
    assert write_quantities({"length": [length, None]}) == {"length": ["10 um", None]}


def test_importing_the_library_needs_neither_pydantic_nor_yaml():
    code = "import sys, stickiness.entries; print({'pydantic', 'yaml'} & {*sys.modules})"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "set()"


def test_common_materials_are_a_dozen_that_can_be_judged():
    common = entries.list_common_materials()
    assert len(common) == 12
    for entry in common.values():
        material = Material.from_entry(entry)
        assert material.solid == HALF_SPACE
        assert entry["source"] == "typical" or "19" in entry["source"] or "20" in entry["source"]


def test_keys_beside_a_common_material_replace_its_values():
    common = entries.list_common_materials()["psa"]
    assert entries.check_material({"common": "psa"}) == common
    tape = entries.check_material({"common": "psa", "thickness": "50 um", "label": "my tape"})
    assert tape == common | {
        "thickness": tape["thickness"],
        "label": "my tape",
        "backing": "bonded",
    }
    table = [["0.1 Hz", "50 kPa"], ["10 Hz", "0.2 MPa"]]
    slow = entries.check_material({"common": "psa", "youngs_modulus_table": table})
    assert slow["youngs_modulus"] is None
    assert slow["work_of_adhesion"] == common["work_of_adhesion"]
    assert entries.check_material(slow) == slow


def test_an_unknown_common_material_has_a_close_match():
    with pytest.raises(entries.EntryError, match="'steel'") as caught:
        entries.check_material({"common": "stel"})
    assert (caught.value.key, caught.value.value) == ("common", "stel")


def test_the_json_schema_knows_that_a_common_material_gives_the_rest():
    schema = jsonschema.Draft202012Validator(Materials.model_json_schema())
    complete = {"label": "tape", "source": "own", **TAPE}
    for entry, right in (
        ({"common": "psa"}, True),
        ({"common": "psa", "thickness": "50 um"}, True),
        (complete, True),
        ({"label": "tape", "source": "own"}, False),
        ({"common": "psa", "tickness": "50 um"}, False),
    ):
        assert schema.is_valid({"materials": {"tape": entry}}) == right, entry


@pytest.mark.parametrize("kind", ["material", "surface"])
def test_options_of_the_command_have_the_texts_of_their_keys(kind, capsys):
    texts = entries.describe_keys(kind)
    assert TEXTS[kind].keys() < texts.keys()
    with pytest.raises(SystemExit):
        read_options(["--help"])
    shown = " ".join(capsys.readouterr().out.split())
    for key, option in TEXTS[kind].items():
        value = "" if key in TEXTS["flags"][kind] else " VALUE"
        assert f"{option}{value} {texts[key]}" in shown


def test_a_wheel_has_all_files_that_are_no_code():
    project = tomllib.loads((SCRIPTS.parent / "pyproject.toml").read_text(encoding="utf-8"))
    package = SCRIPTS / "stickiness"
    patterns = project["tool"]["setuptools"]["package-data"]["stickiness"]
    packed = {
        path.relative_to(package).as_posix()
        for pattern in patterns
        for path in package.glob(pattern)
    }
    files = [path for path in package.rglob("*.*") if path.suffix not in (".py", ".pyc")]
    kept = [path.relative_to(package).as_posix() for path in files if path.is_file()]
    assert {path for path in kept if "__pycache__" not in path} == packed
