"""The configuration as a whole: its files, what overrides what, and where an error is."""

import copy
import shutil
from pathlib import Path

import pytest
import yaml

from common.config import conditions, load
from common.config.models import MODELS
from common.config.reference import PAGE, page

ROOT = Path(__file__).parents[3]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A copy of the configuration, in the working directory."""
    shutil.copytree(ROOT / "config", tmp_path / "config")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def check(given=None, **keywords):
    given = load.load(load.USER) if given is None else given
    campaigns = {name: load.load(path) for name, path in load.CAMPAIGNS.items()}
    load.check_all(load.defaults(".") | given, campaigns, given, **keywords)


def edit(path, **keys):
    content = yaml.safe_load(Path(path).read_text(encoding="utf-8"))
    Path(path).write_text(yaml.safe_dump(content | keys), encoding="utf-8")


def test_the_committed_configuration_passes_unchanged(folder):
    given = load.load(load.USER)
    before = copy.deepcopy(given)
    check(given)
    assert given == before


@pytest.mark.parametrize(
    ("path", "key", "message"),
    [
        (load.USER, "fidelity", "config/config.yaml: fidelity = 3: "),
        (load.USER, "fidelty", "config/config.yaml: fidelty: "),
        (load.PAPER, "theory", "config/campaigns/paper.yaml: theory = 3: "),
        ("config/campaigns/tradeoff.yaml", "finer", "config/campaigns/tradeoff.yaml: finer = 3: "),
        ("config/materials.yaml", "materials", "config/materials.yaml: materials = 3: "),
    ],
)
def test_an_error_names_its_file(folder, path, key, message):
    edit(path, **{key: 3})
    with pytest.raises(load.ConfigError) as caught:
        check()
    assert str(caught.value).startswith(message)


def test_a_module_and_files_that_another_workflow_makes(folder):
    with pytest.raises(load.ConfigError, match="config of module wall: sedes: "):
        check({"sedes": 3}, name="config of module wall")
    surfaces = {"mine": {"kind": "measured", "label": "a", "source": "b", "file": "not/there.txt"}}
    edit("config/surfaces.yaml", surfaces=surfaces)
    check(made=True)
    with pytest.raises(load.ConfigError, match=r"mine\.file = 'not/there.txt': no such file"):
        check()


def test_files_of_the_project_are_found_from_any_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    config = load.defaults(ROOT, lambda path: f"{ROOT}/{path}")
    surfaces = load.check_all(config, {}, {})["surfaces"]["surfaces"]
    files = [each["file"] for each in surfaces["uncd_diamond"]["measurements"]]
    assert files == [str(ROOT / "config/topographies/uncd_diamond.nc")] * 3


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("psa: {label: [}\n", r"materials\.yaml: line 1: not valid YAML"),
        ("psa: 1\npsa: 2\n", r"materials\.yaml: line 2: .*'psa' is given twice"),
        ("- psa\n", r"materials\.yaml: must hold keys and values, found list"),
        (None, r"materials\.yaml: no such file; set its path in config/config\.yaml"),
    ],
)
def test_files_that_cannot_be_read(folder, text, message):
    Path("config/materials.yaml").unlink()
    if text:
        Path("config/materials.yaml").write_text(text, encoding="utf-8")
    with pytest.raises(load.ConfigError, match=message):
        check()


def test_checked_values_are_numbers_in_si_units_with_defaults(folder):
    given = load.load(load.USER)
    campaigns = {name: load.load(path) for name, path in load.CAMPAIGNS.items()}
    checked = load.check_all(load.defaults("."), campaigns, given)
    psa = checked["materials"]["materials"]["psa"]
    assert psa["youngs_modulus"] == 1e5
    assert str(psa["youngs_modulus"]) == "0.1 MPa"
    assert (psa["law"], psa["dwell"]) == ("exponential", None)
    surface = checked["config"]["model_surfaces"]["H0.8_zeta64"]
    assert surface["window"] == 1.0
    # A key that came later must not run simulations of surfaces without it again.
    assert "heights" not in surface
    assert "heights" not in checked["remaining"]["sets"]["H0.8_zeta4_4x4"]


@pytest.mark.parametrize("other", ["youngs_modulus", "plane_strain_modulus"])
def test_conditions_of_a_case_replace_those_of_its_experiment(other):
    absent = dict.fromkeys(conditions.CONDITIONS)
    experiment = absent | {"hurst": 0.8, "range": 1e-9, "poisson_ratio": 0.5, other: 2e6}
    (mine,) = {"youngs_modulus", "plane_strain_modulus"} - {other}
    case = absent | {"range": 2e-9, mine: 3e6}
    expected = {"hurst": 0.8, "range": 2e-9, "poisson_ratio": 0.5, mine: 3e6}
    assert conditions.conditions_of(experiment, case) == expected


def test_the_reference_is_up_to_date():
    assert PAGE.read_text(encoding="utf-8") == page(), "run: make docs"


def test_every_key_is_described_and_the_schemas_are_made():
    rows = [line.split(" | ") for line in page().splitlines() if line.startswith(("| `", "| **"))]
    assert all(len(row) == 3 and row[2].strip("| ") for row in rows)
    for model in MODELS.values():
        assert model.model_json_schema()["properties"]
