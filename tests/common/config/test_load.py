"""The configuration as a whole: its files, what overrides what, and where an error is."""

import copy
import shutil
from pathlib import Path

import pytest
import yaml

from common.config import entries, load
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
        (load.USER, "fidelity", "config/config.yaml: fidelity = 3 must be a text"),
        (load.USER, "fidelty", "config/config.yaml: unknown key 'fidelty'; did you mean"),
        (load.PAPER, "theory", "config/campaigns/paper.yaml: theory = 3 must hold keys"),
        ("config/campaigns/tradeoff.yaml", "finer", "config/campaigns/tradeoff.yaml: finer = 3"),
        ("config/materials.yaml", "materials", "config/materials.yaml: materials = 3 must hold"),
    ],
)
def test_an_error_names_its_file(folder, path, key, message):
    edit(path, **{key: 3})
    with pytest.raises(load.ConfigError) as caught:
        check()
    assert str(caught.value).startswith(message)


def test_a_module_and_files_that_another_workflow_makes(folder):
    with pytest.raises(load.ConfigError, match="config of module wall: unknown key 'sedes'"):
        check({"sedes": 3}, name="config of module wall")
    surfaces = {"mine": {"kind": "measured", "label": "a", "source": "b", "file": "not/there.txt"}}
    edit("config/surfaces.yaml", surfaces=surfaces)
    check(made=True)
    with pytest.raises(load.ConfigError, match=r"mine\.file = 'not/there.txt': no such file"):
        check()


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


def test_keys_beside_the_list_apply_to_every_measurement():
    surface = {
        "kind": "measured",
        "detrend": "quadratic",
        "measurements": [{"file": "a"}, {"file": "b", "detrend": "mean"}],
    }
    (first, one), (second, two) = entries.measurements(surface)
    assert (first, second) == ("measurements[0].", "measurements[1].")
    assert (one["file"], one["detrend"], two["detrend"]) == ("a", "quadratic", "mean")
    assert "measurements" not in one


@pytest.mark.parametrize("other", ["youngs_modulus", "plane_strain_modulus"])
def test_conditions_of_a_case_replace_those_of_its_experiment(other):
    experiment = {"hurst": 0.8, "range": "1 nm", "poisson_ratio": 0.5, other: "2 MPa"}
    (mine,) = {"youngs_modulus", "plane_strain_modulus"} - {other}
    found = entries.conditions_of(experiment, {"range": "2 nm", mine: "3 MPa", "observed": {}})
    assert found == {"hurst": 0.8, "range": "2 nm", "poisson_ratio": 0.5, mine: "3 MPa"}


def test_the_reference_is_up_to_date():
    assert PAGE.read_text(encoding="utf-8") == page(), "run: make docs"


def test_every_key_is_described_and_the_schemas_are_made():
    rows = [line.split(" | ") for line in page().splitlines() if line.startswith(("| `", "| **"))]
    assert all(len(row) == 3 and row[2].strip("| ") for row in rows)
    for model in MODELS.values():
        assert model.model_json_schema()["properties"]
