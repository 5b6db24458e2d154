"""The numbers in README.md lie within their errors of the results of a run."""

from pathlib import Path

import numpy as np
import pytest

from common import heights_table
from common.paper import at_load
from stickiness import Material, Surface, datasets, example_wall, verdict
from stickiness.criteria.pair import WORDS

ROOT = Path(__file__).parents[2]
RUNS = [ROOT / "results" / fidelity for fidelity in ("standard", "draft")]


@pytest.fixture(scope="module")
def results():
    """Folder of a finished run, of the better fidelity if there are two."""
    for folder in RUNS:
        if (folder / "report/findings.md").exists():
            return folder
    pytest.skip("no finished run: make draft or make reproduce")


def read_sum(results):
    data = at_load(datasets.read(results / "adhesion/full/dmt_error.nc"))
    at = data.isel(adhesion_length_over_range=0).sel(range_over_h_rms=0.1)
    times = 1 / float(at.dmt_ratio_at_gap)
    return times, times**2 * float(at.dmt_ratio_at_gap_total_error)


def read_heights(model, kinds, quantity):
    """Percentage of simulations of some kinds of heights, for a model."""

    def read(results):
        table = heights_table.read(ROOT / "config/heights.csv")
        table = table[table.kind.isin(kinds)]
        return 100 * heights_table.compare(table, model, wanted_share=0.1)[quantity], 0.0

    return read


def count_sticking(results):
    words = np.array(WORDS)[datasets.read(results / "criteria/verdicts.nc").verdict.values]
    return np.isin(words, ["sticks", "sticks fully"]).sum(), 0.0


def count_failed_claims(results):
    verdicts = datasets.read(results / "claims/claims.nc").verdict.values
    return sum(verdict == "not reproduced" for verdict in verdicts), 0.0


@pytest.mark.parametrize(
    ("text", "number", "rounding", "read"),
    [
        ("that sum overestimates the attraction 2.7 times", 2.7, 0.05, read_sum),
        (
            "is within 25 % of six in seven shares",
            100 * 6 / 7,
            1,
            read_heights("theory", ["Gaussian"], "within_quarter"),
        ),
        (
            "On skewed heights the limits of this theory contain only 7 %",
            7,
            0.5,
            read_heights("theory", ["skewed", "transformed"], "inside"),
        ),
        ("49 pairs of material and surface, 11 stick", 11, 0, count_sticking),
        ("Of 22 graded claims, 7 are not reproduced", 7, 0, count_failed_claims),
    ],
)
def test_number_lies_within_its_error(results, text, number, rounding, read):
    readme = " ".join((ROOT / "README.md").read_text(encoding="utf-8").split())
    assert text in readme
    value, error = read(results)
    assert abs(value - number) <= error + rounding


def test_the_verdict_shown_is_that_of_the_tutorials_wall(tmp_path):
    """Printed by the library, as the command prints it."""
    example_wall.write(tmp_path / "wall.txt")
    wall = Surface.read(tmp_path / "wall.txt", length="2 mm", height_unit="um")
    tape = Material(youngs_modulus=0.2e6, work_of_adhesion=0.06, range=0.3e-9)
    assert f"The material: {verdict(wall, tape)}\n" in (ROOT / "README.md").read_text(
        encoding="utf-8"
    )
