"""Presets chosen from the measured error models, as the table lists them."""

from pathlib import Path

import pytest
import yaml
from helpers.jobs import make_job

from tradeoff import choose_presets

ROOT = Path(__file__).parents[2]


def percent(text):
    return float(text.removesuffix("%")) / 100


@pytest.fixture(scope="module")
def rows(tmp_path_factory):
    """Rows of the table for the presets of the configuration, by their first cell."""
    config = yaml.safe_load((ROOT / "config/config.yaml").read_text(encoding="utf-8"))
    trade = yaml.safe_load((ROOT / "config/campaigns/tradeoff.yaml").read_text(encoding="utf-8"))
    presets = trade["presets"]
    params = {
        "presets": presets,
        "surface": config["model_surfaces"][presets["surface"]],
        "fidelities": config["fidelities"],
        "descriptor_seeds": config["sampling"]["descriptor_seeds"],
    }
    path = tmp_path_factory.mktemp("presets") / "presets.md"
    choose_presets.main(make_job(path, params, laws=str(ROOT / "config/accuracy.csv")))
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if line[:1] == "|"]
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    return presets, {row[0]: dict(zip(cells[0], row, strict=True)) for row in cells[2:]}


@pytest.mark.slow
def test_presets_keep_their_promise(rows):
    presets, table = rows
    for name, error in presets["accuracy"].items():
        chosen = table[f"{name}: below {error:.0%}"]
        errors = [percent(chosen[column]) for column in choose_presets.COLUMNS]
        assert max(errors) <= error * 1.05  # two digits are printed


def test_better_presets_cost_more(rows):
    presets, table = rows
    by_error = sorted(presets["accuracy"].items(), key=lambda item: -item[1])
    costs = [float(table[f"{name}: below {error:.0%}"]["cost"]) for name, error in by_error]
    assert costs == sorted(costs)
    assert costs[0] < costs[-1]
