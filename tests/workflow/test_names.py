"""Names of cases and model surfaces are free: nothing but the configuration knows them."""

import pytest
import yaml
from helpers.copy_workflow import ROOT


def rename(workflow):
    """Give every case and every model surface another name, one unlike the other."""
    path = workflow / "config/config.yaml"
    config = yaml.safe_load(path.read_text(encoding="utf-8"))
    surfaces = {name: f"ground{i}" for i, name in enumerate(config["model_surfaces"])}
    cases = {name: f"press{i}" for i, name in enumerate(config["cases"])}
    config["cases"] = {
        cases[name]: entry | {"surface": surfaces[entry["surface"]]}
        for name, entry in config["cases"].items()
    }
    config["roles"] = {role: cases[name] for role, name in config["roles"].items()}
    tiny = workflow / "config/tiny.yaml"
    for file, content in ((path, config), (tiny, yaml.safe_load(tiny.read_text()))):
        content["model_surfaces"] = {
            surfaces[name]: entry for name, entry in content["model_surfaces"].items()
        }
        file.write_text(yaml.safe_dump(content, sort_keys=False), encoding="utf-8")


@pytest.mark.workflow
def test_the_same_jobs_are_planned(fresh):
    before = fresh.planned()
    rename(fresh)
    assert fresh.planned() == before
    assert "H0." not in fresh.dry_run("fig4").stdout


def test_no_code_or_template_has_a_name_of_the_configuration():
    config = yaml.safe_load((ROOT / "config/config.yaml").read_text(encoding="utf-8"))
    names = config["model_surfaces"].keys() | config["cases"].keys()
    assert len(names) > 5
    files = [ROOT / "Snakefile", *(ROOT / "rules").iterdir(), *(ROOT / "report").iterdir()]
    files += (ROOT / "scripts").rglob("*.py")
    for file in files:
        text = file.read_text(encoding="utf-8")
        assert [name for name in names if name in text] == [], file
