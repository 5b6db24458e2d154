"""The table of the paper's panels says where the configuration differs from the paper."""

import pytest
from helpers.committed import ROOT, read_committed

from common.paper import PANELS, compare_panels
from stickiness.pages.rendering import make_environment


@pytest.fixture
def config(monkeypatch):
    config, _ = read_committed(monkeypatch)
    return config


def list_differences(config):
    """Texts of the parameters that differ from the paper's known ones, by panel."""
    return {
        (row["panel"], each["here"], each["paper"])
        for row in compare_panels(config)
        for each in row["parameters"]
        if each["paper"] and not each["equal"]
    }


def test_the_committed_configuration_has_the_parameters_of_the_paper(config):
    assert list_differences(config) == set()
    shown = [each["here"] for row in compare_panels(config) for each in row["parameters"]]
    assert not [text for text in shown if text.endswith("= –")], "keys that have no value"
    (maps,) = [row for row in compare_panels(config) if row["panel"] == "2G–I"]
    assert [each["here"] for each in maps["parameters"]] == ["ε/h_rms = 0.0075", "l_a/ε = 0.2"]


def test_a_parameter_that_differs_is_shown_with_the_value_of_the_paper(config):
    config["adhesion"]["fig2"]["maps"]["range_over_h_rms"] = 0.1
    config["theory"]["sweeps"]["fig1a"]["magnification"] = [10, 100]
    config["adhesion"]["fig4b_smooth"]["h_rms"] = 2e-7
    assert list_differences(config) == {
        ("2G–I", "ε/h_rms = 0.1", "0.0075"),
        ("1A", "ζ = 10, 100", "10, 100, 1000"),
        ("4B", "h_rms = 200 nm", "100 nm"),
    }


def test_names_of_cases_surfaces_and_fidelities_are_followed(config):
    config["model_surfaces"]["H0.8_zeta64"]["magnification"] = 32.0
    config["fidelity"] = "draft"
    assert list_differences(config) == {("4B", "ζ = 32", "64"), ("4B", "realisations = 3", "8")}


def test_every_panel_is_described():
    panels = make_environment(ROOT / "report").get_template("panels.j2").module.panels
    assert panels.keys() == PANELS.keys()
