"""Bad configuration: one line that names key, value and remedy."""

import copy
import shutil
from pathlib import Path

import pytest
import yaml

from common.config import checks

ROOT = Path(__file__).parents[3]
CONFIG, MATERIALS, SURFACES, EXPERIMENTS = (
    f"config/{name}.yaml" for name in ("config", "materials", "surfaces", "experiments")
)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A copy of the configuration, as the working directory."""
    shutil.copytree(ROOT / "config", tmp_path / "config")
    for entry in ROOT.iterdir():  # whatever else the configuration may name, such as data
        if entry.name != "config":
            (tmp_path / entry.name).symlink_to(entry)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def check():
    return checks.check_all(checks.load(CONFIG), "config/schemas")


def changed(path, *keys, value):
    def edit():
        file = Path(path)
        content = yaml.load(file.read_text(encoding="utf-8"), yaml.CSafeLoader)  # the fast one
        node = content
        for key in keys[:-1]:
            node = node[key]
        if value is None:
            del node[keys[-1]]
        else:
            node[keys[-1]] = value
        file.write_text(yaml.dump(content, Dumper=yaml.CSafeDumper), encoding="utf-8")

    return edit


def case(*keys, value):
    return changed(CONFIG, "cases", "H0.8_zeta64", *keys, value=value)


def of_theory(**keys):
    asked = {"surface": "H0.8_zeta64", "pressures": [0.1], "model": "theory"}
    return changed(CONFIG, "cases", "mine", value=asked | keys)


def with_accuracy(**keys):
    asked = {"surface": "H0.8_zeta64", "pressures": [0.1], "accuracy": 0.1}
    return changed(CONFIG, "cases", "mine", value=asked | keys)


def adhesion(*keys, value):
    return changed(CONFIG, "adhesion", "fig2", *keys, value=value)


def material(*keys, value):
    return changed(MATERIALS, "materials", "crystal", *keys, value=value)


def steel(*keys, value):
    return changed(SURFACES, "surfaces", "polished_steel", *keys, value=value)


def terrain(**keys):
    """Edit the measured surface: a text file, with these keys (None: without)."""

    def edit():
        file = Path(SURFACES)
        content = yaml.load(file.read_text(encoding="utf-8"), yaml.CSafeLoader)  # the fast one
        surface = {"file": "README.md", **content["surfaces"]["jacksboro"], **keys}
        if "file" not in keys:
            surface["file"] = "README.md"
        kept = {key: value for key, value in surface.items() if value is not None}
        content["surfaces"]["jacksboro"] = kept
        file.write_text(yaml.safe_dump(content), encoding="utf-8")

    return edit


def table(pairs):
    def edit():
        file = Path(MATERIALS)
        content = yaml.load(file.read_text(encoding="utf-8"), yaml.CSafeLoader)  # the fast one
        crystal = content["materials"]["crystal"]
        del crystal["plane_strain_modulus"]
        crystal |= {"youngs_modulus_table": pairs, "poisson_ratio": 0.3}
        file.write_text(yaml.safe_dump(content), encoding="utf-8")

    return edit


COMPARISON = {"hurst": 0.8, "magnification": 16, "seeds": 4}


def model(*keys, value):
    return changed(CONFIG, "model_surfaces", "H0.8_zeta64", *keys, value=value)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("edit", "words"),
    [
        (changed(CONFIG, "fidelty", value="draft"), ["fidelty", "fidelity"]),
        (changed(CONFIG, "fidelity", value="best"), ["fidelity", "'best'", "draft"]),
        (case("pressure", value=[0.1]), ["H0.8_zeta64", "'pressure'", "pressures"]),
        (case("pressures", value=[0.1, -0.2]), ["pressures[1]", "-0.2", "greater than 0"]),
        (case("surface", value="H0.8_zeta65"), ["surface", "H0.8_zeta65", "H0.8_zeta64"]),
        (adhesion("accuracy", value=None), ["adhesion.fig2.accuracy", "missing", "auto"]),
        (adhesion("model", value="full"), ["adhesion.fig2.accuracy", "0.1", "model: auto"]),
        (adhesion("model", value="best"), ["adhesion.fig2.model", "'best'", "auto, dmt, full"]),
        (adhesion("pressures", value=[0.07]), ["fig2.pressures", "0.07", "cases.H0.8_zeta64"]),
        (adhesion("range_over_h_rms", value=[20]), ["fig2.range_over_h_rms", "20", "0.0001"]),
        (adhesion("case", value="H0.8_zeta65"), ["fig2.case", "H0.8_zeta65", "H0.8_zeta64"]),
        (adhesion("accuracy", value=2), ["fig2.accuracy", "2", "at most 1"]),
        (
            changed(CONFIG, "adhesion", "dmt_error", "model", value="dmt"),
            ["dmt_error", "seeds", "full model", "model: dmt"],
        ),
        (case("maps", value=[0.07]), ["maps", "0.07", "pressures"]),
        (case("accuracy", value=3), ["H0.8_zeta64.accuracy", "3", "at most 1"]),
        (case("accuracy", value=0), ["H0.8_zeta64.accuracy", "0", "greater than 0"]),
        (case("quantities", value=["areas"]), ["quantities[0]", "'areas'", "'area'?"]),
        (case("quantities", value=[]), ["quantities", "at least 1"]),
        (case("quantities", value=["area"]), ["H0.8_zeta64.quantities", "leave it out"]),
        (
            changed(CONFIG, "cases", "H0.8_zeta32", "model", value="theory"),
            ["H0.8_zeta32.model", "'theory'", "add a case"],
        ),
        (case("carry_to", value=64), ["H0.8_zeta64.carry_to", "64", "above the magnification"]),
        (case("carry_to", value=1024), ["H0.8_zeta64.carry_to", "1024", "at most 512"]),
        (
            changed(CONFIG, "cases", "H0.8_zeta32", "carry_to", value=300),
            ["H0.8_zeta32.carry_to", "300", "at most 256"],
        ),
        (of_theory(seeds=3), ["mine.seeds", "3", "model: theory"]),
        (of_theory(accuracy=0.1), ["mine.accuracy", "0.1", "model: theory"]),
        (of_theory(at_most=9), ["mine.at_most", "9", "model: theory"]),
        (with_accuracy(at_most=1), ["mine.at_most", "1", "at least 2"]),
        (case("at_most", value=9), ["H0.8_zeta64.at_most", "9", "needs accuracy"]),
        (changed(CONFIG, "sampling", "at_most", value=129), ["sampling.at_most", "at most 128"]),
        (
            changed(CONFIG, "tradeoff", "presets", "surface", value="H0.8_zeta65"),
            ["tradeoff.presets.surface", "H0.8_zeta65", "H0.8_zeta64"],
        ),
        (
            changed(CONFIG, "tradeoff", "presets", "accuracy", value={"drift": 0.1}),
            ["tradeoff.presets.accuracy", "drift", "draft"],
        ),
        (
            changed(CONFIG, "tradeoff", "settings", "at_tolerances", value=1),
            ["tradeoff.settings", "at_tolerances", "at_tolerance"],
        ),
        (
            changed(CONFIG, "remaining", "sets", "H0.8_zeta32_4x4", "points", value=128),
            ["remaining.sets.H0.8_zeta32_4x4.points", "128", "at least 256"],
        ),
        (
            changed(CONFIG, "remaining", "sets", "H0.8_zeta16_rolloff", "rolloff", value=16),
            ["H0.8_zeta16_rolloff.rolloff", "16", "below magnification"],
        ),
        (case("sampling", value="best"), ["H0.8_zeta64.sampling", "'best'", "multilevel"]),
        (changed(CONFIG, "sampling", "method", value="plan"), ["method", "'plan'", "'plain'?"]),
        (
            changed(CONFIG, "fidelities", "draft", "coarse_seeds", value=8),
            ["fidelities.draft.coarse_seeds", "8", "at least 32"],
        ),
        (
            changed(CONFIG, "fidelities", "draft", "comparisons", value=["H0.5_zeta16_4x5"]),
            ["fidelities.draft.comparisons", "H0.5_zeta16_4x5", "H0.5_zeta16_4x4"],
        ),
        (
            changed(CONFIG, "comparisons", "surfaces", "H0.8_zeta64", value=COMPARISON),
            ["comparisons.surfaces.H0.8_zeta64", "name of a case"],
        ),
        (
            changed(CONFIG, "theory", "table", "pressure", value=[0.1, 0.01, 0.2, 0.5]),
            ["theory.table.pressure", "0.01", "increasing"],
        ),
        (
            changed(CONFIG, "sampling", "descriptor_seeds", value=0.5),
            ["sampling.descriptor_seeds", "0.5", "integer"],
        ),
        (model("hurst", value=1.2), ["hurst", "1.2", "at most 1"]),
        (model("hurst", value=0), ["hurst", "0", "(0, 1]"]),
        (model("magnification", value=0.5), ["magnification", "0.5", "greater than 1"]),
        (model("window", value=0.5), ["window", "0.5", "at least 1"]),
        (material("plane_strain_modulus", value="-1 GPa"), ["crystal", "-1 GPa", "positive"]),
        (material("plane_strain_modulus", value="1 GN"), ["plane_strain_modulus", "1 GN", "Pa"]),
        (material("work_of_adhesion", value=0.05), ["work_of_adhesion", "0.05", "string"]),
        (
            material("range", value="0.2 nanometre s"),
            ["range", "0.2 nanometre s", "a length is wanted"],
        ),
        (material("source", value=None), ["crystal", "source", "missing"]),
        (material("thickness", value="50 um"), ["crystal", "50 um", "youngs_modulus"]),
        (material("thickness", value="50"), ["crystal.thickness", "'50'", "unit"]),
        (material("thickness", value="-1 um"), ["crystal.thickness", "-1 um", "positive"]),
        (material("backing", value="slip"), ["crystal", "slip", "thickness"]),
        (material("backing", value="glued"), ["backing", "glued", "bonded"]),
        (material("surface", value="ashpalt"), ["crystal.surface", "ashpalt", "'asphalt'"]),
        (steel("anisotropy", value=0.5), ["polished_steel.anisotropy", "0.5", "1"]),
        (steel("angle", value=270), ["polished_steel.angle", "270", "180"]),
        (steel("hurst", value=1.5), ["hurst", "1.5", "1"]),
        (steel("h_rms", value=["2 um", "1 um"]), ["h_rms", "2 um", "[low, high]"]),
        (steel("shortest_wavelength", value="1 mm"), ["shortest_wavelength", "longest"]),
        (
            changed(SURFACES, "surfaces", "jacksboro", "file", value="data/none.txt"),
            ["jacksboro", "file", "data/none.txt", "no such file"],
        ),
        (
            changed(SURFACES, "surfaces", "jacksboro", "file", value="builtin:jackson"),
            ["jacksboro", "builtin:jackson", "jacksboro"],
        ),
        (
            changed(SURFACES, "surfaces", "jacksboro", "height_unit", value="kg"),
            ["jacksboro", "height_unit", "kg", "m"],
        ),
        (terrain(length="1 um", pixel_size="1 nm"), ["pixel_size", "not both"]),
        (terrain(channel="Height"), ["channel", "'Height'", "text", "leave it out"]),
        (terrain(variable="z"), ["variable", "'z'", "NetCDF"]),
        (terrain(missing="guess"), ["missing", "'guess'", "fill"]),
        (terrain(missing="crop", max_missing=0.2), ["max_missing", "0.2", "missing: crop"]),
        (terrain(missing_rim=-1), ["missing_rim", "-1", "detect"]),
        (terrain(missing_rim="wide"), ["missing_rim", "wide", "detect"]),
        (terrain(spikes="drop"), ["jacksboro.spikes", "'drop'", "mask"]),
        (terrain(plausibility="maybe"), ["jacksboro.plausibility", "'maybe'", "ignore"]),
        (
            terrain(length="2 m"),
            ["length = '2 m' is longer than 0.5 m", "2 mm, not 2 m?", "plausibility: ignore"],
        ),
        (terrain(length=["2 mm", "160 m"]), ["length = '160 m' is longer than 0.5 m"]),
        (terrain(length="2 pm"), ["length = '2 pm' is shorter than 1e-09 m"]),
        (terrain(length="2 Mm"), ["'2 Mm': Mm is megametre", "did you mean '2 mm'?"]),
        (terrain(length="2 MPa"), ["'2 MPa' is a pressure; a length is wanted, e.g. '10 um'"]),
        (terrain(height_unit="V"), ["height_unit = '1 V' is in V; a length is wanted"]),
        (terrain(height_unit="Nm"), ["height_unit", "a length is wanted"]),
        (terrain(tip_radius="10 mN"), ["tip_radius = '10 mN' is a force; a length is wanted"]),
        (terrain(missing_value="zero"), ["missing_value = 'zero' must be of type number"]),
        (terrain(channel=-1), ["channel = -1 must be at least 0"]),
        (terrain(max_missing=1.2), ["max_missing = 1.2 must be below 1"]),
        (
            material("plane_strain_modulus", value="30 kpa"),
            ["plane_strain_modulus = '30 kpa' cannot be read: did you mean '30 kPa'?"],
        ),
        (
            material("plane_strain_modulus", value="30 mPa"),
            ["mPa is millipascal", "did you mean '30 MPa'?"],
        ),
        (
            material("work_of_adhesion", value="50 mN"),
            ["'50 mN' is a force; an energy per area is wanted, e.g. '50 mJ/m^2'"],
        ),
        (material("range", value="0.3"), ["range = '0.3' has no unit; a length is wanted"]),
        (material("range", value="0,3 nm"), ["'0,3 nm' holds a comma", "decimal point"]),
        (terrain(missing_rim=1.5), ["missing_rim", "1.5", "type string or integer"]),
        (terrain(pixel_size=2), ["jacksboro.pixel_size", "2", "string or array", "unit"]),
        (terrain(pixel_size=["2 m"]), ["jacksboro.pixel_size", "2 m", "at least 2"]),
        (terrain(pixel_size=["2 m", 2]), ["jacksboro.pixel_size[1]", "2", "string"]),
        (steel("h_rms", value=1), ["h_rms", "1", "string or array", "unit"]),
        (terrain(tip_radius="-3 nm"), ["jacksboro.tip_radius", "-3 nm", "positive"]),
        (terrain(fit_from="1 um", fit_to="1 mm"), ["fit_to", "1 mm", "fit_from"]),
        (terrain(cutoff="maybe"), ["cutoff", "'maybe'", "detect"]),
        (terrain(file=None), ["jacksboro", "file; measurements"]),
        (terrain(measurements=[{"file": "README.md"}] * 2), ["jacksboro", "file; measurements"]),
        (
            terrain(file=None, measurements=[{"file": "README.md"}, {"file": "none.txt"}]),
            ["jacksboro.measurements[1].file", "none.txt", "no such file"],
        ),
        (terrain(file=None, measurements=[{"file": "README.md"}]), ["measurements", "at least 2"]),
        (table([["1 Hz", "1 MPa"]]), ["youngs_modulus_table", "at least 2"]),
        (table([["1 Hz", "1 MPa"], ["0.1 Hz", "1 MPa"]]), ["crystal", "ascend"]),
        (table([["2 Hz", "1 MPa"], ["9 Hz", "1 MPa"]]), ["crystal", "2 Hz", "cover 1 Hz"]),
        (table([["1 s", "1 MPa"], ["9 Hz", "1 MPa"]]), ["table[0][0]", "'1 s'", "Hz"]),
        (
            changed(CONFIG, "criteria", "frequencies", "minimum", value=1e9),
            ["criteria.frequencies.minimum", "below maximum"],
        ),
        (material("range", value="2,5 nm"), ["crystal.range", "2,5 nm", "decimal point"]),
        (
            changed(
                EXPERIMENTS, "experiments", "dalvi", "hurst", value={"value": 2, "known": "read"}
            ),
            ["experiments.yaml", "dalvi.hurst.value", "2", "between 0.01 and 1"],
        ),
        (changed(EXPERIMENTS, "experimets", value={}), ["experimets", "'experiments'?"]),
        (changed(CONFIG, "experiments", value="config/e.yaml"), ["config/e.yaml", "no such"]),
        (changed(CONFIG, "experiments", value=None), ["'experiments' is missing"]),
        (changed(CONFIG, "surfaces", value="config/surfs.yaml"), ["config/surfs.yaml", "no such"]),
        (changed(CONFIG, "cases", "H0.8_zeta32", value=None), ["cases", "H0.8_zeta32", "missing"]),
        (
            changed(CONFIG, "criteria", "map", "range_times_q0", "maximum", value=1e-13),
            ["criteria.map.range_times_q0.minimum", "below maximum"],
        ),
        (
            changed(CONFIG, "criteria", "compared", "magnification", "maximum", value=1e9),
            ["criteria.compared.magnification.maximum", "theory.table.magnification", "100000000"],
        ),
        (
            changed(CONFIG, "criteria", "compared", "quoted_h_rms_over_range", value=0.5),
            ["criteria.compared.quoted_h_rms_over_range", "0.5", "theory.table.range"],
        ),
        (
            changed(CONFIG, "criteria", "map", "hurst", value=0.1),
            ["criteria.map.hurst", "0.1", "theory.table.hurst"],
        ),
        (
            changed(CONFIG, "criteria", "a_v", "pressure", value=0.07),
            ["criteria.a_v.pressure", "0.07", "H0.8_zeta32_wide"],
        ),
        (
            changed(CONFIG, "criteria", "a_v", "measured", value="config/a_v.csv"),
            ["criteria.a_v", "measured", "from the run itself"],
        ),
    ],
)
def test_one_line_names_key_value_and_remedy(folder, edit, words):
    edit()
    with pytest.raises(checks.ConfigError) as caught:
        check()
    message = str(caught.value)
    assert "\n" not in message
    for word in words:
        assert word in message


def test_shipped_configuration_is_valid(folder):
    materials, surfaces, experiments = check()
    assert len(materials) >= 6
    assert "jacksboro" in surfaces
    assert "fuller_tabor" in experiments


def test_a_key_given_twice_is_refused(folder):
    with Path(MATERIALS).open("a", encoding="utf-8") as file:
        file.write("  psa: {label: another}\n")
    with pytest.raises(checks.ConfigError, match=r"materials\.yaml: line \d+: .*'psa' .* twice"):
        check()


def test_broken_yaml_names_file_and_line(folder):
    Path(MATERIALS).write_text("materials:\n  psa: {label: [}\n", encoding="utf-8")
    with pytest.raises(checks.ConfigError, match=r"materials\.yaml: line 2"):
        check()


@pytest.mark.parametrize(
    ("key", "message"),
    [
        ("carry_to", "mine.yaml: case: the key 'carry_to' is now called 'extrapolate_to'"),
        ("seed", "mine.yaml: case: remove the key 'seed': seeds are numbered from 1"),
    ],
)
def test_a_key_of_an_earlier_version_gets_one_line_with_what_to_do(tmp_path, key, message):
    case = {
        "type": "object",
        "additionalProperties": False,
        "renamed": {"carry_to": "extrapolate_to"},
        "removed": {"seed": "seeds are numbered from 1"},
        "properties": {"extrapolate_to": {"type": "number"}},
    }
    schema = tmp_path / "case.schema.yaml"
    schema.write_text(yaml.safe_dump({"type": "object", "properties": {"case": case}}))
    with pytest.raises(checks.ConfigError) as caught:
        checks.check_schema({"case": {key: 1}}, schema, "mine.yaml")
    assert str(caught.value) == message
    checks.check_schema({"case": {"extrapolate_to": 1}}, schema, "mine.yaml")


def test_the_check_changes_nothing(folder):
    given = checks.load(CONFIG)
    before = copy.deepcopy(given)
    checks.check_all(given, "config/schemas")
    assert given == before


def schema_keys(node):
    """Every pair of renamed or removed keys and the keys that there are beside them."""
    if isinstance(node, dict):
        old = {**node.get("renamed", {}), **node.get("removed", {})}
        if old:
            yield set(old), set(node.get("renamed", {}).values()), set(node["properties"])
        for value in node.values():
            yield from schema_keys(value)


def test_renamed_keys_lead_to_keys_that_exist():
    for path in (ROOT / "config/schemas").glob("*.yaml"):
        for old, new, present in schema_keys(checks.load(path)):
            assert old.isdisjoint(present)
            assert new <= present


def test_frequencies_out_of_order_are_shown(folder):
    table([["1 Hz", "1 MPa"], ["0.1 Hz", "1 MPa"]])()
    with pytest.raises(checks.ConfigError, match=r"table = 1 Hz, 0\.1 Hz: .*ascend"):
        check()


def test_keys_beside_the_list_hold_for_every_measurement():
    surface = {
        "kind": "measured",
        "detrend": "quadratic",
        "measurements": [{"file": "a"}, {"file": "b", "detrend": "mean"}],
    }
    (first, one), (second, two) = checks.measurements(surface)
    assert (first, second) == ("measurements[0].", "measurements[1].")
    assert (one["file"], one["detrend"], two["detrend"]) == ("a", "quadratic", "mean")
    assert "measurements" not in one


def test_the_measurement_for_bem_must_exist():
    surfaces = {
        "asphalt": {"kind": "measured", "file": __file__},
        "polished_steel": {"kind": "measured", "file": __file__, "bem": {"measurement": 1}},
    }
    with pytest.raises(checks.ConfigError, match=r"polished_steel\.bem\.measurement = 1 .*below 1"):
        checks.check_surfaces(surfaces)


ADHESION = {"plane_strain_modulus": "25 MPa", "work_of_adhesion": "50 mJ/m^2", "range": "2 nm"}


@pytest.mark.parametrize(
    ("bem", "beside", "text"),
    [
        ({"pressures": ["1 MPa"]}, {}, r"pressures\[0\] = '1 MPa' needs bem\.adhesion"),
        ({"pressures": ["1 MPa", 0.1], "adhesion": ADHESION}, {}, r"pressures\[1\] = 0\.1 has no"),
        ({"pressures": ["1 m"], "adhesion": ADHESION}, {}, r"pressures\[0\] = '1 m' is a length"),
        ({"pressures": ["-1 Pa"], "adhesion": ADHESION}, {}, r"'-1 Pa' must be positive"),
        ({"pressures": ["1 MPa", "1e6 Pa"], "adhesion": ADHESION}, {}, "must not repeat"),
        ({"pressures": [0.1], "periodic": True}, {"detrend": "plane"}, "detrend = 'plane' would"),
        ({"pressures": [0.1], "periodic": True}, {"missing": "crop"}, "missing = 'crop' would"),
    ],
)
def test_a_contact_that_cannot_be_is_refused(bem, beside, text):
    measured = {"kind": "measured", "file": __file__}
    surfaces = {"asphalt": measured, "polished_steel": measured | beside | {"bem": bem}}
    with pytest.raises(checks.ConfigError, match=r"surfaces\.polished_steel\..*" + text):
        checks.check_surfaces(surfaces)


@pytest.mark.parametrize(
    ("bem", "text"),
    [
        ({"pressures": [0]}, r"pressures\[0\] = 0 must be greater than 0"),
        ({"pressures": [0.1], "most_points": 16384}, "most_points = 16384 must be at most 8192"),
        ({"pressures": [0.1], "adhesion": {"range": "1 nm"}}, "adhesion: "),
        ({"pressures": [0.1], "periodic": "yes"}, "periodic = 'yes' must be of type boolean"),
    ],
)
def test_the_schema_refuses_a_contact(bem, text):
    entry = {"kind": "measured", "label": "a", "file": "a.npy", "source": "own", "bem": bem}
    with pytest.raises(checks.ConfigError, match=text):
        checks.check_schema(
            {"surfaces": {"a": entry}}, ROOT / "config/schemas/surfaces.schema.yaml", "s.yaml"
        )


def test_units_within_adhesion_are_checked():
    entry = {"bem": {"adhesion": ADHESION | {"range": "2 Pa"}}}
    with pytest.raises(checks.ConfigError, match=r"a\.bem\.adhesion\.range = '2 Pa' is a pressure"):
        checks.check_units({"surfaces": {"a": entry}}, "s.yaml")


@pytest.mark.parametrize(
    ("key", "value", "allowed"),
    [
        ("range", "0.3 mm", "1e-12 m … 1e-4 m"),
        ("work_of_adhesion", "60 MJ/m^2", "1e-9 J/m^2 … 10000 J/m^2"),
        ("thickness", "50 m", "1e-10 m … 1 m"),
        ("youngs_modulus", "0.2 Pa", "1 Pa … 100000 GPa"),
    ],
)
def test_sizes_of_no_solid_are_refused(key, value, allowed):
    tape = {"youngs_modulus": "0.2 MPa", "work_of_adhesion": "60 mJ/m^2", "range": "0.3 nm"}
    tape |= {"thickness": "50 um", "poisson_ratio": 0.5}
    checks.check_materials({"tape": tape})
    with pytest.raises(checks.ConfigError, match="no solid is beyond") as raised:
        checks.check_materials({"tape": tape | {key: value}}, "mine.yaml")
    assert str(raised.value).startswith(f"mine.yaml: materials.tape.{key} = {value!r}")
    assert allowed in str(raised.value)
